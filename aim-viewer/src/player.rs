//! [`Player`]: what a character does by itself: a clip, perhaps another one on its upper body, and the way from one to the next.

use aim_animation::{Blender, Clip, Control, Cursor, Inertia, Mask, Motion, Root, RootPath, Transform, Transition};
use aim_character::Role;

use crate::character::Character;

/// Longest transition from one clip to another, seconds.
pub(crate) const LONGEST_FADE: f32 = 2.0;
/// Samples of a root's way, a second.
const ROOT_HZ: f32 = 30.0;

/// Clips to be played, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Play {
    /// `None` is the rest pose.
    pub(crate) clip: Option<usize>,
    /// The clip of the upper body, if it has one of its own.
    pub(crate) over: Option<usize>,
    /// Length of the transition from one clip to another, seconds.
    pub(crate) fade_s: f32,
    /// True to leave out the movement of the root.
    pub(crate) in_place: bool,
}

/// Facts of a character that all who play its clips share.
#[derive(Debug)]
pub(crate) struct Repertoire {
    /// All that hangs on the innermost joint of the rig.
    upper_body: Mask,
    /// The steady movement of each clip's root; `None` of a clip without length.
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

/// One character that plays.
#[derive(Clone, Debug)]
pub(crate) struct Player {
    /// Clips that were played last.
    last: Option<Play>,
    control: Control,
    over: Control,
    inertia: Inertia,
    /// The last two poses, the older one first, and the time between them.
    shown: [Vec<Transform>; 2],
    dt_s: f32,
    /// Seconds by which it is ahead of the others.
    phase: f32,
}

impl Player {
    pub(crate) fn new(character: &Character, phase: f32) -> Self {
        let skeleton = character.skeleton();
        let rest = || skeleton.rest().to_vec();
        let (control, inertia) = (Control::new(), Inertia::new(skeleton));
        Self { last: None, control, over: control, inertia, shown: [rest(), rest()], dt_s: 0.0, phase }
    }

    /// Seconds since the beginning of the clip.
    pub(crate) fn time(&self) -> f32 {
        self.control.time_s()
    }

    /// Goes to a time of the clip, the phase aside.
    pub(crate) fn seek(&mut self, time: f32, length: f32) {
        self.control.seek(if length > 0.0 { (time + self.phase) % length } else { 0.0 });
    }

    /// Goes on by `dt` seconds of the animation, and tells the pose.
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
            // Of equal lengths.
            let _ = self.inertia.begin(&transition);
        }
        self.control.advance(dt, length(play.clip));
        self.over.advance(dt, length(play.over));
        self.inertia.advance(dt);
        let mut pose = self.sample(character, shared, play);
        // Of equal lengths.
        let _ = self.inertia.apply(&mut pose);
        if dt > 0.0 {
            self.shown.rotate_left(1);
            self.shown[1].clone_from(&pose);
            self.dt_s = dt;
        }
        pose
    }

    /// The pose without what a transition has left.
    fn sample(&self, character: &Character, shared: &Repertoire, play: Play) -> Vec<Transform> {
        let skeleton = character.skeleton();
        let mut pose = skeleton.rest().to_vec();
        if let Some(clip) = play.clip.and_then(|clip| character.clips().get(clip)) {
            clip.sample(self.control.time_s(), &mut Cursor::default(), &mut pose);
        }
        // All slices are of equal lengths.
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
