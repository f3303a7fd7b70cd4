//! The report of a bake: all frames, and a summary.

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
    /// Name of the written clip.
    pub(crate) clip: String,
    /// Name of the clip that was aimed over, or "the rest pose".
    #[serde(skip)]
    pub(crate) over: String,
    /// `true` if the written clip replaces one of the same name.
    #[serde(skip)]
    replaces: bool,
    pub(crate) fps: f32,
    /// Weight of the aim; omitted from the JSON if it is 1.
    #[serde(skip_serializing_if = "is_whole")]
    pub(crate) weight: f32,
    effector: EffectorReport,
    /// Warnings, without "warning: "; omitted from the JSON if there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) warnings: Vec<String>,
    #[serde(skip)]
    pub(crate) aimed: Effector,
    pub(crate) frames: Vec<BakeFrame>,
    pub(crate) summary: BakeSummary,
    /// Errors of the written clip after keys were left out; `None` without `--reduce`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) reduction: Option<BakedReduction>,
    #[serde(serialize_with = "plausibility::block")]
    pub(crate) plausibility: Plausibility,
}

/// The effector: a bone, and a direction and an origin in its local space.
#[derive(Debug, Serialize)]
struct EffectorReport {
    #[serde(flatten)]
    bone: Bone,
    forward: [f64; 3],
    origin: [f64; 3],
}

/// Input of [`BakeReport::new`]: the bake `baked` with the rig `spec`.
pub(crate) struct Reported<'a> {
    pub(crate) spec: &'a RigSpec,
    pub(crate) effector: Effector,
    /// Name of the solver, as on the command line.
    pub(crate) solver: &'static str,
    pub(crate) fps: f32,
    pub(crate) weight: f32,
    /// Name of the clip that was aimed over, or "the rest pose".
    pub(crate) over: &'a str,
    /// `true` if the document has a clip with the name of the written one.
    pub(crate) replaces: bool,
    pub(crate) skeleton: &'a Skeleton,
    pub(crate) chain: &'a ChainNodes,
    /// Nodes that keep their place on the trunk, such as arms that hang on the neck.
    pub(crate) held: &'a [usize],
    pub(crate) baked: &'a Baked,
    pub(crate) warnings: Vec<String>,
    pub(crate) reduction: Option<BakedReduction>,
    /// Plausibility of the written model.
    pub(crate) plausibility: Plausibility,
}

#[derive(Debug, Serialize)]
pub(crate) struct BakeFrame {
    pub(crate) t: f32,
    pub(crate) target: [f64; 3],
    /// Angle between the gaze and the target, degrees.
    pub(crate) error_deg: f64,
    /// Angle between the gaze and the [goal](Wanted::Goal), degrees, which the status refers to. `None` if the target
    /// itself is wanted.
    #[serde(skip_serializing_if = "Option::is_none")]
    goal_error_deg: Option<f64>,
    /// Roll of the effector's joint about the gaze beyond that of the animation, degrees, positive to the left; see
    /// [`AimedFrame::roll_deg`].
    pub(crate) roll_deg: f64,
    /// Angle between the other eye's gaze and the target, degrees; `None` unless both eyes are aimed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) pair_error_deg: Option<f64>,
    /// Angle between the other eye's gaze and its goal, degrees; `None` unless both eyes are aimed at a goal.
    #[serde(skip_serializing_if = "Option::is_none")]
    pair_goal_error_deg: Option<f64>,
    pub(crate) status: &'static str,
    pub(crate) joints: Vec<JointReport>,
    followers: Vec<Follower>,
}

impl BakeFrame {
    /// Returns the angle between the gaze and the [wanted](BakeReport::wanted) direction, degrees.
    pub(crate) fn off_deg(&self) -> f64 {
        self.goal_error_deg.unwrap_or(self.error_deg)
    }

    /// Returns the angle between the other eye's gaze and the wanted direction, degrees; `None` unless both eyes are
    /// aimed.
    pub(crate) fn pair_off_deg(&self) -> Option<f64> {
        self.pair_goal_error_deg.or(self.pair_error_deg)
    }
}

/// A bone, identified by its name and, if several nodes share the name, its index.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Bone {
    #[serde(rename = "bone")]
    pub(crate) name: String,
    /// Index of the node in the file; `None` if the name is unique.
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

/// A bone that moves although it is no joint of the rig: the other eye, or a held bone.
#[derive(Debug, Serialize)]
struct Follower {
    #[serde(flatten)]
    bone: Bone,
    /// Angles of the other eye; `None` unless both eyes are aimed.
    #[serde(flatten)]
    angles: Option<FollowerAngles>,
}

/// Added angles, about axes parallel to those of the first joint.
#[derive(Clone, Copy, Debug, Serialize)]
struct FollowerAngles {
    heading_deg: f64,
    pitch_deg: f64,
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
    /// Direction that `reached` and the errors of this summary refer to; omitted from the JSON if it is the target.
    #[serde(skip_serializing_if = "Wanted::is_target")]
    pub(crate) of: Wanted,
    pub(crate) max_error_deg_reached: f64,
    pub(crate) max_rate_violation_deg_s: f64,
    pub(crate) max_limit_violation_deg: f64,
    /// Largest added roll to either side, degrees.
    pub(crate) max_roll_deg: f64,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands out references")]
fn is_whole(weight: &f32) -> bool {
    *weight >= 1.0
}

/// Returns the word for a status in the JSON report, which users rely on.
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
            warnings,
            reduction,
            plausibility,
        } = reported;
        let bones: Vec<Bone> = chain.joints.iter().map(|&node| Bone::new(skeleton, node)).collect();
        let followers = chain.other_eye.iter().chain(held).map(|&node| (node, Bone::new(skeleton, node)));
        let followers: Vec<(usize, Bone)> = followers.collect();
        let joint = |(joint, bone): (&JointFrame, &Bone)| JointReport {
            bone: bone.clone(),
            heading_deg: f64::from(joint.heading).to_degrees(),
            pitch_deg: f64::from(joint.pitch).to_degrees(),
            at_limit: joint.at_limit,
            recovering: joint.recovering,
        };
        let goal = (Wanted::at_weight(weight) == Wanted::Goal).then_some(());
        let degrees = |radians: f32| f64::from(radians).to_degrees();
        let follower = |frame: &AimedFrame, (node, bone): &(usize, Bone)| Follower {
            bone: bone.clone(),
            angles: frame
                .pair_angles
                .filter(|_| chain.other_eye == Some(*node))
                .map(|[heading, pitch]| FollowerAngles { heading_deg: degrees(heading), pitch_deg: degrees(pitch) }),
        };
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
            followers: followers.iter().map(|known| follower(frame, known)).collect(),
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
            warnings,
            aimed: effector,
            summary: BakeSummary::new(spec, baked, Wanted::at_weight(weight)),
            frames: frames.collect(),
            reduction,
            plausibility,
        }
    }

    /// Returns the direction that statuses and [errors](BakeFrame::off_deg) refer to.
    pub(crate) fn wanted(&self) -> Wanted {
        self.summary.of
    }

    /// Returns the statuses that occur, in the order of [`Wanted::statuses`]: each with its number of frames and the
    /// words that follow this number.
    pub(crate) fn counts(&self) -> Vec<(&'static str, usize, &'static str)> {
        let count = |word: &str| self.frames.iter().filter(|frame| frame.status == word).count();
        let counts = self.wanted().statuses().map(|(word, _, after, _)| (word, count(word), after));
        counts.filter(|(_, frames, _)| *frames > 0).collect()
    }

    /// Returns the words for frames that reached the wanted direction.
    pub(crate) fn on_it(&self) -> &'static str {
        self.wanted().statuses().find(|(word, ..)| *word == "reached").map_or("", |(_, _, after, _)| after)
    }

    /// Returns the summary in words; `file` is the path of the written model.
    pub(crate) fn in_words(&self, file: &Path) -> String {
        let BakeSummary { frames, reached, max_error_deg_reached, .. } = self.summary;
        let mut out =
            format!("wrote {}: {frames} frames of {:?}, aimed with the rig {}", file.display(), self.over, self.rig);
        if self.aimed.joint > 0 {
            out += &format!(", effector {:?}", self.effector.bone.name);
        }
        if self.clip != self.over || self.replaces {
            out += &format!(", saved as {:?}", self.clip);
        }
        if self.replaces {
            out += ", replacing the clip of that name";
        }
        out += "; ";
        out += &match reached {
            0 => format!("none {}", self.on_it()),
            _ => {
                let when = if self.reduction.is_some() { " before reduction" } else { "" };
                format!("{reached} {} (error at most {max_error_deg_reached:.3}°{when})", self.on_it())
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

/// Returns the largest excess of an angle's speed between two frames over its rate, degrees per second; 0 if there is
/// none.
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

/// Returns the change of an angle, radians, without its sign; for a free angle the shorter way around.
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

/// Returns the largest distance of an angle from its range, degrees; 0 if every angle is in its range.
fn limit_violation(spec: &RigSpec, frames: &[AimedFrame]) -> f64 {
    let all = frames.iter().flat_map(|frame| spec.joints.iter().zip(&frame.joints));
    all.flat_map(|(joint, at)| {
        let angles = [at.heading, at.pitch].map(f64::from);
        range_in_frame(joint, at).into_iter().zip(angles).map(|([lo, hi], angle)| (lo - angle).max(angle - hi))
    })
    .fold(0.0, f64::max)
    .to_degrees()
}
