//! Writes a random function in ordinary Rust: loops of all kinds that change numbers, options, flags, arrays, structs and enums,
//! and are left in all ways, and helpers that return early.
//!
//! What the two texts of a function differ in stands between ‹ and ›: numbers and their type.

use std::fmt::Write;

/// What all functions know.
const KNOWN: &str = "
#[derive(Clone, Copy)]
struct Pair {
    a: ‹f64›,
    b: Option<‹f64›>,
}

impl Pair {
    fn energy(&self) -> ‹f64› {
        match self.b {
            Some(b) if b > self.a => b - self.a,
            Some(b) => ‹0.5› * b,
            None => self.a,
        }
    }

    fn turned(self) -> Self {
        match self.b {
            Some(b) => Self { a: b, b: Some(self.a) },
            None => Self { a: -self.a, ..self },
        }
    }

    fn fill(&mut self, with: ‹f64›) -> bool {
        let was_empty = self.b.is_none();
        if was_empty {
            self.b = Some(with);
        } else {
            self.a = ‹0.5› * self.a + with;
        }
        was_empty
    }
}

#[derive(Clone, Copy)]
enum Shape {
    Empty,
    One(‹f64›),
    Two { a: ‹f64›, b: ‹f64› },
}

impl Shape {
    fn size(&self) -> ‹f64› {
        match *self {
            Shape::Empty => ‹0.25›,
            Shape::One(a) => a,
            Shape::Two { a, b } => a * b,
        }
    }

    fn grown(self, by: ‹f64›) -> Self {
        match self {
            Shape::Empty => Shape::One(by),
            Shape::One(a) if a < by => Shape::Two { a, b: by },
            Shape::One(_) => Shape::Empty,
            Shape::Two { a, b } => Shape::Two { a: b, b: ‹0.5› * a + by },
        }
    }
}

fn bent(a: ‹f64›, b: ‹f64›) -> ‹f64› {
    if a > b {
        return a - b;
    }
    let mut r = b;
    for _ in 0..2 {
        r = ‹0.5› * r + a;
        if r > ‹1.0› {
            break;
        }
    }
    r
}

fn root(a: ‹f64›) -> Option<‹f64›> {
    if a < ‹0.2› { None } else { Some(a.sqrt()) }
}

fn both(a: ‹f64›, b: ‹f64›) -> Option<‹f64›> {
    Some(root(a)? + ‹0.5› * root(b)?)
}

fn nudge(a: &mut ‹f64›, by: ‹f64›) -> bool {
    if by > *a {
        *a = ‹0.5› * (*a + by);
        return true;
    }
    false
}
";

/// The names that can be read, or changed, where a statement stands.
#[derive(Clone, Default)]
struct Scope {
    numbers: Vec<String>,
    changed: Vec<String>,
    options: Vec<String>,
    flags: Vec<String>,
    wholes: Vec<String>,
    arrays: Vec<String>,
    pairs: Vec<String>,
    shapes: Vec<String>,
    /// Numbers of loops around.
    loops: usize,
}

struct Writer {
    random: fastrand::Rng,
    text: String,
    indent: usize,
    names: usize,
    /// How many statements may still be written.
    left: usize,
}

/// The module of a random function, and its twin.
pub(crate) fn module(number: u64) -> String {
    let mut writer =
        Writer { random: fastrand::Rng::with_seed(number), text: String::new(), indent: 0, names: 0, left: 14 };
    let text = writer.function();
    let plain = text.replace(['‹', '›'], "");
    let twin = twin_of(&text);
    format!(
        "#[aim::differentiate]
mod program_{number} {{
{plain_known}
#[differentiate(wrt(x, y))]
pub(super) fn program_{number}{plain}}}
mod twin_{number} {{
use aim_programs::{{Dual, Number as _, c, of}};
use num_dual::DualNum as _;
{known}
pub(super) fn program_{number}{twin}}}
",
        plain_known = KNOWN.replace(['‹', '›'], ""),
        known = twin_of(KNOWN),
    )
}

/// The text for dual numbers.
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
        self.indent = 1;
        for _ in 0..self.random.usize(2..=4) {
            self.declaration(&mut scope);
        }
        // Something to change is always there.
        let name = self.name();
        let value = self.number(&scope, 1);
        self.line(&format!("let mut {name} = {value};"));
        scope.numbers.push(name.clone());
        scope.changed.push(name);
        for _ in 0..self.random.usize(2..=4) {
            self.statement(&mut scope, 3);
        }
        let result = self.result(&scope);
        self.line(&result);
        let body = core::mem::take(&mut self.text);
        format!("(x: ‹f64›, y: ‹f64›, s: &[‹f64›], n: i32) -> ‹f64› {{\n{body}}}\n")
    }

    /// A number of all that could have been changed.
    fn result(&mut self, scope: &Scope) -> String {
        let mut terms: Vec<String> = scope.changed.clone();
        terms.extend(scope.options.iter().map(|o| format!("{o}.map_or(‹0.3›, |v| ‹2.0› * v)")));
        terms.extend(
            scope.flags.iter().map(|f| format!("if {f} {{ ‹0.7› * x }} else {{ y }}")).map(|t| format!("({t})")),
        );
        terms.extend(scope.wholes.iter().map(|k| format!("x * ‹f64::from›({k})")));
        terms.extend(scope.arrays.iter().map(|a| format!("{a}[0] - {a}[2] * {a}[1]")));
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

    /// A name for a number, where another name is borrowed.
    fn bound(&mut self, scope: &Scope) -> String {
        let (name, value) = (self.name(), self.number(scope, 1));
        self.line(&format!("let {name} = {value};"));
        name
    }

    /// Something that is changed later.
    fn declaration(&mut self, scope: &mut Scope) {
        let name = self.name();
        match self.random.u8(..7) {
            0 => {
                let value = self.number(scope, 1);
                self.line(&format!("let mut {name} = {value};"));
                scope.numbers.push(name.clone());
                scope.changed.push(name);
            }
            1 => {
                if self.random.bool() {
                    self.line(&format!("let mut {name}: Option<‹f64›> = None;"));
                } else {
                    let value = self.option(scope, 1);
                    self.line(&format!("let mut {name} = {value};"));
                }
                scope.options.push(name);
            }
            2 => {
                let value = if self.random.bool() {
                    self.condition(scope, 1)
                } else {
                    self.one_of(&["true", "false"]).to_owned()
                };
                self.line(&format!("let mut {name} = {value};"));
                scope.flags.push(name);
            }
            3 => {
                let value = self.random.u8(..3);
                self.line(&format!("let mut {name} = {value}_i32;"));
                scope.wholes.push(name);
            }
            4 => {
                let [a, b, c] = core::array::from_fn(|_| self.number(scope, 0));
                self.line(&format!("let mut {name} = [{a}, {b}, {c}];"));
                scope.arrays.push(name);
            }
            5 => {
                let (a, b) = (self.number(scope, 0), self.option(scope, 0));
                self.line(&format!("let mut {name} = Pair {{ a: {a}, b: {b} }};"));
                scope.pairs.push(name);
            }
            _ => {
                let value = self.shape(scope);
                self.line(&format!("let mut {name} = {value};"));
                scope.shapes.push(name);
            }
        }
    }

    /// Statements in a block of its own.
    fn block(&mut self, scope: &Scope, depth: usize) {
        let mut inner = scope.clone();
        self.indent += 1;
        for _ in 0..self.random.usize(1..=2) {
            self.statement(&mut inner, depth);
        }
        self.indent -= 1;
    }

    fn statement(&mut self, scope: &mut Scope, depth: usize) {
        if depth == 0 || self.left == 0 || self.random.u8(..10) < 4 {
            self.change(scope);
            return;
        }
        self.left -= 1;
        match self.random.u8(..16) {
            0 | 1 => {
                let condition = self.condition(scope, 1);
                self.line(&format!("if {condition} {{"));
                self.block(scope, depth - 1);
                if self.random.bool() {
                    self.line("} else {");
                    self.block(scope, depth - 1);
                }
                self.line("}");
            }
            2 | 3 if !scope.options.is_empty() => {
                let (option, name) = (self.any(&scope.options), self.name());
                let from = if self.random.bool() { format!("{option}.take()") } else { option };
                self.line(&format!("if let Some({name}) = {from} {{"));
                let mut inner = scope.clone();
                inner.numbers.push(name);
                self.block(&inner, depth - 1);
                if self.random.bool() {
                    self.line("} else {");
                    self.block(scope, depth - 1);
                }
                self.line("}");
            }
            4 if !scope.shapes.is_empty() => {
                let (shape, [a, b]) = (self.any(&scope.shapes), [self.name(), self.name()]);
                self.line(&format!("match {shape} {{\n    Shape::One({a}) => {{"));
                let mut inner = scope.clone();
                inner.numbers.push(a.clone());
                self.indent += 1;
                self.block(&inner, depth - 1);
                self.line("}");
                if self.random.bool() {
                    let bound = self.literal();
                    self.line(&format!("Shape::Two {{ a: {a}, b: {b} }} if {b} < {bound} => {{"));
                    inner.numbers.push(b);
                    self.block(&inner, depth - 1);
                    self.line("}");
                }
                self.line("_ => {");
                self.block(scope, depth - 1);
                self.line("}");
                self.indent -= 1;
                self.line("}");
            }
            5 | 6 => {
                let condition = self.condition(scope, 1);
                self.line(&format!("if {condition} {{"));
                self.indent += 1;
                self.change(&mut scope.clone());
                let leaves = if scope.loops > 0 { self.one_of(&["break;", "continue;", "return"]) } else { "return" };
                if leaves == "return" {
                    let result = self.number(scope, 1);
                    self.line(&format!("return {result};"));
                } else {
                    self.line(leaves);
                }
                self.indent -= 1;
                self.line("}");
            }
            _ if scope.loops < 2 => self.repetition(scope, depth),
            _ => self.change(scope),
        }
    }

    /// A loop.
    fn repetition(&mut self, scope: &Scope, depth: usize) {
        let mut inner = scope.clone();
        inner.loops += 1;
        let name = self.name();
        match self.random.u8(..11) {
            0 => {
                let rounds = self.random.u8(2..=3);
                self.line(&format!("for {name} in 0..{rounds}_i32 {{"));
                inner.numbers.push(format!("‹f64::from›({name})"));
            }
            1 => {
                self.line(&format!("for {name} in 0..n {{"));
                inner.numbers.push(format!("‹f64::from›({name})"));
            }
            2 | 3 => {
                self.line(&format!("for &{name} in s {{"));
                inner.numbers.push(name);
            }
            4 => {
                self.line(&format!("for {name} in s.iter().rev() {{"));
                inner.numbers.push(format!("(*{name})"));
            }
            5 => {
                self.line(&format!("for {name} in s.windows(2) {{"));
                inner.numbers.extend([format!("{name}[0]"), format!("{name}[1]")]);
            }
            6 => {
                let at = self.name();
                self.line(&format!("for ({at}, {name}) in s.iter().enumerate() {{"));
                inner.numbers.extend([format!("(*{name})"), format!("s[{at}]")]);
            }
            7 => {
                let first = self.random.u8(..2);
                self.line(&format!("for {name} in {first}..s.len() {{"));
                inner.numbers.push(format!("s[{name}]"));
                if first > 0 {
                    inner.numbers.push(format!("s[{name} - 1]"));
                }
            }
            8 => {
                let mut condition = format!("{name} < {}", self.one_of(&["n", "3", "4"]));
                if self.random.bool() {
                    condition = format!("{condition} && {}", self.condition(scope, 0));
                }
                self.line(&format!("let mut {name} = 0_i32;\nwhile {condition} {{\n    {name} += 1;"));
                inner.numbers.push(format!("‹f64::from›({name})"));
            }
            9 if !scope.options.is_empty() => {
                // It ends, for what is put back is counted.
                let (option, count) = (self.any(&scope.options), self.name());
                self.line(&format!(
                    "let mut {count} = 0_i32;\nwhile let Some({name}) = {option}.take() {{\n    {count} += 1;"
                ));
                self.line(&format!("    if {count} > n {{\n        break;\n    }}"));
                inner.numbers.push(name);
            }
            _ => {
                let (count, condition) = (self.name(), self.condition(scope, 0));
                self.line(&format!("let mut {count} = 0_i32;\nloop {{\n    {count} += 1;\n    if {count} > n || {condition} {{\n        break;\n    }}"));
            }
        }
        self.block(&inner, depth - 1);
        self.line("}");
    }

    /// A change of something.
    fn change(&mut self, scope: &mut Scope) {
        loop {
            match self.random.u8(..16) {
                0..=3 if !scope.changed.is_empty() => {
                    let (name, value) = (self.any(&scope.changed), self.number(scope, 2));
                    let line = match self.random.u8(..4) {
                        0 => format!("{name} += {value};"),
                        1 => format!("{name} = {value}.sin();"),
                        2 => format!("{name} -= ‹0.5› * {value};"),
                        _ => format!("{name} = ‹0.5› * {name} + {value};"),
                    };
                    self.line(&line);
                }
                4..=6 if !scope.options.is_empty() => {
                    let (name, value) = (self.any(&scope.options), self.option(scope, 1));
                    let kind = self.random.u8(..9);
                    let number = if matches!(kind, 4 | 6) { self.bound(scope) } else { self.number(scope, 1) };
                    let line = match kind {
                        0 => format!("{name} = None;"),
                        1 => format!("{name}.replace({number});"),
                        2 if !scope.changed.is_empty() => {
                            format!("{} = *{name}.get_or_insert({number});", self.any(&scope.changed))
                        }
                        3 if !scope.changed.is_empty() => {
                            format!("{} += {name}.take().unwrap_or({number});", self.any(&scope.changed))
                        }
                        4 => {
                            let lent =
                                if self.random.bool() { format!("&mut {name}") } else { format!("{name}.as_mut()") };
                            format!("if let Some(v) = {lent} {{\n    *v = ‹0.5› * *v + {number};\n}}")
                        }
                        5 => format!("*{name}.insert({number}) += ‹0.5› * x;"),
                        6 => format!("{name}.get_or_insert_with(|| {number});"),
                        _ => format!("{name} = {value};"),
                    };
                    self.line(&line);
                }
                7 if !scope.flags.is_empty() => {
                    let (name, value) = (self.any(&scope.flags), self.condition(scope, 1));
                    self.line(&format!("{name} = {value};"));
                }
                8 if !scope.wholes.is_empty() => {
                    let name = self.any(&scope.wholes);
                    let by = self.random.u8(1..3);
                    self.line(&format!("{name} += {by};"));
                }
                9 | 10 if !scope.arrays.is_empty() => {
                    let (name, value) = (self.any(&scope.arrays), self.bound(scope));
                    let at = self.random.u8(..3);
                    let line = match self.random.u8(..4) {
                        0 => format!("{name}.swap({at}, {});", (at + 1) % 3),
                        1 => format!("for e in &mut {name} {{\n    *e = ‹0.5› * *e + {value};\n}}"),
                        2 => format!("{name}[{at}] += {value};"),
                        _ => format!("{name}[{at}] = {value};"),
                    };
                    self.line(&line);
                }
                11 | 12 if !scope.pairs.is_empty() => {
                    let (name, number) = (self.any(&scope.pairs), self.number(scope, 1));
                    let line = match self.random.u8(..6) {
                        0 => format!("{name} = {name}.turned();"),
                        1 => format!("{name}.a = {number};"),
                        2 => format!("{name}.b = {};", self.option(scope, 1)),
                        3 => format!("{name} = Pair {{ a: {number}, ..{name} }};"),
                        4 if !scope.flags.is_empty() => format!("{} = {name}.fill({number});", self.any(&scope.flags)),
                        _ => format!("{name}.fill({number});"),
                    };
                    self.line(&line);
                }
                13 if !scope.shapes.is_empty() => {
                    let (name, shape) = (self.any(&scope.shapes), self.shape(scope));
                    let line = if self.random.bool() {
                        format!("{name} = {name}.grown({});", self.number(scope, 1))
                    } else {
                        format!("{name} = {shape};")
                    };
                    self.line(&line);
                }
                14 if !scope.changed.is_empty() => {
                    let (name, by) = (self.any(&scope.changed), self.bound(scope));
                    if scope.flags.is_empty() || self.random.bool() {
                        self.line(&format!("nudge(&mut {name}, {by});"));
                    } else {
                        let flag = self.any(&scope.flags);
                        self.line(&format!("{flag} = nudge(&mut {name}, {by});"));
                    }
                }
                15 => {
                    let (name, value) = (self.name(), self.number(scope, 2));
                    self.line(&format!("let {name} = {value};"));
                    scope.numbers.push(name);
                    // Used by what follows.
                    continue;
                }
                _ => continue,
            }
            return;
        }
    }

    fn shape(&mut self, scope: &Scope) -> String {
        match self.random.u8(..3) {
            0 => "Shape::Empty".to_owned(),
            1 => format!("Shape::One({})", self.number(scope, 1)),
            _ => format!("Shape::Two {{ a: {}, b: {} }}", self.number(scope, 1), self.number(scope, 0)),
        }
    }

    fn option(&mut self, scope: &Scope, depth: usize) -> String {
        let number = self.number(scope, depth);
        if depth > 0 && !scope.options.is_empty() && self.random.bool() {
            let (option, other) = (self.any(&scope.options), self.number(scope, 0));
            return match self.random.u8(..8) {
                0 => format!("{option}.map(|v| v * {other} + {number})"),
                1 => format!("{option}.filter(|v| *v > {number})"),
                2 => format!("{option}.or(Some({number}))"),
                3 => format!("{option}.and_then(|v| root(v + {number}))"),
                4 => format!("{option}.xor(root({number}))"),
                5 => format!("{option}.zip(root({number})).map(|(v, w)| v - w)"),
                6 => format!("{option}.and(root({number}))"),
                _ => option,
            };
        }
        match self.random.u8(..6) {
            0 => format!("root({number})"),
            1 => format!("both({number}, {})", self.number(scope, 0)),
            2 => {
                let condition = self.condition(scope, 0);
                format!("if {condition} {{ Some({number}) }} else {{ None }}")
            }
            3 => format!("s.first().map(|v| *v * {number})"),
            _ => format!("Some({number})"),
        }
    }

    fn condition(&mut self, scope: &Scope, depth: usize) -> String {
        let (a, b) = (self.number(scope, depth), self.number(scope, 0));
        match self.random.u8(..9) {
            0 if !scope.flags.is_empty() => self.any(&scope.flags),
            1 if !scope.flags.is_empty() => format!("!{}", self.any(&scope.flags)),
            2 if !scope.options.is_empty() => {
                format!("{}.{}()", self.any(&scope.options), self.one_of(&["is_some", "is_none"]))
            }
            3 if !scope.wholes.is_empty() => format!("{} < {}", self.any(&scope.wholes), self.one_of(&["n", "2", "3"])),
            4 if !scope.shapes.is_empty() => format!("matches!({}, Shape::One(v) if v > {a})", self.any(&scope.shapes)),
            5 if !scope.options.is_empty() => {
                format!("{}.{}(|v| v < {a})", self.any(&scope.options), self.one_of(&["is_some_and", "is_none_or"]))
            }
            6 if depth > 0 => {
                let other = self.condition(scope, 0);
                format!("({a} < {b} {} {other})", self.one_of(&["&&", "||"]))
            }
            7 => format!("{a} > {b}"),
            _ => format!("{a} < {b}"),
        }
    }

    /// A number, in brackets where it needs them.
    fn number(&mut self, scope: &Scope, depth: usize) -> String {
        if depth == 0 {
            return match self.random.u8(..8) {
                0 => self.literal(),
                1 if !scope.arrays.is_empty() => format!("{}[{}]", self.any(&scope.arrays), self.random.u8(..3)),
                2 if !scope.pairs.is_empty() => format!("{}.a", self.any(&scope.pairs)),
                3 if !scope.options.is_empty() => format!("{}.unwrap_or(x)", self.any(&scope.options)),
                _ => self.any(&scope.numbers),
            };
        }
        let (a, b) = (self.number(scope, depth - 1), self.number(scope, depth - 1));
        match self.random.u8(..20) {
            0..=2 => format!("({a} + {b})"),
            3 | 4 => format!("({a} - {b})"),
            5..=7 => format!("({a} * {b})"),
            8 => format!("({a} / (‹1.0› + {b} * {b}))"),
            9 => format!("(‹1.0› + {a} * {a}).sqrt()"),
            10 => format!("{a}.{}()", self.one_of(&["sin", "cos", "tanh", "atan"])),
            11 => format!("{a}.{}({b})", self.one_of(&["max", "min"])),
            12 => format!("bent({a}, {b})"),
            13 => {
                let condition = self.condition(scope, 0);
                format!("(if {condition} {{ {a} }} else {{ {b} }})")
            }
            14 if !scope.pairs.is_empty() => format!("{}.energy()", self.any(&scope.pairs)),
            15 if !scope.shapes.is_empty() => format!("{}.size()", self.any(&scope.shapes)),
            16 if !scope.options.is_empty() => format!("{}.map_or({a}, |v| v * {b})", self.any(&scope.options)),
            17 => format!("both({a}, {b}).unwrap_or({a})"),
            18 => format!("(-{a})"),
            _ => a,
        }
    }
}
