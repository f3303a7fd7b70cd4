//! Methods of quaternions.

use aim_symbolic::{Node, Scalar, Vector};

use super::function::functions;
use crate::declare::report::text::Text;
use crate::differentiate::lower::algebra::Algebra;
use crate::differentiate::lower::map::Quaternion;
use crate::differentiate::lower::value::Value;
use crate::differentiate::messages;

functions! {
    METHODS(a):
    mul_vec3(q: Quaternion, v: Vector) -> Vector { q.map.apply(a, v) }
    mul_vec3a(q: Quaternion, v: Vector) -> Vector { q.map.apply(a, v) }
    mul_quat(q: Quaternion, r: Quaternion) -> Quaternion { q.compose(a, &r) }
    conjugate(q: Quaternion) -> Quaternion { q.conjugate(a) }
    inverse(q: Quaternion) -> Quaternion { q.conjugate(a) }
    normalize(q: Quaternion) -> Quaternion { normalize(a, &q)? }
    xyz(q: Quaternion) -> Vector { parts(&q)?.0 }
    dot(q: Quaternion, r: Quaternion) -> Scalar {
        let ((u, w), (v, x)) = (parts(&q)?, parts(&r)?);
        let (along, product) = (a.dot(u, v), a.mul(w, x));
        a.add(along, product)
    }
    length_squared(q: Quaternion) -> Scalar { square(a, parts(&q)?) }
    length(q: Quaternion) -> Scalar {
        let square = square(a, parts(&q)?);
        a.sqrt(square)
    }
    to_array(q: Quaternion) -> Array {
        let (u, w) = parts(&q)?;
        let [x, y, z] = a.parts(u);
        [x, y, z, w].map(Value::Scalar).to_vec()
    }
    clone(q: Quaternion) -> Quaternion { q }
}

/// The numbers of a quaternion.
pub(in crate::differentiate::lower) fn parts(q: &Quaternion) -> Result<(Vector, Scalar), Text> {
    q.parts.ok_or_else(messages::quaternion_of_matrix)
}

fn square(a: &mut Algebra, (u, w): (Vector, Scalar)) -> Scalar {
    let (u2, w2) = (a.dot(u, u), a.mul(w, w));
    a.add(u2, w2)
}

fn normalize(a: &mut Algebra, q: &Quaternion) -> Result<Quaternion, Text> {
    if q.map.is_rotation() {
        return Ok(q.clone());
    }
    let (u, w) = parts(q)?;
    let square = square(a, (u, w));
    let length = a.sqrt(square);
    let reciprocal = a.recip(length);
    let varies = a.varies(Node::Vector(u)) || a.varies(Node::Scalar(w));
    let (u, w) = (a.scale(reciprocal, u), a.mul(reciprocal, w));
    Ok(if varies { Quaternion::from_parts(u, w) } else { Quaternion::unit(a, u, w) })
}
