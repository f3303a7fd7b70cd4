//! How a joint with inertia follows its goal: it takes up speed by its acceleration, brakes so that it stops there, and
//! never turns towards an end of its range faster than it can still stop before it.
//!
//! Within a frame a speed changes evenly, so the way is that of the mean of the speeds at both its ends: joints are at
//! the same place at the same time whatever the frame rate, and the speed from frame to frame, as it is seen, never
//! changes by more than acceleration × time either. Angles are heading and pitch, in this order.

use core::f32::consts::PI;

use crate::limits::RangeOfMotion;
use crate::limits::reach::{Reach, way};
use crate::{Joint, JointInfo, Role, math};

/// Accelerations beyond this make no difference any more, rad/s².
const MOST_RAD_S2: f32 = 1e6;

/// A joint's acceleration as it counts, rad/s²: what was declared, or what its part in a gaze suggests.
fn acceleration(info: &JointInfo) -> f32 {
    let by_role = match info.role {
        Role::Chest => 500.0 * PI / 180.0,
        _ => 1200.0 * PI / 180.0,
    };
    // Declared as nothing, negative or undefined counts as undeclared.
    let declared = info.acceleration > 0.0 && info.acceleration.is_finite();
    (if declared { info.acceleration } else { by_role }).min(MOST_RAD_S2)
}

/// One joint in one frame.
pub(crate) struct Follower<'a> {
    motion: &'a RangeOfMotion,
    reach: &'a Reach,
    dt: f32,
    rate: f32,
    /// The largest change of speed in this frame.
    gain: f32,
}

impl<'a> Follower<'a> {
    /// `reach` is that of this frame; `dt` seconds, positive.
    pub(crate) fn new(info: &JointInfo, motion: &'a RangeOfMotion, reach: &'a Reach, dt: f32) -> Self {
        Self { motion, reach, dt, rate: reach.step / dt, gain: acceleration(info) * dt }
    }

    /// The joint a frame further on its way to `goal`.
    pub(crate) fn towards(&self, joint: &Joint, goal: [f32; 2]) -> Joint {
        let [heading, pitch] = goal;
        let way = way(joint, &Joint { heading, pitch, ..*joint }, self.motion);
        if self.arrives(way, joint.velocity) {
            return self.held(joint, way, [0.0; 2]);
        }
        let distance = length(way);
        let along = way.map(|way| way / distance);
        let speed = self.braking(distance, along[0] * joint.velocity[0] + along[1] * joint.velocity[1]);
        // Both angles by one factor: an oblique way stays straight.
        let speed = speed.min(self.rate / along[0].abs().max(along[1].abs()));
        self.speeding_to(joint, along.map(|part| part * speed))
    }

    /// The joint a frame nearer to a stop, either angle as hard as it can.
    pub(crate) fn stopping(&self, joint: &Joint) -> Joint {
        let before = joint.velocity;
        let velocity = before.map(|speed| speed - speed.max(-self.gain).min(self.gain));
        let way = [0, 1].map(|index| 0.5 * (before[index] + velocity[index]) * self.dt);
        self.held(joint, way, velocity)
    }

    /// How far an angle goes on that changes at this speed, until it has [stopped](Self::stopping).
    pub(crate) fn stopping_distance(&self, speed: f32) -> f32 {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "as many whole frames as there are"
        )]
        let frames = f32::from((speed.abs() / self.gain) as u16);
        // Frames of even braking, and the last, in which less than all of it is needed.
        let last = (speed.abs() - frames * self.gain).max(0.0);
        speed.signum() * 0.5 * self.dt * (frames * (speed.abs() + last) + last)
    }

    /// The joint between two steps that it could take from `joint`, this part of the way from the first for either angle.
    pub(crate) fn between(&self, joint: &Joint, steps: [&Joint; 2], parts: [f32; 2]) -> Joint {
        let [first, second] = steps;
        let mix = |k: usize, a: f32, b: f32| a + parts[k] * (b - a);
        let way =
            [mix(0, first.heading, second.heading) - joint.heading, mix(1, first.pitch, second.pitch) - joint.pitch];
        self.held(joint, way, [0, 1].map(|k| mix(k, first.velocity[k], second.velocity[k])))
    }

    /// Whether the joint can come to rest at the end of this way within the frame, unnoticed: the mean speed of the frame
    /// is then one that leads there and to rest.
    fn arrives(&self, way: [f32; 2], velocity: [f32; 2]) -> bool {
        // What rounding makes of a stop that is just possible.
        let gain = 1.001 * self.gain;
        let mean = way.map(|way| way / self.dt);
        let change = [mean[0] - velocity[0], mean[1] - velocity[1]];
        length(velocity) <= gain && length(mean) <= 0.5 * gain && length(change) <= 0.5 * gain
    }

    /// The speed at the end of the frame from which the joint still stops at this distance, having begun it at `speed`:
    /// v² = 2·acceleration·(distance − (speed + v)·dt/2).
    fn braking(&self, distance: f32, speed: f32) -> f32 {
        let half = 0.5 * self.gain;
        math::sqrt(half * half + self.gain * (2.0 * distance / self.dt - speed)) - half
    }

    /// The joint a frame on, its velocity changed towards this one as far as its acceleration allows.
    fn speeding_to(&self, joint: &Joint, wanted: [f32; 2]) -> Joint {
        let before = joint.velocity;
        let change = [wanted[0] - before[0], wanted[1] - before[1]];
        let part = (self.gain / length(change)).min(1.0);
        let mut velocity = [before[0] + part * change[0], before[1] + part * change[1]];
        let ranges = [self.motion.heading, self.motion.pitch_at(joint.heading)];
        for (index, (range, angle)) in ranges.into_iter().zip([joint.heading, joint.pitch]).enumerate() {
            let up = self.braking((range.hi() - angle).max(0.0), before[index]).max(0.0);
            let down = self.braking((angle - range.lo()).max(0.0), -before[index]).max(0.0);
            // Where it is too late to brake in time the range ends the movement, below.
            let held = velocity[index].min(up).max(-down);
            velocity[index] = held.max(before[index] - self.gain).min(before[index] + self.gain);
        }
        let way = [0, 1].map(|index| 0.5 * (before[index] + velocity[index]) * self.dt);
        self.held(joint, way, velocity)
    }

    /// The joint moved by this way within its reach; range and rate beat acceleration.
    fn held(&self, joint: &Joint, way: [f32; 2], velocity: [f32; 2]) -> Joint {
        let wanted = [joint.heading + way[0], joint.pitch + way[1]];
        let held = self.reach.hold(&Joint { heading: wanted[0], pitch: wanted[1], ..*joint });
        let velocity = [
            if held.heading == wanted[0] { velocity[0] } else { (held.heading - joint.heading) / self.dt },
            if held.pitch == wanted[1] { velocity[1] } else { (held.pitch - joint.pitch) / self.dt },
        ];
        Joint { velocity, ..held }
    }
}

fn length([x, y]: [f32; 2]) -> f32 {
    math::sqrt(x * x + y * y)
}
