//! Methods of vectors.

use std::rc::Rc;

use aim_symbolic::Scalar;

use super::function::{CallError, evaluate, functions};
use crate::differentiate::lower::algebra::Algebra;
use crate::differentiate::lower::condition::Condition;
use crate::differentiate::lower::value::{MASK, Struct, Value};
use crate::differentiate::messages;

functions! {
    /// Functions of vectors of two and of three: a third component of 0 stays 0.
    EITHER(a):
    dot(v: Vector, w: Vector) -> Scalar { a.dot(v, w) }
    length(v: Vector) -> Scalar { a.norm(v) }
    length_squared(v: Vector) -> Scalar { a.dot(v, v) }
    length_recip(v: Vector) = v.length().recip();
    distance(v: Vector, w: Vector) = (v - w).length();
    distance_squared(v: Vector, w: Vector) = (v - w).length_squared();
    normalize(v: Vector) -> Vector { a.normalize(v) }
    normalize_or_zero(v: Vector) -> Vector { a.normalize(v) }
    lerp(v: Vector, w: Vector, k: Scalar) = v + (w - v) * k;
    midpoint(v: Vector, w: Vector) = (v + w) * 0.5;
    project_onto(v: Vector, w: Vector) = w * (v.dot(w) * w.dot(w).recip());
    project_onto_normalized(v: Vector, w: Vector) = w * v.dot(w);
    reject_from(v: Vector, w: Vector) = v - v.project_onto(w);
    reject_from_normalized(v: Vector, w: Vector) = v - v.project_onto_normalized(w);
    reflect(v: Vector, normal: Vector) = v - normal * (2.0 * v.dot(normal));
    mul_add(v: Vector, factor: Vector, summand: Vector) = v * factor + summand;
    angle_between(v: Vector, w: Vector) -> Scalar {
        let (cross, dot) = (a.cross(v, w), a.dot(v, w));
        let sine = a.norm(cross);
        a.atan2(sine, dot)
    }
    abs(v: Vector) = Vec3::new(v.x.abs(), v.y.abs(), v.z.abs());
    min(v: Vector, w: Vector) = Vec3::new(v.x.min(w.x), v.y.min(w.y), v.z.min(w.z));
    max(v: Vector, w: Vector) = Vec3::new(v.x.max(w.x), v.y.max(w.y), v.z.max(w.z));
    floor(v: Vector) = Vec3::new(v.x.floor(), v.y.floor(), v.z.floor());
    ceil(v: Vector) = Vec3::new(v.x.ceil(), v.y.ceil(), v.z.ceil());
    round(v: Vector) = Vec3::new(v.x.round(), v.y.round(), v.z.round());
    trunc(v: Vector) = Vec3::new(v.x.trunc(), v.y.trunc(), v.z.trunc());
    fract(v: Vector) = v - v.trunc();
    clamp(v: Vector, low: Vector, high: Vector) = v.max(low).min(high);
    saturate(v: Vector) = Vec3::new(v.x.clamp(0.0, 1.0), v.y.clamp(0.0, 1.0), v.z.clamp(0.0, 1.0));
    try_normalize(v: Vector) = if v.length_squared() > 0.0 { Some(v.normalize()) } else { None };
    normalize_or(v: Vector, otherwise: Vector) = if v.length_squared() > 0.0 { v.normalize() } else { otherwise };
    refract(v: Vector, normal: Vector, eta: Scalar) = if 1.0 - eta * eta * (1.0 - normal.dot(v).powi(2)) >= 0.0 {
        eta * v - (eta * normal.dot(v) + (1.0 - eta * eta * (1.0 - normal.dot(v).powi(2))).sqrt()) * normal
    } else {
        0.0 * v
    };
    move_towards(v: Vector, w: Vector, most: Scalar) =
        if (w - v).length() <= most { w } else { v + most * (w - v).normalize() };
    clamp_length(v: Vector, least: Scalar, most: Scalar) = v.clamp_length_min(least).clamp_length_max(most);
    clamp_length_min(v: Vector, least: Scalar) =
        if v.length_squared() < least * least { least * v.normalize() } else { v };
    clamp_length_max(v: Vector, most: Scalar) =
        if v.length_squared() > most * most { most * v.normalize() } else { v };
    element_sum(v: Vector) = v.x + v.y + v.z;
    clone(v: Vector) -> Vector { v }
}

functions! {
    /// Functions of vectors of three.
    METHODS(a):
    cross(v: Vector, w: Vector) -> Vector { a.cross(v, w) }
    normalize_and_length(v: Vector) = (v.normalize_or(Vec3::X), v.length());
    step(edge: Vector, v: Vector) = Vec3::new(
        if v.x < edge.x { 0.0 } else { 1.0 },
        if v.y < edge.y { 0.0 } else { 1.0 },
        if v.z < edge.z { 0.0 } else { 1.0 },
    );
    any_orthogonal_vector(v: Vector) =
        if v.x.abs() > v.y.abs() { Vec3::new(-v.z, 0.0, v.x) } else { Vec3::new(0.0, v.z, -v.y) };
    any_orthonormal_vector(v: Vector) = {
        let sign = v.z.signum();
        let a = -1.0 / (sign + v.z);
        Vec3::new(v.x * v.y * a, sign + v.y * v.y * a, -v.y)
    };
    any_orthonormal_pair(v: Vector) = {
        let sign = v.z.signum();
        let a = -1.0 / (sign + v.z);
        let one = Vec3::new(1.0 + sign * v.x * v.x * a, sign * v.x * v.y * a, -sign * v.x);
        (one, v.any_orthonormal_vector())
    };
    rotate_axis(v: Vector, axis: Vector, radians: Scalar) = Quat::from_axis_angle(axis, radians) * v;
    recip(v: Vector) = Vec3::new(v.x.recip(), v.y.recip(), v.z.recip());
    signum(v: Vector) = Vec3::new(v.x.signum(), v.y.signum(), v.z.signum());
    exp(v: Vector) = Vec3::new(v.x.exp(), v.y.exp(), v.z.exp());
    exp2(v: Vector) = Vec3::new(v.x.exp2(), v.y.exp2(), v.z.exp2());
    ln(v: Vector) = Vec3::new(v.x.ln(), v.y.ln(), v.z.ln());
    log2(v: Vector) = Vec3::new(v.x.log2(), v.y.log2(), v.z.log2());
    sqrt(v: Vector) = Vec3::new(v.x.sqrt(), v.y.sqrt(), v.z.sqrt());
    sin(v: Vector) = Vec3::new(v.x.sin(), v.y.sin(), v.z.sin());
    cos(v: Vector) = Vec3::new(v.x.cos(), v.y.cos(), v.z.cos());
    sin_cos(v: Vector) = (v.sin(), v.cos());
    powf(v: Vector, n: Scalar) = Vec3::new(v.x.powf(n), v.y.powf(n), v.z.powf(n));
    copysign(v: Vector, w: Vector) = Vec3::new(v.x.copysign(w.x), v.y.copysign(w.y), v.z.copysign(w.z));
    rem_euclid(v: Vector, w: Vector) = Vec3::new(v.x.rem_euclid(w.x), v.y.rem_euclid(w.y), v.z.rem_euclid(w.z));
    min_element(v: Vector) = v.x.min(v.y).min(v.z);
    max_element(v: Vector) = v.x.max(v.y).max(v.z);
    element_product(v: Vector) = v.x * v.y * v.z;
    rotate_x(v: Vector, radians: Scalar) = Mat3::from_rotation_x(radians) * v;
    rotate_y(v: Vector, radians: Scalar) = Mat3::from_rotation_y(radians) * v;
    rotate_z(v: Vector, radians: Scalar) = Mat3::from_rotation_z(radians) * v;
    with_x(v: Vector, c: Scalar) = Vec3::new(c, v.y, v.z);
    with_y(v: Vector, c: Scalar) = Vec3::new(v.x, c, v.z);
    with_z(v: Vector, c: Scalar) = Vec3::new(v.x, v.y, c);
    truncate(v: Vector) = Vec2::new(v.x, v.y);
    extend(v: Vector, w: Scalar) = Vec4::new(v.x, v.y, v.z, w);
    to_vec3a(v: Vector) -> Vector { v }
    to_vec3(v: Vector) -> Vector { v }
    into(v: Vector) -> Vector { v }
    to_array(v: Vector) -> Array { a.parts(v).map(Value::Scalar).to_vec() }
    cmplt(v: Vector, w: Vector) -> Struct { compared(a, &Value::Vector(v), &Value::Vector(w), "<")? }
    cmple(v: Vector, w: Vector) -> Struct { compared(a, &Value::Vector(v), &Value::Vector(w), "<=")? }
    cmpgt(v: Vector, w: Vector) -> Struct { compared(a, &Value::Vector(v), &Value::Vector(w), ">")? }
    cmpge(v: Vector, w: Vector) -> Struct { compared(a, &Value::Vector(v), &Value::Vector(w), ">=")? }
    cmpeq(v: Vector, w: Vector) -> Struct { compared(a, &Value::Vector(v), &Value::Vector(w), "==")? }
    cmpne(v: Vector, w: Vector) -> Struct { compared(a, &Value::Vector(v), &Value::Vector(w), "!=")? }
    select(mask: Struct, v: Vector, w: Vector) -> Vector {
        let [x, y, z] = selected(a, &mask, &Value::Vector(v), &Value::Vector(w))?;
        a.vector([x, y, z])
    }
}

functions! {
    /// Functions of vectors of two.
    PLANAR(a):
    perp(v: Planar) = Vec2::new(-v.y, v.x);
    normalize_and_length(v: Planar) = (v.normalize_or(Vec2::X), v.length());
    step(edge: Planar, v: Planar) =
        Vec2::new(if v.x < edge.x { 0.0 } else { 1.0 }, if v.y < edge.y { 0.0 } else { 1.0 });
    perp_dot(v: Planar, w: Planar) = v.extend(0.0).cross(w.extend(0.0)).z;
    rotate(v: Planar, w: Planar) = Vec2::new(v.x * w.x - v.y * w.y, v.y * w.x + v.x * w.y);
    recip(v: Planar) = Vec2::new(v.x.recip(), v.y.recip());
    signum(v: Planar) = Vec2::new(v.x.signum(), v.y.signum());
    exp(v: Planar) = Vec2::new(v.x.exp(), v.y.exp());
    exp2(v: Planar) = Vec2::new(v.x.exp2(), v.y.exp2());
    ln(v: Planar) = Vec2::new(v.x.ln(), v.y.ln());
    log2(v: Planar) = Vec2::new(v.x.log2(), v.y.log2());
    sqrt(v: Planar) = Vec2::new(v.x.sqrt(), v.y.sqrt());
    sin(v: Planar) = Vec2::new(v.x.sin(), v.y.sin());
    cos(v: Planar) = Vec2::new(v.x.cos(), v.y.cos());
    sin_cos(v: Planar) = (v.sin(), v.cos());
    powf(v: Planar, n: Scalar) = Vec2::new(v.x.powf(n), v.y.powf(n));
    copysign(v: Planar, w: Planar) = Vec2::new(v.x.copysign(w.x), v.y.copysign(w.y));
    rem_euclid(v: Planar, w: Planar) = Vec2::new(v.x.rem_euclid(w.x), v.y.rem_euclid(w.y));
    element_product(v: Planar) = v.x * v.y;
    into(v: Planar) -> Planar { v }
    to_angle(v: Planar) = v.y.atan2(v.x);
    angle_to(v: Planar, w: Planar) = v.perp_dot(w).atan2(v.dot(w));
    min_element(v: Planar) = v.x.min(v.y);
    max_element(v: Planar) = v.x.max(v.y);
    with_x(v: Planar, c: Scalar) = Vec2::new(c, v.y);
    with_y(v: Planar, c: Scalar) = Vec2::new(v.x, c);
    extend(v: Planar, z: Scalar) = Vec3::new(v.x, v.y, z);
    to_array(v: Planar) -> Array {
        let [x, y, _] = a.parts(v);
        vec![Value::Scalar(x), Value::Scalar(y)]
    }
    cmplt(v: Planar, w: Planar) -> Struct { compared(a, &Value::Planar(v), &Value::Planar(w), "<")? }
    cmple(v: Planar, w: Planar) -> Struct { compared(a, &Value::Planar(v), &Value::Planar(w), "<=")? }
    cmpgt(v: Planar, w: Planar) -> Struct { compared(a, &Value::Planar(v), &Value::Planar(w), ">")? }
    cmpge(v: Planar, w: Planar) -> Struct { compared(a, &Value::Planar(v), &Value::Planar(w), ">=")? }
    cmpeq(v: Planar, w: Planar) -> Struct { compared(a, &Value::Planar(v), &Value::Planar(w), "==")? }
    cmpne(v: Planar, w: Planar) -> Struct { compared(a, &Value::Planar(v), &Value::Planar(w), "!=")? }
    select(mask: Struct, v: Planar, w: Planar) -> Planar {
        let [x, y] = selected(a, &mask, &Value::Planar(v), &Value::Planar(w))?;
        let zero = a.number(0.0);
        a.vector([x, y, zero])
    }
}

functions! {
    /// Functions of vectors of four.
    FOUR(a):
    dot(v: Four, w: Four) = v.x * w.x + v.y * w.y + v.z * w.z + v.w * w.w;
    length_squared(v: Four) = v.dot(v);
    length(v: Four) = v.dot(v).sqrt();
    length_recip(v: Four) = v.length().recip();
    distance(v: Four, w: Four) = (v - w).length();
    distance_squared(v: Four, w: Four) = (v - w).length_squared();
    normalize(v: Four) = v * v.length().recip();
    midpoint(v: Four, w: Four) = (v + w) * 0.5;
    min_element(v: Four) = v.x.min(v.y).min(v.z.min(v.w));
    max_element(v: Four) = v.x.max(v.y).max(v.z.max(v.w));
    element_product(v: Four) = v.x * v.y * (v.z * v.w);
    project_onto(v: Four, w: Four) = w * (v.dot(w) * w.dot(w).recip());
    reject_from(v: Four, w: Four) = v - v.project_onto(w);
    lerp(v: Four, w: Four, k: Scalar) = v + (w - v) * k;
    abs(v: Four) = Vec4::new(v.x.abs(), v.y.abs(), v.z.abs(), v.w.abs());
    min(v: Four, w: Four) = Vec4::new(v.x.min(w.x), v.y.min(w.y), v.z.min(w.z), v.w.min(w.w));
    max(v: Four, w: Four) = Vec4::new(v.x.max(w.x), v.y.max(w.y), v.z.max(w.z), v.w.max(w.w));
    clamp(v: Four, low: Four, high: Four) = v.max(low).min(high);
    element_sum(v: Four) = v.x + v.y + v.z + v.w;
    truncate(v: Four) = Vec3::new(v.x, v.y, v.z);
    to_array(v: Four) -> Array { v.map(Value::Scalar).to_vec() }
    into(v: Four) -> Four { v }
    cmplt(v: Four, w: Four) -> Struct { compared(a, &Value::Four(v), &Value::Four(w), "<")? }
    cmple(v: Four, w: Four) -> Struct { compared(a, &Value::Four(v), &Value::Four(w), "<=")? }
    cmpgt(v: Four, w: Four) -> Struct { compared(a, &Value::Four(v), &Value::Four(w), ">")? }
    cmpge(v: Four, w: Four) -> Struct { compared(a, &Value::Four(v), &Value::Four(w), ">=")? }
    cmpeq(v: Four, w: Four) -> Struct { compared(a, &Value::Four(v), &Value::Four(w), "==")? }
    cmpne(v: Four, w: Four) -> Struct { compared(a, &Value::Four(v), &Value::Four(w), "!=")? }
    select(mask: Struct, v: Four, w: Four) -> Four {
        let [x, y, z, w] = selected(a, &mask, &Value::Four(v), &Value::Four(w))?;
        [x, y, z, w]
    }
    clone(v: Four) -> Four { v }
}

functions! {
    /// Functions of masks, the results of comparisons of vectors.
    OF_MASKS(a):
    any(mask: Struct) -> Truth { conditions(&mask).into_iter().fold(Condition::Known(false), Condition::or) }
    all(mask: Struct) -> Truth { conditions(&mask).into_iter().fold(Condition::Known(true), Condition::and) }
    test(mask: Struct, index: Integer) -> Truth {
        let index = a.known_index(&Value::Integer(index)).ok_or_else(messages::index_unknown)?;
        conditions(&mask).get(index).cloned().ok_or_else(|| messages::index_outside("a mask"))?
    }
    clone(mask: Struct) -> Struct { mask }
}

/// Compares two vectors number by number.
fn compared(a: &mut Algebra, v: &Value, w: &Value, operator: &str) -> Result<Rc<Struct>, CallError> {
    let formula = format!("v {operator} w");
    let parts = ["x", "y", "z", "w"].into_iter().map_while(|name| Some((name, v.field(a, name)?, w.field(a, name)?)));
    let parts: Vec<_> = parts.collect();
    let parts = parts.into_iter().map(|(name, v, w)| (name.to_owned(), evaluate(a, &formula, &["v", "w"], &[v, w])));
    Ok(Rc::new(Struct { name: MASK.to_owned(), fields: parts.collect() }))
}

/// Selects each number of `v` where the mask holds, else that of `w`.
fn selected<const N: usize>(a: &mut Algebra, mask: &Struct, v: &Value, w: &Value) -> Result<[Scalar; N], CallError> {
    let conditions: [Condition; N] = conditions(mask).try_into().map_err(|_| CallError::Arguments)?;
    let parts = conditions.iter().zip(["x", "y", "z", "w"]).map(|(condition, name)| {
        match (v.field(a, name), w.field(a, name)) {
            (Some(Value::Scalar(x)), Some(Value::Scalar(y))) => Some(condition.select(a, x, y)),
            _ => None,
        }
    });
    let parts: Option<Vec<Scalar>> = parts.collect();
    parts.and_then(|parts| parts.try_into().ok()).ok_or(CallError::Arguments)
}

/// Returns the conditions of a mask; none for another struct.
fn conditions(mask: &Struct) -> Vec<Condition> {
    let conditions = mask.fields.iter().filter(|_| mask.is_mask()).filter_map(|(_, value)| match value {
        Value::Truth(condition) => Some(condition.clone()),
        _ => None,
    });
    conditions.collect()
}
