use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(heading = -35deg..=35deg)]
    #[joint(rate = 450deg)]
    left_eye: Joint,
}

fn main() {}
