//! Constant rotations next to turns: a part of the constant rotation that turns in the same plane is added to the
//! angle. [`BASES`](crate::rewrite::rules::BASES).

use crate::ir::node::Node;
use crate::rewrite::rotations::leading;
use crate::{Angle, Graph, Plane, Rotation, RotationNode, Scalar, Vector, VectorNode};

type Matrix = [[f64; 3]; 3];

/// Returns a change of basis as a matrix in which row i gives component i of the image.
fn as_basis(g: &Graph, rotation: Rotation) -> Option<Matrix> {
    let rows = |entries: [crate::Constant; 9]| [0, 1, 2].map(|i| [0, 1, 2].map(|k| entries[3 * i + k].value()));
    match g.untransposed(rotation) {
        (RotationNode::Basis(images), false) => Some(transposed(rows(images))),
        (RotationNode::Basis(images), true) => Some(rows(images)),
        _ => None,
    }
}

impl Graph {
    /// Returns `true` if `outputs` depend on a change of basis whose matrix has no zeros.
    pub(crate) fn has_general_basis(&self, outputs: &[Scalar]) -> bool {
        self.order(outputs).iter().any(|node| match *node {
            Node::Vector(v) => leading(self, v)
                .and_then(|(rotation, _)| as_basis(self, rotation))
                .is_some_and(|m| m.iter().flatten().all(|&c| c != 0.0)),
            Node::Scalar(_) => false,
        })
    }
}

fn transposed(m: Matrix) -> Matrix {
    [0, 1, 2].map(|i| [0, 1, 2].map(|k| m[k][i]))
}

/// Returns the plane and the angle of a turn, and `true` if `rotation` is its inverse.
fn as_turn(g: &Graph, rotation: Rotation) -> Option<(Plane, Angle, bool)> {
    match g.untransposed(rotation) {
        (RotationNode::Turn(plane, angle), back) => Some((plane, angle, back)),
        _ => None,
    }
}

/// Splits a matrix without zeros into M = T(ε) M′, with T a turn in the plane and a zero in M′. Returns the sine and
/// cosine of ε, and M′.
fn split(m: Matrix, plane: Plane) -> Option<([f64; 2], Matrix)> {
    if m.iter().flatten().any(|&c| c == 0.0) {
        return None;
    }
    let (from, towards) = plane.axes();
    // The column with the smallest component along the axis has the largest part in the plane, so that the angle is
    // well conditioned.
    let axis = 3 - from - towards;
    let column = (1..3).fold(0, |best, k| if m[axis][k].abs() < m[axis][best].abs() { k } else { best });
    let [first, second] = [from, towards].map(|row| m[row][column]);
    // The inverse turn by ε maps `first` to first cos + second sin and `second` to second cos − first sin. One of the
    // two becomes 0, by the smaller of the two possible angles.
    let (zero, tan) = if first.abs() >= second.abs() { (towards, second / first) } else { (from, -first / second) };
    let cos = 1.0 / (1.0 + tan * tan).sqrt();
    let sin = tan * cos;
    let mut rest = m;
    for k in 0..3 {
        rest[from][k] = cos * m[from][k] + sin * m[towards][k];
        rest[towards][k] = cos * m[towards][k] - sin * m[from][k];
    }
    rest[zero][column] = 0.0;
    Some(([sin, cos], rest))
}

/// `T(θ) M = T(θ + ε) M′`, and likewise with the change of basis last.
pub(crate) fn turn_into_angle(g: &mut Graph, v: Vector) -> Option<Vector> {
    let VectorNode::Rotate(outer, inner) = g.vector_node(v) else { return None };
    let (first, core) = leading(g, inner)?;
    let (turn, basis, is_basis_first) = match (as_turn(g, outer), as_turn(g, first)) {
        (Some(turn), None) => (turn, as_basis(g, first)?, true),
        // M T(θ) is the inverse of T(−θ) Mᵀ.
        (None, Some(turn)) => (turn, transposed(as_basis(g, outer)?), false),
        _ => return None,
    };
    let (plane, angle, back) = turn;
    let ([sin, cos], rest) = split(basis, plane)?;
    let is_less = back == is_basis_first;
    let angle = g.shifted_angle(angle, [if is_less { -sin } else { sin }, cos]);
    let mut turn = g.turn(plane, angle);
    if back {
        turn = g.transpose(turn);
    }
    // The images of the axes are the columns of the matrix.
    let images = if is_basis_first { transposed(rest) } else { rest };
    let basis = g.basis(images);
    let [once, twice] = if is_basis_first { [basis, turn] } else { [turn, basis] };
    let once = g.rotate(once, core);
    Some(g.rotate(twice, once))
}
