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
        "Take one joint and hold still what lies between it and the effector. Then the effector’s place and direction in the joint’s space \
         follow from the joint’s own angles alone. In effector space the effector’s origin is ",
        Formula::vector("0"),
        " and its tip, one unit ahead, is ",
        Formula::vector("f"),
        "; ",
        Formula::italic("M"),
        " and ",
        Formula::vector("t"),
        " take both to the joint, and the joint’s added rotation turns them:",
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
        "The aim is the cosine of the angle between where the effector points and where the target is: the dot product of two \
         vectors of length 1. It is 1 with the target straight ahead and −1 with the target straight behind. Where the target \
         is on the effector there is no direction to it; the fraction, and with it the aim, counts as 0 there.",
    ]));
    Section { id: "aim", title: "The effector and its aim".into(), blocks }
}

/// Returns the statement of one of the chain's objectives.
pub(super) fn of_chain(kernel: &Kernel<'_>) -> Vec<Block> {
    let words = if *kernel.emitted.objective == CHAIN_RESIDUAL_JACOBIAN {
        text![
            "The residual says by how much the effector misses the target, to the left and up. It is the stereographic picture of \
             the target’s direction, as a map of the globe from its antipode: its length is 2 tan(½ angle), 0 on target and \
             growing all the way to behind, where it is not defined and counts as 0. With the way from the effector to the \
             target, its length and its parts forward, left and up, it is stated as",
        ]
    } else {
        text!["The aim is stated as for one joint, through all joints at once:"]
    };
    let Kernel { derivation, notation, .. } = kernel;
    vec![Block::Paragraph(words), defined(&derivation.graph, &derivation.stated, kernel.values(), notation)]
}

/// Returns the equations that define these expressions under their names, after those of their common subexpressions.
pub(super) fn defined(g: &Graph, scalars: &[Scalar], names: &[Formula], notation: &print::Notation) -> Block {
    let defined = print::defined(g, scalars, notation);
    let mut equations: Vec<Equation> = defined.equations(g).into_iter().map(Equation::from).collect();
    for (&scalar, name) in scalars.iter().zip(names) {
        equations.push((name.clone(), print::scalar(g, scalar, &defined.notation)).into());
    }
    Block::Equations(equations)
}
