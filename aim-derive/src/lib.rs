//! The procedural macros of `aim-rig`. Each passes its tokens to `aim-codegen` and returns the code generated there.

use proc_macro::TokenStream;

/// Derives the traits `Rig`, with kernels specialised for the declared axes, and `AimRig`.
///
/// The struct carries `#[aim(axes(up = +X, forward = +Y, left = +Z), handedness = right, effector(forward = +Y, origin
/// = (0.0, 0.1, 0.0)), natural(…), region = human, crate = ::aim)]`; two of the three axes suffice. Each field is a
/// joint, in order from the eye inward, with `#[joint(role = eye, heading = -35deg..=35deg, pitch = -25deg..=20deg,
/// rate = 450deg)]`. `rate`, the largest speed of each angle per second, and at least one of `heading` and `pitch` are
/// required. The other settings of a joint:
///
/// | setting | meaning |
/// |---|---|
/// | `role = eye` | the body part: `eye`, `head`, `neck`, `chest` (any joint of the upper torso) or `none`, the default |
/// | `axes(…)` | this bone's axes, where they differ from the struct's |
/// | `mirrored = true` | this bone's axes have the opposite handedness |
/// | `heading = free` | unlimited rotation, as of a turret |
/// | `stiffness = 4.0` | weight in the displacement cost: stiffer joints move less; 1 by default |
/// | `acceleration = 1200deg` | largest change of speed, per second squared |
/// | `upright = 0.5` | blends the heading's axis from the bone's own up, 0, to the character's up, 1 |
/// | `pitch_taper = 0.3` | fraction of the pitch's range lost at the ends of the heading's range, growing from 0 at heading 0; 0 to 1 |
/// | `limits_from = bind_pose` | measures the ranges from the bind pose instead of the animated pose |
/// | `bone = "node"` or `["a", "b"]` | the bone's names in models; the field's name by default |
/// | `other_eye = "node"` | on the eye: the bone of the other eye |
/// | `hold = ["a", "b"]` | child bones that follow the joint's carrier instead, as clavicles on a neck: `Description::held_correction` |
///
/// # How a natural gaze is shared
///
/// `natural(eyes_only = 15deg, head_share = 0.8, engage = 15deg, release = 8deg, delay = 0)` sets how eyes, neck and
/// spine share a gaze shift in the natural solver. The values shown are the defaults, except that by default `engage`
/// is at most `eyes_only` and `release` at most `engage`. The eyes alone make shifts of up to `eyes_only`; `head_share`
/// (0 to 1) is the head's share of the excess. The head starts to move when the target is further than `engage` from
/// the middle of the eye's range, `delay` seconds after the eyes, and rests again when the target is nearer than
/// `release`.
///
/// A joint's part in the gaze is set by its `role` alone, never guessed from names. Neck and head turn about the
/// character's up unless `upright` says otherwise. A rig in which any joint has a role uses the natural solver unless a
/// call selects another.
///
/// # What the body can do
///
/// `region = human` (the default), `quadruped`, `bird` or `toon` selects the combined limits of head and chest in the
/// natural solver; they include the rotation of the animation itself. `region(like = bird, head(heading =
/// -130deg..=130deg, pitch = -70deg..=70deg, rate = 400deg, acceleration = 4000deg), chest(…))` sets them in numbers;
/// omitted values are those of `like`. The head region consists of the joints with the roles `head` and `neck`, the
/// chest region of those with the role `chest`.
///
/// # A pose by name, and further kernels
///
/// The macro also defines a struct with the rig's visibility, `HeroPose` for `Hero`, with one field for each joint, for
/// poses and corrections accessed by name. It converts from and to an array of the joints' values.
///
/// `kernels(aim_gradient, chain_value_gradient, chain_residual_jacobian)` on the struct, with any of the three, adds
/// associated functions of those names, generic over `Scalar`: `Hero::chain_value_gradient(links, target, sin_cos,
/// out)`.
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
