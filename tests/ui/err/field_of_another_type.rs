use aim::{AimRig, Joint, Rig};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(role = eye, heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg)]
    left_eye: f32,
    #[joint(role = neck, heading = -60deg..=60deg, rate = 170deg)]
    neck: Option<Joint>,
    #[joint(role = chest, heading = -20deg..=20deg, rate = 70deg)]
    chest: Joint,
}

fn main() {
    println!("{}", Thug::RIG.description().joints().len());
}
