use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = (0.0, 0.8, 0.6), forward = +Z))]
struct Thug {
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    left_eye: Joint,
}

fn main() {}
