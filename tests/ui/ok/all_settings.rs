// Everything that a declaration may say.
use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(
    bones(up = +X, forward = +Y, left = +Z),
    handedness = right,
    effector(forward = (0.0, 0.8, 0.6), origin = (0.0, 0.1, -0.02)),
    natural(eyes_only = 12deg, head_share = 0.75, engage = 15deg, release = 0.1rad, delay = 0),
    crate = ::aim,
)]
pub struct Thug {
    #[joint(
        heading = -35deg..=35.5deg,
        pitch = -0.4rad..=20deg,
        rate = 450deg,
        acceleration = 12_000deg,
        comfort = 0.5,
        bone = ["L_eyeBall_joint2", "LeftEye"],
        pair = "R_eyeBall_joint",
        bones(up = +Z, forward = +Y),
        mirrored = true,
        narrowing = 0.5,
    )]
    pub left_eye: Joint,
    #[joint(heading = free, rate = 2rad, level = 0.5, range = absolute, bone = "Neck")]
    r#neck: Joint,
    #[joint(pitch = -10deg..=10deg, rate = 1rad, range = relative)]
    spine3: Joint,
}

fn main() {
    let thug = Thug::default();
    assert_eq!(thug.joint_infos().len(), 3);
    assert_eq!(Thug::BONES[0], ["L_eyeBall_joint2", "LeftEye"]);
    assert!(format!("{thug:?}").starts_with("Thug"));
}
