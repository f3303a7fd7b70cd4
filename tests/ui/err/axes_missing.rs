use aim::{AimRig, Joint};

#[derive(AimRig)]
struct Thug {
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    left_eye: Joint,
}

#[derive(AimRig)]
#[aim(handedness = left)]
struct Guard {
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    left_eye: Joint,
}

#[derive(AimRig)]
#[aim(axes())]
struct Turret {
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    left_eye: Joint,
}

fn main() {}
