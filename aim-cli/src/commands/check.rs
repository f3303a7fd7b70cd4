//! `aim check`: compares the derived programs with central differences of the stated objective.
//!
//! The objective is evaluated in f64 directly from its statement, which moves the effector through all joints and is
//! not rewritten. So the comparison tests rewriting, differentiation, lowering and ordering, in f64 and in the f32 of
//! the emitted code.

use aim_runtime::glam::{DMat3, DQuat};
use std::path::Path;

use aim_codegen::objective::{FirstLink, Scope, Statement, functions};
use aim_codegen::{AngleRange, Kernel, RigSpec, kernels};
use aim_symbolic::{Angle, Bindings, Op, Program};

use crate::args;
use crate::failure::{Failure, Result};
use crate::files;

/// Largest deviation in f64 that passes, relative to the larger of 1 and the expected magnitude.
pub(crate) const TOLERANCE_F64: f64 = 1e-7;
/// Largest deviation in f32 that passes, relative to the larger of 1 and the expected magnitude.
pub(crate) const TOLERANCE_F32: f64 = 2e-4;

pub(super) fn run(arguments: &args::Check) -> Result {
    let spec = files::load_rig(&arguments.rig)?;
    let mut kernels = kernels(&spec);
    if let Some(which) = arguments.flip_sign {
        flip_signs(&mut kernels, which);
    }
    let verdicts = verdicts(&spec, &kernels, arguments.samples);
    let mut report = String::new();
    for verdict in &verdicts {
        report += &format!(
            "{} {:<34} worst f64 {:.1e}, f32 {:.1e}\n",
            if verdict.passed() { "ok    " } else { "FAILED" },
            verdict.name,
            verdict.double,
            verdict.single
        );
    }
    files::print(&format!(
        "{}: {} random poses compared with central differences\n{report}",
        spec.name, arguments.samples
    ))?;
    all_passed(&arguments.rig, &spec, &verdicts)
}

/// Result of comparing a program with central differences.
pub(crate) struct Verdict {
    /// Name of the compared program.
    pub(crate) name: String,
    /// Largest deviation in f64, relative to the larger of 1 and the expected magnitude.
    pub(crate) double: f64,
    /// Largest deviation in f32, relative to the larger of 1 and the expected magnitude.
    pub(crate) single: f64,
}

impl Verdict {
    /// Returns `true` if both deviations are within their tolerances.
    pub(crate) fn passed(&self) -> bool {
        self.double <= TOLERANCE_F64 && self.single <= TOLERANCE_F32
    }
}

/// Compares every program of a rig with central differences in `samples` random poses, the same in every run.
pub(crate) fn verdicts(spec: &RigSpec, kernels: &[Kernel], samples: u32) -> Vec<Verdict> {
    trials(spec, kernels).into_iter().map(|trial| trial.run(samples)).collect()
}

/// Checks that every program passed.
///
/// # Errors
/// A program did not pass; the message names all such programs.
pub(crate) fn all_passed(rig: &Path, spec: &RigSpec, verdicts: &[Verdict]) -> Result {
    let failed: Vec<&str> = verdicts.iter().filter(|one| !one.passed()).map(|one| one.name.as_str()).collect();
    if failed.is_empty() {
        return Ok(());
    }
    Err(Failure::Check(format!(
        "{}: derivatives of {} differ from central differences by more than {TOLERANCE_F64:.0e} (f64) or {TOLERANCE_F32:.0e} \
         (f32): {}",
        rig.display(),
        spec.name,
        failed.join(", ")
    )))
}

/// A program, and the statement of what it should compute.
struct Trial<'a> {
    name: String,
    statement: Statement,
    /// Number of links among the inputs.
    links: usize,
    program: &'a Program,
}

fn trials<'a>(spec: &RigSpec, kernels: &'a [Kernel]) -> Vec<Trial<'a>> {
    let trials = functions(kernels).into_iter().map(|function| {
        let Kernel { objective, joints, program } = function.kernel;
        let joints = function.joint.map_or_else(|| joints.clone(), |joint| vec![joint]);
        Trial {
            name: format!("{}: {}", function.subject(spec), objective.title),
            statement: objective.statement(spec, &joints, FirstLink::Given),
            links: if objective.scope == Scope::Joint { 1 } else { spec.joints.len() },
            program,
        }
    });
    trials.collect()
}

impl Trial<'_> {
    fn run(self, samples: u32) -> Verdict {
        let mut random = Random(fastrand::Rng::with_seed(0x5eed));
        let mut worst = Verdict { name: self.name.clone(), double: 0.0, single: 0.0 };
        for _ in 0..samples {
            let bindings = self.pose(&mut random);
            let expected = self.expected(&bindings);
            let mut double = vec![0.0; expected.len()];
            self.program.run(bindings.inputs(), &mut double);
            #[expect(clippy::cast_possible_truncation, reason = "the f32 programs are on trial too")]
            let inputs: Vec<f32> = bindings.inputs().iter().map(|&x| x as f32).collect();
            let mut single = vec![0.0; expected.len()];
            self.program.run(&inputs, &mut single);
            for ((expected, double), single) in expected.into_iter().zip(double).zip(single) {
                let deviation = |found: f64| {
                    let deviation = (found - expected).abs() / expected.abs().max(1.0);
                    if deviation.is_nan() { f64::INFINITY } else { deviation }
                };
                worst.double = worst.double.max(deviation(double));
                worst.single = worst.single.max(deviation(single.into()));
            }
        }
        worst
    }

    /// Returns the values, then their derivatives by central differences of sixth order.
    fn expected(&self, at: &Bindings) -> Vec<f64> {
        const STEP: f64 = 2e-3;
        let Statement { graph, values, angles } = &self.statement;
        let mut expected: Vec<f64> = values.iter().map(|&v| graph.evaluate(v, at)).collect();
        for &value in values {
            for &(angle, range) in angles {
                if range.is_none() {
                    expected.push(0.0);
                    continue;
                }
                // f′ ≈ (45 (f₁ − f₋₁) − 9 (f₂ − f₋₂) + (f₃ − f₋₃)) / 60 h, where fₖ is the value k steps of h away.
                let moved = |steps: f64| graph.evaluate(value, &at.moved(graph, angle, steps * STEP));
                let weighted = |steps: f64, weight: f64| weight * (moved(steps) - moved(-steps));
                let sum = weighted(1.0, 45.0) + weighted(2.0, -9.0) + weighted(3.0, 1.0);
                expected.push(sum / (60.0 * STEP));
            }
        }
        expected
    }

    /// Returns a random pose in which single precision is meaningful: the target is at a distance from the effector and
    /// not behind it.
    fn pose(&self, random: &mut Random) -> Bindings {
        let Statement { graph, values, angles } = &self.statement;
        loop {
            let mut given = Vec::new();
            for _ in 0..self.links {
                given.extend(random.rotation());
                given.extend([0; 3].map(|_| random.within(0.5)));
            }
            let target = [0; 3].map(|_| random.within(3.0));
            given.extend(target);
            let angles: Vec<(Angle, f64)> =
                angles.iter().filter_map(|&(angle, range)| Some((angle, random.in_range(range?)))).collect();
            let bindings = Bindings::new(graph, &given, &angles);
            // Each component of a link's offset is at most 0.5, so a link is at most 0.87 long.
            let reach = 0.9 * f64::from(u32::try_from(self.links).unwrap_or(u32::MAX));
            let distance = target.iter().map(|c| c * c).sum::<f64>().sqrt();
            let moderate = values.iter().all(|&v| graph.evaluate(v, &bindings).abs() < 3.0);
            if (distance > reach + 0.3 || self.links > 3) && moderate {
                return bindings;
            }
        }
    }
}

/// Turns the `which`-th addition of each program into a subtraction, or vice versa. Counts from 0 and wraps around.
fn flip_signs(kernels: &mut [Kernel], which: usize) {
    for Kernel { program, .. } in kernels {
        let sums: Vec<usize> = program
            .ops()
            .iter()
            .enumerate()
            .filter(|(_, op)| matches!(op, Op::Add(..) | Op::Sub(..)))
            .map(|(i, _)| i)
            .collect();
        if !sums.is_empty() {
            *program = program.with_sign_flipped(sums[which % sums.len()]);
        }
    }
}

/// Random values from a seeded generator, so that every run has the same poses.
struct Random(fastrand::Rng);

impl Random {
    fn within(&mut self, limit: f64) -> f64 {
        limit * (2.0 * self.0.f64() - 1.0)
    }

    fn in_range(&mut self, range: AngleRange) -> f64 {
        match range {
            AngleRange::Between(lo, hi) => lo + (hi - lo) * self.0.f64(),
            AngleRange::Free => self.within(std::f64::consts::PI),
        }
    }

    /// Returns the nine numbers of a random rotation matrix, column by column.
    fn rotation(&mut self) -> [f64; 9] {
        let q = DQuat::from_xyzw(self.within(1.0), self.within(1.0), self.within(1.0), self.within(1.0));
        let q = if q.length_squared() > 0.01 { q.normalize() } else { DQuat::IDENTITY };
        DMat3::from_quat(q).to_cols_array()
    }
}
