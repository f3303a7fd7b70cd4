use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(heading = .., rate = 450deg)]
    left_eye: Joint,
    #[joint(heading = -35deg.., rate = 450deg)]
    neck: Joint,
    #[joint(heading = ..=35deg, rate = 450deg)]
    spine3: Joint,
    #[joint(heading = -35deg..35deg, rate = 450deg)]
    spine2: Joint,
}

fn main() {}
