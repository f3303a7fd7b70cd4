//! The sections on the stated objectives, decomposed at the effector's origin and tip.

use aim_codegen::objective::CHAIN_RESIDUAL_JACOBIAN;
use aim_symbolic::print::{self, Formula};
use aim_symbolic::{Graph, Node, Scalar, ScalarNode, Vector, VectorNode};

use super::document::{Block, Equation, Section, text};
use super::kernel::Kernel;

/// Origin and tip of the effector in a stated aim.
pub(super) struct Points {
    pub(super) origin: Vector,
    pub(super) tip: Vector,
}

impl Points {
    /// Finds the points in an aim stated as `(P − origin) / |P − origin| · (tip − origin)`; `None` if it has another
    /// form.
    pub(super) fn find(g: &Graph, aim: Scalar) -> Option<Self> {
        let ScalarNode::Dot(a, b) = g.scalar_node(aim) else { return None };
        [(a, b), (b, a)].into_iter().find_map(|(direction, to_target)| {
            let VectorNode::Sub(tip, origin) = g.vector_node(direction) else { return None };
            let VectorNode::Normalize(_) = g.vector_node(to_target) else { return None };
            Some(Self { origin, tip })
        })
    }
}

/// Returns the section on the aim of one joint.
pub(super) fn section(kernel: &Kernel<'_>) -> Section {
    let g = &kernel.derivation.graph;
    let aim = kernel.derivation.stated[0];
    let mut blocks = vec![Block::Paragraph(text![
        "Consider one joint, and keep everything between it and the effector fixed. The effector’s position and direction in the joint’s \
         space then depend only on the joint’s own angles. In effector space, the effector’s origin is ",
        Formula::vector("0"),
        " and its tip, one unit ahead, is ",
        Formula::vector("f"),
        "; ",
        Formula::italic("M"),
        " and ",
        Formula::vector("t"),
        " transform both to the joint’s space, and the joint’s added rotation turns them:",
    ])];
    let mut notation = kernel.notation.clone();
    let mut equations = Vec::new();
    if let Some(Points { origin, tip }) = Points::find(g, aim) {
        for (point, index, paper) in [(origin, 0, 4), (tip, 1, 5)] {
            let symbol = Formula::vector("P").numbered(index);
            let right = print::definition(g, Node::Vector(point), &notation);
            equations.push(Equation { left: symbol.clone(), right, paper: Some(paper) });
            notation.parts.push((Node::Vector(point), symbol));
        }
    }
    let right = print::scalar(g, aim, &notation);
    equations.push(Equation { left: Formula::upright("aim"), right, paper: Some(6) });
    blocks.push(Block::Equations(equations));
    blocks.push(Block::Paragraph(text![
        "The aim is the cosine of the angle between the effector’s direction and the direction to the target: the dot product \
         of two unit vectors. It is 1 with the target straight ahead and −1 with the target straight behind. If the target \
         coincides with the effector’s origin, it has no direction; the fraction, and with it the aim, is then defined as 0.",
    ]));
    Section { id: "aim", title: "The effector and its aim".into(), blocks }
}

/// Returns the statement of one of the chain's objectives.
pub(super) fn of_chain(kernel: &Kernel<'_>) -> Vec<Block> {
    let words = if *kernel.emitted.objective == CHAIN_RESIDUAL_JACOBIAN {
        text![
            "The residual gives by how much the effector misses the target, to the left and up. It is the stereographic projection \
             of the target’s direction from the point straight behind: its length is 2 tan(½ angle), which is 0 on target and \
             grows until straight behind, where it is undefined and counts as 0. With the vector from the effector to the \
             target, its length and its components forward, left and up, it is stated as",
        ]
    } else {
        text!["The aim is stated as for one joint, but through all joints:"]
    };
    let Kernel { derivation, notation, .. } = kernel;
    vec![Block::Paragraph(words), defined(&derivation.graph, &derivation.stated, kernel.values(), notation)]
}

/// Returns the equations that define these expressions under their names, after those of their common subexpressions.
pub(super) fn defined(g: &Graph, scalars: &[Scalar], names: &[Formula], notation: &print::Notation) -> Block {
    let defined = print::name_parts(g, scalars, notation);
    let mut equations: Vec<Equation> = defined.equations(g).into_iter().map(Equation::from).collect();
    for (&scalar, name) in scalars.iter().zip(names) {
        equations.push((name.clone(), print::scalar(g, scalar, &defined.notation)).into());
    }
    Block::Equations(equations)
}
