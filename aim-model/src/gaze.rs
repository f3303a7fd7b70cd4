//! [`GazeSharing`]: how a gaze is shared between the eyes and the joints that support them.

/// How a natural gaze is shared between the eyes and the joints that support them.
///
/// Joint 0 is the eye, the others support it. Where the target appears, the eye leaps there within its rate and range,
/// and holds it. The supporting joints get a goal: their share of the gaze shift with the least stiffness-weighted
/// displacement, and more where the eye could not do the rest. They follow that with inertia: they take up speed by
/// their acceleration and brake so that they stop there. Meanwhile the eye solves in
/// each frame exactly what they leave, and so turns back as they arrive. Ranges and rates hold before everything else.
/// A joint without a declared acceleration has 500°/s² in the [chest](crate::Role::Chest), else 1200°/s².
///
/// Declared per rig, and overridden per call by the runtime's settings. Angles that are negative or NaN count as 0.
/// The attention of a call lessens `eyes_only`, `engage` and `release` to nothing and brings `head_share`
/// to 1: then the head alone ends up turned to the target.
///
/// # What people do
///
/// The defaults are of the size that is measured; people differ widely in how much they move their heads (Fuller, *Head
/// movement propensity*, Exp. Brain Res. 1992), which is what these numbers are for.
///
/// - *Eyes alone.* Within about 15° of their middle the eyes tend to shift the gaze by themselves: the customary
///   oculomotor range, of some 50° to either side that the eye can mechanically be turned. Monkeys turn their heads
///   hardly at all for shifts below 20°, and beyond 25° by an amount that grows linearly with the shift, while the eye's
///   part saturates at about 35° (Freedman and Sparks, J. Neurophysiol. 77, 1997). Hence a zone and a slope.
/// - *Who is first.* The head follows the saccade by 20 to 40 ms whatever the target's angle (*The reaction time of
///   eye-head coordination in man*), partly as it is heavy: the neck of the default reaches 1° some 40 ms after the eye.
/// - *How fast.* Peak speed and duration of a saccade follow from its size, the main sequence (Bahill, Clark and Stark,
///   1975): 213, 352 and 455°/s for 5, 15 and 30° in a hundred people (PMC6143243). A rate of 450°/s for an eye is that
///   of large saccades; small ones are quicker here than people's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GazeSharing<T = f32> {
    /// The gaze shift that the eyes make alone, radians: `D` in head shift = `g·max(0, |E| − D)`. `E` is the angle from
    /// the animated gaze to the target. Default 15°.
    pub eyes_only: T,
    /// The part of the gaze shift beyond that which the head makes, 0…1: `g`. Default 0.8.
    pub head_share: T,
    /// The supporting joints begin to move when the target is further from the eyes' middle than this, radians, or out
    /// of the eyes' range. Default 15°.
    pub engage: T,
    /// They rest again once they have arrived and the target is nearer the eyes' middle than this, radians. Default 8°.
    pub release: T,
    /// How long after the eyes the supporting joints begin, seconds: beside what their inertia takes. Default 0.
    pub delay: T,
}

macro_rules! human {
    ($float:ident) => {
        impl GazeSharing<$float> {
            /// The defaults: of the size that is measured of people.
            pub const HUMAN: Self = {
                const DEG: $float = core::$float::consts::PI / 180.0;
                Self { eyes_only: 15.0 * DEG, head_share: 0.8, engage: 15.0 * DEG, release: 8.0 * DEG, delay: 0.0 }
            };
        }

        impl Default for GazeSharing<$float> {
            fn default() -> Self {
                Self::HUMAN
            }
        }
    };
}

human!(f32);
human!(f64);

impl<T: Copy> GazeSharing<T> {
    /// With this [`eyes_only`](Self::eyes_only) zone, radians.
    #[must_use]
    pub const fn with_eyes_only(mut self, angle_rad: T) -> Self {
        self.eyes_only = angle_rad;
        self
    }

    /// With this [`head_share`](Self::head_share), 0…1.
    #[must_use]
    pub const fn with_head_share(mut self, share: T) -> Self {
        self.head_share = share;
        self
    }

    /// With supporting joints that [engage](Self::engage) and [release](Self::release) at these angles, radians.
    #[must_use]
    pub const fn with_engagement(mut self, engage_rad: T, release_rad: T) -> Self {
        self.engage = engage_rad;
        self.release = release_rad;
        self
    }

    /// With this [`delay`](Self::delay), seconds.
    #[must_use]
    pub const fn with_delay(mut self, seconds: T) -> Self {
        self.delay = seconds;
        self
    }
}
