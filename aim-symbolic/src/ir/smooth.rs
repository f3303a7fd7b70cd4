//! Functions of s = r² that are smooth where their closed forms in r are 0 / 0, and whose derivatives are functions of
//! the same family.
//!
//! The Stumpff functions are c₀ = cos r, c₁ = sin r / r, c₂ = (1 − cos r)/r², c₃ = (r − sin r)/r³ and so on,
//! cₖ(s) = Σ (−s)ʲ/(k + 2j)!, with cₖ = 1/k! − s cₖ₊₂ and dcₖ/ds = (k cₖ₊₂ − cₖ₊₁)/2 (Danby, *Fundamentals of Celestial
//! Mechanics*, 1988, § 6.9). Their hyperbolic counterparts are cₖ(−s).
//!
//! The arc function is a₀(s, w) = atan2(r, w)/r. With D = 2 ∂/∂s, q = s + w² and tⱼ = (−2)ʲ j!/qʲ⁺¹, its derivatives
//! aⱼ = Dʲ a₀ satisfy s aⱼ₊₁ = w tⱼ − (2j + 1) aⱼ and ∂aⱼ/∂w = −tⱼ. Near s = 0, for w > 0, they are
//! aⱼ = w tⱼ/(2j + 1) F(1, j + 1; j + 3/2; s/q) with the hypergeometric function F.

/// A Stumpff function cₖ(s), or its hyperbolic counterpart cₖ(−s).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Stumpff {
    /// `true` for cₖ(−s), the hyperbolic counterpart.
    pub hyperbolic: bool,
    /// The order k.
    pub order: u8,
}

/// k!
pub(crate) fn factorial(k: u8) -> f64 {
    (1..=k).map(f64::from).product()
}

/// Returns (−2)ʲ j!, the constant factor of tⱼ = (−2)ʲ j!/qʲ⁺¹.
pub(crate) fn arc_factor(order: u8) -> f64 {
    (-2.0_f64).powi(order.into()) * factorial(order)
}

impl Stumpff {
    /// Returns the function of the same kind with another order.
    pub(crate) fn of_order(self, order: u8) -> Self {
        Self { order, ..self }
    }

    /// Returns cₖ(s), or cₖ(−s) if hyperbolic: by its series for |s| < 1, else by cₖ₊₂ = (1/k! − cₖ)/s.
    pub(crate) fn value(self, s: f64) -> f64 {
        let s = if self.hyperbolic { -s } else { s };
        if s.abs() < 1.0 {
            let mut term = 1.0 / factorial(self.order);
            let mut sum = 0.0;
            for j in 0..12 {
                sum += term;
                let next = f64::from(self.order) + f64::from(2 * j + 1);
                term *= -s / (next * (next + 1.0));
            }
            return sum;
        }
        let r = s.abs().sqrt();
        let lowest = match (s < 0.0, self.order % 2 == 0) {
            (false, true) => r.cos(),
            (false, false) => r.sin() / r,
            (true, true) => r.cosh(),
            (true, false) => r.sinh() / r,
        };
        (self.order % 2..self.order).step_by(2).fold(lowest, |c, k| (1.0 / factorial(k) - c) / s)
    }
}

/// Returns aⱼ(s, w): for w > 0 and small s/q by its series, else by the recurrence.
pub(crate) fn arc_value(order: u8, s: f64, w: f64) -> f64 {
    let q = s + w * w;
    if w > 0.0 && s < q / 4.0 {
        let b = f64::from(order) + 1.0;
        let mut term = w * arc_factor(order) / q.powi(i32::from(order) + 1) / (2.0 * b - 1.0);
        let mut sum = 0.0;
        for k in 0..40 {
            sum += term;
            term *= (b + f64::from(k)) / (b + 0.5 + f64::from(k)) * s / q;
        }
        return sum;
    }
    if s <= 0.0 {
        return 0.0;
    }
    let lowest = s.sqrt().atan2(w) / s.sqrt();
    (0..order).fold(lowest, |a, j| (w * arc_factor(j) / q.powi(i32::from(j) + 1) - (2.0 * f64::from(j) + 1.0) * a) / s)
}
