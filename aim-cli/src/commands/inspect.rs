//! `aim inspect`: bones with measured axes and roles, and clips.

use aim_gltf::{Document, Measurement};
use serde::Serialize;

use crate::args;
use crate::failure::Result;
use crate::files;

#[derive(Serialize)]
struct Inspection {
    file: String,
    up: [f64; 3],
    forward: [f64; 3],
    bones: Vec<Bone>,
    clips: Vec<Clip>,
}

#[derive(Serialize)]
struct Bone {
    name: String,
    parent: Option<String>,
    role: Option<&'static str>,
    up: &'static str,
    forward: &'static str,
    left: &'static str,
    deviation_deg: f64,
    handedness: &'static str,
}

#[derive(Serialize)]
struct Clip {
    name: String,
    seconds: f32,
}

impl Inspection {
    fn of(file: String, document: &Document) -> Self {
        let measurement = Measurement::of(document);
        let nodes = document.skeleton().nodes();
        let bones = measurement.bones.iter().map(|bone| Bone {
            name: bone.name.clone(),
            parent: bone.parent.map(|parent| nodes[parent].name.clone()),
            role: bone.role.map(aim_gltf::Role::as_str),
            up: bone.up.as_str(),
            forward: bone.forward.as_str(),
            left: bone.left.as_str(),
            deviation_deg: rounded(bone.deviation_deg),
            handedness: bone.handedness.as_str(),
        });
        Self {
            file,
            up: measurement.up.to_array().map(rounded),
            forward: measurement.forward.to_array().map(rounded),
            bones: bones.collect(),
            clips: document
                .clips()
                .iter()
                .map(|clip| Clip { name: clip.name.clone(), seconds: clip.seconds() })
                .collect(),
        }
    }

    fn table(&self) -> String {
        let mut out = format!("{}: up {:?}, forward {:?}\n\n", self.file, self.up, self.forward);
        let width = |texts: &mut dyn Iterator<Item = usize>| texts.max().unwrap_or(0).max(4);
        let name_width = width(&mut self.bones.iter().map(|b| b.name.chars().count()));
        out += &format!("{:<name_width$}  {:<9}  up  fwd  left   off  hand\n", "bone", "role");
        for bone in &self.bones {
            out += &format!(
                "{:<name_width$}  {:<9}  {}  {}   {}   {:>4.1}°  {}\n",
                bone.name,
                bone.role.unwrap_or(""),
                bone.up,
                bone.forward,
                bone.left,
                bone.deviation_deg,
                bone.handedness
            );
        }
        out += if self.clips.is_empty() { "\nno clips\n" } else { "\nclips\n" };
        for clip in &self.clips {
            out += &format!("  {} {:.3} s\n", clip.name, clip.seconds);
        }
        out
    }
}

/// To a millionth: what is beyond is noise of the file.
fn rounded(x: f64) -> f64 {
    (x * 1e6).round() / 1e6 + 0.0
}

pub(super) fn run(arguments: &args::Inspect) -> Result {
    let document = files::load_model(&arguments.file)?;
    let inspection = Inspection::of(arguments.file.display().to_string(), &document);
    files::print(&if arguments.json { files::to_json(&inspection)? } else { inspection.table() })
}
