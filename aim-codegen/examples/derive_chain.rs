//! Derives the aim of a chain of N joints, all its derivatives, and writes the Rust that a macro would: what a derivation costs.
//!
//! `derive_chain N`, under callgrind and without optimisation, which is how macros run.

use std::process::ExitCode;

use aim_codegen::objective::{self, ChainInputs};
use aim_codegen::{AngleRange, EffectorSpec, Frame, JointSpec, RigSpec};
use aim_symbolic::{Graph, Program, print};

fn main() -> ExitCode {
    let Some(joints) = std::env::args().nth(1).and_then(|n| n.parse().ok()).filter(|n| (1..=100).contains(n)) else {
        eprintln!("derive_chain: how many joints, 1 to 100?");
        return ExitCode::FAILURE;
    };
    let spec = rig(joints);
    let mut g = Graph::new();
    let inputs = ChainInputs::declare(&mut g, joints);
    let aim = objective::chain_aim(&mut g, &spec, &inputs);
    let program = Program::derive(&g, &[aim], &inputs.declared_angles(&spec));
    println!("{joints} joints: {}; {} bytes of text", program.count(), print::plain(&program).len());
    ExitCode::SUCCESS
}

/// A chain of joints that turn and nod, with the axes +X up, +Y forward, +Z left.
fn rig(joints: usize) -> RigSpec {
    let frame = Frame { up: [1.0, 0.0, 0.0], forward: [0.0, 1.0, 0.0], left: [0.0, 0.0, 1.0] };
    let range = Some(AngleRange::Between(-1.0, 1.0));
    let joint = |i: usize| JointSpec {
        name: format!("joint{i}"),
        bones: vec![format!("joint{i}")],
        frame,
        pitch: range,
        heading: range,
        absolute: false,
        rate: 1.0,
        acceleration: None,
        comfort: 1.0,
        level: None,
        narrowing: None,
        pair: None,
    };
    RigSpec {
        name: "Chain".into(),
        joints: (0..joints).map(joint).collect(),
        effector: EffectorSpec { frame, origin: [0.0; 3] },
        natural: None,
    }
}
