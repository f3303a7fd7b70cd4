//! Clips of real characters, reduced and packed: bytes compared with those of the file, and errors by forward
//! kinematics in `f64`.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::time::Instant;

use aim_animation::{Clip, PackedClip, Reduction, Skeleton, Transform};
use aim_character::Measurement;
use aim_gltf::Document;
use aim_runtime::glam::{DAffine3, DVec3};
use serde_json::Value;

const FILES: [&str; 7] = [
    "cesium_man.gltf",
    "dude.glb",
    "khronos_fox.glb",
    "pab_arnaud.glb",
    "quaternius_horse.glb",
    "quaternius_robot.glb",
    "rocketbox_female_adult_01.glb",
];

fn path(file: &str) -> PathBuf {
    let folder = PathBuf::from(std::env::var_os("AIM_RIGS").expect("AIM_RIGS names a folder of real characters"));
    // Relative to the repository, where the command runs that sets it; tests run in the crate's folder.
    let folder =
        if folder.is_relative() { PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..").join(folder) } else { folder };
    folder.join(file)
}

/// Returns the bytes of an animation's times and values as floats. A time accessor shared by several channels counts
/// once.
fn bytes_in_file(json: &Value, animation: usize) -> usize {
    let animation = &json["animations"][animation];
    let index = |value: &Value| usize::try_from(value.as_u64().unwrap()).unwrap();
    let numbers = |accessor: usize| {
        let accessor = &json["accessors"][accessor];
        let parts = match accessor["type"].as_str().unwrap() {
            "SCALAR" => 1,
            "VEC3" => 3,
            "VEC4" => 4,
            other => panic!("{other}"),
        };
        parts * index(&accessor["count"])
    };
    let mut inputs = BTreeSet::new();
    let mut values = 0;
    for channel in animation["channels"].as_array().unwrap() {
        let sampler = &animation["samplers"][index(&channel["sampler"])];
        inputs.insert(index(&sampler["input"]));
        values += numbers(index(&sampler["output"]));
    }
    4 * (values + inputs.into_iter().map(numbers).sum::<usize>())
}

fn affine(transform: &Transform) -> DAffine3 {
    DAffine3::from_scale_rotation_translation(
        transform.scale.as_dvec3(),
        transform.rotation.as_dquat().normalize(),
        transform.translation.as_dvec3(),
    )
}

fn world(skeleton: &Skeleton, pose: &[Transform]) -> Vec<DAffine3> {
    let mut world: Vec<DAffine3> = Vec::new();
    for (bone, parent) in skeleton.parents().iter().enumerate() {
        let local = affine(&pose[bone]);
        world.push(parent.map_or(local, |parent| world[parent] * local));
    }
    world
}

/// Returns test points fixed to each bone: its origin, its children's origins at rest, and its length along its axes.
fn points(skeleton: &Skeleton) -> Vec<Vec<DVec3>> {
    let rest = world(skeleton, skeleton.rest());
    let children =
        |bone: usize| skeleton.parents().iter().enumerate().filter(move |(_, parent)| **parent == Some(bone));
    let length = |bone: usize| {
        let lengths = children(bone).map(|(child, _)| rest[child].translation.distance(rest[bone].translation));
        lengths.fold(0.0, f64::max)
    };
    let size = rest.iter().map(|bone| bone.translation.distance(rest[0].translation)).fold(0.0, f64::max);
    (0..skeleton.len())
        .map(|bone| {
            let mut at = Some(bone);
            while let Some(bone) = at.filter(|bone| length(*bone) < 1.1e-4 * size) {
                at = skeleton.parents()[bone];
            }
            let length = at.map_or(0.1 * size, length);
            let mut points = vec![DVec3::ZERO];
            points.extend(children(bone).map(|(child, _)| skeleton.rest()[child].translation.as_dvec3()));
            for axis in DVec3::AXES {
                let scale = rest[bone].transform_vector3(axis).length();
                points.push(axis * (length / scale));
            }
            points
        })
        .collect()
}

/// Returns the largest error at the clip's keys and at eight points between neighbouring keys.
fn error(skeleton: &Skeleton, clip: &Clip, mut sample: impl FnMut(f32, &mut [Transform])) -> f64 {
    let mut times: Vec<f32> = Vec::new();
    for tracks in clip.tracks() {
        times.extend(tracks.translation.iter().flat_map(|track| track.times()));
        times.extend(tracks.rotation.iter().flat_map(|track| track.times()));
        times.extend(tracks.scale.iter().flat_map(|track| track.times()));
    }
    times.sort_by(f32::total_cmp);
    times.dedup();
    let between: Vec<f32> = times
        .windows(2)
        .flat_map(|pair| (1..=8_u8).map(|k| pair[0] + (pair[1] - pair[0]) * f32::from(k) / 9.0))
        .collect();
    times.extend(between);
    times.sort_by(f32::total_cmp);
    let points = points(skeleton);
    let (mut cursor, mut worst) = (clip.cursor(), 0.0_f64);
    for time in times {
        let mut poses = [skeleton.rest().to_vec(), skeleton.rest().to_vec()];
        clip.sample(time, &mut cursor, &mut poses[0]);
        sample(time, &mut poses[1]);
        let [a, b] = poses.map(|pose| world(skeleton, &pose));
        for (bone, points) in points.iter().enumerate() {
            for point in points {
                let off = a[bone].transform_point3(*point).distance(b[bone].transform_point3(*point));
                assert!(off.is_finite(), "bone {bone} at {time} s");
                worst = worst.max(off);
            }
        }
    }
    worst
}

#[test]
#[ignore = "needs AIM_RIGS"]
fn real_clips_keep_a_millimetre_in_a_fifth_of_their_bytes() {
    let (mut all_file, mut all_packed, mut all_reduced, mut least) = (0, 0, 0, 0.0_f64);
    let mut seconds = 0.0;
    for file in FILES {
        let document = Document::load(path(file)).unwrap();
        let millimetre = 1e-3 * Measurement::of(&document).metre();
        let skeleton = document.skeleton();
        for (index, clip) in document.clips().iter().enumerate() {
            let in_file = bytes_in_file(document.json(), index);
            #[expect(clippy::cast_possible_truncation, reason = "a tolerance")]
            let reduction = Reduction::new(millimetre as f32);
            let start = Instant::now();
            let packed = reduction.pack(clip, skeleton).unwrap();
            let took = start.elapsed().as_secs_f64();
            seconds += took;
            let reduced = reduction.reduce(clip, skeleton).unwrap();
            let mut cursor = packed.clip.cursor();
            let off = error(skeleton, clip, |time, pose| packed.clip.sample(time, &mut cursor, pose)) / millimetre;
            let mut cursor = reduced.clip.cursor();
            let off_reduced =
                error(skeleton, clip, |time, pose| reduced.clip.sample(time, &mut cursor, pose)) / millimetre;
            #[expect(clippy::cast_precision_loss, reason = "some thousands")]
            let part = |bytes: usize| 100.0 * bytes as f64 / in_file as f64;
            println!(
                "| {file} | {} | {:.2} | {in_file} | {} | {:.1} | {} | {:.1} | {off:.2} | {took:.2}",
                clip.name(),
                clip.length_s(),
                reduced.clip.bytes(),
                part(reduced.clip.bytes()),
                packed.clip.bytes(),
                part(packed.clip.bytes()),
            );
            assert!(off <= 1.0 && off_reduced <= 1.0, "{file} {} {off} {off_reduced}", clip.name());
            assert!(part(packed.clip.bytes()) <= 60.0, "{file} {}", clip.name());
            assert_eq!(PackedClip::from_bytes(&packed.clip.to_bytes()).as_ref(), Ok(&packed.clip));
            least = least.max(off);
            all_file += in_file;
            all_packed += packed.clip.bytes();
            all_reduced += reduced.clip.bytes();
        }
    }
    println!("all: {all_file} reduced {all_reduced} packed {all_packed}; {seconds:.1} s, error up to {least:.3} mm");
    assert!(all_packed * 100 <= all_file * 20);
}
