//! Animation clips: keys read exactly as stored, sampled as glTF 2.0 defines, repeated without changing a key.

use std::collections::HashSet;
use std::sync::Arc;

use glam::{Quat, Vec3, Vec4};

use crate::accessor::Data;
use crate::error::Error;
use crate::num;
use crate::raw;
use crate::trs::Trs;

/// What a channel animates.
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

/// How a channel goes from one key to the next.
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

impl Channel {
    fn new(node: usize, property: Property, times: Arc<[f32]>, values: Vec<f32>, width: usize) -> Self {
        Self { node, property, interpolation: Interpolation::Linear, times, values, width }
    }

    /// A linear rotation track: a local rotation at each time (seconds, increasing). Share one `times` between tracks.
    #[must_use]
    pub fn rotation(node: usize, times: Arc<[f32]>, rotations: &[Quat]) -> Self {
        let values = rotations.iter().flat_map(|q| q.to_array()).collect();
        Self::new(node, Property::Rotation, times, values, 4)
    }

    /// A linear translation track: a local translation at each time (seconds, increasing).
    #[must_use]
    pub fn translation(node: usize, times: Arc<[f32]>, translations: &[Vec3]) -> Self {
        let values = translations.iter().flat_map(|v| v.to_array()).collect();
        Self::new(node, Property::Translation, times, values, 3)
    }

    /// A linear scale track: a local scale at each time (seconds, increasing).
    #[must_use]
    pub fn scale(node: usize, times: Arc<[f32]>, scales: &[Vec3]) -> Self {
        let values = scales.iter().flat_map(|v| v.to_array()).collect();
        Self::new(node, Property::Scale, times, values, 3)
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

    /// What it moves.
    #[must_use]
    pub fn property(&self) -> Property {
        self.property
    }

    /// How it interpolates.
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

    /// Numbers stored for one key.
    pub(crate) fn stride(&self) -> usize {
        if self.interpolation == Interpolation::CubicSpline { self.width * 3 } else { self.width }
    }

    /// The value of key `k`, without its tangents.
    pub(crate) fn value(&self, k: usize) -> &[f32] {
        let start = k * self.stride() + if self.interpolation == Interpolation::CubicSpline { self.width } else { 0 };
        &self.values[start..start + self.width]
    }

    fn in_tangent(&self, k: usize) -> &[f32] {
        let start = k * self.stride();
        &self.values[start..start + self.width]
    }

    fn out_tangent(&self, k: usize) -> &[f32] {
        let start = k * self.stride() + 2 * self.width;
        &self.values[start..start + self.width]
    }

    /// The value at a time, held outside the keys; rotations come out unit. NaN counts as the first key.
    pub(crate) fn sample(&self, seconds: f32) -> Vec<f32> {
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
                let (out, into) = (self.out_tangent(k), self.in_tangent(next));
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
        let mut times: Vec<f32> = Vec::new();
        let mut values = Vec::new();
        let zeros = vec![0.0; self.width];
        let cubic = self.interpolation == Interpolation::CubicSpline;
        let hold = |value: &[f32], values: &mut Vec<f32>| {
            for part in if cubic { vec![&zeros[..], value, &zeros] } else { vec![value] } {
                values.extend_from_slice(part);
            }
        };
        let stride = self.stride();
        let last = self.times.len() - 1;
        // Multiplying rather than adding up keeps late repeats exact.
        'periods: for round in 0_u32.. {
            let start = num::narrow(f64::from(round) * f64::from(period));
            if round > 0 && (start >= end || period <= 0.0) {
                break;
            }
            // The seam: the first key of a round equals the last of the round before, or lies a hair after it.
            let mut push = |offset: f32, key: &dyn Fn(&mut Vec<f32>), value: &[f32]| {
                let mut at = start + offset;
                if let Some(&before) = times.last() {
                    if at <= before {
                        let tail = values.len() - stride;
                        let kept = if cubic { tail + self.width } else { tail };
                        if values[kept..kept + self.width] == *value {
                            let mut whole = Vec::with_capacity(stride);
                            key(&mut whole);
                            if cubic {
                                // Arrive as the old round did, leave as the new one does.
                                values[tail + 2 * self.width..].copy_from_slice(&whole[2 * self.width..]);
                            }
                            return;
                        }
                        at = num::just_after(before);
                    }
                }
                times.push(at);
                key(&mut values);
            };
            if self.times[0] > 0.0 {
                push(0.0, &|out| hold(self.value(0), out), self.value(0));
            }
            for k in 0..=last {
                // A held border has flat tangents; the key beside it must then be approached flat, too.
                let flat_in = k == 0 && self.times[0] > 0.0;
                let flat_out = k == last && self.times[last] < period;
                push(
                    self.times[k],
                    &|out| {
                        let from = out.len();
                        out.extend_from_slice(&self.values[k * stride..(k + 1) * stride]);
                        if cubic && flat_in {
                            out[from..from + self.width].fill(0.0);
                        }
                        if cubic && flat_out {
                            out[from + 2 * self.width..].fill(0.0);
                        }
                    },
                    self.value(k),
                );
                if start + self.times[k] >= end {
                    break 'periods;
                }
            }
            if self.times[last] < period {
                push(period, &|out| hold(self.value(last), out), self.value(last));
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
        let stride = self.stride();
        if times[keep - 1] < end {
            let (k, old) = (keep - 1, self.times[keep] - self.times[keep - 1]);
            let (w, h) = (self.width, end - self.times[k]);
            if self.interpolation == Interpolation::CubicSpline {
                // The slope of the spline at the cut, so that the remaining piece is the same curve.
                let u = h / old;
                let (d_a, d_out, d_in) =
                    ((6.0 * u * u - 6.0 * u) / old, 3.0 * u * u - 4.0 * u + 1.0, 3.0 * u * u - 2.0 * u);
                let (a, b) = (self.value(k), self.value(keep));
                let slope: Vec<f32> = (0..w)
                    .map(|i| d_a * (a[i] - b[i]) + d_out * self.out_tangent(k)[i] + d_in * self.in_tangent(keep)[i])
                    .collect();
                self.values.truncate(keep * stride);
                self.values.extend_from_slice(&slope);
                self.values.extend_from_slice(&at_end);
                self.values.resize((keep + 1) * stride, 0.0);
            } else {
                self.values.truncate(keep * stride);
                self.values.extend_from_slice(&at_end);
            }
            times.push(end);
        } else {
            self.values.truncate(keep * stride);
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
    let (a, mut b) = (a.as_dquat().normalize(), b.as_dquat().normalize());
    let mut cos = a.dot(b);
    if cos < 0.0 {
        (b, cos) = (-b, -cos);
    }
    let u = f64::from(u);
    let mixed = if cos > 1.0 - 1e-9 {
        a * (1.0 - u) + b * u
    } else {
        let angle = cos.acos();
        (a * ((1.0 - u) * angle).sin() + b * (u * angle).sin()) * (1.0 / angle.sin())
    };
    mixed.normalize().as_quat()
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
    pub fn sample(&self, seconds: f32, pose: &mut [Trs]) {
        for channel in &self.channels {
            let Some(local) = pose.get_mut(channel.node) else {
                continue;
            };
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
                        return Err(Error::invalid(
                            format!("{place}.input"),
                            "its times must be one or more, not negative, and increasing",
                        ));
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
            let interpolation = match sampler.interpolation.as_deref() {
                None | Some("LINEAR") => Interpolation::Linear,
                Some("STEP") => Interpolation::Step,
                Some("CUBICSPLINE") => Interpolation::CubicSpline,
                Some(other) => {
                    return Err(Error::invalid(
                        place,
                        format!("interpolation {other:?} is none of STEP, LINEAR, CUBICSPLINE"),
                    ));
                }
            };
            let (property, shape) = match channel.target.path.as_str() {
                "translation" => (Property::Translation, "VEC3"),
                "rotation" => (Property::Rotation, "VEC4"),
                "scale" => (Property::Scale, "VEC3"),
                "weights" => (Property::Weights, "SCALAR"),
                // Extensions such as animation pointers: kept in the file, no part of a pose.
                _ => continue,
            };
            let Some(node) = channel.target.node else {
                continue;
            };
            if node >= data.raw.nodes.len() {
                return Err(Error::invalid(place, format!("its target nodes[{node}] does not exist")));
            }
            let values = data.floats(sampler.output, &[shape], &format!("{place}.output"))?;
            let per_key = if interpolation == Interpolation::CubicSpline { 3 } else { 1 };
            let width = match property {
                Property::Rotation => 4,
                Property::Weights => values.len() / (times.len() * per_key),
                _ => 3,
            };
            if width == 0 || values.len() != times.len() * per_key * width {
                return Err(Error::invalid(
                    format!("{place}.output"),
                    format!("{} numbers do not make {} keys of {per_key} × {width}", values.len(), times.len()),
                ));
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
