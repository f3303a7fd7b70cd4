//! What is counted: deforming a trajectory of so many frames, so many times, and little else.
//!
//! `reach_frames FRAMES TIMES`: two runs differ by the work of the times by which they differ. The trajectory is the same
//! motion sampled more or less finely; it is evaluated as often whatever the frames, as the default would on a fine one.

use std::env;
use std::hint::black_box;
use std::process::ExitCode;

use aim::glam::Vec3;
use aim::reach::{Node, Trajectory, Waypoint};

const EVALUATIONS: usize = 6;

fn main() -> ExitCode {
    let numbers: Option<Vec<u16>> = env::args().skip(1).map(|word| word.parse().ok()).collect();
    let Some([frames, times]) = numbers.as_deref() else {
        eprintln!("reach_frames FRAMES TIMES");
        return ExitCode::FAILURE;
    };
    let points: Vec<Vec3> = (0..*frames)
        .map(|frame| {
            let t = f32::from(frame) / f32::from(frames - 1) * std::f32::consts::PI;
            Vec3::new(0.4 * t.cos(), 0.1 * (3.0 * t).sin(), 0.7 * t.sin())
        })
        .collect();
    let frame = points.len() * 2 / 5;
    let waypoint = Waypoint::new(frame, points[frame] + Vec3::new(0.1, 0.15, -0.05));
    let (mut out, mut workspace) = (points.clone(), vec![Node::default(); points.len()]);
    let trajectory = Trajectory::new(&points).with_evaluations(EVALUATIONS).with_tolerance(0.0);
    for _ in 0..*times {
        let outcome = trajectory.deform(&[waypoint], &mut out, &mut workspace);
        assert_eq!(outcome.evaluations, EVALUATIONS, "every run does the same");
        black_box(&out);
    }
    ExitCode::SUCCESS
}
