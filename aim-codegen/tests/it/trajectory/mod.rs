//! Kernels of a trajectory's cost: they need no more operations than the best hand-written versions, and the runtime's
//! file is up to date.
//!
//! `AIM_BLESS=1 cargo test -p aim-codegen --test it trajectory` rewrites `aim-runtime/src/trajectory/derived.rs`.

mod emit;
mod objective;

use std::path::Path;
use std::{env, fs};

use objective::TrajectoryPrograms;

const HEADER: &str = "//! Derived from the statement in `aim-codegen/tests/it/trajectory/objective.rs`; rewritten by\n\
                      //! `AIM_BLESS=1 cargo test -p aim-codegen --test it trajectory`. A point beside the chord of its neighbours.\n\n";

#[test]
fn the_trajectory_code_of_the_runtime_is_up_to_date() {
    let tokens = emit::emit(&TrajectoryPrograms::derive());
    let file = syn::parse2(tokens).expect("what is emitted is Rust");
    let found = HEADER.to_owned() + &prettyplease::unparse(&file);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../aim-runtime/src/trajectory/derived.rs");
    if env::var_os("AIM_BLESS").is_some_and(|bless| bless == "1") {
        fs::write(&path, &found).expect("the runtime's folder is writable");
    }
    let expected = fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
    assert!(
        expected == found,
        "aim-runtime/src/trajectory/derived.rs is not what is derived now. If the change is meant to be so:\n\
         AIM_BLESS=1 cargo test -p aim-codegen --test it trajectory"
    );
}

#[test]
fn the_term_and_its_nine_derivatives_take_58_operations() {
    let programs = TrajectoryPrograms::derive();
    assert_eq!(programs.term_gradient.outputs().len(), 10);
    assert!(programs.term_gradient.count().total() <= 58, "{}", programs.term_gradient.count());
    assert!(programs.place.count().total() <= 32, "{}", programs.place.count());
    println!("with second derivatives: {}", programs.rounded_term_hessian.count());
    assert_eq!(programs.rounded_term_hessian.outputs().len(), 55);
}
