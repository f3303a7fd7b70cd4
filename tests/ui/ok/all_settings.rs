// Everything that a declaration may say.
use aim::{AimRig, Joint, Rig};

#[derive(AimRig)]
#[aim(
    axes(up = +X, forward = +Y, left = +Z),
    handedness = right,
    effector(forward = (0.0, 0.8, 0.6), origin = (0.0, 0.1, -0.02)),
    natural(eyes_only = 12deg, head_share = 0.75, engage = 15deg, release = 0.1rad, delay = 0),
    crate = ::aim,
)]
pub struct Thug {
    #[joint(
        role = eye,
        heading = -35deg..=35.5deg,
        pitch = -0.4rad..=20deg,
        rate = 450deg,
        acceleration = 12_000deg,
        stiffness = 0.5,
        bone = ["L_eyeBall_joint2", "LeftEye"],
        other_eye = "R_eyeBall_joint",
        axes(up = +Z, forward = +Y),
        mirrored = true,
        pitch_taper = 0.5,
    )]
    pub left_eye: Joint,
    #[joint(role = neck, heading = free, rate = 2rad, upright = 0.5, limits_from = bind_pose, bone = "Neck", hold = ["L", "R"])]
    r#neck: Joint,
    #[joint(role = chest, pitch = -10deg..=10deg, rate = 1rad, limits_from = animation)]
    spine3: Joint,
}

fn main() {
    let thug = Thug::RIG;
    assert_eq!(thug.description().joints().len(), 3);
    assert_eq!([thug.bone_name(0, 0), thug.bone_name(0, 1)], [Some("L_eyeBall_joint2"), Some("LeftEye")]);
    assert_eq!([0, 1, 2].map(|place| thug.held_bone(1, place)), [Some("L"), Some("R"), None]);
    assert_eq!(thug.other_eye_bone(), Some("R_eyeBall_joint"));
}
