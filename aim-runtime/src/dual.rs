//! The least comfort-weighted displacement that a linear model of the gaze allows: a quadratic problem over all angles
//! whose dual has two unknowns, whatever the number of joints.
//!
//! Minimise `½ Σ (θᵢ − restᵢ)² / easeᵢ` subject to `J θ = wanted`, `loᵢ ≤ θᵢ ≤ hiᵢ`. Its dual is concave and piecewise
//! quadratic in λ ∈ R², `θᵢ(λ) = clamp(restᵢ + easeᵢ Jᵢ·λ, loᵢ, hiᵢ)`, and its gradient is what the model still misses,
//! `wanted − J θ(λ)`. Newton's method on that takes one or two steps from the λ of the frame before.
//!
//! Where the box leaves no solution λ would grow without bound. There the gap is *bought* instead: at most [`DEAREST`]
//! of displacement a radian, the exact penalty `DEAREST · |gap|`. So one problem covers both cases, the solution of the
//! second is as well determined as of the first, and it changes into the other without a jump.

use crate::Scalar;

/// An angle of the model.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Angle {
    /// Its column of the Jacobian.
    pub(crate) column: [f32; 2],
    pub(crate) lo: f32,
    pub(crate) hi: f32,
    /// The angle that costs nothing.
    pub(crate) rest: f32,
    /// One over its weight in the displacement; positive.
    pub(crate) ease: f32,
}

/// What a joint without an angle has in its place.
pub(crate) const NO_ANGLE: Angle = Angle { column: [0.0; 2], lo: 0.0, hi: 0.0, rest: 0.0, ease: 1.0 };

impl Angle {
    /// The angle at a dual point.
    #[inline(always)]
    pub(crate) fn at(&self, [x, y]: [f32; 2]) -> f32 {
        let [jx, jy] = self.column;
        (self.rest + self.ease * (jx * x + jy * y)).max(self.lo).min(self.hi)
    }
}

/// The displacement that a radian of gap may cost at most, in units of the most willing joint.
pub(crate) const DEAREST: f32 = 300.0;

/// A gap this small is none, radians.
pub(crate) const CLOSED: f32 = 1e-6;
/// Plain Newton steps, before each is looked at more closely.
const PLAIN_STEPS: usize = 4;

/// What the determinant of the free angles' normal matrix is to its squared trace at least, where they cover both
/// directions of the gaze: a quarter if they do so equally.
pub(crate) const STRAINED: f32 = 0.05;

/// A solution.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Solution {
    /// The dual point: [`Angle::at`] gives the angles.
    pub(crate) lambda: [f32; 2],
    /// Whether nothing is missing any more.
    pub(crate) closed: bool,
    /// Whether the angles that are free to move hardly cover both directions of the gaze: in one of them a little of the
    /// gaze takes much movement.
    pub(crate) strained: bool,
}

/// Solves for these angles, from the dual point `start`.
#[inline(always)]
pub(crate) fn solve(angles: &[[Angle; 2]], wanted: [f32; 2], start: [f32; 2]) -> Solution {
    let mut lambda = start;
    for _ in 0..PLAIN_STEPS {
        let (mut gap, mut hessian) = (wanted, [0.0, 0.0, 0.0]);
        for angle in angles.as_flattened() {
            let [x, y] = angle.column;
            let free = angle.rest + angle.ease * (x * lambda[0] + y * lambda[1]);
            let held = free.max(angle.lo).min(angle.hi);
            let ease = if free == held { angle.ease } else { 0.0 };
            gap = [gap[0] - x * held, gap[1] - y * held];
            let (ex, ey) = (ease * x, ease * y);
            hessian = [hessian[0] + ex * x, hessian[1] + ex * y, hessian[2] + ey * y];
        }
        let missed = gap[0] * gap[0] + gap[1] * gap[1];
        let [xx, xy, yy] = hessian;
        let determinant = xx * yy - xy * xy;
        let trace = xx + yy;
        if missed <= CLOSED * CLOSED {
            return Solution { lambda, closed: true, strained: determinant < STRAINED * trace * trace };
        }
        if !(determinant > 1e-6 * trace * trace) {
            break;
        }
        let inverse = 1.0 / determinant;
        lambda[0] += (yy * gap[0] - xy * gap[1]) * inverse;
        lambda[1] += (xx * gap[1] - xy * gap[0]) * inverse;
        if !(lambda[0] * lambda[0] + lambda[1] * lambda[1] < DEAREST * DEAREST) {
            break;
        }
    }
    solve_with_care(angles, wanted, start)
}

/// The dual at a point, in f64: multipliers may be large where the gap is bought.
struct Dual {
    value: f64,
    gradient: [f64; 2],
    hessian: [f64; 3],
}

fn evaluate(angles: &[[Angle; 2]], wanted: [f32; 2], lambda: [f64; 2], price: f64) -> Dual {
    let wanted = wanted.map(f64::from);
    let [a, b] = lambda;
    let mut dual = Dual {
        value: a * wanted[0] + b * wanted[1] - 0.5 * price * (a * a + b * b),
        gradient: [wanted[0] - price * a, wanted[1] - price * b],
        hessian: [price, 0.0, price],
    };
    for angle in angles.as_flattened() {
        let [x, y] = angle.column.map(f64::from);
        let (rest, ease) = (f64::from(angle.rest), f64::from(angle.ease));
        let pull = x * a + y * b;
        let free = rest + ease * pull;
        let held = free.max(f64::from(angle.lo)).min(f64::from(angle.hi));
        let moved = held - rest;
        dual.value -= pull * held - 0.5 * moved * moved / ease;
        dual.gradient[0] -= x * held;
        dual.gradient[1] -= y * held;
        if free == held {
            dual.hessian[0] += ease * x * x;
            dual.hessian[1] += ease * x * y;
            dual.hessian[2] += ease * y * y;
        }
    }
    dual
}

/// [`solve`] where plain Newton steps do not do: the gap is bought at a price that is raised until it is closed, or
/// until λ has reached what it may cost.
///
/// `price·λ` is the gap at the optimum, so the price that makes |λ| = DEAREST is gap / DEAREST.
#[cold]
#[inline(never)]
fn solve_with_care(angles: &[[Angle; 2]], wanted: [f32; 2], start: [f32; 2]) -> Solution {
    const ROUNDS: usize = 10;
    let dearest = f64::from(DEAREST);
    let mut lambda = start.map(f64::from);
    let length = |[a, b]: [f64; 2]| Scalar::sqrt(a * a + b * b);
    if !(length(lambda) <= dearest) {
        lambda = [0.0; 2];
    }
    let mut price = (length(evaluate(angles, wanted, [0.0; 2], 0.0).gradient) / dearest).max(1e-6);
    let mut gap = f64::INFINITY;
    let mut strained = true;
    for _ in 0..ROUNDS {
        ascend(angles, wanted, price, &mut lambda);
        let paid = length(lambda);
        let dual = evaluate(angles, wanted, lambda, 0.0);
        gap = length(dual.gradient);
        let [xx, xy, yy] = dual.hessian;
        strained = xx * yy - xy * xy < f64::from(STRAINED) * (xx + yy) * (xx + yy);
        if gap <= f64::from(CLOSED) || (0.9..=1.1).contains(&(paid / dearest)) {
            break;
        }
        // A gap that remains costs in inverse proportion to its price. One that is paid for by less can be closed.
        let part = paid / dearest;
        price = (price * if part < 1.0 { part * part * part } else { part }).max(1e-12);
    }
    #[expect(clippy::cast_possible_truncation, reason = "a result in the precision of its inputs")]
    let (lambda, gap) = (lambda.map(|x| x as f32), gap as f32);
    Solution { lambda, closed: gap <= 10.0 * CLOSED, strained }
}

/// Newton's method with Armijo's line search on the concave dual.
fn ascend(angles: &[[Angle; 2]], wanted: [f32; 2], price: f64, lambda: &mut [f64; 2]) {
    const STEPS: usize = 30;
    const HALVINGS: usize = 30;
    let mut here = evaluate(angles, wanted, *lambda, price);
    for _ in 0..STEPS {
        let [gx, gy] = here.gradient;
        let [xx, xy, yy] = here.hessian;
        let determinant = xx * yy - xy * xy;
        if !(determinant > 0.0) {
            return;
        }
        let step = [(yy * gx - xy * gy) / determinant, (xx * gy - xy * gx) / determinant];
        let slope = gx * step[0] + gy * step[1];
        if !(slope > 1e-18) {
            return;
        }
        let mut part = 1.0;
        for halving in 0.. {
            let trial = [lambda[0] + part * step[0], lambda[1] + part * step[1]];
            let there = evaluate(angles, wanted, trial, price);
            // Rounding hides a gain this small; the point is as good.
            let hidden = 1e-14 * (here.value.abs() + there.value.abs());
            if there.value >= here.value + 1e-4 * part * slope - hidden {
                (*lambda, here) = (trial, there);
                break;
            }
            if halving == HALVINGS {
                return;
            }
            part *= 0.5;
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use std::vec::Vec;

    use super::*;

    /// A small generator (splitmix64).
    struct Random(u64);

    impl Random {
        fn between(&mut self, lo: f32, hi: f32) -> f32 {
            self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut z = self.0;
            z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
            let part = f32::from(((z ^ z >> 31) >> 48) as u16) / 65_536.0;
            lo + (hi - lo) * part
        }

        fn angle(&mut self) -> Angle {
            let (a, b) = (self.between(-1.0, 1.0), self.between(-1.0, 1.0));
            Angle {
                column: [self.between(-1.0, 1.0), self.between(-1.0, 1.0)],
                lo: a.min(b),
                hi: a.max(b),
                rest: if a < 0.0 { 0.0 } else { self.between(-1.0, 1.0) },
                ease: 10.0_f32.powf(self.between(-2.0, 0.0)),
            }
        }

        fn problem(&mut self, joints: usize) -> (Vec<[Angle; 2]>, [f32; 2]) {
            let angles: Vec<[Angle; 2]> = (0..joints).map(|_| [self.angle(), self.angle()]).collect();
            let mut wanted = [self.between(-2.0, 2.0), self.between(-2.0, 2.0)];
            if self.between(0.0, 1.0) < 0.6 {
                // What some angles of the box come to.
                wanted = [0.0; 2];
                for angle in angles.as_flattened() {
                    let at = self.between(angle.lo, angle.hi);
                    wanted = [wanted[0] + at * angle.column[0], wanted[1] + at * angle.column[1]];
                }
            }
            (angles, wanted)
        }
    }

    fn cost(angles: &[[Angle; 2]], at: impl Fn(usize) -> f64) -> f64 {
        let terms = angles.as_flattened().iter().enumerate().map(|(i, angle)| {
            let moved = at(i) - f64::from(angle.rest);
            0.5 * moved * moved / f64::from(angle.ease)
        });
        terms.sum()
    }

    fn gap(angles: &[[Angle; 2]], wanted: [f32; 2], at: impl Fn(usize) -> f64) -> [f64; 2] {
        let mut gap = wanted.map(f64::from);
        for (i, angle) in angles.as_flattened().iter().enumerate() {
            let [x, y] = angle.column.map(f64::from);
            gap = [gap[0] - x * at(i), gap[1] - y * at(i)];
        }
        gap
    }

    fn length([x, y]: [f64; 2]) -> f64 {
        x.hypot(y)
    }

    /// The least displacement that meets `wanted`, with its multiplier, by trying every set of angles at their lower and
    /// upper ends; `None` where the box has no solution.
    fn by_every_active_set(angles: &[[Angle; 2]], wanted: [f32; 2]) -> Option<(f64, [f64; 2])> {
        let flat = angles.as_flattened();
        let sets = 3_usize.pow(u32::try_from(flat.len()).unwrap());
        let mut best: Option<(f64, [f64; 2])> = None;
        for set in 0..sets {
            let which = |i: usize| set / 3_usize.pow(u32::try_from(i).unwrap()) % 3;
            let (mut left, [mut xx, mut xy, mut yy]) = (wanted.map(f64::from), [0.0; 3]);
            for (i, angle) in flat.iter().enumerate() {
                let [x, y] = angle.column.map(f64::from);
                let ease = f64::from(angle.ease);
                let at = [angle.rest, angle.lo, angle.hi].map(f64::from)[which(i)];
                left = [left[0] - x * at, left[1] - y * at];
                if which(i) == 0 {
                    [xx, xy, yy] = [xx + ease * x * x, xy + ease * x * y, yy + ease * y * y];
                }
            }
            let determinant = xx * yy - xy * xy;
            if determinant <= 1e-12 * (xx + yy) * (xx + yy) {
                continue;
            }
            let lambda = [(yy * left[0] - xy * left[1]) / determinant, (xx * left[1] - xy * left[0]) / determinant];
            let at = |i: usize| {
                let [x, y] = flat[i].column.map(f64::from);
                let free = f64::from(flat[i].rest) + f64::from(flat[i].ease) * (x * lambda[0] + y * lambda[1]);
                [free, flat[i].lo.into(), flat[i].hi.into()][which(i)]
            };
            let within = |i: usize| (f64::from(flat[i].lo) - 1e-9..=f64::from(flat[i].hi) + 1e-9).contains(&at(i));
            if (0..flat.len()).all(within) && best.is_none_or(|(least, _)| cost(angles, at) < least) {
                best = Some((cost(angles, at), lambda));
            }
        }
        best
    }

    #[test]
    fn the_optimum_of_every_active_set() {
        let dearest = f64::from(DEAREST);
        let mut random = Random(1);
        let mut seen = [0; 3];
        for case in 0..1500 {
            let (angles, wanted) = random.problem(1 + case % 3);
            let start = [random.between(-3.0, 3.0), random.between(-3.0, 3.0)];
            let solution = solve(&angles, wanted, if case % 2 == 0 { start } else { [0.0; 2] });
            let at = |i: usize| f64::from(angles.as_flattened()[i].at(solution.lambda));
            let (found, missed) = (cost(&angles, at), gap(&angles, wanted, at));
            match by_every_active_set(&angles, wanted) {
                Some((least, lambda)) if length(lambda) < 0.8 * dearest => {
                    seen[0] += 1;
                    assert!(solution.closed && length(missed) < 3e-5, "case {case}: {solution:?} misses {missed:?}");
                    assert!((found - least).abs() < 1e-3 * least + 1e-4, "case {case}: {found} instead of {least}");
                }
                // It can be met, for more than is paid for it.
                Some((least, lambda)) if length(lambda) > 1.3 * dearest => {
                    seen[1] += 1;
                    assert!(found <= least * 1.001 + 1e-4, "case {case}: {found} instead of {least}");
                }
                Some(_) => {}
                None => {
                    seen[2] += 1;
                    assert!(!solution.closed, "case {case}: {solution:?}");
                    bought(&mut random, &angles, wanted, &solution);
                }
            }
        }
        assert!(seen[0] > 400 && seen[2] > 100, "{seen:?}");
    }

    /// Optimality where the box has no solution: the gap is along λ, which is as long as it may be, and nothing at random
    /// in the box is worth more.
    fn bought(random: &mut Random, angles: &[[Angle; 2]], wanted: [f32; 2], solution: &Solution) {
        let dearest = f64::from(DEAREST);
        let lambda = solution.lambda.map(f64::from);
        let at = |i: usize| f64::from(angles.as_flattened()[i].at(solution.lambda));
        let missed = gap(angles, wanted, at);
        let across = (lambda[0] * missed[1] - lambda[1] * missed[0]) / length(lambda) / length(missed);
        assert!(across.abs() < 1e-2, "{solution:?}: {missed:?}");
        assert!((0.85..1.15).contains(&(length(lambda) / dearest)), "{solution:?}");
        let found = cost(angles, at) + dearest * length(missed);
        for _ in 0..100 {
            let flat = angles.as_flattened();
            let other: Vec<f64> = flat.iter().map(|angle| random.between(angle.lo, angle.hi).into()).collect();
            let value = cost(angles, |i| other[i]) + dearest * length(gap(angles, wanted, |i| other[i]));
            assert!(found <= 1.01 * value, "{solution:?}: {found} but {value}");
        }
    }

    /// Weights matter by their ratios alone, wherever the price of a gap has no say.
    #[test]
    fn scaled_weights() {
        let mut random = Random(2);
        for case in 0..500 {
            let (angles, wanted) = random.problem(3);
            let plain = solve(&angles, wanted, [0.0; 2]);
            let scaled: Vec<[Angle; 2]> =
                angles.iter().map(|joint| joint.map(|angle| Angle { ease: 1e3 * angle.ease, ..angle })).collect();
            let other = solve(&scaled, wanted, [0.0; 2]);
            if plain.closed && other.closed {
                for (a, b) in angles.as_flattened().iter().zip(scaled.as_flattened()) {
                    let (a, b) = (a.at(plain.lambda), b.at(other.lambda));
                    assert!((a - b).abs() < 2e-3, "case {case}: {a} {b}");
                }
            }
            assert!(other.closed || !plain.closed, "case {case}");
        }
    }

    /// Whatever the numbers: an angle of the box, or not a number where a number was none.
    #[test]
    fn awkward_numbers() {
        const AWKWARD: [f32; 8] = [0.0, -0.0, 1e20, 1e-30, f32::INFINITY, f32::NAN, 1.0, -1.0];
        for a in AWKWARD {
            for b in AWKWARD {
                let angle = Angle { column: [a, b], lo: -1.0, hi: 1.0, rest: 0.0, ease: 1.0 };
                let solution = solve(&[[angle, NO_ANGLE], [angle, NO_ANGLE]], [b, a], [a, a]);
                assert!((-1.0..=1.0).contains(&angle.at(solution.lambda)), "{a}, {b}: {solution:?}");
            }
        }
    }
}
