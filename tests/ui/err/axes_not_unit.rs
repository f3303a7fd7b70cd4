use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = (0.0, 2.0, 0.0), forward = +Z))]
struct Thug {
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    left_eye: Joint,
}

#[derive(AimRig)]
#[aim(axes(up = (0.0, 0.0, 0.0), forward = +Z))]
struct Guard {
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    left_eye: Joint,
}

fn main() {}
