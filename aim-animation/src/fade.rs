//! Offsets that decay smoothly to zero from an initial value and velocity.

use aim_runtime::glam::Vec3;

/// Evaluates two quintic polynomials at `u` in 0…1: the first decays from the value 1, the second from the value 0 with
/// velocity 1.
///
/// Both reach the value 0 at `u = 1` with velocity 0, and have acceleration 0 at both ends.
pub(crate) fn decay_polynomials(u: f32) -> (f32, f32) {
    let cube = u * u * u;
    (1.0 - cube * (10.0 - u * (15.0 - 6.0 * u)), u - cube * (6.0 - u * (8.0 - 3.0 * u)))
}

/// Two vectors that decay from an initial value and velocity to zero at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fade {
    value: [Vec3; 2],
    velocity: [Vec3; 2],
    elapsed_s: f32,
    /// Duration, seconds; 0 if nothing decays.
    length_s: f32,
}

impl Fade {
    pub(crate) const NONE: Self =
        Self { value: [Vec3::ZERO; 2], velocity: [Vec3::ZERO; 2], elapsed_s: 0.0, length_s: 0.0 };

    /// Starts a decay from `value` and `velocity` to zero within `length_s` seconds.
    ///
    /// A length that is not positive and finite ends it at once. Vectors that are not finite are treated as zero.
    pub(crate) fn new(value: [Vec3; 2], velocity: [Vec3; 2], length_s: f32) -> Self {
        let finite = |vector: Vec3| if vector.is_finite() { vector } else { Vec3::ZERO };
        let length_s = if length_s.is_finite() { length_s.max(0.0) } else { 0.0 };
        Self { value: value.map(finite), velocity: velocity.map(finite), elapsed_s: 0.0, length_s }
    }

    /// Advances by `dt_s` seconds; a negative or non-finite step is treated as 0.
    pub(crate) fn advance(&mut self, dt_s: f32) {
        if dt_s.is_finite() {
            self.elapsed_s = (self.elapsed_s + dt_s.max(0.0)).min(self.length_s);
        }
    }

    pub(crate) fn is_done(&self) -> bool {
        !(self.elapsed_s < self.length_s)
    }

    /// Returns the current velocity of both vectors, per second.
    pub(crate) fn rate(&self) -> [Vec3; 2] {
        if self.is_done() {
            return [Vec3::ZERO; 2];
        }
        let (of_value, of_velocity) = decay_derivatives(self.elapsed_s / self.length_s);
        [0, 1].map(|part: usize| self.value[part] * (of_value / self.length_s) + self.velocity[part] * of_velocity)
    }

    /// Returns the current value of both vectors.
    pub(crate) fn offset(&self) -> [Vec3; 2] {
        if self.is_done() {
            return [Vec3::ZERO; 2];
        }
        let (of_value, of_velocity) = decay_polynomials(self.elapsed_s / self.length_s);
        [0, 1].map(|part: usize| self.value[part] * of_value + self.velocity[part] * (of_velocity * self.length_s))
    }
}

/// A number in 0…1 that moves to 0 or 1 in a given time, continuous in value and speed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Ramp {
    goal: f32,
    value: f32,
    velocity: f32,
    elapsed_s: f32,
    length_s: f32,
    /// Value minus goal, and speed, when the current movement began.
    from: [f32; 2],
    /// Time within which the initial speed decays, seconds; at most `length_s`.
    slowing_s: f32,
}

impl Ramp {
    /// Starts a movement to `goal` within `length_s` seconds. Does nothing if `goal` is already the goal.
    pub(crate) fn set_goal(&mut self, goal: f32, length_s: f32) {
        if goal != self.goal {
            let (from, velocity) = (self.value - goal, self.velocity);
            (self.from, self.goal) = ([from, velocity], goal);
            (self.elapsed_s, self.length_s) = (0.0, if length_s.is_finite() { length_s.max(0.0) } else { 0.0 });
            // Shortens the decay of the speed so that the value stays in 0…1. Away from the goal, the speed adds at
            // most 16/81 · speed · time, the maximum of the second polynomial of `decay_polynomials`; it must not pass
            // the other end, 1 − |from| away. Towards the goal, the ratio of the second polynomial to the first is at
            // most 2/5, so the value does not pass the goal if speed · time ≤ 5/2 · |from|.
            let room = if from * velocity > 0.0 { (1.0 - from.abs()) * 81.0 / 16.0 } else { from.abs() * 2.5 };
            self.slowing_s = (room.max(0.0) / velocity.abs()).min(self.length_s);
        }
    }

    pub(crate) fn advance(&mut self, dt_s: f32) {
        let dt = if dt_s.is_finite() { dt_s.max(0.0) } else { 0.0 };
        self.elapsed_s = (self.elapsed_s + dt).min(self.length_s);
        let (value, velocity) = if self.elapsed_s < self.length_s {
            let (u, length, slowing) = (self.elapsed_s / self.length_s, self.length_s, self.slowing_s);
            // If `slowing` is 0, the quotient is infinite or NaN, and `min` makes it 1: the decay is over.
            let slowed = (self.elapsed_s / slowing).min(1.0);
            let [value, velocity] = self.from;
            let rate = value * decay_derivatives(u).0 / length + velocity * decay_derivatives(slowed).1;
            (value * decay_polynomials(u).0 + velocity * decay_polynomials(slowed).1 * slowing, rate)
        } else {
            (0.0, 0.0)
        };
        (self.value, self.velocity) = (self.goal + value, velocity);
    }

    pub(crate) fn value(&self) -> f32 {
        self.value
    }
}

/// Derivatives of the two polynomials of [`decay_polynomials`] with respect to `u`.
fn decay_derivatives(u: f32) -> (f32, f32) {
    let square = u * u;
    let rest = 1.0 - u;
    (-30.0 * square * rest * rest, 1.0 - square * (18.0 - u * (32.0 - 15.0 * u)))
}
