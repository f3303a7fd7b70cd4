use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(heading = -35deg..=35deg, rate = 450deg, stiffness = 0.0)]
    left_eye: Joint,
    #[joint(heading = -35deg..=35deg, rate = 450deg, stiffness = -1)]
    neck: Joint,
    #[joint(heading = -35deg..=35deg, rate = 450deg, stiffness = 1e999)]
    spine3: Joint,
}

fn main() {}
