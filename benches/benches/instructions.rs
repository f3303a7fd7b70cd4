//! Instruction counts, taken with valgrind: the same on every run, whatever the load of the machine.
//!
//! Needs valgrind and `gungraun-runner`. With `-- --save-summary=json` the counts are saved for `bench_table`, which
//! looks them up by the names below: problem, implementation, number type.
#![expect(missing_docs, unused_qualifications, reason = "what gungraun's macros emit")]

#[expect(unreachable_pub, reason = "shared with the other benchmark")]
mod contenders;

use std::hint::black_box;

use aim_benches::pose::{measured_chains as chains, measured_joints as joints};
use aim_benches::{by_hand, chain_by_hand, derived, differences};
use contenders::{dual, symbolic};
use gungraun::prelude::*;

#[library_benchmark]
#[bench::joint_derived_f32(joints::<f32>(), derived::joint::<f32>)]
#[bench::joint_derived_f64(joints::<f64>(), derived::joint::<f64>)]
#[bench::joint_by_hand_f32(joints::<f32>(), by_hand::joint::<f32>)]
#[bench::joint_by_hand_f64(joints::<f64>(), by_hand::joint::<f64>)]
#[bench::joint_dual_turned_back_f32(joints::<f32>(), dual::turned_back::<f32>)]
#[bench::joint_dual_turned_back_f64(joints::<f64>(), dual::turned_back::<f64>)]
#[bench::joint_dual_paper_f32(joints::<f32>(), dual::paper::<f32>)]
#[bench::joint_dual_paper_f64(joints::<f64>(), dual::paper::<f64>)]
#[bench::joint_differences_f32(joints::<f32>(), differences::joint::<f32>)]
#[bench::joint_differences_f64(joints::<f64>(), differences::joint::<f64>)]
#[bench::joint_symdiff_f64(joints::<f64>(), symbolic::joint)]
#[bench::joint_given_derived_f32(joints::<f32>(), derived::joint_given::<f32>)]
#[bench::joint_given_derived_f64(joints::<f64>(), derived::joint_given::<f64>)]
#[bench::joint_given_by_hand_f32(joints::<f32>(), by_hand::joint_given::<f32>)]
#[bench::joint_given_by_hand_f64(joints::<f64>(), by_hand::joint_given::<f64>)]
#[bench::gradient_derived_f32(chains::<f32>(), derived::gradient::<f32>)]
#[bench::gradient_derived_f64(chains::<f64>(), derived::gradient::<f64>)]
#[bench::gradient_by_hand_f32(chains::<f32>(), chain_by_hand::gradient::<f32>)]
#[bench::gradient_by_hand_f64(chains::<f64>(), chain_by_hand::gradient::<f64>)]
#[bench::gradient_differences_f32(chains::<f32>(), differences::gradient::<f32>)]
#[bench::gradient_differences_f64(chains::<f64>(), differences::gradient::<f64>)]
#[bench::gradient_given_derived_f32(chains::<f32>(), derived::gradient_given::<f32>)]
#[bench::gradient_given_derived_f64(chains::<f64>(), derived::gradient_given::<f64>)]
#[bench::gradient_given_by_hand_f32(chains::<f32>(), chain_by_hand::gradient_given::<f32>)]
#[bench::gradient_given_by_hand_f64(chains::<f64>(), chain_by_hand::gradient_given::<f64>)]
#[bench::jacobian_derived_f32(chains::<f32>(), derived::jacobian::<f32>)]
#[bench::jacobian_derived_f64(chains::<f64>(), derived::jacobian::<f64>)]
#[bench::jacobian_by_hand_f32(chains::<f32>(), chain_by_hand::jacobian::<f32>)]
#[bench::jacobian_by_hand_f64(chains::<f64>(), chain_by_hand::jacobian::<f64>)]
#[bench::jacobian_differences_f32(chains::<f32>(), differences::jacobian::<f32>)]
#[bench::jacobian_differences_f64(chains::<f64>(), differences::jacobian::<f64>)]
#[bench::jacobian_given_derived_f32(chains::<f32>(), derived::jacobian_given::<f32>)]
#[bench::jacobian_given_derived_f64(chains::<f64>(), derived::jacobian_given::<f64>)]
#[bench::jacobian_given_by_hand_f32(chains::<f32>(), chain_by_hand::jacobian_given::<f32>)]
#[bench::jacobian_given_by_hand_f64(chains::<f64>(), chain_by_hand::jacobian_given::<f64>)]
// Returns the poses, so that freeing them is not measured.
fn each<P, O>(poses: Vec<P>, way: impl Fn(&P) -> O) -> Vec<P> {
    for pose in &poses {
        black_box(way(black_box(pose)));
    }
    poses
}

library_benchmark_group!(name = evaluations, benchmarks = each);
main!(library_benchmark_groups = evaluations);
