//! The emitted code, each line beside its formula and what that is.

use aim_codegen::Objective;
use aim_symbolic::print::{self, Formula, Sign};
use aim_symbolic::{Aspect, Meaning, Node};

use super::document::{Block, Inline, Kind, Section, Table, Text, code, text};
use super::kernel::Kernel;

pub(super) fn section(kernel: &Kernel<'_>, rust: &str) -> Section {
    let mut blocks = vec![Block::Paragraph(text![
        "In components the formulas become additions, multiplications, a root and a division, in an order in which each line \
         needs earlier lines only; equal parts are computed once. What is needed once stands where it is needed. The lines are \
         those that ",
        code("aim generate --lang rust"),
        " writes for ",
        kernel.names(),
        "; those in C and WGSL do the same in the same order.",
    ])];
    blocks.extend(self::blocks(kernel, rust));
    Section { id: "code", title: "The code of one joint".into(), blocks }
}

/// What the function is given, and its lines.
pub(super) fn blocks(kernel: &Kernel<'_>, rust: &str) -> Vec<Block> {
    vec![Block::Table(inputs(kernel)), Block::Table(lines(kernel, rust))]
}

fn inputs(kernel: &Kernel<'_>) -> Table {
    let input = |stem: &str| kernel.notation.input(stem);
    let turns = |pitch: &str, heading: &str| {
        let [s, c] =
            ["s", "c"].map(|function| [pitch, heading].map(|angle| Formula::italic(function).indexed(input(angle))));
        let [[s_p, s_h], [c_p, c_h]] = [s, c];
        text![Formula::list([s_p, c_p, s_h, c_h])]
    };
    let target = vec![text![code("target")], text![Formula::vector("P")], text!["the target, in the joint’s space"]];
    let rows = match kernel.objective {
        Objective::Joint(_) => vec![
            vec![
                text![code("effector_to_joint[0..9]")],
                text![input("m")],
                text!["from effector space to the joint’s: the images of the three axes, one after the other"],
            ],
            vec![text![code("effector_to_joint[9..12]")], text![input("m_t")], text!["the effector’s origin there"]],
            target,
            vec![text![code("sin_cos")], turns("p", "h"), text!["of the joint’s pitch and heading"]],
        ],
        Objective::ChainAim | Objective::ChainResidual => {
            let [l, t] =
                ["L", "t"].map(|letter| if letter == "t" { Formula::vector("t") } else { Formula::italic(letter) });
            let i = Formula::italic("i");
            let angle = |letter: &str, function: &str| {
                Formula::italic(function).indexed(Formula::italic(letter).indexed(i.clone()))
            };
            vec![
                vec![
                    text![code("links[i][0..9]")],
                    text![l.indexed(i.clone())],
                    text!["link i: the images of the three axes, one after the other"],
                ],
                vec![
                    text![code("links[i][9..12]")],
                    text![t.indexed(i.clone())],
                    text!["link i: the image of the origin"],
                ],
                vec![
                    text![code("target")],
                    text![Formula::vector("P")],
                    text!["the target, in the last joint’s space"],
                ],
                vec![
                    text![code("sin_cos[i]")],
                    text![Formula::list([angle("p", "s"), angle("p", "c"), angle("h", "s"), angle("h", "c")])],
                    text!["of joint i’s pitch and heading"],
                ],
            ]
        }
    };
    Table {
        kind: Kind::Code,
        caption: "What the function is given".into(),
        head: ["input", "symbol", "what it is"].map(|name| text![name]).to_vec(),
        rows,
    }
}

fn lines(kernel: &Kernel<'_>, rust: &str) -> Table {
    let derivation = &kernel.derivation;
    let defined = print::defined(&derivation.graph, &derivation.outputs, &kernel.named);
    let told = print::told(&derivation.program, &kernel.notation);
    let function = Function::find(rust, &name(kernel.objective));
    let mut rows = Vec::new();
    for ((number, symbol, right), meaning) in told.steps.iter().zip(derivation.meanings()) {
        let meaning = meaning.and_then(|meaning| self::meaning(kernel, &defined.notation, meaning));
        rows.push(vec![
            text![code(function.step(*number))],
            text![Formula::equals(symbol.clone(), right.clone())],
            meaning.map_or_else(Text::new, |meaning| text![meaning]),
        ]);
    }
    for (place, (result, name)) in told.outputs.iter().zip(&kernel.outputs).enumerate() {
        let first = if place == 0 { text![code(function.result.clone())] } else { Text::new() };
        rows.push(vec![first, text![result.clone()], text![Inline::Math(name.clone())]]);
    }
    Table {
        kind: Kind::Code,
        caption: format!("{}: {}", name(kernel.objective), derivation.program.count()),
        head: ["line", "formula", "what it is"].map(|name| text![name]).to_vec(),
        rows,
    }
}

/// The longest formula that tells a line's meaning better than nothing.
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

/// The emitted function's name.
fn name(objective: Objective) -> String {
    match objective {
        Objective::Joint(joint) => format!("aim_gradient_{joint}"),
        Objective::ChainAim => "value_gradient".into(),
        Objective::ChainResidual => "residual_jacobian".into(),
    }
}

/// The lines of one emitted function.
struct Function {
    /// Each step's number and line.
    steps: Vec<(usize, String)>,
    /// What it returns.
    result: String,
}

impl Function {
    fn find(rust: &str, name: &str) -> Self {
        let start = rust.find(&format!("fn {name}<")).unwrap_or(rust.len());
        let mut function = Self { steps: Vec::new(), result: String::new() };
        let mut open: Option<(usize, String)> = None;
        for line in rust[start..].lines().map(str::trim) {
            if let Some((number, text)) = &mut open {
                *text += " ";
                *text += line;
                if line.ends_with(';') {
                    let number = *number;
                    function.steps.extend(open.take().map(|(_, text)| (number, text)));
                }
            } else if let Some(number) = step_number(line) {
                if line.ends_with(';') {
                    function.steps.push((number, line.to_owned()));
                } else {
                    open = Some((number, line.to_owned()));
                }
            } else if line == "}" {
                break;
            } else if !function.steps.is_empty() || line.starts_with('[') {
                // After the steps come the results.
                function.result += line;
            }
        }
        function
    }

    fn step(&self, number: usize) -> &str {
        self.steps.iter().find(|(known, _)| *known == number).map_or("", |(_, line)| line)
    }
}

/// The number of the step that this line defines.
fn step_number(line: &str) -> Option<usize> {
    line.strip_prefix("let __v")?.split_once(' ')?.0.parse().ok()
}
