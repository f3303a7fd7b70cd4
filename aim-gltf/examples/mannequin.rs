//! Writes the mannequin in a convention of your choice, and what is measured of any file.
//!
//! `mannequin OUT.glb [UP FORWARD LEFT]` with axes such as `+X -Z +Y`, or `mannequin --measure FILE...`.

use std::error::Error;

use aim_gltf::{Channel, Clip, Document, Measurement, PAPER_AXES, mannequin, write_file};
use glam::Quat;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match &arguments[..] {
        [flag, files @ ..] if flag == "--measure" => files.iter().try_for_each(|file| measure(file)),
        [flag, input, output] if flag == "--repeat" => repeat(input, output),
        [out] => Ok(write_file(out, &mannequin(|_| PAPER_AXES)?)?),
        [out, up, forward, left] => {
            let axes = [axis(up)?, axis(forward)?, axis(left)?];
            Ok(write_file(out, &mannequin(|_| axes)?)?)
        }
        _ => Err("give OUT.glb [UP FORWARD LEFT], --measure FILE..., or --repeat IN OUT.glb".into()),
    }
}

fn axis(text: &str) -> Result<[f32; 3], String> {
    let mut axis = [0.0; 3];
    let (sign, letter) = text.split_at(text.len().min(1));
    let index = ["X", "Y", "Z"].iter().position(|l| *l == letter).ok_or(format!("{text} is none of ±X, ±Y, ±Z"))?;
    axis[index] = if sign == "-" { -1.0 } else { 1.0 };
    Ok(axis)
}

fn measure(file: &str) -> Result<(), Box<dyn Error>> {
    let document = Document::load(file).map_err(|e| format!("{file}: {e}"))?;
    let measured = Measurement::of(&document);
    println!("{file}: faces {:.3}, {:.3} high, by {:?}", measured.forward, measured.height, measured.evidence);
    for bone in &measured.bones {
        let role = bone.role.map_or("", |role| role.as_str());
        let [up, forward, left] = bone.deviations_deg;
        println!(
            "  {:28} {role:9} up {} {up:4.1}  forward {} {forward:4.1}  left {} {left:4.1}  {}",
            bone.name,
            bone.up,
            bone.forward,
            bone.left,
            bone.handedness.as_str()
        );
    }
    for clip in document.clips() {
        println!("  clip {} of {:.3} s", clip.name, clip.seconds());
    }
    Ok(())
}

/// The first clip two and a half times as long, and a still one, written beside what the file has.
fn repeat(input: &str, output: &str) -> Result<(), Box<dyn Error>> {
    let document = Document::load(input).map_err(|e| format!("{input}: {e}"))?;
    let still = Clip::new("still", vec![Channel::rotation(0, [0.0].into(), &[Quat::IDENTITY])]);
    let mut clips = vec![still];
    if let Some(first) = document.clips().first() {
        let mut long = first.repeated(first.seconds() * 2.5);
        long.name.push_str(" again");
        clips.push(long);
    }
    Ok(write_file(output, &document.with_clips(&clips)?)?)
}
