//! Allotment: sharing the gaze shift, from the animated gaze to the target, between the regions.

use core::f32::consts::PI;

use glam::{Vec3A, Vec4};

use super::glide::{Pair, pair, square};
use super::region::{Region, pitch_reduction};
use super::sharing::EYE_PART;
use super::{Aims, Gaze, Posture, SAME_RAD, SightAngles};
use crate::kinematics::bearing::{BY_THE_FRONT_RAD, FORWARD_STEEP_RAD};
use crate::limits::Interval;
use crate::math::Bounded;
use crate::math::trig;
use crate::rig::PerJoint;
use crate::{Joint, math};

/// Largest number of rounds that adjust the shares to the range of the leading joint.
pub(super) const ROUNDS: usize = 16;
/// Largest number of such rounds in a frame, which continues from the result of the last one.
pub(super) const FRAME_ROUNDS: usize = 2;
/// Largest adjustment in a round, as a multiple of the remaining error.
const MOST_STEPS: f32 = 5.0;
/// Ratio to the last round's error above which another round is not worth trying.
const GAIN: f32 = 0.95;
/// Part of its range within which the leading joint can certainly cover what headings and elevations leave to it, at
/// elevations below [`STEEP_RAD`].
const PLAIN_PART: f32 = 0.8;
/// Elevation above which headings are a poor measure of the joints' angles.
const STEEP_RAD: f32 = 50.0 * PI / 180.0;
/// Remainder of the gaze shift that counts as out of reach at elevations below [`STEEP_RAD`], radians: a rounding
/// error.
const OUT_OF_REACH_RAD: f32 = 2e-4;
/// Remainder of the gaze shift that counts as out of reach at elevations above [`STEEP_RAD`], radians. Joint angles may
/// still cover a smaller one, because headings say little there.
const STEEP_OUT_OF_REACH_RAD: f32 = 0.3;

/// The lanes of a pair.
const HEADING: usize = 0;
const PITCH: usize = 1;

/// Converts eye headings h, relative to a head at elevation η = `head`, into headings ψ relative to the head's for
/// directions at `elevation` ε. Inverts tan h = cos ε·sin ψ/(cos ε·cos ψ·cos η + sin ε·sin η).
fn eye_headings([right, left]: [f32; 2], head: f32, elevation: f32) -> [f32; 2] {
    let half_turn = Vec4::splat(PI);
    let [sines, cosines] = trig::sin_cos_4(Vec4::new(right, left, head, elevation).max(-half_turn).min(half_turn));
    let [sin_head, cos_head, sin_up, cos_up] = [sines.z, cosines.z, sines.w, cosines.w];
    let across = sines * cos_head;
    let square = cosines * cosines + across * across;
    let ahead = Vec4::new(math::root(square.x), math::root(square.y), 1.0, 1.0);
    let lift = sin_up * sin_head / cos_up.at_least(1e-3);
    let lifted = (sines * lift / ahead).max(Vec4::NEG_ONE).min(Vec4::ONE);
    let square = Vec4::ONE - lifted * lifted;
    let (x, y) = (math::root(square.x), math::root(square.y));
    let [a, b, c, d] =
        trig::atan2_of_4(Vec4::new(across.x, across.y, lifted.x, lifted.y), Vec4::new(cosines.x, cosines.y, x, y))
            .to_array();
    [a + c, b + d]
}

/// A gaze shift: from the animated gaze to the target, as headings and elevations.
#[derive(Clone, Copy, Debug)]
pub(super) struct GazeShift {
    from: Pair,
    to: Pair,
    shift: Pair,
    /// The part of it that the regions cover, as far as the eye can cover the rest.
    own: Pair,
}

/// The directions allotted to the regions.
pub(super) struct Allotment<const C: usize> {
    /// Heading and elevation of each region's outermost forward, from the innermost region outward.
    pub(super) directions: PerJoint<Pair, C>,
    /// The point that the leading joint looks at: the target, or the nearest direction within reach if it is out of
    /// reach.
    pub(super) point: Vec3A,
    pub(super) fit: Fit,
}

/// The directions of the regions' outermost joints, and the remainder of a gaze shift that does not fit.
pub(super) type Shared<const C: usize> = (PerJoint<Pair, C>, Pair);

/// The result of fitting a target's heading and elevation into ranges and budgets.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    /// `true` if heading and elevation fit.
    pub(super) within_reach: bool,
    /// Turn of the body that would make the heading fit, radians, positive to the left.
    pub(super) body_turn: f32,
}

impl Fit {
    pub(super) const WITHIN_REACH: Self = Self { within_reach: true, body_turn: 0.0 };
}

impl<const C: usize> Allotment<C> {
    pub(super) fn aims(&self) -> Aims<'_> {
        Aims::At(&self.directions, self.point)
    }
}

impl<const C: usize> Gaze<'_, C> {
    /// Returns the gaze shift to the point that is aimed at.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn gaze_shift(&self) -> Option<GazeShift> {
        self.gaze_shift_to(self.goal.aim_point)
    }

    /// Returns the turn of the body that would bring a target behind into reach, which differs from the point aimed at.
    #[cold]
    pub(super) fn turn_for_behind(&self) -> Option<f32> {
        let (_, unfit) = self.share_again(&self.gaze_shift_to(self.goal.measured_point)?, Vec4::ZERO);
        Some(unfit.x)
    }

    #[cfg_attr(not(aim_small), inline(always))]
    fn gaze_shift_to(&self, point: Vec3A) -> Option<GazeShift> {
        let to_target = math::unit(point - self.pivot)?;
        let [mut from, to] = self.bearings.turned(self.body.gaze.direction, to_target);
        if from.y.abs() > FORWARD_STEEP_RAD {
            from = self.bearings.steep_angles(from, self.body.own_up(self.body.first()));
        }
        let shift = self.bearings.angle_change(from, to, self.goal.side);
        let own = if self.has_eye() {
            let angle = math::angle_between_units(self.glance.rest, to_target);
            (shift + self.glance.change) * self.sharing.head_part(angle)
        } else {
            shift
        };
        Some(GazeShift { from, to, shift, own })
    }

    /// Returns the allotment in the plain cases: the leading joint can certainly cover the rest and could so before,
    /// when the regions covered nothing beyond their part (`extra`), or the target is out of reach. Otherwise returns
    /// the result of [`share`](Self::share) without `extra`, from which [`settle`](Self::settle) has to iterate.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn allot(&self, gaze_shift: &GazeShift, extra: Pair) -> Result<Allotment<C>, Shared<C>> {
        let (directions, unfit) = self.share(gaze_shift, Vec4::ZERO);
        let head = self.count() - 1;
        let is_level = gaze_shift.to.y.abs().at_least(directions[head].y.abs()) < STEEP_RAD;
        let nothing = if is_level { OUT_OF_REACH_RAD } else { STEEP_OUT_OF_REACH_RAD };
        if square(unfit) > nothing * nothing {
            return Ok(self.out_of_reach(gaze_shift, directions, unfit));
        }
        if !is_level || square(extra) > 0.0 || !self.body.deviation.is_slight() {
            return Err((directions, unfit));
        }
        let turned = |region: usize| directions[region] - self.regions[region].animated;
        let own = &self.ranges[self.body.first()];
        let (rest, lo, hi) = if self.has_eye() {
            (gaze_shift.shift - turned(head), own.lo, own.hi)
        } else {
            let inside = if head > 0 { turned(head - 1) } else { Vec4::ZERO };
            (turned(head) - inside, self.regions[head].lo, self.regions[head].hi)
        };
        // NaN or infinite if an angle cannot move.
        let used = rest / Vec4::select(rest.cmpgt(Vec4::ZERO), hi, lo);
        let is_plain = square(used) < PLAIN_PART * PLAIN_PART;
        if !is_plain {
            return Err((directions, unfit));
        }
        Ok(Allotment { directions, point: self.goal.aim_point, fit: Fit::WITHIN_REACH })
    }

    /// Returns the allotment for a target out of reach. To the side, the gaze keeps the target's elevation; too high or
    /// too low, its heading.
    fn out_of_reach(&self, gaze_shift: &GazeShift, directions: PerJoint<Pair, C>, unfit: Pair) -> Allotment<C> {
        let nearest = gaze_shift.from + gaze_shift.shift - unfit;
        let to_target = self.goal.aim_point - self.pivot;
        let distance = to_target.length();
        let mut to_point = self.bearings.direction(nearest) * distance;
        // Near the zenith, the eye looks towards the target itself, although the regions turn by way of the front.
        let steep = (gaze_shift.to.y.abs() - BY_THE_FRONT_RAD[0]) / (BY_THE_FRONT_RAD[1] - BY_THE_FRONT_RAD[0]);
        if self.has_eye() && steep > 0.0 {
            to_point += (to_target - to_point) * steep.at_most(1.0);
        }
        let point = self.pivot + to_point;
        Allotment { directions, point, fit: Fit { within_reach: false, body_turn: unfit.x } }
    }

    /// Finds the allotment and puts the joints there. `extra` is what the regions cover beyond their part.
    pub(super) fn settle(
        &self,
        gaze_shift: GazeShift,
        from: &PerJoint<Joint, C>,
        posture: &mut Posture<'_, C>,
        extra: &mut Pair,
    ) -> Option<Allotment<C>> {
        let shared = match self.allot(&gaze_shift, *extra) {
            Ok(allotment) => {
                let sight = self.turn_joints(allotment.aims(), from, None, posture)?;
                if sight.is_within() || !allotment.fit.within_reach {
                    self.settle_eye(&sight, from, posture);
                    return Some(allotment);
                }
                (allotment.directions, Vec4::ZERO)
            }
            Err(shared) => shared,
        };
        let allotment = self.iterate_allotment(&gaze_shift, shared, from, posture, (extra, ROUNDS))?;
        let sight = self.turn_joints(allotment.aims(), from, None, posture)?;
        self.settle_eye(&sight, from, posture);
        Some(allotment)
    }

    /// Finds the allotment by iteration, where it is not plain: in each of at most `rounds` rounds, adjusts `extra`
    /// until the leading joint can just cover the rest. `shared` is the result of [`share`](Self::share) without it.
    pub(super) fn iterate_allotment(
        &self,
        gaze_shift: &GazeShift,
        shared: Shared<C>,
        from: &PerJoint<Joint, C>,
        posture: &mut Posture<'_, C>,
        (extra, rounds): (&mut Pair, usize),
    ) -> Option<Allotment<C>> {
        let own = &self.ranges[self.body.first()];
        let (mut before, mut step) = (Vec4::ZERO, Vec4::ZERO);
        let (mut directions, unfit) = shared;
        if square(*extra) > 0.0 {
            directions = self.share_again(gaze_shift, *extra).0;
        }
        for round in 0..rounds {
            let sight = self.turn_joints(Aims::At(&directions, self.goal.aim_point), from, None, posture)?;
            let left = sight.excess();
            // The part of `extra` that the regions need not cover.
            let spare = (sight.unclamped - own.hi).max(-*extra).min(Vec4::ZERO)
                + (sight.unclamped - own.lo).min(-*extra).max(Vec4::ZERO);
            let needs = if self.has_eye() {
                spare.cmpeq(Vec4::ZERO)
            } else {
                // A head without eyes may be stopped by its region's limits instead of its own range.
                left.abs().cmpgt(Vec4::splat(SAME_RAD))
            };
            let off = Vec4::select(needs, left, spare);
            if SightAngles::is_negligible(off) {
                break;
            }
            // Where something does not fit without `extra`, the regions are at their limits and turn no further.
            let gains = if round > 0 {
                square(off) < GAIN * GAIN * square(before)
            } else {
                let ends = off.cmpeq(Vec4::ZERO) | (unfit * off.signum()).cmpgt(Vec4::splat(OUT_OF_REACH_RAD));
                square(*extra) > 0.0 || ends.bitmask() & 3 != 3
            };
            if !gains {
                if SightAngles::is_negligible(left) {
                    *extra = Vec4::ZERO;
                    break;
                }
                *extra -= step;
                return Some(self.out_of_reach(gaze_shift, directions, left));
            }
            // A secant step through the last two rounds, separately for each angle.
            let per = step / (before - off);
            step = off * Vec4::select(per.cmpgt(Vec4::ZERO), per.min(Vec4::splat(MOST_STEPS)), Vec4::ONE);
            before = off;
            *extra += step;
            directions = self.share_again(gaze_shift, *extra).0;
        }
        Some(Allotment { directions, point: self.goal.aim_point, fit: Fit::WITHIN_REACH })
    }

    /// [`share`](Self::share), compiled once for the callers that are rarely reached.
    #[inline(never)]
    fn share_again(&self, gaze_shift: &GazeShift, extra: Pair) -> Shared<C> {
        self.share(gaze_shift, extra)
    }

    /// Shares a gaze shift out between the regions, which cover its `own` part and `extra` on top. Returns the resulting
    /// directions of the regions' outermost joints, and the remainder of the shift that does not fit.
    #[cfg_attr(not(aim_small), inline(always))]
    fn share(&self, &GazeShift { to, shift, own, .. }: &GazeShift, extra: Pair) -> Shared<C> {
        let mut directions = self.rig.array(Vec4::ZERO);
        let (mut lo, mut hi, mut wanted) = (Vec4::ZERO, Vec4::ZERO, own);
        if self.has_eye() {
            let eye = &self.ranges[self.body.first()];
            (lo, hi) = (eye.lo, eye.hi);
            // The regions' part, but at least what would take the eye out of its customary range.
            let [least, most] = &self.customary;
            wanted = own.max(shift - *most).min(shift - *least);
        }
        let done = self.turn_regions(wanted + extra, &mut directions);
        let rest = shift - done;
        let mut unfit = rest - rest.max(lo).min(hi);
        if self.has_eye() && unfit.x != 0.0 {
            let [right, left] = eye_headings([lo.x, hi.x], directions[self.count() - 1].y, to.y - unfit.y);
            let eye = Interval::from_ends(right, left);
            let [least, most] = [eye.hi(), eye.lo()].map(|end| shift.x - EYE_PART * end);
            let wanted = own.x.at_least(least).at_most(most);
            let rest = shift.x - self.turn_axis::<HEADING>(wanted + extra.x, &mut directions);
            unfit.x = rest - eye.hold(rest);
        }
        if self.regions()[..self.count() - 1].iter().any(Region::is_steep) {
            self.raise(&mut directions);
        }
        (directions, unfit)
    }

    /// Corrects the directions of steep regions by way of their front.
    #[cold]
    #[inline(never)]
    fn raise(&self, directions: &mut [Pair]) {
        let inner = self.count() - 1;
        for (number, (region, direction)) in self.regions()[..inner].iter().zip(directions).enumerate() {
            if region.is_steep() {
                let [outer, _] = region.part.ends::<C>(number);
                *direction = region.raised(&self.body.frames[outer], self.bearings, *direction);
            }
        }
    }

    /// Turns the regions by a total of `wanted`, each by its compliance; what one cannot cover passes to the others.
    /// Returns the total turn.
    ///
    /// A pitch p under a head turned aside by β lifts the gaze by at most p·cos β and rolls the head by p·sin β, so a
    /// region's compliance in pitch decreases, the further the head is turned out of it.
    #[cfg_attr(not(aim_small), inline(always))]
    fn turn_regions(&self, wanted: Pair, directions: &mut [Pair]) -> Pair {
        let heading = self.turn_axis::<HEADING>(wanted.x, directions);
        pair([heading, self.turn_axis::<PITCH>(wanted.y, directions)])
    }

    /// Turns the regions about one axis. The headings must be set before the pitches.
    #[cfg_attr(not(aim_small), inline(always))]
    fn turn_axis<const AXIS: usize>(&self, wanted: f32, directions: &mut [Pair]) -> f32 {
        let (regions, head) = (self.regions(), self.count() - 1);
        let mut compliances = self.rig.array(0.0_f32);
        let mut total = regions[head].part.compliance[AXIS];
        compliances[head] = total;
        for (number, region) in regions[..head].iter().enumerate() {
            let out = if AXIS == PITCH { directions[head].x - directions[number].x } else { 0.0 };
            compliances[number] = region.part.compliance[AXIS] / pitch_reduction(out);
            total += compliances[number];
        }
        // Usually every region has room for its part.
        let each = wanted / total;
        let (mut sum, mut fits) = (0.0, true);
        for ((compliances, region), direction) in compliances.iter().zip(regions).zip(&mut *directions) {
            let own = each * compliances;
            fits &= (region.lo[AXIS] <= own) & (own <= region.hi[AXIS]);
            sum += own;
            direction[AXIS] = region.animated[AXIS] + sum;
        }
        if fits { sum } else { self.turn_within_limits::<AXIS>(wanted, &compliances, directions) }
    }

    /// Turns the regions where some have no room for their parts. Monomorphised for each axis.
    #[cfg_attr(not(aim_small), inline(never))]
    fn turn_within_limits<const AXIS: usize>(
        &self,
        wanted: f32,
        compliances: &PerJoint<f32, C>,
        directions: &mut [Pair],
    ) -> f32 {
        self.turn_within_limits_of(AXIS, wanted, compliances, directions)
    }

    #[cfg_attr(not(aim_small), inline(always))]
    fn turn_within_limits_of(
        &self,
        axis: usize,
        wanted: f32,
        compliances: &PerJoint<f32, C>,
        directions: &mut [Pair],
    ) -> f32 {
        let regions = self.regions();
        let mut turns = self.rig.array(0.0_f32);
        let mut compliances = *compliances;
        let mut left = wanted;
        for _ in 0..self.count() {
            let mut total = 0.0;
            for ((compliances, turn), region) in compliances.iter_mut().zip(&*turns).zip(regions) {
                if if left > 0.0 { *turn >= region.hi[axis] } else { *turn <= region.lo[axis] } {
                    *compliances = 0.0;
                }
                total += *compliances;
            }
            if left == 0.0 || !(total > 0.0) {
                break;
            }
            let each = left / total;
            for ((compliances, turn), region) in compliances.iter().zip(&mut *turns).zip(regions) {
                let next = (*turn + each * compliances).at_least(region.lo[axis]).at_most(region.hi[axis]);
                left -= next - *turn;
                *turn = next;
            }
        }
        let mut sum = 0.0;
        for ((turn, region), direction) in turns.iter().zip(regions).zip(&mut *directions) {
            sum += turn;
            direction[axis] = region.animated[axis] + sum;
        }
        sum
    }
}
