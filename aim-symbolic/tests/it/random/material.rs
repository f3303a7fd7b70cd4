//! Building blocks of random statements: inputs of every kind, constants, and points at which to evaluate them.

use aim_symbolic::{Angle, Function, Graph, Plane, Rotation, Scalar, Unit, Variable, Vector};
use fastrand::Rng;

use super::bounded::Bounded;
use super::dual::{Dual, Oracle};
use super::field::Field;

/// Constants, with the simplest and most frequent first.
pub(crate) const NUMBERS: [f64; 12] = [0.0, 1.0, -1.0, 2.0, 0.5, 1.0, -2.0, 3.0, -0.25, 0.0, 0.75, -1.5];

/// Vectors of whole length, with unit vectors first.
pub(crate) const VECTORS: [[f64; 3]; 9] = [
    [0.0, 1.0, 0.0],
    [-1.0, 0.0, 0.0],
    [0.6, 0.0, 0.8],
    [0.0, 0.0, 0.0],
    [1.0, 2.0, 2.0],
    [0.0, 0.0, 2.0],
    [2.0, -3.0, 6.0],
    [0.0, -3.0, 4.0],
    [0.5, 0.0, 0.0],
];

/// Constant unit vectors.
pub(crate) const UNITS: [[f64; 3]; 5] =
    [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.6, 0.0, -0.8], [0.0, -0.8, 0.6]];

pub(crate) const PLANES: [Plane; 4] = [Plane::XY, Plane::XZ, Plane::YZ, Plane { from: 2, towards: 0 }];

pub(crate) const FUNCTIONS: [Function; 10] = [
    Function::Sin,
    Function::Cos,
    Function::Tan,
    Function::Exp,
    Function::Ln,
    Function::Asin,
    Function::Acos,
    Function::Sinh,
    Function::Cosh,
    Function::Tanh,
];

pub(crate) const BASES: [[[f64; 3]; 3]; 5] = [
    [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
    [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
    [[0.6, 0.8, 0.0], [-0.8, 0.6, 0.0], [0.0, 0.0, -1.0]],
    [[1.0, 0.0, 0.0], [0.0, 0.28, 0.96], [0.0, -0.96, 0.28]],
];

/// Pools of expressions to build from, simplest first. Statements add to them.
#[derive(Clone)]
pub(crate) struct Pools {
    pub(crate) g: Graph,
    pub(crate) scalars: Vec<Scalar>,
    pub(crate) vectors: Vec<Vector>,
    pub(crate) units: Vec<Unit>,
    pub(crate) rotations: Vec<Rotation>,
    pub(crate) angles: Vec<Angle>,
    /// Variables that derivatives can be taken by.
    pub(crate) variables: Vec<Variable>,
}

/// Names of scalar inputs. Inputs are declared in the order of these constants by [`Pools::new`].
const SCALARS: [&str; 2] = ["x", "y"];
const POINTS: [&str; 3] = ["a", "b", "c"];
const MATRICES: [&str; 2] = ["m", "n"];
const ANGLES: [&str; 2] = ["p", "h"];

impl Pools {
    pub(crate) fn new() -> Self {
        let mut g = Graph::new();
        let mut scalars = SCALARS.map(|name| g.input(name)).to_vec();
        let mut vectors = POINTS.map(|name| g.vector_input(name)).to_vec();
        let matrices = MATRICES.map(|name| g.rotation_input(name));
        let angles = ANGLES.map(|name| g.angle(name)).to_vec();
        let (q, w) = (g.vector_input("q"), g.input("q_w"));
        let mut variables: Vec<Variable> = angles.iter().map(|&angle| angle.into()).collect();
        variables.extend(scalars.iter().map(|&s| Variable::from(s)));
        for v in [vectors[0], vectors[1]] {
            if let aim_symbolic::VectorNode::Components(c) = g.vector_node(v) {
                variables.extend(c.map(Variable::from));
            }
        }
        // A direction along several variables, including components that are not variables themselves.
        if let aim_symbolic::VectorNode::Components(c) = g.vector_node(vectors[2]) {
            let components = [(variables[0], c[0]), (variables[3], c[1]), (variables[4], c[2])];
            variables.push(g.direction(&components).into());
        }
        // Steps on the rotation manifold, from each side.
        let steps = [g.step(), g.step()];
        for &step in &steps {
            if let aim_symbolic::VectorNode::Components(c) = g.vector_node(step) {
                variables.extend(c.map(Variable::from));
            }
        }
        scalars.extend([1.0, 0.0].map(|c| g.constant(c)));
        vectors.extend([VECTORS[0], VECTORS[3], VECTORS[2]].map(|c| g.constant_vector(c)));
        let mut rotations = vec![g.turn(PLANES[0], angles[0]), g.turn(PLANES[1], angles[1])];
        rotations.extend(matrices);
        let quaternion = g.quaternion(q, w);
        let [right, left] = steps.map(|step| g.turn_by_step(step));
        rotations.extend([g.basis(BASES[0]), g.basis(BASES[3]), quaternion]);
        rotations.extend([g.compose(quaternion, right), g.compose(left, matrices[0])]);
        let units = vec![g.normalize(vectors[0])];
        Self { g, scalars, vectors, units, rotations, angles, variables }
    }
}

/// Number type with random points to evaluate at.
pub(crate) trait Sample: Oracle {
    fn random(random: &mut Rng) -> Self;
}

impl Sample for Field {
    fn random(random: &mut Rng) -> Self {
        Self::new(random.u64(..) >> 3)
    }
}

impl Sample for Bounded {
    fn random(random: &mut Rng) -> Self {
        Self::exact(3.0 * random.f64() - 1.5)
    }
}

fn sum<T: Sample>(terms: [T; 4]) -> T {
    terms[0] + terms[1] + terms[2] + terms[3]
}

/// Returns a random point: a value for each input. Matrices and quaternions are fractions of random quaternions; sines
/// and cosines come from half tangents.
pub(crate) fn point<T: Sample>(random: &mut Rng) -> Vec<T> {
    let mut inputs: Vec<T> = (0..SCALARS.len() + 3 * POINTS.len()).map(|_| T::random(random)).collect();
    let (one, two) = (T::constant(1.0), T::constant(2.0));
    for _ in MATRICES {
        let [a, b, c, d] = [0; 4].map(|_| T::random(random));
        let twice = two / sum([a * a, b * b, c * c, d * d]);
        inputs.extend(
            [
                [one - twice * (c * c + d * d), twice * (b * c + a * d), twice * (b * d - a * c)],
                [twice * (b * c - a * d), one - twice * (b * b + d * d), twice * (c * d + a * b)],
                [twice * (b * d + a * c), twice * (c * d - a * b), one - twice * (b * b + c * c)],
            ]
            .into_iter()
            .flatten(),
        );
    }
    for _ in ANGLES {
        let t = T::random(random);
        let scale = one / (one + t * t);
        inputs.extend([two * t * scale, (one - t * t) * scale]);
    }
    // Square of a quaternion divided by its squared length: a unit quaternion with rational components.
    let [a, b, c, d] = [0; 4].map(|_| T::random(random));
    let scale = one / sum([a * a, b * b, c * c, d * d]);
    inputs.extend([b, c, d].map(|part| two * a * part * scale));
    inputs.push((a * a - b * b - c * c - d * d) * scale);
    inputs
}

/// Returns the same point, moving with `variable`.
pub(crate) fn moving<T: Oracle>(g: &Graph, point: &[T], variable: Variable) -> Vec<Dual<T>> {
    let count = g.inputs().len();
    let mut inputs: Vec<Dual<T>> = point.iter().map(|&value| Dual::fixed(value)).collect();
    // Components of steps, which are 0.
    inputs.resize(count + g.step_components(), Dual::fixed(T::constant(0.0)));
    let place = |s: Scalar| match g.scalar_node(s) {
        aim_symbolic::ScalarNode::Op(aim_symbolic::Op::Input(place)) => place as usize,
        aim_symbolic::ScalarNode::Step(component) => count + component as usize,
        node => unreachable!("{node:?} is no input"),
    };
    let components = match variable {
        Variable::Along(direction) => {
            g.direction_components(direction).iter().map(|&(x, k)| (x, point[place(k)])).collect()
        }
        variable => vec![(variable, T::constant(1.0))],
    };
    for (variable, speed) in components {
        match variable {
            Variable::Input(s) => inputs[place(s)].slope = speed,
            Variable::Angle(angle) => {
                let (sin, cos) = g.sin_cos(angle);
                inputs[place(sin)].slope = speed * point[place(cos)];
                inputs[place(cos)].slope = -speed * point[place(sin)];
            }
            Variable::Along(_) => unreachable!("directions are of inputs and angles"),
        }
    }
    inputs
}
