//! [`normal_matrix`]: the transform of what stands square to a surface.

use aim_runtime::glam::{Affine3A, Mat3A, Vec3A};
use aim_runtime::rotation::{cross, length};

/// The matrix that moves normals where `matrix` moves points: a positive multiple of the inverse's transpose, so that
/// normals stay square to the surface under scale, skew and mirrors. What it gives has to be made unit again. For a pure rotation
/// it is a multiple of the matrix itself.
///
/// It has a direction for all normals but one also where the matrix is flat; zero if it is not finite, or flatter.
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
    let m = matrix.matrix3;
    let most = m.x_axis.abs().max(m.y_axis.abs()).max(m.z_axis.abs()).max_element();
    // Brought to about 1, so that products stay in range.
    let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis].map(|column| column / most);
    // M⁻ᵀ = cof(M) / det(M); of the determinant only the sign counts.
    let cofactors = Mat3A::from_cols(cross(y, z), cross(z, x), cross(x, y));
    if !cofactors.is_finite() {
        return Mat3A::ZERO;
    }
    if x.dot(cofactors.x_axis) < 0.0 { -cofactors } else { cofactors }
}

/// The vector at length 1; zero if it is zero or not finite.
pub(crate) fn unit_or_zero(vector: Vec3A) -> Vec3A {
    let most = vector.abs().max_element();
    let scaled = vector / most;
    if scaled.is_finite() { scaled / length(scaled) } else { Vec3A::ZERO }
}
