use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(heading = -35deg..=35deg, rate = 450deg, bone = "neck")]
    left_eye: Joint,
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    neck: Joint,
    #[joint(heading = -35deg..=35deg, rate = 450deg, bone = ["spine", "spine"])]
    spine3: Joint,
}

fn main() {}
