use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(heading = -35..=35deg, rate = 450)]
    left_eye: Joint,
}

fn main() {}
