//! Expressions: typed nodes, hash-consed in one graph, what they are made of and what they are worth.

pub(crate) mod evaluate;
pub(crate) mod graph;
pub(crate) mod node;
pub(crate) mod number;
pub(crate) mod op;
pub(crate) mod order;
pub(crate) mod smooth;
pub(crate) mod table;
