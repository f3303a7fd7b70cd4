//! Variables on a manifold: rotations and rigid transforms, with derivatives with respect to their tangent vectors.
//!
//! | type | its tangent | q ⊕ δ, perturbed on the right | on the left |
//! |---|---|---|---|
//! | `Quat`, and `Mat3` as a rotation | a vector ω | q exp ω | exp(ω) q |
//! | `Rigid`, `Affine3A` | ω and ρ | R exp ω, t + R ρ | exp(ω) R, exp(ω) t + ρ |
//! | arrays and tuples | the tangents of their elements | | |
//! | structs | the tuple of their fields' tangents | | |
//! | numbers and vectors | themselves | x + δ | x + δ |
//! | values that do not vary | `()` | | |

use aim_symbolic::{Rotation, Scalar, Vector, VectorNode};
use quote::quote;

use super::lower::{Affine, Algebra, Map, Quaternion};
use super::types::{Precision, Shape, Type};

/// Side of a rotation on which its step is composed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Side {
    Left,
    #[default]
    Right,
}

/// The part of an argument that derivatives are taken with respect to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum VaryingPart {
    Nothing,
    Numbers,
    /// Its tangent vector.
    Tangent(Side),
}

impl Type {
    /// Returns `true` if the type contains a rotation.
    pub(super) fn has_rotation(&self) -> bool {
        let mut found = false;
        self.leaves(&mut |leaf| found |= matches!(leaf.shape, Shape::Quaternion | Shape::Matrix | Shape::Rigid));
        found
    }

    /// Returns the type of its tangent. Vectors come from the same module as its own types, or from the facade `krate`.
    pub(super) fn tangent(&self, krate: &proc_macro2::TokenStream) -> Self {
        let of_parts = |parts: Vec<Self>| {
            let types = parts.iter().map(|part| &part.tokens);
            Self::made(quote!((#(#types,)*)), Shape::Tuple(parts.clone()), self.precision)
        };
        let vector = || {
            let name = if self.precision == Some(Precision::Double) { "DVec3" } else { "Vec3" };
            Self::made(self.neighbour(name, krate), Shape::Vector, self.precision)
        };
        match &self.shape {
            Shape::Quaternion | Shape::Matrix => vector(),
            Shape::Rigid => of_parts(vec![vector(), vector()]),
            Shape::Array(element, length) => {
                let element = element.tangent(krate);
                let tokens = &element.tokens;
                Self::made(quote!([#tokens; #length]), Shape::Array(Box::new(element.clone()), *length), self.precision)
            }
            Shape::Tuple(parts) => of_parts(parts.iter().map(|part| part.tangent(krate)).collect()),
            Shape::Struct(_, fields, _) => of_parts(fields.iter().map(|(_, field)| field.tangent(krate)).collect()),
            _ if self.dimension() == 0 => of_parts(Vec::new()),
            _ => self.owned(),
        }
    }
}

impl Side {
    /// Composes a rotation with a step; also returns the step and its components.
    fn step(self, a: &mut Algebra, rotation: Rotation) -> (Rotation, Vector, [Scalar; 3]) {
        let step = a.g.step();
        let turn = a.g.turn_by_step(step);
        let moved = match self {
            Self::Left => a.g.compose(turn, rotation),
            Self::Right => a.g.compose(rotation, turn),
        };
        (moved, step, components(a, step))
    }

    /// Returns a quaternion of length 1 that moves on its manifold, and the components of its step.
    pub(super) fn quaternion(self, a: &mut Algebra, [x, y, z, w]: [Scalar; 4]) -> (Quaternion, [Scalar; 3]) {
        let u = a.vector([x, y, z]);
        let rotation = a.g.quaternion(u, w);
        let (rotation, step, components) = self.step(a, rotation);
        // exp δ = (δ/2, 1 − |δ|²/8), to second order.
        let (half, one, eighth) = (a.number(0.5), a.number(1.0), a.number(0.125));
        let (vector, square) = (a.scale(half, step), a.dot(step, step));
        let less = a.mul(eighth, square);
        let turn = [(u, w), (vector, a.sub(one, less))];
        let turn = turn.map(|(u, w)| Quaternion { map: Map::identity(a), parts: (u, w) });
        let [still, turn] = &turn;
        let parts = if self == Self::Left { turn.compose(a, still) } else { still.compose(a, turn) }.parts;
        (Quaternion { map: Map::Rotation(rotation), parts }, components)
    }

    /// Returns a rotation matrix that moves on its manifold, and the components of its step.
    pub(super) fn matrix(self, a: &mut Algebra, rows: [Scalar; 9]) -> (Map, [Scalar; 3]) {
        let rotation = a.g.matrix(rows);
        let (rotation, _, components) = self.step(a, rotation);
        (Map::Rotation(rotation), components)
    }

    /// Returns a rigid transform that moves on its manifold, and the components of its step.
    pub(super) fn rigid(self, a: &mut Algebra, rows: [Scalar; 9], translation: Vector) -> (Affine, [Scalar; 6]) {
        let still = a.g.matrix(rows);
        let (rotation, step, turned) = self.step(a, still);
        let shift = a.g.step();
        let shifted = components(a, shift);
        let translation = match self {
            Self::Left => {
                let turn = a.g.turn_by_step(step);
                let turned = a.g.rotate(turn, translation);
                a.add_vectors(turned, shift)
            }
            Self::Right => {
                let shift = a.g.rotate(still, shift);
                a.add_vectors(translation, shift)
            }
        };
        let ([a0, a1, a2], [b0, b1, b2]) = (turned, shifted);
        (Affine { map: Map::Rotation(rotation), translation }, [a0, a1, a2, b0, b1, b2])
    }
}

fn components(a: &Algebra, step: Vector) -> [Scalar; 3] {
    match a.g.vector_node(step) {
        VectorNode::Components(components) => components,
        node => unreachable!("{node:?} is no step"),
    }
}
