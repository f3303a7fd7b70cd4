//! How the leading joint sees a point.

use core::f32::consts::{FRAC_PI_2, PI};

use glam::{Mat3A, Vec3A};

use super::body::{Carried, halves, turned};
use super::glide::{Pair, length};
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
    pub(super) const NOTHING: Self = Self { wanted: [0.0; 2], held: [0.0; 2] };

    /// What the range does not hold.
    pub(super) fn left(&self) -> Pair {
        [math::wrap_pi(self.wanted[0] - self.held[0]), self.wanted[1] - self.held[1]]
    }

    pub(super) fn is_nothing(left: Pair) -> bool {
        length(left) < SAME_RAD
    }

    pub(super) fn is_within(&self) -> bool {
        Self::is_nothing(self.left())
    }

    /// How far the point is off the middle of the range.
    pub(super) fn off(&self) -> f32 {
        let [heading, pitch] = self.wanted;
        let cos = trig::sin_cos(heading).1 * trig::sin_cos(pitch).1;
        trig::atan2(math::sqrt(1.0 - cos * cos), cos)
    }
}

impl<const C: usize> Gaze<'_, C> {
    /// How the leading joint sees a point with the joints like this.
    pub(super) fn see(&self, joints: &[Joint], point: Vec3A) -> Option<Seen> {
        let first = self.body.first;
        let outward = |carried: Carried, index: usize| carried.outward(self.body, index, halves(&joints[index]));
        let carried = (first + 1..self.body.count).rev().fold(Carried::root(self.body), outward);
        self.seen(&carried, joints, point)
    }

    /// The same where it is known what the joints inside do.
    #[inline(always)]
    pub(super) fn seen(&self, carried: &Carried, joints: &[Joint], point: Vec3A) -> Option<Seen> {
        let first = self.body.first;
        let wanted = self.sight(carried, joints, point)?;
        Some(Seen { wanted, held: self.held(first, &joints[first], wanted) })
    }

    /// The heading and the pitch by which the leading joint looks at a point, carried like this. `None` where the point is on
    /// the effector.
    #[inline(always)]
    pub(super) fn sight(&self, carried: &Carried, joints: &[Joint], point: Vec3A) -> Option<Pair> {
        if let Some(chain) = self.chain {
            return self.sight_by_search(chain, carried, joints, point);
        }
        let local = carried.frame.transpose() * (point - carried.at);
        if !self.body.is_plain {
            return self.sight_in_rounds(local, joints);
        }
        let square = local.dot(local);
        (square > 1e-30 && square < f32::INFINITY).then(|| heading_and_pitch(local))
    }

    /// [`sight`](Self::sight) of an effector that is not at its joint: each round looks from where the last one left the
    /// effector.
    #[cold]
    fn sight_in_rounds(&self, local: Vec3A, joints: &[Joint]) -> Option<Pair> {
        let (first, effector) = (self.body.first, &self.body.effector);
        if effector.origin == Vec3A::ZERO {
            return Some(turn_to(effector.direction, math::unit(local)?));
        }
        let mut held = joints[first].angles();
        let mut wanted = held;
        for _ in 0..SIGHT_ROUNDS {
            let from = turned(&Mat3A::IDENTITY, trig::halves(held[1], held[0])) * effector.origin;
            let next = turn_to(effector.direction, math::unit(local - from)?);
            let change = [math::wrap_pi(next[0] - wanted[0]), next[1] - wanted[1]];
            wanted = next;
            held = self.held(first, &joints[first], wanted);
            if length(change) < 0.1 * SAME_RAD {
                break;
            }
        }
        Some(wanted)
    }

    /// [`sight`](Self::sight) in a pose that is not rigid, by the exact solver, the other joints held where they are.
    #[cold]
    fn sight_by_search(&self, chain: &Chain<C>, carried: &Carried, joints: &[Joint], point: Vec3A) -> Option<Pair> {
        let (body, first) = (self.body, self.body.first);
        let mut found = self.rig.array(Joint::REST);
        found.copy_from_slice(joints);
        let mut reaches = self.rig.array(Reach::REST);
        for (reach, joint) in reaches.iter_mut().zip(joints) {
            *reach = Reach::at(joint);
        }
        // Beyond its range too: what the range does not hold is to be known.
        let info = &self.rig.joints[first];
        let all = |declared: Option<[f32; 2]>, most: f32| declared.map(|_| [-most, most]);
        let declared = Angles { heading: all(info.heading, PI), pitch: all(info.pitch, FRAC_PI_2) };
        reaches[first] = Reach::range(&RangeOfMotion::new(declared, 0.0, None));
        let goal = Goal { aimed: point, ..*self.goal };
        Solver::new(self.rig, chain, &goal).settle(&mut found, &reaches, Search::Thorough)?;
        // The angles that look where the rigid links would have to look; of an angle that the joint lacks, what is left.
        let frame = carried.frame;
        let turned = turned(&frame, halves(&found[first]));
        let rigid =
            Ray { origin: carried.at + turned * body.effector.origin, direction: turned * body.effector.direction };
        let seen = chain.seen_target(point, chain.gaze_of(self.rig, &found), rigid);
        Some(turn_to(body.effector.direction, math::unit(frame.transpose() * (seen - rigid.origin))?))
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
        trig::atan2_of_both(
            [to_left * level - to_ahead * left, to_up * ahead - level * up],
            [to_ahead * level + to_left * left, level * ahead + to_up * up],
        )
    };
    let angles = turn(if ahead < -ACROSS { -level } else { level });
    if ahead.abs() <= ACROSS {
        let other = turn(-level);
        if other[0].abs() < angles[0].abs() {
            return other;
        }
    }
    angles
}
