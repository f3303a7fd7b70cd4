//! What `aim generate rigs/NAME.toml --lang rust -o src/checked_in/NAME.rs` wrote.

mod extra;
mod hero;

pub use extra::Extra;
pub use hero::Hero;
