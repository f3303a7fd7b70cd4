//! [`AimPlugin`]: the systems in their order.

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

/// The systems that aim, in `PostUpdate`: after [`AnimationSystems`] and before [`TransformSystems::Propagate`]. What is to be aimed
/// over, such as constraints of your own, comes before them; what hangs on aimed bones, such as a weapon that is placed by code, after
/// them.
#[derive(Debug, Hash, PartialEq, Eq, Clone, Copy, SystemSet)]
pub struct AimSystems;

impl AimPlugin {
    /// The systems in another schedule than `PostUpdate`, such as `FixedPostUpdate`: for characters that are animated there, too. In
    /// frames in which they do not run, a clip that plays in `PostUpdate` would put its bones back.
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
        // Where scenes have just been spawned, and are not animated yet.
        app.add_systems(PostUpdate, find_bones.before(AnimationSystems).before(AimSystems));
        app.add_systems(self.schedule, (solve_aims, apply_aims, report_aims).chain().in_set(AimSystems));
        app.configure_sets(self.schedule, AimSystems.after(AnimationSystems).before(TransformSystems::Propagate));
    }

    #[cfg(any(feature = "assets", feature = "gizmos"))]
    fn finish(&self, app: &mut App) {
        // Whether there are assets, or gizmos, is known when all plugins are there.
        #[cfg(feature = "assets")]
        crate::asset::build(app);
        #[cfg(feature = "gizmos")]
        crate::gizmos::build(app);
    }
}
