//! For every file of `rigs/`, the compiled rig of `aim::rigs`, the interpreter and the emitted C agree with each other
//! and with central differences.

use aim::rigs::{Mannequin, Mixamo, Rigify, Rocketbox, Thug, Turret, UnrealMannequin, Vrm};
use aim::{AimRig, Budgets, GazeSharing, LimitsFrom, Rig, Role};
use aim_character::InterpretedRig;
use aim_codegen::objective::FirstLink;
use aim_codegen::{NaturalSpec, RigSpec};
use aim_tests::kinematics::Case;
use aim_tests::scale::part_of;
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

fn compare<R: AimRig>(name: &str) {
    let specs = specs();
    let spec = specs.iter().find(|spec| spec.name == name).expect("each compiled rig has its file");
    let (compiled, interpreted) = (R::RIG, InterpretedRig::new(spec));
    let [ours, others] = [compiled.description(), interpreted.description()];
    assert_eq!(ours.joints(), others.joints(), "{name}");
    assert_eq!((ours.effector(), ours.sharing()), (others.effector(), others.sharing()), "{name}");
    for joint in 0..=ours.joints().len() {
        assert_eq!(compiled.joint_name(joint), interpreted.joint_name(joint), "{name}");
        assert_eq!(compiled.bone_name(joint, 0), interpreted.bone_name(joint, 0), "{name}");
    }
    for mut case in oracle::cases(spec, 7, 300) {
        if FirstLink::of(spec) == FirstLink::Identity {
            case.links[0].rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            case.links[0].translation = [0.0; 3];
            // This moves the effector, so check again that the target is not behind it, where the residual is steep.
            let (distance, angle) = case.view(spec);
            if distance < 0.5 || angle > 2.0 {
                continue;
            }
        }
        compare_case(spec, &case, compiled, &interpreted);
    }
}

fn compare_case(spec: &RigSpec, case: &Case, compiled: &dyn Rig, interpreted: &dyn Rig) {
    let name = &spec.name;
    let links: Vec<[f32; 12]> = case.links.iter().map(|link| link.numbers().map(rounded)).collect();
    let (target, sin_cos) = (case.target.map(rounded), case.sin_cos());
    let sin_cos: Vec<[f32; 4]> = sin_cos.into_iter().map(|numbers| numbers.map(rounded)).collect();
    let bits = |numbers: &[f32]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    let (_, jacobian) = oracle::expected_chain(spec, case);
    let [mut ours, mut theirs] = [vec![0.0; jacobian.len()], vec![0.0; jacobian.len()]];
    compiled.residual_jacobian(&links, &target, &sin_cos, &mut ours);
    interpreted.residual_jacobian(&links, &target, &sin_cos, &mut theirs);
    assert_eq!(bits(&ours), bits(&theirs), "{name}: compiled and interpreted");
    oracle::assert_close(&oracle::doubled(&ours), &jacobian, 2e-4, &format!("{name}, Jacobian"));
    for joint in 0..links.len() {
        let ours = compiled.aim_gradient(joint, &links[joint], &target, &sin_cos[joint]);
        let theirs = interpreted.aim_gradient(joint, &links[joint], &target, &sin_cos[joint]);
        assert_eq!(bits(&ours), bits(&theirs), "{name}: compiled and interpreted");
        if let Some(expected) = oracle::expected_joint(spec, case, joint) {
            oracle::assert_close(&oracle::doubled(&ours), &expected, 2e-5, &format!("{name}, joint {joint}"));
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "kernels take single precision")]
fn rounded(x: f64) -> f32 {
    x as f32
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
        let roles: Vec<_> = spec.joints.iter().map(|joint| joint.role).collect();
        let expected = match spec.name.as_str() {
            "Turret" => vec![Role::None; 2],
            _ => vec![Role::Eye, Role::Neck, Role::Chest],
        };
        assert_eq!(roles, expected, "{}", spec.name);
    }
}

/// Every setting of a declaration that a solver may query, as a compile-time constant.
#[derive(aim::AimRig)]
#[aim(axes(up = +X, forward = +Y), natural(eyes_only = 10deg, head_share = 0.7, release = 0.1rad, delay = 0.05),
    region(like = bird, head(heading = -130deg..=130deg, rate = 400deg), chest(acceleration = 9rad)))]
struct Owl {
    #[joint(role = eye, heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg, pitch_taper = 0.25)]
    left_eye: aim::Joint,
    #[joint(role = head, heading = free, rate = 170deg, upright = 0.5, acceleration = 20rad, limits_from = bind_pose, bone = "Head_01")]
    turn: aim::Joint,
}

const OWL: &str = r#"
    name = "Owl"
    axes = { up = "+X", forward = "+Y" }
    natural = { eyes_only = "10deg", head_share = 0.7, release = "0.1rad", delay = 0.05 }
    region.like = "bird"
    region.head = { heading = ["-130deg", "130deg"], rate = "400deg" }
    region.chest.acceleration = "9rad"
    [[joint]]
    name = "left_eye"
    role = "eye"
    heading = ["-35deg", "35deg"]
    pitch = ["-25deg", "20deg"]
    rate = "450deg"
    pitch_taper = 0.25
    [[joint]]
    name = "turn"
    role = "head"
    heading = "free"
    rate = "170deg"
    upright = 0.5
    acceleration = "20rad"
    limits_from = "bind_pose"
    bone = "Head_01"
"#;

#[test]
fn what_is_declared_reaches_the_solvers_whichever_way_the_rig_runs() {
    let spec = aim_codegen::declare::from_toml("owl", OWL).expect("a right declaration");
    let interpreted = InterpretedRig::new(&spec);
    let [compiled, interpreted] = [Owl::RIG.description(), interpreted.description()];
    assert_eq!(compiled.joints(), interpreted.joints());
    assert_eq!(compiled.sharing(), interpreted.sharing());
    assert_eq!(compiled.budgets(), interpreted.budgets());
    let Budgets { head, chest } = compiled.budgets();
    assert_eq!((head.heading[1], head.rate, chest.acceleration), (130_f32.to_radians(), 400_f32.to_radians(), 9.0));
    assert_eq!((head.pitch, chest.rate), (Budgets::BIRD.head.pitch, Budgets::BIRD.chest.rate));
    let [eye, turn] = compiled.joints() else { panic!("two joints") };
    assert_eq!((eye.role, eye.pitch_taper, eye.upright), (Role::Eye, 0.25, None));
    assert_eq!(
        (turn.role, turn.pitch_taper, turn.upright, turn.limits_from),
        (Role::Head, 0.0, Some(0.5), LimitsFrom::BindPose)
    );
    assert_eq!((compiled.sharing().head_share, compiled.sharing().delay), (0.7, 0.05));
}

#[test]
fn what_is_not_declared_of_a_natural_gaze_is_the_runtimes() {
    let (ours, runtimes) = (NaturalSpec::default(), GazeSharing::default());
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
fn the_c_of_every_rig_agrees_with_central_differences() {
    let specs = specs();
    let cases: Vec<Vec<Case>> = specs.iter().map(|spec| oracle::cases(spec, 11, part_of(10_000))).collect();
    c::compare(&specs, &cases);
}

#[test]
fn the_page_about_axes_shows_what_is_declared() {
    let page = include_str!("../../../docs/axes.md");
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
