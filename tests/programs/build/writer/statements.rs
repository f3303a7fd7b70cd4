//! Writes statements: declarations, branches, loops, and changes of declared variables.

use super::{Scope, Writer};

impl Writer {
    /// Declares a variable that is changed later.
    pub(super) fn declaration(&mut self, scope: &mut Scope) {
        let name = self.name();
        match self.random.u8(..9) {
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
            6 => {
                let (a, b) = (self.number(scope, 1), self.number(scope, 0));
                self.line(&format!("let mut {name} = ({a}, {b});"));
                scope.tuples.push(name);
            }
            7 => {
                let (a, b) = (self.number(scope, 0), self.number(scope, 0));
                self.line(&format!("let mut {name} = vec![{a}, {b}];"));
                scope.lists.push(name);
            }
            _ => {
                let value = self.shape(scope);
                self.line(&format!("let mut {name} = {value};"));
                scope.shapes.push(name);
            }
        }
    }

    /// Writes statements in a block of their own.
    fn block(&mut self, scope: &Scope, depth: usize) {
        let mut inner = scope.clone();
        self.indent += 1;
        for _ in 0..self.random.usize(1..=2) {
            self.statement(&mut inner, depth);
        }
        self.indent -= 1;
    }

    pub(super) fn statement(&mut self, scope: &mut Scope, depth: usize) {
        if depth == 0 || self.left == 0 || self.random.u8(..10) < 4 {
            self.change(scope);
            return;
        }
        self.left -= 1;
        match self.random.u8(..24) {
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
            2 if !scope.options.is_empty() => {
                let (option, name) = (self.any(&scope.options), self.name());
                let from = match self.random.u8(..3) {
                    0 => format!("{option}.take()"),
                    1 => format!("{option} && {}", self.comparison(scope, 0)),
                    _ => option,
                };
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
            3 => {
                let (option, name) = (self.option(scope, 1), self.name());
                self.line(&format!("let Some({name}) = {option} else {{"));
                self.leave(scope);
                self.line("};");
                scope.numbers.push(name);
                self.statement(scope, depth - 1);
            }
            4 if !scope.shapes.is_empty() => self.shapes(scope, depth),
            5 | 6 => {
                let condition = self.condition(scope, 1);
                self.line(&format!("if {condition} {{"));
                self.leave(scope);
                self.line("}");
            }
            7 if !scope.wholes.is_empty() => {
                let whole = self.any(&scope.wholes);
                let of = if self.random.bool() { format!("{whole} % 3") } else { whole };
                self.line(&format!("match {of} {{"));
                self.arms(scope, depth, &[("0", &[]), ("1 | 3..=4", &[]), ("_", &[])]);
            }
            8 => {
                self.line("match s {");
                let [first, last] = [self.name(), self.name()];
                let (one, two) = (format!("[{first}]"), format!("[{first}, .., {last}]"));
                let (a, b) = (format!("(*{first})"), format!("(*{last})"));
                self.arms(scope, depth, &[("[]", &[]), (&one, &[&a]), (&two, &[&a, &b])]);
            }
            9 => self.block_of_a_number(scope, depth),
            10 => {
                let (name, captured) = (self.name(), self.bound(scope));
                let inner = scope.of_numbers(&["x", "y", "q", &captured]);
                let value = self.number(&inner, 2);
                self.line(&format!("let {name} = |q: ‹f64›| {value};"));
                scope.closures.push(name);
                self.statement(scope, depth - 1);
            }
            20 => {
                let (name, condition, number) = (self.name(), self.condition(scope, 1), self.number(scope, 1));
                let label = format!("'of_{name}");
                self.line(&format!(
                    "let {name} = {label}: {{\n    if {condition} {{\n        break {label} {number};\n    }}"
                ));
                // A `break` without a label is not allowed inside a labelled block.
                let mut inner = scope.clone();
                inner.loops.retain(Option::is_some);
                self.block(&inner, depth - 1);
                let (condition, number, other) =
                    (self.condition(scope, 1), self.number(scope, 1), self.number(scope, 1));
                self.line(&format!("    if {condition} {{\n        break {label} {number};\n    }}\n    {other}\n}};"));
                scope.numbers.push(name);
            }
            21 => {
                let (name, slice) = (self.name(), self.any(&scope.slices));
                let part = match self.random.u8(..4) {
                    0 => format!("&{slice}[{slice}.len() / 2..]"),
                    1 => format!("&{slice}[..{slice}.len().min(3)]"),
                    2 => format!("{slice}.split_at({slice}.len() / 2).1"),
                    _ => format!("if {} {{ {slice} }} else {{ s }}", self.condition(scope, 1)),
                };
                self.line(&format!("let {name} = {part};"));
                scope.slices.push(name);
                self.statement(scope, depth - 1);
            }
            22 if !scope.changed.is_empty() => {
                let (name, changed, number) = (self.name(), self.any(&scope.changed), self.bound(scope));
                self.line(&format!(
                    "let mut {name} = |q: ‹f64›| {{\n    {changed} += q * {number};\n    {changed} - q\n}};"
                ));
                let [one, other] = [(); 2].map(|()| {
                    let of = self.name();
                    let value = self.number(&scope.of_numbers(&["x", "y", &number]), 1);
                    self.line(&format!("let {of} = {name}({value});"));
                    of
                });
                scope.numbers.extend([one, other]);
            }
            23 => {
                let [name, a, b] = [self.name(), self.name(), self.name()];
                let other = self.number(scope, 1);
                self.line(&format!("let {name} = match e {{\n    [[{a}, {b}], ..] if {a} < {b} => *{b},"));
                self.line(&format!("    [.., [{a}, _]] => ‹0.5› * *{a},\n    _ => {other},\n}};"));
                scope.numbers.push(name);
                self.statement(scope, depth - 1);
            }
            _ if scope.loops.len() < 2 => self.repetition(scope, depth),
            _ => self.change(scope),
        }
    }

    /// Leaves an enclosing loop, continues one, or returns.
    fn leave(&mut self, scope: &Scope) {
        self.indent += 1;
        if self.random.bool() {
            self.change(&mut scope.clone());
        }
        let leaves = if scope.loops.is_empty() { "return" } else { self.one_of(&["break", "continue", "return"]) };
        if leaves == "return" {
            let result = self.number(scope, 1);
            self.line(&format!("return {result};"));
        } else {
            let around = &scope.loops[self.random.usize(..scope.loops.len())];
            self.line(&around.as_ref().map_or(format!("{leaves};"), |label| format!("{leaves} {label};")));
        }
        self.indent -= 1;
    }

    /// Writes the arms of a `match`, with the numbers that their patterns bind.
    fn arms(&mut self, scope: &Scope, depth: usize, arms: &[(&str, &[&str])]) {
        self.indent += 1;
        for (pattern, numbers) in arms {
            let mut inner = scope.clone();
            inner.numbers.extend(numbers.iter().map(|number| (*number).to_owned()));
            self.line(&format!("{pattern} => {{"));
            self.block(&inner, depth - 1);
            self.line("}");
        }
        self.indent -= 1;
        self.line("}");
    }

    /// Writes a `match` on an enum.
    fn shapes(&mut self, scope: &Scope, depth: usize) {
        let (shape, [a, b]) = (self.any(&scope.shapes), [self.name(), self.name()]);
        self.line(&format!("match {shape} {{"));
        let (one, two) =
            (format!("Shape::One({a})"), format!("Shape::Two {{ a: {a}, b: {b} }} if {b} < {}", self.literal()));
        let (of_one, of_two): (&[&str], &[&str]) = (&[&a], &[&a, &b]);
        if self.random.bool() {
            self.arms(scope, depth, &[(&two, of_two), (&one, of_one), ("_", &[])]);
        } else {
            self.arms(scope, depth, &[(&one, of_one), ("_", &[])]);
        }
    }

    /// Writes a number that a block with statements evaluates to.
    fn block_of_a_number(&mut self, scope: &mut Scope, depth: usize) {
        let name = self.name();
        let mut inner = scope.clone();
        match self.random.u8(..3) {
            0 => self.line(&format!("let {name} = {{")),
            1 => {
                let condition = self.condition(scope, 1);
                let other = self.number(scope, 1);
                self.line(&format!("let {name} = if {condition} {{\n    {other}\n}} else {{"));
            }
            _ => {
                let (count, condition, number) = (self.name(), self.condition(scope, 0), self.number(scope, 1));
                self.line(&format!("let mut {count} = 0_i32;\nlet {name} = loop {{\n    {count} += 1;"));
                self.line(&format!("    if {count} > n || {condition} {{\n        break {number};\n    }}"));
                // A `break` needs a value here, so the loop is not offered to inner statements.
                inner.loops.clear();
                inner.is_kept = true;
                self.block(&inner, 0);
                self.line("};");
                scope.numbers.push(name);
                return;
            }
        }
        self.indent += 1;
        for _ in 0..self.random.usize(1..=2) {
            self.statement(&mut inner, depth - 1);
        }
        let value = self.number(&inner, 1);
        self.line(&value);
        self.indent -= 1;
        self.line("};");
        scope.numbers.push(name);
    }

    /// Writes a loop.
    fn repetition(&mut self, scope: &Scope, depth: usize) {
        let mut inner = scope.clone();
        let name = self.name();
        let label = self.random.bool().then(|| format!("'of_{name}"));
        let named = label.as_ref().map_or(String::new(), |label| format!("{label}: "));
        inner.loops.push(label);
        let kind = self.random.u8(..20);
        let slice = self.any(&scope.slices);
        inner.is_kept |= !matches!(kind, 0 | 11 | 15);
        match kind {
            0 => {
                let rounds = self.random.u8(2..=3);
                self.line(&format!("{named}for {name} in 0..{rounds}_i32 {{"));
                inner.numbers.push(format!("‹f64::from›({name})"));
            }
            1 => {
                self.line(&format!("{named}for {name} in 0..n {{"));
                inner.numbers.push(format!("‹f64::from›({name})"));
            }
            2 | 3 => {
                self.line(&format!("{named}for &{name} in {slice} {{"));
                inner.numbers.push(name);
            }
            4 => {
                self.line(&format!("{named}for {name} in {slice}.iter().rev() {{"));
                inner.numbers.push(format!("(*{name})"));
            }
            5 => {
                self.line(&format!("{named}for {name} in {slice}.windows(2) {{"));
                inner.numbers.extend([format!("{name}[0]"), format!("{name}[1]")]);
            }
            6 => {
                let at = self.name();
                self.line(&format!("{named}for ({at}, {name}) in s.iter().enumerate() {{"));
                inner.numbers.extend([format!("(*{name})"), format!("s[{at}]")]);
            }
            7 => {
                let first = self.random.u8(..2);
                self.line(&format!("{named}for {name} in {first}..s.len() {{"));
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
                self.line(&format!("let mut {name} = 0_i32;\n{named}while {condition} {{\n    {name} += 1;"));
                inner.numbers.push(format!("‹f64::from›({name})"));
            }
            9 if !scope.options.is_empty() => {
                // The counter ends the loop even if the body puts a value back.
                let (option, count) = (self.any(&scope.options), self.name());
                self.line(&format!(
                    "let mut {count} = 0_i32;\n{named}while let Some({name}) = {option}.take() {{\n    {count} += 1;"
                ));
                self.line(&format!("    if {count} > n {{\n        break;\n    }}"));
                inner.numbers.push(name);
            }
            11 if !scope.arrays.is_empty() => {
                let (array, at) = (self.any(&scope.arrays), self.name());
                self.line(&format!("{named}for ({at}, {name}) in {array}.into_iter().enumerate() {{"));
                inner.numbers.extend([name, format!("‹f64::from›({at} as i32)")]);
            }
            12 => {
                let bound = self.comparison(&scope.of_numbers(&["x", "(*q)"]), 1);
                let takes = self.one_of(&["filter(|q|", "take_while(|q|", "skip_while(|q|"]);
                let bound = bound.replace("(*q)", "(**q)");
                self.line(&format!("{named}for {name} in s.iter().{takes} {bound}) {{"));
                inner.numbers.push(format!("(*{name})"));
            }
            13 => {
                let other = self.name();
                let with = self.one_of(&["s.iter().skip(1)", "s.iter().rev()", "s[s.len() / 2..].iter()"]);
                self.line(&format!("{named}for ({name}, {other}) in s.iter().zip({with}) {{"));
                inner.numbers.extend([format!("(*{name})"), format!("(*{other})")]);
            }
            14 => {
                let tail = self.name();
                let (pattern, value) = match self.random.u8(..3) {
                    0 => (format!("[{name}, rest @ ..]"), tail.clone()),
                    1 => (format!("[rest @ .., {name}]"), tail.clone()),
                    _ => (format!("Some(({name}, rest))"), format!("{tail}.split_first()")),
                };
                self.line(&format!(
                    "let mut {tail} = {slice};\n{named}while let {pattern} = {value} {{\n    {tail} = rest;"
                ));
                inner.numbers.push(format!("(*{name})"));
                inner.slices.push(tail);
            }
            15 => {
                let (other, [a, b, c]) = (self.name(), core::array::from_fn(|_| self.number(scope, 1)));
                self.line(&format!("{named}for ({name}, {other}) in s.iter().zip([{a}, {b}, {c}]) {{"));
                inner.numbers.extend([format!("(*{name})"), other]);
            }
            16 => {
                self.line(&format!("{named}for &[{name}, {name}b] in e {{"));
                inner.numbers.extend([name.clone(), format!("{name}b")]);
            }
            17 => {
                self.line(&format!("{named}for {name} in e.iter().skip(1) {{"));
                inner.numbers.extend([format!("{name}[0]"), format!("{name}[1]")]);
            }
            18 => {
                self.line(&format!("{named}for {name} in {slice}.chunks(2) {{"));
                inner.slices.push(name);
            }
            19 => {
                self.line(&format!("{named}for ({name}, {name}b) in e.iter().zip({slice}) {{"));
                inner.numbers.extend([format!("{name}[0]"), format!("(*{name}b)")]);
            }
            _ => {
                let (count, condition) = (self.name(), self.condition(scope, 0));
                self.line(&format!("let mut {count} = 0_i32;\n{named}loop {{\n    {count} += 1;"));
                self.line(&format!("    if {count} > n || {condition} {{\n        break;\n    }}"));
            }
        }
        self.block(&inner, depth - 1);
        self.line("}");
    }

    /// Writes a change of a variable.
    fn change(&mut self, scope: &mut Scope) {
        loop {
            match self.random.u8(..20) {
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
                    let line = match self.random.u8(..7) {
                        0 => format!("{name}.swap({at}, {});", (at + 1) % 3),
                        1 => format!("for e in &mut {name} {{\n    *e = ‹0.5› * *e + {value};\n}}"),
                        2 => format!("{name}[{at}] += {value};"),
                        4 => format!("for (e, v) in {name}.iter_mut().zip(s) {{\n    *e += ‹0.5› * *v + {value};\n}}"),
                        5 if !scope.wholes.is_empty() => {
                            format!("{name}[({} % 3) as usize] += {value};", self.any(&scope.wholes))
                        }
                        6 => format!("{name} = {name}.map(|v| {value} - ‹0.5› * v);"),
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
                    // The new number is used by the change that follows.
                    continue;
                }
                16 if !scope.tuples.is_empty() => {
                    let (name, number) = (self.any(&scope.tuples), self.number(scope, 1));
                    let line = match self.random.u8(..4) {
                        0 => format!("{name} = ({name}.1, ‹0.5› * {name}.0 + {number});"),
                        1 => format!("{name}.0 = {number};"),
                        2 => format!("let (a, b) = &mut {name};\ncore::mem::swap(a, b);\n*a += {};", self.literal()),
                        _ => format!("{name}.1 -= ‹0.5› * {number};"),
                    };
                    self.line(&line);
                }
                17 if scope.changed.len() > 1 => {
                    let [a, b] = [self.any(&scope.changed), self.any(&scope.changed)];
                    if a == b {
                        continue;
                    }
                    self.line(&format!("core::mem::swap(&mut {a}, &mut {b});"));
                }
                18 if !scope.lists.is_empty() => {
                    let (name, number) = (self.any(&scope.lists), self.bound(scope));
                    let line = match self.random.u8(..6) {
                        0 if !scope.is_kept => format!("{name}.push({number});"),
                        1 if !scope.is_kept => {
                            format!("if let Some(v) = {name}.pop() {{\n    {name}.insert(0, v - {number});\n}}")
                        }
                        2 if !scope.is_kept => format!("{name}.retain(|v| *v < {number});"),
                        3 => format!("{name}.iter_mut().for_each(|v| *v = ‹0.5› * *v + {number});"),
                        4 => format!("if let Some(v) = {name}.last_mut() {{\n    *v += {number};\n}}"),
                        _ => format!("if !{name}.is_empty() {{\n    {name}[0] -= ‹0.5› * {number};\n}}"),
                    };
                    self.line(&line);
                }
                19 if !scope.changed.is_empty() && !scope.pairs.is_empty() => {
                    let [number, pair] = [self.any(&scope.changed), self.any(&scope.pairs)];
                    self.line(&format!("{number} += core::mem::replace(&mut {pair}.a, {number});"));
                }
                _ => continue,
            }
            return;
        }
    }
}
