//! Writes numbers, conditions and other values.

use super::{Scope, Writer};

impl Writer {
    pub(super) fn shape(&mut self, scope: &Scope) -> String {
        match self.random.u8(..3) {
            0 => "Shape::Empty".to_owned(),
            1 => format!("Shape::One({})", self.number(scope, 1)),
            _ => format!("Shape::Two {{ a: {}, b: {} }}", self.number(scope, 1), self.number(scope, 0)),
        }
    }

    pub(super) fn option(&mut self, scope: &Scope, depth: usize) -> String {
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
        let s = self.any(&scope.slices);
        match self.random.u8(..17) {
            0 => format!("root({number})"),
            1 => format!("both({number}, {})", self.number(scope, 0)),
            2 => {
                let condition = self.condition(scope, 0);
                format!("(if {condition} {{ Some({number}) }} else {{ None }})")
            }
            3 => format!("{s}.first().map(|v| *v * {number})"),
            6 => format!("{s}.iter().copied().find(|v| *v > {number})"),
            7 => format!("{s}.iter().position(|v| *v > {number}).map(|at| {s}[at])"),
            8 => format!("{s}.iter().copied().reduce(|v, w| ‹0.5› * v + {number} * w)"),
            9 => format!("first_above({s}, {number})"),
            10 => format!("{s}.iter().copied().min_by(|v, w| v.partial_cmp(w).unwrap())"),
            11 => {
                format!("{s}.iter().max_by(|v, w| (**v * {number}).partial_cmp(&(**w * {number})).unwrap()).copied()")
            }
            12 => format!("{s}.last().copied().filter(|v| *v < {number})"),
            13 => format!("e.first().map(|[v, w]| *v - {number} * *w)"),
            14 => format!("sure({number}, x).ok()"),
            15 => format!(
                "e.iter().fold(None, |v: Option<‹f64›>, w| match v {{\n    Some(v) if v > w[0] => Some(v),\n    _ => Some(w[0] * {number}),\n}})"
            ),
            16 => format!("{s}.split_last().and_then(|(v, rest)| Some(*v * *rest.first()?))"),
            _ => format!("Some({number})"),
        }
    }

    /// Writes a comparison of two numbers.
    pub(super) fn comparison(&mut self, scope: &Scope, depth: usize) -> String {
        let (a, b) = (self.number(scope, depth), self.number(scope, 0));
        format!("{a} {} {b}", self.one_of(&["<", ">"]))
    }

    pub(super) fn condition(&mut self, scope: &Scope, depth: usize) -> String {
        let (a, b) = (self.number(scope, depth), self.number(scope, 0));
        match self.random.u8(..15) {
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
            9 => format!("s.iter().{}(|v| *v > {a})", self.one_of(&["any", "all"])),
            10 => format!("s.len() > {}", self.one_of(&["n as usize", "2", "3"])),
            12 => format!("(‹0.5›..‹1.5›).contains(&{a})"),
            13 if !scope.tuples.is_empty() => format!("matches!({}, (v, w) if v < w)", self.any(&scope.tuples)),
            14 => format!("matches!(e, [[v, _], ..] if *v > {a})"),
            _ => format!("{a} < {b}"),
        }
    }

    /// Writes a number, in brackets if necessary.
    pub(super) fn number(&mut self, scope: &Scope, depth: usize) -> String {
        if depth == 0 {
            return match self.random.u8(..8) {
                0 => self.literal(),
                1 if !scope.arrays.is_empty() => format!("{}[{}]", self.any(&scope.arrays), self.random.u8(..3)),
                2 if !scope.pairs.is_empty() => format!("{}.a", self.any(&scope.pairs)),
                4 if !scope.tuples.is_empty() => format!("{}.{}", self.any(&scope.tuples), self.random.u8(..2)),
                3 if !scope.options.is_empty() => format!("{}.unwrap_or(x)", self.any(&scope.options)),
                _ => self.any(&scope.numbers),
            };
        }
        let (a, b) = (self.number(scope, depth - 1), self.number(scope, depth - 1));
        let s = self.any(&scope.slices);
        match self.random.u8(..56) {
            0..=2 => format!("({a} + {b})"),
            3 | 4 => format!("({a} - {b})"),
            5..=7 => format!("({a} * {b})"),
            8 => format!("({a} / (‹1.0› + {b} * {b}))"),
            9 => format!("(‹1.0› + {a} * {a}).sqrt()"),
            10 => format!("{a}.{}()", self.one_of(&["sin", "cos", "sin().tanh", "atan"])),
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
            20 => format!("(if {a} > ‹0.2› {{ {a}.{}() }} else {{ {b} }})", self.one_of(&["sqrt", "ln", "recip"])),
            21 => {
                format!("(if {a} * {a} < ‹0.9› {{ {a}.{}() }} else {{ {b} }})", self.one_of(&["asin", "acos", "atanh"]))
            }
            22 => format!("(if {b} < -‹0.3› {{ {a} / {b} }} else {{ {b} }})"),
            23 => format!("{a}.clamp(-‹0.7›, ‹1.2›)"),
            24 => format!("{a}.abs()"),
            25 => format!("{a}.atan2(‹1.0› + {b} * {b})"),
            26 => format!("{a}.sin().exp()"),
            27 => format!("{s}.iter().map(|v| *v * {a} + {b}).sum::<‹f64›>()"),
            28 => format!("{s}.iter().fold({a}, |v, w| if v < *w {{ *w - v }} else {{ ‹0.5› * v }})"),
            29 => format!("‹f64::from›(s.iter().filter(|v| **v < {a}).count() as i32)"),
            30 if !scope.closures.is_empty() => format!("{}({a})", self.any(&scope.closures)),
            31 => format!("total({s}, {a}, {b})"),
            32 => format!("pick({}, {a}, {b})", self.comparison(scope, 0)),
            33 if !scope.pairs.is_empty() => {
                let [one, other] = [self.any(&scope.pairs), self.any(&scope.pairs)];
                format!("({one} + {other} * {a}).energy()")
            }
            34 if !scope.wholes.is_empty() => {
                format!("s.get({} as usize).copied().unwrap_or({a})", self.any(&scope.wholes))
            }
            35 if !scope.lists.is_empty() => {
                format!("{}.iter().fold({a}, |v, w| v.max(*w))", self.any(&scope.lists))
            }
            36 => format!("e.iter().map(|[v, w]| *v * {a} - *w).sum::<‹f64›>()"),
            37 => format!("{s}.iter().zip(e).map(|(v, w)| *v * w[1] + {a} * w[0]).sum::<‹f64›>()"),
            38 => format!("e.iter().fold({a}, |v, w| if w[0] > w[1] {{ v + w[0] }} else {{ ‹0.5› * v }})"),
            39 => {
                format!("[{a}, {b}, x].into_iter().chain([y]).filter(|v| *v > ‹0.1›).map(|v| v * {a}).sum::<‹f64›>()")
            }
            40 => format!(
                "[{a}, {b}, y].iter().scan(x, |v, w| {{\n    *v = ‹0.5› * *v + *w;\n    Some(*v)\n}}).fold(y, |v, w| v - w)"
            ),
            41 => format!("{s}.iter().enumerate().map(|(i, v)| *v * ‹f64::from›(i as i32) + {a}).sum::<‹f64›>()"),
            42 => format!("checked({a}).unwrap_or({b})"),
            43 => format!("sure({a}, {b}).map_or({b}, |v| v * x)"),
            44 => format!("folded({a}, {b}, {})", self.random.u8(..4)),
            45 => format!("product([[{a}, x], [y, {b}]], [{b}, {a}])[{}]", self.random.u8(..2)),
            46 if !scope.pairs.is_empty() => format!("{}.scaled({a})", self.any(&scope.pairs)),
            47 if !scope.shapes.is_empty() => format!("{}.scaled({a})", self.any(&scope.shapes)),
            48 => format!("Point({a}, {b}).turned().dot(Point(x, {a}))"),
            49 => format!("(Point({a}, y) + Point({b}, x) * {a}).0"),
            50 => format!("{s}.chunks(2).map(|v| v[0] * v.iter().fold({a}, |v, w| v - *w)).sum::<‹f64›>()"),
            51 => format!("e.iter().map(|v| v.iter().fold({a}, |v, w| v * *w)).sum::<‹f64›>()"),
            52 if !scope.options.is_empty() => {
                let option = self.any(&scope.options);
                format!("(if {option}.is_some() {{ {option}.unwrap() * {a} }} else {{ {b} }})")
            }
            53 if !scope.options.is_empty() => {
                let (one, other) = (self.any(&scope.options), self.option(scope, depth - 1));
                format!(
                    "match ({one}, {other}) {{\n    (Some(v), Some(w)) if v < w => v - w,\n    (Some(v), None) | (None, Some(v)) => v * {a},\n    _ => {b},\n}}"
                )
            }
            54 if !scope.options.is_empty() => {
                format!("{}.into_iter().chain([{a}, {b}]).fold(x, |v, w| ‹0.5› * v - w)", self.any(&scope.options))
            }
            55 => format!("{s}.iter().map(|v| *v * {a}).rev().step_by(2).fold({b}, |v, w| v - w)"),
            _ => a,
        }
    }
}
