//! Minimises the stiffness-weighted displacement that a linear model of the gaze requires: a quadratic program over all
//! angles whose dual has two unknowns, regardless of the number of joints.
//!
//! Minimise `½ Σ (θᵢ − restᵢ)² / easeᵢ` subject to `J θ = wanted`, `loᵢ ≤ θᵢ ≤ hiᵢ`. The dual is concave and piecewise
//! quadratic in λ ∈ R², with `θᵢ(λ) = clamp(restᵢ + easeᵢ Jᵢ·λ, loᵢ, hiᵢ)`. Its gradient is the remaining gap of the
//! model, `wanted − J θ(λ)`. Newton's method converges in one or two steps from the λ of the last frame.
//!
//! If the box contains no solution, λ would grow without bound. The constraint is then replaced by the exact penalty
//! `gap_price · |gap|`, which limits |λ| to `gap_price`: a radian of gap is closed only if that costs at most
//! `gap_price` of displacement. The same problem covers both cases. Its solution is equally well determined in both,
//! and changes continuously from one to the other.

use crate::Scalar;

/// An angle of the linear model.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Angle {
    /// The angle's column of the Jacobian.
    pub(crate) column: [f32; 2],
    pub(crate) lo: f32,
    pub(crate) hi: f32,
    /// The angle at which the displacement is 0.
    pub(crate) rest: f32,
    /// Reciprocal of the angle's weight in the displacement; positive.
    pub(crate) ease: f32,
}

/// Placeholder for an angle that a joint lacks.
pub(crate) const NO_ANGLE: Angle = Angle { column: [0.0; 2], lo: 0.0, hi: 0.0, rest: 0.0, ease: 1.0 };

impl Angle {
    /// Returns the angle at a dual point.
    #[inline(always)]
    fn at(&self, [x, y]: [f32; 2]) -> f32 {
        let [jx, jy] = self.column;
        (self.rest + self.ease * (jx * x + jy * y)).max(self.lo).min(self.hi)
    }
}

/// Least price of a radian of gap: the displacement it may cost, in units of the joint of lowest stiffness.
pub(crate) const MIN_GAP_PRICE: f32 = 300.0;
/// Price of a radian of gap in units of the joint of highest stiffness, which may have to close the rest of the gap
/// alone.
const GAP_PRICE_OF_STIFFEST: f32 = 400.0;
/// Largest price of a radian of gap; beyond it, single precision cannot resolve the displacement.
const MAX_GAP_PRICE: f32 = 1e5;

/// Returns the price of a radian of gap for angles of which this is the least ease.
pub(crate) fn gap_price(least_ease: f32) -> f32 {
    (GAP_PRICE_OF_STIFFEST / least_ease).max(MIN_GAP_PRICE).min(MAX_GAP_PRICE)
}

/// A gap of at most this counts as closed, radians.
pub(crate) const CLOSED: f32 = 1e-6;
/// Number of plain Newton steps before [`solve_in_double_precision`] takes over.
const PLAIN_STEPS: usize = 4;

/// Ratio of the determinant of the free angles' normal matrix to its squared trace, below which they hardly cover both
/// directions of the gaze. The ratio is 1/4 if they cover both equally.
pub(crate) const STRAINED: f32 = 0.05;

/// A solution of the dual.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Solution {
    /// The dual point.
    pub(crate) lambda: [f32; 2],
    /// The dual point in double precision, if plain Newton steps did not suffice.
    precise: Option<[f64; 2]>,
    /// `true` if no gap remains.
    pub(crate) closed: bool,
    /// `true` if the free angles hardly cover both directions of the gaze, so that in one of them a small change of the
    /// gaze takes a large movement.
    pub(crate) strained: bool,
}

impl Solution {
    /// Returns an angle of the model in this solution.
    #[inline(always)]
    pub(crate) fn of(&self, angle: &Angle) -> f32 {
        match self.precise {
            None => angle.at(self.lambda),
            #[expect(clippy::cast_possible_truncation, reason = "a result in the precision of its inputs")]
            Some(lambda) => angle.precisely_at(lambda).1 as f32,
        }
    }
}

/// Solves for these angles, starting from the dual point `start`.
#[inline(always)]
pub(crate) fn solve(angles: &[[Angle; 2]], wanted: [f32; 2], start: [f32; 2], gap_price: f32) -> Solution {
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
        if !(lambda[0] * lambda[0] + lambda[1] * lambda[1] < gap_price * gap_price) {
            break;
        }
    }
    solve_in_double_precision(angles, wanted, start, gap_price)
}

/// Gap and Hessian of the dual at a point, without the penalty, in f64: multipliers may be large when the gap is
/// penalised.
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
    /// Returns the angle at a dual point, before and after clamping to its bounds.
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

/// Solves where plain Newton steps fail: subtracts `½·price·|λ|²` from the dual and adjusts `price` until the gap
/// closes or |λ| is near `gap_price`.
///
/// At the optimum the gap is `price·λ`, so the price for which `|λ| = gap_price` is `|gap| / gap_price`.
#[cold]
#[inline(never)]
fn solve_in_double_precision(angles: &[[Angle; 2]], wanted: [f32; 2], start: [f32; 2], gap_price: f32) -> Solution {
    const ROUNDS: usize = 10;
    let gap_price = f64::from(gap_price);
    let mut lambda = start.map(f64::from);
    if !(length(lambda) <= 1.1 * gap_price) {
        lambda = [0.0; 2];
    }
    let mut here = Dual::at(angles, wanted, lambda);
    // A start that large had a gap that is likely to remain.
    let there = if length(lambda) > 0.8 * gap_price { here.gap } else { Dual::at(angles, wanted, [0.0; 2]).gap };
    let mut price = (length(there) / gap_price).max(1e-6);
    for _ in 0..ROUNDS {
        ascend(angles, wanted, price, &mut lambda, &mut here);
        let paid = length(lambda) / gap_price;
        if length(here.gap) <= f64::from(CLOSED) || (0.9..=1.1).contains(&paid) {
            break;
        }
        // Newton's step on 1 / |λ|, which is nearly linear in the price.
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

/// Maximises the concave dual, less the quadratic penalty, by Newton's method with an exact line search.
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

/// Returns the part of a step at which the dual is highest, from the slopes at its start and end. The slope is
/// piecewise linear, with kinks where an angle meets a bound.
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
                // The image of a random point of the box, so that a solution exists.
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

    /// Returns the least displacement that meets `wanted`, with its multiplier, by enumerating every set of active
    /// bounds; `None` if the box has no solution.
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
    fn solutions_agree_with_enumerated_active_sets() {
        let gap_price = f64::from(MIN_GAP_PRICE);
        let mut random = Random(1);
        let mut seen = [0; 3];
        for case in 0..1500 {
            let (angles, wanted) = random.problem(1 + case % 3);
            let start = [random.between(-3.0, 3.0), random.between(-3.0, 3.0)];
            let solution = solve(&angles, wanted, if case % 2 == 0 { start } else { [0.0; 2] }, MIN_GAP_PRICE);
            let at = |i: usize| f64::from(angles.as_flattened()[i].at(solution.lambda));
            let (found, missed) = (cost(&angles, at), gap(&angles, wanted, at));
            match by_every_active_set(&angles, wanted) {
                Some((least, lambda)) if length(lambda) < 0.8 * gap_price => {
                    seen[0] += 1;
                    assert!(solution.closed && length(missed) < 3e-5, "case {case}: {solution:?} misses {missed:?}");
                    assert!((found - least).abs() < 1e-3 * least + 1e-4, "case {case}: {found} instead of {least}");
                }
                // A solution exists, but costs more than the price allows.
                Some((least, lambda)) if length(lambda) > 1.3 * gap_price => {
                    seen[1] += 1;
                    assert!(found <= least * 1.001 + 1e-4, "case {case}: {found} instead of {least}");
                }
                Some(_) => {}
                None => {
                    seen[2] += 1;
                    assert!(!solution.closed, "case {case}: {solution:?}");
                    assert_penalised_optimum(&mut random, &angles, wanted, &solution);
                }
            }
        }
        assert!(seen[0] > 400 && seen[2] > 100, "{seen:?}");
    }

    /// Checks optimality where the box has no solution: the gap is parallel to λ, |λ| equals the price, and no random
    /// point of the box has a lower cost.
    fn assert_penalised_optimum(random: &mut Random, angles: &[[Angle; 2]], wanted: [f32; 2], solution: &Solution) {
        let gap_price = f64::from(MIN_GAP_PRICE);
        let lambda = solution.lambda.map(f64::from);
        let at = |i: usize| f64::from(angles.as_flattened()[i].at(solution.lambda));
        let missed = gap(angles, wanted, at);
        let across = (lambda[0] * missed[1] - lambda[1] * missed[0]) / length(lambda) / length(missed);
        assert!(across.abs() < 1e-2, "{solution:?}: {missed:?}");
        assert!((0.85..1.15).contains(&(length(lambda) / gap_price)), "{solution:?}");
        let found = cost(angles, at) + gap_price * length(missed);
        for _ in 0..100 {
            let flat = angles.as_flattened();
            let other: Vec<f64> = flat.iter().map(|angle| random.between(angle.lo, angle.hi).into()).collect();
            let value = cost(angles, |i| other[i]) + gap_price * length(gap(angles, wanted, |i| other[i]));
            assert!(found <= 1.01 * value, "{solution:?}: {found} but {value}");
        }
    }

    /// Only the ratios of weights matter, unless the price of a gap limits the solution.
    #[test]
    fn only_ratios_of_weights_matter() {
        let mut random = Random(2);
        for case in 0..500 {
            let (angles, wanted) = random.problem(3);
            let plain = solve(&angles, wanted, [0.0; 2], MIN_GAP_PRICE);
            let scaled: Vec<[Angle; 2]> =
                angles.iter().map(|joint| joint.map(|angle| Angle { ease: 1e3 * angle.ease, ..angle })).collect();
            let other = solve(&scaled, wanted, [0.0; 2], MIN_GAP_PRICE);
            if plain.closed && other.closed {
                for (a, b) in angles.as_flattened().iter().zip(scaled.as_flattened()) {
                    let (a, b) = (a.at(plain.lambda), b.at(other.lambda));
                    assert!((a - b).abs() < 2e-3, "case {case}: {a} {b}");
                }
            }
            assert!(other.closed || !plain.closed, "case {case}");
        }
    }

    /// Whatever the input, every angle stays in the box.
    #[test]
    fn invalid_numbers_stay_in_the_box() {
        const AWKWARD: [f32; 8] = [0.0, -0.0, 1e20, 1e-30, f32::INFINITY, f32::NAN, 1.0, -1.0];
        for a in AWKWARD {
            for b in AWKWARD {
                let angle = Angle { column: [a, b], lo: -1.0, hi: 1.0, rest: 0.0, ease: 1.0 };
                let solution = solve(&[[angle, NO_ANGLE], [angle, NO_ANGLE]], [b, a], [a, a], MIN_GAP_PRICE);
                assert!((-1.0..=1.0).contains(&angle.at(solution.lambda)), "{a}, {b}: {solution:?}");
            }
        }
    }
}
