//! Writes the mannequin in a convention of your choice: `mannequin OUT.glb [--moves] [--vrm0|--vrm1] [UP FORWARD LEFT]` with axes
//! such as `+X -Z +Y`. `aim inspect OUT.glb` measures them again.

use std::error::Error;

use aim_character::{Mannequin, PAPER_AXES, Vrm};
use aim_gltf::write_file;

fn main() -> Result<(), Box<dyn Error>> {
    let mut file = Mannequin::new();
    let mut words = Vec::new();
    for argument in std::env::args().skip(1) {
        match argument.as_str() {
            "--moves" => file = file.with_moves(),
            "--vrm0" => file = file.with_vrm(Vrm::V0),
            "--vrm1" => file = file.with_vrm(Vrm::V1),
            _ => words.push(argument),
        }
    }
    match &words[..] {
        [out] => Ok(write_file(out, &file.glb(|_| PAPER_AXES)?)?),
        [out, up, forward, left] => {
            let axes = [axis(up)?, axis(forward)?, axis(left)?];
            Ok(write_file(out, &file.glb(|_| axes)?)?)
        }
        _ => Err("give OUT.glb [--moves] [--vrm0|--vrm1] [UP FORWARD LEFT]".into()),
    }
}

fn axis(text: &str) -> Result<[f32; 3], String> {
    let mut axis = [0.0; 3];
    let (sign, letter) = text.split_at(text.len().min(1));
    let index = ["X", "Y", "Z"].iter().position(|l| *l == letter).ok_or(format!("{text} is none of ±X, ±Y, ±Z"))?;
    axis[index] = if sign == "-" { -1.0 } else { 1.0 };
    Ok(axis)
}
