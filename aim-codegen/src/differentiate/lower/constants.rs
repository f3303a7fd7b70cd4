//! Associated constants of number types and of glam types.

use super::algebra::Algebra;
use super::map::{Affine, Map, Quaternion};
use super::square;
use super::value::Value;
use crate::differentiate::types::{self, Precision, Shape};

/// Returns an associated constant, such as `Vec3::X`.
pub(super) fn associated(a: &mut Algebra, ty: &str, name: &str) -> Option<Value> {
    let (shape, precision) = types::named(ty)?;
    Some(match shape {
        Shape::Scalar => Value::Scalar(a.number(of_numbers(precision, name)?)),
        Shape::Planar => {
            let [x, y, _] = direction(name, 2)?;
            Value::Planar(a.number_vector([x, y, 0.0]))
        }
        Shape::Vector => {
            let components = direction(name, 3)?;
            Value::Vector(a.number_vector(components))
        }
        Shape::Four => {
            let axis = |letters: &str| ["X", "Y", "Z", "W"].iter().position(|known| *known == letters);
            let (sign, letter) = name.strip_prefix("NEG_").map_or((1.0, name), |rest| (-1.0, rest));
            let components: [f64; 4] = match (letter, axis(letter)) {
                ("ZERO", _) => [0.0; 4],
                ("ONE", _) => [sign; 4],
                (_, Some(axis)) => core::array::from_fn(|k| if k == axis { sign } else { 0.0 }),
                _ => return None,
            };
            Value::Four(components.map(|c| a.number(c)))
        }
        Shape::Quaternion if name == "IDENTITY" => Value::Quaternion(Quaternion::identity(a)),
        Shape::Matrix if name == "IDENTITY" => Value::Matrix(Map::identity(a)),
        Shape::Matrix if name == "ZERO" => {
            let zero = a.number_vector([0.0; 3]);
            Value::Matrix(Map::Columns([zero; 3]))
        }
        Shape::Square(4) if name == "IDENTITY" => {
            let map = Map::identity(a);
            Value::Homogeneous(Affine::about_origin(a, map))
        }
        Shape::Square(count) if name == "IDENTITY" || name == "ZERO" => {
            let diagonal = a.number(if name == "ZERO" { 0.0 } else { 1.0 });
            Value::Square(square::diagonal(a, &vec![diagonal; count]))
        }
        Shape::Rigid if name == "IDENTITY" => {
            let map = Map::identity(a);
            Value::Affine(Affine::about_origin(a, map))
        }
        _ => return None,
    })
}

fn of_numbers(precision: Precision, name: &str) -> Option<f64> {
    let (epsilon, least, most) = match precision {
        Precision::Single => (f32::EPSILON.into(), f32::MIN_POSITIVE.into(), f32::MAX.into()),
        Precision::Double => (f64::EPSILON, f64::MIN_POSITIVE, f64::MAX),
    };
    match name {
        "EPSILON" => Some(epsilon),
        "MIN_POSITIVE" => Some(least),
        "MAX" => Some(most),
        "MIN" => Some(-most),
        "INFINITY" => Some(f64::INFINITY),
        "NEG_INFINITY" => Some(f64::NEG_INFINITY),
        "NAN" => Some(f64::NAN),
        _ => None,
    }
}

fn direction(name: &str, axes: usize) -> Option<[f64; 3]> {
    let along = |letter: &str, value: f64| {
        let axis = ["X", "Y", "Z"][..axes].iter().position(|&known| known == letter)?;
        let mut components = [0.0; 3];
        components[axis] = value;
        Some(components)
    };
    match name {
        "ZERO" => Some([0.0; 3]),
        "ONE" => Some([1.0; 3]),
        "NEG_ONE" => Some([-1.0; 3]),
        _ => match name.strip_prefix("NEG_") {
            Some(letter) => along(letter, -1.0),
            None => along(name, 1.0),
        },
    }
}
