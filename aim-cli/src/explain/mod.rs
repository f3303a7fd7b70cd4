//! `aim explain`: the derivation of a rig's code as a document.
//!
//! What the document says of formulas, counts and code comes from the expression graph, the derivation's books and the
//! emitted text; only the words between them are written here. The same rig gives the same bytes.

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

use aim_codegen::{Objective, RigSpec, objectives};
use aim_symbolic::print::Formula;

use crate::commands::check::Verdict;
use crate::commands::count::Counts;

pub(crate) use document::Document;
pub(crate) use html::page as html;
pub(crate) use latex::text as latex;

use document::{Block, Inline, Section, code, text};
use kernel::Kernel;

/// What a document is about: everything is of the same rig.
pub(crate) struct Subject<'a> {
    pub(crate) spec: &'a RigSpec,
    /// The emitted Rust.
    pub(crate) rust: &'a str,
    pub(crate) counts: &'a Counts,
    /// What the derived programs' comparison with central differences found,
    pub(crate) verdicts: &'a [Verdict],
    /// in so many poses.
    pub(crate) samples: u32,
}

/// The document.
pub(crate) fn document(subject: &Subject<'_>) -> Document {
    let spec = subject.spec;
    let mut kernels: Vec<Kernel<'_>> =
        objectives(spec).into_iter().map(|(objective, joints)| Kernel::new(spec, objective, joints)).collect();
    let chain = kernels.split_off(kernels.len() - 2);
    let first = &kernels[0];
    let mut sections = vec![
        conventions::section(spec),
        conventions::notation(spec),
        conventions::chain(spec, &chain[0]),
        statement::section(first),
        rewriting::section(first),
        gradient::section(first),
        listing::section(first, subject.rust),
    ];
    if kernels.len() > 1 {
        sections.push(other_joints(&kernels, subject.rust));
    }
    sections.push(whole_chain(&chain, subject.rust));
    sections.push(check::section(subject));
    sections.push(check::counts(subject));
    Document {
        title: format!("How {} aims: its derivation, step by step", spec.name),
        lead: lead(subject, first),
        sections,
    }
}

fn lead(subject: &Subject<'_>, first: &Kernel<'_>) -> Vec<Block> {
    let spec = subject.spec;
    let before = first.derivation.steps.first().map_or(0, |step| step.before.total());
    vec![
        Block::Paragraph(text![
            "Where does the code come from that turns ",
            Inline::Strong(spec.name.clone()),
            " to a target? This document leads from the axes of its bones to every line that ",
            code("aim generate"),
            " writes for it. All formulas, counts and lines of code are taken from the derivation itself, which keeps its \
             books; none was typed. Who knows that the derivative of the sine is the cosine, and how to differentiate \
             products and functions of functions, can follow every step.",
        ]),
        Block::Paragraph(text![
            "The objective is that of S. M. Johnson, ",
            Inline::Emphasis("A Method for Head and Eye Aiming using Steepest Descent".into()),
            "; “paper (4)” is equation 4 there. As it stands, the aim of one joint with both its derivatives takes ",
            Inline::Strong(counted(before, "operation")),
            "; what is emitted takes ",
            Inline::Strong(first.derivation.program.count().total().to_string()),
            ". What lies between is told here.",
        ]),
    ]
}

/// The kernels of the joints that have other axes or angles than the first.
fn other_joints(kernels: &[Kernel<'_>], rust: &str) -> Section {
    let mut blocks = vec![Block::Paragraph(text![
        "The same was done for the joints whose axes or angles are others than those of ",
        kernels[0].names(),
        ".",
    ])];
    blocks.extend(kernels[1..].iter().map(|kernel| whole(kernel, kernel.names(), rust)));
    Section { id: "other-joints", title: "The other joints".into(), blocks }
}

fn whole_chain(chain: &[Kernel<'_>], rust: &str) -> Section {
    let mut blocks = vec![Block::Paragraph(text![
        "The solvers that move all joints at once need the chain as a whole: its aim, and its residual, which says not only \
         how far the effector is off but in which direction. The same rules lead from their statements to their code.",
    ])];
    for (kernel, title) in
        chain.iter().zip(["The chain’s aim and its derivatives", "The chain’s residual and its Jacobian"])
    {
        blocks.push(Block::Heading(text![title]));
        blocks.extend(statement::of_chain(kernel));
        blocks.push(whole(kernel, text_of(&format!("{title}, derived")), rust));
    }
    Section { id: "whole-chain", title: "The whole chain".into(), blocks }
}

fn text_of(text: &str) -> Inline {
    Inline::Text(text.to_owned())
}

/// A kernel's derivation from rewriting to code, to be opened by whoever wants to see it.
fn whole(kernel: &Kernel<'_>, name: Inline, rust: &str) -> Block {
    let steps = &kernel.derivation.steps;
    let before = steps.first().map_or(0, |step| step.before.total());
    let summary =
        text![name, format!(": from {before} to {}", counted(kernel.derivation.program.count().total(), "operation"))];
    let mut blocks = rewriting::blocks(kernel);
    blocks.push(Block::Heading(text!["The derivatives"]));
    blocks.extend(gradient::blocks(kernel));
    blocks.push(Block::Heading(text!["The code"]));
    blocks.extend(listing::blocks(kernel, rust));
    Block::Fold(summary, blocks)
}

/// `1 operation`, `2 operations`.
fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

/// The symbol of what an objective is called.
fn aim() -> Formula {
    Formula::upright("aim")
}

/// The residual's symbols: left, up.
fn residual() -> [Formula; 2] {
    ["left", "up"].map(|side| Formula::italic("s").indexed(Formula::upright(side)))
}

/// What the values of an objective are called.
fn values(objective: Objective) -> Vec<Formula> {
    match objective {
        Objective::Joint(_) | Objective::ChainAim => vec![aim()],
        Objective::ChainResidual => residual().to_vec(),
    }
}
