//! [`Judge`]: measures the error of a clip in model space, in double precision.

use alloc::vec::Vec;

use aim_runtime::glam::Quat;
use aim_runtime::rotation::{dot, length};

use super::bone_ends::{BoneEnds, narrowed};
use crate::clip::Clip;
use crate::packed::grid::power_of_two;
use crate::playable::PlayableClip;
use crate::skeleton::Skeleton;
use crate::track::{Curve, Track, hermite};
use crate::transform::Transform;

/// Number of sample points between neighbouring keys.
const BETWEEN: u8 = 8;

/// An affine map in double precision: columns, and the translation.
#[derive(Clone, Copy, Debug)]
struct Map {
    columns: [[f64; 3]; 3],
    translation: [f64; 3],
}

impl Map {
    fn of(transform: &Transform) -> Self {
        let [x, y, z, w] = transform.rotation.to_array().map(f64::from);
        let scale = transform.scale.to_array().map(f64::from);
        // Valid for a quaternion of any length.
        let s = 2.0 / (x * x + y * y + z * z + w * w);
        let columns = [
            [1.0 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)],
            [s * (x * y - z * w), 1.0 - s * (x * x + z * z), s * (y * z + x * w)],
            [s * (x * z + y * w), s * (y * z - x * w), 1.0 - s * (x * x + y * y)],
        ];
        let columns = [0, 1, 2].map(|i| columns[i].map(|number| number * scale[i]));
        Self { columns, translation: transform.translation.to_array().map(f64::from) }
    }

    fn turned(&self, [a, b, c]: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = &self.columns;
        [0, 1, 2].map(|i| x[i] * a + y[i] * b + z[i] * c)
    }

    fn times(&self, other: &Self) -> Self {
        let columns = other.columns.map(|column| self.turned(column));
        let turned = self.turned(other.translation);
        Self { columns, translation: [0, 1, 2].map(|i| turned[i] + self.translation[i]) }
    }
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| a[i] - b[i])
}

fn square(v: [f64; 3]) -> f64 {
    v[0] * v[0] + v[1] * v[1] + v[2] * v[2]
}

/// Largest error of a bone; NaN if its position is not a number.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Error {
    pub(super) squared: f64,
    pub(super) vector: [f64; 3],
    pub(super) time_s: f32,
}

impl Error {
    /// Keeps the larger error; NaN is treated as the largest.
    fn keep_larger(&mut self, other: Self) {
        if !(other.squared <= self.squared) && !self.squared.is_nan() {
            *self = other;
        }
    }

    /// Length of the error vector; infinite if it is not finite.
    pub(super) fn size(&self) -> f32 {
        if self.squared.is_finite() { length(narrowed(self.vector)) } else { f32::INFINITY }
    }
}

/// Sample times: before the first key, at each key, between neighbours, and just before each key, where steps and jumps
/// end.
fn points(keys: &[f32]) -> impl Iterator<Item = f32> {
    let before_all = keys.first().map(|first| first.next_down());
    let next = keys.iter().skip(1).copied().map(Some).chain([None]);
    let from_first = keys.iter().zip(next).flat_map(|(&from, next)| {
        let between = move |to: f32| {
            let at = move |k: u8| from + (to - from) * (f32::from(k) / f32::from(BETWEEN + 1));
            (1..=BETWEEN).map(at).chain([to.next_down()])
        };
        core::iter::once(from).chain(next.into_iter().flat_map(between))
    });
    before_all.into_iter().chain(from_first)
}

/// Measures clips against an original.
#[derive(Debug)]
pub(super) struct Judge<'a> {
    skeleton: &'a Skeleton,
    original: &'a Clip,
    ends: Vec<BoneEnds>,
    /// Times of the keys, of the pins, and around fast turns (see [`fast_turn_times`]).
    keys: Vec<f32>,
    /// Times of the keys alone, if `keys` has more, so that the points between them are measured too.
    own_keys: Vec<f32>,
}

/// Largest errors of bones and of scalars.
#[derive(Debug)]
pub(super) struct Errors {
    pub(super) bones: Vec<Error>,
    /// By index in the clip's list of scalars.
    pub(super) scalars: Vec<f32>,
}

impl<'a> Judge<'a> {
    /// A judge for a clip; `pins` are additional times to measure at.
    pub(super) fn new(skeleton: &'a Skeleton, original: &'a Clip, pins: &[f32]) -> Self {
        let own_keys = crate::packed::times_of(original);
        let mut keys = own_keys.clone();
        keys.extend(pins);
        let rotations = original.tracks().iter().filter_map(|tracks| tracks.rotation.as_ref());
        rotations.for_each(|track| keys.extend(fast_turn_times(track)));
        keys.sort_unstable_by(f32::total_cmp);
        keys.dedup();
        let own_keys = if keys == own_keys { Vec::new() } else { own_keys };
        Self { skeleton, original, ends: BoneEnds::of(skeleton), keys, own_keys }
    }

    pub(super) fn ends(&self) -> &[BoneEnds] {
        &self.ends
    }

    /// Errors at the keys and halfway between them, for at most `most` of the keys.
    pub(super) fn errors_at_keys(&self, clip: &dyn PlayableClip, most: usize) -> Errors {
        let step = self.keys.len().div_ceil(most.max(1)).max(1);
        let between = |pair: &[f32]| pair[0] + 0.5 * (pair[1] - pair[0]);
        let middles = self.keys.windows(2).map(between).chain(self.keys.last().copied());
        let times = self.keys.iter().copied().zip(middles).step_by(step).flat_map(|(key, middle)| [key, middle]);
        self.errors(clip, times)
    }

    /// Errors at all keys, just before each, and at eight points between neighbours.
    pub(super) fn errors_everywhere(&self, clip: &dyn PlayableClip) -> Errors {
        self.errors(clip, points(&self.keys).chain(points(&self.own_keys)))
    }

    fn errors(&self, clip: &dyn PlayableClip, times: impl Iterator<Item = f32>) -> Errors {
        let bones = self.skeleton.len();
        let rest = self.skeleton.rest();
        let (mut pose, mut other) = (rest.to_vec(), rest.to_vec());
        let none = Map { columns: [[0.0; 3]; 3], translation: [0.0; 3] };
        let mut maps = alloc::vec![(none, none, true); bones];
        let mut errors = Errors {
            bones: alloc::vec![Error::default(); bones],
            scalars: alloc::vec![0.0; self.original.scalars().len()],
        };
        let (mut cursor, mut clip_cursor) = (self.original.cursor(), clip.cursor());
        let mut keys = alloc::vec![0; errors.scalars.len()];
        for time_s in times {
            pose.copy_from_slice(rest);
            self.original.sample(time_s, &mut cursor, &mut pose);
            other.copy_from_slice(rest);
            clip.sample(time_s, &mut clip_cursor, &mut other);
            for bone in 0..bones {
                let [local, local_other] = [Map::of(&pose[bone]), Map::of(&other[bone])];
                let is_local_same = same(&pose[bone], &other[bone]);
                maps[bone] = match self.skeleton.parents()[bone].map(|parent| &maps[parent]) {
                    None => (local, local_other, is_local_same),
                    Some((parent, other, is_same)) => {
                        let of_original = parent.times(&local);
                        let is_same = *is_same && is_local_same;
                        (of_original, if is_same { of_original } else { other.times(&local_other) }, is_same)
                    }
                };
                if !maps[bone].2 {
                    errors.bones[bone].keep_larger(self.error(bone, &maps[bone], time_s));
                }
            }
            for (place, (_, track)) in self.original.scalars().iter().enumerate() {
                let off = (clip.scalar(time_s, place) - track.sample_near(time_s, &mut keys[place])).abs();
                errors.scalars[place] = errors.scalars[place].max(off);
            }
        }
        errors
    }

    /// Error at a bone's ends.
    fn error(&self, bone: usize, (of_original, of_other, _): &(Map, Map, bool), time_s: f32) -> Error {
        let origin = difference(of_other.translation, of_original.translation);
        let mut worst = Error { squared: square(origin), vector: origin, time_s };
        for child in &self.ends[bone].children {
            let turn = difference(of_other.turned(*child), of_original.turned(*child));
            let vector = [0, 1, 2].map(|i| origin[i] + turn[i]);
            worst.keep_larger(Error { squared: square(vector), vector, time_s });
        }
        for (axis, along) in self.ends[bone].axis_distances.into_iter().enumerate() {
            let turn = difference(of_other.columns[axis], of_original.columns[axis]);
            for along in [along, -along] {
                let vector = [0, 1, 2].map(|i| origin[i] + along * turn[i]);
                worst.keep_larger(Error { squared: square(vector), vector, time_s });
            }
        }
        worst
    }
}

/// Times at which a cubic turns by a large angle in a short time, because its quaternions pass near zero, and times
/// that converge to each of them from both sides.
fn fast_turn_times(track: &Track<Quat>) -> impl Iterator<Item = f32> + '_ {
    let times = if track.curve() == Curve::Cubic { track.times() } else { &[] };
    times.windows(2).enumerate().flat_map(|(key, pair)| {
        let (from, interval, segment) = (pair[0], pair[1] - pair[0], track.segment(key));
        let square = |part: f32| {
            let point = hermite(segment, part);
            dot(point, point)
        };
        let least = |around: f32, step: f32| {
            let parts = (-8..=8_i8).map(|k| around + f32::from(k) * step).filter(|part| (0.0..1.0).contains(part));
            parts.map(|part| (part, square(part))).reduce(|a, b| if b.1 < a.1 { b } else { a })
        };
        let moment = (0..4).try_fold((0.5, 1.0), |(around, _), zoom| least(around, 0.0625 * power_of_two(-3 * zoom)));
        let moment = moment.filter(|(_, square)| *square < 0.25 && interval > 0.0);
        let around = |(part, _): (f32, f32)| {
            let aside = (2..14).map(|k| power_of_two(-k));
            aside.flat_map(move |aside| [part - aside, part + aside]).chain([part])
        };
        let parts = moment.into_iter().flat_map(around).filter(|part| 0.0 < *part && *part < 1.0);
        parts.map(move |part| from + part * interval)
    })
}

/// Returns `true` if two transforms are equal, up to the sign of the quaternion.
fn same(a: &Transform, b: &Transform) -> bool {
    a.translation == b.translation && a.scale == b.scale && (a.rotation == b.rotation || a.rotation == -b.rotation)
}
