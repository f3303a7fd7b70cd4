//! Every file of `rigs/`: the compiled rig of `aim::rigs`, the interpreter and the emitted C agree with each other and
//! with central differences.

use aim::rigs::{Mannequin, Mixamo, Rigify, Rocketbox, Thug, Turret, UnrealMannequin, Vrm};
use aim::{AimRig, Natural, Role};
use aim_character::InterpretedRig;
use aim_codegen::{NaturalSpec, RigSpec};
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
    let (compiled, interpreted) = (R::default(), InterpretedRig::new(spec));
    compare::compare(spec, &cases, &Outputs::of(&compiled, &cases));
    assert_eq!(compiled.joint_infos(), interpreted.joint_infos(), "{name}");
    assert_eq!((compiled.effector(), compiled.natural()), (interpreted.effector(), interpreted.natural()), "{name}");
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
fn characters_have_eyes_necks_and_spines_and_a_turret_has_none() {
    for spec in specs() {
        let roles: Vec<_> = spec.joints.iter().map(aim_codegen::JointSpec::role).collect();
        let expected = match spec.name.as_str() {
            "Turret" => vec![aim_codegen::Role::Other; 2],
            _ => vec![aim_codegen::Role::Eye, aim_codegen::Role::Neck, aim_codegen::Role::Spine],
        };
        assert_eq!(roles, expected, "{}", spec.name);
    }
}

/// Every setting of a declaration that a solver may ask for, known when compiling.
#[derive(aim::AimRig)]
#[aim(bones(up = +X, forward = +Y), natural(eyes_only = 10deg, head_share = 0.7, release = 0.1rad, delay = 0.05))]
struct Owl {
    #[joint(heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg, narrowing = 0.25)]
    left_eye: aim::Joint,
    #[joint(heading = free, rate = 170deg, level = 0.5, acceleration = 20rad, range = absolute, bone = "Head_01")]
    turn: aim::Joint,
}

const OWL: &str = r#"
    name = "Owl"
    bones = { up = "+X", forward = "+Y" }
    natural = { eyes_only = "10deg", head_share = 0.7, release = "0.1rad", delay = 0.05 }
    [[joint]]
    name = "left_eye"
    heading = ["-35deg", "35deg"]
    pitch = ["-25deg", "20deg"]
    rate = "450deg"
    narrowing = 0.25
    [[joint]]
    name = "turn"
    heading = "free"
    rate = "170deg"
    level = 0.5
    acceleration = "20rad"
    range = "absolute"
    bone = "Head_01"
"#;

#[test]
fn what_is_declared_reaches_the_solvers_whichever_way_the_rig_runs() {
    let spec = aim_codegen::declare::from_toml("owl", OWL).expect("a right declaration");
    let (compiled, interpreted) = (Owl::default(), InterpretedRig::new(&spec));
    assert_eq!(compiled.joint_infos(), interpreted.joint_infos());
    assert_eq!(compiled.natural(), interpreted.natural());
    let [eye, turn] = compiled.joint_infos() else { panic!("two joints") };
    assert_eq!((eye.role, eye.narrowing, eye.level), (Role::Eye, 0.25, None));
    assert_eq!((turn.role, turn.narrowing, turn.level, turn.absolute), (Role::Head, 0.0, Some(0.5), true));
    assert_eq!((compiled.natural().head_share, compiled.natural().delay), (0.7, 0.05));
}

#[test]
fn what_is_not_declared_of_a_natural_gaze_is_the_runtimes() {
    let (ours, runtimes) = (NaturalSpec::default(), Natural::default());
    let pairs = [
        (ours.eyes_only, runtimes.eyes_only),
        (ours.head_share, runtimes.head_share),
        (ours.engage, runtimes.engage),
        (ours.release, runtimes.release),
        (ours.delay, runtimes.delay),
    ];
    assert!(pairs.iter().all(|(a, b)| (a - f64::from(*b)).abs() < 1e-6), "{pairs:?}");
}

#[test]
fn the_c_of_every_rig_agrees_with_central_differences_on_ten_thousand_poses() {
    for spec in specs() {
        let cases = oracle::cases(&spec, 11, 10_000);
        c::compare(&[spec], &[cases]);
    }
}

#[test]
fn the_page_about_axes_shows_what_is_declared() {
    let page = include_str!("../../docs/axes.md");
    let axis = |[x, y, z]: [f64; 3]| -> String {
        let (letter, value) =
            [("X", x), ("Y", y), ("Z", z)].into_iter().find(|(_, value)| *value != 0.0).expect("a unit");
        format!("{}{letter}", if value < 0.0 { '-' } else { '+' })
    };
    let mut rows = 0;
    for row in page.lines().filter(|line| line.starts_with("| `rigs/")) {
        let cells: Vec<&str> = row.split('|').map(|cell| cell.trim().trim_matches('`')).collect();
        let [_, file, bone, directions @ ..] = cells.as_slice() else { panic!("{row}") };
        let path = format!("{}/../{file}", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).expect("the page names a bundled rig");
        let rig = aim_codegen::declare::from_toml(file, &text).expect("a bundled rig is right");
        let joint = rig.joints.iter().find(|joint| joint.name == *bone).expect("the page names a joint");
        let frame = [joint.frame.up, joint.frame.forward, joint.frame.left].map(axis);
        assert_eq!(directions[..3], frame, "{row}");
        rows += 1;
    }
    assert!(rows >= 8, "{rows} rows");
    let (_, snippet) = page.split_once("```toml\n").expect("the page shows a declaration");
    let joint = snippet.split("```").next().unwrap_or_default();
    let whole = format!("name = 'R'\nhandedness = 'right'\n{joint}heading = 'free'\nrate = '1rad'\n");
    aim_codegen::declare::from_toml("axes.md", &whole).unwrap_or_else(|errors| panic!("{errors}"));
}
