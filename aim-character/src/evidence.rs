//! Where a character faces and what told it, in words.

use aim_gltf::{Clue, Document, Evidence, Measurement};
use glam::DVec3;

/// A direction: `+Z`, or three numbers where it is no axis.
pub fn direction(v: DVec3) -> String {
    let axis = aim_gltf::SignedAxis::of(v);
    if axis.vector().distance(v) < 1e-3 {
        axis.to_string()
    } else {
        let [x, y, z] = v.to_array().map(|c| (c * 100.0).round() / 100.0 + 0.0);
        format!("({x:.2}, {y:.2}, {z:.2})")
    }
}

/// One sentence: facing, up, and what agrees on it.
pub fn facing(measurement: &Measurement, document: &Document) -> String {
    let agree: Vec<String> =
        measurement.evidence.iter().filter(|said| said.agrees).map(|said| clue(said, document)).collect();
    format!("Faces {}, up is {}, by {}.", direction(measurement.forward), direction(measurement.up), agree.join(", "))
}

/// A sentence for each clue that says otherwise.
pub fn against(measurement: &Measurement, document: &Document) -> Vec<String> {
    let against = measurement.evidence.iter().filter(|said| !said.agrees);
    against
        .map(|said| {
            let (what, says) = match (said.up, said.forward) {
                (Some(up), _) => ("up is", up),
                (None, forward) => ("forward is", forward.unwrap_or(DVec3::ZERO)),
            };
            format!("{} would have it that {what} {}", clue(said, document), direction(says))
        })
        .collect()
}

fn clue(said: &Evidence, document: &Document) -> String {
    let name = |node: usize| &document.skeleton().nodes()[node].name;
    match said.clue {
        Clue::Names { left, right } => format!("the names {} and {}", name(left), name(right)),
        Clue::Limbs { one, other } => format!("the limbs {} and {}", name(one), name(other)),
        Clue::Symmetry => "the symmetry of the joints".into(),
        Clue::Legs => "the legs".into(),
        Clue::Feet => "the feet".into(),
        Clue::Soles => "the soles".into(),
        Clue::Eyes => "the eyes".into(),
        Clue::Trunk => "the trunk".into(),
        Clue::Reach { node } => format!("the reach of {}", name(node)),
        _ => "glTF's convention alone".into(),
    }
}
