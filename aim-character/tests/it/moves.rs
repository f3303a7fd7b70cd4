//! The mannequin's clips, checked by forward kinematics of the written file: soles on the ground, loops, arms and head.

use aim_character::{Mannequin, Measurement, PAPER_AXES, Role, Vrm, propose};
use aim_gltf::{Document, LookAt, LookAtKind};
use aim_runtime::glam::{DAffine3, DQuat, DVec3};

fn built(file: Mannequin) -> Document {
    Document::from_bytes(&file.glb(|_| PAPER_AXES).unwrap()).unwrap()
}

/// The clips, and the pose of the figure after each: metres forward, and quarter turns to the left.
const MOVES: [(&str, f64, f64); 6] = [
    ("walk_ahead", 1.2, 0.0),
    ("walk_circle", 0.0, 0.0),
    ("run", 2.0, 0.0),
    ("jump", 0.0, 0.0),
    ("turn", 0.0, 1.0),
    ("wave", 0.0, 0.0),
];

/// Returns each joint's world transform at a time, and its transform from the bind pose.
fn posed(document: &Document, clip: &str, seconds: f32) -> (Vec<DAffine3>, Vec<DAffine3>) {
    let skeleton = document.skeleton();
    let world = skeleton.world_f64(&skeleton.pose(document.clip(clip).unwrap(), seconds));
    let moved = skeleton.nodes().iter().zip(&world);
    let moved = moved.map(|(node, world)| *world * node.inverse_bind.unwrap_or(DAffine3::IDENTITY)).collect();
    (world, moved)
}

fn frames(document: &Document, clip: &str, rate: f32) -> Vec<(f32, Vec<DAffine3>, Vec<DAffine3>)> {
    let length = document.clip(clip).unwrap().length_s();
    let count = (1..u16::MAX).find(|k| f32::from(*k) > length * rate - 0.5).unwrap();
    let time = |k: u16| length * f32::from(k) / f32::from(count);
    (0..=count)
        .map(|k| {
            let (world, moved) = posed(document, clip, time(k));
            (time(k), world, moved)
        })
        .collect()
}

/// Returns heel, ball and tip of both soles, moved by the bones that carry them.
fn soles(document: &Document, moved: &[DAffine3]) -> [[DVec3; 3]; 2] {
    [("left", 1.0), ("right", -1.0)].map(|(side, sign)| {
        let bone = |name: &str| moved[document.skeleton().find(&format!("{side}_{name}")).unwrap()];
        let at = |bone: DAffine3, z: f64| bone.transform_point3(DVec3::new(0.097 * sign, 0.0, z));
        [at(bone("foot"), -0.06), at(bone("toes"), 0.09), at(bone("toes"), 0.17)]
    })
}

/// Checks at four samples per key that no sole is below the ground or slides on it, and that both feet are up only in a
/// run and a jump.
#[test]
fn standing_feet_do_not_slide() {
    let document = built(Mannequin::new().with_moves());
    for (name, ..) in MOVES {
        let frames = frames(&document, name, 240.0);
        let (mut lowest, mut slid, mut flown, mut stood) = (f64::INFINITY, 0.0_f64, 0.0_f64, [0.0_f64; 2]);
        // Position at which each point came down, while it is down.
        let mut down: [[Option<DVec3>; 3]; 2] = Default::default();
        for (_, _, moved) in &frames {
            let soles = soles(&document, moved);
            for (foot, sole) in soles.iter().enumerate() {
                for (point, down) in sole.iter().zip(&mut down[foot]) {
                    lowest = lowest.min(point.y);
                    *down = (point.y < 2e-3).then(|| down.unwrap_or(*point));
                    slid = slid.max(down.map_or(0.0, |at| (*point - at).with_y(0.0).length()));
                }
                stood[foot] += f64::from(u8::from(down[foot].iter().any(Option::is_some)));
            }
            flown += f64::from(u8::from(down.iter().flatten().all(Option::is_none)));
        }
        let share = |of: f64| of / frames.len() as f64;
        println!(
            "{name}: lowest {lowest:.4} m, slid {slid:.4} m, in the air {:.2}, down {:?}",
            share(flown),
            stood.map(share)
        );
        assert!(lowest > -0.01, "{name}: a sole is {lowest} m high");
        assert!(slid < 0.01, "{name}: a sole slides {slid} m");
        let flies = matches!(name, "run" | "jump");
        assert_eq!(flies, share(flown) > 0.15, "{name}: in the air for {} of the time", share(flown));
        assert!(flies || share(flown) < 0.01, "{name}: in the air for {} of the time", share(flown));
        assert!(stood.iter().all(|stood| share(*stood) > 0.25), "{name}: both feet come down");
    }
}

/// The end continues into the beginning after the clip's movement: in position, and with no larger jump in speed than
/// between any two keys of the clip.
#[test]
fn moves_are_loops() {
    let document = built(Mannequin::new().with_moves());
    for (name, ahead, quarters) in MOVES {
        let along = DAffine3::from_rotation_translation(
            DQuat::from_rotation_y(quarters * std::f64::consts::FRAC_PI_2),
            DVec3::Z * ahead,
        );
        let frames = frames(&document, name, 60.0);
        let last = frames.len() - 1;
        let (mut worst, mut most) = (0.0_f64, 0.0_f64);
        for joint in 0..25 {
            let at = |k: usize| frames[k].1[joint];
            assert!(at(last).abs_diff_eq(along * at(0), 1e-5), "{name} joint {joint}: {:?} {:?}", at(last), at(0));
            let bend = |a: DVec3, b: DVec3, c: DVec3| (a - 2.0 * b + c).length();
            let place = |k: usize| at(k).translation;
            worst = worst.max(bend(place(last - 1), place(last), along.transform_point3(place(1))));
            most = (1..last).map(|k| bend(place(k - 1), place(k), place(k + 1))).fold(most, f64::max);
        }
        println!("{name}: {worst:.4} m at the seam, {most:.4} m elsewhere");
        assert!(worst < 1.05 * most, "{name}: {worst} beside {most}");
    }
}

/// The hand on a side moves back while the foot on that side moves forward. The head is upright and faces ahead of the
/// hips.
#[test]
fn arms_swing_against_the_legs_and_the_head_is_up() {
    let document = built(Mannequin::new().with_moves());
    let find = |name: &str| document.skeleton().find(name).unwrap();
    let bind = document.skeleton().nodes()[find("head")].inverse_bind.unwrap();
    for (name, ..) in MOVES {
        let frames = frames(&document, name, 60.0);
        let (mut least_up, mut furthest) = (1.0_f64, 0.0_f64);
        let mut ways: [Vec<f64>; 2] = Default::default();
        for (_, world, moved) in &frames {
            let head = world[find("head")] * bind;
            least_up = least_up.min(head.matrix3.y_axis.normalize().y);
            let [ahead, hips_ahead] = [head, moved[find("hips")]].map(|at| at.matrix3.z_axis.with_y(0.0).normalize());
            furthest = furthest.max(ahead.angle_between(hips_ahead));
            let hips = world[find("hips")].translation;
            for (ways, part) in ways.iter_mut().zip(["left_hand", "left_foot"]) {
                ways.push((world[find(part)].translation - hips).dot(hips_ahead));
            }
        }
        println!("{name}: head up {least_up:.3}, away from the hips' front by {:.0}°", furthest.to_degrees());
        assert!(least_up > 0.95, "{name}: the head leans, {least_up}");
        assert!(furthest < 0.7, "{name}: the head is turned by {furthest}");
        if name.starts_with("walk") || name == "run" {
            let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len() as f64;
            let [hand, foot] = ways.each_ref().map(|way| (way, mean(way)));
            let product = |a: (&Vec<f64>, f64), b: (&Vec<f64>, f64)| {
                a.0.iter().zip(b.0).map(|(x, y)| (x - a.1) * (y - b.1)).sum::<f64>()
            };
            let correlation = product(hand, foot) / (product(hand, hand) * product(foot, foot)).sqrt();
            println!("{name}: hand and foot {correlation:.2}");
            assert!(correlation < -0.8, "{name}: {correlation}");
        }
    }
}

/// Both versions of VRM look the same, except that version 0 faces the other way, and all bones and eyes are
/// recognised.
#[test]
fn moves_are_the_same_in_vrm_files() {
    let plain = built(Mannequin::new().with_moves());
    for (version, facing) in [(Vrm::V0, DVec3::NEG_Z), (Vrm::V1, DVec3::Z)] {
        let document = built(Mannequin::new().with_moves().with_vrm(version));
        let scene = DAffine3::from_scale(DVec3::new(facing.z, 1.0, facing.z));
        for (clip, seconds) in [("walk", 0.3), ("run", 0.2), ("wave", 1.0), ("turn", 0.9)] {
            let (_, expected) = posed(&plain, clip, seconds);
            let (_, found) = posed(&document, clip, seconds);
            // The mesh also faces the other way.
            for (joint, (expected, found)) in expected.iter().zip(&found).enumerate().take(25) {
                assert!((*found * scene).abs_diff_eq(scene * *expected, 2e-6), "{version:?} {clip} joint {joint}");
            }
        }
        let measured = Measurement::of(&document);
        assert_eq!((measured.up, measured.forward), (DVec3::Y, facing), "{version:?}");
        for (role, name) in [
            (Role::Hips, "hips"),
            (Role::Neck, "neck"),
            (Role::Head, "head"),
            (Role::LeftEye, "left_eye"),
            (Role::RightEye, "right_eye"),
        ] {
            assert_eq!(measured.with_role(role).map(|bone| bone.name.as_str()), Some(name), "{version:?}");
        }
        let named = document.skeleton().nodes().iter().filter(|node| node.vrm_bone.is_some()).count();
        assert_eq!(named, 24, "{version:?}: all but one bone of the spine");
        let look = LookAt::of(&document).expect("it has a lookAt");
        assert_eq!(look.kind, LookAtKind::Bone);
        assert!(LookAt::doubts(&document).is_empty());
        assert_eq!([look.horizontal_outer.apply(20.0), look.vertical_up.apply(40.0)], [20.0, 25.0]);
        let spec = propose(&document, &measured, None).unwrap().spec;
        // An eye, the head, the neck, and the bones of the spine that VRM has names for.
        assert_eq!(spec.joints.len(), 6, "{version:?}");
        // The arms are level in the rest pose.
        let skeleton = document.skeleton();
        let rest = skeleton.world_f64(skeleton.rest());
        let hand = |side: &str| rest[skeleton.find(&format!("{side}_hand")).unwrap()].translation;
        assert!((hand("left").y - hand("right").y).abs() < 1e-6 && hand("left").y > 1.3, "{version:?}");
        assert!((hand("left") - hand("right")).length() > 1.2);
    }
}

/// The first clip of its file: a loop on the spot without a jump in speed, walking at its ends and running in its
/// middle. The other clips are the same as without it.
#[test]
fn the_walk_to_run_blend_stays_in_step() {
    let (document, plain) =
        (built(Mannequin::new().with_walk_to_run().with_moves()), built(Mannequin::new().with_moves()));
    let clip = &document.clips()[0];
    assert_eq!((clip.name(), clip.length_s()), ("walk_to_run", 10.0));
    for other in plain.clips() {
        assert_eq!(document.clip(other.name()).unwrap(), other);
    }
    let measurement = Measurement::of(&document);
    assert!(aim_character::mended_loop(&document, &measurement, clip).unwrap().is_none());
    let frames = frames(&document, "walk_to_run", 60.0);
    let hips = document.skeleton().find("hips").unwrap();
    let away = frames.iter().map(|(_, world, _)| world[hips].translation.with_y(0.0).length()).fold(0.0, f64::max);
    assert!(away < 0.06, "the hips are {away} m away");
    // In a run there are times with no foot on the ground, in a walk times with both.
    let down = |(_, _, moved): &(f32, Vec<DAffine3>, Vec<DAffine3>)| {
        soles(&document, moved).map(|sole| sole.iter().any(|point| point.y < 4e-3))
    };
    let part = |from: usize, to: usize, with: fn([bool; 2]) -> bool| {
        let frames = &frames[from..to];
        frames.iter().filter(|frame| with(down(frame))).count() as f64 / frames.len() as f64
    };
    let none = |feet: [bool; 2]| feet == [false; 2];
    let both = |feet: [bool; 2]| feet == [true; 2];
    let [walk, run] = [(0, 72), (264, 336)].map(|(from, to)| [part(from, to, none), part(from, to, both)]);
    println!("in the air, on both feet: {walk:.2?} walking, {run:.2?} running");
    assert!(walk[0] < 0.01 && walk[1] > 0.15, "it walks: {walk:?}");
    assert!(run[0] > 0.15 && run[1] < 0.01, "it runs: {run:?}");
    // The feet alternate throughout: the legs stay opposite, whatever the share of the run.
    let feet = ["left_foot", "right_foot"].map(|foot| document.skeleton().find(foot).unwrap());
    let apart: Vec<f64> = frames.iter().map(|(_, w, _)| (w[feet[0]].translation - w[feet[1]].translation).z).collect();
    let steps: Vec<usize> = (1..apart.len()).filter(|&k| apart[k - 1] * apart[k] < 0.0).collect();
    let longest = steps.windows(2).map(|pair| pair[1] - pair[0]).max().unwrap();
    let shortest = steps.windows(2).map(|pair| pair[1] - pair[0]).min().unwrap();
    // 1.1 s and 0.7 s for two steps, stretched to a whole number of cycles.
    assert!(longest <= 37 && shortest >= 18, "steps take {shortest} to {longest} frames");
}
