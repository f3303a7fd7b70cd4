//! The character of the workloads: chest, head and eye with human proportions, in random or moving poses.

use aim::glam::{Affine3A, Mat3A, Quat, Vec3};
use aim::{AimRig, Joint, Rig};

/// One degree in radians.
pub const DEG: f64 = std::f64::consts::PI / 180.0;

/// The measured rig, declared with the derive macro: an eye on a head on a chest.
///
/// The neck's heading is not levelled. Level headings have measurements of their own; without them, forward kinematics
/// has a definition that is independent of the solvers.
#[derive(Debug, AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
pub struct Gazer {
    #[joint(role = eye, heading = -35deg..=35deg, pitch = -25deg..=25deg, rate = 8rad, stiffness = 0.5)]
    eye: Joint,
    #[joint(role = neck, heading = -60deg..=60deg, pitch = -40deg..=40deg, rate = 3rad, acceleration = 1200deg, upright = 0.0)]
    neck: Joint,
    #[joint(role = chest, heading = -20deg..=20deg, pitch = -15deg..=15deg, rate = 1.2rad, acceleration = 500deg, stiffness = 4.0)]
    spine3: Joint,
}

/// A rig of the eye alone.
#[derive(Debug, AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
pub struct EyeOnly {
    #[joint(role = eye, heading = -35deg..=35deg, pitch = -25deg..=25deg, rate = 8rad)]
    eye: Joint,
}

/// Returns the orientation of an upright bone with +X up, +Y forward, +Z left, in a world with +Y up in which the
/// character faces +Z and its left is +X.
fn upright() -> Mat3A {
    Mat3A::from_cols(Vec3::Y.into(), Vec3::Z.into(), Vec3::X.into())
}

/// Position of the chest's joint, metres.
const CHEST: Vec3 = Vec3::new(0.0, 1.37, 0.0);
/// Offset of the head's joint from the chest's, in world axes, metres.
const HEAD: Vec3 = Vec3::new(0.0, 0.23, 0.0);
/// Offset of the eye from the head's joint, in world axes, metres.
const EYE: Vec3 = Vec3::new(0.03, 0.06, 0.09);

/// Position of the eye without animation, metres.
pub const EYE_AT_REST: Vec3 = Vec3::new(0.03, 1.66, 0.09);

/// Returns the bones eye, neck, chest with these rotations added in world axes; each bone carries those further out.
pub fn posed(turns: [Quat; 3]) -> [Affine3A; 3] {
    let [eye, neck, chest] = turns;
    let spine = Affine3A::from_rotation_translation(chest, CHEST);
    let head = spine * Affine3A::from_rotation_translation(neck, HEAD);
    let eye = head * Affine3A::from_rotation_translation(eye, EYE);
    let upright = Affine3A { matrix3: upright(), translation: Vec3::ZERO.into() };
    [eye, head, spine].map(|bone| bone * upright)
}

/// Returns a random unit vector, in any direction.
pub fn direction(random: &mut fastrand::Rng) -> Vec3 {
    loop {
        let v = Vec3::from(std::array::from_fn(|_| 2.0 * random.f32() - 1.0));
        if v.length() > 0.1 && v.length() < 1.0 {
            return v.normalize();
        }
    }
}

/// Returns a random rotation of up to `degrees` about a random axis.
pub fn wobble(random: &mut fastrand::Rng, degrees: f32) -> Quat {
    Quat::from_axis_angle(direction(random), (degrees * (2.0 * random.f32() - 1.0)).to_radians())
}

/// Returns a pose with each joint rotated at random by up to 5°.
pub fn random_pose(random: &mut fastrand::Rng) -> [Affine3A; 3] {
    posed(std::array::from_fn(|_| wobble(random, 5.0)))
}

/// A moving pose: each joint swings by up to 5° about an axis of its own, with a period of one to three seconds.
#[derive(Clone, Copy, Debug)]
pub struct Animation {
    joints: [(Vec3, f32, f32, f32); 3],
}

impl Animation {
    /// Creates an animation with random axes, amplitudes, speeds and phases.
    pub fn random(random: &mut fastrand::Rng) -> Self {
        use std::f32::consts::TAU;
        Self {
            joints: std::array::from_fn(|_| {
                let amplitude = (2.0 + 3.0 * random.f32()).to_radians();
                (direction(random), amplitude, TAU / (1.0 + 2.0 * random.f32()), TAU * random.f32())
            }),
        }
    }

    /// Returns the pose at time `t`, seconds.
    pub fn at(&self, t: f32) -> [Affine3A; 3] {
        posed(
            self.joints.map(|(axis, amplitude, speed, phase)| {
                Quat::from_axis_angle(axis, amplitude * (speed * t + phase).sin())
            }),
        )
    }
}

/// Returns joints with random angles within their ranges; an angle without a range is 0.
pub fn random_state(rig: &dyn Rig, random: &mut fastrand::Rng) -> Vec<Joint> {
    let mut anywhere = |range: Option<[f32; 2]>| {
        let [lo, hi] = range.map_or([0.0; 2], |range| range.map(|x| x.clamp(-3.1, 3.1)));
        lo + (hi - lo) * random.f32()
    };
    let joints = rig.description().joints().iter();
    joints
        .map(|info| {
            let heading = anywhere(info.heading);
            Joint::from_angles(heading, anywhere(info.pitch))
        })
        .collect()
}
