use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
#[joint(rate = 450deg)]
struct Thug {
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    #[aim(handedness = left)]
    left_eye: Joint,
}

fn main() {}
