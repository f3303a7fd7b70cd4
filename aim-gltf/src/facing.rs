//! The character's up, forward and left in the world, and by what they were found.
//!
//! No single clue is believed: names may be mirrored, a file may lie on its back. Each clue says a direction and has a
//! weight; the heavier side wins, and what contradicts it stays in the evidence for the user to see.

use glam::DVec3;

use crate::clues::{self, Body, Clue, Hint};
use crate::trs::nearest_axis;

/// The statement of one clue, in world space.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Evidence {
    /// The source.
    pub clue: Clue,
    /// The character's up, if it speaks of that.
    pub up: Option<DVec3>,
    /// The character's forward, if it speaks of that; of either sign where the clue cannot tell.
    pub forward: Option<DVec3>,
    /// True if the measurement follows it.
    pub agrees: bool,
    /// Its weight; a pair of names has 2.
    pub weight: f64,
}

impl Evidence {
    fn ahead(clue: Clue, forward: DVec3, agrees: bool, weight: f64) -> Self {
        Self { clue, up: None, forward: Some(forward), agrees, weight }
    }
}

/// Right-angled unit vectors in world space; `forward = left × up`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Facing {
    pub(crate) up: DVec3,
    pub(crate) forward: DVec3,
    pub(crate) left: DVec3,
    pub(crate) evidence: Vec<Evidence>,
}

/// Names of sides outweigh any other single clue, and no two that agree.
const NAMES: f64 = 2.0;
/// Under a mirror left may have become right; any clue of the body knows better.
const MIRRORED_NAMES: f64 = 0.9;
/// A clue across the plane of symmetry says nothing about which way forward is (cosine).
const ASIDE: f64 = 0.3;
/// Sines of angles at which a direction is taken for an axis: 0.006°, and 0.1° for legs that only resemble each other.
const ROUNDING: f64 = 1e-4;
const HAND_MADE: f64 = 2e-3;
/// Legs within this of a coordinate axis (cosine of 30°) may say that another axis than +Y is up.
const STRAIGHT: f64 = 0.866;

impl Facing {
    pub(crate) fn find(body: &Body<'_>) -> Self {
        let mut evidence = Vec::new();
        let up = up(body, &mut evidence);
        let mut hints = clues::ahead(body, up);
        let pair = clues::named_pair(body, up).map(|(left, right)| (Clue::Names { left, right }, [left, right]));
        let limbs = || {
            let [one, other] = body.plan.as_ref()?.legs;
            Some((Clue::Limbs { one, other }, [one, other]))
        };
        let across = pair.or_else(limbs).map(|(clue, [a, b])| (clue, clues::apart(body, a, b, up)));
        let across = across.or_else(|| Some((Clue::Symmetry, clues::mirror_axis(body, up)?)));
        let forward = match across {
            Some((clue, left)) => {
                let named = match clue {
                    Clue::Names { left, right } if clues::is_mirrored(body, left, right) => Some(MIRRORED_NAMES),
                    Clue::Names { .. } => Some(NAMES),
                    _ => None,
                };
                let left = square(left.normalize_or(DVec3::X), if named.is_some() { ROUNDING } else { HAND_MADE });
                let ahead = square(left.cross(up), ROUNDING);
                if !hints.iter().any(|hint| hint.clue == Clue::Feet) {
                    hints.extend(clues::soles(body, up, ahead));
                }
                let vote = |hint: &Hint| hint.weight * along(hint.ahead, ahead);
                let score: f64 = named.unwrap_or(0.0) + hints.iter().map(vote).sum::<f64>();
                // A tie is glTF's to decide.
                let keep = if score == 0.0 { ahead.dot(convention(up)) >= -1e-9 } else { score > 0.0 };
                let forward = if keep { ahead } else { -ahead };
                let says = if named.is_some() { ahead } else { forward };
                let agrees = keep || named.is_none();
                evidence.push(Evidence::ahead(clue, says, agrees, named.unwrap_or(0.5)));
                forward
            }
            None => match hints.iter().max_by(|a, b| a.weight.total_cmp(&b.weight)) {
                // Without a plane of symmetry a direction is no better than to some degrees.
                Some(hint) => upright(nearest_axis(hint.ahead), up).unwrap_or(hint.ahead),
                None => convention(up),
            },
        };
        for Hint { clue, ahead, weight } in hints {
            evidence.push(Evidence::ahead(clue, ahead, ahead.dot(forward) > 0.0, weight));
        }
        if evidence.iter().all(|said| said.forward.is_none()) {
            evidence.push(Evidence::ahead(Clue::Convention, forward, true, 0.25));
        }
        Self { up, forward, left: up.cross(forward), evidence }
    }

    /// Confidence in the facing: the share of the evidence that agrees, 0…1; low if there is little evidence.
    pub(crate) fn confidence(&self) -> f64 {
        let weight = |agrees: bool| {
            let said = self.evidence.iter().filter(|said| said.agrees == agrees && said.forward.is_some());
            said.map(|said| said.weight).sum::<f64>()
        };
        weight(true) / (weight(true) + weight(false) + 0.5)
    }
}

/// Whether the trunk lies level and leads ahead.
pub(crate) fn go_on_all_fours(evidence: &[Evidence]) -> bool {
    evidence.iter().any(|said| said.clue == Clue::Trunk && said.agrees)
}

/// +Y unless the legs plainly stand along another axis.
fn up(body: &Body<'_>, evidence: &mut Vec<Evidence>) -> DVec3 {
    let Some(legs) = clues::legs_up(body) else { return DVec3::Y };
    let axis = nearest_axis(legs);
    let up = if axis.dot(legs) > STRAIGHT { axis } else { DVec3::Y };
    let agrees = up.dot(legs) > 0.5;
    evidence.push(Evidence { clue: Clue::Legs, up: Some(legs), forward: None, agrees, weight: 1.0 });
    up
}

/// The forward of glTF's convention for a model whose up is `up`: +Z, turned by the turn from +Y to `up`.
fn convention(up: DVec3) -> DVec3 {
    match up.z {
        z if z > 0.9 => DVec3::NEG_Y,
        z if z < -0.9 => DVec3::Y,
        _ => DVec3::Z,
    }
}

/// 1, −1, or 0 for a direction that is rather across.
fn along(direction: DVec3, axis: DVec3) -> f64 {
    let cos = direction.dot(axis);
    if cos.abs() < ASIDE { 0.0 } else { cos.signum() }
}

fn upright(direction: DVec3, up: DVec3) -> Option<DVec3> {
    (direction.dot(up).abs() < 1e-9).then_some(direction)
}

/// A direction within `sine` of a coordinate axis is that axis.
fn square(direction: DVec3, sine: f64) -> DVec3 {
    let axis = nearest_axis(direction);
    if axis.cross(direction).length() < sine { axis } else { direction }
}
