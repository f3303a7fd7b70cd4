//! The book-keeping of a derivation: what was rewritten into what, how derivatives were taken, which rules brought the
//! operation count from what to what, and what each step of the program computes.

use crate::diff::sweep::Swept;
use crate::ir::evaluate::Evaluation;
use crate::ir::node::Node;
use crate::lower::Effort;
use crate::program::derive::{Choices, Way, choose, distinct};
use crate::rewrite::log::{Log, Rewrite};
use crate::rewrite::rules::{ARITHMETIC, RESUBSTITUTE, Rule};
use crate::{Bindings, Count, Graph, InputKind, Program, Scalar, ScalarNode, Singular, Want};

/// Rules that together brought a program's operation count down.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// The rules in the order in which they were first applied, and how often each was.
    pub rules: Vec<(Rule, usize)>,
    /// The operations of the program if rewriting had stopped before it.
    pub before: Count,
    /// The operations of the program if rewriting had stopped after it.
    pub after: Count,
    /// How many rewrites had been made after it; 0 for the rules of arithmetic, which come first.
    pub rewrites: usize,
}

/// What of a part of an expression is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aspect {
    /// The number itself.
    Value,
    /// The number's square, of a length.
    Square,
    /// A component (0, 1, 2) of the vector.
    Component(u8),
}

/// What a step of a program computes: a part of the expression that it was made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Meaning {
    /// The part.
    pub node: Node,
    /// What of it.
    pub aspect: Aspect,
    /// Whether the step has the other sign.
    pub negated: bool,
}

/// A derivation from the statement to the program, with everything on the way.
#[derive(Clone, Debug)]
pub struct Derivation {
    /// Where all expressions are.
    pub graph: Graph,
    /// What was stated.
    pub stated: Vec<Scalar>,
    /// The same as derivatives were taken of it.
    pub values: Vec<Scalar>,
    /// How derivatives were taken.
    pub sweeps: Vec<Swept>,
    /// What was wanted, just after that.
    pub derived: Vec<Scalar>,
    /// What was wanted, before it is written in components.
    pub outputs: Vec<Scalar>,
    /// What was rewritten, in order.
    pub rewrites: Vec<Rewrite>,
    /// How many of those come before derivatives were taken.
    pub before_sweeps: usize,
    /// What brought the operation count down.
    pub steps: Vec<Step>,
    /// Where what was stated, or its derivatives, have no limit.
    pub singular: Vec<Singular>,
    /// Where it leads.
    pub program: Program,
    statement: Graph,
    wanted: Vec<Want>,
    choices: Choices,
}

impl Derivation {
    /// Derives the program of what is wanted, as [`Program::derive_wanted`] does, and keeps the books.
    ///
    /// Each step brings the count down that the program would have if rewriting had stopped there and derivatives had been
    /// taken of what was there. The first starts from the statement as it stands: every operation of it and of its
    /// derivatives is done, also those with 0 and 1.
    #[must_use]
    pub fn new(g: &Graph, wanted: &[Want]) -> Self {
        let (program, choices) = choose(g, wanted, &[]);
        let way = |log: Log, off: &[Rule]| Way::taken(g, wanted, choices.clone(), off, log, Effort::Polish);
        let count = |rewrites: usize, off: &[Rule]| way(Log::limited(rewrites), off).program.count();
        let Way { g: mut graph, outputs, log, .. } = way(Log::default(), &[]);
        let least = program.count().total();
        let mut book = Book { steps: Vec::new(), rules: Vec::new(), count: count(0, &ARITHMETIC), least };
        // The last rule is for programs that are done.
        for on in 1..ARITHMETIC.len() {
            book.record(ARITHMETIC[on - 1], 0, count(0, &ARITHMETIC[on..]));
            // What did nothing by itself is not part of what comes after it.
            book.rules.clear();
        }
        for (before, rewrite) in log.applied.iter().enumerate() {
            book.record(rewrite.rule, before + 1, count(before + 1, &[]));
        }
        book.record(RESUBSTITUTE, log.applied.len(), program.count());
        let stated = distinct(wanted.iter().filter_map(|want| want.stated()));
        let variables = distinct(wanted.iter().filter_map(|want| match *want {
            Want::Derivative(_, x) | Want::Second(_, x, _) => Some(x),
            _ => None,
        }));
        Self {
            singular: graph.singular_points(&log.values, &variables),
            graph,
            stated,
            values: log.values,
            sweeps: log.sweeps,
            derived: log.derived,
            outputs,
            rewrites: log.applied,
            before_sweeps: log.before_sweeps,
            steps: book.steps,
            program,
            statement: g.clone(),
            wanted: wanted.to_vec(),
            choices,
        }
    }

    /// What is wanted, if rewriting had stopped after so many rewrites.
    #[must_use]
    pub fn stopped_after(&self, rewrites: usize) -> (Graph, Vec<Scalar>) {
        let log = Log::limited(rewrites);
        let way = Way::taken(&self.statement, &self.wanted, self.choices.clone(), &[], log, Effort::Compare);
        (way.g, way.outputs)
    }

    /// For each of the program's [`steps`](Program::steps) the part of the [`outputs`](Self::outputs) that it computes;
    /// `None` for what is on the way to such a part.
    ///
    /// Parts and steps are matched by their values: what agrees for three random inputs to 1e-11 is the same. Factoring and
    /// sharing leave no node that both have.
    #[must_use]
    pub fn meanings(&self) -> Vec<Option<Meaning>> {
        let g = &self.graph;
        let mut parts: Vec<(Node, Aspect)> = Vec::new();
        for node in g.order(&self.outputs) {
            match node {
                Node::Scalar(s) => {
                    if matches!(g.scalar_node(s), ScalarNode::Norm(_)) {
                        parts.push((node, Aspect::Square));
                    }
                    parts.push((node, Aspect::Value));
                }
                Node::Vector(_) => parts.extend((0..3).map(|axis| (node, Aspect::Component(axis)))),
            }
        }
        let mut random = Random(0x9e37_79b9_7f4a_7c15);
        let points: Vec<(Vec<f64>, Vec<f64>)> = (0..3).map(|_| self.at_random(&parts, &mut random)).collect();
        let agree = |place: usize, part: usize, sign: f64| {
            points.iter().all(|(values, parts)| {
                let (value, part) = (values[place], sign * parts[part]);
                (value - part).abs() <= 1e-11 * value.abs().max(part.abs()).max(1e-3)
            })
        };
        let meaning = |place: usize| {
            let found = |sign| (0..parts.len()).find(|&part| agree(place, part, sign)).map(|part| (part, sign));
            let (part, sign) = found(1.0).or_else(|| found(-1.0))?;
            Some(Meaning { node: parts[part].0, aspect: parts[part].1, negated: sign < 0.0 })
        };
        (0..self.program.ops().len()).filter(|&place| self.program.is_step(place)).map(meaning).collect()
    }

    /// The values of the program's operations and of these parts for inputs at random.
    fn at_random(&self, parts: &[(Node, Aspect)], random: &mut Random) -> (Vec<f64>, Vec<f64>) {
        let g = &self.graph;
        let mut given = Vec::new();
        let mut angles = Vec::new();
        for (_, kind) in g.inputs() {
            match *kind {
                InputKind::Given => given.push(random.number()),
                InputKind::Sin(angle) => angles.push((angle, 3.0 * random.number())),
                InputKind::Cos(_) => {}
            }
        }
        let bindings = Bindings::new(g, &given, &angles);
        let mut evaluation = Evaluation::new(g, &bindings);
        let values = parts.iter().map(|&part| match part {
            (Node::Scalar(s), Aspect::Square) => evaluation.scalar(s).powi(2),
            (Node::Scalar(s), _) => evaluation.scalar(s),
            (Node::Vector(v), Aspect::Component(axis)) => evaluation.vector(v)[usize::from(axis)],
            (Node::Vector(_), _) => f64::NAN,
        });
        let values = values.collect();
        (self.program.values(bindings.inputs()), values)
    }
}

/// Numbers of no particular kind, the same in every run.
struct Random(u64);

impl Random {
    /// −1…1
    fn number(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        let high = u32::try_from(self.0 >> 32).unwrap_or_default();
        f64::from(high) / f64::from(u32::MAX) * 2.0 - 1.0
    }
}

impl Program {
    /// How rules led from the statement to the program: the steps of its [`Derivation`].
    #[must_use]
    pub fn trace(g: &Graph, wanted: &[Want]) -> Vec<Step> {
        Derivation::new(g, wanted).steps
    }
}

struct Book {
    steps: Vec<Step>,
    /// What was applied since the last step.
    rules: Vec<(Rule, usize)>,
    /// The least count so far.
    count: Count,
    /// That of the program: fewer operations on the way, where a later rule led elsewhere, are no step to it.
    least: usize,
}

impl Book {
    fn record(&mut self, rule: Rule, rewrites: usize, after: Count) {
        match self.rules.iter_mut().find(|(known, _)| *known == rule) {
            Some((_, times)) => *times += 1,
            None => self.rules.push((rule, 1)),
        }
        if (self.least..self.count.total()).contains(&after.total()) {
            let rules = core::mem::take(&mut self.rules);
            self.steps.push(Step { rules, before: self.count, after, rewrites });
            self.count = after;
        }
    }
}
