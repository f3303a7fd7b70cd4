//! The report of a bake: every frame, and a summary.

use std::path::Path;

use aim_character::{AimedFrame, Baked, ChainNodes, JointFrame, Plausibility, range_in_frame};
use aim_codegen::{AngleRange, RigSpec};
use aim_gltf::Skeleton;
use aim_runtime::Status;
use serde::Serialize;

use crate::baked_reduction::BakedReduction;
use crate::effector::Effector;
use crate::plausibility;
use crate::words::Wanted;

/// Content of `--report`. Angles are in degrees.
#[derive(Debug, Serialize)]
pub(crate) struct BakeReport {
    pub(crate) rig: String,
    pub(crate) solver: &'static str,
    /// The one that was written.
    pub(crate) clip: String,
    /// The clip that was aimed over, or the rest pose.
    #[serde(skip)]
    pub(crate) over: String,
    /// True if it is written in the place of a clip of its name.
    #[serde(skip)]
    replaces: bool,
    pub(crate) fps: f32,
    /// Left out where it is whole.
    #[serde(skip_serializing_if = "is_whole")]
    pub(crate) weight: f32,
    effector: EffectorReport,
    #[serde(skip)]
    pub(crate) aimed: Effector,
    pub(crate) frames: Vec<BakeFrame>,
    pub(crate) summary: BakeSummary,
    /// How far what was written is from the frames, where keys were left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) reduction: Option<BakedReduction>,
    #[serde(serialize_with = "plausibility::block")]
    pub(crate) plausibility: Plausibility,
}

/// A bone, and a direction and a point in its local space.
#[derive(Debug, Serialize)]
struct EffectorReport {
    #[serde(flatten)]
    bone: Bone,
    forward: [f64; 3],
    origin: [f64; 3],
}

/// Subject of a report: `baked` with the rig `spec`.
pub(crate) struct Reported<'a> {
    pub(crate) spec: &'a RigSpec,
    pub(crate) effector: Effector,
    /// The word of the solver.
    pub(crate) solver: &'static str,
    pub(crate) fps: f32,
    pub(crate) weight: f32,
    /// The clip that was aimed over, or what else.
    pub(crate) over: &'a str,
    /// True if there is a clip of the written one's name.
    pub(crate) replaces: bool,
    pub(crate) skeleton: &'a Skeleton,
    pub(crate) chain: &'a ChainNodes,
    /// The nodes that are held on the trunk.
    pub(crate) held: &'a [usize],
    pub(crate) baked: &'a Baked,
    pub(crate) reduction: Option<BakedReduction>,
    /// Measured on what was written.
    pub(crate) plausibility: Plausibility,
}

#[derive(Debug, Serialize)]
pub(crate) struct BakeFrame {
    pub(crate) t: f32,
    pub(crate) target: [f64; 3],
    /// From the target.
    pub(crate) error_deg: f64,
    /// From the [goal](Wanted::Goal), where that is another direction; what the status is of.
    #[serde(skip_serializing_if = "Option::is_none")]
    goal_error_deg: Option<f64>,
    /// By how much the effector's joint is rolled about the gaze more than in the animation, positive to the left; see
    /// [`AimedFrame::roll_deg`].
    pub(crate) roll_deg: f64,
    /// The other eye's error, where both are aimed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) pair_error_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pair_goal_error_deg: Option<f64>,
    pub(crate) status: &'static str,
    pub(crate) joints: Vec<JointReport>,
    followers: Vec<Bone>,
}

impl BakeFrame {
    /// The angle from what is [`wanted`](BakeReport::wanted), degrees.
    pub(crate) fn off_deg(&self) -> f64 {
        self.goal_error_deg.unwrap_or(self.error_deg)
    }

    /// The same of the other eye.
    pub(crate) fn pair_off_deg(&self) -> Option<f64> {
        self.pair_goal_error_deg.or(self.pair_error_deg)
    }
}

/// A bone, told apart from others of its name.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Bone {
    #[serde(rename = "bone")]
    pub(crate) name: String,
    /// The node's index in the file, where the name alone does not tell which it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    node: Option<usize>,
}

impl Bone {
    fn new(skeleton: &Skeleton, node: usize) -> Self {
        let name = &skeleton.names()[node];
        let node = skeleton.nodes()[node].index.filter(|_| skeleton.named(name).count() > 1);
        Self { name: name.clone(), node }
    }
}

#[derive(Debug, Serialize)]
pub(crate) struct JointReport {
    #[serde(flatten)]
    pub(crate) bone: Bone,
    pub(crate) heading_deg: f64,
    pub(crate) pitch_deg: f64,
    pub(crate) at_limit: bool,
    pub(crate) recovering: bool,
}

#[derive(Debug, Serialize)]
pub(crate) struct BakeSummary {
    pub(crate) frames: usize,
    pub(crate) reached: usize,
    /// What is reached, and what errors that are summed up here are from; left out where that is the target.
    #[serde(skip_serializing_if = "Wanted::is_target")]
    pub(crate) of: Wanted,
    pub(crate) max_error_deg_reached: f64,
    pub(crate) max_rate_violation_deg_s: f64,
    pub(crate) max_limit_violation_deg: f64,
    /// The largest roll to either side.
    pub(crate) max_roll_deg: f64,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands out references")]
fn is_whole(weight: &f32) -> bool {
    *weight >= 1.0
}

/// The word of the contract.
pub(crate) fn status_word(status: Status) -> &'static str {
    match status {
        Status::Reached => "reached",
        Status::RateLimited => "rate_limited",
        Status::AtLimit => "at_limit",
        Status::Behind => "behind",
        _ => "degenerate",
    }
}

impl BakeReport {
    pub(crate) fn new(reported: Reported<'_>) -> Self {
        let Reported {
            spec,
            effector,
            solver,
            fps,
            weight,
            over,
            replaces,
            skeleton,
            chain,
            held,
            baked,
            reduction,
            plausibility,
        } = reported;
        let bones: Vec<Bone> = chain.joints.iter().map(|&node| Bone::new(skeleton, node)).collect();
        let followers = chain.other_eye.iter().chain(held).map(|&node| Bone::new(skeleton, node));
        let followers: Vec<Bone> = followers.collect();
        let joint = |(joint, bone): (&JointFrame, &Bone)| JointReport {
            bone: bone.clone(),
            heading_deg: f64::from(joint.heading).to_degrees(),
            pitch_deg: f64::from(joint.pitch).to_degrees(),
            at_limit: joint.at_limit,
            recovering: joint.recovering,
        };
        let goal = (Wanted::at_weight(weight) == Wanted::Goal).then_some(());
        let degrees = |radians: f32| f64::from(radians).to_degrees();
        let frames = baked.frames.iter().map(|frame| BakeFrame {
            t: frame.t,
            target: frame.target.to_array(),
            error_deg: frame.error_deg,
            goal_error_deg: goal.map(|()| degrees(frame.outcome.remaining)),
            pair_goal_error_deg: goal.and(frame.outcome.other_eye_remaining).map(degrees),
            roll_deg: frame.roll_deg,
            pair_error_deg: frame.pair_error_deg,
            status: status_word(frame.outcome.status),
            joints: frame.joints.iter().zip(&bones).map(joint).collect(),
            followers: followers.clone(),
        });
        Self {
            rig: spec.name.clone(),
            solver,
            clip: baked.clip.name().to_owned(),
            fps,
            weight,
            over: over.to_owned(),
            replaces,
            effector: EffectorReport {
                bone: bones[effector.joint].clone(),
                forward: effector.ray.frame.forward,
                origin: effector.ray.origin,
            },
            aimed: effector,
            summary: BakeSummary::new(spec, baked, Wanted::at_weight(weight)),
            frames: frames.collect(),
            reduction,
            plausibility,
        }
    }

    /// What statuses and [errors](BakeFrame::off_deg) are of.
    pub(crate) fn wanted(&self) -> Wanted {
        self.summary.of
    }

    /// The statuses that frames have, in the order of [`Wanted::statuses`]: each with their number, and in words that follow it.
    pub(crate) fn counts(&self) -> Vec<(&'static str, usize, &'static str)> {
        let count = |word: &str| self.frames.iter().filter(|frame| frame.status == word).count();
        let counts = self.wanted().statuses().map(|(word, _, after, _)| (word, count(word), after));
        counts.filter(|(_, frames, _)| *frames > 0).collect()
    }

    /// The words for a frame that is where it is wanted.
    pub(crate) fn on_it(&self) -> &'static str {
        self.wanted().statuses().find(|(word, ..)| *word == "reached").map_or("", |(_, _, after, _)| after)
    }

    /// The summary in words; `file` is what was written.
    pub(crate) fn in_words(&self, file: &Path) -> String {
        let BakeSummary { frames, reached, max_error_deg_reached, .. } = self.summary;
        let mut out = format!("wrote {}: {frames} frames of {:?} aimed by {}", file.display(), self.over, self.rig);
        if self.aimed.joint > 0 {
            out += &format!(" with the effector {:?}", self.effector.bone.name);
        }
        if self.clip != self.over || self.replaces {
            out += &format!(" as {:?}", self.clip);
        }
        if self.replaces {
            out += ", in place of the clip of that name";
        }
        out += ", ";
        out += &match reached {
            0 => format!("none of them {}", self.on_it()),
            _ => {
                let when = if self.reduction.is_some() { " before the reduction" } else { "" };
                format!("{reached} of them {} (error at most {max_error_deg_reached:.3}°{when})", self.on_it())
            }
        };
        for (_, frames, words) in self.counts().into_iter().filter(|(status, ..)| *status != "reached") {
            out += &format!(", {frames} {words}");
        }
        if let Some(reduction) = &self.reduction {
            out += &format!("\n{}", reduction.in_words());
        }
        out + "\n" + &plausibility::in_words(&self.plausibility)
    }
}

impl BakeSummary {
    fn new(spec: &RigSpec, baked: &Baked, of: Wanted) -> Self {
        let off_deg = |frame: &AimedFrame| match of {
            Wanted::Target => frame.error_deg,
            Wanted::Goal => f64::from(frame.outcome.remaining).to_degrees(),
        };
        let reached = baked.frames.iter().filter(|frame| frame.outcome.status == Status::Reached);
        Self {
            frames: baked.frames.len(),
            reached: reached.clone().count(),
            of,
            max_error_deg_reached: reached.map(off_deg).fold(0.0, f64::max),
            max_rate_violation_deg_s: rate_violation(spec, &baked.frames),
            max_limit_violation_deg: limit_violation(spec, &baked.frames),
            max_roll_deg: baked.frames.iter().map(|frame| frame.roll_deg.abs()).fold(0.0, f64::max),
        }
    }
}

/// By how much an angle's speed between two frames exceeds its rate at most, degrees a second.
fn rate_violation(spec: &RigSpec, frames: &[AimedFrame]) -> f64 {
    let mut worst: f64 = 0.0;
    for pair in frames.windows(2) {
        let seconds = f64::from(pair[1].t - pair[0].t);
        for ((joint, before), after) in spec.joints.iter().zip(&pair[0].joints).zip(&pair[1].joints) {
            let heading = change(joint.heading, before.heading, after.heading);
            let pitch = change(joint.pitch, before.pitch, after.pitch);
            worst = worst.max(heading.max(pitch) / seconds - joint.rate);
        }
    }
    worst.to_degrees()
}

fn change(range: Option<AngleRange>, before: f32, after: f32) -> f64 {
    let change = f64::from(after) - f64::from(before);
    match range {
        Some(AngleRange::Free) => {
            let turn = std::f64::consts::TAU;
            (change - turn * (change / turn).round()).abs()
        }
        _ => change.abs(),
    }
}

/// By how much an angle leaves its range at most, degrees.
fn limit_violation(spec: &RigSpec, frames: &[AimedFrame]) -> f64 {
    let all = frames.iter().flat_map(|frame| spec.joints.iter().zip(&frame.joints));
    all.flat_map(|(joint, at)| {
        let angles = [at.heading, at.pitch].map(f64::from);
        range_in_frame(joint, at).into_iter().zip(angles).map(|([lo, hi], angle)| (lo - angle).max(angle - hi))
    })
    .fold(0.0, f64::max)
    .to_degrees()
}
