//! Cyclic coordinate descent: joint by joint from the tip inward, each turns so that the tip comes as near to the target
//! as it alone can bring it, over and over.

use core::f32::consts::PI;

use glam::{Quat, Vec3, Vec3A, Vec4};

use super::two_bone::{Hinge, Limb, TwoBone};
use crate::JointSet;
use crate::limits::Interval;
use crate::limits::reach::AT_LIMIT_RAD;
use crate::math::trig::atan2;
use crate::math::turn::{about, angle, at_most, normalized, part, shortest};
use crate::math::{self, cross, direction, product, turned};

/// How far a joint of a chain may be turned away from the animation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum CcdLimit {
    /// Any way, any far.
    #[default]
    Free,
    /// Any way, no further than this, radians.
    Ball {
        /// At least 0; NaN counts as that.
        most_rad: f32,
    },
    /// About one axis: a knee, an elbow.
    Hinge {
        /// As the animation holds it, in the space of the chain, of any length but zero; the right-hand rule counts. Without
        /// a direction the joint does not turn.
        axis: Vec3,
        /// The least angle, radians, 0 where the animation has it.
        least_rad: f32,
        /// The most, radians. Both infinite: it turns freely. An inverted range counts as its middle, NaN as no range.
        most_rad: f32,
    },
}

/// A joint of a chain: where it is and how far it turns; and then, how it is turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CcdJoint {
    /// Where the animation has it, in the space of the chain.
    pub position: Vec3,
    /// How far it may turn.
    pub limit: CcdLimit,
    /// The part of each turn that it leaves to the others, 0…1; 0, the default, is none, and at 1 it does not turn. Stiff shoulders
    /// leave the elbow to move first. NaN counts as 0.
    pub stiffness: f32,
    /// Whether it and the next joint move as [two bones](TwoBone): the next one flexes, about its hinge if it is one, until the tip is
    /// as far from this joint as the target, and then this joint turns. A knee that is all but straight then bends in one step.
    pub is_two_bone: bool,
    /// Out: goes before its bone's rotation in the space of the chain: `turn * animated`. Unit and finite.
    pub turn: Quat,
    /// What it turns beyond what it is carried along by the joints before: `turn` = the one before's `turn` × `added`.
    added: Quat,
    /// The same before the chain was bent out of the straight.
    unbent: Quat,
    /// Where it is by now, from the first joint, in chain lengths.
    at: Vec3A,
}

impl CcdJoint {
    /// A joint without limits.
    #[must_use]
    pub const fn new(position: Vec3) -> Self {
        let at = Vec3A::ZERO;
        let (turn, added, unbent) = (Quat::IDENTITY, Quat::IDENTITY, Quat::IDENTITY);
        Self { position, limit: CcdLimit::Free, stiffness: 0.0, is_two_bone: false, turn, added, unbent, at }
    }

    /// With this limit.
    #[must_use]
    pub const fn with_limit(mut self, limit: CcdLimit) -> Self {
        self.limit = limit;
        self
    }

    /// Leaving this part of each turn to the others, 0…1.
    #[must_use]
    pub const fn with_stiffness(mut self, stiffness: f32) -> Self {
        self.stiffness = stiffness;
        self
    }

    /// Moving with the next joint as two bones: a hip before a knee, a shoulder before an elbow.
    #[must_use]
    pub const fn with_two_bones(mut self) -> Self {
        self.is_two_bone = true;
        self
    }

    /// What its limit bounds: the turn that it adds to the animation, in the space of the animated chain.
    #[must_use]
    pub const fn added(&self) -> Quat {
        self.added
    }
}

/// The solver of chains.
///
/// ```
/// use aim_runtime::glam::Vec3;
/// use aim_runtime::ik::{Ccd, CcdJoint, CcdLimit, CcdStatus};
///
/// let knee = CcdLimit::Hinge { axis: Vec3::X, least_rad: 0.0, most_rad: 2.4 };
/// let mut leg = [
///     CcdJoint::new(Vec3::new(0.0, 1.0, 0.0)).with_limit(CcdLimit::Ball { most_rad: 1.5 }),
///     CcdJoint::new(Vec3::new(0.0, 0.5, 0.02)).with_limit(knee),
/// ];
/// let outcome = Ccd::new().solve(&mut leg, Vec3::ZERO, Vec3::new(0.1, 0.3, 0.3));
/// assert_eq!(outcome.status, CcdStatus::Reached);
/// assert!(outcome.iterations <= 50);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Ccd {
    /// How far from the target the tip may stay, as a part of the chain's length. Default 1e-4.
    pub tolerance: f32,
    /// How often it goes through the chain at most. Default 50.
    pub iterations: u32,
}

impl Default for Ccd {
    fn default() -> Self {
        Self::new()
    }
}

/// What became of a call of [`Ccd::solve`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CcdOutcome {
    /// Where the tip is then, by forward kinematics.
    pub tip: Vec3,
    /// How far that is from the target.
    pub error: f32,
    /// How often it went through the chain.
    pub iterations: u32,
    /// The joints at an end of their limits, by their index.
    pub at_limit: JointSet,
    /// Why it ended.
    pub status: CcdStatus,
}

/// Why the descent ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CcdStatus {
    /// The tip is within the tolerance.
    Reached,
    /// The iterations are used up.
    IterationLimit,
    /// No joint brings the tip any nearer: the target is out of reach, of the limits, or of the method.
    Stuck,
    /// Something is no number, or the chain has no joint, or its length is zero or not finite: nothing is turned.
    Degenerate,
}

/// A pass in which no joint turns by more than this has come to rest, radians.
const REST_RAD: f32 = 2e-6;
/// How far a chain that is straight along the way to its target is bent to begin with, radians.
const BEND_RAD: f32 = 0.1;

impl Ccd {
    /// To 1e-4 of the chain's length, in 50 iterations at most.
    #[must_use]
    pub const fn new() -> Self {
        Self { tolerance: 1e-4, iterations: 50 }
    }

    /// To this part of the chain's length.
    #[must_use]
    pub const fn with_tolerance(mut self, tolerance: f32) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// In so many iterations at most.
    #[must_use]
    pub const fn with_iterations(mut self, iterations: u32) -> Self {
        self.iterations = iterations;
        self
    }

    /// Turns `joints`, from the root outward, so that `tip`, carried by the last of them, comes to `target`. All in one
    /// space.
    ///
    /// Starts from the animation on every call, so that equal input has equal output; where a hinge's range leaves the
    /// animation out, from the nearest angle within.
    pub fn solve(&self, joints: &mut [CcdJoint], tip: Vec3, target: Vec3) -> CcdOutcome {
        joints.iter_mut().for_each(|joint| (joint.turn, joint.added) = (Quat::IDENTITY, Quat::IDENTITY));
        let unmoved = CcdOutcome {
            tip,
            error: math::length(Vec3A::from(target - tip)),
            iterations: 0,
            at_limit: JointSet::EMPTY,
            status: CcdStatus::Degenerate,
        };
        let Some(chain) = Chain::new(joints, tip, target) else { return unmoved };
        let solved = chain.descend(joints, self);
        let root = Vec3A::from(joints[0].position);
        let tip = root + chain.pose(joints) * chain.scale;
        let mut at_limit = JointSet::EMPTY;
        for (index, joint) in joints.iter().enumerate() {
            if joint.is_at_limit() {
                at_limit.insert(index);
            }
        }
        let error = math::length(Vec3A::from(target) - tip);
        CcdOutcome { tip: tip.into(), error, at_limit, ..solved }
    }
}

/// What does not change while joints turn. The first joint is the origin, the chain's length is 1.
struct Chain {
    tip: Vec3A,
    target: Vec3A,
    scale: f32,
}

impl Chain {
    fn new(joints: &[CcdJoint], tip: Vec3, target: Vec3) -> Option<Self> {
        let root = joints.first()?.position;
        let ends = joints.iter().skip(1).map(|joint| joint.position).chain([tip]);
        let bones = joints.iter().zip(ends).map(|(joint, end)| Vec3A::from(end - joint.position));
        let scale = bones.fold(0.0, |sum, bone| sum + math::length(bone));
        let relative = |point: Vec3| Vec3A::from(point - root) / scale;
        let chain = Self { tip: relative(tip), target: relative(target), scale };
        let finite = joints.iter().all(|joint| relative(joint.position).is_finite());
        (scale > 0.0
            && scale.is_finite()
            && finite
            && chain.tip.is_finite()
            && chain.target.is_finite()
            && target.is_finite())
        .then_some(chain)
    }

    fn relative(&self, joints: &[CcdJoint], index: usize) -> Vec3A {
        match joints.get(index) {
            Some(joint) => Vec3A::from(joint.position - joints[0].position) / self.scale,
            None => self.tip,
        }
    }

    /// Where joints and tip are with what is added; the joints learn their turns.
    fn pose(&self, joints: &mut [CcdJoint]) -> Vec3A {
        let (mut turn, mut at) = (Quat::IDENTITY, Vec3A::ZERO);
        for index in 0..joints.len() {
            let bone = self.relative(joints, index + 1) - self.relative(joints, index);
            let joint = &mut joints[index];
            // Long products stay units.
            turn = normalized(product(turn, joint.added));
            (joint.turn, joint.at) = (turn, at);
            at += turned(turn, bone);
        }
        at
    }

    fn descend(&self, joints: &mut [CcdJoint], settings: &Ccd) -> CcdOutcome {
        joints.iter_mut().for_each(|joint| joint.hold(Quat::IDENTITY));
        let tolerance = settings.tolerance.max(0.0);
        let mut tip = self.pose(joints);
        let mut best = math::length(self.target - tip);
        // The error before the chain was bent out of the straight.
        let (mut iterations, mut unbent) = (0, None);
        let status = loop {
            // Judged with the digits of rounding to spare.
            if best <= tolerance {
                break CcdStatus::Reached;
            }
            if iterations >= settings.iterations {
                break CcdStatus::IterationLimit;
            }
            iterations += 1;
            let moved = self.pass(joints, tip);
            tip = self.pose(joints);
            if moved <= REST_RAD {
                // Where all is in one line no joint knows which way to go.
                if unbent.is_some() || !(math::length(self.target) < 1.0) || !self.is_straight(joints, tip) {
                    break CcdStatus::Stuck;
                }
                unbent = Some(best);
                self.bend(joints, tip);
                tip = self.pose(joints);
            }
            best = math::length(self.target - tip);
        };
        if unbent.is_some_and(|unbent| best > unbent) {
            joints.iter_mut().for_each(|joint| joint.added = joint.unbent);
        }
        CcdOutcome { tip: Vec3::ZERO, error: 0.0, iterations, at_limit: JointSet::EMPTY, status }
    }

    /// Each joint once, from the tip inward; the largest turn of any, radians.
    fn pass(&self, joints: &mut [CcdJoint], mut tip: Vec3A) -> f32 {
        let mut largest: f32 = 0.0;
        for index in (0..joints.len()).rev() {
            if joints[index].is_two_bone {
                let (flexed, turn) = self.flex(joints, index, tip);
                (tip, largest) = (flexed, largest.max(turn));
            }
            // What carries this joint has not moved in this pass.
            let carried = if index == 0 { Quat::IDENTITY } else { joints[index - 1].turn };
            let joint = &mut joints[index];
            // Seen from the joint, in the space of the animated chain.
            let back = carried.conjugate();
            let [to_tip, to_target] = [tip, self.target].map(|point| turned(back, point - joint.at));
            let before = joint.added;
            joint.turn_towards(to_tip, to_target);
            let turn = normalized(product(joint.added, before.conjugate()));
            largest = largest.max(angle(turn));
            tip = joint.at + turned(carried, turned(turn, to_tip));
        }
        largest
    }

    /// Flexes the joint after this one so that the tip is as far from this one as the target; where the tip is then, and the turn, radians.
    fn flex(&self, joints: &mut [CcdJoint], index: usize, tip: Vec3A) -> (Vec3A, f32) {
        let [upper, lower, ..] = &mut joints[index..] else { return (tip, 0.0) };
        let carried = upper.turn;
        let hinge = lower.limit.hinge().map(|(axis, range)| {
            // Flexing is the way in which the hinge turns farther.
            let axis = if range.hi() < -range.lo() { -axis } else { axis };
            Hinge { axis: turned(carried, axis).into(), least_rad: 0.0, most_rad: PI }
        });
        let limb = Limb { root: upper.at.into(), middle: lower.at.into(), tip: tip.into() };
        let solved = TwoBone { hinge, ..TwoBone::new() }.solve(&limb, self.target.into());
        // What the lower bone turns beyond the upper one, as seen in the animated chain.
        let flexion = product(solved.upper.conjugate(), solved.lower);
        let flexion = product(product(carried.conjugate(), flexion), carried);
        let before = lower.added;
        lower.move_to(product(flexion, before));
        let turn = normalized(product(lower.added, before.conjugate()));
        let to_tip = turned(carried.conjugate(), tip - lower.at);
        (lower.at + turned(carried, turned(turn, to_tip)), angle(turn))
    }

    /// Whether joints, tip and target lie on one line.
    fn is_straight(&self, joints: &[CcdJoint], tip: Vec3A) -> bool {
        let Some(line) = direction(self.target).or_else(|| direction(tip)) else { return false };
        let beside = |point: Vec3A| math::length(cross(line, point)) > 1e-4;
        !beside(tip) && !joints.iter().any(|joint| beside(joint.at))
    }

    /// Bends every joint by its share of a little, in a plane of its own choice or its hinge's.
    fn bend(&self, joints: &mut [CcdJoint], tip: Vec3A) {
        let line = direction(tip).or_else(|| direction(self.target)).unwrap_or(Vec3A::X);
        let across = line.any_orthonormal_vector();
        for joint in joints {
            joint.unbent = joint.added;
            let by = BEND_RAD * joint.share();
            match joint.limit.hinge() {
                Some((axis, range)) => {
                    let at = about_axis(joint.added, axis);
                    let there = range.hold(at + by);
                    let there = if there == at { range.hold(at - by) } else { there };
                    joint.added = about(axis, 0.5 * there);
                }
                None => joint.hold(product(about(across, 0.5 * by), joint.added)),
            }
        }
    }
}

impl CcdLimit {
    /// The axis and range of a hinge; the axis is zero where it has none.
    fn hinge(&self) -> Option<(Vec3A, Interval)> {
        match *self {
            Self::Hinge { axis, least_rad, most_rad } => {
                let axis = direction(axis.into());
                let range = Interval::declared(axis.map(|_| [least_rad, most_rad]));
                let half_turn = Interval::declared(Some([-PI, PI]));
                Some((axis.unwrap_or(Vec3A::X), if range.is_free() { range } else { range.common(half_turn) }))
            }
            _ => None,
        }
    }
}

impl CcdJoint {
    /// Adds this turn, or what the limit lets of it.
    fn hold(&mut self, added: Quat) {
        self.added = match self.limit {
            CcdLimit::Free => normalized(added),
            CcdLimit::Ball { most_rad } => at_most(normalized(added), most_rad.max(0.0)),
            CcdLimit::Hinge { .. } => match self.limit.hinge() {
                Some((axis, range)) => about(axis, 0.5 * range.hold(about_axis(added, axis))),
                None => added,
            },
        };
    }

    /// The part of each turn that it takes, 0…1.
    fn share(&self) -> f32 {
        1.0 - self.stiffness.max(0.0).min(1.0)
    }

    /// Adds as much of the way to this turn as the joint's stiffness and its limit let it.
    fn move_to(&mut self, added: Quat) {
        let share = self.share();
        if share < 1.0 {
            let way = part(normalized(product(added, self.added.conjugate())), share);
            self.hold(product(way, self.added));
        } else {
            self.hold(added);
        }
    }

    /// Turns so that what is at `from`, as seen from the joint, comes nearest to `to`.
    fn turn_towards(&mut self, from: Vec3A, to: Vec3A) {
        match self.limit.hinge() {
            Some((axis, range)) => {
                let flat = |v: Vec3A| direction(v).map(|v| v - axis * v.dot(axis));
                let (Some(from), Some(to)) = (flat(from), flat(to)) else { return };
                let by = atan2(axis.dot(cross(from, to)), from.dot(to));
                let at = about_axis(self.added, axis);
                let there = at + by * self.share();
                let there = if range.is_free() { math::wrap_pi(there) } else { range.hold(there) };
                self.added = about(axis, 0.5 * there);
            }
            None => {
                if let (Some(from), Some(to)) = (direction(from), direction(to)) {
                    self.move_to(product(shortest(from, to), self.added));
                }
            }
        }
    }

    fn is_at_limit(&self) -> bool {
        match self.limit {
            CcdLimit::Free => false,
            CcdLimit::Ball { most_rad } => angle(self.added) >= most_rad.max(0.0) - AT_LIMIT_RAD,
            CcdLimit::Hinge { .. } => self.limit.hinge().is_some_and(|(axis, range)| {
                let at = about_axis(self.added, axis);
                at <= range.lo() + AT_LIMIT_RAD || at >= range.hi() - AT_LIMIT_RAD
            }),
        }
    }
}

/// The angle of a turn about a unit axis, radians, −π…π.
fn about_axis(turn: Quat, axis: Vec3A) -> f32 {
    let turn = if turn.w < 0.0 { -turn } else { turn };
    2.0 * atan2(Vec3A::from_vec4(Vec4::from(turn)).dot(axis), turn.w)
}
