//! How the leading joint sees a point.

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

/// How often the closed form of an effector that is not at its joint is repeated, at most.
const SIGHT_ROUNDS: usize = 24;

/// How the leading joint sees a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    /// The heading and the pitch that look there, and the nearest that the joint's range holds.
    pub(super) wanted: Pair,
    pub(super) held: Pair,
}

impl Seen {
    pub(super) const NOTHING: Self = Self { wanted: Vec4::ZERO, held: Vec4::ZERO };

    /// What the range does not hold.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn left(&self) -> Pair {
        let left = self.wanted - self.held;
        if left.x.abs() > PI { Vec4::new(math::wrap_pi(left.x), left.y, 0.0, 0.0) } else { left }
    }

    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn is_nothing(left: Pair) -> bool {
        square(left) < SAME_RAD * SAME_RAD
    }

    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn is_within(&self) -> bool {
        Self::is_nothing(self.left())
    }

    /// How far the point is off the middle of the range.
    pub(super) fn off(&self) -> f32 {
        let cos = trig::sin_cos(self.wanted.x).1 * trig::sin_cos(self.wanted.y).1;
        trig::atan2(math::sqrt(1.0 - cos * cos), cos)
    }
}

impl<const C: usize> Gaze<'_, C> {
    /// How the leading joint sees a point with the joints like this.
    pub(super) fn see(&self, joints: &[Joint], point: Vec3A) -> Option<Seen> {
        let body = self.body;
        let outward = |point, index: usize| body.take_back_point(index, &Turn::new(angles(&joints[index])), point);
        let taken_back = (body.first + 1..body.count()).rev().fold(point, outward);
        self.seen(joints, point, taken_back)
    }

    /// The same of a point from which the turns of the joints inside are taken back already.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn seen(&self, joints: &[Joint], point: Vec3A, taken_back: Vec3A) -> Option<Seen> {
        let first = self.body.first;
        let wanted = self.sight(joints, point, taken_back)?;
        Some(Seen { wanted, held: self.ranges[first].hold_from(angles(&joints[first]), wanted) })
    }

    /// The heading and the pitch by which the leading joint looks at a point, the turns of the joints inside taken back from it.
    /// `None` where the point is on the effector.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn sight(&self, joints: &[Joint], point: Vec3A, taken_back: Vec3A) -> Option<Pair> {
        if let Some(chain) = self.chain {
            return self.sight_by_search(chain, joints, point);
        }
        let local = self.local(taken_back);
        if !self.body.is_plain {
            return self.sight_in_rounds(local, joints);
        }
        let square = local.dot(local);
        (square > 1e-30 && square < f32::INFINITY).then(|| heading_and_pitch(local))
    }

    /// A point from which turns are taken back, in the leading joint's frame.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn local(&self, taken_back: Vec3A) -> Vec3A {
        let (body, first) = (self.body, self.body.first);
        body.rows[first] * (taken_back - body.places[first])
    }

    /// [`sight`](Self::sight) of an effector that is not at its joint: each round looks from where the last one left the
    /// effector.
    #[cold]
    fn sight_in_rounds(&self, local: Vec3A, joints: &[Joint]) -> Option<Pair> {
        let (first, effector) = (self.body.first, &self.body.effector);
        if effector.origin == Vec3A::ZERO {
            return Some(turn_to(effector.direction, math::unit(local)?));
        }
        let from = angles(&joints[first]);
        let (mut held, mut wanted) = (from, from);
        for _ in 0..SIGHT_ROUNDS {
            let origin = Turn::new(held).of_frame(&Mat3A::IDENTITY) * effector.origin;
            let next = turn_to(effector.direction, math::unit(local - origin)?);
            let change = Seen { wanted: next, held: wanted }.left();
            wanted = next;
            held = self.ranges[first].hold_from(from, wanted);
            if length(change) < 0.1 * SAME_RAD {
                break;
            }
        }
        Some(wanted)
    }

    /// [`sight`](Self::sight) in a pose that is not rigid, by the exact solver, the other joints held where they are.
    #[cold]
    fn sight_by_search(&self, chain: &Chain<C>, joints: &[Joint], point: Vec3A) -> Option<Pair> {
        let (body, first) = (self.body, self.body.first);
        let mut found = self.rig.array(Joint::REST);
        found.copy_from_slice(joints);
        let mut reaches = self.rig.array(Reach::REST);
        for (reach, joint) in reaches.iter_mut().zip(joints) {
            *reach = Reach::at(joint);
        }
        // Beyond its range too: what the range does not hold is to be known.
        let info = &self.body.infos()[first];
        let all = |declared: Option<[f32; 2]>, most: f32| declared.map(|_| [-most, most]);
        let declared = Angles { heading: all(info.heading, PI), pitch: all(info.pitch, FRAC_PI_2) };
        reaches[first] = Reach::range(&RangeOfMotion::new(declared, 0.0, None));
        let goal = Goal { aimed: point, ..*self.goal };
        Solver::new(self.rig, chain, &goal).settle(&mut found, &reaches, Search::Thorough)?;
        // The angles that look where the rigid links would have to look; of an angle that the joint lacks, what is left.
        let (at, frame) = self.carried(joints);
        let turned = Turn::new(angles(&found[first])).of_frame(&frame);
        let rigid = Ray { origin: at + turned * body.effector.origin, direction: turned * body.effector.direction };
        let seen = chain.seen_target(point, chain.gaze_of(self.rig, &found), rigid);
        Some(turn_to(body.effector.direction, math::unit(frame.transpose() * (seen - rigid.origin))?))
    }

    /// Where the joints inside bring the leading joint, and its frame.
    fn carried(&self, joints: &[Joint]) -> (Vec3A, Mat3A) {
        let body = self.body;
        let root = (Vec3A::ZERO, body.frames[body.count() - 1]);
        (body.first + 1..body.count()).rev().fold(root, |(at, frame), index| {
            let turn = Turn::new(angles(&joints[index])).of_frame(&frame) * body.rows[index];
            (at + turn * (body.places[index - 1] - body.places[index]), turn * body.frames[index - 1])
        })
    }
}

/// The heading and the pitch that turn `from` to `to`, unit vectors along a joint's forward, left and up: pitch lifts `from` to the height of `to`,
/// or as near as it gets, then heading brings it there.
pub(super) fn turn_to(from: Vec3A, to: Vec3A) -> Pair {
    /// Nearer to square to the bone's forward than this, a direction can be lifted to either side.
    const ACROSS: f32 = 0.5;
    let [[ahead, left, up], [to_ahead, to_left, to_up]] = [from, to].map(|v| v.to_array());
    let level = math::sqrt(ahead * ahead + up * up - to_up * to_up);
    // Differences of angles, each by one arctangent.
    let turn = |level: f32| {
        trig::atan2_of_4(
            pair([to_left * level - to_ahead * left, to_up * ahead - level * up]),
            pair([to_ahead * level + to_left * left, level * ahead + to_up * up]),
        )
    };
    let angles = turn(if ahead < -ACROSS { -level } else { level });
    if ahead.abs() <= ACROSS {
        let other = turn(-level);
        if other.x.abs() < angles.x.abs() {
            return other;
        }
    }
    angles
}
