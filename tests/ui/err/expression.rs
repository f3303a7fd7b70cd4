use aim::{AimRig, Joint};

const RATE: f32 = 450.0;

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(heading = -35deg..=30deg + 5deg, pitch = -LIMIT..=LIMIT, rate = RATE)]
    left_eye: Joint,
    #[joint(heading = "-35deg..=35deg", rate = "450deg", stiffness = core::f32::consts::PI)]
    neck: Joint,
}

fn main() {}
