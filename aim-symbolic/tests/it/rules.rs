//! Properties of single rules.

use aim_symbolic::{Function, Graph, Program, Scalar, Variable, rules};

#[test]
fn every_rule_has_an_explanation() {
    for rule in rules::all() {
        assert!(rule.why.ends_with('.') && rule.why.len() > 40, "{rule}: {}", rule.why);
    }
}

/// The length |v| cancels from the angle of (|v| / e^s, |v| t); 1 / e^s stays, since e^s is positive but not a length.
#[test]
fn a_positive_factor_that_is_no_length_does_not_cancel() {
    let mut g = Graph::new();
    let (v, [s, t]) = (g.vector_input("v"), ["s", "t"].map(|name| g.input(name)));
    let (length, size) = (g.norm(v), g.call(Function::Exp, s));
    let per_size = g.reciprocal(size);
    let (y, x) = (g.mul(length, per_size), g.mul(length, t));
    let angle = g.atan2(y, x);
    let program = Program::derive(&g, &[angle], &[Variable::from(t)]);
    let mut results = [0.0_f64; 2];
    program.run(&[1.0, 2.0, 2.0, 0.3, 0.7], &mut results);
    let y = (-0.3_f64).exp();
    for (found, expected) in results.into_iter().zip([y.atan2(0.7), -y / (y * y + 0.49)]) {
        assert!((found - expected).abs() < 1e-15, "{found} instead of {expected}");
    }
}

/// Returns the number of operations of the derived program of a number of x and y, which the function states.
fn operations(state: fn(&mut Graph, Scalar, Scalar) -> Scalar) -> usize {
    let mut g = Graph::new();
    let [x, y] = ["x", "y"].map(|name| g.input(name));
    let stated = state(&mut g, x, y);
    Program::derive::<Variable>(&g, &[stated], &[]).count().total()
}

/// Returns b + k (y − b) for b = x + k (y − x).
fn interpolated_twice(g: &mut Graph, x: Scalar, y: Scalar, factor: f64) -> Scalar {
    let factor = g.constant(factor);
    let mut between = x;
    for _ in 0..2 {
        let way = g.sub(y, between);
        let part = g.mul(factor, way);
        between = g.add(between, part);
    }
    between
}

/// x + ¼ (y − x), interpolated again with y, is a sum of two multiples. In x + 100 (y − x) the difference keeps digits
/// that 100 y − 99 x would lose.
#[test]
fn combinations_are_multiplied_out_unless_they_lose_digits() {
    let once = operations(|g, x, y| interpolated_twice(g, x, y, 0.25));
    assert_eq!(once, 3);
    let far = operations(|g, x, y| interpolated_twice(g, x, y, 100.0));
    assert!(far > 3, "{far}");
}

/// (x − y) + y is x: in 1 − s + s, as the sine and cosine of a half of an angle have it, too.
#[test]
fn a_subtracted_term_that_is_added_again_drops_out() {
    let left = operations(|g, x, y| {
        let (product, difference) = (g.mul(x, y), g.sub(x, y));
        let restored = g.add(difference, y);
        g.add(product, restored)
    });
    assert_eq!(left, 2);
}
