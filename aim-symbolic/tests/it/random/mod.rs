//! Random statements over all kinds of nodes, judged exactly: modulo a large prime, where equal is equal.

mod bounded;
mod counts;
mod derivatives;
mod dual;
mod evaluate;
mod field;
mod judge;
mod material;
mod plain;
mod recipe;
mod rewriting;
mod steps;
mod values;
