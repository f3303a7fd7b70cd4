//! The worst neighbourhood for emitted code: no prelude, and whatever it could name means something else.
#![no_implicit_prelude]
#![allow(
    dead_code,
    non_camel_case_types,
    non_upper_case_globals,
    missing_docs,
    clippy::all,
    reason = "the neighbours are never used and badly named on purpose"
)]

mod core {}
mod std {}
mod alloc {}
mod aim {}
mod glam {}
mod __private {}

pub struct Option;
pub struct Result;
pub struct Vec;
pub struct String;
pub struct Box;
pub struct Joint;
pub struct JointInfo;
pub struct Axes;
pub struct Effector;
pub struct S;
pub struct T;
pub struct Scalar;
pub struct AimRig;
pub trait Default {}
pub trait Debug {}
pub trait Copy {}
pub trait Clone {}
pub trait Into {}
pub trait From {}
pub trait TryFrom {}
pub trait TryInto {}
pub trait Iterator {}
pub trait AsRef {}
pub trait Drop {}
pub trait Fn {}
pub trait Sized {}
pub trait Send {}
pub type f32 = ();
pub type f64 = ();
pub type usize = ();
pub type u32 = ();
pub type bool = ();
pub type char = ();
pub type str = ();
pub const Some: () = ();
pub const None: () = ();
pub const Ok: () = ();
pub const Err: () = ();
pub const INFOS: () = ();
pub const BONES: () = ();
pub const ZERO: () = ();
pub const TINY: () = ();
// Patterns of these names would not bind, but compare.
pub const joint: () = ();
pub const effector_to_joint: () = ();
pub const target: () = ();
pub const sin_cos: () = ();
pub const links: () = ();
pub const out: () = ();
pub const value: () = ();
pub const states: () = ();
pub const formatter: () = ();
pub const f: () = ();
pub const m: () = ();
pub const x: () = ();
pub const left_eye: () = ();
pub const neck: () = ();
pub fn aim_gradient() {}
pub fn aim_gradient_0() {}
pub fn aim_gradient_1() {}
pub fn value_gradient() {}
pub fn residual_jacobian() {}
pub fn chain_value_gradient() {}
pub fn chain_residual_jacobian() {}
pub fn drop() {}

macro_rules! constants {
    ($($name:ident)*) => { $(pub const $name: () = ();)* };
}

constants! {
    v0 v1 v2 v3 v4 v5 v6 v7 v8 v9 v10 v11 v12 v13 v14 v15 v16 v17 v18 v19 v20 v21 v22 v23 v24 v25 v26 v27 v28 v29
    v30 v31 v32 v33 v34 v35 v36 v37 v38 v39 v40 v41 v42 v43 v44 v45 v46 v47 v48 v49 v50 v51 v52 v53 v54 v55 v56 v57
    v58 v59 v60 v61 v62 v63 v64 v65 v66 v67 v68 v69 v70 v71 v72 v73 v74 v75 v76 v77 v78 v79 v80 v81 v82 v83 v84 v85
}

/// Methods of every type, found before any that borrows.
pub trait Methods: ::core::marker::Sized {
    fn field(self) {}
    fn finish(self) {}
    fn fill(self) {}
    fn sqrt(self) {}
    fn try_from(self) {}
    fn debug_struct(self) {}
    fn default() {}
    fn fmt(self) {}
    fn array(self) {}
    fn sin_cos(self) {}
    fn select_less(self) {}
    fn from_cols_array(self) {}
}

impl<Any> Methods for Any {}

/// Two joints with kernels of their own.
#[derive(::aim::AimRig)]
#[aim(axes(up = +X, forward = +Y), effector(forward = (0.0, 0.8, 0.6), origin = (0.0, 0.1, 0.0)), natural(delay = 0.1))]
pub struct Thug {
    #[joint(role = eye, heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg, acceleration = 90rad)]
    left_eye: ::aim::Joint,
    #[joint(role = neck, heading = free, pitch = -25deg..=20deg, rate = 90deg, axes(up = +Z, forward = +X), upright = 0.5)]
    neck: ::aim::Joint,
}

/// A differentiated function; its types are written out, as its neighbours' are not what they seem.
#[::aim::differentiate(wrt(radians, v), hessian)]
pub fn turned(radians: ::core::primitive::f32, v: ::aim::glam::Vec3) -> ::core::primitive::f32 {
    let (sine, cosine) = (radians.sin(), radians.cos());
    (<::aim::glam::Vec3>::new(sine, cosine, radians) / v.length()).dot(v)
}

/// Its Jacobian's matrix stands beside its vector.
#[::aim::differentiate(wrt(v))]
pub fn scaled(v: ::aim::glam::Vec3) -> ::aim::glam::Vec3 {
    v * v.x
}

/// Rigs called as the type parameters of emitted code are.
mod parameters {
    #[derive(::aim::AimRig)]
    #[aim(axes(up = +X, forward = +Y))]
    struct S {
        #[joint(heading = -35deg..=35deg, rate = 450deg)]
        s: ::aim::Joint,
    }

    #[derive(::aim::AimRig)]
    #[aim(axes(up = +X, forward = +Y))]
    struct T {
        #[joint(heading = -35deg..=35deg, rate = 450deg)]
        t: ::aim::Joint,
    }
}

#[cfg(test)]
mod tests {
    use ::std::prelude::rust_2024::*;
    use ::std::{assert, assert_eq};

    #[test]
    fn the_function_means_what_it_says() {
        let v = ::aim::glam::Vec3::X;
        let (value, (by_x, _)) = super::turned_gradient(0.0, v);
        assert_eq!((value, by_x), (super::turned(0.0, v), 1.0));
        assert_eq!(super::scaled_jacobian(v).1.0.x_axis, 2.0 * v);
    }

    #[test]
    fn the_rig_means_what_it_says() {
        let mut thug = <::aim::Aim<super::Thug>>::new();
        assert!(thug.joints().left_eye == ::aim::Joint::REST && thug.joints().neck == ::aim::Joint::REST);
        let rig = <super::Thug as ::aim::AimRig>::RIG;
        assert_eq!([0, 1].map(|joint| ::aim::Rig::bone_name(rig, joint, 0)), [Some("left_eye"), Some("neck")]);
        let pose = <::aim::Pose<_>>::new([::aim::glam::Affine3A::IDENTITY; 2]);
        let settings = <::aim::Settings as ::core::default::Default>::default();
        let outcome = thug.snap(&pose, ::aim::glam::Vec3::new(0.5, 2.0, 2.0), &settings).outcome;
        assert_eq!(outcome.status, ::aim::Status::Reached, "{outcome:?}");
    }
}
