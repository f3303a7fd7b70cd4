//! [`Inertia`]: from one animation to another without a jump in place or speed.

use alloc::vec::Vec;

use aim_runtime::glam::{Quat, Vec3};
use aim_runtime::rotation::{exp, length, log, product};

use crate::fade::faded;
use crate::pose::{PoseError, check_length};
use crate::skeleton::Skeleton;
use crate::transform::{Transform, made_unit};

/// The animations that a transition leads from and to, each at two times, `dt_s` apart, the later one now.
#[derive(Clone, Copy, Debug)]
pub struct Transition<'a> {
    /// The last two poses that were shown, the older one first: as they were, with what an earlier transition had left.
    pub shown: [&'a [Transform]; 2],
    /// The animation that begins, at the same two times: before where it begins, and there.
    pub next: [&'a [Transform]; 2],
    /// The time between the two, seconds.
    pub dt_s: f32,
    /// Duration of the transition, seconds.
    pub length_s: f32,
}

/// A transition of one character: what the old animation differs from the new one by, in place and speed, goes on under its own
/// momentum and fades. Only the new animation is evaluated any more.
///
/// Translations and scales fade by polynomials of the fifth degree, from the difference and its velocity, without acceleration, to
/// nothing at rest; rotations by their rotation vectors. So places and speeds are continuous at both ends, and a transition that is
/// interrupted by another is, too. Momentum carries on by a fifth of velocity × length at most: long transitions swing farther.
///
/// Momentum does not mirror a bone: where both animations have a scale of the same sign it keeps that, and turns away from 0
/// smoothly. What would leave the range of numbers, by a transition of 10³⁰ s for instance, is left as the new animation has it.
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
    /// 0 where there is no transition.
    length_s: f32,
}

/// A bone's offset when the transition begins, and its rate of change: translation, rotation vector, scale.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Offset {
    value: [Vec3; 3],
    velocity: [Vec3; 3],
    /// The scale that was shown then.
    scale: Vec3,
}

impl Inertia {
    /// Memory for a character in no transition.
    #[must_use]
    pub fn new(skeleton: &Skeleton) -> Self {
        let none = Offset { value: [Vec3::ZERO; 3], velocity: [Vec3::ZERO; 3], scale: Vec3::ZERO };
        Self { offsets: alloc::vec![none; skeleton.len()], elapsed_s: 0.0, length_s: 0.0 }
    }

    /// Begins a transition at the time of the later poses, in place of the one that may be under way. A length that is not positive
    /// and finite is none: a cut. Without a `dt_s` that is positive and finite velocities count as equal. What is not finite in a
    /// bone's poses makes no difference for it.
    ///
    /// # Errors
    /// A pose has another length than the skeleton; then nothing changes.
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

    /// Goes on by `dt_s` seconds; what is negative or not finite counts as 0.
    pub fn advance(&mut self, dt_s: f32) {
        if dt_s.is_finite() {
            self.elapsed_s = (self.elapsed_s + dt_s.max(0.0)).min(self.length_s);
        }
    }

    /// True if there is no transition any more.
    #[must_use]
    pub fn is_done(&self) -> bool {
        !(self.elapsed_s < self.length_s)
    }

    /// Adds what is left of the difference to the pose of the new animation; nothing once it is [done](Self::is_done).
    ///
    /// # Errors
    /// The pose has another length than the skeleton; then nothing is written.
    pub fn apply(&self, pose: &mut [Transform]) -> Result<(), PoseError> {
        check_length(self.offsets.len(), pose.len())?;
        if self.is_done() {
            return Ok(());
        }
        let u = self.elapsed_s / self.length_s;
        let (of_value, of_velocity) = faded(u);
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

/// By what one transform differs from another: translation, rotation vector in the parent's space, scale.
fn between(from: &Transform, to: &Transform) -> [Vec3; 3] {
    let turn: Quat = product(made_unit(to.rotation), made_unit(from.rotation).conjugate());
    [to.translation - from.translation, log(turn), to.scale - from.scale]
}

/// Of the two rotation vectors of a rotation, the short way and the long way round, the one nearer to another.
fn near(vector: Vec3, like: Vec3) -> Vec3 {
    let angle = length(vector.into());
    let other = vector - vector * (core::f32::consts::TAU / angle);
    if angle > 1e-3 && length((other - like).into()) < length((vector - like).into()) { other } else { vector }
}

fn finite_or(vector: Vec3, other: Vec3) -> Vec3 {
    if vector.is_finite() { vector } else { other }
}

/// A scale between the one shown first and the next one, moved away from 0 where it would lose the sign that both have.
///
/// With h = shown · next / (shown + next), less than either: x from h on, h² / (2h − x) below, with the same slope at h.
fn sign_kept(scale: f32, shown: f32, next: f32) -> f32 {
    let sign = if next < 0.0 { -1.0 } else { 1.0 };
    let [x, shown, next] = [scale * sign, shown * sign, next * sign];
    let least = next / (1.0 + next / shown);
    if shown > 0.0 && next > 0.0 && x < least { sign * (least * (least / (2.0 * least - x))) } else { scale }
}
