//! [`Description`]: the declared data of a rig.

use glam::{Vec3A, Vec4};

use super::JointInfo;
use super::body_part::{self, BodyPart, MOST_PARTS};
use crate::limits::reach::AT_LIMIT_RAD;
use crate::limits::{Interval, RangeOfMotion};
use crate::{Axes, Budget, Budgets, GazeSharing, Role, Solver, math};

/// Number of joints whose angles a description has in [`Lanes`].
pub(crate) const LANE_JOINTS: usize = 8;

/// Declared data of a rig: joints, effector, gaze sharing and budgets. Immutable; a constant for a derived rig.
///
/// ```
/// use aim_runtime::{Axes, Budgets, Description, JointInfo, Role, Solver};
///
/// const AXES: Axes = Axes { up: [0.0, 1.0, 0.0], forward: [0.0, 0.0, 1.0], left: [1.0, 0.0, 0.0] };
/// const JOINTS: [JointInfo; 2] = [
///     JointInfo::new(AXES, 7.0).with_heading(-0.6, 0.6).with_pitch(-0.4, 0.3).with_role(Role::Eye),
///     JointInfo::new(AXES, 3.0).with_heading(-1.0, 1.0).with_pitch(-0.7, 0.6).with_role(Role::Neck),
/// ];
/// const BIRD: Description<'static> = Description::new(&JOINTS).with_budgets(Budgets::BIRD);
/// assert_eq!((BIRD.joints().len(), BIRD.default_solver()), (2, Solver::Natural));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Description<'a> {
    pub(crate) joints: &'a [JointInfo],
    pub(crate) effector: Effector,
    pub(crate) sharing: GazeSharing,
    pub(crate) budgets: Budgets,
    pub(crate) least_stiffness: f32,
    /// Number of declared angles.
    pub(crate) angles: usize,
    /// `true` if any joint has an upright heading.
    pub(crate) has_upright: bool,
    /// `true` if the axes of every joint are orthonormal.
    pub(crate) is_square: bool,
    /// `true` if every range is counted from the animation, has no taper, and lies within ±π.
    pub(crate) has_fixed_ranges: bool,
    default_solver: Solver,
    /// `true` if the effector's origin is not joint 0's.
    pub(crate) has_origin: bool,
    /// `true` if the effector's direction is joint 0's forward.
    pub(crate) aims_forward: bool,
    pub(crate) lanes: AllLanes,
    /// Body parts that regions move if joint 0 is aimed.
    pub(crate) parts: [BodyPart; MOST_PARTS],
    /// Number of body parts, which may exceed [`MOST_PARTS`].
    pub(crate) part_count: usize,
}

impl<'a> Description<'a> {
    /// Creates the description of a rig with these joints, given from the effector inward. The effector is joint 0's
    /// forward from joint 0's origin.
    ///
    /// With no joints or more than 64, every call is [`Degenerate`](crate::Status::Degenerate).
    #[must_use]
    pub const fn new(joints: &'a [JointInfo]) -> Self {
        let origin = [0.0; 3];
        let effector = match joints.first() {
            Some(first) => Effector { forward: first.axes.forward, origin },
            None => Effector { forward: [0.0, 0.0, 1.0], origin },
        };
        let (mut least_stiffness, mut angles, mut has_upright, mut has_fixed_ranges) = (f32::INFINITY, 0, false, true);
        let mut is_square = true;
        let mut default_solver = Solver::Exact;
        let mut index = 0;
        while index < joints.len() {
            let joint = &joints[index];
            least_stiffness = least_stiffness.min(joint.stiffness);
            angles += joint.pitch.is_some() as usize + joint.heading.is_some() as usize;
            has_upright |= joint.is_upright();
            is_square &= joint.planes.are_square();
            has_fixed_ranges &= joint.has_fixed_ranges();
            if !matches!(joint.role, Role::None) {
                default_solver = Solver::Natural;
            }
            index += 1;
        }
        let sharing = GazeSharing::HUMAN;
        let (has_origin, aims_forward) = (false, true);
        let mut lanes = [Lanes::new(joints, 0, least_stiffness); LANE_JOINTS / 2];
        let mut k = 1;
        while k < lanes.len() {
            lanes[k] = Lanes::new(joints, k, least_stiffness);
            k += 1;
        }
        let mut parts = [BodyPart::NONE; MOST_PARTS];
        let part_count = BodyPart::find(joints, 0, &Budgets::HUMAN, &mut parts);
        Self {
            joints,
            effector,
            sharing,
            budgets: Budgets::HUMAN,
            least_stiffness,
            angles,
            has_upright,
            is_square,
            has_fixed_ranges,
            default_solver,
            has_origin,
            aims_forward,
            lanes,
            parts,
            part_count,
        }
    }

    /// Sets the [`effector`](Self::effector).
    #[must_use]
    pub const fn with_effector(mut self, effector: Effector) -> Self {
        const fn are_same([a, b, c]: [f32; 3], [d, e, f]: [f32; 3]) -> bool {
            a == d && b == e && c == f
        }
        self.has_origin = !are_same(effector.origin, [0.0; 3]);
        self.aims_forward = match self.joints.first() {
            Some(first) => are_same(effector.forward, first.axes.forward),
            None => false,
        };
        self.effector = effector;
        self
    }

    /// Sets the [sharing](Self::sharing) of a natural gaze between the eyes and the joints that support them. A human's
    /// by default.
    #[must_use]
    pub const fn with_sharing(mut self, sharing: GazeSharing) -> Self {
        self.sharing = sharing;
        self
    }

    /// Returns the budget of the body part that a role belongs to.
    pub(crate) const fn budget(&self, role: Role) -> Budget {
        body_part::budget(&self.budgets, role)
    }

    /// Sets the [`budgets`](Self::budgets) of the body parts, for the [natural](Solver::Natural) solver. A human's by
    /// default.
    #[must_use]
    pub const fn with_budgets(mut self, budgets: Budgets) -> Self {
        self.budgets = budgets;
        self.part_count = BodyPart::find(self.joints, 0, &budgets, &mut self.parts);
        self
    }

    /// Returns the joints, from the effector inward.
    #[must_use]
    pub const fn joints(&self) -> &'a [JointInfo] {
        self.joints
    }

    /// Returns the effector: the direction that is aimed, and its origin.
    #[must_use]
    pub const fn effector(&self) -> &Effector {
        &self.effector
    }

    /// Returns the sharing of a natural gaze between the eyes and the joints that support them.
    #[must_use]
    pub const fn sharing(&self) -> &GazeSharing {
        &self.sharing
    }

    /// Returns the turn budgets of the body parts in a natural gaze.
    #[must_use]
    pub const fn budgets(&self) -> &Budgets {
        &self.budgets
    }

    /// Returns the solver that is used if [`Settings::solver`](crate::Settings::solver) is `None`:
    /// [`Natural`](Solver::Natural) for a rig in which any joint has a role, otherwise [`Exact`](Solver::Exact).
    #[must_use]
    pub const fn default_solver(&self) -> Solver {
        self.default_solver
    }

    /// Returns `true` if the rig has [`EXACT_JOINTS`](super::EXACT_JOINTS) joints: an eye that leads, and two body parts
    /// of one joint each.
    #[cfg(not(aim_small))]
    pub(crate) fn is_eye_head_chest(&self) -> bool {
        self.joints.len() == super::EXACT_JOINTS && self.part_count == 2 && self.parts[1].outer == 1
    }

    /// Returns `true` if the effector is joint 0's forward from joint 0's origin.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn aims_joint_0(&self) -> bool {
        !self.has_origin && self.aims_forward
    }
}

/// Declared data for the angles of the first [`LANE_JOINTS`] joints.
pub(crate) type AllLanes = [Lanes; LANE_JOINTS / 2];

/// Declared data for four angles: pitch and heading of one joint, then of the next. An angle that is not declared has
/// the range 0 alone.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lanes {
    /// Lower ends of the ranges.
    pub(crate) least: Vec4,
    /// Upper ends of the ranges.
    pub(crate) most: Vec4,
    /// Angles below which an angle counts as at its lower end; −∞ for an angle that is not declared.
    pub(crate) low: Vec4,
    /// Angles above which an angle counts as at its upper end; ∞ for an angle that is not declared.
    pub(crate) high: Vec4,
    /// Rates, rad/s, not negative.
    pub(crate) rate: Vec4,
    /// Half the ease, where ease = least stiffness of the rig / stiffness of the joint. The factor one half leaves half
    /// of the way to rest to later frames, as the general solver does.
    pub(crate) half_ease: Vec4,
}

impl Lanes {
    /// Returns the declared ranges of the first or the second joint, if they are fixed.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn motion(&self, joint: usize) -> RangeOfMotion {
        let range = |lane: usize| Interval::ordered(self.least[lane], self.most[lane]);
        RangeOfMotion { heading: range(2 * joint + 1), pitch: range(2 * joint), taper: None }
    }

    /// Creates the lanes of joints 2k and 2k + 1.
    const fn new(joints: &[JointInfo], k: usize, least_stiffness: f32) -> Self {
        let [mut least, mut most, mut rate, mut half_ease] = [[0.0; 4]; 4];
        let (mut low, mut high) = ([f32::NEG_INFINITY; 4], [f32::INFINITY; 4]);
        let mut lane = 0;
        while lane < 4 && 2 * k + lane / 2 < joints.len() {
            let info = &joints[2 * k + lane / 2];
            rate[lane] = info.rate.max(0.0);
            // A quotient that is NaN counts as the least ease.
            half_ease[lane] = 0.5 * (least_stiffness / info.stiffness).max(1e-6).min(1.0);
            if let Some([lo, hi]) = if lane % 2 == 0 { info.pitch } else { info.heading } {
                (least[lane], most[lane]) = (lo, hi);
                (low[lane], high[lane]) = (lo + AT_LIMIT_RAD, hi - AT_LIMIT_RAD);
            }
            lane += 1;
        }
        let [least, most, low] = [Vec4::from_array(least), Vec4::from_array(most), Vec4::from_array(low)];
        let [high, rate, half_ease] = [Vec4::from_array(high), Vec4::from_array(rate), Vec4::from_array(half_ease)];
        Self { least, most, low, high, rate, half_ease }
    }
}

/// The ray that is aimed: an origin and a unit direction fixed to joint 0, in joint 0's bone space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effector {
    /// Unit direction that is turned towards the target.
    pub forward: [f32; 3],
    /// Origin of the direction, in the bone's units of length.
    pub origin: [f32; 3],
}

impl Effector {
    /// Returns the axes along which the residual is measured: forward, left and up in effector space, which has joint
    /// 0's axes.
    ///
    /// They are joint 0's up and left, orthogonalised against the effector's forward. If the effector looks along joint
    /// 0's up, its up is joint 0's backward direction; if it looks down, joint 0's forward.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn axes(&self, first: &Axes) -> [Vec3A; 3] {
        let [up, forward, left] = [first.up, first.forward, first.left].map(Vec3A::from);
        if self.forward == first.forward { [forward, left, up] } else { self.turned_axes(up, forward, left) }
    }

    #[cold]
    fn turned_axes(&self, up: Vec3A, forward: Vec3A, left: Vec3A) -> [Vec3A; 3] {
        /// The sine of half a degree.
        const ALONG: f32 = 0.008_726_535;
        let handedness = math::cross(up, forward).dot(left).signum();
        let aimed = Vec3A::from(self.forward);
        let along = up.dot(aimed);
        let up = if math::cross(up, aimed).length() < ALONG { forward * -along.signum() } else { up };
        let up = math::direction(up - aimed * aimed.dot(up)).unwrap_or(Vec3A::ZERO);
        [aimed, math::cross(up, aimed) * handedness, up]
    }
}
