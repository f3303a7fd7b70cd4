//! Exact numbers: the field of p² elements with p = 2⁶¹ − 1 and i² = −1, in which every element of the prime field has
//! a square root.
//!
//! Two different rational expressions agree at a random point with a probability of their degree / 2⁶¹. Operations
//! without a result in the field (division by 0, a root outside the field, a constant that is not a simple fraction)
//! yield an *undefined* value, which propagates.

use std::ops::{Add, Div, Mul, Neg, Sub};

use aim_symbolic::{Function, Number};

const P: u64 = (1 << 61) - 1;
/// Marks a value that is not an element: `re` is this, `im` holds the reason.
const UNDEFINED: u64 = u64::MAX;

/// Reason why a number is undefined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Undefined {
    /// Division by 0.
    DividedByZero = 1,
    /// Root that does not exist in the field.
    Root = 2,
    /// Constant that is not a simple fraction.
    Constant = 3,
    /// Operation on the smallest length.
    Tiny = 4,
}

/// Element re + im i, or a mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Field {
    re: u64,
    im: u64,
}

fn reduced(x: u64) -> u64 {
    let x = (x & P) + (x >> 61);
    if x >= P { x - P } else { x }
}

fn add(a: u64, b: u64) -> u64 {
    reduced(a + b)
}

fn sub(a: u64, b: u64) -> u64 {
    if a >= b { a - b } else { a + P - b }
}

fn mul(a: u64, b: u64) -> u64 {
    let wide = u128::from(a) * u128::from(b);
    #[expect(clippy::cast_possible_truncation, reason = "the low 61 bits, then the rest, which has 61 too")]
    let (low, high) = ((wide as u64) & P, (wide >> 61) as u64);
    reduced(low + high)
}

fn power(mut base: u64, mut exponent: u64) -> u64 {
    let mut product = 1;
    while exponent > 0 {
        if exponent & 1 == 1 {
            product = mul(product, base);
        }
        base = mul(base, base);
        exponent >>= 1;
    }
    product
}

fn inverse(a: u64) -> u64 {
    power(a, P - 2)
}

/// Returns one of the square roots in the prime field.
fn root(a: u64) -> Option<u64> {
    let mut root = a;
    for _ in 0..59 {
        root = mul(root, root);
    }
    (mul(root, root) == a).then_some(root)
}

/// Returns numerator and denominator, both below 2²⁴, if `a` is such a fraction.
fn fraction(a: u64) -> Option<(i64, i64)> {
    const SMALL: i64 = 1 << 24;
    let [mut r0, mut r1] = [P, a].map(|x| i64::try_from(x).expect("61 bits"));
    let (mut t0, mut t1) = (0, 1);
    while r1 >= SMALL {
        let quotient = r0 / r1;
        (r0, r1) = (r1, r0 - quotient * r1);
        (t0, t1) = (t1, t0 - quotient * t1);
    }
    (t1.abs() < SMALL).then_some((r1 * t1.signum(), t1.abs()))
}

/// Returns a pseudorandom number that depends on `seeds` alone.
pub(crate) fn hash(seeds: &[u64]) -> u64 {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    for &seed in seeds {
        state = (state ^ seed).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        state = (state ^ (state >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        state ^= state >> 31;
    }
    state
}

/// Returns the simple fraction that `value` is nearest to.
fn simple_fraction(value: f64) -> Option<(u64, u64)> {
    let tolerance = 1e-13 * value.max(1.0);
    let (mut h0, mut h1, mut k0, mut k1) = (0.0, 1.0, 1.0, 0.0);
    let mut rest = value;
    loop {
        let whole = rest.floor();
        (h0, h1) = (h1, whole * h1 + h0);
        (k0, k1) = (k1, whole * k1 + k0);
        // With larger denominators, some fraction is near any number by chance.
        if tolerance * k1 * k1 > 1e-5 || h1 > 1e12 {
            return None;
        }
        if (value - h1 / k1).abs() <= tolerance {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small and not negative")]
            return Some((h1 as u64, k1 as u64));
        }
        rest = 1.0 / (rest - whole);
    }
}

impl Field {
    pub(crate) const ZERO: Self = Self { re: 0, im: 0 };

    /// Creates an element of the prime field.
    pub(crate) fn new(re: u64) -> Self {
        Self { re: reduced(re), im: 0 }
    }

    const fn undefined_by(why: Undefined) -> Self {
        Self { re: UNDEFINED, im: why as u64 }
    }

    /// Returns the reason if it is not an element.
    pub(crate) fn undefined(self) -> Option<Undefined> {
        if self.re != UNDEFINED {
            return None;
        }
        [Undefined::DividedByZero, Undefined::Root, Undefined::Constant, Undefined::Tiny]
            .into_iter()
            .find(|&why| why as u64 == self.im)
    }

    /// Returns the first of both that is undefined.
    fn first_undefined(self, other: Self) -> Option<Self> {
        if self.re == UNDEFINED {
            Some(self)
        } else if other.re == UNDEFINED {
            Some(other)
        } else {
            None
        }
    }

    /// Selects one of x and −x. For fractions, the positive one; otherwise in the prime field, the one that is a
    /// square, so that products of positive numbers are positive; otherwise either, but the same one for x and −x.
    fn is_positive(self) -> bool {
        match (self.im, fraction(self.re)) {
            (0, Some((numerator, _))) => numerator >= 0,
            (0, None) => self.is_square(),
            _ if self.re != 0 => self.re <= P / 2,
            _ => self.im <= P / 2,
        }
    }

    /// Returns `true` for squares of elements of the prime field. −1 is not one.
    pub(crate) fn is_square(self) -> bool {
        self.im == 0 && root(self.re).is_some()
    }

    fn is_fraction(self) -> bool {
        self.im == 0 && fraction(self.re).is_some()
    }

    fn unsigned(self) -> (bool, Self) {
        if self.is_positive() { (false, self) } else { (true, -self) }
    }

    /// Returns a number that represents `function(self)`: arbitrary, but the same for the same argument.
    fn atom(self, tag: u64) -> Self {
        Self::new(hash(&[tag, self.re, self.im]) >> 3)
    }

    /// Returns the tangent of half of an angle, as an odd function.
    fn half_tangent(self) -> Self {
        if self == Self::ZERO {
            return self;
        }
        let (negative, x) = self.unsigned();
        let t = x.atom(1);
        if negative { -t } else { t }
    }

    /// Returns sine and cosine of the angle with this half tangent.
    pub(crate) fn sin_cos_of_half_tangent(t: Self) -> (Self, Self) {
        let (one, two) = (Self::new(1), Self::new(2));
        let scale = one / (one + t * t);
        (two * t * scale, (one - t * t) * scale)
    }

    fn norm(self) -> u64 {
        add(mul(self.re, self.re), mul(self.im, self.im))
    }
}

impl Add for Field {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        self.first_undefined(other).unwrap_or_else(|| Self { re: add(self.re, other.re), im: add(self.im, other.im) })
    }
}

impl Sub for Field {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self.first_undefined(other).unwrap_or_else(|| Self { re: sub(self.re, other.re), im: sub(self.im, other.im) })
    }
}

impl Mul for Field {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        if let Some(undefined) = self.first_undefined(other) {
            return undefined;
        }
        if self.im | other.im == 0 {
            return Self { re: mul(self.re, other.re), im: 0 };
        }
        let re = sub(mul(self.re, other.re), mul(self.im, other.im));
        Self { re, im: add(mul(self.re, other.im), mul(self.im, other.re)) }
    }
}

impl Div for Field {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        if let Some(undefined) = self.first_undefined(other) {
            return undefined;
        }
        if other == Self::ZERO {
            return Self::undefined_by(Undefined::DividedByZero);
        }
        let inverse = inverse(other.norm());
        self * Self { re: mul(other.re, inverse), im: mul(sub(0, other.im), inverse) }
    }
}

impl Neg for Field {
    type Output = Self;

    fn neg(self) -> Self {
        Self::ZERO - self
    }
}

impl Number for Field {
    fn constant(value: f64) -> Self {
        assert!(value.is_finite(), "constant {value}");
        let Some((numerator, denominator)) = simple_fraction(value.abs()) else {
            return Self::undefined_by(Undefined::Constant);
        };
        let size = Self::new(numerator) / Self::new(denominator);
        if value < 0.0 { -size } else { size }
    }

    fn tiny() -> Self {
        Self::undefined_by(Undefined::Tiny)
    }

    fn sqrt(self) -> Self {
        if self.re == UNDEFINED {
            return self;
        }
        let found = if self.im == 0 {
            let of_minus = || root(sub(0, self.re)).map(|im| Self { re: 0, im });
            root(self.re).map(Self::new).or_else(of_minus)
        } else {
            let half = inverse(2);
            root(self.norm()).and_then(|norm| {
                let halves = [add(self.re, norm), sub(self.re, norm)].map(|sum| mul(half, sum));
                let re = halves.into_iter().find_map(root)?;
                Some(Self { re, im: mul(self.im, inverse(mul(2, re))) })
            })
        };
        match found {
            None => Self::undefined_by(Undefined::Root),
            // In programs, such a root is a constant rounded to a double.
            Some(root) if self.is_fraction() && !root.is_fraction() => Self::undefined_by(Undefined::Constant),
            Some(root) => root.unsigned().1,
        }
    }

    /// Everything except 0 is above the smallest length, fractions are ordered, squares are positive, as roots are, and
    /// the rest is in an arbitrary order.
    fn select_less(a: Self, b: Self, then: Self, otherwise: Self) -> Self {
        let less = match (a.undefined(), b.undefined()) {
            (Some(Undefined::Tiny), None) => b != Self::ZERO,
            (None, Some(Undefined::Tiny)) => a == Self::ZERO,
            (Some(Undefined::Tiny), Some(_)) | (None, Some(_)) => return b,
            (Some(_), _) => return a,
            (None, None) => match (fraction(a.re), fraction(b.re)) {
                (Some((n, d)), Some((m, e))) if a.im | b.im == 0 => n * e < m * d,
                _ if a.im | b.im == 0 && b == Self::ZERO => !a.is_square(),
                _ if a.im | b.im == 0 && a == Self::ZERO => b.is_square(),
                _ => a != b && hash(&[a.re, a.im, b.re, b.im]) & 1 == 1,
            },
        };
        if less { then } else { otherwise }
    }

    fn call(self, function: Function) -> Self {
        if self.re == UNDEFINED {
            return self;
        }
        let (zero, one, two) = (Self::ZERO, Self::new(1), Self::new(2));
        let vanishes = match function {
            Function::Ln | Function::Acos => one,
            _ => zero,
        };
        if self.is_fraction() && self != vanishes {
            return Self::undefined_by(Undefined::Constant);
        }
        let (sin, cos) = match function {
            Function::Sin | Function::Cos | Function::Tan => Self::sin_cos_of_half_tangent(self.half_tangent()),
            _ => (zero, zero),
        };
        match function {
            Function::Sin => sin,
            Function::Cos => cos,
            Function::Tan => sin / cos,
            // Angles of the points with this sine or cosine, so that they agree with `atan2`.
            Function::Asin => self.atan2((one - self * self).sqrt()),
            Function::Acos => (one - self * self).sqrt().atan2(self),
            Function::Ln if self == one => zero,
            Function::Exp if self == zero => one,
            // Positive.
            Function::Exp => self.atom(4) * self.atom(4),
            Function::Ln => self.atom(5),
            Function::Sinh | Function::Cosh | Function::Tanh => {
                // Like circular functions, of i times the argument.
                let t = self.half_tangent();
                let (sinh, cosh) = (two * t, one + t * t);
                match function {
                    Function::Sinh => sinh / (one - t * t),
                    Function::Cosh => cosh / (one - t * t),
                    _ => sinh / cosh,
                }
            }
            Function::Floor => self.atom(9),
        }
    }

    fn atan2(self, x: Self) -> Self {
        if let Some(undefined) = self.first_undefined(x) {
            return undefined;
        }
        // Odd in the first argument.
        if self == Self::ZERO {
            return self;
        }
        let (negative, y) = self.unsigned();
        // The same for all multiples by a length.
        let ratio = x / y;
        let value = Self::new(hash(&[6, ratio.re, ratio.im]) >> 3);
        if negative { -value } else { value }
    }
}

#[test]
fn the_field_is_a_field_with_roots() {
    let mut random = fastrand::Rng::with_seed(1);
    for _ in 0..1000 {
        let [a, b, c, d] = [0; 4].map(|_| reduced(random.u64(..) >> 1));
        let (x, y) = (Field { re: a, im: b }, Field { re: c, im: d });
        assert_eq!(x / y * y, x);
        assert_eq!((x + y) * (x - y), x * x - y * y);
        assert_eq!(Field::new(a).sqrt() * Field::new(a).sqrt(), Field::new(a));
        assert_eq!((x * x).sqrt(), x.unsigned().1);
        let (sin, cos) = (x.call(Function::Sin), x.call(Function::Cos));
        assert_eq!(sin * sin + cos * cos, Field::new(1));
        assert_eq!((-x).call(Function::Sin), -sin);
    }
    for (value, numerator, denominator) in [(0.6 * 0.8 * 0.6, 36, 125), (0.171_875, 11, 64), (1.0 / 3.0 / 3.0, 1, 9)] {
        assert_eq!(Field::constant(-value), -Field::new(numerator) / Field::new(denominator));
        assert_eq!((Field::constant(value) * Field::constant(value)).sqrt(), Field::constant(value));
    }
    assert_eq!(Field::constant(2.0_f64.sqrt()).undefined(), Some(Undefined::Constant));
}
