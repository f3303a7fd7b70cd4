//! Resubstitution computes a number from others that exist: where it makes programs smaller, and where it would do
//! harm.

use aim_symbolic::rules::{self, RESUBSTITUTE, Rule};
use aim_symbolic::{Graph, Program, Scalar, Want};

/// Returns the program of the stated values, derived with this rule alone.
fn program(state: impl FnOnce(&mut Graph) -> Vec<Scalar>) -> Program {
    let mut g = Graph::new();
    let values = state(&mut g);
    let others: Vec<Rule> = rules::all().into_iter().filter(|rule| *rule != RESUBSTITUTE).collect();
    let wanted: Vec<Want> = values.into_iter().map(Want::Value).collect();
    Program::derive_without(&g, &wanted, &others)
}

fn inputs<const N: usize>(g: &mut Graph) -> [Scalar; N] {
    core::array::from_fn(|i| g.input(&format!("x{i}")))
}

/// a c + b d
fn sum_of_products(g: &mut Graph, [a, b]: [Scalar; 2], [c, d]: [Scalar; 2]) -> Scalar {
    let (one, other) = (g.mul(a, c), g.mul(b, d));
    g.add(one, other)
}

#[test]
fn a_multiple_is_computed_from_its_base() {
    let program = program(|g| {
        let [a, b, c, d, k] = inputs(g);
        let multiples = [a, b].map(|x| g.mul(k, x));
        vec![sum_of_products(g, [a, b], [c, d]), sum_of_products(g, multiples, [c, d])]
    });
    assert_eq!(program.count().total(), 4, "{program:?}");
    let mut out = [0.0; 2];
    program.run(&[2.0, 3.0, 5.0, 7.0, 11.0], &mut out);
    assert_eq!(out, [31.0, 341.0]);
}

#[test]
fn a_product_that_two_values_could_share_is_added() {
    // a c occurs in none of the products as written: (a b) c, (d a) c, (e a) c.
    let program = program(|g| {
        let [a, b, c, d, e] = inputs(g);
        let product = |g: &mut Graph, all: &[Scalar]| all.iter().copied().reduce(|x, y| g.mul(x, y)).unwrap_or(all[0]);
        vec![product(g, &[a, b, c]), product(g, &[d, a, c]), product(g, &[e, a, c])]
    });
    assert_eq!(program.count().total(), 4, "{program:?}");
}

#[test]
fn a_value_that_is_always_zero_is_removed() {
    let program = program(|g| {
        let [a, b] = inputs(g);
        let sum = g.add(a, b);
        let square = g.mul(sum, sum);
        let parts = [(a, a), (a, b), (b, a), (b, b)].map(|(x, y)| g.mul(x, y));
        vec![parts.into_iter().fold(square, |left, part| g.sub(left, part))]
    });
    assert_eq!(program.count().total(), 0, "{program:?}");
}

#[test]
fn no_new_divisor_is_introduced() {
    // x a b … g equals (x / y) (y a b … g), except at y = 0.
    let program = program(|g| {
        let [x, y, rest @ ..]: [Scalar; 9] = inputs(g);
        let [of_x, of_y] = [x, y].map(|first| rest.iter().fold(first, |product, &factor| g.mul(product, factor)));
        vec![g.div(x, y), of_y, of_x]
    });
    let mut out = [0.0; 3];
    program.run(&[3.0, 0.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0], &mut out);
    assert_eq!(out[1..], [0.0, 384.0], "{program:?}");
}

#[test]
fn no_cancellation_is_introduced() {
    // (x − y)(x + y) equals x² − y², but the difference of squares may cancel catastrophically.
    let program = program(|g| {
        let [x, y] = inputs(g);
        let (difference, sum) = (g.sub(x, y), g.add(x, y));
        vec![g.mul(x, x), g.mul(y, y), g.mul(difference, sum)]
    });
    assert_eq!(program.count().total(), 5, "{program:?}");
}

#[test]
fn intentional_rounding_is_preserved() {
    let program = program(|g| {
        let [x] = inputs(g);
        let much = g.constant(1e20);
        let sum = g.add(x, much);
        vec![g.sub(sum, much)]
    });
    assert_eq!(program.count().total(), 2, "{program:?}");
}

#[test]
fn one_over_a_high_power_is_derived() {
    let program = program(|g| {
        let [x] = inputs(g);
        let (power, one) = ((0..40).fold(x, |power, _| g.mul(power, power)), g.constant(1.0));
        vec![g.div(one, power)]
    });
    assert_eq!(program.count().total(), 41, "{program:?}");
}
