//! [`Conventions`]: the settings that joints inherit from their rig.

use super::axes::Axes;
use crate::Frame;

/// Settings that joints inherit from the rig.
pub(super) struct Conventions<'t> {
    /// Sign of `(up × forward) · left` for unmirrored axes: 1 in a right-handed rig, -1 in a left-handed one.
    pub(super) hand: f64,
    pub(super) axes: Option<Axes<'t>>,
    /// Frame of the rig's axes.
    pub(super) frame: Option<Frame>,
}
