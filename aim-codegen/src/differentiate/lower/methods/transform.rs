//! Methods of matrices and transforms.

use super::function::functions;
use crate::differentiate::lower::algebra::Algebra;
use crate::differentiate::lower::value::Value;
use crate::differentiate::messages;

functions! {
    /// Of matrices.
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
    into(m: Matrix) -> Matrix { m }
    clone(m: Matrix) -> Matrix { m }
}

functions! {
    /// Of transforms.
    AFFINE(a):
    transform_point3(m: Affine, v: Vector) -> Vector { m.apply(a, v) }
    transform_point3a(m: Affine, v: Vector) -> Vector { m.apply(a, v) }
    transform_vector3(m: Affine, v: Vector) -> Vector { m.map.apply(a, v) }
    transform_vector3a(m: Affine, v: Vector) -> Vector { m.map.apply(a, v) }
    inverse(m: Affine) -> Affine { m.inverse(a) }
    clone(m: Affine) -> Affine { m }
}

/// The index of an axis, which has to be known.
fn axis(a: &Algebra, index: aim_symbolic::Scalar) -> Result<usize, crate::declare::report::text::Text> {
    let known = a.known_index(&Value::Integer(index)).ok_or_else(messages::index_unknown)?;
    if known < 3 { Ok(known) } else { Err(messages::index_outside("a matrix")) }
}
