//! [`normal_matrix`]: the transform of surface normals.

use aim_runtime::glam::{Affine3A, Mat3A, Vec3A};
use aim_runtime::rotation::length;

use crate::float::narrow;

/// Returns the matrix that transforms normals when `matrix` transforms points: a positive multiple of its inverse
/// transpose, so that normals stay perpendicular to the surface under scale, skew and mirroring. Its results have to be
/// normalised again. For a pure rotation it is a multiple of the matrix itself.
///
/// If `matrix` is singular but of rank 2, the result still gives all normals except those in one plane their direction.
/// It is zero if `matrix` is not finite or of lower rank.
///
/// Entries are rounded to single precision. For scales whose ratio is 1000, the direction of a normal has an error of
/// 1e-5, or 1e-4 for those that are shortened most. [`Mesh::deform_normals`](crate::Mesh::deform_normals) does not
/// round.
///
/// ```
/// use aim_animation::glam::{Affine3A, Vec3, Vec3A};
/// use aim_animation::normal_matrix;
///
/// // A slope that is stretched upwards is steeper; its normal lies lower.
/// let stretch = Affine3A::from_scale(Vec3::new(1.0, 2.0, 1.0));
/// let normal = (normal_matrix(&stretch) * Vec3A::new(1.0, 1.0, 0.0)).normalize();
/// assert!(normal.abs_diff_eq(Vec3A::new(2.0, 1.0, 0.0).normalize(), 1e-6));
/// ```
#[must_use]
pub fn normal_matrix(matrix: &Affine3A) -> Mat3A {
    let columns = Cofactors::new(matrix.matrix3).columns;
    let most = columns.as_flattened().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    // Scale the largest entry to 1, so that all fit single precision.
    let [x, y, z] = columns.map(|column| Vec3A::from_array(column.map(|x| narrow(x / most))));
    let scaled = Mat3A::from_cols(x, y, z);
    if scaled.is_finite() { scaled } else { Mat3A::ZERO }
}

/// Cofactor matrix: M⁻ᵀ = cof(M) / det(M). Computed in double precision, whose range holds all products of three
/// single-precision numbers, and whose digits keep the small differences that uneven scales cause.
pub(crate) struct Cofactors {
    /// The columns of the cofactor matrix times the sign of the determinant; its magnitude does not affect directions.
    columns: [[f64; 3]; 3],
    pub(crate) is_mirrored: bool,
}

impl Cofactors {
    pub(crate) fn new(m: Mat3A) -> Self {
        let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis].map(wide);
        let columns = [cross(y, z), cross(z, x), cross(x, y)];
        let is_mirrored = x[0] * columns[0][0] + x[1] * columns[0][1] + x[2] * columns[0][2] < 0.0;
        let side = if is_mirrored { -1.0 } else { 1.0 };
        Self { columns: columns.map(|column| column.map(|x| x * side)), is_mirrored }
    }

    /// Returns the transformed normal, of length one; zero if it is zero or not finite.
    pub(crate) fn turned(&self, normal: Vec3A) -> Vec3A {
        let ([x, y, z], [a, b, c]) = (self.columns, wide(normal));
        direction([0, 1, 2].map(|row| x[row] * a + y[row] * b + z[row] * c))
    }
}

/// Converts a vector to double precision.
fn wide(v: Vec3A) -> [f64; 3] {
    v.to_array().map(f64::from)
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Unit normal of a triangle whose corners are counter-clockwise seen from its tip; zero if the triangle is degenerate.
pub(crate) fn facet_normal(corners: [Vec3A; 3]) -> Vec3A {
    let [a, b, c] = corners.map(wide);
    let from_a = |p: [f64; 3]| [0, 1, 2].map(|axis| p[axis] - a[axis]);
    direction(cross(from_a(b), from_a(c)))
}

/// Returns the vector with length 1; zero if it is zero or not finite.
fn direction(vector: [f64; 3]) -> Vec3A {
    let most = vector.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let scaled = Vec3A::from_array(vector.map(|x| narrow(x / most)));
    if scaled.is_finite() { scaled / length(scaled) } else { Vec3A::ZERO }
}
