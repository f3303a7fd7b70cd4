//! Keys for the weights of a mesh's morph targets. A glTF file has one sampler for all of them, so there are keys at
//! the times of all of their tracks.
//!
//! The curves do not change: a line or a cubic is split exactly at additional keys, a line among cubics is a cubic with
//! constant velocity, and a jump is two keys at adjacent times.

use aim_animation::{Curve, Track};
use serde_json::Value;

use super::{Keys, keys};

/// A weight on one side of a time, and its velocity there, per second.
#[derive(Clone, Copy)]
struct OneSidedWeight {
    value: f32,
    velocity: f32,
}

/// Returns the keys of all weights of a mesh; a weight without a track stays at rest.
pub(super) fn keys_of_weights(tracks: &[Option<&Track<f32>>], at_rest: &[f32]) -> Keys {
    let known: Vec<&Track<f32>> = tracks.iter().copied().flatten().collect();
    if known.len() == tracks.len()
        && known.iter().all(|track| track.curve() == known[0].curve() && track.times() == known[0].times())
    {
        return keys(&known, |weight| [weight]);
    }
    let mut times: Vec<f32> = known.iter().flat_map(|track| track.times().iter().copied()).collect();
    times.sort_by(f32::total_cmp);
    times.dedup();
    let rest =
        |target: usize| OneSidedWeight { value: at_rest.get(target).copied().unwrap_or_default(), velocity: 0.0 };
    let sides_of_all = |time: f32| -> Vec<[OneSidedWeight; 2]> {
        let of_track = |(target, track): (usize, &Option<&Track<f32>>)| {
            track.map_or_else(|| [rest(target); 2], |track| both_sides(track, time))
        };
        tracks.iter().enumerate().map(of_track).collect()
    };
    let has_jump = |sides: &[[OneSidedWeight; 2]]| sides.iter().any(|[before, after]| before.value != after.value);
    let mut keys = Keys { curve: common_curve(&known), times: Vec::new(), values: Vec::new(), width: tracks.len() };
    let starts_with_jump = times.first().is_some_and(|first| *first > 0.0 && has_jump(&sides_of_all(*first)));
    if keys.curve == Curve::Step && starts_with_jump {
        // glTF clamps before the first key: add a key at 0 to hold the value from before the jump.
        times.insert(0, 0.0);
    }
    for time in times {
        let sides = sides_of_all(time);
        // Times are not negative, and a step needs no key just before it.
        let before = time.next_down();
        if keys.curve != Curve::Step
            && time > 0.0
            && has_jump(&sides)
            && keys.times.last().is_none_or(|last| *last < before)
        {
            let arriving = sides.iter().map(|[side, _]| [*side, OneSidedWeight { velocity: 0.0, ..*side }]);
            keys.push(before, &arriving.collect::<Vec<_>>());
            let leaving = sides.iter().map(|[_, side]| [OneSidedWeight { velocity: 0.0, ..*side }, *side]);
            keys.push(time, &leaving.collect::<Vec<_>>());
        } else {
            keys.push(time, &sides);
        }
    }
    keys
}

/// Returns the weights at rest of a node's mesh: the node's own, or else the mesh's. Invalid ones are 0; the list may
/// be short.
pub(super) fn weights_at_rest(json: &Value, node: usize) -> Vec<f32> {
    let node = &json["nodes"][node];
    let mesh = node["mesh"].as_u64().and_then(|mesh| usize::try_from(mesh).ok()).map(|mesh| &json["meshes"][mesh]);
    let stated = [Some(node), mesh].into_iter().flatten().find_map(|owner| owner["weights"].as_array());
    let weight = |value: &Value| narrow(value.as_f64().unwrap_or_default());
    stated.into_iter().flatten().map(weight).map(|weight| if weight.is_finite() { weight } else { 0.0 }).collect()
}

impl Keys {
    /// Adds a key of all weights: in-tangents from the first side, values and out-tangents from the second.
    fn push(&mut self, time: f32, sides: &[[OneSidedWeight; 2]]) {
        self.times.push(time);
        let is_cubic = self.curve == Curve::Cubic;
        let into = sides.iter().filter(|_| is_cubic).map(|[before, _]| before.velocity);
        let out = sides.iter().filter(|_| is_cubic).map(|[_, after]| after.velocity);
        let values = sides.iter().map(|[_, after]| after.value);
        self.values.extend(into.chain(values).chain(out));
    }
}

/// Returns the curve that can represent all tracks that change: cubic if any is cubic, else linear if any is linear
/// (steps then become jumps), else step.
fn common_curve(tracks: &[&Track<f32>]) -> Curve {
    let is_still = |track: &Track<f32>| {
        let first = track.values()[0];
        track.values().iter().all(|value| *value == first) && track.tangents().iter().flatten().all(|v| *v == 0.0)
    };
    let mut curve = Curve::Step;
    for track in tracks.iter().filter(|track| !is_still(track)) {
        match track.curve() {
            Curve::Cubic => return Curve::Cubic,
            Curve::Step => {}
            _ => curve = Curve::Linear,
        }
    }
    curve
}

/// Returns the value and velocity of a track just before a time, and from that time on.
fn both_sides(track: &Track<f32>, time: f32) -> [OneSidedWeight; 2] {
    let (times, values) = (track.times(), track.values());
    let (reached, passed) = (times.partition_point(|key| *key < time), times.partition_point(|key| *key <= time));
    // A track is constant before its first key and after its last.
    let side = |next: usize| match (next.checked_sub(1), times.get(next)) {
        (Some(key), Some(_)) => in_segment(track, key, time),
        (None, _) => OneSidedWeight { value: values[0], velocity: 0.0 },
        (Some(last), None) => OneSidedWeight { value: values[last], velocity: 0.0 },
    };
    [side(reached), side(passed)]
}

/// Returns the value and velocity of a track at a time in the segment from `key` to the next key, both ends included.
fn in_segment(track: &Track<f32>, key: usize, time: f32) -> OneSidedWeight {
    let ends = [track.times()[key], track.times()[key + 1]];
    let [a, b] = [track.values()[key], track.values()[key + 1]].map(f64::from);
    let interval = f64::from(ends[1]) - f64::from(ends[0]);
    let u = (f64::from(time) - f64::from(ends[0])) / interval;
    let v = 1.0 - u;
    let (value, slope) = match track.curve() {
        Curve::Step => (a, 0.0),
        Curve::Cubic => {
            let [out, into] = [track.tangents()[key][1], track.tangents()[key + 1][0]].map(|v| f64::from(v) * interval);
            // H₀ = v²(1 + 2u), H₁ = u·v², H₂ = u²(1 + 2v), H₃ = −u²·v, and their derivatives.
            let value = a * v * v * (1.0 + 2.0 * u) + b * u * u * (1.0 + 2.0 * v) + out * u * v * v - into * u * u * v;
            let slope = (b - a) * 6.0 * u * v + out * (1.0 - u * (4.0 - 3.0 * u)) + into * u * (3.0 * u - 2.0);
            (value, slope)
        }
        _ => (a * v + b * u, b - a),
    };
    let velocity = narrow(slope / interval);
    // The slope of a jump between adjacent times can exceed single precision.
    OneSidedWeight { value: narrow(value), velocity: if velocity.is_finite() { velocity } else { 0.0 } }
}

#[expect(clippy::cast_possible_truncation, reason = "files have single precision")]
fn narrow(value: f64) -> f32 {
    value as f32
}
