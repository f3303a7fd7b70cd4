//! Characters spawned by Bevy's glTF loader and animated by Bevy's player, without a window or a renderer.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use aim_character::{Mannequin, PAPER_AXES};
use bevy_aim::aim::Role;
use bevy_aim::aim::glam::{DAffine3, DMat3, DQuat, DVec3, Quat, Vec3};
use bevy_aim::{AimCharacter, AimPlugin, AimStatus, AimSystems, AimTarget};
use bevy_animation::graph::{AnimationGraph, AnimationGraphHandle};
use bevy_animation::{AnimationPlayer, AnimationPlugin};
use bevy_app::{AnimationSystems, App, PostUpdate, TaskPoolPlugin};
use bevy_asset::io::memory::{Dir, MemoryAssetReader};
use bevy_asset::io::{AssetSourceBuilder, AssetSourceId};
use bevy_asset::{AssetApp, AssetEvent, AssetPlugin, AssetServer, Assets, Handle, LoadState};
use bevy_ecs::prelude::*;
use bevy_gltf::{Gltf, GltfAssetLabel, GltfPlugin};
use bevy_image::ImagePlugin;
use bevy_mesh::MeshPlugin;
use bevy_time::{TimePlugin, TimeUpdateStrategy};
use bevy_transform::TransformPlugin;
use bevy_transform::components::Transform;
use bevy_world_serialization::{WorldAsset, WorldAssetRoot, WorldSerializationPlugin};

use crate::stage::{FRAME, angle_deg, binding, drawn, hero, outcome, status};

/// The animated value of every transform, derived from its changes since the last frame was drawn. Independent of the
/// plugin's own record.
#[derive(Resource, Default)]
struct Animated {
    animated: HashMap<Entity, Transform>,
    drawn: HashMap<Entity, Transform>,
}

fn watch(transforms: Query<(Entity, &Transform)>, mut watched: ResMut<Animated>) {
    let Animated { animated, drawn } = &mut *watched;
    for (entity, now) in &transforms {
        let before = animated.entry(entity).or_insert(*now);
        let drawn = drawn.get(&entity);
        if drawn.is_none_or(|drawn| drawn.rotation != now.rotation) {
            before.rotation = now.rotation;
        }
        if drawn.is_none_or(|drawn| drawn.translation != now.translation) {
            before.translation = now.translation;
        }
        before.scale = now.scale;
    }
}

fn remember(transforms: Query<(Entity, &Transform)>, mut watched: ResMut<Animated>) {
    watched.drawn.extend(transforms.iter().map(|(entity, now)| (entity, *now)));
}

/// Returns an app that can load these files.
fn app(files: &[(&str, Vec<u8>)]) -> App {
    let root = Dir::default();
    for (name, bytes) in files {
        root.insert_asset(Path::new(name), bytes.clone());
    }
    let mut app = App::new();
    let source = AssetSourceBuilder::new(move || Box::new(MemoryAssetReader { root: root.clone() }));
    app.register_asset_source(AssetSourceId::Default, source);
    app.add_plugins((TaskPoolPlugin::default(), TimePlugin, TransformPlugin, AimPlugin::default()));
    app.add_plugins((AssetPlugin::default(), WorldSerializationPlugin, AnimationPlugin));
    app.add_plugins((MeshPlugin, ImagePlugin::default(), GltfPlugin::default()));
    app.insert_resource(TimeUpdateStrategy::ManualDuration(FRAME));
    app.init_resource::<Animated>().init_resource::<Kept>();
    app.add_systems(PostUpdate, watch.after(AnimationSystems).before(AimSystems));
    app.add_systems(PostUpdate, remember.after(AimSystems));
    // Register the component types of scenes, which Bevy's default plugins would do.
    app.world().resource::<AppTypeRegistry>().write().register_derived_types();
    app.finish();
    app.cleanup();
    app.update();
    app
}

/// Handles of the loaded files, which keep them loaded.
#[derive(Resource, Default)]
struct Kept(HashMap<String, Handle<Gltf>>);

/// Spawns a file's scene on an entity, as a game does. If two assets of a file are requested, Bevy loads the file twice
/// and then spawns the scene a second time.
fn spawn(app: &mut App, file: &str, character: AimCharacter, place: Transform) -> Entity {
    let assets = app.world().resource::<AssetServer>().clone();
    let gltf: Handle<Gltf> = assets.load(file.to_owned());
    app.world_mut().resource_mut::<Kept>().0.insert(file.to_owned(), gltf.clone());
    let scene = WorldAssetRoot(assets.load(GltfAssetLabel::Scene(0).from_asset(file.to_owned())));
    let root = app.world_mut().spawn((scene, character, place)).id();
    for _ in 0..4000 {
        app.update();
        if let Some(LoadState::Failed(why)) = assets.get_load_state(&gltf) {
            panic!("{file}: {why}");
        }
        let is_spawned = app.world().get::<Children>(root).is_some();
        if is_spawned && app.world().resource::<Assets<Gltf>>().contains(&gltf) {
            play(app, root, file);
            return root;
        }
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    panic!("{file} takes more than twenty seconds");
}

/// Plays a clip on every player that plays none: a walk or an idle clip if the file has one, otherwise its first. A
/// reloaded scene has a new player.
fn play(app: &mut App, root: Entity, file: &str) {
    let gltf = &app.world().resource::<Kept>().0[file];
    let gltf = app.world().resource::<Assets<Gltf>>().get(gltf).expect("a file");
    let is_calm = |name: &str| ["walk", "idle"].iter().any(|of| name.to_lowercase().contains(of));
    let mut calm: Vec<_> = gltf.named_animations.iter().filter(|(name, _)| is_calm(name)).collect();
    calm.sort_by_key(|(name, _)| *name);
    let Some(clip) = calm.first().map(|(_, clip)| *clip).or(gltf.animations.first()).cloned() else { return };
    for entity in below(app, root) {
        let mut entity = app.world_mut().entity_mut(entity);
        if entity.contains::<AnimationPlayer>() && !entity.contains::<AnimationGraphHandle>() {
            let (graph, node) = AnimationGraph::from_clip(clip.clone());
            let graph = entity.world_scope(|world| world.resource_mut::<Assets<AnimationGraph>>().add(graph));
            entity.insert(AnimationGraphHandle(graph));
            entity.get_mut::<AnimationPlayer>().expect("a player").play(node).repeat();
        }
    }
}

/// Returns an entity and all its descendants.
fn below(app: &App, root: Entity) -> Vec<Entity> {
    let mut found = vec![root];
    let mut next = 0;
    while let Some(&entity) = found.get(next) {
        found.extend(app.world().get::<Children>(entity).into_iter().flat_map(|children| children.iter()));
        next += 1;
    }
    found
}

fn affine(local: &Transform) -> DAffine3 {
    let turn = DMat3::from_quat(local.rotation.as_dquat().normalize());
    DAffine3::from_mat3_translation(turn * DMat3::from_diagonal(local.scale.as_dvec3()), local.translation.as_dvec3())
}

/// Returns a bone's transform in the space of one of its ancestors: as animated, and as drawn.
fn in_space_of(app: &App, bone: Entity, carrier: Entity) -> [DAffine3; 2] {
    let watched = app.world().resource::<Animated>();
    let mut place = [DAffine3::IDENTITY; 2];
    let mut at = bone;
    while at != carrier {
        let now = app.world().get::<Transform>(at).expect("a place");
        let local = [affine(&watched.animated[&at]), affine(now)];
        place = [local[0] * place[0], local[1] * place[1]];
        at = app.world().get::<ChildOf>(at).expect("it hangs on its carrier").parent();
    }
    place
}

/// Returns the effector's position and direction, as drawn by Bevy.
fn gaze(app: &App, character: Entity) -> [DVec3; 2] {
    let binding = binding(app, character);
    let effector = *binding.rig().description().effector();
    let eye = drawn(app, binding.joints().next().expect("a joint"));
    let [forward, origin] = [effector.forward, effector.origin].map(|v| Vec3::from(v).as_dvec3());
    [eye.transform_point3(origin), eye.transform_vector3(forward).normalize()]
}

/// Summary of the checks of a character that looked around.
#[derive(Debug, Default)]
struct Found {
    reached: usize,
    worst_deg: f64,
    held: usize,
}

/// Makes a character look at a target that circles in front of it and then stops, and checks each frame: a gaze with
/// status `Reached` is on the target as drawn by Bevy; no joint leaves its range or exceeds its rate; no region exceeds
/// its budget; and held bones stay with their carriers.
fn look(app: &mut App, name: &str, character: Entity, frames: u16) -> Found {
    let [eye, ahead] = gaze(app, character);
    let far = 1.2 * (eye - drawn(app, character).translation).length();
    let rig = binding(app, character).rig().clone();
    let description = rig.description();
    let mut angles = binding(app, character).angles().to_vec();
    let mut found = Found::default();
    for frame in 0..frames {
        let said = || format!("{name}, frame {frame}");
        let t = f32::from(frame) * FRAME.as_secs_f32();
        let angle = 0.6 * f64::from(t.min(0.5 * f32::from(frames) * FRAME.as_secs_f32()) * 1.5).sin();
        let target = eye + DQuat::from_rotation_y(angle) * ahead * far + DVec3::Y * (0.1 * far * angle);
        app.world_mut().entity_mut(character).insert(AimTarget::point(target.as_vec3()));
        play(app, character, name);
        app.update();
        let binding = binding(app, character);
        let joints: Vec<Entity> = binding.joints().collect();
        let (now, pose) = (binding.angles().to_vec(), binding.pose());
        let recovering = outcome(app, character).outcome.expect("an outcome").recovering;
        let mut sums = [[0.0_f32; 2]; 2];
        for (joint, info) in description.joints().iter().enumerate() {
            let [heading, pitch] = [now[joint].heading(), now[joint].pitch()];
            let most = info.rate * FRAME.as_secs_f32() + 1e-4;
            let turned = [heading - angles[joint].heading(), pitch - angles[joint].pitch()];
            assert!(turned.iter().all(|turned| turned.abs() <= most), "{}, joint {joint}: {turned:?}", said());
            let range = description.joint_range(joint, &pose).expect("a joint");
            let is_in = |angle: f32, [lo, hi]: [f32; 2]| angle >= lo.min(0.0) - 1e-3 && angle <= hi.max(0.0) + 1e-3;
            let is_inside = is_in(heading, range.heading()) && is_in(pitch, range.pitch_at(heading));
            assert!(is_inside || recovering.contains(joint), "{}, joint {joint} is out of its range", said());
            if let Role::Head | Role::Neck | Role::Chest = info.role {
                let sum = &mut sums[usize::from(info.role == Role::Chest)];
                *sum = [sum[0] + heading, sum[1] + pitch];
            }
            // The drawn rotation is the animated one times the correction.
            let animated = app.world().resource::<Animated>().animated[&joints[joint]].rotation;
            let expected = animated * binding.corrections()[joint];
            let off =
                app.world().get::<Transform>(joints[joint]).expect("a bone").rotation.as_dquat().normalize().inverse()
                    * expected.as_dquat().normalize();
            let off = 2.0 * off.xyz().length().min(1.0).asin().to_degrees();
            assert!(off < 0.005, "{}, joint {joint} is drawn {off} degrees from where it is aimed", said());
        }
        let budgets = description.budgets();
        for (sum, budget) in sums.into_iter().zip([budgets.head, budgets.chest]) {
            for (angle, [lo, hi]) in sum.into_iter().zip([budget.heading, budget.pitch]) {
                assert!(angle >= lo - 2e-3 && angle <= hi + 2e-3, "{}: a region turns by {angle}: {lo}…{hi}", said());
            }
        }
        angles = now;
        found.held += held(app, character, &joints, &said());
        if status(app, character).is_reached() {
            let [eye, looks] = gaze(app, character);
            let error = angle_deg(looks, target.as_vec3().as_dvec3() - eye);
            // Allowance for rounding: Bevy's world transforms are products of rounded local ones.
            const ROUNDED_DEG: f64 = 5e-4;
            assert!(error <= 0.1 + ROUNDED_DEG, "{}: {error} degrees off, said to be reached", said());
            (found.reached, found.worst_deg) = (found.reached + 1, found.worst_deg.max(error));
        }
    }
    found
}

/// Checks the rig's held bones, and returns their number.
fn held(app: &App, character: Entity, joints: &[Entity], said: &str) -> usize {
    let binding = binding(app, character);
    let description = binding.rig().description();
    let mut count = 0;
    for bone in binding.held() {
        let hangs_on = |joint: &usize| below(app, joints[*joint]).contains(&bone);
        let joint = (0..joints.len()).find(hangs_on).expect("it hangs on a joint");
        let Some(carrier) = description.carrier(joint) else { continue };
        let [animated, drawn] = in_space_of(app, bone, joints[carrier]);
        let size = animated.translation.length().max(1e-6);
        let moved = animated.translation.distance(drawn.translation) / size;
        let turned = angle_deg(animated.matrix3.y_axis, drawn.matrix3.y_axis);
        assert!(
            moved < 1e-4 && turned < 0.02,
            "{said}: a held bone moves by {moved} of its distance and {turned} degrees"
        );
        count += 1;
    }
    count
}

fn mannequin() -> Vec<u8> {
    Mannequin::new().with_moves().glb(|_| PAPER_AXES).expect("axes at right angles")
}

const PLACES: [Transform; 3] = [
    Transform::IDENTITY,
    Transform {
        translation: Vec3::new(3.0, 0.5, 1.0),
        rotation: Quat::from_xyzw(0.0, 0.841_471, 0.0, 0.540_302_3),
        scale: Vec3::splat(0.01),
    },
    Transform { translation: Vec3::ZERO, rotation: Quat::IDENTITY, scale: Vec3::new(-1.0, 1.0, 1.0) },
];

#[test]
fn a_loaded_mannequin_looks() {
    let mut app = app(&[("mannequin.glb", mannequin())]);
    for place in PLACES {
        let character = spawn(&mut app, "mannequin.glb", hero(), place);
        app.update();
        let found = look(&mut app, "mannequin.glb", character, 240);
        println!("{found:?}");
        assert!(found.reached > 120 && found.held == 2 * 240, "{found:?}");
        app.world_mut().entity_mut(character).despawn();
    }
}

/// A reloaded scene has new entities for all its bones.
#[test]
fn a_scene_that_is_loaded_anew_is_looked_at_from_where_it_was() {
    let mut app = app(&[("mannequin.glb", mannequin())]);
    let character = spawn(&mut app, "mannequin.glb", hero(), Transform::IDENTITY);
    let lamp = Vec3::new(0.9, 1.7, 1.5);
    app.world_mut().entity_mut(character).insert(AimTarget::point(lamp));
    for _ in 0..120 {
        app.update();
    }
    let eye = binding(&app, character).joints().next().expect("an eye");
    let angles = binding(&app, character).angles().to_vec();
    let file = app.world().resource::<Kept>().0["mannequin.glb"].clone();
    let scene = app.world().resource::<Assets<Gltf>>().get(&file).expect("a file").scenes[0].clone();
    app.world_mut().resource_mut::<Messages<AssetEvent<WorldAsset>>>().write(AssetEvent::Modified { id: scene.id() });
    let mut is_new = false;
    for frame in 0..30 {
        app.update();
        assert_eq!(status(&app, character), AimStatus::Reached, "frame {frame}");
        let now = binding(&app, character);
        for (was, now) in angles.iter().zip(now.angles()) {
            assert!((was.heading() - now.heading()).abs() < 0.1, "frame {frame}: {was:?}, then {now:?}");
        }
        is_new |= now.joints().next() != Some(eye);
        let [eye, looks] = gaze(&app, character);
        assert!(angle_deg(looks, lamp.as_dvec3() - eye) <= 0.1);
    }
    assert!(is_new && app.world().get_entity(eye).is_err());
}

/// Returns a GLB file with parts of its JSON replaced.
#[cfg(feature = "measure")]
fn changed(glb: &[u8], changes: &[(&str, &str)]) -> Vec<u8> {
    let number = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().expect("four bytes"));
    let end = 20 + number(12) as usize;
    let mut text = String::from_utf8(glb[20..end].to_vec()).expect("a text");
    for (old, new) in changes {
        assert_eq!(text.matches(old).count(), 1, "{old}");
        text = text.replace(old, new);
    }
    text += &" ".repeat(text.len().next_multiple_of(4) - text.len());
    let length = |bytes: usize| u32::try_from(bytes).expect("a small file").to_le_bytes();
    let total = length(20 + text.len() + glb.len() - end);
    [&glb[..8], &total, &length(text.len()), &glb[16..20], text.as_bytes(), &glb[end..]].concat()
}

/// In the changed file, a mesh has the name of the head, and the neck is bent in the rest pose.
#[cfg(feature = "measure")]
#[test]
fn a_skin_tells_which_are_bones_and_their_bind_pose() {
    let neck = "\"name\":\"neck\",\"translation\":[0.14000000059604645,0.0,0.0],\"rotation\":[0.0,0.0,0.0,1.0]";
    let bent = neck.replace("[0.0,0.0,0.0,1.0]", "[0.0,0.0,0.38268343,0.9238795]");
    let mesh = "{\"name\":\"body\",\"mesh\":0,\"skin\":0}";
    let changes = [(neck, &bent[..]), (mesh, &mesh.replace("body", "head"))];
    let files = [mannequin(), changed(&mannequin(), &changes)];
    let [straight, bent] = files.map(|file| {
        let mut app = app(&[("file.glb", file)]);
        let character = spawn(&mut app, "file.glb", AimCharacter::measured(), Transform::IDENTITY);
        app.update();
        app.update();
        let binding = binding(&app, character);
        let head = binding.joints().nth(1).expect("a head");
        let on = app.world().get::<ChildOf>(head).expect("a neck").parent();
        assert_eq!(app.world().get::<Name>(on).map(Name::as_str), Some("neck"));
        binding.pose().bind.expect("a bind pose").to_vec()
    });
    assert_eq!(straight.len(), 7);
    for (straight, bent) in straight.iter().zip(&bent) {
        assert!(straight.abs_diff_eq(*bent, 1e-4), "{bent:?} instead of {straight:?}");
    }
}

/// Tests characters from the folder in the environment variable `AIM_RIGS`.
#[cfg(feature = "measure")]
#[test]
fn real_files_look() {
    let Some(folder) = std::env::var_os("AIM_RIGS") else {
        println!("NOT TESTED: AIM_RIGS names no folder of real characters.");
        return;
    };
    let files = std::fs::read_dir(folder).expect("a folder");
    let is_model = |file: &PathBuf| file.extension().is_some_and(|of| of == "glb" || of == "gltf" || of == "vrm");
    let mut files: Vec<PathBuf> = files.map(|file| file.expect("a file").path()).filter(is_model).collect();
    files.sort();
    assert!(!files.is_empty(), "no characters there");
    for file in files {
        let name = file.file_name().expect("a name").to_string_lossy().into_owned();
        let mut app = app(&[(&name, std::fs::read(&file).expect("a file"))]);
        for place in PLACES {
            let character = spawn(&mut app, &name, AimCharacter::measured(), place);
            app.update();
            if let AimStatus::Unbound(why) = status(&app, character) {
                println!("NOT TESTED: {name}: {why}");
                continue;
            }
            let found = look(&mut app, &name, character, 120);
            println!("{name}: {found:?}");
            app.world_mut().entity_mut(character).despawn();
        }
    }
}
