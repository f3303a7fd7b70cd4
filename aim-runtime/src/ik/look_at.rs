//! A head on its neck, by plain quaternions: an upright frame along the way to the target, within limits, at a bounded
//! angular speed.
//!
//! Up is the neck's, not the world's, so lying down and hanging upside down are nothing special.

use core::f32::consts::PI;

use glam::{Affine3A, Quat, Vec3, Vec3A};

use crate::Axes;
use crate::limits::Interval;
use crate::math::trig::{atan2, sin_cos};
use crate::math::turn::{across, at_most, between};
use crate::math::{self, angle_between, cross, direction, turned};
use crate::solve::LONGEST_FRAME_S;

/// What becomes of a target beyond the limits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Beyond {
    /// The head turns to the nearest heading and pitch within them.
    #[default]
    Clamp,
    /// The head stays as it is.
    Refuse,
}

/// The way that the head takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Path {
    /// Heading, pitch and what roll the head had each go straight to where they go: limits hold all the way, and a head
    /// without roll never gets any.
    #[default]
    Level,
    /// The one turn that leads there, at constant speed (spherical linear interpolation the short way). The quickest, but
    /// between two upright looks it rolls a little, and cuts corners of the limits.
    Slerp,
}

/// The solver of a head.
///
/// It keeps nothing: the head's transform as it is now goes in, and the turn from there comes out. So the bone must not be
/// animated otherwise.
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
    /// Which way the neck points: its up is what the head is upright about.
    pub neck: Axes,
    /// Which way the head points.
    pub head: Axes,
    /// How far the head turns to the neck's left, least and most, radians, within ±π; both
    /// infinite where it may go round. Default free.
    pub heading: [f32; 2],
    /// How far up, least and most, radians; within ±π/2 counts. Default ±π/2.
    pub pitch: [f32; 2],
    /// What becomes of a target beyond those. Default [`Beyond::Clamp`].
    pub beyond: Beyond,
    /// The way there. Default [`Path::Level`].
    pub path: Path,
    /// The largest angular speed of the head on its neck, rad/s. Default infinite: at once. NaN and negative stand still.
    pub speed_rad: f32,
    /// The largest speeds of heading, pitch and roll, each for itself, rad/s; [`Self::speed_rad`] holds as well. Of
    /// [`Path::Level`] alone: [`Path::Slerp`] is one turn with one speed. Default infinite. NaN and negative stand still.
    pub angle_speeds_rad: [f32; 3],
}

/// What became of a call of [`LookAt::solve`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LookAtOutcome {
    /// Goes before the head's rotation: `turn * head`. Unit and finite; no larger than speed × time.
    pub turn: Quat,
    /// The angle left between the head's forward and the way to the target, radians, 0…π; π/2 where that is degenerate.
    pub remaining_rad: f32,
    /// Whether the head looks there, and if not, why.
    pub status: LookAtStatus,
}

/// Whether a head looks at its target; if not, the first reason that holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LookAtStatus {
    /// Within 1e-4 radians.
    Reached,
    /// Something is no number or has no direction, or the target is on the head: nothing is turned.
    Degenerate,
    /// Beyond the limits, and refused: the head stays.
    Refused,
    /// Beyond the limits: it goes as near as they let it.
    AtLimit,
    /// On the way.
    Turning,
}

/// What counts as looking there, radians.
const MET_RAD: f32 = 1e-4;

/// Heading, pitch and roll, radians: turning by pitch first and heading last, on a neck's axes.
type Angles = [f32; 3];

/// The largest turn of a frame, as a whole and of each angle, radians, not negative.
struct Steps {
    whole: f32,
    each: Angles,
}

impl LookAt {
    /// With these axes of neck and head, without limits, at once.
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

    /// With these limits to the right and to the left, radians.
    #[must_use]
    pub const fn with_heading(mut self, least_rad: f32, most_rad: f32) -> Self {
        self.heading = [least_rad, most_rad];
        self
    }

    /// With these limits down and up, radians.
    #[must_use]
    pub const fn with_pitch(mut self, least_rad: f32, most_rad: f32) -> Self {
        self.pitch = [least_rad, most_rad];
        self
    }

    /// With this policy for targets beyond the limits.
    #[must_use]
    pub const fn with_beyond(mut self, beyond: Beyond) -> Self {
        self.beyond = beyond;
        self
    }

    /// Taking this way.
    #[must_use]
    pub const fn with_path(mut self, path: Path) -> Self {
        self.path = path;
        self
    }

    /// No faster than this, rad/s.
    #[must_use]
    pub const fn with_speed(mut self, speed_rad: f32) -> Self {
        self.speed_rad = speed_rad;
        self
    }

    /// With no angle of [`Path::Level`] faster than this, rad/s: a head nods slower than it turns.
    #[must_use]
    pub const fn with_angle_speeds(mut self, heading_rad: f32, pitch_rad: f32, roll_rad: f32) -> Self {
        self.angle_speeds_rad = [heading_rad, pitch_rad, roll_rad];
        self
    }

    /// Turns `head`, as it is now, towards `target` for a frame of `dt` seconds. All in one space.
    ///
    /// With `dt` zero, negative or NaN nothing moves; above 0.1 s it counts as 0.1 s. A head found beyond the limits goes
    /// back within them at its speed. Straight up and down, where there is no heading, counts as heading 0.
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
            // NaN stands still.
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

    /// The limits as they count.
    fn ranges(&self) -> [Interval; 2] {
        let [heading, pitch] = [self.heading, self.pitch].map(|range| Interval::declared(Some(range)));
        let within = |range: Interval, most: f32| range.common(Interval::declared(Some([-most, most])));
        [if heading.is_free() { heading } else { within(heading, PI) }, within(pitch, PI / 2.0)]
    }
}

/// The angle of a range that a heading is brought to: of those that are the same heading, the nearest.
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

/// A bone's forward, up and left as they stand in space: unit and square to each other.
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

    /// Heading and pitch of a unit vector.
    fn angles(&self, v: Vec3A) -> [f32; 2] {
        let [ahead, left, up] = [self.forward, self.left, self.up].map(|axis| v.dot(axis));
        let level = math::sqrt(ahead * ahead + left * left);
        [if level > 1e-6 { atan2(left, ahead) } else { 0.0 }, atan2(up, level)]
    }

    /// The frame with these angles on this one.
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

    /// The turn of a head that takes its angles on this neck towards others, each by no more than its step, and straight
    /// from there on where that is more than the whole may be.
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
        // Heading turns about up and roll about forward, which are square only where the pitch is 0.
        let about_both = by[0].abs() + by[2].abs();
        let whole = math::sqrt(about_both * about_both + by[1] * by[1]);
        let part = if whole > steps.whole { steps.whole / whole } else { 1.0 };
        let [heading, pitch, roll] = [heading + part * by[0], pitch + part * by[1], roll + part * by[2]];
        // The last digits of the way there.
        at_most(head.turn_to(&self.turned([heading, pitch, roll])), steps.whole)
    }
}
