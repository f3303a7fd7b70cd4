//! Measures the systems of [`AimPlugin`] for 2 000 mannequins that walk and look around, on one thread and on two, in
//! seven pairs of runs. Prints three ratios, because other processes may use the machine:
//!
//! - the median over the pairs, each run represented by the 10th percentile of its frame times: the gain on this
//!   machine at present;
//! - the fastest frame of all runs on one thread, divided by the fastest on two;
//! - on Linux, the medians of the frames in which no thread waited for a processor: the gain with two free processors.

use std::fs::File;
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
const FRAMES: u16 = 240;
const RUNS: usize = 7;
/// Least number of undisturbed frames for which a median is printed.
const LEAST: usize = 20;

/// Longest wait for a processor, summed over all threads, of a frame that counts as undisturbed.
const UNDISTURBED: Duration = Duration::from_micros(100);

static CLOCK: Mutex<Clock> = Mutex::new(Clock { began: None, frames: Vec::new(), threads: Vec::new() });

/// Frame times of the measured systems.
struct Clock {
    /// Start of the systems in this frame, and the time that threads had waited for a processor by then.
    began: Option<(Instant, Duration)>,
    /// Duration of each frame, and the time that threads had waited before it.
    frames: Vec<(Duration, Duration)>,
    /// The kernel's `schedstat` file of each thread.
    threads: Vec<File>,
}

impl Clock {
    fn begin(&mut self) {
        let waited = self.waited();
        self.began = Some((Instant::now(), waited));
    }

    fn end(&mut self) {
        if let Some((began, waited)) = self.began.take() {
            self.frames.push((began.elapsed(), waited));
        }
    }

    /// Returns the time that all threads have waited for a processor so far. The kernel adds a wait when it ends.
    fn waited(&self) -> Duration {
        self.threads.iter().filter_map(waited).sum()
    }

    /// Clears the times and opens the files of the threads that exist now.
    fn reset(&mut self) {
        let tasks = std::fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
        self.threads = tasks.filter_map(|task| File::open(task.path().join("schedstat")).ok()).collect();
        self.began = None;
        self.frames.clear();
    }

    /// Returns the frames without waits up to the start of the next frame, which also includes waits that end only
    /// after the frame.
    fn undisturbed(&self) -> Vec<Duration> {
        let waited = self.frames.windows(2).map(|pair| (pair[0].0, pair[1].1 - pair[0].1));
        waited.filter(|(_, waited)| !self.threads.is_empty() && *waited <= UNDISTURBED).map(|(time, _)| time).collect()
    }
}

#[cfg(unix)]
fn waited(schedstat: &File) -> Option<Duration> {
    let mut text = [0; 64];
    let length = std::os::unix::fs::FileExt::read_at(schedstat, &mut text, 0).ok()?;
    let nanoseconds = std::str::from_utf8(&text[..length]).ok()?.split_whitespace().nth(1)?.parse().ok()?;
    Some(Duration::from_nanos(nanoseconds))
}

#[cfg(not(unix))]
fn waited(_: &File) -> Option<Duration> {
    None
}

/// Frame times of a run, seconds.
struct Run {
    /// 10th percentile.
    tenth: f64,
    fastest: f64,
    /// Times of the frames in which no thread waited for a processor.
    undisturbed: Vec<f64>,
}

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

fn run(threads: usize) -> Run {
    let file = mannequin(|_| PAPER_AXES).expect("axes at right angles");
    let document = Document::from_bytes(&file).expect("a file");
    let skeleton: &Skeleton = document.skeleton();
    let mut app = App::new();
    // The other pools need no more than one thread each.
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
    let began = || CLOCK.lock().expect("a clock").begin();
    let ended = || CLOCK.lock().expect("a clock").end();
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
    CLOCK.lock().expect("a clock").reset();
    for frame in 0..FRAMES {
        let angle = f32::from(frame) * 0.05;
        app.world_mut().get_mut::<Transform>(lamp).expect("a lamp").translation =
            Vec3::new(30.0 * angle.sin(), 1.6, 40.0);
        app.update();
    }
    let clock = CLOCK.lock().expect("a clock");
    let mut times: Vec<f64> = clock.frames.iter().map(|(time, _)| time.as_secs_f64()).collect();
    times.sort_by(f64::total_cmp);
    let undisturbed = clock.undisturbed().iter().map(Duration::as_secs_f64).collect();
    Run { tenth: times[times.len() / 10], fastest: times[0], undisturbed }
}

/// Measures a run in a process of its own, because Bevy's task pools are created once per process.
fn measured(threads: usize) -> Run {
    let program = std::env::current_exe().expect("a program");
    let run = std::process::Command::new(program).args(["--threads", &threads.to_string()]).output().expect("a run");
    let text = String::from_utf8_lossy(&run.stdout);
    let seconds: Vec<f64> = text.split_whitespace().map(|number| number.parse().expect("seconds")).collect();
    let [tenth, fastest, undisturbed @ ..] = &seconds[..] else { panic!("two numbers or more, not {text}") };
    Run { tenth: *tenth, fastest: *fastest, undisturbed: undisturbed.to_vec() }
}

fn median(numbers: impl Iterator<Item = f64>) -> f64 {
    let mut numbers: Vec<f64> = numbers.collect();
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}

fn main() {
    let mut arguments = std::env::args().skip(1);
    if arguments.next().as_deref() == Some("--threads") {
        let threads = arguments.next().and_then(|threads| threads.parse().ok()).expect("a number");
        let Run { tenth, fastest, undisturbed } = run(threads);
        let undisturbed: String = undisturbed.iter().map(|time| format!(" {time}")).collect();
        println!("{tenth} {fastest}{undisturbed}");
        return;
    }
    // Alternates, so that other load on the machine slows both alike.
    let pairs: Vec<[Run; 2]> = (0..RUNS).map(|_| [measured(1), measured(2)]).collect();
    let of = |threads: usize, time: fn(&Run) -> f64| pairs.iter().map(move |pair| time(&pair[threads - 1]));
    let least = |times: &mut dyn Iterator<Item = f64>| times.fold(f64::INFINITY, f64::min);
    println!("{CHARACTERS} characters, a frame, on one thread and on two:");
    let told = |what: &str, [one, two]: [f64; 2], ratio: f64| {
        println!("{what}: {:.2} ms, {:.2} ms: {ratio:.2} times as fast", one * 1e3, two * 1e3);
    };
    let tenth = |run: &Run| run.tenth;
    let ratios = pairs.iter().map(|[one, two]| one.tenth / two.tenth);
    told("median of the pairs", [median(of(1, tenth)), median(of(2, tenth))], median(ratios));
    let fastest = [1, 2].map(|threads| least(&mut of(threads, |run| run.fastest)));
    told("the fastest frames", fastest, fastest[0] / fastest[1]);
    let undisturbed =
        [0, 1].map(|which| pairs.iter().flat_map(|pair| pair[which].undisturbed.clone()).collect::<Vec<_>>());
    let counts = undisturbed.each_ref().map(Vec::len);
    let what = format!("undisturbed, {} and {} of {} frames", counts[0], counts[1], RUNS * usize::from(FRAMES));
    if counts.iter().all(|count| *count >= LEAST) {
        let medians = undisturbed.map(|times| median(times.into_iter()));
        told(&what, medians, medians[0] / medians[1]);
    } else {
        println!("{what}: too few to tell");
    }
}
