//! [`BodyPart`]: the declared data of neighbouring joints that share a turn in a natural gaze.

use core::f32::consts::PI;

use glam::Vec4;

use super::JointInfo;
use crate::{Budget, Budgets, Role};

/// Number of joints of most rigs (an eye, a head, a chest). Chains of exactly this capacity have this count, so the
/// compiler knows the length of loops over joints. In a natural gaze of such a chain, an eye leads and each other joint
/// is a body part of its own ([`Description::is_eye_head_chest`]), so the compiler knows their indices too.
pub(crate) const EXACT_JOINTS: usize = 3;
/// Upper bound on accelerations, rad/s²; larger ones make no visible difference.
const MOST_RAD_S2: f32 = 1e6;
/// Number of parts for which a description has room. A rig with more has its parts computed in each call.
pub(crate) const MOST_PARTS: usize = 4;

/// Neighbouring joints of one body part: a head with its neck, a chest, joints without a role. Pairs of heading and
/// pitch are in the first two lanes of vectors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyPart {
    /// Index of the outermost joint.
    pub(crate) outer: usize,
    /// Index of the innermost joint.
    pub(crate) inner: usize,
    /// Sums of the joints' compliances.
    pub(crate) compliance: Vec4,
    /// Ends of the budget: right and down.
    pub(crate) least: Vec4,
    /// Ends of the budget: left and up.
    pub(crate) most: Vec4,
    /// Largest speed of the sums of angles, rad/s.
    pub(crate) rate: f32,
    /// Largest acceleration of the sums of angles, rad/s².
    pub(crate) acceleration: f32,
    /// Rate at which the offset from the goal decays, 1/s.
    pub(crate) pace: f32,
    /// Largest speed at which the offset from the goal decays, rad/s.
    pub(crate) approach: f32,
}

impl BodyPart {
    /// Returns the outermost and the innermost joint of part `number` of a chain with capacity `C`, from the innermost
    /// part outward.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn ends<const C: usize>(&self, number: usize) -> [usize; 2] {
        if C == EXACT_JOINTS { [C - 1 - number; 2] } else { [self.outer, self.inner] }
    }

    pub(crate) const NONE: Self = Self {
        outer: 0,
        inner: 0,
        compliance: Vec4::ZERO,
        least: Vec4::ZERO,
        most: Vec4::ZERO,
        rate: 0.0,
        acceleration: 0.0,
        pace: 0.0,
        approach: 0.0,
    };

    /// Finds the parts of a body whose joint `first` is aimed, from the innermost outward. An eye that leads belongs to
    /// no part. Returns the number of parts, which may exceed the length of `parts`.
    pub(crate) const fn find(joints: &[JointInfo], first: usize, budgets: &Budgets, parts: &mut [Self]) -> usize {
        let mut count = 0;
        let mut next = joints.len();
        let has_eye = first + 1 < next && matches!(joints[first].role, Role::Eye);
        let outermost = if has_eye { first + 1 } else { first };
        while next > outermost {
            let part = Self::ending_at(joints, next - 1, outermost, budgets);
            if count < parts.len() {
                parts[count] = part;
            }
            next = part.outer;
            count += 1;
        }
        count
    }

    /// Returns the part whose innermost joint is `inner`.
    const fn ending_at(joints: &[JointInfo], inner: usize, outermost: usize, budgets: &Budgets) -> Self {
        let role = part_of(&joints[inner]);
        let Budget { heading: [right, left], pitch: [down, up], rate: fastest, acceleration } = budget(budgets, role);
        let (mut rate, mut declared, mut sum) = (0.0, 0.0_f32, [0.0; 2]);
        let mut outer = inner + 1;
        while outer > outermost && part_of(&joints[outer - 1]) as u8 == role as u8 {
            outer -= 1;
            let info = &joints[outer];
            let own = info.compliance();
            sum = [sum[0] + own[0], sum[1] + own[1]];
            if info.rate > 0.0 {
                rate += info.rate;
            }
            if info.acceleration > declared && info.acceleration < f32::INFINITY {
                declared = info.acceleration;
            }
        }
        let acceleration = lesser(if declared > 0.0 { declared } else { acceleration }, MOST_RAD_S2);
        let rate = lesser(rate, fastest);
        let pace = pace(acceleration);
        Self {
            outer,
            inner,
            compliance: Vec4::new(sum[0], sum[1], 0.0, 0.0),
            least: Vec4::new(right, down, 0.0, 0.0),
            most: Vec4::new(left, up, 0.0, 0.0),
            rate,
            acceleration,
            pace,
            // Chosen so that the part can stop from its full speed with this acceleration.
            approach: lesser(rate, 3.5 * acceleration / pace),
        }
    }
}

/// Returns the budget of the body part that a role belongs to. An eye and a joint without a role have the head's
/// acceleration, without bounds on angles and rate.
pub(super) const fn budget(budgets: &Budgets, role: Role) -> Budget {
    const ALL: [f32; 2] = [f32::NEG_INFINITY, f32::INFINITY];
    match role {
        Role::Head | Role::Neck => budgets.head,
        Role::Chest => budgets.chest,
        Role::Eye | Role::None => Budget { heading: ALL, pitch: ALL, rate: f32::INFINITY, ..budgets.head },
    }
}

/// Returns the role that stands for a joint's body part. An eye that does not lead counts as a joint without a role.
const fn part_of(info: &JointInfo) -> Role {
    match info.role {
        Role::Neck => Role::Head,
        Role::Eye => Role::None,
        role => role,
    }
}

/// Returns the smaller of number and bound; the bound if the number is NaN.
const fn lesser(number: f32, bound: f32) -> f32 {
    if number < bound { number } else { bound }
}

/// Returns the rate at which a region's offset from its goal decays, 1/s.
///
/// A movement over an angle s with speed s·(ωt)²/2·e^(−ωt) needs an acceleration of at most 0.23·ω²·s. A human's
/// 1200°/s² corresponds to 11.5/s, with which 95 % of any movement takes half a second.
const fn pace(acceleration: f32) -> f32 {
    const HUMAN: f32 = 11.5;
    const HUMAN_RAD_S2: f32 = 1200.0 * PI / 180.0;
    let square = (acceleration / HUMAN_RAD_S2) as f64;
    if !(square > 1e-12) {
        return 1e-3;
    }
    // Newton's iteration from half the exponent, because square roots are not available in constants.
    let mut root = f64::from_bits((square.to_bits() >> 1) + 0x1ff8_0000_0000_0000);
    let mut round = 0;
    while round < 4 {
        root = 0.5 * (root + square / root);
        round += 1;
    }
    #[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is meant")]
    let pace = HUMAN * root as f32;
    if pace > 1e-3 { pace } else { 1e-3 }
}
