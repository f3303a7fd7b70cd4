//! [`RigSpec`]: a declaration that has passed every check. The steps after it (deriving, emitting) cannot fail.

use aim_model::{
    Angles, Axes, Budget as ModelBudget, Budgets as ModelBudgets, GazeSharing, LimitsFrom, RangeOfMotion, Role,
};

/// A checked rig. Angles are in radians; vectors of a frame have unit length and are orthogonal.
#[derive(Clone, Debug, PartialEq)]
pub struct RigSpec {
    /// The rig's name, a Rust type name such as `Thug`.
    pub name: String,
    /// The joints, from the effector inward; at least one.
    pub joints: Vec<JointSpec>,
    /// The effector, in joint 0's bone space.
    pub effector: EffectorSpec,
    /// Sharing of a natural gaze among eyes and supporting joints; `None` leaves it to the runtime.
    pub natural: Option<NaturalSpec>,
    /// Budgets of the body's regions in a natural gaze; `None` for the runtime's default, a human's.
    pub region: Option<Budgets>,
    /// Names of the objectives whose kernels are emitted as functions of the rig.
    pub kernels: Vec<&'static str>,
}

/// A checked joint.
#[derive(Clone, Debug, PartialEq)]
pub struct JointSpec {
    /// The field's name, such as `left_eye`.
    pub name: String,
    /// Names that its bone may have in a model. Never empty; the field's name by default.
    pub bones: Vec<String>,
    /// Role in a gaze, as declared.
    pub role: Role,
    /// The bone's axes.
    pub frame: Frame,
    /// Range of the pitch; `None` if the joint has no pitch.
    pub pitch: Option<AngleRange>,
    /// Range of the heading; `None` if the joint has no heading.
    pub heading: Option<AngleRange>,
    /// Pose that the ranges are measured from.
    pub limits_from: LimitsFrom,
    /// Largest speed of each angle, rad/s.
    pub rate: f64,
    /// Largest acceleration of each angle, rad/s²; `None` for no limit.
    pub acceleration: Option<f64>,
    /// Weight of the joint in the displacement cost.
    pub stiffness: f64,
    /// Fraction, 0…1, by which the heading's axis is tilted from the bone's up to the character's; `None` for the
    /// role's default.
    pub upright: Option<f64>,
    /// Fraction of the pitch range that is lost at either end of the heading range, 0…1.
    pub pitch_taper: Option<f64>,
    /// Name of the other eye's bone.
    pub other_eye: Option<String>,
    /// Names of bones that hang on this joint but stay with the joint's parent; `None` to find them from the skeleton.
    pub hold: Option<Vec<String>>,
}

/// Axes of a bone in its own space: unit vectors, orthogonal, `up × forward = ±left`. The sign depends on handedness
/// and mirroring.
pub type Frame = Axes<f64>;

/// The effector: origin and axes, in joint 0's bone space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffectorSpec {
    /// Axes of the effector: joint 0's, or with the declared effector forward and joint 0's up orthogonalised against
    /// it.
    pub frame: Frame,
    /// Origin of the effector's direction.
    pub origin: [f64; 3],
}

/// Sharing of a natural gaze between the eyes and the joints that support them.
pub type NaturalSpec = GazeSharing<f64>;

/// Limits of the total turn of the joints of one region.
pub type Budget = ModelBudget<f64>;

/// Budgets of the regions of a body.
pub type Budgets = ModelBudgets<f64>;

/// Range of an angle; always contains 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AngleRange {
    /// From `lo` to `hi`, radians: `-π ≤ lo ≤ 0 ≤ hi ≤ π` and `lo < hi`.
    Between(f64, f64),
    /// Unlimited; the angle wraps.
    Free,
}

impl AngleRange {
    /// Returns both ends, lower first, in radians; infinite for a free angle.
    #[must_use]
    pub fn ends(self) -> [f64; 2] {
        match self {
            Self::Between(lo, hi) => [lo, hi],
            Self::Free => [f64::NEG_INFINITY, f64::INFINITY],
        }
    }
}

impl JointSpec {
    /// Returns the ranges of the joint's added angles. `animated` are the angles, in radians, by which the animation
    /// turns the joint out of the pose that the ranges are measured from; `None` if they are measured from the
    /// animation itself.
    pub fn range_of_motion(&self, animated: Option<Angles<f64>>) -> RangeOfMotion<f64> {
        let declared = Angles { heading: self.heading.map(AngleRange::ends), pitch: self.pitch.map(AngleRange::ends) };
        RangeOfMotion::new(declared, self.pitch_taper.unwrap_or(0.0), animated)
    }

    /// Returns the number of declared angles, 1 or 2.
    #[must_use]
    pub fn angles(&self) -> usize {
        usize::from(self.pitch.is_some()) + usize::from(self.heading.is_some())
    }
}

impl RigSpec {
    /// Returns the number of declared angles of the whole chain.
    pub fn angles(&self) -> usize {
        self.joints.iter().map(JointSpec::angles).sum()
    }
}
