use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y), axes(up = +X, up = +X, forward = +Y))]
struct Thug {
    #[joint(heading = -35deg..=35deg, rate = 450deg, heading = free)]
    left_eye: Joint,
}

fn main() {}
