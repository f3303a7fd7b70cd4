//! The section on derivatives: one sweep over whole vectors, part by part.

use aim_symbolic::print::{self, Formula, Notation};
use aim_symbolic::{
    Graph, Node, Op, Rotation, RotationNode, Scalar, ScalarNode, SweepDirection, SweepRecord, VectorNode, VisitedNode,
};

use super::document::{Block, Kind, Section, Table, Text, text};
use super::kernel::Kernel;
use super::{rewriting, statement};

pub(super) fn section(kernel: &Kernel<'_>) -> Section {
    let mut blocks = vec![
        Block::Paragraph(text![
            "A derivative contributions the first-order change of the aim when an angle changes slightly. The chain rule computes it one \
             part of the expression at a time, and a part may be a whole vector. If the aim depends on a vector ",
            Formula::vector("w"),
            ", then ",
            Formula::vector("w").barred(),
            " denotes its derivative with respect to that vector: the aim changes by ",
            Formula::infix(Formula::vector("w").barred(), print::Sign::Dot, Formula::upright("change")),
            " of ",
            Formula::vector("w"),
            ". Going backwards from the aim to the angles, each part passes its derivative on to its own parts. Every part is \
             therefore visited once, however many angles there are.",
        ]),
        Block::Paragraph(text![
            "Angles enter through rotations. Differentiating the cosines and sines of a rotation matrix contributions the same matrix, \
             followed by a quarter turn in its plane: per radian, a rotated vector moves by its own perpendicular in that \
             plane, which is already available.",
        ]),
    ];
    blocks.extend(self::blocks(kernel));
    Section { id: "gradient", title: "The gradient".into(), blocks }
}

/// Returns the tables of the sweeps, and the blocks on the rewriting of their results.
pub(super) fn blocks(kernel: &Kernel<'_>) -> Vec<Block> {
    let derivation = &kernel.derivation;
    let mut blocks = Vec::new();
    if !kernel.parts.is_empty() {
        blocks.push(Block::Paragraph(text![
            "The parts that depend on the angles, from the inside out, each with a name:"
        ]));
        blocks.push(Block::Equations(kernel.parts.clone()));
    }
    blocks.extend(derivation.sweeps.iter().map(|swept| Block::Table(sweep(kernel, swept))));
    blocks.extend(rewriting::after_derivatives(kernel));
    blocks.push(Block::Paragraph(text!["The code computes these formulas:"]));
    blocks.push(statement::defined(&derivation.graph, &derivation.outputs, &kernel.outputs, &kernel.named));
    blocks
}

fn sweep(kernel: &Kernel<'_>, swept: &SweepRecord) -> Table {
    let (caption, head, rows) = match swept.direction {
        SweepDirection::Backward(scalar) => (
            "Backward sweep: each part’s derivative, from those of the parts that use it",
            ["derivative", "is", "because"],
            back(kernel, swept, scalar),
        ),
        SweepDirection::Forward(_) => (
            "Forward sweep: each part’s change with the angle, from the changes of its own parts",
            ["part", "changes by", "because"],
            forward(kernel, swept),
        ),
    };
    Table::new(Kind::Code, caption, &head, rows)
}

/// Length up to which a formula is repeated instead of named.
const SHORT: usize = 3;

fn back(kernel: &Kernel<'_>, swept: &SweepRecord, scalar: Scalar) -> Vec<Vec<Text>> {
    let g = &kernel.derivation.graph;
    let mut notation = kernel.named.clone();
    let place = kernel.derivation.values.iter().position(|&known| known == scalar);
    let value = kernel.outputs[place.unwrap_or_default()].clone();
    let mut rows = Vec::new();
    for VisitedNode { node, derivative, contributions } in &swept.visited {
        let symbol = if *node == Node::Scalar(scalar) {
            Formula::derivative(value.clone(), value.clone())
        } else {
            print::node(g, *node, &notation).barred()
        };
        let right = print::node(g, *derivative, &notation);
        rows.push(vec![text![symbol.clone()], text![right.clone()], needed_by(g, swept, *node)]);
        // Sums pass a derivative on unchanged; it then keeps its first name.
        if right.length() > SHORT && !notation.parts.iter().any(|(known, _)| known == derivative) {
            notation.parts.push((*derivative, symbol));
        }
        for &(variable, change) in contributions {
            let by = Formula::derivative(value.clone(), kernel.variable(variable));
            let because = match *node {
                Node::Vector(vector) => match g.vector_node(vector) {
                    VectorNode::Rotate(rotation, _) => {
                        turned(g, rotation, &print::node(g, *node, &notation), &notation)
                    }
                    _ => text!["of this part"],
                },
                Node::Scalar(_) => text!["of this part"],
            };
            rows.push(vec![text![by], text![print::scalar(g, change, &notation)], because]);
        }
    }
    rows
}

/// Returns the reason for the derivative of a turned vector by the angle of the turn.
fn turned(g: &Graph, rotation: Rotation, part: &Formula, notation: &Notation) -> Text {
    let turn = print::rotation(g, rotation, notation);
    let back = matches!(g.rotation_node(rotation), RotationNode::Transpose(_));
    text![
        turn,
        if back { " turns " } else { " turned " },
        part.clone(),
        if back {
            " back: per radian, it moves against its perpendicular"
        } else {
            ": per radian, it moves along its perpendicular"
        },
    ]
}

/// Returns the rules by which the parts that use this one pass their derivatives on to it.
fn needed_by(g: &Graph, swept: &SweepRecord, node: Node) -> Text {
    let mut reasons: Vec<&'static str> = Vec::new();
    let mut times = 0;
    for VisitedNode { node: needing, .. } in &swept.visited {
        if g.parts(*needing).contains(&node) {
            times += 1;
            let reason = rule(g, *needing, Some(node));
            if !reasons.contains(&reason) {
                reasons.push(reason);
            }
        }
    }
    match (reasons.as_slice(), times) {
        ([], _) => text!["this is the value itself"],
        (reasons, times) => {
            let all = reasons.join("; ");
            if times > 1 { text![format!("used {times} times, so the terms add up: {all}")] } else { text![all] }
        }
    }
}

/// Returns the rule for the change of an expression with all of its parts, or with the given one.
fn rule(g: &Graph, whole: Node, part: Option<Node>) -> &'static str {
    const SUM: &str = "a sum changes as its terms do";
    const FIRST_TERM: &str = "a difference changes as its first term does";
    const SECOND_TERM: &str = "a difference changes against its second term";
    const SIGN: &str = "the sign is kept";
    const PRODUCT: &str = "a product changes by the change of one factor, times the other";
    match whole {
        Node::Scalar(scalar) => match g.scalar_node(scalar) {
            ScalarNode::Dot(v, w) if v == w => "the derivative of a square is twice its root",
            ScalarNode::Dot(..) => "a dot product changes by the change of one side, dot the other side",
            ScalarNode::Norm(_) => "a length changes by as much as its vector moves along its own direction",
            ScalarNode::Component(..) => "a component is a dot product with its axis",
            ScalarNode::Reciprocal(_) => "the derivative of 1/x is −1/x²",
            ScalarNode::Op(Op::Sub(_, second)) if part == Some(Node::Scalar(second)) => SECOND_TERM,
            ScalarNode::Op(Op::Sub(..)) if part.is_some() => FIRST_TERM,
            ScalarNode::Op(Op::Add(..) | Op::Sub(..)) => SUM,
            ScalarNode::Op(Op::Neg(_)) => SIGN,
            ScalarNode::Op(Op::Mul(..)) => PRODUCT,
            ScalarNode::Op(Op::Div(..)) => "the quotient rule",
            ScalarNode::Op(Op::Sqrt(_)) => "the derivative of √x is 1/(2√x)",
            _ => "the chain rule",
        },
        Node::Vector(vector) => match g.vector_node(vector) {
            VectorNode::Normalize(_) => {
                "a direction changes only by the motion of its vector across it, divided by the length; motion along it changes only \
                 the length"
            }
            VectorNode::Rotate(..) => "v · R w = Rᵀ v · w, so the derivative is turned back",
            VectorNode::Sub(_, second) if part == Some(Node::Vector(second)) => SECOND_TERM,
            VectorNode::Sub(..) if part.is_some() => FIRST_TERM,
            VectorNode::Add(..) | VectorNode::Sub(..) => SUM,
            VectorNode::Neg(_) => SIGN,
            VectorNode::Scale(..) => PRODUCT,
            VectorNode::Motion(..) => "the angular velocity, times the moment",
            VectorNode::Imaginary(..) => "a quaternion changes by half the angular velocity times the quaternion",
            VectorNode::Perp(..) => "the quarter turn is turned back",
            VectorNode::Solve(..) => "M M⁻¹ = 1, so the derivative of M⁻¹ is −M⁻¹ dM M⁻¹",
            VectorNode::Cross(..) => "the product rule for the cross product",
            _ => "the chain rule",
        },
    }
}

fn forward(kernel: &Kernel<'_>, swept: &SweepRecord) -> Vec<Vec<Text>> {
    let g = &kernel.derivation.graph;
    let mut notation = kernel.named.clone();
    let mut rows = Vec::new();
    for VisitedNode { node, derivative, .. } in &swept.visited {
        let place = kernel.derivation.values.iter().position(|&value| *node == Node::Scalar(value));
        let symbol = place.map_or_else(|| print::node(g, *node, &notation), |place| kernel.outputs[place].clone());
        let right = print::node(g, *derivative, &notation);
        let because = match *node {
            Node::Vector(vector) => match g.vector_node(vector) {
                VectorNode::Rotate(rotation, inner) => {
                    let turns = turned(g, rotation, &symbol, &notation);
                    let moves = swept.visited.iter().any(|passage| passage.node == Node::Vector(inner));
                    if moves { text!["the rotation turns the change as well"] } else { turns }
                }
                _ => text![rule(g, *node, None)],
            },
            Node::Scalar(_) => text![rule(g, *node, None)],
        };
        rows.push(vec![text![symbol.clone()], text![right.clone()], because]);
        if right.length() > SHORT && !notation.parts.iter().any(|(known, _)| known == derivative) {
            notation.parts.push((*derivative, symbol.barred()));
        }
    }
    rows
}
