//! A small symbolic derivative compiler for rigid kinematics.
//!
//! Scalars, vectors, rotations and rigid transforms are *types* of one hash-consed [`Graph`], so that rewriting can use
//! identities that scalar algebra systems cannot see, such as `R Rᵀ = 1`. The passes, in order:
//!
//! 1. The caller states an objective with the constructors of [`Graph`], as it would be written on paper.
//! 2. [`rules`] move rotations to where they cancel or cost least.
//! 3. [`gradient`](Graph::gradient) sweeps backwards over whole vectors, in time linear in the length of a chain;
//!    [`tangents`](Graph::tangents) sweeps forwards.
//! 4. More rules drop radial parts and gather common factors. The result is split into components, folded, shared and
//!    ordered into a straight-line [`Program`]. Where rules compete, [`Program::derive`] derives a bounded number of
//!    variants and keeps the one with the fewest operations.
//! 5. The program is run ([`Program::run`]), counted ([`Program::count`]), traced ([`Program::trace`]) or printed
//!    ([`mod@print`]).
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
//! let program = Program::derive(&g, &[objective], &[angle]);
//! let mut out = [0.0; 2];
//! // The inputs in order of their declaration: v, w, then the sine and cosine of the angle.
//! program.run(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0], &mut out);
//! assert_eq!(out, [0.0, 1.0]);
//! ```

mod diff;
mod ir;
mod lower;
pub mod print;
mod program;
mod rewrite;

pub use diff::differential::ReciprocalPlacement;
pub use diff::sweep::{SweepDirection, SweepRecord, VisitedNode};
pub use ir::evaluate::Bindings;
pub use ir::graph::Graph;
pub use ir::graph::prune::Pruned;
pub use ir::node::{
    Angle, Attitude, Direction, InputKind, Matrix, Node, Plane, Rigid, Rotation, RotationNode, Scalar, ScalarNode,
    Space, Unit, Variable, Vector, VectorNode,
};
pub use ir::number::Number;
pub use ir::op::{Constant, Function, Op, Value};
pub use ir::smooth::Stumpff;
pub use lower::fold::Fold;
pub use program::Program;
pub use program::count::Count;
pub use program::derivation::{Aspect, Derivation, Meaning, Step};
pub use program::derive::Want;
pub use program::singular::{Condition, Singular};
pub use rewrite::log::Rewrite;
pub use rewrite::rules;
