use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(heading = -35deg..=35grad, pitch = -0.5radians..=35degrees, rate = 450 deg)]
    left_eye: Joint,
}

fn main() {}
