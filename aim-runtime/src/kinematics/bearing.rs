//! [`Bearings`]: heading and elevation about the character's up, from its front. Pairs of angles are the first two lanes of a
//! vector of four, in this order.

use core::f32::consts::{FRAC_PI_2, PI, TAU};

use glam::{Mat3A, Vec3A, Vec3Swizzles, Vec4, Vec4Swizzles};

use crate::kinematics::chain::Upright;
use crate::math::trig;
use crate::math::{self, Bounded};
use crate::rig::Side;

/// A gaze higher or lower than this has a heading that says little, radians.
const STEEP_RAD: f32 = 80.0 * PI / 180.0;
/// From the first of these elevations on, up or down, what is aside is [turned to](Bearings::turned) less aside than it is; from the
/// second on even what is behind, by way of the front.
pub(crate) const BY_THE_FRONT_RAD: [f32; 2] = [45.0 * PI / 180.0, 66.0 * PI / 180.0];

/// Heading and pitch of a direction along forward, left and up; heading 0 where it goes straight up or down.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn heading_and_pitch(direction: Vec3A) -> Vec4 {
    let level = math::root(direction.x * direction.x + direction.y * direction.y);
    let both = Vec4::new(direction.x, level, direction.x, level);
    trig::atan2_of_4(Vec4::from((direction.yzz(), 0.0)), both)
}

/// Those of two directions in little more than the time of one.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn headings_and_pitches([a, b]: [Vec3A; 2]) -> Vec4 {
    let [ahead, left, up] = a.to_array();
    let [b_ahead, b_left, b_up] = b.to_array();
    let (level, b_level) = (math::root(ahead * ahead + left * left), math::root(b_ahead * b_ahead + b_left * b_left));
    trig::atan2_of_4(Vec4::new(left, up, b_left, b_up), Vec4::new(ahead, level, b_ahead, b_level))
}

/// Directions of solver space as headings (from the front to the left) and elevations above the horizon, radians.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bearings {
    /// Forward, left and up as columns, and as rows.
    axes: Mat3A,
    rows: Mat3A,
    /// Whether a joint turns all the way round.
    turns_round: bool,
}

impl Bearings {
    /// About `up`, with the heading of the trunk's `forward` as 0, positive towards the side of its `left`. A trunk that
    /// lies has its head at the end of `trunk_up`.
    fn new(up: Vec3A, forward: Vec3A, left: Vec3A, trunk_up: Vec3A) -> Self {
        const LEVEL: f32 = 0.1;
        let level = |v: Vec3A| v - up * v.dot(up);
        let ahead = level(forward);
        let ahead = if ahead.dot(ahead) > LEVEL * LEVEL { ahead } else { level(trunk_up) * -forward.dot(up).signum() };
        let forward = math::unit(ahead).unwrap_or(forward);
        let across = math::cross(up, forward);
        let left = if across.dot(left) < 0.0 { -across } else { across };
        let axes = Mat3A::from_cols(forward, left, up);
        Self { axes, rows: axes.transpose(), turns_round: false }
    }

    /// About what upright headings turn about, from the front of a trunk that has its forward, left and up as these columns.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn of_trunk(trunk: &Mat3A, about: Upright, turns_round: bool) -> Self {
        let Mat3A { x_axis: forward, y_axis: left, z_axis: trunk_up } = *trunk;
        match about {
            Upright::About(up) => Self { turns_round, ..Self::new(up, forward, left, trunk_up) },
            Upright::Off | Upright::Innermost => Self { axes: *trunk, rows: trunk.transpose(), turns_round },
        }
    }

    /// The direction that elevations count towards.
    pub(crate) fn up(&self) -> Vec3A {
        self.axes.z_axis
    }

    /// Heading and elevation of a direction of any length but zero.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn angles(&self, direction: Vec3A) -> Vec4 {
        heading_and_pitch(self.rows * direction)
    }

    /// Those of two directions, one after the other.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn angles_of_both(&self, directions: [Vec3A; 2]) -> Vec4 {
        headings_and_pitches(directions.map(|direction| self.rows * direction))
    }

    /// Heading and elevation of a direction, and those of a unit direction as somebody turns to it: the nearer it is to the
    /// zenith, the less aside, and straight up from in front. Its heading is atan2(left, forward + 3w) where cos ε falls short of
    /// cos 45° by √(w·cos 45°): above 66° even what is behind is turned to by way of the front.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn turned(&self, from: Vec3A, to: Vec3A) -> [Vec4; 2] {
        const STEEP_COS: f32 = core::f32::consts::FRAC_1_SQRT_2;
        /// A body that walks away under its target looks up, and not round.
        const AHEAD: f32 = 3.0;
        let [from, to] = [from, to].map(|direction| self.rows * direction);
        let [from_level, level] = [from, to].map(|v| math::root(v.x * v.x + v.y * v.y));
        let short = (STEEP_COS - level).at_least(0.0);
        let ahead = Vec4::new(from.x, from_level, to.x + AHEAD * short * short / STEEP_COS, level);
        let both = trig::atan2_of_4(Vec4::new(from.y, from.z, to.y, to.z), ahead);
        [both, both.zwzw()]
    }

    /// The unit direction of a heading and an elevation.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn direction(&self, angles: Vec4) -> Vec3A {
        self.direction_of(trig::halves_of(angles))
    }

    /// The unit directions of two headings and elevations, one after the other.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn directions(&self, angles: Vec4) -> [Vec3A; 2] {
        trig::halves_of_both(angles).map(|halves| self.direction_of(halves))
    }

    #[cfg_attr(not(aim_small), inline(always))]
    fn direction_of(&self, halves: trig::Halves) -> Vec3A {
        let [sin_e, cos_e, sin_h, cos_h] = trig::doubled(halves).to_array();
        self.axes * Vec3A::new(cos_h * cos_e, sin_h * cos_e, sin_e)
    }

    /// The unit direction this part of the way from one to another.
    #[cold]
    pub(crate) fn part_way(&self, [from, to]: [Vec3A; 2], part: f32, side: Side) -> Vec3A {
        let [from, to] = [from, to].map(|direction| self.angles(direction));
        self.direction(from + self.way(from, to, side) * part)
    }

    /// The way from one direction to another, by the `side` on which what is behind counts as being.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn way(&self, from: Vec4, to: Vec4, side: Side) -> Vec4 {
        let ([from_heading, from_elevation, ..], [mut heading, mut elevation, ..]) = (from.to_array(), to.to_array());
        match side {
            Side::Left if heading < -FRAC_PI_2 => heading += TAU,
            Side::Right if heading > FRAC_PI_2 => heading -= TAU,
            _ => {}
        }
        heading -= from_heading;
        // Through the front, however far round the animation has turned the gaze: which side a target is on does not change
        // with that.
        if self.turns_round {
            heading = math::wrap_pi(heading);
        }
        // From near the zenith the other side is nearer by way of it.
        if from_elevation.abs() > STEEP_RAD && heading.abs() > FRAC_PI_2 {
            heading -= PI * heading.signum();
            elevation = PI * from_elevation.signum() - elevation;
        }
        Vec4::new(heading, elevation - from_elevation, 0.0, 0.0)
    }
}
