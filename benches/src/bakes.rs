//! Plausibility of bakes: characters with automatically proposed rigs aim at targets that move, stand aside, behind and
//! overhead, and the written clips are measured.

use aim::glam::DVec3;
use aim::{DynAim, Settings};
use aim_character::{Criterion, InterpretedRig, Measurement, Plan, Plausibility, Settle, bake, chain_nodes, propose};
use aim_gltf::Document;

use crate::solver::row::{Row, number};

/// Heading (to the left) and elevation of a target, degrees, as a function of time in seconds.
type Course = fn(f64) -> [f64; 2];

/// The bakes: name, length in seconds, distance of the target in metres for a character 1.7 m tall, and the target's
/// course.
const BAKES: [(&str, f32, f64, Course); 7] = [
    ("orbit", 10.0, 3.0, |t| [36.0 * t, 0.0]),
    ("10° and back", 4.5, 5.0, |t| [if (1.5..3.0).contains(&t) { 10.0 } else { 0.0 }, 0.0]),
    ("30° and back", 4.5, 5.0, |t| [if (1.5..3.0).contains(&t) { 30.0 } else { 0.0 }, 0.0]),
    ("60° and back", 4.5, 5.0, |t| [if (1.5..3.0).contains(&t) { 60.0 } else { 0.0 }, 0.0]),
    ("95° and back", 4.5, 5.0, |t| [if (1.5..3.0).contains(&t) { 95.0 } else { 0.0 }, 0.0]),
    ("150°", 4.5, 5.0, |t| [if t < 1.5 { 0.0 } else { 150.0 }, 0.0]),
    ("overhead", 4.5, 5.0, |t| [0.0, if t < 1.5 { 0.0 } else { 90.0 }]),
];

/// Returns the worst value of each criterion over all bakes of a character's default clip, with the name of the bake
/// that has it.
///
/// # Errors
/// Fails if the character has no chain or nothing that can be baked.
pub fn looks(name: &str, document: &Document) -> Result<Vec<Row>, String> {
    let measured =
        BAKES.iter().map(|bake| Ok((bake.0, measure(document, bake).map_err(|error| format!("{name}: {error}"))?)));
    let measured: Vec<(&str, Plausibility)> = measured.collect::<Result<_, String>>()?;
    Ok(Criterion::ALL.into_iter().map(|criterion| row(name, criterion, &measured)).collect())
}

fn row(name: &str, criterion: Criterion, measured: &[(&str, Plausibility)]) -> Row {
    let what = format!("{name}: {}", criterion.key());
    let must = measured.first().and_then(|(_, first)| criterion.must(first.is_humanoid));
    let all = measured.iter().filter_map(|(bake, looks)| Some((bake, looks.worst(criterion)?)));
    let Some((bake, worst)) = all.max_by(|(_, a), (_, b)| a.value.total_cmp(&b.value)) else {
        return Row {
            what,
            must: must.map_or("–".to_owned(), |must| format!("≤ {}", number(must))),
            measured: "–".to_owned(),
            held: None,
        };
    };
    let row = match must {
        Some(must) => Row::at_most(what, must, "", worst.value),
        None => Row::shown(what, "", worst.value),
    };
    row.noting(&format!("{bake}, {:.2} s", worst.t))
}

fn measure(
    document: &Document,
    &(_, seconds, metres, course): &(&str, f32, f64, Course),
) -> Result<Plausibility, String> {
    let measurement = &Measurement::of(document);
    let spec = propose(document, measurement, None).map_err(|error| error.to_string())?.spec;
    let chain = &chain_nodes(&spec, document.skeleton()).map_err(|error| error.to_string())?;
    let eye = measurement.bind_world[chain.joints[0]].transform_point3(spec.effector.origin.into());
    let target = |t: f32, _: &[_]| -> DVec3 {
        let &Measurement { forward, left, up, .. } = measurement;
        let [(sin, cos), (above, level)] = course(t.into()).map(|degrees| degrees.to_radians().sin_cos());
        eye + ((forward * cos + left * sin) * level + up * above) * (metres * measurement.metre())
    };
    let plan = Plan {
        document,
        clip: document.default_clip(),
        measurement,
        chain,
        both_eyes: false,
        seconds,
        fps: 60.0,
        settle: Settle::Snap,
        looped: false,
        settings: Settings::default(),
        target_node: None,
    };
    let mut character = DynAim::new(InterpretedRig::new(&spec));
    let mut measured = || -> Result<Plausibility, aim_character::Error> {
        let baked = bake(&mut character, &plan, target, |_, _| {})?;
        let written = Document::from_bytes(&document.with_clips(std::slice::from_ref(&baked.clip))?)?;
        Plausibility::measure(&character.rig, &plan, &baked, &written)
    };
    measured().map_err(|error| error.to_string())
}
