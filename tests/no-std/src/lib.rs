//! A rig in a static library without the standard library.
//!
//! The crate defines its own panic handler, so it builds only if no dependency links `std`, which defines one too.
//! `.ci/run` builds it, also with the feature `lanes`, and checks that it fails to build with the feature `with-std`.
#![no_std]
#![forbid(unsafe_code)]

use aim::glam::{Affine3A, Vec3};
use aim::{Aim, AimRig, Joint, Pose, Settings};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z), kernels(aim_gradient))]
struct Thug {
    #[joint(role = eye, heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg, stiffness = 0.5)]
    left_eye: Joint,
    #[joint(role = neck, heading = -60deg..=60deg, pitch = -40deg..=35deg, rate = 170deg)]
    neck: Joint,
}

/// Returns the remaining angle after one frame, radians.
pub extern "C" fn aimed(x: f32, y: f32, z: f32) -> f32 {
    let pose = Pose::new([Affine3A::IDENTITY; 2]);
    Aim::<Thug>::new().aim(&pose, Vec3::new(x, y, z), 1.0 / 60.0, &Settings::default()).outcome.remaining
}

/// Computes the eye's aim for four characters at once.
#[cfg(feature = "lanes")]
pub extern "C" fn aims(x: &[f32; 4], y: &[f32; 4], z: &[f32; 4], aims: &mut [f32; 4]) {
    use aim::wide::f32x4;
    let (zero, one) = (f32x4::ZERO, f32x4::ONE);
    let link = [one, zero, zero, zero, one, zero, zero, zero, one, zero, zero, zero];
    let target = [x, y, z].map(|coordinates| f32x4::new(*coordinates));
    let [aim, ..] = Thug::aim_gradient(0, &link, &target, &[zero, one, zero, one]);
    *aims = aim.to_array();
}

#[panic_handler]
fn stop(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
