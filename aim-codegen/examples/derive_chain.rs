//! Derives the aim of a chain of N joints, all its derivatives, and writes the Rust that a macro would: what a derivation costs.
//!
//! `derive_chain N`, under callgrind and without optimisation, which is how macros run.

use std::process::ExitCode;

use aim_codegen::objective::{CHAIN_VALUE_GRADIENT, FirstLink};
use aim_codegen::{AngleRange, EffectorSpec, Frame, JointSpec, LimitsFrom, RigSpec, Role};
use aim_symbolic::print;

fn main() -> ExitCode {
    let Some(joints) = std::env::args().nth(1).and_then(|n| n.parse().ok()).filter(|n| (1..=100).contains(n)) else {
        eprintln!("derive_chain: how many joints, 1 to 100?");
        return ExitCode::FAILURE;
    };
    let spec = rig(joints);
    let all: Vec<usize> = (0..joints).collect();
    let program = CHAIN_VALUE_GRADIENT.statement(&spec, &all, FirstLink::Given).program();
    println!("{joints} joints: {}; {} bytes of text", program.count(), print::maxima("chain", &program).len());
    ExitCode::SUCCESS
}

/// A chain of joints that turn and nod, with the axes +X up, +Y forward, +Z left.
fn rig(joints: usize) -> RigSpec {
    let frame = Frame { up: [1.0, 0.0, 0.0], forward: [0.0, 1.0, 0.0], left: [0.0, 0.0, 1.0] };
    let range = Some(AngleRange::Between(-1.0, 1.0));
    let joint = |i: usize| JointSpec {
        name: format!("joint{i}"),
        bones: vec![format!("joint{i}")],
        role: Role::None,
        frame,
        pitch: range,
        heading: range,
        limits_from: LimitsFrom::Animation,
        rate: 1.0,
        acceleration: None,
        stiffness: 1.0,
        upright: None,
        pitch_taper: None,
        other_eye: None,
        hold: None,
    };
    RigSpec {
        name: "Chain".into(),
        joints: (0..joints).map(joint).collect(),
        effector: EffectorSpec { frame, origin: [0.0; 3] },
        natural: None,
        region: None,
        kernels: Vec::new(),
    }
}
