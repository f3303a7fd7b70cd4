//! [`Control`]: where a character is in a clip.

use crate::float::{floor, narrow};
use crate::step::{Looping, Step, count};

/// A clip played by one character: local time, speed, looping. One for each clip of each character.
///
/// Local time is in 0…length and is kept in double precision. Speed is the ratio of local to global time; it may change at any
/// time, through 0 and below it, and the local time never jumps.
///
/// ```
/// use aim_animation::{Clip, Control};
///
/// let steps = Clip::new("walk").with_length(1.0).with_event(0.4, "left")?.with_event(0.9, "right")?;
/// let mut control = Control::new();
/// control.speed = 2.0;
/// let step = control.advance(0.75, steps.length_s());
/// let told: Vec<&str> = steps.events_passed(&step).map(|event| event.name.as_str()).collect();
/// assert_eq!((told, control.time_s()), (vec!["left", "right", "left"], 0.5));
/// # Ok::<(), aim_animation::EventError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct Control {
    /// Local seconds a global second: 1 as authored, negative backwards. NaN and infinity count as 0.
    pub speed: f32,
    /// What becomes of the clip at its ends.
    pub looping: Looping,
    #[cfg_attr(feature = "serde", serde(deserialize_with = "stored_time"))]
    time_s: f64,
    /// On the way back of a clip that bounces.
    is_back: bool,
    /// Nothing has been told at this time yet.
    is_fresh: bool,
}

/// A time as [`Control::seek`] takes it, from what was stored.
#[cfg(feature = "serde")]
fn stored_time<'de, D: serde::Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let time_s: f64 = serde::Deserialize::deserialize(deserializer)?;
    Ok(if time_s.is_finite() { time_s.max(0.0) } else { 0.0 })
}

impl Default for Control {
    fn default() -> Self {
        Self::new()
    }
}

impl Control {
    /// At the beginning, at speed 1, repeating.
    #[must_use]
    pub const fn new() -> Self {
        Self { speed: 1.0, looping: Looping::Repeat, time_s: 0.0, is_back: false, is_fresh: true }
    }

    /// With a speed.
    #[must_use]
    pub const fn with_speed(mut self, speed: f32) -> Self {
        self.speed = speed;
        self
    }

    /// With what becomes of the clip at its ends.
    #[must_use]
    pub const fn with_looping(mut self, looping: Looping) -> Self {
        self.looping = looping;
        self
    }

    /// The same control at another local time.
    #[must_use]
    pub fn at(mut self, time_s: f32) -> Self {
        self.seek(time_s);
        self
    }

    /// The local time, seconds.
    #[must_use]
    pub fn time_s(&self) -> f32 {
        narrow(self.time_s)
    }

    /// Jumps to a local time without passing what lies between; negative counts as 0, what is not finite is ignored. Times past the
    /// clip's end are brought into it by the next [`advance`](Self::advance).
    pub fn seek(&mut self, time_s: f32) {
        if time_s.is_finite() {
            (self.time_s, self.is_fresh, self.is_back) = (f64::from(time_s.max(0.0)), true, false);
        }
    }

    /// True if a clip that is played once has come to its end, or played backwards to its beginning.
    #[must_use]
    pub fn is_done(&self, length_s: f32) -> bool {
        let end = if self.speed < 0.0 { self.time_s <= 0.0 } else { self.time_s >= f64::from(length_s) };
        self.looping == Looping::Once && end
    }

    /// Moves on by `dt_s` seconds of global time in a clip of this length, and tells the way.
    ///
    /// The way of consecutive steps covers each time once. A time step that is not finite, and a length that is not positive,
    /// move nothing; of a huge step no more than 65 536 ends are told.
    pub fn advance(&mut self, dt_s: f32, length_s: f32) -> Step {
        let length = if length_s > 0.0 && length_s.is_finite() { f64::from(length_s) } else { 0.0 };
        // A clip may have become shorter.
        self.time_s = self.time_s.min(length);
        let mut travel = f64::from(dt_s) * f64::from(self.speed);
        if !travel.is_finite() {
            travel = 0.0;
        }
        if self.looping == Looping::PingPong && self.is_back {
            travel = -travel;
        }
        let mut step = Step::none(self.time_s, length);
        (step.is_forward, step.includes_from) = (travel >= 0.0, core::mem::take(&mut self.is_fresh));
        step.bounces = self.looping == Looping::PingPong;
        let goal = self.time_s + travel;
        (step.ends, step.to_s) = if length == 0.0 {
            (0, 0.0)
        } else if goal == self.time_s {
            // No way, or less than has digits: it stays where it is, also on an end.
            (0, goal)
        } else {
            match self.looping {
                Looping::Once => (0, goal.max(0.0).min(length)),
                Looping::Repeat => wrapped(goal, length),
                Looping::PingPong => bounced(goal, length),
            }
        };
        self.is_back = step.bounces && self.is_back != (step.ends % 2 == 1);
        self.time_s = step.to_s;
        step
    }
}

/// The ends passed on the way to a goal, and the place reached, in 0…length without the end.
fn wrapped(goal: f64, length: f64) -> (u32, f64) {
    let rounds = floor(goal / length);
    let place = goal - rounds * length;
    // Rounding may leave the place on either end.
    let (rounds, place) = if place >= length { (rounds + 1.0, 0.0) } else { (rounds, place.max(0.0)) };
    (count(rounds), place)
}

/// The ends passed on the way to a goal, and the place reached, in 0…length.
fn bounced(goal: f64, length: f64) -> (u32, f64) {
    let rounds = floor(goal / length);
    let place = (goal - rounds * length).max(0.0).min(length);
    let is_mirrored = floor(rounds / 2.0) * 2.0 != rounds;
    // To stop on an end is not to pass it.
    if place == 0.0 && rounds > 0.0 {
        return (count(rounds - 1.0), if is_mirrored { length } else { 0.0 });
    }
    (count(rounds), if is_mirrored { length - place } else { place })
}
