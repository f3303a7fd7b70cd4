//! [`Conventions`] of a rig.

use super::axes::Axes;
use crate::Frame;

/// What the joints inherit from the rig.
pub(super) struct Conventions<'t> {
    /// The sign of `up × forward · left` that unmirrored axes have: 1 in a right-handed rig.
    pub(super) hand: f64,
    pub(super) axes: Option<Axes<'t>>,
    /// The frame of the rig's axes.
    pub(super) frame: Option<Frame>,
}
