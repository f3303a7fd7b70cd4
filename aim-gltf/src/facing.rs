//! The character's up, forward and left in the world, and by what they were found.

use glam::{DAffine3, DVec3};

use crate::names::{Side, Words};
use crate::skeleton::Skeleton;

/// What told where the character faces.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Evidence {
    /// A pair of nodes named left and right.
    Pair {
        /// Node index.
        left: usize,
        /// Node index.
        right: usize,
    },
    /// No such names: the plane of symmetry of the joints, and which way the feet point.
    Shape,
    /// Nothing: glTF says that models face +Z.
    Convention,
}

/// Right-angled unit vectors in world space; `forward = left × up`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Facing {
    pub(crate) up: DVec3,
    pub(crate) forward: DVec3,
    pub(crate) left: DVec3,
    pub(crate) evidence: Evidence,
}

impl Facing {
    fn from_left(left: DVec3, evidence: Evidence) -> Self {
        let up = DVec3::Y;
        Self { up, forward: left.cross(up), left, evidence }
    }

    /// From the bind pose (world ← node), the nodes that are bones, and the skin in the same pose.
    pub(crate) fn find(skeleton: &Skeleton, bind: &[DAffine3], bones: &[bool], skin: &[DVec3]) -> Self {
        if let Some((left, right)) = limb_pair(skeleton, bind, bones) {
            let across = DVec3 { y: 0.0, ..bind[left].translation - bind[right].translation };
            return Self::from_left(square(across.normalize_or(DVec3::X)), Evidence::Pair { left, right });
        }
        let joints: Vec<usize> = (0..bind.len()).filter(|i| skeleton.nodes()[*i].is_joint).collect();
        match shape(skeleton, bind, &joints, skin) {
            Some(left) => Self::from_left(left, Evidence::Shape),
            None => Self::from_left(DVec3::X, Evidence::Convention),
        }
    }
}

/// A direction within rounding (0.006°) of a coordinate axis is that axis.
fn square(direction: DVec3) -> DVec3 {
    let axis = DVec3::AXES.into_iter().find(|axis| axis.cross(direction).length() < 1e-4);
    axis.map_or(direction, |axis| axis * axis.dot(direction).signum())
}

/// Pairs that tell the sides best, best first; arms belong to the part of the body that aims.
const KINDS: [&str; 15] = [
    "upperarm", "arm", "shoulder", "clavicle", "collar", "thigh", "upleg", "upperleg", "leg", "eye", "hand", "foot",
    "knee", "ankle", "toe",
];

fn limb_pair(skeleton: &Skeleton, bind: &[DAffine3], bones: &[bool]) -> Option<(usize, usize)> {
    let nodes = skeleton.nodes();
    let apart = |l: usize, r: usize| {
        let d = bind[l].translation - bind[r].translation;
        d.is_finite() && d.length() < 1e100 && d.x.hypot(d.z) > 1e-6 && d.x.hypot(d.z) > 0.2 * d.y.abs()
    };
    let vrm = |bone: &str| nodes.iter().position(|node| node.vrm_bone.as_deref() == Some(bone));
    if let (Some(l), Some(r)) = (vrm("leftUpperArm"), vrm("rightUpperArm")) {
        if apart(l, r) {
            return Some((l, r));
        }
    }
    let sided: Vec<(usize, Side, String)> = (0..nodes.len())
        .filter(|i| bones[*i])
        .filter_map(|i| {
            let words = Words::of(&nodes[i].name);
            Some((i, words.side?, words.key()))
        })
        .collect();
    KINDS.iter().find_map(|kind| {
        let of = |wanted: Side| sided.iter().filter(move |(_, side, key)| *side == wanted && key.contains(kind));
        of(Side::Left).find_map(|(left, _, key)| {
            let (right, ..) = of(Side::Right).find(|(right, _, other)| other == key && apart(*left, *right))?;
            Some((*left, *right))
        })
    })
}

/// Left from geometry alone: the horizontal axis along which the joints mirror, its sign from the feet.
fn shape(skeleton: &Skeleton, bind: &[DAffine3], joints: &[usize], skin: &[DVec3]) -> Option<DVec3> {
    if joints.len() < 5 || joints.len() > 4096 {
        return None;
    }
    let at: Vec<DVec3> = joints.iter().map(|i| bind[*i].translation).collect();
    let (low, high) = at.iter().fold((f64::MAX, f64::MIN), |(lo, hi), p| (lo.min(p.y), hi.max(p.y)));
    let size = high - low;
    if size <= 0.0 || !size.is_finite() {
        return None;
    }
    let along_x = asymmetry(&at, DVec3::X, size);
    let along_z = asymmetry(&at, DVec3::Z, size);
    // Both small: no joint is off the middle. Alike: nothing learnt.
    let (across, ahead) = match (along_x, along_z) {
        (Some(x), Some(z)) if x > 2.0 * z => (DVec3::Z, DVec3::X),
        (Some(x), Some(z)) if z > 2.0 * x => (DVec3::X, DVec3::Z),
        (Some(_), None) => (DVec3::X, DVec3::Z),
        (None, Some(_)) => (DVec3::Z, DVec3::X),
        _ => return None,
    };
    // Toes lie ahead of ankles.
    let mut ahead_sum = 0.0;
    for &joint in joints {
        let position = bind[joint].translation;
        if let Some(parent) = skeleton.nodes()[joint].parent.filter(|p| joints.contains(p)) {
            if position.y < low + 0.12 * size && bind[parent].translation.y < low + 0.2 * size {
                ahead_sum += (position - bind[parent].translation).dot(ahead);
            }
        }
    }
    if ahead_sum.abs() < 0.01 * size {
        // Without toes: soles reach further ahead of the ankles than behind them.
        let ground = skin.iter().map(|p| p.y).fold(f64::MAX, f64::min);
        let soles = skin.iter().filter(|p| p.y < ground + 0.04 * size).map(|p| p.dot(ahead));
        let (back, front) = soles.fold((f64::MAX, f64::MIN), |(lo, hi), v| (lo.min(v), hi.max(v)));
        let ankles: Vec<f64> = at.iter().filter(|p| p.y < low + 0.05 * size).map(|p| p.dot(ahead)).collect();
        if back > front || ankles.is_empty() {
            return None;
        }
        ahead_sum = (back + front) * 0.5 - ankles.iter().sum::<f64>() / crate::num::count(ankles.len());
        if ahead_sum.abs() < 0.005 * size {
            return None;
        }
    }
    let forward = ahead * ahead_sum.signum();
    // left = up × forward. Whichever axis was found, the cross product gives its sign.
    let left = DVec3::Y.cross(forward);
    debug_assert!(left.dot(across).abs() > 0.99, "across and ahead are the two horizontal axes");
    Some(left)
}

/// How far the joints are from mirroring along `axis`, relative to how far they spread along it; `None` without spread.
fn asymmetry(at: &[DVec3], axis: DVec3, size: f64) -> Option<f64> {
    let (low, high) = at.iter().map(|p| p.dot(axis)).fold((f64::MAX, f64::MIN), |(lo, hi), v| (lo.min(v), hi.max(v)));
    if high - low < 0.05 * size {
        return None;
    }
    let middle = (high + low) * 0.5;
    let mirrored = |p: &DVec3| *p + axis * 2.0 * (middle - p.dot(axis));
    let miss = |p: &DVec3| at.iter().map(|q| q.distance(mirrored(p))).fold(f64::MAX, f64::min);
    let total: f64 = at.iter().map(miss).sum();
    Some(total / crate::num::count(at.len()) / size)
}
