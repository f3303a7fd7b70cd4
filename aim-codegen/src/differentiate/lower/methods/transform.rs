//! Methods of matrices and transforms.

use aim_symbolic::{Scalar, Vector};

use super::function::{CallError, functions};
use crate::differentiate::lower::algebra::Algebra;
use crate::differentiate::lower::square;
use crate::differentiate::lower::value::{Columns, Value};
use crate::differentiate::messages;

functions! {
    /// Functions of 3×3 matrices.
    MATRIX(a):
    mul_vec3(m: Matrix, v: Vector) -> Vector { m.apply(a, v) }
    mul_vec3a(m: Matrix, v: Vector) -> Vector { m.apply(a, v) }
    mul_transpose_vec3(m: Matrix, v: Vector) -> Vector { m.transpose(a).apply(a, v) }
    mul_mat3(m: Matrix, n: Matrix) -> Matrix { m.compose(a, &n) }
    add_mat3(m: Matrix, n: Matrix) -> Matrix { m.zip(a, &n, Algebra::add_vectors) }
    sub_mat3(m: Matrix, n: Matrix) -> Matrix { m.zip(a, &n, Algebra::sub_vectors) }
    mul_scalar(m: Matrix, k: Scalar) -> Matrix { m.map(a, |a, column| a.scale(k, column)) }
    transpose(m: Matrix) -> Matrix { m.transpose(a) }
    inverse(m: Matrix) -> Matrix { m.inverse(a) }
    determinant(m: Matrix) -> Scalar { m.determinant(a) }
    col(m: Matrix, index: Integer) -> Vector {
        let index = axis(a, index)?;
        m.column(a, index)
    }
    row(m: Matrix, index: Integer) -> Vector {
        let index = axis(a, index)?;
        m.transpose(a).column(a, index)
    }
    diagonal(m: Matrix) = Vec3::new(m.x_axis.x, m.y_axis.y, m.z_axis.z);
    to_cols_array(m: Matrix) -> Array {
        m.columns(a).into_iter().flat_map(|column| a.parts(column)).map(Value::Scalar).collect()
    }
    to_cols_array_2d(m: Matrix) -> Array {
        m.columns(a).into_iter().map(|column| Value::Array(a.parts(column).map(Value::Scalar).to_vec())).collect()
    }
    into(m: Matrix) -> Matrix { m }
    clone(m: Matrix) -> Matrix { m }
}

functions! {
    /// Functions of transforms.
    AFFINE(a):
    transform_point3(m: Affine, v: Vector) -> Vector { m.apply(a, v) }
    transform_point3a(m: Affine, v: Vector) -> Vector { m.apply(a, v) }
    transform_vector3(m: Affine, v: Vector) -> Vector { m.map.apply(a, v) }
    transform_vector3a(m: Affine, v: Vector) -> Vector { m.map.apply(a, v) }
    inverse(m: Affine) -> Affine { m.inverse(a) }
    clone(m: Affine) -> Affine { m }
}

functions! {
    /// Functions of 4×4 matrices that are transforms.
    HOMOGENEOUS(a):
    transform_point3(m: Homogeneous, v: Vector) -> Vector { m.apply(a, v) }
    transform_vector3(m: Homogeneous, v: Vector) -> Vector { m.map.apply(a, v) }
    project_point3(m: Homogeneous, v: Vector) -> Vector { m.apply(a, v) }
    inverse(m: Homogeneous) -> Homogeneous { m.inverse(a) }
    clone(m: Homogeneous) -> Homogeneous { m }
}

functions! {
    /// Functions of 2×2 and 4×4 matrices.
    SQUARE(a):
    transpose(m: Square) -> Square { square::transposed(&m) }
    inverse(m: Square) -> Square { square::inverse(a, &m) }
    determinant(m: Square) -> Scalar { square::determinant(a, &m) }
    mul_vec2(m: Square, v: Planar) -> Planar {
        let v = a.parts(v);
        let [x, y] = image(a, &m, &v[..2])?;
        let zero = a.number(0.0);
        a.vector([x, y, zero])
    }
    mul_vec4(m: Square, v: Four) -> Four { image(a, &m, &v)? }
    mul_mat2(m: Square, n: Square) -> Square { product(a, &m, &n)? }
    mul_mat4(m: Square, n: Square) -> Square { product(a, &m, &n)? }
    transform_point3(m: Square, v: Vector) -> Vector {
        let [x, y, z, _] = image_of(a, &m, v, 1.0)?;
        a.vector([x, y, z])
    }
    transform_vector3(m: Square, v: Vector) -> Vector {
        let [x, y, z, _] = image_of(a, &m, v, 0.0)?;
        a.vector([x, y, z])
    }
    project_point3(m: Square, v: Vector) -> Vector {
        let [x, y, z, w] = image_of(a, &m, v, 1.0)?;
        let (reciprocal, v) = (a.recip(w), a.vector([x, y, z]));
        a.scale(reciprocal, v)
    }
    to_cols_array_2d(m: Square) -> Array {
        m.into_iter().map(|column| Value::Array(column.into_iter().map(Value::Scalar).collect())).collect()
    }
    to_cols_array(m: Square) -> Array { m.into_iter().flatten().map(Value::Scalar).collect() }
    clone(m: Square) -> Square { m }
}

fn product(a: &mut Algebra, m: &Columns, n: &Columns) -> Result<Columns, CallError> {
    let same = m.len() == n.len();
    same.then(|| n.iter().map(|column| square::apply(a, m, column)).collect()).ok_or(CallError::Arguments)
}

fn image<const N: usize>(a: &mut Algebra, m: &Columns, v: &[Scalar]) -> Result<[Scalar; N], CallError> {
    let image = if m.len() == v.len() { square::apply(a, m, v) } else { Vec::new() };
    image.try_into().map_err(|_| CallError::Arguments)
}

/// Returns the image of a vector with the fourth component `w`.
fn image_of(a: &mut Algebra, m: &Columns, v: Vector, w: f64) -> Result<[Scalar; 4], CallError> {
    let ([x, y, z], w) = (a.parts(v), a.number(w));
    image(a, m, &[x, y, z, w])
}

/// Returns the index of an axis, which must be known.
fn axis(a: &Algebra, index: Scalar) -> Result<usize, crate::declare::report::text::Text> {
    let known = a.known_index(&Value::Integer(index)).ok_or_else(messages::index_unknown)?;
    if known < 3 { Ok(known) } else { Err(messages::index_outside("a matrix")) }
}
