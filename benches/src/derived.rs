//! The rig under measurement: the thug of `rigs/thug.toml`, by the derive.

use aim::{AimRig, Joint};

use crate::Float;
use crate::float::sin_cos;
use crate::pose::{ChainPose, JointPose};

/// +X up, +Y forward, +Z left.
#[derive(AimRig)]
#[aim(bones(up = +X, forward = +Y, left = +Z))]
pub struct Thug {
    #[joint(heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg, comfort = 0.5)]
    left_eye: Joint,
    #[joint(heading = -60deg..=60deg, pitch = -40deg..=35deg, rate = 170deg)]
    neck: Joint,
    #[joint(heading = -20deg..=20deg, pitch = -10deg..=10deg, rate = 70deg, comfort = 4.0)]
    spine3: Joint,
}

/// No kernel reads the joints' state, and none of the others makes any.
static THUG: Thug = Thug { left_eye: Joint::REST, neck: Joint::REST, spine3: Joint::REST };

/// One joint, sines and cosines given.
#[inline(always)]
pub fn joint_given<S: Float>(pose: &JointPose<S>) -> [S; 3] {
    THUG.aim_gradient(0, &pose.link, &pose.target, &pose.sin_cos)
}

/// One joint, from its angles.
#[inline(always)]
pub fn joint<S: Float>(pose: &JointPose<S>) -> [S; 3] {
    THUG.aim_gradient(0, &pose.link, &pose.target, &sin_cos(pose.angles))
}

/// The chain's aim and six derivatives, sines and cosines given.
#[inline(always)]
pub fn gradient_given<S: Float>(pose: &ChainPose<S>) -> [S; 7] {
    let mut out = [S::ZERO; 7];
    THUG.chain_value_gradient(&pose.links, &pose.target, &pose.sin_cos, &mut out);
    out
}

/// The chain's aim and six derivatives, from its angles.
#[inline(always)]
pub fn gradient<S: Float>(pose: &ChainPose<S>) -> [S; 7] {
    let mut out = [S::ZERO; 7];
    THUG.chain_value_gradient(&pose.links, &pose.target, &pose.angles.map(sin_cos), &mut out);
    out
}

/// The chain's residual and Jacobian, sines and cosines given.
#[inline(always)]
pub fn jacobian_given<S: Float>(pose: &ChainPose<S>) -> [S; 14] {
    let mut out = [S::ZERO; 14];
    THUG.chain_residual_jacobian(&pose.links, &pose.target, &pose.sin_cos, &mut out);
    out
}

/// The chain's residual and Jacobian, from its angles.
#[inline(always)]
pub fn jacobian<S: Float>(pose: &ChainPose<S>) -> [S; 14] {
    let mut out = [S::ZERO; 14];
    THUG.chain_residual_jacobian(&pose.links, &pose.target, &pose.angles.map(sin_cos), &mut out);
    out
}
