//! A program for counting instructions: characters that aim at a target. The frames that are asked for contain nothing
//! else.
//!
//! `track_frames exact|exact-inlined|natural|natural-eyes|eye|eye-inlined FRAMES` follows a swinging target,
//! `natural-eyes` with both eyes. `natural-aside` and `natural-overhead` look at a target out of reach, to the side or
//! overhead, and `natural-jump` at one that alternates between two directions; in these three the animation moves. All
//! inputs are prepared for all frames in advance, so that the difference between two runs is the solver's work in the
//! frames by which they differ.

use std::env;
use std::hint::black_box;
use std::process::ExitCode;

use aim::glam::{Affine3A, Vec3};
use aim::{Aim, AimRig, Behind, Pose, Settings, Solver};
use aim_benches::solver::chain::{EyeOnly, Gazer};
use aim_benches::solver::workload::{Motion, Path, track};

/// Number of characters.
const CHARACTERS: usize = 64;
/// Offset of the other eye along the left axis, metres; negative is to the right.
const APART: f32 = -0.06;
/// Number of frames for which inputs are prepared.
const FRAMES: u16 = 600;

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [solver, frames] = arguments.as_slice() else { return usage() };
    let Ok(frames) = frames.parse() else { return usage() };
    let motions = track(CHARACTERS, false);
    let settings = Settings::default().with_behind(Behind::Off);
    let exact = settings.with_solver(Solver::Exact);
    match solver.as_str() {
        "exact" => follow::<Gazer, false>(&motions, frames, &exact),
        "exact-inlined" => follow::<Gazer, true>(&motions, frames, &exact),
        "natural" => follow::<Gazer, false>(&motions, frames, &settings.with_solver(Solver::Natural)),
        "natural-eyes" => {
            follow_by::<Gazer, false>(&motions, frames, &settings.with_solver(Solver::Natural), Some(APART));
        }
        "natural-aside" => stand(frames, [[120.0, 0.0]; 2]),
        "natural-overhead" => stand(frames, [[10.0, 85.0]; 2]),
        "natural-jump" => stand(frames, [[-40.0, 0.0], [35.0, 15.0]]),
        "eye" => follow::<EyeOnly, false>(&motions, frames, &exact),
        "eye-inlined" => follow::<EyeOnly, true>(&motions, frames, &exact),
        _ => return usage(),
    }
    ExitCode::SUCCESS
}

fn usage() -> ExitCode {
    eprintln!("track_frames exact[-inlined]|natural[-eyes|-aside|-overhead|-jump]|eye[-inlined] FRAMES");
    ExitCode::FAILURE
}

/// Runs natural gazes on a moving animation, at a target that alternates between two directions every half second.
fn stand(frames: usize, ends: [[f32; 2]; 2]) {
    let mut motions = track(CHARACTERS, true);
    motions.iter_mut().for_each(|motion| motion.path = Path::Between { ends, stays: 0.5 });
    follow::<Gazer, false>(
        &motions,
        frames,
        &Settings::default().with_behind(Behind::Off).with_solver(Solver::Natural),
    );
}

/// Follows the target with one eye.
fn follow<R: AimRig, const INLINED: bool>(motions: &[Motion], frames: usize, settings: &Settings) {
    follow_by::<R, INLINED>(motions, frames, settings, None);
}

/// Runs the frames in order, all characters in each. `other_eye` is the offset of a second eye to the left of joint 0,
/// metres.
fn follow_by<R: AimRig, const INLINED: bool>(
    motions: &[Motion],
    frames: usize,
    settings: &Settings,
    other_eye: Option<f32>,
) {
    const DT: f32 = 1.0 / 60.0;
    let mut characters = vec![Aim::<R>::new(); motions.len()];
    let pose = |joints: [Affine3A; 3]| {
        let mut array = R::array(Affine3A::IDENTITY);
        array.as_mut().iter_mut().zip(joints).for_each(|(to, joint)| *to = joint);
        let pose = Pose::new(array);
        match other_eye {
            Some(left) => pose.with_other_eye(joints[0] * Affine3A::from_translation(Vec3::new(0.0, 0.0, left))),
            None => pose,
        }
    };
    let poses: Vec<Vec<_>> = (0..FRAMES)
        .map(|frame| {
            let t = f32::from(frame) * DT;
            motions.iter().map(|motion| (pose(motion.body.at(t)), motion.path.at(t))).collect()
        })
        .collect();
    for frame in poses.iter().take(frames) {
        for (character, (pose, target)) in characters.iter_mut().zip(frame) {
            let (pose, target, settings) = (black_box(pose), *black_box(target), black_box(settings));
            if INLINED {
                black_box(&character.aim_inlined(pose, target, DT, settings));
            } else {
                black_box(&character.aim(pose, target, DT, settings));
            }
        }
    }
    black_box(characters);
}
