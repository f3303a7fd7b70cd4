//! The parts of the body that several bones move together, and what each of those bones does of it.

use crate::measure::BoneAxes;
use aim_codegen::Budget;
use aim_model::Role;
use aim_runtime::glam::DVec3;

/// The part of the turn of head and neck that the head makes on the neck's last bone: of a mammal's neck, about half of the
/// turn is that of atlas and axis (White and Panjabi, *Clinical Biomechanics of the Spine*, 1990).
const HEAD_PART: f64 = 0.5;
/// However short a bone is, it counts as this part of the mean of its region.
const SHORTEST: f64 = 0.1;
/// A bone's own pitches, relative to its part of its region's, so that one bone may make up for another: a head that is turned
/// aside nods by itself, as a neck would roll it, and so does a head on a neck that the animation has bent already. The region's
/// budget bounds their sum. Headings have no slack: of a chain's innermost region the budget does not know how far the animation
/// turns it, but ranges that count from the bind pose do.
const PITCH_SLACK: f64 = 2.0;
/// The same of its rate.
const RATE_SLACK: f64 = 1.25;
/// The least end of a range to either side, radians: one that can be declared, of however many bones a neck has.
const LEAST_END: f64 = 1.5 / 180.0 * core::f64::consts::PI;

/// A part of the body that has a budget.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Region {
    /// Head and neck.
    Head,
    /// The bones of the trunk above the hips.
    Chest,
}

impl Region {
    /// The region of a joint of that role; eyes, and joints without a role, are of none.
    pub(crate) fn of(role: Role) -> Option<Self> {
        match role {
            Role::Head | Role::Neck => Some(Self::Head),
            Role::Chest => Some(Self::Chest),
            Role::Eye | Role::None => None,
        }
    }

    /// The stiffness of the region as a whole: the trunk is the last to move.
    pub(crate) fn stiffness(self) -> f64 {
        match self {
            Self::Head => 1.0,
            Self::Chest => 4.0,
        }
    }

    /// Its name in a sentence.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Head => "head and neck",
            Self::Chest => "the chest",
        }
    }
}

/// The part of its region's turn that each joint of a chain (from the effector inward) makes; 1 for joints of no region. The
/// parts of a region add up to 1: neighbours share by their bones' lengths, but a head has [`HEAD_PART`].
pub(crate) fn parts(roles: &[Role], bones: &[&BoneAxes]) -> Vec<f64> {
    let lengths = lengths(bones);
    let mut parts = vec![1.0; roles.len()];
    for region in [Region::Head, Region::Chest] {
        let of_region = |role: &Role| Region::of(*role) == Some(region);
        let all: Vec<usize> = (0..roles.len()).filter(|joint| of_region(&roles[*joint])).collect();
        let (heads, others): (Vec<usize>, Vec<usize>) = all.into_iter().partition(|joint| roles[*joint] == Role::Head);
        let of_heads = match (heads.is_empty(), others.is_empty()) {
            (false, false) => HEAD_PART,
            (false, true) => 1.0,
            _ => 0.0,
        };
        for (joints, part) in [(heads, of_heads), (others, 1.0 - of_heads)] {
            share(&joints, part, &lengths, &mut parts);
        }
    }
    parts
}

/// Shares `part` among `joints` by their lengths.
fn share(joints: &[usize], part: f64, lengths: &[Option<f64>], parts: &mut [f64]) {
    let known: Vec<f64> = joints.iter().filter_map(|joint| lengths[*joint]).collect();
    let mean = known.iter().sum::<f64>() / known.iter().map(|_| 1.0).sum::<f64>();
    let length = |joint: &usize| match lengths[*joint] {
        // Without any length all are alike.
        Some(length) if mean > 0.0 => length.max(SHORTEST * mean) / mean,
        _ => 1.0,
    };
    let total: f64 = joints.iter().map(length).sum();
    for joint in joints {
        parts[*joint] = part * length(joint) / total;
    }
}

/// The distance from each joint to the next one outward, in the bind pose; unknown of the outermost, and of places that are no
/// numbers.
fn lengths(bones: &[&BoneAxes]) -> Vec<Option<f64>> {
    let place = |at: usize| -> DVec3 { bones[at].bind_world.translation };
    let outward = |at: usize| Some(place(at).distance(place(at.checked_sub(1)?))).filter(|length| length.is_finite());
    (0..bones.len()).map(outward).collect()
}

/// Ranges and rate of a joint that makes `part` of a budget's turn. Angles in radians.
pub(crate) fn of_budget(budget: &Budget, part: f64) -> Budget {
    let with_slack = |slack: f64| (part * slack).min(1.0);
    let range = |ends: [f64; 2], part: f64| ends.map(|end| whole(end * part).abs().max(LEAST_END).copysign(end));
    Budget {
        heading: range(budget.heading, part),
        pitch: range(budget.pitch, with_slack(PITCH_SLACK)),
        rate: whole(budget.rate * with_slack(RATE_SLACK)),
        acceleration: budget.acceleration,
    }
}

/// To whole degrees, where there are five or more; else to tenths.
fn whole(radians: f64) -> f64 {
    let degrees = radians.to_degrees();
    let steps = if degrees.abs() < 5.0 { 10.0 } else { 1.0 };
    ((degrees * steps).round() / steps).to_radians()
}
