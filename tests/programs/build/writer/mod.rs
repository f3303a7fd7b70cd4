//! Writes a random function in ordinary Rust: loops of all kinds that change numbers, options, flags, arrays, lists,
//! tuples, structs and enums and are left in every way, and helpers that return early.
//!
//! The text between ‹ and › differs between the two versions of a function: number literals and the number type.

mod expressions;
mod statements;

use std::fmt::Write;
use std::ops::Range;

/// Items that all functions can use.
const KNOWN: &str = include_str!("known.txt");

/// Largest number of statements in a function.
const STATEMENTS: usize = 14;

/// Names that are in scope for a statement, to read or to change.
#[derive(Clone, Default)]
struct Scope {
    numbers: Vec<String>,
    changed: Vec<String>,
    options: Vec<String>,
    flags: Vec<String>,
    wholes: Vec<String>,
    arrays: Vec<String>,
    lists: Vec<String>,
    tuples: Vec<String>,
    pairs: Vec<String>,
    shapes: Vec<String>,
    closures: Vec<String>,
    slices: Vec<String>,
    /// Labels of the enclosing loops; `None` for one without a label.
    loops: Vec<Option<String>>,
    /// `true` in a loop whose number of rounds is not a small constant. Lists may not change their length there.
    is_kept: bool,
}

impl Scope {
    /// Returns a scope with these numbers and the same slices.
    fn of_numbers(&self, numbers: &[&str]) -> Self {
        let numbers = numbers.iter().map(|number| (*number).to_owned()).collect();
        Self { numbers, slices: self.slices.clone(), ..Self::default() }
    }
}

struct Writer {
    random: fastrand::Rng,
    text: String,
    indent: usize,
    names: usize,
    /// Number of statements that may still be written.
    left: usize,
}

/// Returns the module of the random functions with these numbers, and its twin for dual numbers.
pub(crate) fn modules(numbers: Range<u64>) -> String {
    let first = numbers.start;
    let (mut plain, mut twin) = (String::new(), String::new());
    for number in numbers {
        let random = fastrand::Rng::with_seed(number);
        let mut writer = Writer { random, text: String::new(), indent: 0, names: 0, left: STATEMENTS };
        let text = format!("pub(super) fn program_{number}{}", writer.function());
        plain += &format!("#[differentiate(wrt(x, y))]\n{}\n", text.replace(['‹', '›'], ""));
        twin += &format!("{}\n", twin_of(&text));
    }
    format!(
        "#[aim::differentiate]
mod programs_{first} {{
{plain_known}
{plain}}}
mod twins_{first} {{
use aim_programs::{{Dual, Number as _, c, of}};
use num_dual::DualNum as _;
{known}
{twin}}}
",
        plain_known = KNOWN.replace(['‹', '›'], ""),
        known = twin_of(KNOWN),
    )
}

/// Returns the text of a function for dual numbers.
fn twin_of(text: &str) -> String {
    let mut twin = String::new();
    for part in text.split('‹') {
        let Some((marked, rest)) = part.split_once('›') else {
            twin += part;
            continue;
        };
        match marked {
            "f64" => twin += "Dual",
            "f64::from" => twin += "of",
            number => write!(twin, "c({number})").expect("a string takes all"),
        }
        twin += rest;
    }
    twin
}

impl Writer {
    fn function(&mut self) -> String {
        let mut scope = Scope::default();
        scope.numbers.extend(["x", "y"].map(String::from));
        scope.slices.push("s".to_owned());
        self.indent = 1;
        for _ in 0..self.random.usize(2..=4) {
            self.declaration(&mut scope);
        }
        // Ensures that there is a variable to change.
        let name = self.name();
        let value = self.number(&scope, 1);
        self.line(&format!("let mut {name} = {value};"));
        scope.numbers.push(name.clone());
        scope.changed.push(name);
        for _ in 0..self.random.usize(2..=4) {
            self.statement(&mut scope, 3);
        }
        let result = Self::result(&scope);
        self.line(&result);
        let body = core::mem::take(&mut self.text);
        format!("(x: ‹f64›, y: ‹f64›, s: &[‹f64›], e: &[[‹f64›; 2]], n: i32) -> ‹f64› {{\n{body}}}\n")
    }

    /// Returns an expression that depends on every variable that may have been changed.
    fn result(scope: &Scope) -> String {
        let mut terms: Vec<String> = scope.changed.clone();
        terms.extend(scope.options.iter().map(|o| format!("{o}.map_or(‹0.3›, |v| ‹2.0› * v)")));
        terms.extend(scope.flags.iter().map(|f| format!("(if {f} {{ ‹0.7› * x }} else {{ y }})")));
        terms.extend(scope.wholes.iter().map(|k| format!("x * ‹f64::from›({k})")));
        terms.extend(scope.arrays.iter().map(|a| format!("{a}[0] - {a}[2] * {a}[1]")));
        terms.extend(scope.lists.iter().map(|l| format!("{l}.iter().map(|v| *v * y).sum::<‹f64›>()")));
        terms.extend(scope.tuples.iter().map(|t| format!("{t}.0 * {t}.1")));
        terms.extend(scope.pairs.iter().map(|p| format!("{p}.energy()")));
        terms.extend(scope.shapes.iter().map(|e| format!("{e}.size()")));
        terms.join(" + ")
    }

    fn line(&mut self, line: &str) {
        for part in line.lines() {
            self.text += &"    ".repeat(self.indent);
            self.text += part;
            self.text += "\n";
        }
    }

    fn name(&mut self) -> String {
        self.names += 1;
        format!("v{}", self.names)
    }

    fn one_of<'a>(&mut self, of: &[&'a str]) -> &'a str {
        of[self.random.usize(..of.len())]
    }

    fn any(&mut self, of: &[String]) -> String {
        of[self.random.usize(..of.len())].clone()
    }

    fn literal(&mut self) -> String {
        format!("‹{}_f64›", self.one_of(&["0.25", "0.5", "0.8", "1.0", "1.5", "2.0", "0.1", "3.0"]))
    }

    /// Binds a number to a name, for places where another name is borrowed.
    fn bound(&mut self, scope: &Scope) -> String {
        let (name, value) = (self.name(), self.number(scope, 1));
        self.line(&format!("let {name} = {value};"));
        name
    }
}
