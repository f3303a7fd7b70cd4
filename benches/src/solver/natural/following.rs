//! A target that moves, on bodies that may; and what becomes of the displacement.

use super::super::chain::{DEG, Gazer};
use super::super::parallel;
use super::super::reference::Problem;
use super::super::row::{Row, largest, quantile};
use super::super::sample::{FRAME_RATES, Sample, Scene, frames};
use super::super::workload::{Where, track};
use aim::AimRig;

/// The lag behind a swinging target.
pub fn following(sample: &Sample) -> Vec<Row> {
    let mut rows = Vec::new();
    for (moving, hz) in [(false, 60.0), (false, 30.0), (false, 144.0), (true, 60.0)] {
        let motions = track(sample.of(256), moving);
        let followed = parallel::map(motions.len(), |i| {
            let mut scene = Scene::new(Gazer::RIG, &motions[i].body.at(0.0), motions[i].path.at(0.0));
            let mut lags = Vec::new();
            for frame in 0_u16..600 {
                scene.follow(&motions[i], f32::from(frame) / hz);
                scene.step(1.0 / hz, &sample.plain());
                // The first two seconds are arriving.
                if f32::from(frame) >= 2.0 * hz {
                    lags.push(scene.remaining(&scene.model()) / DEG);
                }
            }
            lags
        });
        let mut lags: Vec<f64> = followed.into_iter().flatten().collect();
        let body = if moving { ", moving animation" } else { "" };
        let name = format!("track, {hz} Hz{body}");
        rows.push(Row::at_most(format!("{name}: lag, median"), 1e-3, "°", quantile(&mut lags, 0.5)));
        rows.push(
            Row::at_most(format!("{name}: lag, p99"), 6e-3, "°", quantile(&mut lags, 0.99))
                .noting(&format!("worst {:.2e}°", quantile(&mut lags, 1.0))),
        );
    }
    rows
}

/// Still targets, all over the front: all that can be reached is, and out of reach the gaze comes as near as it can.
pub fn resting(sample: &Sample) -> Vec<Row> {
    let mut rows = Vec::new();
    for hz in FRAME_RATES {
        let cases = Where::Front.cases(sample.of(if hz == 60.0 { 4096 } else { 1024 }));
        let ends = parallel::map(cases.len(), |i| {
            let mut scene = Scene::new(Gazer::RIG, &cases[i].pose, cases[i].target);
            let model = scene.model();
            scene.run(frames(model.longest() + 1.0, hz), 1.0 / hz, &sample.plain());
            let problem = Problem::within_ranges(&model, cases[i].target.as_dvec3());
            let mut starts = problem.starts(i as u64, 3);
            starts.push(scene.angles(&model));
            let best = problem.nearest(&starts).remaining;
            (best, scene.remaining(&model))
        });
        let (reachable, others): (Vec<_>, Vec<_>) = ends.into_iter().partition(|(best, _)| *best < 1e-6);
        let missed = reachable.iter().filter(|(_, remaining)| *remaining > 0.1 * DEG).count();
        rows.push(
            Row::none(format!("still target, {hz} Hz: within reach and not reached"), missed, reachable.len())
                .noting(&format!("worst {:.1e}°", largest(reachable.iter().map(|(_, remaining)| remaining / DEG)))),
        );
        let mut worse: Vec<f64> = others.iter().map(|(best, remaining)| (remaining - best) / DEG).collect();
        rows.push(
            Row::at_most(
                format!("still target, {hz} Hz: out of reach, worse than the best, p99"),
                0.5,
                "°",
                quantile(&mut worse, 0.99),
            )
            .noting(&format!("of {}", others.len())),
        );
    }
    rows
}
