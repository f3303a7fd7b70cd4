//! A program for counting instructions: samples, blends or transforms poses of 64 bones, and does little else.
//!
//! `pose_frames none|sample|packed|blend|sum|model|matrices|deform|stack-… FRAMES`: the difference between two runs is
//! the work of the frames by which they differ; `none` is the empty frame.
//! - `sample`: every bone has its own linear tracks of translation, rotation and scale, with 30 keys a second, sampled
//!   forward at 60 Hz with one cursor.
//! - `packed`: the first half second of that clip, packed to a tolerance of 0.001 and repeated.
//! - `blend`: two poses; `sum`: four poses.
//! - `model`: model-space transforms; `matrices`: skinning matrices of all bones; `deform`: 64 vertices of four joints
//!   each.
//! - `stack-blend`, `stack-feet`, `stack-aim`, `stack-hand`: frames of layers on a figure, each with the layers before
//!   it: two clips blended, two planted feet, three joints aimed, one hand.

use std::env;
use std::hint::black_box;
use std::process::ExitCode;

use aim::animation::{
    AimChain, AimLayer, Blender, Bone, Clip, ClipControl, Figure, Ground, Influence, Instance, Layer, LimbLayer, Mesh,
    MeshPose, Model, Plant, Reduction, Skeleton, Skin, Stance, TipTarget, Track, Transform,
};
use aim::glam::{Affine3A, Quat, Vec3};
use aim::{AimRig, Joint};

const BONES: usize = 64;
/// Keys of the clip, 30 a second.
const KEYS: u16 = 600;
/// Length of the packed part of the clip, seconds; short, since packing itself is not measured.
const PACKED_S: f32 = 0.5;

/// The aim chain of the layer stack: three bones.
#[derive(AimRig)]
#[aim(axes(up = +Y, forward = +Z, left = +X))]
struct Spine {
    #[joint(role = head, heading = -60deg..=60deg, pitch = -40deg..=40deg, rate = 200deg)]
    head: Joint,
    #[joint(role = neck, heading = -30deg..=30deg, pitch = -20deg..=20deg, rate = 120deg)]
    neck: Joint,
    #[joint(role = chest, heading = -30deg..=30deg, pitch = -20deg..=20deg, rate = 70deg)]
    chest: Joint,
}

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [work, frames] = arguments.as_slice() else { return usage() };
    let Ok(frames) = frames.parse::<u16>() else { return usage() };
    // A spine with a chain of four bones (itself included) at each of its bones.
    let bones = (0..BONES).map(|bone| {
        let parent = if bone % 4 == 0 { bone.checked_sub(4) } else { Some(bone - 1) };
        Bone::new("bone", parent).with_rest(Transform::new(Vec3::Y * 0.1, Quat::from_rotation_z(0.1)))
    });
    let skeleton = Skeleton::new(bones).expect("parents come first");
    let clip = clip();
    if let Some(last) = work.strip_prefix("stack-") {
        return stack(&skeleton, clip, last, frames);
    }
    let mut cursor = clip.cursor();
    let pack = || Reduction::new(1e-3).pack(&clip.cut(0.0, PACKED_S), &skeleton).expect("it is sound").clip;
    let packed = (work == "packed").then(pack);
    let mut packed_cursor = packed.as_ref().map(|packed| packed.cursor()).unwrap_or_default();
    let mut pose = skeleton.rest().to_vec();
    let mut model = vec![Affine3A::IDENTITY; BONES];
    let blender = Blender::new(&skeleton);
    let mut others = [0.1, 0.4, 1.3, 2.0].map(|time_s| {
        let mut other = pose.clone();
        clip.sample(time_s, &mut clip.cursor(), &mut other);
        other
    });
    let skin = Skin::new(&skeleton, (0..BONES).collect::<Vec<_>>()).expect("they span space");
    let mut matrices = model.clone();
    let mesh = mesh();
    let mut placed = mesh.positions().to_vec();
    for frame in 0..frames {
        let time_s = f32::from(frame) / 60.0;
        match work.as_str() {
            "none" => {}
            "sample" => clip.sample(time_s, &mut cursor, &mut pose),
            "packed" => {
                if let Some(packed) = &packed {
                    packed.sample(time_s % PACKED_S, &mut packed_cursor, &mut pose);
                }
            }
            "blend" => {
                let [one, other, ..] = &mut others;
                blender.blend(one, other, black_box(0.25)).expect("of one length");
            }
            "sum" => {
                let [a, b, c, d] = &others;
                blender.sum(&[(a, 0.4), (b, 0.3), (c, 0.2), (d, 0.1)], &mut pose).expect("of one length");
            }
            "model" => skeleton.to_model(&pose, &mut model).expect("of one length"),
            "matrices" => skin.matrices(&model, &mut matrices).expect("of one length"),
            "deform" => mesh.deform(&MeshPose::new(&matrices), &mut placed).expect("of one length"),
            _ => return usage(),
        }
        black_box((&pose, &model, &others, &matrices, &placed));
    }
    ExitCode::SUCCESS
}

/// Runs frames of the layers up to `last`. Legs and arm are chains of three bones of the skeleton, all of which the
/// clips move.
fn stack(skeleton: &Skeleton, clip: Clip, last: &str, frames: u16) -> ExitCode {
    let Some(count) = ["blend", "feet", "aim", "hand"].iter().position(|layer| *layer == last) else { return usage() };
    let other = clip.reversed();
    let model = Model::new(skeleton.clone(), [clip, other]);
    let (mut figure, mut hero) = (Figure::new(skeleton.clone()), Instance::new(&model));
    hero.play(ClipControl::new(0));
    hero.play(ClipControl::new(1).with_weight(0.3));
    let foot = |hip: usize| Plant::new(skeleton, [hip, hip + 1, hip + 2], Vec3::ZERO).expect("it has length");
    let mut stance = Stance::new(skeleton, 0, [foot(5), foot(9)]).expect("they hang on the first bone");
    stance.feet_mut().iter_mut().for_each(Plant::plant);
    let chain = AimChain::new(skeleton, [15, 14, 13]).expect("they hang on each other");
    let mut gaze = AimLayer::new(chain, Spine::RIG);
    let mut hand = LimbLayer::new(skeleton, [17, 18, 19]).expect("it has length");
    hand.set_target(TipTarget::bone(15, Vec3::Y * 0.1));
    for frame in 0..frames {
        hero.advance(&model, 1.0 / 60.0);
        gaze.target = Vec3::new(0.5 + 0.001 * f32::from(frame), 2.0, 3.0);
        let (mut walk, mut feet) = (hero.layer(&model), stance.on(|at| Ground::new(at.with_y(0.1 * at.z), Vec3::Y)));
        let mut layers: [&mut dyn Layer; 4] = [&mut walk, &mut feet, &mut gaze, &mut hand];
        figure.run(1.0 / 60.0, &mut layers[..=count]).expect("of one skeleton");
        black_box(&figure);
    }
    ExitCode::SUCCESS
}

fn usage() -> ExitCode {
    eprintln!("pose_frames none|sample|packed|blend|sum|model|matrices|deform FRAMES");
    eprintln!("pose_frames stack-blend|stack-feet|stack-aim|stack-hand FRAMES");
    ExitCode::FAILURE
}

/// Builds a mesh with one vertex for each bone, moved by that bone and the next three.
fn mesh() -> Mesh {
    let joint = |bone: usize| u32::try_from(bone % BONES).unwrap_or_default();
    let influences = |bone: usize| [0, 1, 2, 3].map(|next| Influence::new(joint(bone + next), 0.25));
    let influences: Vec<[Influence; 4]> = (0..BONES).map(influences).collect();
    Mesh::new([Vec3::ONE; BONES], [], &influences).expect("every vertex is moved")
}

fn clip() -> Clip {
    let times: Vec<f32> = (0..KEYS).map(|key| f32::from(key) / 30.0).collect();
    (0..BONES).fold(Clip::new("all bones"), |clip, bone| {
        let phase = 0.7 * u16::try_from(bone).map_or(0.0, f32::from);
        let swing: Vec<f32> = times.iter().map(|time| (2.0 * time + phase).sin()).collect();
        let translations: Vec<Vec3> = swing.iter().map(|swing| Vec3::new(0.02 * swing, 0.1, 0.0)).collect();
        let rotations: Vec<Quat> = swing.iter().map(|swing| Quat::from_rotation_x(0.6 * swing)).collect();
        let scales: Vec<Vec3> = swing.iter().map(|swing| Vec3::splat(1.0 + 0.05 * swing)).collect();
        clip.with_translation(bone, Track::linear(times.clone(), translations).expect("times increase"))
            .with_rotation(bone, Track::linear(times.clone(), rotations).expect("times increase"))
            .with_scale(bone, Track::linear(times.clone(), scales).expect("times increase"))
    })
}
