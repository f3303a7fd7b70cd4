//! Right-angled frames in double precision.

use aim_gltf::Skeleton;
use aim_runtime::glam::{DAffine3, DMat3, DVec3};

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

/// The orthogonal part of what a node's parent is in the world; it may mirror. The identity for a root.
pub(crate) fn parent_frame(skeleton: &Skeleton, world: &[DAffine3], node: usize) -> DMat3 {
    skeleton.parents()[node].map_or(DMat3::IDENTITY, |parent| orthonormal(&world[parent].matrix3).0)
}
