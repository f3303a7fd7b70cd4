//! The same functions by symdiff, whose attribute macro differentiates scalar expressions at compile time.
//!
//! symdiff supports f64 slices, arithmetic, sines, cosines and square roots, so the problem can be written in
//! components. It has no vectors or rotations, no f32, no select for a guard, and cannot take the sine and cosine of an
//! angle as inputs. The cheaper formulation is used here, with the target rotated back. The value takes a call of its
//! own.

use aim_benches::pose::JointPose;

/// Returns aim, ∂aim/∂pitch, ∂aim/∂heading of one joint, from its angles.
#[inline(always)]
pub fn joint(pose: &JointPose<f64>) -> [f64; 3] {
    let value = aim(&pose.angles, &pose.target, &pose.link);
    let [by_pitch, by_heading] = aim_gradient(&pose.angles, &pose.target, &pose.link);
    [value, by_pitch, by_heading]
}

#[symdiff::gradient(var = angles, dim = 2)]
fn aim(angles: &[f64], target: &[f64], link: &[f64]) -> f64 {
    let w = target[1] * angles[1].cos() + target[2] * angles[1].sin();
    let x = target[0] * angles[0].cos() - w * angles[0].sin() - link[9];
    let y = target[0] * angles[0].sin() + w * angles[0].cos() - link[10];
    let z = target[2] * angles[1].cos() - target[1] * angles[1].sin() - link[11];
    (link[3] * x + link[4] * y + link[5] * z) / (x * x + y * y + z * z).sqrt()
}
