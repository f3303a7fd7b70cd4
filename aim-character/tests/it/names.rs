//! Names do not influence a rig: with every field and bone renamed, its motion is the same bit by bit.

use aim_character::InterpretedRig;
use aim_codegen::{JointSpec, RigSpec, Role, declare};
use aim_runtime::glam::{Affine3A, EulerRot, Mat3A, Quat, Vec3, Vec3A};
use aim_runtime::{DynAim, JointSet, Outcome, Pose, Settings, Solver, Status};

use crate::RIGS;

const FRAME_S: f32 = 1.0 / 60.0;
const FRAMES: u16 = 300;
/// `None` leaves the solver to the rig, which chooses by role.
const SOLVERS: [Option<Solver>; 4] = [None, Some(Solver::Natural), Some(Solver::Exact), Some(Solver::Ascent)];
/// Other names for joints, from the effector inward: names of other parts of the body, of eyes only, and of no part.
const OTHER_NAMES: [[&str; 4]; 4] = [
    ["tail", "left_eye", "head", "neck"],
    ["chest", "right_eye", "neck", "left_eye"],
    ["left_eye", "right_eye", "eye_3", "eye_4"],
    ["joint_a", "joint_b", "joint_c", "joint_d"],
];

/// Renames the joints of a declaration, their bones and the other eye.
fn renamed(declaration: &str, names: &[&str]) -> String {
    let mut joints = names.iter();
    let mut name = "Tail";
    let rename = |line: &str| match line.split_once(" = ") {
        _ if line == "[[joint]]" => {
            name = joints.next().expect("a name for every joint");
            line.to_owned()
        }
        Some(("name", _)) => format!("name = {name:?}"),
        Some(("bone", _)) => format!("bone = {:?}", [name.replace('_', " "), format!("Bip01_{name}")]),
        Some(("other_eye", _)) => format!("other_eye = \"Bip01 Spine of {name}\""),
        _ => line.to_owned(),
    };
    declaration.lines().map(rename).collect::<Vec<_>>().join("\n")
}

/// Removes the roles from a declaration.
fn without_roles(declaration: &str) -> String {
    declaration.lines().filter(|line| !line.starts_with("role = ")).collect::<Vec<_>>().join("\n")
}

fn declared(declaration: &str) -> RigSpec {
    declare::from_toml("a rig", declaration).unwrap_or_else(|errors| panic!("{}", errors.render()))
}

/// The result of a frame, with floats as bits.
#[derive(Debug, PartialEq)]
struct Frame {
    angles: Vec<[u32; 2]>,
    corrections: Vec<[u32; 4]>,
    aim: [u32; 2],
    other_eye: Option<(u32, [u32; 4])>,
    status: Status,
    sets: [JointSet; 2],
}

impl Frame {
    fn new(aim: &DynAim<InterpretedRig>, outcome: &Outcome) -> Self {
        let bits = |rotation: &Quat| rotation.to_array().map(f32::to_bits);
        let other_eye = outcome.other_eye_remaining.zip(outcome.other_eye_correction);
        Self {
            angles: aim.state.joints.iter().map(|joint| [joint.heading(), joint.pitch()].map(f32::to_bits)).collect(),
            corrections: aim.corrections().iter().map(bits).collect(),
            aim: [outcome.aim, outcome.remaining].map(f32::to_bits),
            other_eye: other_eye.map(|(remaining, correction)| (remaining.to_bits(), bits(&correction))),
            status: outcome.status,
            sets: [outcome.at_limit, outcome.recovering],
        }
    }
}

/// Runs five seconds of a swaying character with a target that orbits it, jumps, and passes behind it.
fn motion(spec: &RigSpec, solver: Option<Solver>) -> Vec<Frame> {
    let mut settings = Settings::default();
    settings.solver = solver;
    let mut aim = DynAim::new(InterpretedRig::new(spec));
    let (bind, left) = (standing(spec, 0.0), Vec3::from(axis(spec.joints[0].frame.left)));
    let mut frame = |number: u16| {
        let t = f32::from(number) * FRAME_S;
        let joints = standing(spec, t);
        let mut pose = Pose::new(&joints[..]).with_up(Vec3::Y).with_bind(&bind);
        if spec.joints[0].other_eye.is_some() {
            pose = pose.with_other_eye(joints[0] * Affine3A::from_translation(-0.06 * left));
        }
        let azimuth = 0.7 * t + f32::from(number / 60);
        let target = Vec3::new(2.0 * azimuth.sin(), 1.5 + t.sin(), 2.0 * azimuth.cos());
        let outcome =
            if number == 200 { aim.snap(&pose, target, &settings) } else { aim.aim(&pose, target, FRAME_S, &settings) };
        Frame::new(&aim, &outcome)
    };
    (0..FRAMES).map(&mut frame).collect()
}

/// Returns the joints one above the other, with +Y up and facing +Z, each swaying in its own way; at rest at 0 s.
fn standing(spec: &RigSpec, t: f32) -> Vec<Affine3A> {
    let place = |(height, joint): (f32, &JointSpec)| {
        let [up, forward, left] = [joint.frame.up, joint.frame.forward, joint.frame.left].map(axis);
        let upright = Mat3A::from_cols(left, up, forward).transpose();
        let sway = [0.5, 0.3, 0.2].map(|size| size * (t * (1.0 + size) * height).sin());
        let sway = Quat::from_euler(EulerRot::YXZ, sway[0], sway[1], sway[2]);
        let mut at = Affine3A::from_quat(sway) * Affine3A::from_mat3(upright.into());
        at.translation = Vec3A::new(0.0, height, 0.0);
        at
    };
    [1.65, 1.5, 1.35, 1.2].into_iter().zip(&spec.joints).map(place).collect()
}

#[expect(clippy::cast_possible_truncation, reason = "axes of the bundled rigs are ones and zeros")]
fn axis(declared: [f64; 3]) -> Vec3A {
    Vec3A::from_array(declared.map(|c| c as f32))
}

#[test]
fn renaming_every_field_and_bone_of_every_bundled_rig_changes_no_bit_of_its_motion() {
    for (rig, with_roles) in RIGS.into_iter().step_by(if crate::in_full() { 1 } else { 4 }) {
        for declaration in [with_roles.to_owned(), without_roles(with_roles)] {
            let spec = declared(&declaration);
            let motions = SOLVERS.map(|solver| motion(&spec, solver));
            for motion in &motions {
                let moves = motion.windows(2).filter(|pair| pair[0].angles != pair[1].angles).count();
                assert!(moves > 200, "{rig}: moves in {moves} of {FRAMES} frames");
            }
            let own: Vec<&str> = spec.joints.iter().map(|joint| &joint.name[..]).collect();
            // Also name each joint like the next one.
            let swapped: Vec<&str> = own.iter().cycle().skip(1).take(own.len()).copied().collect();
            let others = OTHER_NAMES.iter().map(|names| &names[..own.len()]);
            let others = others.step_by(if crate::in_full() { 1 } else { 2 });
            for names in others.chain([&swapped[..]]) {
                let other = declared(&renamed(&declaration, names));
                assert!(other.joints.iter().map(|joint| &joint.name).eq(names), "{rig}: {names:?}");
                let is_alike = |a: &JointSpec, b: &JointSpec| a.bones.iter().any(|bone| b.bones.contains(bone));
                assert!(!other.joints.iter().zip(&spec.joints).any(|(a, b)| is_alike(a, b)), "{rig}: {names:?}");
                for (solver, expected) in SOLVERS.into_iter().zip(&motions) {
                    let found = motion(&other, solver);
                    let differs = found.iter().zip(expected).position(|(found, expected)| found != expected);
                    assert_eq!(differs, None, "{rig} called {names:?} moves differently with {solver:?}");
                }
            }
        }
    }
}

#[test]
fn a_role_decides_what_a_name_does_not() {
    let declaration = RIGS.iter().find(|(rig, _)| *rig == "vrm").expect("a rig with eyes").1;
    let [with, without] = [declared(declaration), declared(&without_roles(declaration))];
    assert_eq!(without.joints.iter().map(|joint| joint.role).collect::<Vec<_>>(), [Role::None; 3]);
    assert_ne!(motion(&with, None), motion(&without, None));
}
