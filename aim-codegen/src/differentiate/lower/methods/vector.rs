//! Methods of vectors.

use aim_symbolic::{Scalar, Vector};

use super::formula::formulas;
use super::function::functions;
use crate::differentiate::lower::algebra::Algebra;
use crate::differentiate::lower::map::Map;
use crate::differentiate::lower::value::Value;

functions! {
    /// Of vectors of two and of three, as long as a third component of 0 stays 0.
    EITHER(a):
    dot(v: Vector, w: Vector) -> Scalar { a.dot(v, w) }
    length(v: Vector) -> Scalar { a.norm(v) }
    length_squared(v: Vector) -> Scalar { a.dot(v, v) }
    normalize(v: Vector) -> Vector { a.normalize(v) }
    normalize_or_zero(v: Vector) -> Vector { a.normalize(v) }
    abs(v: Vector) -> Vector { a.map(v, Algebra::abs) }
    min(v: Vector, w: Vector) -> Vector { a.zip(v, w, Algebra::min) }
    max(v: Vector, w: Vector) -> Vector { a.zip(v, w, Algebra::max) }
    clone(v: Vector) -> Vector { v }
}

formulas! {
    /// The same, in the language of the functions themselves.
    EITHER_FORMULAS:
    length_recip(v: Vector) = v.length().recip();
    distance(v: Vector, w: Vector) = (v - w).length();
    distance_squared(v: Vector, w: Vector) = (v - w).length_squared();
    lerp(v: Vector, w: Vector, k: Scalar) = v + (w - v) * k;
    midpoint(v: Vector, w: Vector) = (v + w) * 0.5;
    project_onto(v: Vector, w: Vector) = w * (v.dot(w) * w.dot(w).recip());
    project_onto_normalized(v: Vector, w: Vector) = w * v.dot(w);
    reject_from(v: Vector, w: Vector) = v - v.project_onto(w);
    reject_from_normalized(v: Vector, w: Vector) = v - v.project_onto_normalized(w);
    reflect(v: Vector, normal: Vector) = v - normal * (2.0 * v.dot(normal));
    mul_add(v: Vector, factor: Vector, summand: Vector) = v * factor + summand;
    // The quotient is kept within ±1.
    angle_between(v: Vector, w: Vector) = (v.dot(w) / (v.dot(v) * w.dot(w)).sqrt()).clamp(-1.0, 1.0).acos();
    clamp(v: Vector, low: Vector, high: Vector) = v.max(low).min(high);
    element_sum(v: Vector) = v.x + v.y + v.z;
}

functions! {
    /// Of vectors of three.
    METHODS(a):
    cross(v: Vector, w: Vector) -> Vector { a.cross(v, w) }
    recip(v: Vector) -> Vector { a.map(v, Algebra::recip) }
    signum(v: Vector) -> Vector { a.map(v, Algebra::signum) }
    rotate_x(v: Vector, radians: Scalar) -> Vector { Map::turn(a, 0, radians).apply(a, v) }
    rotate_y(v: Vector, radians: Scalar) -> Vector { Map::turn(a, 1, radians).apply(a, v) }
    rotate_z(v: Vector, radians: Scalar) -> Vector { Map::turn(a, 2, radians).apply(a, v) }
    with_x(v: Vector, c: Scalar) -> Vector { with(a, v, 0, c) }
    with_y(v: Vector, c: Scalar) -> Vector { with(a, v, 1, c) }
    with_z(v: Vector, c: Scalar) -> Vector { with(a, v, 2, c) }
    to_vec3a(v: Vector) -> Vector { v }
    to_vec3(v: Vector) -> Vector { v }
    to_array(v: Vector) -> Array { a.parts(v).map(Value::Scalar).to_vec() }
}

formulas! {
    /// Of vectors of three, in the language of the functions themselves.
    FORMULAS:
    min_element(v: Vector) = v.x.min(v.y).min(v.z);
    max_element(v: Vector) = v.x.max(v.y).max(v.z);
    element_product(v: Vector) = v.x * v.y * v.z;
    truncate(v: Vector) = Vec2::new(v.x, v.y);
}

functions! {
    /// Of vectors of two.
    PLANAR(a):
    with_x(v: Planar, c: Scalar) -> Planar { with(a, v, 0, c) }
    with_y(v: Planar, c: Scalar) -> Planar { with(a, v, 1, c) }
    extend(v: Planar, z: Scalar) -> Vector { with(a, v, 2, z) }
    to_array(v: Planar) -> Array {
        let [x, y, _] = a.parts(v);
        vec![Value::Scalar(x), Value::Scalar(y)]
    }
}

formulas! {
    /// Of vectors of two, in the language of the functions themselves.
    PLANAR_FORMULAS:
    perp(v: Planar) = Vec2::new(-v.y, v.x);
    perp_dot(v: Planar, w: Planar) = v.extend(0.0).cross(w.extend(0.0)).z;
    min_element(v: Planar) = v.x.min(v.y);
    max_element(v: Planar) = v.x.max(v.y);
}

fn with(a: &mut Algebra, v: Vector, axis: usize, component: Scalar) -> Vector {
    let mut parts = a.parts(v);
    parts[axis] = component;
    a.vector(parts)
}
