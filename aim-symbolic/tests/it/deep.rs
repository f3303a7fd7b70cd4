//! Expressions of any depth can be derived on a small stack.

use aim_symbolic::{Function, Graph, Plane, Program, Scalar, Variable};

/// Stack size, bytes: a quarter of the default for spawned threads.
const STACK: usize = 512 << 10;

/// Derives an expression built from a number by applying `step` repeatedly, with its derivative by that number.
#[track_caller]
fn derive(steps: usize, step: impl Fn(&mut Graph, Scalar, Scalar) -> Scalar + Sync) {
    let derive = || {
        let mut g = Graph::new();
        let x = g.input("x");
        let deep = (0..steps).fold(x, |deep, _| step(&mut g, deep, x));
        let program = Program::derive(&g, &[deep], &[Variable::from(x)]);
        let mut results = [0.0_f64; 2];
        program.run(&[0.5], &mut results);
        assert!(results.iter().all(|x| x.is_finite()), "{results:?}");
    };
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK).spawn_scoped(scope, derive);
        thread.expect("a thread of little stack").join().expect("a derivation");
    });
}

#[test]
fn sums_products_and_functions() {
    derive(4000, |g, deep, x| {
        let half = g.constant(0.25);
        let scaled = g.mul(half, deep);
        let sum = g.add(scaled, x);
        g.call(Function::Sin, sum)
    });
    derive(4000, |g, deep, x| g.add(deep, x));
    derive(4000, |g, deep, x| g.sub(x, deep));
    derive(4000, |g, deep, x| g.mul(x, deep));
}

/// Quotients, in which everything that may vanish with a length is searched.
#[test]
fn quotients_of_nested_functions() {
    derive(1000, |g, deep, x| {
        let sin = g.call(Function::Sin, deep);
        g.div(sin, x)
    });
    derive(1000, |g, deep, x| {
        let (constant, sin) = (g.constant(0.25), g.call(Function::Sin, deep));
        let sum = g.add(constant, sin);
        let vanishing = g.call(Function::Sin, sum);
        g.div(vanishing, x)
    });
}

/// A loop repeats its argument, so that paths through the expression are many more than its parts.
#[test]
fn iterated_maps_over_a_number() {
    derive(1, |g, _, x| {
        let end = (0..40).fold(x, |y, _| {
            let sin = g.call(Function::Sin, y);
            let scaled = g.mul(x, sin);
            g.add(y, scaled)
        });
        g.div(end, x)
    });
}

/// The cases of a select beside a deep sum.
#[test]
fn deep_sums_beside_a_select_over_a_length() {
    derive(1, |g, _, x| {
        let v = g.components([x; 3]);
        let norm = g.norm(v);
        let deep = (0..20_000).fold(x, |deep, _| g.add(deep, x));
        let limited = g.select_less(norm, x, norm, x);
        let sum = g.add(deep, limited);
        g.div(sum, norm)
    });
}

#[test]
fn selects() {
    derive(2000, |g, deep, x| {
        let sum = g.add(deep, x);
        g.select_less(sum, x, x, sum)
    });
    derive(2000, |g, deep, x| g.select_less(deep, x, x, deep));
}

#[test]
fn vectors_and_rotations() {
    derive(600, |g, deep, x| {
        let angle = g.angle_of(deep);
        let turn = g.turn(Plane::XY, angle);
        let v = g.constant_vector([1.0, 2.0, 3.0]);
        let turned = g.rotate(turn, v);
        let direction = g.normalize(turned);
        let component = g.component(direction.into(), 0);
        g.add(component, x)
    });
    derive(600, |g, deep, x| {
        let unit = g.constant_vector([0.0, 0.0, 1.0]);
        let v = g.components([deep, x, x]);
        let crossed = g.cross(v, unit);
        g.norm(crossed)
    });
}
