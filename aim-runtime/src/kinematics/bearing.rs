//! [`Bearings`]: heading and elevation of directions about the character's up, measured from its front. Pairs of angles
//! are the first two lanes of a [`Vec4`], in this order.

use core::f32::consts::{FRAC_PI_2, PI, TAU};

use glam::{Mat3A, Vec3A, Vec3Swizzles, Vec4, Vec4Swizzles};

use crate::kinematics::chain::Upright;
use crate::math::trig;
use crate::math::{self, Bounded};
use crate::rig::Side;

/// Elevation, up or down, beyond which a heading carries little information, radians.
const STEEP_RAD: f32 = 80.0 * PI / 180.0;
/// Elevation, up or down, beyond which a forward is measured by its [steep angles](Bearings::steep_angles), radians.
pub(crate) const FORWARD_STEEP_RAD: f32 = 45.0 * PI / 180.0;
/// Elevations, up or down, between which the heading of a forward is replaced by that of its front, radians.
const VERTICAL_RAD: [f32; 2] = [75.0 * PI / 180.0, 85.0 * PI / 180.0];
/// Elevations, up or down, radians. Beyond the first, directions to the side are [turned to](Bearings::turned) with a
/// smaller heading than their own; beyond the second, even directions behind are turned to through the front.
pub(crate) const BY_THE_FRONT_RAD: [f32; 2] = [45.0 * PI / 180.0, 60.0 * PI / 180.0];

/// Returns heading and pitch of a direction with components along forward, left and up. The heading is 0 for straight
/// up and straight down.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn heading_and_pitch(direction: Vec3A) -> Vec4 {
    let level = math::root(direction.x * direction.x + direction.y * direction.y);
    let both = Vec4::new(direction.x, level, direction.x, level);
    trig::atan2_of_4(Vec4::from((direction.yzz(), 0.0)), both)
}

/// Returns heading and pitch of two directions, one pair after the other, in little more than the time of one.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn headings_and_pitches([a, b]: [Vec3A; 2]) -> Vec4 {
    let [ahead, left, up] = a.to_array();
    let [b_ahead, b_left, b_up] = b.to_array();
    let (level, b_level) = (math::root(ahead * ahead + left * left), math::root(b_ahead * b_ahead + b_left * b_left));
    trig::atan2_of_4(Vec4::new(left, up, b_left, b_up), Vec4::new(ahead, level, b_ahead, b_level))
}

/// Converts between directions of solver space and angles: headings from the front towards the left, and elevations
/// above the horizon, radians.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bearings {
    /// Matrix with forward, left and up as columns, and its transpose.
    axes: Mat3A,
    rows: Mat3A,
    /// `true` if a joint of the chain can turn all the way round.
    turns_round: bool,
    /// `true` if the axes are those of the trunk.
    pub(crate) are_of_trunk: bool,
}

impl Bearings {
    /// Creates bearings about `up`. The trunk's `forward` has heading 0, and headings are positive towards its `left`.
    /// If the trunk lies, so that `forward` is nearly vertical, the direction of `trunk_up` (the head) is the front
    /// when it faces down, and the opposite direction when it faces up.
    fn new(up: Vec3A, forward: Vec3A, left: Vec3A, trunk_up: Vec3A) -> Self {
        const LEVEL: f32 = 0.1;
        let level = |v: Vec3A| v - up * v.dot(up);
        let ahead = level(forward);
        let ahead = if ahead.dot(ahead) > LEVEL * LEVEL { ahead } else { level(trunk_up) * -forward.dot(up).signum() };
        let forward = math::unit(ahead).unwrap_or(forward);
        let across = math::cross(up, forward);
        let left = if across.dot(left) < 0.0 { -across } else { across };
        let axes = Mat3A::from_cols(forward, left, up);
        Self { axes, rows: axes.transpose(), turns_round: false, are_of_trunk: false }
    }

    /// Creates bearings about the axis of upright headings, with the front of a trunk that has forward, left and up as
    /// these columns.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn of_trunk(trunk: &Mat3A, about: Upright, turns_round: bool) -> Self {
        let Mat3A { x_axis: forward, y_axis: left, z_axis: trunk_up } = *trunk;
        match about {
            Upright::About(up) => Self { turns_round, ..Self::new(up, forward, left, trunk_up) },
            Upright::Off | Upright::Innermost => {
                Self { axes: *trunk, rows: trunk.transpose(), turns_round, are_of_trunk: true }
            }
        }
    }

    /// Returns the direction from whose horizon elevations are measured.
    pub(crate) fn up(&self) -> Vec3A {
        self.axes.z_axis
    }

    /// Returns heading and elevation of a direction of any length but zero.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn angles(&self, direction: Vec3A) -> Vec4 {
        heading_and_pitch(self.rows * direction)
    }

    /// Returns heading and elevation of two directions, one pair after the other.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn angles_of_both(&self, directions: [Vec3A; 2]) -> Vec4 {
        headings_and_pitches(directions.map(|direction| self.rows * direction))
    }

    /// Returns heading and elevation of `from`, then the angles by which a person turns to the unit direction `to`: the
    /// nearer to the zenith it is, the smaller the heading, and straight up is approached from the front. That heading
    /// is atan2(left, forward + 3d·(d/cos 45° − min(forward, 0))), where d = max(0, cos 45° − cos ε). Above about 60°,
    /// even directions behind are turned to through the front. The elevation is measured in the vertical plane of that
    /// heading, so it exceeds ±90° there.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn turned(&self, from: Vec3A, to: Vec3A) -> [Vec4; 2] {
        const STEEP_COS: f32 = core::f32::consts::FRAC_1_SQRT_2;
        /// Large enough that a character walking away under its target looks up instead of round.
        const AHEAD: f32 = 3.0;
        let [from, to] = [from, to].map(|direction| self.rows * direction);
        let [from_level, level] = [from, to].map(|v| math::root(v.x * v.x + v.y * v.y));
        // Forward and left components for the heading, and the level and upward ones for the elevation, at any scale.
        let (mut forward, mut along, mut up) = (to.x, level, to.z);
        if level < STEEP_COS {
            let short = STEEP_COS - level;
            forward += AHEAD * short * (short / STEEP_COS - to.x.at_most(0.0));
            along = to.x * forward + to.y * to.y;
            up *= math::root(forward * forward + to.y * to.y);
        }
        let ahead = Vec4::new(from.x, from_level, forward, along);
        let both = trig::atan2_of_4(Vec4::new(from.y, from.z, to.y, up), ahead);
        [both, both.zwzw()]
    }

    /// Returns heading and elevation of a steep forward whose frame has this `up`. `angles` is what [`Self::angles`]
    /// returns for the forward.
    ///
    /// A forward beyond the vertical, behind and with its frame upside down, is measured from the front: heading ± π and
    /// elevation ±π − ε, an angle beyond ±90°. The heading of a nearly vertical forward is that of its own front, which
    /// is where up points if the forward points down, and the opposite direction if it points up; or the trunk's, if
    /// they differ by 90° or more, as in a body that lies on its side.
    #[cold]
    #[inline(never)]
    pub(crate) fn steep_angles(&self, angles: Vec4, up: Vec3A) -> Vec4 {
        let [mut heading, mut elevation, ..] = angles.to_array();
        let sign = elevation.signum();
        let up = self.rows * up;
        if up.z < 0.0 && heading.abs() > FRAC_PI_2 {
            heading -= PI * heading.signum();
            elevation = PI * sign - elevation;
        }
        let (ahead, left) = (-sign * up.x, -sign * up.y);
        let level = math::root(ahead * ahead + left * left).at_least(1e-3);
        // Up to 60° from the trunk's front, and none of it from 90° on.
        let front = trig::atan2(left, ahead) * (2.0 * ahead / level).at_least(0.0).at_most(1.0);
        let [from, to] = VERTICAL_RAD;
        let part = ((angles.y.abs() - from) / (to - from)).at_least(0.0).at_most(1.0);
        heading += math::wrap_pi(front - heading) * part;
        Vec4::new(heading, elevation, heading, elevation)
    }

    /// Returns the unit direction with this heading and elevation.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn direction(&self, angles: Vec4) -> Vec3A {
        self.direction_of(trig::halves_of(angles))
    }

    /// Returns the unit directions of two pairs of heading and elevation.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn directions(&self, angles: Vec4) -> [Vec3A; 2] {
        trig::halves_of_both(angles).map(|halves| self.direction_of(halves))
    }

    #[cfg_attr(not(aim_small), inline(always))]
    fn direction_of(&self, halves: trig::Halves) -> Vec3A {
        let [sin_e, cos_e, sin_h, cos_h] = trig::doubled(halves).to_array();
        self.axes * Vec3A::new(cos_h * cos_e, sin_h * cos_e, sin_e)
    }

    /// Returns the unit direction at this fraction of the way from one direction to another.
    #[cold]
    pub(crate) fn part_way(&self, [from, to]: [Vec3A; 2], part: f32, side: Side) -> Vec3A {
        let [from, to] = [from, to].map(|direction| self.angles(direction));
        self.direction(from + self.angle_change(from, to, side) * part)
    }

    /// Returns the change of heading and elevation from one direction to another. A target more than 90° to the side
    /// counts as being on `side`.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn angle_change(&self, from: Vec4, to: Vec4, side: Side) -> Vec4 {
        let ([from_heading, from_elevation, ..], [mut heading, mut elevation, ..]) = (from.to_array(), to.to_array());
        match side {
            Side::Left if heading < -FRAC_PI_2 => heading += TAU,
            Side::Right if heading > FRAC_PI_2 => heading -= TAU,
            _ => {}
        }
        heading -= from_heading;
        // Unwrapped, the way leads through the front however far the animation has turned the gaze, so the side of a
        // target does not depend on that. A joint that turns all the way round takes the shorter way.
        if self.turns_round {
            heading = math::wrap_pi(heading);
        }
        // From a steep gaze, the far side is nearer over the zenith: heading ± π with elevation π − ε is the same
        // direction. Nobody looks back under the body, so a gaze in front never passes the nadir.
        if from_elevation.abs() > STEEP_RAD
            && heading.abs() > FRAC_PI_2
            && (from_elevation > 0.0 || from_heading.abs() > FRAC_PI_2)
        {
            heading -= PI * heading.signum();
            elevation = PI * from_elevation.signum() - elevation;
        }
        Vec4::new(heading, elevation - from_elevation, 0.0, 0.0)
    }
}
