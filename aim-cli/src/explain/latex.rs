//! The document as LaTeX source, which needs amsmath, longtable and `TikZ`.

use std::collections::HashMap;
use std::fmt::Write;

use aim_symbolic::print::{Formula, Sign, latex};

use super::document::{Block, Drawing, Equation, Explanation, Ink, Inline, Kind, Rewriting, Table};

const PREAMBLE: &str = include_str!("preamble.tex");

/// Returns the LaTeX source.
pub(crate) fn text(document: &Explanation) -> String {
    let mut out = format!("% Written by aim {}. Do not edit: write it again.\n", env!("CARGO_PKG_VERSION"));
    out += PREAMBLE;
    let _ = write!(out, "\\title{{{}}}\n\\date{{}}\n\\maketitle\n", plain(&document.title));
    blocks(&mut out, &document.lead);
    out += "\\tableofcontents\n";
    for section in &document.sections {
        let _ = writeln!(out, "\n\\section{{{}}}\\label{{{}}}", plain(&section.title), section.id);
        blocks(&mut out, &section.blocks);
    }
    out + "\\end{document}\n"
}

fn blocks(out: &mut String, all: &[Block]) {
    for block in all {
        out.push('\n');
        self::block(out, block);
    }
}

fn block(out: &mut String, block: &Block) {
    let _ = match block {
        Block::Paragraph(text) => writeln!(out, "{}", line(text)),
        Block::Heading(text) => writeln!(out, "\\subsection*{{{}}}", line(text)),
        Block::Equations(lines) => {
            let lines: Vec<String> = lines.iter().map(equation).collect();
            writeln!(out, "\\begin{{align*}}\n{}\n\\end{{align*}}", lines.join(" \\\\\n"))
        }
        Block::Rewritings(all) => {
            let lines: Vec<String> = all.iter().map(rewriting).collect();
            writeln!(out, "\\begin{{gather*}}\n{}\n\\end{{gather*}}", lines.join(" \\\\\n"))
        }
        Block::Table(table) => {
            self::table(out, table);
            Ok(())
        }
        Block::Drawings(all) => {
            all.iter().for_each(|one| drawing(out, one));
            Ok(())
        }
        Block::Fold(summary, inner) => {
            let _ = writeln!(out, "\\subsubsection*{{{}}}", line(summary));
            blocks(out, inner);
            Ok(())
        }
    };
}

fn line(text: &[Inline]) -> String {
    text.iter().map(inline).collect()
}

fn inline(part: &Inline) -> String {
    match part {
        Inline::Text(text) => plain(text),
        Inline::Strong(text) => format!("\\textbf{{{}}}", plain(text)),
        Inline::Emphasis(text) => format!("\\emph{{{}}}", plain(text)),
        Inline::Code(text) => format!("\\texttt{{{}}}", plain(text)),
        Inline::Math(formula) => format!("${}$", latex(formula)),
    }
}

fn equation(Equation { left, right, paper }: &Equation) -> String {
    let number = paper.map_or_else(String::new, |number| format!(" && \\text{{paper ({number})}}"));
    format!("{} &= {}{number}", latex(left), latex(right))
}

fn rewriting(one: &Rewriting) -> String {
    let mut text = latex(&Formula::infix(one.from.clone(), Sign::Becomes, one.to.clone()));
    if one.times > 1 {
        let _ = write!(text, " \\qquad \\text{{({} times)}}", one.times);
    }
    if !one.letters.is_empty() {
        let equal = |(letter, meaning): &(Formula, Formula)| format!("{} = {}", latex(letter), latex(meaning));
        let letters: Vec<String> = one.letters.iter().map(equal).collect();
        let _ = write!(text, r" \qquad \text{{with }} {}", letters.join(r",\ "));
    }
    text
}

fn table(out: &mut String, table: &Table) {
    let columns = table.head.len();
    let layout = match table.kind {
        Kind::Numbers => "l".to_owned() + &"r".repeat(columns.saturating_sub(1)),
        Kind::Facts | Kind::Code => widths(table)
            .iter()
            .map(|width| format!(">{{\\raggedright\\arraybackslash}}p{{{width:.3}\\linewidth}}"))
            .collect(),
    };
    let row = |cells: &[Vec<Inline>]| cells.iter().map(|cell| line(cell)).collect::<Vec<_>>().join(" & ");
    let size = if table.kind == Kind::Code { "\\scriptsize" } else { "\\small" };
    let _ = writeln!(out, "{{{size}\n\\begin{{longtable}}{{{layout}}}");
    let _ = writeln!(out, "\\multicolumn{{{columns}}}{{l}}{{{}}} \\\\\n\\hline", plain(&table.caption));
    let _ = writeln!(out, "{} \\\\\n\\hline\n\\endhead", row(&table.head));
    for cells in &table.rows {
        let _ = writeln!(out, "{} \\\\", row(cells));
    }
    *out += "\\hline\n\\end{longtable}}\n";
}

/// Returns the widths of the columns as shares of the line width, in proportion to their longest cells.
fn widths(table: &Table) -> Vec<f64> {
    /// Space between two columns, as a share of the line width.
    const GAP: f64 = 0.026;
    let length = |cell: &Vec<Inline>| -> u32 {
        let length = |part: &Inline| match part {
            Inline::Text(text) | Inline::Strong(text) | Inline::Emphasis(text) | Inline::Code(text) => {
                text.chars().count()
            }
            Inline::Math(formula) => formula.length(),
        };
        u32::try_from(cell.iter().map(length).sum::<usize>().clamp(6, 44)).unwrap_or(44)
    };
    let longest = |column: usize| {
        let cells = table.rows.iter().chain([&table.head]).filter_map(|row| row.get(column));
        f64::from(cells.map(length).max().unwrap_or(6))
    };
    let longest: Vec<f64> = (0..table.head.len()).map(longest).collect();
    let all: f64 = longest.iter().sum();
    longest.iter().map(|one| one / all - GAP).map(|width| width.max(0.02)).collect()
}

fn drawing(out: &mut String, drawing: &Drawing) {
    // Centimetres per unit of the drawing.
    const UNIT: f64 = 0.022;
    let at = |[x, y]: [f64; 2]| format!("({:.2},{:.2})", UNIT * x, UNIT * (drawing.size[1] - y));
    *out += "\\begin{tikzpicture}[>=stealth]\n";
    for arrow in &drawing.arrows {
        let points: Vec<String> = arrow.points.iter().map(|&point| at(point)).collect();
        let _ = writeln!(out, "\\draw[->,{}] {};", ink(arrow.ink), points.join(" -- "));
    }
    for label in &drawing.labels {
        let _ = writeln!(out, "\\node[{}] at {} {{{}}};", ink(label.ink), at(label.at), plain(&label.text));
    }
    let _ = writeln!(out, "\\end{{tikzpicture}}\n\n{}\n", line(&drawing.caption));
}

fn ink(ink: Ink) -> &'static str {
    match ink {
        Ink::Axis(0) => "thick,red!75!black",
        Ink::Axis(1) => "thick,green!50!black",
        Ink::Axis(_) => "thick,blue!75!black",
        Ink::Direction => "dotted,gray",
        Ink::Heading => "violet",
        Ink::Pitch => "orange!70!black",
    }
}

/// Characters that are special in LaTeX or missing in its fonts, one per line with the text that prints it.
const LETTERS: &str = include_str!("letters.txt");

/// Escapes text for LaTeX.
fn plain(text: &str) -> String {
    let known: HashMap<&str, &str> = LETTERS.lines().filter_map(|line| line.split_once(' ')).collect();
    let mut buffer = [0; 4];
    let mut out = String::new();
    for letter in text.chars() {
        match letter {
            '\u{a0}' | '\u{202f}' => out.push('~'),
            letter => {
                let letter = letter.encode_utf8(&mut buffer);
                out += known.get(&*letter).copied().unwrap_or(letter);
            }
        }
    }
    out
}
