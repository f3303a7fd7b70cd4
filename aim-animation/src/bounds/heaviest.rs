//! Which joint moves a point of a triangle most.

use crate::mesh::Mesh;

/// The joint that moves a point of a triangle most, of equals the lowest; `shares` are those of the corners.
pub(super) fn heaviest(mesh: &Mesh, corners: &[u32; 3], shares: [f32; 3]) -> usize {
    let influences = || {
        let of = |(corner, share): (&u32, f32)| {
            mesh.influences(*corner as usize).iter().map(move |influence| (influence.joint, influence.weight * share))
        };
        corners.iter().zip(shares).flat_map(of)
    };
    let total = |joint: u32| influences().filter(|other| other.0 == joint).map(|other| other.1).sum::<f32>();
    let mut best = (u32::MAX, -1.0);
    for (joint, _) in influences() {
        let total = total(joint);
        if total > best.1 || (total == best.1 && joint < best.0) {
            best = (joint, total);
        }
    }
    best.0 as usize
}
