use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(heading = -35deg..=35deg, rate = 450deg, stiffness = 0.5deg, upright = 1rad)]
    left_eye: Joint,
}

fn main() {}
