//! `aim bake`: aims a model over a clip and writes it back.

use std::io::IsTerminal;
use std::path::Path;
use std::time::Duration;

use aim_character::{Fit, InterpretedRig, propose};
use aim_codegen::{RigSpec, Role};
use aim_gltf::{Baked, ChainNodes, Clip, Document, Measurement, Plan};
use aim_runtime::Settings;
use glam::DVec3;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::args::{self, Aiming, Settle, Solver};
use crate::failure::{Failure, Result};
use crate::files;
use crate::html::{self, Subject};
use crate::outputs::Outputs;
use crate::report::Report;
use crate::target::{Target, TargetSpec};

/// A bake ready to run: what `bake` and `demo` share.
pub(super) struct Job<'a> {
    /// The file's name, for messages.
    pub(super) file: &'a Path,
    pub(super) document: &'a Document,
    pub(super) measurement: &'a Measurement,
    pub(super) spec: &'a RigSpec,
    pub(super) target: &'a TargetSpec,
    pub(super) clip: Option<&'a Clip>,
    pub(super) seconds: f32,
    pub(super) fps: f32,
    pub(super) aiming: Aiming,
    pub(super) settle: Settle,
    pub(super) looped: bool,
}

/// What came of it.
pub(super) struct Done {
    pub(super) model: Vec<u8>,
    pub(super) baked: Baked,
    pub(super) report: Report,
}

impl Job<'_> {
    /// Aims frame by frame, with a progress bar on a terminal.
    pub(super) fn run(&self) -> Result<Done> {
        let fail = |error: aim_gltf::Error| Failure::in_file(self.file, error);
        let skeleton = self.document.skeleton();
        let bones = self.spec.joints.iter().map(|joint| joint.bones.as_slice());
        let chain = ChainNodes::find(skeleton, bones, self.spec.joints[0].pair.as_deref()).map_err(fail)?;
        if self.aiming.both_eyes && chain.pair.is_none() {
            return Err(Failure::input(format!(
                "the rig {} has no other eye to aim; name it with pair = \"…\" on its first joint, or leave --both-eyes out",
                self.spec.name
            )));
        }
        let effector_bind =
            self.measurement.bind_world[chain.joints[0]].transform_point3(DVec3::from_array(self.spec.effector.origin));
        let target = Target::new(self.target, self.file, self.document, self.measurement, effector_bind)?;
        let (solver, solver_word) = solver(self.aiming.solver, self.spec);
        let plan = Plan {
            document: self.document,
            clip: self.clip,
            measurement: self.measurement,
            chain: &chain,
            both_eyes: self.aiming.both_eyes,
            seconds: self.seconds,
            fps: self.fps,
            settle: match self.settle {
                Settle::Snap => aim_gltf::Settle::Snap,
                Settle::Animation => aim_gltf::Settle::Animation,
            },
            looped: self.looped,
            settings: Settings::default().with_solver(solver),
        };
        let bar = progress_bar();
        let mut rig = InterpretedRig::new(self.spec);
        let baked = aim_gltf::bake(
            &mut rig,
            &plan,
            |t, world| target.at(t.into(), world),
            |done, all| {
                bar.set_length(all as u64);
                bar.set_position(done as u64);
            },
        )
        .map_err(fail)?;
        bar.finish();
        let model = self.document.with_clips(std::slice::from_ref(&baked.clip)).map_err(fail)?;
        let name = |node: usize| skeleton.nodes()[node].name.clone();
        let names: Vec<String> = chain.joints.iter().map(|&node| name(node)).collect();
        let report = Report::new(self.spec, solver_word, self.fps, &names, chain.pair.map(name), &baked);
        Ok(Done { model, baked, report })
    }

    /// The page about what came of it.
    pub(super) fn page(&self, done: &Done) -> String {
        html::page(&Subject {
            spec: self.spec,
            report: &done.report,
            document: self.document,
            measurement: self.measurement,
            baked: &done.baked,
        })
    }
}

/// The solver that was asked for, else the one that suits the rig, and its word in the report.
fn solver(asked: Option<Solver>, spec: &RigSpec) -> (aim_runtime::Solver, &'static str) {
    let usual = if spec.joints[0].role() == Role::Eye { Solver::Natural } else { Solver::Exact };
    match asked.unwrap_or(usual) {
        Solver::Natural => (aim_runtime::Solver::Natural, "natural"),
        Solver::Exact => (aim_runtime::Solver::Exact, "exact"),
        Solver::Ascent => (aim_runtime::Solver::Ascent, "ascent"),
    }
}

/// A bar on a terminal, nothing in a pipe.
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

/// Refuses to write two things to one file, over an input of another kind, and a binary file under a text file's name.
fn check_outputs(arguments: &args::Bake, document: &Document) -> Result {
    let mut outputs = Outputs::default();
    outputs.reads_parts_of(document);
    if let Some(rig) = &arguments.rig {
        outputs.reads(rig, "the rig");
    }
    if let TargetSpec::File(path) = &arguments.target {
        outputs.reads(path, "the target's path");
    }
    outputs.writes_model(&arguments.out, &arguments.file, arguments.report.as_deref(), arguments.html.as_deref())
}

/// Says what a bake goes through with although it may not be what was meant.
fn warn(arguments: &args::Bake, spec: &RigSpec, document: &Document, measurement: &Measurement) {
    if let Some(rig) = &arguments.rig {
        if let [first, rest @ ..] = &Fit::new(spec, document, measurement).problems[..] {
            let more = if rest.is_empty() { String::new() } else { format!(" (and {} more)", rest.len()) };
            let (file, rig) = (arguments.file.display(), rig.display());
            eprintln!(
                "warning: {rig} and {file} contradict each other: {first}{more}; see aim check {file} --rig {rig}"
            );
        }
    }
    if let TargetSpec::Node(name) = &arguments.target {
        let skeleton = document.skeleton();
        let name_of = |node: usize| &skeleton.nodes()[node].name;
        let is_turned = |bone: &&String| spec.joints.iter().any(|joint| joint.bones.contains(*bone));
        let turned = skeleton.find(name).ok().and_then(|node| skeleton.ancestry(node).map(name_of).find(is_turned));
        if let Some(bone) = turned {
            eprintln!(
                "warning: the target {name} moves with {bone}, which aiming turns: aimed is at where the animation alone has it"
            );
        }
    }
}

pub(super) fn run(arguments: &args::Bake) -> Result {
    let document = files::load_model(&arguments.file)?;
    check_outputs(arguments, &document)?;
    let measurement = Measurement::of(&document);
    let spec = match &arguments.rig {
        Some(path) => files::load_rig(path)?,
        None => propose(&document, &measurement, None).map_err(|error| Failure::in_file(&arguments.file, error))?.spec,
    };
    warn(arguments, &spec, &document, &measurement);
    let fail = |error: aim_gltf::Error| Failure::in_file(&arguments.file, error);
    let clip = match &arguments.clip {
        Some(name) => Some(document.clip(name).map_err(fail)?),
        None => document.clips().first(),
    };
    let seconds = match (arguments.seconds, clip) {
        (Some(seconds), _) => seconds,
        (None, Some(clip)) if clip.seconds() > 0.0 => clip.seconds(),
        (None, Some(clip)) => {
            return Err(Failure::in_file(
                &arguments.file,
                format!("its clip {:?} has no length; say how long to aim with --seconds", clip.name),
            ));
        }
        (None, None) => {
            return Err(Failure::in_file(
                &arguments.file,
                "has no clip to aim over; say how long to aim with --seconds",
            ));
        }
    };
    let job = Job {
        file: &arguments.file,
        document: &document,
        measurement: &measurement,
        spec: &spec,
        target: &arguments.target,
        clip,
        seconds,
        fps: arguments.fps,
        aiming: arguments.aiming,
        settle: arguments.settle,
        looped: arguments.looped,
    };
    let done = job.run()?;
    let report = arguments.report.as_ref().map(|_| files::to_json(&done.report)).transpose()?;
    let page = arguments.html.as_ref().map(|_| job.page(&done));
    let mut written = vec![(arguments.out.as_path(), &done.model[..])];
    written.extend(arguments.report.as_deref().zip(report.as_ref().map(String::as_bytes)));
    written.extend(arguments.html.as_deref().zip(page.as_ref().map(String::as_bytes)));
    files::write_all(&written)?;
    files::print(&format!("{}\n", done.report.in_words(&arguments.out)))
}
