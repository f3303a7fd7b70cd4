//! The limbs that a body stands on, and the kind of body that this makes it.

use aim_model::BoneName;
use aim_runtime::glam::DVec3;

use crate::measure::arms::has_named_limbs;
use crate::measure::clues::Body;
use crate::measure::facing::{Facing, is_led_by_head};
use crate::measure::roles::carrying;
use crate::num::count;

/// Feet, and the forefeet of who goes on all fours, are no higher than this part of the height.
const FOOT: f64 = 0.15;
/// Feet are further from the middle than this part of the distance of the outermost.
const ASIDE: f64 = 0.15;
/// Forelegs begin further ahead of hind legs than this part of their height: the hem of a coat does not.
const AHEAD: f64 = 0.4;
/// Words of what birds have.
const OF_BIRDS: &str = "wing wings feather feathers beak";

/// A kind of body that has budgets of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum BodyKind {
    /// Upright, or nothing tells.
    Human,
    /// On all fours, or with its trunk level.
    Quadruped,
    /// With wings instead of arms.
    Bird,
}

impl BodyKind {
    /// A quadruped where limbs stand on the ground far ahead of others. Else a bird where no names tell arms, and either names tell
    /// wings, feathers or a beak, or it stands on nothing and its span exceeds its length and twice its height. Else a quadruped
    /// where its head lies ahead of its hips. Else a human.
    pub(crate) fn find(body: &Body<'_>, facing: &Facing, standing: &[Limb]) -> Self {
        if is_on_all_fours(standing) {
            return Self::Quadruped;
        }
        let names = || body.skeleton.names().iter().zip(body.is_bone).filter(|(_, is_bone)| **is_bone);
        let has_wings = || names().any(|(name, _)| BoneName::new(name).has(OF_BIRDS));
        let [span, length, height] = [facing.left, facing.forward, facing.up].map(|axis| {
            let (low, high) = range(body, axis);
            high - low
        });
        let flies = standing.is_empty() && span > length && span > 2.0 * height;
        if !has_named_limbs(body.skeleton) && (flies || has_wings()) {
            Self::Bird
        } else if is_led_by_head(&facing.evidence) {
            Self::Quadruped
        } else {
            Self::Human
        }
    }
}

/// A limb that reaches down to the ground.
pub(crate) struct Limb {
    /// Its first bone.
    root: usize,
    /// True if its feet are on the character's left.
    is_left: bool,
    /// The place of its first bone along the character's forward.
    ahead: f64,
    /// The height of its first bone above the lowest one.
    height: f64,
}

/// The limbs that reach down to the ground: largest subtrees with feet of one side only.
pub(crate) fn standing_limbs(body: &Body<'_>, facing: &Facing) -> Vec<Limb> {
    let along = |node: usize, axis: DVec3| body.bind[node].translation.dot(axis);
    let (low, high) = range(body, facing.up);
    let is_low = |node: &usize| along(*node, facing.up) < low + FOOT * (high - low);
    let feet: Vec<usize> = (0..body.bind.len()).filter(|node| body.is_bone[*node]).filter(is_low).collect();
    let middle = feet.iter().map(|foot| along(*foot, facing.left)).sum::<f64>() / count(feet.len().max(1));
    let aside = |foot: usize| along(foot, facing.left) - middle;
    let outermost = feet.iter().map(|foot| aside(*foot).abs()).fold(0.0, f64::max);
    // For each bone, whether feet of the right and of the left hang on it.
    let mut sides = vec![[false; 2]; body.bind.len()];
    for foot in feet.into_iter().filter(|foot| aside(*foot).abs() > ASIDE * outermost) {
        sides[foot][usize::from(aside(foot) > 0.0)] = true;
    }
    let parent = |node: usize| body.skeleton.parents()[node];
    for node in (0..body.bind.len()).rev() {
        if let Some(parent) = parent(node) {
            let below = sides[node];
            sides[parent].iter_mut().zip(below).for_each(|(side, below)| *side |= below);
        }
    }
    let is_limb = |node: &usize| {
        sides[*node][0] != sides[*node][1] && parent(*node).is_none_or(|parent| sides[parent] == [true; 2])
    };
    let limbs = (0..body.bind.len()).filter(is_limb).filter(|node| !is_low(node));
    limbs
        .map(|root| Limb {
            root,
            is_left: sides[root][1],
            ahead: along(root, facing.forward),
            height: along(root, facing.up) - low,
        })
        .collect()
}

/// True if limbs of either side begin far ahead of others of that side.
fn is_on_all_fours(limbs: &[Limb]) -> bool {
    [false, true].into_iter().all(|is_left| {
        let limbs = || limbs.iter().filter(|limb| limb.is_left == is_left);
        let (back, front) = ends(limbs().map(|limb| limb.ahead));
        let height = limbs().map(|limb| limb.height).fold(0.0, f64::max);
        front - back > AHEAD * height
    })
}

/// For each node, whether a leg hangs on it, however deep: one that its name tells, or one of these.
pub(crate) fn carry_legs(body: &Body<'_>, limbs: &[Limb]) -> Vec<bool> {
    let mut is_leg = body.named_legs();
    limbs.iter().for_each(|limb| is_leg[limb.root] = true);
    carrying(body.skeleton, &is_leg)
}

/// The least and the largest place of a bone along an axis.
fn range(body: &Body<'_>, axis: DVec3) -> (f64, f64) {
    let bones = body.bind.iter().zip(body.is_bone).filter(|(_, is_bone)| **is_bone);
    ends(bones.map(|(bind, _)| bind.translation.dot(axis)).filter(|place| place.is_finite()))
}

/// The least and the largest of some numbers.
fn ends(numbers: impl Iterator<Item = f64>) -> (f64, f64) {
    numbers.fold((f64::MAX, f64::MIN), |(low, high), number| (low.min(number), high.max(number)))
}
