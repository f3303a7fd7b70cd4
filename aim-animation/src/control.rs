//! [`Control`]: the playback state of a clip on one character.

use crate::float::{floor, narrow};
use crate::step::{Looping, Step, count};

/// Playback state of a clip on one character: local time, speed and looping. Use one for each clip of each character.
///
/// The local time lies in 0…length and is kept in double precision. The speed is the ratio of local to global time. It
/// may be changed at any time, also to 0 or a negative value, without a jump in local time.
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
    /// Playback speed, local seconds per global second: 1 as authored, negative backwards. NaN and infinity are treated
    /// as 0.
    pub speed: f32,
    /// Behaviour at the clip's ends.
    pub looping: Looping,
    #[cfg_attr(feature = "serde", serde(deserialize_with = "stored_time"))]
    time_s: f64,
    /// `true` while a [`PingPong`](Looping::PingPong) clip is on its way back.
    is_back: bool,
    /// `true` if the events at the current time have not been reported yet: initially and after a seek.
    is_fresh: bool,
}

/// Deserialises the local time. Negative times become 0, as in [`Control::seek`], and so do times that are not finite.
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
    /// Creates a control at local time 0 and speed 1 that repeats.
    #[must_use]
    pub const fn new() -> Self {
        Self { speed: 1.0, looping: Looping::Repeat, time_s: 0.0, is_back: false, is_fresh: true }
    }

    /// Sets the playback [`speed`](Self::speed).
    #[must_use]
    pub const fn with_speed(mut self, speed: f32) -> Self {
        self.speed = speed;
        self
    }

    /// Sets the behaviour at the clip's ends.
    #[must_use]
    pub const fn with_looping(mut self, looping: Looping) -> Self {
        self.looping = looping;
        self
    }

    /// Moves the control to a local time, seconds, as [`seek`](Self::seek) does.
    #[must_use]
    pub fn at(mut self, time_s: f32) -> Self {
        self.seek(time_s);
        self
    }

    /// Returns the local time, seconds.
    #[must_use]
    pub fn time_s(&self) -> f32 {
        narrow(self.time_s)
    }

    /// Jumps to a local time, seconds, without passing the events in between.
    ///
    /// Negative times become 0; times that are not finite are ignored. A time past the clip's end is clamped to it by
    /// the next [`advance`](Self::advance).
    pub fn seek(&mut self, time_s: f32) {
        if time_s.is_finite() {
            (self.time_s, self.is_fresh, self.is_back) = (f64::from(time_s.max(0.0)), true, false);
        }
    }

    /// Returns `true` if a clip played [once](Looping::Once) has reached its end, or its beginning at a negative speed.
    #[must_use]
    pub fn is_done(&self, length_s: f32) -> bool {
        let end = if self.speed < 0.0 { self.time_s <= 0.0 } else { self.time_s >= f64::from(length_s) };
        self.looping == Looping::Once && end
    }

    /// Advances by `dt_s` seconds of global time in a clip of `length_s` seconds, and returns the step taken.
    ///
    /// Consecutive steps cover each local time exactly once. If `dt_s` is not finite, the time does not move. If the
    /// length is not positive and finite, the time becomes 0. A step reports at most 65 536 passes of an end of the
    /// clip.
    pub fn advance(&mut self, dt_s: f32, length_s: f32) -> Step {
        let length = if length_s > 0.0 && length_s.is_finite() { f64::from(length_s) } else { 0.0 };
        // The clip may be shorter than in the last step.
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
            // No movement, or less than the precision of the time. The time stays where it is, even exactly on an end.
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

/// Returns the number of ends passed on the way to an unwrapped time `goal`, and the wrapped time reached: at least 0
/// and less than `length`.
fn wrapped(goal: f64, length: f64) -> (u32, f64) {
    let cycles = floor(goal / length);
    let place = goal - cycles * length;
    // Rounding may put the time on or outside either end.
    let (cycles, place) = if place >= length { (cycles + 1.0, 0.0) } else { (cycles, place.max(0.0)) };
    (count(cycles), place)
}

/// Returns the number of ends passed on the way to an unwrapped time `goal`, and the reflected time reached: 0 to
/// `length`, both included.
fn bounced(goal: f64, length: f64) -> (u32, f64) {
    let cycles = floor(goal / length);
    let place = (goal - cycles * length).max(0.0).min(length);
    let is_mirrored = floor(cycles / 2.0) * 2.0 != cycles;
    // Stopping exactly on an end does not pass it.
    if place == 0.0 && cycles > 0.0 {
        return (count(cycles - 1.0), if is_mirrored { length } else { 0.0 });
    }
    (count(cycles), if is_mirrored { length - place } else { place })
}
