//! The report of `aim reach`: targets, trajectory and frames, and a summary in words.

use aim_animation::Clip;
use aim_character::{Arrival, ReachPlan, Reached};
use aim_gltf::Document;
use aim_runtime::glam::DVec3;
use aim_runtime::ik::TwoBoneStatus;
use aim_runtime::trajectory::Status;
use serde::Serialize;
use serde_json::{Value, json};

use crate::words::tiny;

/// Content of `--report`; the command's help describes it.
#[derive(Debug, Serialize)]
pub(crate) struct ReachReport {
    pub(crate) clip: String,
    pub(crate) bone: String,
    pub(crate) limb: [String; 3],
    pub(crate) fps: f32,
    pub(crate) length: f64,
    pub(crate) targets: Vec<TargetReport>,
    trajectory: Value,
    pub(crate) frames: Vec<ReachFrame>,
    pub(crate) summary: ReachSummary,
}

#[derive(Debug, Serialize)]
pub(crate) struct TargetReport {
    pub(crate) at: f32,
    pub(crate) target: [f64; 3],
    pub(crate) aimed: [f64; 3],
    pub(crate) status: &'static str,
    pub(crate) error: f64,
}

#[derive(Debug, Serialize)]
pub(crate) struct ReachFrame {
    pub(crate) t: f32,
    pub(crate) before: [f64; 3],
    pub(crate) wanted: [f64; 3],
    pub(crate) after: [f64; 3],
    pub(crate) status: &'static str,
}

#[derive(Debug, Serialize)]
pub(crate) struct ReachSummary {
    pub(crate) frames: usize,
    pub(crate) reached: usize,
    pub(crate) stretched: usize,
    pub(crate) max_error: f64,
}

/// Largest distance from a target at which it counts as reached, in lengths of the limb.
const REACHED: f64 = 1e-4;

impl ReachFrame {
    /// Returns the distance of the written bone from the deformed trajectory, in the file's units.
    pub(crate) fn error(&self) -> f64 {
        DVec3::from(self.after).distance(self.wanted.into())
    }

    /// Returns the distance of the written bone from its original place, in the file's units.
    pub(crate) fn moved(&self) -> f64 {
        DVec3::from(self.after).distance(self.before.into())
    }
}

impl ReachReport {
    /// Returns the largest distance from a target at which it counts as reached, in the file's units.
    pub(crate) fn tolerance(&self) -> f64 {
        REACHED * self.length
    }

    /// Creates the report from `clip` in `written`, the model as it was written, so that the report describes the file.
    pub(crate) fn new(bone: &str, plan: &ReachPlan<'_>, reached: &Reached, written: &Document, clip: &Clip) -> Self {
        let limb = plan.limb;
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
        let frames = reached.frames.iter().map(|frame| ReachFrame {
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
        Self {
            clip: reached.clip.name().to_owned(),
            bone: bone.to_owned(),
            limb: [limb.upper, limb.lower, limb.tip].map(|node| skeleton.names()[node].clone()),
            fps: plan.fps,
            length: reached.length,
            summary: ReachSummary {
                frames: frames.len(),
                reached: targets.iter().filter(|target| target.status == "reached").count(),
                stretched: frames.iter().filter(|frame| frame.status == "stretched").count(),
                max_error: frames.iter().map(ReachFrame::error).fold(0.0, f64::max),
            },
            targets,
            trajectory: json!({
                "status": match reached.outcome.status {
                    Status::Met => "met",
                    Status::Unsettled => "unsettled",
                    Status::Missed => "missed",
                    _ => "degenerate",
                },
                "evaluations": reached.outcome.evaluations,
                "gradient": reached.outcome.gradient,
                "distortion": reached.outcome.distortion * reached.length * reached.length,
            }),
            frames,
        }
    }

    /// Returns the result for each target and for the limb, one sentence per line.
    pub(crate) fn in_words(&self) -> String {
        let mut words = String::new();
        for target in &self.targets {
            let [x, y, z] = target.aimed;
            words += &match target.status {
                "reached" => format!("{} reaches its target at {} s", self.bone, target.at),
                too => format!(
                    "{} cannot reach its target at {} s, which is {}: the closest it gets is {} away, at {x:.4},{y:.4},{z:.4}",
                    self.bone,
                    target.at,
                    too.replace('_', " "),
                    tiny(target.error, "")
                ),
            };
            words += "\n";
        }
        if self.summary.stretched > 0 {
            words += &format!(
                "In {} of {} frames the path is out of reach, and the limb is stretched towards it\n",
                self.summary.stretched, self.summary.frames
            );
        }
        words
    }
}
