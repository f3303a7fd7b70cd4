// Rustc refuses the sign itself, before any macro sees it; only in a string is it ours to explain.
use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(heading = -35deg..=35deg, rate = "450°")]
    left_eye: Joint,
}

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Guard {
    #[joint(heading = -35°..=35°, rate = 450deg)]
    left_eye: Joint,
}

fn main() {}
