//! Warnings of a bake: printed to standard error at once, and kept for the report and its page.

use aim_animation::Clip;
use aim_character::{AimedFrame, ChainNodes, Fit, Live, Measurement, Role};
use aim_codegen::RigSpec;
use aim_gltf::{Document, Skeleton};
use aim_runtime::Status;

use crate::args;
use crate::words::{listed, trimmed};

/// The warnings so far.
#[derive(Debug, Default)]
pub(crate) struct Warnings(pub(crate) Vec<String>);

impl Warnings {
    /// Prints and keeps a warning, if there is one.
    pub(crate) fn add(&mut self, warning: Option<String>) {
        if let Some(warning) = warning {
            eprintln!("warning: {warning}");
            self.0.push(warning);
        }
    }
}

/// Returns a warning if the given rig contradicts the file, because the result may not be what the user expects.
pub(crate) fn mismatch(
    arguments: &args::Bake,
    spec: &RigSpec,
    document: &Document,
    measurement: &Measurement,
) -> Option<String> {
    let rig = arguments.rig.as_ref()?;
    let problems = Fit::new(spec, document, measurement).problems;
    let (first, rest) = problems.split_first()?;
    let more = if rest.is_empty() { String::new() } else { format!(" (and {} more)", rest.len()) };
    let (file, rig) = (arguments.file.display(), rig.display());
    Some(format!("{rig} does not match {file}: {first}{more}; run `aim check {file} --rig {rig}`"))
}

/// Least displacement of the hips over the ground from a clip's first frame to its last that is warned of, as a share
/// of the character's height.
const TRAVEL: f64 = 0.03;
/// Largest number of times that a warning lists.
const MOST_TIMES: usize = 5;

/// Returns a warning if a bake of this many seconds repeats a clip that moves the hips over the ground: the body then
/// jumps back at each repetition.
pub(crate) fn repeated_travel(
    arguments: &args::Bake,
    document: &Document,
    measurement: &Measurement,
    clip: &Clip,
    seconds: f32,
) -> Option<String> {
    let (period, seconds) = (f64::from(clip.length_s()), f64::from(seconds));
    // The tolerance allows for rounded lengths.
    let starts = (1_u32..).map(|round| f64::from(round) * period).take_while(|t| *t < seconds - 1e-4 * period);
    let times: Vec<String> = starts.clone().take(MOST_TIMES).map(|t| trimmed(t, 2)).filter(|_| period > 0.0).collect();
    if times.is_empty() {
        return None;
    }
    let skeleton = document.skeleton();
    let hips = measurement.with_role(Role::Hips)?;
    let [begin, end] =
        [0.0, clip.length_s()].map(|t| skeleton.world_f64(&skeleton.pose(clip, t))[hips.node].translation);
    let moved = (end - begin).reject_from_normalized(measurement.up).length();
    let share = Some(moved / measurement.height).filter(|share| share.is_finite() && *share > TRAVEL)?;
    let times: Vec<&str> = times.iter().map(String::as_str).collect();
    let count = starts.count();
    let when = if count > times.len() {
        format!("{count} times, first at {} s", times[0])
    } else {
        format!("at {} s", listed(&times))
    };
    let (name, file) = (clip.name(), arguments.file.display());
    Some(format!(
        "{name:?} moves {} by {} units over the ground ({} % of the height), and the body jumps back by as much each time the \
         clip repeats ({when}); to walk on the spot, bake the result of `aim clip {file} --clip {name:?} --extract linear --out in-place.glb`",
        hips.name,
        trimmed(moved, 2),
        trimmed(100.0 * share, 0),
    ))
}

/// Angle by which the other eye may look past the target without a warning, degrees. It is that of human eyes whose
/// target is 0.45 m away, nearer than an outstretched hand.
const PAST_DEG: f64 = 8.0;

/// Returns a warning if a target comes so near that the other eye, which turns as the first one does, looks past it.
pub(crate) fn parallel_eyes(
    live: &Live,
    skeleton: &Skeleton,
    chain: &ChainNodes,
    frames: &[AimedFrame],
) -> Option<String> {
    let other = chain.other_eye?;
    let reached = frames.iter().filter(|frame| frame.outcome.status == Status::Reached);
    let past = reached.filter_map(|frame| {
        let [[own, _], [place, _]] = live.gazes(0, &frame.world)[..] else { return None };
        let deg = (frame.target - own).angle_between(frame.target - place).to_degrees();
        deg.is_finite().then_some((deg, frame.t))
    });
    let (deg, t) = past.reduce(|most, at| if at.0 > most.0 { at } else { most }).filter(|(deg, _)| *deg > PAST_DEG)?;
    let [other, own] = [other, chain.joints[0]].map(|node| &skeleton.names()[node]);
    Some(format!(
        "{other} turns as {own} does and looks up to {}° past the near target (at {} s); --both-eyes makes both eyes \
         converge on it",
        trimmed(deg, 0),
        trimmed(t.into(), 2),
    ))
}
