use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(bones(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(heading = -35deg..=35deg, rate = 450deg, comfort = 0.0)]
    left_eye: Joint,
    #[joint(heading = -35deg..=35deg, rate = 450deg, comfort = -1)]
    neck: Joint,
    #[joint(heading = -35deg..=35deg, rate = 450deg, comfort = 1e999)]
    spine3: Joint,
}

fn main() {}
