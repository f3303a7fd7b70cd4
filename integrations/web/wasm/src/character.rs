//! [`Character`]: aims a character, frame by frame.

use std::sync::Arc;

use aim::animation::{AimFrame, Corrections, Transform};
use aim::glam::{Affine3A, Vec3};
use aim::{Behind, DynAim, Rig, Settings, Status, Target, Targets};

use crate::Found;
use crate::bones::{LOCAL, affine, transform};

/// Layout of the block that a character shares with JavaScript: offsets in `f32`s from its start.
pub mod layout {
    /// World matrix of the root bones' parent: 16 numbers, column-major.
    pub const PLACE: usize = 0;
    /// [`weight`](aim::Settings::weight), [`attention`](aim::Settings::attention), [`patience`](aim::Settings::patience),
    /// [`tolerance`](aim::Settings::tolerance), and [`behind`](aim::Settings::behind) as a number.
    pub const SETTINGS: usize = 16;
    /// The status as a number; the remaining angle and the required turn of the body, radians; and the time for which
    /// the target has been out of reach, seconds.
    pub const OUTCOME: usize = 24;
    /// The targets: for each, a point in world space and a weight.
    pub const TARGETS: usize = 32;
    /// Greatest number of targets.
    pub const MOST_TARGETS: usize = 16;
    /// The bones' local transforms, ten numbers each: animated before an update, aimed after it.
    pub const BONES: usize = TARGETS + 4 * MOST_TARGETS;
}

/// A character that aims.
pub struct Character {
    found: Found,
    aim: DynAim<Arc<dyn Rig>>,
    frame: AimFrame,
    /// The bones that an update writes: joints, the other eye, and held bones.
    written: Vec<usize>,
    /// Local transforms of the bones as animated, without corrections.
    animated: Vec<Transform>,
    /// Local transforms of the bones with this frame's corrections.
    aimed: Vec<Transform>,
    model: Vec<Affine3A>,
    /// Local transforms of each written bone at the last update: animated and aimed.
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
    /// Creates a character in its rest pose.
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

    /// Returns the block of inputs and outputs: see [`layout`]. The heading and pitch of each joint follow the bones,
    /// radians.
    pub fn block(&mut self) -> &mut [f32] {
        &mut self.block
    }

    /// Returns, for each bone of the block, its index in [`Bones`](crate::Bones).
    #[must_use]
    pub fn bones(&self) -> &[usize] {
        &self.found.bones
    }

    /// Returns the bones of the block that an update writes.
    #[must_use]
    pub fn written(&self) -> &[usize] {
        &self.written
    }

    /// Returns the bone of each joint, as an index into the bones of the block, from the effector inward.
    #[must_use]
    pub fn joints(&self) -> &[usize] {
        self.found.chain.joints()
    }

    /// Returns the name of a joint; empty if it does not exist.
    #[must_use]
    pub fn joint_name(&self, joint: usize) -> &str {
        self.found.rig.joint_name(joint).unwrap_or_default()
    }

    /// Aims for a frame of `dt` seconds at the first `targets` targets of the block. With `snap`, rates are ignored.
    /// Reads the bones of the block as animated and replaces them by the aimed ones.
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
        // Cannot fail here or below: all slices have the skeleton's length.
        let _ = chain.skeleton().to_model(&self.aimed, &mut self.model);
        self.frame.place = affine(&self.block[layout::PLACE..layout::SETTINGS]).unwrap_or(Affine3A::IDENTITY);
        let _ = chain.gather(&mut self.frame, &mut self.aimed, &mut self.model);
        // Weighted targets that are not finite are ignored. If none is finite, pass one as a point: the solver then
        // reports a degenerate call and keeps the angles, instead of returning to the animation.
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

    /// Removes the corrections from those bones of the block that still have them. The angles stay, so that the next
    /// update continues from them.
    pub fn restore(&mut self) {
        self.read();
        for (memory, &bone) in self.memory.iter_mut().zip(&self.written) {
            *memory = [self.animated[bone]; 2];
            write(&mut self.block, bone, &self.animated[bone]);
        }
    }

    /// Reads the bones as animated. A value that still equals the last written one was not animated since, so the
    /// stored animated value is used; otherwise corrections would accumulate.
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

/// Writes a bone's translation and rotation to the block.
fn write(block: &mut [f32], bone: usize, Transform { translation, rotation, .. }: &Transform) {
    let at = &mut block[layout::BONES + LOCAL * bone..];
    at[..3].copy_from_slice(&translation.to_array());
    at[3..7].copy_from_slice(&rotation.to_array());
}
