//! The report of `aim clip`: the size of each clip before and after the change, and a summary in words.

use std::path::PathBuf;

use aim_animation::{Clip, Motion, RootPath, Track, Transform, Value};
use aim_character::Measurement;
use aim_gltf::{ClipSize, Document};
use aim_runtime::glam::DVec3;
use serde::Serialize;

use crate::deviation::key_times;
use crate::reduction::millimetre;
use crate::seam_report::SeamReport;
use crate::words::{counted, fixed, grouped, trimmed, weights_in_words};

/// Content of `--report`; the command's help describes it.
#[derive(Debug, Serialize)]
pub(crate) struct ClipReport {
    pub(crate) file: String,
    pub(crate) millimetre: f64,
    pub(crate) file_bytes: [usize; 2],
    pub(crate) out: Option<PathBuf>,
    pub(crate) clips: Vec<ClipCost>,
}

/// A clip before and after it was changed.
#[derive(Debug, Serialize)]
pub(crate) struct ClipCost {
    pub(crate) clip: String,
    pub(crate) length_s: f32,
    pub(crate) before: Side,
    pub(crate) after: Side,
    pub(crate) root: Option<RootReport>,
    pub(crate) extracted: Option<Extracted>,
    /// `true` if the seam was mended, `false` if the clip looped already; `None` without `--loop`.
    pub(crate) mended: Option<bool>,
    pub(crate) reduced: Option<ReducedReport>,
    pub(crate) bones: Vec<BoneBytes>,
}

/// Tracks, keys, bytes and seam of a clip.
#[derive(Debug, Serialize)]
pub(crate) struct Side {
    pub(crate) tracks: Tracks,
    pub(crate) keys: usize,
    pub(crate) key_bytes: usize,
    pub(crate) text_bytes: usize,
    pub(crate) key_bytes_a_second: f64,
    pub(crate) seam: SeamReport,
}

/// Numbers of tracks by kind.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(crate) struct Tracks {
    pub(crate) moving: usize,
    /// Tracks of one value that differs from the rest pose.
    pub(crate) constant: usize,
    pub(crate) at_rest: usize,
}

/// Motion of the hips from the first frame to the last, as a screw.
#[derive(Debug, Serialize)]
pub(crate) struct RootReport {
    pub(crate) speed: f64,
    pub(crate) speed_m_s: f64,
    pub(crate) turn_deg_s: f64,
    pub(crate) axis: [f32; 3],
    pub(crate) point: Option<[f32; 3]>,
    pub(crate) along: f32,
    /// Length of the path of the hips, sway included, in the file's units.
    pub(crate) distance: f64,
}

/// Root motion that was extracted from a clip.
#[derive(Debug, Serialize)]
pub(crate) struct Extracted {
    pub(crate) motion: String,
    /// `true` if there was no motion to extract, so that the clip stays unchanged.
    pub(crate) nothing: bool,
    pub(crate) seconds: f32,
    /// Length of the motion's path, in the file's units.
    pub(crate) distance: f64,
    pub(crate) translation: [f32; 3],
    pub(crate) turn_deg: f64,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) path: Vec<Place>,
}

/// Transform of an extracted motion at a time.
#[derive(Debug, Serialize)]
pub(crate) struct Place {
    t: f32,
    translation: [f32; 3],
    rotation: [f32; 4],
}

/// Result of a reduction: the request, and the error of the clip as written.
#[derive(Debug, Serialize)]
pub(crate) struct ReducedReport {
    pub(crate) tolerance_mm: f64,
    /// `true` if no change was requested and this is only a proposal.
    pub(crate) proposed: bool,
    pub(crate) pins: Vec<f32>,
    pub(crate) error_mm: f64,
    pub(crate) bone: Option<String>,
    pub(crate) t: Option<f64>,
    pub(crate) weights_error: Option<f64>,
}

/// Bytes of a bone's keys before and after, by property.
#[derive(Debug, Serialize)]
pub(crate) struct BoneBytes {
    pub(crate) bone: String,
    /// Index of the bone.
    #[serde(skip)]
    pub(crate) number: usize,
    pub(crate) before: Kinds,
    pub(crate) after: Kinds,
}

/// Bytes of keys, by property.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(crate) struct Kinds {
    pub(crate) translation: f64,
    pub(crate) rotation: f64,
    pub(crate) scale: f64,
    pub(crate) weights: f64,
}

impl Kinds {
    pub(crate) fn all(self) -> [f64; 4] {
        [self.translation, self.rotation, self.scale, self.weights]
    }

    pub(crate) fn sum(self) -> f64 {
        self.all().iter().sum()
    }
}

impl Tracks {
    fn of(clip: &Clip, document: &Document) -> Self {
        let skeleton = document.skeleton();
        let mut tracks = Self::default();
        for of in clip.tracks() {
            let rest = skeleton.rest().get(of.bone).copied().unwrap_or(Transform::IDENTITY);
            of.translation.iter().for_each(|track| tracks.count(track, Some(rest.translation), |a, b| a == b));
            of.rotation.iter().for_each(|track| tracks.count(track, Some(rest.rotation), |a, b| a == b || a == -b));
            of.scale.iter().for_each(|track| tracks.count(track, Some(rest.scale), |a, b| a == b));
        }
        for (scalar, track) in clip.scalars() {
            let node = (0..skeleton.len()).find(|node| document.morph_scalars(*node).contains(scalar));
            let rest = node.and_then(|node| {
                let first = document.morph_scalars(node).start;
                skeleton.morph_weights(node).map(|weights| weights.get(scalar - first).copied().unwrap_or_default())
            });
            tracks.count(track, rest, |a, b| a == b);
        }
        tracks
    }

    fn count<T: Value>(&mut self, track: &Track<T>, rest: Option<T>, same: impl Fn(T, T) -> bool) {
        let first = track.values()[0];
        let still = |value: &T| same(*value, *value) && same(*value, first);
        let flat = |[into, out]: &[T; 2]| [into, out].into_iter().all(|tangent| same(*tangent, first.times(0.0)));
        if !(track.values().iter().all(still) && track.tangents().iter().all(flat)) {
            self.moving += 1;
        } else if rest.is_some_and(|rest| same(first, rest)) {
            self.at_rest += 1;
        } else {
            self.constant += 1;
        }
    }

    pub(crate) fn in_words(self) -> String {
        format!("{} moving, {} constant, {} at rest", self.moving, self.constant, self.at_rest)
    }
}

impl Side {
    pub(crate) fn new(document: &Document, measurement: &Measurement, clip: &Clip, size: &ClipSize) -> Self {
        let keys = clip.tracks().iter().map(|tracks| crate::deviation::bone_times(tracks).count()).sum::<usize>();
        let length = f64::from(clip.length_s());
        Self {
            tracks: Tracks::of(clip, document),
            keys: keys + clip.scalars().iter().map(|(_, track)| track.times().len()).sum::<usize>(),
            key_bytes: size.keys,
            text_bytes: size.text,
            key_bytes_a_second: if length > 0.0 { crate::words::count(size.keys) / length } else { 0.0 },
            seam: SeamReport::new(document, measurement, clip),
        }
    }
}

impl RootReport {
    /// Measures the motion of the hips along `path`, and the length of the path at `times`.
    pub(crate) fn new(path: &RootPath, measurement: &Measurement, times: &[f32]) -> Self {
        let screw = Motion::composite(path).screw();
        let speed = f64::from(screw.speed_s());
        Self {
            speed,
            speed_m_s: speed / millimetre(measurement) / 1000.0,
            turn_deg_s: f64::from(screw.turn_rad_s).to_degrees(),
            axis: screw.axis.to_array(),
            point: screw.point.map(|point| point.to_array()),
            along: screw.along_s,
            distance: distance(times.iter().map(|&t| path.at(t))),
        }
    }

    pub(crate) fn in_words(&self) -> String {
        format!(
            "{} units/s ({} m/s for a 1.7 m figure), turning {}°/s; path length {} units",
            trimmed(self.speed, 3),
            trimmed(self.speed_m_s, 2),
            trimmed(self.turn_deg_s, 1),
            trimmed(self.distance, 3)
        )
    }
}

impl Extracted {
    /// Samples `motion`, of the kind named by `word`, at `times`. `height` is the character's, in the file's units.
    pub(crate) fn new(motion: &Motion, word: &str, times: &[f32], height: f64) -> Self {
        let places: Vec<Place> = times
            .iter()
            .map(|&t| {
                let at = motion.at(t);
                Place { t, translation: at.translation.to_array(), rotation: at.rotation.to_array() }
            })
            .collect();
        let whole = motion.at(motion.length_s());
        Self {
            motion: word.to_owned(),
            nothing: times.iter().all(|&t| is_nothing(motion.at(t), height)),
            seconds: motion.length_s(),
            distance: distance(times.iter().map(|&t| motion.at(t))),
            translation: whole.translation.to_array(),
            turn_deg: f64::from(aim_runtime::rotation::angle(whole.rotation)).to_degrees(),
            path: if word == "delta" { places } else { Vec::new() },
        }
    }
}

/// Returns `true` if a transform is too small to see: at most 1e-5 of the character's height and 1e-4 radians.
fn is_nothing(place: Transform, height: f64) -> bool {
    place.translation.as_dvec3().length() <= 1e-5 * height && aim_runtime::rotation::angle(place.rotation) <= 1e-4
}

/// Returns the length of the polyline through `places`.
fn distance(places: impl Iterator<Item = Transform>) -> f64 {
    let points: Vec<DVec3> = places.map(|place| place.translation.as_dvec3()).collect();
    points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

/// Returns the bytes of each bone's keys before and after, largest after the change first.
pub(crate) fn bone_bytes(document: &Document, [before, after]: [&ClipSize; 2]) -> Vec<BoneBytes> {
    let mut bones = std::collections::BTreeMap::<usize, [Kinds; 2]>::new();
    for (side, size) in [before, after].into_iter().enumerate() {
        for channel in &size.channels {
            let kinds = &mut bones.entry(channel.bone).or_default()[side];
            let kind = match channel.path.as_str() {
                "translation" => &mut kinds.translation,
                "rotation" => &mut kinds.rotation,
                "scale" => &mut kinds.scale,
                _ => &mut kinds.weights,
            };
            *kind += channel.bytes;
        }
    }
    let names = document.skeleton().names();
    let bytes = |(bone, [before, after]): (usize, [Kinds; 2])| BoneBytes {
        bone: names[bone].clone(),
        number: bone,
        before,
        after,
    };
    let mut bytes: Vec<BoneBytes> = bones.into_iter().map(bytes).collect();
    let order = |bone: &BoneBytes| [bone.after.sum(), bone.before.sum()];
    bytes.sort_by(|a, b| order(b).partial_cmp(&order(a)).unwrap_or(std::cmp::Ordering::Equal));
    bytes
}

/// Returns the times of a clip's keys and of its ends, sorted, each once.
pub(crate) fn sampled(clip: &Clip) -> Vec<f32> {
    let mut times = key_times(clip);
    times.extend([0.0, clip.length_s()]);
    times.sort_by(f32::total_cmp);
    times.dedup();
    times
}

impl ClipReport {
    /// Returns the summary in words; if `is_preview`, as a proposal.
    pub(crate) fn in_words(&self, is_preview: bool) -> String {
        let mut out = self.table(is_preview);
        for cost in &self.clips {
            out += &format!("\n{}\n  seam  {}\n", cost.clip, cost.before.seam.in_words());
            if let Some(root) = &cost.root {
                out += &format!("  hips  {}\n", root.in_words());
            }
            match &cost.extracted {
                Some(Extracted { nothing: true, .. }) => out += "  nothing to extract: the clip is already in place\n",
                Some(Extracted { motion, distance, turn_deg, .. }) => {
                    out += &format!(
                        "  extracted as {motion}: path length {} units, final turn {}°\n",
                        trimmed(*distance, 3),
                        trimmed(*turn_deg, 1)
                    );
                }
                None => {}
            }
            if let Some(words) = cost.loop_in_words() {
                out += &format!("  loop  {words}\n");
            }
            if !is_preview {
                out += &format!("  seam after  {}\n", cost.after.seam.in_words());
            }
            if let Some(reduced) = &cost.reduced {
                out += &format!("  at {} mm  {}\n", reduced.tolerance_mm, reduced.in_words());
            }
        }
        let [before, after] = self.file_bytes;
        let file = format!("{} bytes (before: {})", grouped(after), grouped(before));
        out += &match &self.out {
            Some(out) => format!("\nwrote {}: {file}\n", out.display()),
            None if is_preview => format!("\nWith --reduce 1mm, the file would have {file}.\n"),
            None => format!("\nThe file would have {file}; write it with --out.\n"),
        };
        out
    }

    fn table(&self, is_preview: bool) -> String {
        let head = [
            "clip",
            "length",
            "moving tracks",
            "constant",
            "at rest",
            "keys",
            "bytes",
            "bytes/s",
            if is_preview { "at 1 mm" } else { "after" },
            "share",
        ];
        let row = |cost: &ClipCost| {
            let ClipCost { clip, length_s, before, after, .. } = cost;
            [
                clip.clone(),
                format!("{} s", trimmed((*length_s).into(), 3)),
                before.tracks.moving.to_string(),
                before.tracks.constant.to_string(),
                before.tracks.at_rest.to_string(),
                grouped(before.keys),
                grouped(before.key_bytes),
                grouped(rounded(before.key_bytes_a_second)),
                grouped(after.key_bytes),
                percent(after.key_bytes, before.key_bytes),
            ]
        };
        let rows: Vec<[String; 10]> =
            std::iter::once(head.map(str::to_owned)).chain(self.clips.iter().map(row)).collect();
        let widths: Vec<usize> =
            (0..10).map(|k| rows.iter().map(|row| row[k].chars().count()).max().unwrap_or(0)).collect();
        let line = |row: &[String; 10]| {
            let cells = row.iter().zip(&widths).enumerate();
            let cells = cells
                .map(|(k, (cell, width))| if k == 0 { format!("{cell:<width$}") } else { format!("{cell:>width$}") });
            cells.collect::<Vec<_>>().join("  ").trim_end().to_owned() + "\n"
        };
        rows.iter().map(line).collect()
    }
}

impl ClipCost {
    /// Returns the result of `--loop` in words; `None` without that option.
    pub(crate) fn loop_in_words(&self) -> Option<String> {
        Some(match (self.mended?, &self.reduced) {
            (true, Some(_)) => "mended: the jump at the seam is blended out within 0.25 s".into(),
            (true, None) => {
                "mended: the jump at the seam is blended out within 0.25 s; the tracks are now cubic, add --reduce to \
                 shrink them"
                    .into()
            }
            (false, _) => "unchanged: position and speed change no more at the seam than elsewhere".into(),
        })
    }
}

impl ReducedReport {
    pub(crate) fn in_words(&self) -> String {
        let off = format!("error at most {} mm", fixed(self.error_mm, 3));
        let place = match (&self.bone, self.t) {
            (Some(bone), Some(t)) => format!(" ({bone} at {} s)", trimmed(t, 3)),
            _ => String::new(),
        };
        let pins =
            if self.pins.is_empty() { String::new() } else { format!("; {} pinned", counted(self.pins.len(), "pose")) };
        off + &place + &weights_in_words(self.weights_error) + &pins
    }
}

/// Returns `part` as a percentage of `of`; empty if `of` is 0.
pub(crate) fn percent(part: usize, of: usize) -> String {
    if of == 0 {
        String::new()
    } else {
        format!("{} %", fixed(100.0 * crate::words::count(part) / crate::words::count(of), 1))
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "bytes a second are no more than a file's over a frame"
)]
pub(crate) fn rounded(value: f64) -> usize {
    value.round() as usize
}
