//! A joint: what is declared of it ([`JointInfo`]) and its state ([`Joint`]).

use core::f32::consts::TAU;

use glam::{Quat, Vec3A, Vec4};

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
            planes: Planes::of(&axes),
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

    /// The bone's axes, in its own space.
    pub const fn axes(&self) -> &Axes {
        &self.axes
    }

    /// With these axes.
    pub const fn with_axes(mut self, axes: Axes) -> Self {
        self.axes = axes;
        self.planes = Planes::of(&axes);
        self
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

    /// Whether its heading is level at all.
    #[inline(always)]
    pub(crate) fn is_level(&self) -> bool {
        match self.level {
            Some(level) => level > 0.0,
            None => matches!(self.role, Role::Head | Role::Neck),
        }
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

/// What heading and pitch turn about, padded to vectors of four.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Planes {
    by_heading: [f32; 4],
    by_pitch: [f32; 4],
    by_both: [f32; 4],
    /// Where these are axes of coordinates, which of them each coordinate belongs to, and the signs.
    aligned: Option<([usize; 3], [f32; 4])>,
    /// See [`are_square`](Self::are_square).
    square: bool,
}

impl Planes {
    /// Going by the planes and not by handed axes is what makes it right for mirrored and left-handed triples too.
    const fn of(axes: &Axes) -> Self {
        const OFF: f32 = 2e-7;
        const fn cross(a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], 0.0]
        }
        const fn padded([x, y, z]: [f32; 3]) -> [f32; 4] {
            [x, y, z, 0.0]
        }
        const fn is_zero(a: [f32; 4], b: [f32; 4], less: f32) -> bool {
            let dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] - less;
            -OFF <= dot && dot <= OFF
        }
        let (up, forward, left) = (padded(axes.up), padded(axes.forward), padded(axes.left));
        let (by_heading, by_pitch) = (cross(forward, left), cross(forward, up));
        let unit = is_zero(up, up, 1.0) && is_zero(forward, forward, 1.0) && is_zero(left, left, 1.0);
        let square = unit && is_zero(forward, up, 0.0) && is_zero(forward, left, 0.0);
        let by_both = cross(by_heading, by_pitch);
        Self { by_heading, by_pitch, by_both, aligned: Self::aligned([by_heading, by_pitch, by_both]), square }
    }

    /// Whether the axes are unit and square to each other as far as a correction has to be unit.
    pub(crate) const fn are_square(&self) -> bool {
        self.square
    }

    const fn aligned(planes: [[f32; 4]; 3]) -> Option<([usize; 3], [f32; 4])> {
        let (mut places, mut signs) = ([3; 3], [1.0; 4]);
        let mut k = 0;
        while k < 9 {
            let (place, coordinate) = (k / 3, k % 3);
            let along = planes[place][coordinate];
            if along == 1.0 || along == -1.0 {
                places[coordinate] = place;
                signs[coordinate] = along;
            } else if along != 0.0 {
                return None;
            }
            k += 1;
        }
        if places[0] + places[1] + places[2] == 3 && places[0] != places[1] { Some((places, signs)) } else { None }
    }
}

/// A joint's state: the two angles added to the animation, radians. The default is rest: both 0.
///
/// Always finite. Besides the angles a joint remembers which side the target was last seen on, for when it passes
/// behind, where it is bound for, and how fast it moves where it has inertia.
#[derive(Clone, Copy, Debug)]
pub struct Joint {
    pub(crate) pitch: f32,
    pub(crate) heading: f32,
    pub(crate) side: Side,
    /// Whether the target was behind; on the innermost joint.
    pub(crate) behind: bool,
    /// Heading and pitch to go to: while the joints turn round together, though the aim gets worse on the way, and as a
    /// supporting joint of a natural gaze.
    pub(crate) bound_for: Option<[f32; 2]>,
    /// How fast heading and pitch change, rad/s; of a joint with inertia only.
    pub(crate) velocity: [f32; 2],
    /// How the frame that the angles count in stands in the bone: tilted upright for a level heading.
    pub(crate) tilt: Quat,
    /// The other eye; on joint 0 of a rig whose last pose had one.
    pub(crate) pair: Option<Pair>,
    /// The sines and cosines of the halves of pitch and heading, and the angles, in this order as they stand above, as
    /// they were when these were last taken.
    pub(crate) halves: trig::Halves,
    pub(crate) halved: [f32; 2],
    /// The correction at those angles.
    pub(crate) turned: Quat,
    /// What the chain remembers from frame to frame; kept by the innermost joint.
    pub(crate) memory: Memory,
}

/// Equal where all that matters for what comes is.
impl PartialEq for Joint {
    fn eq(&self, other: &Self) -> bool {
        let all = |joint: &Self| {
            let Self { heading, pitch, side, behind, bound_for, velocity, tilt, pair, memory, .. } = *joint;
            (heading, pitch, side, behind, bound_for, velocity, tilt, pair, memory)
        };
        all(self) == all(other)
    }
}

impl Joint {
    /// Both angles 0 and nothing remembered, as by default: for rigs that are constants.
    pub const REST: Self = Self {
        heading: 0.0,
        pitch: 0.0,
        side: Side::None,
        behind: false,
        bound_for: None,
        velocity: [0.0; 2],
        tilt: Quat::IDENTITY,
        pair: None,
        halves: [0.0, 1.0, 0.0, 1.0],
        // Of no angles: nothing is kept.
        halved: [f32::NAN; 2],
        turned: Quat::IDENTITY,
        memory: Memory::NONE,
    };
}

impl Default for Joint {
    #[inline]
    fn default() -> Self {
        Self::REST
    }
}

/// What the solvers remember from frame to frame.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    /// What the joints are about that support a natural gaze.
    pub(crate) support: Support,
}

impl Memory {
    pub(crate) const NONE: Self = Self {
        lambda: [0.0; 2],
        strain: 0.0,
        target: [0.0; 3],
        still_s: 0.0,
        caution: 0,
        blocked_s: 0.0,
        searched: [0.0; 3],
        turn: 0,
        support: Support::Rests,
    };
}

/// What the joints are about that support a natural gaze.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Support {
    /// They rest where they were bound for: the eye does what there is to do.
    Rests,
    /// They set out in so many seconds.
    Waits(f32),
    /// They follow their share of the gaze shift.
    Shares,
    /// They do more than their share, or other than it, for an eye that cannot do the rest.
    Helps,
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

    /// Heading and pitch.
    pub(crate) fn angles(&self) -> [f32; 2] {
        [self.heading, self.pitch]
    }

    /// The added heading and pitch of the other eye, radians, about axes parallel to this eye's; `None` but for joint 0 of
    /// a rig whose last pose had [a pair](crate::Pose::with_pair).
    pub fn pair(&self) -> Option<[f32; 2]> {
        self.pair.map(|pair| pair.angles)
    }

    /// The sines and cosines of half its angles: those that are kept, if they are of these angles.
    #[inline(always)]
    pub(crate) fn halves(&self) -> trig::Halves {
        if self.is_halved() { self.halves } else { self.halves_anew() }
    }

    /// Whether what is kept is of its angles, bit by bit: that takes fewer instructions than comparing numbers.
    #[inline(always)]
    pub(crate) fn is_halved(&self) -> bool {
        [self.pitch, self.heading].map(f32::to_bits) == self.halved.map(f32::to_bits)
    }

    /// Lets the angles count in another frame of the bone: what is kept of them holds no longer.
    pub(crate) fn set_tilt(&mut self, tilt: Quat) {
        self.tilt = tilt;
        self.halved = [f32::NAN; 2];
    }

    #[cold]
    #[inline(never)]
    fn halves_anew(&self) -> trig::Halves {
        trig::halves(self)
    }

    /// Puts it at this pitch and heading, with what later calls would have to make of them: the halves, and the turn in
    /// the levelled bone.
    #[inline(always)]
    pub(crate) fn put(&mut self, angles: [f32; 2], halves: trig::Halves, turn: Quat, tilt: Quat) {
        [self.pitch, self.heading] = angles;
        self.velocity = [0.0; 2];
        self.halved = angles;
        self.halves = halves;
        self.tilt = tilt;
        self.turned = tilted(turn, tilt);
    }

    /// Takes anew what is kept of its angles.
    pub(crate) fn halve(&mut self, info: &JointInfo) {
        self.halves = trig::halves(self);
        self.turned = tilted(turn(&info.axes, &info.planes, self.halves), self.tilt);
        self.halved = [self.pitch, self.heading];
    }

    /// The correction in the bone's own space: what its animated local rotation is multiplied by on the right,
    /// `local' = local · R_heading · R_pitch` (pitch acts first), both about the axes of the levelled bone where the
    /// last call levelled its heading.
    ///
    /// Unit to 1e-6 for unit axes square to each other, and the exact identity where both angles are 0.
    #[must_use]
    #[inline]
    pub fn correction(&self, axes: &Axes) -> Quat {
        tilted(turn(axes, &Planes::of(axes), self.halves()), self.tilt)
    }

    /// [`correction`](Self::correction) of its own joint: the one that is kept, if it is of these
    /// angles.
    #[inline(always)]
    pub(crate) fn own_correction(&self, info: &JointInfo) -> Quat {
        if self.is_halved() { self.turned } else { self.own_correction_anew(info) }
    }

    #[cold]
    #[inline(never)]
    fn own_correction_anew(&self, info: &JointInfo) -> Quat {
        tilted(turn(&info.axes, &info.planes, trig::halves(self)), self.tilt)
    }
}

/// A rotation of the levelled bone in the bone.
#[inline(always)]
pub(crate) fn tilted(turn: Quat, tilt: Quat) -> Quat {
    if chain::is_identity(tilt) {
        return turn;
    }
    let axis = math::turned(tilt, Vec3A::new(turn.x, turn.y, turn.z));
    Quat::from_xyzw(axis.x, axis.y, axis.z, turn.w)
}

/// The rotation by these halves of pitch and heading in the (levelled) bone.
#[inline(always)]
pub(crate) fn turn(axes: &Axes, planes: &Planes, [sin_p, cos_p, sin_h, cos_h]: trig::Halves) -> Quat {
    if !planes.square {
        return turn_by_planes(axes, [sin_p, cos_p, sin_h, cos_h]);
    }
    let load = |v: &[f32; 4]| Vec4::from_array(*v);
    let products = Vec4::new(sin_h, cos_h, sin_h, cos_h) * Vec4::new(cos_p, sin_p, sin_p, cos_p);
    let [by_heading, by_pitch, by_both, by_none] = products.to_array();
    if let Some(([x, y, z], signs)) = &planes.aligned {
        // The same sums, without what is multiplied by 0 in them.
        let part = |place: usize| [by_heading, by_pitch, by_both, by_none][place & 3];
        return Quat::from_vec4(Vec4::new(part(*x), part(*y), part(*z), by_none) * load(signs) + Vec4::ZERO);
    }
    let axis =
        load(&planes.by_heading) * by_heading + load(&planes.by_pitch) * by_pitch + load(&planes.by_both) * by_both;
    Quat::from_vec4(axis + Vec4::W * by_none)
}

/// [`turn`] for axes that are not quite square, or not at all: each angle in its plane, none where there is none.
#[cold]
fn turn_by_planes(axes: &Axes, [sin_p, cos_p, sin_h, cos_h]: trig::Halves) -> Quat {
    let [up, forward, left] = [axes.up, axes.forward, axes.left].map(Vec3A::from);
    let turn = |to: Vec3A, sin: f32, cos: f32| {
        let axis = math::direction(math::cross(forward, to)).unwrap_or(Vec3A::ZERO) * sin;
        if axis == Vec3A::ZERO { Quat::IDENTITY } else { Quat::from_xyzw(axis.x, axis.y, axis.z, cos) }
    };
    math::product(turn(left, sin_h, cos_h), turn(up, sin_p, cos_p))
}
