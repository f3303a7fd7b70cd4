//! The guide: the pages of the folder `docs`. Their examples run as tests.
//!
//! - **First steps**: [`axes`] explains how to find which axis of a bone points forward, [`natural_gaze`] how eyes,
//!   head and chest share a gaze, [`viewer`] how to watch it, and [`solvers`] which solver to choose.
//! - **Playing animation**: [`animation`], then [`tracks`], [`playing`], [`blending`], [`root_motion`], [`reach`] and
//!   [`layers`]; [`animation_coverage`] lists the features of the animation library and how each is tested.
//! - **Other solvers**, in [`ik`](crate::ik): [`two_bone`], [`ccd`], [`one_bone`], [`look_at`], [`aim_poses`].
//! - **Derivatives**: [`differentiating`] your own functions, [`singularities`], [`operation_counts`].
//! - **Source**: [`paper`].

/// Declares one module per page. Links between the Markdown files are redirected to these modules by `guide_links.md`:
/// it is included first, and the first definition of a link takes precedence.
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
    // The crate `derivand` includes this page too and runs its examples.
    #[cfg(not(doctest))]
    differentiating "differentiating.md"
    singularities "singularities.md"
    operation_counts "operation-counts.md"
    paper "paper.md"
}

// rustdoc does not copy files beside a page, so the figure is embedded below the text.
#[doc = include_str!("guide_links.md")]
#[doc = include_str!("../docs/natural-gaze.md")]
///
/// # The figure
///
#[doc = include_str!("../docs/natural-gaze.svg")]
pub mod natural_gaze {}
