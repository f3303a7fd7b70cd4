//! [`Steady`]: motions at constant speed, straight or along a screw.

use aim_runtime::glam::{Vec3, Vec3A};
use aim_runtime::rotation::{cross, exp, length, log, product, turned};

use super::root::RootPath;
use crate::float::{floor, narrow};
use crate::transform::{Transform, made_unit};

/// A screw: a turn about an axis and a shift along it, both at constant speed. Any rigid motion is one (Chasles).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screw {
    /// The direction of the axis in the space of the model, a unit vector. Without a turn it is that of the movement; zero if
    /// there is none of either.
    pub axis: Vec3,
    /// A point of the axis in the space of the model, the one nearest to the root; `None` without a turn.
    pub point: Option<Vec3>,
    /// The speed of the turn about the axis, radians a second, not negative.
    pub turn_rad_s: f32,
    /// The speed of the root along its arc about the axis, units a second, not negative.
    pub arc_s: f32,
    /// The speed along the axis, units a second.
    pub along_s: f32,
}

impl Screw {
    /// The speed of the root, units a second. To play another clip as fast as this one, its control's speed is the ratio of the two.
    #[must_use]
    pub fn speed_s(&self) -> f32 {
        length(Vec3A::new(self.arc_s, self.along_s, 0.0))
    }
}

/// A motion at constant speed of a root that begins at `anchor`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Steady {
    /// The root's place at the beginning.
    anchor: Vec3A,
    /// The axis of the turn, unit; any if there is none.
    axis: Vec3A,
    turn_rad_s: f64,
    /// The velocity at the beginning.
    velocity: Vec3A,
    /// True if the velocity turns too: along an arc, not straight.
    is_curved: bool,
}

impl Steady {
    /// From the beginning of a path to its end along a screw; straight where there is none.
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
        // 4 sin²(φ/2) / φ²: vanishes after whole turns, where the root comes back whatever the radius of its arc.
        if !(f64::from(square) * angle * angle > 4e-4 || angle.abs() < 1.0) {
            return straight;
        }
        // The velocity v whose mean over the turn is the way: way/T = along + cos·v + sin·(axis × v), solved for v.
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

    /// Whether the motion of any interval follows from its length alone.
    pub(super) fn is_screw(&self) -> bool {
        self.is_curved
    }

    /// The motion from the beginning to a time, which may be negative.
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
        // The root goes from its anchor, and all else turns about it.
        let place = self.anchor - turned(rotation, self.anchor) + mean * narrow(time_s);
        Transform::new(place.into(), rotation)
    }

    pub(super) fn to_screw(self) -> Screw {
        let speed = length(self.velocity);
        if self.turn_rad_s == 0.0 {
            let axis = if speed > 0.0 { self.velocity / speed } else { Vec3A::ZERO };
            return Screw { axis: axis.into(), point: None, turn_rad_s: 0.0, arc_s: 0.0, along_s: speed };
        }
        // Of the two directions of an axis the one about which the turn is positive.
        let axis = if self.turn_rad_s < 0.0 { -self.axis } else { self.axis };
        let rate = narrow(self.turn_rad_s.abs());
        let along = axis.dot(self.velocity);
        let across = self.velocity - axis * along;
        // The velocity is ω × (anchor − point).
        let point = self.anchor + cross(axis, across) / rate;
        let point = point.is_finite().then_some(Vec3::from(point));
        Screw { axis: axis.into(), point, turn_rad_s: rate, arc_s: length(across), along_s: along }
    }
}

/// From the first frame to the last over the time between; zero where that is beyond all numbers.
fn mean_velocity(path: &RootPath) -> Vec3A {
    let way = path.at(narrow(path.length_s)).translation - path.at(0.0).translation;
    let velocity = Vec3A::from(way) / narrow(path.length_s);
    if velocity.is_finite() { velocity } else { Vec3A::ZERO }
}

/// The rotation about an axis by any angle.
fn turn(axis: Vec3A, angle: f64) -> aim_runtime::glam::Quat {
    const TURN: f64 = core::f64::consts::TAU;
    // Whole turns are taken off in double precision.
    let angle = angle - floor(angle / TURN + 0.5) * TURN;
    made_unit(exp((axis * narrow(angle)).into()))
}

/// sin and cos, averaged over angles from 0 to this one: (1 − cos φ)/φ and sin φ/φ.
fn mean_turn(axis: Vec3A, angle: f64) -> [f32; 2] {
    let phi = narrow(angle);
    if phi.abs() < 1e-3 {
        return [0.5 * phi, 1.0 - phi * phi / 6.0];
    }
    let half = turn(axis, angle);
    // The sign of the quaternion does not matter to its products.
    let (sin, cos) = (Vec3A::new(half.x, half.y, half.z).dot(axis), half.w);
    [2.0 * sin * sin / phi, 2.0 * sin * cos / phi]
}

/// The axis and the angle of a path's turn from its beginning to its end, with the whole turns between.
fn whole_turn(path: &RootPath) -> (Vec3A, f64) {
    const TURN: f64 = core::f64::consts::TAU;
    let keys = path.rotation.values();
    let [start, end] = [0.0, narrow(path.length_s)].map(|time| path.rotation.sample(time));
    let short = Vec3A::from(log(made_unit(product(end, start.conjugate()))));
    let steps = keys.windows(2).map(|pair| Vec3A::from(log(made_unit(product(pair[1], pair[0].conjugate())))));
    let sum: Vec3A = steps.fold(Vec3A::ZERO, |sum, step| sum + step);
    let (size, travelled) = (length(short), length(sum));
    // Of a whole turn the way alone knows the axis.
    let axis = if size > 1e-3 || !(travelled > 3.0) { short / size } else { sum / travelled };
    if !axis.is_finite() {
        return (Vec3A::Y, 0.0);
    }
    let angle = f64::from(short.dot(axis));
    (axis, angle + TURN * floor((f64::from(sum.dot(axis)) - angle) / TURN + 0.5))
}
