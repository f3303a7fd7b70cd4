//! Methods of quaternions.

use aim_symbolic::{Node, Scalar, Stumpff, Vector};

use super::function::{CallError, evaluate, functions};
use crate::differentiate::lower::algebra::Algebra;
use crate::differentiate::lower::map::{Map, Quaternion};
use crate::differentiate::lower::value::Value;

functions! {
    METHODS(a):
    mul_vec3(q: Quaternion, v: Vector) -> Vector { q.map.apply(a, v) }
    mul_vec3a(q: Quaternion, v: Vector) -> Vector { q.map.apply(a, v) }
    mul_quat(q: Quaternion, r: Quaternion) -> Quaternion { q.compose(a, &r) }
    conjugate(q: Quaternion) -> Quaternion { q.conjugate(a) }
    inverse(q: Quaternion) -> Quaternion { q.conjugate(a) }
    normalize(q: Quaternion) -> Quaternion { normalize(a, q) }
    xyz(q: Quaternion) -> Vector { q.parts.0 }
    dot(q: Quaternion, r: Quaternion) -> Scalar {
        let ((u, w), (v, x)) = (q.parts, r.parts);
        let (along, product) = (a.dot(u, v), a.mul(w, x));
        a.add(along, product)
    }
    slerp(q: Quaternion, end: Quaternion, s: Scalar) -> Quaternion { slerp(a, [&q, &end], s) }
    lerp(q: Quaternion, end: Quaternion, s: Scalar) =
        (if q.dot(end) < 0.0 { q - (end + q) * s } else { q + (end - q) * s }).normalize();
    length_squared(q: Quaternion) -> Scalar { square(a, q.parts) }
    length(q: Quaternion) -> Scalar {
        let square = square(a, q.parts);
        a.sqrt(square)
    }
    to_array(q: Quaternion) -> Array {
        let (u, w) = q.parts;
        let [x, y, z] = a.parts(u);
        [x, y, z, w].map(Value::Scalar).to_vec()
    }
    to_scaled_axis(q: Quaternion) -> Vector {
        let (u, w) = q.turning_parts(a);
        let (square, two) = (a.dot(u, u), a.number(2.0));
        let arc = a.g.arc(square, w);
        let factor = a.mul(two, arc);
        a.scale(factor, u)
    }
    angle_between(q: Quaternion, r: Quaternion) -> Scalar {
        let (u, w) = q.conjugate(a).compose(a, &r).turning_parts(a);
        let (length, two) = (a.norm(u), a.number(2.0));
        let Value::Scalar(size) = evaluate(a, "w.abs()", &["w"], &[Value::Scalar(w)]) else { return Err(CallError::Arguments) };
        let half = a.atan2(length, size);
        a.mul(two, half)
    }
    to_axis_angle(q: Quaternion) -> Tuple {
        let (u, w) = q.turning_parts(a);
        let (length, two) = (a.norm(u), a.number(2.0));
        let half = a.atan2(length, w);
        vec![Value::Vector(a.normalize(u)), Value::Scalar(a.mul(two, half))]
    }
    clone(q: Quaternion) -> Quaternion { q }
}

/// Returns the quaternion of a matrix, as glam computes it: by its largest component, for which no digits cancel.
pub(super) fn of_matrix(a: &mut Algebra, map: Map) -> Quaternion {
    // Four times the largest component, squared; and four times its products with all components.
    const BY_LARGEST: &str = "{
        let (square, products) = if z.z <= 0.0 {
            let difference = y.y - x.x;
            if difference <= 0.0 {
                let square = 1.0 - z.z - difference;
                (square, Vec4::new(square, x.y + y.x, x.z + z.x, y.z - z.y))
            } else {
                let square = 1.0 - z.z + difference;
                (square, Vec4::new(x.y + y.x, square, y.z + z.y, z.x - x.z))
            }
        } else {
            let sum = y.y + x.x;
            if sum <= 0.0 {
                let square = 1.0 + z.z - sum;
                (square, Vec4::new(x.z + z.x, y.z + z.y, square, x.y - y.x))
            } else {
                let square = 1.0 + z.z + sum;
                (square, Vec4::new(y.z - z.y, z.x - x.z, x.y - y.x, square))
            }
        };
        products * (0.5 / square.sqrt())
    }";
    let columns = map.columns(a).map(Value::Vector);
    let Value::Four([x, y, z, w]) = evaluate(a, BY_LARGEST, &["x", "y", "z"], &columns) else {
        return Quaternion::identity(a);
    };
    let parts = (a.vector([x, y, z]), w);
    let map = if map.is_rotation() { map } else { Map::Spin(parts.0, w) };
    Quaternion { map, parts }
}

fn square(a: &mut Algebra, (u, w): (Vector, Scalar)) -> Scalar {
    let (u2, w2) = (a.dot(u, u), a.mul(w, w));
    a.add(u2, w2)
}

/// Interpolates between two quaternions of length 1, along the shorter arc at constant speed: with the angle θ between
/// them, the weights are sin((1 − s) θ)/sin θ and sin(s θ)/sin θ.
fn slerp(a: &mut Algebra, ends: [&Quaternion; 2], s: Scalar) -> Quaternion {
    let [near, far] = ends.map(|end| four(a, end.parts));
    let Value::Scalar(along) = evaluate(a, "near.dot(far)", &["near", "far"], &[near.clone(), far.clone()]) else {
        return ends[0].clone();
    };
    // θ = 2 arcsin h, where h is half of the chord, so that sin θ = 2 h √(1 − h²).
    let Value::Scalar(h2) = evaluate(a, "0.5 * (1.0 - along.abs())", &["along"], &[Value::Scalar(along)]) else {
        return ends[0].clone();
    };
    let one = a.number(1.0);
    let rest = a.sub(one, h2);
    let cos = a.sqrt(rest);
    let half = a.g.arc(h2, cos);
    let two = a.number(2.0);
    let ratio = a.mul(two, half);
    let r2 = a.mul(ratio, ratio);
    let angle2 = a.mul(r2, h2);
    let scale = a.div(half, cos);
    let before = a.sub(one, s);
    let [from, to] = [before, s].map(|s| {
        let s2 = a.mul(s, s);
        let square = a.mul(s2, angle2);
        let sine = a.g.stumpff(Stumpff { hyperbolic: false, order: 1 }, square);
        let product = a.mul(s, sine);
        Value::Scalar(a.mul(scale, product))
    });
    let names = ["near", "far", "from", "to", "along"];
    let values = [near, far, from, to, Value::Scalar(along)];
    let Value::Four([x, y, z, w]) =
        evaluate(a, "near * from + far * if along < 0.0 { -to } else { to }", &names, &values)
    else {
        return ends[0].clone();
    };
    let u = a.vector([x, y, z]);
    let varies = a.varies(Node::Vector(u)) || a.varies(Node::Scalar(w));
    if varies { Quaternion::from_parts(u, w) } else { Quaternion::unit(a, u, w) }
}

fn four(a: &mut Algebra, (u, w): (Vector, Scalar)) -> Value {
    let [x, y, z] = a.parts(u);
    Value::Four([x, y, z, w])
}

fn normalize(a: &mut Algebra, q: Quaternion) -> Quaternion {
    if q.map.is_rotation() {
        return q;
    }
    let (u, w) = q.parts;
    let square = square(a, (u, w));
    let length = a.sqrt(square);
    let reciprocal = a.recip(length);
    if a.varies(Node::Vector(u)) || a.varies(Node::Scalar(w)) {
        return Quaternion::normalized(a, (u, w), reciprocal);
    }
    let (u, w) = (a.scale(reciprocal, u), a.mul(reciprocal, w));
    Quaternion::unit(a, u, w)
}
