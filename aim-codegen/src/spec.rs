//! [`RigSpec`]: a declaration that has passed every check. All that follows (deriving, emitting) cannot fail.

use aim_model::{
    Angles, Axes, Budget as ModelBudget, Budgets as ModelBudgets, GazeSharing, LimitsFrom, RangeOfMotion, Role,
};

/// A checked rig. Angles in radians, vectors unit and square to each other.
#[derive(Clone, Debug, PartialEq)]
pub struct RigSpec {
    /// The rig's name, a Rust type name such as `Thug`.
    pub name: String,
    /// The joints, from the effector inward; at least one.
    pub joints: Vec<JointSpec>,
    /// What is aimed, in joint 0's bone space.
    pub effector: EffectorSpec,
    /// How a natural gaze is shared, or `None` to leave it to the runtime.
    pub natural: Option<NaturalSpec>,
    /// The budgets of the parts of the body in a natural gaze, or `None` to leave them to the runtime: a human's.
    pub region: Option<Budgets>,
    /// The kernels that are wanted as functions of the rig, by the names of their objectives.
    pub kernels: Vec<&'static str>,
}

/// A checked joint.
#[derive(Clone, Debug, PartialEq)]
pub struct JointSpec {
    /// The field's name, such as `left_eye`.
    pub name: String,
    /// Names its bone may have in a model; never empty, by default the field's name.
    pub bones: Vec<String>,
    /// What part the joint has in a gaze, as declared.
    pub role: Role,
    /// The bone's axes.
    pub frame: Frame,
    /// The pitch's range, or `None` for a joint that does not nod.
    pub pitch: Option<AngleRange>,
    /// The heading's range, or `None` for a joint that does not turn.
    pub heading: Option<AngleRange>,
    /// The pose from which the ranges are counted.
    pub limits_from: LimitsFrom,
    /// Largest speed of each angle, rad/s.
    pub rate: f64,
    /// Largest change of speed, rad/s².
    pub acceleration: Option<f64>,
    /// The joint's weight in the displacement cost.
    pub stiffness: f64,
    /// How far heading turns about the character's up, 0…1.
    pub upright: Option<f64>,
    /// The part of the pitch's range that is lost at either end of the heading's, 0…1.
    pub pitch_taper: Option<f64>,
    /// The other eye's bone.
    pub other_eye: Option<String>,
    /// Names of bones that hang on this joint and stay with what carries it; `None` to find them from the skeleton.
    pub hold: Option<Vec<String>>,
}

/// The axes of a bone in its own space: unit, square to each other; `up × forward = ±left`, the sign by handedness and
/// mirror.
pub type Frame = Axes<f64>;

/// What is aimed, in joint 0's bone space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffectorSpec {
    /// The effector's axes: joint 0's, or squared to the declared effector forward (forward kept).
    pub frame: Frame,
    /// The point the direction starts from.
    pub origin: [f64; 3],
}

/// How a natural gaze is shared between the eyes and the joints that support them.
pub type NaturalSpec = GazeSharing<f64>;

/// Bounds of the turn that the joints of one part of the body make together.
pub type Budget = ModelBudget<f64>;

/// The budgets of the parts of a body.
pub type Budgets = ModelBudgets<f64>;

/// An angle's range around 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AngleRange {
    /// From the first to the second, radians, both within ±π, the first ≤ 0 ≤ the second, the first < the second.
    Between(f64, f64),
    /// Without limit; the angle wraps.
    Free,
}

impl AngleRange {
    /// Both ends, the lower first, radians; infinite where the angle is free.
    #[must_use]
    pub fn ends(self) -> [f64; 2] {
        match self {
            Self::Between(lo, hi) => [lo, hi],
            Self::Free => [f64::NEG_INFINITY, f64::INFINITY],
        }
    }
}

impl JointSpec {
    /// The ranges of the added angles where the animation turns the joint by `animated`, radians, out of the pose that
    /// they are counted from; `None` where that is the animation.
    pub fn range_of_motion(&self, animated: Option<Angles<f64>>) -> RangeOfMotion<f64> {
        let declared = Angles { heading: self.heading.map(AngleRange::ends), pitch: self.pitch.map(AngleRange::ends) };
        RangeOfMotion::new(declared, self.pitch_taper.unwrap_or(0.0), animated)
    }

    /// The number of declared angles, 1 or 2.
    #[must_use]
    pub fn angles(&self) -> usize {
        usize::from(self.pitch.is_some()) + usize::from(self.heading.is_some())
    }
}

impl RigSpec {
    /// The number of declared angles of the whole chain.
    pub fn angles(&self) -> usize {
        self.joints.iter().map(JointSpec::angles).sum()
    }
}
