//! [`Stage`]: an animated character, its target, and the solvers that aim it, advanced frame by frame.

use std::cell::OnceCell;
use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use aim::rigs::Mannequin;
use aim_animation::{Clip, Ray};
use aim_character::{AimedFrame, InterpretedRig, Live, Moment};
use aim_codegen::Role;
use aim_runtime::glam::Vec3;
use aim_runtime::{AimRig, DynAim};
use web_time::Instant;

use crate::actor::{Actor, SharedRig};
use crate::character::Character;
use crate::feet::{Feet, Slope};
use crate::held::Lamp;
use crate::player::{Play, Player, Repertoire};
use crate::pointed::Pointed;
use crate::target::{Path, Room, Target};
use crate::timing::Timing;
use crate::tools::{Tools, Try};
use crate::tuning::Tuning;

/// Longest time step of a frame, seconds. Time beyond that is dropped.
pub(crate) const LONGEST: f32 = 0.1;
/// Time step of a single step, and of every frame when frames are counted, seconds.
pub(crate) const SIXTIETH: f32 = 1.0 / 60.0;
/// Number of frames kept for the plots and the trail.
const REMEMBERED: usize = 600;
/// Distance between characters, metres of a 1.7 m character.
const APART: f32 = 1.15;

/// Playback state of the animation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Clock {
    pub(crate) play: Play,
    /// Animation time since the clip was started, seconds.
    pub(crate) time: f32,
    /// Speed of the animation and of the target's path: 1 is real time.
    pub(crate) speed: f32,
    pub(crate) paused: bool,
    /// `true` to advance the next frame by 1/60 s although the animation is paused.
    pub(crate) step: bool,
}

/// Values of a past frame, for the plots and the trail.
#[derive(Clone, Debug)]
pub(crate) struct Memory {
    /// Time of the frame, seconds.
    pub(crate) t: f64,
    /// Error of each actor, degrees.
    pub(crate) error_deg: Vec<f64>,
    /// Added heading and pitch of each joint of the first actor, degrees.
    pub(crate) angles_deg: Vec<[f64; 2]>,
    /// Position of the target, world space.
    pub(crate) target: Vec3,
}

/// The state of the scene.
#[derive(Debug)]
pub(crate) struct Stage {
    pub(crate) character: Character,
    pub(crate) tuning: Tuning,
    pub(crate) target: Target,
    pub(crate) clock: Clock,
    pub(crate) actors: Vec<Actor>,
    /// Further characters, behind the first actor, that look at its target.
    pub(crate) crowd: Vec<Actor>,
    /// The rig with its present settings.
    rig: Arc<InterpretedRig>,
    pub(crate) memory: VecDeque<Memory>,
    pub(crate) timing: Timing,
    /// `true` if every frame advances by the same time, so that there is no frame rate to show.
    pub(crate) counts_frames: bool,
    repertoire: Repertoire,
    /// The hit under the mouse pointer, while boxes are shown.
    pub(crate) pointed: Option<Pointed>,
    /// `true` to slope the floor and plant feet on it.
    pub(crate) is_sloped: bool,
    pub(crate) slope: Slope,
    /// Initial state of the feet, cloned for each character; `None` if no feet were found.
    pub(crate) feet: Option<Feet>,
    /// The lamp of the right hand; `None` if no hand was found.
    pub(crate) lamp: Option<Lamp>,
    /// Created when a tool is first used.
    tools: OnceCell<Tools>,
    live: Live,
    live_is_for_both_eyes: bool,
    /// Total time of all frames, seconds.
    age: f64,
}

impl Stage {
    /// Creates a stage with a character and a target.
    ///
    /// # Errors
    /// If the rig's bones do not form a chain in the character.
    pub(crate) fn new(character: Character) -> Result<Self, String> {
        let tuning = Tuning::new(&character);
        let rig = Arc::new(InterpretedRig::new(&tuning.spec));
        let live = Live::new(&*rig, &character.document, &character.measurement, &character.chain, tuning.both_eyes)
            .map_err(|error| format!("{}: {error}", character.name))?;
        let clip = character.document.default_clip().and_then(|clip| character.clip(clip.name()).ok());
        let mut stage = Self {
            target: Target::new(&room(&character)),
            repertoire: Repertoire::new(&character),
            is_sloped: false,
            slope: Slope::new(&character),
            feet: Feet::new(&character),
            lamp: Lamp::new(&character),
            pointed: None,
            tools: OnceCell::new(),
            clock: Clock {
                play: Play { clip, over: None, fade_s: 0.3, in_place: false },
                time: 0.0,
                speed: 1.0,
                paused: false,
                step: false,
            },
            live_is_for_both_eyes: tuning.both_eyes,
            actors: Vec::new(),
            crowd: Vec::new(),
            rig,
            memory: VecDeque::new(),
            timing: Timing::default(),
            counts_frames: false,
            age: 0.0,
            character,
            tuning,
            live,
        };
        // Run a frame of zero duration, so that everything that is shown exists.
        stage.advance(0.0);
        stage.memory.clear();
        Ok(stage)
    }

    pub(crate) fn room(&self) -> Room {
        room(&self.character)
    }

    /// Returns the current position of the target, world space.
    pub(crate) fn target_now(&self) -> Vec3 {
        self.target.at(&self.room())
    }

    /// Returns the result of the first actor's last frame.
    pub(crate) fn first(&self) -> Option<&AimedFrame> {
        self.actors.first()?.frame.as_ref()
    }

    /// Stores the hit of a ray with the figures, until the next call.
    pub(crate) fn point_at(&mut self, ray: Option<Ray>) {
        self.pointed = ray.and_then(|ray| Pointed::new(&self.character, &self.actors, &ray));
    }

    /// Returns the offset of each character from its position in the file.
    pub(crate) fn shifts(&self) -> impl Iterator<Item = Vec3> {
        self.actors.iter().map(|actor| actor.shift).chain(self.crowd.iter().map(|member| member.shift))
    }

    /// Returns the index of the aimed joint; 0 is the rig's effector.
    pub(crate) fn effector(&self) -> usize {
        self.tuning.settings.effector
    }

    /// Restarts the clip and the target's path, with the joints at rest.
    pub(crate) fn restart(&mut self) {
        self.seek(0.0);
        self.target.time = 0.0;
        self.actors.iter_mut().for_each(|actor| actor.character.reset());
        self.crowd.clear();
        self.memory.clear();
    }

    /// Sets all characters to a time of the clip, seconds.
    pub(crate) fn seek(&mut self, time: f32) {
        let length = self.clip_length();
        self.clock.time = time;
        self.actors.iter_mut().chain(&mut self.crowd).for_each(|actor| actor.player.seek(time, length));
    }

    /// Returns the length of the current clip, seconds; 0 for the rest pose.
    pub(crate) fn clip_length(&self) -> f32 {
        let clip = self.clock.play.clip.and_then(|clip| self.character.clips().get(clip));
        clip.map_or(0.0, Clip::length_s)
    }

    /// Switches the effector between the eyes and the neck.
    pub(crate) fn switch_effector(&mut self) {
        let joints = &self.tuning.spec.joints;
        let neck = joints.iter().skip(1).position(|joint| matches!(joint.role, Role::Neck | Role::Head));
        let other = neck.map_or(usize::from(joints.len() > 1), |at| at + 1);
        self.tuning.settings.effector = if self.effector() == 0 { other } else { 0 };
    }

    /// Returns the origins and directions of the gazes of a frame: those of both eyes, or of the joint that is aimed
    /// instead.
    fn gazes(&self, frame: &AimedFrame) -> Vec<[Vec3; 2]> {
        let gazes = self.live.gazes(self.effector(), &frame.world);
        gazes.into_iter().map(|gaze| gaze.map(|v| v.as_vec3())).collect()
    }

    /// Advances by `seconds` of real time.
    pub(crate) fn advance(&mut self, seconds: f32) {
        Timing::note(&mut self.timing.between, seconds.into());
        let dt = match (self.clock.paused, std::mem::take(&mut self.clock.step)) {
            (true, false) => 0.0,
            (true, true) => SIXTIETH,
            (false, _) => seconds.min(LONGEST),
        };
        self.recast();
        let animated = dt * self.clock.speed;
        self.clock.time += animated;
        if self.target.path != Path::Still {
            self.target.time += animated;
        }
        let target = self.target_now();
        let (mut actors, mut crowd) = (std::mem::take(&mut self.actors), std::mem::take(&mut self.crowd));
        let taken: Vec<Duration> = actors.iter_mut().map(|actor| self.aim(actor, target, dt)).collect();
        let taken_by_crowd: Duration = crowd.iter_mut().map(|actor| self.aim(actor, target - actor.shift, dt)).sum();
        (self.actors, self.crowd) = (actors, crowd);
        // Frames of zero duration are not timed, because they cost a solver little.
        if dt > 0.0 {
            taken.iter().for_each(|taken| Timing::note(&mut self.timing.one, taken.as_secs_f64()));
            if !self.crowd.is_empty() {
                Timing::note(&mut self.timing.crowd, taken_by_crowd.as_secs_f64());
            }
            self.remember(target, dt);
        }
    }

    /// Aims a character for a frame, and returns the time that the solver took.
    fn aim(&self, actor: &mut Actor, target: Vec3, dt: f32) -> Duration {
        let skeleton = self.character.skeleton();
        let settings = self.tuning.settings(actor.solver);
        let play = self.clock.play;
        let mut pose = actor.player.advance(&self.character, &self.repertoire, play, dt * self.clock.speed);
        let clip = play.clip.and_then(|clip| self.character.clips().get(clip));
        let seconds = actor.player.time();
        if !self.is_sloped {
            actor.feet = None;
        } else if let Some(template) = &self.feet {
            let feet = actor.feet.get_or_insert_with(|| template.clone());
            // Cannot fail: the pose has the skeleton's length.
            let _ = feet.apply(&self.slope, actor.shift, dt * self.clock.speed, &mut pose);
        }
        self.live.pose_morph_eyes(clip, seconds, &mut pose);
        let world = skeleton.world_f64(&pose);
        let joints = self.live.animated(&mut pose, &world);
        let start = Instant::now();
        let outcome = actor.character.aim(&joints.pose(), target, dt, &settings);
        let mut taken = start.elapsed();
        let effector = settings.effector;
        let moment = Moment { t: 0.0, target: target.as_dvec3(), world: &world, joints: &joints, outcome, effector };
        let mut frame = self.live.aimed(&actor.character, skeleton, &mut pose, &moment);
        actor.gazes = self.gazes(&frame);
        actor.tool = self.tuning.tool;
        if let Some(tool) = actor.tool {
            let tools = self.tools.get_or_init(|| Tools::new(&self.character, &self.rig, &self.live));
            let start = Instant::now();
            let tried = tools.apply(&self.character, Try { tool, target, dt }, &mut pose, &mut actor.head);
            taken = start.elapsed();
            frame.world = skeleton.world_f64(&pose);
            (frame.error_deg, frame.outcome.status) = (tried.error_deg, tried.status);
            actor.gazes = tried.gazes;
        } else {
            actor.head = None;
        }
        let eyes = self.live.morph_weights(clip, seconds, &pose);
        actor.posed.matrices = self.character.skinning.matrices(&frame.world);
        actor.posed.morphs = self.character.skinning.morphs(clip.map(|clip| (clip, seconds)), eyes);
        actor.frame = Some(frame);
        taken
    }

    /// Adapts actors and rigs to the tuning.
    fn recast(&mut self) {
        let tuning = &self.tuning;
        let is_alone = tuning.crowd > 1 || tuning.tool.is_some();
        let solvers = if is_alone { tuning.lineup.solvers()[..1].to_vec() } else { tuning.lineup.solvers() };
        if !self.actors.iter().map(|actor| actor.solver).eq(solvers.iter().copied()) {
            let [_, _, left] = self.character.directions();
            let middle = (count(solvers.len()) - 1.0) / 2.0;
            let old = std::mem::take(&mut self.actors);
            for (at, &solver) in solvers.iter().enumerate() {
                let known = old.iter().find(|actor| actor.solver == solver).or(old.first());
                let player = known.map_or_else(|| Player::new(&self.character, 0.0), |actor| actor.player.clone());
                let character =
                    known.map_or_else(|| DynAim::new(self.rig.clone() as SharedRig), |actor| actor.character.clone());
                // From left to right, as seen from in front.
                let shift = left * ((count(at) - middle) * APART * self.character.metre());
                self.actors.push(Actor::new(solver, shift, player, character));
            }
            self.memory.clear();
        }
        if *self.rig.spec() != self.tuning.spec {
            Arc::make_mut(&mut self.rig).declare(&self.tuning.spec);
            self.actors.iter_mut().for_each(|actor| actor.change_rig(self.rig.clone()));
            let rig = self.crowd_rig();
            self.crowd.iter_mut().for_each(|actor| actor.change_rig(rig.clone()));
        }
        let both_eyes = self.tuning.both_eyes;
        if both_eyes != self.live_is_for_both_eyes {
            let Character { document, measurement, chain, .. } = &self.character;
            // Cannot fail: the bones formed a chain before.
            if let Ok(live) = Live::new(&*self.rig, document, measurement, chain, both_eyes) {
                self.live = live;
            }
            self.live_is_for_both_eyes = both_eyes;
        }
        self.gather();
    }

    /// Returns the crowd's rig: the compiled one if the settings are as declared, otherwise the interpreted one.
    fn crowd_rig(&self) -> SharedRig {
        let is_compiled = self.character.is_mannequin && self.tuning.spec == *self.character.spec();
        if is_compiled { Arc::new(Mannequin::RIG) } else { self.rig.clone() }
    }

    /// Adapts the crowd to the number in the tuning, in rows behind the first actor.
    fn gather(&mut self) {
        let solver = self.actors[0].solver;
        self.crowd.iter_mut().for_each(|actor| actor.solver = solver);
        let others = self.tuning.crowd.saturating_sub(1);
        if others == self.crowd.len() {
            return;
        }
        let [_, forward, left] = self.character.directions();
        let metre = self.character.metre();
        let rows = ROW.min(others.max(1));
        let rig = self.crowd_rig();
        self.crowd.truncate(others);
        for at in self.crowd.len()..others {
            let (player, character) = (Player::new(&self.character, count(at) * 0.37), DynAim::new(rig.clone()));
            self.crowd.push(Actor::new(solver, Vec3::ZERO, player, character));
        }
        for (at, actor) in self.crowd.iter_mut().enumerate() {
            // Places fill outward from the middle, row by row. The first place is the actor's.
            let (row, column) = ((at + 1) / rows, (at + 1) % rows);
            let aside = count(column.div_ceil(2)) * if column % 2 == 0 { 1.0 } else { -1.0 };
            actor.shift = (left * aside - forward * count(row)) * (APART * metre);
        }
        self.timing.crowd = 0.0;
    }

    fn remember(&mut self, target: Vec3, dt: f32) {
        self.age += f64::from(dt);
        let degrees = |rad: f32| f64::from(rad).to_degrees();
        self.memory.push_back(Memory {
            t: self.age,
            error_deg: self.actors.iter().filter_map(|actor| Some(actor.frame.as_ref()?.error_deg)).collect(),
            angles_deg: self.first().map_or_else(Vec::new, |frame| {
                frame.joints.iter().map(|joint| [degrees(joint.heading), degrees(joint.pitch)]).collect()
            }),
            target,
        });
        while self.memory.len() > REMEMBERED {
            self.memory.pop_front();
        }
    }
}

/// Number of characters in a row of the crowd.
const ROW: usize = 10;

fn room(character: &Character) -> Room {
    Room { centre: character.effector(), directions: character.directions(), metre: character.metre() }
}

#[expect(clippy::cast_precision_loss, reason = "small counts")]
fn count(n: usize) -> f32 {
    n as f32
}
