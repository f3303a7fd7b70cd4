//! The leading joint's view of a point.

use core::f32::consts::{FRAC_PI_2, PI};

use glam::{Mat3A, Vec3A, Vec4};

use super::body::{Turn, angles};
use super::glide::{Pair, length, pair, square};
use super::{Gaze, SAME_RAD};
use crate::kinematics::bearing::heading_and_pitch;
use crate::kinematics::chain::{Chain, Ray};
use crate::limits::reach::Reach;
use crate::limits::{Angles, RangeOfMotion};
use crate::math::trig;
use crate::solve::exact::Solver;
use crate::solve::exact::settle::Search;
use crate::target::goal::Goal;
use crate::{Joint, math};

/// Largest number of fixed-point iterations for an effector that is offset from its joint.
const SIGHT_ROUNDS: usize = 24;

/// The leading joint's view of a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct SightAngles {
    /// The heading and pitch that look at the point.
    pub(super) unclamped: Pair,
    /// `unclamped`, clamped to the joint's range.
    pub(super) clamped: Pair,
}

impl SightAngles {
    pub(super) const ZERO: Self = Self { unclamped: Vec4::ZERO, clamped: Vec4::ZERO };

    /// Returns the part of the turn that the range does not allow.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn excess(&self) -> Pair {
        let excess = self.unclamped - self.clamped;
        if excess.x.abs() > PI { Vec4::new(math::wrap_pi(excess.x), excess.y, 0.0, 0.0) } else { excess }
    }

    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn is_negligible(excess: Pair) -> bool {
        square(excess) < SAME_RAD * SAME_RAD
    }

    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn is_within(&self) -> bool {
        Self::is_negligible(self.excess())
    }

    /// Returns the angle between the point and the forward of the eye at rest, radians. `glance` is the turn of the
    /// animated eye out of it.
    pub(super) fn eccentricity(&self, glance: Pair) -> f32 {
        let angles = self.unclamped + glance;
        let cos = trig::sin_cos(angles.x).1 * trig::sin_cos(angles.y).1;
        trig::atan2(math::sqrt(1.0 - cos * cos), cos)
    }
}

impl<const C: usize> Gaze<'_, C> {
    /// Returns the leading joint's view of a point at these joint angles.
    pub(super) fn sight_angles_at(&self, joints: &[Joint], point: Vec3A) -> Option<SightAngles> {
        self.sight_angles(joints, point, self.body.unturned(joints, point))
    }

    /// Returns the leading joint's view of a point, given the point with the turns of the joints inward of it undone.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn sight_angles(&self, joints: &[Joint], point: Vec3A, unturned_point: Vec3A) -> Option<SightAngles> {
        let first = self.body.first();
        let wanted = self.sight(joints, point, unturned_point)?;
        Some(SightAngles { unclamped: wanted, clamped: self.ranges[first].hold_from(angles(&joints[first]), wanted) })
    }

    /// Returns the heading and pitch by which the leading joint looks at a point, given the point with the turns of the
    /// joints inward of it undone. `None` if the point is on the effector.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn sight(&self, joints: &[Joint], point: Vec3A, unturned_point: Vec3A) -> Option<Pair> {
        if let Some(chain) = self.chain {
            return self.search_sight(chain, joints, point);
        }
        let local = self.body.view(unturned_point);
        if !self.body.is_plain {
            return self.iterate_sight(local, joints);
        }
        let square = local.dot(local);
        (square > 1e-30 && square < f32::INFINITY).then(|| heading_and_pitch(local))
    }

    /// [`sight`](Self::sight) for an effector that is offset from its joint, by fixed-point iteration: each round looks
    /// from the position where the last one left the effector.
    #[cold]
    fn iterate_sight(&self, local: Vec3A, joints: &[Joint]) -> Option<Pair> {
        let (first, effector) = (self.body.first(), &self.body.effector);
        let limits = self.ranges[first].ends();
        if effector.origin == Vec3A::ZERO {
            return Some(turn_to(effector.direction, math::unit(local)?, limits));
        }
        let from = angles(&joints[first]);
        let (mut held, mut wanted) = (from, from);
        for _ in 0..SIGHT_ROUNDS {
            let origin = Turn::new(held).of_frame(&Mat3A::IDENTITY) * effector.origin;
            let next = turn_to(effector.direction, math::unit(local - origin)?, limits);
            let change = SightAngles { unclamped: next, clamped: wanted }.excess();
            wanted = next;
            held = self.ranges[first].hold_from(from, wanted);
            if length(change) < 0.1 * SAME_RAD {
                break;
            }
        }
        Some(wanted)
    }

    /// [`sight`](Self::sight) in a pose that is not rigid, by the exact solver with all other joints fixed.
    #[cold]
    fn search_sight(&self, chain: &Chain<C>, joints: &[Joint], point: Vec3A) -> Option<Pair> {
        let (body, first) = (self.body, self.body.first());
        let mut found = self.rig.array(Joint::REST);
        found.copy_from_slice(joints);
        let mut reaches = self.rig.array(Reach::REST);
        for (reach, joint) in reaches.iter_mut().zip(joints) {
            *reach = Reach::at(joint);
        }
        // Search beyond the joint's range, to find out what the range does not allow.
        let info = &self.body.infos()[first];
        let all = |declared: Option<[f32; 2]>, most: f32| declared.map(|_| [-most, most]);
        let declared = Angles { heading: all(info.heading, PI), pitch: all(info.pitch, FRAC_PI_2) };
        reaches[first] = Reach::range(&RangeOfMotion::new(declared, 0.0, None));
        let goal = Goal { aim_point: point, ..*self.goal };
        Solver::new(self.rig, chain, &goal).settle(&mut found, &reaches, Search::Thorough)?;
        // The angles at which rigid links would see the point where the true effector does; for a missing angle, the
        // remainder.
        let (at, frame) = self.carried(joints);
        let turned = Turn::new(angles(&found[first])).of_frame(&frame);
        let rigid = Ray { origin: at + turned * body.effector.origin, direction: turned * body.effector.direction };
        let seen = chain.rigid_target(point, chain.gaze_of(self.rig, &found), rigid);
        let local = math::unit(frame.transpose() * (seen - rigid.origin))?;
        Some(turn_to(body.effector.direction, local, self.ranges[first].ends()))
    }

    /// Returns the leading joint's place and frame, as carried by the joints inward of it.
    fn carried(&self, joints: &[Joint]) -> (Vec3A, Mat3A) {
        let body = self.body;
        let root = (Vec3A::ZERO, body.frames[body.count() - 1]);
        (body.first() + 1..body.count()).rev().fold(root, |(at, frame), index| {
            let turn = Turn::new(angles(&joints[index])).of_frame(&frame) * body.rows[index];
            (at + turn * (body.places[index - 1] - body.places[index]), turn * body.frames[index - 1])
        })
    }
}

/// Returns the heading and pitch that turn `from` to `to`, unit vectors along a joint's forward, left and up. Pitch
/// lifts `from` to the height of `to`, or as near as possible; then heading brings it there. A direction that can be
/// lifted either way is lifted the way that is within the limits `[lo, hi]` or less far beyond them; if that does not
/// decide, the way that needs the smaller heading.
pub(super) fn turn_to(from: Vec3A, to: Vec3A, [lo, hi]: [Pair; 2]) -> Pair {
    /// Forward component below which a direction is so nearly perpendicular to the bone's forward that it can be lifted
    /// either way.
    const ACROSS: f32 = 0.5;
    let [[ahead, left, up], [to_ahead, to_left, to_up]] = [from, to].map(|v| v.to_array());
    let level = math::sqrt(ahead * ahead + up * up - to_up * to_up);
    // Each difference of two angles takes one arctangent, by the subtraction formula.
    let turn = |level: f32| {
        trig::atan2_of_4(
            pair([to_left * level - to_ahead * left, to_up * ahead - level * up]),
            pair([to_ahead * level + to_left * left, level * ahead + to_up * up]),
        )
    };
    let angles = turn(if ahead < -ACROSS { -level } else { level });
    if ahead.abs() <= ACROSS {
        let other = turn(-level);
        let [excess, other_excess] = [angles, other].map(|turn| square(turn - turn.max(lo).min(hi)));
        if other_excess < excess || other_excess == excess && other.x.abs() < angles.x.abs() {
            return other;
        }
    }
    angles
}
