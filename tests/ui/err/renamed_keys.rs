use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(bones(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg, comfort = 0.5, level = 0.5)]
    left_eye: Joint,
    #[joint(heading = -60deg..=60deg, pitch = -40deg..=35deg, rate = 170deg, narrowing = 0.25, range = absolute)]
    neck: Joint,
}

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Other {
    #[joint(heading = -35deg..=35deg, rate = 450deg, pair = "right_eye", range = relative)]
    left_eye: Joint,
    #[joint(heading = -60deg..=60deg, rate = 170deg, range = -60deg..=60deg)]
    neck: Joint,
}

fn main() {}
