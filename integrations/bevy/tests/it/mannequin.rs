//! Printed by `aim rig mannequin.glb --format bevy`.

use bevy_aim::AimCharacter;
use bevy_aim::aim::{AimRig, Joint};

/// Measured from mannequin.glb. Faces +Z, up is +Y, according to the legs, the names left_upper_arm and right_upper_arm, the eyes, the feet.
#[derive(AimRig)]
#[aim(
    crate = bevy_aim::aim,
    axes(up = +X, forward = +Y, left = +Z),
    region = human
)]
pub struct Mannequin {
    // eyes can turn by about 50 degrees but seldom pass 35; saccades peak at 400 to 700 deg/s
    #[joint(
        bone = "left_eye",
        role = eye,
        other_eye = "right_eye",
        heading = -35deg..=35deg,
        pitch = -25deg..=20deg,
        limits_from = bind_pose,
        rate = 450deg,
        stiffness = 0.5
    )]
    pub left_eye: Joint,
    // 50 % of the turn of head and neck, which the rig's region limits to 78 degrees to either side, 50 down and 60 up
    #[joint(
        bone = "head",
        role = head,
        heading = -39deg..=39deg,
        pitch = -50deg..=60deg,
        limits_from = bind_pose,
        rate = 150deg,
        stiffness = 2.0
    )]
    pub head: Joint,
    // 50 % of the turn of head and neck, which the rig's region limits to 78 degrees to either side, 50 down and 60 up
    #[joint(
        bone = "neck",
        role = neck,
        heading = -39deg..=39deg,
        pitch = -50deg..=60deg,
        limits_from = bind_pose,
        rate = 150deg,
        stiffness = 2.0
    )]
    pub neck: Joint,
    // 30 % of the turn of the chest, which the rig's region limits to 30 degrees to either side, 30 down and 20 up
    #[joint(
        bone = "spine3",
        role = chest,
        heading = -9deg..=9deg,
        pitch = -18deg..=12deg,
        limits_from = bind_pose,
        rate = 37deg,
        stiffness = 13.43
    )]
    pub spine3: Joint,
    // 23 % of the turn of the chest, which the rig's region limits to 30 degrees to either side, 30 down and 20 up
    #[joint(
        bone = "spine2",
        role = chest,
        heading = -7deg..=7deg,
        pitch = -14deg..=9deg,
        limits_from = bind_pose,
        rate = 29deg,
        stiffness = 17.09
    )]
    pub spine2: Joint,
    // 23 % of the turn of the chest, which the rig's region limits to 30 degrees to either side, 30 down and 20 up
    #[joint(
        bone = "spine1",
        role = chest,
        heading = -7deg..=7deg,
        pitch = -14deg..=9deg,
        limits_from = bind_pose,
        rate = 29deg,
        stiffness = 17.09
    )]
    pub spine1: Joint,
    // 23 % of the turn of the chest, which the rig's region limits to 30 degrees to either side, 30 down and 20 up
    #[joint(
        bone = "spine",
        role = chest,
        heading = -7deg..=7deg,
        pitch = -14deg..=9deg,
        limits_from = bind_pose,
        rate = 29deg,
        stiffness = 17.09
    )]
    pub spine: Joint,
}

impl Mannequin {
    /// The character, to be spawned on the root of its scene, together with an `AimTarget`.
    pub fn character() -> AimCharacter {
        AimCharacter::of::<Self>()
            .with_trunk("hips")
    }
}
