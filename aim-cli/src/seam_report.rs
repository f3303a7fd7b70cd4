//! [`SeamReport`]: the difference between the end and the beginning of a clip, with the bones that differ most.

use aim_animation::{Clip, Gap};
use aim_character::{Measurement, on_the_spot};
use aim_gltf::Document;
use serde::Serialize;

use crate::reduction::millimetre;
use crate::words::fixed;

/// Largest value, and the bone that has it.
#[derive(Clone, Debug, Default, Serialize)]
pub(crate) struct Most {
    pub(crate) most: f64,
    pub(crate) bone: Option<String>,
}

/// Seam of a clip without the motion of its hips: differences in place and speed. Translations are in millimetres of a
/// 1.7 m figure, rotations in degrees.
#[derive(Clone, Debug, Default, Serialize)]
pub(crate) struct SeamReport {
    pub(crate) mm: Most,
    pub(crate) deg: Most,
    pub(crate) mm_s: Most,
    pub(crate) deg_s: Most,
}

impl SeamReport {
    /// Measures the seam of a clip, including the motion of its hips if that cannot be determined.
    pub(crate) fn new(document: &Document, measurement: &Measurement, clip: &Clip) -> Self {
        let clip = on_the_spot(document, measurement, clip).unwrap_or_else(|_| clip.clone());
        let skeleton = document.skeleton();
        let world = skeleton.world_f64(skeleton.rest());
        let mut report = Self::default();
        for tracks in clip.tracks() {
            let mut alone = Clip::new("").with_length(clip.length_s());
            if let Some(track) = &tracks.translation {
                alone = alone.with_translation(tracks.bone, track.clone());
            }
            if let Some(track) = &tracks.rotation {
                alone = alone.with_rotation(tracks.bone, track.clone());
            }
            let seam = alone.seam();
            let scale = skeleton.parents()[tracks.bone].map_or(1.0, |parent| world[parent].matrix3.x_axis.length());
            let name = &skeleton.names()[tracks.bone];
            let mm = |gap: Gap| f64::from(gap.translation) * scale / millimetre(measurement);
            let deg = |gap: Gap| f64::from(gap.rotation_rad).to_degrees();
            report.mm.most_of(mm(seam.place), name);
            report.deg.most_of(deg(seam.place), name);
            report.mm_s.most_of(mm(seam.speed), name);
            report.deg_s.most_of(deg(seam.speed), name);
        }
        report
    }

    pub(crate) fn in_words(&self) -> String {
        let part = |most: &Most, unit: &str, decimals| {
            let number = fixed(most.most, decimals);
            match &most.bone {
                Some(bone) if number.chars().any(|digit| ('1'..='9').contains(&digit)) => {
                    format!("{number}{unit} ({bone})")
                }
                _ => format!("0{unit}"),
            }
        };
        format!(
            "{}, {}; speed {}, {}",
            part(&self.mm, " mm", 1),
            part(&self.deg, "°", 1),
            part(&self.mm_s, " mm/s", 0),
            part(&self.deg_s, "°/s", 0)
        )
    }
}

impl Most {
    fn most_of(&mut self, value: f64, bone: &str) {
        if value > self.most {
            *self = Self { most: value, bone: Some(bone.to_owned()) };
        }
    }
}
