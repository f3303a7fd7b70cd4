//! [`AimSettings`]: how a character aims; [`AimSnap`]: at once.

use aim::{Ascent, Behind, GazeSharing, Settings, Solver};
use bevy_ecs::component::Component;
#[cfg(feature = "reflect")]
use bevy_ecs::reflect::ReflectComponent;
#[cfg(feature = "reflect")]
use bevy_reflect::std_traits::ReflectDefault;

/// The settings of a character's aim: the fields of [`Settings`], where they are explained.
///
/// A [`weight`](Self::weight) of 0 leaves the character to its animation: its joints go back at their rates.
#[derive(Component, Clone, Debug, PartialEq)]
#[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect))]
#[cfg_attr(feature = "reflect", reflect(Component, Default, Debug, PartialEq, Clone))]
pub struct AimSettings {
    /// Share of the way to the target, 0…1.
    pub weight: f32,
    /// The angle up to which the target counts as reached, radians.
    pub tolerance: f32,
    /// The joint that is aimed, from the effector inward; 0 is the effector.
    pub effector: usize,
    /// Share of the head in a natural gaze beyond what people do without thinking, 0…1.
    pub attention: f32,
    /// For how long a natural gaze stays with a target out of reach, seconds.
    pub patience: f32,
    /// Policy for targets behind.
    #[cfg_attr(feature = "reflect", reflect(ignore))]
    pub behind: Behind,
    /// Solver; `None` leaves it to the rig.
    #[cfg_attr(feature = "reflect", reflect(ignore))]
    pub solver: Option<Solver>,
    /// Sharing of a natural gaze; `None` leaves it to the rig.
    #[cfg_attr(feature = "reflect", reflect(ignore))]
    pub sharing: Option<GazeSharing>,
    /// Steps of [`Solver::Ascent`].
    #[cfg_attr(feature = "reflect", reflect(ignore))]
    pub ascent: Ascent,
}

impl AimSettings {
    /// The settings as solvers take them.
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

/// Puts a character on its target at once, whatever its rates, as soon as its bones are found and there is a target: after a
/// spawn, or a cut of the camera. The component is taken off when that is done.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect))]
#[cfg_attr(feature = "reflect", reflect(Component, Default, Debug, PartialEq, Clone))]
pub struct AimSnap;
