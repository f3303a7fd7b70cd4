//! `aim bake`: aims a model over a clip and writes the result.

use std::io::IsTerminal;
use std::time::Duration;

use aim_animation::{Clip, Gap, Seam};
use aim_character::{
    AimedFrame, Error, InterpretedRig, Live, Measurement, MendedLoop, Plan, Plausibility, chain_nodes, hold,
    mended_loop, propose,
};
use aim_codegen::RigSpec;
use aim_gltf::Document;
use aim_runtime::{DynAim, Rig, Settings, Solver};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::args::{self, SOLVERS};
use crate::bake_report::{BakeReport, Reported};
use crate::baked_reduction::Gaze;
use crate::effector::Effector;
use crate::failure::{Failure, Result};
use crate::files;
use crate::html::{self, BakePage};
use crate::outputs::Outputs;
use crate::plausibility;
use crate::target::TargetSpec;
use crate::warnings::{self, Warnings};

pub(super) fn run(arguments: &args::Bake) -> Result {
    let document = files::load_model(&arguments.file)?;
    let path = if let TargetSpec::File(path) = &arguments.target { Some(path) } else { None };
    let read = [(arguments.rig.as_ref(), "the rig"), (path, "the target path")];
    Outputs::reading(read).reading_parts_of(&document).write_model(arguments.written.targets(), &arguments.file)?;
    let measurement = arguments.facing.measure(&arguments.file, &document)?;
    let mut spec = match &arguments.rig {
        Some(path) => files::load_rig(path)?,
        None => {
            let proposal = propose(&document, &measurement, None);
            let spec = proposal.map_err(|error| Failure::in_file(&arguments.file, error))?.spec;
            let stem = arguments.file.file_stem().map(|stem| stem.to_string_lossy().into_owned());
            RigSpec { name: stem.unwrap_or(spec.name), ..spec }
        }
    };
    if let Some(names) = &arguments.hold {
        let names = if names[..] == ["none"] { &[][..] } else { names };
        hold(&mut spec, document.skeleton(), names).map_err(|error| Failure::in_file(&arguments.file, error))?;
    }
    bake(arguments, &document, &measurement, &spec)
}

/// Aims the document over its clip, with a progress bar on a terminal, and writes the requested files.
pub(super) fn bake(arguments: &args::Bake, document: &Document, measurement: &Measurement, spec: &RigSpec) -> Result {
    let file = &arguments.file;
    let mut warnings = Warnings::default();
    warnings.add(warnings::mismatch(arguments, spec, document, measurement));
    let clip = match &arguments.clip {
        Some(name) => Some(document.clip(name).map_err(Failure::of(file))?),
        None => document.default_clip(),
    };
    if let (None, Some(clip), [_, _, ..]) = (&arguments.clip, clip, document.clips()) {
        warnings.add(Some(format!(
            "{} has {} clips; using {:?}; choose another with --clip (`aim inspect` lists them)",
            arguments.file.display(),
            document.clips().len(),
            clip.name()
        )));
    }
    let unknown_length =
        |what: &str| Err(Failure::in_file(&arguments.file, format!("{what}; set the length with --seconds")));
    let seconds = match (arguments.seconds, clip) {
        (Some(seconds), _) => seconds,
        (None, Some(clip)) if clip.length_s() > 0.0 => clip.length_s(),
        (None, Some(clip)) => return unknown_length(&format!("clip {:?} has no length", clip.name())),
        (None, None) => return unknown_length("no clip to aim over"),
    };
    warnings.add(clip.and_then(|clip| warnings::repeated_travel(arguments, document, measurement, clip, seconds)));
    let mended = match clip.filter(|_| arguments.looped) {
        Some(clip) => {
            mended_for(seconds, clip, |clip| mended_loop(document, measurement, clip).map_err(Failure::of(file)))?
        }
        None => None,
    };
    let skeleton = document.skeleton();
    let chain = chain_nodes(spec, skeleton).map_err(Failure::of(file))?;
    let effector = match &arguments.effector {
        Some(word) => Effector::named(word, spec, skeleton, &chain)?,
        None => Effector::of(spec, 0),
    };
    let both_eyes = arguments.aiming.both_eyes;
    if both_eyes && chain.other_eye.is_none() {
        return Err(Failure::input(format!(
            "the rig {} declares no other eye; set other_eye = \"…\" on its first joint, or omit --both-eyes",
            spec.name
        )));
    }
    if let (true, 1.., Some(word)) = (both_eyes, effector.joint, &arguments.effector) {
        return Err(Failure::input(format!(
            "--both-eyes conflicts with --effector {word}, which leaves the eyes at rest; omit one of the two"
        )));
    }
    let aimed = chain.joints[effector.joint];
    let effector_bind = measurement.bind_world[aimed].transform_point3(effector.ray.origin.into());
    let target_node = match &arguments.target {
        TargetSpec::Node(name) => Some(skeleton.find(name).map_err(Failure::of(file))?),
        _ => None,
    };
    let eyes = chain.other_eye.filter(|_| both_eyes).into_iter().chain([aimed]);
    if let Some(node) = target_node.filter(|node| eyes.clone().any(|eye| eye == *node)) {
        let name = &skeleton.names()[node];
        return Err(no_target(name, &format!("{name} itself is aimed and cannot look at itself")));
    }
    let target = arguments.target.resolve(&arguments.file, document, measurement, effector_bind)?;
    let mut character = DynAim::new(InterpretedRig::new(spec));
    let usual = character.rig.description().default_solver();
    let solver = arguments.aiming.solver.map_or(usual, |solvers| solvers[0]);
    for (option, is_given) in [("--attention", arguments.attention > 0.0), ("--patience", arguments.patience.is_some())]
    {
        let is_unused = is_given && solver != Solver::Natural;
        warnings.add(is_unused.then(|| format!("{option} has no effect; only the natural solver uses it")));
    }
    let plan = Plan {
        document,
        clip: mended.as_ref().or(clip),
        measurement,
        chain: &chain,
        both_eyes,
        seconds,
        fps: arguments.fps,
        settle: arguments.settle,
        looped: arguments.looped,
        settings: Settings::default()
            .with_solver(solver)
            .with_effector(effector.joint)
            .with_weight(arguments.weight)
            .with_attention(arguments.attention)
            .with_behind(arguments.behind)
            .with_patience(arguments.patience.unwrap_or(f32::INFINITY)),
        target_node,
    };
    let live = Live::new(&character.rig, document, measurement, &chain, both_eyes).map_err(Failure::of(file))?;
    let moving = plan.target_node.filter(|&node| live.looks_with(skeleton, node, effector.joint));
    let moving = moving.map(|node| skeleton.names()[node].as_str());
    warnings.add(
        moving.map(|name| {
            format!("the target {name} moves with the gaze; aiming at its position in the animation alone")
        }),
    );
    let held: Vec<usize> = live.held().collect();
    let bar = progress_bar();
    let progress = |done, all| {
        bar.set_length(all as u64);
        bar.set_position(done as u64);
    };
    let mut baked =
        aim_character::bake(&mut character, &plan, |t, world| target(t.into(), world), progress).map_err(|error| {
            match error {
                Error::Clip(_) => Failure::in_file(file, format!("{error}; change --seconds or --fps")),
                _ => Failure::in_file(file, error),
            }
        })?;
    bar.finish();
    if let Some(node) = target_node {
        let is_here = |frame: &AimedFrame| {
            let [eye, _] = live.gazes(effector.joint, &frame.world)[0];
            eye.distance(frame.world[node].translation) <= HERE * measurement.height
        };
        if baked.frames.iter().all(is_here) {
            let (name, aimed) = (&skeleton.names()[node], &skeleton.names()[aimed]);
            return Err(no_target(name, &format!("{name} is at the place of {aimed}, which is aimed, in every frame")));
        }
    }
    if !both_eyes && effector.joint == 0 && arguments.weight >= 1.0 {
        warnings.add(warnings::parallel_eyes(&live, skeleton, &chain, &baked.frames));
    }
    let name = arguments.name.clone().unwrap_or_else(|| name_beside(clip, document.clips()));
    baked.clip = baked.clip.with_name(name);
    let write = |new: &Clip| document.with_clip_like(new, clip.map(Clip::name)).map_err(Failure::of(file));
    let mut model = write(&baked.clip)?;
    let mut reduction = None;
    if let Some(tolerance) = arguments.reduce {
        let gaze = Gaze { document, measurement, effector, chain: &chain };
        let left = gaze.reduced(&baked.clip, tolerance).map_err(|error| Failure::in_file(file, error))?;
        let smaller = write(&left)?;
        let (told, error) = gaze.told(&baked, tolerance, [&model, &smaller]).map_err(Failure::of(file))?;
        error.check(file, baked.clip.name(), tolerance)?;
        (baked.clip, model, reduction) = (left, smaller, Some(told));
    }
    let word = SOLVERS.iter().find(|(known, ..)| known[0] == solver).map_or("", |(_, word, _)| word);
    let written = Document::from_bytes(&model).map_err(Failure::of(file))?;
    let report = BakeReport::new(Reported {
        spec,
        effector,
        solver: word,
        fps: arguments.fps,
        weight: arguments.weight,
        over: clip.map_or("the rest pose", Clip::name),
        replaces: document.clips().iter().any(|known| known.name() == baked.clip.name()),
        skeleton,
        chain: &chain,
        held: &held,
        baked: &baked,
        warnings: warnings.0,
        reduction,
        plausibility: Plausibility::measure(&character.rig, &plan, &baked, &written).map_err(Failure::of(file))?,
    });
    let subject = BakePage { spec, report: &report, document, measurement, source: plan.clip, baked: &baked };
    arguments.written.targets().write(&model, &report, || html::page(&subject))?;
    files::print(&format!("{}\n", report.in_words(&arguments.written.out)))?;
    for page in [&arguments.written.report, &arguments.written.html].into_iter().flatten() {
        files::print(&format!("wrote {}\n", page.display()))?;
    }
    if arguments.strict { plausibility::insist(&report, moving, &arguments.written.out) } else { Ok(()) }
}

/// Distance between the effector and a target node below which they are at one place, as a share of the height.
const HERE: f64 = 1e-4;

/// Returns the failure for a target node that gives no direction.
fn no_target(name: &str, problem: &str) -> Failure {
    Failure::input(format!("--target node:{name}: {problem}; choose a node away from it, such as a hand or a prop"))
}

/// Returns the clip as a loop of this many seconds, and prints each seam that `mend` mended. `None` if it loops
/// already.
///
/// A loop of whole repetitions needs only the clip itself to be mended. Any other length is cut out of the clip,
/// repeated if it is too short, and the new seam is mended as well.
fn mended_for(seconds: f32, clip: &Clip, mend: impl Fn(&Clip) -> Result<Option<MendedLoop>>) -> Result<Option<Clip>> {
    let mended = |piece: &Clip, problem: &str| -> Result<Option<Clip>> {
        let Some(MendedLoop { clip, seam, .. }) = mend(piece)? else { return Ok(None) };
        files::print(&format!("{problem}: {}\n", in_words(&seam)))?;
        Ok(Some(clip))
    };
    // Tolerance for the number of repetitions, because lengths are rounded.
    const NONE: f32 = 1e-4;
    let name = clip.name();
    let rounds = seconds / clip.length_s();
    let has_round = rounds >= 1.0 - NONE;
    let round = if has_round { mended(clip, &format!("{name:?} does not loop"))? } else { None };
    let is_whole = has_round && (rounds - rounds.round()).abs() <= NONE;
    // Nothing can be cut out of a clip without a length, or for no length.
    if is_whole || !(rounds > 0.0 && rounds.is_finite()) {
        return Ok(round);
    }
    let piece = round.as_ref().unwrap_or(clip).repeated(seconds);
    Ok(mended(&piece, &format!("{seconds} s of {name:?} do not loop"))?.or(round))
}

/// Describes the seam that was mended.
fn in_words(seam: &Seam) -> String {
    let Gap { translation, rotation_rad, .. } = seam.place;
    format!(
        "the end was off the beginning by {translation:.3} units and {:.1}°, and by {:.3} units/s and {:.1}°/s in speed; mended",
        rotation_rad.to_degrees(),
        seam.speed.translation,
        seam.speed.rotation_rad.to_degrees()
    )
}

/// Returns a name for the result of aiming over `clip`, different from those of the `known` clips.
fn name_beside(clip: Option<&Clip>, known: &[Clip]) -> String {
    let name = clip.map_or_else(|| "aim".to_owned(), |clip| format!("{}_aimed", clip.name()));
    let is_free = |name: &String| known.iter().all(|clip| clip.name() != name);
    let numbered = (2_u32..).map(|number| format!("{name}{number}"));
    std::iter::once(name.clone()).chain(numbered).find(is_free).unwrap_or(name)
}

/// Returns a progress bar, hidden if standard error is not a terminal.
fn progress_bar() -> ProgressBar {
    let target =
        if std::io::stderr().is_terminal() { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
    let bar = ProgressBar::with_draw_target(None, target);
    if let Ok(style) = ProgressStyle::with_template("aiming {bar:40} {pos}/{len} frames") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(100));
    bar
}
