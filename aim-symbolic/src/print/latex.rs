//! LaTeX output; needs the package amsmath.

use super::formula::{Formula, Sign, Typeface};

/// Returns the formula in LaTeX, for use in math mode.
#[must_use]
pub fn formula(formula: &Formula) -> String {
    let f = self::formula;
    match formula {
        Formula::Symbol(name, face) => symbol(name, *face),
        Formula::Number(digits) => digits.clone(),
        Formula::Sign(sign) => self::sign(*sign).to_owned(),
        Formula::Row(parts) => parts.iter().map(f).collect::<Vec<_>>().join(" "),
        Formula::Index(stem, index) => format!("{}_{{{}}}", base(stem), f(index)),
        Formula::Squared(stem) => format!("{}^2", base(stem)),
        Formula::Inverse(stem) => format!("{{{}}}^{{-1}}", f(stem)),
        Formula::Transposed(stem) => format!("{}^{{\\mathrm{{T}}}}", f(stem)),
        Formula::Fraction(above, below) => format!(r"\frac{{{}}}{{{}}}", f(above), f(below)),
        Formula::Root(inner) => format!(r"\sqrt{{{}}}", f(inner)),
        Formula::Group(inner) => format!(r"\left({}\right)", f(inner)),
        Formula::Bars(inner) => format!(r"\left|{}\right|", f(inner)),
        Formula::Over(stem) => format!(r"\bar{{{}}}", f(stem)),
        Formula::Matrix(rows) => {
            let row = |row: &Vec<Formula>| row.iter().map(f).collect::<Vec<_>>().join(" & ");
            let rows: Vec<String> = rows.iter().map(row).collect();
            format!(r"\begin{{bmatrix}} {} \end{{bmatrix}}", rows.join(r" \\ "))
        }
        Formula::Cases(branches, condition) => {
            let [then, otherwise] = branches.as_ref();
            format!(
                r"\begin{{cases}} {} & \text{{where }} {} \\ {} & \text{{else}} \end{{cases}}",
                f(then),
                f(condition),
                f(otherwise)
            )
        }
    }
}

/// Returns the base of an index or exponent, in braces if it is more than a symbol.
fn base(stem: &Formula) -> String {
    match stem {
        Formula::Symbol(..) | Formula::Group(_) => formula(stem),
        // TeX drops braces around a lone accent together with its index; an empty group beside it keeps them.
        Formula::Index(inner, _) if matches!(**inner, Formula::Over(_)) => format!("{{{}{{}}}}", formula(stem)),
        stem => format!("{{{}}}", formula(stem)),
    }
}

fn symbol(name: &str, face: Typeface) -> String {
    let name = name.replace('_', r"\_").replace('ε', r"\varepsilon");
    let is_letter = name.chars().count() == 1 || name.starts_with('\\');
    match face {
        Typeface::Italic if is_letter => name,
        Typeface::Italic | Typeface::Upright => format!(r"\mathrm{{{name}}}"),
        Typeface::Bold => format!(r"\mathbf{{{name}}}"),
    }
}

fn sign(sign: Sign) -> &'static str {
    match sign {
        Sign::Plus => "+",
        Sign::Minus | Sign::Negative => "-",
        Sign::Dot | Sign::Point => r"\cdot",
        Sign::Cross => r"\times",
        Sign::Times => r"\,",
        Sign::Equals => "=",
        Sign::Less => "<",
        Sign::Across => r"\perp",
        Sign::Partial => r"\partial",
        Sign::Becomes => r"\longrightarrow",
        Sign::Comma => ",",
    }
}
