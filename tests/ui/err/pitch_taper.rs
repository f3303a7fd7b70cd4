use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg, pitch_taper = 25)]
    left_eye: Joint,
    #[joint(pitch = -25deg..=20deg, rate = 450deg, pitch_taper = 0.5)]
    neck: Joint,
    #[joint(heading = free, pitch = -25deg..=20deg, rate = 450deg, pitch_taper = 0.5)]
    spine: Joint,
}

fn main() {}
