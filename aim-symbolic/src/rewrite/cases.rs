//! Distinguishes cases: states an expression that contains selects as one select.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::{Graph, Op, Scalar, ScalarNode};

/// Limit on the number of subexpressions; the cases of larger expressions are not distinguished.
const MOST_PARTS: usize = 200;

/// The operands of a comparison a < b.
pub(super) type Comparison = [Scalar; 2];

/// Returns the comparisons of the selects in `s`, each once; none if the expression is too large. Does not look into
/// functions of vectors.
pub(super) fn comparisons(g: &Graph, s: Scalar) -> Vec<Comparison> {
    let (mut found, mut known, mut order) = (Vec::new(), FxHashSet::from_iter([s]), vec![s]);
    let mut next = 0;
    while next < order.len() {
        if order.len() > MOST_PARTS {
            return Vec::new();
        }
        if let ScalarNode::Op(op) = g.scalar_node(order[next]) {
            if let Op::SelectLess(a, b, ..) = op
                && !found.contains(&[a, b])
            {
                found.push([a, b]);
            }
            order.extend(op.operands().filter(|&part| known.insert(part)));
        }
        next += 1;
    }
    found
}

/// Returns `a < b ? s : s`, each branch simplified by what it knows about the comparison.
pub(super) fn distinguished(g: &mut Graph, s: Scalar, [a, b]: Comparison) -> Scalar {
    let [then, otherwise] = [true, false].map(|holds| where_known(g, s, ([a, b], holds), &mut FxHashMap::default()));
    g.select_less(a, b, then, otherwise)
}

fn where_known(g: &mut Graph, s: Scalar, known: (Comparison, bool), done: &mut FxHashMap<Scalar, Scalar>) -> Scalar {
    if let Some(&done) = done.get(&s) {
        return done;
    }
    let made = match g.scalar_node(s) {
        ScalarNode::Op(Op::SelectLess(a, b, then, otherwise)) if [a, b] == known.0 => {
            where_known(g, if known.1 { then } else { otherwise }, known, done)
        }
        ScalarNode::Op(op) => {
            let op = op.map(|part| where_known(g, part, known, done));
            g.intern_scalar(ScalarNode::Op(op))
        }
        _ => s,
    };
    done.insert(s, made);
    made
}
