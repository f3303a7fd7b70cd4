//! Offsets that go on under their own momentum and fade.

use aim_runtime::glam::Vec3;

/// The fifth-degree polynomials from 1 and from a velocity of 1 to nothing, without acceleration at either end, for `u` in 0…1.
pub(crate) fn faded(u: f32) -> (f32, f32) {
    let cube = u * u * u;
    (1.0 - cube * (10.0 - u * (15.0 - 6.0 * u)), u - cube * (6.0 - u * (8.0 - 3.0 * u)))
}

/// Two vectors that fade, from a value and a velocity to nothing at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fade {
    value: [Vec3; 2],
    velocity: [Vec3; 2],
    elapsed_s: f32,
    /// 0 where nothing fades.
    length_s: f32,
}

impl Fade {
    pub(crate) const NONE: Self =
        Self { value: [Vec3::ZERO; 2], velocity: [Vec3::ZERO; 2], elapsed_s: 0.0, length_s: 0.0 };

    /// From here to nothing in `length_s` seconds; a length that is not positive and finite is a cut, and what is not finite
    /// counts as nothing.
    pub(crate) fn new(value: [Vec3; 2], velocity: [Vec3; 2], length_s: f32) -> Self {
        let finite = |vector: Vec3| if vector.is_finite() { vector } else { Vec3::ZERO };
        let length_s = if length_s.is_finite() { length_s.max(0.0) } else { 0.0 };
        Self { value: value.map(finite), velocity: velocity.map(finite), elapsed_s: 0.0, length_s }
    }

    /// Goes on by `dt_s` seconds; what is negative or not finite counts as 0.
    pub(crate) fn advance(&mut self, dt_s: f32) {
        if dt_s.is_finite() {
            self.elapsed_s = (self.elapsed_s + dt_s.max(0.0)).min(self.length_s);
        }
    }

    pub(crate) fn is_done(&self) -> bool {
        !(self.elapsed_s < self.length_s)
    }

    /// The velocity at which it fades.
    pub(crate) fn rate(&self) -> [Vec3; 2] {
        if self.is_done() {
            return [Vec3::ZERO; 2];
        }
        let (of_value, of_velocity) = fading(self.elapsed_s / self.length_s);
        [0, 1].map(|part: usize| self.value[part] * (of_value / self.length_s) + self.velocity[part] * of_velocity)
    }

    /// The part that is left.
    pub(crate) fn left(&self) -> [Vec3; 2] {
        if self.is_done() {
            return [Vec3::ZERO; 2];
        }
        let (of_value, of_velocity) = faded(self.elapsed_s / self.length_s);
        [0, 1].map(|part: usize| self.value[part] * of_value + self.velocity[part] * (of_velocity * self.length_s))
    }
}

/// A number within 0…1 that goes to one of these ends in a given time, without a jump in value or speed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Ramp {
    goal: f32,
    value: f32,
    velocity: f32,
    elapsed_s: f32,
    length_s: f32,
    /// Its beginning, as seen from the goal, and its speed there.
    from: [f32; 2],
    /// The time in which that speed runs out, seconds; at most the whole.
    slowing_s: f32,
}

impl Ramp {
    /// Leads it to a goal; nothing is done if that is where it goes.
    pub(crate) fn lead(&mut self, goal: f32, length_s: f32) {
        if goal != self.goal {
            let (from, velocity) = (self.value - goal, self.velocity);
            (self.from, self.goal) = ([from, velocity], goal);
            (self.elapsed_s, self.length_s) = (0.0, if length_s.is_finite() { length_s.max(0.0) } else { 0.0 });
            // Within 0…1: away from the goal the speed leads on by at most 16/81 · speed · time, and the room is up to the other end.
            // Towards the goal it stays short of it: the ratio of both polynomials is at most 2/5.
            let room = if from * velocity > 0.0 { (1.0 - from.abs()) * 81.0 / 16.0 } else { from.abs() * 2.5 };
            self.slowing_s = (room.max(0.0) / velocity.abs()).min(self.length_s);
        }
    }

    pub(crate) fn advance(&mut self, dt_s: f32) {
        let dt = if dt_s.is_finite() { dt_s.max(0.0) } else { 0.0 };
        self.elapsed_s = (self.elapsed_s + dt).min(self.length_s);
        let (value, velocity) = if self.elapsed_s < self.length_s {
            let (u, length, slowing) = (self.elapsed_s / self.length_s, self.length_s, self.slowing_s);
            // A slowing of no time is over.
            let slowed = (self.elapsed_s / slowing).min(1.0);
            let [value, velocity] = self.from;
            let rate = value * fading(u).0 / length + velocity * fading(slowed).1;
            (value * faded(u).0 + velocity * faded(slowed).1 * slowing, rate)
        } else {
            (0.0, 0.0)
        };
        (self.value, self.velocity) = (self.goal + value, velocity);
    }

    pub(crate) fn value(&self) -> f32 {
        self.value
    }
}

/// The derivatives of [`faded`].
fn fading(u: f32) -> (f32, f32) {
    let square = u * u;
    let rest = 1.0 - u;
    (-30.0 * square * rest * rest, 1.0 - square * (18.0 - u * (32.0 - 15.0 * u)))
}
