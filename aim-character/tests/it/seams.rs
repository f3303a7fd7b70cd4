//! Mended loops, checked by forward kinematics of the written file: positions and speeds of every node across the seam.

use aim_animation::{Clip, Track};
use aim_character::{Mannequin, Measurement, PAPER_AXES, mended_loop};
use aim_gltf::Document;
use aim_runtime::glam::{DAffine3, DQuat, DVec3};

fn mannequin() -> Document {
    Document::from_bytes(&Mannequin::new().with_moves().glb(|_| PAPER_AXES).unwrap()).unwrap()
}

/// Returns the world transforms of all nodes.
fn world(document: &Document, clip: &Clip, seconds: f32) -> Vec<DAffine3> {
    document.skeleton().world_f64(&document.skeleton().pose(clip, seconds))
}

/// Returns the travel of the hips over a clip: displacement on the ground and rotation about the vertical.
fn along(document: &Document, clip: &Clip) -> DAffine3 {
    let hips = document.skeleton().find("hips").unwrap();
    let [begin, end] = [0.0, clip.length_s()].map(|t| world(document, clip, t)[hips]);
    let heading = |at: DAffine3| {
        let ahead = at.matrix3.y_axis;
        DQuat::from_rotation_y(ahead.x.atan2(ahead.z))
    };
    let turn = heading(end) * heading(begin).inverse();
    let way = end.translation - turn * begin.translation;
    DAffine3::from_rotation_translation(turn, way.with_y(0.0))
}

/// Returns the largest jumps of any node across the seam, in position and in speed (by one-sided differences), if the
/// next cycle is displaced by `along`.
fn jumps(document: &Document, clip: &Clip, along: DAffine3) -> [f64; 2] {
    let (length, h) = (clip.length_s(), 4e-3_f32);
    let at = |times: [f32; 3]| times.map(|time| world(document, clip, time));
    let [start, end] = [at([0.0, h, 2.0 * h]), at([length, length - h, length - 2.0 * h])];
    let speed = |of: &[Vec<DAffine3>; 3], node: usize, sign: f64| {
        let [a, b, c] = [0, 1, 2].map(|k| of[k][node].translation);
        (b * 4.0 - a * 3.0 - c) * (sign / (2.0 * f64::from(h)))
    };
    let jump = |node: usize| {
        let place = end[0][node].translation.distance(along.transform_point3(start[0][node].translation));
        let before: DVec3 = speed(&end, node, -1.0);
        [place, before.distance(along.transform_vector3(speed(&start, node, 1.0)))]
    };
    // Nodes that are not bones do not travel.
    let hips = document.skeleton().find("hips").unwrap();
    document
        .skeleton()
        .subtree(hips)
        .map(jump)
        .fold([0.0; 2], |most, jump| [most[0].max(jump[0]), most[1].max(jump[1])])
}

/// The mannequin's clips are already loops, apart from their travel: they are not changed.
#[test]
fn a_seamless_loop_is_unchanged() {
    let document = mannequin();
    let measurement = Measurement::of(&document);
    for clip in document.clips() {
        assert!(mended_loop(&document, &measurement, clip).unwrap().is_none(), "{}", clip.name());
    }
}

/// Pieces of clips that are not loops, on the spot, straight ahead and round a bend, written and read again.
#[test]
fn a_jump_is_mended_in_position_and_velocity() {
    let document = mannequin();
    let measurement = Measurement::of(&document);
    for (name, from, to) in [
        ("walk", 0.0, 1.0),
        ("walk", 0.1, 0.7),
        ("wave", 0.2, 1.1),
        ("walk_ahead", 0.0, 0.9),
        ("walk_ahead", 0.3, 1.0),
        ("run", 0.1, 0.6),
        ("walk_circle", 0.0, 2.0),
    ] {
        let clip = document.clip(name).unwrap().cut(from, to).with_name("piece");
        let mended = mended_loop(&document, &measurement, &clip).unwrap().expect("it is no loop");
        let file = Document::from_bytes(&document.with_clips(&[mended.clip]).unwrap()).unwrap();
        let written = file.clip("piece").unwrap();
        let travels = name != "walk" && name != "wave";
        let way = if travels { along(&document, &clip) } else { DAffine3::IDENTITY };
        let [before, after] = [jumps(&document, &clip, way), jumps(&file, written, way)];
        println!("{name} {from}…{to}: {before:.3?} before, {after:?} after");
        assert!(before[0] > 0.05 && before[1] > 0.3, "{name}: {before:?}");
        assert!(after[0] < 1e-4, "{name}: {} m over the seam", after[0]);
        // The tolerance covers the error of the differences, which is of the order of the third derivative.
        assert!(after[1] < 0.02 * before[1] + 0.02, "{name}: {} m/s over the seam", after[1]);
        // The middle of the clip is unchanged, and nothing moved by more than the width of the seam.
        let moved = |time: f32| {
            let pairs = world(&document, &clip, time).into_iter().zip(world(&file, written, time));
            pairs.map(|(a, b)| a.translation.distance(b.translation)).fold(0.0_f64, f64::max)
        };
        let (length, half) = (clip.length_s(), 0.5 * clip.length_s());
        let most = (0..=100_u8).map(|k| moved(length * f32::from(k) / 100.0)).fold(0.0_f64, f64::max);
        println!("  moved by {most:.3} m at most, {:.1e} m in the middle", moved(half));
        assert!(most < before[0] + 0.02 * before[1], "{name}: moved by {most} m, the seam was {} m", before[0]);
        assert!(moved(half) < 1e-3, "{name}: the middle moved by {} m", moved(half));
    }
}

/// A clip with more samples than a bake may have keys, for example because of a stray key, is rejected before it is
/// sampled.
#[test]
fn too_long_clips_are_refused() {
    let document = mannequin();
    let measurement = Measurement::of(&document);
    let walk = document.clip("walk").unwrap();
    for end in [9e3, 1e30] {
        let stray = Track::linear([0.0, end], [0.0, 1.0]).unwrap();
        let error = mended_loop(&document, &measurement, &walk.clone().with_scalar(0, stray)).unwrap_err();
        let words = error.to_string();
        assert!(words.contains("at 60 frames per second") && words.contains(&end.to_string()), "{words}");
    }
}
