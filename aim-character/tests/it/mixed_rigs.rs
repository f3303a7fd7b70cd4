//! The mannequin with different axes in every bone: measured exactly, and aimed with the measured axes to the same
//! result in the world.

use std::thread;

use aim_character::{ChainNodes, InterpretedRig, Measurement, Plan, Settle, bake, mannequin};
use aim_codegen::{Frame, RigSpec, declare};
use aim_gltf::Document;
use aim_runtime::glam::DVec3;
use aim_runtime::{DynAim, Settings};

const RIG: &str = include_str!("../../../rigs/mannequin.toml");

/// Number of mixes: about a second's work, or a minute's in full (`.ci/run`); the most in optimised builds
/// (`.ci/thorough`).
fn mixes() -> u64 {
    match (cfg!(debug_assertions), crate::in_full()) {
        (false, _) => 10_000,
        (true, true) => 2_000,
        (true, false) => 60,
    }
}

/// Position, up, forward and left of each joint in world space.
type Seen = [[DVec3; 4]; 3];

/// Measures and aims one mannequin with random axes in every bone.
fn mixed(seed: u64, frames: &[Frame]) -> Seen {
    let frame_of = |bone: &str| {
        let bone = bone.bytes().fold(seed, |hash, byte| hash.wrapping_mul(31).wrapping_add(byte.into()));
        frames[fastrand::Rng::with_seed(bone).usize(..frames.len())]
    };
    #[expect(clippy::cast_possible_truncation, reason = "axes are ones and zeros")]
    let model = mannequin(|bone| {
        let frame = frame_of(bone);
        [frame.up, frame.forward, frame.left].map(|axis| axis.map(|c| c as f32))
    });
    let document = Document::from_bytes(&model.expect("the axes are a frame")).expect("the mannequin is a right file");
    let measurement = Measurement::of(&document);
    assert_eq!((measurement.up, measurement.forward, measurement.left), (DVec3::Y, DVec3::Z, DVec3::X), "mix {seed}");
    for bone in &measurement.bones {
        let frame = frame_of(&bone.name);
        let found = [bone.up, bone.forward, bone.left].map(|axis| axis.vector().to_array());
        assert_eq!(found, [frame.up, frame.forward, frame.left], "mix {seed}: {}", bone.name);
        assert!(bone.deviation_deg < 1e-3, "mix {seed}: {} is {}° off", bone.name, bone.deviation_deg);
    }
    aimed(&document, &measurement)
}

/// Snaps the bind pose to a target with eye, neck and spine, using the measured axes.
fn aimed(document: &Document, measurement: &Measurement) -> Seen {
    let mut spec: RigSpec = declare::from_toml("mannequin.toml", RIG).expect("the rig is right");
    let bones = spec.joints.iter().map(|joint| document.skeleton().find(&joint.bones[0]).expect("the bone is there"));
    let nodes: Vec<usize> = bones.collect();
    for (joint, node) in spec.joints.iter_mut().zip(&nodes) {
        let frame = measurement.bone(*node).expect("it is a bone").frame;
        let [up, forward, left] = [frame.up, frame.forward, frame.left].map(|axis| axis.to_array());
        joint.frame = Frame { up, forward, left };
    }
    spec.effector.frame = spec.joints[0].frame;
    let chain = ChainNodes { joints: nodes.clone(), other_eye: None, holds: None };
    let plan = Plan {
        document,
        clip: None,
        measurement,
        chain: &chain,
        both_eyes: false,
        seconds: 0.05,
        fps: 30.0,
        settle: Settle::Snap,
        looped: false,
        settings: Settings::default().with_tolerance(2e-6),
        target_node: None,
    };
    let target = DVec3::new(1.1, 1.9, 1.6);
    let baked =
        bake(&mut DynAim::new(InterpretedRig::new(&spec)), &plan, |_, _| target, |_, _| ()).expect("the plan is right");
    assert!(baked.frames[0].error_deg < 0.01, "{}° off the target", baked.frames[0].error_deg);
    let world = &baked.frames[0].world;
    std::array::from_fn(|joint| {
        let (world, frame) = (world[nodes[joint]], spec.joints[joint].frame);
        let direction = |axis: [f64; 3]| world.transform_vector3(DVec3::from_array(axis));
        [world.translation, direction(frame.up), direction(frame.forward), direction(frame.left)]
    })
}

#[test]
fn bones_of_mixed_axes_are_measured_exactly_and_aimed_alike() {
    let frames: Vec<Frame> = Frame::cardinal().collect();
    let expected = mixed(0, &frames);
    let mixes = mixes();
    let threads = thread::available_parallelism().map_or(1, |n| n.get() as u64);
    thread::scope(|scope| {
        for first in 0..threads {
            let frames = &frames;
            scope.spawn(move || {
                for seed in (1 + first..=mixes).step_by(usize::try_from(threads).expect("few threads")) {
                    let found = mixed(seed, frames);
                    let pairs = expected.iter().flatten().zip(found.iter().flatten());
                    let distance = pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
                    assert!(distance < 1e-4, "mix {seed}: {distance}");
                }
            });
        }
    });
}
