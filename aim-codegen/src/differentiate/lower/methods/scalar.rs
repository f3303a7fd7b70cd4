//! Functions of numbers.

use std::rc::Rc;

use aim_symbolic::Function::{Acos, Asin, Cosh, Exp, Floor, Ln, Sinh, Tan, Tanh};
use aim_symbolic::{Node, Op, Scalar, ScalarNode};

use super::function::{CallError, evaluate, functions};
use crate::declare::report::text::Text;
use crate::differentiate::lower::algebra::Algebra;
use crate::differentiate::lower::condition::Condition;
use crate::differentiate::lower::value::{Optional, Order, Value};
use crate::differentiate::messages;

functions! {
    METHODS(a):
    sin(x: Scalar) -> Scalar { a.sin_cos(x).0 }
    cos(x: Scalar) -> Scalar { a.sin_cos(x).1 }
    sin_cos(x: Scalar) -> Tuple {
        let (sin, cos) = a.sin_cos(x);
        vec![Value::Scalar(sin), Value::Scalar(cos)]
    }
    tan(x: Scalar) -> Scalar { a.call(Tan, x) }
    asin(x: Scalar) -> Scalar { a.call(Asin, x) }
    acos(x: Scalar) -> Scalar {
        // Of a quaternion of length 1, w = √(1 − |u|²).
        match a.unit_parts.get(&x).copied().filter(|_| a.varies(Node::Scalar(x))) {
            Some(u) => {
                let length = a.norm(u);
                a.atan2(length, x)
            }
            None => a.call(Acos, x),
        }
    }
    atan(x: Scalar) = x.atan2(1.0);
    atan2(y: Scalar, x: Scalar) -> Scalar { a.atan2(y, x) }
    powi(x: Scalar, exponent: Integer) -> Scalar {
        match whole(a, exponent) {
            Ok(exponent) => a.power(x, exponent),
            Err(_) => a.pow(x, exponent),
        }
    }
    powf(x: Scalar, exponent: Scalar) -> Scalar { a.pow(x, exponent) }
    sqrt(x: Scalar) -> Scalar { a.sqrt(x) }
    cbrt(x: Scalar) = x.signum() * x.abs().powf(1.0 / 3.0);
    exp(x: Scalar) -> Scalar { a.call(Exp, x) }
    // For x < −1, the difference loses no digits and cannot overflow.
    exp_m1(x: Scalar) = if x < -1.0 { x.exp() - 1.0 } else { 2.0 * (0.5 * x).sinh() * (0.5 * x).exp() };
    exp2(x: Scalar) = (x * core::f64::consts::LN_2).exp();
    ln(x: Scalar) -> Scalar { a.call(Ln, x) }
    ln_1p(x: Scalar) -> Scalar { by_artanh(a, x, ["2.0", "1.0 / (2.0 + x)", "square < 0.0625", "(1.0 + x).ln()"])? }
    log(x: Scalar, base: Scalar) = x.ln() / base.ln();
    log2(x: Scalar) = x.ln() / core::f64::consts::LN_2;
    log10(x: Scalar) = x.ln() / core::f64::consts::LN_10;
    sinh(x: Scalar) -> Scalar { a.call(Sinh, x) }
    cosh(x: Scalar) -> Scalar { a.call(Cosh, x) }
    tanh(x: Scalar) -> Scalar { a.call(Tanh, x) }
    asinh(x: Scalar) -> Scalar { by_artanh(a, x, ["1.0", "1.0 / (1.0 + x * x).sqrt()", "x * x < 1.0 / 15.0", ASINH])? }
    acosh(x: Scalar) -> Scalar {
        // 1 + d loses the digits of a small d.
        let d = [0, 1].into_iter().find_map(|side| match a.g.scalar_node(x) {
            ScalarNode::Op(Op::Add(p, q)) if a.constant_of([p, q][side]) == Some(1.0) => Some([q, p][side]),
            _ => None,
        });
        match d {
            Some(d) => number(a, ACOSH, d)?,
            None => number(a, &format!("{{ let x = x - 1.0; {ACOSH} }}"), x)?,
        }
    }
    atanh(x: Scalar) -> Scalar { by_artanh(a, x, ["1.0", "1.0", "square < 0.0625", "0.5 * ((1.0 + x) / (1.0 - x)).ln()"])? }
    floor(x: Scalar) -> Scalar { a.call(Floor, x) }
    ceil(x: Scalar) = -(-x).floor();
    trunc(x: Scalar) = if x < 0.0 { x.ceil() } else { x.floor() };
    fract(x: Scalar) = x - x.trunc();
    round(x: Scalar) = {
        let whole = x.trunc();
        let rest = x - whole;
        if rest < 0.5 && rest > -0.5 { whole } else { whole + x.signum() }
    };
    rem_euclid(x: Scalar, y: Scalar) -> Scalar {
        let size = size(a, y)?;
        let quotient = a.div(x, size);
        let turns = a.call(Floor, quotient);
        let whole = a.mul(size, turns);
        a.sub(x, whole)
    }
    copysign(x: Scalar, sign: Scalar) = sign.signum() * x.abs();
    abs(x: Scalar) = if x < 0.0 { -x } else { x };
    signum(x: Scalar) = if x < 0.0 { -1.0 } else { 1.0 };
    min(x: Scalar, y: Scalar) -> Scalar { or_number(a, x, y, "if y < x { y } else { x }")? }
    max(x: Scalar, y: Scalar) -> Scalar { or_number(a, x, y, "if x < y { y } else { x }")? }
    clamp(x: Scalar, low: Scalar, high: Scalar) = x.max(low).min(high);
    recip(x: Scalar) -> Scalar { a.recip(x) }
    midpoint(x: Scalar, y: Scalar) = 0.5 * (x + y);
    mul_add(x: Scalar, factor: Scalar, summand: Scalar) = x * factor + summand;
    hypot(x: Scalar, y: Scalar) = Vec2::new(x, y).length();
    to_radians(x: Scalar) -> Scalar {
        let factor = a.number(core::f64::consts::PI / 180.0);
        a.mul(factor, x)
    }
    to_degrees(x: Scalar) -> Scalar {
        let factor = a.number(180.0 / core::f64::consts::PI);
        a.mul(factor, x)
    }
    is_finite(x: Scalar) -> Truth {
        let (size, infinity) = (size(a, x)?, a.number(f64::INFINITY));
        Condition::less(a, size, infinity)
    }
    is_infinite(x: Scalar) -> Truth {
        let (size, [infinity, below]) = (size(a, x)?, [f64::INFINITY, -1.0].map(|end| a.number(end)));
        Condition::less(a, size, infinity).not().and(Condition::less(a, below, size))
    }
    is_nan(x: Scalar) -> Truth {
        let (size, below) = (size(a, x)?, a.number(-1.0));
        Condition::less(a, below, size).not()
    }
    partial_cmp(x: Scalar, y: Scalar) -> Optional {
        let order = Value::Ordering(Rc::new(Order::of(a, x, y)));
        Rc::new(Optional { is_some: Condition::Known(true), value: order })
    }
    total_cmp(x: Scalar, y: Scalar) -> Ordering { Rc::new(Order::of(a, x, y)) }
    clone(x: Scalar) -> Scalar { x }
}

functions! {
    /// Functions of whole numbers.
    WHOLE(a):
    pow(n: Integer, exponent: Integer) -> Integer {
        let exponent = whole(a, exponent)?;
        if exponent < 0 {
            return Err(CallError::Arguments);
        }
        a.power(n, exponent)
    }
    abs(n: Integer) = if n < 0 { -n } else { n };
    min(n: Integer, m: Integer) = if m < n { m } else { n };
    max(n: Integer, m: Integer) = if n < m { m } else { n };
    clamp(n: Integer, low: Integer, high: Integer) = n.max(low).min(high);
    signum(n: Integer) = if n < 0 { -1 } else if n > 0 { 1 } else { 0 };
    abs_diff(n: Integer, m: Integer) = (n - m).abs();
    rem_euclid(n: Integer, m: Integer) = {
        let rest = n % m;
        if rest < 0 { rest + m.abs() } else { rest }
    };
    div_euclid(n: Integer, m: Integer) = (n - n.rem_euclid(m)) / m;
    div_ceil(n: Integer, m: Integer) = (n + m - 1) / m;
    is_multiple_of(n: Integer, m: Integer) = if m == 0 { n == 0 } else { n % m == 0 };
    is_power_of_two(n: Integer) -> Truth { Condition::Known(known(a, n, "is_power_of_two")?.is_power_of_two()) }
    isqrt(n: Integer) -> Integer {
        let root = known(a, n, "isqrt")?.isqrt();
        a.count(root)
    }
    ilog2(n: Integer) -> Integer {
        let power = known(a, n, "ilog2")?.checked_ilog2().ok_or_else(|| messages::integer_unknown("ilog2"))?;
        a.number(f64::from(power))
    }
    cmp(n: Integer, m: Integer) -> Ordering { Rc::new(Order::of(a, n, m)) }
    clone(n: Integer) -> Integer { n }
}

/// asinh |x| with the sign of x. An overflow of x² is harmless: 1/x² is then 0.
const ASINH: &str = "x.signum() * (x.abs() * (1.0 + (1.0 + 1.0 / (x * x)).sqrt())).ln()";

/// arcosh (1 + x) = 2 artanh √q with q = x/(x + 2), by its series where q < 1/16. Has the factor √x, so that its square
/// is smooth at 0.
const ACOSH: &str = "{
    let q = x / (x + 2.0);
    let series = (0..13).rev().fold(0.0, |sum, k| sum * q + 1.0 / (2 * k + 1) as f64);
    let far = if q < 0.0625 { 1.0 } else { x };
    let closed = (1.0 + far + far.sqrt() * (far + 2.0).sqrt()).ln() / far.sqrt();
    x.sqrt() * if q < 0.0625 { 2.0 * series / (x + 2.0).sqrt() } else { closed }
}";

/// Returns c artanh(r x), with `r` given as an expression of x. Where `near`, which implies |r x| < ¼, uses the series
/// c r x Σ (r x)²ᵏ/(2k + 1), which loses no digits; elsewhere `closed`, an expression of x with logarithms. Both have
/// the factor x, so that a quotient by x has its limit at 0.
fn by_artanh(a: &mut Algebra, x: Scalar, [c, r, near, closed]: [&str; 4]) -> Result<Scalar, CallError> {
    let formula = format!(
        "{{
            let r = {r};
            let square = (r * x) * (r * x);
            let series = (0..13).rev().fold(0.0, |sum, k| sum * square + 1.0 / (2 * k + 1) as f64);
            let far = if {near} {{ 0.5 }} else {{ x }};
            let closed = |x: f64| {closed};
            x * if {near} {{ {c} * r * series }} else {{ closed(far) / far }}
        }}"
    );
    number(a, &formula, x)
}

/// Evaluates a formula of one number.
fn number(a: &mut Algebra, formula: &str, x: Scalar) -> Result<Scalar, CallError> {
    match evaluate(a, formula, &["x"], &[Value::Scalar(x)]) {
        Value::Scalar(value) => Ok(value),
        _ => Err(CallError::Arguments),
    }
}

/// Evaluates a formula of two numbers. If one of them is a constant NaN, returns the other.
fn or_number(a: &mut Algebra, x: Scalar, y: Scalar, formula: &str) -> Result<Scalar, CallError> {
    match [x, y].map(|x| a.constant_of(x).is_some_and(f64::is_nan)) {
        [true, _] => return Ok(y),
        [_, true] => return Ok(x),
        _ => {}
    }
    let Value::Scalar(value) = evaluate(a, formula, &["x", "y"], &[Value::Scalar(x), Value::Scalar(y)]) else {
        return Err(CallError::Arguments);
    };
    // Its scalar part is never beyond ±1.
    if let Some(&u) = a.unit_parts.get(&x).filter(|_| a.constant_of(y).is_some_and(|end| end.abs() == 1.0)) {
        a.unit_parts.insert(value, u);
    }
    Ok(value)
}

/// Returns |x|.
fn size(a: &mut Algebra, x: Scalar) -> Result<Scalar, CallError> {
    number(a, "x.abs()", x)
}

/// Returns a number that must be known, and not negative.
fn known(a: &Algebra, n: Scalar, name: &str) -> Result<usize, Text> {
    a.known_index(&Value::Integer(n)).ok_or_else(|| messages::integer_unknown(name))
}

/// Returns the exponent of a power, which must be known.
fn whole(a: &Algebra, exponent: Scalar) -> Result<i32, Text> {
    let known = a.known_integer(&Value::Integer(exponent)).and_then(|exponent| i32::try_from(exponent).ok());
    known.ok_or_else(messages::power_unknown)
}
