#![doc = include_str!("registry.md")]
//!
//! # A natural gaze over one second
//!
//! Headings of gaze, head, chest and eye while the natural solver turns a standing character to targets at its side.
//! [The guide](guide::natural_gaze) explains the curves.
//!
#![doc = include_str!("../docs/natural-gaze.svg")]
//!
//! # Where to look
//!
//! - A character: [`Aim`] for a rig declared with `#[derive(AimRig)]`, [`DynAim`] for a rig known only at run time.
//!   Both have the methods `aim` and `snap`.
//! - A call: its [`Pose`], its target ([`Targets`]) and its [`Settings`]; it returns [`Aimed`] with an [`Outcome`].
//! - Setup mistakes, detected in debug builds: [`check`].
//! - Other solvers: [`ik`]. The rotation arithmetic that they use: [`rotation`].
//! - Playing the animation that is aimed: the feature `animation`.
//! - [The guide](guide) has pages on axes, solvers, the natural gaze, animation and derivatives.
//! - The derived kernels, for writing your own solver: [`Rig`], [`Scalar`] and the section on lanes below.
//!
//! # Feature flags
//!
//! - `std` (default): [`DynAim`]; square roots, and the sines of functions that you differentiate, from the standard
//!   library.
//! - `libm`: the same mathematical functions from the crate `libm`, for targets without a standard library.
//! - `animation`: skeletons, clips, blending and root motion, in `aim::animation`. Needs an allocator.
//! - `rigs`: the bundled rigs, in `aim::rigs`.
//! - `serde`: storage of [`Settings`], of a character's [`Aim`] or [`State`], of [`Outcome`] and of the types of their
//!   fields; in the animation library, of transforms and playback positions. A restored state continues with
//!   bit-identical results.
//! - `f64`: double-precision glam types, for functions that you differentiate.
//! - `wide`: kernels in SIMD lanes, see below. Needs Rust 1.89, as the crate [`wide`](https://docs.rs/wide) does, which
//!   is re-exported as `aim::wide`.
//!
//! # Eight characters at once
//!
//! If the declaration of a rig asks for them (`kernels(aim_gradient, chain_value_gradient, chain_residual_jacobian)`),
//! its kernels are emitted as functions generic over [`Scalar`]. With the feature `wide`, the vectors of that crate are
//! scalars too: one call evaluates as many characters as the vector has lanes. Each lane gives exactly the bits that a
//! scalar call for its character gives; lanes do not affect each other. This is for crowds with a solver of their own:
//! [`Aim::aim`] moves one character.
//!
//! ```
//! # #[cfg(feature = "wide")] {
//! use aim::wide::f32x8;
//! use aim::{AimRig, Joint};
//!
//! #[derive(AimRig)]
//! #[aim(axes(up = +X, forward = +Y, left = +Z), kernels(aim_gradient))]
//! struct Owl {
//!     #[joint(role = neck, heading = -60deg..=60deg, pitch = -40deg..=35deg, rate = 170deg)]
//!     neck: Joint,
//! }
//!
//! // Eight owls look along +Y. Their targets go from straight ahead to the left; the last one's is in its own eye.
//! let (zero, one) = (f32x8::ZERO, f32x8::ONE);
//! let eye_to_neck = [one, zero, zero, zero, one, zero, zero, zero, one, zero, zero, zero];
//! let target = [
//!     zero,
//!     f32x8::new([4.0, 4.0, 4.0, 4.0, 3.0, 2.0, 1.0, 0.0]),
//!     f32x8::new([0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 4.0, 0.0]),
//! ];
//! let [sin_pitch, cos_pitch, sin_heading, cos_heading] = [zero, one, zero, one];
//!
//! let sin_cos = [sin_pitch, cos_pitch, sin_heading, cos_heading];
//! let [aim, by_pitch, by_heading] = Owl::aim_gradient(0, &eye_to_neck, &target, &sin_cos);
//!
//! assert_eq!(aim.to_array()[0], 1.0); // on target
//! assert!(by_heading.to_array()[1..7].iter().all(|&slope| slope > 0.0)); // to be turned to the left
//! assert_eq!(aim.to_array()[7], 0.0); // nothing to aim at: zero, in this lane alone
//! assert_eq!(by_pitch.to_array(), [0.0; 8]); // none of them is above or below
//! # }
//! ```
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(feature = "animation")]
#[doc(inline)]
pub use aim_animation as animation;
#[doc(inline)]
pub use aim_derive::{AimRig, differentiate};
#[cfg(feature = "std")]
#[doc(inline)]
pub use aim_runtime::DynAim;
pub use aim_runtime::glam;
#[cfg(feature = "wide")]
pub use aim_runtime::wide;
#[doc(inline)]
pub use aim_runtime::{
    Aim, AimRig, Aimed, Ascent, Axes, Behind, Budget, Budgets, Call, Description, Effector, GazeSharing, Joint,
    JointInfo, JointRange, JointSet, LimitsFrom, Memory, Outcome, Pose, Real, Rig, Role, Scalar, Settings, Solver,
    State, Status, Target, Targets, check, ik, rotation, trajectory,
};

#[cfg(doc)]
pub mod guide;

/// An affine transform that the caller guarantees to be rigid: a rotation and a translation, without scale, shear or
/// mirroring. [`macro@differentiate`] treats both this name and `Affine3A` as rigid.
pub type Rigid = glam::Affine3A;

/// Double-precision counterpart of [`Rigid`]: an affine transform that the caller guarantees to be rigid.
#[cfg(feature = "f64")]
pub type DRigid = glam::DAffine3;

/// Includes the rigs that the package's `build.rs` compiled with `aim_codegen::build::rigs`, each as a struct under its
/// own name.
///
/// The argument is the name of the folder or file, without extension:
///
/// ```ignore
/// // build.rs: aim_codegen::build::rigs("rigs");
/// aim::include_rigs!("rigs");
///
/// let mut hero = Aim::<Hero>::new();
/// ```
#[macro_export]
macro_rules! include_rigs {
    ($name:literal) => {
        ::core::include!(::core::concat!(::core::env!("OUT_DIR"), "/", $name, ".rs"));
    };
}

/// The bundled rigs, compiled from `rigs/*.toml`.
#[cfg(feature = "rigs")]
pub mod rigs {
    include_rigs!("rigs");
}

/// The project's front page and the pages of the book outside the guide, so that their examples run as doctests.
#[cfg(doctest)]
mod book {
    #[doc = include_str!("../README.md")]
    mod readme {}
    #[doc = include_str!("../docs/five-minutes.md")]
    mod five_minutes {}
    #[doc = include_str!("../docs/recipes.md")]
    mod recipes {}
    #[doc = include_str!("../docs/troubleshooting.md")]
    mod troubleshooting {}
}

/// Items that emitted code refers to; not for hand-written code.
#[doc(hidden)]
pub mod __private {
    #[doc(hidden)]
    pub use aim_runtime::differences;
    pub use aim_runtime::glam::Affine3A;
    pub use aim_runtime::number_constant;
    pub use aim_runtime::{
        AimRig, Axes, Budget, Budgets, Description, Effector, GazeSharing, Joint, JointInfo, LimitsFrom, Pose, Real,
        Rig, Role, Scalar,
    };
}
