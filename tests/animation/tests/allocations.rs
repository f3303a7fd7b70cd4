//! Checks that per-frame code does not allocate: sampling, playing, blending, root motion, gather, aim and apply. This
//! file has only one test, so that no other thread allocates meanwhile.

use std::alloc::System;
use std::hint::black_box;

use aim::animation::{
    AimChain, AimLayer, AimLine, AimPoseSet, AimPosesLayer, BlendLine, BlendPlane, Blender, BoneBoxes, Clip,
    ClipControl, Control, Corrections, Figure, Gizmos, Ground, Inertia, Influence, Instance, LimbLayer, Looping, Marks,
    Mask, Mesh, MeshPose, Method, Model, Morph, Motion, Node, Parameter, Phase, Plant, Ray, Reach, ReachGoal, Recoil,
    Reduction, Root, RootPath, Skeleton, Skin, Stance, TipTarget, Track, Transform, Transition, Tree,
};
use aim::glam::{Affine3A, Quat, Vec2, Vec3};
use aim::{Aim, AimRig, DynAim, Rig, Settings};
use aim_animation_tests::{Hero, gait, skeleton};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};

#[global_allocator]
static COUNTED: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// Fails if something allocates, grows or frees memory.
fn allocates_nothing<T>(what: &str, mut run: impl FnMut() -> T) {
    let region = Region::new(COUNTED);
    for _ in 0..3 {
        black_box(run());
    }
    let change = region.change();
    let count = change.allocations + change.reallocations + change.deallocations;
    assert_eq!(count, 0, "{what}: {change:?}");
}

fn tree(skeleton: &Skeleton) -> Tree {
    let line = BlendLine::new([0.0, 1.0]).unwrap();
    let gaits = Node::line(line, Parameter::Input(0), [Node::source(0), Node::source(1)]);
    let plane = BlendPlane::new([Vec2::ZERO, Vec2::X, Vec2::Y]).unwrap();
    let ways = [Parameter::Input(0), Parameter::Input(1)];
    let ways = Node::plane(plane, ways, [Node::source(0), Node::source(1), Node::source(0)]);
    let root = Node::sum([(gaits, 0.5), (ways, 0.5)])
        .blend(Node::source(1), 0.5)
        .with_mask(Mask::subtree(skeleton, 7))
        .add(Node::source(0), 0.2);
    Tree::new(skeleton, root).unwrap()
}

#[test]
fn frames_allocate_nothing() {
    let skeleton = skeleton(Transform::IDENTITY);
    let clips = [gait(&skeleton, "walk", 1.0, 1.4), gait(&skeleton, "run", 0.7, 4.0)]
        .map(|clip| clip.with_event(0.1, "step").unwrap());
    let mut cursors = clips.each_ref().map(Clip::cursor);
    let mut poses = [(); 4].map(|()| skeleton.rest().to_vec());
    let mut model = vec![Affine3A::IDENTITY; skeleton.len()];

    // The counter does notice an allocation.
    let region = Region::new(COUNTED);
    black_box(skeleton.rest().to_vec());
    assert_eq!(region.change().allocations, 1, "the allocator is counted");

    let mut control = Control::new().with_looping(Looping::PingPong).with_speed(-3.0);
    allocates_nothing("playing", || {
        let step = control.advance(0.9, 1.0);
        let told = clips[0].events_passed(&step).count();
        clips[0].sample(step.to_s(), &mut cursors[0], &mut poses[0]);
        clips[1].sample(0.3, &mut cursors[1], &mut poses[1]);
        told
    });

    let packed = Reduction::new(1e-3).pack(&clips[0], &skeleton).unwrap().clip;
    let mut cursor = packed.cursor();
    allocates_nothing("playing a packed clip", || {
        packed.sample(0.3, &mut cursor, &mut poses[0]);
        packed.sample_scalars(0.3, &mut cursor, &mut []);
    });

    let marks = [Marks::new(1.0, [0.0, 0.5]).unwrap(), Marks::new(0.7, [0.0, 0.3]).unwrap()];
    let mut phase = Phase::new();
    let advanced = |phase: &mut Phase| {
        phase.advance(0.1, &[(&marks[0], 0.3), (&marks[1], 0.7)]);
        marks.each_ref().map(|marks| phase.step(marks))
    };
    allocates_nothing("playing in step", || advanced(&mut phase));

    let mask = Mask::subtree(&skeleton, 3);
    for method in [Method::Nlerp, Method::Slerp, Method::Log] {
        let blender = Blender::new(&skeleton).with_method(method).with_mask(&mask);
        let [a, b, c, d] = &mut poses;
        allocates_nothing("blending", || {
            blender.blend(c, b, 0.3).unwrap();
            blender.difference(a, b, d).unwrap();
            blender.add(c, d, 0.5).unwrap();
            blender.sum(&[(a, 0.1), (b, 0.7)], c).unwrap();
        });
    }

    let tree = tree(&skeleton);
    let (mut scratch, mut shares) = (tree.scratch(), [0.0; 2]);
    allocates_nothing("a tree of blends", || {
        tree.shares(0, &[0.4, 0.2], &mut scratch, &mut shares).unwrap();
        tree.evaluate(&[0.4, 0.2], &mut scratch, &mut poses[2], |source, pose| {
            clips[source].sample(0.3, &mut cursors[source], pose);
        })
        .unwrap();
    });

    let mut inertia = Inertia::new(&skeleton);
    allocates_nothing("a transition", || {
        let [a, b, c, d] = &mut poses;
        inertia.begin(&Transition { shown: [a, b], next: [b, a], dt_s: 0.1, length_s: 0.5 }).unwrap();
        inertia.advance(0.1);
        inertia.apply(c).unwrap();
        d.copy_from_slice(c);
    });

    for root in [Root::Bone(1), Root::Shadow { bone: 1, up: Vec3::Y }] {
        let path = RootPath::new(&clips[0], &skeleton, root, 30.0).unwrap();
        for motion in [Motion::linear(&path), Motion::composite(&path), Motion::variable(&path)] {
            allocates_nothing("root motion", || {
                let steps = advanced(&mut phase);
                motion.remove(0.3, &skeleton, &mut poses[2]).unwrap();
                Motion::blend(steps.map(|step| (motion.delta(&step), 0.5)))
            });
        }
    }

    let root = Root::Shadow { bone: 1, up: Vec3::Y };
    let motion = Motion::variable(&RootPath::new(&clips[0], &skeleton, root, 30.0).unwrap());
    let kind = Model::new(skeleton.clone(), clips.clone()).with_motion(0, motion).with_mask(mask.clone());
    let mut instance = Instance::new(&kind);
    instance.play(ClipControl::new(0).with_weight(0.5));
    instance.play(ClipControl::new(1).with_mask(0));
    instance.attach(3, Affine3A::IDENTITY);
    allocates_nothing("an instance", || {
        instance.advance(&kind, 0.3);
        instance.pose(&kind, &mut poses[2]).unwrap();
        (instance.events(&kind).count(), instance.things(&model).count())
    });

    // A limb in closed form, and one solved by descent.
    for limb in [&[2, 3, 4][..], &[1, 2, 3, 4]] {
        let reach = Reach::new(&clips[0], &skeleton, limb, 60.0).unwrap();
        let (mut state, goal) = (reach.state(), Vec3::new(0.2, 1.4, 0.1));
        allocates_nothing("a limb that is led", || {
            reach.aim(&mut state, &[ReachGoal::new(0.3, goal), ReachGoal::new(0.6, goal)], 0.2).unwrap();
            state.advance(0.1);
            reach.apply(&mut state, 0.4, &mut poses[2], &mut model).unwrap()
        });
    }

    let skin = Skin::new(&skeleton, (0..skeleton.len()).collect::<Vec<_>>()).unwrap();
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
    let mesh = Mesh::new(corners, [[0, 1, 2]], &[[Influence::new(1, 0.5), Influence::new(2, 0.5)]; 3]).unwrap();
    let mesh = mesh.with_normals([Vec3::Z; 3]).unwrap();
    let mesh = mesh.with_morphs([Morph { target: 0, vertex: 1, position: Vec3::X, normal: Vec3::X }]).unwrap();
    let boxes = BoneBoxes::new(&mesh, &skin).unwrap();
    let (mut matrices, mut placed, mut normals) = (model.clone(), corners, corners);
    allocates_nothing("a mesh that is deformed and hit", || {
        skin.matrices(&model, &mut matrices).unwrap();
        let pose = MeshPose::new(&matrices).with_morph_weights(&[0.5]);
        mesh.deform(&pose, &mut placed).unwrap();
        mesh.deform_normals(&pose, 1, &mut normals).unwrap();
        let middle = (placed[0] + placed[1] + placed[2]) / 3.0;
        let ray = Ray::new(middle + normals[0], -normals[0]);
        (boxes.hit(&mesh, &pose, &ray).unwrap().unwrap(), boxes.whole(&pose).unwrap(), boxes.oriented(1, &pose))
    });

    let right = skeleton.find("right_eye").unwrap();
    let chain = AimChain::named(&skeleton, Hero::RIG).unwrap().with_other_eye(right).unwrap().with_up(Vec3::Y);
    let (mut frame, mut dynamic, mut derived) = (chain.frame(), DynAim::new(Hero::RIG), Aim::<Hero>::new());
    allocates_nothing("gather, aim and apply", || {
        let local = &mut poses[2];
        local.copy_from_slice(skeleton.rest());
        skeleton.to_model(local, &mut model).unwrap();
        chain.gather(&mut frame, local, &mut model).unwrap();
        dynamic.aim(&frame.pose(), Vec3::new(1.0, 2.0, 3.0), 0.02, &Settings::default());
        let aimed = derived.aim(&frame.pose_of().unwrap(), Vec3::new(1.0, 2.0, 3.0), 0.02, &Settings::default());
        let corrections = Corrections::from(&dynamic);
        chain.apply(&frame, corrections, local, &mut model).unwrap();
        let description = Hero::RIG.description();
        let gizmos = Gizmos { chain: &chain, frame: &frame, description: &description, corrections, model: &model };
        (aimed.outcome, gizmos.gazes(1.0).count() + gizmos.axes(0.1).count() + gizmos.ranges(0.3).count())
    });

    // All layers, on arbitrary bones.
    let turns = [[0.5, 0.4], [-0.5, 0.4], [0.0, -0.5]];
    let turns = turns.map(|[left, down]| Quat::from_rotation_y(left) * Quat::from_rotation_x(down));
    let aims = Clip::new("aim").with_rotation(2, Track::linear([0.0, 1.0, 2.0], turns).unwrap());
    let line = AimLine { bone: 4, origin: Vec3::ZERO, forward: Vec3::Y };
    let set = AimPoseSet::from_clip(&aims, &skeleton, &[0.0, 1.0, 2.0], line).unwrap();
    let foot = Plant::new(&skeleton, [2, 3, 4], Vec3::ZERO).unwrap().with_events("step", "other");
    let (mut stance, mut poses) = (Stance::new(&skeleton, 1, [foot]).unwrap(), AimPosesLayer::new(set));
    let mut limbs = [&[3, 7, 8][..], &[2, 3, 7, 8]].map(|limb| LimbLayer::new(&skeleton, limb).unwrap());
    let (mut recoil, mut gaze) =
        (Recoil::new(&skeleton, [3, 7, 8], Affine3A::IDENTITY).unwrap(), AimLayer::new(chain, Hero::RIG));
    let mut figure = Figure::new(skeleton.clone());
    poses.target = Vec3::new(0.1, 1.5, 3.0);
    stance.feet_mut()[0].plant();
    allocates_nothing("layers", || {
        instance.advance(&kind, 0.1);
        instance.events(&kind).for_each(|(_, event)| stance.on_event(&event.name));
        limbs.iter_mut().for_each(|limb| limb.set_target(TipTarget::bone(4, Vec3::Y)));
        recoil.kick(Vec3::Y, Vec3::X);
        let (walk, feet) = (&mut instance.layer(&kind), &mut stance.on(|at| Ground::new(at, Vec3::Y)));
        let [arm, long] = &mut limbs;
        figure.run(0.1, &mut [walk, feet, &mut poses, &mut gaze, &mut recoil, arm, long]).unwrap();
    });
    assert!(figure.local() != skeleton.rest() && recoil.offset() != Transform::IDENTITY, "they have done something");
}
