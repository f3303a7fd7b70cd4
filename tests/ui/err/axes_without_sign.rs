use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = X, forward = +Y))]
struct Thug {
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    left_eye: Joint,
}

#[derive(AimRig)]
#[aim(axes(up = +W, forward = +y))]
struct Guard {
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    left_eye: Joint,
}

fn main() {}
