//! Cyclic coordinate descent: passes over the joints from the tip inward, and turns each so that it alone brings the
//! tip as near to the target as possible, until the tip arrives or the chain comes to rest.

use core::f32::consts::PI;

use glam::{Quat, Vec3, Vec3A, Vec4};

use super::two_bone::{Hinge, Limb, TwoBone};
use crate::JointSet;
use crate::limits::Interval;
use crate::limits::reach::AT_LIMIT_RAD;
use crate::math::trig::atan2;
use crate::math::turn::{about, angle, at_most, normalized, part, shortest};
use crate::math::{self, cross, direction, product, turned};

/// Limit on a joint's turn away from the animation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum CcdLimit {
    /// No limit.
    #[default]
    Free,
    /// A turn about any axis by at most this angle.
    Ball {
        /// Largest angle of the turn, radians. Negative values and NaN count as 0.
        most_rad: f32,
    },
    /// A turn about one axis: a knee, an elbow.
    Hinge {
        /// Axis in the animated pose, in the space of the chain, of any length but zero; the right-hand rule applies.
        /// If it has no direction, the joint does not turn.
        axis: Vec3,
        /// Least angle, radians; 0 is the animated pose.
        least_rad: f32,
        /// Largest angle, radians. If both ends are infinite, the joint turns freely. An inverted range counts as its
        /// middle; a range with NaN counts as 0 alone.
        most_rad: f32,
    },
}

/// A joint of a chain. Input: position, limit and stiffness. Output: [`turn`](Self::turn).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CcdJoint {
    /// Animated position, in the space of the chain.
    pub position: Vec3,
    /// Limit on the joint's turn away from the animation.
    pub limit: CcdLimit,
    /// Fraction of each turn that the joint leaves to the other joints, 0…1; at 1 it does not turn. A stiff shoulder
    /// lets the elbow move first. Values outside are clamped, NaN counts as 0. Default 0.
    pub stiffness: f32,
    /// `true` if this joint and the next one move as [two bones](TwoBone): the next joint first flexes, about its hinge
    /// axis if it has one, until the tip is as far from this joint as the target is; then this joint turns. This lets
    /// an almost straight knee bend in a single step.
    pub is_two_bone: bool,
    /// Output: rotation to apply before the bone's rotation in the space of the chain: `turn * animated`. Unit and
    /// finite.
    pub turn: Quat,
    /// Turn that this joint adds to that of the previous joint: `turn` = previous `turn` × `added`.
    added: Quat,
    /// Value of `added` before a straight chain was bent.
    unbent: Quat,
    /// Current position relative to the first joint, in chain lengths.
    at: Vec3A,
}

impl CcdJoint {
    /// Creates a joint without limits.
    #[must_use]
    pub const fn new(position: Vec3) -> Self {
        let at = Vec3A::ZERO;
        let (turn, added, unbent) = (Quat::IDENTITY, Quat::IDENTITY, Quat::IDENTITY);
        Self { position, limit: CcdLimit::Free, stiffness: 0.0, is_two_bone: false, turn, added, unbent, at }
    }

    /// Sets the [`limit`](Self::limit).
    #[must_use]
    pub const fn with_limit(mut self, limit: CcdLimit) -> Self {
        self.limit = limit;
        self
    }

    /// Sets the [`stiffness`](Self::stiffness), 0…1.
    #[must_use]
    pub const fn with_stiffness(mut self, stiffness: f32) -> Self {
        self.stiffness = stiffness;
        self
    }

    /// Makes this joint and the next one move as [two bones](Self::is_two_bone): a hip before a knee, a shoulder before
    /// an elbow.
    #[must_use]
    pub const fn with_two_bones(mut self) -> Self {
        self.is_two_bone = true;
        self
    }

    /// Returns the turn that the joint adds to the animation, in the space of the animated chain. This is the turn that
    /// its limit bounds.
    #[must_use]
    pub const fn added(&self) -> Quat {
        self.added
    }
}

/// Solver for chains of any number of joints.
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
    /// Distance from the target up to which the tip counts as arrived, as a fraction of the chain's length. Default
    /// 1e-4.
    pub tolerance: f32,
    /// Maximum number of passes over the chain. Default 50.
    pub iterations: u32,
}

impl Default for Ccd {
    fn default() -> Self {
        Self::new()
    }
}

/// Result of [`Ccd::solve`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CcdOutcome {
    /// Resulting position of the tip, by forward kinematics.
    pub tip: Vec3,
    /// Distance of the resulting tip from the target.
    pub error: f32,
    /// Number of passes over the chain.
    pub iterations: u32,
    /// Joints at an end of their limits, by index from the root outward.
    pub at_limit: JointSet,
    /// Reason why the iteration ended.
    pub status: CcdStatus,
}

/// Reason why the iteration ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CcdStatus {
    /// The tip is within the tolerance of the target.
    Reached,
    /// The maximum number of passes was reached first.
    IterationLimit,
    /// No joint brings the tip nearer: the target is beyond the chain's length or limits, or the method is at a local
    /// optimum.
    Stuck,
    /// An input is not finite, the chain has no joint, or its length is zero or not finite. Nothing is turned.
    Degenerate,
}

/// Angle below which every turn of a pass must stay for the chain to count as at rest, radians.
const REST_RAD: f32 = 2e-6;
/// Initial bend of each joint of a chain that is straight along the line to its target, radians.
const BEND_RAD: f32 = 0.1;

impl Ccd {
    /// Creates a solver with a tolerance of 1e-4 of the chain's length and at most 50 passes.
    #[must_use]
    pub const fn new() -> Self {
        Self { tolerance: 1e-4, iterations: 50 }
    }

    /// Sets the [`tolerance`](Self::tolerance), as a fraction of the chain's length.
    #[must_use]
    pub const fn with_tolerance(mut self, tolerance: f32) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// Sets the maximum number of [passes](Self::iterations).
    #[must_use]
    pub const fn with_iterations(mut self, iterations: u32) -> Self {
        self.iterations = iterations;
        self
    }

    /// Turns `joints`, given from the root outward, so that `tip`, which moves with the last joint, comes to `target`.
    /// All arguments are in one space.
    ///
    /// Every call starts from the animation, so equal input gives equal output. If a hinge's range excludes the
    /// animated angle 0, it starts from the nearest angle within.
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

/// Constants of one call, relative to the first joint and scaled so that the chain's length is 1.
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

    /// Updates the joints' positions and accumulated turns from `added`. Returns the position of the tip.
    fn pose(&self, joints: &mut [CcdJoint]) -> Vec3A {
        let (mut turn, mut at) = (Quat::IDENTITY, Vec3A::ZERO);
        for index in 0..joints.len() {
            let bone = self.relative(joints, index + 1) - self.relative(joints, index);
            let joint = &mut joints[index];
            // Renormalise, so that long products stay unit.
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
        // Distance to the target before a straight chain was bent.
        let (mut iterations, mut unbent) = (0, None);
        let status = loop {
            // In chain lengths; the outcome's error is measured again in the caller's units.
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
                // If joints, tip and target are on one line, no joint has a direction to turn in.
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

    /// Turns each joint once, from the tip inward. Returns the largest turn of any joint, radians.
    fn pass(&self, joints: &mut [CcdJoint], mut tip: Vec3A) -> f32 {
        let mut largest: f32 = 0.0;
        for index in (0..joints.len()).rev() {
            if joints[index].is_two_bone {
                let (flexed, turn) = self.flex(joints, index, tip);
                (tip, largest) = (flexed, largest.max(turn));
            }
            // The joints further in, which carry this one, have not moved yet in this pass.
            let carried = if index == 0 { Quat::IDENTITY } else { joints[index - 1].turn };
            let joint = &mut joints[index];
            // Directions from the joint, in the space of the animated chain.
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

    /// Flexes the joint after `index` so that the tip is as far from joint `index` as the target is. Returns the new
    /// position of the tip and the angle of the turn, radians.
    fn flex(&self, joints: &mut [CcdJoint], index: usize, tip: Vec3A) -> (Vec3A, f32) {
        let [upper, lower, ..] = &mut joints[index..] else { return (tip, 0.0) };
        let carried = upper.turn;
        let hinge = lower.limit.hinge().map(|(axis, range)| {
            // Flexion is in the direction in which the hinge's range is larger.
            let axis = if range.hi() < -range.lo() { -axis } else { axis };
            Hinge { axis: turned(carried, axis).into(), least_rad: 0.0, most_rad: PI }
        });
        let limb = Limb { root: upper.at.into(), middle: lower.at.into(), tip: tip.into() };
        let solved = TwoBone { hinge, ..TwoBone::new() }.solve(&limb, self.target.into());
        // Turn of the lower bone relative to the upper one, in the space of the animated chain.
        let flexion = product(solved.upper.conjugate(), solved.lower);
        let flexion = product(product(carried.conjugate(), flexion), carried);
        let before = lower.added;
        lower.move_to(product(flexion, before));
        let turn = normalized(product(lower.added, before.conjugate()));
        let to_tip = turned(carried.conjugate(), tip - lower.at);
        (lower.at + turned(carried, turned(turn, to_tip)), angle(turn))
    }

    /// Returns `true` if joints, tip and target lie on one line.
    fn is_straight(&self, joints: &[CcdJoint], tip: Vec3A) -> bool {
        let Some(line) = direction(self.target).or_else(|| direction(tip)) else { return false };
        let beside = |point: Vec3A| math::length(cross(line, point)) > 1e-4;
        !beside(tip) && !joints.iter().any(|joint| beside(joint.at))
    }

    /// Bends every joint by [`BEND_RAD`], less its stiffness, about its hinge axis or about one common axis orthogonal
    /// to the chain.
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
    /// Returns unit axis and range of a hinge. Without a usable axis: any axis, with the range 0 alone.
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
    /// Sets `added` to this turn, clamped to the limit.
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

    /// Returns the fraction of each turn that the joint takes, 0…1.
    fn share(&self) -> f32 {
        1.0 - self.stiffness.max(0.0).min(1.0)
    }

    /// Moves `added` towards this turn, by the fraction that the stiffness leaves, within the limit.
    fn move_to(&mut self, added: Quat) {
        let share = self.share();
        if share < 1.0 {
            let way = part(normalized(product(added, self.added.conjugate())), share);
            self.hold(product(way, self.added));
        } else {
            self.hold(added);
        }
    }

    /// Turns the joint so that the point at `from`, relative to the joint, comes nearest to `to`.
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

/// Returns the angle of a turn about a unit axis, radians, −π…π.
fn about_axis(turn: Quat, axis: Vec3A) -> f32 {
    let turn = if turn.w < 0.0 { -turn } else { turn };
    2.0 * atan2(Vec3A::from_vec4(Vec4::from(turn)).dot(axis), turn.w)
}
