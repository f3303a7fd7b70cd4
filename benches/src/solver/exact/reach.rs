//! Targets from rest without rate limits, and targets out of reach.

use aim::{AimRig, JointInfo, Pose, Rig};

use super::super::chain::{DEG, Gazer, random_state};
use super::super::numeric::NumericRig;
use super::super::parallel;
use super::super::reference::{MET_RAD, Problem};
use super::super::row::{Row, largest, quantile};
use super::super::sample::{Sample, Scene, frames};
use super::super::workload::Where;

/// The `cone` workload from rest without rate limits: solved within three frames, and by one `snap`.
pub fn cold(sample: &Sample) -> Vec<Row> {
    let cases = Where::Cone.cases(sample.of(4096));
    let mut quick: Vec<JointInfo> = Gazer::RIG.description().joints().to_vec();
    for info in &mut quick {
        info.rate = 1e6;
    }
    let ends = parallel::map(cases.len(), |i| {
        let case = &cases[i];
        let mut scene = Scene::new(NumericRig::new(&quick), &case.pose, case.target);
        let model = scene.model();
        let problem = Problem::within_ranges(&model, case.target.as_dvec3());
        if !problem.is_met(&problem.starts(i as u64, 6)) {
            return None;
        }
        let after = [1, 2, 3].map(|_| {
            scene.step(0.1, &sample.plain());
            scene.remaining(&model) / DEG
        });
        let mut snapped = Scene::new(Gazer::RIG, &case.pose, case.target);
        snapped.rig.snap(&Pose::new(case.pose), case.target, &sample.plain());
        Some((after, snapped.remaining(&model) / DEG))
    });
    let ends: Vec<([f64; 3], f64)> = ends.into_iter().flatten().collect();
    let solved = |k: usize| ends.iter().filter(|(after, _)| after[k] <= 0.1).count();
    let share = |k: usize| 100.0 * solved(k) as f64 / ends.len() as f64;
    let snapped = ends.iter().filter(|(_, snapped)| *snapped <= 0.1).count();
    vec![
        Row::every("cone from rest, without rates: solved to 0.1° in three frames", solved(2), ends.len()).noting(
            &format!(
                "{:.1} % in one, {:.1} % in two; worst {:.1e}°",
                share(0),
                share(1),
                largest(ends.iter().map(|(after, _)| after[2]))
            ),
        ),
        Row::every("cone from rest: solved to 0.1° by one snap", snapped, ends.len())
            .noting(&format!("worst {:.1e}°", largest(ends.iter().map(|(_, snapped)| *snapped)))),
    ]
}

/// Targets out of reach: the remaining angle compared with the best that a global search finds.
pub fn unreachable(sample: &Sample) -> Vec<Row> {
    let cases = Where::Any.cases(sample.of(4096));
    let mut rows = Vec::new();
    for from_rest in [true, false] {
        let worse = parallel::map(cases.len(), |i| {
            let case = &cases[i];
            let mut scene = Scene::new(Gazer::RIG, &case.pose, case.target);
            let model = scene.model();
            if !from_rest {
                let state = random_state(&scene.rig.rig, &mut fastrand::Rng::with_seed(0x0ff_0000 + i as u64));
                scene.rig.state.joints = state;
            }
            // Twice the time, since the solver may take the long way round.
            scene.run(frames(2.0 * model.longest() + 1.0, 60.0), 1.0 / 60.0, &sample.plain());
            let remaining = scene.remaining(&model);
            if remaining <= 0.1 * DEG {
                return None;
            }
            let problem = Problem::within_ranges(&model, case.target.as_dvec3());
            let mut starts = problem.starts(i as u64, 12);
            starts.push(scene.angles(&model));
            let best = problem.nearest(&starts).remaining;
            let here = problem.polish(&scene.angles(&model), 60, 1e-9).remaining;
            (best > MET_RAD).then_some([remaining - best, remaining - here].map(|worse| worse / DEG))
        });
        let worse: Vec<[f64; 2]> = worse.into_iter().flatten().collect();
        // `nearby` compares with a local search from the same angles. A larger difference to the global best means that
        // the best is on another side of the target.
        let mut nearby: Vec<f64> = worse.iter().map(|worse| worse[1]).collect();
        let mut worse: Vec<f64> = worse.iter().map(|worse| worse[0]).collect();
        let from = if from_rest { "from rest" } else { "from anywhere" };
        let what = format!("unreachable, {from}: worse than the global best, p99");
        let note = format!(
            "median {:.1e}°, worst {:.2}°, of {}; than the nearest local best p99 {:.1e}°",
            quantile(&mut worse, 0.5),
            quantile(&mut worse, 1.0),
            worse.len(),
            quantile(&mut nearby, 0.99)
        );
        rows.push(Row::at_most(what, 0.5, "°", quantile(&mut worse, 0.99)).noting(&note));
    }
    rows
}
