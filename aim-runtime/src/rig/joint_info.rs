//! [`JointInfo`]: what was declared of a joint.

use core::f32::consts::PI;

use glam::Quat;

use crate::kinematics::rotation::{Planes, joint_turn};
use crate::math::Bounded;
use crate::{Axes, Joint, LimitsFrom, Role};

/// What was declared of a joint. Angles in radians.
///
/// ```
/// use aim_runtime::glam::{Quat, Vec3};
/// use aim_runtime::{Axes, JointInfo, Role};
///
/// let axes = Axes { up: [0.0, 1.0, 0.0], forward: [0.0, 0.0, 1.0], left: [1.0, 0.0, 0.0] };
/// let neck = JointInfo::new(axes, 3.0).with_heading(-1.0, 1.0).with_pitch(-0.7, 0.6).with_role(Role::Neck);
/// assert!((neck.rotation(0.5, 0.0) * Vec3::Z).x > 0.0); // to the left
/// assert!((neck.rotation(0.0, 0.5) * Vec3::Z).y > 0.0); // up
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct JointInfo {
    pub(crate) axes: Axes,
    pub(crate) planes: Planes,
    /// Range of the heading, `[lo, hi]` around 0; `None` for a joint that does not turn sideways. Infinite where it
    /// was declared `free`.
    pub heading: Option<[f32; 2]>,
    /// Range of the pitch, `[lo, hi]` around 0; `None` for a joint that does not nod.
    pub pitch: Option<[f32; 2]>,
    /// Largest speed of each angle, rad/s.
    pub rate: f32,
    /// Largest change of speed, rad/s²; infinite where none was declared.
    pub acceleration: f32,
    /// Weight of the joint in the displacement cost: stiffer joints move less. Only ratios matter.
    pub stiffness: f32,
    /// Part of the way, 0…1, that the heading's axis is tilted from the bone's own up to the character's; `None` is 1
    /// for a neck or head and 0 for the others.
    pub upright: Option<f32>,
    /// Part of the pitch range, 0…1, that is lost at either end of the heading's range, growing linearly from none at
    /// heading 0. Outside values are clamped, NaN counts as 0; without an end (a `free` heading) nothing is lost.
    pub pitch_taper: f32,
    /// Part that the joint has in a gaze.
    pub role: Role,
    /// Origin of the ranges: the animation, or the [bind pose](crate::Pose::with_bind).
    pub limits_from: LimitsFrom,
}

impl JointInfo {
    /// A joint with these axes and this rate (rad/s) and no angle yet.
    #[must_use]
    pub const fn new(axes: Axes, rate: f32) -> Self {
        Self {
            axes,
            planes: Planes::new(&axes),
            heading: None,
            pitch: None,
            rate,
            acceleration: f32::INFINITY,
            stiffness: 1.0,
            upright: None,
            pitch_taper: 0.0,
            role: Role::None,
            limits_from: LimitsFrom::Animation,
        }
    }

    /// The bone's axes, in its own space.
    #[must_use]
    pub const fn axes(&self) -> &Axes {
        &self.axes
    }

    /// With these axes.
    #[must_use]
    pub const fn with_axes(mut self, axes: Axes) -> Self {
        self.axes = axes;
        self.planes = Planes::new(&axes);
        self
    }

    /// With a heading in `lo..=hi`, radians.
    #[must_use]
    pub const fn with_heading(mut self, lo: f32, hi: f32) -> Self {
        self.heading = Some([lo, hi]);
        self
    }

    /// With a pitch in `lo..=hi`, radians.
    #[must_use]
    pub const fn with_pitch(mut self, lo: f32, hi: f32) -> Self {
        self.pitch = Some([lo, hi]);
        self
    }

    /// With this [`acceleration`](Self::acceleration), rad/s².
    #[must_use]
    pub const fn with_acceleration(mut self, acceleration: f32) -> Self {
        self.acceleration = acceleration;
        self
    }

    /// With this [`stiffness`](Self::stiffness).
    #[must_use]
    pub const fn with_stiffness(mut self, stiffness: f32) -> Self {
        self.stiffness = stiffness;
        self
    }

    /// With an [`upright`](Self::upright) heading, 0…1.
    #[must_use]
    pub const fn with_upright(mut self, upright: f32) -> Self {
        self.upright = Some(upright);
        self
    }

    /// With this [`pitch_taper`](Self::pitch_taper), 0…1.
    #[must_use]
    pub const fn with_pitch_taper(mut self, pitch_taper: f32) -> Self {
        self.pitch_taper = pitch_taper;
        self
    }

    /// With this [`role`](Self::role).
    #[must_use]
    pub const fn with_role(mut self, role: Role) -> Self {
        self.role = role;
        self
    }

    /// With ranges counted from [there](Self::limits_from).
    #[must_use]
    pub const fn with_limits_from(mut self, limits_from: LimitsFrom) -> Self {
        self.limits_from = limits_from;
        self
    }

    /// The rotation at these added angles, radians, about the bone's own axes: what its animated local rotation is
    /// multiplied by on the right, pitch acting first. Finite; unit to 1e-6 for angles that are.
    #[must_use]
    pub fn rotation(&self, heading_rad: f32, pitch_rad: f32) -> Quat {
        joint_turn(self, &Joint::REST.turned_to(heading_rad, pitch_rad))
    }

    /// What the joint gives way of heading and pitch: 1/stiffness, 0 for an angle that it does not have.
    #[inline(always)]
    pub(crate) const fn compliance(&self) -> [f32; 2] {
        let stiffness = if self.stiffness > 0.0 { self.stiffness.max(1e-6).min(1e6) } else { 1.0 };
        let per_stiffness = 1.0 / stiffness;
        let heading = if self.heading.is_some() { per_stiffness } else { 0.0 };
        [heading, if self.pitch.is_some() { per_stiffness } else { 0.0 }]
    }

    /// Whether the heading's axis is tilted upright at all.
    pub(crate) const fn is_upright(&self) -> bool {
        match self.upright {
            Some(upright) => upright > 0.0,
            None => matches!(self.role, Role::Head | Role::Neck),
        }
    }

    /// [`upright`](Self::upright) as it counts, 0…1.
    pub(crate) fn effective_upright(&self) -> f32 {
        let by_role = if matches!(self.role, Role::Head | Role::Neck) { 1.0 } else { 0.0 };
        self.upright.unwrap_or(by_role).at_least(0.0).at_most(1.0)
    }

    /// Whether the ranges are the declared ones in every pose and at every heading, and within ±π.
    pub(crate) const fn has_fixed_ranges(&self) -> bool {
        const fn is_within(range: Option<[f32; 2]>) -> bool {
            match range {
                Some([lo, hi]) => -PI <= lo && lo <= hi && hi <= PI,
                None => true,
            }
        }
        let from_animation = matches!(self.limits_from, LimitsFrom::Animation);
        from_animation && self.pitch_taper == 0.0 && is_within(self.pitch) && is_within(self.heading)
    }
}
