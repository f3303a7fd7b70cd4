//! Supported functions: tables of their names, the kinds of their arguments, and their values.
//!
//! A method is a function whose first argument is the receiver, so `v.dot(w)` and `Vec3::dot(v, w)` share one entry.

mod construct;
mod function;
mod quaternion;
mod scalar;
mod transform;
mod vector;

pub(super) use self::function::{CallError, Function};
use super::algebra::Algebra;
use super::square;
use super::value::Value;
use crate::declare::report::text::Text;
use crate::differentiate::messages;
use crate::differentiate::types::{self, Shape};

/// Returns the methods of a value.
pub(super) fn methods_of(receiver: &Value) -> &'static [&'static [Function]] {
    match receiver {
        Value::Scalar(_) => &[scalar::METHODS],
        Value::Planar(_) => &[vector::PLANAR, vector::EITHER],
        Value::Vector(_) => &[vector::METHODS, vector::EITHER],
        Value::Quaternion(_) => &[quaternion::METHODS],
        Value::Matrix(_) => &[transform::MATRIX],
        Value::Affine(_) => &[transform::AFFINE],
        Value::Square(_) => &[transform::SQUARE],
        Value::Homogeneous(_) => &[transform::HOMOGENEOUS, transform::SQUARE],
        Value::Four(_) => &[vector::FOUR],
        Value::Integer(_) => &[scalar::WHOLE],
        Value::Struct(of) if of.is_mask() => &[vector::OF_MASKS],
        _ => &[],
    }
}

/// Returns the constructors of a type, and its methods.
pub(super) fn functions_of(shape: &Shape) -> &'static [&'static [Function]] {
    match shape {
        Shape::Scalar => &[construct::SCALAR, scalar::METHODS],
        Shape::Four => &[construct::FOUR, vector::FOUR],
        Shape::Planar => &[construct::PLANAR, vector::PLANAR, vector::EITHER],
        Shape::Vector => &[construct::VECTOR, vector::METHODS, vector::EITHER],
        Shape::Quaternion => &[construct::QUATERNION, quaternion::METHODS],
        Shape::Matrix => &[construct::MATRIX, transform::MATRIX],
        Shape::Rigid => &[construct::AFFINE, transform::AFFINE],
        Shape::Square(2) => &[construct::MATRIX_OF_TWO, transform::SQUARE],
        Shape::Square(_) => &[construct::MATRIX_OF_FOUR, transform::HOMOGENEOUS, transform::SQUARE],
        _ => &[],
    }
}

/// Returns the message about a method that a value of this kind does not have; `known` are those that it has.
pub(super) fn unknown_method(name: &str, kind: &str, known: &[&str]) -> Text {
    // A method of other values is not a misspelt one, and many short names are alike: `map` and `max`.
    let similar = if name.len() <= 3 || has_name(name) { &[] } else { known };
    messages::unknown_method(name, kind, known, similar)
}

/// Returns `true` if a number or a type of glam has a method of this name.
fn has_name(name: &str) -> bool {
    let tables = [
        scalar::METHODS,
        scalar::WHOLE,
        vector::EITHER,
        vector::METHODS,
        vector::PLANAR,
        vector::FOUR,
        quaternion::METHODS,
        transform::MATRIX,
        transform::AFFINE,
        transform::HOMOGENEOUS,
        transform::SQUARE,
    ];
    tables.into_iter().flatten().any(|function| function.name == name)
}

/// Methods of numbers that are in no table.
const OF_NUMBERS: &[&str] = &[
    "is_subnormal",
    "is_normal",
    "classify",
    "is_sign_positive",
    "is_sign_negative",
    "next_up",
    "next_down",
    "maximum",
    "minimum",
    "div_euclid",
    "round_ties_even",
    "abs_sub",
    "to_bits",
    "from_bits",
    "to_be_bytes",
    "to_le_bytes",
    "to_ne_bytes",
    "to_int_unchecked",
];

/// Shapes of glam's types.
const GLAM_SHAPES: [Shape; 8] = [
    Shape::Planar,
    Shape::Vector,
    Shape::Four,
    Shape::Quaternion,
    Shape::Matrix,
    Shape::Square(2),
    Shape::Square(4),
    Shape::Rigid,
];

/// Methods and functions of glam's types that are in no table, besides conversions such as `as_vec3`.
const OF_GLAM: &[&str] = &[
    "abs_diff_eq",
    "add_mat2",
    "add_mat4",
    "col_mut",
    "div_euclid",
    "div_scalar",
    "dot_into_vec",
    "fract_gl",
    "from_cols_slice",
    "from_euler",
    "from_homogeneous",
    "from_mat2",
    "from_mat3_minor",
    "from_mat3a_minor",
    "from_mat4_minor",
    "from_rotation_arc_2d",
    "from_rotation_axes",
    "from_rows",
    "from_rows_array",
    "from_rows_slice",
    "from_scale_angle",
    "from_scale_angle_translation",
    "frustum_lh",
    "frustum_rh",
    "frustum_rh_gl",
    "inverse_or_zero",
    "is_finite",
    "is_finite_mask",
    "is_nan",
    "is_nan_mask",
    "is_near_identity",
    "is_negative_bitmask",
    "is_negative_mask",
    "is_normalized",
    "lerp_monotonic",
    "map",
    "max_position",
    "min_position",
    "mul_diagonal_scale",
    "mul_transpose_vec2",
    "mul_transpose_vec3a",
    "mul_transpose_vec4",
    "orthographic_lh",
    "orthographic_rh",
    "orthographic_rh_gl",
    "perspective_infinite_reverse_lh",
    "perspective_infinite_reverse_rh",
    "perspective_rh_gl",
    "project",
    "project_point3a",
    "rotate_angle",
    "rotate_towards",
    "set_row",
    "slerp_long",
    "smoothstep",
    "sub_mat2",
    "sub_mat4",
    "to_euler",
    "to_homogeneous",
    "to_rows_array",
    "to_scale_rotation_translation",
    "transform_point2",
    "transform_vector2",
    "try_inverse",
    "with_w",
    "write_cols_to_slice",
    "write_to_slice",
];

/// Returns `true` if the type may have an inherent method or function of this name.
pub(super) fn is_of_type(shape: &Shape, name: &str) -> bool {
    // `from`, `into` and `clone` are trait functions; their meaning depends on the implementing type.
    if matches!(name, "from" | "into" | "clone") {
        return false;
    }
    let is_in = |shape: &Shape| functions_of(shape).iter().copied().flatten().any(|function| function.name == name);
    match shape {
        Shape::Scalar => OF_NUMBERS.contains(&name) || is_in(shape),
        // Some functions are in the tables of one type only, although others have them, too.
        _ => OF_GLAM.contains(&name) || name.starts_with("as_") || GLAM_SHAPES.iter().any(is_in),
    }
}

/// Converts a number to an integer type as `as` does: truncates, and saturates at the type's ends.
pub(super) fn whole(a: &mut Algebra, x: &Value, ty: &str) -> Value {
    let (least, most) = types::ends(ty);
    let formula = match (least.is_finite(), most.is_finite()) {
        (_, true) => format!("x.trunc().clamp({least:?}, {most:?})"),
        (true, false) => format!("x.trunc().max({least:?})"),
        (false, false) => "x.trunc()".to_owned(),
    };
    match function::evaluate(a, &formula, &["x"], core::slice::from_ref(x)) {
        Value::Scalar(whole) => Value::Integer(whole),
        other => other,
    }
}

/// Calls the function with this name in these tables; `None` if there is none.
///
/// Vectors of two use the methods of vectors of three, with a third component of 0.
pub(super) fn call(
    tables: &[&'static [Function]],
    name: &str,
    a: &mut Algebra,
    arguments: &[Value],
) -> Option<Result<Value, (CallError, &'static Function)>> {
    let mut error = None;
    for function in tables.iter().copied().flatten().filter(|function| function.name == name) {
        match function.call(a, arguments) {
            Ok(value) => return Some(Ok(value)),
            Err(found) => error = Some(Err((found, function))),
        }
        // A 4×4 matrix that is stored as a transform: use its entries.
        if let Some(Value::Homogeneous(m)) = arguments.first() {
            let mut written = arguments.to_vec();
            written[0] = Value::Square(square::of_affine(a, m));
            if let Ok(value) = function.call(a, &written) {
                return Some(Ok(value));
            }
        }
        if let Some(lifted) = lifted(arguments) {
            match function.call(a, &lifted) {
                Ok(Value::Vector(v)) => return Some(Ok(Value::Planar(v))),
                Ok(value) => return Some(Ok(value)),
                Err(found @ (CallError::Message(_) | CallError::Refused(_))) => error = Some(Err((found, function))),
                Err(CallError::Arguments) => {}
            }
        }
    }
    error
}

/// Returns the arguments with vectors of two as vectors of three; `None` if the first is not a vector of two, or if
/// others are vectors of three.
fn lifted(arguments: &[Value]) -> Option<Vec<Value>> {
    if !matches!(arguments.first(), Some(Value::Planar(_))) {
        return None;
    }
    arguments
        .iter()
        .map(|argument| match argument {
            Value::Planar(v) => Some(Value::Vector(*v)),
            Value::Vector(_) => None,
            other => Some(other.clone()),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::differentiate::lower::condition::Condition;
    use crate::differentiate::lower::map::{Affine, Map, Quaternion};

    #[test]
    fn lists_beside_the_tables_repeat_no_table() {
        let is_in = |shapes: &[Shape], name: &str| {
            shapes.iter().flat_map(functions_of).copied().flatten().any(|function| function.name == name)
        };
        let of_glam: Vec<&str> = OF_GLAM.iter().copied().filter(|name| is_in(&GLAM_SHAPES, name)).collect();
        let of_numbers: Vec<&str> = OF_NUMBERS.iter().copied().filter(|name| is_in(&[Shape::Scalar], name)).collect();
        assert_eq!([of_glam, of_numbers], [Vec::<&str>::new(), Vec::new()]);
    }

    #[test]
    fn every_formula_has_a_value() {
        let mut a = Algebra::new();
        let x = a.g.input("x");
        let (v, zero) = (a.vector([x; 3]), a.number(0.0));
        let planar = a.vector([x, x, zero]);
        let matrix = Map::Columns([v; 3]);
        let value = |kind: &&str| match *kind {
            "Scalar" => Value::Scalar(x),
            "Integer" => Value::Integer(zero),
            "Truth" => Value::Truth(Condition::Less(zero, x)),
            "Four" => Value::Four([x; 4]),
            "Planar" => Value::Planar(planar),
            "Vector" => Value::Vector(v),
            "Quaternion" => Value::Quaternion(Quaternion::from_parts(v, x)),
            "Matrix" => Value::Matrix(matrix.clone()),
            "Square" => Value::Square(vec![vec![x; 4]; 4]),
            "Homogeneous" => Value::Homogeneous(Affine { map: matrix.clone(), translation: v }),
            "Affine" => Value::Affine(Affine { map: matrix.clone(), translation: v }),
            _ => Value::Array(vec![Value::Scalar(x); 3]),
        };
        for function in [Shape::Scalar].iter().chain(&GLAM_SHAPES).flat_map(functions_of).copied().flatten() {
            let arguments: Vec<Value> = function.takes.iter().map(value).collect();
            if let Ok(found) = function.call(&mut a, &arguments) {
                assert!(!found.is_unknown(), "{}", function.name);
            }
        }
    }
}
