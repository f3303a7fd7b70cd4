//! [`RigSpec`]: a declaration that has passed every check. All that follows (deriving, emitting) cannot fail.

/// A checked rig. Angles in radians, vectors unit and square to each other.
#[derive(Clone, Debug, PartialEq)]
pub struct RigSpec {
    /// The rig's name, a Rust type name such as `Thug`.
    pub name: String,
    /// The joints, from the effector inward; at least one.
    pub joints: Vec<JointSpec>,
    /// What is aimed, in joint 0's bone space.
    pub effector: EffectorSpec,
}

/// A checked joint.
#[derive(Clone, Debug, PartialEq)]
pub struct JointSpec {
    /// The field's name, such as `left_eye`.
    pub name: String,
    /// Names its bone may have in a model; never empty, by default the field's name.
    pub bones: Vec<String>,
    /// The bone's axes.
    pub frame: Frame,
    /// The pitch's range, or `None` for a joint that does not nod.
    pub pitch: Option<AngleRange>,
    /// The heading's range, or `None` for a joint that does not turn.
    pub heading: Option<AngleRange>,
    /// Whether the ranges are counted from the bind pose instead of from the animation.
    pub absolute: bool,
    /// Largest speed of each angle, rad/s.
    pub rate: f64,
    /// Largest change of speed, rad/s².
    pub acceleration: Option<f64>,
    /// The joint's weight in the displacement cost.
    pub comfort: f64,
    /// How far heading turns about the character's up, 0…1.
    pub level: Option<f64>,
    /// The other eye's bone.
    pub pair: Option<String>,
}

/// Unit, mutually square axes of a bone in its own space; `up × forward = ±left`, the sign by handedness and mirror.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The direction that points up in the character.
    pub up: [f64; 3],
    /// The direction the character faces.
    pub forward: [f64; 3],
    /// The direction of the character's left.
    pub left: [f64; 3],
}

/// What is aimed, in joint 0's bone space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffectorSpec {
    /// The effector's axes: joint 0's, or squared to the declared effector forward (forward kept).
    pub frame: Frame,
    /// The point the direction starts from.
    pub origin: [f64; 3],
}

/// An angle's range around 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AngleRange {
    /// From the first to the second, radians, both within ±π, the first ≤ 0 ≤ the second, the first < the second.
    Between(f64, f64),
    /// Without limit; the angle wraps.
    Free,
}

impl JointSpec {
    /// The number of declared angles, 1 or 2.
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
