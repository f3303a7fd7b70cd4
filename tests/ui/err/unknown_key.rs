use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(bones(up = +X, forward = +Y, sideways = +Z), hand = left, comfort = 2.0)]
struct Thug {
    #[joint(headng = -35deg..=35deg, speed = 450deg, handedness = left, colour = 3)]
    left_eye: Joint,
}

fn main() {}
