//! Generates random functions.

use fastrand::Rng;

use super::language::{Condition, Expression, Index, KINDS, Kind, Leave, Statement, Way, Written};

use Expression as E;

/// A generator of random functions.
pub(super) struct Author {
    random: Rng,
    /// `true` to use only operations that are exact modulo a prime.
    is_rational: bool,
    known: [usize; 3],
    /// The enclosing loops: number and kind.
    loops: Vec<(usize, Way)>,
    all_loops: usize,
    /// Number of statements that may still be written.
    left: usize,
}

impl Author {
    pub(super) fn new(seed: u64, is_rational: bool) -> Self {
        let random = Rng::with_seed(seed);
        Self { random, is_rational, known: [2, 2, 1], loops: Vec::new(), all_loops: 0, left: 9 }
    }

    /// Limits the functions to this number of statements, before the result.
    pub(super) fn of_at_most(self, left: usize) -> Self {
        Self { left, ..self }
    }

    pub(super) fn function(mut self) -> Written {
        let mut body = self.statements(2..6);
        // Use the last variable of each kind.
        let result = self.expression(Kind::Number, 3);
        let sum = KINDS.map(|kind| E::Variable(kind, self.known[kind as usize] - 1));
        let [number, vector, matrix] = sum;
        let size = E::Dot(Box::new([vector, E::Variable(Kind::Vector, 0)]));
        let used = E::Sum(Box::new([size, E::Product(Box::new([number, E::Determinant(Box::new(matrix))]))]));
        body.push(Statement::Increase(Kind::Number, 0, used));
        Written { body, result: E::Sum(Box::new([result, E::Variable(Kind::Number, 0)])) }
    }

    fn statements(&mut self, count: std::ops::Range<usize>) -> Vec<Statement> {
        let count = self.random.usize(count);
        let mut written = Vec::new();
        while written.len() < count && self.left > 0 {
            self.left -= 1;
            written.push(self.statement());
        }
        written
    }

    fn block(&mut self) -> Vec<Statement> {
        let known = self.known;
        let written = self.statements(1..4);
        self.known = known;
        written
    }

    fn statement(&mut self) -> Statement {
        let kind = KINDS[self.random.usize(..3)];
        let place = self.random.usize(..self.known[kind as usize]);
        // Nest at most two loops.
        match self.random.u8(..if self.loops.len() < 2 { 13 } else { 8 }) {
            0 | 1 => self.declaration(kind),
            2 => Statement::Set(kind, place, self.expression(kind, 3)),
            3 | 4 => Statement::Increase(kind, place, self.expression(kind, 2)),
            5 => Statement::Add(self.index(), self.expression(Kind::Number, 2)),
            6 | 7 => self.leave().unwrap_or_else(|| self.declaration(kind)),
            8..11 => {
                let (count, number) = (self.random.u8(1..4), self.all_loops);
                let way = [Way::Up, Way::Down, Way::While, Way::Each][self.random.usize(..4)];
                self.all_loops += 1;
                self.loops.push((number, way));
                let body = self.block();
                self.loops.pop();
                Statement::Loop { count, way, number, body }
            }
            _ if self.is_rational => self.declaration(kind),
            _ => Statement::If { less: self.compared(), then: self.block(), otherwise: self.block() },
        }
    }

    fn declaration(&mut self, kind: Kind) -> Statement {
        let to = self.expression(kind, 3);
        self.known[kind as usize] += 1;
        Statement::Let(kind, to)
    }

    fn compared(&mut self) -> [Expression; 2] {
        [self.expression(Kind::Number, 2), self.expression(Kind::Number, 1)]
    }

    /// Writes an exit from a loop. Rational functions compare nothing, so only a counter decides there.
    fn leave(&mut self) -> Option<Statement> {
        let &(number, way) = self.loops.last()?;
        let condition = match way {
            Way::Up | Way::Down | Way::While if self.is_rational || self.random.bool() => {
                Condition::Is(number, self.random.u8(..3))
            }
            _ if self.is_rational => return None,
            _ => Condition::Less(self.compared()),
        };
        let leave = match self.random.u8(..5) {
            0 | 1 => Leave::Break,
            // A `continue` would skip the counter of a `while` loop.
            2 | 3 if way != Way::While => Leave::Continue,
            _ => Leave::Return(self.expression(Kind::Number, 2)),
        };
        Some(Statement::Leave(condition, leave))
    }

    fn index(&mut self) -> Index {
        match self.loops.last() {
            // The counter is below 3.
            Some((number, Way::Up | Way::Down | Way::While)) if self.random.bool() => Index::Counter(*number),
            _ => Index::Constant(self.random.usize(..3)),
        }
    }

    fn expression(&mut self, kind: Kind, depth: usize) -> Expression {
        const CONSTANTS: [f64; 6] = [0.5, 1.0, -2.0, 0.0, 1.5, -0.25];
        let known = self.known[kind as usize];
        if depth == 0 || self.random.u8(..5) == 0 {
            let variable = E::Variable(kind, self.random.usize(..known));
            return match (kind, self.random.u8(..6)) {
                (Kind::Number, 0) => E::Constant(CONSTANTS[self.random.usize(..CONSTANTS.len())]),
                (Kind::Number, 1) => E::Element(self.index()),
                (Kind::Number, 2 | 3) => match self.loops.last() {
                    Some((number, Way::Each)) => E::Item(*number),
                    Some((number, _)) => E::Counter(*number),
                    None => variable,
                },
                _ => variable,
            };
        }
        let depth = depth - 1;
        let one = |of: &mut Self, kind| Box::new(of.expression(kind, depth));
        let two = |of: &mut Self, kinds: [Kind; 2]| Box::new(kinds.map(|kind| of.expression(kind, depth)));
        let (n, v, m) = (Kind::Number, Kind::Vector, Kind::Matrix);
        match self.random.u8(..12) {
            0 => return E::Sum(two(self, [kind; 2])),
            1 => return E::Difference(two(self, [kind; 2])),
            2 => return E::Negative(one(self, kind)),
            3 => return E::Product(two(self, [n, kind])),
            _ => {}
        }
        let axis = self.random.usize(..3);
        match (kind, self.random.u8(..6)) {
            (Kind::Number, 0) => E::Dot(two(self, [v, v])),
            (Kind::Number, 1) => E::Component(one(self, v), axis),
            (Kind::Number, 2) => E::Determinant(one(self, m)),
            (Kind::Number, 3) if !self.is_rational => E::Sine(one(self, n)),
            (Kind::Number, 4) if !self.is_rational => E::Root(one(self, n)),
            (Kind::Number, _) => E::Ratio(two(self, [n, n])),
            (Kind::Vector, 0) => E::Cross(two(self, [v, v])),
            (Kind::Vector, 1) => E::Column(one(self, m), axis),
            (Kind::Vector, 2) => E::Product(two(self, [m, v])),
            (Kind::Vector, 3) => E::Vector(Box::new([n; 3].map(|kind| self.expression(kind, depth)))),
            (Kind::Vector, _) => E::Turned(one(self, v)),
            (Kind::Matrix, 0 | 1) => E::Product(two(self, [m, m])),
            (Kind::Matrix, 2) => E::Columns(Box::new([v; 3].map(|kind| self.expression(kind, depth)))),
            (Kind::Matrix, _) => E::Transpose(one(self, m)),
        }
    }
}
