//! [`Motion`]: root motion. `root.rs` defines the root and samples its path, `steady.rs` has the motions of constant
//! speed.

mod error;
mod root;
mod steady;

use aim_runtime::glam::Vec3;
use aim_runtime::rotation::{exp, log};

pub use error::MotionError;
pub use root::{Root, RootPath};
pub use steady::Screw;

use crate::clip::{Clip, sample_times};
use crate::cursor::Cursor;
use crate::float::narrow;
use crate::mask::clamped;
use crate::pose::{PoseError, check_length};
use crate::skeleton::Skeleton;
use crate::step::Step;
use crate::track::Track;
use crate::transform::{Transform, made_unit};
use steady::Steady;

/// Root motion: the movement of a clip's root, removed from the clip and applied to the character's place.
///
/// `M(t)`, [`at`](Self::at), is a rigid transform, the identity at the beginning. The clip is played without it
/// ([`remove`](Self::remove)): `pose' = M(t)⁻¹ · pose`. The [`delta`](Self::delta) of each frame's step moves the
/// character's place, `place' = place · delta`, across loops, backwards, and at any speed. So `place · pose'`
/// reproduces the authored movement from wherever the character stands, and stays correct if it is interrupted at any
/// time. A delta depends only on the step: no pose has to be sampled.
///
/// | kind | `M(t)` | the clip keeps |
/// |---|---|---|
/// | [`linear`](Self::linear) | a straight line from the first to the last frame, turning at a constant rate | starts, stops, bobbing |
/// | [`composite`](Self::composite) | the screw from the first to the last frame (Chasles): along an arc | the same, less of it in curves |
/// | [`variable`](Self::variable) | the root itself | nothing: the root stands still |
///
/// ```
/// use aim_animation::glam::{Vec3, Vec3A};
/// use aim_animation::{Bone, Clip, Control, Motion, Root, RootPath, Skeleton, Track, Transform};
///
/// let skeleton = Skeleton::new([Bone::new("hips", None)])?;
/// let stride = Track::linear([0.0, 1.0], [Vec3::Y, Vec3::Y + 1.4 * Vec3::Z])?;
/// let walk = Clip::new("walk").with_translation(0, stride);
/// let root = Root::Shadow { bone: 0, up: Vec3::Y };
/// let motion = Motion::linear(&RootPath::new(&walk, &skeleton, root, 30.0)?);
///
/// let (mut control, mut place) = (Control::new().with_speed(2.0), Transform::IDENTITY);
/// let mut pose = [Transform::IDENTITY];
/// for _ in 0..60 {
///     let step = control.advance(1.0 / 30.0, walk.length_s());
///     place = place.rigid_product(&motion.delta(&step));
///     walk.sample(step.to_s(), &mut walk.cursor(), &mut pose);
///     motion.remove(step.to_s(), &skeleton, &mut pose)?;
/// }
/// assert!(place.translation.distance(5.6 * Vec3::Z) < 1e-4);
/// assert!(pose[0].translation.distance(Vec3::Y) < 1e-5, "the hips stay above the place");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    kind: Kind,
    length_s: f64,
    /// Screw motion from the first frame to the last.
    whole: Steady,
    bone: usize,
}

#[derive(Clone, Debug, PartialEq)]
enum Kind {
    Steady(Steady),
    /// The path and the inverse of its first transform.
    Variable(RootPath, Transform),
}

impl Motion {
    /// The motion along a straight line from the first frame to the last, with constant speed and constant turning
    /// rate.
    #[must_use]
    pub fn linear(path: &RootPath) -> Self {
        let whole = Steady::screw(path);
        Self { kind: Kind::Steady(whole.straightened(path)), length_s: path.length_s, whole, bone: path.bone }
    }

    /// The screw motion from the first frame to the last: a rotation about an axis and a translation along it, both at
    /// constant speed. A character that walks a curve stays on the curve whenever it is interrupted.
    ///
    /// Turns of more than half a circle are recognised by summing the rotation along the path. If the clip ends in its
    /// initial direction after whole turns, the screw is not determined, and the motion is the linear one.
    #[must_use]
    pub fn composite(path: &RootPath) -> Self {
        let whole = Steady::screw(path);
        Self { kind: Kind::Steady(whole), length_s: path.length_s, whole, bone: path.bone }
    }

    /// The motion that follows the path exactly: the root no longer moves in the clip.
    #[must_use]
    pub fn variable(path: &RootPath) -> Self {
        let start = path.at(0.0).rigid_inverse();
        Self {
            kind: Kind::Variable(path.clone(), start),
            length_s: path.length_s,
            whole: Steady::screw(path),
            bone: path.bone,
        }
    }

    /// The bone whose movement, or whose shadow's movement, this is.
    #[must_use]
    pub fn bone(&self) -> usize {
        self.bone
    }

    /// Length of the clip, seconds.
    #[must_use]
    pub fn length_s(&self) -> f32 {
        narrow(self.length_s)
    }

    /// Returns the movement from the beginning of the clip to a time, in model space. Times are clamped to the clip;
    /// NaN is treated as its beginning.
    #[must_use]
    pub fn at(&self, time_s: f32) -> Transform {
        let time = f64::from(time_s).max(0.0).min(self.length_s);
        match &self.kind {
            Kind::Steady(steady) => steady.at(time),
            Kind::Variable(path, start) => path.at(narrow(time)).rigid_product(start),
        }
    }

    /// Returns the movement of a step through the clip, in the space of the character's place before the step:
    /// `place' = place · delta`.
    #[must_use]
    pub fn delta(&self, step: &Step) -> Transform {
        // A clip that bounces returns along the way it came, so its passes cancel.
        let ends = if step.bounces { 0.0 } else { f64::from(step.ends) };
        let cycles = if step.is_forward { ends } else { -ends };
        if let Kind::Steady(steady) = &self.kind {
            if steady.is_screw() {
                return steady.at(step.to_s - step.from_s + cycles * self.length_s);
            }
        }
        // delta = M(from)⁻¹ · M(length)ⁿ · M(to), where n is the signed number of ends passed.
        let whole = self.at(self.length_s());
        let whole =
            power(if cycles < 0.0 { whole.rigid_inverse() } else { whole }, if step.bounces { 0 } else { step.ends });
        let [from, to] = [step.from_s(), step.to_s()].map(|time| self.at(time));
        from.rigid_inverse().rigid_product(&whole.rigid_product(&to))
    }

    /// Removes the movement from a pose of the clip at a time: bones without a parent are moved by `M(t)⁻¹`.
    ///
    /// # Errors
    /// `pose` has another length than the skeleton; then nothing is written.
    pub fn remove(&self, time_s: f32, skeleton: &Skeleton, pose: &mut [Transform]) -> Result<(), PoseError> {
        check_length(skeleton.len(), pose.len())?;
        let back = self.at(time_s).rigid_inverse();
        for (transform, parent) in pose.iter_mut().zip(skeleton.parents()) {
            if parent.is_none() {
                *transform = Transform { scale: transform.scale, ..back.rigid_product(transform) };
            }
        }
        Ok(())
    }

    /// Returns the clip with the movement removed, for players that cannot [remove](Self::remove) it at run time. The
    /// tracks of bones without a parent are replaced by linear ones with at least `rate_hz` samples a second. If the
    /// rate is not positive and finite, only the ends are sampled.
    #[must_use]
    pub fn removed_from(&self, clip: &Clip, skeleton: &Skeleton, rate_hz: f32) -> Clip {
        let rate_hz = if rate_hz.is_finite() { rate_hz } else { 0.0 };
        let times = sample_times(clip.length_s(), rate_hz);
        let mut stripped = clip.clone();
        let roots = (0..skeleton.len()).filter(|bone| skeleton.parents()[*bone].is_none());
        for bone in roots {
            let mut pose = skeleton.rest().to_vec();
            let samples = times.iter().map(|time| {
                pose.copy_from_slice(skeleton.rest());
                clip.sample(*time, &mut Cursor::default(), &mut pose);
                let at = self.at(*time).rigid_inverse().rigid_product(&pose[bone]);
                (at.translation, at.rotation)
            });
            let (places, rotations): (alloc::vec::Vec<_>, alloc::vec::Vec<_>) = samples.unzip();
            if let (Ok(places), Ok(rotations)) =
                (Track::linear(times.clone(), places), Track::linear(times.clone(), rotations))
            {
                stripped = stripped.with_translation(bone, places).with_rotation(bone, rotations);
            }
        }
        stripped
    }

    /// Returns the screw motion from the first frame to the last: its axis, and the speeds about and along it.
    /// Available for every kind of motion.
    #[must_use]
    pub fn screw(&self) -> Screw {
        self.whole.to_screw()
    }

    /// Weighted mean of the deltas of blended clips; for a tree, the weights are its [shares](crate::Tree::shares). The
    /// identity if no weight is positive. Weights are clamped to 0…1; NaN is treated as 0.
    pub fn blend(deltas: impl IntoIterator<Item = (Transform, f32)>) -> Transform {
        let mut sum = (Vec3::ZERO, Vec3::ZERO, 0.0);
        for (delta, weight) in deltas {
            let weight = clamped(weight);
            if weight > 0.0 {
                sum.0 += delta.translation * weight;
                sum.1 += log(delta.rotation) * weight;
                sum.2 += weight;
            }
        }
        if !(sum.2 > 0.0) {
            return Transform::IDENTITY;
        }
        Transform::new(sum.0 / sum.2, made_unit(exp(sum.1 / sum.2)))
    }
}

/// Raises a rigid transform to the n-th power, by repeated squaring.
fn power(transform: Transform, mut exponent: u32) -> Transform {
    let (mut power, mut square) = (Transform::IDENTITY, transform);
    while exponent > 0 {
        if exponent % 2 == 1 {
            power = power.rigid_product(&square);
        }
        square = square.rigid_product(&square);
        exponent /= 2;
    }
    power
}
