//! Instruction counts, by valgrind: the same on every run, whatever else the machine does.
//!
//! Needs valgrind and `gungraun-runner`. With `-- --save-summary=json` the counts are kept for `bench_table`, which finds
//! them by the names of these functions.
#![expect(missing_docs, unused_qualifications, reason = "what gungraun's macros emit")]

#[expect(unreachable_pub, reason = "shared with the other benchmark")]
mod contenders;

use std::hint::black_box;

use aim_benches::pose::{ChainPose, JointPose, measured_chains as chains, measured_joints as joints};
use aim_benches::{Float, by_hand, chain_by_hand, derived, differences};
use contenders::dual::{self, Real};
use contenders::symbolic;
use gungraun::prelude::*;

/// Gives the poses back: freeing them is not measured.
#[inline(always)]
fn each<P, O>(poses: Vec<P>, f: impl Fn(&P) -> O) -> Vec<P> {
    for pose in &poses {
        black_box(f(black_box(pose)));
    }
    poses
}

#[library_benchmark]
#[bench::f32(joints::<f32>())]
#[bench::f64(joints::<f64>())]
fn joint_derived<S: Float>(poses: Vec<JointPose<S>>) -> Vec<JointPose<S>> {
    each(poses, derived::joint)
}

#[library_benchmark]
#[bench::f32(joints::<f32>())]
#[bench::f64(joints::<f64>())]
fn joint_by_hand<S: Float>(poses: Vec<JointPose<S>>) -> Vec<JointPose<S>> {
    each(poses, by_hand::joint)
}

#[library_benchmark]
#[bench::f32(joints::<f32>())]
#[bench::f64(joints::<f64>())]
fn joint_dual_turned_back<S: Real>(poses: Vec<JointPose<S>>) -> Vec<JointPose<S>> {
    each(poses, dual::turned_back)
}

#[library_benchmark]
#[bench::f32(joints::<f32>())]
#[bench::f64(joints::<f64>())]
fn joint_dual_paper<S: Real>(poses: Vec<JointPose<S>>) -> Vec<JointPose<S>> {
    each(poses, dual::paper)
}

#[library_benchmark]
#[bench::f32(joints::<f32>())]
#[bench::f64(joints::<f64>())]
fn joint_differences<S: Float>(poses: Vec<JointPose<S>>) -> Vec<JointPose<S>> {
    each(poses, differences::joint)
}

#[library_benchmark]
#[bench::f64(joints())]
fn joint_symdiff(poses: Vec<JointPose<f64>>) -> Vec<JointPose<f64>> {
    each(poses, symbolic::joint)
}

#[library_benchmark]
#[bench::f32(joints::<f32>())]
#[bench::f64(joints::<f64>())]
fn joint_given_derived<S: Float>(poses: Vec<JointPose<S>>) -> Vec<JointPose<S>> {
    each(poses, derived::joint_given)
}

#[library_benchmark]
#[bench::f32(joints::<f32>())]
#[bench::f64(joints::<f64>())]
fn joint_given_by_hand<S: Float>(poses: Vec<JointPose<S>>) -> Vec<JointPose<S>> {
    each(poses, by_hand::joint_given)
}

#[library_benchmark]
#[bench::f32(chains::<f32>())]
#[bench::f64(chains::<f64>())]
fn gradient_derived<S: Float>(poses: Vec<ChainPose<S>>) -> Vec<ChainPose<S>> {
    each(poses, derived::gradient)
}

#[library_benchmark]
#[bench::f32(chains::<f32>())]
#[bench::f64(chains::<f64>())]
fn gradient_by_hand<S: Float>(poses: Vec<ChainPose<S>>) -> Vec<ChainPose<S>> {
    each(poses, chain_by_hand::gradient)
}

#[library_benchmark]
#[bench::f32(chains::<f32>())]
#[bench::f64(chains::<f64>())]
fn gradient_differences<S: Float>(poses: Vec<ChainPose<S>>) -> Vec<ChainPose<S>> {
    each(poses, differences::gradient)
}

#[library_benchmark]
#[bench::f32(chains::<f32>())]
#[bench::f64(chains::<f64>())]
fn gradient_given_derived<S: Float>(poses: Vec<ChainPose<S>>) -> Vec<ChainPose<S>> {
    each(poses, derived::gradient_given)
}

#[library_benchmark]
#[bench::f32(chains::<f32>())]
#[bench::f64(chains::<f64>())]
fn gradient_given_by_hand<S: Float>(poses: Vec<ChainPose<S>>) -> Vec<ChainPose<S>> {
    each(poses, chain_by_hand::gradient_given)
}

#[library_benchmark]
#[bench::f32(chains::<f32>())]
#[bench::f64(chains::<f64>())]
fn jacobian_derived<S: Float>(poses: Vec<ChainPose<S>>) -> Vec<ChainPose<S>> {
    each(poses, derived::jacobian)
}

#[library_benchmark]
#[bench::f32(chains::<f32>())]
#[bench::f64(chains::<f64>())]
fn jacobian_by_hand<S: Float>(poses: Vec<ChainPose<S>>) -> Vec<ChainPose<S>> {
    each(poses, chain_by_hand::jacobian)
}

#[library_benchmark]
#[bench::f32(chains::<f32>())]
#[bench::f64(chains::<f64>())]
fn jacobian_differences<S: Float>(poses: Vec<ChainPose<S>>) -> Vec<ChainPose<S>> {
    each(poses, differences::jacobian)
}

#[library_benchmark]
#[bench::f32(chains::<f32>())]
#[bench::f64(chains::<f64>())]
fn jacobian_given_derived<S: Float>(poses: Vec<ChainPose<S>>) -> Vec<ChainPose<S>> {
    each(poses, derived::jacobian_given)
}

#[library_benchmark]
#[bench::f32(chains::<f32>())]
#[bench::f64(chains::<f64>())]
fn jacobian_given_by_hand<S: Float>(poses: Vec<ChainPose<S>>) -> Vec<ChainPose<S>> {
    each(poses, chain_by_hand::jacobian_given)
}

library_benchmark_group!(
    name = joint,
    benchmarks =
        [joint_derived, joint_by_hand, joint_dual_turned_back, joint_dual_paper, joint_differences, joint_symdiff,]
);
library_benchmark_group!(name = joint_given, benchmarks = [joint_given_derived, joint_given_by_hand]);
library_benchmark_group!(name = gradient, benchmarks = [gradient_derived, gradient_by_hand, gradient_differences]);
library_benchmark_group!(name = gradient_given, benchmarks = [gradient_given_derived, gradient_given_by_hand]);
library_benchmark_group!(name = jacobian, benchmarks = [jacobian_derived, jacobian_by_hand, jacobian_differences]);
library_benchmark_group!(name = jacobian_given, benchmarks = [jacobian_given_derived, jacobian_given_by_hand]);
main!(library_benchmark_groups = [joint, joint_given, gradient, gradient_given, jacobian, jacobian_given]);
