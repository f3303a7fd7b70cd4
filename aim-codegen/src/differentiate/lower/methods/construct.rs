//! Constructors: functions that make a value of a type.

use aim_symbolic::{Node, Scalar, Vector};

use super::function::{CallError, functions};
use super::quaternion::of_matrix;
use crate::declare::report::text::Text;
use crate::differentiate::lower::algebra::Algebra;
use crate::differentiate::lower::map::{Affine, Map, Quaternion};
use crate::differentiate::lower::square;
use crate::differentiate::lower::value::Value;
use crate::differentiate::messages;

functions! {
    SCALAR(a):
    from(x: Scalar) -> Scalar { x }
    from(n: Integer) -> Scalar { n }
    from(c: Truth) = if c { 1.0 } else { 0.0 };
}

functions! {
    FOUR(a):
    new(x: Scalar, y: Scalar, z: Scalar, w: Scalar) -> Four { [x, y, z, w] }
    splat(x: Scalar) -> Four { [x; 4] }
    from_array(numbers: Array) -> Four { scalars(&numbers)? }
    from_slice(numbers: Array) -> Four { scalars(numbers.get(..4).unwrap_or_default())? }
    from(numbers: Array) -> Four { scalars(&numbers)? }
    from(v: Four) -> Four { v }
    from(q: Quaternion) -> Four {
        let ([x, y, z], w) = (a.parts(q.parts.0), q.parts.1);
        [x, y, z, w]
    }
    from(parts: Tuple) -> Four {
        match parts.as_slice() {
            [Value::Vector(v), Value::Scalar(w)] => {
                let [x, y, z] = a.parts(*v);
                [x, y, z, *w]
            }
            _ => return Err(CallError::Arguments),
        }
    }
}

functions! {
    PLANAR(a):
    new(x: Scalar, y: Scalar) -> Planar { planar(a, x, y) }
    splat(x: Scalar) = Vec2::new(x, x);
    from_angle(x: Scalar) = Vec2::new(x.cos(), x.sin());
    from_slice(numbers: Array) -> Planar {
        let [x, y] = scalars(numbers.get(..2).unwrap_or_default())?;
        planar(a, x, y)
    }
    from_array(numbers: Array) -> Planar {
        let [x, y] = scalars(&numbers)?;
        planar(a, x, y)
    }
    from(v: Planar) -> Planar { v }
}

functions! {
    VECTOR(a):
    new(x: Scalar, y: Scalar, z: Scalar) -> Vector { a.vector([x, y, z]) }
    splat(x: Scalar) -> Vector { a.vector([x; 3]) }
    from_slice(numbers: Array) -> Vector {
        let numbers = scalars(numbers.get(..3).unwrap_or_default())?;
        a.vector(numbers)
    }
    from_array(numbers: Array) -> Vector {
        let numbers = scalars(&numbers)?;
        a.vector(numbers)
    }
    from(numbers: Array) -> Vector {
        let numbers = scalars(&numbers)?;
        a.vector(numbers)
    }
    from(v: Vector) -> Vector { v }
}

functions! {
    QUATERNION(a):
    from_rotation_x(radians: Scalar) -> Quaternion { Quaternion::turn(a, 0, radians) }
    from_rotation_y(radians: Scalar) -> Quaternion { Quaternion::turn(a, 1, radians) }
    from_rotation_z(radians: Scalar) -> Quaternion { Quaternion::turn(a, 2, radians) }
    from_axis_angle(axis: Vector, radians: Scalar) -> Quaternion {
        match still_turn(a, axis, radians)? {
            Some(turn) => turn,
            None => Quaternion::about_varying(a, axis, radians),
        }
    }
    // Opposite vectors have no shortest arc: the quaternion is then 0, and the rotation the identity.
    from_rotation_arc(from: Vector, to: Vector) = {
        let c = from.cross(to);
        Quat::from_xyzw(c.x, c.y, c.z, 1.0 + from.dot(to)).normalize()
    };
    from_rotation_arc_colinear(from: Vector, to: Vector) =
        Quat::from_rotation_arc(from, if from.dot(to) < 0.0 { -to } else { to });
    from_scaled_axis(v: Vector) -> Quaternion { Quaternion::about_vector(a, v) }
    from_xyzw(x: Scalar, y: Scalar, z: Scalar, w: Scalar) -> Quaternion { quaternion(a, [x, y, z, w]) }
    from_array(numbers: Array) -> Quaternion {
        let numbers = scalars(&numbers)?;
        quaternion(a, numbers)
    }
    from_mat3(m: Matrix) -> Quaternion { of_matrix(a, m) }
    from_mat3a(m: Matrix) -> Quaternion { of_matrix(a, m) }
    from_mat4(m: Homogeneous) -> Quaternion { of_matrix(a, m.map) }
    from_affine3(m: Affine) -> Quaternion { of_matrix(a, m.map) }
    from_affine3a(m: Affine) -> Quaternion { of_matrix(a, m.map) }
    from_vec4(v: Four) -> Quaternion { quaternion(a, v) }
}

functions! {
    MATRIX(a):
    from_rotation_x(radians: Scalar) -> Matrix { Map::turn(a, 0, radians) }
    from_rotation_y(radians: Scalar) -> Matrix { Map::turn(a, 1, radians) }
    from_rotation_z(radians: Scalar) -> Matrix { Map::turn(a, 2, radians) }
    from_axis_angle(axis: Vector, radians: Scalar) -> Matrix { about(a, axis, radians)? }
    from_quat(q: Quaternion) -> Matrix { q.map }
    from_cols(x: Vector, y: Vector, z: Vector) -> Matrix { Map::of_columns(a, [x, y, z]) }
    from_cols_array(numbers: Array) -> Matrix {
        let [xx, xy, xz, yx, yy, yz, zx, zy, zz] = scalars(&numbers)?;
        let columns = [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]].map(|column| a.vector(column));
        Map::of_columns(a, columns)
    }
    from_cols_array_2d(columns: Array) -> Matrix {
        let numbers = columns_of::<3>(&columns)?.concat();
        let columns = [0, 3, 6].map(|k| a.vector([numbers[k], numbers[k + 1], numbers[k + 2]]));
        Map::of_columns(a, columns)
    }
    from_diagonal(v: Vector) -> Matrix { Map::Diagonal(v) }
    from(m: Matrix) -> Matrix { m }
}

functions! {
    AFFINE(a):
    from_translation(v: Vector) = Affine3A::from_mat3_translation(Mat3::IDENTITY, v);
    from_rotation_translation(q: Quaternion, v: Vector) = Affine3A::from_mat3_translation(Mat3::from_quat(q), v);
    from_mat3_translation(m: Matrix, v: Vector) -> Affine {
        Affine { map: m, translation: v }
    }
    from_quat(q: Quaternion) -> Affine { Affine::about_origin(a, q.map) }
    from_mat3(m: Matrix) -> Affine { Affine::about_origin(a, m) }
    from_rotation_x(radians: Scalar) = Affine3A::from_mat3(Mat3::from_rotation_x(radians));
    from_rotation_y(radians: Scalar) = Affine3A::from_mat3(Mat3::from_rotation_y(radians));
    from_rotation_z(radians: Scalar) = Affine3A::from_mat3(Mat3::from_rotation_z(radians));
    from_axis_angle(axis: Vector, radians: Scalar) -> Affine {
        let map = about(a, axis, radians)?;
        Affine::about_origin(a, map)
    }
}

functions! {
    MATRIX_OF_TWO(a):
    from_cols(x: Planar, y: Planar) -> Square { [x, y].map(|column| a.parts(column)[..2].to_vec()).to_vec() }
    from_cols_array(numbers: Array) -> Square {
        let numbers: [Scalar; 4] = scalars(&numbers)?;
        numbers.chunks(2).map(<[Scalar]>::to_vec).collect()
    }
    from_cols_array_2d(columns: Array) -> Square { columns_of::<2>(&columns)? }
    from_angle(x: Scalar) = Mat2::from_cols(Vec2::new(x.cos(), x.sin()), Vec2::new(-x.sin(), x.cos()));
    from_diagonal(v: Planar) -> Square {
        let parts = a.parts(v);
        square::diagonal(a, &parts[..2])
    }
}

functions! {
    MATRIX_OF_FOUR(a):
    from_cols(x: Four, y: Four, z: Four, w: Four) -> Square { [x, y, z, w].map(|column| column.to_vec()).to_vec() }
    from_cols_array(numbers: Array) -> Square {
        let numbers: [Scalar; 16] = scalars(&numbers)?;
        numbers.chunks(4).map(<[Scalar]>::to_vec).collect()
    }
    from_cols_array_2d(columns: Array) -> Square { columns_of::<4>(&columns)? }
    from_diagonal(v: Four) -> Square { square::diagonal(a, &v) }
    from_mat3_translation(m: Matrix, v: Vector) -> Homogeneous { Affine { map: m, translation: v } }
    from_translation(v: Vector) = Mat4::from_mat3_translation(Mat3::IDENTITY, v);
    from_rotation_translation(q: Quaternion, v: Vector) = Mat4::from_mat3_translation(Mat3::from_quat(q), v);
    from_scale_rotation_translation(s: Vector, q: Quaternion, v: Vector) =
        Mat4::from_mat3_translation(Mat3::from_quat(q) * Mat3::from_diagonal(s), v);
    from_scale(s: Vector) = Mat4::from_mat3(Mat3::from_diagonal(s));
    from_mat3(m: Matrix) = Mat4::from_mat3_translation(m, Vec3::ZERO);
    from_quat(q: Quaternion) = Mat4::from_mat3(Mat3::from_quat(q));
    from_rotation_x(radians: Scalar) = Mat4::from_mat3(Mat3::from_rotation_x(radians));
    from_rotation_y(radians: Scalar) = Mat4::from_mat3(Mat3::from_rotation_y(radians));
    from_rotation_z(radians: Scalar) = Mat4::from_mat3(Mat3::from_rotation_z(radians));
    from_axis_angle(axis: Vector, radians: Scalar) -> Homogeneous {
        let map = about(a, axis, radians)?;
        Affine::about_origin(a, map)
    }
    look_to_rh(eye: Vector, ahead: Vector, up: Vector) = {
        let aside = ahead.cross(up).normalize();
        let m = Mat3::from_cols(aside, aside.cross(ahead), -ahead).transpose();
        Mat4::from_mat3_translation(m, -(m * eye))
    };
    look_to_lh(eye: Vector, ahead: Vector, up: Vector) = Mat4::look_to_rh(eye, -ahead, up);
    look_at_rh(eye: Vector, at: Vector, up: Vector) = Mat4::look_to_rh(eye, (at - eye).normalize(), up);
    look_at_lh(eye: Vector, at: Vector, up: Vector) = Mat4::look_to_lh(eye, (at - eye).normalize(), up);
    perspective_rh(angle: Scalar, aspect: Scalar, near: Scalar, far: Scalar) = {
        let (height, depth) = ((0.5 * angle).tan().recip(), far / (near - far));
        Mat4::from_cols(
            Vec4::new(height / aspect, 0.0, 0.0, 0.0),
            Vec4::new(0.0, height, 0.0, 0.0),
            Vec4::new(0.0, 0.0, depth, -1.0),
            Vec4::new(0.0, 0.0, depth * near, 0.0),
        )
    };
    perspective_lh(angle: Scalar, aspect: Scalar, near: Scalar, far: Scalar) = {
        let (height, depth) = ((0.5 * angle).tan().recip(), far / (far - near));
        Mat4::from_cols(
            Vec4::new(height / aspect, 0.0, 0.0, 0.0),
            Vec4::new(0.0, height, 0.0, 0.0),
            Vec4::new(0.0, 0.0, depth, 1.0),
            Vec4::new(0.0, 0.0, -depth * near, 0.0),
        )
    };
    perspective_infinite_rh(angle: Scalar, aspect: Scalar, near: Scalar) = {
        let height = (0.5 * angle).tan().recip();
        Mat4::from_cols(
            Vec4::new(height / aspect, 0.0, 0.0, 0.0),
            Vec4::new(0.0, height, 0.0, 0.0),
            Vec4::new(0.0, 0.0, -1.0, -1.0),
            Vec4::new(0.0, 0.0, -near, 0.0),
        )
    };
    perspective_infinite_lh(angle: Scalar, aspect: Scalar, near: Scalar) = {
        let height = (0.5 * angle).tan().recip();
        Mat4::from_cols(
            Vec4::new(height / aspect, 0.0, 0.0, 0.0),
            Vec4::new(0.0, height, 0.0, 0.0),
            Vec4::new(0.0, 0.0, 1.0, 1.0),
            Vec4::new(0.0, 0.0, -near, 0.0),
        )
    };
    from(m: Affine) -> Homogeneous { m }
}

/// Returns the rotation about an axis that does not depend on the variables; `None` if it does.
fn still_turn(a: &mut Algebra, axis: Vector, radians: Scalar) -> Result<Option<Quaternion>, Text> {
    let Some(known) = a.g.constant_vector_of(axis) else {
        let moves = a.varies(Node::Vector(axis));
        return Ok((!moves).then(|| Quaternion::about(a, axis, radians)));
    };
    let length = known.iter().map(|c| c * c).sum::<f64>().sqrt();
    if (length - 1.0).abs() > 1e-4 {
        return Err(messages::axis_not_unit(length));
    }
    Ok(Some(match known.iter().position(|c| c.abs() == 1.0) {
        // ±X, ±Y, ±Z
        Some(cardinal) => {
            let radians = if known[cardinal] < 0.0 { a.neg(radians) } else { radians };
            Quaternion::turn(a, cardinal, radians)
        }
        None => Quaternion::about(a, axis, radians),
    }))
}

fn about(a: &mut Algebra, axis: Vector, radians: Scalar) -> Result<Map, Text> {
    Ok(match still_turn(a, axis, radians)? {
        Some(turn) => turn.map,
        None => Map::rodrigues(a, axis, radians),
    })
}

fn planar(a: &mut Algebra, x: Scalar, y: Scalar) -> Vector {
    let zero = a.number(0.0);
    a.vector([x, y, zero])
}

/// Returns the quaternion with these components; a rotation only if it is known to have length 1.
fn quaternion(a: &mut Algebra, [x, y, z, w]: [Scalar; 4]) -> Quaternion {
    let u = a.vector([x, y, z]);
    let square: Option<f64> = [x, y, z, w].iter().map(|&c| a.constant_of(c).map(|c| c * c)).sum();
    if square.is_some_and(|square| (square - 1.0).abs() < 1e-6) {
        Quaternion::unit(a, u, w)
    } else {
        Quaternion::from_parts(u, w)
    }
}

/// Returns the columns of an `N`×`N` matrix.
fn columns_of<const N: usize>(columns: &[Value]) -> Result<Vec<Vec<Scalar>>, Text> {
    let of = |column: &Value| match column {
        Value::Array(numbers) => scalars::<N>(numbers).map(|numbers| numbers.to_vec()),
        _ => Err(messages::numbers_expected(N)),
    };
    let columns: Vec<Vec<Scalar>> = columns.iter().map(of).collect::<Result<_, _>>()?;
    if columns.len() == N { Ok(columns) } else { Err(messages::numbers_expected(N * N)) }
}

fn scalars<const N: usize>(values: &[Value]) -> Result<[Scalar; N], Text> {
    let numbers: Option<Vec<Scalar>> = values
        .iter()
        .map(|value| match value {
            Value::Scalar(x) => Some(*x),
            _ => None,
        })
        .collect();
    numbers.and_then(|numbers| numbers.try_into().ok()).ok_or_else(|| messages::numbers_expected(N))
}
