//! A rig in a static library without a standard library.
//!
//! It defines the panic handler itself, so it builds only if nothing below it links `std`, which has one. `.ci/run`
//! builds it; and builds it with the feature `with-std`, which has to fail for just that reason.
#![no_std]
#![forbid(unsafe_code)]

use aim::glam::{Affine3A, Vec3};
use aim::{AimRig, Joint, Pose};

#[derive(AimRig)]
#[aim(bones(up = +X, forward = +Y, left = +Z))]
struct Thug {
    #[joint(heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg, comfort = 0.5)]
    left_eye: Joint,
    #[joint(heading = -60deg..=60deg, pitch = -40deg..=35deg, rate = 170deg)]
    neck: Joint,
}

/// The remaining angle after one frame, in radians.
pub extern "C" fn aimed(x: f32, y: f32, z: f32) -> f32 {
    let mut thug = Thug::default();
    let pose = Pose { joints: [Affine3A::IDENTITY; 2] };
    thug.aim(&pose, Vec3::new(x, y, z), 1.0 / 60.0).remaining
}

#[panic_handler]
fn stop(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
