use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(heading = -0x23deg..=35deg, rate = 0b11)]
    left_eye: Joint,
}

fn main() {}
