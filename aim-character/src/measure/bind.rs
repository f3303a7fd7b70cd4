//! The bind pose in world space: the pose in which a skin was fitted, which is where bone axes mean something.
//!
//! Inverse bind matrices live in the mesh's own space, which glTF ties to nothing. One map per skin, world ← mesh,
//! is found from the joints: the one that most of them agree on, else the hips' made square with the skeleton's root (a rest
//! pose that is a frame of some walk turns the hips, and a skin is modelled upright).

use aim_runtime::glam::{DAffine3, DMat3, DVec3};

use crate::measure::frame::orthonormal;
use crate::measure::roles::{Role, Roles};
use aim_gltf::Skeleton;

/// Joints agree when their maps differ by less than this cosine of the turning angle (1°).
const SAME: f64 = 0.999_847_7;
/// A map this near to a right-angled one (20°) is taken to be right-angled.
const SQUARE: f64 = 0.939_692_6;
/// Joints tried as the one that most agree with.
const TRIED: usize = 64;

/// World ← node in the bind pose, for every node. A node no skin lists keeps its rest place relative to the nearest
/// ancestor that is listed, and its rest place altogether where there is none.
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
            // Only below a joint can bind and rest differ.
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

/// World ← mesh of one skin.
fn calibrate(
    skeleton: &Skeleton,
    listed: &[(usize, DAffine3)],
    rest: &[DAffine3],
    known: &[Option<DAffine3>],
    roles: &Roles,
) -> Option<DAffine3> {
    // A skin that shares a joint with one already placed goes where that joint is.
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
    // Upright in what carries the whole skeleton, wherever that is turned to.
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

/// Cosine of the angle between two frames of equal handedness; −1 and less where they mirror each other.
fn turn_cos(a: &DMat3, b: &DMat3) -> f64 {
    let trace = a.x_axis.dot(b.x_axis) + a.y_axis.dot(b.y_axis) + a.z_axis.dot(b.z_axis);
    (trace - 1.0) * 0.5
}

/// The nearest frame whose axes are ± coordinate axes.
fn nearest_square(m: &DMat3) -> DMat3 {
    let [x, y, z] = signed_permutation(&[m.x_axis, m.y_axis, m.z_axis], m.determinant() < 0.0);
    DMat3::from_cols(x, y, z)
}

/// The triple of distinct signed unit axes, mirrored or not, that fits three directions best together.
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
