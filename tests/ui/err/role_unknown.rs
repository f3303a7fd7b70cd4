use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(role = eyes, heading = -35deg..=35deg, rate = 450deg)]
    left_eye: Joint,
    #[joint(role = spine, heading = -20deg..=20deg, rate = 70deg)]
    spine3: Joint,
    #[joint(role = hand, heading = -20deg..=20deg, rate = 70deg)]
    left_hand: Joint,
    #[joint(role = "head", heading = -20deg..=20deg, rate = 70deg)]
    right_hand: Joint,
}

fn main() {}
