//! What is counted: poses of 64 bones, sampled from a clip, blended, or taken to model space, and little else.
//!
//! `pose_frames none|sample|packed|blend|sum|model|matrices|deform FRAMES`: two runs differ by the work of the frames by which they
//! differ; `none` is the frame without the work. Every bone has its own linear tracks of translation, rotation and scale, of 30 keys a
//! second, sampled forward at 60 Hz with one cursor; `packed` is that clip packed to a thousandth. `sum` is of four poses; `matrices` are
//! those of all bones, and `deform` moves as many vertices of four joints each.

use std::env;
use std::hint::black_box;
use std::process::ExitCode;

use aim::animation::{Blender, Bone, Clip, Influence, Mesh, MeshPose, Reduction, Skeleton, Skin, Track, Transform};
use aim::glam::{Affine3A, Quat, Vec3};

const BONES: usize = 64;
/// Keys of the clip, 30 a second.
const KEYS: u16 = 600;

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [work, frames] = arguments.as_slice() else { return usage() };
    let Ok(frames) = frames.parse::<u16>() else { return usage() };
    // A chain of four to each bone of a spine.
    let bones = (0..BONES).map(|bone| {
        let parent = if bone % 4 == 0 { bone.checked_sub(4) } else { Some(bone - 1) };
        Bone::new("bone", parent).with_rest(Transform::new(Vec3::Y * 0.1, Quat::from_rotation_z(0.1)))
    });
    let skeleton = Skeleton::new(bones).expect("parents come first");
    let clip = clip();
    let mut cursor = clip.cursor();
    let packed = (work == "packed").then(|| Reduction::new(1e-3).pack(&clip, &skeleton).expect("it is sound").clip);
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
                    packed.sample(time_s, &mut packed_cursor, &mut pose);
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

fn usage() -> ExitCode {
    eprintln!("pose_frames none|sample|packed|blend|sum|model|matrices|deform FRAMES");
    ExitCode::FAILURE
}

/// A vertex for each bone, moved by that and the next three.
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
