//! Operation counts of derived programs, custom objectives, and the runtime's generated trajectory kernels.

mod counts;
mod objectives;
mod trajectory;
