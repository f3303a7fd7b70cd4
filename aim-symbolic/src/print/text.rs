//! Formulas as one line of text.

use super::formula::{Formula, Sign};

/// Returns the formula in one line of Unicode: fractions with a slash, roots with √, indices after an underscore.
#[must_use]
pub fn formula(formula: &Formula) -> String {
    let f = self::formula;
    match formula {
        Formula::Symbol(name, _) => name.clone(),
        Formula::Number(digits) => digits.clone(),
        Formula::Sign(sign) => self::sign(*sign).to_owned(),
        Formula::Row(parts) => parts.iter().map(f).collect(),
        Formula::Index(stem, index) => format!("{}_{}", f(stem), grouped(index)),
        Formula::Squared(stem) => format!("{}²", f(stem)),
        Formula::Transposed(stem) => format!("{}ᵀ", f(stem)),
        Formula::Inverse(stem) => format!("{}⁻¹", f(stem)),
        Formula::Fraction(above, below) => format!("{}/{}", grouped(above), grouped(below)),
        Formula::Root(inner) => format!("√{}", grouped(inner)),
        Formula::Group(inner) => format!("({})", f(inner)),
        Formula::Bars(inner) => format!("|{}|", f(inner)),
        Formula::Over(stem) => format!("{}\u{304}", f(stem)),
        Formula::Matrix(rows) => {
            let row = |row: &Vec<Formula>| row.iter().map(f).collect::<Vec<_>>().join(", ");
            format!("[{}]", rows.iter().map(row).collect::<Vec<_>>().join("; "))
        }
        Formula::Cases(branches, condition) => {
            format!("({} where {}, else {})", f(&branches[0]), f(condition), f(&branches[1]))
        }
    }
}

/// Returns the formula, in parentheses if it has several parts.
fn grouped(part: &Formula) -> String {
    match part {
        Formula::Row(parts) if parts.len() > 1 => format!("({})", formula(part)),
        part => formula(part),
    }
}

fn sign(sign: Sign) -> &'static str {
    match sign {
        Sign::Plus => " + ",
        Sign::Minus => " − ",
        Sign::Negative => "−",
        Sign::Dot | Sign::Point => " · ",
        Sign::Cross => " × ",
        Sign::Times => " ",
        Sign::Equals => " = ",
        Sign::Less => " < ",
        Sign::Across => "⊥",
        Sign::Partial => "∂",
        Sign::Becomes => " → ",
        Sign::Comma => ", ",
    }
}
