//! Functions of numbers.

use std::rc::Rc;

use aim_symbolic::Function::{Acos, Asin, Cosh, Exp, Floor, Ln, Sinh, Tan, Tanh};
use aim_symbolic::Scalar;

use super::function::{Fault, evaluate, functions};
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
    acos(x: Scalar) -> Scalar { a.call(Acos, x) }
    atan(x: Scalar) = x.atan2(1.0);
    atan2(y: Scalar, x: Scalar) -> Scalar { a.atan2(y, x) }
    powi(x: Scalar, exponent: Integer) -> Scalar {
        let exponent = whole(a, exponent)?;
        a.power(x, exponent)
    }
    powf(x: Scalar, exponent: Scalar) -> Scalar { a.pow(x, exponent) }
    sqrt(x: Scalar) -> Scalar { a.sqrt(x) }
    cbrt(x: Scalar) = x.signum() * x.abs().powf(1.0 / 3.0);
    exp(x: Scalar) -> Scalar { a.call(Exp, x) }
    exp_m1(x: Scalar) = 2.0 * (0.5 * x).sinh() * (0.5 * x).exp();
    exp2(x: Scalar) = (x * core::f64::consts::LN_2).exp();
    ln(x: Scalar) -> Scalar { a.call(Ln, x) }
    log(x: Scalar, base: Scalar) = x.ln() / base.ln();
    log2(x: Scalar) = x.ln() / core::f64::consts::LN_2;
    log10(x: Scalar) = x.ln() / core::f64::consts::LN_10;
    sinh(x: Scalar) -> Scalar { a.call(Sinh, x) }
    cosh(x: Scalar) -> Scalar { a.call(Cosh, x) }
    tanh(x: Scalar) -> Scalar { a.call(Tanh, x) }
    rem_euclid(x: Scalar, y: Scalar) -> Scalar {
        let size = evaluate(a, "y.abs()", &["y"], &[Value::Scalar(y)]);
        let Value::Scalar(size) = size else { return Err(Fault::Arguments) };
        let quotient = a.div(x, size);
        let turns = a.call(Floor, quotient);
        let whole = a.mul(size, turns);
        a.sub(x, whole)
    }
    copysign(x: Scalar, sign: Scalar) = sign.signum() * x.abs();
    abs(x: Scalar) = if x < 0.0 { -x } else { x };
    signum(x: Scalar) = if x < 0.0 { -1.0 } else { 1.0 };
    min(x: Scalar, y: Scalar) = if y < x { y } else { x };
    max(x: Scalar, y: Scalar) = if x < y { y } else { x };
    clamp(x: Scalar, low: Scalar, high: Scalar) = x.max(low).min(high);
    recip(x: Scalar) -> Scalar { a.recip(x) }
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
    partial_cmp(x: Scalar, y: Scalar) -> Optional {
        let order = Value::Ordering(Rc::new(Order::of(a, x, y)));
        Rc::new(Optional { is_some: Condition::Known(true), value: order })
    }
    total_cmp(x: Scalar, y: Scalar) -> Ordering { Rc::new(Order::of(a, x, y)) }
    clone(x: Scalar) -> Scalar { x }
}

functions! {
    /// Of whole numbers.
    WHOLE(a):
    pow(n: Integer, exponent: Integer) -> Integer {
        let exponent = whole(a, exponent)?;
        if exponent < 0 {
            return Err(Fault::Arguments);
        }
        a.power(n, exponent)
    }
    abs(n: Integer) = if n < 0 { -n } else { n };
    min(n: Integer, m: Integer) = if m < n { m } else { n };
    max(n: Integer, m: Integer) = if n < m { m } else { n };
    cmp(n: Integer, m: Integer) -> Ordering { Rc::new(Order::of(a, n, m)) }
    clone(n: Integer) -> Integer { n }
}

/// The exponent of a power, which has to be known.
fn whole(a: &Algebra, exponent: Scalar) -> Result<i32, Text> {
    let known = a.known_integer(&Value::Integer(exponent)).and_then(|exponent| i32::try_from(exponent).ok());
    known.ok_or_else(messages::power_unknown)
}
