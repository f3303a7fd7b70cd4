//! `MathML` output, restricted to the subset that browsers have in common.

use super::formula::{Formula, Sign, Typeface};

/// Returns the formula as the content of a `math` element.
#[must_use]
pub fn formula(formula: &Formula) -> String {
    let mut out = String::new();
    write(&mut out, formula);
    out
}

fn write(out: &mut String, formula: &Formula) {
    match formula {
        Formula::Symbol(name, face) => symbol(out, name, *face),
        Formula::Number(digits) => element(out, "mn", digits),
        Formula::Sign(sign) => *out += self::sign(*sign),
        Formula::Row(parts) => {
            *out += "<mrow>";
            parts.iter().for_each(|part| write(out, part));
            *out += "</mrow>";
        }
        Formula::Index(stem, index) => of_parts(out, "msub", &[stem, index]),
        Formula::Squared(stem) => marked(out, stem, "<mn>²</mn>"),
        Formula::Inverse(stem) => marked(out, stem, "<mn>⁻¹</mn>"),
        Formula::Transposed(stem) => marked(out, stem, "<mi mathvariant=\"normal\">ᵀ</mi>"),
        Formula::Fraction(above, below) => of_parts(out, "mfrac", &[above, below]),
        Formula::Root(inner) => of_parts(out, "msqrt", &[inner]),
        Formula::Group(inner) => fenced(out, "(", inner, ")"),
        Formula::Bars(inner) => fenced(out, "|", inner, "|"),
        Formula::Over(stem) => {
            *out += "<mover accent=\"true\">";
            write(out, stem);
            *out += "<mo stretchy=\"false\">¯</mo></mover>";
        }
        Formula::Matrix(rows) => {
            *out += "<mtable class=\"matrix\">";
            for row in rows {
                *out += "<mtr>";
                row.iter().for_each(|entry| of_parts(out, "mtd", &[entry]));
                *out += "</mtr>";
            }
            *out += "</mtable>";
        }
        Formula::Cases(branches, condition) => {
            let [then, otherwise] = branches.as_ref();
            *out += "<mrow><mo stretchy=\"true\">{</mo><mtable class=\"cases\"><mtr>";
            of_parts(out, "mtd", &[then]);
            *out += "<mtd><mtext>where </mtext>";
            write(out, condition);
            *out += "</mtd></mtr><mtr>";
            of_parts(out, "mtd", &[otherwise]);
            *out += "<mtd><mtext>else</mtext></mtd></mtr></mtable></mrow>";
        }
    }
}

fn symbol(out: &mut String, name: &str, face: Typeface) {
    let is_letter = name.chars().count() == 1;
    match face {
        // Words longer than a letter are upright by default.
        Typeface::Italic => element(out, "mi", name),
        Typeface::Upright if !is_letter => element(out, "mi", name),
        Typeface::Upright => *out += &format!("<mi mathvariant=\"normal\">{}</mi>", escaped(name)),
        Typeface::Bold => *out += &format!("<mi mathvariant=\"normal\" class=\"vector\">{}</mi>", escaped(name)),
    }
}

fn element(out: &mut String, tag: &str, text: &str) {
    *out += &format!("<{tag}>{}</{tag}>", escaped(text));
}

fn of_parts(out: &mut String, tag: &str, parts: &[&Formula]) {
    *out += &format!("<{tag}>");
    parts.iter().for_each(|part| write(out, part));
    *out += &format!("</{tag}>");
}

/// Appends a mark that is itself a raised character: fonts without mathematical tables set exponents far too high.
fn marked(out: &mut String, stem: &Formula, mark: &str) {
    *out += "<mrow>";
    write(out, stem);
    *out += mark;
    *out += "</mrow>";
}

fn fenced(out: &mut String, open: &str, inner: &Formula, close: &str) {
    let stretchy = if inner.is_high() { "" } else { " stretchy=\"false\"" };
    *out += &format!("<mrow><mo fence=\"true\" form=\"prefix\"{stretchy}>{open}</mo>");
    write(out, inner);
    *out += &format!("<mo fence=\"true\" form=\"postfix\"{stretchy}>{close}</mo></mrow>");
}

fn sign(sign: Sign) -> &'static str {
    match sign {
        Sign::Plus => "<mo>+</mo>",
        Sign::Minus => "<mo>−</mo>",
        Sign::Negative => "<mo form=\"prefix\">−</mo>",
        Sign::Dot | Sign::Point => "<mo>⋅</mo>",
        Sign::Cross => "<mo>×</mo>",
        Sign::Times => "<mo lspace=\".12em\" rspace=\".12em\">\u{2062}</mo>",
        Sign::Equals => "<mo>=</mo>",
        Sign::Less => "<mo>&lt;</mo>",
        Sign::Across => "<mo form=\"prefix\" lspace=\"0\" rspace=\".1em\">⊥</mo>",
        Sign::Partial => "<mi>∂</mi>",
        Sign::Becomes => "<mo>⟶</mo>",
        Sign::Comma => "<mo separator=\"true\">,</mo>",
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
