//! Orthonormal frames in double precision.

use aim_gltf::Skeleton;
use aim_runtime::glam::{DAffine3, DMat3, DVec3};

/// Returns the nearest orthonormal matrix, and the lengths of the columns. The sign of the determinant is kept. A
/// column of zero length is replaced by the cross product of the others; if the matrix is still singular or not finite,
/// the result is the identity.
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
    // Polar decomposition by Newton's iteration X ← (X + X⁻ᵀ) / 2: quadratic convergence; orthonormal input is kept to
    // rounding.
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

/// Returns the signed coordinate axis nearest to a direction.
pub(crate) fn nearest_axis(v: DVec3) -> DVec3 {
    let at = v.abs().max_position();
    DVec3::AXES[at] * if v[at] < 0.0 { -1.0 } else { 1.0 }
}

/// Returns the orthogonal part of the world matrix of a node's parent, which may mirror; the identity for a root.
pub(crate) fn parent_frame(skeleton: &Skeleton, world: &[DAffine3], node: usize) -> DMat3 {
    skeleton.parents()[node].map_or(DMat3::IDENTITY, |parent| orthonormal(&world[parent].matrix3).0)
}
