//! Steps that build statements: the graph's constructors, and idioms that rules look for.

use aim_symbolic::{Attitude, Graph, Matrix, Stumpff};

use super::material::{BASES, FUNCTIONS, NUMBERS, PLANES, Pools, UNITS, VECTORS};
use PoolKind::{Angle, Rotation, Scalar, Unit, Vector};

/// Pool that a step takes from or adds to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PoolKind {
    Scalar,
    Vector,
    Unit,
    Rotation,
    Angle,
}

/// Largest number of parts of a step.
pub(crate) const PARTS: usize = 5;

/// Step that makes an expression from `parts`, indices into the pools. `number` selects constants, planes and
/// functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Step {
    pub(crate) kind: StepKind,
    pub(crate) parts: [u16; PARTS],
    pub(crate) number: u8,
}

macro_rules! steps {
    ($($name:ident: $weight:literal [$($part:ident),*] => $pool:ident,)*) => {
        /// Kind of step.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum StepKind {
            /// An existing expression, which steps shrink to.
            Same(PoolKind),
            $($name,)*
        }

        /// Relative frequency of each kind.
        pub(crate) const WEIGHTS: &[(StepKind, u32)] = &[$((StepKind::$name, $weight),)*];

        impl StepKind {
            /// Returns the pool that the result is added to.
            pub(crate) fn pool(self) -> PoolKind {
                match self {
                    Self::Same(pool) => pool,
                    $(Self::$name => $pool,)*
                }
            }

            /// Returns the pools that the parts are taken from.
            pub(crate) fn parts(self) -> &'static [PoolKind] {
                match self {
                    Self::Same(Scalar) => &[Scalar],
                    Self::Same(Vector) => &[Vector],
                    Self::Same(Unit) => &[Unit],
                    Self::Same(Rotation) => &[Rotation],
                    Self::Same(Angle) => &[Angle],
                    $(Self::$name => &[$($part),*],)*
                }
            }
        }
    };
}

steps! {
    Constant: 3 [] => Scalar,
    Add: 4 [Scalar, Scalar] => Scalar,
    Sub: 4 [Scalar, Scalar] => Scalar,
    Mul: 4 [Scalar, Scalar] => Scalar,
    Div: 2 [Scalar, Scalar] => Scalar,
    Neg: 5 [Scalar] => Scalar,
    Sqrt: 1 [Scalar] => Scalar,
    Reciprocal: 2 [Scalar] => Scalar,
    Select: 3 [Scalar, Scalar, Scalar, Scalar] => Scalar,
    Call: 4 [Scalar] => Scalar,
    Atan2: 3 [Scalar, Scalar] => Scalar,
    PlaneAngle: 1 [Vector, Vector, Vector] => Scalar,
    Quotient: 3 [Scalar, Scalar] => Scalar,
    QuotientOfLength: 3 [Vector, Scalar] => Scalar,
    Dot: 10 [Vector, Vector] => Scalar,
    Norm: 7 [Vector] => Scalar,
    Component: 3 [Vector] => Scalar,
    RootOfSquare: 2 [Vector] => Scalar,
    OverRoot: 1 [Scalar, Scalar] => Scalar,
    OverLength: 2 [Scalar, Vector] => Scalar,
    DotOverLength: 2 [Vector, Vector] => Scalar,
    LengthOfCross: 4 [Vector, Unit] => Scalar,
    LengthOfConstantCross: 3 [Vector] => Scalar,
    DotOfTurned: 3 [Rotation, Vector, Vector] => Scalar,
    DotWithConstant: 3 [Rotation, Vector] => Scalar,
    DotBesideDirection: 3 [Vector, Rotation, Vector, Vector] => Scalar,
    TwoTargets: 3 [Vector, Vector, Rotation, Vector] => Scalar,
    LengthToEffector: 3 [Vector, Rotation, Vector] => Scalar,
    SquareToEffector: 2 [Vector, Rotation, Vector] => Scalar,
    DotAcrossPerp: 2 [Vector, Unit] => Scalar,
    DotAxisAcross: 2 [Vector, Unit] => Scalar,
    SquareOfDirections: 2 [Rotation, Unit, Unit] => Scalar,
    LengthAcrossDirection: 2 [Vector, Rotation, Vector, Vector] => Scalar,
    DotAcrossAlong: 2 [Vector, Vector, Scalar, Unit] => Scalar,
    ConstantVector: 3 [] => Vector,
    Components: 3 [Scalar, Scalar, Scalar] => Vector,
    AddVectors: 6 [Vector, Vector] => Vector,
    SubVectors: 6 [Vector, Vector] => Vector,
    NegVector: 4 [Vector] => Vector,
    Scale: 8 [Scalar, Vector] => Vector,
    Rotate: 14 [Rotation, Vector] => Vector,
    RotateBack: 4 [Rotation, Vector] => Vector,
    Direction: 8 [Unit] => Vector,
    Perp: 3 [Vector] => Vector,
    Cross: 5 [Vector, Vector] => Vector,
    CrossOfCross: 1 [Vector, Vector, Vector] => Vector,
    Across: 5 [Vector, Unit] => Vector,
    OperationTurnedBack: 4 [Rotation, Vector, Scalar] => Vector,
    ToEffector: 4 [Vector, Rotation, Vector] => Vector,
    VectorOverLength: 3 [Vector] => Vector,
    LengthTimesDirection: 3 [Vector, Vector] => Vector,
    ScaleTwice: 3 [Scalar, Scalar, Vector] => Vector,
    WeightedSum: 3 [Scalar, Vector, Scalar, Vector] => Vector,
    SameFactor: 3 [Scalar, Vector, Vector] => Vector,
    SameVector: 3 [Scalar, Scalar, Vector] => Vector,
    TurnedSum: 3 [Rotation, Vector, Vector] => Vector,
    ThereAndBack: 2 [Rotation, Vector] => Vector,
    MeetInverse: 3 [Rotation, Vector, Vector] => Vector,
    Spread: 3 [Scalar, Vector, Scalar, Vector, Scalar] => Vector,
    AcrossOfSum: 3 [Vector, Scalar, Unit] => Vector,
    AcrossOfAcross: 2 [Vector, Unit] => Vector,
    AcrossOfCross: 2 [Vector, Unit] => Vector,
    Rejection: 2 [Vector, Unit] => Vector,
    Solve: 4 [Vector, Vector, Vector, Vector] => Vector,
    Rodrigues: 2 [Vector, Vector] => Vector,
    Spun: 1 [Vector, Scalar, Vector] => Vector,
    CrossInDots: 1 [Vector, Vector, Vector] => Vector,
    TurnedComponents: 2 [Vector, Scalar] => Vector,
    Normalize: 8 [Vector] => Unit,
    ToEffectorDirection: 5 [Vector, Rotation, Vector] => Unit,
    NormalizeTurned: 4 [Rotation, Vector] => Unit,
    Turn: 4 [Angle] => Rotation,
    About: 2 [Unit, Angle] => Rotation,
    AboutConstant: 2 [Angle] => Rotation,
    ByQuaternion: 2 [Vector, Scalar] => Rotation,
    ByTurn: 1 [Vector] => Rotation,
    Basis: 3 [] => Rotation,
    Compose: 5 [Rotation, Rotation] => Rotation,
    Transpose: 4 [Rotation] => Rotation,
    Conjugate: 3 [Rotation] => Rotation,
    AngleOf: 4 [Scalar] => Angle,
}

fn choice<T: Copy>(all: &[T], number: u8) -> T {
    all[usize::from(number) % all.len()]
}

/// Returns two numbers that vanish where `x` does, with the same order.
fn vanishing(
    g: &mut Graph,
    x: aim_symbolic::Scalar,
    w: aim_symbolic::Scalar,
    number: u8,
) -> (aim_symbolic::Scalar, aim_symbolic::Scalar) {
    use aim_symbolic::Function::{Acos, Asin, Cos, Cosh, Sin, Sinh, Tan, Tanh};
    let (half, one) = (g.constant(0.5), g.constant(1.0));
    let half = g.mul(half, x);
    let square = g.mul(x, x);
    match number % 12 {
        0 => (g.mul(w, x), x),
        1 => (g.call(Sin, x), x),
        2 => (g.call(Sin, half), x),
        3 => {
            let cos = g.call(Cos, x);
            (g.sub(one, cos), square)
        }
        4 => {
            let sin = g.call(Sin, x);
            (g.sub(x, sin), g.mul(square, x))
        }
        5 => (g.call(Tan, x), x),
        6 => (g.call(Sinh, x), x),
        7 => {
            let cosh = g.call(Cosh, x);
            (g.sub(cosh, one), square)
        }
        8 => (g.call(Tanh, half), x),
        9 => (g.atan2(x, w), x),
        10 => (g.call(Asin, x), x),
        _ => {
            let rest = g.sub(one, square);
            let angle = g.call(Acos, x);
            let root = g.sqrt(rest);
            (g.mul(w, angle), root)
        }
    }
}

/// Returns multiples of the sine and cosine of the angle between two vectors perpendicular to a third, by the same
/// factor. For the last values of `number` they are no such pair.
fn in_plane(g: &mut Graph, [a, b, c]: [aim_symbolic::Vector; 3], number: u8) -> [aim_symbolic::Scalar; 2] {
    let (length, axis) = (g.norm(b), g.normalize(b));
    let (m, n) = if number % 2 == 0 { (g.cross(a, b), g.cross(b, c)) } else { (g.cross(b, a), g.cross(c, b)) };
    let (m, n) = match number % 10 {
        0 => (g.normalize(m).into(), g.normalize(n).into()),
        1 => (g.across(a, axis), g.across(c, axis)),
        _ => (m, n),
    };
    let (cosine, cross) = (g.dot(m, n), g.cross(n, m));
    match number % 7 {
        0 if number % 4 == 0 => [g.norm(cross), cosine],
        0 | 1 => [g.dot(axis, cross), cosine],
        2 => [g.dot(cross, b), g.mul(cosine, length)],
        3 => {
            let (lever, over) = (g.cross(axis.into(), n), g.reciprocal(length));
            [g.dot(m, lever), cosine].map(|s| g.mul(over, s))
        }
        4 => {
            let along = g.dot(a, n);
            [g.mul(along, length), cosine]
        }
        5 => {
            let (along, cosine) = (g.dot(c, m), g.neg(cosine));
            [along, g.div(cosine, length)]
        }
        _ => [g.dot(b, cross), cosine],
    }
}

/// Result of a step.
enum StepResult {
    Scalar(aim_symbolic::Scalar),
    Vector(aim_symbolic::Vector),
    Unit(aim_symbolic::Unit),
    Rotation(aim_symbolic::Rotation),
    Angle(aim_symbolic::Angle),
}

macro_rules! made {
    ($($pool:ident),*) => { $(
        impl From<aim_symbolic::$pool> for StepResult {
            fn from(made: aim_symbolic::$pool) -> Self {
                Self::$pool(made)
            }
        }
    )* };
}
made!(Scalar, Vector, Unit, Rotation, Angle);

impl Pools {
    /// Applies a step.
    pub(crate) fn apply(&mut self, step: Step) {
        match self.make(step) {
            StepResult::Scalar(made) => self.scalars.push(made),
            StepResult::Vector(made) => self.vectors.push(made),
            StepResult::Unit(made) => self.units.push(made),
            StepResult::Rotation(made) => self.rotations.push(made),
            StepResult::Angle(made) => self.angles.push(made),
        }
    }

    fn make(&mut self, Step { kind, parts, number }: Step) -> StepResult {
        let s = |i: usize| self.scalars[usize::from(parts[i])];
        let v = |i: usize| self.vectors[usize::from(parts[i])];
        let u = |i: usize| self.units[usize::from(parts[i])];
        let r = |i: usize| self.rotations[usize::from(parts[i])];
        let a = |i: usize| self.angles[usize::from(parts[i])];
        let g = &mut self.g;
        match kind {
            StepKind::Same(Scalar) => s(0).into(),
            StepKind::Same(Vector) => v(0).into(),
            StepKind::Same(Unit) => u(0).into(),
            StepKind::Same(Rotation) => r(0).into(),
            StepKind::Same(Angle) => a(0).into(),
            StepKind::Constant => g.constant(choice(&NUMBERS, number)).into(),
            StepKind::Add => g.add(s(0), s(1)).into(),
            StepKind::Sub => g.sub(s(0), s(1)).into(),
            StepKind::Mul => g.mul(s(0), s(1)).into(),
            StepKind::Div => g.div(s(0), s(1)).into(),
            StepKind::Neg => g.neg(s(0)).into(),
            StepKind::Sqrt => g.sqrt(s(0)).into(),
            StepKind::Reciprocal => g.reciprocal(s(0)).into(),
            StepKind::Quotient => {
                let (above, below) = vanishing(g, s(0), s(1), number);
                g.div(above, below).into()
            }
            StepKind::QuotientOfLength => {
                let length = g.norm(v(0));
                let (above, below) = vanishing(g, length, s(1), number);
                let reciprocal = g.reciprocal(length);
                if below == length { g.mul(above, reciprocal).into() } else { g.div(above, below).into() }
            }
            StepKind::LengthTimesDirection => {
                let (length, direction) = (g.norm(v(0)), g.normalize(v(0)));
                let (above, below) = vanishing(g, length, length, number);
                let factor = if below == length { above } else { length };
                let along = match number % 3 {
                    0 => direction.into(),
                    1 => g.cross(direction.into(), v(1)),
                    _ => {
                        let dot = g.dot(direction, v(1));
                        g.scale(dot, direction.into())
                    }
                };
                g.scale(factor, along).into()
            }
            StepKind::Select => {
                let plain = g.select_less(s(0), s(1), s(2), s(3));
                match number % 6 {
                    // Nested in another select, on either side.
                    0 => g.select_less(s(3), s(1), plain, s(0)).into(),
                    1 => g.select_less(s(0), s(2), s(1), plain).into(),
                    // With the same condition again.
                    2 => {
                        let quotient = g.div(s(2), s(3));
                        let other = g.select_less(s(0), s(1), s(3), quotient);
                        g.mul(plain, other).into()
                    }
                    3 => {
                        let quotient = g.div(s(2), s(3));
                        let inner = g.select_less(s(2), s(1), quotient, plain);
                        g.select_less(s(0), s(1), inner, quotient).into()
                    }
                    _ => plain.into(),
                }
            }
            StepKind::Call => {
                let argument = if number % 2 == 0 { s(0) } else { g.neg(s(0)) };
                g.call(choice(&FUNCTIONS, number / 2), argument).into()
            }
            StepKind::Atan2 => g.atan2(s(0), s(1)).into(),
            StepKind::PlaneAngle => {
                // Most axes are constants of whole length, since half of the others have no length in the field.
                let axis = if number % 3 == 0 { v(1) } else { g.constant_vector(choice(&VECTORS, number)) };
                let [y, x] = in_plane(g, [v(0), axis, v(2)], number);
                g.atan2(y, x).into()
            }
            StepKind::Dot => g.dot(v(0), v(1)).into(),
            StepKind::Norm => g.norm(v(0)).into(),
            StepKind::Component => g.component(v(0), number % 3).into(),
            StepKind::RootOfSquare => {
                let square = g.dot(v(0), v(0));
                g.sqrt(square).into()
            }
            // The number's sign, divided by a length.
            StepKind::OverRoot => {
                let square = g.mul(s(0), s(0));
                let (aside, one) = (g.mul(s(1), s(1)), g.constant(1.0));
                let sum = g.add(one, aside);
                let square = g.mul(square, sum);
                let root = g.sqrt(square);
                g.div(s(0), root).into()
            }
            StepKind::OverLength => {
                let norm = g.norm(v(1));
                g.div(s(0), norm).into()
            }
            StepKind::DotOverLength => {
                let (dot, norm) = (g.dot(v(0), v(1)), g.norm(v(0)));
                g.div(dot, norm).into()
            }
            StepKind::LengthOfCross => {
                let cross = if number % 2 == 0 { g.cross(v(0), u(1).into()) } else { g.cross(u(1).into(), v(0)) };
                g.norm(cross).into()
            }
            StepKind::LengthOfConstantCross => {
                let unit = g.constant_vector(choice(&UNITS, number));
                let cross = g.cross(v(0), unit);
                g.norm(cross).into()
            }
            StepKind::DotOfTurned => {
                let (v, w) = (g.rotate(r(0), v(1)), g.rotate(r(0), v(2)));
                g.dot(v, w).into()
            }
            StepKind::DotWithConstant => {
                let (constant, back) = (g.constant_vector(choice(&VECTORS, number)), g.transpose(r(0)));
                let turned = g.rotate(if number % 2 == 0 { back } else { r(0) }, v(1));
                g.dot(turned, constant).into()
            }
            StepKind::DotBesideDirection => {
                let (effector, other) = (g.rotate(r(1), v(2)), g.rotate(r(1), v(3)));
                let sum = if number % 2 == 0 { g.sub_vectors(v(0), effector) } else { g.add_vectors(effector, v(0)) };
                let direction = g.normalize(sum);
                g.dot(direction, other).into()
            }
            StepKind::TwoTargets => {
                let effector = g.rotate(r(2), v(3));
                let axis = g.constant_vector(choice(&VECTORS, number));
                let forward = g.rotate(r(2), axis);
                let [first, second] = [v(0), v(1)].map(|target| {
                    let difference = g.sub_vectors(target, effector);
                    let direction = g.normalize(difference);
                    g.dot(direction, forward)
                });
                g.add(first, second).into()
            }
            StepKind::LengthToEffector => {
                let effector = g.rotate(r(1), v(2));
                let sum = if number % 2 == 0 { g.sub_vectors(v(0), effector) } else { g.add_vectors(v(0), effector) };
                g.norm(sum).into()
            }
            StepKind::SquareToEffector => {
                let effector = g.rotate(r(1), v(2));
                let sum = if number % 2 == 0 { g.sub_vectors(v(0), effector) } else { g.add_vectors(v(0), effector) };
                g.dot(sum, sum).into()
            }
            StepKind::DotAcrossPerp => {
                let across = g.across(v(0), u(1));
                let perp = g.perp(choice(&PLANES, number), u(1).into());
                g.dot(across, perp).into()
            }
            StepKind::DotAxisAcross => {
                let axis = g.constant_vector(core::array::from_fn(|k| f64::from(k == usize::from(number) % 3)));
                let across = g.across(axis, u(1));
                g.dot(across, v(0)).into()
            }
            StepKind::SquareOfDirections => {
                let turned = g.rotate(r(0), u(1));
                let difference = if number % 2 == 0 {
                    g.sub_vectors(turned, u(2).into())
                } else {
                    g.add_vectors(u(2).into(), turned)
                };
                g.dot(difference, difference).into()
            }
            StepKind::LengthAcrossDirection => {
                let (origin, forward) = (g.rotate(r(1), v(2)), g.rotate(r(1), v(3)));
                let difference = g.sub_vectors(v(0), origin);
                let direction = g.normalize(difference);
                let across = g.across(forward, direction);
                g.norm(across).into()
            }
            StepKind::DotAcrossAlong => {
                let across = g.across(v(1), u(3));
                let along = g.scale(s(2), u(3).into());
                let sum = g.add_vectors(v(0), along);
                g.dot(sum, across).into()
            }
            StepKind::ConstantVector => g.constant_vector(choice(&VECTORS, number)).into(),
            StepKind::Components => {
                let parts = match number % 4 {
                    0 => [(0, 1), (1, 2), (2, 0)]
                        .map(|(then, otherwise)| g.select_less(s(0), s(1), s(then), s(otherwise))),
                    _ => [s(0), s(1), s(2)],
                };
                g.components(parts).into()
            }
            StepKind::AddVectors => g.add_vectors(v(0), v(1)).into(),
            StepKind::SubVectors => g.sub_vectors(v(0), v(1)).into(),
            StepKind::NegVector => g.neg_vector(v(0)).into(),
            StepKind::Scale => g.scale(s(0), v(1)).into(),
            StepKind::Rotate => g.rotate(r(0), v(1)).into(),
            StepKind::RotateBack => {
                let back = g.transpose(r(0));
                g.rotate(back, v(1)).into()
            }
            StepKind::Direction => aim_symbolic::Vector::from(u(0)).into(),
            StepKind::Perp => g.perp(choice(&PLANES, number), v(0)).into(),
            StepKind::Cross => g.cross(v(0), v(1)).into(),
            StepKind::CrossOfCross => {
                let (cross, other) = (g.cross(v(0), v(1)), g.cross(v(2), v(1)));
                let with = [v(1), other, v(2)][usize::from(number) % 3];
                if number % 2 == 0 { g.cross(cross, with).into() } else { g.cross(with, cross).into() }
            }
            StepKind::Solve => {
                let m = Matrix::new([v(0), v(1), v(2)]);
                g.solve(if number % 2 == 0 { m } else { m.transpose() }, v(3)).into()
            }
            StepKind::Across => g.across(v(0), u(1)).into(),
            StepKind::OperationTurnedBack => {
                let back = g.transpose(r(0));
                let turned = g.rotate(back, v(1));
                match number % 5 {
                    0 => g.scale(s(2), turned).into(),
                    1 => g.neg_vector(turned).into(),
                    2 => aim_symbolic::Vector::from(g.normalize(turned)).into(),
                    3 => {
                        let direction = g.normalize(turned);
                        g.across(v(1), direction).into()
                    }
                    _ => g.perp(choice(&PLANES, number / 5), turned).into(),
                }
            }
            StepKind::ToEffector => {
                let effector = g.rotate(r(1), v(2));
                g.sub_vectors(v(0), effector).into()
            }
            StepKind::VectorOverLength => {
                let norm = g.norm(v(0));
                let one = g.constant(1.0);
                let over = if number % 2 == 0 { g.reciprocal(norm) } else { g.div(one, norm) };
                g.scale(over, v(0)).into()
            }
            StepKind::ScaleTwice => {
                let once = g.scale(s(1), v(2));
                g.scale(s(0), once).into()
            }
            StepKind::WeightedSum => {
                let (first, second) = (g.scale(s(0), v(1)), g.scale(s(2), v(3)));
                if number % 2 == 0 { g.add_vectors(first, second).into() } else { g.sub_vectors(first, second).into() }
            }
            StepKind::SameFactor => {
                let (first, second) = (g.scale(s(0), v(1)), g.scale(s(0), v(2)));
                if number % 2 == 0 { g.add_vectors(first, second).into() } else { g.sub_vectors(first, second).into() }
            }
            StepKind::SameVector => {
                let (first, second) = (g.scale(s(0), v(2)), g.scale(s(1), v(2)));
                if number % 2 == 0 { g.add_vectors(first, second).into() } else { g.sub_vectors(first, second).into() }
            }
            StepKind::TurnedSum => {
                let (first, second) = (g.rotate(r(0), v(1)), g.rotate(r(0), v(2)));
                if number % 2 == 0 { g.add_vectors(first, second).into() } else { g.sub_vectors(first, second).into() }
            }
            StepKind::ThereAndBack => {
                let (there, back) = (g.rotate(r(0), v(1)), g.transpose(r(0)));
                g.rotate(back, there).into()
            }
            StepKind::MeetInverse => {
                let back = g.transpose(r(0));
                let (first, second) = if number % 4 < 2 { (r(0), back) } else { (back, r(0)) };
                let there = g.rotate(first, v(1));
                let sum = if number % 2 == 0 { g.add_vectors(v(2), there) } else { g.sub_vectors(v(2), there) };
                g.rotate(second, sum).into()
            }
            StepKind::Spread => {
                let (k, m) = (s(0), s(2));
                let along = g.scale(m, v(3));
                let difference = g.sub_vectors(v(1), along);
                let first = g.scale(k, difference);
                let n = if number % 2 == 0 { s(4) } else { g.mul(m, s(4)) };
                let second = g.scale(n, v(3));
                g.add_vectors(first, second).into()
            }
            StepKind::AcrossOfSum => {
                let along = g.scale(s(1), u(2).into());
                let sum = if number % 2 == 0 { g.add_vectors(v(0), along) } else { g.sub_vectors(along, v(0)) };
                g.across(sum, u(2)).into()
            }
            StepKind::AcrossOfAcross => {
                let across = g.across(v(0), u(1));
                g.across(across, u(1)).into()
            }
            StepKind::AcrossOfCross => {
                let cross = g.cross(v(0), u(1).into());
                let sum = if number % 2 == 0 { cross } else { g.add_vectors(cross, v(0)) };
                g.across(sum, u(1)).into()
            }
            StepKind::Rejection => {
                let along = g.dot(v(0), u(1));
                let along = g.scale(along, u(1).into());
                g.sub_vectors(v(0), along).into()
            }
            StepKind::Rodrigues => {
                let (turn, point) = (v(0), v(1));
                let square = g.dot(turn, turn);
                let factor = |g: &mut Graph, order| g.stumpff(Stumpff { hyperbolic: false, order }, square);
                let aside = g.cross(turn, point);
                let (sine, versine) = (factor(g, 1), factor(g, 2));
                let (kept, along) = if number % 2 == 0 {
                    let (cos, dot) = (factor(g, 0), g.dot(turn, point));
                    let along = g.mul(versine, dot);
                    (g.scale(cos, point), g.scale(along, turn))
                } else {
                    let twice = g.cross(turn, aside);
                    (point, g.scale(versine, twice))
                };
                let aside = g.scale(sine, aside);
                let sum = g.add_vectors(kept, aside);
                g.add_vectors(sum, along).into()
            }
            StepKind::Spun => {
                let (u, w, point, two) = (v(0), s(1), v(2), g.constant(2.0));
                let (square, w_square, dot) = (g.dot(u, u), g.mul(w, w), g.dot(u, point));
                let (kept, aside, along) = (g.sub(w_square, square), g.mul(two, w), g.mul(two, dot));
                let cross = g.cross(u, point);
                let [kept, aside, along] = [(kept, point), (aside, cross), (along, u)].map(|(k, v)| g.scale(k, v));
                let sum = g.add_vectors(kept, along);
                if number % 2 == 0 { g.add_vectors(sum, aside) } else { g.sub_vectors(sum, aside) }.into()
            }
            StepKind::CrossInDots => {
                let (u, w, c) = (v(0), v(1), v(2));
                let (first, second) = (g.dot(u, c), g.dot(w, c));
                let (first, second) = (g.scale(first, w), g.scale(second, u));
                let (difference, cross) = (g.sub_vectors(first, second), g.cross(u, w));
                if number % 2 == 0 { g.add_vectors(difference, cross) } else { g.sub_vectors(cross, difference) }.into()
            }
            StepKind::TurnedComponents => {
                let plane = choice(&PLANES, number);
                let (i, k) = (usize::from(plane.from), usize::from(plane.towards));
                let (sin, cos) = (g.call(aim_symbolic::Function::Sin, s(1)), g.call(aim_symbolic::Function::Cos, s(1)));
                let parts = [0, 1, 2].map(|axis| g.component(v(0), axis));
                let mut turned = parts;
                let (x, y) = (g.mul(cos, parts[i]), g.mul(parts[k], sin));
                turned[i] = g.sub(x, y);
                let (x, y) = (g.mul(sin, parts[i]), g.mul(cos, parts[k]));
                turned[k] = g.add(x, y);
                g.components(turned).into()
            }
            StepKind::Normalize => g.normalize(v(0)).into(),
            StepKind::ToEffectorDirection => {
                let effector = g.rotate(r(1), v(2));
                let difference = g.sub_vectors(v(0), effector);
                g.normalize(difference).into()
            }
            StepKind::NormalizeTurned => {
                let turned = g.rotate(r(0), v(1));
                g.normalize(turned).into()
            }
            StepKind::Turn => g.turn(choice(&PLANES, number), a(0)).into(),
            StepKind::About => g.about(u(0).into(), a(1)).into(),
            StepKind::AboutConstant => {
                let axis = g.constant_vector(choice(&UNITS, number));
                g.about(axis, a(0)).into()
            }
            StepKind::ByQuaternion => g.attitude(Attitude::Quaternion(v(0), s(1))).into(),
            StepKind::ByTurn => g.attitude(Attitude::Turn(v(0))).into(),
            StepKind::Basis => g.basis(choice(&BASES, number)).into(),
            StepKind::Compose => g.compose(r(0), r(1)).into(),
            StepKind::Transpose => g.transpose(r(0)).into(),
            StepKind::Conjugate => {
                let basis = g.basis(choice(&BASES, number));
                let back = g.transpose(basis);
                let inner = g.compose(r(0), basis);
                g.compose(back, inner).into()
            }
            StepKind::AngleOf => g.angle_of(s(0)).into(),
        }
    }
}
