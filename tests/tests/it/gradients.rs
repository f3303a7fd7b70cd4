//! Compares emitted Rust, emitted C and the interpreter with central differences of independent forward kinematics, for
//! every convention, handedness, general frames and hinges.

use aim_codegen::RigSpec;
use aim_tests::compare::compare;
use aim_tests::kinematics::Case;
use aim_tests::scale::{part_of, sampled};
use aim_tests::{c, oracle, rigs};

use crate::emitted;

#[test]
fn emitted_rust_and_the_interpreter_agree_with_central_differences() {
    for (number, spec) in rigs::rigs().iter().enumerate() {
        let cases = oracle::cases(spec, number as u64, part_of(60));
        compare(spec, &cases, &emitted::outputs(number, &cases));
    }
}

#[test]
fn degenerate_targets_give_finite_zeros() {
    // Joint 0 of this rig has both angles.
    let mut link = [0.0_f32; 12];
    (link[0], link[4], link[8]) = (1.0, 1.0, 1.0);
    (link[9], link[10], link[11]) = (0.3, -0.2, 0.1);
    let rest = [0.0, 1.0, 0.0, 1.0];
    assert_eq!(
        emitted::Rig0::aim_gradient(0, &link, &[0.3, -0.2, 0.1], &rest),
        [0.0; 3],
        "the target is on the effector"
    );
    let far = emitted::Rig0::aim_gradient(0, &link, &[1e20, -1e20, 1e20], &rest);
    assert!(far.iter().all(|x| x.is_finite()), "{far:?}");
    (link[9], link[10], link[11]) = (0.0, 0.0, 0.0);
    for tiny in [0.0, 1e-45, -1e-40, 1e-20] {
        let near = emitted::Rig0::aim_gradient(0, &link, &[tiny, tiny, -tiny], &rest);
        assert!(near.iter().all(|x| x.is_finite() && x.abs() <= 2.0), "{tiny}: {near:?}");
    }
    assert_eq!(emitted::Rig0::aim_gradient(99, &link, &[1.0, 0.0, 0.0], &rest), [0.0; 3], "there is no such joint");
    let mut wrong_length = [1.0_f32; 1];
    emitted::Rig0::chain_value_gradient(&[], &[1.0, 0.0, 0.0], &[], &mut wrong_length);
    assert_eq!(wrong_length, [0.0], "the slices have the wrong length");
}

#[test]
fn emitted_c_compiles_without_warnings_and_agrees_with_central_differences() {
    let specs: Vec<RigSpec> = sampled(rigs::rigs()).collect();
    let cases_of = |(spec, seed)| oracle::cases(spec, seed, part_of(40));
    let cases: Vec<Vec<Case>> = specs.iter().zip(1000..).map(cases_of).collect();
    c::compare(&specs, &cases);
}
