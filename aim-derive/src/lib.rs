//! The derive macro of `aim-rig`: hands its tokens to `aim-codegen` and what comes back to the compiler.

use proc_macro::TokenStream;

/// Derives a rig: its kernels for exactly the declared axes, `AimRig`, `Default` (every angle 0) and `Debug`.
///
/// On the struct, `#[aim(bones(up = +X, forward = +Y, left = +Z), handedness = right, effector(forward = +Y,
/// origin = (0.0, 0.1, 0.0)), crate = ::aim)]`; two of the three axes are enough. On each field, from the eye inward,
/// `#[joint(heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg)]` with at least one of the angles and the
/// rate, the largest speed of each angle. A joint may also have:
///
/// | setting | meaning |
/// |---|---|
/// | `bones(…)` | this bone's own axes |
/// | `mirrored = true` | its axes are mirrored |
/// | `heading = free` | a turret: no limit |
/// | `comfort = 4.0` | reluctance in the displacement cost, 1 by default |
/// | `acceleration = 1200deg` | largest change of speed, per second squared |
/// | `level = 0.5` | how far heading turns about the character's up, 0 to 1 |
/// | `range = absolute` | ranges are counted from the bind pose, not from the animation |
/// | `bone = "node"` or `["a", "b"]` | its names in models; the field's name by default |
/// | `pair = "node"` | on the eye: the other eye |
///
/// Beside the trait there is a constant `BONES`, the bones' names joint by joint. Deriving `Default` or `Debug` beside it is
/// an error: both come with it.
#[proc_macro_derive(AimRig, attributes(aim, joint))]
pub fn derive_aim_rig(input: TokenStream) -> TokenStream {
    aim_codegen::derive(input.into()).into()
}

/// Differentiates a function.
#[proc_macro_attribute]
pub fn differentiate(attribute: TokenStream, item: TokenStream) -> TokenStream {
    aim_codegen::differentiate(attribute.into(), item.into()).into()
}
