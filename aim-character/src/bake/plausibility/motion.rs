//! Measures rotations over time: speed, acceleration, and the number of quick reversals of the acceleration.

use std::collections::VecDeque;

use aim_runtime::glam::{DMat3, DVec3};

use super::Worst;

/// Longest duration of a reversal, seconds.
const REVERSAL_S: f64 = 0.1;
/// Time over which reversals are counted, seconds.
const COUNTED_S: f64 = 0.5;
/// Steps shorter than this share of a frame are ignored, because their speed is mostly rounding error. The last step of
/// a clip may be one.
const SHORT: f64 = 0.5;

/// A rotation in world space, followed from frame to frame.
pub(super) struct Turning {
    /// Acceleration above which an axis is fully accelerated in one direction: half of the budget, degrees per second
    /// squared.
    full_deg_s2: f64,
    /// Shortest step that is measured, seconds.
    least_s: f64,
    last: Option<(f64, DMat3)>,
    /// Mean angular velocity over the last step, degrees per second, with the time of the step's middle.
    velocity: Option<(f64, DVec3)>,
    acceleration: Option<DVec3>,
    /// For each axis, the last time at which it was fully accelerated, and whether in the positive direction.
    was_full: [Option<(f64, bool)>; 3],
    /// For each axis, the times of its recent reversals.
    reversals: [VecDeque<f64>; 3],
    most: Worst,
}

impl Turning {
    /// Creates a tracker. `budget` is in degrees per second squared.
    pub(super) fn new(budget: f64, fps: f32) -> Self {
        Self {
            full_deg_s2: 0.5 * budget,
            least_s: SHORT / f64::from(fps),
            last: None,
            velocity: None,
            acceleration: None,
            was_full: [None; 3],
            reversals: Default::default(),
            most: Worst { value: 0.0, t: 0.0 },
        }
    }

    /// Adds the rotation at a time later than the previous one.
    pub(super) fn push(&mut self, t: f64, turn: DMat3) {
        let Some((before, from)) = self.last else {
            self.last = Some((t, turn));
            return;
        };
        let dt = t - before;
        if dt < self.least_s {
            return;
        }
        self.last = Some((t, turn));
        let velocity = rotation_vector(&(turn * from.transpose())) * (1.0 / dt).to_degrees();
        let middle = before + 0.5 * dt;
        self.acceleration = self.velocity.map(|(at, slower)| (velocity - slower) / (middle - at));
        self.velocity = Some((middle, velocity));
        for axis in 0..3 {
            self.count_reversal(axis, before);
        }
    }

    /// Forgets the past: the next rotation is unrelated to the previous one.
    pub(super) fn restart(&mut self) {
        (self.last, self.velocity, self.acceleration, self.was_full) = (None, None, None, [None; 3]);
    }

    /// Returns the angular speed over the last step, degrees per second.
    pub(super) fn speed(&self) -> Option<f64> {
        self.velocity.map(|(_, velocity)| velocity.length())
    }

    /// Returns the angular acceleration between the last two steps, degrees per second squared.
    pub(super) fn acceleration(&self) -> Option<f64> {
        self.acceleration.map(DVec3::length)
    }

    /// Returns the largest number of reversals of one axis within half a second, and the time at which it was reached.
    pub(super) fn most_reversals(&self) -> Worst {
        self.most
    }

    /// Counts a reversal of an axis, if its acceleration changed from full in one direction to full in the other.
    fn count_reversal(&mut self, axis: usize, t: f64) {
        let Some(along) = self.acceleration.map(|acceleration| acceleration[axis]) else { return };
        if along.abs() <= self.full_deg_s2 {
            return;
        }
        let way = along > 0.0;
        if self.was_full[axis].is_some_and(|(since, before)| before != way && t - since <= REVERSAL_S + 1e-6) {
            let recent = &mut self.reversals[axis];
            recent.push_back(t);
            while recent.front().is_some_and(|first| t - first >= COUNTED_S) {
                recent.pop_front();
            }
            let count = crate::num::count(recent.len());
            if count > self.most.value {
                self.most = Worst { value: count, t };
            }
        }
        self.was_full[axis] = Some((t, way));
    }
}

/// Returns axis times angle of a rotation, radians.
fn rotation_vector(turn: &DMat3) -> DVec3 {
    let axis = DVec3::new(turn.y_axis.z - turn.z_axis.y, turn.z_axis.x - turn.x_axis.z, turn.x_axis.y - turn.y_axis.x);
    let trace = turn.x_axis.x + turn.y_axis.y + turn.z_axis.z;
    axis.normalize_or_zero() * axis.length().atan2(trace - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a rotation about up whose acceleration alternates between +1000 and −1000°/s² every `half_s`, at 120
    /// frames per second.
    fn shaken(half_s: f64, seconds: f64) -> Turning {
        let mut turning = Turning::new(1200.0, 120.0);
        let (mut angle, mut speed, dt) = (0.0, 0.0, 1.0 / 120.0);
        let mut t = 0.0;
        while t < seconds {
            turning.push(t, DMat3::from_rotation_y(f64::to_radians(angle)));
            let way = if (t / half_s).rem_euclid(2.0) < 1.0 { 1.0 } else { -1.0 };
            speed += 1000.0 * way * dt;
            angle += speed * dt;
            t += dt;
        }
        turning
    }

    #[test]
    fn constant_acceleration_is_measured() {
        let turning = shaken(10.0, 0.25);
        assert!((turning.acceleration().expect("three frames") - 1000.0).abs() < 1e-6);
        // 30 frames: by the last step the acceleration has been applied 29 times.
        assert!((turning.speed().expect("two frames") - 1000.0 * 29.0 / 120.0).abs() < 10.0);
        assert_eq!(turning.most_reversals().value, 0.0);
    }

    #[test]
    fn reversals_are_counted_where_they_follow_each_other_quickly() {
        // The acceleration is full until it changes sign, so every change is a reversal: five, two and none in half a
        // second.
        assert_eq!(shaken(0.11, 2.0).most_reversals().value, 5.0);
        assert_eq!(shaken(0.3, 2.0).most_reversals().value, 2.0);
        assert_eq!(shaken(3.0, 2.0).most_reversals().value, 0.0);
    }

    #[test]
    fn a_tiny_last_step_gives_no_speed() {
        let mut turning = Turning::new(1200.0, 60.0);
        turning.push(0.0, DMat3::IDENTITY);
        turning.push(1.0 / 60.0, DMat3::from_rotation_y(0.01));
        let before = turning.speed();
        turning.push(1.0 / 60.0 + 1e-6, DMat3::from_rotation_y(0.0100002));
        assert_eq!(turning.speed(), before);
    }
}
