//! [`Settings`]: how a call aims.

use crate::GazeSharing;
use crate::math::Bounded;

/// How a [`Call`](crate::Call) aims.
///
/// ```
/// use aim_runtime::Settings;
///
/// let half_hearted = Settings::default().with_weight(0.5);
/// assert_eq!(half_hearted.weight, 0.5);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
#[non_exhaustive]
pub struct Settings {
    /// How far the gaze goes along the arc from the animated direction to the target, 0…1; outside values are
    /// clamped, NaN counts as 0. It scales the goal and not the angles, so ranges and rates hold while it changes; at
    /// 0 the corrections decay at their rates to the exact identity, wherever the target is. Default 1.
    #[cfg_attr(feature = "serde", serde(with = "aim_model::stored"))]
    pub weight: f32,
    /// The remaining angle at which the target counts as reached, radians; NaN and negative values count as 0.
    /// Default 0.1°.
    #[cfg_attr(feature = "serde", serde(with = "aim_model::stored"))]
    pub tolerance: f32,
    /// What is aimed: 0 is the declared effector, `k` is joint `k` itself (a head, say): its own forward from its own
    /// origin. Joints nearer the effector than `k` return to rest at their rates. An index past the last joint means
    /// the last. Default 0.
    pub effector: usize,
    /// Which solver moves the joints; `None` is [`Solver::Natural`] for a rig with a joint that has a role, else
    /// [`Solver::Exact`]. Default `None`.
    pub solver: Option<Solver>,
    /// What becomes of a target behind the character. Default [`Behind::Clip`].
    pub behind: Behind,
    /// How far the head takes over from the eyes in a [natural](Solver::Natural) gaze, 0…1: at 0 eyes and head share as
    /// the rig's [`GazeSharing`] says, at 1 the head is turned fully to the target, the eyes never leaving it. Outside
    /// values are clamped, NaN counts as 0. Default 0.
    #[cfg_attr(feature = "serde", serde(with = "aim_model::stored"))]
    pub attention: f32,
    /// How the natural solver shares a gaze; `None` leaves it to the rig ([`Description::sharing`](crate::Description::sharing)).
    pub sharing: Option<GazeSharing>,
    /// For how long a natural gaze stays with a target that is out of reach, seconds; then it returns to the animation until
    /// the target comes into reach. NaN and negative values count as 0. Default ∞: it stays.
    #[cfg_attr(feature = "serde", serde(with = "aim_model::stored"))]
    pub patience: f32,
    /// How the ascent steps.
    pub ascent: Ascent,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            weight: 1.0,
            tolerance: 0.1 * core::f32::consts::PI / 180.0,
            effector: 0,
            solver: None,
            behind: Behind::Clip,
            attention: 0.0,
            sharing: None,
            patience: f32::INFINITY,
            ascent: Ascent::default(),
        }
    }
}

impl Settings {
    /// With this [`weight`](Self::weight), 0…1.
    ///
    /// ```
    /// # mod turret { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/turret.rs")); }
    /// # use turret::Turret;
    /// use aim_runtime::glam::{Affine3A, Vec3};
    /// use aim_runtime::{Aim, Pose, Settings};
    ///
    /// // Half of the way to what is 0.6 rad to the left.
    /// let (target, half) = (Vec3::new(0.6_f32.sin(), 0.0, 0.6_f32.cos()), Settings::default().with_weight(0.5));
    /// let mut turret = Aim::<Turret>::new();
    /// let _ = turret.snap(&Pose::new([Affine3A::IDENTITY]), target, &half);
    /// assert!((turret.state.joints[0].heading() - 0.3).abs() < 1e-3);
    /// ```
    #[must_use]
    pub const fn with_weight(mut self, weight: f32) -> Self {
        self.weight = weight;
        self
    }

    /// With this [`tolerance`](Self::tolerance), radians.
    ///
    /// ```
    /// # mod turret { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/turret.rs")); }
    /// # use turret::Turret;
    /// use aim_runtime::glam::{Affine3A, Vec3};
    /// use aim_runtime::{Aim, Pose, Settings, Status};
    ///
    /// // 3 rad/s: after a tenth of a second it is 0.2 rad short, which is near enough for a shotgun.
    /// let (pose, target) = (Pose::new([Affine3A::IDENTITY]), Vec3::new(0.5_f32.sin(), 0.0, 0.5_f32.cos()));
    /// let status = |settings| Aim::<Turret>::new().aim(&pose, target, 0.1, &settings).outcome.status;
    /// assert_eq!(status(Settings::default()), Status::RateLimited);
    /// assert_eq!(status(Settings::default().with_tolerance(0.25)), Status::Reached);
    /// ```
    #[must_use]
    pub const fn with_tolerance(mut self, tolerance_rad: f32) -> Self {
        self.tolerance = tolerance_rad;
        self
    }

    /// With this [`effector`](Self::effector): 0 or a joint's index.
    #[must_use]
    pub const fn with_effector(mut self, effector: usize) -> Self {
        self.effector = effector;
        self
    }

    /// With this [`solver`](Self::solver).
    #[must_use]
    pub const fn with_solver(mut self, solver: Solver) -> Self {
        self.solver = Some(solver);
        self
    }

    /// With this policy for targets [`behind`](Self::behind).
    #[must_use]
    pub const fn with_behind(mut self, behind: Behind) -> Self {
        self.behind = behind;
        self
    }

    /// With this [`attention`](Self::attention), 0…1.
    #[must_use]
    pub const fn with_attention(mut self, attention: f32) -> Self {
        self.attention = attention;
        self
    }

    /// With this [`sharing`](Self::sharing) sharing instead of the rig's.
    #[must_use]
    pub const fn with_sharing(mut self, sharing: GazeSharing) -> Self {
        self.sharing = Some(sharing);
        self
    }

    /// With this [`patience`](Self::patience), seconds.
    #[must_use]
    pub const fn with_patience(mut self, patience_s: f32) -> Self {
        self.patience = patience_s;
        self
    }

    /// With these settings of the [`ascent`](Self::ascent).
    #[must_use]
    pub const fn with_ascent(mut self, ascent: Ascent) -> Self {
        self.ascent = ascent;
        self
    }

    /// Whether the weight is 1, bit for bit.
    #[inline(always)]
    pub(crate) const fn has_full_weight(&self) -> bool {
        self.weight.to_bits() == 1.0_f32.to_bits()
    }

    /// The weight as it counts: 0…1.
    pub(crate) fn effective_weight(&self) -> f32 {
        // `max` and `min` return the number where the other is NaN, so NaN becomes 0.
        self.weight.at_least(0.0).at_most(1.0)
    }

    /// The tolerance as it counts: 0…∞, radians.
    pub(crate) fn effective_tolerance(&self) -> f32 {
        self.tolerance.at_least(0.0)
    }
}

/// Which solver moves the joints.
///
/// ```
/// use aim_runtime::{Settings, Solver};
///
/// assert_eq!(Settings::default().solver, None); // by the rig
/// let settings = Settings::default().with_solver(Solver::Exact);
/// assert_eq!(settings.solver, Some(Solver::Exact));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Solver {
    /// Eyes, neck and spine as people use them: the eyes leap to the target and hold it, the head follows with its
    /// inertia by a share of what is beyond the eyes' own zone, and the eyes return as it arrives. See [`GazeSharing`].
    Natural,
    /// All joints at once: of all angles within range and rate that put the gaze on the target, those of the least
    /// stiffness-weighted displacement.
    Exact,
    /// The paper's steepest ascent, joint by joint from the effector inward. See [`Ascent`].
    Ascent,
}

/// What becomes of a target behind the character, where the ranges do not reach.
///
/// *Behind* is a cone seen from the animated effector, about the opposite of the innermost joint's animated forward (its
/// parent is not in the pose): a target is behind from 30° off that, and until it is 10° further out again. The
/// corrections have no part in it, so nothing feeds back. A target behind counts as being on the side it was last seen
/// on until it is 10° past the middle of the back: then the other way round is nearer by a margin, and the joints turn
/// round. Whatever the policy and wherever it sets in or ends, no angle changes faster than its rate. Where the ranges
/// let the gaze come round behind (a turret, say), no target counts as behind.
///
/// While a policy is active and the target is not reached all the same, the status is
/// [`Behind`](crate::Status::Behind).
///
/// ```
/// # mod turret { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/turret.rs")); }
/// # use turret::Turret;
/// use aim_runtime::glam::{Affine3A, Vec3};
/// use aim_runtime::{Aim, Behind, Pose, Settings, Status};
///
/// let mut turret = Aim::<Turret>::new();
/// let settings = Settings::default().with_behind(Behind::Release);
/// let aimed = turret.aim(&Pose::new([Affine3A::IDENTITY]), Vec3::NEG_Z, 1.0 / 60.0, &settings);
/// assert_eq!(aimed.outcome.status, Status::Behind);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Behind {
    /// No policy: the joints go as near as they come, on the side they are on, until the other comes nearer by a margin.
    Off,
    /// They turn to the edge of the cone behind, on the side that the target counts as being on.
    #[default]
    Clip,
    /// They turn to the target as a plane in front of the character has it: a target further than 80° to the side of the
    /// animated forward is moved forward, parallel to it, until it is 80° to the side, its elevation kept. One that goes round
    /// behind is followed back through the front to the other side, and met there; nothing turns round. Targets that the joints
    /// could reach beyond the plane are moved, too. The cone above has no part in it.
    ///
    /// A frame costs what one that is searched does, also where the target is in front.
    ///
    /// Source: S. M. Johnson, section 6.2: "clipping the target point to a plane in front of the character", which leaves
    /// open how far in front it is. At a fixed distance it would move near targets and lift the gaze to those behind; hence
    /// directions are clipped, and the elevation stays.
    Plane,
    /// They stay as they are; those outside their ranges go back as ever.
    Hold,
    /// They return to the animation at their rates, as with weight 0.
    Release,
}

/// How the steepest ascent steps: joint by joint from the effector inward, along the unit gradient, at the joint's
/// rate, halved on overshoot.
///
/// [`Ascent::paper`] is the method as it was published; the default adds what makes it settle and look the other way
/// round.
///
/// ```
/// use aim_runtime::{Ascent, Settings, Solver};
///
/// let published = Settings::default().with_solver(Solver::Ascent).with_ascent(Ascent::paper());
/// assert_eq!(published.ascent.relax, Some(0.95));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
#[non_exhaustive]
pub struct Ascent {
    /// How often an overshooting step is halved before the joint is left alone for this call. At most 24 count.
    /// Default 4.
    pub halvings: u32,
    /// While the remaining angle is within 1° (and within the tolerance, if that is larger), the part of each supporting
    /// joint's angles that is kept after a sixtieth of a second (the published value is 0.95); the joints nearer the
    /// effector then make up for it. `None` leaves them. Default `None`.
    pub relax: Option<f32>,
    /// Whether the ascent is finished exactly: a step is no longer than the gradient says it takes to reach the
    /// target, and where halved steps hardly help although the target is within reach, the joints go at their rates
    /// to the angles that reach it. Without it the shortest step is the rate's `1 / 2^halvings`, so a fast joint alone
    /// stays up to half of that off for ever. Not in the paper. Default on.
    pub finish: bool,
    /// Whether the joints turn round at their rates where their ranges block the way and starting from the animation
    /// they would come to aim better by a margin of 5°: so an orbiting target is picked up on the other side. Without
    /// it they stay where they are blocked. Not in the paper. Default on.
    pub turn_back: bool,
}

impl Default for Ascent {
    fn default() -> Self {
        Self { halvings: 4, relax: None, finish: true, turn_back: true }
    }
}

impl Ascent {
    /// The published method: four halvings, supporting joints relaxed by 5 %, nothing added.
    #[must_use]
    pub const fn paper() -> Self {
        Self { halvings: 4, relax: Some(0.95), finish: false, turn_back: false }
    }

    /// With this number of [`halvings`](Self::halvings).
    #[must_use]
    pub const fn with_halvings(mut self, halvings: u32) -> Self {
        self.halvings = halvings;
        self
    }

    /// With supporting joints [relaxed](Self::relax) to this part of their angles each sixtieth of a second, 0…1.
    #[must_use]
    pub const fn with_relax(mut self, relax: Option<f32>) -> Self {
        self.relax = relax;
        self
    }

    /// With or without [`finish`](Self::finish).
    #[must_use]
    pub const fn with_finish(mut self, finish: bool) -> Self {
        self.finish = finish;
        self
    }

    /// With or without [`turn_back`](Self::turn_back).
    #[must_use]
    pub const fn with_turn_back(mut self, turn_back: bool) -> Self {
        self.turn_back = turn_back;
        self
    }
}
