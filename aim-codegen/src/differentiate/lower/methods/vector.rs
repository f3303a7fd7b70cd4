//! Methods of vectors.

use aim_symbolic::{Function, Scalar, Vector};

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
    length_recip(v: Vector) -> Scalar {
        let length = a.norm(v);
        a.recip(length)
    }
    distance(v: Vector, w: Vector) -> Scalar {
        let between = a.sub_vectors(v, w);
        a.norm(between)
    }
    distance_squared(v: Vector, w: Vector) -> Scalar {
        let between = a.sub_vectors(v, w);
        a.dot(between, between)
    }
    normalize(v: Vector) -> Vector { a.normalize(v) }
    normalize_or_zero(v: Vector) -> Vector { a.normalize(v) }
    lerp(v: Vector, w: Vector, k: Scalar) -> Vector {
        let between = a.sub_vectors(w, v);
        let way = a.scale(k, between);
        a.add_vectors(v, way)
    }
    midpoint(v: Vector, w: Vector) -> Vector {
        let (sum, half) = (a.add_vectors(v, w), a.number(0.5));
        a.scale(half, sum)
    }
    project_onto(v: Vector, w: Vector) -> Vector { project(a, v, w) }
    project_onto_normalized(v: Vector, w: Vector) -> Vector {
        let along = a.dot(v, w);
        a.scale(along, w)
    }
    reject_from(v: Vector, w: Vector) -> Vector {
        let along = project(a, v, w);
        a.sub_vectors(v, along)
    }
    reject_from_normalized(v: Vector, w: Vector) -> Vector {
        let along = a.dot(v, w);
        let along = a.scale(along, w);
        a.sub_vectors(v, along)
    }
    reflect(v: Vector, normal: Vector) -> Vector {
        let (two, along) = (a.number(2.0), a.dot(v, normal));
        let twice = a.mul(two, along);
        let twice = a.scale(twice, normal);
        a.sub_vectors(v, twice)
    }
    mul_add(v: Vector, factor: Vector, summand: Vector) -> Vector {
        let product = a.zip(v, factor, Algebra::mul);
        a.add_vectors(product, summand)
    }
    angle_between(v: Vector, w: Vector) -> Scalar { angle_between(a, v, w) }
    abs(v: Vector) -> Vector { a.map(v, Algebra::abs) }
    min(v: Vector, w: Vector) -> Vector { a.zip(v, w, Algebra::min) }
    max(v: Vector, w: Vector) -> Vector { a.zip(v, w, Algebra::max) }
    clamp(v: Vector, low: Vector, high: Vector) -> Vector {
        let v = a.zip(v, low, Algebra::max);
        a.zip(v, high, Algebra::min)
    }
    element_sum(v: Vector) -> Scalar {
        let [x, y, z] = a.parts(v);
        let sum = a.add(x, y);
        a.add(sum, z)
    }
    clone(v: Vector) -> Vector { v }
}

functions! {
    /// Of vectors of three.
    METHODS(a):
    cross(v: Vector, w: Vector) -> Vector { a.cross(v, w) }
    recip(v: Vector) -> Vector { a.map(v, Algebra::recip) }
    signum(v: Vector) -> Vector { a.map(v, Algebra::signum) }
    min_element(v: Vector) -> Scalar {
        let [x, y, z] = a.parts(v);
        let least = a.min(x, y);
        a.min(least, z)
    }
    max_element(v: Vector) -> Scalar {
        let [x, y, z] = a.parts(v);
        let most = a.max(x, y);
        a.max(most, z)
    }
    element_product(v: Vector) -> Scalar {
        let [x, y, z] = a.parts(v);
        let product = a.mul(x, y);
        a.mul(product, z)
    }
    rotate_x(v: Vector, radians: Scalar) -> Vector { Map::turn(a, 0, radians).apply(a, v) }
    rotate_y(v: Vector, radians: Scalar) -> Vector { Map::turn(a, 1, radians).apply(a, v) }
    rotate_z(v: Vector, radians: Scalar) -> Vector { Map::turn(a, 2, radians).apply(a, v) }
    with_x(v: Vector, c: Scalar) -> Vector { with(a, v, 0, c) }
    with_y(v: Vector, c: Scalar) -> Vector { with(a, v, 1, c) }
    with_z(v: Vector, c: Scalar) -> Vector { with(a, v, 2, c) }
    truncate(v: Vector) -> Planar {
        let zero = a.number(0.0);
        with(a, v, 2, zero)
    }
    to_vec3a(v: Vector) -> Vector { v }
    to_vec3(v: Vector) -> Vector { v }
    to_array(v: Vector) -> Array { a.parts(v).map(Value::Scalar).to_vec() }
}

functions! {
    /// Of vectors of two.
    PLANAR(a):
    perp(v: Planar) -> Planar {
        let [x, y, zero] = a.parts(v);
        let minus = a.neg(y);
        a.vector([minus, x, zero])
    }
    perp_dot(v: Planar, w: Planar) -> Scalar {
        let normal = a.cross(v, w);
        a.component(normal, 2)
    }
    min_element(v: Planar) -> Scalar {
        let [x, y, _] = a.parts(v);
        a.min(x, y)
    }
    max_element(v: Planar) -> Scalar {
        let [x, y, _] = a.parts(v);
        a.max(x, y)
    }
    with_x(v: Planar, c: Scalar) -> Planar { with(a, v, 0, c) }
    with_y(v: Planar, c: Scalar) -> Planar { with(a, v, 1, c) }
    extend(v: Planar, z: Scalar) -> Vector { with(a, v, 2, z) }
    to_array(v: Planar) -> Array {
        let [x, y, _] = a.parts(v);
        vec![Value::Scalar(x), Value::Scalar(y)]
    }
}

/// w (v · w) / (w · w)
fn project(a: &mut Algebra, v: Vector, w: Vector) -> Vector {
    let (along, square) = (a.dot(v, w), a.dot(w, w));
    let reciprocal = a.recip(square);
    let along = a.mul(along, reciprocal);
    a.scale(along, w)
}

/// acos (v · w / √(v² w²)), the quotient kept within ±1.
fn angle_between(a: &mut Algebra, v: Vector, w: Vector) -> Scalar {
    let (along, v2, w2) = (a.dot(v, w), a.dot(v, v), a.dot(w, w));
    let square = a.mul(v2, w2);
    let root = a.sqrt(square);
    let cosine = a.div(along, root);
    let [low, high] = [-1.0, 1.0].map(|c| a.number(c));
    let cosine = a.clamp(cosine, low, high);
    a.call(Function::Acos, cosine)
}

fn with(a: &mut Algebra, v: Vector, axis: usize, component: Scalar) -> Vector {
    let mut parts = a.parts(v);
    parts[axis] = component;
    a.vector(parts)
}
