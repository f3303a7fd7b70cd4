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
        price = (price * paid / dearest).max(1e-12);
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
