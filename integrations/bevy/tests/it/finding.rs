//! Tests of finding bones: late, not at all, and again after a loss.

use std::sync::Mutex;

use bevy_aim::aim::glam::{DVec3, Quat, Vec3};
use bevy_aim::{AimBinding, AimCharacter, AimStatus, AimTarget, AimedBone, Unbound};
use bevy_ecs::prelude::*;
use bevy_transform::components::Transform;

use crate::stage::{self, FRAME, Hero, Player, bone, error_deg, hero, judge, spawn, status};

const LAMP: Vec3 = Vec3::new(0.5, 1.7, 2.0);

#[test]
fn bones_may_come_later() {
    let mut app = stage::app();
    let character = app.world_mut().spawn((hero(), AimTarget::point(LAMP), Transform::IDENTITY)).id();
    for _ in 0..3 {
        app.update();
        assert_eq!(status(&app, character), AimStatus::Unbound(Unbound::Bones));
    }
    // Insert another character's bones below the entity.
    let scene = spawn(&mut app, AimCharacter::of::<Hero>(), Transform::IDENTITY, 1.0);
    let bones = app.world_mut().entity_mut(scene).take::<Player>().expect("a player");
    app.world_mut().entity_mut(scene).remove::<AimCharacter>().insert(ChildOf(character));
    app.world_mut().entity_mut(character).insert(bones);
    for _ in 0..120 {
        app.update();
    }
    assert_eq!(status(&app, character), AimStatus::Reached);
    assert!(error_deg(&app, character, "left_eye", LAMP.as_dvec3()) < 0.1);
}

#[test]
fn what_is_missing_is_told() {
    let mut app = stage::app();
    let told = |app: &mut bevy_app::App, character: AimCharacter| {
        let entity = spawn(app, character, Transform::IDENTITY, 1.0);
        app.update();
        app.update();
        status(app, entity)
    };
    assert_eq!(told(&mut app, hero()), AimStatus::NoTarget);
    let unbound = AimStatus::Unbound;
    assert_eq!(told(&mut app, hero().with_bone(1, "Neck")), unbound(Unbound::Joint(1)));
    assert_eq!(told(&mut app, hero().with_bone(1, "spine1").with_bone(3, "neck")), unbound(Unbound::Order(2)));
    assert_eq!(told(&mut app, hero().with_other_eye("Right_Eye")), unbound(Unbound::OtherEye));
    assert_eq!(told(&mut app, hero().with_other_eye("left_eye")), unbound(Unbound::OtherEye));
    assert_eq!(told(&mut app, hero().with_trunk("Hips")), unbound(Unbound::Trunk));
    assert_eq!(told(&mut app, hero().with_held(1, "left_foot")), unbound(Unbound::Held));
    let wild = spawn(&mut app, hero(), Transform::IDENTITY, 1.0);
    let neck = bone(&app, wild, "neck");
    app.world_mut().get_mut::<Player>(wild).expect("a player").plays = false;
    app.world_mut().get_mut::<Transform>(neck).expect("a bone").rotation = Quat::from_xyzw(f32::NAN, 0.0, 0.0, 1.0);
    app.update();
    assert_eq!(status(&app, wild), unbound(Unbound::RestPose));
}

/// A logger that collects all messages.
struct Log(Mutex<Vec<String>>);

impl log::Log for Log {
    fn enabled(&self, _: &log::Metadata<'_>) -> bool {
        true
    }
    fn log(&self, record: &log::Record<'_>) {
        self.0.lock().expect("a list").push(record.args().to_string());
    }
    fn flush(&self) {}
}

/// A misspelt bone name is logged, once. A missing bone of a scene that may still be loading is not.
#[test]
fn what_stays_missing_is_logged() {
    static LOG: Log = Log(Mutex::new(Vec::new()));
    log::set_logger(&LOG).expect("no other test logs");
    log::set_max_level(log::LevelFilter::Warn);
    let mut app = stage::app();
    spawn(&mut app, hero().with_bone(1, "Jaw-of-no-one"), Transform::IDENTITY, 1.0);
    let waiting = app.world_mut().spawn((hero().with_bone(0, "Eye-to-come"), Transform::IDENTITY)).id();
    app.world_mut().spawn((Transform::IDENTITY, ChildOf(waiting)));
    for _ in 0..300 {
        app.update();
    }
    let logged = LOG.0.lock().expect("a list");
    let about = |name: &str| logged.iter().filter(|line| line.contains(name)).collect::<Vec<_>>();
    let [told] = about("Jaw-of-no-one")[..] else { panic!("{logged:?}") };
    assert!(told.contains("joint 1") && told.contains("with_bone"), "{told}");
    assert!(about("Eye-to-come").is_empty(), "{logged:?}");
}

/// For bones that are found late, when they are already animated, the bind pose is the one in which they appeared.
#[test]
fn the_bind_pose_is_that_in_which_bones_appear() {
    let mut app = stage::app();
    let late = spawn(&mut app, hero().with_bone(1, "Neck"), Transform::IDENTITY, 1.0);
    for _ in 0..30 {
        app.update();
    }
    assert_eq!(status(&app, late), AimStatus::Unbound(Unbound::Joint(1)));
    app.world_mut().entity_mut(late).insert(hero());
    let early = spawn(&mut app, hero(), Transform::IDENTITY, 1.0);
    app.update();
    let [late, early] = [late, early].map(|character| {
        let bind = stage::binding(&app, character).pose().bind.expect("a bind pose");
        bind[2].inverse() * bind[1]
    });
    assert!(late.abs_diff_eq(early, 1e-5), "{late:?} instead of {early:?}");
}

#[test]
fn a_name_that_repeats_is_told_by_a_path() {
    let mut app = stage::app();
    let character = spawn(&mut app, hero(), Transform::IDENTITY, 1.0);
    // The head lies between the eye and the spine, so under the name `neck` it is an equally valid candidate.
    let head = bone(&app, character, "head");
    app.world_mut().entity_mut(head).insert(Name::new("neck"));
    app.world_mut().entity_mut(character).insert(AimTarget::point(LAMP));
    app.update();
    assert_eq!(status(&app, character), AimStatus::Unbound(Unbound::Joint(1)));
    app.world_mut().entity_mut(character).insert(hero().with_bone(1, "spine2/spine3/neck"));
    for _ in 0..120 {
        app.update();
    }
    assert_eq!(status(&app, character), AimStatus::Reached);
}

/// Meshes often have the names of the bones that move them, and other parents.
#[test]
fn of_several_of_a_name_the_one_in_the_chain_is_meant() {
    let mut app = stage::app();
    let character = spawn(&mut app, hero(), Transform::IDENTITY, 1.0);
    let [hand, armature] = ["left_hand", "hips"].map(|name| bone(&app, character, name));
    let armature = app.world().get::<ChildOf>(armature).expect("an armature").parent();
    for name in ["left_eye", "right_eye", "neck", "spine1", "hips"] {
        for on in [hand, armature, character] {
            app.world_mut().spawn((Name::new(name), Transform::IDENTITY, ChildOf(on)));
        }
    }
    app.world_mut().spawn((Name::new("left_clavicle"), Transform::IDENTITY, ChildOf(armature)));
    app.world_mut().entity_mut(character).insert(AimTarget::point(LAMP));
    for _ in 0..120 {
        app.update();
        judge(&app, character, None, 0.0);
    }
    assert_eq!(status(&app, character), AimStatus::Reached);
    for eye in ["left_eye", "right_eye"] {
        assert!(error_deg(&app, character, eye, LAMP.as_dvec3()) < 0.1);
    }
}

#[test]
fn the_other_eye_is_that_of_the_rig_or_of_the_user() {
    let mut app = stage::app();
    let alone = spawn(&mut app, hero().without_other_eye(), Transform::IDENTITY, 1.0);
    let follows = spawn(&mut app, hero().with_following_eye("right_eye"), Transform::IDENTITY, 1.0);
    for character in [alone, follows] {
        app.world_mut().get_mut::<Player>(character).expect("a player").plays = false;
        app.world_mut().entity_mut(character).insert(AimTarget::point(Vec3::new(0.3, 1.7, 0.5)));
    }
    for _ in 0..60 {
        app.update();
    }
    for (character, turns) in [(alone, false), (follows, true)] {
        let eye = bone(&app, character, "right_eye");
        let rest = stage::to_bevy(&stage::skeleton().rest()[stage::skeleton().find("right_eye").expect("a bone")]);
        assert_eq!(app.world().get::<Transform>(eye).expect("a bone").rotation != rest.rotation, turns);
        assert_eq!(stage::binding(&app, character).other_eye_correction(), None);
        assert!(error_deg(&app, character, "right_eye", DVec3::new(0.3, 1.7, 0.5)) > 0.5, "it does not converge");
    }
}

#[test]
fn a_rider_is_not_its_horse() {
    let mut app = stage::app();
    let horse = spawn(&mut app, hero(), Transform::IDENTITY, 1.0);
    let rider = spawn(&mut app, hero(), Transform::from_xyz(0.0, 1.0, 0.0), 1.0);
    let saddle = bone(&app, horse, "spine1");
    app.world_mut().entity_mut(rider).insert(ChildOf(saddle));
    for character in [horse, rider] {
        app.world_mut().entity_mut(character).insert(AimTarget::point(LAMP));
    }
    for _ in 0..120 {
        app.update();
    }
    let bones = |character| app.world().get::<AimBinding>(character).expect("bones").joints().collect::<Vec<_>>();
    assert_eq!(bones(horse)[0], bone(&app, horse, "left_eye"));
    assert_eq!(bones(rider)[0], bone(&app, rider, "left_eye"));
    assert_eq!(status(&app, horse), AimStatus::Reached);
    assert!(error_deg(&app, horse, "left_eye", LAMP.as_dvec3()) < 0.1);
}

#[test]
fn a_lost_bone_lets_go_of_the_others_until_it_is_back() {
    let mut app = stage::app();
    let character = spawn(&mut app, hero(), Transform::IDENTITY, 1.0);
    app.world_mut().get_mut::<Player>(character).expect("a player").plays = false;
    app.world_mut().entity_mut(character).insert(AimTarget::point(Vec3::new(1.5, 1.7, 1.0)));
    for _ in 0..120 {
        app.update();
    }
    assert_eq!(status(&app, character), AimStatus::Reached);
    let (eye, neck, head) =
        (bone(&app, character, "left_eye"), bone(&app, character, "neck"), bone(&app, character, "head"));
    let rest = app.world().get::<Player>(character).expect("a player").animated.clone();
    let rest_of = |name: &str| rest[stage::skeleton().find(name).expect("a bone")];
    assert!(app.world().get::<Transform>(neck).expect("a bone").rotation != rest_of("neck").rotation);
    // Reparent the eye to the character's root.
    app.world_mut().entity_mut(eye).insert(ChildOf(character));
    app.update();
    assert!(matches!(status(&app, character), AimStatus::Unbound(_)));
    assert_eq!(app.world().get::<Transform>(neck).expect("a bone").rotation, rest_of("neck").rotation);
    assert!(app.world().get::<AimedBone>(neck).is_none());
    app.update();
    app.update();
    assert_eq!(status(&app, character), AimStatus::Unbound(Unbound::Order(1)));
    app.world_mut().entity_mut(eye).insert(ChildOf(head));
    app.world_mut().entity_mut(character).insert(hero());
    for _ in 0..120 {
        app.update();
    }
    assert_eq!(status(&app, character), AimStatus::Reached);
    // Despawn the eye.
    app.world_mut().entity_mut(eye).despawn();
    for _ in 0..5 {
        app.update();
    }
    assert_eq!(status(&app, character), AimStatus::Unbound(Unbound::Joint(0)));
}

#[test]
fn without_the_component_bones_are_as_animated() {
    let mut app = stage::app();
    let character = spawn(&mut app, hero(), Transform::IDENTITY, 1.0);
    app.world_mut().entity_mut(character).insert(AimTarget::point(Vec3::new(1.5, 1.7, 1.0)));
    for _ in 0..60 {
        app.update();
    }
    app.world_mut().get_mut::<Player>(character).expect("a player").plays = false;
    app.update();
    app.world_mut().entity_mut(character).remove::<AimCharacter>();
    app.update();
    let player = app.world().get::<Player>(character).expect("a player");
    for (&bone, animated) in player.bones.iter().zip(&player.animated) {
        assert_eq!(*app.world().get::<Transform>(bone).expect("a bone"), stage::to_bevy(animated));
        assert!(app.world().get::<AimedBone>(bone).is_none());
    }
    assert!(app.world().get::<AimBinding>(character).is_none());
    // Insert the component again: the character starts from its animated pose.
    app.world_mut().entity_mut(character).insert(hero());
    let mut judged = None;
    for _ in 0..120 {
        app.update();
        judged = Some(judge(&app, character, judged.as_ref(), FRAME.as_secs_f64()));
    }
    assert_eq!(status(&app, character), AimStatus::Reached);
}

#[test]
fn characters_come_and_go() {
    let mut app = stage::app();
    for round in 0..20 {
        let character = spawn(&mut app, hero(), Transform::IDENTITY, 1.0);
        app.world_mut().entity_mut(character).insert(AimTarget::point(LAMP));
        for _ in 0..round % 4 {
            app.update();
        }
        app.world_mut().entity_mut(character).despawn();
        app.update();
    }
    let left = app.world_mut().query::<&AimedBone>().iter(app.world()).count();
    assert_eq!(left, 0);
}

#[cfg(feature = "measure")]
#[test]
fn a_measured_character_looks() {
    let mut app = stage::app();
    let characters =
        [1.0, 0.01].map(|scale| spawn(&mut app, AimCharacter::measured(), Transform::from_xyz(scale, 0.0, 0.0), scale));
    for character in characters {
        app.world_mut().entity_mut(character).insert(AimTarget::point(LAMP));
    }
    let mut reached = 0;
    for _ in 0..180 {
        app.update();
        for character in characters {
            if status(&app, character) == AimStatus::Reached {
                reached += 1;
                for eye in ["left_eye", "right_eye"] {
                    let error = error_deg(&app, character, eye, LAMP.as_dvec3());
                    assert!(error <= 0.1, "{eye}: {error}°");
                }
            }
        }
    }
    assert!(reached > 250, "{reached}");
    let binding = stage::binding(&app, characters[0]);
    assert_eq!(binding.joints().count(), 7);
    // A scene without eyes, head or neck cannot be measured.
    let lamp = app.world_mut().spawn((AimCharacter::measured(), Transform::IDENTITY)).id();
    app.world_mut().spawn((Name::new("Lampshade"), Transform::IDENTITY, ChildOf(lamp)));
    app.update();
    assert_eq!(status(&app, lamp), AimStatus::Unbound(Unbound::Measurement));
}

#[cfg(feature = "assets")]
#[test]
fn a_rig_may_be_loaded_and_changed() {
    use bevy_aim::{AimPlugin, AimRigAsset};
    use bevy_app::{App, TaskPoolPlugin};
    use bevy_asset::{AssetPlugin, AssetServer, Assets, Handle};

    let folder = format!("{}/rigs", env!("CARGO_TARGET_TMPDIR"));
    std::fs::create_dir_all(&folder).expect("a folder");
    std::fs::write(format!("{folder}/hero.aim.toml"), aim_character::MANNEQUIN_RIG).expect("a file");
    std::fs::write(format!("{folder}/wrong.aim.toml"), "name = 3").expect("a file");
    let mut app = App::new();
    // The plugin may be added before the asset plugin.
    app.add_plugins((AimPlugin::default(), TaskPoolPlugin::default()));
    app.add_plugins(AssetPlugin { file_path: folder, ..AssetPlugin::default() });
    stage::add(&mut app);
    let [handle, wrong]: [Handle<AimRigAsset>; 2] =
        ["hero.aim.toml", "wrong.aim.toml"].map(|file| app.world().resource::<AssetServer>().load(file));
    let character = spawn(&mut app, AimCharacter::from_asset(handle.clone()), Transform::IDENTITY, 1.0);
    let other = spawn(&mut app, AimCharacter::from_asset(wrong), Transform::IDENTITY, 1.0);
    app.world_mut().entity_mut(character).insert(AimTarget::point(LAMP));
    let until = |app: &mut App, is_so: &dyn Fn(&App) -> bool| {
        for _ in 0..2000 {
            app.update();
            if is_so(app) {
                return;
            }
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        panic!("it takes more than ten seconds");
    };
    until(&mut app, &|app| status(app, character) == AimStatus::Reached);
    assert!(error_deg(&app, character, "left_eye", LAMP.as_dvec3()) < 0.1);
    assert!(error_deg(&app, character, "right_eye", LAMP.as_dvec3()) < 0.1, "the file names it");
    assert_eq!(status(&app, other), AimStatus::Unbound(Unbound::Rig));
    // Replace the asset, as Bevy does when a watched file changes.
    let one = aim_character::MANNEQUIN_RIG.replace("bone = \"neck\"", "bone = \"head\"");
    let changed = AimRigAsset::from_toml("hero", &one).expect("a rig");
    app.world_mut().resource_mut::<Assets<AimRigAsset>>().insert(&handle, changed).expect("a place");
    let head = bone(&app, character, "head");
    until(&mut app, &|app| {
        app.world().get::<AimBinding>(character).is_some_and(|binding| binding.joints().nth(1) == Some(head))
    });
    let said = AimRigAsset::from_toml("wrong", "name = 3").map(|_| ()).expect_err("no rig").to_string();
    assert!(said.contains("wrong"), "{said}");
}
