//! Derives the smallest program of a statement: runs the passes in order and compares a bounded number of choices
//! between them.

use crate::diff::sweep::{SweepDirection, SweepRecord};
use crate::ir::node::Node;
use crate::lower::Effort;
use crate::rewrite::log::Log;
use crate::rewrite::rules::{
    self, ACROSS_FOR_CROSS, BASES, CANCELLING, COMMON_CROSS, COMMON_DOT, CONSTANT_SCALE, CROSS_OF_DOTS, DIRECTIONS,
    DROP_RADIAL, EXPAND_ACROSS, FORMULAS, FRAMES, LIMITS, LINEAR_MAP, MATRIX, MERGE_SHARED, OPTIONAL, OTHER_SIDES,
    PRODUCTS, RATIOS, ROTATIONS, Rule, Rules, SCALES, SPREAD, TURN_INTO_ANGLE, WORDING,
};
use crate::{Function, Graph, Op, Program, ReciprocalPlacement, Rotation, Scalar, ScalarNode, Variable, VectorNode};

/// An output of a program: a value, one of its derivatives, or a term of the normal equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Want {
    /// The expression's value.
    Value(Scalar),
    /// The expression's derivative by a variable.
    Derivative(Scalar, Variable),
    /// The second derivative, by the first variable and then by the second.
    Second(Scalar, Variable, Variable),
    /// The component by this variable of `Jᵀr`, with r all values that are wanted together.
    Projected(Variable),
    /// The entry by both variables of `JᵀJ`.
    Normal(Variable, Variable),
}

impl Want {
    /// Lists `values` and after them each value's derivatives by `variables`, value by value.
    pub fn all<V: Copy + Into<Variable>>(values: &[Scalar], variables: &[V]) -> Vec<Self> {
        let derivatives = values.iter().flat_map(|&v| variables.iter().map(move |&x| Self::Derivative(v, x.into())));
        values.iter().map(|&v| Self::Value(v)).chain(derivatives).collect()
    }

    /// Returns the expression that is wanted or differentiated; `None` if the output depends on all values.
    pub(crate) fn stated(self) -> Option<Scalar> {
        match self {
            Self::Value(stated) | Self::Derivative(stated, _) | Self::Second(stated, ..) => Some(stated),
            Self::Projected(_) | Self::Normal(..) => None,
        }
    }
}

/// The direction in which derivatives are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sweep {
    /// From the values to the variables.
    Reverse(ReciprocalPlacement),
    /// From the variables to the values.
    Forward,
}

/// One combination of choices.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Choices {
    sweep: Sweep,
    /// Variables by which derivatives are taken forward in any case.
    forward: Vec<Variable>,
    /// The rules that are switched off in favour of others.
    without: Vec<Rule>,
    /// Limit on the number of rotations that move to the other side of a dot product.
    max_other_side: Option<usize>,
    /// Rotations whose inner frame the calculation moves to, because fewer vectors are rotated there.
    inner_frames: Vec<Rotation>,
    /// Derivatives of quaternions' parts are those of their formulas, not of angular velocities.
    by_formulas: bool,
    /// Functions of one or two numbers are differentiated on their own, once for all sweeps.
    local: bool,
}

impl Choices {
    fn first() -> Self {
        let sweep = Sweep::Reverse(ReciprocalPlacement::Late);
        Self {
            sweep,
            forward: Vec::new(),
            without: OPTIONAL.to_vec(),
            max_other_side: None,
            inner_frames: Vec::new(),
            by_formulas: false,
            local: false,
        }
    }
}

/// Largest number of operations for which a program is compared with every rival.
const SMALL: usize = 100;

/// A program is near a rival if it has at most 1/`NEAR` more operations: arranging it may then still make it smaller.
const NEAR: usize = 2;
/// Largest number of operations for which a program counts as near any rival.
const MOST_PLAIN: usize = 300;
/// The same after a first arrangement.
const MOST_ARRANGED: usize = 150;

/// Limit on the number of variants compared for each choice: rotations moved between sides of dot products, frames,
/// variables.
const MOST_SIDES: usize = 8;

impl Program {
    /// Derives the program of `values` and, after them, of each value's derivatives by `variables`, value by value.
    pub fn derive<V: Copy + Into<Variable>>(g: &Graph, values: &[Scalar], variables: &[V]) -> Self {
        Self::derive_wanted(g, &Want::all(values, variables))
    }

    /// Derives the program of exactly what is wanted, in that order.
    ///
    /// Where rules compete, the program with fewer operations and calls wins; on a tie the one with fewer selects, then
    /// the one with less depth, then the first.
    #[must_use]
    pub fn derive_wanted(g: &Graph, wanted: &[Want]) -> Self {
        Self::derive_without(g, wanted, &[])
    }

    /// Derives a program by the default choices, without a search. All rules but the optional ones apply; the program
    /// need not be the smallest.
    pub fn derive_at_once(g: &Graph, wanted: &[Want]) -> Self {
        Problem { g, wanted, without: &[] }.first_candidate().program.finished()
    }

    /// Derives the smallest program without these rules, to see their effect.
    #[must_use]
    pub fn derive_without(g: &Graph, wanted: &[Want], without: &[Rule]) -> Self {
        Problem { g, wanted, without }.smallest_program().0
    }
}

/// The statement from which programs are derived.
#[derive(Clone, Copy)]
pub(crate) struct Problem<'a> {
    pub(crate) g: &'a Graph,
    pub(crate) wanted: &'a [Want],
    /// Rules that do not apply, whatever the choices.
    pub(crate) without: &'a [Rule],
}

impl<'a> Problem<'a> {
    /// Returns the smallest of a bounded number of programs, and the choices that lead to it.
    ///
    /// Each rival changes the best program so far in one respect, and replaces it if the result is smaller. For a small
    /// program every arrangement is compared, and all rivals are tried again after an improvement. The result is also
    /// compared with the smallest program by the rules of arithmetic alone, so that rewriting never makes a program
    /// larger.
    pub(crate) fn smallest_program(self) -> (Program, Choices) {
        let (best, is_rewritten) = self.smallest(None);
        if is_rewritten || cfg!(not(aim_small)) && best.is_rewritten() {
            let off: Vec<Rule> = rules::of_sets().into_iter().chain(self.without.iter().copied()).collect();
            let (mut plain, _) = Problem { without: &off, ..self }.smallest(Some(cost(&best.program).0));
            if cost(&plain.program) < cost(&best.program) {
                plain.choices.without.extend(&off);
                return (plain.program.finished(), plain.choices);
            }
        }
        (best.program.finished(), best.choices)
    }

    /// Returns the smallest program by the rules that apply, and whether any rule was applied. Polishes it unless it is
    /// too large to become smaller than a `rival` with this number of operations.
    fn smallest(self, rival: Option<usize>) -> (Candidate<'a>, bool) {
        let mut best = self.first_candidate();
        let (changes, is_rewritten) = (best.rivals(), best.is_rewritten());
        if best.is_small() {
            best.arrange(Effort::Finish);
            best = best.improve_twice(&changes);
        } else {
            best = best.improve(&changes, Effort::Compare);
        }
        if rival.is_none_or(|rival| best.is_near(rival, MOST_PLAIN)) {
            best = best.polish(rival);
        }
        (best, is_rewritten)
    }

    /// Returns the result of the default choices.
    fn first_candidate(self) -> Candidate<'a> {
        self.candidate(Choices::first(), Log::default(), Effort::Compare)
    }

    /// Rewrites and compiles the statement by these choices, as far as the log's limit permits.
    pub(crate) fn candidate(self, choices: Choices, mut log: Log, effort: Effort) -> Candidate<'a> {
        let mut g = self.g.clone();
        let outputs = self.rewritten(&mut g, &choices, &mut log);
        let program = self.compiled(&mut g, &outputs, &choices, effort);
        Candidate { problem: self, choices, g, outputs, program, log }
    }

    /// Returns the sweeps worth trying, starting with the reverse sweep, the default.
    fn sweeps(self) -> Vec<Sweep> {
        let variables = self.variables();
        let mut sweeps = vec![Sweep::Reverse(ReciprocalPlacement::Late)];
        if !variables.is_empty() {
            sweeps.push(Sweep::Reverse(ReciprocalPlacement::Early));
            if variables.len() <= 2 * self.stated().len() {
                sweeps.push(Sweep::Forward);
            }
        }
        sweeps
    }

    /// Returns the expressions that are wanted or differentiated.
    fn stated(self) -> Vec<Scalar> {
        distinct(self.wanted.iter().filter_map(|want| want.stated()))
    }

    /// Returns the variables by which first derivatives are required.
    fn variables(self) -> Vec<Variable> {
        let by_one = self.wanted.iter().filter_map(|want| match *want {
            Want::Derivative(_, x) => Some(x),
            _ => None,
        });
        distinct(by_one.chain(self.variables_of_all()))
    }

    /// Returns the variables by which first derivatives of all values are required.
    fn variables_of_all(self) -> Vec<Variable> {
        distinct(self.wanted.iter().flat_map(|want| match *want {
            Want::Projected(x) => vec![x],
            Want::Normal(x, y) => vec![x, y],
            _ => Vec::new(),
        }))
    }

    /// Returns the vectors whose components are all variables.
    fn vectors_of(self, variables: &[Variable]) -> Vec<Vec<Variable>> {
        let components = |node: Node| match node {
            Node::Vector(v) => match self.g.vector_node(v) {
                VectorNode::Components(c) => Some(c.map(Variable::Input).to_vec()),
                _ => None,
            },
            Node::Scalar(_) => None,
        };
        let all = self.g.order(&self.stated()).into_iter().filter_map(components);
        all.filter(|c| c.iter().all(|x| variables.contains(x))).collect()
    }

    /// Returns the rules that the problem or the choices switch off.
    fn off(self, choices: &Choices) -> Vec<Rule> {
        self.without.iter().chain(&choices.without).copied().collect()
    }

    fn compiled(self, g: &mut Graph, outputs: &[Scalar], choices: &Choices, effort: Effort) -> Program {
        let rules = Rules { without: &self.off(choices), max_other_side: choices.max_other_side };
        Program::compile_with(g, outputs, &rules, effort)
    }

    /// Returns the wanted expressions, rewritten by these choices.
    fn rewritten(self, g: &mut Graph, choices: &Choices, log: &mut Log) -> Vec<Scalar> {
        let rules = Rules { without: &self.off(choices), max_other_side: choices.max_other_side };
        let limits = Rules { without: self.without, max_other_side: None };
        g.set_inner_frames(&choices.inner_frames);
        let stated = self.stated();
        let formulas = if choices.by_formulas { g.rewrite_by(&stated, &FORMULAS) } else { stated.clone() };
        let limited = g.rewrite_with(&formulas, &LIMITS, &limits, log);
        let mut worded = g.rewrite_with(&limited, &WORDING, &rules, log);
        if !RATIOS.rules.is_empty() {
            // Dropping lengths may leave expressions that can be restated again.
            let plain = g.rewrite_with(&worded, &RATIOS, &rules, log);
            worded = if plain == worded { worded } else { g.rewrite_with(&plain, &WORDING, &rules, log) };
        }
        let mut values = g.rewrite_with(&worded, &ROTATIONS, &rules, log);
        if rules.has(&TURN_INTO_ANGLE) {
            values = g.rewrite_with(&values, &BASES, &rules, log);
        }
        (log.values, log.before_sweeps) = (values.clone(), log.applied.len());

        let mut derived = Derived(stated.into_iter().map(Want::Value).zip(values).collect());
        let residuals = distinct(self.wanted.iter().filter_map(|want| match *want {
            Want::Value(s) => Some(s),
            _ => None,
        }));
        let by_one = self.wanted.iter().filter_map(|want| match *want {
            Want::Derivative(s, x) | Want::Second(s, x, _) => Some((s, x)),
            _ => None,
        });
        let of_all = self.variables_of_all().into_iter().flat_map(|x| residuals.iter().map(move |&s| (s, x)));
        let pairs = distinct(by_one.chain(of_all));
        derived.take_first(g, &pairs, choices, log);
        for (_, slope) in derived.0.iter_mut().filter(|(want, _)| matches!(want, Want::Derivative(..))) {
            *slope = g.without_slopes_of_roots(*slope, &limits, log);
        }
        for &(s, x) in &pairs {
            let by = |want: &Want| match *want {
                Want::Second(of, a, b) if (of, a) == (s, x) => Some(b),
                _ => None,
            };
            let by: Vec<Variable> = self.wanted.iter().filter_map(by).collect();
            // Builds with `aim_small` take only first derivatives.
            if cfg!(not(aim_small)) && !by.is_empty() {
                let slope = g.rewrite_with(&[derived.get(Want::Derivative(s, x))], &LIMITS, &limits, log);
                let slope = g.rewrite_with(&slope, &DIRECTIONS, &rules, log)[0];
                let gradient = g.gradient(slope, &by, ReciprocalPlacement::Late);
                for (y, second) in by.into_iter().zip(gradient) {
                    derived.0.push((Want::Second(s, x, y), g.without_slopes_of_roots(second, &limits, log)));
                }
            }
        }

        let sum = |g: &mut Graph, factors: &dyn Fn(Scalar) -> [Want; 2]| {
            let factors = residuals.iter().map(|&s| factors(s).map(|want| derived.get(want)));
            let products: Vec<Scalar> = factors.map(|[a, b]| g.mul(a, b)).collect();
            products.into_iter().reduce(|a, b| g.add(a, b)).unwrap_or_else(|| g.constant(0.0))
        };
        let output = |want: &Want| match *want {
            Want::Projected(x) => sum(g, &|s| [Want::Value(s), Want::Derivative(s, x)]),
            Want::Normal(x, y) => sum(g, &|s| [Want::Derivative(s, x), Want::Derivative(s, y)]),
            want => derived.get(want),
        };
        let outputs: Vec<Scalar> = self.wanted.iter().map(output).collect();
        let outputs = g.at_rest(&outputs);
        log.derived.clone_from(&outputs);
        let mut outputs = g.rewrite_with(&outputs, &DIRECTIONS, &rules, log);
        if !choices.inner_frames.is_empty() {
            outputs = g.rewrite_with(&outputs, &FRAMES, &rules, log);
        }
        let outputs = g.rewrite_with(&outputs, &SCALES, &rules, log);
        g.rewrite_with(&outputs, &PRODUCTS, &rules, log)
    }
}

/// Expressions with their derivatives, as far as they have been taken.
struct Derived(Vec<(Want, Scalar)>);

impl Derived {
    fn get(&self, want: Want) -> Scalar {
        self.0.iter().find(|(known, _)| *known == want).map(|(_, s)| *s).expect("everything wanted was derived")
    }

    /// Adds the first derivatives of these expressions by these variables.
    fn take_first(&mut self, g: &mut Graph, pairs: &[(Scalar, Variable)], choices: &Choices, log: &mut Log) {
        let is_reverse = |x: &Variable| choices.sweep != Sweep::Forward && !choices.forward.contains(x);
        if let Sweep::Reverse(placement) = choices.sweep {
            let reverse: Vec<_> = pairs.iter().filter(|(_, x)| is_reverse(x)).collect();
            for s in distinct(reverse.iter().map(|(s, _)| *s)) {
                let by: Vec<Variable> = reverse.iter().filter(|(of, _)| *of == s).map(|(_, x)| *x).collect();
                let value = self.get(Want::Value(s));
                let (gradient, visited) = g.sweep_backward(value, &by, placement, choices.local);
                log.sweeps.push(SweepRecord { direction: SweepDirection::Backward(value), visited });
                self.0.extend(by.into_iter().map(|x| Want::Derivative(s, x)).zip(gradient));
            }
        }
        for x in distinct(pairs.iter().map(|(_, x)| *x).filter(|x| !is_reverse(x))) {
            let of: Vec<Scalar> = pairs.iter().filter(|(_, by)| *by == x).map(|(s, _)| *s).collect();
            let values: Vec<Scalar> = of.iter().map(|&s| self.get(Want::Value(s))).collect();
            let (tangents, visited) = g.sweep_forward(&values, x, choices.local);
            log.sweeps.push(SweepRecord { direction: SweepDirection::Forward(x), visited });
            self.0.extend(of.into_iter().map(|s| Want::Derivative(s, x)).zip(tangents));
        }
    }
}

/// A combination of choices and its result. Each starts anew from the statement, so that a program does not depend on
/// what else was tried.
#[derive(Clone)]
pub(crate) struct Candidate<'a> {
    problem: Problem<'a>,
    choices: Choices,
    pub(crate) g: Graph,
    pub(crate) outputs: Vec<Scalar>,
    pub(crate) program: Program,
    /// The rules that were applied.
    pub(crate) log: Log,
}

impl Candidate<'_> {
    fn is_small(&self) -> bool {
        cost(&self.program).0 <= SMALL
    }

    /// Returns `true` if the program is not much larger than a rival, or has at most `few` operations.
    fn is_near(&self, rival: usize, few: usize) -> bool {
        cost(&self.program).0 <= (rival + rival / NEAR).max(few)
    }

    /// Returns `true` if any rule was applied, other than those of limits.
    fn is_rewritten(&self) -> bool {
        self.log.applied.iter().any(|done| !LIMITS.rules.contains(&done.rule))
    }

    /// Returns the better of the two, or the first if they are equal.
    fn better_of(self, other: Self) -> Self {
        if cost(&other.program) < cost(&self.program) { other } else { self }
    }

    /// Tries every rival in turn and returns the best.
    fn improve(self, changes: &[Change], effort: Effort) -> Self {
        changes.iter().fold(self, |best, change| {
            let mut choices = best.choices.clone();
            change(&mut choices);
            if choices == best.choices {
                return best;
            }
            let rival = best.problem.candidate(choices, Log::default(), effort);
            best.better_of(rival)
        })
    }

    /// Tries every rival of a small program, and if that improves it, all of them once more.
    fn improve_twice(self, changes: &[Change]) -> Self {
        let before = cost(&self.program);
        let best = self.improve(changes, Effort::Finish);
        if cost(&best.program) == before {
            return best;
        }
        best.improve(changes, Effort::Finish)
    }

    /// Returns the program with the best arrangement, or a variant with more derivatives taken forward if that is
    /// smaller.
    fn polish(mut self, rival: Option<usize>) -> Self {
        if cfg!(aim_small) {
            self.arrange(Effort::Polish);
            return self;
        }
        let effort = if self.is_small() { Effort::Finish } else { Effort::Compare };
        let mut other = self.clone().improve(&self.forward_changes(true), effort);
        self.arrange_if_competitive(rival);
        if other.choices == self.choices {
            return self;
        }
        other.arrange_if_competitive(rival);
        self.better_of(other)
    }

    /// Arranges the program, unless it is too large to become smaller than a rival.
    fn arrange_if_competitive(&mut self, rival: Option<usize>) {
        if let Some(rival) = rival {
            // The result must not depend on the trial.
            let mut trial = self.clone();
            trial.arrange(Effort::Polish);
            if !trial.is_near(rival, MOST_ARRANGED) {
                return;
            }
        }
        self.arrange(Effort::Last { rival });
    }

    /// Returns `true` if slopes were replaced by expressions with their limits. Taken forward, they are sums whose limits
    /// are not found.
    fn has_limits_of_slopes(&self) -> bool {
        let of_slopes = self.log.applied.iter().skip(self.log.before_sweeps);
        of_slopes.into_iter().any(|done| LIMITS.rules.contains(&done.rule))
    }

    /// Returns the rivals that take derivatives forward: by the variables on which the arguments of sines and cosines
    /// depend, since these are each other's derivatives, or with `others` by the remaining numbers; and by all components
    /// of a vector, whose slopes share what those of a single one would compute in addition.
    fn forward_changes(&self, others: bool) -> Vec<Change> {
        let g = &self.g;
        let is_turn = |node: &Node| match *node {
            Node::Scalar(s) => match g.scalar_node(s) {
                ScalarNode::Op(Op::Call(Function::Sin | Function::Cos, a)) => Some(Node::Scalar(a)),
                _ => None,
            },
            Node::Vector(_) => None,
        };
        let arguments: Vec<Node> = g.order(&self.outputs).iter().filter_map(is_turn).collect();
        let turns = |x: &Variable| arguments.iter().any(|&a| g.depends_on(a, &[*x]));
        let is_number = |x: &Variable| matches!(x, Variable::Input(_));
        let has_limits = self.has_limits_of_slopes();
        let is_chosen = |x: &Variable| !has_limits && if others { is_number(x) && !turns(x) } else { turns(x) };
        let variables = self.problem.variables();
        let alone = variables.iter().filter(|x| is_chosen(x)).take(MOST_SIDES).map(|&x| vec![x]);
        let vectors =
            if (others || !self.is_small()) && !has_limits { self.problem.vectors_of(&variables) } else { Vec::new() };
        let by = vectors.into_iter().take(MOST_SIDES).chain(alone);
        by.map(|by| -> Change {
            Box::new(move |c| {
                for &x in &by {
                    if !c.forward.contains(&x) {
                        c.forward.push(x);
                    }
                }
            })
        })
        .collect()
    }

    /// Returns the rival that uses matrices, if quaternions rotate several vectors.
    fn matrix_change(&self) -> Option<Change> {
        (!self.g.busy_quaternions(&self.g.order(&self.outputs)).is_empty()).then(|| optional(MATRIX))
    }

    /// Returns the rivals that gather products with a common vector, if there are several cross products: first cross
    /// products, also without [`DROP_RADIAL`], which would take the gathered sums apart; then dot products, and
    /// matrices again, which may pay only then.
    fn gathering_changes(&self) -> Vec<Change> {
        let is_cross =
            |node: &Node| matches!(*node, Node::Vector(v) if matches!(self.g.vector_node(v), VectorNode::Cross(..)));
        if self.g.order(&self.outputs).iter().filter(|node| is_cross(node)).count() < 2 {
            return Vec::new();
        }
        let with: Change = Box::new(|c| c.without.retain(|off| !CROSSES.contains(off)));
        let whole: Change = Box::new(|c| {
            c.without.retain(|off| !CROSSES.contains(off));
            c.without.push(DROP_RADIAL);
        });
        vec![optional(LINEAR_MAP), with, whole, optional(COMMON_DOT), optional(LINEAR_MAP)]
    }

    /// Compiles the program again, with more arrangements of its sums and products.
    fn arrange(&mut self, effort: Effort) {
        self.program = self.problem.compiled(&mut self.g, &self.outputs, &self.choices, effort);
    }

    /// Returns the rivals worth trying, judged by the rules that were applied.
    fn rivals(&self) -> Vec<Change> {
        let Self { g, outputs, log, .. } = self;
        let applied = |rules: &[Rule]| log.applied.iter().filter(|done| rules.contains(&done.rule)).count();
        let mut rivals: Vec<Change> = Vec::new();
        if cfg!(not(aim_small)) && self.problem.g.has_quaternion_parts() {
            rivals.push(Box::new(|c| c.by_formulas = true));
        }
        for sweep in self.problem.sweeps() {
            if sweep != Sweep::Forward || !self.has_limits_of_slopes() {
                rivals.push(Box::new(move |c| c.sweep = sweep));
            }
        }
        if cfg!(not(aim_small)) {
            rivals.extend(self.forward_changes(false));
        }
        // A rotation that cancelled beside several directions may cost more on the many other sides than it saved.
        let innermost = distinct(g.cancelled().iter().rev().copied());
        if g.cancelled().len() > innermost.len() {
            for count in (1..=innermost.len()).take(MOST_SIDES) {
                let frames = innermost[..count].to_vec();
                rivals.push(Box::new(move |c| c.inner_frames = frames.clone()));
            }
        }
        if applied(&[EXPAND_ACROSS]) > 0 {
            rivals.push(optional(SPREAD));
        }
        if g.has_general_basis(outputs) {
            rivals.push(optional(TURN_INTO_ANGLE));
        }
        if g.has_constant_direction(outputs) {
            rivals.push(optional(CONSTANT_SCALE));
        }
        if cfg!(not(aim_small)) && self.problem.stated().len() > 1 {
            rivals.push(Box::new(|c| c.local = true));
        }
        rivals.extend(self.matrix_change());
        if cfg!(not(aim_small)) {
            rivals.extend(self.gathering_changes());
        }
        let is_rival = |rule: &Rule| [MERGE_SHARED, ACROSS_FOR_CROSS].contains(rule) || self.is_small();
        for rule in distinct(log.applied.iter().map(|done| done.rule)).into_iter().filter(is_rival) {
            rivals.push(Box::new(move |c| {
                if !LIMITS.rules.contains(&rule) && !c.without.contains(&rule) {
                    c.without.push(rule);
                }
            }));
        }
        if applied(&CANCELLING) == 0 {
            for fewer in (0..applied(&OTHER_SIDES)).rev().take(MOST_SIDES) {
                rivals.push(Box::new(move |c| c.max_other_side = Some(fewer)));
            }
        }
        rivals
    }
}

/// The choice that a rival changes.
type Change = Box<dyn Fn(&mut Choices)>;

/// Rules that gather cross products.
const CROSSES: [Rule; 2] = [CROSS_OF_DOTS, COMMON_CROSS];

/// Returns the rival that uses an optional rule.
fn optional(rule: Rule) -> Change {
    Box::new(move |c| c.without.retain(|&off| off != rule))
}

fn cost(program: &Program) -> (usize, usize, usize) {
    let count = program.count();
    (count.total() + count.call, count.select, program.depth())
}

pub(crate) fn distinct<T: PartialEq>(all: impl Iterator<Item = T>) -> Vec<T> {
    let mut found = Vec::new();
    for one in all {
        if !found.contains(&one) {
            found.push(one);
        }
    }
    found
}
