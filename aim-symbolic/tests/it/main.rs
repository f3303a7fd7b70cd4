//! The paper's appendix, and random statements over every kind of node.

mod paper;
mod random;
mod selects;
