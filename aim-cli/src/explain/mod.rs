//! `aim explain`: the derivation of a rig's code as a document.
//!
//! All formulas, counts and code in the document come from the expression graph, the recorded derivation and the
//! emitted text; only the sentences between them are written here. The same rig gives the same bytes.

mod check;
mod conventions;
mod document;
mod drawing;
mod gradient;
mod html;
mod kernel;
mod latex;
mod listing;
mod rewriting;
mod statement;

use aim_codegen::emit::Rig;
use aim_codegen::objective::{self, Scope, notation};
use aim_symbolic::print::{self, Formula};

use crate::words::counted;

pub(crate) use check::Explained;
pub(crate) use document::Explanation;
pub(crate) use html::page as html;
pub(crate) use latex::text as latex;

use document::{Block, Equation, Inline, Section, code, text};
use kernel::{Kernel, joint_names};

/// Returns the document about a rig.
pub(crate) fn document(subject: &Explained<'_>) -> Explanation {
    let spec = subject.spec;
    let kernels = subject.kernels.iter().map(|kernel| Kernel::new(spec, kernel));
    let (joints, chain): (Vec<_>, Vec<_>) = kernels.partition(|kernel| kernel.is_small());
    let first = &joints[0];
    let mut sections = vec![
        conventions::section(spec),
        conventions::notation(spec),
        conventions::chain(spec, &chain[0]),
        statement::section(first),
        rewriting::section(first),
        gradient::section(first),
        listing::section(first),
    ];
    if joints.len() > 1 {
        sections.push(other_joints(&joints));
    }
    sections.push(whole_chain(&chain));
    sections.push(check::section(subject));
    sections.push(check::counts(subject));
    Explanation {
        title: format!("How {} aims: its derivation, step by step", spec.name),
        lead: lead(subject, first),
        sections,
    }
}

/// Returns a document of formulas only: each objective as stated and as rewritten, then the steps of its program.
pub(crate) fn formulas(rig: &Rig<'_>) -> Explanation {
    let section = |kernel: &objective::Kernel| {
        let notation = notation(rig.spec, kernel.objective.scope);
        let symbols = (kernel.objective.symbols)();
        let mut statement = kernel.statement(rig.spec);
        let stated = statement::defined(&statement.graph, &statement.values, &symbols, &notation);
        let rewritten: Vec<_> = statement.values.iter().map(|&value| statement.graph.rewrite(value)).collect();
        let rewritten = statement::defined(&statement.graph, &rewritten, &symbols, &notation);
        let told = print::program_formulas(&kernel.program, &notation);
        let steps = told.steps.into_iter().map(|(_, symbol, right)| Equation::from((symbol, right)));
        let outputs = told.outputs.into_iter().enumerate();
        let outputs = outputs.map(|(i, output)| Equation::from((Formula::italic("r").numbered(i), output)));
        let is_joint = kernel.objective.scope == Scope::Joint;
        let subject = if is_joint { joint_names(rig.spec, &kernel.joints) } else { "chain".to_owned() };
        Section {
            id: kernel.objective.name,
            title: format!("{subject}: {}", kernel.objective.title),
            blocks: vec![
                Block::Paragraph(text![format!("{}.", kernel.program.count())]),
                Block::Paragraph(text!["As stated:"]),
                stated,
                Block::Paragraph(text!["With every rotation moved to where it cancels or costs least:"]),
                rewritten,
                Block::Paragraph(text!["Step by step:"]),
                Block::Equations(steps.chain(outputs).collect()),
            ],
        }
    };
    Explanation { title: rig.spec.name.clone(), lead: Vec::new(), sections: rig.kernels.iter().map(section).collect() }
}

fn lead(subject: &Explained<'_>, first: &Kernel<'_>) -> Vec<Block> {
    let spec = subject.spec;
    let before = first.derivation.steps.first().map_or(0, |step| step.before.total());
    vec![
        Block::Paragraph(text![
            "This document derives the code that turns ",
            Inline::Strong(spec.name.clone()),
            " towards a target, from the axes of its bones to every line that ",
            code("aim generate"),
            " writes for it. All formulas, counts and lines of code are taken from the recorded derivation; none was typed \
             by hand. To follow every step, you need to know that the derivative of the sine is the cosine, and the product \
             and chain rules.",
        ]),
        Block::Paragraph(text![
            "The objective is that of S. M. Johnson, ",
            Inline::Emphasis("A Method for Head and Eye Aiming using Steepest Descent".into()),
            "; “paper (4)” is equation 4 there. As it stands, the aim of one joint with both its derivatives takes ",
            Inline::Strong(counted(before, "operation")),
            "; the emitted code takes ",
            Inline::Strong(first.derivation.program.count().total().to_string()),
            ". The sections below explain the steps in between.",
        ]),
    ]
}

/// Returns the section on the joints whose axes or angles differ from those of the first.
fn other_joints(kernels: &[Kernel<'_>]) -> Section {
    let mut blocks = vec![Block::Paragraph(text![
        "The same derivation for the joints whose axes or angles differ from those of ",
        kernels[0].names(),
        ".",
    ])];
    blocks.extend(kernels[1..].iter().map(|kernel| whole(kernel, kernel.names())));
    Section { id: "other-joints", title: "The other joints".into(), blocks }
}

fn whole_chain(chain: &[Kernel<'_>]) -> Section {
    let mut blocks = vec![Block::Paragraph(text![
        "Solvers that move all joints at once need the whole chain: its aim, and its residual, which gives not only how far \
         off the effector is but also in which direction. The same rules turn their statements into code.",
    ])];
    for kernel in chain {
        let title = format!("The chain’s {}", kernel.emitted.objective.title);
        blocks.push(Block::Heading(text![title.clone()]));
        blocks.extend(statement::of_chain(kernel));
        blocks.push(whole(kernel, Inline::from(format!("{title}, derived"))));
    }
    Section { id: "whole-chain", title: "The whole chain".into(), blocks }
}

/// Returns a kernel's derivation from rewriting to code, folded away until it is opened.
fn whole(kernel: &Kernel<'_>, name: Inline) -> Block {
    let steps = &kernel.derivation.steps;
    let before = steps.first().map_or(0, |step| step.before.total());
    let summary =
        text![name, format!(": from {before} to {}", counted(kernel.derivation.program.count().total(), "operation"))];
    let mut blocks = rewriting::blocks(kernel);
    blocks.push(Block::Heading(text!["The derivatives"]));
    blocks.extend(gradient::blocks(kernel));
    blocks.push(Block::Heading(text!["The code"]));
    blocks.extend(listing::blocks(kernel));
    Block::Fold(summary, blocks)
}
