//! A node's local transform as translation, rotation and scale, always with a unit rotation.

use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3, Quat, Vec3};

/// A local transform: scale first, then rotation, then translation, relative to the parent node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trs {
    /// In units of the parent.
    pub translation: Vec3,
    /// Unit.
    pub rotation: Quat,
    /// May be negative (mirrored) or zero (hidden).
    pub scale: Vec3,
}

impl Trs {
    /// Nothing moved, turned or scaled.
    pub const IDENTITY: Self = Self { translation: Vec3::ZERO, rotation: Quat::IDENTITY, scale: Vec3::ONE };

    /// The same transform as an affine map, parent ← node, with the rotation made unit to double precision.
    #[must_use]
    pub fn affine_f64(&self) -> DAffine3 {
        let rotation = self.rotation.as_dquat().normalize();
        DAffine3::from_scale_rotation_translation(self.scale.as_dvec3(), rotation, self.translation.as_dvec3())
    }

    /// Turns the node by a correction of its own space: `local' = local · correction`. It keeps its scale, which where it
    /// mirrors mirrors the correction, too.
    pub fn turn(&mut self, correction: Quat) {
        let sign = self.scale.signum();
        let axis = sign.x * sign.y * sign.z * sign * correction.xyz();
        self.rotation = (self.rotation * Quat::from_xyzw(axis.x, axis.y, axis.z, correction.w)).normalize();
    }

    /// Takes a matrix apart. A mirrored one gets a negative x scale; shear is dropped; a singular one keeps
    /// its column lengths as scale and the nearest rotation there is.
    #[must_use]
    pub fn from_affine(affine: &DAffine3) -> Self {
        let (frame, lengths) = orthonormal(&affine.matrix3);
        let mirror = if frame.determinant() < 0.0 { DVec3::new(-1.0, 1.0, 1.0) } else { DVec3::ONE };
        let rotation = DQuat::from_mat3(&(frame * DMat3::from_diagonal(mirror))).normalize();
        Self {
            translation: affine.translation.as_vec3(),
            rotation: rotation.as_quat(),
            scale: (lengths * mirror).as_vec3(),
        }
    }
}

/// The nearest frame of unit vectors at right angles (columns), and the column lengths. The sign of the
/// determinant is kept; where a column vanishes the frame is completed, and as a last resort the identity.
pub(crate) fn orthonormal(m: &DMat3) -> (DMat3, DVec3) {
    let columns = [m.x_axis, m.y_axis, m.z_axis];
    let lengths = DVec3::from_array(columns.map(DVec3::length));
    let mut unit = columns.map(DVec3::normalize_or_zero);
    for i in 0..3 {
        if unit[i] == DVec3::ZERO {
            unit[i] = unit[(i + 1) % 3].cross(unit[(i + 2) % 3]).normalize_or_zero();
        }
    }
    let mut frame = DMat3::from_cols_array_2d(&unit.map(|c| c.to_array()));
    if frame.determinant().abs() < 1e-6 || !frame.is_finite() {
        return (DMat3::IDENTITY, lengths);
    }
    // Polar decomposition by Newton's iteration: quadratic, and exact columns stay exact to rounding.
    for _ in 0..30 {
        let next = (frame + frame.inverse().transpose()) * 0.5;
        let change = (next - frame).to_cols_array().iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        frame = next;
        if change < 1e-15 {
            break;
        }
    }
    (frame, lengths)
}

/// The signed coordinate axis nearest to a direction.
pub(crate) fn nearest_axis(v: DVec3) -> DVec3 {
    let at = v.abs().max_position();
    DVec3::AXES[at] * if v[at] < 0.0 { -1.0 } else { 1.0 }
}

/// A column-major glTF matrix as an affine map; the last row is taken as (0, 0, 0, 1).
pub(crate) fn affine_of(columns: &[f64; 16]) -> DAffine3 {
    DAffine3::from_mat4(DMat4::from_cols_array(columns))
}
