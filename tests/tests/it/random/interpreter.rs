//! The reference: an interpreter of the generated functions, over any number type.

use std::ops::ControlFlow::{self, Break, Continue};

use aim_symbolic::{Function, Number};
use fastrand::Rng;

use super::dual::Dual;
use super::language::{Condition, Expression, Index, Leave, Statement, Way, Written};

use Expression as E;

/// A value of each kind; matrices are stored by columns.
#[derive(Clone, Copy, Debug)]
enum Value<T> {
    Number(T),
    Vector([T; 3]),
    Matrix([[T; 3]; 3]),
}

use Value as V;

impl<T: Number> Value<T> {
    fn number(self) -> T {
        let Self::Number(value) = self else { unreachable!("a number was written") };
        value
    }

    fn vector(self) -> [T; 3] {
        let Self::Vector(value) = self else { unreachable!("a vector was written") };
        value
    }

    fn matrix(self) -> [[T; 3]; 3] {
        let Self::Matrix(value) = self else { unreachable!("a matrix was written") };
        value
    }

    /// Combines two values element by element.
    fn with(self, other: Self, op: impl Fn(T, T) -> T) -> Self {
        let both = |a: [T; 3], b: [T; 3]| std::array::from_fn(|i| op(a[i], b[i]));
        match (self, other) {
            (Self::Number(a), Self::Number(b)) => Self::Number(op(a, b)),
            (Self::Vector(a), Self::Vector(b)) => Self::Vector(both(a, b)),
            (Self::Matrix(a), Self::Matrix(b)) => Self::Matrix(std::array::from_fn(|i| both(a[i], b[i]))),
            _ => unreachable!("of one kind"),
        }
    }
}

fn dot<T: Number>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross<T: Number>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn scaled<T: Number>(k: T, v: [T; 3]) -> [T; 3] {
    v.map(|c| k * c)
}

fn sum<T: Number>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn image<T: Number>(columns: [[T; 3]; 3], v: [T; 3]) -> [T; 3] {
    sum(sum(scaled(v[0], columns[0]), scaled(v[1], columns[1])), scaled(v[2], columns[2]))
}

/// A point at which a function is evaluated: its arguments, and the step of its rotation, whose value is 0 and which
/// only has a slope.
#[derive(Clone, Debug)]
pub(super) struct Point<T> {
    x: T,
    y: T,
    u: [T; 3],
    w: [T; 3],
    matrix: [[T; 3]; 3],
    turn: [T; 4],
    table: [T; 3],
    step: [T; 3],
}

impl<T: Number> Point<T> {
    pub(super) fn random(random: &mut Rng, number: impl Fn(&mut Rng) -> T) -> Self {
        let mut next = || number(random);
        let mut three = || std::array::from_fn(|_| next());
        let (u, w, table) = (three(), three(), three());
        let matrix = std::array::from_fn(|_| three());
        let [x, y, a] = three();
        let [b, c, d] = three();
        // The square of a quaternion, divided by its squared length: a unit quaternion with rational components.
        let two = T::constant(2.0);
        let length = a * a + b * b + c * c + d * d;
        let turn = [two * a * b, two * a * c, two * a * d, a * a - b * b - c * c - d * d].map(|part| part / length);
        Self { x, y, u, w, matrix, turn, table, step: [T::constant(0.0); 3] }
    }

    /// Returns the inputs in the order of the arguments.
    pub(super) fn inputs(&self) -> Vec<T> {
        let mut inputs = vec![self.x, self.y];
        inputs.extend(
            self.u.iter().chain(&self.w).chain(self.matrix.as_flattened()).chain(&self.turn).chain(&self.table),
        );
        inputs
    }

    /// Returns the point as dual numbers that vary with one variable: x, a component of u, or of the rotation's
    /// tangent.
    pub(super) fn moving(&self, variable: usize) -> Point<Dual<T>> {
        let dual = Dual::fixed;
        let slope = |at: usize, value: T| Dual { value, slope: T::constant(if at == variable { 1.0 } else { 0.0 }) };
        let [u, step] = [(1, self.u), (4, self.step)].map(|(from, of)| std::array::from_fn(|i| slope(from + i, of[i])));
        Point {
            x: slope(0, self.x),
            y: dual(self.y),
            u,
            w: self.w.map(dual),
            matrix: self.matrix.map(|column| column.map(dual)),
            turn: self.turn.map(dual),
            table: self.table.map(dual),
            step,
        }
    }
}

/// Number of variables of the derivatives.
pub(super) const VARIABLES: usize = 7;

/// An iteration of a loop.
#[derive(Clone, Copy)]
struct Round<T> {
    number: usize,
    count: u8,
    element: T,
}

/// The reason why a block ends early.
enum Left<T> {
    Round,
    Loop,
    Function(T),
}

/// The interpreter.
struct Run<'p, T> {
    point: &'p Point<T>,
    variables: [Vec<Value<T>>; 3],
    table: [T; 3],
    /// The iteration of each enclosing loop: its counter or its current element.
    rounds: Vec<Round<T>>,
    /// `true` as long as no comparison was too close to decide.
    is_clear: bool,
    compare: fn(T, T) -> Option<bool>,
}

impl<T: Number> Run<'_, T> {
    fn round_of(&self, number: usize) -> Round<T> {
        *self.rounds.iter().find(|round| round.number == number).expect("it is in its loop")
    }

    fn place(&self, index: Index) -> usize {
        match index {
            Index::Constant(index) => index,
            Index::Counter(number) => self.round_of(number).count.into(),
        }
    }

    fn value(&self, expression: &Expression) -> Value<T> {
        let number = |of: &Expression| self.value(of).number();
        let vector = |of: &Expression| self.value(of).vector();
        let matrix = |of: &Expression| self.value(of).matrix();
        let one = T::constant(1.0);
        match expression {
            E::Constant(value) => V::Number(T::constant(*value)),
            E::Variable(kind, number) => self.variables[*kind as usize][*number],
            E::Counter(number) => V::Number(T::constant(self.round_of(*number).count.into())),
            E::Item(number) => V::Number(self.round_of(*number).element),
            E::Element(index) => V::Number(self.table[self.place(*index)]),
            E::Sum(of) => self.value(&of[0]).with(self.value(&of[1]), |a, b| a + b),
            E::Difference(of) => self.value(&of[0]).with(self.value(&of[1]), |a, b| a - b),
            E::Negative(of) => {
                let of = self.value(of);
                of.with(of, |a, _| -a)
            }
            E::Product(of) => match (self.value(&of[0]), self.value(&of[1])) {
                (V::Number(a), V::Number(b)) => V::Number(a * b),
                (V::Number(k), V::Vector(v)) => V::Vector(scaled(k, v)),
                (V::Number(k), V::Matrix(m)) => V::Matrix(m.map(|column| scaled(k, column))),
                (V::Matrix(m), V::Vector(v)) => V::Vector(image(m, v)),
                (V::Matrix(a), V::Matrix(b)) => V::Matrix(b.map(|column| image(a, column))),
                _ => unreachable!("no other product is written"),
            },
            E::Ratio(of) => {
                let b = number(&of[1]);
                V::Number(number(&of[0]) / (b * b + one))
            }
            E::Sine(of) => V::Number(number(of).call(Function::Sin)),
            E::Root(of) => {
                let a = number(of);
                V::Number((a * a + one).sqrt())
            }
            E::Dot(of) => V::Number(dot(vector(&of[0]), vector(&of[1]))),
            E::Cross(of) => V::Vector(cross(vector(&of[0]), vector(&of[1]))),
            E::Component(of, axis) => V::Number(vector(of)[*axis]),
            E::Column(of, axis) => V::Vector(matrix(of)[*axis]),
            E::Vector(of) => V::Vector([0, 1, 2].map(|i| number(&of[i]))),
            E::Columns(of) => V::Matrix([0, 1, 2].map(|i| vector(&of[i]))),
            E::Transpose(of) => {
                let m = matrix(of);
                V::Matrix([0, 1, 2].map(|i| [0, 1, 2].map(|k| m[k][i])))
            }
            E::Determinant(of) => {
                let [a, b, c] = matrix(of);
                V::Number(dot(a, cross(b, c)))
            }
            E::Turned(of) => {
                // v + 2 w (t × v) + 2 t × (t × v), after the step: v + step × v.
                let v = vector(of);
                let v = sum(v, cross(self.point.step, v));
                let [x, y, z, w] = self.point.turn;
                let (t, two) = ([x, y, z], T::constant(2.0));
                let once = cross(t, v);
                V::Vector(sum(v, sum(scaled(two * w, once), scaled(two, cross(t, once)))))
            }
        }
    }

    /// Runs a block; variables declared in it end with it.
    fn block(&mut self, statements: &[Statement]) -> ControlFlow<Left<T>> {
        let known = self.variables.each_ref().map(Vec::len);
        let end = statements.iter().try_for_each(|statement| self.step(statement));
        self.variables.iter_mut().zip(known).for_each(|(variables, known)| variables.truncate(known));
        end
    }

    fn is_less(&mut self, [a, b]: &[Expression; 2]) -> bool {
        let is_less = (self.compare)(self.value(a).number(), self.value(b).number());
        self.is_clear &= is_less.is_some();
        is_less.unwrap_or(false)
    }

    fn step(&mut self, statement: &Statement) -> ControlFlow<Left<T>> {
        match statement {
            Statement::Let(kind, to) => {
                let to = self.value(to);
                self.variables[*kind as usize].push(to);
            }
            Statement::Set(kind, number, to) => self.variables[*kind as usize][*number] = self.value(to),
            Statement::Increase(kind, number, by) => {
                let by = self.value(by);
                let place = &mut self.variables[*kind as usize][*number];
                *place = place.with(by, |a, b| a + b);
            }
            Statement::Add(index, by) => {
                let by = self.value(by).number();
                let place = self.place(*index);
                self.table[place] = self.table[place] + by;
            }
            Statement::Loop { count, way, number, body } => {
                let table = self.table;
                for round in 0..if *way == Way::Each { 3 } else { *count } {
                    let count = if *way == Way::Down { count - 1 - round } else { round };
                    self.rounds.push(Round { number: *number, count, element: table[usize::from(count)] });
                    let end = self.block(body);
                    self.rounds.pop();
                    match end {
                        Break(Left::Loop) => break,
                        Break(Left::Function(_)) => return end,
                        Break(Left::Round) | Continue(()) => {}
                    }
                }
            }
            Statement::Leave(condition, leave) => {
                let holds = match condition {
                    Condition::Less(compared) => self.is_less(compared),
                    Condition::Is(number, count) => self.round_of(*number).count == *count,
                };
                if holds {
                    return Break(match leave {
                        Leave::Break => Left::Loop,
                        Leave::Continue => Left::Round,
                        Leave::Return(result) => Left::Function(self.value(result).number()),
                    });
                }
            }
            Statement::If { less, then, otherwise } => {
                let is_less = self.is_less(less);
                return self.block(if is_less { then } else { otherwise });
            }
        }
        Continue(())
    }
}

impl Written {
    /// Returns the result at a point; `None` if a comparison was too close to decide.
    pub(super) fn result<T: Number>(&self, point: &Point<T>, compare: fn(T, T) -> Option<bool>) -> Option<T> {
        let variables = [
            vec![V::Number(point.x), V::Number(point.y)],
            vec![V::Vector(point.u), V::Vector(point.w)],
            vec![V::Matrix(point.matrix)],
        ];
        let mut run = Run { point, variables, table: point.table, rounds: Vec::new(), is_clear: true, compare };
        let result = match self.body.iter().try_for_each(|statement| run.step(statement)) {
            Break(Left::Function(result)) => result,
            _ => run.value(&self.result).number(),
        };
        run.is_clear.then_some(result)
    }
}
