//! The record of a derivation: every rewrite, the derivative sweeps, the rules that lowered the operation count, and
//! the meaning of each step of the program.

use crate::diff::sweep::SweepRecord;
use crate::ir::evaluate::Evaluation;
use crate::ir::node::Node;
use crate::lower::Effort;
use crate::program::derive::{Candidate, Choices, Problem, distinct};
use crate::rewrite::log::{Log, Rewrite};
use crate::rewrite::rules::{ARITHMETIC, RESUBSTITUTE, Rule};
use crate::{Bindings, Count, Graph, InputKind, Program, Scalar, ScalarNode, Singular, Want};

/// Rules that together lowered a program's operation count.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// The rules in order of first application, and the number of applications of each.
    pub rules: Vec<(Rule, usize)>,
    /// The operations of the program if rewriting had stopped before this step.
    pub before: Count,
    /// The operations of the program if rewriting had stopped after this step.
    pub after: Count,
    /// The number of rewrites up to the end of this step; 0 for the rules of arithmetic, which come first.
    pub rewrites: usize,
}

/// The aspect of an expression that a step computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aspect {
    /// The number itself.
    Value,
    /// The square of the number, which is a length.
    Square,
    /// A component (0, 1, 2) of the vector.
    Component(u8),
}

/// The meaning of a program's step: the part of the original expression that it computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Meaning {
    /// The part of the expression.
    pub node: Node,
    /// The aspect of the part.
    pub aspect: Aspect,
    /// `true` if the step has the opposite sign.
    pub negated: bool,
}

/// A derivation from the statement to the program, with all intermediate results.
#[derive(Clone, Debug)]
pub struct Derivation {
    /// The graph that holds all expressions.
    pub graph: Graph,
    /// The stated expressions.
    pub stated: Vec<Scalar>,
    /// The stated expressions as rewritten before differentiation.
    pub values: Vec<Scalar>,
    /// The derivative sweeps.
    pub sweeps: Vec<SweepRecord>,
    /// The wanted expressions immediately after differentiation.
    pub derived: Vec<Scalar>,
    /// The wanted expressions after all rewriting, before they are lowered to components.
    pub outputs: Vec<Scalar>,
    /// All rewrites, in order.
    pub rewrites: Vec<Rewrite>,
    /// The number of rewrites before differentiation.
    pub before_sweeps: usize,
    /// The steps that lowered the operation count.
    pub steps: Vec<Step>,
    /// The points at which the stated expressions or their derivatives have no limit.
    pub singular: Vec<Singular>,
    /// The resulting program.
    pub program: Program,
    statement: Graph,
    wanted: Vec<Want>,
    choices: Choices,
}

impl Derivation {
    /// Derives the program of what is wanted like [`Program::derive_wanted`] and records the derivation.
    ///
    /// Each step lowers the operation count of the program that would result if rewriting stopped there and derivatives
    /// were taken of the expressions at that point. The first step starts from the statement as it stands, where every
    /// operation of the statement and its derivatives counts, including those with 0 and 1.
    #[must_use]
    pub fn new(g: &Graph, wanted: &[Want]) -> Self {
        let problem = Problem { g, wanted, without: &[] };
        let (program, choices) = problem.smallest_program();
        let count = |rewrites: usize, without: &[Rule]| {
            let candidate =
                Problem { without, ..problem }.candidate(choices.clone(), Log::limited(rewrites), Effort::Polish);
            candidate.program.count()
        };
        let Candidate { g: mut graph, outputs, log, .. } =
            problem.candidate(choices.clone(), Log::default(), Effort::Polish);
        let least = program.count().total();
        let mut recorder = StepRecorder { steps: Vec::new(), rules: Vec::new(), count: count(0, &ARITHMETIC), least };
        // The last rule applies only to finished programs.
        for on in 1..ARITHMETIC.len() {
            recorder.record(ARITHMETIC[on - 1], 0, count(0, &ARITHMETIC[on..]));
            // A rule without effect of its own is not part of the step that follows.
            recorder.rules.clear();
        }
        for (before, rewrite) in log.applied.iter().enumerate() {
            recorder.record(rewrite.rule, before + 1, count(before + 1, &[]));
        }
        recorder.record(RESUBSTITUTE, log.applied.len(), program.count());
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
            steps: recorder.steps,
            program,
            statement: g.clone(),
            wanted: wanted.to_vec(),
            choices,
        }
    }

    /// Returns the wanted expressions as they would be if rewriting had stopped after this many rewrites.
    #[must_use]
    pub fn stopped_after(&self, rewrites: usize) -> (Graph, Vec<Scalar>) {
        let problem = Problem { g: &self.statement, wanted: &self.wanted, without: &[] };
        let candidate = problem.candidate(self.choices.clone(), Log::limited(rewrites), Effort::Compare);
        (candidate.g, candidate.outputs)
    }

    /// Returns for each of the program's [`steps`](Program::steps) the part of the [`outputs`](Self::outputs) that it
    /// computes, or `None` for an intermediate result.
    ///
    /// Parts and steps are matched by value, since factoring and sharing leave no common nodes: they count as equal if
    /// they agree to 1e-11 for three random inputs.
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

    /// Returns the values of the program's operations and of these parts for random inputs.
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

/// A pseudorandom generator (xorshift) with the same sequence in every run.
struct Random(u64);

impl Random {
    /// Returns a number in −1…1.
    fn number(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        let high = u32::try_from(self.0 >> 32).unwrap_or_default();
        f64::from(high) / f64::from(u32::MAX) * 2.0 - 1.0
    }
}

impl Program {
    /// Returns the steps of the program's [`Derivation`]: how rules led from the statement to the program.
    #[must_use]
    pub fn trace(g: &Graph, wanted: &[Want]) -> Vec<Step> {
        Derivation::new(g, wanted).steps
    }
}

struct StepRecorder {
    steps: Vec<Step>,
    /// The rules applied since the last step.
    rules: Vec<(Rule, usize)>,
    /// The lowest count so far.
    count: Count,
    /// The count of the final program. An intermediate count below it is not recorded as a step, as later rules lead
    /// elsewhere.
    least: usize,
}

impl StepRecorder {
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
