//! [`Region`]: neighbouring joints of one part of the body, which share a turn.

use core::f32::consts::PI;

use glam::Vec3A;

use super::body::Body;
use crate::kinematics::bearing::Bearings;
use crate::limits::{Interval, RangeOfMotion};
use crate::math;
use crate::math::Bounded;
use crate::{JointInfo, Role};

/// Accelerations beyond this make no difference any more, rad/s².
const MOST_RAD_S2: f32 = 1e6;

/// Neighbouring joints of one part of the body: a head with its neck, a chest, joints without a role.
///
/// Pairs are of heading and pitch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Region {
    /// The outermost joint and the innermost one.
    pub(super) outer: usize,
    pub(super) inner: usize,
    /// Heading and elevation of the outermost joint's forward in the animation.
    pub(super) animated: [f32; 2],
    /// The outermost joint's animated forward in the innermost one's frame.
    pub(super) forward: Vec3A,
    /// The sums that the joints' ranges allow, and the budget in this pose.
    pub(super) room: [Interval; 2],
    /// The sums of the joints' compliances.
    pub(super) compliance: [f32; 2],
    /// The largest speed and acceleration of the sums of angles.
    pub(super) rate: f32,
    pub(super) acceleration: f32,
    /// The rate at which its offset dies away, 1/s, and the largest speed at which it does.
    pub(super) pace: f32,
    pub(super) approach: f32,
}

impl Region {
    pub(super) const NONE: Self = Self {
        outer: 0,
        inner: 0,
        animated: [0.0; 2],
        forward: Vec3A::ZERO,
        room: [Interval::REST; 2],
        compliance: [0.0; 2],
        rate: 0.0,
        acceleration: 0.0,
        pace: 0.0,
        approach: 0.0,
    };

    /// The part of the region's turn that a joint makes.
    pub(super) fn share(&self, info: &JointInfo) -> [f32; 2] {
        let own = compliance(info);
        [0, 1].map(|axis| if own[axis] > 0.0 { own[axis] / self.compliance[axis] } else { 0.0 })
    }
}

/// What a joint gives way of each of its angles: 1/stiffness, 0 for an angle that it does not have.
fn compliance(info: &JointInfo) -> [f32; 2] {
    let stiffness = if info.stiffness > 0.0 { info.stiffness.at_least(1e-6).at_most(1e6) } else { 1.0 };
    [info.heading, info.pitch].map(|range| if range.is_some() { 1.0 / stiffness } else { 0.0 })
}

/// The part of the body that a joint belongs to. An eye that does not lead is none.
fn part(info: &JointInfo) -> Role {
    match info.role {
        Role::Neck => Role::Head,
        Role::Eye => Role::None,
        role => role,
    }
}

/// Finds the regions of a body, from the innermost to the one that ends with joint `outermost`, and how many there are.
#[inline(always)]
pub(super) fn regions<const C: usize>(
    body: &Body<'_, C>,
    motions: &[RangeOfMotion],
    bearings: &Bearings,
    outermost: usize,
    regions: &mut [Region],
) -> usize {
    let (rig, infos) = (body.rig, body.rig.joints);
    let mut count = 0;
    let mut next = body.count;
    let mut inside: Option<[f32; 2]> = None;
    while next > outermost {
        let inner = next - 1;
        let role = part(&infos[inner]);
        let budget = rig.budget(role);
        let region = &mut regions[count];
        let (mut rate, mut declared) = (0.0, 0.0_f32);
        let (mut heading, mut pitch) = ([0.0_f32; 2], [0.0_f32; 2]);
        while next > outermost && part(&infos[next - 1]) == role {
            next -= 1;
            let (info, motion) = (&infos[next], &motions[next]);
            let own = compliance(info);
            region.compliance = [region.compliance[0] + own[0], region.compliance[1] + own[1]];
            heading = [heading[0] + motion.heading.lo(), heading[1] + motion.heading.hi()];
            pitch = [pitch[0] + motion.pitch.lo(), pitch[1] + motion.pitch.hi()];
            rate += info.rate.at_least(0.0);
            if info.acceleration > declared && info.acceleration < f32::INFINITY {
                declared = info.acceleration;
            }
        }
        (region.outer, region.inner) = (next, inner);
        let forward = body.forwards[next];
        if next < inner {
            region.forward = body.frames[inner].transpose() * forward;
        }
        region.animated = bearings.angles(forward);
        // How far the animation turns the region out of what is inside it counts too.
        let [from_heading, from_pitch] = inside.unwrap_or(region.animated);
        inside = Some(region.animated);
        let turned = [math::wrap_pi(region.animated[0] - from_heading), region.animated[1] - from_pitch];
        let room = |[lo, hi]: [f32; 2], [least, most]: [f32; 2], turned: f32| {
            Interval::from_ends(lo.at_least((least - turned).at_most(0.0)), hi.at_most((most - turned).at_least(0.0)))
        };
        region.room = [room(heading, budget.heading, turned[0]), room(pitch, budget.pitch, turned[1])];
        region.rate = rate.at_most(budget.rate);
        region.acceleration = if declared > 0.0 { declared } else { budget.acceleration }.at_most(MOST_RAD_S2);
        region.pace = pace(region.acceleration);
        // From its full speed the region is to come to rest with this acceleration.
        region.approach = region.rate.at_most(3.5 * region.acceleration / region.pace);
        count += 1;
    }
    count
}

/// The rate at which a region's offset dies away, 1/s.
///
/// A way s of which the speed is s·(ωt)²/2·e^(−ωt) needs 0.23·ω²·s of acceleration at most; a human's 1200°/s² and 11.5/s go
/// together, so that 95 % of any way take half a second.
fn pace(acceleration: f32) -> f32 {
    const HUMAN: f32 = 11.5;
    const HUMAN_RAD_S2: f32 = 1200.0 * PI / 180.0;
    (HUMAN * math::sqrt(acceleration / HUMAN_RAD_S2)).at_least(1e-3)
}
