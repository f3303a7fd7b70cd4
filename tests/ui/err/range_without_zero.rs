use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(heading = 5deg..=20deg, pitch = -20deg..=-5deg, rate = 450deg)]
    left_eye: Joint,
}

fn main() {}
