//! Every file of `rigs/`: the compiled rig of `aim::rigs`, the interpreter and the emitted C agree with each other and
//! with central differences.

use aim::AimRig;
use aim::rigs::{Mannequin, Mixamo, Rigify, Rocketbox, Thug, Turret, UnrealMannequin, Vrm};
use aim_codegen::RigSpec;
use aim_tests::compare::{self, Outputs};
use aim_tests::{c, oracle};

fn specs() -> Vec<RigSpec> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../rigs");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .expect("the repository has a folder rigs")
        .map(|entry| entry.expect("it can be listed").path())
        .collect();
    files.sort();
    let specs: Vec<RigSpec> = files
        .iter()
        .map(|file| {
            let text = std::fs::read_to_string(file).expect("a rig file is text");
            aim_codegen::declare::from_toml("rig", &text).expect("a bundled rig is right")
        })
        .collect();
    assert!(specs.len() >= 8, "{} rigs", specs.len());
    specs
}

fn compare<R: AimRig + Default>(name: &str) {
    let specs = specs();
    let spec = specs.iter().find(|spec| spec.name == name).expect("each compiled rig has its file");
    let cases = oracle::cases(spec, 7, 300);
    compare::compare(spec, &cases, &Outputs::of(&R::default(), &cases));
}

#[test]
fn compiled_rust_is_the_interpreter_bit_for_bit_and_agrees_with_central_differences() {
    compare::<Mannequin>("Mannequin");
    compare::<Mixamo>("Mixamo");
    compare::<Rigify>("Rigify");
    compare::<Rocketbox>("Rocketbox");
    compare::<Thug>("Thug");
    compare::<Turret>("Turret");
    compare::<UnrealMannequin>("UnrealMannequin");
    compare::<Vrm>("Vrm");
}

#[test]
fn the_c_of_every_rig_agrees_with_central_differences_on_ten_thousand_poses() {
    for spec in specs() {
        let cases = oracle::cases(&spec, 11, 10_000);
        c::compare(&[spec], &[cases]);
    }
}
