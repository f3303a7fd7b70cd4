//! Moving targets, on still and moving bodies, and the displacement of the resulting angles.

use super::super::chain::{DEG, Gazer};
use super::super::parallel;
use super::super::reference::Problem;
use super::super::row::{Row, largest, quantile};
use super::super::sample::{FRAME_RATES, Sample, Scene, frames};
use super::super::workload::{Where, track};
use aim::glam::DVec3;
use aim::{AimRig, Rig};

/// Measures the lag behind a swinging target.
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
                // Skip the first two seconds, in which the gaze arrives.
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

/// Still targets in all directions: those well within reach must be reached, and those out of reach must be looked at
/// with the right elevation.
pub fn resting(sample: &Sample) -> Vec<Row> {
    let mut rows = Vec::new();
    for hz in FRAME_RATES {
        let cases = Where::Any.cases(sample.of(if hz == 60.0 { 4096 } else { 1024 }));
        let ends = parallel::map(cases.len(), |i| {
            let target = cases[i].target.as_dvec3();
            let mut scene = Scene::new(Gazer::RIG, &cases[i].pose, cases[i].target);
            let model = scene.model();
            scene.run(frames(model.longest() + 1.0, hz), 1.0 / hz, &sample.plain());
            // Well within reach means within 80 % of the ranges, since heading and elevation may be limited separately.
            let mut narrow = model.clone();
            narrow.angles.iter_mut().for_each(|angle| angle.range = angle.range.map(|end| 0.8 * end));
            let problem = Problem::within_ranges(&narrow, target);
            let is_well_within = problem.is_met(&problem.starts(i as u64, 3));
            let values = scene.angles(&model);
            // Elevation is relative to the trunk's up axis, which the solver takes as level unless the pose sets an up
            // direction.
            let up = cases[i].pose[2].transform_vector3a(Gazer::RIG.description().joints()[2].axes().up.into());
            let elevation = |v: DVec3| v.normalize().dot(up.as_dvec3().normalize()).asin() / DEG;
            let elevations = [model.gaze(&values), target - model.origin(&values)].map(elevation);
            (is_well_within, scene.remaining(&model), elevations)
        });
        let (within, others): (Vec<_>, Vec<_>) = ends.into_iter().partition(|(is_well_within, ..)| *is_well_within);
        let missed = within.iter().filter(|(_, remaining, _)| *remaining > 0.1 * DEG).count();
        rows.push(
            Row::none(format!("still target, {hz} Hz: well within reach and not reached"), missed, within.len())
                .noting(&format!("worst {:.1e}°", largest(within.iter().map(|(_, remaining, _)| remaining / DEG)))),
        );
        let mut off: Vec<f64> =
            others.iter().filter(|(.., [_, to])| to.abs() < 30.0).map(|(.., [gaze, to])| (gaze - to).abs()).collect();
        rows.push(
            Row::at_most(
                format!("still target, {hz} Hz: at its limits, off the target's elevation, p99"),
                3.0,
                "°",
                quantile(&mut off, 0.99),
            )
            .noting(&format!("of {}", off.len())),
        );
    }
    rows
}
