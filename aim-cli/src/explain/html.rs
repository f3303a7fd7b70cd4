//! The document as a self-contained HTML page without network access or scripts, for light and dark screens and for
//! paper.

use aim_symbolic::print::{Formula, Sign, mathml};
use maud::{Markup, PreEscaped, html};

use super::document::{Arrow, Block, Drawing, Equation, Explanation, Ink, Inline, Kind, Rewriting, Section, Table};
use crate::words::n;

/// Returns the HTML page.
pub(crate) fn page(document: &Explanation) -> String {
    let content = html! {
        h1 { (document.title) }
        div.lead { (blocks(&document.lead)) }
        nav aria-label="Contents" {
            ol { @for section in &document.sections { li { a href={ "#" (section.id) } { (section.title) } } } }
        }
        @for (number, one) in document.sections.iter().enumerate() { (section(number + 1, one)) }
    };
    crate::page::page(&document.title, include_str!("style.css"), &content)
}

fn section(number: usize, section: &Section) -> Markup {
    html! {
        section id=(section.id) {
            h2 { span.number { (number) } " " (section.title) }
            (blocks(&section.blocks))
        }
    }
}

fn blocks(all: &[Block]) -> Markup {
    html! { @for block in all { (self::block(block)) } }
}

fn block(block: &Block) -> Markup {
    match block {
        Block::Paragraph(text) => html! { p { (line(text)) } },
        Block::Heading(text) => html! { h3 { (line(text)) } },
        Block::Equations(lines) => equations(lines),
        Block::Rewritings(all) => {
            scrolling("formula", "Rewritings", &html! { ul.rewritings { @for one in all { li { (rewriting(one)) } } } })
        }
        Block::Table(table) => self::table(table),
        Block::Drawings(all) => html! { div.drawings { @for one in all { (drawing(one)) } } },
        Block::Fold(summary, inner) => html! { details { summary { (line(summary)) } (blocks(inner)) } },
    }
}

fn line(text: &[Inline]) -> Markup {
    html! { @for part in text { (inline(part)) } }
}

fn inline(part: &Inline) -> Markup {
    match part {
        Inline::Text(text) => html! { (text) },
        Inline::Strong(text) => html! { strong { (text) } },
        Inline::Emphasis(text) => html! { cite { (text) } },
        Inline::Code(text) => html! { code { (text) } },
        Inline::Math(formula) => math(formula),
    }
}

fn math(formula: &Formula) -> Markup {
    html! { math { (PreEscaped(mathml(formula))) } }
}

/// Returns a container that scrolls on its own, also by keyboard, if its content is wider than the page.
fn scrolling(class: &str, told: &str, content: &Markup) -> Markup {
    html! { div class=(class) tabindex="0" role="group" aria-label=(told) { (content) } }
}

fn equations(lines: &[Equation]) -> Markup {
    let rows: String = lines.iter().map(equation).collect();
    let content =
        html! { math display="block" { (PreEscaped(format!("<mtable class=\"equations\">{rows}</mtable>"))) } };
    scrolling("formula", "Formula", &content)
}

fn equation(Equation { left, right, paper }: &Equation) -> String {
    let right = Formula::Row(vec![Formula::Sign(Sign::Equals), right.clone()]);
    let number = paper.map_or_else(String::new, |number| format!("<mtd><mtext>paper ({number})</mtext></mtd>"));
    format!("<mtr><mtd>{}</mtd><mtd>{}</mtd>{number}</mtr>", mathml(left), mathml(&right))
}

fn rewriting(one: &Rewriting) -> Markup {
    let both = Formula::infix(one.from.clone(), Sign::Becomes, one.to.clone());
    html! {
        (math(&both))
        @if one.times > 1 { span.times { (one.times) " times" } }
        @if !one.letters.is_empty() {
            span.letters {
                "with "
                @for (place, (letter, meaning)) in one.letters.iter().enumerate() {
                    @if place > 0 { ", " }
                    (math(&Formula::equals(letter.clone(), meaning.clone())))
                }
            }
        }
    }
}

fn table(table: &Table) -> Markup {
    let class = match table.kind {
        Kind::Facts => "facts",
        Kind::Numbers => "numbers",
        Kind::Code => "code",
    };
    let content = html! {
        table class=(class) {
            caption { (table.caption) }
            thead { tr { @for head in &table.head { th scope="col" { (line(head)) } } } }
            tbody {
                @for row in &table.rows {
                    tr {
                        @for (place, cell) in row.iter().enumerate() {
                            @if place == 0 && table.kind != Kind::Code {
                                th scope="row" { (line(cell)) }
                            } @else {
                                td { (line(cell)) }
                            }
                        }
                    }
                }
            }
        }
    };
    scrolling("scroll", &table.caption, &content)
}

fn drawing(drawing: &Drawing) -> Markup {
    let [width, height] = drawing.size;
    html! {
        figure {
            svg viewBox={ "0 0 " (width) " " (height) } role="img" aria-label=(drawing.told) {
                @for arrow in &drawing.arrows { (self::arrow(arrow)) }
                @for label in &drawing.labels {
                    text class=(ink(label.ink)) x=(n(label.at[0])) y=(n(label.at[1])) { (label.text) }
                }
            }
            figcaption { (line(&drawing.caption)) }
        }
    }
}

fn arrow(Arrow { points, ink }: &Arrow) -> Markup {
    let [.., before, tip] = points.as_slice() else { return html! {} };
    let (dx, dy) = (tip[0] - before[0], tip[1] - before[1]);
    let length = dx.hypot(dy).max(1e-9);
    let (dx, dy) = (dx / length, dy / length);
    let (long, wide) = (11.0, 4.5);
    let base = [tip[0] - long * dx, tip[1] - long * dy];
    let head = [*tip, [base[0] - wide * dy, base[1] + wide * dx], [base[0] + wide * dy, base[1] - wide * dx]];
    html! {
        g class=(self::ink(*ink)) {
            polyline points=(list(&[&points[..points.len() - 1], &[base]].concat())) {}
            polygon points=(list(&head)) {}
        }
    }
}

fn list(points: &[[f64; 2]]) -> String {
    points.iter().map(|[x, y]| format!("{},{}", n(*x), n(*y))).collect::<Vec<_>>().join(" ")
}

fn ink(ink: Ink) -> &'static str {
    match ink {
        Ink::Axis(0) => "x",
        Ink::Axis(1) => "y",
        Ink::Axis(_) => "z",
        Ink::Direction => "direction",
        Ink::Heading => "heading",
        Ink::Pitch => "pitch",
    }
}
