//! The time that the systems of [`AimPlugin`] take for 2 000 mannequins that walk and look around, on one thread and on two: medians
//! of seven runs, and their ratio. Of a run it is the frame that a tenth of the frames are faster than, as others may use the machine.

use std::sync::Mutex;
use std::time::{Duration, Instant};

use aim::animation::{Clip, Skeleton};
use aim::{AimRig, Joint};
use aim_character::{PAPER_AXES, mannequin};
use aim_gltf::Document;
use bevy_aim::{AimCharacter, AimPlugin, AimSystems, AimTarget};
use bevy_app::{AnimationSystems, App, PostUpdate, TaskPoolOptions, TaskPoolPlugin, TaskPoolThreadAssignmentPolicy};
use bevy_ecs::prelude::*;
use bevy_math::Vec3;
use bevy_time::{TimePlugin, TimeUpdateStrategy};
use bevy_transform::TransformPlugin;
use bevy_transform::components::Transform;

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z), region = human)]
struct Walker {
    #[joint(bone = "left_eye", role = eye, heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg, stiffness = 0.5)]
    eye: Joint,
    #[joint(bone = "neck", role = neck, heading = -60deg..=60deg, pitch = -40deg..=35deg, rate = 170deg)]
    neck: Joint,
    #[joint(bone = "spine3", role = chest, heading = -20deg..=20deg, pitch = -10deg..=10deg, rate = 70deg, stiffness = 4.0)]
    chest: Joint,
}

const CHARACTERS: usize = 2000;
const FRAMES: u16 = 60;
const RUNS: usize = 7;

/// When the systems began in this frame, and what they have taken in each.
static CLOCK: Mutex<(Option<Instant>, Vec<Duration>)> = Mutex::new((None, Vec::new()));

#[derive(Resource)]
struct Walk {
    skeleton: Skeleton,
    clip: Clip,
    seconds: f32,
}

#[derive(Component)]
struct Bone(usize);

fn play(mut walk: ResMut<Walk>, mut bones: Query<(&Bone, &mut Transform)>) {
    walk.seconds = (walk.seconds + 1.0 / 60.0) % walk.clip.length_s();
    let mut pose = walk.skeleton.rest().to_vec();
    walk.clip.sample(walk.seconds, &mut walk.clip.cursor(), &mut pose);
    for (bone, mut transform) in &mut bones {
        let local = pose[bone.0];
        *transform = Transform { translation: local.translation, rotation: local.rotation, scale: local.scale };
    }
}

/// Seconds that the systems take in a frame.
fn run(threads: usize) -> f64 {
    let file = mannequin(|_| PAPER_AXES).expect("axes at right angles");
    let document = Document::from_bytes(&file).expect("a file");
    let skeleton: &Skeleton = document.skeleton();
    let mut app = App::new();
    // Nothing else wants a thread of its own.
    let none = TaskPoolThreadAssignmentPolicy {
        min_threads: 1,
        max_threads: 1,
        percent: 0.0,
        on_thread_spawn: None,
        on_thread_destroy: None,
    };
    let compute =
        TaskPoolThreadAssignmentPolicy { min_threads: threads, max_threads: threads, percent: 1.0, ..none.clone() };
    let options = TaskPoolOptions {
        min_total_threads: threads + 2,
        max_total_threads: threads + 2,
        io: none.clone(),
        async_compute: none,
        compute,
    };
    app.add_plugins((TaskPoolPlugin { task_pool_options: options }, TimePlugin, TransformPlugin, AimPlugin::default()));
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_nanos(16_666_667)));
    app.insert_resource(Walk {
        skeleton: skeleton.clone(),
        clip: document.clip("walk").expect("a clip").clone(),
        seconds: 0.0,
    });
    let began = || CLOCK.lock().expect("a clock").0 = Some(Instant::now());
    let ended = || {
        let mut clock = CLOCK.lock().expect("a clock");
        if let Some(began) = clock.0.take() {
            clock.1.push(began.elapsed());
        }
    };
    app.add_systems(PostUpdate, play.in_set(AnimationSystems));
    app.add_systems(PostUpdate, began.after(AnimationSystems).before(AimSystems));
    app.add_systems(PostUpdate, ended.after(AimSystems).before(bevy_transform::TransformSystems::Propagate));
    let lamp = app.world_mut().spawn(Transform::from_xyz(0.0, 1.6, 40.0)).id();
    for number in 0..CHARACTERS {
        let place = Transform::from_xyz((number % 50) as f32 - 25.0, 0.0, (number / 50) as f32 - 20.0);
        let root = app.world_mut().spawn((AimCharacter::of::<Walker>(), AimTarget::entity(lamp), place)).id();
        let mut bones: Vec<Entity> = Vec::new();
        for (bone, name) in skeleton.names().iter().enumerate() {
            let parent = skeleton.parents()[bone].map_or(root, |parent| bones[parent]);
            bones.push(
                app.world_mut().spawn((Name::new(name.clone()), Bone(bone), Transform::IDENTITY, ChildOf(parent))).id(),
            );
        }
    }
    for _ in 0..10 {
        app.update();
    }
    CLOCK.lock().expect("a clock").1.clear();
    for frame in 0..FRAMES {
        let angle = f32::from(frame) * 0.05;
        app.world_mut().get_mut::<Transform>(lamp).expect("a lamp").translation =
            Vec3::new(30.0 * angle.sin(), 1.6, 40.0);
        app.update();
    }
    let mut frames = std::mem::take(&mut CLOCK.lock().expect("a clock").1);
    frames.sort();
    frames[frames.len() / 10].as_secs_f64()
}

/// A process each: Bevy's pools are made once.
fn main() {
    let mut arguments = std::env::args().skip(1);
    if arguments.next().as_deref() == Some("--threads") {
        let threads = arguments.next().and_then(|threads| threads.parse().ok()).expect("a number");
        println!("{}", run(threads));
        return;
    }
    let program = std::env::current_exe().expect("a program");
    let measured = |threads: usize| {
        let run =
            std::process::Command::new(&program).args(["--threads", &threads.to_string()]).output().expect("a run");
        String::from_utf8_lossy(&run.stdout).trim().parse::<f64>().expect("seconds")
    };
    // By turns, so that what else the machine does slows both.
    let mut runs = [Vec::new(), Vec::new()];
    for _ in 0..RUNS {
        for (threads, runs) in runs.iter_mut().enumerate() {
            runs.push(measured(threads + 1));
        }
    }
    let [one, two] = runs.map(|mut runs| {
        runs.sort_by(f64::total_cmp);
        runs[RUNS / 2]
    });
    println!(
        "{CHARACTERS} characters, a frame: {:.2} ms on one thread, {:.2} ms on two: {:.2} times as fast",
        one * 1e3,
        two * 1e3,
        one / two
    );
}
