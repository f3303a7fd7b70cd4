use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(role = eye, heading = -0.6deg..=0.6deg, pitch = -25deg..=20deg, rate = 450rad)]
    left_eye: Joint,
    #[joint(role = neck, heading = -60deg..=60deg, rate = 6000deg)]
    neck: Joint,
}

fn main() {}
