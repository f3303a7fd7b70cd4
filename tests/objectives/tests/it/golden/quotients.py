"""Values and first and second derivatives of quotients that are 0 / 0 at 0, by 60 digits and their Taylor series.

Run: pip install mpmath; python3 quotients.py > quotients.txt
Each line: the name, x, the value, the first and the second derivative at x.
"""
from mpmath import mp, mpf, acos, asin, atan, cos, cosh, diff, exp, log, nstr, sin, sinh, sqrt, tan, tanh

mp.dps = 60

FUNCTIONS = {
    "sinc": lambda x: sin(x) / x,
    "versine": lambda x: (1 - cos(x)) / x**2,
    "cubic": lambda x: (x - sin(x)) / x**3,
    "tangent": lambda x: tan(x) / x,
    "cotangent": lambda x: x / tan(x),
    "arc_sine": lambda x: asin(x) / x,
    "arc_tangent": lambda x: atan(x) / x,
    "hyperbolic_sine": lambda x: sinh(x) / x,
    "hyperbolic_versine": lambda x: (cosh(x) - 1) / x**2,
    "hyperbolic_tangent": lambda x: tanh(x) / x,
    "half": lambda x: sin(x / 2) / x,
    "square_of_sinc": lambda x: (sin(x) / x) ** 2,
    "ratio": lambda x: sin(3 * x) / sin(x),
    "linear": lambda x: (1 - cos(x)) / x,
    # Of w = 1 − x: near 1.
    "arc_cosine": lambda x: acos(1 - x) / sqrt(1 - (1 - x) ** 2),
    "exponential": lambda x: (exp(x) - 1) / x,
    "occupation": lambda x: x / (exp(x) - 1),
    "logarithm": lambda x: log(1 + x) / x,
    "root": lambda x: (sqrt(1 + x) - 1) / x,
    "annuity": lambda x: (1 - (1 + x) ** -5) / x,
    "bessel": lambda x: (sin(x) - x * cos(x)) / x**3,
    "translation": lambda x: (1 - sin(x) / x) / x**2,
    "log_of_cosine": lambda x: log(cos(x)) / x**2,
    "sine_of_sine": lambda x: sin(sin(x)) / x,
    "over_sine_of_sine": lambda x: x / sin(sin(x)),
    "versine_of_sine": lambda x: (1 - cos(sin(x))) / x**2,
    "sine_of_arc_tangent": lambda x: sin(mpf("1.5") * atan(x)) / x,
}

PLACES = [mpf(0)] + [mpf(10) ** -k for k in range(12, 0, -1)] + [mpf("0.3"), mpf("0.37"), mpf("0.9"), mpf("1.1"), mpf(2), mpf("3.1"), mpf(7)]


def derivatives(function, x):
    """By an interpolating polynomial over a circle: exact also where the quotient has no value."""
    radius, n = mpf("0.05"), 48
    if x > mpf("0.2"):
        return [function(x), diff(function, x), diff(function, x, 2)]
    points = [radius * mp.expjpi(mpf(2) * k / n) for k in range(n)]
    values = [function(point) for point in points]
    coefficients = [sum(v * mp.expjpi(-mpf(2) * k * j / n) for k, v in enumerate(values)) / n / radius**j for j in range(n)]
    if abs(x) >= radius / 4:
        return [function(x), diff(function, x), diff(function, x, 2)]
    real = [c.real for c in coefficients]
    first = [j * c for j, c in enumerate(real)][1:]
    second = [j * c for j, c in enumerate(first)][1:]
    return [sum(c * x**j for j, c in enumerate(poly)) for poly in (real, first, second)]


for name, function in FUNCTIONS.items():
    for x in PLACES:
        if name == "arc_sine" and x >= 1 or name == "arc_cosine" and x >= 2 or name in ("ratio", "cotangent") and x > 3 or name == "log_of_cosine" and x > 1.5:
            continue
        values = derivatives(function, x)
        print(name, nstr(x, 3), *(nstr(v, 20) for v in values))
