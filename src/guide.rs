//! The guide: the pages of the folder `docs`, whose examples are run.
//!
//! - **To begin with**: [`axes`] tells which axis of a bone is forward, [`natural_gaze`] how eyes, head and chest share a gaze,
//!   [`viewer`] how to see it. [`solvers`] tells when to use which.
//! - **Animation under the aim**: [`animation`], then [`tracks`], [`playing`], [`blending`], [`root_motion`],
//!   [`reach`] and [`layers`]; [`animation_coverage`] lists what it answers and what judges it.
//! - **Other solvers**, in [`ik`](crate::ik): [`two_bone`], [`ccd`], [`one_bone`], [`look_at`], [`aim_poses`].
//! - **Derivatives**: [`differentiating`] your own functions, [`singularities`], [`operation_counts`].
//! - **Where it comes from**: [`paper`].

/// Pages by their files. Links between them are those of the files, led to modules by `guide_links.md`, whose definitions come
/// first and so count.
macro_rules! pages {
    ($($(#[$condition:meta])? $name:ident $file:literal)*) => {$(
        $(#[$condition])?
        #[doc = include_str!("guide_links.md")]
        #[doc = include_str!(concat!("../docs/", $file))]
        pub mod $name {}
    )*};
}

pages! {
    axes "axes.md"
    viewer "viewer.md"
    solvers "solvers.md"
    #[cfg(any(not(doctest), feature = "animation"))]
    animation "animation.md"
    animation_coverage "animation-coverage.md"
    #[cfg(any(not(doctest), feature = "animation"))]
    tracks "tracks.md"
    #[cfg(any(not(doctest), feature = "animation"))]
    playing "playing.md"
    #[cfg(any(not(doctest), feature = "animation"))]
    blending "blending.md"
    #[cfg(any(not(doctest), feature = "animation"))]
    deforming "deforming.md"
    #[cfg(any(not(doctest), feature = "animation"))]
    root_motion "root-motion.md"
    #[cfg(any(not(doctest), feature = "animation"))]
    storage "storage.md"
    reach "reach.md"
    #[cfg(any(not(doctest), feature = "animation"))]
    layers "layers.md"
    two_bone "two-bone.md"
    ccd "ccd.md"
    one_bone "one-bone.md"
    look_at "look-at.md"
    aim_poses "aim-poses.md"
    // Its examples are those of the crate `derivand`, which runs them.
    #[cfg(not(doctest))]
    differentiating "differentiating.md"
    singularities "singularities.md"
    operation_counts "operation-counts.md"
    paper "paper.md"
}

// The figure stands below the page: a file beside it is not part of the documentation.
#[doc = include_str!("guide_links.md")]
#[doc = include_str!("../docs/natural-gaze.md")]
///
/// # The figure
///
#[doc = include_str!("../docs/natural-gaze.svg")]
pub mod natural_gaze {}
