//! The section on the emitted code: each line with its formula and the meaning of that.

use aim_codegen::emit::rust_kernels;
use aim_codegen::format_rust;
use aim_codegen::objective::Scope;
use aim_symbolic::print::{self, Formula, Sign};
use aim_symbolic::{Aspect, Meaning, Node};
use quote::{ToTokens, quote};

use super::document::{Block, Inline, Kind, Section, Table, Text, code, text};
use super::kernel::Kernel;

pub(super) fn section(kernel: &Kernel<'_>) -> Section {
    let mut blocks = vec![Block::Paragraph(text![
        "In components, the formulas become additions, multiplications, a root and a division, ordered so that each line needs \
         only earlier lines; equal parts are computed once, and values used once are written inline. These are the lines \
         that ",
        code("aim generate --lang rust"),
        " writes for ",
        kernel.names(),
        "; the C and WGSL code does the same in the same order.",
    ])];
    blocks.extend(self::blocks(kernel));
    Section { id: "code", title: "The code of one joint".into(), blocks }
}

/// Returns the table of the function's inputs and the table of its lines.
pub(super) fn blocks(kernel: &Kernel<'_>) -> Vec<Block> {
    vec![Block::Table(inputs(kernel)), Block::Table(lines(kernel))]
}

fn inputs(kernel: &Kernel<'_>) -> Table {
    let row = |name: &str, symbol: Formula, meaning: &str| vec![text![code(name)], text![symbol], text![meaning]];
    let input = |stem: &str| kernel.notation.input(stem);
    let sin_cos = |pitch: &Formula, heading: &Formula| {
        let of = |function: &str, angle: &Formula| Formula::italic(function).indexed(angle.clone());
        Formula::list([of("s", pitch), of("c", pitch), of("s", heading), of("c", heading)])
    };
    let target = |meaning: &str| row("target", Formula::vector("P"), meaning);
    let rows = match kernel.emitted.objective.scope {
        Scope::Joint => vec![
            row(
                "effector_to_joint[0..9]",
                input("m"),
                "from effector space to the joint’s space: the images of the three axes in order",
            ),
            row("effector_to_joint[9..12]", input("m_t"), "the effector’s origin in that space"),
            target("the target, in the joint’s space"),
            row("sin_cos", sin_cos(&input("p"), &input("h")), "sines and cosines of the joint’s pitch and heading"),
        ],
        Scope::Chain => {
            let of_i = |symbol: Formula| symbol.indexed(Formula::italic("i"));
            let [pitch, heading] = ["p", "h"].map(|letter| of_i(Formula::italic(letter)));
            let images = "link i: the images of the three axes in order";
            vec![
                row("links[i][0..9]", of_i(Formula::italic("L")), images),
                row("links[i][9..12]", of_i(Formula::vector("t")), "link i: the image of the origin"),
                target("the target, in the last joint’s space"),
                row("sin_cos[i]", sin_cos(&pitch, &heading), "sines and cosines of joint i’s pitch and heading"),
            ]
        }
    };
    Table::new(Kind::Code, "Inputs of the function", &["input", "symbol", "meaning"], rows)
}

fn lines(kernel: &Kernel<'_>) -> Table {
    let derivation = &kernel.derivation;
    let defined = print::name_parts(&derivation.graph, &derivation.outputs, &kernel.named);
    let told = print::program_formulas(&derivation.program, &kernel.notation);
    let emitted = rust_kernels::lines(kernel.emitted, kernel.spec, &quote!(::aim));
    let mut rows = Vec::new();
    for ((number, symbol, right), meaning) in told.steps.iter().zip(derivation.meanings()) {
        let meaning = meaning.and_then(|meaning| self::meaning(kernel, &defined.notation, meaning));
        rows.push(vec![
            text![code(emitted.step(*number).map_or_else(String::new, formatted))],
            text![Formula::equals(symbol.clone(), right.clone())],
            meaning.map_or_else(Text::new, |meaning| text![meaning]),
        ]);
    }
    for (place, (result, name)) in told.outputs.iter().zip(&kernel.outputs).enumerate() {
        let first = if place == 0 { text![code(formatted(&emitted.results))] } else { Text::new() };
        rows.push(vec![first, text![result.clone()], text![Inline::Math(name.clone())]]);
    }
    let caption = format!("{}: {}", rust_kernels::function_name(kernel.emitted), derivation.program.count());
    Table::new(Kind::Code, caption, &["line", "formula", "meaning"], rows)
}

/// Maximum length of a formula that is shown as the meaning of a line.
const MOST: usize = 18;

fn meaning(kernel: &Kernel<'_>, notation: &print::Notation, meaning: Meaning) -> Option<Formula> {
    let derivation = &kernel.derivation;
    let output = match meaning.node {
        Node::Scalar(scalar) => derivation.outputs.iter().position(|&output| output == scalar),
        Node::Vector(_) => None,
    };
    let formula = match output {
        Some(place) => kernel.outputs[place].clone(),
        None => print::node(&derivation.graph, meaning.node, notation),
    };
    if formula.length() > MOST {
        return None;
    }
    let formula = match meaning.aspect {
        Aspect::Value => formula,
        Aspect::Square => Formula::Squared(Box::new(formula)),
        Aspect::Component(axis) => {
            let is_symbol = matches!(formula, Formula::Symbol(..) | Formula::Index(..));
            let whole = if is_symbol { formula } else { Formula::Group(Box::new(formula)) };
            whole.indexed(Formula::italic(["x", "y", "z"][usize::from(axis)]))
        }
    };
    Some(if meaning.negated {
        Formula::Row(vec![Formula::Sign(Sign::Negative), Formula::Group(Box::new(formula))])
    } else {
        formula
    })
}

/// Returns a line of the emitted code as it is in the file, without line breaks.
fn formatted(line: impl ToTokens) -> String {
    // Nested as deeply as a kernel is in the file, so that long lines break at the same places.
    let text = format_rust(quote!(const _: () = { fn kernel() { #line } };));
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    lines[2..lines.len() - 2].join(" ")
}
