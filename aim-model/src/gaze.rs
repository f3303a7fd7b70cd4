//! [`GazeSharing`]: how a gaze is shared between the eyes and the joints that support them; [`Budgets`]: what the parts of
//! the body can do.

/// How a natural gaze is shared between the eyes and the joints that support them.
///
/// Joint 0 is the eye, the others support it. Where the target appears, the eye leaps there within its rate and range,
/// and holds it. The supporting joints get a goal: their share of the gaze shift's heading and elevation, each part of the body
/// by its compliance (1/stiffness) within its [budget](Budgets), and more where the eye could not do the rest. They glide
/// there in one smooth movement. Meanwhile the eye turns in each frame to exactly what they leave, and so turns back as
/// they arrive. Ranges hold before rates, rates before accelerations.
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
///   eye-head coordination in man*), partly as it is heavy: the neck of the default reaches 1° some 50 ms after the eye where
///   the gaze shifts by 60°, 80 ms where it shifts by 30°.
/// - *How fast.* Peak speed and duration of a saccade follow from its size, the main sequence (Bahill, Clark and Stark,
///   1975): 213, 352 and 455°/s for 5, 15 and 30° in a hundred people (PMC6143243). An eye with a rate of 450°/s comes to 240,
///   415 and 450°/s here.
///
/// ```
/// use aim_model::GazeSharing;
///
/// // A lizard: eyes that do much by themselves, and a head that does little.
/// let lizard = GazeSharing::<f32>::default().with_eyes_only(0.6).with_head_share(0.3);
/// assert_eq!((lizard.eyes_only, lizard.delay), (0.6, 0.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        default,
        bound(
            serialize = "T: crate::stored::Stored + Default",
            deserialize = "T: crate::stored::Stored + Default, GazeSharing<T>: Default"
        )
    )
)]
pub struct GazeSharing<T = f32> {
    /// The gaze shift that the eyes make alone, radians: `D` in head shift = `g·max(0, |E| − D)`. `E` is the angle from
    /// the animated gaze to the target. Default 15°.
    #[cfg_attr(feature = "serde", serde(with = "crate::stored"))]
    pub eyes_only: T,
    /// The part of the gaze shift beyond that which the head makes, 0…1: `g`. Default 0.8.
    #[cfg_attr(feature = "serde", serde(with = "crate::stored"))]
    pub head_share: T,
    /// The supporting joints begin to move when the target is further from the eyes' middle than this, radians, or out
    /// of the eyes' range. Default 15°.
    #[cfg_attr(feature = "serde", serde(with = "crate::stored"))]
    pub engage: T,
    /// They rest again once they have arrived and the target is nearer the eyes' middle than this, radians. Default 8°.
    #[cfg_attr(feature = "serde", serde(with = "crate::stored"))]
    pub release: T,
    /// How long after the eyes the supporting joints begin, seconds: beside what their inertia takes. Default 0.
    #[cfg_attr(feature = "serde", serde(with = "crate::stored"))]
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

/// Bounds of the turn that the joints of one part of the body make together. Angles in radians.
///
/// A budget bounds the animation's own turn (out of what the part stands on) and the added one together. Where the
/// animation exceeds it, nothing is added.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: crate::stored::Stored + Default",
        deserialize = "T: crate::stored::Stored + Default"
    ))
)]
pub struct Budget<T = f32> {
    /// Headings, right and left: `[lo, hi]` around 0.
    #[cfg_attr(feature = "serde", serde(with = "crate::stored"))]
    pub heading: [T; 2],
    /// Elevations, down and up: `[lo, hi]` around 0.
    #[cfg_attr(feature = "serde", serde(with = "crate::stored"))]
    pub pitch: [T; 2],
    /// The largest speed of the sum of the part's headings, and of its pitches, rad/s.
    #[cfg_attr(feature = "serde", serde(with = "crate::stored"))]
    pub rate: T,
    /// The largest change of those speeds, rad/s². It also sets the pace: a turn takes about 2.5/√acceleration seconds.
    #[cfg_attr(feature = "serde", serde(with = "crate::stored"))]
    pub acceleration: T,
}

/// The budgets of the parts of a body.
///
/// ```
/// use aim_model::{Budget, Budgets};
///
/// let human = Budgets::<f32>::HUMAN;
/// let stiff = Budgets { head: Budget { heading: [-0.5, 0.5], ..human.head }, ..human };
/// assert_eq!(stiff.head.rate, human.head.rate);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        default,
        bound(
            serialize = "T: crate::stored::Stored + Default",
            deserialize = "T: crate::stored::Stored + Default, Budgets<T>: Default"
        )
    )
)]
pub struct Budgets<T = f32> {
    /// Head and neck together: [`Role::Head`](crate::Role::Head) and [`Role::Neck`](crate::Role::Neck).
    pub head: Budget<T>,
    /// The upper torso: [`Role::Chest`](crate::Role::Chest).
    pub chest: Budget<T>,
}

macro_rules! budgets {
    ($float:ident) => {
        impl Budgets<$float> {
            /// A human's: the neck turns by 70 to 80° to either side, bends by 50 to 60° forward and back; the thoracic spine
            /// by about 30° to either side (White and Panjabi, *Clinical Biomechanics of the Spine*, 1990). Rates and
            /// accelerations are a choice: those at which half a second is enough for any turn.
            pub const HUMAN: Self = Self::of([78.0, -50.0, 60.0, 240.0, 1200.0], [30.0, -30.0, 20.0, 100.0, 500.0]);

            /// An animal's on four legs: a long neck that reaches the flank.
            pub const QUADRUPED: Self = Self::of([120.0, -70.0, 60.0, 300.0, 1500.0], [20.0, -20.0, 20.0, 80.0, 400.0]);

            /// A bird's: quick heads that turn far (an owl's up to 270°), bodies that hardly do.
            pub const BIRD: Self = Self::of([125.0, -70.0, 70.0, 420.0, 4000.0], [10.0, -10.0, 10.0, 80.0, 400.0]);

            /// A cartoon figure's: further and snappier than people.
            pub const TOON: Self = Self::of([95.0, -60.0, 70.0, 300.0, 2400.0], [40.0, -35.0, 30.0, 150.0, 1000.0]);

            /// From a part's largest heading to either side, its pitches down and up, its rate and its acceleration, degrees.
            const fn of(head: [$float; 5], chest: [$float; 5]) -> Self {
                const fn budget([heading, down, up, rate, acceleration]: [$float; 5]) -> Budget<$float> {
                    const DEG: $float = core::$float::consts::PI / 180.0;
                    Budget {
                        heading: [-heading * DEG, heading * DEG],
                        pitch: [down * DEG, up * DEG],
                        rate: rate * DEG,
                        acceleration: acceleration * DEG,
                    }
                }
                Self { head: budget(head), chest: budget(chest) }
            }

            /// Nothing but what the joints' own ranges and rates allow, at a human's pace.
            pub const UNBOUNDED: Self = {
                const FREE: [$float; 2] = [$float::NEG_INFINITY, $float::INFINITY];
                const fn freed(budget: Budget<$float>) -> Budget<$float> {
                    Budget { heading: FREE, pitch: FREE, rate: $float::INFINITY, ..budget }
                }
                Self { head: freed(Self::HUMAN.head), chest: freed(Self::HUMAN.chest) }
            };
        }

        impl Default for Budgets<$float> {
            fn default() -> Self {
                Self::HUMAN
            }
        }
    };
}

budgets!(f32);
budgets!(f64);

impl Budgets<f64> {
    /// The budgets that declarations know by a word.
    pub const NAMED: [(&str, Self); 4] =
        [("human", Self::HUMAN), ("quadruped", Self::QUADRUPED), ("bird", Self::BIRD), ("toon", Self::TOON)];
}
