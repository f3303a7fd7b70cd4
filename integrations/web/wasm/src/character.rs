//! [`Character`]: one that aims, frame by frame.

use std::sync::Arc;

use aim::animation::{AimFrame, Corrections, Transform};
use aim::glam::{Affine3A, Vec3};
use aim::{Behind, DynAim, Rig, Settings, Status, Target, Targets};

use crate::Found;
use crate::bones::{LOCAL, affine, transform};

/// Layout of the block that a character shares with JavaScript, in numbers from its start.
pub mod layout {
    /// World matrix of what the root bones hang on: 16 numbers, column-major.
    pub const PLACE: usize = 0;
    /// [`weight`](aim::Settings::weight), [`attention`](aim::Settings::attention), [`patience`](aim::Settings::patience),
    /// [`tolerance`](aim::Settings::tolerance), and [`behind`](aim::Settings::behind) as a number.
    pub const SETTINGS: usize = 16;
    /// The status as a number, the remaining angle, the turn of the body, and the seconds for which the target is out of reach.
    pub const OUTCOME: usize = 24;
    /// The targets: a point in the world and a weight each.
    pub const TARGETS: usize = 32;
    /// Targets at most.
    pub const MOST_TARGETS: usize = 16;
    /// The bones' local transforms, ten numbers each: as they are, and then as they are to be.
    pub const BONES: usize = TARGETS + 4 * MOST_TARGETS;
}

/// A character that aims.
pub struct Character {
    found: Found,
    aim: DynAim<Arc<dyn Rig>>,
    frame: AimFrame,
    /// The bones that a correction moves.
    written: Vec<usize>,
    /// The bones as animated, without corrections.
    animated: Vec<Transform>,
    /// The same with this frame's corrections.
    aimed: Vec<Transform>,
    model: Vec<Affine3A>,
    /// Each written bone before the last correction, and with it.
    memory: Vec<[Transform; 2]>,
    targets: Vec<Target>,
    block: Vec<f32>,
}

impl std::fmt::Debug for Character {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Character").field("found", &self.found).field("aimed", &self.aimed).finish_non_exhaustive()
    }
}

impl Character {
    /// A character at rest.
    #[must_use]
    pub fn new(found: &Found) -> Self {
        let chain = &found.chain;
        let rest = chain.skeleton().rest().to_vec();
        let moves = |&bone: &usize| {
            chain.joints().contains(&bone) || chain.other_eye() == Some(bone) || chain.held().any(|held| held == bone)
        };
        let written: Vec<usize> = (0..rest.len()).filter(moves).collect();
        Self {
            aim: DynAim::new(found.rig.clone()),
            frame: chain.frame(),
            memory: written.iter().map(|&bone| [rest[bone]; 2]).collect(),
            written,
            model: vec![Affine3A::IDENTITY; rest.len()],
            targets: Vec::with_capacity(layout::MOST_TARGETS),
            block: vec![0.0; layout::BONES + LOCAL * rest.len() + 2 * chain.joints().len()],
            animated: rest.clone(),
            aimed: rest,
            found: found.clone(),
        }
    }

    /// The numbers that go in and come out: see [`layout`]. Behind the bones are the heading and the pitch of each joint, radians.
    pub fn block(&mut self) -> &mut [f32] {
        &mut self.block
    }

    /// For each bone of the block its number among those that were handed over.
    #[must_use]
    pub fn bones(&self) -> &[usize] {
        &self.found.bones
    }

    /// The bones of the block that a frame moves.
    #[must_use]
    pub fn written(&self) -> &[usize] {
        &self.written
    }

    /// The bone of the block of each joint, from the effector inward.
    #[must_use]
    pub fn joints(&self) -> &[usize] {
        self.found.chain.joints()
    }

    /// The name of a joint.
    #[must_use]
    pub fn joint_name(&self, joint: usize) -> &str {
        self.found.rig.joint_name(joint).unwrap_or_default()
    }

    /// One frame of `dt` seconds, at the first `targets` of the block; with `snap` as if it had had all the time it needs. The bones
    /// of the block are read as they are and left as they are to be.
    pub fn update(&mut self, dt: f32, targets: usize, snap: bool) {
        self.read();
        self.targets.clear();
        for at in 0..targets.min(layout::MOST_TARGETS) {
            let [x, y, z, weight] = self.numbers(layout::TARGETS + 4 * at);
            self.targets.push(Target::new(Vec3::new(x, y, z), weight));
        }
        let settings = self.settings();
        let chain = &self.found.chain;
        self.aimed.copy_from_slice(&self.animated);
        // All are of this character's length.
        let _ = chain.skeleton().to_model(&self.aimed, &mut self.model);
        self.frame.place = affine(&self.block[layout::PLACE..layout::SETTINGS]).unwrap_or(Affine3A::IDENTITY);
        let _ = chain.gather(&mut self.frame, &mut self.aimed, &mut self.model);
        // Of several those that are no place are left out; if all are, there is nothing to aim at, and the angles hold.
        let targets = match self.targets.first() {
            Some(first) if !self.targets.iter().any(|target| target.point.is_finite()) => Targets::Point(first.point),
            _ => Targets::Weighted(&self.targets),
        };
        let pose = self.frame.pose();
        let outcome = match snap && !self.targets.is_empty() {
            true => self.aim.snap(&pose, targets, &settings),
            false => self.aim.aim(&pose, targets, dt, &settings),
        };
        let corrections = Corrections { joints: self.aim.corrections(), other_eye: self.aim.other_eye_correction() };
        let _ = chain.apply(&self.frame, corrections, &mut self.aimed, &mut self.model);
        for (memory, &bone) in self.memory.iter_mut().zip(&self.written) {
            *memory = [self.animated[bone], self.aimed[bone]];
            write(&mut self.block, bone, &self.aimed[bone]);
        }
        let status = match outcome.status {
            _ if self.targets.is_empty() => 0.0,
            Status::Reached => 1.0,
            Status::RateLimited => 2.0,
            Status::AtLimit => 3.0,
            Status::Behind => 4.0,
            _ => 5.0,
        };
        let remaining = if self.targets.is_empty() { 0.0 } else { outcome.remaining };
        let told = [status, remaining, outcome.body_turn, outcome.out_of_reach_for];
        self.block[layout::OUTCOME..][..told.len()].copy_from_slice(&told);
        let angles = layout::BONES + LOCAL * self.animated.len();
        for (at, joint) in self.block[angles..].chunks_exact_mut(2).zip(&self.aim.state.joints) {
            at.copy_from_slice(&[joint.heading(), joint.pitch()]);
        }
    }

    /// Takes the corrections off the bones of the block that still have them; the next frame goes on where the last one was.
    pub fn restore(&mut self) {
        self.read();
        for (memory, &bone) in self.memory.iter_mut().zip(&self.written) {
            *memory = [self.animated[bone]; 2];
            write(&mut self.block, bone, &self.animated[bone]);
        }
    }

    /// Reads the bones as they are animated: what still is as it was written has been left alone since, so that corrections do not
    /// add up.
    fn read(&mut self) {
        for (bone, animated) in self.animated.iter_mut().enumerate() {
            *animated = transform(&self.block[layout::BONES + LOCAL * bone..][..LOCAL]);
        }
        for ([base, written], &bone) in self.memory.iter().zip(&self.written) {
            let animated = &mut self.animated[bone];
            if animated.rotation == written.rotation {
                animated.rotation = base.rotation;
            }
            if animated.translation == written.translation {
                animated.translation = base.translation;
            }
        }
    }

    fn settings(&self) -> Settings {
        let [weight, attention, patience, tolerance, behind] = self.numbers(layout::SETTINGS);
        let behinds = [Behind::Clip, Behind::Off, Behind::Plane, Behind::Hold, Behind::Release];
        let chosen = (0..behinds.len()).find(|at| *at as f32 == behind);
        Settings::default()
            .with_weight(weight)
            .with_attention(attention)
            .with_patience(patience)
            .with_tolerance(tolerance)
            .with_behind(chosen.map_or(Behind::Clip, |at| behinds[at]))
    }

    fn numbers<const N: usize>(&self, at: usize) -> [f32; N] {
        std::array::from_fn(|number| self.block[at + number])
    }
}

/// Puts a bone's translation and rotation into the block.
fn write(block: &mut [f32], bone: usize, Transform { translation, rotation, .. }: &Transform) {
    let at = &mut block[layout::BONES + LOCAL * bone..];
    at[..3].copy_from_slice(&translation.to_array());
    at[3..7].copy_from_slice(&rotation.to_array());
}
