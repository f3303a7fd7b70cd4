use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = -Z))]
struct Thug {
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    left_eye: Joint,
}

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, right = -Z), handedness = left)]
struct Guard {
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    left_eye: Joint,
}

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Turret {
    #[joint(heading = -35deg..=35deg, rate = 450deg, axes(up = +Z, forward = +X, left = -Y))]
    left_eye: Joint,
    #[joint(heading = -35deg..=35deg, rate = 450deg, mirrored = true)]
    neck: Joint,
}

fn main() {}
