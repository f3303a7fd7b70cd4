//! `aim reach`: leads a hand or foot through points and writes the model back.

use aim_gltf::{Arrival, Clip, Document, Error, Goal, LimbNodes, Measurement, ReachPlan, Reached, reach};
use aim_runtime::ik::TwoBoneStatus;
use aim_runtime::reach::Status;
use glam::DVec3;
use serde::Serialize;

use crate::args;
use crate::failure::{Failure, Result};
use crate::files;
use crate::html::{self, Course, Takes};
use crate::outputs::Outputs;

/// What `--report` writes; the command's help says what it is.
#[derive(Debug, Serialize)]
struct Report {
    clip: String,
    bone: String,
    limb: [String; 3],
    fps: f32,
    length: f64,
    targets: Vec<TargetReport>,
    trajectory: TrajectoryReport,
    frames: Vec<FrameReport>,
    summary: Summary,
}

#[derive(Debug, Serialize)]
struct TargetReport {
    at: f32,
    target: [f64; 3],
    aimed: [f64; 3],
    status: &'static str,
    error: f64,
}

#[derive(Debug, Serialize)]
struct TrajectoryReport {
    status: &'static str,
    evaluations: usize,
    gradient: f64,
    distortion: f64,
}

#[derive(Debug, Serialize)]
struct FrameReport {
    t: f32,
    before: [f64; 3],
    wanted: [f64; 3],
    after: [f64; 3],
    status: &'static str,
}

#[derive(Debug, Serialize)]
struct Summary {
    frames: usize,
    reached: usize,
    stretched: usize,
    max_error: f64,
}

/// As near as counts as reached, of the limb's length.
const REACHED: f64 = 1e-4;

impl Report {
    /// `clip` is of `written`, the model as it was written: what the report claims is so in the file.
    fn new(arguments: &args::Reach, limb: LimbNodes, reached: &Reached, written: &Document, clip: &Clip) -> Self {
        let skeleton = written.skeleton();
        let after = |t: f32| skeleton.world_f64(&skeleton.pose(clip, t))[limb.tip].translation;
        let target = |arrival: &Arrival| {
            let error = after(arrival.goal.at).distance(arrival.goal.target);
            TargetReport {
                at: arrival.goal.at,
                target: arrival.goal.target.to_array(),
                aimed: arrival.aimed.to_array(),
                status: match arrival.reach {
                    _ if error <= REACHED * reached.length => "reached",
                    TwoBoneStatus::TooNear => "too_near",
                    _ => "too_far",
                },
                error,
            }
        };
        let targets: Vec<_> = reached.arrivals.iter().map(target).collect();
        let frames = reached.frames.iter().map(|frame| FrameReport {
            t: frame.t,
            before: frame.before.to_array(),
            wanted: frame.wanted.to_array(),
            after: after(frame.t).to_array(),
            status: match frame.status {
                TwoBoneStatus::TooFar => "stretched",
                TwoBoneStatus::TooNear => "folded",
                TwoBoneStatus::Degenerate => "degenerate",
                _ => "reached",
            },
        });
        let frames: Vec<_> = frames.collect();
        let error = |frame: &FrameReport| DVec3::from(frame.after).distance(frame.wanted.into());
        Self {
            clip: reached.clip.name.clone(),
            bone: arguments.bone.clone(),
            limb: [limb.upper, limb.lower, limb.tip].map(|node| skeleton.nodes()[node].name.clone()),
            fps: arguments.fps,
            length: reached.length,
            summary: Summary {
                frames: frames.len(),
                reached: targets.iter().filter(|target| target.status == "reached").count(),
                stretched: frames.iter().filter(|frame| frame.status == "stretched").count(),
                max_error: frames.iter().map(error).fold(0.0, f64::max),
            },
            targets,
            trajectory: TrajectoryReport {
                status: match reached.outcome.status {
                    Status::Met => "met",
                    Status::Unsettled => "unsettled",
                    Status::Missed => "missed",
                    Status::Degenerate => "degenerate",
                },
                evaluations: reached.outcome.evaluations,
                gradient: reached.outcome.gradient,
                distortion: reached.outcome.distortion * reached.length * reached.length,
            },
            frames,
        }
    }

    fn page(&self, plan: &ReachPlan<'_>, after: &Clip) -> String {
        html::trajectory_page(&Course {
            bone: &self.bone,
            clip: &self.clip,
            limb: self.limb.each_ref().map(String::as_str),
            length: self.length,
            fps: self.fps,
            words: &self.in_words(),
            frames: self
                .frames
                .iter()
                .map(|frame| html::Frame {
                    t: frame.t.into(),
                    before: frame.before.into(),
                    wanted: frame.wanted.into(),
                    after: frame.after.into(),
                    status: if frame.status == "reached" { "follows" } else { frame.status },
                })
                .collect(),
            goals: plan.goals,
            errors: self.targets.iter().map(|target| target.error).collect(),
            tolerance: REACHED * self.length,
            takes: Takes {
                document: plan.document,
                measurement: &Measurement::of(plan.document),
                limb: plan.limb,
                before: plan.clip,
                after,
            },
        })
    }

    fn in_words(&self) -> String {
        let mut words = String::new();
        for target in &self.targets {
            let [x, y, z] = target.aimed;
            words += &match target.status {
                "reached" => format!("{} is on its target at {} s", self.bone, target.at),
                too => format!(
                    "{} cannot get to its target at {} s, it is {}: it comes as near as {}, at {x:.4},{y:.4},{z:.4}",
                    self.bone,
                    target.at,
                    too.replace('_', " "),
                    html::words::tiny(target.error, "")
                ),
            };
            words += "\n";
        }
        if self.summary.stretched > 0 {
            words += &format!(
                "In {} of {} frames the way there is beyond the limb, which is stretched towards it\n",
                self.summary.stretched, self.summary.frames
            );
        }
        words
    }
}

fn check_outputs(arguments: &args::Reach, document: &Document) -> Result {
    let mut outputs = Outputs::default();
    outputs.reads_parts_of(document);
    outputs.writes_model(&arguments.out, &arguments.file, arguments.report.as_deref(), arguments.html.as_deref())
}

pub(super) fn run(arguments: &args::Reach) -> Result {
    let (times, targets) = (&arguments.at, &arguments.target);
    if times.len() != targets.len() {
        return Err(Failure::input(format!(
            "--at is given {} times and --target {} times; give both once for each point",
            times.len(),
            targets.len()
        )));
    }
    let document = files::load_model(&arguments.file)?;
    check_outputs(arguments, &document)?;
    let fail = |error: Error| Failure::in_file(&arguments.file, error);
    let clip = match &arguments.clip {
        Some(name) => document.clip(name).map_err(fail)?,
        None => document.clips().first().ok_or_else(|| {
            Failure::in_file(&arguments.file, "has no clip to change; export the character with an animation")
        })?,
    };
    let limb = LimbNodes::find(document.skeleton(), &arguments.bone).map_err(fail)?;
    let goals: Vec<Goal> = times.iter().zip(targets).map(|(&at, target)| Goal { at, target: target.0 }).collect();
    let plan = ReachPlan { document: &document, clip, limb, goals: &goals, fps: arguments.fps };
    let reached = reach(&plan).map_err(fail)?;
    let model = document.with_clips(std::slice::from_ref(&reached.clip)).map_err(fail)?;
    let written = Document::from_bytes(&model).map_err(fail)?;
    let after = written.clip(&reached.clip.name).map_err(|error| Failure::in_file(&arguments.out, error))?;
    let report = Report::new(arguments, limb, &reached, &written, after);
    let text = files::to_json(&report)?;
    let page = arguments.html.as_deref().map(|path| (path, report.page(&plan, after)));
    let mut outputs = vec![(arguments.out.as_path(), &model[..])];
    outputs.extend(arguments.report.as_deref().map(|path| (path, text.as_bytes())));
    outputs.extend(page.as_ref().map(|(path, page)| (*path, page.as_bytes())));
    files::write_all(&outputs)?;
    files::print(&format!("{}wrote {}\n", report.in_words(), arguments.out.display()))
}
