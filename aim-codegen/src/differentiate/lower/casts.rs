//! Casts, and whole numbers that are rounded because they are represented by floating-point numbers.

use aim_symbolic::{Op, Scalar, ScalarNode};
use quote::ToTokens;
use syn::Expr;

use super::condition::Condition;
use super::expected::Expected;
use super::extents::Extents;
use super::value::Value;
use super::{NEAR, Translation, methods, strip};
use crate::differentiate::names::segments;
use crate::differentiate::{messages, types};
use crate::emit::Precision;

impl Translation<'_> {
    /// Returns `true` for a known whole number of at least 2⁵³, where not all whole numbers are representable.
    pub(super) fn is_too_large_to_count(&self, value: &Value) -> bool {
        let Value::Integer(x) = value else { return false };
        self.algebra.constant_of(*x).is_some_and(|x| x.abs() >= LARGEST_WHOLE)
    }

    /// Returns `true` for a whole number computed from one that 64-bit arithmetic may have wrapped. It compares
    /// correctly, but is rounded.
    pub(super) fn may_have_wrapped(&self, value: &Value) -> bool {
        let Value::Integer(x) = value else { return false };
        let (mut parts, mut next) = (vec![*x], 0);
        while let Some(&part) = parts.get(next) {
            next += 1;
            let ScalarNode::Op(op) = self.algebra.g.scalar_node(part) else { continue };
            let made_of = match op {
                Op::Constant(constant) if constant.value() >= 0.5 * WRAPPED => return true,
                // A truncated number was a floating-point number before; its rounding is the usual one.
                Op::Call(..) => Vec::new(),
                Op::SelectLess(_, _, then, otherwise) => vec![then, otherwise],
                op => op.operands().collect(),
            };
            for part in made_of {
                if !parts.contains(&part) {
                    parts.push(part);
                }
            }
        }
        false
    }

    /// Returns `true` for a known number that single precision may round to the other side of a whole number.
    fn is_nearly_whole(&self, x: Scalar) -> bool {
        let known = self.algebra.known(x).filter(|_| self.precision == Some(Precision::Single));
        known.is_some_and(|x| x.fract() != 0.0 && (x - x.round()).abs() <= NEAR * x.abs())
    }

    /// Evaluates `n.saturating_sub(m)`, which depends on the type of the integers: a difference of unsigned ones is at
    /// least 0. `None` for any other call, and if neither the type is known nor that the difference is not negative.
    pub(super) fn saturating_difference(
        &mut self,
        call: &syn::ExprMethodCall,
        receiver: &Value,
        expected: &Expected,
    ) -> Option<Value> {
        let (Value::Integer(n), "saturating_sub", Some(m)) =
            (receiver, call.method.to_string().as_str(), call.args.first())
        else {
            return None;
        };
        let is_unsigned = expected.name().is_some_and(types::is_unsigned) || self.is_unsigned(&call.receiver, *n);
        let m = match self.expression(m) {
            Value::Integer(m) => m,
            other => return other.is_unknown().then_some(Value::Unknown),
        };
        let difference = self.algebra.sub(*n, m);
        if Extents::new(self.algebra, self.frame.facts()).of(difference).least >= 0.0 {
            return Some(Value::Integer(difference));
        }
        let (is_less, zero) = (Condition::less(self.algebra, *n, m), self.algebra.number(0.0));
        is_unsigned.then(|| Value::Integer(is_less.select(self.algebra, zero, difference)))
    }

    /// Returns `true` if an integer is known to be of an unsigned type, by its expression or by its argument's type.
    fn is_unsigned(&self, expression: &Expr, n: Scalar) -> bool {
        let by_expression = match strip(expression) {
            Expr::MethodCall(call) => call.method == "len" || call.method == "count",
            Expr::Cast(cast) => match &*cast.ty {
                syn::Type::Path(path) => types::is_unsigned(&self.resolved(&segments(&path.path))),
                _ => false,
            },
            Expr::Lit(syn::ExprLit { lit: syn::Lit::Int(number), .. }) => types::is_unsigned(number.suffix()),
            _ => false,
        };
        let is_extra = self.algebra.extra_inputs.iter().any(|(_, input)| *input == n);
        by_expression || !is_extra && self.algebra.extent_of_input(n).is_some_and(|(least, _)| least == 0.0)
    }

    /// Returns `true` if a whole number certainly fits this type.
    fn fits(&self, x: Scalar, ty: &str) -> bool {
        let extent = Extents::new(self.algebra, self.frame.facts()).of(x);
        let (least, most) = types::ends(ty);
        extent.least >= least && extent.most <= most
    }

    /// Rounds a known number to its declared type, if that is `f32` in a function of `f64`.
    pub(super) fn rounded_to(&mut self, declared: &Expected, value: Value) -> Value {
        let is_wider = self.precision == Some(Precision::Double) && declared.name() == Some("f32");
        let Value::Scalar(x) = &value else { return value };
        match self.algebra.known(*x).filter(|_| is_wider) {
            Some(known) => Value::Scalar(self.algebra.number(single(known))),
            None => value,
        }
    }

    /// Evaluates `value as type`.
    pub(super) fn cast(&mut self, cast: &syn::ExprCast) -> Value {
        let value = self.expression(&cast.expr);
        let ty = match &*cast.ty {
            syn::Type::Path(path) => self.resolved(&segments(&path.path)),
            other => other.to_token_stream().to_string(),
        };
        let is_integer = |ty: &str| {
            ["usize", "isize"].contains(&ty) || (ty.starts_with(['u', 'i']) && ty[1..].parse::<u8>().is_ok())
        };
        match (&value, ty.as_str(), self.algebra.known_integer(&value)) {
            (Value::Unknown | Value::Never, ..) => value,
            (Value::Integer(_), "f32", Some(whole)) => Value::Scalar(self.algebra.number(in_single(whole))),
            (Value::Integer(x), "f32" | "f64", _) => Value::Scalar(*x),
            (Value::Scalar(x), number, _) if self.precision.is_some_and(|known| known.name() == number) => {
                Value::Scalar(self.algebra.cast_constant(*x))
            }
            // Truncating this constant may give another result in single precision.
            (Value::Scalar(x), ty, _) if is_integer(ty) && self.is_nearly_whole(*x) => {
                self.refuse(&cast.as_token, messages::rounded_constants())
            }
            (Value::Integer(_), ty, Some(whole))
                if is_integer(ty) && (whole >= 0 || !["u64", "usize"].contains(&ty)) =>
            {
                self.algebra.integer(wrapped(whole, ty))
            }
            (Value::Integer(x), ty, _) if is_integer(ty) && self.fits(*x, ty) => value,
            // No count is beyond the ends of these types.
            (Value::Integer(_), "i32" | "i64" | "isize", None) => value,
            (Value::Integer(x), "u32" | "usize" | "u64", _) => {
                let (x, turn) = (*x, if ty == "u32" { f64::from(u32::MAX) + 1.0 } else { WRAPPED });
                let (zero, turn) = (self.algebra.number(0.0), self.algebra.number(turn));
                let wrapped = self.algebra.add(x, turn);
                Value::Integer(Condition::less(self.algebra, x, zero).select(self.algebra, wrapped, x))
            }
            (Value::Truth(condition), ty, _) if is_integer(ty) => Value::Integer(self.algebra.number_of(condition)),
            (Value::Struct(of), ty, _) if is_integer(ty) && self.items.enumeration(&of.name).is_some() => {
                self.discriminant(cast, of)
            }
            (Value::Scalar(_), ty, _) if is_integer(ty) => methods::whole(self.algebra, &value, ty),
            (Value::Integer(_), ty, _) if is_integer(ty) => {
                self.unsupported(&cast.as_token, "a cast that may wrap around", "cast it to `i32`, `i64` or `usize`")
            }
            _ => self.unsupported(
                &cast.as_token,
                "this cast",
                "a function computes in one number type: write a number, or take an argument, of that type",
            ),
        }
    }
}

/// 2⁵³: up to here, `f64` represents all whole numbers exactly.
const LARGEST_WHOLE: f64 = (1_u64 << 53) as f64;

/// 2⁶⁴, which a cast to an unsigned 64-bit type adds to a negative number.
const WRAPPED: f64 = 18_446_744_073_709_551_616.0;

/// Rounds a number to `f32`.
#[expect(clippy::cast_possible_truncation, reason = "as `as` does")]
pub(super) fn single(number: f64) -> f64 {
    f64::from(number as f32)
}

/// Rounds a whole number to `f32`.
#[expect(clippy::cast_precision_loss, reason = "as `as` does")]
fn in_single(whole: i64) -> f64 {
    f64::from(whole as f32)
}

/// Converts a whole number to an integer type, wrapping.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "as `as` does")]
fn wrapped(whole: i64, ty: &str) -> i64 {
    match ty {
        "u8" => (whole as u8).into(),
        "u16" => (whole as u16).into(),
        "u32" => (whole as u32).into(),
        "i8" => (whole as i8).into(),
        "i16" => (whole as i16).into(),
        "i32" => (whole as i32).into(),
        // Wider types hold every `i64`, up to the sign.
        _ => whole,
    }
}
