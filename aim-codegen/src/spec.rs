//! [`RigSpec`]: a declaration that has passed every check. All that follows (deriving, emitting) cannot fail.

use crate::Role;

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
    /// The part of the pitch's range that is lost at either end of the heading's, 0…1.
    pub narrowing: Option<f64>,
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

/// How a natural gaze is shared between the eyes and the joints that support them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NaturalSpec {
    /// The gaze shift that the eyes make alone, radians, 0…π.
    pub eyes_only: f64,
    /// The part of the gaze shift beyond that which the head makes, 0…1.
    pub head_share: f64,
    /// The supporting joints begin to move when the eyes are further from their middle than this, radians, 0…π.
    pub engage: f64,
    /// They rest again once the eyes are nearer their middle than this, radians, at most [`engage`](Self::engage).
    pub release: f64,
    /// How long after the eyes the supporting joints begin, seconds.
    pub delay: f64,
}

/// What the runtime takes where nothing is declared.
impl Default for NaturalSpec {
    fn default() -> Self {
        Self {
            eyes_only: 15f64.to_radians(),
            head_share: 0.8,
            engage: 15f64.to_radians(),
            release: 8f64.to_radians(),
            delay: 0.0,
        }
    }
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

    /// What part the joint has in a gaze: what the first of its own name and its bones' names that tells says.
    pub fn role(&self) -> Role {
        let names = core::iter::once(&self.name).chain(&self.bones);
        names.filter_map(|name| Role::of_name(name)).next().unwrap_or_default()
    }
}

impl RigSpec {
    /// The number of declared angles of the whole chain.
    pub fn angles(&self) -> usize {
        self.joints.iter().map(JointSpec::angles).sum()
    }
}

impl Frame {
    /// All 48 conventions: every choice of signed axes for up, forward and left, of either handedness.
    pub fn cardinal() -> impl Iterator<Item = Self> {
        let unit = |axis: usize, negative: bool| {
            let length = if negative { -1.0 } else { 1.0 };
            core::array::from_fn(|k| if k == axis { length } else { 0.0 })
        };
        let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
        orders.into_iter().flat_map(move |[up, forward, left]| {
            (0..8).map(move |signs| Self {
                up: unit(up, signs & 1 != 0),
                forward: unit(forward, signs & 2 != 0),
                left: unit(left, signs & 4 != 0),
            })
        })
    }

    /// +1 where up × forward is left, −1 where it is −left.
    pub fn handedness(&self) -> f64 {
        let [u, f, l] = [self.up, self.forward, self.left];
        let cross = [u[1] * f[2] - u[2] * f[1], u[2] * f[0] - u[0] * f[2], u[0] * f[1] - u[1] * f[0]];
        (cross[0] * l[0] + cross[1] * l[1] + cross[2] * l[2]).signum()
    }
}
