//! The least stiffness-weighted displacement that a linear model of the gaze allows: a quadratic problem over all angles
//! whose dual has two unknowns, whatever the number of joints.
//!
//! Minimise `½ Σ (θᵢ − restᵢ)² / easeᵢ` subject to `J θ = wanted`, `loᵢ ≤ θᵢ ≤ hiᵢ`. Its dual is concave and piecewise
//! quadratic in λ ∈ R², `θᵢ(λ) = clamp(restᵢ + easeᵢ Jᵢ·λ, loᵢ, hiᵢ)`, and its gradient is what the model still misses,
//! `wanted − J θ(λ)`. Newton's method on that takes one or two steps from the λ of the frame before.
//!
//! Where the box leaves no solution λ would grow without bound. There the gap is *bought* instead: at most `dearest`
//! of displacement a radian, the exact penalty `dearest · |gap|`. So one problem covers both cases, the solution of the
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
    fn at(&self, [x, y]: [f32; 2]) -> f32 {
        let [jx, jy] = self.column;
        (self.rest + self.ease * (jx * x + jy * y)).max(self.lo).min(self.hi)
    }
}

/// The displacement that a radian of gap may cost at most, in units of the most willing joint: so much always…
pub(crate) const DEAREST: f32 = 300.0;
/// … and so much in units of the most reluctant one, who may have to make the last of the way…
const DEAREST_TO_THE_RELUCTANT: f32 = 400.0;
/// … as far as that can be told from the displacement in single precision.
const DEAREST_OF_ALL: f32 = 1e5;

/// What a radian of gap may cost where this is the least ease.
pub(crate) fn dearest(least_ease: f32) -> f32 {
    (DEAREST_TO_THE_RELUCTANT / least_ease).max(DEAREST).min(DEAREST_OF_ALL)
}

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
    /// The dual point.
    pub(crate) lambda: [f32; 2],
    /// The same where it took more digits.
    precise: Option<[f64; 2]>,
    /// Whether nothing is missing any more.
    pub(crate) closed: bool,
    /// Whether the angles that are free to move hardly cover both directions of the gaze: in one of them a little of the
    /// gaze takes much movement.
    pub(crate) strained: bool,
}

impl Solution {
    /// An angle of the model in this solution.
    #[inline(always)]
    pub(crate) fn of(&self, angle: &Angle) -> f32 {
        match self.precise {
            None => angle.at(self.lambda),
            #[expect(clippy::cast_possible_truncation, reason = "a result in the precision of its inputs")]
            Some(lambda) => angle.precisely_at(lambda).1 as f32,
        }
    }
}

/// Solves for these angles, from the dual point `start`.
#[inline(always)]
pub(crate) fn solve(angles: &[[Angle; 2]], wanted: [f32; 2], start: [f32; 2], dearest: f32) -> Solution {
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
            return Solution { lambda, precise: None, closed: true, strained: determinant < STRAINED * trace * trace };
        }
        if !(determinant > 1e-6 * trace * trace) {
            break;
        }
        let inverse = 1.0 / determinant;
        lambda[0] += (yy * gap[0] - xy * gap[1]) * inverse;
        lambda[1] += (xx * gap[1] - xy * gap[0]) * inverse;
        if !(lambda[0] * lambda[0] + lambda[1] * lambda[1] < dearest * dearest) {
            break;
        }
    }
    solve_with_care(angles, wanted, start, dearest)
}

/// The dual's first two derivatives at a point, less what the gap costs, in f64: multipliers may be large where the gap
/// is bought.
struct Dual {
    gap: [f64; 2],
    hessian: [f64; 3],
}

impl Dual {
    fn at(angles: &[[Angle; 2]], wanted: [f32; 2], lambda: [f64; 2]) -> Self {
        let mut dual = Self { gap: wanted.map(f64::from), hessian: [0.0; 3] };
        for angle in angles.as_flattened() {
            let ([x, y], ease) = (angle.column.map(f64::from), f64::from(angle.ease));
            let (free, held) = angle.precisely_at(lambda);
            dual.gap[0] -= x * held;
            dual.gap[1] -= y * held;
            let ease = if free == held { ease } else { 0.0 };
            dual.hessian[0] += ease * x * x;
            dual.hessian[1] += ease * x * y;
            dual.hessian[2] += ease * y * y;
        }
        dual
    }

    fn priced_hessian(&self, price: f64) -> [f64; 3] {
        [self.hessian[0] + price, self.hessian[1], self.hessian[2] + price]
    }
}

impl Angle {
    /// The angle at a dual point, free of its bounds and held by them.
    #[inline(always)]
    fn precisely_at(&self, lambda: [f64; 2]) -> (f64, f64) {
        let free = f64::from(self.rest) + f64::from(self.ease) * dot(self.column.map(f64::from), lambda);
        let (lo, hi) = (f64::from(self.lo), f64::from(self.hi));
        let above = if free > lo { free } else { lo };
        (free, if above < hi { above } else { hi })
    }
}

#[inline(always)]
fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn length(a: [f64; 2]) -> f64 {
    Scalar::sqrt(dot(a, a))
}

/// [`solve`] where plain Newton steps do not do: the gap is bought at a price that is raised until it is closed, or
/// until λ has reached what it may cost.
///
/// `price·λ` is the gap at the optimum, so the price that makes |λ| = dearest is gap / dearest.
#[cold]
#[inline(never)]
fn solve_with_care(angles: &[[Angle; 2]], wanted: [f32; 2], start: [f32; 2], dearest: f32) -> Solution {
    const ROUNDS: usize = 10;
    let dearest = f64::from(dearest);
    let mut lambda = start.map(f64::from);
    if !(length(lambda) <= 1.1 * dearest) {
        lambda = [0.0; 2];
    }
    let mut here = Dual::at(angles, wanted, lambda);
    // A start as dear as that had a gap to buy, and likely has it still.
    let there = if length(lambda) > 0.8 * dearest { here.gap } else { Dual::at(angles, wanted, [0.0; 2]).gap };
    let mut price = (length(there) / dearest).max(1e-6);
    for _ in 0..ROUNDS {
        ascend(angles, wanted, price, &mut lambda, &mut here);
        let paid = length(lambda) / dearest;
        if length(here.gap) <= f64::from(CLOSED) || (0.9..=1.1).contains(&paid) {
            break;
        }
        // Newton's step on 1 / |λ|, which is nearly straight in the price.
        let ([a, b], [xx, xy, yy]) = (lambda, here.priced_hessian(price));
        let bend = (yy * a * a - 2.0 * xy * a * b + xx * b * b) / (xx * yy - xy * xy);
        let step = (a * a + b * b) / bend * (paid - 1.0);
        price = (if step.is_finite() { price + step } else { price * paid }).max(1e-3 * price).max(1e-12);
    }
    let [xx, xy, yy] = here.hessian;
    let strained = xx * yy - xy * xy < f64::from(STRAINED) * (xx + yy) * (xx + yy);
    #[expect(clippy::cast_possible_truncation, reason = "a result in the precision of its inputs")]
    let (rounded, gap) = (lambda.map(|x| x as f32), length(here.gap) as f32);
    Solution { lambda: rounded, precise: Some(lambda), closed: gap <= 10.0 * CLOSED, strained }
}

/// Newton's method with an exact line search on the concave dual, less what the gap costs.
fn ascend(angles: &[[Angle; 2]], wanted: [f32; 2], price: f64, lambda: &mut [f64; 2], here: &mut Dual) {
    const STEPS: usize = 30;
    for _ in 0..STEPS {
        let [gx, gy] = [here.gap[0] - price * lambda[0], here.gap[1] - price * lambda[1]];
        let [xx, xy, yy] = here.priced_hessian(price);
        let determinant = xx * yy - xy * xy;
        if !(determinant > 0.0) {
            return;
        }
        let step = [(yy * gx - xy * gy) / determinant, (xx * gy - xy * gx) / determinant];
        let slope = gx * step[0] + gy * step[1];
        if !(slope > 1e-14) {
            return;
        }
        let whole = [lambda[0] + step[0], lambda[1] + step[1]];
        let there = Dual::at(angles, wanted, whole);
        let steepness = dot(there.gap, step) - price * dot(whole, step);
        if steepness >= -0.1 * slope {
            (*lambda, *here) = (whole, there);
            continue;
        }
        let part = summit(angles, wanted, price, *lambda, step, [slope, steepness]);
        *lambda = [lambda[0] + part * step[0], lambda[1] + part * step[1]];
        *here = Dual::at(angles, wanted, *lambda);
    }
}

/// The part of a step that leads highest, with the slopes at its start and at its end: between two points at which an
/// angle meets a bound the slope is straight.
fn summit(
    angles: &[[Angle; 2]],
    wanted: [f32; 2],
    price: f64,
    lambda: [f64; 2],
    step: [f64; 2],
    slopes: [f64; 2],
) -> f64 {
    let slope = |part: f64| {
        let there = [lambda[0] + part * step[0], lambda[1] + part * step[1]];
        let mut slope = dot(wanted.map(f64::from), step) - price * dot(there, step);
        for angle in angles.as_flattened() {
            slope -= dot(angle.column.map(f64::from), step) * angle.precisely_at(there).1;
        }
        slope
    };
    let ([mut from, mut to], [mut up, mut down]) = ([0.0, 1.0], slopes);
    for angle in angles.as_flattened() {
        let speed = f64::from(angle.ease) * dot(angle.column.map(f64::from), step);
        let (free, _) = angle.precisely_at(lambda);
        for bound in [angle.lo, angle.hi] {
            let part = (f64::from(bound) - free) / speed;
            if part > from && part < to {
                let slope = slope(part);
                if slope > 0.0 {
                    (from, up) = (part, slope);
                } else {
                    (to, down) = (part, slope);
                }
            }
        }
    }
    from + (to - from) * (up / (up - down))
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
            let solution = solve(&angles, wanted, if case % 2 == 0 { start } else { [0.0; 2] }, DEAREST);
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
            let plain = solve(&angles, wanted, [0.0; 2], DEAREST);
            let scaled: Vec<[Angle; 2]> =
                angles.iter().map(|joint| joint.map(|angle| Angle { ease: 1e3 * angle.ease, ..angle })).collect();
            let other = solve(&scaled, wanted, [0.0; 2], DEAREST);
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
                let solution = solve(&[[angle, NO_ANGLE], [angle, NO_ANGLE]], [b, a], [a, a], DEAREST);
                assert!((-1.0..=1.0).contains(&angle.at(solution.lambda)), "{a}, {b}: {solution:?}");
            }
        }
    }
}
