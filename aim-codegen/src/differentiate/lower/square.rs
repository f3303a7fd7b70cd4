//! 2×2 and 4×4 matrices, by their entries. A 4×4 matrix that is an affine transform stays one as long as possible
//! ([`Value::Homogeneous`]).

use aim_symbolic::Scalar;

use super::algebra::Algebra;
use super::map::Affine;
use super::value::{Columns, Value};

/// Returns the vector of two or four numbers.
pub(super) fn vector(a: &mut Algebra, numbers: &[Scalar]) -> Value {
    match *numbers {
        [x, y, z, w] => Value::Four([x, y, z, w]),
        [x, y, ..] => {
            let zero = a.number(0.0);
            Value::Planar(a.vector([x, y, zero]))
        }
        _ => Value::Unknown,
    }
}

/// Returns the components of a vector of two or four.
pub(super) fn numbers(a: &mut Algebra, vector: &Value) -> Vec<Scalar> {
    match vector {
        Value::Planar(v) => a.parts(*v)[..2].to_vec(),
        Value::Four(parts) => parts.to_vec(),
        _ => Vec::new(),
    }
}

/// Returns the matrix of a transform.
pub(super) fn of_affine(a: &mut Algebra, m: &Affine) -> Columns {
    let columns = m.map.columns(a);
    let columns = [columns[0], columns[1], columns[2], m.translation];
    let mut of_one = |(k, column)| {
        let last = a.number(if k == 3 { 1.0 } else { 0.0 });
        let mut numbers = a.parts(column).to_vec();
        numbers.push(last);
        numbers
    };
    columns.into_iter().enumerate().map(&mut of_one).collect()
}

/// Returns the columns of a 2×2 or 4×4 matrix; `None` for any other value.
pub(crate) fn columns(a: &mut Algebra, value: &Value) -> Option<Columns> {
    match value {
        Value::Square(columns) => Some(columns.clone()),
        Value::Homogeneous(m) => Some(of_affine(a, m)),
        _ => None,
    }
}

/// Returns the matrix with these numbers on its diagonal.
pub(super) fn diagonal(a: &mut Algebra, numbers: &[Scalar]) -> Columns {
    let zero = a.number(0.0);
    let column = |(k, &x)| (0..numbers.len()).map(|row| if row == k { x } else { zero }).collect();
    numbers.iter().enumerate().map(column).collect()
}

pub(super) fn transposed(m: &Columns) -> Columns {
    (0..m.len()).map(|row| m.iter().map(|column| column[row]).collect()).collect()
}

pub(super) fn apply(a: &mut Algebra, m: &Columns, v: &[Scalar]) -> Vec<Scalar> {
    (0..m.len())
        .map(|row| {
            let products: Vec<Scalar> = m.iter().zip(v).map(|(column, &x)| a.mul(column[row], x)).collect();
            products.into_iter().reduce(|sum, product| a.add(sum, product)).unwrap_or_else(|| a.number(0.0))
        })
        .collect()
}

/// Combines two matrices entry by entry.
pub(super) fn zip(
    a: &mut Algebra,
    m: &Columns,
    n: &Columns,
    of: impl Fn(&mut Algebra, Scalar, Scalar) -> Scalar,
) -> Columns {
    m.iter().zip(n).map(|(c, d)| c.iter().zip(d).map(|(&x, &y)| of(a, x, y)).collect()).collect()
}

pub(super) fn scaled(a: &mut Algebra, k: Scalar, m: &Columns) -> Columns {
    m.iter().map(|column| column.iter().map(|&x| a.mul(k, x)).collect()).collect()
}

/// Returns the determinant, by expansion along the first column.
pub(super) fn determinant(a: &mut Algebra, m: &Columns) -> Scalar {
    let [column] = m.as_slice() else {
        let products: Vec<Scalar> = (0..m.len())
            .map(|row| {
                let cofactor = cofactor(a, m, 0, row);
                a.mul(m[0][row], cofactor)
            })
            .collect();
        return products.into_iter().reduce(|sum, product| a.add(sum, product)).unwrap_or_else(|| a.number(1.0));
    };
    column[0]
}

fn cofactor(a: &mut Algebra, m: &Columns, column: usize, row: usize) -> Scalar {
    let rest = m.iter().enumerate().filter(|(k, _)| *k != column);
    let rest = rest.map(|(_, column)| column.iter().enumerate().filter(|(k, _)| *k != row).map(|(_, &x)| x).collect());
    let minor = determinant(a, &rest.collect());
    if (column + row) % 2 == 0 { minor } else { a.neg(minor) }
}

/// Returns the inverse: transposed cofactors over the determinant.
pub(super) fn inverse(a: &mut Algebra, m: &Columns) -> Columns {
    let determinant = determinant(a, m);
    let reciprocal = a.recip(determinant);
    let places = 0..m.len();
    let cofactors: Columns =
        places.clone().map(|row| places.clone().map(|column| cofactor(a, m, column, row)).collect()).collect();
    scaled(a, reciprocal, &cofactors)
}
