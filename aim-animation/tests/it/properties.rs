//! No input, whatever its bits, causes a panic; rotations are unit and numbers finite wherever that is promised.

use aim_animation::glam::{Affine3A, Quat, Vec2, Vec3};
use aim_animation::{
    AimLine, AimPoseSet, AimPosesLayer, BezierKey, BlendLine, BlendPlane, Blender, Bone, BoneBoxes, Clip, Continuity,
    Control, Figure, Ground, HermiteKey, Inertia, Influence, Layer, LimbLayer, Looping, Marks, Mask, Mesh, MeshPose,
    Method, Morph, Motion, Node, PackedClip, Parameter, Phase, Plant, Ray, Reach, ReachGoal, Recoil, Reduction, Root,
    RootPath, Skeleton, SkewedTransform, Skin, Stance, TipTarget, Track, Transform, Transition, Tree,
};
use proptest::prelude::*;

use crate::common::Rng;
use crate::reducing::{any_clip, any_skeleton, error};

// Boxed: the types that proptest builds from these overflow a thread's stack and are slow to compile.
fn any_float() -> BoxedStrategy<f32> {
    prop_oneof![any::<u32>().prop_map(f32::from_bits), -2.0_f32..2.0, Just(0.0), Just(f32::NAN), Just(f32::INFINITY)]
        .boxed()
}

fn any_transform() -> BoxedStrategy<Transform> {
    let transform = |n: [f32; 10]| Transform {
        translation: Vec3::from_slice(&n),
        rotation: Quat::from_slice(&n[3..]),
        scale: Vec3::from_slice(&n[7..]),
    };
    prop::array::uniform10(any_float()).prop_map(transform).boxed()
}

fn is_unit(rotation: Quat) -> bool {
    (rotation.length() - 1.0).abs() < 1e-5
}

proptest! {
    #[test]
    fn affine_maps(n in prop::array::uniform12(any_float())) {
        let affine = Affine3A::from_cols_array(&n);
        if let Some(parts) = Transform::from_affine(&affine) {
            prop_assert!(parts.is_sound() && is_unit(parts.rotation), "{parts:?}");
        }
        if let Some(parts) = SkewedTransform::from_affine(&affine) {
            prop_assert!(parts.transform.is_sound(), "{parts:?}");
        }
    }

    #[test]
    fn skeletons(parents in prop::collection::vec(prop::option::of(0_usize..12), 0..12), rest in any_transform()) {
        let bones = parents.iter().map(|&parent| Bone::new("b", parent).with_rest(rest));
        if let Ok(skeleton) = Skeleton::new(bones) {
            let local = skeleton.rest().to_vec();
            let mut model = vec![Affine3A::IDENTITY; local.len()];
            skeleton.to_model(&local, &mut model).unwrap();
            let mut back = local.clone();
            if skeleton.to_local(&model, &mut back).is_ok() {
                prop_assert!(back.iter().all(Transform::is_sound), "{back:?}");
            }
        }
    }

    #[test]
    fn blends(poses in prop::array::uniform3(any_transform()), weight in any_float(), which in 0_usize..3) {
        let skeleton = Skeleton::new([Bone::new("b", None)]).unwrap();
        let method = [Method::Nlerp, Method::Slerp, Method::Log][which];
        let blender = Blender::new(&skeleton).with_method(method);
        let [a, b, c] = poses.map(|bone| [bone]);
        let mut out = a;
        blender.sum(&[(&a, weight), (&b, 1.0), (&c, 0.5)], &mut out).unwrap();
        prop_assert!(is_unit(out[0].rotation), "{out:?}");
        blender.blend(&mut out, &b, weight).unwrap();
        prop_assert!(is_unit(out[0].rotation), "{out:?}");
        blender.add(&mut out, &c, weight).unwrap();
        prop_assert!(is_unit(out[0].rotation), "{out:?}");
        out[0].turn(b[0].rotation);
        prop_assert!(is_unit(out[0].rotation), "{out:?}");
    }

    #[test]
    fn turns(transforms in prop::array::uniform2(any_transform()), rotation in any_transform()) {
        let skeleton = Skeleton::new([Bone::new("a", None), Bone::new("b", Some(0))]).unwrap();
        let mut local = transforms;
        let mut model = [Affine3A::IDENTITY; 2];
        skeleton.to_model(&local, &mut model).unwrap();
        skeleton.turn_in_model(1, rotation.rotation, &model, &mut local).unwrap();
        let turned = local[1].rotation;
        prop_assert!(turned.to_array().map(f32::to_bits) == transforms[1].rotation.to_array().map(f32::to_bits)
            || is_unit(turned), "{turned}");
    }
}

proptest! {
    #[test]
    fn tracks(
        times in prop::collection::vec(prop_oneof![0.0_f32..4.0, any_float()], 1..6),
        numbers in prop::collection::vec(any_float(), 60),
        at in any_float(),
        key in any::<usize>(),
        is_sorted in any::<bool>(),
    ) {
        let mut times = times;
        if is_sorted {
            times.sort_by(f32::total_cmp);
        }
        let count = times.len();
        let scalars = numbers[..count].to_vec();
        let keys: Vec<HermiteKey<Quat>> = numbers.chunks(12).take(count)
            .map(|n| HermiteKey { into: Quat::from_slice(n), value: Quat::from_slice(&n[4..]), out: Quat::from_slice(&n[8..]) })
            .collect();
        let points: Vec<BezierKey<f32>> = numbers.chunks(3).take(count)
            .map(|n| BezierKey { before: n[0], value: n[1], after: n[2] })
            .collect();
        let made = [
            Track::step(times.clone(), scalars.clone()),
            Track::linear(times.clone(), scalars.clone()),
            Track::catmull_rom(times.clone(), scalars),
            Track::bezier(times.clone(), &points),
        ];
        for track in made.into_iter().flatten() {
            for track in [track.cut(0.5, at), track.cut(at, 2.0), track.reversed(at), track] {
                prop_assert!(track.sample_near(at, &mut key.clone()).is_finite(), "{track:?} at {at}");
                prop_assert!(track.sample(1.0).is_finite() && track.sample(track.end_s()).is_finite(), "{track:?}");
                prop_assert!(track.times().windows(2).all(|pair| pair[0] <= pair[1]), "{track:?}");
            }
        }
        let rotations: Vec<Quat> = keys.iter().map(|key| key.value).collect();
        let made = [Track::hermite(times.clone(), &keys), Track::linear(times.clone(), rotations.clone()),
            Track::catmull_rom(times, rotations)];
        for track in made.into_iter().flatten() {
            for track in [track.cut(0.5, at), track.reversed(at), track.resampled(3.0, 2.0), track] {
                prop_assert!(is_unit(track.sample(at)) && is_unit(track.sample(1.3)), "{track:?} at {at}");
            }
        }
    }

    #[test]
    fn controls(steps in prop::collection::vec((any_float(), any_float(), any_float()), 1..20), looping in 0_usize..3) {
        let looping = [Looping::Once, Looping::Repeat, Looping::PingPong][looping];
        let clip = Clip::new("").with_event(0.0, "").unwrap().with_event(0.5, "").unwrap();
        let mut control = Control::new().with_looping(looping);
        for (dt, speed, length) in steps {
            control.speed = speed;
            let step = control.advance(dt, length);
            let end = if length.is_finite() { length.max(0.0) } else { 0.0 };
            prop_assert!((0.0..=end).contains(&control.time_s()), "{control:?}");
            prop_assert!(clip.events_passed(&step).take(100).count() <= 100);
            prop_assert!(step.pieces().take(100).all(|p| p.from_s.is_finite() && p.to_s.is_finite()));
            if dt > 100.0 {
                control.seek(dt);
            }
        }
    }

    #[test]
    fn phases(steps in prop::collection::vec((any_float(), any_float(), any_float()), 1..20), times in prop::collection::vec(any_float(), 1..4)) {
        let marks = Marks::new(1.5, times);
        let other = Marks::new(0.7, [0.1]).unwrap();
        if let Ok(marks) = marks {
            let mut phase = Phase::new();
            for (dt, speed, weight) in steps {
                phase.speed = speed;
                phase.advance(dt, &[(&marks, weight), (&other, 1.0)]);
                prop_assert!((0.0..=1.0).contains(&phase.phase()));
                let step = phase.step(&marks);
                prop_assert!((0.0..=1.5).contains(&step.from_s()) && (0.0..=1.5).contains(&step.to_s()), "{step:?}");
                prop_assert!((0.0..1.5).contains(&marks.time_at(speed)) && (0.0..1.0).contains(&marks.phase_at(dt)));
            }
        }
    }
}

/// Trees of every kind of node; weights and positions are inputs 0 to 5.
fn any_tree() -> BoxedStrategy<Node> {
    let leaf = (0_usize..4).prop_map(Node::source);
    leaf.prop_recursive(5, 40, 4, |inner| {
        let weighted = (inner.clone(), 0_usize..6).prop_map(|(node, input)| (node, Parameter::Input(input)));
        let pair = (inner.clone(), weighted.clone(), prop::option::of(any_float()), any::<bool>());
        prop_oneof![
            prop::collection::vec(weighted, 0..4).prop_map(Node::sum),
            (prop::collection::vec(inner.clone(), 3), prop::array::uniform3(any_float()), 0_usize..6).prop_map(
                |(nodes, places, input)| {
                    let line = BlendLine::new(places).unwrap_or_else(|_| BlendLine::new([0.0, 1.0, 2.0]).unwrap());
                    Node::line(line, Parameter::Input(input), nodes)
                }
            ),
            (prop::collection::vec(inner, 4), prop::array::uniform8(any_float()), 0_usize..5).prop_map(
                |(nodes, places, input)| {
                    let points: Vec<Vec2> = places.chunks(2).map(Vec2::from_slice).collect();
                    let square = [Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::ONE];
                    let plane = BlendPlane::new(points).unwrap_or_else(|_| BlendPlane::new(square).unwrap());
                    Node::plane(plane, [input, input + 1].map(Parameter::Input), nodes)
                }
            ),
            pair.prop_map(|(one, (other, weight), mask, is_layer)| {
                let node = if is_layer { one.add(other, weight) } else { one.blend(other, weight) };
                masked(node, mask)
            }),
        ]
    })
    .boxed()
}

fn masked(node: Node, weight: Option<f32>) -> Node {
    let skeleton = Skeleton::new([Bone::new("b", None)]).unwrap();
    match weight {
        Some(weight) => node.with_mask(Mask::new(&skeleton, weight)),
        None => node,
    }
}

proptest! {
    #[test]
    fn trees(
        root in any_tree(),
        inputs in prop::collection::vec(any_float(), 0..7),
        sources in prop::array::uniform4(any_transform()),
        which in 0_usize..3,
    ) {
        let skeleton = Skeleton::new([Bone::new("b", None)]).unwrap();
        let method = [Method::Nlerp, Method::Slerp, Method::Log][which];
        let tree = Tree::new(&skeleton, root).unwrap().with_method(method);
        let (mut scratch, mut pose, mut shares) = (tree.scratch(), [Transform::IDENTITY], [0.0; 4]);
        tree.evaluate(&inputs, &mut scratch, &mut pose, |source, pose| pose[0] = sources[source]).unwrap();
        // If the source poses are valid and of moderate size, so is the result, whatever the inputs.
        let tamed = |numbers: Vec3| Vec3::from_array(numbers.to_array().map(|n| if n.abs() < 1e3 { n } else { 1.0 }));
        let sound = sources.map(|of| Transform {
            translation: tamed(of.translation),
            rotation: if of.rotation.is_finite() && is_unit(of.rotation.normalize()) { of.rotation.normalize() } else { Quat::IDENTITY },
            scale: tamed(of.scale),
        });
        tree.evaluate(&inputs, &mut scratch, &mut pose, |source, pose| pose[0] = sound[source]).unwrap();
        prop_assert!(pose[0].is_sound() && is_unit(pose[0].rotation), "{pose:?} of {sound:?}");
        tree.shares(0, &inputs, &mut scratch, &mut shares).unwrap();
        let sum = shares.iter().sum::<f32>();
        prop_assert!(shares.iter().all(|share| (0.0..=1.0001).contains(share)) && sum <= 1.0001, "{shares:?}");
    }

    #[test]
    fn spaces(numbers in prop::collection::vec(any_float(), 0..16), x in any_float(), y in any_float()) {
        let mut weights = vec![0.0; 16];
        if let Ok(line) = BlendLine::new(numbers.clone()) {
            line.weights(x, &mut weights);
            prop_assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-6, "{line:?} {weights:?}");
        }
        if let Ok(plane) = BlendPlane::new(numbers.chunks_exact(2).map(Vec2::from_slice).collect::<Vec<_>>()) {
            plane.weights(Vec2::new(x, y), &mut weights);
            prop_assert!(weights.iter().all(|weight| (0.0..=1.0).contains(weight)), "{plane:?} {weights:?}");
            prop_assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-6, "{plane:?} {weights:?}");
        }
    }
}

proptest! {
    #[test]
    fn motions(
        times in prop::collection::vec(prop_oneof![0.0_f32..4.0, any_float()], 1..5),
        numbers in prop::collection::vec(any_float(), 40),
        up in prop::option::of(prop::array::uniform3(any_float())),
        rate in prop_oneof![1.0_f32..100.0, Just(f32::NAN)],
        steps in prop::collection::vec((any_float(), any_float()), 1..8),
        pose in any_transform(),
    ) {
        let mut times: Vec<f32> = times.into_iter().map(|time| time.abs()).filter(|time| *time < 1e3).collect();
        times.sort_by(f32::total_cmp);
        let count = times.len();
        let places: Vec<Vec3> = numbers.chunks_exact(3).take(count).map(Vec3::from_slice).collect();
        let rotations: Vec<Quat> = numbers[20..].chunks_exact(4).take(count).map(Quat::from_slice).collect();
        let mut clip = Clip::new("");
        if let Ok(track) = Track::linear(times.clone(), places) {
            clip = clip.with_translation(0, track);
        }
        if let Ok(track) = Track::linear(times, rotations) {
            clip = clip.with_rotation(0, track);
        }
        let skeleton = Skeleton::new([Bone::new("b", None)]).unwrap();
        let root = up.map_or(Root::Bone(0), |up| Root::Shadow { bone: 0, up: Vec3::from_array(up) });
        if let Ok(path) = RootPath::new(&clip, &skeleton, root, rate) {
            for motion in [Motion::linear(&path), Motion::composite(&path), Motion::variable(&path)] {
                let mut control = Control::new();
                for (dt, speed) in &steps {
                    control.speed = *speed;
                    let step = control.advance(*dt, clip.length_s());
                    let (delta, at) = (motion.delta(&step), motion.at(*dt));
                    for found in [delta, at, Motion::blend([(delta, *dt), (at, *speed)])] {
                        prop_assert!(found.is_sound() && is_unit(found.rotation), "{found:?} of {motion:?}");
                    }
                    let mut pose = [pose];
                    motion.remove(*dt, &skeleton, &mut pose).unwrap();
                    prop_assert!(is_unit(pose[0].rotation));
                }
                let screw = motion.screw();
                prop_assert!(screw.axis.is_finite() && screw.speed_s().is_finite(), "{screw:?}");
                prop_assert!(motion.removed_from(&clip, &skeleton, 3.0).length_s() == clip.length_s());
            }
        }
    }
}

proptest! {
    #[test]
    fn transitions(
        poses in prop::array::uniform4(any_transform()),
        pose in any_transform(),
        times in prop::array::uniform3(any_float()),
    ) {
        let skeleton = Skeleton::new([Bone::new("b", None)]).unwrap();
        let [a, b, c, d] = poses.map(|bone| [bone]);
        let mut inertia = Inertia::new(&skeleton);
        inertia.begin(&Transition { shown: [&a, &b], next: [&c, &d], dt_s: times[0], length_s: times[1] }).unwrap();
        inertia.advance(times[2]);
        let mut found = [pose];
        inertia.apply(&mut found).unwrap();
        prop_assert!(inertia.is_done() && found[0].rotation.to_array().map(f32::to_bits) == pose.rotation.to_array().map(f32::to_bits)
            || is_unit(found[0].rotation), "{found:?}");
    }
}

proptest! {
    #[test]
    fn seams(
        times in prop::collection::vec(prop_oneof![0.0_f32..4.0, any_float()], 1..6),
        numbers in prop::collection::vec(any_float(), 36),
        window in any_float(),
        at in any_float(),
    ) {
        let mut times: Vec<f32> = times.into_iter().map(f32::abs).filter(|time| time.is_finite()).collect();
        times.sort_by(f32::total_cmp);
        let count = times.len();
        let values: Vec<Quat> = numbers.chunks(4).take(count).map(Quat::from_slice).collect();
        let keys: Vec<HermiteKey<f32>> = numbers.chunks(3).take(count)
            .map(|n| HermiteKey { into: n[0], value: n[1], out: n[2] })
            .collect();
        let mut clip = Clip::new("");
        for track in [Track::linear(times.clone(), values.clone()), Track::catmull_rom(times.clone(), values)].into_iter().flatten() {
            clip = clip.with_rotation(0, track);
        }
        for (number, track) in [Track::hermite(times.clone(), &keys), Track::linear(times, numbers[..count].to_vec())]
            .into_iter().flatten().enumerate() {
            clip = clip.with_scalar(number, track);
        }
        for continuity in [Continuity::Place, Continuity::Speed] {
            let mended = clip.mended(continuity, window);
            let (mut pose, mut scalars) = ([Transform::IDENTITY], [0.0; 2]);
            for time in [at, 0.0, 0.5 * clip.length_s(), clip.length_s()] {
                mended.sample(time, &mut mended.cursor(), &mut pose);
                mended.sample_scalars(time, &mut mended.cursor(), &mut scalars);
                prop_assert!(is_unit(pose[0].rotation) && scalars.iter().all(|s| s.is_finite()), "{mended:?} at {time}");
            }
            let _ = mended.seam();
        }
    }
}

proptest! {
    #[test]
    fn limbs(
        bones in prop::array::uniform4(any_transform()),
        pose in prop::array::uniform4(any_transform()),
        n in prop::array::uniform12(any_float()),
        joints in 2_usize..5,
    ) {
        // Valid rest poses in about half of the cases.
        let bone = |k: usize| Bone::new("b", k.checked_sub(1)).with_rest(if n[11] < 0.5 {
            Transform::from_translation(Vec3::new(0.3, 0.1, -0.2))
        } else {
            bones[k]
        });
        let Ok(skeleton) = Skeleton::new((0..4).map(bone)) else { return Ok(()) };
        let mut clip = Clip::new("c").with_length(1.0);
        if let Ok(track) = Track::linear([0.0, 1.0], [bones[1].rotation, bones[2].rotation]) {
            clip = clip.with_rotation(0, track);
        }
        let limb: Vec<usize> = (4 - joints..4).collect();
        let Ok(reach) = Reach::new(&clip, &skeleton, limb, 20.0) else { return Ok(()) };
        let reach = reach.with_smoothing(n[0]);
        let mut state = reach.state();
        state.weight = n[1];
        for target in [Vec3::from_slice(&n[2..]), Vec3::splat(0.2)] {
            let goals = [ReachGoal::new(0.33, target).with_weight(n[5]), ReachGoal::new(0.7, Vec3::from_slice(&n[6..]))];
            reach.aim(&mut state, &goals, n[9]).unwrap();
            state.advance(n[10]);
            let (mut local, mut model) = (pose, [Affine3A::IDENTITY; 4]);
            skeleton.to_model(&local, &mut model).unwrap();
            let before = local;
            reach.apply(&mut state, n[11], &mut local, &mut model).unwrap();
            for (now, before) in local.iter().zip(&before) {
                let is_left = now.rotation.to_array().map(f32::to_bits) == before.rotation.to_array().map(f32::to_bits);
                prop_assert!(is_left || is_unit(now.rotation), "{now:?}");
            }
        }
    }

    #[test]
    fn reductions(seed in any::<u64>(), bones in 1_usize..6, exponent in -6.0_f32..0.0) {
        let mut rng = Rng(seed);
        let (skeleton, clip) = (any_skeleton(&mut rng, bones), any_clip(&mut rng, bones));
        let tolerance = 10.0_f32.powf(exponent);
        let reduction = Reduction::new(tolerance).with_pins([0.4, 1.0]);
        let reduced = reduction.reduce(&clip, &skeleton).unwrap().clip;
        let found = error(&skeleton, &clip, |time, pose| reduced.sample(time, &mut reduced.cursor(), pose));
        prop_assert!(found <= f64::from(tolerance), "{found} of {tolerance}");
        let packed = reduction.pack(&clip, &skeleton).unwrap().clip;
        let found = error(&skeleton, &clip, |time, pose| packed.sample(time, &mut packed.cursor(), pose));
        prop_assert!(found <= f64::from(tolerance), "packed {found} of {tolerance}");
    }

    #[test]
    fn reductions_of_nonsense(
        times in prop::collection::vec(prop_oneof![0.0_f32..4.0, any_float()], 1..8),
        numbers in prop::collection::vec(any_float(), 96),
        rest in any_transform(),
        [tolerance, pin, at] in prop::array::uniform3(any_float()),
        is_sorted in any::<bool>(),
    ) {
        let mut times = times;
        if is_sorted {
            times.iter_mut().for_each(|time| *time = time.abs());
            times.sort_by(f32::total_cmp);
        }
        let rest = if rest.is_sound() { rest } else { Transform::IDENTITY };
        let bones = [None, Some(0), Some(1)].map(|parent| Bone::new("b", parent).with_rest(rest));
        let skeleton = Skeleton::new(bones).unwrap();
        let keys: Vec<HermiteKey<Quat>> = numbers.chunks(12).take(times.len())
            .map(|n| HermiteKey { into: Quat::from_slice(n), value: Quat::from_slice(&n[4..]), out: Quat::from_slice(&n[8..]) })
            .collect();
        let vectors: Vec<Vec3> = numbers.chunks(3).take(times.len()).map(Vec3::from_slice).collect();
        let mut clip = Clip::new("c").with_scalar(usize::MAX, Track::constant(0.5).unwrap());
        if let Ok(track) = Track::hermite(times.clone(), &keys) {
            clip = clip.with_rotation(0, track.cut(0.1, at)).with_rotation(usize::MAX, track);
        }
        if let Ok(track) = Track::linear(times.clone(), vectors.clone()) {
            clip = clip.with_translation(1, track.clone()).with_scale(2, track);
        }
        if let Ok(track) = Track::catmull_rom(times, vectors) {
            clip = clip.with_scale(0, track);
        }
        let reduction = Reduction::new(tolerance.abs()).with_pins([pin.abs()]);
        if let Ok(reduced) = reduction.reduce(&clip, &skeleton) {
            prop_assert!(reduced.error <= tolerance.abs(), "{reduced:?}");
        }
        if let Ok(packed) = reduction.pack(&clip, &skeleton) {
            prop_assert!(packed.error <= tolerance.abs(), "{packed:?}");
            let read = PackedClip::from_bytes(&packed.clip.to_bytes());
            prop_assert_eq!(read.as_ref(), Ok(&packed.clip));
            let mut pose = [Transform::IDENTITY; 3];
            packed.clip.sample(at, &mut packed.clip.cursor(), &mut pose);
            prop_assert!(pose.iter().all(Transform::is_sound), "{pose:?}");
        }
    }

    #[test]
    fn packed_bytes(bytes in prop::collection::vec(any::<u8>(), 0..200), is_begun in any::<bool>(), at in any_float()) {
        // Random bytes, with or without the header of a clip that has no name and no events before them.
        let begin = b"AIMP\x01\0\0\0\0\0\0\0\0\0\x80\x3f\0\0\0\0";
        let bytes = if is_begun { [&begin[..], &bytes].concat() } else { bytes };
        if let Ok(packed) = PackedClip::from_bytes(&bytes) {
            let mut pose = [Transform::IDENTITY; 3];
            packed.sample(at, &mut packed.cursor(), &mut pose);
            prop_assert!(pose.iter().all(Transform::is_sound), "{pose:?}");
        }
    }
}

proptest! {
    #[test]
    fn meshes(
        n in prop::collection::vec(any_float(), 90),
        weights in prop::array::uniform6(prop_oneof![0.0_f32..2.0, any_float()]),
        (is_small, is_posed) in any::<(bool, bool)>(),
    ) {
        let at = |k: usize| if is_small { Vec3::from_slice(&n[k..]).clamp(-Vec3::ONE, Vec3::ONE) } else { Vec3::from_slice(&n[k..]) };
        let skeleton = Skeleton::new([Bone::new("a", None), Bone::new("b", None)]).unwrap();
        let matrix = |k: usize| Affine3A::from_cols_slice(&n[k..]);
        let Ok(skin) = Skin::with_inverse_rest(&skeleton, [0, 1], [Affine3A::IDENTITY, matrix(0)]) else { return Ok(()) };
        let influences: Vec<[Influence; 2]> = weights.chunks(2).map(|w| [Influence::new(0, w[0]), Influence::new(1, w[1])]).collect();
        let morphs = [Morph { target: 0, vertex: 1, position: at(30), normal: at(33) }];
        let Ok(mesh) = Mesh::new([at(12), at(15), at(18)], [[0, 1, 2]], &influences) else { return Ok(()) };
        let Ok(mesh) = mesh.with_normals([at(21), at(24), at(27)]).and_then(|mesh| mesh.with_morphs(morphs)) else { return Ok(()) };
        let boxes = match BoneBoxes::new(&mesh, &skin) {
            Ok(boxes) => boxes,
            Err(error) => panic!("{error}"),
        };
        let matrices = if is_posed { [matrix(36), matrix(48)] } else { [Affine3A::IDENTITY, matrix(36)] };
        let pose_weights = [n[60]];
        let pose = MeshPose::new(&matrices).with_morph_weights(&pose_weights);
        let (mut placed, mut normals) = ([Vec3::ZERO; 3], [Vec3::ZERO; 3]);
        mesh.deform(&pose, &mut placed).unwrap();
        mesh.deform_normals(&pose, 1, &mut normals).unwrap();
        prop_assert!(normals.iter().all(|n| *n == Vec3::ZERO || (n.length() - 1.0).abs() < 1e-5), "{normals:?}");
        let whole = boxes.whole(&pose).unwrap().unwrap();
        for vertex in placed.iter().filter(|vertex| vertex.is_finite()) {
            prop_assert!(whole.contains(*vertex), "{vertex} {whole:?}");
        }
        let ray = Ray { end: n[61], ..Ray::new(at(62), at(65)) };
        if let Some(hit) = boxes.hit(&mesh, &pose, &ray).unwrap() {
            prop_assert!(hit.part >= 0.0 && hit.part <= ray.end && placed.iter().all(|vertex| vertex.is_finite()), "{hit:?}");
        }
    }
}

proptest! {
    #[test]
    fn layers_and_stances(
        rest in prop::array::uniform4(any_transform()),
        place in any_transform(),
        n in prop::array::uniform16(any_float()),
        sound in any::<bool>(),
    ) {
        let bone = |k: usize| Bone::new("b", k.checked_sub(1)).with_rest(if sound {
            Transform::from_translation(Vec3::new(0.03, -0.4, 0.02))
        } else {
            rest[k]
        });
        let Ok(skeleton) = Skeleton::new((0..4).map(bone)) else { return Ok(()) };
        let line = AimLine { bone: 3, origin: Vec3::from_slice(&n[13..]), forward: Vec3::from_slice(&n[10..]) };
        let turns = [[0.5, 0.5], [-0.5, 0.5], [0.0, -0.5], [n[0], n[1]]];
        let turns = turns.map(|[y, x]| Quat::from_xyzw(x, y, 0.0, 1.0));
        let clip = Track::linear([0.0, 1.0, 2.0, 3.0], turns).map(|track| Clip::new("aim").with_rotation(1, track));
        let poses = clip.ok().and_then(|clip| AimPoseSet::from_clip(&clip, &skeleton, &[0.0, 1.0, 2.0, n[2]], line).ok());
        let (limb, plant) = (LimbLayer::new(&skeleton, [1, 2, 3]), Plant::new(&skeleton, [1, 2, 3], Vec3::from_slice(&n[3..])));
        let recoil = Recoil::new(&skeleton, [1, 2, 3], rest[0].to_affine());
        let (Ok(limb), Ok(plant), Ok(mut recoil)) = (limb, plant, recoil) else { return Ok(()) };
        let mut limb = limb.with_fade(n[6]);
        (limb.weight, recoil.rate) = (n[7], n[8]);
        let mut plant = plant.with_fade(n[6]);
        plant.most_tilt_rad = n[7];
        let mut stance = Stance::new(&skeleton, 0, [plant]).unwrap();
        (stance.up, stance.most_drop) = (Vec3::from_slice(&n[9..]), n[12]);
        let mut poses = poses.map(AimPosesLayer::new);
        let mut figure = Figure::new(skeleton);
        for frame in 0..6_usize {
            if frame == 2 {
                figure.place = place;
                recoil.kick(Vec3::from_slice(&n), Vec3::from_slice(&n[4..]));
                limb.set_target(TipTarget::bone(frame, Vec3::from_slice(&n[1..])).with_rotation(rest[3].rotation));
                stance.feet_mut()[0].plant();
            }
            let ground = |at: Vec3| if frame == 3 { Ground::new(Vec3::from_slice(&n[5..]), Vec3::from_slice(&n[2..])) } else { Ground::new(at, Vec3::Y) };
            let mut standing = stance.on(ground);
            let mut layers: Vec<&mut dyn Layer> = vec![&mut recoil, &mut limb, &mut standing];
            if let Some(poses) = &mut poses {
                poses.target = Vec3::from_slice(&n[8..]);
                layers.push(poses);
            }
            figure.run(n[frame], &mut layers).unwrap();
            for (now, before) in figure.local().iter().zip(figure.skeleton().rest()) {
                let is_left = now.rotation.to_array().map(f32::to_bits) == before.rotation.to_array().map(f32::to_bits);
                prop_assert!(is_left || is_unit(now.rotation), "{now:?}");
            }
        }
        // Once all inputs are valid again, so is the pose.
        figure.place = Transform::IDENTITY;
        if sound {
            stance.feet_mut()[0].reset();
            let mut standing = stance.on(|at| Ground::new(at, Vec3::Y));
            figure.run(0.01, &mut [&mut standing]).unwrap();
            prop_assert!(figure.local().iter().all(Transform::is_sound), "{:?}", figure.local());
        }
        figure.hang(3, &rest[1].to_affine(), &rest[2].to_affine());
        prop_assert!(figure.place.is_sound(), "{:?}", figure.place);
    }
}
