//! A small symbolic derivative compiler for rigid kinematics.
//!
//! Scalars, vectors, rotations and rigid transforms are *types* of one hash-consed [`Graph`], so that the rewriting
//! knows what no scalar algebra system knows: `R Rᵀ = 1`. The passes, in order:
//!
//! 1. An objective is stated with the constructors of [`Graph`], as its author would write it down.
//! 2. [`rewrite`](Graph::rewrite) moves rotations to where they cancel or cost least ([`rules`]).
//! 3. [`gradient`](Graph::gradient) sweeps backwards over whole vectors: linear in the length of a chain.
//! 4. [`Program::derive`] lowers to components, folds, shares and orders them: a straight-line [`Program`].
//! 5. The program is run ([`Program::run`]), counted ([`Program::count`]) or printed ([`mod@print`]).
//!
//! ```
//! use aim_symbolic::{Graph, Plane, Program};
//!
//! let mut g = Graph::new();
//! let (v, w) = (g.vector_input("v"), g.vector_input("w"));
//! let angle = g.angle("a");
//! let turn = g.turn(Plane::XY, angle);
//! let turned = g.rotate(turn, v);
//! let objective = g.dot(turned, w);
//! let program = Program::derive(&mut g, &[objective], &[angle]);
//! let mut out = [0.0; 2];
//! // The inputs in order of their declaration: v, w, then the sine and cosine of the angle.
//! program.run(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0], &mut out);
//! assert_eq!(out, [0.0, 1.0]);
//! ```

mod count;
mod derive;
mod directions;
mod evaluate;
mod factor;
mod fold;
mod frames;
mod gradient;
mod graph;
mod interpret;
mod lower;
mod node;
mod order;
mod partial;
pub mod print;
mod products;
mod program;
mod rebuild;
pub mod rules;
mod scaling;
mod signs;
mod table;
mod tangent;
mod tidy;
mod trace;

pub use count::Count;
pub use derive::Want;
pub use evaluate::Bindings;
pub use gradient::Placement;
pub use graph::Graph;
pub use interpret::Number;
pub use node::{
    Angle, Constant, Function, InputKind, Plane, Rigid, Rotation, RotationNode, Scalar, ScalarNode, Unit, Variable,
    Vector, VectorNode,
};
pub use program::{Op, Program, Value};
pub use trace::Step;
