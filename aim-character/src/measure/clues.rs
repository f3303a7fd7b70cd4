//! Clues to the direction a body faces, one from each of its parts. `facing.rs` weighs them.

use aim_model::{BoneName, Side};
use std::collections::HashMap;

use aim_runtime::glam::{DAffine3, DVec3};

use crate::measure::plan::BodyPlan;
use crate::measure::roles::{Role, Roles};
use crate::num::count;
use aim_gltf::Skeleton;

/// A character in its bind pose.
pub(crate) struct Body<'a> {
    pub(crate) skeleton: &'a Skeleton,
    /// World ← node.
    pub(crate) bind: &'a [DAffine3],
    pub(crate) is_bone: &'a [bool],
    /// Vertices in world space.
    pub(crate) skin: &'a [DVec3],
    /// For each vertex, the node that moves it most.
    pub(crate) carriers: &'a [usize],
    pub(crate) roles: &'a Roles,
    pub(crate) plan: Option<BodyPlan>,
}

/// A source of evidence about the character's up or forward.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Clue {
    /// A pair of nodes that are left and right by name or VRM.
    Names {
        /// Node index of the left one.
        left: usize,
        /// Node index of the right one.
        right: usize,
    },
    /// A pair of limbs with the same shape of subtree in mirrored positions; which one is left is unknown.
    Limbs {
        /// Node index of one limb.
        one: usize,
        /// Node index of the other limb.
        other: usize,
    },
    /// The positions of the joints mirror each other.
    Symmetry,
    /// Legs reach down from the hips.
    Legs,
    /// Toes lie ahead of ankles.
    Feet,
    /// Soles reach further ahead of ankles than behind them.
    Soles,
    /// Eyes lie ahead of the head's joint.
    Eyes,
    /// The head of a four-legged animal lies ahead of its hips, or of its tail if no hips are known.
    Trunk,
    /// A barrel, a lens or a lamp shade extends in the direction it points.
    Reach {
        /// Node index of that part.
        node: usize,
    },
    /// The convention of glTF: +Y is up and models face +Z.
    Convention,
    /// A statement of the user.
    Stated,
}

/// A level direction in which some part lies ahead of another.
pub(crate) struct Hint {
    pub(crate) clue: Clue,
    pub(crate) ahead: DVec3,
    pub(crate) weight: f64,
}

impl Body<'_> {
    fn at(&self, node: usize) -> DVec3 {
        self.bind[node].translation
    }

    fn with_role(&self, role: Role) -> Option<usize> {
        (0..self.bind.len()).find(|node| self.roles.of(*node) == Some(role))
    }

    fn parent(&self, node: usize) -> Option<usize> {
        self.skeleton.parents()[node]
    }

    /// Returns the bones whose names have a side, each with the rest of its name as a key.
    fn sided(&self) -> Vec<(usize, Side, String)> {
        let sided = |node: usize| {
            let words = BoneName::new(&self.skeleton.names()[node]);
            Some((node, words.side?, words.key()))
        };
        (0..self.bind.len()).filter(|node| self.is_bone[*node]).filter_map(sided).collect()
    }

    /// Returns, for each node, whether its name is that of a part of a leg.
    pub(crate) fn named_legs(&self) -> Vec<bool> {
        let mut legs = vec![false; self.bind.len()];
        for (node, _, key) in self.sided() {
            legs[node] = LEGS.iter().any(|leg| key.contains(leg));
        }
        legs
    }

    fn joints(&self) -> Vec<usize> {
        (0..self.bind.len()).filter(|i| self.skeleton.nodes()[*i].is_joint && self.at(*i).is_finite()).collect()
    }
}

/// Name parts of the pairs that reveal the sides best, best first. Arms come first because they belong to the part of
/// the body that aims. The empty string at the end matches any name with a side.
const KINDS: [&str; 16] = [
    "upperarm", "arm", "shoulder", "clavicle", "collar", "thigh", "upleg", "upperleg", "leg", "eye", "hand", "foot",
    "knee", "ankle", "toe", "",
];
const LEGS: [&str; 8] = ["thigh", "leg", "calf", "shin", "knee", "ankle", "foot", "hip"];
const TOES: [&str; 2] = ["toe", "ball"];

/// Height of the joints, as a share of their largest level distance, below which a body has no feet: a fish, or a bird
/// in flight.
const FLAT: f64 = 0.1;

/// Largest number of nodes with the same name that are tried as the counterpart of one node; bounds the work for any
/// file.
const MOST_NAMESAKES: usize = 16;

/// Returns the vector from `b` to `a` without its component along `up`.
pub(crate) fn apart(body: &Body<'_>, a: usize, b: usize, up: DVec3) -> DVec3 {
    (body.at(a) - body.at(b)).reject_from_normalized(up)
}

/// Returns `true` if both bones of a pair are mirrored.
pub(crate) fn is_mirrored(body: &Body<'_>, a: usize, b: usize) -> bool {
    [a, b].into_iter().all(|node| body.bind[node].matrix3.determinant() < 0.0)
}

/// Returns the left and the right node of the named pair of limbs that reveals the sides best.
pub(crate) fn named_pair(body: &Body<'_>, up: DVec3) -> Option<(usize, usize)> {
    let nodes = body.skeleton.nodes();
    let is_apart = |l: usize, r: usize| {
        let (d, level) = (body.at(l) - body.at(r), apart(body, l, r, up).length());
        d.is_finite() && d.length() < 1e100 && level > 1e-6 && level > 0.2 * d.dot(up).abs()
    };
    let vrm = |bone: &str| nodes.iter().position(|node| node.vrm_bone.as_deref() == Some(bone));
    if let (Some(l), Some(r)) = (vrm("leftUpperArm"), vrm("rightUpperArm")) {
        if is_apart(l, r) {
            return Some((l, r));
        }
    }
    let sided = body.sided();
    let mut rights: HashMap<&str, Vec<usize>> = HashMap::new();
    for (node, _, key) in sided.iter().filter(|(_, side, _)| *side == Side::Right) {
        rights.entry(key).or_default().push(*node);
    }
    KINDS.iter().find_map(|kind| {
        let lefts = sided.iter().filter(|(_, side, key)| *side == Side::Left && key.contains(kind));
        lefts.into_iter().find_map(|(left, _, key)| {
            // Numbering may run in opposite orders on the two sides: take the counterpart whose depth in the tree is
            // closest.
            let namesakes = rights.get(key.as_str())?.iter().take(MOST_NAMESAKES).copied();
            let depth = |node: usize| body.skeleton.ancestry(node).take(MOST_NAMESAKES * 8).count();
            let near = |right: &usize| depth(*right).abs_diff(depth(*left));
            namesakes.filter(|right| is_apart(*left, *right)).min_by_key(near).map(|right| (*left, right))
        })
    })
}

/// Returns the direction from the feet to the hips, if there are legs that do not point towards the head.
pub(crate) fn legs_up(body: &Body<'_>) -> Option<DVec3> {
    let (sided, is_leg) = (body.sided(), body.named_legs());
    let named = sided.iter().filter_map(|(node, ..)| {
        let parent = body.parent(*node)?;
        (is_leg[*node] && is_leg[parent]).then(|| body.at(parent) - body.at(*node))
    });
    let mut legs: DVec3 = named.sum();
    if legs.length() < 1e-9 {
        let ways = body.plan.as_ref()?.ways_down(body.skeleton, body.bind, body.is_bone);
        legs = ways.iter().filter_map(|way| Some(body.at(*way.first()?) - body.at(*way.last()?))).sum();
    }
    let up = Some(legs.normalize_or_zero()).filter(|up| up.is_finite() && *up != DVec3::ZERO)?;
    // Limbs that point towards the head are not legs.
    let (hips, head) = ends(body);
    let along = hips.zip(head).map_or(0.0, |(hips, head)| (body.at(head) - body.at(hips)).dot(up));
    (along >= 0.0).then_some(up)
}

/// Returns the hips and the head (or a neck bone if no head is named).
fn ends(body: &Body<'_>) -> (Option<usize>, Option<usize>) {
    let plan = body.plan.as_ref();
    let hips = body.with_role(Role::Hips).or_else(|| plan.map(|plan| plan.hips));
    let named = [Role::Head, Role::Neck].into_iter().find_map(|role| body.with_role(role));
    (hips, named.or_else(|| plan.map(|plan| plan.head)))
}

/// Returns the first bone whose name is that of a tail, unless it is hair on the head.
fn tail(body: &Body<'_>) -> Option<usize> {
    let names = body.skeleton.names();
    let is_on_head = |node: usize| body.skeleton.ancestry(node).any(|at| body.roles.of(at) == Some(Role::Head));
    (0..names.len()).find(|node| body.is_bone[*node] && BoneName::new(&names[*node]).has("tail") && !is_on_head(*node))
}

/// Returns the hints of all parts that lie ahead of others.
pub(crate) fn ahead(body: &Body<'_>, up: DVec3) -> Vec<Hint> {
    let hint = |clue: Clue, direction: DVec3, weight: f64| {
        let ahead = direction.reject_from_normalized(up).normalize_or_zero();
        (ahead.is_finite() && ahead != DVec3::ZERO).then_some(Hint { clue, ahead, weight })
    };
    let level = |v: DVec3| v.reject_from_normalized(up).length();
    let mut hints = Vec::new();
    let (hips, head) = ends(body);
    if let (Some(hips), Some(head)) = (hips.or_else(|| tail(body)), head) {
        let trunk = body.at(head) - body.at(hips);
        if level(trunk) > 0.8 * trunk.length() {
            hints.extend(hint(Clue::Trunk, trunk, 2.0));
        }
    }
    let roles = [Role::LeftEye, Role::RightEye, Role::Head].map(|role| body.with_role(role));
    if let [Some(left), Some(right), Some(head)] = roles {
        let eyes = (body.at(left) + body.at(right)) * 0.5 - body.at(head);
        if level(eyes) > 0.25 * eyes.length() {
            hints.extend(hint(Clue::Eyes, eyes, 1.5));
        }
    }
    let (toes, weight) = named_toes(body).map_or_else(|| (low_joints(body, up), 1.0), |toes| (Some(toes), 1.5));
    if let Some(toes) = toes {
        hints.extend(hint(Clue::Feet, toes, weight));
    }
    if hints.is_empty() {
        if let Some((node, reach)) = reach(body).filter(|(_, reach)| level(*reach) > 0.5 * reach.length()) {
            hints.extend(hint(Clue::Reach { node }, reach, 1.0));
        }
    }
    hints
}

/// Returns the sum of the vectors from named ankles to named toes; `None` unless both feet have toes.
fn named_toes(body: &Body<'_>) -> Option<DVec3> {
    let is_leg = body.named_legs();
    let mut sum = [DVec3::ZERO; 2];
    for (node, side, key) in &body.sided() {
        let Some(parent) = body.parent(*node) else { continue };
        if TOES.iter().any(|toe| key.contains(toe)) && is_leg[parent] {
            sum[usize::from(*side == Side::Left)] += body.at(*node) - body.at(parent);
        }
    }
    // Both feet are required: one alone may be turned.
    (sum[0] != DVec3::ZERO && sum[1] != DVec3::ZERO).then(|| sum[0] + sum[1])
}

/// Returns the sum of the vectors from the parents of the lowest joints to those joints, if its level part is long
/// enough to be a direction.
fn low_joints(body: &Body<'_>, up: DVec3) -> Option<DVec3> {
    let joints = body.joints();
    if joints.len() < 5 {
        return None;
    }
    let height = |node: usize| body.at(node).dot(up);
    let (low, high) = joints.iter().fold((f64::MAX, f64::MIN), |(lo, hi), i| (lo.min(height(*i)), hi.max(height(*i))));
    let size = high - low;
    // If all joints lie low, all of them look like feet.
    let reach = joints.iter().map(|joint| apart(body, *joint, joints[0], up).length()).fold(0.0, f64::max);
    if size < FLAT * reach {
        return None;
    }
    let step = |joint: &usize| {
        let parent = body.parent(*joint).filter(|parent| body.skeleton.nodes()[*parent].is_joint)?;
        let is_foot = height(*joint) < low + 0.12 * size && height(parent) < low + 0.2 * size;
        is_foot.then(|| body.at(*joint) - body.at(parent))
    };
    let sum: DVec3 = joints.iter().filter_map(step).sum();
    (sum.reject_from_normalized(up).length() > 0.01 * size && size.is_finite()).then_some(sum)
}

/// Returns a hint for the direction, along `ahead` or against it, in which the soles reach further from the ankles.
pub(crate) fn soles(body: &Body<'_>, up: DVec3, ahead: DVec3) -> Option<Hint> {
    let joints = body.joints();
    let heights = joints.iter().map(|joint| body.at(*joint).dot(up));
    let (low, high) = heights.fold((f64::MAX, f64::MIN), |(lo, hi), h| (lo.min(h), hi.max(h)));
    let size = high - low;
    let ground = body.skin.iter().map(|p| p.dot(up)).fold(f64::MAX, f64::min);
    let soles = body.skin.iter().filter(|p| p.dot(up) < ground + 0.04 * size).map(|p| p.dot(ahead));
    let (back, front) = soles.fold((f64::MAX, f64::MIN), |(lo, hi), v| (lo.min(v), hi.max(v)));
    let ankles = joints.iter().map(|joint| body.at(*joint)).filter(|p| p.dot(up) < low + 0.05 * size);
    let ankles: Vec<f64> = ankles.map(|p| p.dot(ahead)).collect();
    if back > front || ankles.is_empty() {
        return None;
    }
    let reach = (back + front) * 0.5 - ankles.iter().sum::<f64>() / count(ankles.len());
    (reach.abs() > 0.005 * size && reach.is_finite()).then(|| Hint {
        clue: Clue::Soles,
        ahead: ahead * reach.signum(),
        weight: 0.75,
    })
}

/// Words in the names of parts that point in the direction of their shape.
const POINTERS: &str = "barrel muzzle gun cannon lens camera lamp shade spotlight lampshade";

/// Returns the first pointing part and the vector from its joint to the mean of its vertices and its children.
fn reach(body: &Body<'_>) -> Option<(usize, DVec3)> {
    let node = body.skeleton.names().iter().position(|name| BoneName::new(name).has(POINTERS))?;
    let on_it = body.skin.iter().zip(body.carriers).filter(|(_, carrier)| **carrier == node).map(|(p, _)| *p);
    let places: Vec<DVec3> = on_it.chain(body.skeleton.children(node).map(|child| body.at(child))).collect();
    let middle = places.iter().sum::<DVec3>() / count(places.len().max(1));
    let reach = middle - body.at(node);
    (!places.is_empty() && reach.is_finite() && reach.length() > 1e-9).then_some((node, reach))
}

/// Returns the level axis along which the joints mirror each other; `None` if both level axes qualify or neither does.
pub(crate) fn mirror_axis(body: &Body<'_>, up: DVec3) -> Option<DVec3> {
    let joints = body.joints();
    if joints.len() < 5 || joints.len() > 4096 {
        return None;
    }
    let at: Vec<DVec3> = joints.iter().map(|joint| body.at(*joint)).collect();
    let (low, high) = at.iter().map(|p| p.dot(up)).fold((f64::MAX, f64::MIN), |(lo, hi), h| (lo.min(h), hi.max(h)));
    let size = high - low;
    if size <= 0.0 || !size.is_finite() {
        return None;
    }
    let mut level = DVec3::AXES.into_iter().filter(|axis| axis.dot(up).abs() < 0.5);
    let [a, b] = [level.next()?, level.next()?];
    match (asymmetry(&at, a, size), asymmetry(&at, b, size)) {
        (Some(x), Some(y)) if x > 2.0 * y => Some(b),
        (Some(x), Some(y)) if y > 2.0 * x => Some(a),
        (Some(_), None) => Some(a),
        (None, Some(_)) => Some(b),
        _ => None,
    }
}

/// Returns the mean distance of the joints from the mirror image of the set along `axis`, as a share of `size`; `None`
/// if the joints hardly extend along `axis`.
fn asymmetry(at: &[DVec3], axis: DVec3, size: f64) -> Option<f64> {
    let (low, high) = at.iter().map(|p| p.dot(axis)).fold((f64::MAX, f64::MIN), |(lo, hi), v| (lo.min(v), hi.max(v)));
    if high - low < 0.05 * size {
        return None;
    }
    let middle = (high + low) * 0.5;
    let mirrored = |p: &DVec3| *p + axis * 2.0 * (middle - p.dot(axis));
    let miss = |p: &DVec3| at.iter().map(|q| q.distance(mirrored(p))).fold(f64::MAX, f64::min);
    let total: f64 = at.iter().map(miss).sum();
    Some(total / count(at.len()) / size)
}
