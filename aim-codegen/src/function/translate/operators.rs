//! Operators: what each makes of two values, as glam and the language define it.

use syn::BinOp;

use super::algebra::Algebra;
use super::map::{Affine, Quaternion};
use super::value::{Condition, Value};

/// The value of `left operator right`; `None` where there is no such operation.
pub(super) fn binary(a: &mut Algebra, operator: &BinOp, left: &Value, right: &Value) -> Option<Value> {
    match operator {
        BinOp::Add(_) => add(a, left, right),
        BinOp::Sub(_) => subtract(a, left, right),
        BinOp::Mul(_) => multiply(a, left, right),
        BinOp::Div(_) => divide(a, left, right),
        _ => compare(operator, left, right).map(Value::Truth),
    }
}

fn add(a: &mut Algebra, left: &Value, right: &Value) -> Option<Value> {
    Some(match (left, right) {
        (Value::Scalar(x), Value::Scalar(y)) => Value::Scalar(a.add(*x, *y)),
        (Value::Planar(v), Value::Planar(w)) => Value::Planar(a.add_vectors(*v, *w)),
        (Value::Vector(v), Value::Vector(w)) => Value::Vector(a.add_vectors(*v, *w)),
        (Value::Vector(v), Value::Scalar(x)) => {
            let w = a.vector([*x; 3]);
            Value::Vector(a.add_vectors(*v, w))
        }
        (Value::Scalar(x), Value::Vector(w)) => {
            let v = a.vector([*x; 3]);
            Value::Vector(a.add_vectors(v, *w))
        }
        (Value::Matrix(m), Value::Matrix(n)) => Value::Matrix(m.zip(a, n, Algebra::add_vectors)),
        (Value::Quaternion(q), Value::Quaternion(r)) => {
            let ((u, w), (v, x)) = q.parts.zip(r.parts)?;
            Value::Quaternion(Quaternion::of(a.add_vectors(u, v), a.add(w, x)))
        }
        _ => return None,
    })
}

fn subtract(a: &mut Algebra, left: &Value, right: &Value) -> Option<Value> {
    Some(match (left, right) {
        (Value::Scalar(x), Value::Scalar(y)) => Value::Scalar(a.sub(*x, *y)),
        (Value::Planar(v), Value::Planar(w)) => Value::Planar(a.sub_vectors(*v, *w)),
        (Value::Vector(v), Value::Vector(w)) => Value::Vector(a.sub_vectors(*v, *w)),
        (Value::Vector(v), Value::Scalar(x)) => {
            let w = a.vector([*x; 3]);
            Value::Vector(a.sub_vectors(*v, w))
        }
        (Value::Scalar(x), Value::Vector(w)) => {
            let v = a.vector([*x; 3]);
            Value::Vector(a.sub_vectors(v, *w))
        }
        (Value::Matrix(m), Value::Matrix(n)) => Value::Matrix(m.zip(a, n, Algebra::sub_vectors)),
        (Value::Quaternion(q), Value::Quaternion(r)) => {
            let ((u, w), (v, x)) = q.parts.zip(r.parts)?;
            Value::Quaternion(Quaternion::of(a.sub_vectors(u, v), a.sub(w, x)))
        }
        _ => return None,
    })
}

fn multiply(a: &mut Algebra, left: &Value, right: &Value) -> Option<Value> {
    Some(match (left, right) {
        (Value::Scalar(x), Value::Scalar(y)) => Value::Scalar(a.mul(*x, *y)),
        (Value::Scalar(k), Value::Planar(v)) | (Value::Planar(v), Value::Scalar(k)) => Value::Planar(a.scale(*k, *v)),
        (Value::Scalar(k), Value::Vector(v)) | (Value::Vector(v), Value::Scalar(k)) => Value::Vector(a.scale(*k, *v)),
        (Value::Planar(v), Value::Planar(w)) => Value::Planar(a.zip(*v, *w, Algebra::mul)),
        (Value::Vector(v), Value::Vector(w)) => Value::Vector(a.zip(*v, *w, Algebra::mul)),
        (Value::Quaternion(q), Value::Vector(v)) => Value::Vector(q.map.apply(a, *v)),
        (Value::Quaternion(q), Value::Quaternion(r)) => Value::Quaternion(q.compose(a, r)),
        (Value::Quaternion(q), Value::Scalar(k)) => {
            let (u, w) = q.parts?;
            Value::Quaternion(Quaternion::of(a.scale(*k, u), a.mul(*k, w)))
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
    Some(match (left, right) {
        (Value::Scalar(x), Value::Scalar(y)) => Value::Scalar(a.div(*x, *y)),
        (Value::Planar(v), Value::Scalar(k)) => {
            let k = a.recip(*k);
            Value::Planar(a.scale(k, *v))
        }
        (Value::Vector(v), Value::Scalar(k)) => {
            let k = a.recip(*k);
            Value::Vector(a.scale(k, *v))
        }
        (Value::Vector(v), Value::Vector(w)) => Value::Vector(a.zip(*v, *w, Algebra::div)),
        (Value::Matrix(m), Value::Scalar(k)) => {
            let k = a.recip(*k);
            Value::Matrix(m.map(a, |a, column| a.scale(k, column)))
        }
        (Value::Quaternion(q), Value::Scalar(k)) => {
            let ((u, w), k) = (q.parts?, a.recip(*k));
            Value::Quaternion(Quaternion::of(a.scale(k, u), a.mul(k, w)))
        }
        _ => return None,
    })
}

fn compare(operator: &BinOp, left: &Value, right: &Value) -> Option<Condition> {
    use std::rc::Rc;
    Some(match (left, right) {
        (Value::Scalar(x), Value::Scalar(y)) => match operator {
            BinOp::Lt(_) => Condition::Less(*x, *y),
            BinOp::Gt(_) => Condition::Less(*y, *x),
            BinOp::Le(_) => Condition::at_most(*x, *y),
            BinOp::Ge(_) => Condition::at_most(*y, *x),
            BinOp::Eq(_) => Condition::equal(*x, *y),
            BinOp::Ne(_) => Condition::equal(*x, *y).not(),
            _ => return None,
        },
        (Value::Truth(x), Value::Truth(y)) => match operator {
            BinOp::And(_) | BinOp::BitAnd(_) => Condition::And(Rc::new((x.clone(), y.clone()))),
            BinOp::Or(_) | BinOp::BitOr(_) => Condition::Or(Rc::new((x.clone(), y.clone()))),
            _ => return None,
        },
        _ => return None,
    })
}

/// The value of `−operand`.
pub(super) fn negate(a: &mut Algebra, operand: &Value) -> Option<Value> {
    Some(match operand {
        Value::Scalar(x) => Value::Scalar(a.neg(*x)),
        Value::Planar(v) => Value::Planar(a.neg_vector(*v)),
        Value::Vector(v) => Value::Vector(a.neg_vector(*v)),
        Value::Matrix(m) => Value::Matrix(m.map(a, Algebra::neg_vector)),
        // Both turn the same way.
        Value::Quaternion(q) => Value::Quaternion(Quaternion {
            map: q.map.clone(),
            parts: q.parts.map(|(u, w)| (a.neg_vector(u), a.neg(w))),
        }),
        _ => return None,
    })
}
