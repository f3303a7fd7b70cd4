//! [`Steady`] and [`Screw`]: motions at constant speed, along a straight line or a screw.

use aim_runtime::glam::{Vec3, Vec3A};
use aim_runtime::rotation::{cross, exp, length, log, product, turned};

use super::root::RootPath;
use crate::float::{floor, narrow};
use crate::transform::{Transform, made_unit};

/// A screw motion: rotation about an axis and translation along it, both at constant speed. Any rigid motion has one
/// (Chasles' theorem).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screw {
    /// Unit direction of the axis in model space. Without a rotation, the direction of the movement; zero if there is
    /// neither.
    pub axis: Vec3,
    /// Point of the axis nearest to the root, in model space; `None` without a rotation.
    pub point: Option<Vec3>,
    /// Speed of the rotation about the axis, radians a second, not negative.
    pub turn_rad_s: f32,
    /// Speed of the root along its arc about the axis, units a second, not negative.
    pub arc_s: f32,
    /// Speed along the axis, units a second.
    pub along_s: f32,
}

impl Screw {
    /// Speed of the root, units a second. The ratio of two clips' speeds is the playback speed at which one moves as
    /// fast as the other.
    #[must_use]
    pub fn speed_s(&self) -> f32 {
        length(Vec3A::new(self.arc_s, self.along_s, 0.0))
    }
}

/// Motion at constant speed of a root that starts at `anchor`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Steady {
    /// Position of the root at the beginning.
    anchor: Vec3A,
    /// Unit axis of the rotation; arbitrary if there is none.
    axis: Vec3A,
    turn_rad_s: f64,
    /// Velocity at the beginning.
    velocity: Vec3A,
    /// `true` if the velocity rotates too, so that the root follows an arc instead of a straight line.
    is_curved: bool,
}

impl Steady {
    /// The screw motion from the beginning of a path to its end; the straight motion if the screw is not determined.
    pub(super) fn screw(path: &RootPath) -> Self {
        let (axis, angle) = whole_turn(path);
        let straight = Self {
            anchor: path.at(0.0).translation.into(),
            axis,
            turn_rad_s: angle / path.length_s,
            velocity: mean_velocity(path),
            is_curved: false,
        };
        let [sin, cos] = mean_turn(axis, angle);
        let square = sin * sin + cos * cos;
        // `square` = 4 sin²(φ/2) / φ². It vanishes at whole turns, where the arc is closed and its radius is
        // undetermined.
        if !(f64::from(square) * angle * angle > 4e-4 || angle.abs() < 1.0) {
            return straight;
        }
        // Find the initial velocity whose mean over the turn is `mean`. Its part v across the axis solves
        // mean = along + cos·v + sin·(axis × v).
        let mean = straight.velocity;
        let along = axis * axis.dot(mean);
        let across = mean - along;
        let velocity = along + (across * cos - cross(axis, across) * sin) / square;
        if velocity.is_finite() { Self { velocity, is_curved: true, ..straight } } else { straight }
    }

    /// The straight motion between the same ends.
    pub(super) fn straightened(&self, path: &RootPath) -> Self {
        Self { velocity: mean_velocity(path), is_curved: self.turn_rad_s == 0.0, ..*self }
    }

    /// Returns `true` if the motion over an interval depends on its length only, not on where it starts.
    pub(super) fn is_screw(&self) -> bool {
        self.is_curved
    }

    /// Returns the motion from the beginning to a time, which may be negative.
    pub(super) fn at(&self, time_s: f64) -> Transform {
        let angle = self.turn_rad_s * time_s;
        let rotation = turn(self.axis, angle);
        let mut mean = self.velocity;
        if self.is_curved {
            let along = self.axis * self.axis.dot(mean);
            let across = mean - along;
            let [sin, cos] = mean_turn(self.axis, angle);
            mean = along + across * cos + cross(self.axis, across) * sin;
        }
        // The root moves on from its anchor; everything else also turns about the root.
        let place = self.anchor - turned(rotation, self.anchor) + mean * narrow(time_s);
        Transform::new(place.into(), rotation)
    }

    pub(super) fn to_screw(self) -> Screw {
        let speed = length(self.velocity);
        if self.turn_rad_s == 0.0 {
            let axis = if speed > 0.0 { self.velocity / speed } else { Vec3A::ZERO };
            return Screw { axis: axis.into(), point: None, turn_rad_s: 0.0, arc_s: 0.0, along_s: speed };
        }
        // Choose the direction of the axis about which the turn is positive.
        let axis = if self.turn_rad_s < 0.0 { -self.axis } else { self.axis };
        let rate = narrow(self.turn_rad_s.abs());
        let along = axis.dot(self.velocity);
        let across = self.velocity - axis * along;
        // Velocity = ω × (anchor − point), solved for the point.
        let point = self.anchor + cross(axis, across) / rate;
        let point = point.is_finite().then_some(Vec3::from(point));
        Screw { axis: axis.into(), point, turn_rad_s: rate, arc_s: length(across), along_s: along }
    }
}

/// Displacement from the first frame to the last, divided by the duration; zero if that overflows.
fn mean_velocity(path: &RootPath) -> Vec3A {
    let way = path.at(narrow(path.length_s)).translation - path.at(0.0).translation;
    let velocity = Vec3A::from(way) / narrow(path.length_s);
    if velocity.is_finite() { velocity } else { Vec3A::ZERO }
}

/// Rotation about an axis by any angle, radians.
fn turn(axis: Vec3A, angle: f64) -> aim_runtime::glam::Quat {
    const TURN: f64 = core::f64::consts::TAU;
    // Remove whole turns in double precision.
    let angle = angle - floor(angle / TURN + 0.5) * TURN;
    made_unit(exp((axis * narrow(angle)).into()))
}

/// Means of sin and cos over angles from 0 to φ: (1 − cos φ)/φ and sin φ/φ.
fn mean_turn(axis: Vec3A, angle: f64) -> [f32; 2] {
    let phi = narrow(angle);
    if phi.abs() < 1e-3 {
        return [0.5 * phi, 1.0 - phi * phi / 6.0];
    }
    let half = turn(axis, angle);
    // The sign of the quaternion cancels in the products.
    let (sin, cos) = (Vec3A::new(half.x, half.y, half.z).dot(axis), half.w);
    [2.0 * sin * sin / phi, 2.0 * sin * cos / phi]
}

/// Axis and angle of a path's rotation from its beginning to its end, including whole turns.
fn whole_turn(path: &RootPath) -> (Vec3A, f64) {
    const TURN: f64 = core::f64::consts::TAU;
    let keys = path.rotation.values();
    let [start, end] = [0.0, narrow(path.length_s)].map(|time| path.rotation.sample(time));
    let short = Vec3A::from(log(made_unit(product(end, start.conjugate()))));
    let steps = keys.windows(2).map(|pair| Vec3A::from(log(made_unit(product(pair[1], pair[0].conjugate())))));
    let sum: Vec3A = steps.fold(Vec3A::ZERO, |sum, step| sum + step);
    let (size, travelled) = (length(short), length(sum));
    // After a whole turn both ends agree, and only the sum of the steps knows the axis.
    let axis = if size > 1e-3 || !(travelled > 3.0) { short / size } else { sum / travelled };
    if !axis.is_finite() {
        return (Vec3A::Y, 0.0);
    }
    let angle = f64::from(short.dot(axis));
    (axis, angle + TURN * floor((f64::from(sum.dot(axis)) - angle) / TURN + 0.5))
}
