use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, sideways = +Z), hand = left, stiffness = 2.0)]
struct Thug {
    #[joint(headng = -35deg..=35deg, speed = 450deg, handedness = left, colour = 3)]
    left_eye: Joint,
}

fn main() {}
