//! [`Region`]: neighbouring joints of one part of the body, which share a turn.

use core::f32::consts::PI;

use glam::{Vec3A, Vec4, Vec4Swizzles};

use super::body::Body;
use super::glide::Pair;
use super::range::Range;
use crate::kinematics::bearing::Bearings;
use crate::limits::Interval;
use crate::math;
use crate::math::Bounded;
use crate::{Budget, JointInfo, Role};

/// Accelerations beyond this make no difference any more, rad/s².
const MOST_RAD_S2: f32 = 1e6;

/// Neighbouring joints of one part of the body: a head with its neck, a chest, joints without a role.
#[derive(Clone, Copy, Debug)]
pub(super) struct Region {
    /// The outermost joint and the innermost one.
    pub(super) outer: usize,
    pub(super) inner: usize,
    /// Heading and elevation of the outermost joint's forward in the animation.
    pub(super) animated: Pair,
    /// The outermost joint's animated forward in its own frame and in the innermost one's.
    pub(super) own_forward: Vec3A,
    pub(super) forward: Vec3A,
    /// The sums that the joints' ranges allow, and the budget in this pose.
    pub(super) lo: Pair,
    pub(super) hi: Pair,
    /// The sums of the joints' compliances.
    pub(super) compliance: Pair,
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
        animated: Vec4::ZERO,
        own_forward: Vec3A::X,
        forward: Vec3A::X,
        lo: Vec4::ZERO,
        hi: Vec4::ZERO,
        compliance: Vec4::ZERO,
        rate: 0.0,
        acceleration: 0.0,
        pace: 0.0,
        approach: 0.0,
    };

    /// The part of the region's turn that a joint makes.
    pub(super) fn share(&self, info: &JointInfo) -> Pair {
        let own = compliance(info);
        Vec4::select(own.cmpgt(Vec4::ZERO), own / self.compliance, Vec4::ZERO)
    }

    /// The room of one axis.
    pub(super) fn room(&self, axis: usize) -> Interval {
        Interval::from_ends(self.lo[axis], self.hi[axis])
    }
}

/// What a joint gives way of each of its angles: 1/stiffness, 0 for an angle that it does not have.
#[inline(always)]
fn compliance(info: &JointInfo) -> Pair {
    let stiffness = if info.stiffness > 0.0 { info.stiffness.at_least(1e-6).at_most(1e6) } else { 1.0 };
    let per_stiffness = 1.0 / stiffness;
    let of = |range: Option<[f32; 2]>| if range.is_some() { per_stiffness } else { 0.0 };
    Vec4::new(of(info.heading), of(info.pitch), 0.0, 0.0)
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
    ranges: &[Range<'_>],
    bearings: &Bearings,
    outermost: usize,
    regions: &mut [Region],
) -> usize {
    let (rig, infos) = (body.rig, body.rig.joints);
    let mut count = 0;
    let mut next = body.count;
    while next > outermost {
        let inner = next - 1;
        let role = part(&infos[inner]);
        let region = &mut regions[count];
        let (mut rate, mut declared) = (0.0, 0.0_f32);
        while next > outermost && part(&infos[next - 1]) == role {
            next -= 1;
            let info = &infos[next];
            region.compliance += compliance(info);
            region.lo += ranges[next].lo;
            region.hi += ranges[next].hi;
            rate += info.rate.at_least(0.0);
            if info.acceleration > declared && info.acceleration < f32::INFINITY {
                declared = info.acceleration;
            }
        }
        (region.outer, region.inner) = (next, inner);
        let budget = rig.budget(role);
        region.rate = rate.at_most(budget.rate);
        region.acceleration = if declared > 0.0 { declared } else { budget.acceleration }.at_most(MOST_RAD_S2);
        region.pace = pace(region.acceleration);
        // From its full speed the region is to come to rest with this acceleration.
        region.approach = region.rate.at_most(3.5 * region.acceleration / region.pace);
        region.own_forward = body.forward(next);
        count += 1;
    }
    let forwards = |region: &Region| body.frames[region.outer] * region.own_forward;
    for number in (0..count).step_by(2) {
        let other = (number + 1).min(count - 1);
        let [a, b] = [forwards(&regions[number]), forwards(&regions[other])];
        let angles = bearings.angles_of_both([a, b]);
        for (region, forward, angles) in [(other, b, angles.zwzw()), (number, a, angles)] {
            let region = &mut regions[region];
            region.animated = angles;
            if region.outer < region.inner {
                region.forward = body.rows[region.inner] * forward;
            }
        }
    }
    let mut inside = regions[0].animated;
    for region in &mut regions[..count] {
        // How far the animation turns the region out of what is inside it counts too.
        let turned = region.animated - inside;
        inside = region.animated;
        let turned = Vec4::new(math::wrap_pi(turned.x), turned.y, 0.0, 0.0);
        let Budget { heading: [right, left], pitch: [down, up], .. } = rig.budget(part(&infos[region.inner]));
        let least = (Vec4::new(right, down, 0.0, 0.0) - turned).min(Vec4::ZERO);
        let most = (Vec4::new(left, up, 0.0, 0.0) - turned).max(Vec4::ZERO);
        let (lo, hi) = (region.lo.max(least), region.hi.min(most));
        let is_room = lo.cmple(hi);
        let middle = (lo + hi) * 0.5;
        (region.lo, region.hi) = (Vec4::select(is_room, lo, middle), Vec4::select(is_room, hi, middle));
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
