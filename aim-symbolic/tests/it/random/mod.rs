//! Random statements over all kinds of nodes, compared exactly by arithmetic modulo a large prime.

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
