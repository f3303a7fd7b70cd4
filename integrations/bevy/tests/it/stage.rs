//! Test fixture: an app, mannequins with a minimal animation player, and checks that do not use the plugin's internals.

use std::sync::{Arc, LazyLock};
use std::time::Duration;

use aim_character::{Mannequin, PAPER_AXES};
use aim_gltf::Document;
use bevy_aim::aim::animation::{Clip, Skeleton, Transform as Local};
use bevy_aim::aim::glam::{DAffine3, DMat3, DQuat, DVec3, Quat, Vec3};
use bevy_aim::aim::{AimRig, Joint, Role};
use bevy_aim::{AimBinding, AimCharacter, AimOutcome, AimPlugin, AimStatus};
use bevy_app::{AnimationSystems, App, PostUpdate, TaskPoolPlugin};
use bevy_ecs::prelude::*;
use bevy_time::{Time, TimePlugin, TimeUpdateStrategy};
use bevy_transform::TransformPlugin;
use bevy_transform::components::{GlobalTransform, Transform};

/// A rig of the mannequin's eye, neck and two spine bones. The bones point +X up, +Y forward, +Z left. The collar bones
/// are children of the upper spine bone and are held by the lower one.
#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z), region = human)]
pub(crate) struct Hero {
    #[joint(bone = "left_eye", role = eye, heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg, stiffness = 0.5, other_eye = "right_eye")]
    pub(crate) eye: Joint,
    #[joint(bone = "neck", role = neck, heading = -60deg..=60deg, pitch = -40deg..=35deg, rate = 170deg)]
    pub(crate) neck: Joint,
    #[joint(bone = "spine3", role = chest, heading = -20deg..=20deg, pitch = -10deg..=10deg, rate = 70deg, hold = ["left_clavicle", "right_clavicle"])]
    pub(crate) chest: Joint,
    #[joint(bone = "spine1", role = chest, heading = -15deg..=15deg, pitch = -10deg..=10deg, rate = 60deg)]
    pub(crate) belly: Joint,
}

/// Duration of a frame at 60 Hz.
pub(crate) const FRAME: Duration = Duration::from_nanos(16_666_667);

pub(crate) static MANNEQUIN: LazyLock<Document> = LazyLock::new(|| {
    let file = Mannequin::new().with_moves().glb(|_| PAPER_AXES).expect("axes at right angles");
    Document::from_bytes(&file).expect("a file")
});

pub(crate) fn skeleton() -> &'static Skeleton {
    MANNEQUIN.skeleton()
}

pub(crate) fn clip(name: &str) -> Arc<Clip> {
    Arc::new(MANNEQUIN.clip(name).expect("a clip").clone())
}

/// Plays a clip, or two during a cross-fade. Like Bevy's player, it writes only bones that have a track.
#[derive(Component)]
pub(crate) struct Player {
    pub(crate) clip: Arc<Clip>,
    pub(crate) next: Option<(Arc<Clip>, f32)>,
    pub(crate) plays: bool,
    pub(crate) seconds: f32,
    pub(crate) bones: Vec<Entity>,
    /// Factor applied to translations.
    pub(crate) unit: f32,
    /// Local transform of each bone as last written by the player; its rest transform before that.
    pub(crate) animated: Vec<Local>,
}

fn play(time: Res<Time>, mut players: Query<&mut Player>, mut transforms: Query<&mut Transform>) {
    for mut player in &mut players {
        if !player.plays {
            continue;
        }
        player.seconds += time.delta_secs();
        let looped = |clip: &Clip, seconds: f32| {
            let mut pose = skeleton().rest().to_vec();
            clip.sample(seconds.rem_euclid(clip.length_s()), &mut clip.cursor(), &mut pose);
            pose
        };
        let mut pose = looped(&player.clip, player.seconds);
        let mut tracks: Vec<usize> = player.clip.tracks().iter().map(|tracks| tracks.bone).collect();
        if let Some((next, weight)) = &player.next {
            for (bone, (to, from)) in looped(next, player.seconds).iter().zip(&mut pose).enumerate() {
                from.translation = from.translation.lerp(to.translation, *weight);
                from.rotation = from.rotation.slerp(to.rotation, *weight);
                if next.bone(bone).is_some() && !tracks.contains(&bone) {
                    tracks.push(bone);
                }
            }
        }
        for bone in tracks {
            let mut local = pose[bone];
            local.translation *= player.unit;
            // The clip's motion of the hips is dropped, because tests move the root themselves.
            if skeleton().names()[bone] == "hips" {
                local.translation = skeleton().rest()[bone].translation * player.unit;
            }
            let mut transform = transforms.get_mut(player.bones[bone]).expect("a bone");
            *transform = to_bevy(&local);
            player.animated[bone] = local;
        }
    }
}

pub(crate) fn to_bevy(local: &Local) -> Transform {
    Transform { translation: local.translation, rotation: local.rotation, scale: local.scale }
}

/// Returns an app in which each frame takes [`FRAME`].
pub(crate) fn app() -> App {
    app_with(AimPlugin::default())
}

pub(crate) fn app_with(plugin: AimPlugin) -> App {
    let mut app = App::new();
    app.add_plugins((TaskPoolPlugin::default(), plugin));
    add(&mut app);
    app
}

/// Adds everything but the task pools, the plugin and assets.
pub(crate) fn add(app: &mut App) {
    app.add_plugins((TimePlugin, TransformPlugin));
    app.insert_resource(TimeUpdateStrategy::ManualDuration(FRAME));
    app.add_systems(PostUpdate, play.in_set(AnimationSystems));
    // The first frame has a duration of zero.
    app.finish();
    app.update();
}

/// Spawns the mannequin's bones below an armature below the character's entity, in units of `scale` metres.
pub(crate) fn spawn(app: &mut App, character: AimCharacter, root: Transform, scale: f32) -> Entity {
    let unit = 1.0 / scale;
    let entity = app.world_mut().spawn((character, root)).id();
    let armature =
        app.world_mut().spawn((Name::new("Armature"), Transform::from_scale(Vec3::splat(scale)), ChildOf(entity))).id();
    let mut bones: Vec<Entity> = Vec::new();
    let mut animated = Vec::new();
    for (bone, rest) in skeleton().rest().iter().enumerate() {
        let parent = skeleton().parents()[bone].map_or(armature, |parent| bones[parent]);
        let mut rest = *rest;
        rest.translation *= unit;
        let name = Name::new(skeleton().names()[bone].clone());
        bones.push(app.world_mut().spawn((name, to_bevy(&rest), ChildOf(parent))).id());
        animated.push(rest);
    }
    let player = Player { clip: clip("walk"), next: None, plays: true, seconds: 0.0, bones, unit, animated };
    app.world_mut().entity_mut(entity).insert(player);
    entity
}

pub(crate) fn hero() -> AimCharacter {
    AimCharacter::of::<Hero>().with_trunk("hips")
}

pub(crate) fn bone(app: &App, character: Entity, name: &str) -> Entity {
    let bones = &app.world().get::<Player>(character).expect("a character").bones;
    bones[skeleton().find(name).expect("a bone")]
}

pub(crate) fn outcome(app: &App, character: Entity) -> &AimOutcome {
    app.world().get(character).expect("an outcome")
}

pub(crate) fn status(app: &App, character: Entity) -> AimStatus {
    outcome(app, character).status
}

/// Returns an entity's world transform, as drawn by Bevy.
pub(crate) fn drawn(app: &App, entity: Entity) -> DAffine3 {
    app.world().get::<GlobalTransform>(entity).expect("a place").affine().as_daffine3()
}

/// Returns the angle between an eye's direction, as drawn by Bevy, and the direction to a point, degrees.
pub(crate) fn error_deg(app: &App, character: Entity, eye: &str, target: DVec3) -> f64 {
    let eye = drawn(app, bone(app, character, eye));
    angle_deg(eye.matrix3.y_axis, target - eye.translation)
}

/// Returns the angle between two vectors, degrees.
pub(crate) fn angle_deg(a: DVec3, b: DVec3) -> f64 {
    let (a, b) = (a.normalize(), b.normalize());
    a.cross(b).length().atan2(a.dot(b)).to_degrees()
}

/// Returns the heading and pitch of a bone's rotation, degrees.
fn angles_deg(turn: DQuat) -> [f64; 2] {
    let ahead = turn * DVec3::Y;
    [ahead.z.atan2(ahead.y).to_degrees(), ahead.x.atan2(ahead.z.hypot(ahead.y)).to_degrees()]
}

/// The angles of a character's joints in a frame, computed from Bevy's transforms alone.
#[derive(Clone)]
pub(crate) struct Judged {
    pub(crate) angles_deg: Vec<[f64; 2]>,
}

/// Panics if a joint has left its range or exceeded its rate, a region has exceeded its budget, or a held bone has
/// moved relative to its carrier. Ranges are relative to the animation, as declared.
pub(crate) fn judge(app: &App, character: Entity, before: Option<&Judged>, dt: f64) -> Judged {
    let player = app.world().get::<Player>(character).expect("a character");
    let local = |bone: usize| *app.world().get::<Transform>(player.bones[bone]).expect("a bone");
    let description = *Hero::DESCRIPTION;
    let mut angles = Vec::new();
    let mut sums: [[f64; 2]; 2] = [[0.0; 2]; 2];
    for (joint, name) in ["left_eye", "neck", "spine3", "spine1"].into_iter().enumerate() {
        let bone = skeleton().find(name).expect("a bone");
        let turn = player.animated[bone].rotation.as_dquat().inverse() * local(bone).rotation.as_dquat();
        let [heading, pitch] = angles_deg(turn.normalize());
        let info = description.joints()[joint];
        for (angle, range) in [(heading, info.heading), (pitch, info.pitch)] {
            let [lo, hi] = range.unwrap_or_default().map(|end| f64::from(end).to_degrees());
            assert!((lo - 0.02..=hi + 0.02).contains(&angle), "{name}: {angle}° is not in {lo}°…{hi}°");
        }
        if let Some(before) = before {
            let most = f64::from(info.rate).to_degrees() * dt + 0.02;
            for (now, was) in [heading, pitch].into_iter().zip(before.angles_deg[joint]) {
                assert!((now - was).abs() <= most, "{name}: from {was}° to {now}°, at most {most}°");
            }
        }
        if joint > 0 {
            let region = &mut sums[usize::from(info.role == Role::Chest)];
            *region = [region[0] + heading, region[1] + pitch];
        }
        angles.push([heading, pitch]);
    }
    let budgets = description.budgets();
    for (sum, budget) in sums.into_iter().zip([budgets.head, budgets.chest]) {
        for (angle, range) in sum.into_iter().zip([budget.heading, budget.pitch]) {
            let [lo, hi] = range.map(|end| f64::from(end).to_degrees());
            assert!((lo - 0.05..=hi + 0.05).contains(&angle), "a region: {angle}° is not in {lo}°…{hi}°");
        }
    }
    held(player, &local);
    Judged { angles_deg: angles }
}

/// Checks that the collar bones keep their animated transform relative to the lower spine bone.
fn held(player: &Player, local: &dyn Fn(usize) -> Transform) {
    let carrier = skeleton().find("spine1").expect("a bone");
    for name in ["left_clavicle", "right_clavicle"] {
        let held = skeleton().find(name).expect("a bone");
        let below = |of: &dyn Fn(usize) -> DAffine3| {
            skeleton()
                .ancestry(held)
                .take_while(|bone| *bone != carrier)
                .fold(DAffine3::IDENTITY, |place, bone| of(bone) * place)
        };
        let affine = |translation: Vec3, rotation: Quat| {
            DAffine3::from_mat3_translation(DMat3::from_quat(rotation.as_dquat().normalize()), translation.as_dvec3())
        };
        let aimed = below(&|bone| affine(local(bone).translation, local(bone).rotation));
        let animated = below(&|bone| affine(player.animated[bone].translation, player.animated[bone].rotation));
        let moved = aimed.translation.distance(animated.translation) / f64::from(player.unit);
        let turned = (aimed.matrix3.y_axis - animated.matrix3.y_axis).length();
        assert!(moved < 2e-5 && turned < 2e-5, "{name} moved by {moved} m, turned by {turned}");
    }
}

/// Returns the plugin's state of a character.
pub(crate) fn binding(app: &App, character: Entity) -> &AimBinding {
    app.world().get(character).expect("a character whose bones are found")
}
