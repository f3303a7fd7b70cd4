//! Lists, filtering iterators, elements selected by arguments, enums, and generic structs: companions have the
//! function's own value, and the derivatives agree with central differences.

#[aim::differentiate]
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is whole, and in the table")]
mod functions {
    /// A loss applied to a residual.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub(super) enum Loss {
        Square,
        Huber { width: f64 },
        Tukey(f64, bool),
    }

    impl Loss {
        fn of(self, r: f64) -> f64 {
            match self {
                Self::Square => r * r,
                Self::Huber { width } if r.abs() < width => r * r,
                Self::Huber { width } => width * (2.0 * r.abs() - width),
                Self::Tukey(width, scaled) => {
                    let s = (1.0 - (r / width).powi(2)).max(0.0);
                    let loss = (1.0 - s * s * s) * width * width / 3.0;
                    if scaled { 2.0 * loss } else { loss }
                }
            }
        }
    }

    /// A sum of losses, differentiated by the residuals and a scale.
    #[differentiate(wrt(x, scale), hessian, hvp, lanes)]
    pub(super) fn robust(losses: &[Loss; 3], x: [f64; 3], scale: f64) -> f64 {
        losses.iter().zip(x).map(|(loss, x)| loss.of(scale * x)).sum()
    }

    /// An enum with a single variant that has a field.
    #[derive(Clone, Copy)]
    pub(super) enum Only {
        One(f64),
    }

    #[differentiate(wrt(x))]
    pub(super) fn only(x: f64, only: Only) -> f64 {
        let Only::One(k) = only;
        k * x * x
    }

    /// Linear interpolation in a table.
    #[differentiate(wrt(x, table))]
    pub(super) fn interpolated(x: f64, table: [f64; 6]) -> f64 {
        if x > 100.0 {
            return f64::NAN;
        }
        let last = (table.len() - 2) as f64;
        let cell = x.floor().clamp(0.0, last) as usize;
        let t = x - cell as f64;
        (1.0 - t) * table[cell] + t * table[cell + 1]
    }

    /// The mean of the values near the median.
    #[differentiate(wrt(x))]
    pub(super) fn trimmed(x: [f64; 5], near: f64) -> f64 {
        let mut sorted = x.to_vec();
        sorted.sort_by(|a, b| a.total_cmp(b));
        let median = sorted[2];
        let close = || x.iter().filter(|v| (*v - median).abs() < near);
        close().sum::<f64>() / close().count() as f64
    }

    /// A walk that ends when it leaves the circle.
    #[differentiate(wrt(x, pull))]
    pub(super) fn walk(x: [f64; 2], pull: f64, most: usize) -> f64 {
        let mut place = x;
        let mut visited = Vec::new();
        let mut steps = 0;
        while steps < 6 && place[0].hypot(place[1]) < 2.0 {
            if steps >= most {
                break;
            }
            place = [1.3 * place[0] - pull * place[1], 1.2 * place[1] + pull * place[0]];
            steps += 1;
        }
        for _ in 0..2 {
            visited.push(place[0] * place[1]);
            place = [place[1], -place[0]];
        }
        let mut energy = 0.0;
        let mut add = |v: f64| energy += v * v;
        visited.iter().for_each(|v| add(*v));
        add(place[0]);
        energy + steps as f64
    }

    /// Differentiated by a slice too, whose length is fixed for this test.
    #[differentiate(wrt(scale, sizes), lengths(returns = 4, sizes = 2), check = true)]
    pub(super) fn likelihood(scale: f64, returns: &[f64], sizes: &[f64]) -> f64 {
        let mut variance = sizes[0].exp();
        let mut sum = 0.0;
        for r in returns {
            sum += r * r / variance + variance.ln();
            variance = 0.1 + 0.8 * variance + scale * scale * r * r;
        }
        sum / returns.len() as f64 * sizes.last().copied().unwrap_or(1.0)
    }

    /// A dense layer with `IN` inputs and `OUT` outputs.
    #[derive(Clone, Copy)]
    pub(super) struct Dense<const IN: usize, const OUT: usize, A = Tanh> {
        pub(super) weights: [[f64; IN]; OUT],
        pub(super) bias: [f64; OUT],
        pub(super) after: A,
    }

    #[derive(Clone, Copy)]
    pub(super) struct Tanh;

    #[derive(Clone, Copy)]
    pub(super) struct Leaky {
        pub(super) slope: f64,
    }

    pub(super) trait Activation: Copy {
        fn of(self, x: f64) -> f64;
    }

    impl Activation for Tanh {
        fn of(self, x: f64) -> f64 {
            x.tanh()
        }
    }

    impl Activation for Leaky {
        fn of(self, x: f64) -> f64 {
            if x < 0.0 { self.slope * x } else { x }
        }
    }

    impl<const IN: usize, const OUT: usize, A: Activation> Dense<IN, OUT, A> {
        fn forward(&self, input: &[f64; IN]) -> [f64; OUT] {
            core::array::from_fn(|o| {
                let sum: f64 = self.weights[o].iter().zip(input).map(|(w, x)| w * x).sum();
                self.after.of(sum + self.bias[o]) / IN as f64
            })
        }
    }

    /// A network of two layers.
    #[derive(Clone, Copy)]
    pub(super) struct Network {
        pub(super) hidden: Dense<2, 3, Leaky>,
        pub(super) output: Dense<3, 1, Leaky>,
    }

    #[differentiate(wrt(network, input))]
    pub(super) fn predicted(network: &Network, input: [f64; 2]) -> f64 {
        let [out] = network.output.forward(&network.hidden.forward(&input));
        let bent = Dense { weights: [[out, 1.0]], bias: [0.5], after: Tanh };
        bent.forward(&input)[0]
    }
}

use functions::{Dense, Leaky, Loss, Network, Only};

#[test]
fn slices_of_a_length_that_is_said() {
    let (returns, sizes) = ([0.3, -0.2, 0.5, 0.1], [1.0, 2.0]);
    for scale in [0.4, 1.5] {
        let (value, (by_scale, by_sizes)) = functions::likelihood_gradient(scale, &returns, &sizes);
        assert!((value - functions::likelihood(scale, &returns, &sizes)).abs() < 1e-14);
        assert_near(
            [by_scale],
            differences(|[scale]| functions::likelihood(scale, &returns, &sizes), [scale]),
            "by the scale",
        );
        let of_sizes = |sizes: [f64; 2]| functions::likelihood(scale, &returns, &sizes);
        assert_near(by_sizes, differences(of_sizes, sizes), "by the sizes");
    }
}

/// Returns the central differences (f(x + h e) − f(x − h e)) / 2h by each component.
fn differences<const N: usize>(f: impl Fn([f64; N]) -> f64, x: [f64; N]) -> [f64; N] {
    let h = 1e-6;
    core::array::from_fn(|k| {
        let [mut less, mut more] = [x; 2];
        less[k] -= h;
        more[k] += h;
        (f(more) - f(less)) / (2.0 * h)
    })
}

fn assert_near<const N: usize>(found: [f64; N], expected: [f64; N], what: &str) {
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-7 * (1.0 + expected.abs()), "{what}: {found}, differences {expected}");
    }
}

#[test]
fn enums_as_arguments() {
    let all = [Loss::Square, Loss::Huber { width: 0.7 }, Loss::Tukey(2.0, true), Loss::Tukey(1.1, false)];
    for a in all {
        for b in all {
            let losses = [a, b, Loss::Huber { width: 0.3 }];
            for x in [[0.2, -0.4, 0.1], [-1.3, 0.9, 2.1], [3.0, -2.5, -0.2]] {
                let (value, (by_x, by_scale)) = functions::robust_gradient(&losses, x, 1.2);
                let expected = functions::robust(&losses, x, 1.2);
                assert!((value - expected).abs() < 1e-14 * (1.0 + expected), "{value}, {expected}: {losses:?}");
                assert_near(by_x, differences(|x| functions::robust(&losses, x, 1.2), x), "by x");
                assert_near([by_scale], differences(|[s]| functions::robust(&losses, x, s), [1.2]), "by the scale");
                // The variant's index, then the fields of all variants.
                let in_lanes = losses.map(|loss| match loss {
                    Loss::Square => (0.0, 5.0, 9.0, 0.0),
                    Loss::Huber { width } => (1.0, width, -3.0, 1.0),
                    Loss::Tukey(width, scaled) => (2.0, -7.0, width, f64::from(u8::from(scaled))),
                });
                assert_eq!(functions::robust_gradient_lanes(&in_lanes, x, 1.2), (value, (by_x, by_scale)));
            }
        }
    }
    let (value, (slope,)) = functions::only_gradient(2.0, Only::One(3.0));
    assert_eq!([value, slope], [12.0, 12.0]);
}

#[test]
fn elements_that_arguments_choose() {
    let table = [1.0, -2.0, 0.5, 4.0, 3.0, -1.0];
    for x in [-0.5, 0.25, 1.5, 2.75, 3.5, 4.25, 5.5] {
        let (value, (by_x, by_table)) = functions::interpolated_gradient(x, table);
        assert_eq!(value.to_bits(), functions::interpolated(x, table).to_bits());
        assert_near([by_x], differences(|[x]| functions::interpolated(x, table), [x]), "by the place");
        assert_near(by_table, differences(|table| functions::interpolated(x, table), table), "by the table");
    }
    let (value, (by_x, _)) = functions::interpolated_gradient(101.0, table);
    assert!(value.is_nan() && by_x == 0.0);
}

#[test]
fn what_is_left_of_a_list() {
    for x in [[0.3, -1.0, 0.5, 2.0, 0.1], [5.0, 4.0, 3.0, 2.0, 1.0], [-0.2, 0.1, 0.05, -0.4, 9.0]] {
        for near in [0.15, 0.6, 1.75, 100.0] {
            let (value, (slopes,)) = functions::trimmed_gradient(x, near);
            assert!((value - functions::trimmed(x, near)).abs() < 1e-14);
            assert_near(slopes, differences(|x| functions::trimmed(x, near), x), "by the numbers");
        }
    }
}

#[test]
fn loops_that_arguments_end() {
    for x in [[0.3, 0.2], [-1.0, 0.4], [2.5, 0.0], [0.01, -0.02]] {
        for most in [0, 1, 3, 9] {
            let (value, (by_x, by_pull)) = functions::walk_gradient(x, 0.4, most);
            let expected = functions::walk(x, 0.4, most);
            assert!((value - expected).abs() < 1e-13 * (1.0 + expected.abs()), "{value}, {expected}");
            assert_near(by_x, differences(|x| functions::walk(x, 0.4, most), x), "by the start");
            assert_near([by_pull], differences(|[pull]| functions::walk(x, pull, most), [0.4]), "by the pull");
        }
    }
}

#[test]
fn generic_structs_as_arguments() {
    let hidden =
        Dense { weights: [[0.3, -0.8], [1.1, 0.2], [-0.4, 0.5]], bias: [0.1, -0.2, 0.3], after: Leaky { slope: 0.1 } };
    let output = Dense { weights: [[0.7, -1.2, 0.4]], bias: [0.05], after: Leaky { slope: 0.3 } };
    let network = Network { hidden, output };
    for input in [[0.5, -0.4], [-1.2, 0.9], [2.0, 1.5]] {
        let (value, (by_network, by_input)) = functions::predicted_gradient(&network, input);
        assert!((value - functions::predicted(&network, input)).abs() < 1e-14);
        assert_near(by_input, differences(|input| functions::predicted(&network, input), input), "by the input");
        let weights = |weights: [f64; 2]| {
            let mut other = network;
            other.hidden.weights[1] = weights;
            functions::predicted(&other, input)
        };
        assert_near(by_network.hidden.weights[1], differences(weights, hidden.weights[1]), "by weights");
        let slope = |[slope]: [f64; 1]| {
            let mut other = network;
            other.output.after.slope = slope;
            functions::predicted(&other, input)
        };
        assert_near([by_network.output.after.slope], differences(slope, [0.3]), "by the slope");
    }
}
