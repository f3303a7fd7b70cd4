//! [`Stage`]: a character that moves, a target, and the solvers that turn the one to the other, frame by frame.

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

/// The longest frame, seconds: what took longer is not caught up with.
pub(crate) const LONGEST: f32 = 0.1;
/// A frame where frames are counted.
pub(crate) const SIXTIETH: f32 = 1.0 / 60.0;
/// Frames remembered for the plots and the trail.
const REMEMBERED: usize = 600;
/// Distance between characters, metres of a 1.7 m one.
const APART: f32 = 1.15;

/// The animation's time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Clock {
    pub(crate) play: Play,
    /// Seconds of the animation since the clip was begun.
    pub(crate) time: f32,
    /// Speed of the animation and of the target's path: 1 is real time.
    pub(crate) speed: f32,
    pub(crate) paused: bool,
    /// True to advance the next frame by a sixtieth of a second although all is paused.
    pub(crate) step: bool,
}

/// A frame, remembered.
#[derive(Clone, Debug)]
pub(crate) struct Memory {
    /// Seconds.
    pub(crate) t: f64,
    /// Each actor's error, degrees.
    pub(crate) error_deg: Vec<f64>,
    /// The first actor's added heading and pitch, joint by joint, degrees.
    pub(crate) angles_deg: Vec<[f64; 2]>,
    /// Place of the target.
    pub(crate) target: Vec3,
}

/// All of it.
#[derive(Debug)]
pub(crate) struct Stage {
    pub(crate) character: Character,
    pub(crate) tuning: Tuning,
    pub(crate) target: Target,
    pub(crate) clock: Clock,
    pub(crate) actors: Vec<Actor>,
    /// Those who look at the first actor's target, from behind it.
    pub(crate) crowd: Vec<Actor>,
    /// The rig as it is set now.
    rig: Arc<InterpretedRig>,
    pub(crate) memory: VecDeque<Memory>,
    pub(crate) timing: Timing,
    /// True if frames are counted and not timed: then there is no frame rate to show.
    pub(crate) counts_frames: bool,
    repertoire: Repertoire,
    /// What the mouse points at, if that is asked for.
    pub(crate) pointed: Option<Pointed>,
    /// True to slope the floor and to plant feet on it.
    pub(crate) is_sloped: bool,
    pub(crate) slope: Slope,
    /// Feet as each character begins with, where they are found.
    pub(crate) feet: Option<Feet>,
    /// A lamp for the right hand, where there is one.
    pub(crate) lamp: Option<Lamp>,
    /// Found when a tool is first tried.
    tools: OnceCell<Tools>,
    live: Live,
    live_is_for_both_eyes: bool,
    /// Seconds of frames so far.
    age: f64,
}

impl Stage {
    /// A character with a target.
    ///
    /// # Errors
    /// A rig whose bones are no chain of the character.
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
        // A first frame without time: everything that is shown is there.
        stage.advance(0.0);
        stage.memory.clear();
        Ok(stage)
    }

    pub(crate) fn room(&self) -> Room {
        room(&self.character)
    }

    /// Current place of the target.
    pub(crate) fn target_now(&self) -> Vec3 {
        self.target.at(&self.room())
    }

    /// Result of the last frame of the first actor.
    pub(crate) fn first(&self) -> Option<&AimedFrame> {
        self.actors.first()?.frame.as_ref()
    }

    /// Remembers what a ray hits of the figures, until the next one.
    pub(crate) fn point_at(&mut self, ray: Option<Ray>) {
        self.pointed = ray.and_then(|ray| Pointed::new(&self.character, &self.actors, &ray));
    }

    /// Offset of each character from its place in the file.
    pub(crate) fn shifts(&self) -> impl Iterator<Item = Vec3> {
        self.actors.iter().map(|actor| actor.shift).chain(self.crowd.iter().map(|member| member.shift))
    }

    /// The aimed joint: 0 is the rig's effector.
    pub(crate) fn effector(&self) -> usize {
        self.tuning.settings.effector
    }

    /// The clip and the target's path from their beginning, joints at rest.
    pub(crate) fn restart(&mut self) {
        self.seek(0.0);
        self.target.time = 0.0;
        self.actors.iter_mut().for_each(|actor| actor.character.reset());
        self.crowd.clear();
        self.memory.clear();
    }

    /// All to a time of the clip.
    pub(crate) fn seek(&mut self, time: f32) {
        let length = self.clip_length();
        self.clock.time = time;
        self.actors.iter_mut().chain(&mut self.crowd).for_each(|actor| actor.player.seek(time, length));
    }

    /// Length of the clip that plays, seconds; 0 of the rest pose.
    pub(crate) fn clip_length(&self) -> f32 {
        let clip = self.clock.play.clip.and_then(|clip| self.character.clips().get(clip));
        clip.map_or(0.0, Clip::length_s)
    }

    /// From the eyes to the neck, and back.
    pub(crate) fn switch_effector(&mut self) {
        let joints = &self.tuning.spec.joints;
        let neck = joints.iter().skip(1).position(|joint| matches!(joint.role, Role::Neck | Role::Head));
        let other = neck.map_or(usize::from(joints.len() > 1), |at| at + 1);
        self.tuning.settings.effector = if self.effector() == 0 { other } else { 0 };
    }

    /// Starts and directions of the gazes of a frame: of both eyes, or of the other joint that is aimed.
    fn gazes(&self, frame: &AimedFrame) -> Vec<[Vec3; 2]> {
        let gazes = self.live.gazes(self.effector(), &frame.world);
        gazes.into_iter().map(|gaze| gaze.map(|v| v.as_vec3())).collect()
    }

    /// Goes on by so many seconds of real time.
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
        // A frame without time asks little of a solver.
        if dt > 0.0 {
            taken.iter().for_each(|taken| Timing::note(&mut self.timing.one, taken.as_secs_f64()));
            if !self.crowd.is_empty() {
                Timing::note(&mut self.timing.crowd, taken_by_crowd.as_secs_f64());
            }
            self.remember(target, dt);
        }
    }

    /// Aims one of them for a frame, and tells how long the solver took.
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
            // Of equal lengths.
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

    /// Has as many actors and rigs as the tuning wants.
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
                // As a row is read from in front.
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
            // It was a chain before.
            if let Ok(live) = Live::new(&*self.rig, document, measurement, chain, both_eyes) {
                self.live = live;
            }
            self.live_is_for_both_eyes = both_eyes;
        }
        self.gather();
    }

    /// Compiled code has the declared rig only: where anything of that is set otherwise, the crowd's is interpreted.
    fn crowd_rig(&self) -> SharedRig {
        let is_compiled = self.character.is_mannequin && self.tuning.spec == *self.character.spec();
        if is_compiled { Arc::new(Mannequin::RIG) } else { self.rig.clone() }
    }

    /// Has as many of the crowd as there should be, in rows behind the first.
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
            // Outward from the middle, row by row; the first place is the actor's.
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

/// Characters of a crowd in a row.
const ROW: usize = 10;

fn room(character: &Character) -> Room {
    Room { centre: character.effector(), directions: character.directions(), metre: character.metre() }
}

#[expect(clippy::cast_precision_loss, reason = "small counts")]
fn count(n: usize) -> f32 {
    n as f32
}
