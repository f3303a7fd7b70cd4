//! Tests: the paper's appendix, random statements over every kind of node, selects, deep expressions, and single rules.

mod deep;
mod paper;
mod random;
mod resubstitution;
mod rules;
mod selects;
