//! The section on rewriting: for each step that lowers the operation count, the rules, their reasons, the formulas that
//! changed, and the result.

use std::ops::Range;

use aim_codegen::objective::{Inputs, Scope, notation};
use aim_symbolic::print::{self, Formula, Notation, rewriting};
use aim_symbolic::rules::Rule;
use aim_symbolic::{Derivation, Graph, Rewrite, Singular, Step};

use super::document::{Block, Inline, Kind, Rewriting, Section, Table, Text, text};
use super::kernel::Kernel;
use super::statement::defined;
use crate::words::counted;

/// Returns the section on rewriting the first joint's aim.
pub(super) fn section(kernel: &Kernel<'_>) -> Section {
    let mut blocks = vec![Block::Paragraph(text![
        "The statement is correct, but expensive to compute as it stands, and so are its derivatives. Rules rewrite it: each \
         replaces one part of the expression by another that has the same value for all inputs. The number beside a step \
         counts the additions, multiplications, divisions and roots of the whole program, derivatives included, if rewriting \
         stopped there. Sines and cosines are inputs, and negations are free.",
    ])];
    blocks.extend(self::blocks(kernel));
    Section { id: "rewriting", title: "Rewriting the aim".into(), blocks }
}

/// Returns the blocks on rewriting before differentiation.
pub(super) fn blocks(kernel: &Kernel<'_>) -> Vec<Block> {
    let derivation = &kernel.derivation;
    let overview = Block::Table(overview(&derivation.steps));
    let summary = format!("All {} at a glance", counted(derivation.steps.len(), "step"));
    let mut blocks = vec![if kernel.is_small() { overview } else { Block::Fold(text![summary], vec![overview]) }];
    let mut told = Told::default();
    blocks.extend(arithmetic(kernel, &mut told));
    blocks.push(Block::Heading(text!["Moving rotations to where they cancel"]));
    blocks.extend(steps(kernel, 0..derivation.before_sweeps, &kernel.notation, &mut told));
    blocks.push(Block::Paragraph(text!["Derivatives are taken of the result:"]));
    blocks.push(defined(&derivation.graph, &derivation.values, kernel.values(), &kernel.notation));
    if !derivation.singular.is_empty() {
        blocks.push(Block::Table(singular(kernel)));
    }
    blocks
}

/// Returns the table of the points at which a derivative has no limit, with the value that is computed there.
fn singular(kernel: &Kernel<'_>) -> Table {
    let Derivation { graph, singular, .. } = &kernel.derivation;
    let row = |Singular { at, convention }: &Singular| {
        vec![text![print::condition(graph, *at, &kernel.notation)], text![*convention]]
    };
    let caption = "Where a derivative has no limit, and the value computed there";
    Table::new(Kind::Facts, caption, &["where", "by convention"], singular.iter().map(row).collect())
}

/// Returns the blocks on rewriting after differentiation; empty if nothing was rewritten.
pub(super) fn after_derivatives(kernel: &Kernel<'_>) -> Vec<Block> {
    let derivation = &kernel.derivation;
    let range = derivation.before_sweeps..derivation.rewrites.len();
    let mut blocks = steps(kernel, range, &kernel.named, &mut Told::default());
    if !blocks.is_empty() {
        let words = "The derivatives are expressions like any other, and the rules rewrite them as well:";
        blocks.insert(0, Block::Paragraph(text![words]));
    }
    blocks
}

/// Returns the table of operation counts, one row per step.
fn overview(steps: &[Step]) -> Table {
    let most = steps.first().map_or(0, |step| step.before.total());
    let share = |count: usize| {
        let permille = 1000 * count / most.max(1);
        format!("{}.{} %", permille / 10, permille % 10)
    };
    let row = |place: usize, rules: Text, count: usize| {
        vec![text![place.to_string()], rules, text![count.to_string()], text![share(count)]]
    };
    let mut rows = vec![row(0, text!["as stated"], most)];
    for (place, step) in steps.iter().enumerate() {
        let rules: Vec<String> =
            step.rules.iter().map(|&(rule, times)| rule.to_string() + &multiplied(times)).collect();
        rows.push(row(place + 1, text![rules.join(", ")], step.after.total()));
    }
    let head = ["step", "rules", "operations", "share of the statement’s"];
    Table::new(Kind::Facts, "Operation counts, and the rules that lowered them", &head, rows)
}

fn multiplied(times: usize) -> String {
    if times > 1 { format!(" (×{times})") } else { String::new() }
}

/// Rules whose reasons have already been given.
#[derive(Default)]
struct Told(Vec<Rule>);

impl Told {
    /// Returns a paragraph that names the rule, with its reason the first time.
    fn rule(&mut self, rule: Rule, times: usize) -> Block {
        let name = Inline::Strong(sentence(rule.name));
        if self.0.contains(&rule) {
            return Block::Paragraph(text![name, format!("{}.", multiplied(times))]);
        }
        self.0.push(rule);
        Block::Paragraph(text![name, format!("{}. {}", multiplied(times), rule.why)])
    }
}

/// Returns the text with an upper-case first letter.
fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// Returns the blocks on the rules of arithmetic, which are applied first.
fn arithmetic(kernel: &Kernel<'_>, told: &mut Told) -> Vec<Block> {
    let derivation = &kernel.derivation;
    let first: Vec<(usize, &Step)> =
        derivation.steps.iter().enumerate().filter(|(_, step)| step.rewrites == 0).collect();
    if first.is_empty() {
        return Vec::new();
    }
    let mut blocks = vec![
        Block::Heading(text!["Arithmetic"]),
        Block::Paragraph(text![
            "Vectors have three components and rotations nine, and many of those are 0 or ±1. The simplifications that any compiler \
             of formulas makes come first, so that the gain of the other rules is theirs alone.",
        ]),
    ];
    if kernel.is_small() {
        blocks.push(Block::Paragraph(text![
            "For example, the effector’s direction in the joint’s space, in components:"
        ]));
        blocks.push(example(kernel));
    }
    for (place, step) in first {
        blocks.push(heading(place, step));
        blocks.extend(step.rules.iter().map(|&(rule, times)| told.rule(rule, times)));
    }
    blocks
}

/// Returns the effector's direction in components, as an example: hardly any of the nine products is left.
fn example(kernel: &Kernel<'_>) -> Block {
    let mut g = Graph::new();
    let inputs = Inputs::of_joint(&mut g);
    let forward = g.constant_vector(kernel.spec.effector.frame.forward);
    let turned = g.rotate(inputs.links[0].rotation, forward);
    let notation = notation(kernel.spec, Scope::Joint);
    let left = print::vector(&g, turned, &notation);
    let components = g.in_components(turned).map(|c| vec![print::scalar(&g, c, &notation)]);
    Block::Equations(vec![(left, Formula::Matrix(components.to_vec())).into()])
}

fn heading(place: usize, step: &Step) -> Block {
    Block::Heading(text![format!(
        "Step {}: {} → {}",
        place + 1,
        step.before.total(),
        counted(step.after.total(), "operation")
    )])
}

/// Returns the blocks on the steps within this range of rewrites.
fn steps(kernel: &Kernel<'_>, range: Range<usize>, notation: &Notation, told: &mut Told) -> Vec<Block> {
    let derivation = &kernel.derivation;
    let mut blocks = Vec::new();
    let mut from = range.start;
    for (place, step) in derivation.steps.iter().enumerate() {
        if step.rewrites <= from || step.rewrites > range.end {
            continue;
        }
        blocks.push(heading(place, step));
        blocks.extend(applied(kernel, &derivation.rewrites[from..step.rewrites], notation, told));
        from = step.rewrites;
        if kernel.is_small() {
            let (g, outputs) = derivation.stopped_after(step.rewrites);
            let names = if step.rewrites <= derivation.before_sweeps { kernel.values() } else { &kernel.outputs };
            blocks.push(Block::Paragraph(text!["The result:"]));
            blocks.push(defined(&g, &outputs[..names.len()], names, notation));
        }
    }
    let rest = &derivation.rewrites[from..range.end];
    if !rest.is_empty() {
        let summary = format!("{} without effect on the count", counted(rest.len(), "further rewriting"));
        blocks.push(Block::Fold(text![summary], applied(kernel, rest, notation, told)));
    }
    blocks
}

/// Returns the applied rules, each with its reason and the formulas that it changed.
fn applied(kernel: &Kernel<'_>, rewrites: &[Rewrite], notation: &Notation, told: &mut Told) -> Vec<Block> {
    let mut rules: Vec<(Rule, usize, Vec<Rewriting>)> = Vec::new();
    let g = &kernel.derivation.graph;
    for rewrite in rewrites {
        let one = shown(g, rewrite, notation, kernel.is_small());
        match rules.iter_mut().find(|(rule, ..)| *rule == rewrite.rule) {
            Some((_, times, all)) => {
                *times += 1;
                match all.iter_mut().find(|known| known.is_like(&one)) {
                    Some(known) => known.times += 1,
                    None => all.push(one),
                }
            }
            None => rules.push((rewrite.rule, 1, vec![one])),
        }
    }
    let block = |(rule, times, all): (Rule, usize, Vec<Rewriting>)| [told.rule(rule, times), Block::Rewritings(all)];
    rules.into_iter().flat_map(block).collect()
}

/// Returns a rewrite with letters for the unchanged parts. The letters are defined only if `with_letters`.
fn shown(g: &Graph, rewrite: &Rewrite, notation: &Notation, with_letters: bool) -> Rewriting {
    let ([from, to], letters): ([Formula; 2], _) = rewriting(g, rewrite.from, rewrite.to, notation);
    Rewriting { from, to, times: 1, letters: if with_letters { letters } else { Vec::new() } }
}
