//! Editing of tracks: resampling, cutting, reversing, repeating.

use alloc::vec::Vec;

use super::{Curve, Track, Value};
use crate::float::narrow;

/// Maximum number of keys that resampling makes, which bounds its memory.
const MOST_KEYS: f32 = 4_194_304.0;

impl<T: Value> Track<T> {
    /// Returns a linear track through samples of this one: at least `rate_hz` a second from 0 to `length_s`, evenly
    /// spaced, the last one exactly at the end. A jump becomes a steep line. Rotations are in one hemisphere from key
    /// to key.
    ///
    /// If the rate or the length is not positive and finite, the result has one key, at 0. It never has more than about
    /// 2²² keys.
    #[must_use]
    pub fn resampled(&self, rate_hz: f32, length_s: f32) -> Self {
        let steps = length_s * rate_hz;
        let steps = if steps > 0.0 && length_s.is_finite() { ceil(steps.min(MOST_KEYS)) } else { 0 };
        let mut times = Vec::with_capacity(steps + 1);
        let mut values: Vec<T> = Vec::with_capacity(steps + 1);
        let mut key = 0;
        for step in 0..=steps {
            #[expect(clippy::cast_precision_loss, reason = "at most 2²²")]
            let time = if step == 0 { 0.0 } else { length_s * (step as f32 / steps as f32) };
            if times.last().is_some_and(|last| *last >= time) {
                continue;
            }
            let value = self.sample_near(time, &mut key);
            values.push(values.last().map_or(value, |last| value.near(*last)));
            times.push(time);
        }
        Self { times: times.into(), values, tangents: Vec::new(), curve: Curve::Linear }
    }

    /// Returns the piece between two times, shifted to begin at 0. The curve is the same, with keys where it is cut.
    /// Times are clamped to the range from 0 to the last key. If `from_s` is not before `to_s`, the piece is constant,
    /// the value at `from_s`. A jump at `to_s` is not part of the piece, except one at the last key if `to_s` is later.
    #[must_use]
    pub fn cut(&self, from_s: f32, to_s: f32) -> Self {
        let inside = |time: f32| time.max(0.0).min(self.end_s());
        let (from, to) = (inside(from_s), inside(to_s));
        let mut piece = Self { times: [].into(), values: Vec::new(), tangents: Vec::new(), curve: self.curve };
        let mut times = Vec::new();
        let mut push = |time: f32, value: T, tangents: [T; 2]| {
            times.push(time - from);
            piece.values.push(value);
            if self.curve == Curve::Cubic {
                piece.tangents.push(tangents);
            }
        };
        let sampled = |time: f32| match self.curve {
            Curve::Cubic => {
                let (value, velocity) = self.point_and_velocity(time);
                // Between keys that are very close, the velocity can overflow.
                let is_bounded = velocity.times(1e-12).bounded();
                (value, if is_bounded { velocity } else { value.times(0.0) })
            }
            _ => (self.sample(time), self.values[0].times(0.0)),
        };
        let (value, velocity) = sampled(from);
        push(from, value, [velocity; 2]);
        for (k, time) in self.times.iter().enumerate().filter(|(_, time)| from < **time && **time < to) {
            push(*time, self.values[k], self.tangents.get(k).copied().unwrap_or([self.values[k]; 2]));
        }
        if from < to {
            // A jump at the very end belongs to what follows, so the piece ends with the value before the jump.
            let at_end = self.times.partition_point(|time| *time < to);
            match self.times.get(at_end).filter(|time| **time == to) {
                Some(_) => {
                    let into = self.tangents.get(at_end).map_or(self.values[at_end], |tangents| tangents[0]);
                    push(to, self.values[at_end], [into; 2]);
                    let last = self.values.len() - 1;
                    if to_s > to && at_end < last {
                        push(to, self.values[last], [self.values[last].times(0.0); 2]);
                    }
                }
                None => {
                    let (value, velocity) = sampled(to);
                    push(to, value, [velocity; 2]);
                }
            }
        }
        // Rounding must not put the times out of order.
        let mut last = 0.0;
        for time in &mut times {
            *time = f32::max(*time, last);
            last = *time;
        }
        piece.times = times.into();
        piece.without_crowded_keys()
    }

    /// Returns the track played backwards from `length_s`, or from the last key if that is later.
    #[must_use]
    pub fn reversed(&self, length_s: f32) -> Self {
        let length = length_s.max(self.end_s()).min(f32::MAX);
        let mut times: Vec<f32> = self.times.iter().rev().map(|time| length - time).collect();
        let mut values: Vec<T> = self.values.iter().rev().copied().collect();
        if self.curve == Curve::Step {
            // Backwards, a value is held from the time of the next key until its own time.
            times.insert(0, 0.0);
            times.pop();
            if times.get(1) == Some(&0.0) {
                times.remove(0);
                values.remove(0);
            }
        }
        let tangents = self.tangents.iter().rev().map(|[into, out]| [out.times(-1.0), into.times(-1.0)]).collect();
        Self { times: times.into(), values, tangents, curve: self.curve }.without_crowded_keys()
    }

    /// Returns the track repeated until `end_s`: at every time it has the value of this one at that time modulo
    /// `period_s`, which must not be shorter than the track. At a seam it has the value of the round that ends; if the
    /// ends differ, the next round begins at the following float.
    pub(crate) fn repeated(&self, period_s: f32, end_s: f32) -> Self {
        let mut round = self.cut(0.0, period_s);
        if let Some(&value) = round.values.last().filter(|_| round.end_s() < period_s) {
            // Hold the last value until the round ends.
            round.times = round.times.iter().copied().chain([period_s]).collect();
            round.values.push(value);
            if let Some(last) = round.tangents.last_mut() {
                last[1] = value.times(0.0);
                round.tangents.push([value.times(0.0); 2]);
            }
        }
        let (mut times, mut values, mut tangents) = (Vec::new(), Vec::new(), Vec::<[T; 2]>::new());
        // Multiply instead of accumulating, so that late rounds are exact.
        let starts = (0_u32..).map(|number| narrow(f64::from(number) * f64::from(period_s)));
        for start in starts.take_while(|start| *start < end_s) {
            for (k, time) in round.times.iter().enumerate() {
                let (mut time, value) = (start + time, round.values[k]);
                if let Some(last) = times.last().copied().filter(|last| time <= *last) {
                    if k == 0 && values.last() == Some(&value) {
                        // The merged key arrives as the old round did and leaves as the new one does.
                        if let (Some(before), Some(after)) = (tangents.last_mut(), round.tangents.first()) {
                            before[1] = after[1];
                        }
                        continue;
                    }
                    // Two keys at one time are a jump. Move the first key of a round, or a third key, to the following
                    // float.
                    let is_crowded = k == 0 || times.len() > 1 && times[times.len() - 2] >= last;
                    time = if is_crowded { f32::next_up(last) } else { last };
                }
                times.push(time);
                values.push(value);
                tangents.extend(round.tangents.get(k));
            }
        }
        Self { times: times.into(), values, tangents, curve: self.curve }.cut(0.0, end_s)
    }

    /// Removes all but the first and last of more than two keys that rounding has moved to the same time.
    fn without_crowded_keys(self) -> Self {
        let times = &self.times;
        let is_kept = |k: usize| {
            let alike = |other: Option<usize>| other.and_then(|k| times.get(k)).is_some_and(|time| *time == times[k]);
            !(alike(k.checked_sub(1)) && alike(Some(k + 1)))
        };
        let kept: Vec<usize> = (0..times.len()).filter(|&k| is_kept(k)).collect();
        if kept.len() == times.len() {
            return self;
        }
        Self {
            times: kept.iter().map(|&k| times[k]).collect(),
            values: kept.iter().map(|&k| self.values[k]).collect(),
            tangents: kept.iter().filter_map(|&k| self.tangents.get(k).copied()).collect(),
            curve: self.curve,
        }
    }
}

/// Rounds up a number from 0 to 2²².
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "2²² at most")]
fn ceil(number: f32) -> usize {
    let whole = number as usize;
    if (whole as f32) < number { whole + 1 } else { whole }
}
