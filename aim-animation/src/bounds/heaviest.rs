//! Finds the joint or bone with the largest weight at a point of a triangle.

use crate::mesh::Mesh;

/// Returns the key with the largest total weight at a point of a triangle; on a tie, the lowest.
///
/// `shares` are the point's barycentric coordinates. `key` maps a joint to the key under which its weight is summed,
/// such as its bone; joints mapped to `None` are ignored. At least one joint must have a key.
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
