//! [`Region`]: neighbouring joints of one part of the body, which share a turn.

use glam::{Vec3A, Vec4, Vec4Swizzles};

use super::body::Body;
use super::glide::{Pair, pair};
use super::range::Range;
use crate::JointInfo;
use crate::kinematics::bearing::Bearings;
use crate::math::{self, Bounded, trig};
use crate::rig::BodyPart;

/// By how much less of a pitch is made by what is inside of a head that is turned out of it by β, radians: 1 + 8·β², 2 at 20°.
#[cfg_attr(not(aim_small), inline(always))]
pub(super) fn calm(aside: f32) -> f32 {
    1.0 + 8.0 * aside * aside
}

/// A part of the body in a pose.
#[derive(Clone, Copy, Debug)]
pub(super) struct Region<'a> {
    pub(super) part: &'a BodyPart,
    /// Heading and elevation of the outermost joint's forward in the animation.
    pub(super) animated: Pair,
    /// The outermost joint's animated forward in its own frame and in the innermost one's.
    pub(super) own_forward: Vec3A,
    pub(super) forward: Vec3A,
    /// The heading of the latter.
    ahead: f32,
    /// The shifts by the pose: of the middle of the joints' ranges, where those have ends, and of the budget.
    pub(super) shifts: [Pair; 2],
    /// The sums that the joints' ranges allow, and the budget in this pose.
    pub(super) lo: Pair,
    pub(super) hi: Pair,
}

impl Region<'_> {
    pub(super) const NONE: Self = Self {
        part: &BodyPart::NONE,
        animated: Vec4::ZERO,
        own_forward: Vec3A::ZERO,
        forward: Vec3A::ZERO,
        ahead: 0.0,
        shifts: [Vec4::ZERO; 2],
        lo: Vec4::ZERO,
        hi: Vec4::ZERO,
    };

    /// The part of the region's turn that an inner joint makes.
    ///
    /// A pitch p under a forward that is turned aside by β rolls it by p·sin β: the inner joint makes the less of the region's, the
    /// farther the forward is turned out of it.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn share_of(&self, turn: Pair, info: &JointInfo) -> Pair {
        let own = pair(info.compliance());
        let share = Vec4::select(own.cmpgt(Vec4::ZERO), own / self.part.compliance, Vec4::ZERO);
        let aside = self.ahead + (1.0 - share.x) * turn.x;
        share * turn * Vec4::new(1.0, 1.0 / calm(aside), 1.0, 1.0)
    }

    /// The part that inner joints make of a pitch which the outermost lacks, in a turn of the region: beyond 60° aside it would roll the
    /// forward, and hardly lift it.
    pub(super) fn part_inside(&self, turn: Pair) -> f32 {
        let cos = trig::sin_cos(self.ahead + turn.x).1.at_least(0.0);
        (4.0 * cos * cos).at_most(1.0)
    }
}

/// Finds the regions of a body, one for each of its parts.
#[cfg_attr(not(aim_small), inline(always))]
pub(super) fn find_regions<'a, const C: usize>(
    body: &Body<'_, C>,
    parts: &'a [BodyPart],
    ranges: &[Range<'_>],
    bearings: &Bearings,
    regions: &mut [Region<'a>],
) {
    let mut forwards = [Vec3A::X; 2];
    for (number, part) in parts.iter().enumerate() {
        let (frame, mut own_forward) = (&body.frames[part.outer], Vec3A::X);
        forwards[number % 2] = frame.x_axis;
        if body.is_tilted(part.outer) {
            own_forward = body.own_forward(part.outer);
            forwards[number % 2] = *frame * own_forward;
        }
        let region = &mut regions[number];
        (region.part, region.own_forward) = (part, own_forward);
        if part.outer < part.inner {
            region.forward = body.rows[part.inner] * forwards[number % 2];
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
    for region in &mut regions[..parts.len()] {
        let part = region.part;
        // How far the animation turns the region out of what is inside it counts too.
        let turned = region.animated - inside;
        inside = region.animated;
        let turned = Vec4::new(math::wrap_pi(turned.x), turned.y, 0.0, 0.0);
        let own = &ranges[part.outer..=part.inner];
        let [lo, hi] = Range::sums(own);
        let range_shift = (lo + hi) * 0.5;
        let has_ends = range_shift.abs().cmplt(Vec4::INFINITY);
        region.shifts = [Vec4::select(has_ends, range_shift, Vec4::ZERO), -turned];
        let (lo, hi) = (lo.max((part.least - turned).min(Vec4::ZERO)), hi.min((part.most - turned).max(Vec4::ZERO)));
        let is_room = lo.cmple(hi);
        let middle = (lo + hi) * 0.5;
        (region.lo, region.hi) = (Vec4::select(is_room, lo, middle), Vec4::select(is_room, hi, middle));
    }
}
