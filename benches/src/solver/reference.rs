//! Independent reference solutions: the least displacement that meets the target, and the smallest angle between gaze
//! and target.
//!
//! The method is sequential quadratic programming on central differences of the forward kinematics, from several
//! starts; the best result counts. It shares no code with the runtime and uses a different residual.

use aim::glam::DVec3;

use super::model::{Angles, MOST, Model};
use super::quadratic::Program;

/// Angle below which the target counts as met, radians.
pub const MET_RAD: f64 = 1e-6;

/// Smallest distance of a target from the effector, metres.
const BESIDE_M: f64 = 1e-3;

/// Relative gain below which a search ends: a round gains nearly all of the remaining angle if the target can be met.
const GAIN: f64 = 1e-3;

/// Result of a search.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    /// Declared angles, radians.
    pub angles: Angles,
    /// Angle between the gaze and the target, radians; π if the effector is within a millimetre of the target.
    pub remaining: f64,
    /// Displacement cost Σ stiffness θ².
    pub cost: f64,
}

/// A model with a target and bounds on its angles.
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a> {
    /// The rig in its pose.
    pub model: &'a Model,
    /// The target in the pose's space.
    pub target: DVec3,
    /// Lower and upper bounds of the angles.
    pub bounds: [Angles; 2],
}

impl<'a> Problem<'a> {
    /// Creates a problem bounded by the ranges of motion alone.
    pub fn within_ranges(model: &'a Model, target: DVec3) -> Self {
        // An unlimited heading needs no more than one turn to either side.
        let bounds = model.ranges().map(|bound| bound.map(|x| x.clamp(-std::f64::consts::TAU, std::f64::consts::TAU)));
        Self { model, target, bounds }
    }

    /// Creates a problem bounded by the ranges and by what the rates allow in `seconds` from `from`.
    pub fn within_frame(model: &'a Model, target: DVec3, from: &Angles, seconds: f64) -> Self {
        Self { model, target, bounds: model.reach(from, seconds) }
    }

    /// Returns start angles: rest, the middle of the box, and `more` random points in it.
    pub fn starts(&self, seed: u64, more: usize) -> Vec<Angles> {
        let mut random = fastrand::Rng::with_seed(seed);
        let [lo, hi] = &self.bounds;
        let mut at = |share: Option<f64>| {
            let mut start = [0.0; MOST];
            for i in 0..self.model.count() {
                let share = share.unwrap_or_else(|| random.f64());
                start[i] = lo[i] + share * (hi[i] - lo[i]);
            }
            start
        };
        let mut starts = vec![self.held(&[0.0; MOST]), at(Some(0.5))];
        starts.extend((0..more).map(|_| at(None)));
        starts
    }

    fn held(&self, angles: &Angles) -> Angles {
        std::array::from_fn(|i| angles[i].max(self.bounds[0][i]).min(self.bounds[1][i]))
    }

    fn found(&self, angles: Angles) -> Found {
        // With the effector on the target the angle is undefined, so the target does not count as met.
        let beside = self.model.distance(&angles, self.target) > BESIDE_M;
        let remaining = if beside { self.model.remaining(&angles, self.target) } else { std::f64::consts::PI };
        Found { angles, remaining, cost: self.model.cost(&angles) }
    }

    /// Returns the least displacement that meets the target among the results of all starts; `None` if none meets it.
    pub fn least_displacement(&self, starts: &[Angles]) -> Option<Found> {
        let mut best: Option<Found> = None;
        for start in starts {
            // Start where the gaze already meets the target: the linear model is misleading when the target is far off
            // the gaze.
            let near = self.polish(start, 30, GAIN);
            if near.remaining > MET_RAD {
                continue;
            }
            let found = self.descend(&near.angles);
            if found.remaining <= MET_RAD && best.is_none_or(|best| found.cost < best.cost) {
                best = Some(found);
            }
        }
        best
    }

    /// Returns the result with the smallest remaining angle among those of all starts.
    pub fn nearest(&self, starts: &[Angles]) -> Found {
        self.nearest_by(starts, 1e-9)
    }

    /// Returns `true` if the gaze meets the target from any of the starts.
    pub fn is_met(&self, starts: &[Angles]) -> bool {
        self.nearest_by(starts, GAIN).remaining <= MET_RAD
    }

    fn nearest_by(&self, starts: &[Angles], gain: f64) -> Found {
        let mut best = self.polish(&starts[0], 60, gain);
        for start in &starts[1..] {
            if best.remaining <= 0.1 * MET_RAD {
                break;
            }
            let found = self.polish(start, 60, gain);
            if found.remaining < best.remaining {
                best = found;
            }
        }
        best
    }

    /// Runs one search for the least displacement.
    pub fn descend(&self, start: &Angles) -> Found {
        let model = self.model;
        let mut weights = [1.0; MOST];
        let mean = model.angles.iter().map(|angle| angle.stiffness).sum::<f64>() / model.count() as f64;
        for (weight, angle) in weights.iter_mut().zip(&model.angles) {
            *weight = angle.stiffness / mean;
        }
        let displacement = |x: &Angles| 0.5 * x.iter().zip(&weights).map(|(x, w)| w * x * x).sum::<f64>();
        let off = |x: &Angles| {
            let [a, b] = model.residual(x, self.target);
            a.hypot(b)
        };

        let mut x = self.held(start);
        let mut penalty: f64 = 1.0;
        for _ in 0..200 {
            let residual = model.residual(&x, self.target);
            let columns = model.jacobian(&x, self.target);
            let mut right = residual.map(|r| -r);
            for (column, x) in columns.iter().zip(&x) {
                right[0] += column[0] * x;
                right[1] += column[1] * x;
            }
            let program = Program {
                count: model.count(),
                columns: &columns,
                right,
                weights: &weights,
                bounds: &self.bounds,
                softness: 1e-9,
            };
            let (goal, multipliers) = program.solve();
            let step: Angles = std::array::from_fn(|i| goal[i] - x[i]);
            let longest = step.iter().fold(0.0_f64, |longest, s| longest.max(s.abs()));
            if longest < 1e-10 {
                return self.found(x);
            }
            penalty = penalty.max((1.5 * multipliers[0].hypot(multipliers[1])).min(1e4));
            let distance = residual[0].hypot(residual[1]);
            let merit = |x: &Angles| displacement(x) + penalty * off(x);
            // The linear model's predicted decrease of the merit. If the target is out of reach, the predicted residual
            // `left` is not zero.
            let mut left = residual;
            let mut slope = -penalty * distance;
            for (i, column) in columns.iter().enumerate().take(model.count()) {
                left[0] += column[0] * step[i];
                left[1] += column[1] * step[i];
                slope += weights[i] * x[i] * step[i];
            }
            slope += penalty * left[0].hypot(left[1]);
            if slope > -1e-14 {
                return self.found(x);
            }
            let before = merit(&x);
            // Limit a step to one radian, beyond which the linear model is useless.
            let mut length = (1.0 / longest).min(1.0);
            loop {
                let trial: Angles = std::array::from_fn(|i| x[i] + length * step[i]);
                if merit(&trial) <= before + 1e-4 * length * slope {
                    x = trial;
                    break;
                }
                length *= 0.5;
                if length < 1e-9 {
                    return self.found(x);
                }
            }
        }
        self.found(x)
    }

    /// Runs one damped search (Levenberg–Marquardt within the box) for the smallest remaining angle, as long as a round
    /// gains more than `gain` of it.
    pub fn polish(&self, start: &Angles, rounds: usize, gain: f64) -> Found {
        let model = self.model;
        let mut x = self.held(start);
        let mut distance = model.remaining(&x, self.target);
        let mut damping: f64 = 1e-3;
        for _ in 0..rounds {
            if distance < 1e-9 {
                break;
            }
            let columns = model.jacobian(&x, self.target);
            let right = model.residual(&x, self.target).map(|r| -r);
            let mut room = [[0.0; MOST]; 2];
            for (room, bound) in room.iter_mut().zip(&self.bounds) {
                *room = std::array::from_fn(|i| bound[i] - x[i]);
            }
            let mut improved = false;
            for _ in 0..12 {
                let weights = [damping; MOST];
                let program = Program {
                    count: model.count(),
                    columns: &columns,
                    right,
                    weights: &weights,
                    bounds: &room,
                    softness: 1.0,
                };
                let (step, _) = program.solve();
                let trial = self.held(&std::array::from_fn(|i| x[i] + step[i]));
                let there = model.remaining(&trial, self.target);
                if there < distance {
                    improved = distance - there > gain * distance;
                    (x, distance) = (trial, there);
                    damping = (0.1 * damping).max(1e-12);
                    break;
                }
                damping *= 10.0;
            }
            if !improved {
                break;
            }
        }
        self.found(x)
    }
}
