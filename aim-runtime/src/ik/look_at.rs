//! Turns a head on its neck with plain quaternions: an upright frame along the direction to the target, within limits,
//! at a bounded angular speed.
//!
//! Up is the neck's up, not the world's, so characters that lie down or hang upside down need no special handling.

use core::f32::consts::PI;

use glam::{Affine3A, Quat, Vec3, Vec3A};

use crate::Axes;
use crate::limits::Interval;
use crate::math::trig::{atan2, sin_cos};
use crate::math::turn::{across, at_most, between};
use crate::math::{self, angle_between, cross, direction, turned};
use crate::solve::LONGEST_FRAME_S;

/// Policy for a target beyond the limits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Beyond {
    /// The head turns to the nearest heading and pitch within the limits.
    #[default]
    Clamp,
    /// The head stays as it is.
    Refuse,
}

/// Path that the head takes to its goal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Path {
    /// Heading, pitch and any roll of the head each change directly to their goals. The limits hold all the way, and a
    /// head without roll stays without.
    #[default]
    Level,
    /// A single rotation at constant speed (spherical linear interpolation along the shorter arc). It is the shortest
    /// path, but between two upright orientations it rolls a little, and it cuts the corners of the limits.
    Slerp,
}

/// Solver that turns a head on its neck.
///
/// The solver is stateless: it takes the head's current transform and returns the turn from there. Nothing else may
/// animate the head's rotation.
///
/// ```
/// use aim_runtime::Axes;
/// use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3};
/// use aim_runtime::ik::{LookAt, LookAtStatus};
///
/// // Both bones have +X up, +Y forward, +Z left.
/// let axes = Axes { up: [1.0, 0.0, 0.0], forward: [0.0, 1.0, 0.0], left: [0.0, 0.0, 1.0] };
/// let look = LookAt::new(axes, axes).with_heading(-1.2, 1.2).with_pitch(-0.7, 0.6).with_speed(3.0);
///
/// let neck = Affine3A::from_rotation_z(1.3); // lying down
/// let mut head = neck * Affine3A::from_translation(Vec3::X * 0.1);
/// let target = neck.transform_point3(Vec3::new(0.5, 2.0, 1.0));
/// let mut outcome = look.solve(&neck, &head, target, 1.0 / 60.0);
/// # for _ in 0..60 {
/// outcome = look.solve(&neck, &head, target, 1.0 / 60.0); // once a frame
/// head.matrix3 = Mat3A::from_quat(outcome.turn) * head.matrix3;
/// # }
/// assert_eq!(outcome.status, LookAtStatus::Reached);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct LookAt {
    /// Axes of the neck bone. The head is kept upright relative to the neck's up.
    pub neck: Axes,
    /// Axes of the head bone.
    pub head: Axes,
    /// Range of the heading relative to the neck, `[least, most]`, radians, positive to the left, within ±π. Both ends
    /// infinite: the head may turn all the way round. Default infinite.
    pub heading: [f32; 2],
    /// Range of the pitch relative to the neck, `[least, most]`, radians, positive upwards; clamped to ±π/2. Default
    /// ±π/2.
    pub pitch: [f32; 2],
    /// Policy for a target beyond the limits. Default [`Beyond::Clamp`].
    pub beyond: Beyond,
    /// Path to the goal. Default [`Path::Level`].
    pub path: Path,
    /// Largest angular speed of the head relative to the neck, rad/s. Negative values and NaN count as 0. Default
    /// infinite: the head is at its goal in one frame.
    pub speed_rad: f32,
    /// Largest speeds of heading, pitch and roll separately, rad/s, in addition to [`Self::speed_rad`]. Only for
    /// [`Path::Level`]: [`Path::Slerp`] is one turn with one speed. Negative values and NaN count as 0. Default
    /// infinite.
    pub angle_speeds_rad: [f32; 3],
}

/// Result of [`LookAt::solve`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LookAtOutcome {
    /// Rotation to apply before the head's rotation: `turn * head`. Unit and finite; its angle is at most speed × time.
    pub turn: Quat,
    /// Remaining angle between the head's forward and the direction to the target, radians, 0…π; π/2 for a degenerate
    /// call.
    pub remaining_rad: f32,
    /// `Reached` if the head looks at the target, otherwise the reason why not.
    pub status: LookAtStatus,
}

/// Status of a [`LookAt`] turn: success, or the first applicable reason why the head does not look at its target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LookAtStatus {
    /// The head looks at the target to within 1e-4 radians.
    Reached,
    /// An input is not finite or has no direction, or the target is at the head. Nothing is turned.
    Degenerate,
    /// The target is beyond the limits and [`Beyond::Refuse`] is set: the head stays.
    Refused,
    /// The target is beyond the limits: the head turns to the nearest allowed angles.
    AtLimit,
    /// The head is still turning towards the target.
    Turning,
}

/// Remaining angle up to which the head counts as looking at the target, radians.
const MET_RAD: f32 = 1e-4;

/// Heading, pitch and roll, radians, about the neck's axes. Roll is applied first, then pitch, then heading.
type Angles = [f32; 3];

/// Largest turn in one frame, in total and for each angle, radians, not negative.
struct Steps {
    whole: f32,
    each: Angles,
}

impl LookAt {
    /// Creates a solver for bones with these axes, without limits and with infinite speed.
    #[must_use]
    pub const fn new(neck: Axes, head: Axes) -> Self {
        Self {
            neck,
            head,
            heading: [f32::NEG_INFINITY, f32::INFINITY],
            pitch: [-PI / 2.0, PI / 2.0],
            beyond: Beyond::Clamp,
            path: Path::Level,
            speed_rad: f32::INFINITY,
            angle_speeds_rad: [f32::INFINITY; 3],
        }
    }

    /// Sets the [range of the heading](Self::heading): limits to the right and to the left, radians.
    #[must_use]
    pub const fn with_heading(mut self, least_rad: f32, most_rad: f32) -> Self {
        self.heading = [least_rad, most_rad];
        self
    }

    /// Sets the [range of the pitch](Self::pitch): limits down and up, radians.
    #[must_use]
    pub const fn with_pitch(mut self, least_rad: f32, most_rad: f32) -> Self {
        self.pitch = [least_rad, most_rad];
        self
    }

    /// Sets the policy for targets [beyond](Self::beyond) the limits.
    #[must_use]
    pub const fn with_beyond(mut self, beyond: Beyond) -> Self {
        self.beyond = beyond;
        self
    }

    /// Sets the [`path`](Self::path).
    #[must_use]
    pub const fn with_path(mut self, path: Path) -> Self {
        self.path = path;
        self
    }

    /// Sets the largest [angular speed](Self::speed_rad), rad/s.
    #[must_use]
    pub const fn with_speed(mut self, speed_rad: f32) -> Self {
        self.speed_rad = speed_rad;
        self
    }

    /// Sets the largest [speed of each angle](Self::angle_speeds_rad), rad/s, for [`Path::Level`]; for example, for a
    /// head that nods more slowly than it turns.
    #[must_use]
    pub const fn with_angle_speeds(mut self, heading_rad: f32, pitch_rad: f32, roll_rad: f32) -> Self {
        self.angle_speeds_rad = [heading_rad, pitch_rad, roll_rad];
        self
    }

    /// Returns the turn of `head`, from its current transform towards `target`, for a frame of `dt` seconds. All
    /// arguments are in one space.
    ///
    /// If `dt` is zero, negative or NaN, nothing moves; values above 0.1 s are clamped to 0.1 s. A head that is beyond
    /// the limits returns into them at its speed. Straight up and straight down, where the heading is undefined, it
    /// counts as 0.
    #[must_use]
    pub fn solve(&self, neck: &Affine3A, head: &Affine3A, target: Vec3, dt: f32) -> LookAtOutcome {
        self.turned(neck, head, target, dt).unwrap_or(LookAtOutcome {
            turn: Quat::IDENTITY,
            remaining_rad: math::UNDEFINED_RAD,
            status: LookAtStatus::Degenerate,
        })
    }

    fn turned(&self, neck: &Affine3A, head: &Affine3A, target: Vec3, dt: f32) -> Option<LookAtOutcome> {
        let neck = Frame::new(neck, &self.neck)?;
        let now = Frame::new(head, &self.head)?;
        let way = Vec3A::from(target) - head.translation;
        let to_target = direction(way)?;
        let [heading_range, pitch_range] = self.ranges();

        let [heading, pitch] = neck.angles(to_target);
        let (held_heading, held_pitch) = (hold(heading_range, heading), pitch_range.hold(pitch));
        let beyond = (held_heading - heading).abs() > MET_RAD || (held_pitch - pitch).abs() > MET_RAD;
        let turn = if beyond && self.beyond == Beyond::Refuse {
            Quat::IDENTITY
        } else {
            let goal = [held_heading, held_pitch, 0.0];
            // A NaN speed counts as 0.
            let step = |speed_rad: f32| (speed_rad * dt.max(0.0).min(LONGEST_FRAME_S)).max(0.0);
            match self.path {
                Path::Slerp => at_most(now.turn_to(&neck.turned(goal)), step(self.speed_rad)),
                Path::Level => {
                    let steps = Steps { whole: step(self.speed_rad), each: self.angle_speeds_rad.map(step) };
                    neck.level(&now, goal, &steps, heading_range.is_free())
                }
            }
        };
        let remaining_rad = angle_between(turned(turn, now.forward), to_target);
        let status = if remaining_rad <= MET_RAD {
            LookAtStatus::Reached
        } else if !beyond {
            LookAtStatus::Turning
        } else if self.beyond == Beyond::Refuse {
            LookAtStatus::Refused
        } else {
            LookAtStatus::AtLimit
        };
        Some(LookAtOutcome { turn, remaining_rad, status })
    }

    /// Returns the effective limits of heading and pitch.
    fn ranges(&self) -> [Interval; 2] {
        let [heading, pitch] = [self.heading, self.pitch].map(|range| Interval::declared(Some(range)));
        let within = |range: Interval, most: f32| range.common(Interval::declared(Some([-most, most])));
        [if heading.is_free() { heading } else { within(heading, PI) }, within(pitch, PI / 2.0)]
    }
}

/// Returns the angle of `range` nearest to a heading, considering the equivalent headings one full turn away.
fn hold(range: Interval, heading: f32) -> f32 {
    let there = |heading: f32| (range.hold(heading), (range.hold(heading) - heading).abs());
    let (mut best, mut off) = there(heading);
    for other in [heading - 2.0 * PI, heading + 2.0 * PI] {
        let (held, by) = there(other);
        if by < off {
            (best, off) = (held, by);
        }
    }
    best
}

/// A bone's forward, up and left in space: unit and orthogonal.
#[derive(Clone, Copy)]
struct Frame {
    forward: Vec3A,
    up: Vec3A,
    left: Vec3A,
}

impl Frame {
    fn new(bone: &Affine3A, axes: &Axes) -> Option<Self> {
        let matrix = math::orthonormal(bone.matrix3)?;
        let [forward, up, left] = [axes.forward, axes.up, axes.left].map(|axis| Some(matrix * direction(axis.into())?));
        let forward = direction(forward?)?;
        let up = across(up?, forward)?;
        let side = cross(up, forward);
        let left = if side.dot(left?) < 0.0 { -side } else { side };
        (forward.is_finite() && left.is_finite()).then_some(Self { forward, up, left })
    }

    /// Returns heading and pitch of a unit vector.
    fn angles(&self, v: Vec3A) -> [f32; 2] {
        let [ahead, left, up] = [self.forward, self.left, self.up].map(|axis| v.dot(axis));
        let level = math::sqrt(ahead * ahead + left * left);
        [if level > 1e-6 { atan2(left, ahead) } else { 0.0 }, atan2(up, level)]
    }

    /// Returns this frame turned by the given angles.
    fn turned(&self, [heading, pitch, roll]: Angles) -> Self {
        let ((sin_h, cos_h), (sin_p, cos_p)) = (sin_cos(heading), sin_cos(pitch));
        let (level, left) = (self.forward * cos_h + self.left * sin_h, self.left * cos_h - self.forward * sin_h);
        let (forward, up) = (level * cos_p + self.up * sin_p, self.up * cos_p - level * sin_p);
        let (sin_r, cos_r) = sin_cos(roll);
        Self { forward, up: up * cos_r + left * sin_r, left: left * cos_r - up * sin_r }
    }

    fn turn_to(&self, other: &Self) -> Quat {
        between([self.forward, self.up], [other.forward, other.up])
    }

    /// Returns the turn that moves a head's angles on this neck towards `goal`, each by at most its step. If the
    /// combined turn exceeds `steps.whole`, all three changes are scaled down by the same factor.
    fn level(&self, head: &Self, goal: Angles, steps: &Steps, free: bool) -> Quat {
        let [heading, pitch] = self.angles(head.forward);
        let upright = self.turned([heading, pitch, 0.0]);
        let roll = atan2(head.up.dot(upright.left), head.up.dot(upright.up));
        let mut by = [goal[0] - heading, goal[1] - pitch, goal[2] - roll];
        if free {
            by[0] = math::wrap_pi(by[0]);
        }
        for (by, step) in by.iter_mut().zip(steps.each) {
            *by = by.clamp(-step, step);
        }
        // Heading turns about up and roll about forward, which are orthogonal only at pitch 0, so their angles are
        // added; pitch turns about an axis orthogonal to both.
        let about_both = by[0].abs() + by[2].abs();
        let whole = math::sqrt(about_both * about_both + by[1] * by[1]);
        let part = if whole > steps.whole { steps.whole / whole } else { 1.0 };
        let [heading, pitch, roll] = [heading + part * by[0], pitch + part * by[1], roll + part * by[2]];
        // Removes rounding errors above the limit.
        at_most(head.turn_to(&self.turned([heading, pitch, roll])), steps.whole)
    }
}
