//! The joint or the bone that moves a point of a triangle most.

use crate::mesh::Mesh;

/// The joint, or whatever `key` counts joints as, that moves a point of a triangle most; of equals the lowest. `shares`
/// are those of the corners; joints without a key do not count, but there has to be one.
pub(super) fn heaviest(
    mesh: &Mesh,
    corners: &[u32; 3],
    shares: [f32; 3],
    key: impl Fn(u32) -> Option<usize> + Copy,
) -> usize {
    let influences = || {
        let of = move |(corner, share): (&u32, f32)| {
            let of_corner = mesh.influences(*corner as usize).iter();
            of_corner.filter_map(move |influence| Some((key(influence.joint)?, influence.weight * share)))
        };
        corners.iter().zip(shares).flat_map(of)
    };
    let total = |key: usize| influences().filter(|other| other.0 == key).map(|other| other.1).sum::<f32>();
    let mut best = (usize::MAX, -1.0);
    for (key, _) in influences() {
        let total = total(key);
        if total > best.1 || (total == best.1 && key < best.0) {
            best = (key, total);
        }
    }
    best.0
}
