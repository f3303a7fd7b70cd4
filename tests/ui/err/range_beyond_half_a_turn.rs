use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(heading = -181deg..=180deg, pitch = -1rad..=3.2rad, rate = 450deg)]
    left_eye: Joint,
    #[joint(pitch = free, rate = 450deg)]
    neck: Joint,
}

fn main() {}
