//! A written declaration is read back as the same rig, in both notations.

use aim_character::{Measurement, Proposal, declaration, mannequin, propose};
use aim_codegen::declare::{from_derive_input, from_toml};
use aim_codegen::{
    AngleRange, Budget, Budgets, EffectorSpec, Frame, JointSpec, LimitsFrom, NaturalSpec, RigSpec, Role,
};
use aim_gltf::Document;
use aim_runtime::glam::{DQuat, DVec3, EulerRot, Quat, Vec3};

use crate::RIGS;

fn without_reasons(spec: RigSpec) -> Proposal {
    Proposal { spec, reasons: Vec::new() }
}

/// Writes and reads both notations. They must agree on everything but the last decimals of directions.
fn assert_comes_back(proposal: &Proposal) -> String {
    let toml = declaration::toml(proposal, "A test.\nOf two lines.");
    let spec = from_toml("it", &toml).unwrap_or_else(|errors| panic!("{}", errors.render()));
    assert_same(&spec, &proposal.spec, &toml);
    let rust = declaration::rust(proposal, "A test.\nOf two lines.");
    let (import, item) = rust.split_once("\n\n").expect("an import and a struct");
    assert_eq!(import, "use aim::{AimRig, Joint};");
    let item = syn::parse_str(item).unwrap_or_else(|error| panic!("{error}: {rust}"));
    let declared = from_derive_input(&item).unwrap_or_else(|errors| panic!("{}\n{rust}", errors.render()));
    assert_same(&declared.spec, &proposal.spec, &rust);
    toml
}

fn assert_same(found: &RigSpec, wanted: &RigSpec, text: &str) {
    let mut found = found.clone();
    let snap = |found: &mut Frame, wanted: &Frame| {
        let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 2e-9);
        let pairs = [(found.up, wanted.up), (found.forward, wanted.forward), (found.left, wanted.left)];
        assert!(pairs.into_iter().all(|(a, b)| near(a, b)), "{found:?} instead of {wanted:?}\n{text}");
        *found = *wanted;
    };
    snap(&mut found.effector.frame, &wanted.effector.frame);
    for (found, wanted) in found.joints.iter_mut().zip(&wanted.joints) {
        snap(&mut found.frame, &wanted.frame);
    }
    assert_eq!(&found, wanted, "{text}");
}

#[test]
fn bundled_rigs_round_trip() {
    let shared = std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../rigs")).expect("rigs");
    assert_eq!(shared.count(), RIGS.len(), "each bundled rig is written and read");
    for (name, text) in RIGS {
        let spec = from_toml(name, text).unwrap_or_else(|errors| panic!("{}", errors.render()));
        let written = assert_comes_back(&without_reasons(spec));
        assert!(!written.contains("rad\"") && !written.contains("mirrored"), "{written}");
    }
}

#[test]
fn proposals_round_trip_with_their_reasons() {
    let turn = Quat::from_euler(EulerRot::XYZ, 0.3, -0.4, 0.2);
    for frame in Frame::cardinal() {
        #[expect(clippy::cast_possible_truncation, reason = "whole numbers")]
        let axes = [frame.up, frame.forward, frame.left].map(|axis| axis.map(|c| c as f32));
        // The upper bone of the spine lies between all axes.
        let between = axes.map(|axis| (turn * Vec3::from_array(axis)).to_array());
        let model = mannequin(|bone| if bone == "spine3" { between } else { axes }).expect("frames");
        let document = Document::from_bytes(&model).expect("a model");
        let proposal = propose(&document, &Measurement::of(&document), None).expect("a rig");
        let toml = assert_comes_back(&proposal);
        assert!(toml.contains("\n# eyes can turn by about 50 degrees"), "{toml}");
        assert!(toml.contains("heading = [\"-35deg\", \"35deg\"]"), "{toml}");
    }
}

/// A random rig with everything that can be declared, including free angles.
fn any_rig(random: &mut fastrand::Rng) -> RigSpec {
    let frames: Vec<Frame> = Frame::cardinal().collect();
    let turn = DQuat::from_euler(EulerRot::XYZ, random.f64(), random.f64(), random.f64());
    let frame = |random: &mut fastrand::Rng| {
        let Frame { up, forward, left } = frames[random.usize(..frames.len())];
        let turned = |axis: [f64; 3]| (turn * DVec3::from_array(axis)).to_array();
        if random.bool() {
            Frame { up, forward, left }
        } else {
            Frame { up: turned(up), forward: turned(forward), left: turned(left) }
        }
    };
    let between = |random: &mut fastrand::Rng| {
        let ends = [-random.f64() * 180.0, random.f64() * 180.0];
        let [lo, hi] = if random.bool() { ends.map(f64::round) } else { ends };
        AngleRange::Between(lo.to_radians(), (hi + 0.5).min(180.0).to_radians())
    };
    let joints: Vec<JointSpec> = (0..random.usize(1..5))
        .map(|at| {
            let heading = random.bool().then(|| if random.bool() { between(random) } else { AngleRange::Free });
            let pitch = (heading.is_none() || random.bool()).then(|| between(random));
            let has_ends = matches!((heading, pitch), (Some(AngleRange::Between(..)), Some(_)));
            JointSpec {
                name: format!("joint_{at}"),
                bones: (0..random.usize(1..4)).map(|name| format!("bone \"{at}\\{name}\"\t°")).collect(),
                frame: frame(random),
                pitch,
                heading,
                role: Role::ALL[random.usize(..5)],
                limits_from: if random.bool() { LimitsFrom::BindPose } else { LimitsFrom::Animation },
                rate: random.f64() * 9.0 + 1e-3,
                acceleration: random.bool().then(|| random.f64() * 40.0 + 1e-3),
                stiffness: random.f64() * 4.0 + 1e-3,
                upright: random.bool().then(|| random.f64()),
                pitch_taper: (has_ends && random.bool()).then(|| random.f64()),
                other_eye: (at == 0 && random.bool()).then(|| "the other".into()),
                hold: random.bool().then(|| (0..random.usize(..3)).map(|arm| format!("arm \"{at}\" {arm}")).collect()),
            }
        })
        .collect();
    let first = joints[0].frame;
    // The effector pitched up by a quarter turn: its up is the joint's, orthogonalised.
    let nodded = Frame { up: first.forward.map(|c| -c), forward: first.up, left: first.left };
    let effector = EffectorSpec {
        frame: if random.bool() { nodded } else { first },
        origin: if random.bool() { [random.f64(), -random.f64() * 1e-9, 1e9] } else { [0.0; 3] },
    };
    let natural = random.bool().then(|| NaturalSpec {
        eyes_only: random.f64(),
        head_share: random.f64(),
        engage: 1.0 + random.f64(),
        release: random.f64(),
        delay: random.f64(),
    });
    let region = random.bool().then(|| {
        let mut budget = || Budget {
            heading: [-random.f64() - 0.1, random.f64() + 0.1],
            pitch: [-random.f64() - 0.1, random.f64() + 0.1],
            rate: random.f64() * 9.0 + 1e-3,
            acceleration: random.f64() * 40.0 + 1e-3,
        };
        Budgets { head: budget(), chest: budget() }
    });
    RigSpec { name: "Anything".into(), joints, effector, natural, region, kernels: Vec::new() }
}

#[test]
fn random_declarations_round_trip() {
    let mut random = fastrand::Rng::with_seed(7);
    for _ in 0..300 {
        assert_comes_back(&without_reasons(any_rig(&mut random)));
    }
}
