// One error: what uses the rig finds everything it expects.
use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(bones(up = +X, forward = +Y, left = -Z))]
struct Thug {
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    left_eye: Joint,
}

fn rig() -> impl AimRig + Default + core::fmt::Debug {
    Thug::default()
}

fn main() {
    let thug = Thug::default();
    println!("{:?} {:?} {:?} {}", rig(), thug, thug.effector(), Thug::BONES.len());
    let mut thug = thug;
    let pose = aim::Pose { joints: [aim::glam::Affine3A::IDENTITY; 1] };
    println!("{:?}", thug.aim(&pose, aim::glam::Vec3::ONE, 0.01));
    println!("{:?} {}", thug.snap(&pose, aim::glam::Vec3::ONE), thug.corrections().count());
}
