//! A character made in code, for tests that combine animation and aiming.

use core::f32::consts::TAU;

use aim::animation::{Bone, Clip, Skeleton, Track, Transform};
use aim::glam::{Affine3A, Mat3A, Quat, Vec3};
use aim::{AimRig, Joint};

/// The rig under test, from the eye inward. +X of its bones points up, +Y forward, +Z left.
#[derive(AimRig, Debug)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
pub struct Hero {
    /// The left one of two eyes.
    #[joint(role = eye, heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg)]
    pub left_eye: Joint,
    /// Carries the head.
    #[joint(role = neck, heading = -60deg..=60deg, pitch = -40deg..=35deg, rate = 170deg, hold = ["left_clavicle"])]
    pub neck: Joint,
    /// Carries neck and arms.
    #[joint(role = chest, heading = -20deg..=20deg, pitch = -10deg..=10deg, rate = 70deg, stiffness = 4.0)]
    pub spine: Joint,
}

/// The bones: name, parent, and position of the joint (left, up, forward), metres.
const BONES: [(&str, Option<usize>, [f32; 3]); 10] = [
    ("armature", None, [0.0, 0.0, 0.0]),
    ("hips", Some(0), [0.0, 0.95, 0.0]),
    ("spine", Some(1), [0.0, 1.2, 0.0]),
    ("neck", Some(2), [0.0, 1.5, 0.0]),
    ("head", Some(3), [0.0, 1.58, 0.02]),
    ("left_eye", Some(4), [0.03, 1.66, 0.09]),
    ("right_eye", Some(4), [-0.03, 1.66, 0.09]),
    // A child of the neck, as in many skeletons, although the chest should carry it.
    ("left_clavicle", Some(3), [0.05, 1.45, 0.0]),
    ("left_arm", Some(7), [0.2, 1.42, 0.0]),
    ("left_leg", Some(1), [0.1, 0.9, 0.0]),
];

/// Returns a standing character with +Y up, facing +Z, on an armature with this transform.
#[must_use]
pub fn skeleton(armature: Transform) -> Skeleton {
    // Bone +X up, +Y forward, +Z left.
    let standing = Mat3A::from_cols(Vec3::Y.into(), Vec3::Z.into(), Vec3::X.into());
    let model = |bone: usize| match bone {
        0 => Affine3A::IDENTITY,
        _ => Affine3A { matrix3: standing, translation: BONES[bone].2.into() },
    };
    let bones = BONES.iter().enumerate().map(|(bone, &(name, parent, _))| {
        let rest = match parent {
            Some(parent) => Transform::from_affine(&(model(parent).inverse() * model(bone))).unwrap_or_default(),
            None => armature,
        };
        Bone::new(name, parent).with_rest(rest)
    });
    Skeleton::new(bones).unwrap_or_else(|error| unreachable!("{error}"))
}

/// Makes a gait, in place or forward at `speed`: hips that bob, a leg and an arm that swing, eyes that wander.
#[must_use]
pub fn gait(skeleton: &Skeleton, name: &str, length_s: f32, speed: f32) -> Clip {
    let times: Vec<f32> = (0..=24_u8).map(|key| length_s * f32::from(key) / 24.0).collect();
    let rest = |bone: usize| skeleton.rest()[bone];
    let swing = |bone: usize, most_rad: f32| {
        let turn = |time: &f32| Quat::from_rotation_z(most_rad * (TAU * time / length_s).sin());
        Track::linear(times.clone(), times.iter().map(|time| rest(bone).rotation * turn(time)).collect::<Vec<_>>())
    };
    let bob =
        |time: &f32| rest(1).translation + Vec3::new(0.0, 0.02 * (2.0 * TAU * time / length_s).cos(), time * speed);
    let clip = Track::linear(times.clone(), times.iter().map(bob).collect::<Vec<_>>());
    let mut clip = Clip::new(name).with_translation(1, clip.unwrap_or_else(|error| unreachable!("{error}")));
    for (bone, most_rad) in [(2, 0.05), (4, 0.1), (5, 0.1), (6, -0.1), (8, 0.4), (9, 0.5)] {
        clip = clip.with_rotation(bone, swing(bone, most_rad).unwrap_or_else(|error| unreachable!("{error}")));
    }
    clip
}
