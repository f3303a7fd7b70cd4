//! The limbs that a body stands on, and the kind of body that follows from them.

use aim_model::BoneName;
use aim_runtime::glam::DVec3;

use crate::measure::arms::has_named_limbs;
use crate::measure::clues::Body;
use crate::measure::facing::{Facing, has_head_ahead_of_hips};
use crate::measure::roles::carrying;
use crate::num::count;

/// Largest height of feet (and forefeet), as a share of the character's height.
const FOOT: f64 = 0.15;
/// Least distance of feet from the middle, as a share of that of the outermost foot.
const ASIDE: f64 = 0.15;
/// Least distance by which forelegs begin ahead of hind legs, as a share of the limbs' height; larger than that of a
/// coat's hem.
const AHEAD: f64 = 0.4;
/// Words in the names of bones that only birds have.
const BIRD_WORDS: &str = "wing wings feather feathers beak";

/// A kind of body with its own region budgets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum BodyKind {
    /// Upright, or unknown.
    Human,
    /// On all fours, or with a level trunk.
    Quadruped,
    /// With wings instead of arms.
    Bird,
}

impl BodyKind {
    /// Classifies the body:
    ///
    /// - A quadruped if limbs stand on the ground well ahead of others.
    /// - Otherwise a bird if no names reveal arms, and either names reveal wings, feathers or a beak, or it stands on
    ///   nothing and its span exceeds its length and twice its height.
    /// - Otherwise a quadruped if its head lies ahead of its hips.
    /// - Otherwise a human.
    pub(crate) fn find(body: &Body<'_>, facing: &Facing, standing: &[Limb]) -> Self {
        if is_on_all_fours(standing) {
            return Self::Quadruped;
        }
        let names = || body.skeleton.names().iter().zip(body.is_bone).filter(|(_, is_bone)| **is_bone);
        let has_wings = || names().any(|(name, _)| BoneName::new(name).has(BIRD_WORDS));
        let [span, length, height] = [facing.left, facing.forward, facing.up].map(|axis| {
            let (low, high) = range(body, axis);
            high - low
        });
        let flies = standing.is_empty() && span > length && span > 2.0 * height;
        if !has_named_limbs(body.skeleton) && (flies || has_wings()) {
            Self::Bird
        } else if has_head_ahead_of_hips(&facing.evidence) {
            Self::Quadruped
        } else {
            Self::Human
        }
    }
}

/// A limb that reaches the ground.
pub(crate) struct Limb {
    /// First bone of the limb.
    root: usize,
    /// `true` if its feet are on the character's left.
    is_left: bool,
    /// Position of its first bone along the character's forward.
    ahead: f64,
    /// Height of its first bone above the lowest bone of the body.
    height: f64,
}

/// Returns the limbs that reach the ground: the largest subtrees with feet on one side only.
pub(crate) fn standing_limbs(body: &Body<'_>, facing: &Facing) -> Vec<Limb> {
    let along = |node: usize, axis: DVec3| body.bind[node].translation.dot(axis);
    let (low, high) = range(body, facing.up);
    let is_low = |node: &usize| along(*node, facing.up) < low + FOOT * (high - low);
    let feet: Vec<usize> = (0..body.bind.len()).filter(|node| body.is_bone[*node]).filter(is_low).collect();
    let middle = feet.iter().map(|foot| along(*foot, facing.left)).sum::<f64>() / count(feet.len().max(1));
    let aside = |foot: usize| along(foot, facing.left) - middle;
    let outermost = feet.iter().map(|foot| aside(*foot).abs()).fold(0.0, f64::max);
    // For each bone, whether it carries feet on the right and on the left.
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

/// Returns `true` if on each side one limb begins well ahead of another.
fn is_on_all_fours(limbs: &[Limb]) -> bool {
    [false, true].into_iter().all(|is_left| {
        let limbs = || limbs.iter().filter(|limb| limb.is_left == is_left);
        let (back, front) = ends(limbs().map(|limb| limb.ahead));
        let height = limbs().map(|limb| limb.height).fold(0.0, f64::max);
        front - back > AHEAD * height
    })
}

/// Returns, for each node, whether it carries a leg: one recognised by name, or one of `limbs`.
pub(crate) fn carry_legs(body: &Body<'_>, limbs: &[Limb]) -> Vec<bool> {
    let mut is_leg = body.named_legs();
    limbs.iter().for_each(|limb| is_leg[limb.root] = true);
    carrying(body.skeleton, &is_leg)
}

/// Returns the least and the largest position of a bone along an axis.
fn range(body: &Body<'_>, axis: DVec3) -> (f64, f64) {
    let bones = body.bind.iter().zip(body.is_bone).filter(|(_, is_bone)| **is_bone);
    ends(bones.map(|(bind, _)| bind.translation.dot(axis)).filter(|place| place.is_finite()))
}

/// Returns the least and the largest of some numbers.
fn ends(numbers: impl Iterator<Item = f64>) -> (f64, f64) {
    numbers.fold((f64::MAX, f64::MIN), |(low, high), number| (low.min(number), high.max(number)))
}
