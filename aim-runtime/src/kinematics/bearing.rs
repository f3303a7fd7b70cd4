//! [`Bearings`]: heading and elevation about the character's up, from its front.

use core::f32::consts::{FRAC_PI_2, PI, TAU};

use glam::{Mat3A, Vec3A};

use crate::kinematics::chain::Upright;
use crate::math::trig;
use crate::math::{self, Bounded};
use crate::rig::Side;

/// A gaze higher or lower than this has a heading that says little, radians.
const STEEP_RAD: f32 = 80.0 * PI / 180.0;

/// Heading and pitch of a direction along forward, left and up; heading 0 where it goes straight up or down.
#[inline(always)]
pub(crate) fn heading_and_pitch(direction: Vec3A) -> [f32; 2] {
    let [ahead, left, up] = direction.to_array();
    trig::atan2_of_both([left, up], [ahead, math::sqrt(ahead * ahead + left * left)])
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
        let ahead = if ahead.length() > LEVEL { ahead } else { level(trunk_up) * -forward.dot(up).signum() };
        let forward = math::unit(ahead).unwrap_or(forward);
        let across = math::cross(up, forward);
        let left = if across.dot(left) < 0.0 { -across } else { across };
        let axes = Mat3A::from_cols(forward, left, up);
        Self { axes, rows: axes.transpose(), turns_round: false }
    }

    /// About what upright headings turn about, from the front of a trunk that has its forward, left and up as these columns.
    #[inline(always)]
    pub(crate) fn of_trunk(trunk: &Mat3A, about: Upright, turns_round: bool) -> Self {
        let Mat3A { x_axis: forward, y_axis: left, z_axis: trunk_up } = *trunk;
        let up = match about {
            Upright::About(up) => up,
            Upright::Off | Upright::Innermost => trunk_up,
        };
        Self { turns_round, ..Self::new(up, forward, left, trunk_up) }
    }

    /// The direction that elevations count towards.
    pub(crate) fn up(&self) -> Vec3A {
        self.axes.z_axis
    }

    /// Heading and elevation of a direction of any length but zero.
    #[inline(always)]
    pub(crate) fn angles(&self, direction: Vec3A) -> [f32; 2] {
        heading_and_pitch(self.rows * direction)
    }

    /// Heading and elevation of a unit direction as somebody turns to it: the nearer it is to the zenith, the less aside, and
    /// straight up from in front. The heading is atan2(left, forward + w) where cos ε falls short of cos 45° by √(w·cos 45°).
    #[inline(always)]
    pub(crate) fn turned_to(&self, direction: Vec3A) -> [f32; 2] {
        const STEEP_COS: f32 = core::f32::consts::FRAC_1_SQRT_2;
        let [ahead, left, up] = (self.rows * direction).to_array();
        let level = math::sqrt(ahead * ahead + left * left);
        let short = (STEEP_COS - level).at_least(0.0);
        trig::atan2_of_both([left, up], [ahead + short * short / STEEP_COS, level])
    }

    /// The unit direction of a heading and an elevation.
    #[inline(always)]
    pub(crate) fn direction(&self, [heading, elevation]: [f32; 2]) -> Vec3A {
        let [sin_e, cos_e, sin_h, cos_h] = trig::doubled(trig::halves(elevation, heading));
        self.axes * Vec3A::new(cos_h * cos_e, sin_h * cos_e, sin_e)
    }

    /// The unit direction this part of the way from one to another.
    pub(crate) fn part_way(&self, [from, to]: [Vec3A; 2], part: f32, side: Side) -> Vec3A {
        let [from, to] = [from, to].map(|direction| self.angles(direction));
        let way = self.way(from, to, side);
        self.direction([0, 1].map(|axis| from[axis] + part * way[axis]))
    }

    /// The way from one direction to another, by the `side` on which what is behind counts as being.
    pub(crate) fn way(&self, from: [f32; 2], to: [f32; 2], side: Side) -> [f32; 2] {
        let [mut heading, mut elevation] = to;
        match side {
            Side::Left if heading < -FRAC_PI_2 => heading += TAU,
            Side::Right if heading > FRAC_PI_2 => heading -= TAU,
            _ => {}
        }
        heading -= from[0];
        // Through the front, however far round the animation has turned the gaze: which side a target is on does not change
        // with that.
        if self.turns_round {
            heading = math::wrap_pi(heading);
        }
        // From near the zenith the other side is nearer by way of it.
        if from[1].abs() > STEEP_RAD && heading.abs() > FRAC_PI_2 {
            heading -= PI * heading.signum();
            elevation = PI * from[1].signum() - elevation;
        }
        [heading, elevation - from[1]]
    }
}
