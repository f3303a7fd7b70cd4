use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    eye: Joint,
    #[joint(heading = -35deg..=35deg, rate = 450deg, hold = ["clavicle_l", "clavicle_l"])]
    neck: Joint,
    #[joint(heading = -35deg..=35deg, rate = 450deg, hold = ["clavicle_l", "neck", ""])]
    spine3: Joint,
}

fn main() {}
