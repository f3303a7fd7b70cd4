//! [`Marks`] and [`Phase`]: synchronised playback of looped clips, such as a walk and a run.

use alloc::vec::Vec;
use core::fmt;

use crate::float::{floor, narrow};
use crate::step::Step;

/// Times in a looped clip that correspond to times in other clips, such as left foot down, right foot down.
///
/// A cycle with n marks has a *phase* in 0…1; mark k is at phase k/n. Between two marks, and from the last mark across
/// the loop to the first, the phase is linear in time.
///
/// ```
/// use aim_animation::Marks;
///
/// let walk = Marks::new(1.0, [0.1, 0.6])?;
/// let run = Marks::new(0.6, [0.3, 0.5])?;
/// // A run that begins in step with a walk: halfway between its marks.
/// let phase = walk.phase_at(0.35);
/// assert!((phase - 0.25).abs() < 1e-6 && (run.time_at(phase) - 0.4).abs() < 1e-6);
/// # Ok::<(), aim_animation::MarksError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Marks {
    length_s: f64,
    /// At least one, increasing.
    times: Vec<f64>,
}

/// Reason why times cannot be used as marks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MarksError {
    /// The length of the clip is not positive and finite.
    Length,
    /// No mark is given.
    Empty,
    /// This mark is not in 0 ≤ time < length, or is not after the mark before it.
    Mark(usize),
}

impl fmt::Display for MarksError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length => f.write_str("the length of a clip with marks has to be positive and finite"),
            Self::Empty => f.write_str("there is no mark"),
            Self::Mark(mark) => write!(f, "mark {mark} is not within the clip or not after the mark before it"),
        }
    }
}

impl core::error::Error for MarksError {}

impl Marks {
    /// Marks of a clip of length `length_s`, at `times`; both in seconds.
    ///
    /// # Errors
    /// See [`MarksError`].
    pub fn new(length_s: f32, times: impl AsRef<[f32]>) -> Result<Self, MarksError> {
        let times = times.as_ref();
        if !(length_s > 0.0 && length_s.is_finite()) {
            return Err(MarksError::Length);
        }
        if times.is_empty() {
            return Err(MarksError::Empty);
        }
        for (mark, time) in times.iter().enumerate() {
            let is_after = mark.checked_sub(1).is_none_or(|before| times[before] < *time);
            if !((0.0..length_s).contains(time) && is_after) {
                return Err(MarksError::Mark(mark));
            }
        }
        Ok(Self { length_s: f64::from(length_s), times: times.iter().map(|time| f64::from(*time)).collect() })
    }

    /// The length of the clip, seconds.
    #[must_use]
    pub fn length_s(&self) -> f32 {
        narrow(self.length_s)
    }

    /// Returns the phase at a time, in 0 ≤ phase < 1. Times outside the clip wrap around the loop; a time that is not
    /// finite is treated as 0.
    #[must_use]
    pub fn phase_at(&self, time_s: f32) -> f32 {
        let time = if time_s.is_finite() { f64::from(time_s) } else { 0.0 };
        // For times many cycles away, rounding may leave a value slightly outside the clip.
        let time = (time - floor(time / self.length_s) * self.length_s).max(0.0).min(self.length_s);
        let count = self.times.len();
        // Before the first mark, the interval starts at the last mark of the previous cycle.
        let before = self.times.partition_point(|mark| *mark <= time);
        let (mark, from) = match before.checked_sub(1) {
            Some(mark) => (mark, self.times[mark]),
            None => (count - 1, self.times[count - 1] - self.length_s),
        };
        let to = from + self.interval(mark);
        let phase = narrow((index(mark) + ((time - from) / (to - from)).min(1.0)) / index(count));
        if phase < 1.0 { phase } else { 0.0 }
    }

    /// Returns the time at a phase, seconds, in 0 ≤ time < length. Phases outside 0…1 wrap around; a phase that is not
    /// finite is treated as 0.
    #[must_use]
    pub fn time_at(&self, phase: f32) -> f32 {
        let phase = if phase.is_finite() { f64::from(phase) } else { 0.0 };
        let time = self.unwrapped(phase - floor(phase));
        let time = narrow(if time < self.length_s { time } else { time - self.length_s }).max(0.0);
        if time < narrow(self.length_s) { time } else { 0.0 }
    }

    /// Time at a phase without wrapping, one length later for each cycle: continuous and increasing.
    fn unwrapped(&self, phase: f64) -> f64 {
        let (count, cycle) = (self.times.len(), floor(phase));
        let place = (phase - cycle) * index(count);
        let mark = (0..count).rfind(|&mark| index(mark) <= place).unwrap_or(0);
        self.times[mark] + (place - index(mark)) * self.interval(mark) + cycle * self.length_s
    }

    /// Time from a mark to the next one; for the last mark, across the loop to the first.
    fn interval(&self, mark: usize) -> f64 {
        let next = self.times.get(mark + 1).copied().unwrap_or(self.times[0] + self.length_s);
        next - self.times[mark]
    }
}

/// Converts a small number of marks to floating point.
#[expect(clippy::cast_precision_loss, reason = "as many marks as memory holds are counted exactly")]
fn index(number: usize) -> f64 {
    number as f64
}

/// Common phase of clips that are played in step. Keep one for each character and group of clips.
///
/// The local time of each clip follows from the phase by its [`Marks`]; the rate of the phase follows from the weights
/// with which the clips are blended. So the marks of all clips coincide at any weights, and changing a weight never
/// makes a time jump.
///
/// ```
/// use aim_animation::{Clip, Marks, Phase};
///
/// let (walk, run) = (Marks::new(1.0, [0.0, 0.5])?, Marks::new(0.6, [0.1, 0.4])?);
/// let mut phase = Phase::new();
/// phase.advance(0.2, &[(&walk, 0.5), (&run, 0.5)]);
/// // A cycle now takes 0.8 s.
/// assert!((phase.step(&walk).to_s() - 0.25).abs() < 1e-6);
/// assert!((phase.step(&run).to_s() - 0.25).abs() < 1e-6);
/// # Ok::<(), aim_animation::MarksError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phase {
    /// Factor on the rate of the phase: 1 as authored, negative backwards. NaN and infinity are treated as 0.
    pub speed: f32,
    /// Phase, in 0…1.
    phase: f64,
    /// Phase before the last call of `advance`, relative to the cycle of `phase`: outside 0…1 if that call crossed a
    /// cycle's end.
    before: f64,
    /// `true` if events exactly at `before` belong to the last step.
    includes_before: bool,
    /// `true` until the first `advance` from this phase.
    is_fresh: bool,
}

impl Default for Phase {
    fn default() -> Self {
        Self::new()
    }
}

impl Phase {
    /// A phase of 0, running at speed 1.
    #[must_use]
    pub const fn new() -> Self {
        Self { speed: 1.0, phase: 0.0, before: 0.0, includes_before: false, is_fresh: true }
    }

    /// Sets the phase, wrapped to 0…1; a value that is not finite is ignored.
    #[must_use]
    pub fn at(mut self, phase: f32) -> Self {
        if phase.is_finite() {
            self.phase = f64::from(phase) - floor(f64::from(phase));
            (self.before, self.includes_before, self.is_fresh) = (self.phase, false, true);
        }
        self
    }

    /// Current phase, in 0…1.
    #[must_use]
    pub fn phase(&self) -> f32 {
        narrow(self.phase)
    }

    /// Advances the phase by `dt_s` seconds. The duration of a cycle is the weighted mean of the clips' lengths.
    /// Without any positive weight, the phase does not move. At most 32 768 cycles are passed in one call.
    pub fn advance(&mut self, dt_s: f32, clips: &[(&Marks, f32)]) {
        let weights = clips.iter().map(|(marks, weight)| (marks, f64::from(crate::mask::clamped(*weight))));
        let (time, total) =
            weights.fold((0.0, 0.0), |(time, total), (marks, w)| (time + w * marks.length_s, total + w));
        let travel = f64::from(dt_s) * f64::from(self.speed) * total / time;
        let travel = if travel.is_finite() { travel.max(-32_768.0).min(32_768.0) } else { 0.0 };
        let goal = self.phase + travel;
        let cycles = floor(goal);
        (self.includes_before, self.is_fresh) = (self.is_fresh, false);
        (self.before, self.phase) = (self.phase - cycles, goal - cycles);
    }

    /// Returns the step that the last [`advance`](Self::advance) makes through one of the clips.
    #[must_use]
    pub fn step(&self, marks: &Marks) -> Step {
        let [from, to] = [self.before, self.phase].map(|phase| marks.unwrapped(phase));
        let [round, last] = [from, to].map(|time| floor(time / marks.length_s));
        let within = |time: f64, round: f64| (time - round * marks.length_s).max(0.0).min(marks.length_s);
        Step {
            from_s: within(from, round),
            to_s: within(to, last),
            length_s: marks.length_s,
            ends: crate::step::count(last - round),
            is_forward: to >= from,
            bounces: false,
            includes_from: self.includes_before,
        }
    }
}
