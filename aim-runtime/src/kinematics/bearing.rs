//! [`Bearings`]: heading and elevation about the character's up, from its front.

use core::f32::consts::{FRAC_PI_2, PI, TAU};

use glam::Vec3A;

use crate::kinematics::chain::{Chain, Upright};
use crate::math;
use crate::math::trig;
use crate::rig::{ChainRig, Side};
use crate::{Axes, JointInfo};

/// A gaze higher or lower than this has a heading that says little, radians.
const STEEP_RAD: f32 = 80.0 * PI / 180.0;

/// Directions of solver space as headings (from the front to the left) and elevations above the horizon, radians.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bearings {
    forward: Vec3A,
    left: Vec3A,
    up: Vec3A,
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
        Self { forward, left: if across.dot(left) < 0.0 { -across } else { across }, up, turns_round: false }
    }

    /// About what upright headings turn about, from the front of a chain's innermost joint as the animation has it.
    pub(crate) fn of_chain<const C: usize>(rig: &ChainRig<'_, C>, chain: &Chain<C>, about: Upright) -> Self {
        let Axes { up, forward, left } = rig.joints[chain.count - 1].axes;
        let tilt = chain.tilts[chain.count - 1].conjugate();
        let [trunk_up, forward, left] =
            [up, forward, left].map(|axis| chain.base.matrix3 * math::turned(tilt, axis.into()));
        let up = match about {
            Upright::About(up) => up,
            Upright::Off | Upright::Innermost => trunk_up,
        };
        let all = [f32::NEG_INFINITY, f32::INFINITY];
        let is_free = |info: &JointInfo| info.heading == Some(all) && rig.budget(info.role).heading == all;
        Self { turns_round: rig.joints[chain.first..].iter().any(is_free), ..Self::new(up, forward, left, trunk_up) }
    }

    /// Heading and elevation of a direction.
    pub(crate) fn angles(&self, direction: Vec3A) -> [f32; 2] {
        let [ahead, left, up] = [self.forward, self.left, self.up].map(|axis| direction.dot(axis));
        let level = math::sqrt(ahead * ahead + left * left);
        [trig::atan2(left, ahead), trig::atan2(up, level)]
    }

    /// The unit direction of a heading and an elevation.
    pub(crate) fn direction(&self, [heading, elevation]: [f32; 2]) -> Vec3A {
        let ((sin_h, cos_h), (sin_e, cos_e)) = (trig::sin_cos(heading), trig::sin_cos(elevation));
        (self.forward * cos_h + self.left * sin_h) * cos_e + self.up * sin_e
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
