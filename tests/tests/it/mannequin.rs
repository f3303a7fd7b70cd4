//! The mannequin with bones in every convention, and in a different one per bone: the result in the world is the same.

use aim_character::{ChainNodes, InterpretedRig, Measurement, Plan, Settle, bake, mannequin};
use aim_codegen::{Frame, RigSpec};
use aim_gltf::Document;
use aim_runtime::glam::{DAffine3, DVec3};
use aim_runtime::{DynAim, Settings};
use aim_tests::random::Random;

const RIG: &str = include_str!("../../../rigs/mannequin.toml");

/// One frame in world space: each joint's position and its up, forward and left axes.
struct Seen {
    reached: bool,
    joints: Vec<[DVec3; 4]>,
}

/// Bakes the walk aimed at an orbiting target, with these axes for the bones of the rig and the model.
fn aimed(frame_of: impl Fn(&str) -> Frame) -> Vec<Seen> {
    #[expect(clippy::cast_possible_truncation, reason = "axes are ones and zeros")]
    let model = mannequin(|bone| {
        let frame = frame_of(bone);
        [frame.up, frame.forward, frame.left].map(|axis| axis.map(|c| c as f32))
    });
    let document = Document::from_bytes(&model.expect("the axes are a frame")).expect("the mannequin is a right file");
    let mut spec: RigSpec = aim_codegen::declare::from_toml("mannequin.toml", RIG).expect("the rig is right");
    for joint in &mut spec.joints {
        joint.frame = frame_of(&joint.bones[0]);
    }
    spec.effector.frame = spec.joints[0].frame;

    let bones = spec.joints.iter().map(|joint| joint.bones.as_slice());
    let chain = ChainNodes::find(document.skeleton(), bones, Some("right_eye")).expect("the bones are there");
    let plan = Plan {
        document: &document,
        clip: document.clips().first(),
        measurement: &Measurement::of(&document),
        chain: &chain,
        both_eyes: false,
        seconds: 4.0,
        fps: 30.0,
        settle: Settle::Animation,
        looped: false,
        // With a tiny tolerance every frame iterates to the end: early stopping would depend on rounding.
        settings: Settings::default().with_tolerance(2e-6),
        target_node: None,
    };
    let target = |t: f32, _: &[DAffine3]| {
        let turn = f64::from(t) * 1.6 - 1.0;
        DVec3::new(1.5 * turn.sin(), 1.7 + 0.3 * (2.0 * turn).cos(), 1.5 * turn.cos())
    };
    let baked =
        bake(&mut DynAim::new(InterpretedRig::new(&spec)), &plan, target, |_, _| ()).expect("the plan is right");
    let nodes: Vec<(usize, Frame)> = chain
        .joints
        .iter()
        .copied()
        .zip(spec.joints.iter().map(|joint| joint.frame))
        .chain(chain.other_eye.map(|pair| (pair, frame_of("right_eye"))))
        .collect();
    let place = |world: &[DAffine3], (node, frame): &(usize, Frame)| {
        let world = world[*node];
        let direction = |axis: [f64; 3]| world.transform_vector3(DVec3::from_array(axis));
        [world.translation, direction(frame.up), direction(frame.forward), direction(frame.left)]
    };
    let seen = |frame: &aim_character::AimedFrame| Seen {
        reached: frame.error_deg < 0.1,
        joints: nodes.iter().map(|node| place(&frame.world, node)).collect(),
    };
    baked.frames.iter().map(seen).collect()
}

/// Compares two results: positions in metres, and directions by their differences.
///
/// For a target out of reach the aim is flat at its maximum, so that f32 determines the best angle only to the square
/// root of its precision.
fn assert_same(expected: &[Seen], found: &[Seen], what: &str) {
    assert_eq!(expected.len(), found.len());
    for (number, (a, b)) in expected.iter().zip(found).enumerate() {
        let pairs = a.joints.iter().flatten().zip(b.joints.iter().flatten());
        let distance = pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        let tolerance = if a.reached && b.reached { 1e-4 } else { 1e-3 };
        assert!(distance < tolerance, "{what}, frame {number}: {distance}");
    }
    let reached = expected.iter().filter(|frame| frame.reached).count();
    assert!(reached > 40 && reached < expected.len(), "{reached} frames are reached: both kinds should be");
}

fn paper() -> Frame {
    Frame { up: [1.0, 0.0, 0.0], forward: [0.0, 1.0, 0.0], left: [0.0, 0.0, 1.0] }
}

#[test]
fn every_convention_gives_one_result_in_the_world() {
    let expected = aimed(|_| paper());
    for frame in Frame::cardinal() {
        let found = aimed(|_| frame);
        assert_same(&expected, &found, &format!("{frame:?}"));
    }
}

#[test]
fn conventions_mixed_bone_by_bone_give_one_result_in_the_world() {
    let expected = aimed(|_| paper());
    let frames: Vec<Frame> = Frame::cardinal().collect();
    for seed in 0..24 {
        let found = aimed(|bone| {
            let bone: u64 = bone.bytes().fold(seed, |hash, byte| hash.wrapping_mul(31).wrapping_add(byte.into()));
            frames[Random::new(bone).below(48)]
        });
        assert_same(&expected, &found, &format!("mix {seed}"));
    }
}
