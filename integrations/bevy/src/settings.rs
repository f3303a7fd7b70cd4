//! [`AimSettings`]: the settings of a character's aim. [`AimSnap`]: aims it at once.

use aim::{Ascent, Behind, GazeSharing, Settings, Solver};
use bevy_ecs::component::Component;
#[cfg(feature = "reflect")]
use bevy_ecs::reflect::ReflectComponent;
#[cfg(feature = "reflect")]
use bevy_reflect::std_traits::ReflectDefault;

/// Settings of a character's aim. The fields are those of [`Settings`], which explains them in full.
///
/// With a [`weight`](Self::weight) of 0 the character follows its animation: its joints return at their rates.
#[derive(Component, Clone, Debug, PartialEq)]
#[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect))]
#[cfg_attr(feature = "reflect", reflect(Component, Default, Debug, PartialEq, Clone))]
pub struct AimSettings {
    /// Fraction of the arc from the animated direction to the target at which the gaze is aimed, 0…1.
    pub weight: f32,
    /// Remaining angle up to which the target counts as reached, radians.
    pub tolerance: f32,
    /// Index of the joint that is aimed, counted from the effector inward; 0 is the effector.
    pub effector: usize,
    /// Degree to which the head takes over from the eyes in a natural gaze, 0…1: at 0 they share the gaze as the rig's
    /// [`GazeSharing`] declares, at 1 the head turns fully to the target.
    pub attention: f32,
    /// Time for which a natural gaze stays on a target that is out of reach, seconds.
    pub patience: f32,
    /// Policy for targets behind the character.
    #[cfg_attr(feature = "reflect", reflect(ignore))]
    pub behind: Behind,
    /// Solver; `None` selects the rig's default.
    #[cfg_attr(feature = "reflect", reflect(ignore))]
    pub solver: Option<Solver>,
    /// Division of a natural gaze between eyes and head; `None` selects the rig's own.
    #[cfg_attr(feature = "reflect", reflect(ignore))]
    pub sharing: Option<GazeSharing>,
    /// Parameters of [`Solver::Ascent`].
    #[cfg_attr(feature = "reflect", reflect(ignore))]
    pub ascent: Ascent,
}

impl AimSettings {
    /// Converts to the settings of the solver.
    #[must_use]
    pub fn to_settings(&self) -> Settings {
        let mut settings = Settings::default()
            .with_weight(self.weight)
            .with_tolerance(self.tolerance)
            .with_effector(self.effector)
            .with_attention(self.attention)
            .with_patience(self.patience)
            .with_behind(self.behind)
            .with_ascent(self.ascent);
        (settings.solver, settings.sharing) = (self.solver, self.sharing);
        settings
    }
}

impl From<Settings> for AimSettings {
    fn from(settings: Settings) -> Self {
        Self {
            weight: settings.weight,
            tolerance: settings.tolerance,
            effector: settings.effector,
            attention: settings.attention,
            patience: settings.patience,
            behind: settings.behind,
            solver: settings.solver,
            sharing: settings.sharing,
            ascent: settings.ascent,
        }
    }
}

impl Default for AimSettings {
    fn default() -> Self {
        Settings::default().into()
    }
}

/// Aims a character at its target at once, without regard to its rates, as soon as its bones are found and it has a
/// target: for a spawn or a camera cut. The plugin removes the component when that is done.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect))]
#[cfg_attr(feature = "reflect", reflect(Component, Default, Debug, PartialEq, Clone))]
pub struct AimSnap;
