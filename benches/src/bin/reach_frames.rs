//! A program for counting instructions: deforms a trajectory of FRAMES frames TIMES times, and does little else.
//!
//! `reach_frames FRAMES TIMES`: the difference between two runs is the work of the repetitions by which they differ.
//! The trajectory repeats a motion of 60 frames. For any number of frames, the deformation is spread over the same
//! number of frames and takes the same number of evaluations.

use std::env;
use std::hint::black_box;
use std::process::ExitCode;

use aim::glam::Vec3;
use aim::trajectory::{Node, Trajectory, Waypoint};

const EVALUATIONS: usize = 3;

fn main() -> ExitCode {
    let numbers: Option<Vec<u16>> = env::args().skip(1).map(|word| word.parse().ok()).collect();
    let Some([frames, times]) = numbers.as_deref() else {
        eprintln!("reach_frames FRAMES TIMES");
        return ExitCode::FAILURE;
    };
    let points: Vec<Vec3> = (0..*frames)
        .map(|frame| {
            let t = f32::from(frame % 60) / 60.0 * std::f32::consts::TAU;
            Vec3::new(0.4 * t.cos(), 0.1 * (3.0 * t).sin(), 0.7 * t.sin())
        })
        .collect();
    let frame = points.len() * 2 / 5;
    let waypoint = Waypoint::new(frame, points[frame] + Vec3::new(0.1, 0.15, -0.05));
    let (mut out, mut workspace) = (points.clone(), vec![Node::default(); points.len()]);
    let smoothing = 2.4 / f32::from(*frames);
    let trajectory =
        Trajectory::new(&points).with_smoothing(smoothing).with_evaluations(EVALUATIONS).with_tolerance(0.0);
    for _ in 0..*times {
        let outcome = trajectory.deform(&[waypoint], &mut out, &mut workspace);
        assert_eq!(outcome.evaluations, EVALUATIONS, "every run does the same");
        black_box(&out);
    }
    ExitCode::SUCCESS
}
