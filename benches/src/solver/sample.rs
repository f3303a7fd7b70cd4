//! [`Sample`]: how much is measured, and of which solver; and what the measurements share.

use aim::glam::{Affine3A, Vec3};
use aim::{Behind, DynAim, Outcome, Pose, Rig, Settings};

use super::model::{Angles, Model};
use super::workload::Motion;

/// What is measured.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// One case in so many.
    pub thinned: usize,
    /// The solver, and how.
    pub settings: Settings,
}

/// The frame rates that everything holds at.
pub const FRAME_RATES: [f32; 3] = [30.0, 60.0, 144.0];

impl Sample {
    /// A number of cases, thinned.
    pub fn of(&self, count: usize) -> usize {
        count.div_ceil(self.thinned)
    }

    /// The solver without a policy for targets behind: so the paper's and the optimum's words mean what they say.
    pub fn plain(&self) -> Settings {
        self.settings.with_behind(Behind::Off)
    }
}

/// A whole number of frames that last at least so long.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
pub fn frames(seconds: f64, hz: f32) -> usize {
    (seconds * f64::from(hz)).ceil() as usize
}

/// A rig in a pose and its target, for as long as neither moves.
#[derive(Clone, Debug)]
pub struct Scene<R> {
    /// The character.
    pub rig: DynAim<R>,
    /// The joints in the pose's space.
    pub pose: Vec<Affine3A>,
    /// The target in the pose's space.
    pub target: Vec3,
}

impl<R: Rig> Scene<R> {
    /// The rig in this pose.
    pub fn new(rig: R, pose: &[Affine3A], target: Vec3) -> Self {
        let joints = rig.description().joints().len();
        Self { rig: DynAim::new(rig), pose: pose[..joints].to_vec(), target }
    }

    /// One frame.
    pub fn step(&mut self, dt: f32, settings: &Settings) -> Outcome {
        self.rig.aim(&Pose::new(self.pose.as_slice()), self.target, dt, settings)
    }

    /// So many frames.
    pub fn run(&mut self, frames: usize, dt: f32, settings: &Settings) {
        for _ in 0..frames {
            self.step(dt, settings);
        }
    }

    /// The rig in its pose as the definitions have it.
    pub fn model(&self) -> Model {
        Model::new(&self.rig.rig, &self.pose)
    }

    /// The angles as they are.
    pub fn angles(&self, model: &Model) -> Angles {
        model.read(&self.rig.state.joints)
    }

    /// What a user sees: the angle between the corrected gaze and the target, radians.
    pub fn remaining(&self, model: &Model) -> f64 {
        model.seen_remaining(self.rig.corrections(), self.target.as_dvec3())
    }

    /// The pose and the target of a motion at this time.
    pub fn follow(&mut self, motion: &Motion, t: f32) {
        let pose = motion.body.at(t);
        let joints = self.pose.len();
        self.pose.copy_from_slice(&pose[..joints]);
        self.target = motion.path.at(t);
    }
}

/// The largest difference of two sets of angles, radians; headings that may turn freely within half a turn.
pub fn apart(model: &Model, a: &Angles, b: &Angles) -> f64 {
    use std::f64::consts::{PI, TAU};
    let mut largest: f64 = 0.0;
    for (i, angle) in model.angles.iter().enumerate() {
        let mut way = a[i] - b[i];
        if angle.range[0] == f64::NEG_INFINITY {
            way = (way + PI).rem_euclid(TAU) - PI;
        }
        largest = largest.max(way.abs());
    }
    largest
}
