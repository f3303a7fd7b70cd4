//! [`Motion`]: how a clip moves the character that plays it. `root.rs` says what of the character moves, `steady.rs` has the motions
//! of constant speed.

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

/// The movement of a clip's root, taken out of the clip and given to the character's place.
///
/// `M(t)`, [`at`](Self::at), is a rigid transform, the identity at the beginning. The pose is played without it
/// ([`remove`](Self::remove)): `pose' = M(t)⁻¹ · pose`. The place of the character is moved by the
/// [`delta`](Self::delta) of each frame's step, `place' = place · delta`, over loops, backwards, at any speed. So `place · pose'` is
/// the movement as it was made, begun wherever the character stands, and right at any time at which it is interrupted. That needs no
/// pose and no drawing: a delta is a function of the step alone.
///
/// | kind | `M(t)` | the clip keeps |
/// |---|---|---|
/// | [`linear`](Self::linear) | the root from the first to the last frame along a straight line, turning evenly | starts, stops, bobbing |
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
    /// From the first frame to the last, as a screw.
    whole: Steady,
    bone: usize,
}

#[derive(Clone, Debug, PartialEq)]
enum Kind {
    Steady(Steady),
    /// The path, and the inverse of its beginning.
    Variable(RootPath, Transform),
}

impl Motion {
    /// Straight from the first frame to the last, at constant speed, turning at constant speed.
    #[must_use]
    pub fn linear(path: &RootPath) -> Self {
        let whole = Steady::screw(path);
        Self { kind: Kind::Steady(whole.straightened(path)), length_s: path.length_s, whole, bone: path.bone }
    }

    /// The screw from the first frame to the last, at constant speed: about an axis and along it. What walks a curve stays on it,
    /// whenever it is interrupted.
    ///
    /// Turns of more than half a circle are told from shorter ones by the way between. Where a clip comes back to its direction
    /// after whole turns there is no such screw; then it is the linear motion.
    #[must_use]
    pub fn composite(path: &RootPath) -> Self {
        let whole = Steady::screw(path);
        Self { kind: Kind::Steady(whole), length_s: path.length_s, whole, bone: path.bone }
    }

    /// The path itself: the root does not move in the clip any more.
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

    /// The bone whose movement it is, or whose shadow's.
    #[must_use]
    pub fn bone(&self) -> usize {
        self.bone
    }

    /// The length of the clip, seconds.
    #[must_use]
    pub fn length_s(&self) -> f32 {
        narrow(self.length_s)
    }

    /// The movement from the beginning of the clip to a time of it, in the space of the model. Times outside the clip count as its
    /// ends, NaN as its beginning.
    #[must_use]
    pub fn at(&self, time_s: f32) -> Transform {
        let time = f64::from(time_s).max(0.0).min(self.length_s);
        match &self.kind {
            Kind::Steady(steady) => steady.at(time),
            Kind::Variable(path, start) => path.at(narrow(time)).rigid_product(start),
        }
    }

    /// The movement of a step through the clip, in the space of the character's place before it: `place' = place · delta`.
    #[must_use]
    pub fn delta(&self, step: &Step) -> Transform {
        // A clip that bounces comes back the way that it went.
        let ends = if step.bounces { 0.0 } else { f64::from(step.ends) };
        let rounds = if step.is_forward { ends } else { -ends };
        if let Kind::Steady(steady) = &self.kind {
            if steady.is_screw() {
                return steady.at(step.to_s - step.from_s + rounds * self.length_s);
            }
        }
        // M(from)⁻¹ · M(length)ⁿ · M(to).
        let whole = self.at(self.length_s());
        let whole =
            power(if rounds < 0.0 { whole.rigid_inverse() } else { whole }, if step.bounces { 0 } else { step.ends });
        let [from, to] = [step.from_s(), step.to_s()].map(|time| self.at(time));
        from.rigid_inverse().rigid_product(&whole.rigid_product(&to))
    }

    /// Takes the movement out of a pose of the clip at a time: what has no parent is moved by `M(t)⁻¹`.
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

    /// The clip without the movement, for what cannot [remove](Self::remove) it while it plays: linear tracks of what has no
    /// parent, sampled at least this often a second. A rate that is not positive and finite samples the ends alone.
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

    /// The screw that leads from the first frame to the last: axis, speeds about and along it. Of every kind of motion.
    #[must_use]
    pub fn screw(&self) -> Screw {
        self.whole.to_screw()
    }

    /// The mean of the deltas of several clips that are blended, weighted; of those whose clips count, the
    /// [shares](crate::Tree::shares) of a tree. The identity without a weight. Weights are clamped to 0…1, NaN counts as 0.
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

/// A rigid transform n times, by squaring.
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
