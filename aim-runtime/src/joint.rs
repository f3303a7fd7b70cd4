//! A joint: what is declared of it ([`JointInfo`]) and its state ([`Joint`]).

use core::f32::consts::TAU;

use glam::{Quat, Vec3A};

use crate::{Axes, chain, math, trig};

/// What part a joint has in a gaze. It decides what is left to the solver: whether a rig has eyes, which headings are
/// level, how quickly a supporting joint takes up speed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Role {
    /// None in particular.
    #[default]
    Other,
    /// An eye: quick, leads, and returns as the others arrive.
    Eye,
    /// A head.
    Head,
    /// A neck.
    Neck,
    /// A spine or chest.
    Spine,
}

/// What was declared of a joint. Angles in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct JointInfo {
    /// The bone's axes, in its own space.
    pub axes: Axes,
    /// Range of the heading, `[lo, hi]` around 0; `None` for a joint that does not turn sideways. Infinite where it
    /// was declared `free`.
    pub heading: Option<[f32; 2]>,
    /// Range of the pitch, `[lo, hi]` around 0; `None` for a joint that does not nod.
    pub pitch: Option<[f32; 2]>,
    /// Largest speed of each angle, rad/s.
    pub rate: f32,
    /// Largest change of speed, rad/s²; infinite where none was declared.
    pub acceleration: f32,
    /// Reluctance: the joint's weight in the displacement cost. Only ratios matter.
    pub comfort: f32,
    /// How far heading turns about the character's up instead of the bone's own, 0…1; `None` is 1 for a neck or head
    /// and 0 for the others.
    pub level: Option<f32>,
    /// The part of the pitch range that is lost at either end of the heading's range, 0…1, growing linearly from none
    /// at heading 0. Outside values are clamped, NaN counts as 0; without an end (a `free` heading) nothing is lost.
    pub narrowing: f32,
    /// What part the joint has in a gaze.
    pub role: Role,
    /// Whether the ranges are counted from the bind pose instead of from the animation. Then what the animation does
    /// already is part of the angles that the ranges bound; wherever it is, it is let be, and never pushed further out.
    /// Needs [a pose with a bind pose](crate::Pose::with_bind); without one the ranges are counted from the animation.
    pub absolute: bool,
}

impl JointInfo {
    /// A joint with these axes and this rate (rad/s) and no angle yet.
    pub const fn new(axes: Axes, rate: f32) -> Self {
        Self {
            axes,
            heading: None,
            pitch: None,
            rate,
            acceleration: f32::INFINITY,
            comfort: 1.0,
            level: None,
            narrowing: 0.0,
            role: Role::Other,
            absolute: false,
        }
    }

    /// With a heading in `lo..=hi`.
    pub const fn with_heading(mut self, lo: f32, hi: f32) -> Self {
        self.heading = Some([lo, hi]);
        self
    }

    /// With a pitch in `lo..=hi`.
    pub const fn with_pitch(mut self, lo: f32, hi: f32) -> Self {
        self.pitch = Some([lo, hi]);
        self
    }

    /// With this acceleration, rad/s².
    pub const fn with_acceleration(mut self, acceleration: f32) -> Self {
        self.acceleration = acceleration;
        self
    }

    /// With this comfort.
    pub const fn with_comfort(mut self, comfort: f32) -> Self {
        self.comfort = comfort;
        self
    }

    /// With this level.
    pub const fn with_level(mut self, level: f32) -> Self {
        self.level = Some(level);
        self
    }

    /// With this [`narrowing`](Self::narrowing).
    pub const fn with_narrowing(mut self, narrowing: f32) -> Self {
        self.narrowing = narrowing;
        self
    }

    /// With this role.
    pub const fn with_role(mut self, role: Role) -> Self {
        self.role = role;
        self
    }

    /// The level as it counts, 0…1.
    pub(crate) fn effective_level(&self) -> f32 {
        let by_role = if matches!(self.role, Role::Head | Role::Neck) { 1.0 } else { 0.0 };
        self.level.unwrap_or(by_role).max(0.0).min(1.0)
    }

    /// With ranges counted from the bind pose.
    pub const fn with_absolute_range(mut self) -> Self {
        self.absolute = true;
        self
    }
}

/// A joint's state: the two angles added to the animation, radians. The default is rest: both 0.
///
/// Always finite. Besides the angles a joint remembers which side the target was last seen on, for when it passes
/// behind, and where it is bound for while the joints turn round together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Joint {
    pub(crate) heading: f32,
    pub(crate) pitch: f32,
    pub(crate) side: Side,
    /// Whether the target was behind; on the innermost joint.
    pub(crate) behind: bool,
    /// Heading and pitch to go to though the aim gets worse on the way.
    pub(crate) bound_for: Option<[f32; 2]>,
    /// How the frame that the angles count in stands in the bone: tilted upright for a level heading.
    pub(crate) tilt: Quat,
    /// The other eye; on joint 0 of a rig whose last pose had one.
    pub(crate) pair: Option<Pair>,
    /// What the chain remembers from frame to frame; kept by the innermost joint.
    pub(crate) memory: Memory,
}

/// What the exact solver remembers from frame to frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Memory {
    /// The dual point that the last frame ended at.
    pub(crate) lambda: [f32; 2],
    /// How much of a strain is left of the last strained frame, 0…1.
    pub(crate) strain: f32,
    /// The target of the last frame that was strained, in the space that the solver has it in.
    pub(crate) target: [f32; 3],
    /// For how long it has stood still, seconds.
    pub(crate) still_s: f32,
    /// How often a step is halved so that it is a gain.
    pub(crate) caution: u8,
    /// For how long the target has been out of reach, seconds.
    pub(crate) blocked_s: f32,
    /// The target, in the same space, when the joints were last started from everywhere.
    pub(crate) searched: [f32; 3],
    /// How many blocked frames there have been since then, or so; 0 where that has never been.
    pub(crate) turn: u16,
}

/// What joint 0 remembers of a pair of eyes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pair {
    /// The other eye's heading and pitch, about axes parallel to joint 0's.
    pub(crate) angles: [f32; 2],
    /// Heading and pitch of the eye between them that leads.
    pub(crate) lead: [f32; 2],
    /// The other eye's correction in its own bone's space, a quaternion.
    pub(crate) correction: [f32; 4],
}

impl Pair {
    pub(crate) const REST: Self = Self { angles: [0.0; 2], lead: [0.0; 2], correction: [0.0, 0.0, 0.0, 1.0] };
}

/// The side that a target was last seen on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Side {
    /// Not seen yet.
    #[default]
    None,
    Left,
    Right,
}

impl Side {
    /// The side of a coordinate along left.
    pub(crate) fn of(left: f32) -> Self {
        if left < 0.0 { Self::Right } else { Self::Left }
    }

    /// 1 for left and for a target never seen, −1 for right.
    pub(crate) fn sign(self) -> f32 {
        if self == Self::Right { -1.0 } else { 1.0 }
    }
}

impl Joint {
    /// A joint at these added angles, radians: a stored state put back. An angle that is not finite counts as 0, one
    /// beyond a full turn as what is left of it; one outside its range goes back to it at the joint's rate.
    #[must_use]
    pub fn with_angles(heading_rad: f32, pitch_rad: f32) -> Self {
        // No range goes beyond a full turn, and beyond a thousand radians there is no turn left in the digits.
        let sane = |angle: f32| match angle.abs() {
            small if small <= TAU => angle,
            large if large < 1e3 => math::wrap_pi(angle),
            _ => 0.0,
        };
        Self { heading: sane(heading_rad), pitch: sane(pitch_rad), ..Self::default() }
    }

    /// Whether both angles are within this of another joint's, radians.
    pub(crate) fn is_near(&self, other: &Self, angle_rad: f32) -> bool {
        (self.heading - other.heading).abs() <= angle_rad && (self.pitch - other.pitch).abs() <= angle_rad
    }

    /// The added heading, radians: positive turns forward towards left.
    pub fn heading(&self) -> f32 {
        self.heading
    }

    /// The added pitch, radians: positive turns forward towards up.
    pub fn pitch(&self) -> f32 {
        self.pitch
    }

    /// The added heading and pitch of the other eye, radians, about axes parallel to this eye's; `None` but for joint 0 of
    /// a rig whose last pose had [a pair](crate::Pose::with_pair).
    pub fn pair(&self) -> Option<[f32; 2]> {
        self.pair.map(|pair| pair.angles)
    }

    /// The correction in the bone's own space: what its animated local rotation is multiplied by on the right,
    /// `local' = local · R_heading · R_pitch` (pitch acts first), both about the axes of the levelled bone where the
    /// last call levelled its heading.
    ///
    /// Unit to 1e-6 for unit axes square to each other, and the exact identity where both angles are 0.
    #[must_use]
    #[inline]
    pub fn correction(&self, axes: &Axes) -> Quat {
        let turn = turn(axes, trig::halves(self));
        if chain::is_identity(self.tilt) {
            return turn;
        }
        let axis = self.tilt.mul_vec3a(Vec3A::new(turn.x, turn.y, turn.z));
        Quat::from_xyzw(axis.x, axis.y, axis.z, turn.w)
    }
}

/// The rotation by these halves of pitch and heading in the (levelled) bone.
///
/// Going by the planes and not by handed axes is what makes it right for mirrored and left-handed triples too.
#[inline(always)]
pub(crate) fn turn(axes: &Axes, [sin_p, cos_p, sin_h, cos_h]: trig::Halves) -> Quat {
    let [up, forward, left] = [axes.up, axes.forward, axes.left].map(Vec3A::from);
    if !square(up, forward, left) {
        return turn_by_planes([up, forward, left], [sin_p, cos_p, sin_h, cos_h]);
    }
    let (by_heading, by_pitch) = (forward.cross(left), forward.cross(up));
    let by_both = by_heading.cross(by_pitch);
    let axis = by_heading * (sin_h * cos_p) + by_pitch * (cos_h * sin_p) + by_both * (sin_h * sin_p);
    Quat::from_xyzw(axis.x, axis.y, axis.z, cos_h * cos_p)
}

/// Whether a triple is square and unit as far as a correction has to be unit. Of a rig known when compiling this is
/// known then too.
#[inline(always)]
fn square(up: Vec3A, forward: Vec3A, left: Vec3A) -> bool {
    const OFF: f32 = 2e-7;
    let unit = |v: Vec3A| (v.dot(v) - 1.0).abs() <= OFF;
    unit(up) && unit(forward) && unit(left) && forward.dot(up).abs() <= OFF && forward.dot(left).abs() <= OFF
}

/// [`turn`] for axes that are not quite square, or not at all: each angle in its plane, none where there is none.
#[cold]
fn turn_by_planes([up, forward, left]: [Vec3A; 3], [sin_p, cos_p, sin_h, cos_h]: trig::Halves) -> Quat {
    let turn = |to: Vec3A, sin: f32, cos: f32| {
        let axis = forward.cross(to).normalize_or_zero() * sin;
        if axis == Vec3A::ZERO { Quat::IDENTITY } else { Quat::from_xyzw(axis.x, axis.y, axis.z, cos) }
    };
    turn(left, sin_h, cos_h) * turn(up, sin_p, cos_p)
}
