//! The evidence for a character's facing, in words.

use aim_gltf::Document;
use aim_runtime::glam::DVec3;

use crate::measure::clues::Clue;
use crate::measure::facing::Evidence;
use crate::measure::{Measurement, SignedAxis};

/// Formats a direction: `+Z` for an axis, otherwise three numbers.
#[must_use]
pub fn direction(v: DVec3) -> String {
    let axis = SignedAxis::of(v);
    if axis.vector().distance(v) < 1e-3 {
        axis.to_string()
    } else {
        let [x, y, z] = v.to_array().map(|c| (c * 100.0).round() / 100.0 + 0.0);
        format!("({x:.2}, {y:.2}, {z:.2})")
    }
}

/// Returns one sentence with the facing, the up direction and the clues that agree on it.
pub fn facing(measurement: &Measurement, document: &Document) -> String {
    let agree: Vec<String> =
        measurement.evidence.iter().filter(|item| item.agrees).map(|item| clue(item, document)).collect();
    format!(
        "Faces {}, up is {}, according to {}.",
        direction(measurement.forward),
        direction(measurement.up),
        agree.join(", ")
    )
}

/// Returns a sentence for each clue that contradicts the measurement.
pub fn against(measurement: &Measurement, document: &Document) -> Vec<String> {
    let against = measurement.evidence.iter().filter(|item| !item.agrees);
    against
        .map(|item| {
            let (what, says) = match (item.up, item.forward) {
                (Some(up), _) => ("up is", up),
                (None, forward) => ("forward is", forward.unwrap_or(DVec3::ZERO)),
            };
            format!("{what} {} according to {}", direction(says), clue(item, document))
        })
        .collect()
}

/// Confidence below which the facing is a guess.
pub const RELIABLE: f64 = 0.65;

/// Returns why the facing may be wrong and what to do about it; `None` if it is [reliable](RELIABLE).
#[must_use]
pub fn doubt(measurement: &Measurement) -> Option<String> {
    if measurement.confidence >= RELIABLE {
        return None;
    }
    let agrees = |clue: fn(&Clue) -> bool| measurement.evidence.iter().any(|item| item.agrees && clue(&item.clue));
    let mut why = Vec::new();
    if agrees(|clue| matches!(clue, Clue::Symmetry)) {
        why.push("only the symmetry of the joints tells left from right");
    } else if agrees(|clue| matches!(clue, Clue::Limbs { .. })) {
        why.push("no names tell left from right");
    }
    if agrees(|clue| matches!(clue, Clue::Convention)) {
        why.push("nothing tells front from back");
    } else if !agrees(|clue| matches!(clue, Clue::Names { .. } | Clue::Trunk | Clue::Eyes | Clue::Reach { .. })) {
        why.push("only the feet tell front from back");
    }
    if measurement.evidence.iter().any(|item| !item.agrees) {
        why.push("the evidence contradicts itself");
    }
    if why.is_empty() {
        why.push("there is little evidence");
    }
    Some(format!(
        "The facing is uncertain: {}. Check the drawings of `aim inspect --html`, or set the facing with --forward AXIS.",
        why.join(", ")
    ))
}

/// Returns the word for a clue in JSON.
#[must_use]
pub fn word(evidence: &Evidence) -> &'static str {
    match evidence.clue {
        Clue::Names { .. } => "names",
        Clue::Limbs { .. } => "limbs",
        Clue::Symmetry => "symmetry",
        Clue::Legs => "legs",
        Clue::Feet => "feet",
        Clue::Soles => "soles",
        Clue::Eyes => "eyes",
        Clue::Trunk => "trunk",
        Clue::Reach { .. } => "reach",
        Clue::Stated => "stated",
        _ => "convention",
    }
}

fn clue(evidence: &Evidence, document: &Document) -> String {
    let name = |node: usize| &document.skeleton().names()[node];
    match evidence.clue {
        Clue::Names { left, right } => format!("the names {} and {}", name(left), name(right)),
        Clue::Limbs { one, other } => format!("the limbs {} and {}", name(one), name(other)),
        Clue::Symmetry => "the symmetry of the joints".into(),
        Clue::Legs => "the legs".into(),
        Clue::Feet => "the feet".into(),
        Clue::Soles => "the soles".into(),
        Clue::Eyes => "the eyes".into(),
        Clue::Trunk => "the trunk".into(),
        Clue::Stated => "the stated axes".into(),
        Clue::Reach { node } => format!("the reach of {}", name(node)),
        _ => "the glTF convention alone".into(),
    }
}
