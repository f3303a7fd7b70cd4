//! Nothing: `Cargo.toml` is what matters.
