//! [`Sample`]: the size of a measurement and the solver's settings; [`Scene`] and helpers that the measurements share.

use aim::glam::{Affine3A, Vec3};
use aim::{Behind, DynAim, Outcome, Pose, Rig, Settings};

use super::model::{Angles, Model};
use super::workload::Motion;

/// Sample size and solver settings of a measurement.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Divisor of the number of cases: 16 keeps one case in sixteen.
    pub thinned: usize,
    /// The solver and its settings.
    pub settings: Settings,
}

/// Frame rates at which the requirements must hold, frames a second.
pub const FRAME_RATES: [f32; 3] = [30.0, 60.0, 144.0];

impl Sample {
    /// Returns a number of cases divided by [`Sample::thinned`], rounded up.
    pub fn of(&self, count: usize) -> usize {
        count.div_ceil(self.thinned)
    }

    /// Returns the settings without a policy for targets behind, as the definitions of the paper and of the optimum
    /// assume.
    pub fn plain(&self) -> Settings {
        self.settings.with_behind(Behind::Off)
    }
}

/// Returns the number of frames that last at least `seconds`.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
pub fn frames(seconds: f64, hz: f32) -> usize {
    (seconds * f64::from(hz)).ceil() as usize
}

/// A rig with its current pose and target.
#[derive(Clone, Debug)]
pub struct Scene<R> {
    /// The character.
    pub rig: DynAim<R>,
    /// Transforms of the joints, from the effector inward, in the pose's space.
    pub pose: Vec<Affine3A>,
    /// The target in the pose's space.
    pub target: Vec3,
}

impl<R: Rig> Scene<R> {
    /// Creates a character at rest with this pose and target.
    pub fn new(rig: R, pose: &[Affine3A], target: Vec3) -> Self {
        let joints = rig.description().joints().len();
        Self { rig: DynAim::new(rig), pose: pose[..joints].to_vec(), target }
    }

    /// Runs one frame.
    pub fn step(&mut self, dt: f32, settings: &Settings) -> Outcome {
        self.rig.aim(&Pose::new(self.pose.as_slice()), self.target, dt, settings)
    }

    /// Runs a number of frames.
    pub fn run(&mut self, frames: usize, dt: f32, settings: &Settings) {
        for _ in 0..frames {
            self.step(dt, settings);
        }
    }

    /// Returns the reference model of the rig in its current pose.
    pub fn model(&self) -> Model {
        Model::new(&self.rig.rig, &self.pose)
    }

    /// Returns the current angles.
    pub fn angles(&self, model: &Model) -> Angles {
        model.read(&self.rig.state.joints)
    }

    /// Returns the angle between the corrected gaze and the target, radians, as a user sees it.
    pub fn remaining(&self, model: &Model) -> f64 {
        model.seen_remaining(self.rig.corrections(), self.target.as_dvec3())
    }

    /// Takes over the pose and the target of a motion at time `t`, seconds.
    pub fn follow(&mut self, motion: &Motion, t: f32) {
        let pose = motion.body.at(t);
        let joints = self.pose.len();
        self.pose.copy_from_slice(&pose[..joints]);
        self.target = motion.path.at(t);
    }
}

/// Returns the largest difference between two sets of angles, radians. Unlimited headings are compared modulo a full
/// turn.
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
