//! Single frames: a target that can be reached within ranges and rates must be reached in that frame.

use aim::AimRig;
use aim::Status;

use super::super::chain::{DEG, Gazer};
use super::super::parallel;
use super::super::reference::Problem;
use super::super::row::Row;
use super::super::sample::{Sample, Scene};
use super::super::workload::{Motion, orbits, track};

/// Counts the frames whose target can be met within ranges and rates, but that do not report it as reached.
pub fn unreached_frames(sample: &Sample) -> Vec<Row> {
    let mut rows = Vec::new();
    for (hz, moving) in [(60.0, false), (60.0, true), (30.0, false), (144.0, false)] {
        let workloads = [("track", track(sample.of(256), moving)), ("orbits", orbits(sample.of(16), moving))];
        for (name, motions) in workloads {
            let counted = parallel::map(motions.len(), |i| judge(sample, &motions[i], hz, i));
            let (missed, all) = counted.iter().fold((0, 0), |(a, b), (missed, all)| (a + missed, b + all));
            let body = if moving { ", moving animation" } else { "" };
            let what = format!("frames within reach and rates that are not reached: {name}, {hz} Hz{body}");
            rows.push(Row::none(what, missed, all));
        }
    }
    rows
}

/// Returns the number of missed frames, and the number of frames whose target could be reached.
fn judge(sample: &Sample, motion: &Motion, hz: f32, number: usize) -> (usize, usize) {
    let settings = sample.plain();
    let mut scene = Scene::new(Gazer::RIG, &motion.body.at(0.0), motion.path.at(0.0));
    let (mut missed, mut all) = (0, 0);
    for frame in 0_u16..600 {
        scene.follow(motion, f32::from(frame) / hz);
        let model = scene.model();
        let before = scene.angles(&model);
        let outcome = scene.step(1.0 / hz, &settings);
        let remaining = scene.remaining(&model);
        let reached = outcome.status == Status::Reached && remaining <= 0.1 * DEG + 1e-6;
        if reached {
            all += 1;
            continue;
        }
        let problem = Problem::within_frame(&model, scene.target.as_dvec3(), &before, 1.0 / f64::from(hz));
        let starts = problem.starts(number as u64, 3);
        if problem.is_met(&starts) {
            all += 1;
            missed += 1;
        }
    }
    (missed, all)
}
