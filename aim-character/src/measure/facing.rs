//! The character's up, forward and left in the world, and the evidence for them.
//!
//! No single clue is trusted: names may be mirrored, a character may lie on its back. Each clue votes for a direction
//! with a weight, and the larger sum wins. Contradicting clues stay in the evidence, so that the user sees them.

use aim_runtime::glam::DVec3;

use crate::measure::clues::{self, Body, Clue, Hint};
use crate::measure::frame::nearest_axis;

/// The statement of one clue, in world space.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Evidence {
    /// Source of the evidence.
    pub clue: Clue,
    /// The character's up, if the clue gives one.
    pub up: Option<DVec3>,
    /// The character's forward, if the clue gives one; its sign is arbitrary if the clue cannot tell front from back.
    pub forward: Option<DVec3>,
    /// `true` if the measurement agrees with the clue.
    pub agrees: bool,
    /// Weight of the clue; for comparison, a pair of names has 2.
    pub weight: f64,
}

impl Evidence {
    fn ahead(clue: Clue, forward: DVec3, agrees: bool, weight: f64) -> Self {
        Self { clue, up: None, forward: Some(forward), agrees, weight }
    }
}

/// Orthonormal vectors in world space, with `forward = left × up`, and the evidence for them.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Facing {
    pub(crate) up: DVec3,
    pub(crate) forward: DVec3,
    pub(crate) left: DVec3,
    pub(crate) evidence: Vec<Evidence>,
}

/// Weight of names that have a side. No other clue outweighs it alone; most pairs of agreeing clues do.
const NAMES: f64 = 2.0;
/// Weight of names on mirrored bones. A mirror may have exchanged left and right, so every other clue but the soles
/// outweighs them.
const MIRRORED_NAMES: f64 = 0.9;
/// Weight of a clue that reveals the axis between the sides, but not which side is which.
const AXIS: f64 = 0.5;
/// Factor of the confidence if only a pair of similar limbs reveals the sides.
const BY_LIMBS: f64 = 0.9;
/// Factor of the confidence if only the positions of the joints reveal the sides.
const BY_SYMMETRY: f64 = 0.6;
/// Cosine between a clue and the forward axis below which the clue does not vote for front or back.
const ASIDE: f64 = 0.3;
/// Sine of the angle (0.006°) within which a direction is snapped to a coordinate axis.
const ROUNDING: f64 = 1e-4;
/// The same tolerance, 0.1°, for axes between limbs or joints that are only similar to each other.
const HAND_MADE: f64 = 2e-3;
/// Cosine of the largest angle (30°) between the legs and a coordinate axis at which that axis may replace +Y as up.
const STRAIGHT: f64 = 0.866;

/// Directions in the world that the user states. They overrule all clues.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Stated {
    /// The character's up, if stated, of any length but 0.
    pub up: Option<DVec3>,
    /// The character's forward, if stated. Its component along up is ignored.
    pub forward: Option<DVec3>,
}

impl Facing {
    /// Finds the facing from the clues and the user's statements. A statement without a direction is ignored: zero, not
    /// finite, or a forward along up.
    pub(crate) fn find(body: &Body<'_>, stated: Stated) -> Self {
        let mut evidence = Vec::new();
        let up = match stated.up.and_then(DVec3::try_normalize) {
            Some(up) => {
                evidence.push(Evidence {
                    clue: Clue::Stated,
                    up: Some(up),
                    forward: None,
                    agrees: true,
                    weight: NAMES,
                });
                up
            }
            None => up(body, &mut evidence),
        };
        let level = |forward: DVec3| forward.reject_from_normalized(up);
        let facing = Self::weigh_clues(body, up, evidence);
        match stated.forward.map(level).filter(|level| level.length() > 1e-6) {
            Some(forward) => facing.with_stated_forward(forward.normalize()),
            None => facing,
        }
    }

    /// Replaces the forward direction and marks which evidence agrees with it.
    fn with_stated_forward(mut self, forward: DVec3) -> Self {
        for item in &mut self.evidence {
            let sign = if matches!(item.clue, Clue::Limbs { .. } | Clue::Symmetry) { f64::abs } else { |cos| cos };
            item.agrees =
                item.forward.map_or(item.agrees, |forward_of_clue| sign(forward_of_clue.dot(forward)) > ASIDE);
        }
        self.evidence.push(Evidence::ahead(Clue::Stated, forward, true, NAMES));
        Self { forward, left: self.up.cross(forward), ..self }
    }

    /// Finds the facing of a body whose up is known.
    fn weigh_clues(body: &Body<'_>, up: DVec3, mut evidence: Vec<Evidence>) -> Self {
        let mut hints = clues::ahead(body, up);
        let pair = clues::named_pair(body, up).map(|(left, right)| (Clue::Names { left, right }, [left, right]));
        let limbs = || {
            let [one, other] = body.plan.as_ref()?.legs;
            Some((Clue::Limbs { one, other }, [one, other]))
        };
        let across = pair.or_else(limbs).map(|(clue, [a, b])| (clue, clues::apart(body, a, b, up)));
        let across = across.or_else(|| Some((Clue::Symmetry, clues::mirror_axis(body, up)?)));
        // Joints may also mirror each other front to back. Reject a symmetry axis if the other clues point along it
        // rather than across it.
        let is_plausible = |(clue, left): &(Clue, DVec3)| {
            let lies = |axis: DVec3| hints.iter().map(|hint| hint.weight * along(hint.ahead, axis).abs()).sum::<f64>();
            *clue != Clue::Symmetry || lies(left.normalize_or_zero()) <= lies(left.cross(up).normalize_or_zero())
        };
        let (across, rejected_symmetry) = match across {
            Some(across) if !is_plausible(&across) => (None, Some(across.1)),
            across => (across, None),
        };
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
                // glTF's convention decides a tie.
                let keep = if score == 0.0 { ahead.dot(convention(up)) >= -1e-9 } else { score > 0.0 };
                let forward = if keep { ahead } else { -ahead };
                let voted = if named.is_some() { ahead } else { forward };
                let agrees = keep || named.is_none();
                evidence.push(Evidence::ahead(clue, voted, agrees, named.unwrap_or(AXIS)));
                forward
            }
            None => match hints.iter().max_by(|a, b| a.weight.total_cmp(&b.weight)) {
                // Without a plane of symmetry a direction is accurate only to some degrees, so snap it to an axis.
                Some(hint) => upright(nearest_axis(hint.ahead), up).unwrap_or(hint.ahead),
                None => convention(up),
            },
        };
        for Hint { clue, ahead, weight } in hints {
            evidence.push(Evidence::ahead(clue, ahead, along(ahead, forward) > 0.0, weight));
        }
        if let Some(left) = rejected_symmetry {
            evidence.push(Evidence::ahead(Clue::Symmetry, left.cross(up).normalize_or_zero(), false, AXIS));
        }
        if !evidence.iter().any(|item| item.agrees && distinguishes_front_from_back(item)) {
            evidence.push(Evidence::ahead(Clue::Convention, forward, true, 0.25));
        }
        Self { up, forward, left: up.cross(forward), evidence }
    }

    /// Returns the confidence in the facing, 0…1: the share of the evidence that agrees on which way is front. It is
    /// low if there is little evidence, and reduced if only similar limbs or symmetry reveal the sides.
    pub(crate) fn confidence(&self) -> f64 {
        let has_agreeing = |clue: fn(&Clue) -> bool| self.evidence.iter().any(|item| item.agrees && clue(&item.clue));
        if has_agreeing(|clue| *clue == Clue::Stated)
            && self.evidence.iter().any(|item| item.clue == Clue::Stated && item.forward.is_some())
        {
            return 1.0;
        }
        let weight = |agrees: bool| {
            let evidence = self.evidence.iter().filter(|item| item.agrees == agrees && item.forward.is_some());
            // A clue that reveals only the axis between the sides counts if it contradicts, but is no evidence for a
            // front.
            evidence.filter(|item| !agrees || distinguishes_front_from_back(item)).map(|item| item.weight).sum::<f64>()
        };
        let sides = if has_agreeing(|clue| matches!(clue, Clue::Symmetry)) {
            BY_SYMMETRY
        } else if has_agreeing(|clue| matches!(clue, Clue::Limbs { .. })) {
            BY_LIMBS
        } else {
            1.0
        };
        sides * weight(true) / (weight(true) + weight(false) + 0.5)
    }
}

/// Returns `true` if a clue distinguishes front from back, rather than only giving the axis between the sides.
fn distinguishes_front_from_back(evidence: &Evidence) -> bool {
    evidence.forward.is_some() && !matches!(evidence.clue, Clue::Limbs { .. } | Clue::Symmetry)
}

/// Returns `true` if the head lies ahead of the hips rather than above them.
pub(crate) fn has_head_ahead_of_hips(evidence: &[Evidence]) -> bool {
    evidence.iter().any(|item| item.clue == Clue::Trunk && item.agrees)
}

/// Returns +Y, unless the legs clearly stand along another axis.
fn up(body: &Body<'_>, evidence: &mut Vec<Evidence>) -> DVec3 {
    let Some(legs) = clues::legs_up(body) else { return DVec3::Y };
    let axis = nearest_axis(legs);
    let up = if axis.dot(legs) > STRAIGHT { axis } else { DVec3::Y };
    let agrees = up.dot(legs) > 0.5;
    evidence.push(Evidence { clue: Clue::Legs, up: Some(legs), forward: None, agrees, weight: 1.0 });
    up
}

/// Returns the forward direction of glTF's convention for a model whose up is `up`: +Z, rotated by the rotation from +Y
/// to `up`.
fn convention(up: DVec3) -> DVec3 {
    match up.z {
        z if z > 0.9 => DVec3::NEG_Y,
        z if z < -0.9 => DVec3::Y,
        _ => DVec3::Z,
    }
}

/// Returns the sign of the cosine, or 0 for a direction that is mostly across the axis.
fn along(direction: DVec3, axis: DVec3) -> f64 {
    let cos = direction.dot(axis);
    if cos.abs() < ASIDE { 0.0 } else { cos.signum() }
}

fn upright(direction: DVec3, up: DVec3) -> Option<DVec3> {
    (direction.dot(up).abs() < 1e-9).then_some(direction)
}

/// Snaps a direction to the nearest coordinate axis if the sine of the angle between them is below `sine`.
fn square(direction: DVec3, sine: f64) -> DVec3 {
    let axis = nearest_axis(direction);
    if axis.cross(direction).length() < sine { axis } else { direction }
}
