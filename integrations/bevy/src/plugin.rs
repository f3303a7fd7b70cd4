//! [`AimPlugin`]: adds the systems in their order.

use bevy_app::{AnimationSystems, App, Plugin, PostUpdate};
use bevy_ecs::intern::Interned;
use bevy_ecs::schedule::{IntoScheduleConfigs, ScheduleLabel, SystemSet};
use bevy_transform::TransformSystems;

use crate::find::find_bones;
use crate::report::{self, report_aims};
use crate::solve::{apply_aims, solve_aims};

/// Aims every [`AimCharacter`](crate::AimCharacter) after its animation and before Bevy propagates transforms.
///
/// ```
/// use bevy_aim::AimPlugin;
/// use bevy_app::App;
///
/// let mut app = App::new();
/// app.add_plugins(AimPlugin::default());
/// ```
#[derive(Clone, Copy, Debug)]
pub struct AimPlugin {
    schedule: Interned<dyn ScheduleLabel>,
}

/// System set of the systems that aim, in `PostUpdate` unless configured otherwise: after [`AnimationSystems`] and
/// before [`TransformSystems::Propagate`]. Run systems that pose bones, such as your own constraints, before it, and
/// systems that follow aimed bones, such as the placement of a weapon, after it.
#[derive(Debug, Hash, PartialEq, Eq, Clone, Copy, SystemSet)]
pub struct AimSystems;

impl AimPlugin {
    /// Creates a plugin that aims in another schedule than `PostUpdate`, such as `FixedPostUpdate`. The characters must
    /// be animated in that schedule, too: a clip that plays in `PostUpdate` would reset the bones in frames in which
    /// the aiming systems do not run.
    pub fn in_schedule(schedule: impl ScheduleLabel) -> Self {
        Self { schedule: schedule.intern() }
    }
}

impl Default for AimPlugin {
    fn default() -> Self {
        Self::in_schedule(PostUpdate)
    }
}

impl Plugin for AimPlugin {
    fn build(&self, app: &mut App) {
        app.add_observer(report::release).add_observer(report::restore).add_observer(report::lose);
        #[cfg(feature = "reflect")]
        app.register_type::<crate::AimSettings>()
            .register_type::<crate::AimTarget>()
            .register_type::<crate::AimOutcome>()
            .register_type::<crate::AimSnap>();
        // At this point, new scenes have been spawned but not animated yet.
        app.add_systems(PostUpdate, find_bones.before(AnimationSystems).before(AimSystems));
        app.add_systems(self.schedule, (solve_aims, apply_aims, report_aims).chain().in_set(AimSystems));
        app.configure_sets(self.schedule, AimSystems.after(AnimationSystems).before(TransformSystems::Propagate));
    }

    #[cfg(any(feature = "assets", feature = "gizmos"))]
    fn finish(&self, app: &mut App) {
        // In `finish`, because the asset and gizmo plugins may be added after this one.
        #[cfg(feature = "assets")]
        crate::asset::build(app);
        #[cfg(feature = "gizmos")]
        crate::gizmos::build(app);
    }
}
