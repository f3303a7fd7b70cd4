//! [`Settings`]: the parameters of a call.

use crate::GazeSharing;
use crate::math::Bounded;

/// Parameters of a [`Call`](crate::Call).
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
    /// Fraction of the arc from the animated direction to the target at which the gaze is aimed, 0…1. Values outside
    /// are clamped, NaN counts as 0. The weight scales the goal and not the angles, so ranges and rates hold while it
    /// changes. At 0 the corrections return at their rates to the exact identity, wherever the target is. Default 1.
    #[cfg_attr(feature = "serde", serde(with = "aim_model::stored"))]
    pub weight: f32,
    /// Remaining angle up to which the target counts as reached, radians. Negative values and NaN count as 0. Default
    /// 0.1°.
    #[cfg_attr(feature = "serde", serde(with = "aim_model::stored"))]
    pub tolerance: f32,
    /// The ray that is aimed: 0 is the declared effector, `k` is joint `k` itself (a head, for example), with its own
    /// forward from its own origin. Joints nearer the effector than `k` return to rest at their rates. An index past
    /// the last joint selects the last. Default 0.
    pub effector: usize,
    /// The solver that moves the joints; `None` selects [`Solver::Natural`] for a rig in which any joint has a role,
    /// otherwise [`Solver::Exact`]. Default `None`.
    pub solver: Option<Solver>,
    /// Policy for a target behind the character. Default [`Behind::Clip`].
    pub behind: Behind,
    /// Degree to which the head takes over from the eyes in a [natural](Solver::Natural) gaze, 0…1. At 0, eyes and head
    /// share the gaze as the rig's [`GazeSharing`] declares; at 1, the head turns fully to the target, and the eyes
    /// stay on the target throughout. Values outside are clamped, NaN counts as 0. Default 0.
    #[cfg_attr(feature = "serde", serde(with = "aim_model::stored"))]
    pub attention: f32,
    /// Division of a natural gaze between eyes and head; `None` selects the rig's own
    /// ([`Description::sharing`](crate::Description::sharing)). Default `None`.
    pub sharing: Option<GazeSharing>,
    /// Time for which a natural gaze stays on a target that is out of reach, seconds. After that it returns to the
    /// animation until the target comes within reach. Negative values and NaN count as 0. Default ∞.
    #[cfg_attr(feature = "serde", serde(with = "aim_model::stored"))]
    pub patience: f32,
    /// Parameters of [`Solver::Ascent`].
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
    /// Sets the [`weight`](Self::weight), 0…1.
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

    /// Sets the [`tolerance`](Self::tolerance), radians.
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

    /// Sets the [`effector`](Self::effector): 0 or a joint's index.
    #[must_use]
    pub const fn with_effector(mut self, effector: usize) -> Self {
        self.effector = effector;
        self
    }

    /// Sets the [`solver`](Self::solver).
    #[must_use]
    pub const fn with_solver(mut self, solver: Solver) -> Self {
        self.solver = Some(solver);
        self
    }

    /// Sets the policy for targets [`behind`](Self::behind) the character.
    #[must_use]
    pub const fn with_behind(mut self, behind: Behind) -> Self {
        self.behind = behind;
        self
    }

    /// Sets the [`attention`](Self::attention), 0…1.
    #[must_use]
    pub const fn with_attention(mut self, attention: f32) -> Self {
        self.attention = attention;
        self
    }

    /// Sets the [`sharing`](Self::sharing), overriding the rig's.
    #[must_use]
    pub const fn with_sharing(mut self, sharing: GazeSharing) -> Self {
        self.sharing = Some(sharing);
        self
    }

    /// Sets the [`patience`](Self::patience), seconds.
    #[must_use]
    pub const fn with_patience(mut self, patience_s: f32) -> Self {
        self.patience = patience_s;
        self
    }

    /// Sets the parameters of the [`ascent`](Self::ascent).
    #[must_use]
    pub const fn with_ascent(mut self, ascent: Ascent) -> Self {
        self.ascent = ascent;
        self
    }

    /// Returns `true` if the weight is exactly 1.
    #[inline(always)]
    pub(crate) const fn has_full_weight(&self) -> bool {
        self.weight.to_bits() == 1.0_f32.to_bits()
    }

    /// Returns the effective weight, 0…1.
    pub(crate) fn effective_weight(&self) -> f32 {
        // Both bounds replace NaN by the bound, so NaN becomes 0.
        self.weight.at_least(0.0).at_most(1.0)
    }

    /// Returns the effective tolerance, 0…∞, radians.
    pub(crate) fn effective_tolerance(&self) -> f32 {
        self.tolerance.at_least(0.0)
    }
}

/// Algorithm that moves the joints.
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
    /// Moves eyes, neck and spine as people do: the eyes jump to the target and hold it; the head follows with inertia,
    /// taking a share of the angle beyond the eyes' own zone; and the eyes turn back as the head arrives. See
    /// [`GazeSharing`].
    Natural,
    /// Moves all joints at once: among all angles within range and rate that put the gaze on the target, those with the
    /// least stiffness-weighted displacement.
    Exact,
    /// The paper's steepest ascent, joint by joint from the effector inward. See [`Ascent`].
    Ascent,
}

/// Policy for a target behind the character that is out of reach.
///
/// *Behind* is a cone with its apex at the animated effector, about the opposite of the innermost joint's animated
/// forward. (The parent of that joint is not in the pose.) A target is behind once it is within 30° of the axis, and
/// until it is more than 40° from the axis. Corrections do not enter this test, so it cannot feed back. If the ranges
/// let the gaze come round behind (a turret, for example), no target counts as behind.
///
/// A target behind counts as being on the side on which it was last seen, until it is 10° past the middle of the back;
/// then the joints turn round to the other side. Whatever the policy, no angle changes faster than its rate, not even
/// when the policy starts or ends.
///
/// While a policy is active and the target is not reached, the status is [`Behind`](crate::Status::Behind).
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
    /// No policy: the joints go as near to the target as they can on their present side, until the other side is nearer
    /// by a margin.
    Off,
    /// The joints turn to the edge of the cone behind, on the side that the target counts as being on.
    #[default]
    Clip,
    /// The target is clipped to the region in front of the character: a target more than 80° to the side of the
    /// animated forward is moved forward, parallel to it, until it is 80° to the side; its elevation is kept. A target
    /// that goes round behind is followed back through the front to the other side and met there, so the joints never
    /// turn round. Targets that the joints could reach beyond 80° are moved too. The cone behind does not matter.
    ///
    /// Every frame costs as much as one that is searched, even if the target is in front.
    ///
    /// Source: S. M. Johnson, section 6.2: "clipping the target point to a plane in front of the character", which does
    /// not say how far in front the plane is. A plane at a fixed distance would move near targets, and would raise the
    /// gaze to targets behind. Hence directions are clipped instead, and the elevation is kept.
    Plane,
    /// The joints hold their angles; joints outside their ranges still return.
    Hold,
    /// The joints return to the animation at their rates, as with weight 0.
    Release,
}

/// Parameters of the steepest ascent, which moves joint by joint from the effector inward, along the unit gradient, at
/// the joint's rate; a step that overshoots is halved.
///
/// [`Ascent::paper`] is the published method. The default adds exact convergence ([`finish`](Self::finish)) and turning
/// round when blocked ([`turn_back`](Self::turn_back)).
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
    /// Number of times an overshooting step is halved before the joint is left unchanged for this call; clamped to 24.
    /// Default 4.
    pub halvings: u32,
    /// Fraction of each supporting joint's angles that is kept after a sixtieth of a second while the remaining angle
    /// is within 1° (or within the tolerance, if that is larger); the joints nearer the effector then compensate. The
    /// published value is 0.95. `None` disables relaxation. Default `None`.
    pub relax: Option<f32>,
    /// `true` to finish the ascent exactly: a step is no longer than the gradient predicts is needed to reach the
    /// target, and if halved steps hardly help although the target is within reach, the joints go at their rates to the
    /// angles that reach it. Otherwise the shortest step is the rate's `1 / 2^halvings`, so a fast joint alone stays up
    /// to half of that off for ever. Not in the paper. Default `true`.
    pub finish: bool,
    /// `true` to let the joints turn round at their rates if their ranges block the way and starting from the animation
    /// would aim better by a margin of 5°; an orbiting target is then picked up on the other side. Otherwise the joints
    /// stay where they are blocked. Not in the paper. Default `true`.
    pub turn_back: bool,
}

impl Default for Ascent {
    fn default() -> Self {
        Self { halvings: 4, relax: None, finish: true, turn_back: true }
    }
}

impl Ascent {
    /// Returns the published method: four halvings, supporting joints relaxed by 5 %, no additions.
    #[must_use]
    pub const fn paper() -> Self {
        Self { halvings: 4, relax: Some(0.95), finish: false, turn_back: false }
    }

    /// Sets the number of [`halvings`](Self::halvings).
    #[must_use]
    pub const fn with_halvings(mut self, halvings: u32) -> Self {
        self.halvings = halvings;
        self
    }

    /// Sets the fraction of their angles that supporting joints [keep](Self::relax) each sixtieth of a second, 0…1.
    #[must_use]
    pub const fn with_relax(mut self, relax: Option<f32>) -> Self {
        self.relax = relax;
        self
    }

    /// Switches [`finish`](Self::finish) on or off.
    #[must_use]
    pub const fn with_finish(mut self, finish: bool) -> Self {
        self.finish = finish;
        self
    }

    /// Switches [`turn_back`](Self::turn_back) on or off.
    #[must_use]
    pub const fn with_turn_back(mut self, turn_back: bool) -> Self {
        self.turn_back = turn_back;
        self
    }
}
