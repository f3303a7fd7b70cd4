//! From statements to the smallest program: the passes in their order, and the few choices between them.

use crate::diff::sweep::{Course, Swept};
use crate::ir::node::Node;
use crate::lower::Effort;
use crate::rewrite::log::Log;
use crate::rewrite::rules::{
    self, ACROSS_FOR_CROSS, BASES, CANCELLING, COMMON_CROSS, COMMON_DOT, CONSTANT_SCALE, CROSS_OF_DOTS, DIRECTIONS,
    DROP_RADIAL, EXPAND_ACROSS, FRAMES, LIMITS, LINEAR_MAP, MATRIX, MERGE_SHARED, OPTIONAL, OTHER_SIDES, PRODUCTS,
    RATIOS, ROTATIONS, Rule, Rules, SCALES, SPREAD, TURN_INTO_ANGLE, WORDING,
};
use crate::{Function, Graph, Op, Placement, Program, Rotation, Scalar, ScalarNode, Variable, VectorNode};

/// What a program is asked for: a value, or one of its derivatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Want {
    /// The expression's value.
    Value(Scalar),
    /// The expression's derivative by a variable.
    Derivative(Scalar, Variable),
    /// The derivative by the first variable, by the second.
    Second(Scalar, Variable, Variable),
    /// Of all values r that are wanted together, the component of `Jᵀr` by the variable.
    Projected(Variable),
    /// The entry of `JᵀJ` by both.
    Normal(Variable, Variable),
}

impl Want {
    /// `values` and, after them, each value's derivatives by `variables`, value by value.
    pub fn all<V: Copy + Into<Variable>>(values: &[Scalar], variables: &[V]) -> Vec<Self> {
        let derivatives = values.iter().flat_map(|&v| variables.iter().map(move |&x| Self::Derivative(v, x.into())));
        values.iter().map(|&v| Self::Value(v)).chain(derivatives).collect()
    }

    /// What it is of; `None` of what is of all values.
    pub(crate) fn stated(self) -> Option<Scalar> {
        match self {
            Self::Value(stated) | Self::Derivative(stated, _) | Self::Second(stated, ..) => Some(stated),
            Self::Projected(_) | Self::Normal(..) => None,
        }
    }

    /// The variables by which first derivatives of all values are taken.
    fn of_all(self) -> impl Iterator<Item = Variable> {
        let variables = match self {
            Self::Projected(x) => [Some(x), None],
            Self::Normal(x, y) => [Some(x), Some(y)],
            _ => [None, None],
        };
        variables.into_iter().flatten()
    }
}

/// How derivatives are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sweep {
    /// From the values to the variables.
    Reverse(Placement),
    /// From the variables to the values.
    Forward,
}

/// One way through the choices.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Choices {
    sweep: Sweep,
    /// The variables by which derivatives are taken forward nevertheless.
    forward: Vec<Variable>,
    /// The rules that lose against their competitor.
    without: Vec<Rule>,
    /// How many rotations go to the other side of a dot.
    turned: Option<usize>,
    /// The rotations before which the calculation is done, in whose frame fewer vectors need them.
    kept: Vec<Rotation>,
}

impl Choices {
    fn first() -> Self {
        let sweep = Sweep::Reverse(Placement::Late);
        Self { sweep, forward: Vec::new(), without: OPTIONAL.to_vec(), turned: None, kept: Vec::new() }
    }
}

/// A program of so few operations is worth every rival.
const SMALL: usize = 100;

/// A program that is larger than another by less than one part in so many may become smaller by being arranged, and so may one no
/// larger than this; by numbers made of others, also one that is [`SMALL`].
const NEAR: usize = 2;
const MOST_PLAIN: usize = 300;

/// How many ways to share rotations between the sides of dots, and how many frames, are compared.
const MOST_SIDES: usize = 8;

impl Program {
    /// The program of `values` and, after them, of each value's derivatives by `variables`, value by value.
    pub fn derive<V: Copy + Into<Variable>>(g: &Graph, values: &[Scalar], variables: &[V]) -> Self {
        Self::derive_wanted(g, &Want::all(values, variables))
    }

    /// The program of just what is wanted, in that order.
    ///
    /// Where rules compete, the program of fewer operations and calls wins; on a tie that of fewer selects, then the
    /// shallower, then the first.
    #[must_use]
    pub fn derive_wanted(g: &Graph, wanted: &[Want]) -> Self {
        Self::derive_without(g, wanted, &[])
    }

    /// The same by the first way that offers itself, which need not be the smallest: a search is left out, all rules apply.
    pub fn derive_at_once(g: &Graph, wanted: &[Want]) -> Self {
        Way::taken(g, wanted, Choices::first(), &[], Log::default(), Effort::Compare).program.finished()
    }

    /// The same without these rules, to see what they are good for.
    #[must_use]
    pub fn derive_without(g: &Graph, wanted: &[Want], without: &[Rule]) -> Self {
        choose(g, wanted, without).0
    }
}

/// The smallest of the bounded number of programs that the choices lead to.
///
/// Each rival changes the best so far in one respect, and takes its place where its program is smaller. For a small program
/// every arrangement is compared, and what a choice made worthwhile is tried again. Beside them is the smallest by none but the rules
/// of arithmetic: rewriting may not lose against doing nothing.
pub(crate) fn choose(g: &Graph, wanted: &[Want], without: &[Rule]) -> (Program, Choices) {
    let (mut best, is_rewritten) = smallest(g, wanted, without, None);
    if is_rewritten || cfg!(not(aim_small)) && best.is_rewritten() {
        let off: Vec<Rule> = rules::of_sets().into_iter().chain(without.iter().copied()).collect();
        let (mut plain, _) = smallest(g, wanted, &off, Some(cost(&best.program).0));
        plain.choices.without.extend(off);
        best = best.or_better(plain);
    }
    (best.program.finished(), best.choices)
}

/// The smallest of the programs by the rules that apply, and whether any does; it is arranged as far as it may become smaller than
/// a `rival` of so many operations.
fn smallest(g: &Graph, wanted: &[Want], without: &[Rule], rival: Option<usize>) -> (Way, bool) {
    let mut best = Way::taken(g, wanted, Choices::first(), without, Log::default(), Effort::Compare);
    let (changes, is_rewritten) = (rivals(&best, wanted), best.is_rewritten());
    if best.is_small() {
        best.arrange(without, Effort::Finish);
        best = best.improved_again(&changes, g, wanted, without);
    } else {
        best = best.improved(&changes, g, wanted, without, Effort::Compare);
    }
    if rival.is_none_or(|rival| best.is_near(rival, MOST_PLAIN)) {
        best = best.polished(g, wanted, without, rival);
    }
    (best, is_rewritten)
}

/// The sweeps worth a try; by the way back where nothing speaks for another.
fn sweeps(wanted: &[Want]) -> Vec<Sweep> {
    let variables = variables(wanted);
    let values = distinct(wanted.iter().filter_map(|w| w.stated()));
    let mut sweeps = vec![Sweep::Reverse(Placement::Late)];
    if !variables.is_empty() {
        sweeps.push(Sweep::Reverse(Placement::Early));
        if variables.len() <= 2 * values.len() {
            sweeps.push(Sweep::Forward);
        }
    }
    sweeps
}

/// The variables by which first derivatives are wanted.
fn variables(wanted: &[Want]) -> Vec<Variable> {
    let by_one = wanted.iter().filter_map(|w| match *w {
        Want::Derivative(_, x) => Some(x),
        _ => None,
    });
    distinct(by_one.chain(wanted.iter().flat_map(|w| w.of_all())))
}

/// A way through the choices, and where it leads. Each starts from the statement anew: what a program looks like does not
/// depend on what else was tried.
#[derive(Clone)]
pub(crate) struct Way {
    choices: Choices,
    pub(crate) g: Graph,
    pub(crate) outputs: Vec<Scalar>,
    pub(crate) program: Program,
    /// The rules that were applied.
    pub(crate) log: Log,
}

impl Way {
    /// As far as the log lets rules be applied.
    pub(crate) fn taken(
        stated: &Graph,
        wanted: &[Want],
        choices: Choices,
        without: &[Rule],
        mut log: Log,
        effort: Effort,
    ) -> Self {
        let mut g = stated.clone();
        let outputs = rewritten(&mut g, wanted, &choices, without, &mut log);
        let program = compiled(&mut g, &outputs, &choices, without, effort);
        Self { choices, g, outputs, program, log }
    }

    fn is_small(&self) -> bool {
        cost(&self.program).0 <= SMALL
    }

    /// True if it has hardly more operations than a rival, or no more than `few`.
    fn is_near(&self, rival: usize, few: usize) -> bool {
        cost(&self.program).0 <= (rival + rival / NEAR).max(few)
    }

    /// True if a rule was applied, other than those of limits.
    fn is_rewritten(&self) -> bool {
        self.log.applied.iter().any(|done| !LIMITS.rules.contains(&done.rule))
    }

    /// The better of two; of equals the first.
    fn or_better(self, other: Self) -> Self {
        if cost(&other.program) < cost(&self.program) { other } else { self }
    }

    /// The way after every rival's try.
    fn improved(self, changes: &[Change], stated: &Graph, wanted: &[Want], without: &[Rule], effort: Effort) -> Self {
        changes.iter().fold(self, |best, change| {
            let mut choices = best.choices.clone();
            change(&mut choices);
            if choices == best.choices {
                return best;
            }
            best.or_better(Self::taken(stated, wanted, choices, without, Log::default(), effort))
        })
    }

    /// The same of a small program, with what a choice made worthwhile tried again.
    fn improved_again(self, changes: &[Change], stated: &Graph, wanted: &[Want], without: &[Rule]) -> Self {
        let before = cost(&self.program);
        let best = self.improved(changes, stated, wanted, without, Effort::Finish);
        if cost(&best.program) == before {
            return best;
        }
        best.improved(changes, stated, wanted, without, Effort::Finish)
    }

    /// The way arranged as well as can be; or with more derivatives taken forward, where that is smaller then.
    fn polished(mut self, stated: &Graph, wanted: &[Want], without: &[Rule], rival: Option<usize>) -> Self {
        if cfg!(aim_small) {
            self.arrange(without, Effort::Polish);
            return self;
        }
        let effort = if self.is_small() { Effort::Finish } else { Effort::Compare };
        let mut other = self.clone().improved(&self.forward(wanted, true), stated, wanted, without, effort);
        self.settle(without, rival);
        if other.choices == self.choices {
            return self;
        }
        other.settle(without, rival);
        self.or_better(other)
    }

    /// Arranges it as far as it may become smaller than a rival.
    fn settle(&mut self, without: &[Rule], rival: Option<usize>) {
        if let Some(rival) = rival {
            // What comes of it may not depend on the trial.
            let mut trial = self.clone();
            trial.arrange(without, Effort::Polish);
            if !trial.is_near(rival, SMALL) {
                return;
            }
        }
        self.arrange(without, Effort::Last { rival });
    }

    /// The rivals with a derivative taken forward: by numbers that sines and cosines are of, which are each other's derivatives;
    /// `others` are those by numbers of which there are none.
    fn forward(&self, wanted: &[Want], others: bool) -> Vec<Change> {
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
        let by = variables(wanted).into_iter().filter(|x| if others { is_number(x) && !turns(x) } else { turns(x) });
        let by = by.take(MOST_SIDES);
        by.map(|x| -> Change {
            Box::new(move |c| {
                if !c.forward.contains(&x) {
                    c.forward.push(x);
                }
            })
        })
        .collect()
    }

    /// The rival by matrices, where quaternions turn several vectors.
    fn by_matrices(&self) -> Option<Change> {
        (!self.g.busy_quaternions(&self.g.order(&self.outputs)).is_empty()).then(|| optional(MATRIX))
    }

    /// The rivals with products with one vector gathered, where there are cross products: those, also with what is gathered kept
    /// whole, then dot products, and matrices once more, which may pay only then.
    fn gathered(&self) -> Vec<Change> {
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

    /// Tries more arrangements of its sums and products.
    fn arrange(&mut self, without: &[Rule], effort: Effort) {
        self.program = compiled(&mut self.g, &self.outputs, &self.choices, without, effort);
    }
}

/// What a rival does differently.
type Change = Box<dyn Fn(&mut Choices)>;

/// Rules that gather cross products.
const CROSSES: [Rule; 2] = [CROSS_OF_DOTS, COMMON_CROSS];

/// With a rule that applies only where that is found to pay.
fn optional(rule: Rule) -> Change {
    Box::new(move |c| c.without.retain(|&off| off != rule))
}

/// The rivals worth a try, by what was applied on the first way.
fn rivals(first: &Way, wanted: &[Want]) -> Vec<Change> {
    let Way { g, outputs, log, .. } = first;
    let applied = |rules: &[Rule]| log.applied.iter().filter(|done| rules.contains(&done.rule)).count();
    let mut rivals: Vec<Change> = Vec::new();
    for sweep in sweeps(wanted) {
        rivals.push(Box::new(move |c| c.sweep = sweep));
    }
    if cfg!(not(aim_small)) {
        rivals.extend(first.forward(wanted, false));
    }
    // A rotation that left more than one direction may be dearer on the many sides than on the one.
    let innermost = distinct(g.cancelled().iter().rev().copied());
    if g.cancelled().len() > innermost.len() {
        for kept in (1..=innermost.len()).take(MOST_SIDES) {
            let kept = innermost[..kept].to_vec();
            rivals.push(Box::new(move |c| c.kept = kept.clone()));
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
    rivals.extend(first.by_matrices());
    if cfg!(not(aim_small)) {
        rivals.extend(first.gathered());
    }
    let is_rival = |rule: &Rule| [MERGE_SHARED, ACROSS_FOR_CROSS].contains(rule) || first.is_small();
    for rule in distinct(log.applied.iter().map(|done| done.rule)).into_iter().filter(is_rival) {
        rivals.push(Box::new(move |c| {
            if !LIMITS.rules.contains(&rule) && !c.without.contains(&rule) {
                c.without.push(rule);
            }
        }));
    }
    if applied(&CANCELLING) == 0 {
        for fewer in (0..applied(&OTHER_SIDES)).rev().take(MOST_SIDES) {
            rivals.push(Box::new(move |c| c.turned = Some(fewer)));
        }
    }
    rivals
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

fn compiled(g: &mut Graph, outputs: &[Scalar], choices: &Choices, without: &[Rule], effort: Effort) -> Program {
    let off: Vec<Rule> = without.iter().chain(&choices.without).copied().collect();
    Program::compile_with(g, outputs, &Rules { without: &off, turned: choices.turned }, effort)
}

/// What is wanted, rewritten by one way through the choices.
fn rewritten(g: &mut Graph, wanted: &[Want], choices: &Choices, without: &[Rule], log: &mut Log) -> Vec<Scalar> {
    let off: Vec<Rule> = without.iter().chain(&choices.without).copied().collect();
    let rules = Rules { without: &off, turned: choices.turned };
    let stated = distinct(wanted.iter().filter_map(|w| w.stated()));
    g.keep(&choices.kept);
    let limits = Rules { without, turned: None };
    let limited = g.rewrite_with(&stated, &LIMITS, &limits, log);
    let mut worded = g.rewrite_with(&limited, &WORDING, &rules, log);
    if !RATIOS.rules.is_empty() {
        // What is left of lengths may be worded, too.
        let plain = g.rewrite_with(&worded, &RATIOS, &rules, log);
        worded = if plain == worded { worded } else { g.rewrite_with(&plain, &WORDING, &rules, log) };
    }
    let mut values = g.rewrite_with(&worded, &ROTATIONS, &rules, log);
    if rules.has(&TURN_INTO_ANGLE) {
        values = g.rewrite_with(&values, &BASES, &rules, log);
    }
    (log.values, log.before_sweeps) = (values.clone(), log.applied.len());
    let value =
        |s: Scalar| values[stated.iter().position(|&known| known == s).expect("every wanted statement is here")];

    let mut firsts: Vec<((Scalar, Variable), Scalar)> = Vec::new();
    let by_variable = |want: &Want| match *want {
        Want::Derivative(s, x) | Want::Second(s, x, _) => Some((s, x)),
        _ => None,
    };
    let residuals = distinct(wanted.iter().filter_map(|want| match *want {
        Want::Value(s) => Some(s),
        _ => None,
    }));
    let of_all = wanted.iter().flat_map(|want| want.of_all());
    let of_all = of_all.flat_map(|x| residuals.iter().map(move |&s| (s, x)));
    let pairs = distinct(wanted.iter().filter_map(by_variable).chain(of_all));
    let goes_back = |x: &Variable| choices.sweep != Sweep::Forward && !choices.forward.contains(x);
    if let Sweep::Reverse(placement) = choices.sweep {
        for &s in &stated {
            let of = pairs.iter().filter(|(of, x)| *of == s && goes_back(x));
            let variables: Vec<Variable> = of.map(|(_, x)| *x).collect();
            if !variables.is_empty() {
                let (gradient, passages) = g.swept_back(value(s), &variables, placement);
                log.sweeps.push(Swept { course: Course::Back(value(s)), passages });
                firsts.extend(variables.iter().map(|&x| (s, x)).zip(gradient));
            }
        }
    }
    for x in distinct(pairs.iter().map(|(_, x)| *x).filter(|x| !goes_back(x))) {
        let of: Vec<Scalar> = pairs.iter().filter(|(_, by)| *by == x).map(|(s, _)| *s).collect();
        let values: Vec<Scalar> = of.iter().map(|&s| value(s)).collect();
        let (tangents, passages) = g.swept_forward(&values, x);
        log.sweeps.push(Swept { course: Course::Forward(x), passages });
        firsts.extend(of.iter().map(|&s| (s, x)).zip(tangents));
    }
    let first = |s: Scalar, x: Variable| {
        firsts.iter().find(|(key, _)| *key == (s, x)).map(|(_, d)| *d).expect("every wanted derivative was taken")
    };

    let mut seconds: Vec<(Want, Scalar)> = Vec::new();
    for &(s, x) in &pairs {
        let by: Vec<Variable> = wanted
            .iter()
            .filter_map(|w| match *w {
                Want::Second(of, a, b) if (of, a) == (s, x) => Some(b),
                _ => None,
            })
            .collect();
        // A module for the web takes first derivatives alone.
        if cfg!(not(aim_small)) && !by.is_empty() {
            let slope = g.rewrite_with(&[first(s, x)], &LIMITS, &limits, log);
            let slope = g.rewrite_with(&slope, &DIRECTIONS, &rules, log)[0];
            let gradient = g.gradient(slope, &by, Placement::Late);
            seconds.extend(by.into_iter().map(|y| Want::Second(s, x, y)).zip(gradient));
        }
    }

    let sum = |g: &mut Graph, factors: &dyn Fn(Scalar) -> (Scalar, Scalar)| {
        let products: Vec<Scalar> = residuals.iter().map(|&s| factors(s)).map(|(a, b)| g.mul(a, b)).collect();
        products.into_iter().reduce(|a, b| g.add(a, b)).unwrap_or_else(|| g.constant(0.0))
    };
    let outputs: Vec<Scalar> = wanted
        .iter()
        .map(|want| match *want {
            Want::Value(s) => value(s),
            Want::Derivative(s, x) => first(s, x),
            Want::Second(..) => {
                seconds.iter().find(|(key, _)| key == want).map(|(_, d)| *d).expect("every wanted derivative was taken")
            }
            Want::Projected(x) => sum(g, &|s| (value(s), first(s, x))),
            Want::Normal(x, y) => sum(g, &|s| (first(s, x), first(s, y))),
        })
        .collect();
    let outputs = g.at_rest(&outputs);
    log.derived.clone_from(&outputs);
    let mut outputs = g.rewrite_with(&outputs, &DIRECTIONS, &rules, log);
    if !choices.kept.is_empty() {
        outputs = g.rewrite_with(&outputs, &FRAMES, &rules, log);
    }
    let outputs = g.rewrite_with(&outputs, &SCALES, &rules, log);
    g.rewrite_with(&outputs, &PRODUCTS, &rules, log)
}
