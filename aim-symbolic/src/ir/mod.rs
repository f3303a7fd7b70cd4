//! Expressions: typed nodes, hash-consed in one graph, with traversal and evaluation.

pub(crate) mod evaluate;
pub(crate) mod graph;
pub(crate) mod node;
pub(crate) mod number;
pub(crate) mod op;
pub(crate) mod order;
pub(crate) mod smooth;
pub(crate) mod table;
