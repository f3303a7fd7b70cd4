//! A strict crate: what the derive expands to, and what `aim generate` writes into a file, pass every lint that such a
//! crate denies. (`cargo clippy` judges the `clippy::` ones.)
#![forbid(unsafe_code)]
#![deny(
    warnings,
    future_incompatible,
    let_underscore,
    nonstandard_style,
    rust_2018_idioms,
    rust_2021_compatibility,
    rust_2024_compatibility,
    unused,
    elided_lifetimes_in_paths,
    explicit_outlives_requirements,
    meta_variable_misuse,
    missing_debug_implementations,
    missing_docs,
    non_local_definitions,
    single_use_lifetimes,
    trivial_casts,
    trivial_numeric_casts,
    unit_bindings,
    unnameable_types,
    unreachable_pub,
    unused_import_braces,
    unused_lifetimes,
    unused_macro_rules,
    unused_qualifications,
    unused_results,
    variant_size_differences,
    clippy::all,
    clippy::pedantic,
    clippy::allow_attributes_without_reason,
    clippy::arithmetic_side_effects,
    clippy::as_conversions,
    clippy::dbg_macro,
    clippy::exhaustive_enums,
    clippy::expect_used,
    clippy::float_cmp_const,
    clippy::indexing_slicing,
    clippy::panic,
    clippy::print_stdout,
    clippy::std_instead_of_core,
    clippy::todo,
    clippy::undocumented_unsafe_blocks,
    clippy::unwrap_used,
    clippy::wildcard_enum_match_arm
)]

use aim::glam::Vec3;
use aim::{AimRig, Joint, Rigid, differentiate};

/// For everyone.
#[derive(Debug, AimRig)]
#[aim(axes(up = (0.0, 0.96, 0.28), forward = (0.6, -0.224, 0.768)), effector(forward = +Z))]
pub struct Public {
    /// The eye.
    #[joint(role = eye, heading = -0.6rad..=0.6rad, pitch = -0.4rad..=0.35rad, rate = 7.5rad, stiffness = 0.5)]
    pub eye: Joint,
    #[joint(role = neck, heading = free, rate = 170deg, axes(up = -Z, forward = +X), mirrored = true)]
    neck: Joint,
}

#[derive(Debug, AimRig)]
#[aim(axes(up = +X, forward = +Y))]
pub(crate) struct Inside {
    #[joint(role = eye, heading = -35deg..=35deg, rate = 450deg)]
    pub(crate) eye: Joint,
}

/// A rig of a private module, for everyone.
pub use private::Hidden;

mod private {
    use aim::{AimRig, Joint, Rig};

    /// The rig.
    #[derive(Debug, AimRig)]
    #[aim(axes(up = +X, forward = +Y))]
    pub struct Hidden {
        #[joint(role = eye, pitch = -35deg..=35deg, rate = 450deg)]
        eye: Joint,
    }

    #[derive(Debug, AimRig)]
    #[aim(axes(up = +X, forward = +Y))]
    struct Private {
        #[joint(role = eye, pitch = -35deg..=35deg, rate = 450deg)]
        eye: Joint,
    }

    /// The joints of a rig that nobody else sees.
    #[must_use]
    pub fn joints() -> usize {
        Private::RIG.description().joints().len()
    }
}

pub use private::joints;

/// The joints of a rig that only this crate sees.
#[must_use]
pub fn inside() -> Joint {
    Inside::RIG.eye
}

/// The cosine between an eye's direction and the target's.
#[must_use]
#[differentiate(wrt(x, v), hessian)]
pub fn looks(x: f32, v: &Vec3, eye: Rigid) -> f32 {
    let turned = Vec3::from(eye.matrix3.y_axis).rotate_x(x);
    turned.dot(v.normalize()) + if x < 0.5 { x.sin() } else { x.exp() }
}

#[differentiate(wrt(v), budget = 3)]
fn doubled(v: Vec3, _unused: f32) -> Vec3 {
    Vec3::new(2.0 * v.x, v.y, v.z)
}

/// What only this crate differentiates.
#[must_use]
pub fn inner(v: Vec3) -> Vec3 {
    doubled_jacobian(v, 0.0).0
}

/// Code that was generated into a file: nothing excuses it from lints, as the expansion of a macro is excused.
pub mod generated {
    use aim::Joint;

    /// The golden expansion's struct.
    #[derive(Debug)]
    pub struct Thug {
        left_eye: Joint,
        neck: Joint,
        spine3: Joint,
    }

    include!("../../../expected/thug.rs");

    /// The golden expansion's struct.
    #[derive(Debug)]
    pub struct General {
        left_eye: Joint,
        r#neck: Joint,
    }

    include!("../../../expected/general.rs");
}

/// A strict crate lints what `build.rs` wrote, too: the bundled rigs stand under the facade's own lints.
#[cfg(test)]
mod tests {
    use aim::Rig;

    use super::{AimRig, Public, generated};

    #[test]
    fn the_rigs_are_usable() {
        assert_eq!(super::joints(), 1);
        assert_eq!(super::inside(), super::Joint::default());
        assert_eq!(super::inner(super::Vec3::X), super::Vec3::new(2.0, 0.0, 0.0));
        let (value, ..) = super::looks_hessian(0.0, &super::Vec3::Y, super::Rigid::IDENTITY);
        assert!((value - super::looks(0.0, &super::Vec3::Y, super::Rigid::IDENTITY)).abs() < 1e-6);
        assert!((value - super::looks_gradient(0.0, &super::Vec3::Y, super::Rigid::IDENTITY).0).abs() < 1e-6);
        assert_eq!(Public::RIG.description().joints().len(), 2);
        assert_eq!(generated::Thug::RIG.description().joints().len(), 3);
        assert_eq!(generated::General::RIG.description().joints().len(), 2);
    }
}
