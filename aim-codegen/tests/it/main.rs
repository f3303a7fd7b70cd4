//! Operation counts of derived programs, and the checked-in code that is generated.

mod counts;
mod objectives;
mod trajectory;
