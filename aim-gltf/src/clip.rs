//! Animation clips: keys read exactly as stored, sampled as glTF 2.0 defines, repeated without changing a key.

use std::collections::HashSet;
use std::sync::Arc;

use aim_animation::Transform;
use glam::{Quat, Vec3, Vec4};

use crate::accessor::Data;
use crate::error::Error;
use crate::num;
use crate::raw;

/// The animated property of a channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Property {
    /// Three numbers a key, in the parent's units.
    Translation,
    /// Four numbers a key: a quaternion x, y, z, w.
    Rotation,
    /// Three numbers a key.
    Scale,
    /// The mesh's morph weights; carried along, not sampled into poses.
    Weights,
}

/// Interpolation between two keys of a channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Interpolation {
    /// The value stays until the next key.
    Step,
    /// Straight, rotations along the shorter great arc.
    Linear,
    /// Hermite splines; each key holds in-tangent, value and out-tangent (per second).
    CubicSpline,
}

/// The keys of one property of one node.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    pub(crate) node: usize,
    pub(crate) property: Property,
    pub(crate) interpolation: Interpolation,
    pub(crate) times: Arc<[f32]>,
    /// Flat; per key `width` numbers, or three times as many for cubic splines.
    pub(crate) values: Vec<f32>,
    /// Numbers of one value.
    pub(crate) width: usize,
}

/// A named animation.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Clip {
    /// Its name, or `clip0` where the file gives none.
    pub name: String,
    /// Its channels, at most one for each property of each node in a clip that was read.
    pub channels: Vec<Channel>,
}

/// Each property with its path and accessor type in a file, and the numbers of one value; weights have one for each
/// morph target.
pub(crate) const PROPERTIES: [(Property, &str, &str, usize); 4] = [
    (Property::Translation, "translation", "VEC3", 3),
    (Property::Rotation, "rotation", "VEC4", 4),
    (Property::Scale, "scale", "VEC3", 3),
    (Property::Weights, "weights", "SCALAR", 1),
];

/// Each interpolation with its word in a file.
pub(crate) const INTERPOLATIONS: [(Interpolation, &str); 3] =
    [(Interpolation::Step, "STEP"), (Interpolation::Linear, "LINEAR"), (Interpolation::CubicSpline, "CUBICSPLINE")];

impl Channel {
    fn linear<const N: usize>(node: usize, property: Property, times: Arc<[f32]>, values: Vec<[f32; N]>) -> Self {
        Self { node, property, interpolation: Interpolation::Linear, times, values: values.concat(), width: N }
    }

    /// A linear rotation track: a local rotation at each time (seconds, increasing). Share one `times` between tracks.
    #[must_use]
    pub fn rotation(node: usize, times: Arc<[f32]>, rotations: &[Quat]) -> Self {
        Self::linear(node, Property::Rotation, times, rotations.iter().map(Quat::to_array).collect())
    }

    /// A linear translation track: a local translation at each time (seconds, increasing).
    #[must_use]
    pub fn translation(node: usize, times: Arc<[f32]>, translations: &[Vec3]) -> Self {
        Self::linear(node, Property::Translation, times, translations.iter().map(Vec3::to_array).collect())
    }

    /// A linear scale track: a local scale at each time (seconds, increasing).
    #[must_use]
    pub fn scale(node: usize, times: Arc<[f32]>, scales: &[Vec3]) -> Self {
        Self::linear(node, Property::Scale, times, scales.iter().map(Vec3::to_array).collect())
    }

    /// A linear track of the weights of a node's mesh: all of them at each time (seconds, increasing).
    #[must_use]
    pub fn weights(node: usize, times: Arc<[f32]>, weights: &[Vec<f32>]) -> Self {
        let width = weights.first().map_or(0, Vec::len);
        let (property, interpolation) = (Property::Weights, Interpolation::Linear);
        Self { node, property, interpolation, times, values: weights.concat(), width }
    }

    /// The same keys with another interpolation. Cubic splines need three values a key: in-tangent, value, out-tangent.
    #[must_use]
    pub fn with_interpolation(mut self, interpolation: Interpolation) -> Self {
        self.interpolation = interpolation;
        self
    }

    /// The node it moves.
    #[must_use]
    pub fn node(&self) -> usize {
        self.node
    }

    /// The property it moves.
    #[must_use]
    pub fn property(&self) -> Property {
        self.property
    }

    /// Its interpolation.
    #[must_use]
    pub fn interpolation(&self) -> Interpolation {
        self.interpolation
    }

    /// Key times, seconds.
    #[must_use]
    pub fn times(&self) -> &[f32] {
        &self.times
    }

    /// The keys' numbers, flat: per key a vector or quaternion, or in-tangent, value and out-tangent of cubic splines.
    #[must_use]
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// True if each key holds its value between two tangents.
    fn has_tangents(&self) -> bool {
        self.interpolation == Interpolation::CubicSpline
    }

    /// Numbers stored for one key.
    pub(crate) fn stride(&self) -> usize {
        if self.has_tangents() { self.width * 3 } else { self.width }
    }

    /// Part `at` of key `k`: its value, or of cubic splines its in-tangent (0), value (1) or out-tangent (2).
    fn part(&self, k: usize, at: usize) -> &[f32] {
        let start = k * self.stride() + at * self.width;
        &self.values[start..start + self.width]
    }

    /// The value of key `k`, without its tangents.
    pub(crate) fn value(&self, k: usize) -> &[f32] {
        self.part(k, usize::from(self.has_tangents()))
    }

    /// The value at a time, held outside the keys; rotations come out unit. NaN counts as the first key.
    #[must_use]
    pub fn sample(&self, seconds: f32) -> Vec<f32> {
        let next = self.times.partition_point(|t| *t <= seconds);
        let last = self.times.len().saturating_sub(1);
        if self.times.is_empty() {
            return vec![0.0; self.width];
        }
        if next == 0 || seconds.is_nan() {
            return self.unit(self.value(0).to_vec());
        }
        if next > last {
            return self.unit(self.value(last).to_vec());
        }
        let (k, interval) = (next - 1, self.times[next] - self.times[next - 1]);
        let u = (seconds - self.times[k]) / interval;
        let (a, b) = (self.value(k), self.value(next));
        let mix = match self.interpolation {
            Interpolation::Step => a.to_vec(),
            Interpolation::Linear if self.property == Property::Rotation => {
                slerp(quat(a), quat(b), u).to_array().to_vec()
            }
            Interpolation::Linear => a.iter().zip(b).map(|(a, b)| a + (b - a) * u).collect(),
            Interpolation::CubicSpline => {
                let (uu, uuu) = (u * u, u * u * u);
                let (h_a, h_b) = (2.0 * uuu - 3.0 * uu + 1.0, -2.0 * uuu + 3.0 * uu);
                let (h_out, h_in) = (interval * (uuu - 2.0 * uu + u), interval * (uuu - uu));
                let (out, into) = (self.part(k, 2), self.part(next, 0));
                (0..self.width).map(|i| h_a * a[i] + h_out * out[i] + h_b * b[i] + h_in * into[i]).collect()
            }
        };
        self.unit(mix)
    }

    fn unit(&self, value: Vec<f32>) -> Vec<f32> {
        if self.property == Property::Rotation { quat(&value).to_array().to_vec() } else { value }
    }

    /// The channel repeated every `period` seconds until `end`, keys held where they do not reach the period's
    /// borders, so that at every time it equals the original at that time modulo the period.
    fn repeated(&self, period: f32, end: f32) -> Self {
        let (mut times, mut values): (Vec<f32>, Vec<f32>) = (Vec::new(), Vec::new());
        let (cubic, width, stride, last) = (self.has_tangents(), self.width, self.stride(), self.times.len() - 1);
        let place = if cubic { width..2 * width } else { 0..width };
        let held = |k: usize| {
            let mut key = vec![0.0; stride];
            key[place.clone()].copy_from_slice(self.value(k));
            key
        };
        // Multiplying rather than adding up keeps late repeats exact.
        'periods: for round in 0_u32.. {
            let start = num::narrow(f64::from(round) * f64::from(period));
            if round > 0 && (start >= end || period <= 0.0) {
                break;
            }
            // The seam: the first key of a round equals the last of the round before, or lies a hair after it.
            let mut push = |offset: f32, key: Vec<f32>| {
                let mut at = start + offset;
                if let Some(&before) = times.last().filter(|before| at <= **before) {
                    let tail = values.len() - stride;
                    if values[tail..][place.clone()] == key[place.clone()] {
                        // Arrive as the old round did, leave as the new one does.
                        values[tail + place.end..].copy_from_slice(&key[place.end..]);
                        return;
                    }
                    at = num::just_after(before);
                }
                times.push(at);
                values.extend(key);
            };
            if self.times[0] > 0.0 {
                push(0.0, held(0));
            }
            for k in 0..=last {
                let mut key = self.values[k * stride..(k + 1) * stride].to_vec();
                // A held border has flat tangents; the key beside it must then be approached flat, too.
                if cubic && k == 0 && self.times[0] > 0.0 {
                    key[..width].fill(0.0);
                }
                if cubic && k == last && self.times[last] < period {
                    key[2 * width..].fill(0.0);
                }
                push(self.times[k], key);
                if start + self.times[k] >= end {
                    break 'periods;
                }
            }
            if self.times[last] < period {
                push(period, held(last));
            }
        }
        let mut out = Self { times: times.into(), values, ..self.clone() };
        out.cut(end);
        out
    }

    /// Ends the channel at `end` with the value it has there.
    fn cut(&mut self, end: f32) {
        let keep = self.times.partition_point(|t| *t <= end);
        if keep == self.times.len() || keep == 0 {
            return;
        }
        let at_end = self.sample(end);
        let mut times = self.times[..keep].to_vec();
        if times[keep - 1] < end {
            let (k, stride) = (keep - 1, self.stride());
            let mut slope = Vec::new();
            if self.has_tangents() {
                // The slope of the spline at the cut, so that the remaining piece is the same curve.
                let old = self.times[keep] - self.times[k];
                let u = (end - self.times[k]) / old;
                let (d_a, d_out, d_in) =
                    ((6.0 * u * u - 6.0 * u) / old, 3.0 * u * u - 4.0 * u + 1.0, 3.0 * u * u - 2.0 * u);
                let (a, b) = (self.value(k), self.value(keep));
                let (out, into) = (self.part(k, 2), self.part(keep, 0));
                slope = (0..self.width).map(|i| d_a * (a[i] - b[i]) + d_out * out[i] + d_in * into[i]).collect();
            }
            self.values.truncate(keep * stride);
            self.values.extend(slope.into_iter().chain(at_end));
            self.values.resize((keep + 1) * stride, 0.0);
            times.push(end);
        } else {
            self.values.truncate(keep * self.stride());
        }
        self.times = times.into();
    }
}

/// A unit quaternion of four numbers.
pub(crate) fn quat(v: &[f32]) -> Quat {
    let q = Vec4::from_slice(v);
    // Doubles keep what quantised integers lost from growing; a zero quaternion means no rotation.
    let wide = q.as_dvec4();
    if wide.length_squared() > 1e-12 { Quat::from_vec4(wide.normalize().as_vec4()) } else { Quat::IDENTITY }
}

/// Along the shorter arc at constant speed, in double precision.
fn slerp(a: Quat, b: Quat, u: f32) -> Quat {
    let [a, b] = [a, b].map(|q| q.as_dquat().normalize());
    a.slerp(b, f64::from(u)).normalize().as_quat()
}

impl Clip {
    /// A clip of the given channels.
    #[must_use]
    pub fn new(name: impl Into<String>, channels: Vec<Channel>) -> Self {
        Self { name: name.into(), channels }
    }

    /// The last key's time, seconds; 0 without keys.
    #[must_use]
    pub fn seconds(&self) -> f32 {
        self.channels.iter().filter_map(|c| c.times.last()).fold(0.0, |a, b| a.max(*b))
    }

    /// Writes the sampled properties into `pose` (indexed by node); others stay as they are.
    pub fn sample(&self, seconds: f32, pose: &mut [Transform]) {
        for channel in &self.channels {
            let Some(local) = pose.get_mut(channel.node) else { continue };
            match (channel.property, &channel.sample(seconds)[..]) {
                (Property::Translation, v @ [_, _, _]) => local.translation = Vec3::from_slice(v),
                (Property::Rotation, v @ [_, _, _, _]) => local.rotation = Quat::from_slice(v),
                (Property::Scale, v @ [_, _, _]) => local.scale = Vec3::from_slice(v),
                _ => {}
            }
        }
    }

    /// The clip made `seconds` long: repeated when that is more than its own length, cut when less. Keys keep their
    /// values and interpolation. Where the last pose differs from the first the seam jumps, as a player's loop does.
    ///
    /// A clip of no length stays as it is, which holds it for ever. Repeats end early where they would not fit into
    /// memory (65 535 rounds at most).
    #[must_use]
    pub fn repeated(&self, seconds: f32) -> Self {
        let period = self.seconds();
        if !seconds.is_finite() || seconds <= 0.0 || seconds == period || period <= 0.0 {
            return self.clone();
        }
        // A bound on the memory whatever is asked: 2^26 numbers.
        let round: usize = self.channels.iter().map(|c| c.values.len() + 2 * c.stride()).sum();
        let rounds = u16::try_from((1 << 26) / round.max(1)).unwrap_or(u16::MAX).max(1);
        let end = seconds.min(period * f32::from(rounds));
        let channels = self.channels.iter().filter(|c| !c.times.is_empty()).map(|c| c.repeated(period, end)).collect();
        Self { name: self.name.clone(), channels }
    }

    /// Puts a channel in place of those that move the same property of the same node.
    pub fn set(&mut self, channel: Channel) {
        self.channels.retain(|c| (c.node, c.property) != (channel.node, channel.property));
        self.channels.push(channel);
    }

    pub(crate) fn read_all(data: &Data<'_>) -> Result<Vec<Self>, Error> {
        let read = |(index, animation): (usize, &raw::Animation)| Self::read(data, animation, index);
        data.raw.animations.iter().enumerate().map(read).collect()
    }

    fn read(data: &Data<'_>, animation: &raw::Animation, index: usize) -> Result<Self, Error> {
        let mut channels = Vec::with_capacity(animation.channels.len());
        // Channels usually share their times.
        let mut inputs: Vec<(usize, Arc<[f32]>)> = Vec::new();
        for (k, channel) in animation.channels.iter().enumerate() {
            let place = format!("animations[{index}].channels[{k}]");
            let sampler = animation
                .samplers
                .get(channel.sampler)
                .ok_or_else(|| Error::invalid(&place, format!("sampler {} does not exist", channel.sampler)))?;
            let place = format!("animations[{index}].samplers[{}]", channel.sampler);
            let times = match inputs.iter().find(|(input, _)| *input == sampler.input) {
                Some((_, times)) => times.clone(),
                None => {
                    let mut times = data.floats(sampler.input, &["SCALAR"], &format!("{place}.input"))?;
                    if times.is_empty() || times.windows(2).any(|w| w[0] > w[1]) || times[0] < 0.0 {
                        let problem = "its times must be one or more, not negative, and increasing";
                        return Err(Error::invalid(format!("{place}.input"), problem));
                    }
                    // Two keys at one time are how some exporters write a jump.
                    for k in 1..times.len() {
                        if times[k] <= times[k - 1] {
                            times[k] = num::just_after(times[k - 1]);
                        }
                    }
                    let times: Arc<[f32]> = times.into();
                    inputs.push((sampler.input, times.clone()));
                    times
                }
            };
            let word = sampler.interpolation.as_deref().unwrap_or("LINEAR");
            let Some(&(interpolation, _)) = INTERPOLATIONS.iter().find(|(_, known)| *known == word) else {
                let problem = format!("interpolation {word:?} is none of STEP, LINEAR, CUBICSPLINE");
                return Err(Error::invalid(place, problem));
            };
            // Other paths are those of extensions, such as animation pointers: kept in the file, no part of a pose.
            let path = &channel.target.path;
            let Some(&(property, _, shape, width)) = PROPERTIES.iter().find(|(_, known, ..)| known == path) else {
                continue;
            };
            let Some(node) = channel.target.node else { continue };
            if node >= data.raw.nodes.len() {
                return Err(Error::invalid(place, format!("its target nodes[{node}] does not exist")));
            }
            let values = data.floats(sampler.output, &[shape], &format!("{place}.output"))?;
            let per_key = if interpolation == Interpolation::CubicSpline { 3 } else { 1 };
            let morphs = values.len() / (times.len() * per_key);
            let width = if property == Property::Weights { morphs } else { width };
            if width == 0 || values.len() != times.len() * per_key * width {
                let (numbers, keys) = (values.len(), times.len());
                let problem = format!("{numbers} numbers do not make {keys} keys of {per_key} × {width}");
                return Err(Error::invalid(format!("{place}.output"), problem));
            }
            channels.push(Channel { node, property, interpolation, times, values, width });
        }
        let name = animation.name.clone().unwrap_or_else(|| format!("clip{index}"));
        // Of several that move the same, which the specification forbids, the last counts.
        let mut seen = HashSet::new();
        channels.reverse();
        channels.retain(|channel: &Channel| seen.insert((channel.node, channel.property)));
        channels.reverse();
        Ok(Self { name, channels })
    }
}
