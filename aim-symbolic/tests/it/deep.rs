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
