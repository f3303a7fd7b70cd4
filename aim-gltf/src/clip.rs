//! Reads animations as clips: their bones are those of the skeleton, their scalars the weights of morph targets.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use aim_animation::glam::{Quat, Vec3, Vec4};
use aim_animation::{Clip, Curve, HermiteKey, Track, Value};

use crate::accessor::Data;
use crate::error::Error;
use crate::raw;
use crate::skeleton::Skeleton;

/// The `path` of each node property that a clip can animate.
pub(crate) const PATHS: [&str; 4] = ["translation", "rotation", "scale", "weights"];

/// The keys of one property of one node, as stored in the file.
struct Channel<'a> {
    node: usize,
    path: &'a str,
    place: String,
    curve: Curve,
    times: Arc<[f32]>,
    /// `width` numbers per key; for cubic splines three times as many: in-tangent, value, out-tangent.
    values: Vec<f32>,
    width: usize,
}

impl Channel<'_> {
    fn track<T: Value>(&self, value: impl Fn(&[f32]) -> T) -> Result<Track<T>, Error> {
        let parts: Vec<T> = self.values.chunks_exact(self.width).map(value).collect();
        let times = self.times.clone();
        let track = match self.curve {
            Curve::Cubic => {
                let (keys, _) = parts.as_chunks::<3>();
                let keys = keys.iter().map(|&[into, value, out]| HermiteKey { into, value, out });
                Track::hermite(times, &keys.collect::<Vec<_>>())
            }
            Curve::Step => Track::step(times, parts),
            _ => Track::linear(times, parts),
        };
        track.map_err(|error| Error::invalid(&self.place, error.to_string()))
    }

    /// Normalises rotations in double precision, so that quantisation errors of integer components do not grow. A zero
    /// quaternion becomes the identity.
    fn make_unit(&mut self) {
        let cubic = self.curve == Curve::Cubic;
        for (_, four) in self.values.chunks_exact_mut(4).enumerate().filter(|(k, _)| !cubic || k % 3 == 1) {
            let wide = Vec4::from_slice(four).as_dvec4();
            let unit = if wide.length_squared() > 1e-12 { wide.normalize().as_vec4() } else { Vec4::W };
            four.copy_from_slice(&unit.to_array());
        }
    }
}

/// Range of scalars that are the weights of a node's morph targets, by node index of the skeleton. Scalars are numbered
/// in the file's order of nodes.
pub(crate) type MorphScalars = BTreeMap<usize, Range<usize>>;

/// Reads all clips.
pub(crate) fn read_clips(data: &Data<'_>, skeleton: &Skeleton) -> Result<(Vec<Clip>, MorphScalars), Error> {
    let mut next = 0;
    let scalars = data.raw.nodes.iter().enumerate().filter_map(|(node, raw)| {
        let first = next;
        next += data.target_count(raw.mesh?);
        (first < next).then_some((skeleton.bone_of(node)?, first..next))
    });
    let scalars: MorphScalars = scalars.collect();
    let clip = |(index, animation): (usize, &raw::Animation)| {
        let name = animation.name.clone().unwrap_or_else(|| format!("clip{index}"));
        let channels = read_channels(data, skeleton, (index, animation), &scalars)?;
        channels.into_iter().try_fold(Clip::new(name), |clip, channel| with_channel(clip, channel, &scalars))
    };
    let clips = data.raw.animations.iter().enumerate().map(clip).collect::<Result<Vec<_>, _>>()?;
    Ok((clips, scalars))
}

/// Adds a channel to a clip. If several channels animate the same property, which the specification forbids, the last
/// one wins.
fn with_channel(clip: Clip, mut channel: Channel<'_>, scalars: &MorphScalars) -> Result<Clip, Error> {
    let node = channel.node;
    Ok(match channel.path {
        "translation" => clip.with_translation(node, channel.track(Vec3::from_slice)?),
        "scale" => clip.with_scale(node, channel.track(Vec3::from_slice)?),
        "rotation" => {
            channel.make_unit();
            clip.with_rotation(node, channel.track(Quat::from_slice)?)
        }
        _ => {
            let first = scalars.get(&node).map_or(0, |scalars| scalars.start);
            (0..channel.width).try_fold(clip, |clip, target| {
                Ok::<_, Error>(clip.with_scalar(first + target, channel.track(|weights| weights[target])?))
            })?
        }
    })
}

fn read_channels<'a>(
    data: &Data<'_>,
    skeleton: &Skeleton,
    (index, animation): (usize, &'a raw::Animation),
    scalars: &MorphScalars,
) -> Result<Vec<Channel<'a>>, Error> {
    let mut channels = Vec::with_capacity(animation.channels.len());
    // Channels usually share their times: decode each input accessor only once.
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
                    let problem = "expected one or more times, not negative and increasing";
                    return Err(Error::invalid(format!("{place}.input"), problem));
                }
                // Some exporters write a jump as two keys with the same time: move the second to the next representable
                // time.
                for k in 1..times.len() {
                    if times[k] <= times[k - 1] {
                        times[k] = f32::next_up(times[k - 1]);
                    }
                }
                let times: Arc<[f32]> = times.into();
                inputs.push((sampler.input, times.clone()));
                times
            }
        };
        let word = sampler.interpolation.as_deref().unwrap_or("LINEAR");
        let curve = match word {
            "STEP" => Curve::Step,
            "LINEAR" => Curve::Linear,
            "CUBICSPLINE" => Curve::Cubic,
            _ => {
                let problem = format!("unknown interpolation {word:?}; expected STEP, LINEAR or CUBICSPLINE");
                return Err(Error::invalid(place, problem));
            }
        };
        let Some(node) = channel.target.node else { continue };
        let Some(node) = skeleton.bone_of(node).filter(|node| skeleton.is_in_file(*node)) else {
            return Err(Error::invalid(place, format!("its target nodes[{node}] does not exist")));
        };
        // Other paths belong to extensions, such as animation pointers. They are kept in the file but are not part of a
        // pose.
        let (shape, width) = match (channel.target.path.as_str(), scalars.get(&node)) {
            ("translation" | "scale", _) => ("VEC3", 3),
            ("rotation", _) => ("VEC4", 4),
            ("weights", Some(scalars)) => ("SCALAR", scalars.len()),
            _ => continue,
        };
        let values = data.floats(sampler.output, &[shape], &format!("{place}.output"))?;
        let per_key = if curve == Curve::Cubic { 3 } else { 1 };
        if values.len() != times.len() * per_key * width {
            let (numbers, keys) = (values.len(), times.len());
            let problem = format!("found {numbers} numbers, expected {keys} keys of {per_key} × {width}");
            return Err(Error::invalid(format!("{place}.output"), problem));
        }
        channels.push(Channel { node, path: &channel.target.path, place, curve, times, values, width });
    }
    Ok(channels)
}
