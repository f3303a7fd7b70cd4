//! Derivatives through selects: program size, and branches not taken must not contribute.

use aim_symbolic::{Bindings, Function, Graph, Program, Scalar, Variable};

/// Returns `max(x, 0)`.
fn positive(g: &mut Graph, x: Scalar) -> Scalar {
    let zero = g.constant(0.0);
    g.select_less(x, zero, zero, x)
}

/// Returns the last of several layers `max(w x + b, 0)`, and the variables: x, then each w and b.
fn layers(g: &mut Graph, count: usize) -> (Scalar, Vec<Variable>) {
    let mut x = g.input("x");
    let mut variables = vec![x.into()];
    for i in 0..count {
        let (w, b) = (g.input(&format!("w{i}")), g.input(&format!("b{i}")));
        variables.extend([w, b].map(Variable::from));
        let product = g.mul(w, x);
        let sum = g.add(product, b);
        x = positive(g, sum);
    }
    (x, variables)
}

/// Returns the number of operations, including calls and selects; a select counts twice, for its comparison.
fn size(program: &Program) -> usize {
    let count = program.count();
    count.total() + count.select + count.call
}

#[test]
fn layers_take_at_most_twelve_steps_each() {
    for count in [1, 10, 80] {
        let mut g = Graph::new();
        let (output, variables) = layers(&mut g, count);
        let by_x = Program::derive(&g, &[output], &variables[..1]);
        assert!(size(&by_x) <= 7 * count, "{count} layers by x: {}", by_x.count());
        let by_all = Program::derive(&g, &[output], &variables);
        assert!(size(&by_all) <= 12 * count, "{count} layers by all: {}", by_all.count());
    }
}

/// Returns the value and the derivatives at a point.
fn at(g: &Graph, output: Scalar, variables: &[Variable], point: &[f64]) -> Vec<f64> {
    let program = Program::derive(g, &[output], variables);
    let mut results = vec![0.0; 1 + variables.len()];
    program.run(point, &mut results);
    let value = g.evaluate(output, &Bindings::new(g, point, &[]));
    assert!((results[0] - value).abs() <= 1e-12 * (1.0 + value.abs()), "{} instead of {value}", results[0]);
    results.split_off(1)
}

#[track_caller]
fn assert_near(found: &[f64], expected: &[f64]) {
    let near = |(found, expected): (&f64, &f64)| (found - expected).abs() <= 1e-12 * (1.0 + expected.abs());
    assert!(found.iter().zip(expected).all(near), "{found:?} instead of {expected:?}");
}

#[test]
fn layers_have_the_derivatives_of_the_product_of_their_factors() {
    let mut g = Graph::new();
    let (output, variables) = layers(&mut g, 3);
    // x, then w and b of each layer: all layers are above 0.
    let point = [2.0, 3.0, -1.0, 0.5, 0.25, -2.0, 9.0];
    let [x1, x2] = [5.0, 2.75];
    assert_near(&at(&g, output, &variables, &point), &[-3.0, 0.5 * -2.0 * 2.0, 0.5 * -2.0, -2.0 * x1, -2.0, x2, 1.0]);
    // The second layer is below 0, so nothing before it contributes, even if it has overflowed.
    for first in [3.0, 1e200] {
        let point = [1e200, first, -1.0, -0.5, 0.25, -2.0, 9.0];
        assert_near(&at(&g, output, &variables, &point), &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    }
}

/// Returns `if 0 < c { x } else { 0 }`.
fn where_positive(g: &mut Graph, c: Scalar, x: Scalar) -> Scalar {
    let zero = g.constant(0.0);
    g.select_less(zero, c, x, zero)
}

#[test]
fn a_part_shared_by_branches_contributes_in_each_taken_branch() {
    let mut g = Graph::new();
    let [x, y, z] = ["x", "y", "z"].map(|name| g.input(name));
    let variables = [x, y].map(Variable::from);
    let one = g.constant(1.0);
    // 1/x, its square and its cube, each where x, y and z are positive.
    let r = g.div(one, x);
    let square = g.mul(r, r);
    let cube = g.mul(square, r);
    let inner = where_positive(&mut g, z, cube);
    let terms = [where_positive(&mut g, x, r), where_positive(&mut g, y, square), where_positive(&mut g, x, inner)];
    let sum = g.add(terms[0], terms[1]);
    let sum = g.add(sum, terms[2]);
    for x in [0.0_f64, 2.0, -2.0] {
        for (y, z) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
            // At x = 0 a value exists only if no taken branch uses it.
            if x == 0.0 && y > 0.0 {
                continue;
            }
            let mut slope = 0.0;
            if x > 0.0 {
                slope -= x.powi(-2);
                slope -= if z > 0.0 { 3.0 * x.powi(-4) } else { 0.0 };
            }
            slope -= if y > 0.0 { 2.0 * x.powi(-3) } else { 0.0 };
            assert_near(&at(&g, sum, &variables, &[x, y, z]), &[slope, 0.0]);
        }
    }
}

#[test]
fn overflow_in_an_untaken_branch_does_not_affect_the_derivative() {
    // Layers of ln(1 + exp x), written so that nothing overflows.
    let soft = |count: usize| {
        let mut g = Graph::new();
        let input = g.input("x");
        let (one, most) = (g.constant(1.0), g.constant(30.0));
        let mut x = input;
        for _ in 0..count {
            let grown = g.call(Function::Exp, x);
            let sum = g.add(one, grown);
            let soft = g.call(Function::Ln, sum);
            x = g.select_less(most, x, x, soft);
        }
        (g, x, Variable::from(input))
    };
    let (g, output, x) = soft(3);
    assert_near(&at(&g, output, &[x], &[1e4]), &[1.0]);
    // e^x / (1 + e^x) in three layers, where each layer has 1 + e^y = 2 + e^x.
    let e = 0.5_f64.exp();
    assert_near(&at(&g, output, &[x], &[0.5]), &[e / (1.0 + e) * (1.0 + e) / (2.0 + e) * (2.0 + e) / (3.0 + e)]);
    let sizes = [10, 20, 40].map(|count| {
        let (g, output, x) = soft(count);
        size(&Program::derive(&g, &[output], &[x]))
    });
    assert_eq!(sizes[2] - sizes[1], 2 * (sizes[1] - sizes[0]), "{sizes:?}");
}

/// A branch not taken may divide by something that has no value, without affecting the result.
#[test]
fn nan_in_an_untaken_branch_does_not_affect_the_derivative() {
    type Divisor = fn(&mut Graph, Scalar) -> Scalar;
    let divisors: [Divisor; 3] = [
        |g, x| g.sqrt(x),
        |g, x| g.call(Function::Ln, x),
        |g, x| {
            let root = g.sqrt(x);
            g.mul(x, root)
        },
    ];
    for divisor in divisors {
        // z = x where y < 0, else x / d(y)
        let mut g = Graph::new();
        let [x, y] = ["x", "y"].map(|name| g.input(name));
        let (zero, one, two) = (g.constant(0.0), g.constant(1.0), g.constant(2.0));
        let below = divisor(&mut g, y);
        let quotient = g.div(x, below);
        for otherwise in [x, zero] {
            let z = g.select_less(y, zero, otherwise, quotient);
            let (above, sum) = (g.add(z, one), g.add(z, two));
            let ratio = g.div(above, sum);
            let f = g.call(Function::Ln, ratio);
            // d ln((z + 1) / (z + 2)) = dz (1/(z + 1) − 1/(z + 2)), with ∂z/∂x = 1 if z = x.
            let slope = if otherwise == x { 1.0 / 1.5 - 1.0 / 2.5 } else { 0.0 };
            assert_near(&at(&g, f, &[x.into()], &[0.5, -1.0]), &[slope]);
        }
    }
}

#[test]
fn nested_guards_exclude_undefined_values() {
    let mut g = Graph::new();
    let [a, b] = ["a", "b"].map(|name| g.input(name));
    let (zero, tenth, three, minus) = (g.constant(0.0), g.constant(0.1), g.constant(3.0), g.constant(-1.0));
    let root = g.sqrt(a);
    let f = g.div(b, root);
    let size = {
        let negative = g.neg(f);
        g.select_less(f, zero, negative, f)
    };
    let sin = g.call(Function::Sin, f);
    let inner = g.select_less(tenth, size, three, sin);
    let z = g.select_less(zero, a, inner, minus);
    // −b cos(f) / 2a√a where both guards let it pass.
    let f = 0.005 / f64::sqrt(0.25);
    for (at_a, at_b, slope) in [
        (-1.0, 0.5, 0.0),
        (0.0, 0.5, 0.0),
        (0.25, 0.5, 0.0),
        (0.25, 0.005, -0.5 * f / 0.25 * f.cos()),
        (-1.0, 0.0, 0.0),
    ] {
        assert_near(&at(&g, z, &[a.into()], &[at_a, at_b]), &[slope]);
    }
}

#[test]
fn limits_apply_only_where_their_branch_is_taken() {
    for edge in [-0.3, -1e-3, 0.3] {
        let mut g = Graph::new();
        let (x, end) = (g.input("x"), g.constant(edge));
        let sine = g.call(Function::Sin, x);
        let one = g.constant(1.0);
        let square = g.mul(x, x);
        // `if x < edge { 1 + x² } else { sin x } / x` for a negative edge; the branches are swapped for a positive one.
        let other = g.add(one, square);
        let (below, above) = if edge < 0.0 { (other, sine) } else { (sine, other) };
        let bent = g.select_less(x, end, below, above);
        let quotient = g.div(bent, x);
        let by_x = |x: f64| if (x < edge) == (edge < 0.0) { 1.0 - 1.0 / (x * x) } else { (x.cos() - x.sin() / x) / x };
        for point in [-2.0, -0.9, 3.0 * edge, 1.01 * edge, 0.99 * edge, 0.1 * edge, 0.01, 0.9, 2.0] {
            assert_near(&at(&g, quotient, &[x.into()], &[point]), &[by_x(point)]);
        }
        assert_near(&at(&g, quotient, &[x.into()], &[1e-9]), &[-1e-9 / 3.0]);
    }
}
