//! Deviation of the angles from the least displacement.

use aim::AimRig;

use super::super::chain::{DEG, Gazer, random_state};
use super::super::parallel;
use super::super::reference::Problem;
use super::super::row::{Row, quantile};
use super::super::sample::{FRAME_RATES, Sample, Scene, apart, frames};
use super::super::workload::{Still, Where, track};

/// Result for one target that stood still.
struct Settled {
    /// Largest difference of an angle from the least displacement, degrees.
    off: f64,
    /// Angle between the gaze and the target, degrees.
    remaining: f64,
    /// Relative excess of the cost over that of the least displacement.
    dearer: f64,
}

/// Still, reachable targets: every angle compared with the independent solution, and the error of the gaze, after all
/// joints have had time to cross their ranges.
pub fn least_displacement(sample: &Sample) -> Vec<Row> {
    let mut rows = Vec::new();
    for hz in FRAME_RATES {
        // 60 Hz with all cases, the other rates with a quarter of them.
        let share = if hz == 60.0 { 1 } else { 4 };
        for from_rest in [true, false] {
            let cases: Vec<Still> = [Where::Cone, Where::Front]
                .into_iter()
                .flat_map(|place| place.cases(sample.of(4096 / share)))
                .collect();
            let settled: Vec<Settled> = parallel::map(cases.len(), |i| settle(sample, &cases[i], i, hz, from_rest))
                .into_iter()
                .flatten()
                .collect();
            let from = if from_rest { "from rest" } else { "from anywhere" };
            let near = settled.iter().filter(|case| case.off <= 0.1).count();
            let mut off: Vec<f64> = settled.iter().map(|case| case.off).collect();
            let mut remaining: Vec<f64> = settled.iter().map(|case| case.remaining).collect();
            let cheaper = settled.iter().filter(|case| case.off > 0.1 && case.dearer < 1e-3).count();
            let name = format!("still target, {from}, {hz} Hz");
            rows.push(
                Row::every(format!("{name}: all angles within 0.1° of the least displacement"), near, settled.len())
                    .noting(&format!(
                        "p99 {:.2e}°, worst {:.2e}°; {cheaper} of the others cost as little",
                        quantile(&mut off, 0.99),
                        quantile(&mut off, 1.0)
                    )),
            );
            rows.push(Row::at_most(format!("{name}: gaze, median"), 1e-3, "°", quantile(&mut remaining, 0.5)));
            rows.push(
                Row::at_most(format!("{name}: gaze, p99"), 0.01, "°", quantile(&mut remaining, 0.99))
                    .noting(&format!("worst {:.2e}°", quantile(&mut remaining, 1.0))),
            );
        }
    }
    rows
}

/// Returns `None` if the target cannot be reached.
fn settle(sample: &Sample, case: &Still, number: usize, hz: f32, from_rest: bool) -> Option<Settled> {
    let mut random = fastrand::Rng::with_seed(0xd15_0000 + number as u64);
    let mut scene = Scene::new(Gazer::RIG, &case.pose, case.target);
    let model = scene.model();
    let problem = Problem::within_ranges(&model, case.target.as_dvec3());
    if !from_rest {
        let state = random_state(&scene.rig.rig, &mut random);
        scene.rig.state.joints = state;
    }
    scene.run(frames(model.longest() + 0.5, hz), 1.0 / hz, &sample.plain());

    let angles = scene.angles(&model);
    let mut starts = problem.starts(number as u64, 3);
    starts.push(angles);
    let best = problem.least_displacement(&starts)?;
    Some(Settled {
        off: apart(&model, &angles, &best.angles) / DEG,
        remaining: scene.remaining(&model) / DEG,
        dearer: model.cost(&angles) / best.cost - 1.0,
    })
}

/// Lags and costs of one character that follows a target.
struct Tracked {
    lags: Vec<f64>,
    cost: f64,
    least: f64,
}

/// Following a swinging target: the lag, and the displacement cost relative to that of the independent solution.
pub fn tracking(sample: &Sample) -> Vec<Row> {
    let all = [(false, 60.0), (false, 30.0), (false, 144.0), (true, 60.0)];
    all.into_iter().flat_map(|(moving, hz)| tracked(sample, "", moving, hz)).collect()
}

/// The same measurement as [`tracking`] at 60 Hz in still poses, with `name` before the names of the rows.
pub fn tracking_of(sample: &Sample, name: &str) -> Vec<Row> {
    tracked(sample, name, false, 60.0)
}

fn tracked(sample: &Sample, name: &str, moving: bool, hz: f32) -> Vec<Row> {
    let motions = track(sample.of(256), moving);
    let tracked = parallel::map(motions.len(), |i| {
        let mut scene = Scene::new(Gazer::RIG, &motions[i].body.at(0.0), motions[i].path.at(0.0));
        let mut tracked = Tracked { lags: Vec::new(), cost: 0.0, least: 0.0 };
        for frame in 0_u16..600 {
            scene.follow(&motions[i], f32::from(frame) / hz);
            scene.step(1.0 / hz, &sample.plain());
            // Skip the first two seconds, in which the gaze arrives.
            if f32::from(frame) < 2.0 * hz {
                continue;
            }
            let model = scene.model();
            tracked.lags.push(scene.remaining(&model) / DEG);
            if frame % 41 == 0 {
                let problem = Problem::within_ranges(&model, scene.target.as_dvec3());
                let angles = scene.angles(&model);
                let mut starts = problem.starts(i as u64, 1);
                starts.push(angles);
                if let Some(best) = problem.least_displacement(&starts) {
                    tracked.cost += model.cost(&angles);
                    tracked.least += best.cost;
                }
            }
        }
        tracked
    });
    let mut lags: Vec<f64> = tracked.iter().flat_map(|tracked| tracked.lags.iter().copied()).collect();
    let cost: f64 = tracked.iter().map(|tracked| tracked.cost).sum();
    let least: f64 = tracked.iter().map(|tracked| tracked.least).sum();
    let body = if moving { ", moving animation" } else { "" };
    let name = format!("{name}track, {hz} Hz{body}");
    vec![
        Row::at_most(format!("{name}: lag, median"), 1e-3, "°", quantile(&mut lags, 0.5)),
        Row::at_most(format!("{name}: lag, p99"), 6e-3, "°", quantile(&mut lags, 0.99))
            .noting(&format!("worst {:.2e}°", quantile(&mut lags, 1.0))),
        Row::at_most(format!("{name}: displacement cost"), 1.02, " × the least", cost / least),
    ]
}
