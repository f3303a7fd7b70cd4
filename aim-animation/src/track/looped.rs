//! Ends of a looped track: measures their difference and removes it.

use alloc::vec::Vec;

use super::{Curve, Track, Value, intervals, is_bounded};

/// Degree to which the ends of a loop are made to match.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Continuity {
    /// The values match (C⁰): the loop does not jump.
    Place,
    /// The values and velocities match (C¹): the loop does not jerk either.
    Speed,
}

/// The keys of a cubic track.
struct Keys<T> {
    times: Vec<f32>,
    values: Vec<T>,
    /// Velocities on arriving and on leaving.
    tangents: Vec<[T; 2]>,
}

impl<T: Value> Keys<T> {
    fn push(&mut self, time: f32, value: T, tangents: [T; 2]) {
        self.times.push(time);
        self.values.push(value);
        self.tangents.push(tangents);
    }

    fn remove(&mut self, key: usize) {
        self.times.remove(key);
        self.values.remove(key);
        self.tangents.remove(key);
    }
}

impl<T: Value> Track<T> {
    /// Value and velocity at 0 and at the length of the clip. A rotation at the end has the sign nearer to that at the
    /// beginning. `None` for step tracks, which are meant to jump. Of two keys at one end, the later counts at 0, the
    /// earlier at the length.
    pub(crate) fn ends(&self, length_s: f32) -> Option<[[T; 2]; 2]> {
        let keys = self.cubic_keys(length_s)?;
        let last = keys.values.len() - 1;
        let (start, end) = (keys.values[0], keys.values[last]);
        let is_same = end.near(start) == end;
        let velocity = keys.tangents[last][0].times(if is_same { 1.0 } else { -1.0 });
        Some([[start, keys.tangents[0][1]], [end.near(start), velocity]])
    }

    /// Returns a cubic track whose end matches its beginning. Each is corrected by half of the difference; the
    /// correction fades out over `window_s`, at most half of the length. `None` for step tracks, and if numbers would
    /// become too large.
    pub(crate) fn mended(&self, length_s: f32, continuity: Continuity, window_s: f32) -> Option<Self> {
        let [[start, leaving], [end, arriving]] = self.ends(length_s)?;
        let mut keys = self.cubic_keys(length_s)?;
        let window = window_s.min(0.5 * length_s);
        // Test `window_s` too, because `min` has discarded a NaN.
        if !(window_s > 0.0 && window > 0.0) {
            return None;
        }
        let is_same = keys.values[keys.values.len() - 1] == end;
        let sign = if is_same { 1.0 } else { -1.0 };
        let place = end.plus(start.times(-1.0)).times(0.5);
        let speed = match continuity {
            Continuity::Place => place.times(0.0),
            Continuity::Speed => arriving.plus(leaving.times(-1.0)).times(0.5),
        };
        // Insert keys where the correction begins and ends, so that the result is one cubic between each two keys.
        let plain = keys.into_track();
        keys = Keys { times: Vec::new(), values: Vec::new(), tangents: Vec::new() };
        let mut knots = [window, length_s - window].into_iter().peekable();
        for (k, &time) in plain.times.iter().enumerate() {
            while let Some(knot) = knots.next_if(|knot| *knot <= time) {
                if knot < time && keys.times.last().is_some_and(|last| *last < knot) {
                    let (value, velocity) = plain.point_and_velocity(knot);
                    keys.push(knot, value, [velocity; 2]);
                }
            }
            keys.push(time, plain.values[k], plain.tangents[k]);
        }
        for (k, &time) in keys.times.iter().enumerate() {
            // Correction c with c(0) = place, c′(0) = speed, and c = c′ = 0 at the window. At the end it is mirrored in
            // time, with opposite sign.
            let mut correct = |u: f32, sign: f32, towards: f32| {
                let value = place.times(sign * (1.0 - u * u * (3.0 - 2.0 * u)));
                let value = value.plus(speed.times(sign * towards * window * u * (1.0 - u) * (1.0 - u)));
                let velocity = place.times(sign * towards * 6.0 * u * (u - 1.0) / window);
                let velocity = velocity.plus(speed.times(sign * (1.0 - u * (4.0 - 3.0 * u))));
                keys.values[k] = keys.values[k].plus(value);
                keys.tangents[k] = keys.tangents[k].map(|tangent| tangent.plus(velocity));
            };
            if time < window {
                correct(time / window, 1.0, 1.0);
            }
            if length_s - time < window {
                correct((length_s - time) / window, -sign, -1.0);
            }
        }
        let is_sound = (0..keys.times.len()).all(|k| {
            let mut tangents = keys.tangents[k].into_iter().zip(intervals(&keys.times, k));
            keys.values[k].bounded() && tangents.all(|(tangent, interval)| is_bounded(tangent, interval))
        });
        is_sound.then(|| keys.into_track())
    }

    /// Converts the track to cubic keys from 0 to the length; `None` for step tracks.
    fn cubic_keys(&self, length_s: f32) -> Option<Keys<T>> {
        let mut keys = Keys { times: Vec::new(), values: Vec::new(), tangents: Vec::new() };
        let none = self.values[0].times(0.0);
        if self.times[0] > 0.0 {
            keys.push(0.0, self.values[0], [none; 2]);
        }
        match self.curve {
            Curve::Step => return None,
            Curve::Linear => self.push_linear_as_cubic(&mut keys),
            Curve::Cubic => {
                for (k, &time) in self.times.iter().enumerate() {
                    keys.push(time, self.values[k], self.tangents[k]);
                }
            }
        }
        // If two keys share an end, keep the one that a loop shows: the later at 0, the earlier at the length.
        if keys.times.len() > 1 && keys.times[1] <= 0.0 {
            keys.remove(0);
        }
        let last = keys.times.len() - 1;
        if last > 0 && keys.times[last - 1] >= length_s {
            keys.remove(last);
        }
        // The track is constant before its first and after its last key: velocities there are zero.
        let last = keys.values.len() - 1;
        keys.tangents[last][1] = none;
        if self.times[0] > 0.0 {
            keys.tangents[1][0] = none;
        }
        if keys.times[last] < length_s {
            keys.push(length_s, keys.values[last], [none; 2]);
        }
        Some(keys)
    }

    /// Converts linear segments to cubics. This is exact except for rotations, which move along arcs and are subdivided
    /// so finely that the error is invisible.
    fn push_linear_as_cubic(&self, keys: &mut Keys<T>) {
        let none = self.values[0].times(0.0);
        let mut value = keys.values.last().map_or(self.values[0], |last| self.values[0].near(*last));
        let mut into = none;
        for (k, &time) in self.times.iter().enumerate() {
            let interval = self.times.get(k + 1).map_or(0.0, |next| next - time);
            if !(interval > 0.0) {
                keys.push(time, value, [into, none]);
                into = none;
                value = self.values.get(k + 1).map_or(value, |next| next.near(value));
                continue;
            }
            let next = self.values[k + 1].near(value);
            let pieces = value.cubic_pieces(next);
            for piece in 0..pieces {
                let part = f32::from(piece) / f32::from(pieces);
                let at = if piece == 0 { value } else { value.linear(next, part).near(value) };
                let (time_at, velocity) = (time + interval * part, at.linear_velocity([value, next], interval));
                let crowded = piece > 0 && keys.times.last().is_some_and(|last| *last >= time_at);
                if !crowded && time_at < self.times[k + 1] {
                    keys.push(time_at, at, [if piece == 0 { into } else { velocity }, velocity]);
                }
            }
            into = next.linear_velocity([value, next], interval);
            value = next;
        }
    }
}

impl<T: Value> Keys<T> {
    fn into_track(self) -> Track<T> {
        Track { times: self.times.into(), values: self.values, tangents: self.tangents, curve: Curve::Cubic }
    }
}
