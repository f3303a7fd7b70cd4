//! Finds the most expensive frame: characters in random, moving poses aim at targets anywhere that stand, move and
//! jump.
//!
//! `worst_frames natural|exact [FRAMES]` ranks the frames (a million by default) by the least time of three runs of
//! each, and has valgrind count the instructions of the hundred slowest. `worst_frames replay natural|exact CASE…` is
//! the process that valgrind runs; only the calls of [`measured`] are counted.

use std::env;
use std::hint::black_box;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use aim::glam::{Affine3A, Quat, Vec3};
use aim::{Aim, Outcome, Pose, Settings, Solver};
use aim_benches::callgrind;
use aim_benches::solver::chain::{Animation, EYE_AT_REST, Gazer, direction, wobble};

/// Number of frames per character.
const FRAMES: usize = 200;
/// Number of frames whose instructions are counted.
const COUNTED: usize = 100;
/// Number of runs of each frame; the fastest counts.
const ROUNDS: usize = 3;

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match words.as_slice() {
        ["replay", solver, cases @ ..] => replay(solver, cases),
        [solver] => rank(solver, 1_000_000),
        [solver, frames] => frames.parse().map_err(|_| usage()).and_then(|frames| rank(solver, frames)),
        _ => Err(usage()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("worst_frames: {message}");
            ExitCode::FAILURE
        }
    }
}

fn usage() -> String {
    "worst_frames natural|exact [FRAMES]".to_owned()
}

fn settings(solver: &str) -> Result<Settings, String> {
    match solver {
        "natural" => Ok(Settings::default().with_solver(Solver::Natural)),
        "exact" => Ok(Settings::default().with_solver(Solver::Exact)),
        _ => Err(usage()),
    }
}

/// Makes the one call whose instructions are counted.
#[inline(never)]
fn measured(character: &mut Aim<Gazer>, input: &Input, settings: &Settings) -> Outcome {
    character.aim(black_box(&input.pose), black_box(input.target), input.dt, black_box(settings)).outcome
}

/// Inputs of a frame.
struct Input {
    pose: Pose<[Affine3A; 3]>,
    target: Vec3,
    dt: f32,
}

/// A random sequence of inputs for one character; the same number always gives the same sequence.
struct Scene {
    random: fastrand::Rng,
    animation: Animation,
    slouch: [Quat; 3],
    speed: Vec3,
    target: Vec3,
    dt: f32,
    t: f32,
}

impl Scene {
    fn new(number: usize) -> Self {
        let mut random = fastrand::Rng::with_seed(number as u64);
        let animation = Animation::random(&mut random);
        let dt = [1.0 / 30.0, 1.0 / 60.0, 1.0 / 144.0][random.usize(..3)];
        let slouch = std::array::from_fn(|_| wobble(&mut random, 40.0));
        Self { random, animation, slouch, speed: Vec3::ZERO, target: EYE_AT_REST + Vec3::Z, dt, t: 0.0 }
    }

    /// Returns the inputs of the next frame. In one frame of twelve the target jumps and moves on from there; in one of
    /// fifty the animation jumps.
    fn next(&mut self) -> Input {
        let random = &mut self.random;
        if random.u8(..12) == 0 {
            self.target = EYE_AT_REST + direction(random) * (0.1 + 4.0 * random.f32());
            self.speed = direction(random) * (3.0 * random.f32());
        }
        if random.u8(..50) == 0 {
            self.slouch = std::array::from_fn(|_| wobble(random, 40.0));
        }
        self.target += self.speed * self.dt;
        self.t += self.dt;
        let turned = self.slouch.map(|turn| Affine3A::from_quat(turn).matrix3);
        let mut joints = self.animation.at(self.t);
        for (joint, turn) in joints.iter_mut().zip(turned) {
            joint.matrix3 = turn * joint.matrix3;
        }
        Input { pose: Pose::new(joints), target: self.target, dt: self.dt }
    }
}

/// A frame of a character, and the time that it took.
#[derive(Clone, Copy)]
struct Frame {
    character: usize,
    frame: usize,
    time: Duration,
}

fn rank(solver: &str, frames: usize) -> Result<(), String> {
    let settings = settings(solver)?;
    let mut worst: Vec<Frame> = Vec::new();
    for number in 0..frames.div_ceil(FRAMES) {
        let (mut scene, mut character) = (Scene::new(number), Aim::<Gazer>::new());
        for frame in 0..FRAMES {
            let input = scene.next();
            let before = character;
            let time = (0..ROUNDS).map(|_| {
                character = before;
                let start = Instant::now();
                black_box(measured(&mut character, &input, &settings));
                start.elapsed()
            });
            let time = time.min().unwrap_or_default();
            worst.push(Frame { character: number, frame, time });
        }
        if worst.len() > 100 * COUNTED || (number + 1) * FRAMES >= frames {
            worst.sort_by_key(|frame| std::cmp::Reverse(frame.time));
            worst.truncate(COUNTED);
        }
    }
    let mut counts = count(solver, &worst)?;
    counts.sort_by_key(|&(instructions, _)| std::cmp::Reverse(instructions));
    for (instructions, case) in counts.iter().take(10) {
        println!("{instructions:8} instructions: {case}");
    }
    println!("{solver}: {} instructions in the worst of {frames} frames", counts.first().map_or(0, |worst| worst.0));
    Ok(())
}

/// Returns the instructions of each frame, with its case in the form `character:frame`.
fn count(solver: &str, frames: &[Frame]) -> Result<Vec<(u64, String)>, String> {
    let cases: Vec<String> = frames.iter().map(|frame| format!("{}:{}", frame.character, frame.frame)).collect();
    let arguments = [&["replay".to_owned(), solver.to_owned()], &cases[..]].concat();
    let counts = callgrind::instructions_of_calls("worst_frames::measured", cases.len(), &arguments)?;
    Ok(counts.into_iter().zip(cases).collect())
}

/// Replays each case: aims through the preceding frames by calls that are not counted, then makes the counted call.
fn replay(solver: &str, cases: &[&str]) -> Result<(), String> {
    let settings = settings(solver)?;
    for case in cases {
        let numbers = case.split_once(':').and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
        let (number, frame): (usize, usize) = numbers.ok_or_else(usage)?;
        let (mut scene, mut character) = (Scene::new(number), Aim::<Gazer>::new());
        for _ in 0..frame {
            let input = scene.next();
            black_box(&character.aim(&input.pose, input.target, input.dt, &settings));
        }
        let input = scene.next();
        black_box(measured(&mut character, &input, &settings));
    }
    Ok(())
}
