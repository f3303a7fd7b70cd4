use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(heading = -35deg..=35deg, rate = 450deg, acceleration = 0deg)]
    left_eye: Joint,
    #[joint(heading = -35deg..=35deg, rate = 450deg, acceleration = -1rad)]
    neck: Joint,
    #[joint(heading = -35deg..=35deg, rate = 450deg, acceleration = 1e999rad)]
    spine3: Joint,
}

fn main() {}
