//! [`GazeSharing`]: how a gaze is shared between the eyes and the joints that support them; [`Budgets`]: the limits of
//! each part of the body.

/// Parameters for sharing a natural gaze between the eyes and the joints that support them.
///
/// Joint 0 is the eye, the other joints support it. When the target appears, the eye jumps to it within its rate and
/// range and fixates it. Each supporting part of the body receives a share of the gaze shift's heading and elevation by
/// its compliance (1/stiffness) within its [budget](Budgets), and more if the eye cannot cover the rest. The
/// supporting joints glide to their shares in one smooth movement. In each frame the eye covers exactly the remaining
/// turn, and so turns back as they arrive. Ranges take precedence over rates, rates over accelerations.
///
/// A rig declares these values, and the runtime's settings can override them for a call. Negative and NaN angles count
/// as 0. A call's attention scales `eyes_only`, `engage` and `release` down to 0 and raises `head_share` to 1: at full
/// attention the head alone ends up turned to the target.
///
/// # What people do
///
/// The defaults are of the order of published measurements. People differ widely in how much they move their heads
/// (Fuller, *Head movement propensity*, Exp. Brain Res. 1992); adjust the values to express that.
///
/// - *Eyes alone.* Within about 15° of their middle the eyes tend to shift the gaze by themselves. This customary
///   oculomotor range compares with a mechanical one of some 50° to either side. Monkeys turn their heads hardly at all
///   for shifts below 20°, and beyond 25° by an amount that grows linearly with the shift, while the eye's part
///   saturates at about 35° (Freedman and Sparks, J. Neurophysiol. 77, 1997). Hence a zone and a slope.
/// - *Order.* The head follows the saccade by 20 to 40 ms whatever the target's angle (*The reaction time of eye-head
///   coordination in man*), partly because of its inertia: with the defaults, the neck reaches 1° some 50 ms after the
///   eye for a gaze shift of 60°, and 80 ms after it for one of 30°.
/// - *Speed.* Peak speed and duration of a saccade follow from its size, the main sequence (Bahill, Clark and Stark,
///   1975): 213, 352 and 455°/s for 5, 15 and 30° in a hundred people (PMC6143243). Here an eye with a rate of 450°/s
///   reaches 240, 415 and 450°/s.
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
    /// Gaze shift that the eyes make alone, radians: `D` in head shift = `g·max(0, |E| − D)`. `E` is the angle from the
    /// animated gaze, with the eyes at rest if a bind pose tells how, to the target. Default 15°.
    #[cfg_attr(feature = "serde", serde(with = "crate::stored"))]
    pub eyes_only: T,
    /// Part of the gaze shift beyond [`eyes_only`](Self::eyes_only) that the head makes, 0…1: `g`. Default 0.8.
    #[cfg_attr(feature = "serde", serde(with = "crate::stored"))]
    pub head_share: T,
    /// Angle of the target from the eyes' middle beyond which the supporting joints begin to move, radians. They also
    /// begin when the target is out of the eyes' range. Default 15°.
    #[cfg_attr(feature = "serde", serde(with = "crate::stored"))]
    pub engage: T,
    /// Angle of the target from the eyes' middle below which the supporting joints rest again once they have arrived,
    /// radians. Default 8°.
    #[cfg_attr(feature = "serde", serde(with = "crate::stored"))]
    pub release: T,
    /// Delay of the supporting joints after the eyes, seconds, in addition to the effect of their inertia. Default 0.
    #[cfg_attr(feature = "serde", serde(with = "crate::stored"))]
    pub delay: T,
}

macro_rules! human {
    ($float:ident) => {
        impl GazeSharing<$float> {
            /// The defaults, of the order measured in people.
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
    /// Sets [`eyes_only`](Self::eyes_only), radians.
    #[must_use]
    pub const fn with_eyes_only(mut self, angle_rad: T) -> Self {
        self.eyes_only = angle_rad;
        self
    }

    /// Sets [`head_share`](Self::head_share), 0…1.
    #[must_use]
    pub const fn with_head_share(mut self, share: T) -> Self {
        self.head_share = share;
        self
    }

    /// Sets the angles at which the supporting joints [engage](Self::engage) and [release](Self::release), radians.
    #[must_use]
    pub const fn with_engagement(mut self, engage_rad: T, release_rad: T) -> Self {
        self.engage = engage_rad;
        self.release = release_rad;
        self
    }

    /// Sets [`delay`](Self::delay), seconds.
    #[must_use]
    pub const fn with_delay(mut self, seconds: T) -> Self {
        self.delay = seconds;
        self
    }
}

/// Limits of the combined turn of the joints in one part of the body. Angles in radians.
///
/// A budget limits the sum of the animation's own turn, relative to the part that carries it, and the added turn. If
/// the animation exceeds the budget, nothing is added.
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
    /// Range of headings, right and left: `[lo, hi]` around 0.
    #[cfg_attr(feature = "serde", serde(with = "crate::stored"))]
    pub heading: [T; 2],
    /// Range of elevations, down and up: `[lo, hi]` around 0.
    #[cfg_attr(feature = "serde", serde(with = "crate::stored"))]
    pub pitch: [T; 2],
    /// Largest speed of the sum of the part's headings, and of the sum of its pitches, rad/s.
    #[cfg_attr(feature = "serde", serde(with = "crate::stored"))]
    pub rate: T,
    /// Largest rate of change of those sums' speeds, rad/s². It also sets the pace: a turn takes about
    /// 2.5/√acceleration seconds.
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
    /// Budget of head and neck together: [`Role::Head`](crate::Role::Head) and [`Role::Neck`](crate::Role::Neck).
    pub head: Budget<T>,
    /// Budget of the upper torso: [`Role::Chest`](crate::Role::Chest).
    pub chest: Budget<T>,
}

macro_rules! budgets {
    ($float:ident) => {
        impl Budgets<$float> {
            /// Budgets of a human. The neck turns by 70 to 80° to either side and bends by 50 to 60° forward and back;
            /// the thoracic spine turns by about 30° to either side (White and Panjabi, *Clinical Biomechanics of the
            /// Spine*, 1990). Rates and accelerations are chosen so that half a second is enough for any turn.
            pub const HUMAN: Self = Self::of([78.0, -50.0, 60.0, 240.0, 1200.0], [30.0, -30.0, 20.0, 100.0, 500.0]);

            /// Budgets of a four-legged animal: a long neck that reaches the flank.
            pub const QUADRUPED: Self = Self::of([120.0, -70.0, 60.0, 300.0, 1500.0], [20.0, -20.0, 20.0, 80.0, 400.0]);

            /// Budgets of a bird: a fast head that turns far (an owl's up to 270°), a body that hardly turns.
            pub const BIRD: Self = Self::of([125.0, -70.0, 70.0, 420.0, 4000.0], [10.0, -10.0, 10.0, 80.0, 400.0]);

            /// Budgets of a cartoon figure: larger ranges and snappier movement than a human's.
            pub const TOON: Self = Self::of([95.0, -60.0, 70.0, 300.0, 2400.0], [40.0, -35.0, 30.0, 150.0, 1000.0]);

            /// Builds budgets from `[largest heading to either side, pitch down, pitch up, rate, acceleration]` of head
            /// and chest, degrees.
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

            /// No limits beyond the joints' own ranges and rates, at a human's pace.
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
    /// The predefined budgets and the keywords that declare them.
    pub const NAMED: [(&str, Self); 4] =
        [("human", Self::HUMAN), ("quadruped", Self::QUADRUPED), ("bird", Self::BIRD), ("toon", Self::TOON)];
}
