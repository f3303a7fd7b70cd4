//! [`Sharing`]: the gaze-sharing parameters of a call.

use crate::math::Bounded;
use crate::{GazeSharing, Settings};

/// The gaze-sharing parameters that apply to a call: declared or overridden, clamped, and scaled by the attention.
pub(super) struct Sharing {
    pub(super) eyes_only: f32,
    pub(super) head_share: f32,
    pub(super) engage: f32,
    pub(super) release: f32,
    pub(super) delay: f32,
}

impl Sharing {
    pub(super) fn new(declared: &GazeSharing, settings: &Settings) -> Self {
        // The comparisons return the bound for NaN.
        let attention = settings.attention.at_least(0.0).at_most(1.0);
        let sharing = settings.sharing.as_ref().unwrap_or(declared);
        let share = sharing.head_share.at_least(0.0).at_most(1.0);
        let left_to_eyes = 1.0 - attention;
        Self {
            eyes_only: sharing.eyes_only.at_least(0.0) * left_to_eyes,
            head_share: share + (1.0 - share) * attention,
            engage: sharing.engage.at_least(0.0) * left_to_eyes,
            release: sharing.release.at_least(0.0) * left_to_eyes,
            delay: sharing.delay.at_least(0.0),
        }
    }

    /// Returns the part of a gaze shift that the regions make: g·max(0, E − D)/E.
    pub(super) fn head_part(&self, shift: f32) -> f32 {
        let beyond = shift - self.eyes_only;
        if beyond > 0.0 { self.head_share * beyond / shift } else { 0.0 }
    }
}
