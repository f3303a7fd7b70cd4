//! [`Region`]: neighbouring joints of one body part, which share a turn.

use core::f32::consts::PI;

use glam::{Affine3A, Mat3A, Vec3A, Vec4, Vec4Swizzles};

use super::body::Body;
use super::glide::{Pair, pair};
use super::range::Range;
use crate::JointInfo;
use crate::kinematics::bearing::{Bearings, FORWARD_STEEP_RAD};
use crate::math::{self, Bounded, trig};
use crate::rig::BodyPart;

/// Returns the factor by which inner joints make less of a pitch when the head is turned out of them by β = `aside`,
/// radians: 1 + 8·β², which is 2 at 20°.
#[cfg_attr(not(aim_small), inline(always))]
pub(super) fn pitch_reduction(aside: f32) -> f32 {
    1.0 + 8.0 * aside * aside
}

/// Elevations, up or down, between which the measure of a steep region's front changes from its forward to its up.
const FACING_RAD: [f32; 2] = [FORWARD_STEEP_RAD, 60.0 * PI / 180.0];
/// Elevations, up or down, between which the heading range of a steep region shrinks to 0.
const LEVEL_AXIS_RAD: [f32; 2] = [45.0 * PI / 180.0, 75.0 * PI / 180.0];

/// Returns the position of `x` between `from` and `to`, clamped to 0…1.
fn ramp(x: f32, [from, to]: [f32; 2]) -> f32 {
    ((x - from) / (to - from)).at_least(0.0).at_most(1.0)
}

/// A body part in a pose.
#[derive(Clone, Copy, Debug)]
pub(super) struct Region<'a> {
    pub(super) part: &'a BodyPart,
    /// Heading and elevation of the outermost joint's forward in the animation.
    pub(super) animated: Pair,
    /// The outermost joint's animated forward in its own frame.
    pub(super) own_forward: Vec3A,
    /// The outermost joint's animated forward in the innermost joint's frame.
    pub(super) forward: Vec3A,
    /// The heading of `forward`, radians.
    ahead: f32,
    /// The shift of the budget by the pose.
    pub(super) budget_shift: Pair,
    /// The least turn: the sum of the joints' ranges, limited by the budget in this pose.
    pub(super) lo: Pair,
    /// The greatest turn: the sum of the joints' ranges, limited by the budget in this pose.
    pub(super) hi: Pair,
}

impl<'a> Region<'a> {
    /// Creates the region of a part before it is evaluated.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn of_part(part: &'a BodyPart) -> Self {
        Self {
            part,
            animated: Vec4::ZERO,
            own_forward: Vec3A::ZERO,
            forward: Vec3A::ZERO,
            ahead: 0.0,
            budget_shift: Vec4::ZERO,
            lo: Vec4::ZERO,
            hi: Vec4::ZERO,
        }
    }

    /// Returns the heading of a front whose forward is steep, taken from its up: at elevation ε the front is f·cos ε −
    /// u·sin ε.
    #[cold]
    #[inline(never)]
    fn facing(&self, frame: &Mat3A, bearings: &Bearings) -> f32 {
        let (sin, cos) = trig::sin_cos(self.animated.y);
        let front = bearings.angles(frame.x_axis * cos - frame.z_axis * sin);
        let off = math::wrap_pi(front.x - self.animated.x);
        self.animated.x + off * ramp(self.animated.y.abs(), FACING_RAD)
    }

    /// Returns the part of the heading range that remains. A steep region turns about a nearly level axis, which rolls
    /// the joints that it carries.
    #[cold]
    #[inline(never)]
    fn heading_range_factor(&self) -> f32 {
        1.0 - ramp(self.animated.y.abs(), LEVEL_AXIS_RAD)
    }

    /// Returns `true` if the forward is so steep that its heading is a poor measure of the front.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn is_steep(&self) -> bool {
        self.animated.y.abs() > FACING_RAD[0]
    }

    /// Corrects the direction of a steep forward for the heading that a pitch alone changes on the way to its
    /// elevation.
    #[cold]
    #[inline(never)]
    pub(super) fn raised(&self, frame: &Mat3A, bearings: &Bearings, direction: Pair) -> Pair {
        let (sin, cos) = trig::sin_cos(direction.y - self.animated.y);
        let pitched = bearings.angles(frame.x_axis * cos + frame.z_axis * sin);
        let off = pair([math::wrap_pi(pitched.x - self.animated.x), pitched.y - direction.y]);
        direction + off * ramp(self.animated.y.abs(), FACING_RAD)
    }

    /// Returns the part of the region's turn that an inner joint makes.
    ///
    /// A pitch p under a forward that is turned aside by β rolls it by p·sin β, so an inner joint makes less of the
    /// region's pitch, the further the forward is turned out of it.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn share_of(&self, turn: Pair, info: &JointInfo) -> Pair {
        let own = pair(info.compliance());
        let share = Vec4::select(own.cmpgt(Vec4::ZERO), own / self.part.compliance, Vec4::ZERO);
        let aside = self.ahead + (1.0 - share.x) * turn.x;
        share * turn * Vec4::new(1.0, 1.0 / pitch_reduction(aside), 1.0, 1.0)
    }

    /// Returns the part of a pitch lacking in the outermost joint that inner joints make, for a turn of the region.
    /// Beyond 60° aside their pitch would roll the forward and hardly lift it.
    pub(super) fn inner_pitch_part(&self, turn: Pair) -> f32 {
        let cos = trig::sin_cos(self.ahead + turn.x).1.at_least(0.0);
        (4.0 * cos * cos).at_most(1.0)
    }
}

/// Returns heading and elevation of a joint's forward in the bind pose, which moves along with the bone that carries the
/// chain; `None` without a bind pose.
#[cold]
#[inline(never)]
fn bound_angles<const C: usize>(
    body: &Body<'_, C>,
    bind: &[Affine3A],
    outer: usize,
    bearings: &Bearings,
) -> Option<Pair> {
    let forward = bind.get(outer)?.matrix3 * Vec3A::from(body.infos()[outer].axes.forward);
    let angles = bearings.angles(math::unit(forward)?);
    angles.is_finite().then_some(angles)
}

/// Evaluates the regions of a body, one for each of its parts.
#[cfg_attr(not(aim_small), inline(always))]
pub(super) fn find_regions<'a, const C: usize>(
    body: &Body<'_, C>,
    bind: Option<&[Affine3A]>,
    parts: &'a [BodyPart],
    ranges: &[Range<'_>],
    bearings: &Bearings,
    regions: &mut [Region<'a>],
) {
    let mut forwards = [Vec3A::X; 2];
    for (number, part) in parts.iter().enumerate() {
        let [outer, inner] = part.ends::<C>(number);
        let (frame, mut own_forward) = (&body.frames[outer], Vec3A::X);
        forwards[number % 2] = frame.x_axis;
        if body.is_tilted(outer) {
            own_forward = body.own_forward(outer);
            forwards[number % 2] = *frame * own_forward;
        }
        let region = &mut regions[number];
        (region.part, region.own_forward) = (part, own_forward);
        if outer < inner {
            region.forward = body.rows[inner] * forwards[number % 2];
            region.ahead = trig::atan2(region.forward.y, region.forward.x);
        }
        if number % 2 == 1 || number + 1 == parts.len() {
            let angles = bearings.angles_of_both(forwards);
            regions[number / 2 * 2].animated = angles;
            if number % 2 == 1 {
                regions[number].animated = angles.zwzw();
            }
        }
    }
    let mut inside = regions[0].animated;
    if let (Some(bind), [head]) = (bind, parts) {
        let [outer, _] = head.ends::<C>(0);
        inside = bound_angles(body, bind, outer, bearings).unwrap_or(inside);
    }
    for (number, region) in regions[..parts.len()].iter_mut().enumerate() {
        let part = region.part;
        let [outer, inner] = part.ends::<C>(number);
        let is_steep = region.is_steep();
        if is_steep {
            region.animated = bearings.steep_angles(region.animated, body.own_up(outer));
        }
        let mut animated = region.animated;
        if is_steep {
            animated.x = region.facing(&body.frames[outer], bearings);
        }
        // The budget also covers the animation's own turn of the region out of the one that carries it, or, for a head
        // without a chest, out of the bind pose.
        let turned = animated - inside;
        inside = animated;
        let turned = Vec4::new(math::wrap_pi(turned.x), turned.y, 0.0, 0.0);
        let own = &ranges[outer..inner + 1];
        let [lo, hi] = Range::sums(own);
        region.budget_shift = -turned;
        let (lo, hi) = (lo.max((part.least - turned).min(Vec4::ZERO)), hi.min((part.most - turned).max(Vec4::ZERO)));
        let is_room = lo.cmple(hi);
        let middle = (lo + hi) * 0.5;
        (region.lo, region.hi) = (Vec4::select(is_room, lo, middle), Vec4::select(is_room, hi, middle));
        if is_steep && number + 1 < parts.len() {
            let room = region.heading_range_factor();
            (region.lo.x, region.hi.x) = (region.lo.x * room, region.hi.x * room);
        }
    }
}
