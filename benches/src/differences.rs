//! Central differences of the hand-written functions: two evaluations for each angle, and one for the value.
//!
//! They are made as cheap as possible: an evaluation recomputes only the sine and cosine of the angle that it moves.

use crate::Float;
use crate::float::sin_cos;
use crate::pose::{ChainPose, JointPose};
use crate::{by_hand, chain_by_hand};

/// Returns aim, ∂aim/∂pitch, ∂aim/∂heading of one joint, from its angles.
#[inline(always)]
pub fn joint<S: Float>(pose: &JointPose<S>) -> [S; 3] {
    let [pitch, heading] = pose.angles;
    let [sp, cp, sh, ch] = sin_cos(pose.angles);
    let aim = |sin_cos: [S; 4]| by_hand::aim(&pose.link, &pose.target, &sin_cos);
    let by_pitch = central(pitch, |(sp, cp)| aim([sp, cp, sh, ch]));
    let by_heading = central(heading, |(sh, ch)| aim([sp, cp, sh, ch]));
    [aim([sp, cp, sh, ch]), by_pitch, by_heading]
}

#[inline(always)]
fn central<S: Float>(angle: S, f: impl Fn((S, S)) -> S) -> S {
    let ahead = f((angle + S::STEP).sin_cos());
    let behind = f((angle - S::STEP).sin_cos());
    (ahead - behind) * (S::constant(0.5) / S::STEP)
}

/// Returns the chain's aim and six derivatives, from its angles.
#[inline(always)]
pub fn gradient<S: Float>(pose: &ChainPose<S>) -> [S; 7] {
    let at_rest = pose.angles.map(sin_cos);
    let aim = |sin_cos: &[[S; 4]; 3]| [chain_by_hand::aim(&pose.links, &pose.target, sin_cos)];
    let [[a], [b], [c], [d], [e], [f]] = columns(pose, &at_rest, aim);
    [aim(&at_rest)[0], a, b, c, d, e, f]
}

/// Returns the chain's residual and Jacobian, from its angles.
#[inline(always)]
pub fn jacobian<S: Float>(pose: &ChainPose<S>) -> [S; 14] {
    let at_rest = pose.angles.map(sin_cos);
    let residual = |sin_cos: &[[S; 4]; 3]| chain_by_hand::residual(&pose.links, &pose.target, sin_cos);
    let columns = columns(pose, &at_rest, residual);
    let [left, up] = residual(&at_rest);
    std::array::from_fn(|i| match i {
        0 => left,
        1 => up,
        2..8 => columns[i - 2][0],
        _ => columns[i - 8][1],
    })
}

/// Returns the derivatives of `f` by each angle, joint by joint, pitch before heading.
#[inline(always)]
fn columns<S: Float, const R: usize>(
    pose: &ChainPose<S>,
    at_rest: &[[S; 4]; 3],
    f: impl Fn(&[[S; 4]; 3]) -> [S; R],
) -> [[S; R]; 6] {
    std::array::from_fn(|i| {
        let (joint, angle) = (i / 2, i % 2);
        let at = |moved: S| {
            let mut turned = *at_rest;
            (turned[joint][2 * angle], turned[joint][2 * angle + 1]) = moved.sin_cos();
            f(&turned)
        };
        let ahead = at(pose.angles[joint][angle] + S::STEP);
        let behind = at(pose.angles[joint][angle] - S::STEP);
        std::array::from_fn(|r| (ahead[r] - behind[r]) * (S::constant(0.5) / S::STEP))
    })
}
