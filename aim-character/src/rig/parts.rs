//! Shares of the joints in the regions of the body: head with neck, and trunk.

use crate::measure::BoneAxes;
use aim_codegen::Budget;
use aim_model::Role;
use aim_runtime::glam::DVec3;

/// Share of the turn of head and neck that the head makes on the neck's last bone. In a mammal's neck about half of the
/// turn is that of atlas and axis (White and Panjabi, *Clinical Biomechanics of the Spine*, 1990).
const HEAD_PART: f64 = 0.5;
/// Least length of a bone in the division of a region, as a share of the mean length.
const SHORTEST: f64 = 0.1;
/// Factor by which a bone's own pitch range exceeds its share of the region's, so that one bone can compensate for
/// another. A head that is turned aside nods by itself, because the neck would roll it; so does a head on a neck that
/// the animation has already bent. The region's budget bounds the sum.
///
/// Headings have no such factor: for the innermost region of a chain, the budget ignores how far the animation turns
/// it, whereas ranges counted from the bind pose do not.
const PITCH_SLACK: f64 = 2.0;
/// Factor by which a bone's own rate exceeds its share of the region's rate.
const RATE_SLACK: f64 = 1.25;
/// Least absolute value of the end of a range, radians: one that can be declared, however many bones a neck has.
const LEAST_END: f64 = 1.5 / 180.0 * core::f64::consts::PI;

/// A part of the body with a budget.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Region {
    /// Head and neck.
    Head,
    /// The bones of the trunk above the hips.
    Chest,
}

impl Region {
    /// Returns the region of a joint with this role; `None` for eyes and for joints without a role.
    pub(crate) fn of(role: Role) -> Option<Self> {
        match role {
            Role::Head | Role::Neck => Some(Self::Head),
            Role::Chest => Some(Self::Chest),
            Role::Eye | Role::None => None,
        }
    }

    /// Returns the stiffness of the region as a whole. The trunk is stiffer, so it moves last.
    pub(crate) fn stiffness(self) -> f64 {
        match self {
            Self::Head => 1.0,
            Self::Chest => 4.0,
        }
    }

    /// Returns the name of the region for a sentence.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Head => "head and neck",
            Self::Chest => "the chest",
        }
    }
}

/// Returns, for each joint of a chain from the effector inward, its share of its region's turn; 1 for joints of no
/// region.
///
/// The shares of a region add up to 1. Bones share in proportion to their lengths, except that a head has
/// [`HEAD_PART`].
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

/// Divides `part` among `joints` in proportion to their lengths.
fn share(joints: &[usize], part: f64, lengths: &[Option<f64>], parts: &mut [f64]) {
    let known: Vec<f64> = joints.iter().filter_map(|joint| lengths[*joint]).collect();
    let mean = known.iter().sum::<f64>() / known.iter().map(|_| 1.0).sum::<f64>();
    let length = |joint: &usize| match lengths[*joint] {
        // If no length is known, all joints have equal shares.
        Some(length) if mean > 0.0 => length.max(SHORTEST * mean) / mean,
        _ => 1.0,
    };
    let total: f64 = joints.iter().map(length).sum();
    for joint in joints {
        parts[*joint] = part * length(joint) / total;
    }
}

/// Returns the distance from each joint to the next one outward in the bind pose; `None` for the outermost joint and
/// for non-finite positions.
fn lengths(bones: &[&BoneAxes]) -> Vec<Option<f64>> {
    let place = |at: usize| -> DVec3 { bones[at].bind_world.translation };
    let outward = |at: usize| Some(place(at).distance(place(at.checked_sub(1)?))).filter(|length| length.is_finite());
    (0..bones.len()).map(outward).collect()
}

/// Returns the ranges and the rate of a joint that makes `part` of a budget's turn. Angles in radians.
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

/// Rounds an angle to whole degrees, or to tenths if it is below 5°.
fn whole(radians: f64) -> f64 {
    let degrees = radians.to_degrees();
    let steps = if degrees.abs() < 5.0 { 10.0 } else { 1.0 };
    ((degrees * steps).round() / steps).to_radians()
}
