//! [`Description`]: what was declared of a rig.

use glam::Vec3A;

use super::JointInfo;
use crate::{Axes, GazeSharing, Role, Solver, math};

/// What was declared of a rig: immutable, a constant for a derived rig.
#[derive(Clone, Copy, Debug)]
pub struct Description<'a> {
    pub(crate) joints: &'a [JointInfo],
    pub(crate) effector: Effector,
    pub(crate) sharing: GazeSharing,
    pub(crate) least_stiffness: f32,
    /// The number of declared angles.
    pub(crate) angles: usize,
    /// Whether any joint has an upright heading.
    pub(crate) has_upright: bool,
    /// Whether every range counts from the animation, has no taper, and lies within ±π.
    pub(crate) has_fixed_ranges: bool,
    /// Whether the effector is anywhere but at joint 0's origin.
    pub(crate) has_origin: bool,
    /// Whether the effector looks along joint 0's forward.
    pub(crate) aims_forward: bool,
}

impl<'a> Description<'a> {
    /// A rig of these joints, from the effector inward, that aims joint 0's forward from its origin.
    ///
    /// No joints, or more than 64: every call is [`Degenerate`](crate::Status::Degenerate).
    #[must_use]
    pub const fn new(joints: &'a [JointInfo]) -> Self {
        let origin = [0.0; 3];
        let effector = match joints.first() {
            Some(first) => Effector { forward: first.axes.forward, origin },
            None => Effector { forward: [0.0, 0.0, 1.0], origin },
        };
        let (mut least_stiffness, mut angles, mut has_upright, mut has_fixed_ranges) = (f32::INFINITY, 0, false, true);
        let mut index = 0;
        while index < joints.len() {
            let joint = &joints[index];
            least_stiffness = least_stiffness.min(joint.stiffness);
            angles += joint.pitch.is_some() as usize + joint.heading.is_some() as usize;
            has_upright |= joint.is_upright();
            has_fixed_ranges &= joint.has_fixed_ranges();
            index += 1;
        }
        let sharing = GazeSharing::HUMAN;
        let (has_origin, aims_forward) = (false, true);
        Self {
            joints,
            effector,
            sharing,
            least_stiffness,
            angles,
            has_upright,
            has_fixed_ranges,
            has_origin,
            aims_forward,
        }
    }

    /// With this effector.
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

    /// With this sharing of a gaze between the eyes and the joints that support them.
    #[must_use]
    pub const fn with_sharing(mut self, sharing: GazeSharing) -> Self {
        self.sharing = sharing;
        self
    }

    /// The joints, from the effector inward.
    #[must_use]
    pub const fn joints(&self) -> &'a [JointInfo] {
        self.joints
    }

    /// The aimed direction and point.
    #[must_use]
    pub const fn effector(&self) -> &Effector {
        &self.effector
    }

    /// The sharing of a gaze between the eyes and the joints that support them.
    #[must_use]
    pub const fn sharing(&self) -> &GazeSharing {
        &self.sharing
    }

    /// The solver that moves the joints where [`Settings::solver`](crate::Settings::solver) leaves it open:
    /// [`Natural`](Solver::Natural) for a rig whose joint 0 is an eye, else [`Exact`](Solver::Exact).
    #[must_use]
    pub const fn default_solver(&self) -> Solver {
        match self.joints.first() {
            Some(JointInfo { role: Role::Eye, .. }) => Solver::Natural,
            _ => Solver::Exact,
        }
    }

    /// Whether the effector looks along joint 0's forward from its origin.
    #[inline(always)]
    pub(crate) fn aims_joint_0(&self) -> bool {
        !self.has_origin && self.aims_forward
    }
}

/// What is aimed: a point and a unit direction fixed to joint 0, in joint 0's bone space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effector {
    /// The unit direction that is turned to the target.
    pub forward: [f32; 3],
    /// The point that the direction starts from, in the units of the bone.
    pub origin: [f32; 3],
}

impl Effector {
    /// The axes that the residual is measured along: forward, left and up in effector space, which has joint 0's axes.
    ///
    /// Joint 0's own up and left, squared to the effector's forward; where that points along up, up is where the back
    /// of the head, or the face, was.
    #[inline(always)]
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
