use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(bones(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(heading = -35..=35deg, rate = 450)]
    left_eye: Joint,
}

fn main() {}
