use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(bones(up = +X, forward = +Y), bones(up = +X, up = +X, forward = +Y))]
struct Thug {
    #[joint(heading = -35deg..=35deg, rate = 450deg, heading = free)]
    left_eye: Joint,
}

fn main() {}
