//! The rules of the derivation: their results on the recorded problems, and that each rule is needed.

use aim_codegen::{EffectorSpec, Frame, RigSpec, emit, format_rust, kernels};
use aim_symbolic::Program;
use aim_symbolic::rules::{self, Rule};
use aim_tests::problems::{self, Problem};
use aim_tests::rigs::bare_joint;
use aim_tests::scale::sampled;
use quote::quote;

#[test]
fn counts_are_the_recorded_ones() {
    let others = problems::all().into_iter().filter_map(|Problem { name, g, wanted, operations }| {
        let count = Program::derive_wanted(&g, &wanted).count();
        (count.total() != operations).then(|| format!("{name}: {count} instead of {operations}"))
    });
    let others: Vec<String> = others.collect();
    assert!(others.is_empty(), "{others:#?}");
}

#[test]
fn without_any_one_rule_a_count_rises() {
    let is_needed = |rule: &Rule| {
        problems::all().into_iter().any(|Problem { g, wanted, operations, .. }| {
            Program::derive_without(&g, &wanted, &[*rule]).count().total() > operations
        })
    };
    let unneeded: Vec<Rule> = sampled(rules::all()).filter(|rule| !is_needed(rule)).collect();
    assert!(unneeded.is_empty(), "no recorded problem needs {unneeded:?}");
}

#[test]
fn a_trace_leads_from_the_statement_to_the_program() {
    for Problem { name, g, wanted, operations } in problems::all() {
        let steps = Program::trace(&g, &wanted);
        assert!(steps.windows(2).all(|pair| pair[0].after == pair[1].before), "{name}: {steps:?}");
        assert!(steps.iter().all(|step| step.after.total() < step.before.total()), "{name}: {steps:?}");
        assert_eq!(steps.last().map(|step| step.after.total()), Some(operations), "{name}");
    }
}

#[test]
fn objectives_come_within_a_twentieth_of_what_is_derived_by_hand() {
    let by_hand = |name: &str| match name {
        "squared distance" => Some(28),
        "aim with roll" => Some(62),
        "two targets" => Some(93),
        "ARAP term" => Some(58),
        _ => None,
    };
    let mut compared = 0;
    for Problem { name, operations, .. } in problems::all() {
        if let Some(reference) = by_hand(name) {
            assert!(20 * operations <= 21 * reference, "{name}: {operations} against {reference}");
            compared += 1;
        }
    }
    assert_eq!(compared, 4);
}

#[test]
fn seven_joints_fit_in_twelve_kilobytes() {
    let frame = Frame::cardinal().next().expect("there are 48");
    let joints = (0..7).map(|i| bare_joint(i, frame, true, true)).collect();
    let effector = EffectorSpec { frame, origin: [0.0; 3] };
    let spec = RigSpec { name: "Rig".into(), joints, effector, natural: None, region: None, kernels: Vec::new() };
    let kernels = kernels(&spec);
    let rig = emit::Rig { spec: &spec, kernels: &kernels };
    let text = format_rust(emit::rust::emit(&rig, &emit::rust::Item::of(&spec, quote!(::aim))));
    let from = text
        .find("fn chain_value_gradient<S: ::aim::__private::Scalar>(\n        __")
        .expect("the chain's aim and its derivatives are emitted");
    let length = text[from..].find("fn chain_residual_jacobian").expect("the residual comes after them");
    assert!(length <= 12_000, "{length} bytes");
}
