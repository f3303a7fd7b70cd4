//! Checks differentiated functions against references that are independent of their derivation: central differences of
//! the function as written, dual numbers through a second implementation of the objective, and single against double
//! precision.
//!
//! Functions are passed as they are: [`Function`] calls them with plain numbers, argument by argument. The arguments to
//! differentiate by come first, in the order of `wrt`.

pub mod dual;
mod function;
mod random;

use num_dual::{Dual64, HyperDual64};

pub use self::function::{Argument, ByRows, Function, Numbers, Rows, by_rows};
pub use self::random::Random;

/// Number of random points for each objective.
const POINTS: usize = 10_000;

/// Step of the central differences. A kink must be more than three steps away from a point.
const STEP: f64 = 1e-3;

/// Largest error against central differences, relative to the largest number compared, or to 1 if all are smaller.
const DIFFERENCES: f64 = 1e-6;
/// Largest error against dual numbers, relative to the largest number compared, or to 1 if all are smaller.
const DUAL: f64 = 1e-10;

/// Largest error of single precision, in units of the change that rounding the arguments causes. Small angles computed
/// from their cosine come closest to it.
const SINGLE: f64 = 32.0;

/// A sampler of the points at which an objective is checked.
#[derive(Debug)]
pub struct At<S>(pub S);

impl<S: Fn(&mut Random) -> Vec<f64>> At<S> {
    /// Checks value and first derivatives, in both precisions.
    ///
    /// # Panics
    /// Panics if one of them is wrong.
    pub fn check<F, G, H, D>(
        &self,
        function: impl Function<f64, F>,
        derivatives: impl Function<f64, G>,
        single: impl Function<f64, H>,
        dual: impl Function<Dual64, D>,
    ) {
        let mut errors = Errors::default();
        let mut random = Random::new(1);
        for _ in 0..POINTS {
            let point = self.point(&mut random);
            let (value, found) = (function.feed(&point), derivatives.feed(&point));
            let variables = found.len() / value.len() - 1;
            let with_eps = |k: Option<usize>| {
                let numbers = point.iter().enumerate();
                numbers.map(|(i, &x)| Dual64::new(x, f64::from(Some(i) == k))).collect::<Vec<_>>()
            };
            let of_duals = dual.feed(&with_eps(None)).into_iter().map(|x| x.re);
            let by_duals = (0..variables).flat_map(|k| dual.feed(&with_eps(Some(k))).into_iter().map(|x| x.eps));
            let by_differences = (0..variables).flat_map(|k| difference(|x| function.feed(x), &point, k));
            errors.dual.compare(&point, &found, &of_duals.chain(by_duals).collect::<Vec<_>>());
            errors.differences.compare(&point, &found, &value.into_iter().chain(by_differences).collect::<Vec<_>>());
            errors.single(&point, &single, &derivatives, &found, &mut random);
        }
        errors.judge();
    }

    /// Checks the second derivatives, in both precisions. The central differences are those of `gradient`, which
    /// [`check`](Self::check) checks.
    ///
    /// # Panics
    /// Panics if one of them is wrong.
    pub fn check_second<G, H, I, D>(
        &self,
        gradient: impl Function<f64, G>,
        derivatives: impl Function<f64, H>,
        single: impl Function<f64, I>,
        dual: impl Function<HyperDual64, D>,
    ) {
        let mut errors = Errors::default();
        let mut random = Random::new(2);
        for _ in 0..POINTS {
            let point = self.point(&mut random);
            let (first, found) = (gradient.feed(&point), derivatives.feed(&point));
            let variables = first.len() - 1;
            let with_eps = |i: usize, k: usize| {
                let numbers = point.iter().enumerate();
                numbers
                    .map(|(n, &x)| HyperDual64::new(x, f64::from(n == i), f64::from(n == k), 0.0))
                    .collect::<Vec<_>>()
            };
            let pairs = (0..variables).flat_map(|i| (0..variables).map(move |k| (i, k)));
            let by_duals = pairs.map(|(i, k)| dual.feed(&with_eps(i, k))[0].eps1eps2);
            let by_differences = (0..variables).flat_map(|k| difference(|x| gradient.feed(x)[1..].to_vec(), &point, k));
            errors.dual.compare(&point, &found, &first.iter().copied().chain(by_duals).collect::<Vec<_>>());
            errors.differences.compare(
                &point,
                &found,
                &first.iter().copied().chain(by_differences).collect::<Vec<_>>(),
            );
            errors.single(&point, &single, &derivatives, &found, &mut random);
        }
        errors.judge();
    }

    /// Returns a random point whose coordinates are exact in single precision.
    fn point(&self, random: &mut Random) -> Vec<f64> {
        (self.0)(random).into_iter().map(|x| f64::from(function::single(x))).collect()
    }
}

/// Checks a point at which lengths vanish or branches meet: the value is the function's, and the derivatives are the
/// documented ones, in both precisions.
///
/// # Panics
/// Panics if the value or a derivative differs.
#[track_caller]
pub fn singular<F, G, H>(
    point: &[f64],
    function: impl Function<f64, F>,
    derivatives: impl Function<f64, G>,
    single: impl Function<f64, H>,
    expected: &[f64],
) {
    let value = function.feed(point);
    assert!(value.iter().all(|x| x.is_finite()), "the function itself is {value:?}");
    let expected: Vec<f64> = value.iter().chain(expected).copied().collect();
    for (found, tolerance) in [(derivatives.feed(point), 1e-12), (single.feed(point), 1e-5)] {
        assert_eq!(found.len(), expected.len());
        let near = |(found, expected): (&f64, &f64)| (found - expected).abs() <= tolerance * (1.0 + expected.abs());
        assert!(found.iter().zip(&expected).all(near), "found    {found:?}\nexpected {expected:?}");
    }
}

/// Returns the derivatives of `f` by its `k`th number, by central differences of sixth order.
fn difference(f: impl Fn(&[f64]) -> Vec<f64>, point: &[f64], k: usize) -> Vec<f64> {
    let mut sum = Vec::new();
    for (steps, weight) in [(1.0, 45.0), (2.0, -9.0), (3.0, 1.0)] {
        for sign in [1.0, -1.0] {
            let mut moved = point.to_vec();
            moved[k] += sign * steps * STEP;
            let values = f(&moved);
            sum.resize(values.len(), 0.0);
            for (sum, value) in sum.iter_mut().zip(values) {
                *sum += sign * weight * value / (60.0 * STEP);
            }
        }
    }
    sum
}

/// The largest error of one kind, with the point at which it occurred.
#[derive(Default)]
struct Largest {
    error: f64,
    place: String,
}

impl Largest {
    fn compare(&mut self, point: &[f64], found: &[f64], expected: &[f64]) {
        let scale = expected.iter().fold(1.0, |scale: f64, x| scale.max(x.abs()));
        self.compare_to(scale, point, found, expected);
    }

    fn compare_to(&mut self, scale: f64, point: &[f64], found: &[f64], expected: &[f64]) {
        assert_eq!(found.len(), expected.len(), "numbers of derivatives");
        for (found_one, expected_one) in found.iter().zip(expected) {
            let error = (found_one - expected_one).abs() / scale;
            // NaN counts as an infinite error.
            if error.is_nan() || error > self.error {
                self.error = if error.is_nan() { f64::INFINITY } else { error };
                self.place = format!("at {point:?}\nfound    {found:?}\nexpected {expected:?}");
            }
        }
    }
}

#[derive(Default)]
struct Errors {
    differences: Largest,
    dual: Largest,
    single: Largest,
}

impl Errors {
    /// Compares single precision with double. The allowed error depends on the point: it is the change of the
    /// derivatives when each argument is rounded, extrapolated from larger changes of the arguments with random signs.
    fn single<G, H>(
        &mut self,
        point: &[f64],
        single: &impl Function<f64, H>,
        double: &impl Function<f64, G>,
        expected: &[f64],
        random: &mut Random,
    ) {
        const MOVE: f64 = 1.0 / 4096.0;
        let mut scale = expected.iter().fold(1.0, |scale: f64, x| scale.max(x.abs()));
        for _ in 0..2 {
            let moved: Vec<f64> = point.iter().map(|x| x * (1.0 + random.sign() * MOVE)).collect();
            let change = double.feed(&moved).into_iter().zip(expected).map(|(x, y)| (x - y).abs() / MOVE);
            scale = change.fold(scale, f64::max);
        }
        self.single.compare_to(scale * f64::from(f32::EPSILON), point, &single.feed(point), expected);
    }

    fn judge(&self) {
        let Self { differences, dual, single } = self;
        // The test harness names each thread after its test.
        let name = std::thread::current().name().unwrap_or_default().to_owned();
        println!(
            "{name}: differences {:.1e}, num-dual {:.1e}, single precision {:.1}",
            differences.error, dual.error, single.error
        );
        for (kind, found, limit) in
            [("central differences", differences, DIFFERENCES), ("num-dual", dual, DUAL), ("f32", single, SINGLE)]
        {
            assert!(
                found.error <= limit,
                "{name}, {kind}: {:.2e}, allowed is {limit:.0e}\n{}",
                found.error,
                found.place
            );
        }
    }
}
