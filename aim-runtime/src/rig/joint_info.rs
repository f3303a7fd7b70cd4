//! [`JointInfo`]: the declared data of a joint.

use core::f32::consts::PI;

use glam::Quat;

use crate::kinematics::rotation::{Planes, joint_turn};
use crate::math::Bounded;
use crate::{Axes, Joint, LimitsFrom, Role};

/// Declared data of a joint: axes, ranges, rates, stiffness and role. Angles are in radians.
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
    /// Range of the heading, `[lo, hi]` around 0; `None` for a joint without heading. Infinite if it was declared
    /// `free`.
    pub heading: Option<[f32; 2]>,
    /// Range of the pitch, `[lo, hi]` around 0; `None` for a joint without pitch.
    pub pitch: Option<[f32; 2]>,
    /// Largest speed of each angle, rad/s.
    pub rate: f32,
    /// Largest acceleration of each angle, rad/s²; infinite if none was declared.
    pub acceleration: f32,
    /// Weight of the joint in the displacement cost: stiffer joints move less. Only ratios matter.
    pub stiffness: f32,
    /// Fraction, 0…1, by which the heading's axis is tilted from the bone's own up to the character's. `None` means 1
    /// for a neck or head and 0 for other joints.
    pub upright: Option<f32>,
    /// Fraction of the pitch range, 0…1, that is lost at either end of the heading's range; the loss grows linearly
    /// from 0 at heading 0. Values outside are clamped, NaN counts as 0. If the heading has no end (`free`), nothing is
    /// lost.
    pub pitch_taper: f32,
    /// Role of the joint in a natural gaze.
    pub role: Role,
    /// Pose from which the ranges are counted: the animation, or the [bind pose](crate::Pose::with_bind).
    pub limits_from: LimitsFrom,
}

impl JointInfo {
    /// Creates a joint with these axes and this rate (rad/s), without heading and pitch.
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

    /// Returns the bone's axes, in its own space.
    #[must_use]
    pub const fn axes(&self) -> &Axes {
        &self.axes
    }

    /// Sets the [`axes`](Self::axes).
    #[must_use]
    pub const fn with_axes(mut self, axes: Axes) -> Self {
        self.axes = axes;
        self.planes = Planes::new(&axes);
        self
    }

    /// Sets the range of the [`heading`](Self::heading) to `lo..=hi`, radians.
    #[must_use]
    pub const fn with_heading(mut self, lo: f32, hi: f32) -> Self {
        self.heading = Some([lo, hi]);
        self
    }

    /// Sets the range of the [`pitch`](Self::pitch) to `lo..=hi`, radians.
    #[must_use]
    pub const fn with_pitch(mut self, lo: f32, hi: f32) -> Self {
        self.pitch = Some([lo, hi]);
        self
    }

    /// Sets the [`acceleration`](Self::acceleration), rad/s².
    #[must_use]
    pub const fn with_acceleration(mut self, acceleration: f32) -> Self {
        self.acceleration = acceleration;
        self
    }

    /// Sets the [`stiffness`](Self::stiffness).
    #[must_use]
    pub const fn with_stiffness(mut self, stiffness: f32) -> Self {
        self.stiffness = stiffness;
        self
    }

    /// Sets the [`upright`](Self::upright) fraction, 0…1.
    #[must_use]
    pub const fn with_upright(mut self, upright: f32) -> Self {
        self.upright = Some(upright);
        self
    }

    /// Sets the [`pitch_taper`](Self::pitch_taper), 0…1.
    #[must_use]
    pub const fn with_pitch_taper(mut self, pitch_taper: f32) -> Self {
        self.pitch_taper = pitch_taper;
        self
    }

    /// Sets the [`role`](Self::role).
    #[must_use]
    pub const fn with_role(mut self, role: Role) -> Self {
        self.role = role;
        self
    }

    /// Sets the pose [from which the ranges are counted](Self::limits_from).
    #[must_use]
    pub const fn with_limits_from(mut self, limits_from: LimitsFrom) -> Self {
        self.limits_from = limits_from;
        self
    }

    /// Returns the rotation at these added angles, radians, about the bone's own axes: its animated local rotation is
    /// multiplied by it on the right; pitch acts first. Finite for every input, and unit to 1e-6 for finite angles.
    #[must_use]
    pub fn rotation(&self, heading_rad: f32, pitch_rad: f32) -> Quat {
        joint_turn(self, &Joint::REST.turned_to(heading_rad, pitch_rad))
    }

    /// Returns the compliance of heading and pitch: 1/stiffness, or 0 for an angle that is not declared.
    #[inline(always)]
    pub(crate) const fn compliance(&self) -> [f32; 2] {
        let stiffness = if self.stiffness > 0.0 { self.stiffness.max(1e-6).min(1e6) } else { 1.0 };
        let per_stiffness = 1.0 / stiffness;
        let heading = if self.heading.is_some() { per_stiffness } else { 0.0 };
        [heading, if self.pitch.is_some() { per_stiffness } else { 0.0 }]
    }

    /// Returns `true` if the heading's axis is tilted upright at all.
    pub(crate) const fn is_upright(&self) -> bool {
        match self.upright {
            Some(upright) => upright > 0.0,
            None => matches!(self.role, Role::Head | Role::Neck),
        }
    }

    /// Returns the effective [`upright`](Self::upright) fraction, 0…1.
    pub(crate) fn effective_upright(&self) -> f32 {
        let by_role = if matches!(self.role, Role::Head | Role::Neck) { 1.0 } else { 0.0 };
        self.upright.unwrap_or(by_role).at_least(0.0).at_most(1.0)
    }

    /// Returns `true` if the ranges are the declared ones in every pose and at every heading, and within ±π.
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
