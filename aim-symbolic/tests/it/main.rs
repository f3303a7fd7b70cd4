//! The paper's appendix, random statements over every kind of node, selects, and deep expressions.

mod deep;
mod paper;
mod random;
mod selects;
