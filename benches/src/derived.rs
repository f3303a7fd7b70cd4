//! The benchmarked rig: that of `rigs/thug.toml`, declared with the derive macro.

use aim::{AimRig, Joint};

use crate::Float;
use crate::float::sin_cos;
use crate::pose::{ChainPose, JointPose};

/// A left eye, neck and upper spine joint, with +X up, +Y forward, +Z left.
#[derive(Debug, AimRig)]
#[aim(
    axes(up = +X, forward = +Y, left = +Z),
    kernels(aim_gradient, chain_value_gradient, chain_residual_jacobian)
)]
pub struct Thug {
    #[joint(role = eye, heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg, stiffness = 0.5)]
    left_eye: Joint,
    #[joint(role = neck, heading = -60deg..=60deg, pitch = -40deg..=35deg, rate = 170deg)]
    neck: Joint,
    #[joint(role = chest, heading = -20deg..=20deg, pitch = -10deg..=10deg, rate = 70deg, stiffness = 4.0)]
    spine3: Joint,
}

/// Returns aim, ∂aim/∂pitch, ∂aim/∂heading of one joint, from given sines and cosines.
#[inline(always)]
pub fn joint_given<S: Float>(pose: &JointPose<S>) -> [S; 3] {
    Thug::aim_gradient(0, &pose.link, &pose.target, &pose.sin_cos)
}

/// Returns aim, ∂aim/∂pitch, ∂aim/∂heading of one joint, from its angles.
#[inline(always)]
pub fn joint<S: Float>(pose: &JointPose<S>) -> [S; 3] {
    Thug::aim_gradient(0, &pose.link, &pose.target, &sin_cos(pose.angles))
}

/// Returns the chain's aim and six derivatives, from given sines and cosines.
#[inline(always)]
pub fn gradient_given<S: Float>(pose: &ChainPose<S>) -> [S; 7] {
    let mut out = [S::ZERO; 7];
    Thug::chain_value_gradient(&pose.links, &pose.target, &pose.sin_cos, &mut out);
    out
}

/// Returns the chain's aim and six derivatives, from its angles.
#[inline(always)]
pub fn gradient<S: Float>(pose: &ChainPose<S>) -> [S; 7] {
    let mut out = [S::ZERO; 7];
    Thug::chain_value_gradient(&pose.links, &pose.target, &pose.angles.map(sin_cos), &mut out);
    out
}

/// Returns the chain's residual and Jacobian, from given sines and cosines.
#[inline(always)]
pub fn jacobian_given<S: Float>(pose: &ChainPose<S>) -> [S; 14] {
    let mut out = [S::ZERO; 14];
    Thug::chain_residual_jacobian(&pose.links, &pose.target, &pose.sin_cos, &mut out);
    out
}

/// Returns the chain's residual and Jacobian, from its angles.
#[inline(always)]
pub fn jacobian<S: Float>(pose: &ChainPose<S>) -> [S; 14] {
    let mut out = [S::ZERO; 14];
    Thug::chain_residual_jacobian(&pose.links, &pose.target, &pose.angles.map(sin_cos), &mut out);
    out
}
