//! Real characters, of the folder that the variable `AIM_RIGS` names: measured, and judged while their first clip plays and a target
//! goes round in front of them.

use std::path::PathBuf;

use aim_gltf::Document;
use bevy_aim::aim::animation::{Skeleton, Transform as Local};
use bevy_aim::aim::glam::{DQuat, DVec3, Quat, Vec3};
use bevy_aim::{AimCharacter, AimStatus, AimTarget};
use bevy_app::App;
use bevy_ecs::prelude::*;
use bevy_transform::components::Transform;

use crate::stage::{self, FRAME, binding, drawn, outcome, status, to_bevy};

fn spawn(app: &mut App, skeleton: &Skeleton, root: Transform) -> (Entity, Vec<Entity>) {
    let entity = app.world_mut().spawn((AimCharacter::measured(), root)).id();
    let mut bones: Vec<Entity> = Vec::new();
    for (bone, rest) in skeleton.rest().iter().enumerate() {
        let parent = skeleton.parents()[bone].map_or(entity, |parent| bones[parent]);
        let name = Name::new(skeleton.names()[bone].clone());
        bones.push(app.world_mut().spawn((name, to_bevy(rest), ChildOf(parent))).id());
    }
    (entity, bones)
}

/// The effector's place and direction, as Bevy draws it.
fn gaze(app: &App, character: Entity) -> [DVec3; 2] {
    let binding = binding(app, character);
    let effector = *binding.rig().description().effector();
    let eye = drawn(app, binding.joints().next().expect("a joint"));
    let [forward, origin] = [effector.forward, effector.origin].map(|v| Vec3::from(v).as_dvec3());
    [eye.transform_point3(origin), eye.transform_vector3(forward).normalize()]
}

/// The joints that are outside the ranges that the runtime tells for the pose, and not on their way back.
fn outside(app: &App, character: Entity) -> Vec<usize> {
    let binding = binding(app, character);
    let recovering = outcome(app, character).outcome.expect("an outcome").recovering;
    let (description, pose) = (binding.rig().description(), binding.pose());
    let is_outside = |joint: &usize| {
        let angles = binding.angles()[*joint];
        let range = description.joint_range(*joint, &pose).expect("a joint");
        let is_in = |angle: f32, [lo, hi]: [f32; 2]| angle >= lo.min(0.0) - 1e-3 && angle <= hi.max(0.0) + 1e-3;
        !is_in(angles.heading(), range.heading()) || !is_in(angles.pitch(), range.pitch_at(angles.heading()))
    };
    (0..binding.angles().len()).filter(is_outside).filter(|joint| !recovering.contains(*joint)).collect()
}

fn look(file: &PathBuf, root: Transform) {
    let document = Document::load(file).expect("a model");
    let skeleton: &Skeleton = document.skeleton();
    let mut app = stage::app();
    let (character, bones) = spawn(&mut app, skeleton, root);
    app.update();
    app.update();
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    if let AimStatus::Unbound(why) = status(&app, character) {
        println!("{name}: {why:?}");
        return;
    }
    let [eye, ahead] = gaze(&app, character);
    let far = 1.2 * (eye - drawn(&app, character).translation).length();
    let mut angles = binding(&app, character).angles().to_vec();
    let (mut reached, mut worst) = (0, 0.0_f64);
    for frame in 0..240_u16 {
        let t = f32::from(frame) * FRAME.as_secs_f32();
        if let Some(clip) = document.clips().first() {
            let mut pose: Vec<Local> = skeleton.rest().to_vec();
            clip.sample(t % clip.length_s().max(0.1), &mut clip.cursor(), &mut pose);
            for tracks in clip.tracks().iter().filter(|tracks| tracks.bone < bones.len()) {
                *app.world_mut().get_mut::<Transform>(bones[tracks.bone]).expect("a bone") =
                    to_bevy(&pose[tracks.bone]);
            }
        }
        // Halts in the second half.
        let angle = 0.5 * f64::from(t.min(2.0) * 1.5).sin();
        let turn = DQuat::from_rotation_y(angle);
        let target = eye + turn * ahead * far + DVec3::Y * (0.1 * far * angle);
        app.world_mut().entity_mut(character).insert(AimTarget::point(target.as_vec3()));
        app.update();
        let now = binding(&app, character).angles().to_vec();
        let rig = binding(&app, character).rig().clone();
        for (joint, info) in rig.description().joints().iter().enumerate() {
            let most = info.rate * FRAME.as_secs_f32() + 1e-4;
            let turned = [now[joint].heading() - angles[joint].heading(), now[joint].pitch() - angles[joint].pitch()];
            assert!(
                turned.iter().all(|turned| turned.abs() <= most),
                "{name}, frame {frame}, joint {joint}: {turned:?}"
            );
        }
        angles = now;
        assert_eq!(outside(&app, character), [0; 0], "{name}, frame {frame}");
        if status(&app, character) == AimStatus::Reached {
            let [eye, looks] = gaze(&app, character);
            let to = target.as_vec3().as_dvec3() - eye;
            let error = looks.cross(to.normalize()).length().atan2(looks.dot(to.normalize())).to_degrees();
            assert!(error <= 0.1, "{name}, frame {frame}: {error} degrees off, said to be reached");
            (reached, worst) = (reached + 1, worst.max(error));
        }
    }
    println!("{name}: reached in {reached} of 240 frames, at most {worst:.4} degrees off");
}

#[test]
fn real_characters_look() {
    let Some(folder) = std::env::var_os("AIM_RIGS") else {
        println!("NOT TESTED: AIM_RIGS names no folder of real characters.");
        return;
    };
    let files = std::fs::read_dir(folder).expect("a folder").map(|file| file.expect("a file").path());
    let is_model = |file: &PathBuf| file.extension().is_some_and(|of| of == "glb" || of == "gltf" || of == "vrm");
    let mut files: Vec<PathBuf> = files.filter(is_model).collect();
    files.sort();
    let mirrored = Transform { scale: Vec3::new(-1.0, 1.0, 1.0), ..Transform::IDENTITY };
    let turned = Transform::from_xyz(3.0, 0.5, 1.0).with_rotation(Quat::from_rotation_y(2.0));
    for file in &files {
        for root in [Transform::IDENTITY, turned.with_scale(Vec3::splat(0.01)), mirrored] {
            look(file, root);
        }
    }
    assert!(!files.is_empty(), "no characters there");
}
