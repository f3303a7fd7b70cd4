//! [`Sharing`]: the gaze-sharing parameters of a call.

use glam::Vec4;

use super::glide::Pair;
use super::range::Range;
use crate::math::Bounded;
use crate::{GazeSharing, Settings};

/// Part of an eye's range that it is allotted at most. The margin covers the error of adding headings and elevations.
pub(super) const EYE_PART: f32 = 0.98;
/// Part of an eye's range that is left to the regions at a head share of 1, as long as they have room. People's eyes can
/// turn by 50°, but come to rest beside a turned head within a customary range that is 44° wide on average (Stahl, *Exp.
/// Brain Res.* 126, 1999).
const UNCUSTOMARY_PART: f32 = 0.35;

/// The gaze-sharing parameters that apply to a call: declared or overridden, clamped, and scaled by the attention.
pub(super) struct Sharing<'a> {
    parameters: &'a GazeSharing,
    /// The factor on the shifts that the eyes make alone: 1 − attention.
    left_to_eyes: f32,
    head_share: f32,
}

impl<'a> Sharing<'a> {
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn new(declared: &'a GazeSharing, settings: &'a Settings) -> Self {
        // The comparisons return the bound for NaN.
        let attention = settings.attention.at_least(0.0).at_most(1.0);
        let parameters = settings.sharing.as_ref().unwrap_or(declared);
        let share = parameters.head_share.at_least(0.0).at_most(1.0);
        Self { parameters, left_to_eyes: 1.0 - attention, head_share: share + (1.0 - share) * attention }
    }

    fn eyes_only(&self) -> f32 {
        self.parameters.eyes_only.at_least(0.0) * self.left_to_eyes
    }

    pub(super) fn engage(&self) -> f32 {
        self.parameters.engage.at_least(0.0) * self.left_to_eyes
    }

    pub(super) fn release(&self) -> f32 {
        self.parameters.release.at_least(0.0) * self.left_to_eyes
    }

    pub(super) fn delay(&self) -> f32 {
        self.parameters.delay.at_least(0.0)
    }

    /// Returns the least and the greatest turn of an eye while the regions have room: about its rest, a part of its
    /// range, which the shifts that it makes alone extend. `glance` is the turn of the animated eye out of its rest.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn customary_range(&self, eye: &Range<'_>, glance: Pair) -> [Pair; 2] {
        let [lo, hi] = [eye.lo, eye.hi].map(|end| (end + glance) * EYE_PART);
        let (part, alone) = (1.0 - UNCUSTOMARY_PART * self.head_share, Vec4::splat(self.eyes_only()));
        [(lo * part).min(-alone).max(lo) - glance, (hi * part).max(alone).min(hi) - glance]
    }

    /// Returns the part of a gaze shift that the regions make: g·max(0, E − D)/E.
    pub(super) fn head_part(&self, shift: f32) -> f32 {
        let beyond = shift - self.eyes_only();
        if beyond > 0.0 { self.head_share * beyond / shift } else { 0.0 }
    }
}
