//! Long formulas with names for their parts.

use std::collections::{HashMap, HashSet};

use super::expression::{self, Notation};
use super::formula::Formula;
use crate::ir::node::Node;
use crate::{Graph, Op, Scalar, ScalarNode, VectorNode};

/// Expressions with names for the parts that are needed more than once.
#[derive(Clone, Debug)]
pub struct Defined {
    /// Each part with its symbol, after those that it is made of.
    pub definitions: Vec<(Node, Formula)>,
    /// The notation with those symbols.
    pub notation: Notation,
}

impl Defined {
    /// The equations that say what the symbols stand for.
    #[must_use]
    pub fn equations(&self, g: &Graph) -> Vec<(Formula, Formula)> {
        let equation =
            |(node, symbol): &(Node, Formula)| (symbol.clone(), expression::definition(g, *node, &self.notation));
        self.definitions.iter().map(equation).collect()
    }
}

/// So short a formula is not worth a name.
const SHORT: usize = 3;

/// So long a formula is not read in one go.
const LONG: usize = 16;

/// Names the parts of `outputs` that are needed more than once or are long: **a**₁, **a**₂, … the vectors, k₁, k₂, … the
/// numbers.
#[must_use]
pub fn defined(g: &Graph, outputs: &[Scalar], notation: &Notation) -> Defined {
    let order = g.order(outputs);
    let mut uses: HashMap<Node, usize> = HashMap::new();
    for &node in &order {
        for part in g.parts(node) {
            // A direction is written with its vector twice.
            let times = match node {
                Node::Vector(v) if matches!(g.vector_node(v), VectorNode::Normalize(_)) => 2,
                _ => 1,
            };
            *uses.entry(part).or_default() += times;
        }
    }
    let mut defined = Defined { definitions: Vec::new(), notation: notation.clone() };
    let (mut vectors, mut scalars) = (0, 0);
    for &node in &order {
        let is_output = matches!(node, Node::Scalar(s) if outputs.contains(&s));
        if is_given(g, node) || is_output && !uses.contains_key(&node) {
            continue;
        }
        let length = expression::node(g, node, &defined.notation).length();
        if (uses.get(&node).is_some_and(|&uses| uses > 1) && length > SHORT) || length > LONG {
            let symbol = match node {
                Node::Vector(_) => {
                    vectors += 1;
                    Formula::vector("a").numbered(vectors)
                }
                Node::Scalar(_) => {
                    scalars += 1;
                    Formula::italic("k").numbered(scalars)
                }
            };
            defined.notation.parts.push((node, symbol.clone()));
            defined.definitions.push((node, symbol));
        }
    }
    defined
}

/// Whether it is a symbol or a number already.
fn is_given(g: &Graph, node: Node) -> bool {
    match node {
        Node::Scalar(s) => matches!(g.scalar_node(s), ScalarNode::Op(Op::Input(_) | Op::Constant(_) | Op::Tiny)),
        Node::Vector(v) => match g.vector_node(v) {
            VectorNode::Components(c) => c.into_iter().all(|c| is_given(g, Node::Scalar(c))),
            _ => false,
        },
    }
}

/// Both sides of a rewriting, with letters for what they have in common: the rule as it was applied here.
///
/// Returns the two sides and what the letters stand for.
#[must_use]
pub fn rewriting(g: &Graph, from: Node, to: Node, notation: &Notation) -> ([Formula; 2], Vec<(Formula, Formula)>) {
    let reachable = |root| -> HashSet<Node> { g.order_of_nodes(&[root]).into_iter().collect() };
    let (of_from, of_to) = (reachable(from), reachable(to));
    let mut letters = Letters { g, notation: notation.clone(), meanings: Vec::new(), vectors: 0, scalars: 0 };
    let mut stack = vec![to, from];
    let mut seen = HashSet::new();
    while let Some(node) = stack.pop() {
        if !seen.insert(node) || is_given(g, node) {
            continue;
        }
        if of_from.contains(&node) && of_to.contains(&node) {
            letters.name(node);
        } else {
            stack.extend(g.parts(node).into_iter().rev());
        }
    }
    letters.notation.grouped = true;
    let sides = [from, to].map(|side| expression::node(g, side, &letters.notation));
    (sides, letters.meanings)
}

struct Letters<'a> {
    g: &'a Graph,
    notation: Notation,
    meanings: Vec<(Formula, Formula)>,
    vectors: usize,
    scalars: usize,
}

impl Letters<'_> {
    fn name(&mut self, node: Node) {
        let formula = expression::node(self.g, node, &self.notation);
        if formula.length() <= 1 {
            return;
        }
        let letter = |letters: &str, place: usize| {
            let letter = letters.chars().nth(place % letters.len()).map(String::from).unwrap_or_default();
            (letter, (place >= letters.len()).then_some(place / letters.len()))
        };
        let ((letter, index), symbol): (_, fn(&str) -> Formula) = match node {
            Node::Vector(_) => {
                self.vectors += 1;
                (letter("abcdegnqvwxyz", self.vectors - 1), Formula::vector)
            }
            Node::Scalar(_) => {
                self.scalars += 1;
                (letter("kmnqwxyz", self.scalars - 1), Formula::italic)
            }
        };
        let symbol = symbol(&letter);
        let symbol = index.map_or(symbol.clone(), |index| symbol.numbered(index));
        self.notation.parts.push((node, symbol.clone()));
        self.meanings.push((symbol, formula));
    }
}
