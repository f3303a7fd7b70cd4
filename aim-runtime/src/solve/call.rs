//! [`Call`]: what is asked for, and what it says to all solvers.

use glam::Vec3;

use crate::kinematics::chain::Upright;
use crate::math::Bounded;
use crate::rig::PoseSlices;
use crate::{Settings, Solver, math};

/// The longest frame, seconds: after a hitch nothing leaps.
pub(crate) const LONGEST_FRAME_S: f32 = 0.1;

/// What a call asks for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Call<'a> {
    /// The target, in the pose's space.
    pub(crate) target_ps: Vec3,
    /// The frame's length, seconds; `None` for a snap.
    pub(crate) dt: Option<f32>,
    pub(crate) settings: &'a Settings,
}

impl<'a> Call<'a> {
    /// A call with the frame's length as it counts: 0…0.1 s, 0 for NaN.
    #[inline(always)]
    pub(crate) fn new(target_ps: Vec3, dt: Option<f32>, settings: &'a Settings) -> Self {
        let counted = |dt: f32| dt.at_least(0.0).at_most(LONGEST_FRAME_S);
        Self { target_ps, dt: dt.map(counted), settings }
    }
}

/// What upright headings turn about in this pose. The paper's method knows bones only.
pub(crate) fn upright_axis(pose: &PoseSlices<'_>, solver: Solver) -> Upright {
    if solver == Solver::Ascent {
        return Upright::Off;
    }
    pose.up.and_then(|up| math::direction(up.into())).map_or(Upright::Innermost, Upright::About)
}
