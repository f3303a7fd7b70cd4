use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(heading = -35deg..=35deg rate = 450deg,, mirrored)]
    left_eye: Joint,
    #[joint(heading: free, rate)]
    neck: Joint,
}

fn main() {}
