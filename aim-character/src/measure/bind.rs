//! The bind pose in world space: the pose in which the skin was fitted, in which bone axes are meaningful.
//!
//! Inverse bind matrices refer to the mesh's own space, which glTF does not relate to the world. For each skin, one map
//! world ← mesh is found from its joints: the map on which most of them agree. If no majority agrees, the map of the
//! hips is used, snapped to the nearest right-angled orientation relative to the skeleton's root: a rest pose taken
//! from a walk turns the hips, whereas skins are modelled upright.

use aim_runtime::glam::{DAffine3, DMat3, DVec3};

use crate::measure::frame::orthonormal;
use crate::measure::roles::{Role, Roles};
use aim_gltf::Skeleton;

/// Cosine of the largest rotation (1°) between the maps of two joints that agree.
const SAME: f64 = 0.999_847_7;
/// Cosine of the largest rotation (20°) between a map and the nearest right-angled one for which the latter is used.
const SQUARE: f64 = 0.939_692_6;
/// Number of joints whose maps are tried as the majority's.
const TRIED: usize = 64;

/// Returns world ← node in the bind pose, for every node. A node that no skin lists keeps its rest transform relative
/// to its nearest listed ancestor, or its rest transform in the world if it has none.
pub(crate) fn bind_world(skeleton: &Skeleton, rest: &[DAffine3], roles: &Roles) -> Vec<DAffine3> {
    let mut bind: Vec<Option<DAffine3>> = vec![None; skeleton.len()];
    for index in 0..skeleton.skin_count() {
        let (joints, inverse) = skeleton.skin(index);
        let listed: Vec<(usize, DAffine3)> =
            joints.iter().zip(inverse).filter_map(|(j, m)| Some((*j, (*m)?))).collect();
        let Some(world_of_mesh) = calibrate(skeleton, &listed, rest, &bind, roles) else {
            continue;
        };
        for (joint, inverse) in &listed {
            bind[*joint].get_or_insert(world_of_mesh * inverse.inverse());
        }
    }
    let mut out = rest.to_vec();
    for node in 0..skeleton.len() {
        let inherited = || {
            let parent = skeleton.parents()[node]?;
            // Bind and rest poses can differ only below a joint.
            if out[parent] == rest[parent] || rest[parent].matrix3.determinant().abs() < 1e-30 {
                return None;
            }
            Some(out[parent] * rest[parent].inverse() * rest[node])
        };
        if let Some(known) = bind[node].or_else(inherited).filter(DAffine3::is_finite) {
            out[node] = known;
        }
    }
    out
}

/// Returns world ← mesh of one skin; `None` if the skin has no inverse bind matrices.
fn calibrate(
    skeleton: &Skeleton,
    listed: &[(usize, DAffine3)],
    rest: &[DAffine3],
    known: &[Option<DAffine3>],
    roles: &Roles,
) -> Option<DAffine3> {
    // A skin that shares a joint with a skin already placed is placed by that joint.
    if let Some((joint, inverse)) = listed.iter().find(|(joint, _)| known[*joint].is_some()) {
        return known[*joint].map(|world| world * *inverse);
    }
    let maps: Vec<DAffine3> = listed.iter().map(|(joint, inverse)| rest[*joint] * *inverse).collect();
    let frames: Vec<DMat3> = maps.iter().map(|m| orthonormal(&m.matrix3).0).collect();
    let agreeing = |a: &DMat3| frames.iter().filter(|b| turn_cos(a, b) > SAME).count();
    let best = (0..frames.len()).take(TRIED).max_by_key(|i| (agreeing(&frames[*i]), frames.len() - i))?;
    if agreeing(&frames[best]) * 2 >= frames.len() {
        return Some(maps[best]);
    }
    let with_role = |role: Role| listed.iter().position(|(joint, _)| roles.of(*joint) == Some(role));
    let reference =
        with_role(Role::Hips).or_else(|| with_role(Role::Spine)).or_else(|| with_role(Role::Head)).unwrap_or(0);
    let (frame, map) = (frames[reference], maps[reference]);
    // Upright relative to the node that carries the whole skeleton, whatever its orientation.
    let joint = listed[reference].0;
    let carrier = skeleton.ancestry(joint).find(|node| !skeleton.nodes()[*node].is_joint);
    let upright = carrier.map_or(DMat3::IDENTITY, |node| orthonormal(&rest[node].matrix3).0);
    let square = upright * nearest_square(&(upright.transpose() * frame));
    if turn_cos(&frame, &square) < SQUARE {
        return Some(map);
    }
    let scale = orthonormal(&map.matrix3).1.element_sum() / 3.0;
    let (joint, inverse) = &listed[reference];
    let mesh_point = inverse.inverse().translation;
    let matrix3 = square * scale;
    Some(DAffine3 { matrix3, translation: rest[*joint].translation - matrix3 * mesh_point })
}

/// Returns the cosine of the angle between two frames of equal handedness, or at most 0 if their handedness differs.
fn turn_cos(a: &DMat3, b: &DMat3) -> f64 {
    let trace = a.x_axis.dot(b.x_axis) + a.y_axis.dot(b.y_axis) + a.z_axis.dot(b.z_axis);
    (trace - 1.0) * 0.5
}

/// Returns the nearest frame whose axes are signed coordinate axes.
fn nearest_square(m: &DMat3) -> DMat3 {
    let [x, y, z] = signed_permutation(&[m.x_axis, m.y_axis, m.z_axis], m.determinant() < 0.0);
    DMat3::from_cols(x, y, z)
}

/// Returns the triple of different signed coordinate axes of the given handedness that fits the three directions best,
/// by the sum of cosines.
pub(crate) fn signed_permutation(directions: &[DVec3; 3], mirrored: bool) -> [DVec3; 3] {
    const ORDERS: [([usize; 3], f64); 6] =
        [([0, 1, 2], 1.0), ([1, 2, 0], 1.0), ([2, 0, 1], 1.0), ([0, 2, 1], -1.0), ([2, 1, 0], -1.0), ([1, 0, 2], -1.0)];
    let mut best = (f64::NEG_INFINITY, DVec3::AXES);
    for (order, parity) in ORDERS {
        for signs in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
            // The third sign follows from the handedness.
            let third = signs[0] * signs[1] * parity * if mirrored { -1.0 } else { 1.0 };
            let axes =
                [DVec3::AXES[order[0]] * signs[0], DVec3::AXES[order[1]] * signs[1], DVec3::AXES[order[2]] * third];
            let fit: f64 = axes.iter().zip(directions).map(|(a, d)| a.dot(*d)).sum();
            if fit > best.0 + 1e-9 {
                best = (fit, axes);
            }
        }
    }
    best.1
}
