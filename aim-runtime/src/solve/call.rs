//! [`Call`]: the inputs of one call.

use glam::Vec3;

use crate::kinematics::chain::Upright;
use crate::math::Bounded;
use crate::rig::{ChainRig, PoseSlices};
use crate::{Settings, Solver, math};

/// The longest frame, seconds. A longer one after a hitch is shortened to this, so that nothing jumps.
pub(crate) const LONGEST_FRAME_S: f32 = 0.1;

/// The inputs of one call.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Call<'a> {
    /// The target, in the pose's space.
    pub(crate) target_ps: Vec3,
    /// The length of the frame, seconds; `None` for a snap.
    pub(crate) dt: Option<f32>,
    pub(crate) settings: &'a Settings,
}

impl<'a> Call<'a> {
    /// Creates a call. Clamps `dt` to 0…0.1 s; NaN counts as 0.
    #[inline(always)]
    pub(crate) fn new(target_ps: Vec3, dt: Option<f32>, settings: &'a Settings) -> Self {
        let counted = |dt: f32| dt.at_least(0.0).at_most(LONGEST_FRAME_S);
        Self { target_ps, dt: dt.map(counted), settings }
    }
}

/// Returns the axis of upright headings in this pose. The steepest ascent has none, as in the paper.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn upright_axis(pose: &PoseSlices<'_>, solver: Solver) -> Upright {
    if solver == Solver::Ascent {
        return Upright::Off;
    }
    pose.up.and_then(|up| math::direction(up.into())).map_or(Upright::Innermost, Upright::About)
}

/// Returns the solver selected by the settings, or else the rig's default.
pub(crate) fn solver<const C: usize>(rig: &ChainRig<'_, C>, settings: &Settings) -> Solver {
    settings.solver.unwrap_or(rig.default_solver())
}
