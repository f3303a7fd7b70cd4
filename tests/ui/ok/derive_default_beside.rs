use aim::{AimRig, Joint};

#[derive(AimRig, Debug, Default)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    left_eye: Joint,
}

fn main() {}
