//! A packed clip plays under layers: aim poses, a planted foot, a hand, recoil; and rays are cast at the deformed mesh.

use aim::animation::{
    AimLine, AimPoseSet, AimPosesLayer, Bone, BoneBoxes, Clip, Cursor, Figure, Ground, Influence, LimbLayer, Mesh,
    MeshPose, Morph, PackedClip, Plant, PoseError, Ray, Recoil, Reduction, Skeleton, Skin, Stance, TipTarget, Track,
    Transform,
};
use aim::glam::{Affine3A, Quat, Vec3};
use aim::ik::{Ccd, CcdJoint};

use crate::{FRAMES, Fnv, World};

/// A pelvis with a leg and an arm.
fn skeleton() -> Option<Skeleton> {
    let bone = |(name, parent, at): (&str, _, [f32; 3])| {
        Bone::new(name, parent).with_rest(Transform::from_translation(at.into()))
    };
    let bones = [
        ("pelvis", None, [0.0, 1.0, 0.0]),
        ("hip", Some(0), [0.1, -0.1, 0.0]),
        ("knee", Some(1), [0.0, -0.42, 0.03]),
        ("ankle", Some(2), [0.0, -0.4, -0.03]),
        ("shoulder", Some(0), [0.2, 0.5, 0.0]),
        ("elbow", Some(4), [0.3, 0.0, -0.02]),
        ("hand", Some(5), [0.25, 0.0, 0.02]),
    ];
    Skeleton::new(bones.map(bone)).ok()
}

/// Returns a clip that moves every bone, 30 keys a second, made without functions that differ between machines.
fn clip() -> Option<Clip> {
    let times: Vec<f32> = (0..=60_u8).map(|key| f32::from(key) / 30.0).collect();
    // A smooth swing, 0 at 0, 1 and 2 s.
    let swing = |time: f32| time * (time - 1.0) * (time - 2.0);
    (0..7_u8).try_fold(Clip::new("clip"), |clip, bone| {
        let by = 0.2 + 0.05 * f32::from(bone);
        let turns: Vec<Quat> = times.iter().map(|time| turn(by * swing(*time))).collect();
        let clip = clip.with_rotation(bone.into(), Track::linear(&times[..], turns).ok()?);
        let ways: Vec<Vec3> = times.iter().map(|time| Vec3::new(0.1 * swing(*time), 1.0, 0.05 * time)).collect();
        Some(if bone == 0 { clip.with_translation(0, Track::linear(&times[..], ways).ok()?) } else { clip })
    })
}

/// Returns a rotation about x; `tangent` is that of half the angle.
fn turn(tangent: f32) -> Quat {
    let cos = 1.0 / (1.0 + tangent * tangent).sqrt();
    Quat::from_xyzw(tangent * cos, 0.0, 0.0, cos)
}

/// Returns a mesh with a triangle at each bone, bound to that bone and the next.
fn mesh(skeleton: &Skeleton) -> Option<(Mesh, Skin)> {
    let (mut positions, mut influences) = (Vec::new(), Vec::new());
    let mut model = vec![Affine3A::IDENTITY; skeleton.len()];
    skeleton.to_model(skeleton.rest(), &mut model).ok()?;
    for (bone, at) in (0..).zip(&model) {
        for corner in [Vec3::ZERO, Vec3::new(0.1, 0.0, 0.02), Vec3::new(0.0, 0.1, 0.0)] {
            positions.push(Vec3::from(at.translation) + corner);
            influences.push([Influence::new(bone, 0.7), Influence::new((bone + 1) % 7, 0.3)]);
        }
    }
    let triangles: Vec<[u32; 3]> = (0..7).map(|bone| [3 * bone, 3 * bone + 1, 3 * bone + 2]).collect();
    let normals = vec![Vec3::new(0.0, 0.6, 0.8); positions.len()];
    let morph = Morph { target: 0, vertex: 4, position: Vec3::new(0.01, 0.02, 0.0), normal: Vec3::X };
    let mesh = Mesh::new(positions, triangles, &influences).ok()?.with_normals(normals).ok()?.with_morphs([morph]);
    Some((mesh.ok()?, Skin::new(skeleton, (0..7).collect::<Vec<_>>()).ok()?))
}

pub(crate) fn run(world: World) -> u64 {
    // All construction here succeeds; a failure would show as a hash of 0.
    hashed(world).unwrap_or(0)
}

fn hashed(mut world: World) -> Option<u64> {
    let (mut hash, skeleton, clip) = (Fnv::default(), skeleton()?, clip()?);
    let packed = Reduction::new(1e-3).with_pins([0.5]).pack(&clip, &skeleton).ok()?;
    hash.float(packed.error);
    packed.clip.to_bytes().into_iter().for_each(|byte| hash.float(byte.into()));
    let packed: PackedClip = packed.clip;

    let line = AimLine { bone: 6, origin: Vec3::new(0.0, 0.1, 0.0), forward: Vec3::Z };
    let set = AimPoseSet::from_clip(&poses()?, &skeleton, &[0.0, 1.0, 2.0, 3.0], line).ok()?;
    let mut poses = AimPosesLayer::new(set);
    let foot = Plant::new(&skeleton, [1, 2, 3], Vec3::new(0.1, 0.0, 0.1)).ok()?;
    let mut stance = Stance::new(&skeleton, 0, [foot]).ok()?;
    let mut hand = LimbLayer::new(&skeleton, [4, 5, 6]).ok()?.with_fade(0.2);
    let mut recoil = Recoil::new(&skeleton, [4, 5, 6], Affine3A::IDENTITY).ok()?;
    let (mesh, skin) = mesh(&skeleton)?;
    let boxes = BoneBoxes::new(&mesh, &skin).ok()?;
    let mut matrices = vec![Affine3A::IDENTITY; skin.len()];
    let (mut placed, mut normals) = (mesh.positions().to_vec(), mesh.positions().to_vec());
    let (mut figure, mut cursor, mut time) = (Figure::new(skeleton), Cursor::default(), 0.0);
    let ground = |at: Vec3| Ground::new(Vec3::new(at.x, 0.05 * at.z * at.z, at.z), Vec3::new(0.0, 1.0, -0.1 * at.z));
    for frame in 0..FRAMES {
        world.pass(frame, false);
        time = if time + world.dt > 2.0 { 0.0 } else { time + world.dt };
        figure.place.translation = Vec3::new(0.0, 0.0, 0.01 * world.target.z);
        poses.target = world.target;
        match frame % 60 {
            0 => stance.feet_mut().iter_mut().for_each(Plant::plant),
            20 => hand.set_target(TipTarget::world(Vec3::new(0.4, 1.2, 0.1 * world.target.x))),
            30 => recoil.kick(Vec3::NEG_Z, Vec3::X),
            40 => stance.feet_mut().iter_mut().for_each(Plant::release),
            50 => hand.release(),
            _ => {}
        }
        let mut play = |figure: &mut Figure, _: f32| {
            figure.edit(|local| {
                packed.sample(time, &mut cursor, local);
                Ok::<(), PoseError>(())
            })
        };
        let feet = &mut stance.on(ground);
        figure.run(world.dt, &mut [&mut play, feet, &mut poses, &mut recoil, &mut hand]).ok()?;
        for bone in figure.local() {
            hash.turns(&[bone.rotation]);
            bone.translation.to_array().into_iter().for_each(|x| hash.float(x));
        }

        skin.matrices(figure.model(), &mut matrices).ok()?;
        let weights = [0.5];
        let pose = MeshPose::new(&matrices).with_morph_weights(&weights);
        mesh.deform(&pose, &mut placed).ok()?;
        mesh.deform_normals(&pose, 1, &mut normals).ok()?;
        placed.iter().chain(&normals).flat_map(|vector| vector.to_array()).for_each(|x| hash.float(x));
        let hit = boxes.hit(&mesh, &pose, &Ray::segment(world.target, placed[frame as usize % 21])).ok()?;
        hash.float(hit.map_or(2.0, |hit| hit.part));

        let [hip, knee, ankle] = [1, 2, 3].map(|bone| Vec3::from(figure.model()[bone].translation));
        let mut leg = [CcdJoint::new(hip).with_stiffness(0.5).with_two_bones(), CcdJoint::new(knee)];
        hash.float(Ccd::new().solve(&mut leg, ankle, Vec3::new(0.1, 0.3, 0.1)).error);
        hash.turns(&leg.map(|joint| joint.turn));
    }
    Some(hash.0)
}

/// Returns a clip of four poses of the arm and the pelvis that aim to all sides.
fn poses() -> Option<Clip> {
    let about_y = |tangent: f32| {
        let [x, .., w] = turn(tangent).to_array();
        Quat::from_xyzw(0.0, x, 0.0, w)
    };
    let times = [0.0, 1.0, 2.0, 3.0];
    let headings = Track::linear(times, [-0.3, 0.3, -0.3, 0.3].map(about_y)).ok()?;
    let pitches = Track::linear(times, [-0.2, -0.2, 0.2, 0.2].map(turn)).ok()?;
    Some(Clip::new("aim").with_rotation(0, headings).with_rotation(4, pitches))
}
