//! Long formulas with names for their parts.

use std::collections::{HashMap, HashSet};

use super::expression::{self, Notation};
use super::formula::Formula;
use crate::ir::node::Node;
use crate::{Graph, Op, Scalar, ScalarNode, VectorNode};

/// Expressions in which repeated and long parts have names.
#[derive(Clone, Debug)]
pub struct NamedParts {
    /// Each named part with its symbol, after the parts on which it depends.
    pub definitions: Vec<(Node, Formula)>,
    /// The notation, extended by those symbols.
    pub notation: Notation,
}

impl NamedParts {
    /// Returns the equations that define the symbols.
    #[must_use]
    pub fn equations(&self, g: &Graph) -> Vec<(Formula, Formula)> {
        let equation =
            |(node, symbol): &(Node, Formula)| (symbol.clone(), expression::definition(g, *node, &self.notation));
        self.definitions.iter().map(equation).collect()
    }
}

/// Longest formula that is not named although it is used more than once.
const SHORT: usize = 3;

/// Longest formula that is not named if it is used once.
const LONG: usize = 16;

/// Names the parts of `outputs` that are used more than once or are long: vectors **a**₁, **a**₂, …, numbers k₁, k₂, …
#[must_use]
pub fn name_parts(g: &Graph, outputs: &[Scalar], notation: &Notation) -> NamedParts {
    let order = g.order(outputs);
    let mut uses: HashMap<Node, usize> = HashMap::new();
    for &node in &order {
        for part in g.parts(node) {
            // A direction is written as v/|v|, which contains its vector twice.
            let times = match node {
                Node::Vector(v) if matches!(g.vector_node(v), VectorNode::Normalize(_)) => 2,
                _ => 1,
            };
            *uses.entry(part).or_default() += times;
        }
    }
    let mut named = NamedParts { definitions: Vec::new(), notation: notation.clone() };
    let (mut vectors, mut scalars) = (0, 0);
    for &node in &order {
        let is_output = matches!(node, Node::Scalar(s) if outputs.contains(&s));
        if is_given(g, node) || is_output && !uses.contains_key(&node) {
            continue;
        }
        let length = expression::node(g, node, &named.notation).length();
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
            named.notation.parts.push((node, symbol.clone()));
            named.definitions.push((node, symbol));
        }
    }
    named
}

/// Returns `true` if the node is a symbol or a number already.
fn is_given(g: &Graph, node: Node) -> bool {
    match node {
        Node::Scalar(s) => matches!(g.scalar_node(s), ScalarNode::Op(Op::Input(_) | Op::Constant(_) | Op::Tiny)),
        Node::Vector(v) => match g.vector_node(v) {
            VectorNode::Components(c) => c.into_iter().all(|c| is_given(g, Node::Scalar(c))),
            _ => false,
        },
    }
}

/// States an application of a rule: both sides of the rewriting, with letters for their common parts.
///
/// Returns the two sides and the meanings of the letters.
#[must_use]
pub fn rewriting(g: &Graph, from: Node, to: Node, notation: &Notation) -> ([Formula; 2], Vec<(Formula, Formula)>) {
    let reachable = |root| -> HashSet<Node> { g.order_of_nodes(&[root]).into_iter().collect() };
    let (of_from, of_to) = (reachable(from), reachable(to));
    let mut letters = LetterNames { g, notation: notation.clone(), meanings: Vec::new(), vectors: 0, scalars: 0 };
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

struct LetterNames<'a> {
    g: &'a Graph,
    notation: Notation,
    meanings: Vec<(Formula, Formula)>,
    vectors: usize,
    scalars: usize,
}

impl LetterNames<'_> {
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
