//! [`Player`]: the animation of a character: a clip, optionally another on the upper body, and transitions between
//! clips.

use aim_animation::{Blender, Clip, Control, Cursor, Inertia, Mask, Motion, Root, RootPath, Transform, Transition};
use aim_character::Role;

use crate::character::Character;

/// Longest transition from one clip to another, seconds.
pub(crate) const LONGEST_FADE: f32 = 2.0;
/// Sampling rate of the root's path, Hz.
const ROOT_HZ: f32 = 30.0;

/// The clips to play, and playback options.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Play {
    /// Index of the clip; `None` for the rest pose.
    pub(crate) clip: Option<usize>,
    /// Index of a separate clip for the upper body, if any.
    pub(crate) over: Option<usize>,
    /// Duration of the transition from one clip to another, seconds.
    pub(crate) fade_s: f32,
    /// `true` to remove the movement of the root.
    pub(crate) in_place: bool,
}

/// Data of a character that all its players share.
#[derive(Debug)]
pub(crate) struct Repertoire {
    /// The rig's innermost joint and its descendants.
    upper_body: Mask,
    /// Average movement of each clip's root; `None` for a clip of length 0.
    motions: Vec<Option<Motion>>,
}

impl Repertoire {
    pub(crate) fn new(character: &Character) -> Self {
        let skeleton = character.skeleton();
        let innermost = character.chain.joints[character.chain.joints.len() - 1];
        let hips = character.measurement.with_role(Role::Hips).map(|bone| bone.node);
        let bone = hips.or_else(|| skeleton.ancestry(innermost).last()).unwrap_or(innermost);
        let [up, ..] = character.directions();
        let motion = |clip: &Clip| {
            let path = RootPath::new(clip, skeleton, Root::Shadow { bone, up }, ROOT_HZ).ok()?;
            Some(Motion::linear(&path))
        };
        Self { upper_body: Mask::subtree(skeleton, innermost), motions: character.clips().iter().map(motion).collect() }
    }
}

/// The playback state of one character.
#[derive(Clone, Debug)]
pub(crate) struct Player {
    /// The clips and options of the last call; `None` before the first.
    last: Option<Play>,
    control: Control,
    over: Control,
    inertia: Inertia,
    /// The last two poses, the older one first.
    shown: [Vec<Transform>; 2],
    /// Time between the last two poses, seconds.
    dt_s: f32,
    /// Offset of the playback time, by which characters of a crowd differ, seconds.
    phase: f32,
}

impl Player {
    pub(crate) fn new(character: &Character, phase: f32) -> Self {
        let skeleton = character.skeleton();
        let rest = || skeleton.rest().to_vec();
        let (control, inertia) = (Control::new(), Inertia::new(skeleton));
        Self { last: None, control, over: control, inertia, shown: [rest(), rest()], dt_s: 0.0, phase }
    }

    /// Returns the time since the beginning of the clip, seconds.
    pub(crate) fn time(&self) -> f32 {
        self.control.time_s()
    }

    /// Sets the time within the clip, to which the phase is added.
    pub(crate) fn seek(&mut self, time: f32, length: f32) {
        self.control.seek(if length > 0.0 { (time + self.phase) % length } else { 0.0 });
    }

    /// Advances the animation by `dt` seconds and returns the pose.
    pub(crate) fn advance(
        &mut self,
        character: &Character,
        shared: &Repertoire,
        play: Play,
        dt: f32,
    ) -> Vec<Transform> {
        let clip = |at: Option<usize>| at.and_then(|at| character.clips().get(at));
        let length = |at: Option<usize>| clip(at).map_or(0.0, Clip::length_s);
        let before = self.last.replace(play);
        let changes = before.is_some_and(|before| (before.clip, before.over) != (play.clip, play.over));
        if before.is_none_or(|before| before.clip != play.clip) {
            self.seek(0.0, length(play.clip));
        }
        if before.is_none_or(|before| before.over != play.over) {
            self.over.seek(0.0);
        }
        if changes {
            let next = self.sample(character, shared, play);
            let [older, newer] = &self.shown;
            let transition =
                Transition { shown: [older, newer], next: [&next, &next], dt_s: self.dt_s, length_s: play.fade_s };
            // Cannot fail: all slices have the skeleton's length.
            let _ = self.inertia.begin(&transition);
        }
        self.control.advance(dt, length(play.clip));
        self.over.advance(dt, length(play.over));
        self.inertia.advance(dt);
        let mut pose = self.sample(character, shared, play);
        // Cannot fail: all slices have the skeleton's length.
        let _ = self.inertia.apply(&mut pose);
        if dt > 0.0 {
            self.shown.rotate_left(1);
            self.shown[1].clone_from(&pose);
            self.dt_s = dt;
        }
        pose
    }

    /// Returns the pose of the clips, without the offset of a transition in progress.
    fn sample(&self, character: &Character, shared: &Repertoire, play: Play) -> Vec<Transform> {
        let skeleton = character.skeleton();
        let mut pose = skeleton.rest().to_vec();
        if let Some(clip) = play.clip.and_then(|clip| character.clips().get(clip)) {
            clip.sample(self.control.time_s(), &mut Cursor::default(), &mut pose);
        }
        // Cannot fail here and below: all slices have the skeleton's length.
        if let Some(motion) = play.clip.filter(|_| play.in_place).and_then(|clip| shared.motions.get(clip)?.as_ref()) {
            let _ = motion.remove(self.control.time_s(), skeleton, &mut pose);
        }
        if let Some(over) = play.over.and_then(|clip| character.clips().get(clip)) {
            let mut other = skeleton.rest().to_vec();
            over.sample(self.over.time_s(), &mut Cursor::default(), &mut other);
            let _ = Blender::new(skeleton).with_mask(&shared.upper_body).blend(&mut pose, &other, 1.0);
        }
        pose
    }
}
