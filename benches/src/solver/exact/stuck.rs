//! Reachable targets that are never reached.

use aim::{AimRig, Behind, Pose, Settings};

use super::super::chain::{DEG, Gazer, random_state};
use super::super::model::Model;
use super::super::parallel;
use super::super::random_rigs;
use super::super::reference::Problem;
use super::super::row::Row;
use super::super::sample::{FRAME_RATES, Sample, Scene, frames};
use super::super::workload::{Motion, Path, Where, orbits};

/// Tolerance for a reached target, radians.
const TOLERANCE_RAD: f64 = 0.1 * DEG * 1.000_1;

/// Still targets, from rest and from random angles.
pub fn stuck_still(sample: &Sample) -> Vec<Row> {
    let mut rows = Vec::new();
    for place in [Where::Cone, Where::Front, Where::Any] {
        for hz in FRAME_RATES {
            let cases = place.cases(sample.of(if hz == 60.0 { 4096 } else { 1024 }));
            let ends = parallel::map(2 * cases.len(), |i| {
                let case = &cases[i / 2];
                let mut scene = Scene::new(Gazer::RIG, &case.pose, case.target);
                let model = scene.model();
                if i % 2 == 1 {
                    let state = random_state(&scene.rig.rig, &mut fastrand::Rng::with_seed(0x57_0000 + i as u64));
                    scene.rig.state.joints = state;
                }
                scene.run(frames(model.longest() + 0.5, hz), 1.0 / hz, &sample.plain());
                if scene.remaining(&model) <= TOLERANCE_RAD {
                    return (true, true);
                }
                (false, within_reach(&Problem::within_ranges(&model, case.target.as_dvec3()), i))
            });
            let reachable = ends.iter().filter(|(_, reachable)| *reachable).count();
            let stuck = ends.iter().filter(|(reached, reachable)| *reachable && !reached).count();
            rows.push(Row::none(format!("stuck although reachable: {}, {hz} Hz", place.name()), stuck, reachable));
        }
    }
    rows
}

/// Returns `true` if an independent search meets the target.
fn within_reach(problem: &Problem<'_>, seed: usize) -> bool {
    problem.is_met(&problem.starts(seed as u64, 10))
}

/// Targets that circle the character. Counts the frames in which the target is reachable but not reached, and would not
/// be reached if it stopped there, however long the joints had.
pub fn stuck_on_orbits(sample: &Sample) -> Vec<Row> {
    let mut rows = Vec::new();
    for (behind, name) in [(Behind::Off, "off"), (Behind::Clip, "clip")] {
        let settings = sample.settings.with_behind(behind);
        for hz in FRAME_RATES {
            for moving in [false, true] {
                if hz != 60.0 && (moving || behind != Behind::Off) {
                    continue;
                }
                let motions = orbits(sample.of(2), moving);
                let counted = parallel::map(motions.len(), |i| orbit(&motions[i], hz, &settings, i));
                let sum = |of: fn(&Orbited) -> usize| counted.iter().map(of).sum::<usize>();
                let body = if moving { ", moving animation" } else { "" };
                let what = format!("stuck although reachable: orbits, {hz} Hz, behind {name}{body}");
                let row = Row::none(what, sum(|orbit| orbit.stuck), sum(|orbit| orbit.reachable));
                rows.push(row.noting(&format!("{} on the way", sum(|orbit| orbit.on_the_way))));
            }
        }
    }
    rows
}

/// Counts of frames in one orbit.
#[derive(Default)]
struct Orbited {
    /// Frames whose target is within reach: all that reached it, and judged ones that could.
    reachable: usize,
    /// Reachable frames that are not reached, but would be in time if the target stopped.
    on_the_way: usize,
    /// Reachable frames that would never be reached.
    stuck: usize,
}

fn orbit(motion: &Motion, hz: f32, settings: &Settings, number: usize) -> Orbited {
    let mut scene = Scene::new(Gazer::RIG, &motion.body.at(0.0), motion.path.at(0.0));
    let mut orbited = Orbited::default();
    let Path::Orbit { seconds } = motion.path else { return orbited };
    for frame in 0..frames(2.0 * f64::from(seconds.abs()), hz) {
        #[expect(clippy::cast_precision_loss, reason = "a few thousand frames")]
        scene.follow(motion, frame as f32 / hz);
        scene.step(1.0 / hz, settings);
        let model = scene.model();
        if scene.remaining(&model) <= TOLERANCE_RAD {
            orbited.reachable += 1;
            continue;
        }
        // The search is expensive: of the frames that are not reached, only one in five is judged.
        let judged = frame % 5 == 0;
        if judged && within_reach(&Problem::within_ranges(&model, scene.target.as_dvec3()), number) {
            orbited.reachable += 1;
            let mut stopped = scene.clone();
            stopped.run(frames(model.longest() + 0.5, hz), 1.0 / hz, settings);
            if stopped.remaining(&model) <= TOLERANCE_RAD {
                orbited.on_the_way += 1;
            } else {
                orbited.stuck += 1;
            }
        }
    }
    orbited
}

/// A hundred thousand random rigs of one to seven joints: reachable targets must be reached.
pub fn stuck_on_random_rigs(sample: &Sample) -> Vec<Row> {
    let count = sample.of(100_000);
    let settings = sample.plain();
    let ends = parallel::map(count, |number| {
        let case = random_rigs::case(number);
        let (mut rig, pose) = (case.character(), Pose::new(case.pose.as_slice()));
        let model = Model::new(&case.rig, &case.pose);
        let target = case.target.as_dvec3();
        if !(case.reachable || within_reach(&Problem::within_ranges(&model, target), number)) {
            return (false, false);
        }
        for _ in 0..frames(model.longest() + 0.5, case.hz) {
            rig.aim(&pose, case.target, 1.0 / case.hz, &settings);
            if model.seen_remaining(rig.corrections(), target) <= TOLERANCE_RAD {
                return (true, true);
            }
        }
        (false, true)
    });
    let reachable = ends.iter().filter(|(_, reachable)| *reachable).count();
    let stuck: Vec<usize> = (0..count).filter(|&i| ends[i].1 && !ends[i].0).collect();
    let first: Vec<String> = stuck.iter().take(8).map(usize::to_string).collect();
    let row = Row::none(format!("stuck although reachable: {count} random rigs"), stuck.len(), reachable);
    vec![if stuck.is_empty() { row } else { row.noting(&format!("the first are {}", first.join(", "))) }]
}
