//! Turns over time: speed, acceleration, and how often the acceleration is thrown about.

use std::collections::VecDeque;

use aim_runtime::glam::{DMat3, DVec3};

use super::Worst;

/// A reversal takes no longer than this, and as many count as there are in this time, seconds.
const REVERSAL_S: f64 = 0.1;
const COUNTED_S: f64 = 0.5;
/// Steps shorter than this part of a frame tell rounding, not speed: the last of a clip may be one.
const SHORT: f64 = 0.5;

/// A rotation in the world that is followed from frame to frame.
pub(super) struct Turning {
    /// The acceleration that counts as full one way or the other: half of the budget, degrees a second squared.
    full: f64,
    /// The shortest step that is measured, seconds.
    least_s: f64,
    last: Option<(f64, DMat3)>,
    /// Over the last step, degrees a second, with its middle.
    velocity: Option<(f64, DVec3)>,
    acceleration: Option<DVec3>,
    /// For each axis, when it last was full, and which way.
    was_full: [Option<(f64, bool)>; 3],
    /// For each axis, its reversals of the last while.
    reversals: [VecDeque<f64>; 3],
    most: Worst,
}

impl Turning {
    /// With a budget of acceleration in degrees a second squared.
    pub(super) fn new(budget: f64, fps: f32) -> Self {
        Self {
            full: 0.5 * budget,
            least_s: SHORT / f64::from(fps),
            last: None,
            velocity: None,
            acceleration: None,
            was_full: [None; 3],
            reversals: Default::default(),
            most: Worst { value: 0.0, t: 0.0 },
        }
    }

    /// The rotation at a time later than the one before.
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
            self.watch(axis, before);
        }
    }

    /// Forgets what was before: the next rotation has nothing to do with it.
    pub(super) fn restart(&mut self) {
        (self.last, self.velocity, self.acceleration, self.was_full) = (None, None, None, [None; 3]);
    }

    /// Degrees a second over the last step.
    pub(super) fn speed(&self) -> Option<f64> {
        self.velocity.map(|(_, velocity)| velocity.length())
    }

    /// Degrees a second squared between the last two steps.
    pub(super) fn acceleration(&self) -> Option<f64> {
        self.acceleration.map(DVec3::length)
    }

    /// The largest number of reversals of one axis in half a second, and when it was reached.
    pub(super) fn most_reversals(&self) -> Worst {
        self.most
    }

    fn watch(&mut self, axis: usize, t: f64) {
        let Some(along) = self.acceleration.map(|acceleration| acceleration[axis]) else { return };
        if along.abs() <= self.full {
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

/// Axis times angle of a rotation, radians.
fn rotation_vector(turn: &DMat3) -> DVec3 {
    let axis = DVec3::new(turn.y_axis.z - turn.z_axis.y, turn.z_axis.x - turn.x_axis.z, turn.x_axis.y - turn.y_axis.x);
    let trace = turn.x_axis.x + turn.y_axis.y + turn.z_axis.z;
    axis.normalize_or_zero() * axis.length().atan2(trace - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A turn about up whose acceleration is +1000 and −1000°/s² in turns of `half_s`, at 120 frames a second.
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
    fn speed_and_acceleration_of_a_steady_push() {
        let turning = shaken(10.0, 0.25);
        assert!((turning.acceleration().expect("three frames") - 1000.0).abs() < 1e-6);
        // 30 frames: the last step has had 29 pushes.
        assert!((turning.speed().expect("two frames") - 1000.0 * 29.0 / 120.0).abs() < 10.0);
        assert_eq!(turning.most_reversals().value, 0.0);
    }

    #[test]
    fn reversals_are_counted_where_they_follow_each_other_quickly() {
        // Five changes of way in half a second, or one too slow to be one: it is full until it turns.
        assert_eq!(shaken(0.11, 2.0).most_reversals().value, 5.0);
        assert_eq!(shaken(0.3, 2.0).most_reversals().value, 2.0);
        assert_eq!(shaken(3.0, 2.0).most_reversals().value, 0.0);
    }

    #[test]
    fn a_last_step_of_next_to_nothing_tells_no_speed() {
        let mut turning = Turning::new(1200.0, 60.0);
        turning.push(0.0, DMat3::IDENTITY);
        turning.push(1.0 / 60.0, DMat3::from_rotation_y(0.01));
        let before = turning.speed();
        turning.push(1.0 / 60.0 + 1e-6, DMat3::from_rotation_y(0.0100002));
        assert_eq!(turning.speed(), before);
    }
}
