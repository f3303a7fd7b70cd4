//! Operators on two values, as defined by the language and by glam.

use aim_symbolic::{Fold, Function, Scalar, Vector};
use syn::BinOp;

use super::algebra::Algebra;
use super::condition::Condition;
use super::map::{Affine, Quaternion};
use super::value::Value;
use super::{methods, square};

/// Evaluates `left operator right`; `None` if there is no such operation.
pub(super) fn binary(a: &mut Algebra, operator: &BinOp, left: &Value, right: &Value) -> Option<Value> {
    if let (Value::Integer(x), Value::Integer(y)) = (left, right)
        && let Some(value) = of_integers(a, operator, *x, *y)
    {
        return Some(value);
    }
    if let Some(value) = of_squares(a, operator, left, right) {
        return Some(value);
    }
    match operator {
        BinOp::Add(_) => sum(a, (left, right), Fold::add, Algebra::add_vectors),
        BinOp::Sub(_) => sum(a, (left, right), Fold::sub, Algebra::sub_vectors),
        BinOp::Mul(_) => multiply(a, left, right),
        BinOp::Div(_) => divide(a, left, right),
        BinOp::Rem(_) => remainder(a, left, right),
        _ => match (left, right) {
            (Value::Struct(x), Value::Struct(y)) if x.is_mask() && y.is_mask() && is_of_bits(operator) => {
                let pairs = x.fields.iter().zip(&y.fields);
                let parts = pairs.map(|((_, x), (_, y))| compare(a, operator, x, y).map(Value::Truth));
                Some(Value::Struct(x.with(parts.collect::<Option<_>>()?)))
            }
            _ => compare(a, operator, left, right).map(Value::Truth),
        },
    }
}

/// Evaluates a sum or a difference; a number beside a vector applies to each component.
fn sum(
    a: &mut Algebra,
    (left, right): (&Value, &Value),
    of_scalars: fn(&mut Fold, Scalar, Scalar) -> Scalar,
    of_vectors: fn(&mut Algebra, Vector, Vector) -> Vector,
) -> Option<Value> {
    Some(match (left, right) {
        (Value::Scalar(x), Value::Scalar(y)) => Value::Scalar(of_scalars(a, *x, *y)),
        (Value::Planar(v), Value::Planar(w)) => Value::Planar(of_vectors(a, *v, *w)),
        (Value::Vector(v), Value::Vector(w)) => Value::Vector(of_vectors(a, *v, *w)),
        (Value::Vector(v), Value::Scalar(x)) => {
            let w = a.vector([*x; 3]);
            Value::Vector(of_vectors(a, *v, w))
        }
        (Value::Scalar(x), Value::Vector(w)) => {
            let v = a.vector([*x; 3]);
            Value::Vector(of_vectors(a, v, *w))
        }
        (Value::Planar(v), Value::Scalar(x)) => {
            let w = in_plane(a, *x);
            Value::Planar(of_vectors(a, *v, w))
        }
        (Value::Scalar(x), Value::Planar(w)) => {
            let v = in_plane(a, *x);
            Value::Planar(of_vectors(a, v, *w))
        }
        (Value::Four(v), Value::Four(w)) => Value::Four(core::array::from_fn(|k| of_scalars(a, v[k], w[k]))),
        (Value::Four(v), Value::Scalar(x)) => Value::Four(v.map(|c| of_scalars(a, c, *x))),
        (Value::Scalar(x), Value::Four(w)) => Value::Four(w.map(|c| of_scalars(a, *x, c))),
        (Value::Matrix(m), Value::Matrix(n)) => Value::Matrix(m.zip(a, n, of_vectors)),
        (Value::Quaternion(q), Value::Quaternion(r)) => {
            let ((u, w), (v, x)) = (q.parts, r.parts);
            Value::Quaternion(Quaternion::from_parts(of_vectors(a, u, v), of_scalars(a, w, x)))
        }
        _ => return None,
    })
}

/// Returns the vector of two with both components equal to `x`.
fn in_plane(a: &mut Algebra, x: Scalar) -> Vector {
    let zero = a.number(0.0);
    a.vector([x, x, zero])
}

fn multiply(a: &mut Algebra, left: &Value, right: &Value) -> Option<Value> {
    Some(match (left, right) {
        (Value::Scalar(x), Value::Scalar(y)) => Value::Scalar(a.mul(*x, *y)),
        (Value::Scalar(k), Value::Planar(v)) | (Value::Planar(v), Value::Scalar(k)) => Value::Planar(a.scale(*k, *v)),
        (Value::Scalar(k), Value::Vector(v)) | (Value::Vector(v), Value::Scalar(k)) => Value::Vector(a.scale(*k, *v)),
        (Value::Planar(v), Value::Planar(w)) => Value::Planar(a.zip(*v, *w, Algebra::mul)),
        (Value::Vector(v), Value::Vector(w)) => Value::Vector(a.zip(*v, *w, Algebra::mul)),
        (Value::Scalar(k), Value::Four(v)) | (Value::Four(v), Value::Scalar(k)) => Value::Four(v.map(|x| a.mul(*k, x))),
        (Value::Four(v), Value::Four(w)) => Value::Four(core::array::from_fn(|k| a.mul(v[k], w[k]))),
        (Value::Quaternion(q), Value::Vector(v)) => Value::Vector(q.map.apply(a, *v)),
        (Value::Quaternion(q), Value::Quaternion(r)) => Value::Quaternion(q.compose(a, r)),
        (Value::Quaternion(q), Value::Scalar(k)) => {
            let (u, w) = q.parts;
            Value::Quaternion(Quaternion::from_parts(a.scale(*k, u), a.mul(*k, w)))
        }
        (Value::Matrix(m), Value::Vector(v)) => Value::Vector(m.apply(a, *v)),
        (Value::Matrix(m), Value::Matrix(n)) => Value::Matrix(m.compose(a, n)),
        (Value::Matrix(m), Value::Scalar(k)) | (Value::Scalar(k), Value::Matrix(m)) => {
            Value::Matrix(m.map(a, |a, column| a.scale(*k, column)))
        }
        (Value::Affine(m), Value::Affine(n)) => Value::Affine(m.compose(a, n)),
        (Value::Matrix(m), Value::Affine(n)) => {
            let m = Affine::about_origin(a, m.clone());
            Value::Affine(m.compose(a, n))
        }
        (Value::Affine(m), Value::Matrix(n)) => {
            let n = Affine::about_origin(a, n.clone());
            Value::Affine(m.compose(a, &n))
        }
        _ => return None,
    })
}

fn divide(a: &mut Algebra, left: &Value, right: &Value) -> Option<Value> {
    match (left, right) {
        (Value::Scalar(x), Value::Scalar(y)) => Some(Value::Scalar(a.div(*x, *y))),
        (Value::Vector(v), Value::Vector(w)) => Some(Value::Vector(a.zip(*v, *w, |a, x, y| a.div(x, y)))),
        (Value::Scalar(x), Value::Vector(w)) => {
            let v = a.vector([*x; 3]);
            Some(Value::Vector(a.zip(v, *w, |a, x, y| a.div(x, y))))
        }
        (Value::Planar(_) | Value::Scalar(_), Value::Planar(w)) => {
            let v = match left {
                Value::Planar(v) => *v,
                Value::Scalar(x) => in_plane(a, *x),
                _ => return None,
            };
            // Keep the third component at 0.
            let (v, w, zero) = (a.parts(v), a.parts(*w), a.number(0.0));
            let [x, y] = [0, 1].map(|k| a.div(v[k], w[k]));
            Some(Value::Planar(a.vector([x, y, zero])))
        }
        (Value::Four(v), Value::Four(w)) => Some(Value::Four(core::array::from_fn(|k| a.div(v[k], w[k])))),
        (Value::Scalar(x), Value::Four(w)) => Some(Value::Four(w.map(|c| a.div(*x, c)))),
        (
            Value::Planar(_) | Value::Vector(_) | Value::Four(_) | Value::Matrix(_) | Value::Quaternion(_),
            Value::Scalar(k),
        ) => {
            let reciprocal = Value::Scalar(a.recip(*k));
            multiply(a, left, &reciprocal)
        }
        _ => None,
    }
}

/// Evaluates operators on 2×2 and 4×4 matrices.
fn of_squares(a: &mut Algebra, operator: &BinOp, left: &Value, right: &Value) -> Option<Value> {
    if let (BinOp::Mul(_), Value::Homogeneous(m)) = (operator, left) {
        match right {
            Value::Homogeneous(n) => return Some(Value::Homogeneous(m.compose(a, n))),
            Value::Four([x, y, z, w]) => {
                let v = a.vector([*x, *y, *z]);
                let (image, along) = (m.map.apply(a, v), a.scale(*w, m.translation));
                let sum = a.add_vectors(image, along);
                let [x, y, z] = a.parts(sum);
                return Some(Value::Four([x, y, z, *w]));
            }
            _ => {}
        }
    }
    let (m, n) = (square::columns(a, left), square::columns(a, right));
    Some(match (operator, m, n) {
        (BinOp::Mul(_), Some(m), Some(n)) if m.len() == n.len() => {
            Value::Square(n.iter().map(|column| square::apply(a, &m, column)).collect())
        }
        (BinOp::Mul(_), Some(m), None) => match right {
            Value::Scalar(k) => Value::Square(square::scaled(a, *k, &m)),
            _ => {
                let v = square::numbers(a, right);
                if v.len() != m.len() {
                    return None;
                }
                let image = square::apply(a, &m, &v);
                square::vector(a, &image)
            }
        },
        (BinOp::Mul(_), None, Some(n)) => {
            let Value::Scalar(k) = left else { return None };
            Value::Square(square::scaled(a, *k, &n))
        }
        (BinOp::Div(_), Some(m), None) => {
            let Value::Scalar(k) = right else { return None };
            let reciprocal = a.recip(*k);
            Value::Square(square::scaled(a, reciprocal, &m))
        }
        (BinOp::Add(_), Some(m), Some(n)) if m.len() == n.len() => {
            Value::Square(square::zip(a, &m, &n, |a, x, y| a.add(x, y)))
        }
        (BinOp::Sub(_), Some(m), Some(n)) if m.len() == n.len() => {
            Value::Square(square::zip(a, &m, &n, |a, x, y| a.sub(x, y)))
        }
        _ => return None,
    })
}

/// Returns x − y trunc(x / y).
fn remainder(a: &mut Algebra, left: &Value, right: &Value) -> Option<Value> {
    let (Value::Scalar(x), Value::Scalar(y)) = (left, right) else { return None };
    let quotient = a.div(*x, *y);
    let (zero, opposite) = (a.number(0.0), a.neg(quotient));
    let (down, up) = (a.call(Function::Floor, quotient), a.call(Function::Floor, opposite));
    let up = a.neg(up);
    let turns = Condition::less(a, quotient, zero).select(a, up, down);
    let whole = a.mul(*y, turns);
    Some(Value::Scalar(a.sub(*x, whole)))
}

/// Returns `true` if an operator is a comparison.
pub(super) fn compares(operator: &BinOp) -> bool {
    use BinOp::{Eq, Ge, Gt, Le, Lt, Ne};
    matches!(operator, Lt(_) | Le(_) | Gt(_) | Ge(_) | Eq(_) | Ne(_))
}

/// Evaluates operators on whole numbers. Those on their bits require known operands.
fn of_integers(a: &mut Algebra, operator: &BinOp, x: Scalar, y: Scalar) -> Option<Value> {
    let [left, right] = [x, y].map(|it| a.known_integer(&Value::Integer(it)));
    if let (Some(left), Some(right)) = (left, right) {
        let known = match operator {
            BinOp::Add(_) => left.checked_add(right),
            BinOp::Sub(_) => left.checked_sub(right),
            BinOp::Mul(_) => left.checked_mul(right),
            BinOp::Div(_) => left.checked_div(right),
            BinOp::Rem(_) => left.checked_rem(right),
            BinOp::BitAnd(_) => Some(left & right),
            BinOp::BitOr(_) => Some(left | right),
            BinOp::BitXor(_) => Some(left ^ right),
            BinOp::Shl(_) => shifted_left(left, right),
            BinOp::Shr(_) => u32::try_from(right).ok().and_then(|count| left.checked_shr(count)),
            _ => None,
        };
        return known.map(|known| a.integer(known));
    }
    if matches!(operator, BinOp::Div(_) | BinOp::Rem(_)) {
        let quotient = Value::Scalar(a.div(x, y));
        let Value::Integer(quotient) = methods::whole(a, &quotient, "i64") else { return None };
        let product = a.mul(y, quotient);
        return Some(Value::Integer(if matches!(operator, BinOp::Div(_)) { quotient } else { a.sub(x, product) }));
    }
    Some(Value::Integer(match operator {
        BinOp::Add(_) => a.add(x, y),
        BinOp::Sub(_) => a.sub(x, y),
        BinOp::Mul(_) => a.mul(x, y),
        _ => return None,
    }))
}

/// Returns `n << count` if it is the same in all integer types: a small number, or a single bit that is the sign of none.
fn shifted_left(n: i64, count: i64) -> Option<i64> {
    let shifted = n.checked_mul(1 << u32::try_from(count).ok().filter(|count| *count < 32)?)?;
    let is_small = i8::try_from(shifted).is_ok();
    (is_small || n == 1 && ![7, 15, 31].contains(&count)).then_some(shifted)
}

/// Returns `true` for an operator on the bits of integers, or on two booleans.
pub(super) fn is_of_bits(operator: &BinOp) -> bool {
    use BinOp::{BitAnd, BitOr, BitXor, Shl, Shr};
    matches!(operator, BitAnd(_) | BitOr(_) | BitXor(_) | Shl(_) | Shr(_))
}

fn compare(a: &Algebra, operator: &BinOp, left: &Value, right: &Value) -> Option<Condition> {
    Some(match (left, right) {
        (Value::Scalar(x), Value::Scalar(y)) | (Value::Integer(x), Value::Integer(y)) => match operator {
            BinOp::Lt(_) => Condition::less(a, *x, *y),
            BinOp::Gt(_) => Condition::less(a, *y, *x),
            BinOp::Le(_) => Condition::at_most(a, *x, *y),
            BinOp::Ge(_) => Condition::at_most(a, *y, *x),
            BinOp::Eq(_) => Condition::equal(a, *x, *y),
            BinOp::Ne(_) => Condition::equal(a, *x, *y).not(),
            _ => return None,
        },
        (Value::Ordering(x), Value::Ordering(y)) => {
            let same = |x: &Condition, y: &Condition| x.clone().and(y.clone()).or(x.clone().not().and(y.clone().not()));
            let equal = same(&x.less, &y.less).and(same(&x.greater, &y.greater));
            match operator {
                BinOp::Eq(_) => equal,
                BinOp::Ne(_) => equal.not(),
                _ => return None,
            }
        }
        (Value::Truth(x), Value::Truth(y)) => match operator {
            BinOp::And(_) | BinOp::BitAnd(_) => x.clone().and(y.clone()),
            BinOp::Or(_) | BinOp::BitOr(_) => x.clone().or(y.clone()),
            BinOp::Ne(_) | BinOp::BitXor(_) => x.clone().and(y.clone().not()).or(x.clone().not().and(y.clone())),
            BinOp::Eq(_) => x.clone().and(y.clone()).or(x.clone().not().and(y.clone().not())),
            _ => return None,
        },
        _ => return None,
    })
}

/// Returns the trait method of an operator.
pub(super) fn method(operator: &BinOp) -> Option<&'static str> {
    Some(match operator {
        BinOp::Add(_) => "add",
        BinOp::Sub(_) => "sub",
        BinOp::Mul(_) => "mul",
        BinOp::Div(_) => "div",
        BinOp::Rem(_) => "rem",
        BinOp::BitAnd(_) => "bitand",
        BinOp::BitOr(_) => "bitor",
        BinOp::BitXor(_) => "bitxor",
        BinOp::Shl(_) => "shl",
        BinOp::Shr(_) => "shr",
        BinOp::AddAssign(_) => "add_assign",
        BinOp::SubAssign(_) => "sub_assign",
        BinOp::MulAssign(_) => "mul_assign",
        BinOp::DivAssign(_) => "div_assign",
        BinOp::RemAssign(_) => "rem_assign",
        BinOp::BitAndAssign(_) => "bitand_assign",
        BinOp::BitOrAssign(_) => "bitor_assign",
        BinOp::BitXorAssign(_) => "bitxor_assign",
        BinOp::ShlAssign(_) => "shl_assign",
        BinOp::ShrAssign(_) => "shr_assign",
        _ => return None,
    })
}

/// Returns the operator in a compound assignment.
pub(super) fn assigned(operator: &BinOp) -> Option<BinOp> {
    Some(match operator {
        BinOp::AddAssign(_) => BinOp::Add(Default::default()),
        BinOp::SubAssign(_) => BinOp::Sub(Default::default()),
        BinOp::MulAssign(_) => BinOp::Mul(Default::default()),
        BinOp::DivAssign(_) => BinOp::Div(Default::default()),
        BinOp::RemAssign(_) => BinOp::Rem(Default::default()),
        BinOp::BitAndAssign(_) => BinOp::BitAnd(Default::default()),
        BinOp::BitOrAssign(_) => BinOp::BitOr(Default::default()),
        BinOp::BitXorAssign(_) => BinOp::BitXor(Default::default()),
        BinOp::ShlAssign(_) => BinOp::Shl(Default::default()),
        BinOp::ShrAssign(_) => BinOp::Shr(Default::default()),
        _ => return None,
    })
}

/// Evaluates `−operand`.
pub(super) fn negate(a: &mut Algebra, operand: &Value) -> Option<Value> {
    Some(match operand {
        Value::Scalar(x) => Value::Scalar(a.neg(*x)),
        Value::Integer(x) => Value::Integer(a.neg(*x)),
        Value::Planar(v) => Value::Planar(a.neg_vector(*v)),
        Value::Vector(v) => Value::Vector(a.neg_vector(*v)),
        Value::Four(v) => Value::Four(v.map(|x| a.neg(x))),
        Value::Matrix(m) => Value::Matrix(m.map(a, Algebra::neg_vector)),
        Value::Square(_) | Value::Homogeneous(_) => {
            let (m, minus) = (square::columns(a, operand)?, a.number(-1.0));
            Value::Square(square::scaled(a, minus, &m))
        }
        // q and −q are the same rotation.
        Value::Quaternion(q) => {
            Value::Quaternion(Quaternion { map: q.map.clone(), parts: (a.neg_vector(q.parts.0), a.neg(q.parts.1)) })
        }
        _ => return None,
    })
}
