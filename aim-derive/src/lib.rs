//! The macros of `aim-rig`: hand their tokens to `aim-codegen` and what comes back to the compiler.

use proc_macro::TokenStream;

/// Derives a rig: `Rig`, with kernels for exactly the declared axes, and `AimRig`.
///
/// On the struct, `#[aim(axes(up = +X, forward = +Y, left = +Z), handedness = right, effector(forward = +Y,
/// origin = (0.0, 0.1, 0.0)), natural(…), region = human, crate = ::aim)]`; two of the three axes are enough. On each field,
/// from the eye inward, `#[joint(role = eye, heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg)]` with at least
/// one of the angles and the rate, the largest speed of each angle. A joint may also have:
///
/// | setting | meaning |
/// |---|---|
/// | `role = eye` | what the joint is: `eye`, `head`, `neck`, `chest` (any joint of the upper torso) or `none`, the default |
/// | `axes(…)` | this bone's own axes |
/// | `mirrored = true` | its axes are mirrored |
/// | `heading = free` | a turret: no limit |
/// | `stiffness = 4.0` | weight in the displacement cost: stiffer joints move less; 1 by default |
/// | `acceleration = 1200deg` | largest change of speed, per second squared |
/// | `upright = 0.5` | how far heading turns about the character's up, 0 to 1 |
/// | `pitch_taper = 0.3` | the part of the pitch's range that is lost at the ends of the heading's, growing from 0 at heading 0; 0 to 1 |
/// | `limits_from = bind_pose` | ranges are counted from the bind pose, not from the animation |
/// | `bone = "node"` or `["a", "b"]` | its names in models; the field's name by default |
/// | `other_eye = "node"` | on the eye: the other eye |
/// | `hold = ["a", "b"]` | bones that hang on this joint and stay with what carries it, as clavicles on a neck; see `Description::held_correction` |
///
/// # How a natural gaze is shared
///
/// `natural(eyes_only = 15deg, head_share = 0.8, engage = 15deg, release = 8deg, delay = 0)` says how eyes, neck and spine
/// share a gaze in the natural solver; what is left out is as written here. `eyes_only` is the shift that the eyes make
/// alone, `head_share` the head's part of what is beyond it (0 to 1); the head begins to help when the eyes are further
/// than `engage` from their middle, rests again nearer than `release`, and begins `delay` seconds after the eyes.
///
/// The part a joint has in the gaze is its `role`; names tell nothing. Neck and head turn about the character's up unless
/// `upright` says otherwise, and a rig with a joint that has a role is aimed by the natural solver unless a call asks for
/// another.
///
/// # What the body can do
///
/// `region = human` (the default), `quadruped`, `bird` or `toon` says what the parts of the body can do together in the natural
/// solver, the animation's own turn included; `region(like = bird, head(heading = -130deg..=130deg, pitch = -70deg..=70deg,
/// rate = 400deg, acceleration = 4000deg), chest(…))` says it in numbers, and what is left out is as of `like`. The head is
/// the joints with the roles `head` and `neck`, the chest those with the role `chest`.
///
/// # A pose by name, and further kernels
///
/// Beside the traits there is a struct of the rig's visibility, `HeroPose` for `Hero`, with a field for each joint: for poses
/// and corrections that are given and read by name. It is converted from and to an array of the joints' values.
///
/// `kernels(aim_gradient, chain_value_gradient, chain_residual_jacobian)` on the struct, with any of the three, makes
/// associated functions of those names, generic over `Scalar`: `Hero::chain_value_gradient(links, target, sin_cos, out)`.
#[proc_macro_derive(AimRig, attributes(aim, joint))]
pub fn derive_aim_rig(input: TokenStream) -> TokenStream {
    aim_codegen::derive(input.into()).into()
}

#[doc = include_str!("differentiate.md")]
#[proc_macro_attribute]
pub fn differentiate(attribute: TokenStream, item: TokenStream) -> TokenStream {
    aim_codegen::differentiate(attribute.into(), item.into(), "aim").into()
}

#[doc = include_str!("differentiate.md")]
#[doc(hidden)]
#[proc_macro_attribute]
pub fn differentiate_by_derivand(attribute: TokenStream, item: TokenStream) -> TokenStream {
    aim_codegen::differentiate(attribute.into(), item.into(), "derivand").into()
}
