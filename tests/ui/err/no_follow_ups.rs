// One error: what uses the rig finds everything it expects.
use aim::{Aim, AimRig, Joint, Pose, Rig, Settings};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = -Z))]
struct Thug {
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    left_eye: Joint,
}

fn rig() -> &'static impl AimRig {
    Thug::RIG
}

fn main() {
    println!("{:?} {:?}", rig().description(), Thug::RIG.bone_name(0, 0));
    let mut thug = Aim::<Thug>::new();
    let pose = Pose::new([aim::glam::Affine3A::IDENTITY; 1]);
    println!("{:?}", thug.aim(&pose, aim::glam::Vec3::ONE, 0.01, &Settings::default()).outcome);
    println!("{:?}", thug.snap(&pose, aim::glam::Vec3::ONE, &Settings::default()).corrections);
}
