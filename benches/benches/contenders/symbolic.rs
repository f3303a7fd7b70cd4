//! The same by symdiff, whose attribute differentiates scalar expressions while compiling.
//!
//! It knows f64 slices, arithmetic, sines, cosines and square roots, so the problem can be stated, in components. It
//! knows no vectors or rotations, no f32, no select for a guard, and no angle whose sine and cosine are given. The
//! statement is the cheaper one, with the target turned back; the value is a call of its own.

use aim_benches::pose::JointPose;

/// One joint, from its angles.
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
