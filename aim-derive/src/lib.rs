//! The derive macro of `aim-rig`: hands its tokens to `aim-codegen` and what comes back to the compiler.

use proc_macro::TokenStream;

/// Derives a rig: its kernels for exactly the declared axes, `AimRig`, `Default` (every angle 0) and `Debug`.
///
/// On the struct, `#[aim(bones(up = +X, forward = +Y, left = +Z), handedness = right, effector(forward = +Y,
/// origin = (0.0, 0.1, 0.0)), crate = ::aim)]`; on each field, from the eye inward, `#[joint(heading = -35deg..=35deg,
/// pitch = -25deg..=20deg, rate = 450deg)]` with at least one of the angles and the rate. Optional in a joint:
/// `comfort`, `acceleration`, `bone`, `pair`, `level`, `range`, `bones`, `mirrored`.
#[proc_macro_derive(AimRig, attributes(aim, joint))]
pub fn derive_aim_rig(input: TokenStream) -> TokenStream {
    aim_codegen::derive(input.into()).into()
}
