//! One term of the target constraint: the change of a bone's position in its neighbours' frame, and its nine
//! derivatives.
//!
//! For three points, with `a = p₁ − p₀`, `c = p₂ − p₀`, `A = c / |c|`: `α = a · A` is the component along,
//! `β = |a × A| = |a − α A|` the distance across. The term is `(α₀ − α)² + (β₀ − β)²`.
//!
//! **A is never formed.** With `r = 1 / |c|` and `k = α r`: `w = a − α A = a − k c`, which is perpendicular to `c`;
//! `β = |w|`.
//!
//! ```text
//! ∂α/∂a = A     ∂β/∂a = w / β     ∂α/∂c = r w     ∂β/∂c = −k w / β
//! ```
//!
//! A change of `c` along itself has no effect; a change across it, along `w`, rotates `A` by `r` times the change. With
//! `x = 2 (α − α₀)`, `y = 2 (β − β₀)`, `μ = y / β`, `λ = r x`, `ν = λ − μ k`:
//!
//! ```text
//! ∂/∂c = x r w − y k w / β = ν w     ∂/∂a = x A + y w / β = λ c + μ w
//! ```
//!
//! The gradient of the third point follows by translation: the three gradients sum to 0.
//!
//! | | |
//! |---|---|
//! | a, c | 6 |
//! | \|c\|, r, a · c, α, k | 6 + 1 + 5 + 1 + 1 |
//! | w, β | 6 + 6 |
//! | α − α₀, β − β₀, the term | 2 + 3 |
//! | x, y, λ, μ, ν | 1 + 1 + 1 + 1 + 2 |
//! | ∂/∂a, ∂/∂c, their sum | 9 + 3 + 3 |
//! | | 58 |
//!
//! Rejected:
//! - Forming A: costs 3, saves 2 of the factors r: 59.
//! - `k = a · c / c · c` and `α = k |c|`, `λ = x / |c|`: 57, but with one more division by the same length.
//! - `β² = a · a − α²`: cancels where the trajectory is nearly straight, and is no cheaper, since w is needed anyway.
//! - The cross product: 9 instead of 6.
//!
//! If the trajectory is straight, β = 0: the direction of w is undefined, and the derivative of β is set to 0. If
//! `p₂ = p₀`, r = 0: α = 0 and β = |a|.

use aim_symbolic::Number;

use super::algebra::{over, reciprocal};

fn sub<T: Number>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot<T: Number>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Returns the term and its gradients by p₀, p₁ and p₂: 58 operations. `rest` holds α₀ and β₀.
#[inline]
pub fn term_gradient<T: Number>(points: [[T; 3]; 3], rest: [T; 2]) -> (T, [[T; 3]; 3]) {
    let [p0, p1, p2] = points;
    let (a, c) = (sub(p1, p0), sub(p2, p0));
    let r = reciprocal(dot(c, c).sqrt());
    let alpha = r * dot(a, c);
    let k = r * alpha;
    let w = sub(a, c.map(|c| k * c));
    let beta = dot(w, w).sqrt();

    let (along, across) = (alpha - rest[0], beta - rest[1]);
    let value = along * along + across * across;

    let lambda = r * (along + along);
    let mu = over(across + across, beta);
    let nu = lambda - mu * k;
    let by_a: [T; 3] = core::array::from_fn(|i| lambda * c[i] + mu * w[i]);
    let by_c = w.map(|w| nu * w);
    let by_p0 = core::array::from_fn(|i| -(by_a[i] + by_c[i]));
    (value, [by_p0, by_a, by_c])
}
