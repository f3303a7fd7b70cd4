//! [`Inertia`]: transitions between animations without a jump in pose or velocity.

use alloc::vec::Vec;

use aim_runtime::glam::{Quat, Vec3};
use aim_runtime::rotation::{exp, length, log, product};

use crate::fade::decay_polynomials;
use crate::pose::{PoseError, check_length};
use crate::skeleton::Skeleton;
use crate::transform::{Transform, made_unit};

/// Input of [`Inertia::begin`]: two poses of the old and of the new animation, the first `dt_s` ago, the second now.
#[derive(Clone, Copy, Debug)]
pub struct Transition<'a> {
    /// The last two poses shown, the older first, including the remainder of an earlier transition.
    pub shown: [&'a [Transform]; 2],
    /// Two poses of the new animation at the same times: `dt_s` before its start, and at its start.
    pub next: [&'a [Transform]; 2],
    /// Time between the two poses of each animation, seconds.
    pub dt_s: f32,
    /// Duration of the transition, seconds.
    pub length_s: f32,
}

/// A transition of one character between animations, by inertialisation: the offset of the old animation from the new
/// one continues at its current velocity and decays to zero. Only the new animation needs to be evaluated.
///
/// - Translations, scales and rotation vectors decay along quintic polynomials, from the initial offset and velocity to
///   zero at rest, with zero acceleration at both ends.
/// - Pose and velocity are therefore continuous at the start and at the end, also if one transition interrupts another.
/// - The velocity adds at most a fifth of velocity × length to the offset, so longer transitions overshoot more.
/// - A component of the scale keeps its sign if both animations have the same sign: it is bent away from 0 smoothly.
/// - Components that are not finite, as in a transition of 10³⁰ s, are taken from the new animation.
///
/// ```
/// use aim_animation::glam::Vec3;
/// use aim_animation::{Bone, Inertia, Skeleton, Transform, Transition};
///
/// let skeleton = Skeleton::new([Bone::new("hips", None)])?;
/// let at = |x: f32| [Transform::from_translation(Vec3::X * x)];
/// let mut inertia = Inertia::new(&skeleton);
/// // What was shown moves by 1 a second and is at 2, what begins stands at 5.
/// let (shown, next) = ([at(1.9), at(2.0)], at(5.0));
/// let shown = [&shown[0][..], &shown[1][..]];
/// inertia.begin(&Transition { shown, next: [&next, &next], dt_s: 0.1, length_s: 0.4 })?;
/// let mut pose = at(5.0);
/// inertia.advance(0.01);
/// inertia.apply(&mut pose)?;
/// assert!((pose[0].translation.x - 2.01).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Inertia {
    offsets: Vec<Offset>,
    elapsed_s: f32,
    /// Duration of the transition, seconds; 0 if there is none.
    length_s: f32,
}

/// Offset of a bone at the start of a transition, and its velocity: translation, rotation vector and scale.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Offset {
    value: [Vec3; 3],
    velocity: [Vec3; 3],
    /// Scale shown at the start of the transition.
    scale: Vec3,
}

impl Inertia {
    /// Allocates the memory for one character, without a transition.
    #[must_use]
    pub fn new(skeleton: &Skeleton) -> Self {
        let none = Offset { value: [Vec3::ZERO; 3], velocity: [Vec3::ZERO; 3], scale: Vec3::ZERO };
        Self { offsets: alloc::vec![none; skeleton.len()], elapsed_s: 0.0, length_s: 0.0 }
    }

    /// Begins a transition at the time of the later poses, replacing any current one.
    ///
    /// - If `length_s` is not positive and finite, there is no transition: the new animation starts with a cut.
    /// - If `dt_s` is not positive and finite, the velocities of the two animations are treated as equal.
    /// - An offset or velocity of a bone that is not finite is treated as zero.
    ///
    /// # Errors
    /// Fails if a pose differs in length from the skeleton. Nothing changes then.
    pub fn begin(&mut self, transition: &Transition<'_>) -> Result<(), PoseError> {
        let Transition { shown, next, dt_s, length_s } = *transition;
        shown.iter().chain(&next).try_for_each(|pose| check_length(self.offsets.len(), pose.len()))?;
        let rate = if dt_s > 0.0 && dt_s.is_finite() { 1.0 / dt_s } else { 0.0 };
        for (bone, offset) in self.offsets.iter_mut().enumerate() {
            let [before, now] = [0, 1].map(|time| between(&next[time][bone], &shown[time][bone]));
            let before = [before[0], near(before[1], now[1]), before[2]];
            let velocity = [0, 1, 2].map(|part: usize| (now[part] - before[part]) * rate);
            let finite = |vector: Vec3| if vector.is_finite() { vector } else { Vec3::ZERO };
            let scale = shown[1][bone].scale;
            *offset = Offset { value: now.map(finite), velocity: velocity.map(finite), scale };
        }
        self.elapsed_s = 0.0;
        self.length_s = if length_s.is_finite() { length_s.max(0.0) } else { 0.0 };
        Ok(())
    }

    /// Advances by `dt_s` seconds; a negative or non-finite step is treated as 0.
    pub fn advance(&mut self, dt_s: f32) {
        if dt_s.is_finite() {
            self.elapsed_s = (self.elapsed_s + dt_s.max(0.0)).min(self.length_s);
        }
    }

    /// Returns `true` if no transition is in progress.
    #[must_use]
    pub fn is_done(&self) -> bool {
        !(self.elapsed_s < self.length_s)
    }

    /// Adds the remaining offset to a pose of the new animation. Does nothing once the transition is
    /// [done](Self::is_done).
    ///
    /// # Errors
    /// Fails if the pose differs in length from the skeleton. Nothing is written then.
    pub fn apply(&self, pose: &mut [Transform]) -> Result<(), PoseError> {
        check_length(self.offsets.len(), pose.len())?;
        if self.is_done() {
            return Ok(());
        }
        let u = self.elapsed_s / self.length_s;
        let (of_value, of_velocity) = decay_polynomials(u);
        let of_velocity = of_velocity * self.length_s;
        for (transform, Offset { value, velocity, scale: shown }) in pose.iter_mut().zip(&self.offsets) {
            let [place, turn, scale] =
                [0, 1, 2].map(|part: usize| value[part] * of_value + velocity[part] * of_velocity);
            let Transform { translation: next_place, scale: next_scale, .. } = *transform;
            transform.translation = finite_or(next_place + place, next_place);
            transform.rotation = made_unit(product(exp(turn), transform.rotation));
            let kept = |axis: usize| sign_kept(next_scale[axis] + scale[axis], shown[axis], next_scale[axis]);
            transform.scale = finite_or(Vec3::new(kept(0), kept(1), kept(2)), next_scale);
        }
        Ok(())
    }
}

/// Returns the difference `to` − `from`: translation, rotation vector in the parent's space, scale.
fn between(from: &Transform, to: &Transform) -> [Vec3; 3] {
    let turn: Quat = product(made_unit(to.rotation), made_unit(from.rotation).conjugate());
    [to.translation - from.translation, log(turn), to.scale - from.scale]
}

/// Returns the rotation vector of the same rotation that is nearer to `like`: `vector` itself, or the one that goes the
/// other way round, `vector · (1 − 2π / angle)`.
fn near(vector: Vec3, like: Vec3) -> Vec3 {
    let angle = length(vector.into());
    let other = vector - vector * (core::f32::consts::TAU / angle);
    if angle > 1e-3 && length((other - like).into()) < length((vector - like).into()) { other } else { vector }
}

fn finite_or(vector: Vec3, other: Vec3) -> Vec3 {
    if vector.is_finite() { vector } else { other }
}

/// Bends a scale away from 0 if `shown` (the scale at the start) and `next` (that of the new animation) have the same
/// sign, so that it keeps that sign.
///
/// With h = shown · next / (shown + next), which is less than either: x for x ≥ h, and h² / (2h − x) below. The value
/// and the slope are continuous at h.
fn sign_kept(scale: f32, shown: f32, next: f32) -> f32 {
    let sign = if next < 0.0 { -1.0 } else { 1.0 };
    let [x, shown, next] = [scale * sign, shown * sign, next * sign];
    let least = next / (1.0 + next / shown);
    if shown > 0.0 && next > 0.0 && x < least { sign * (least * (least / (2.0 * least - x))) } else { scale }
}
