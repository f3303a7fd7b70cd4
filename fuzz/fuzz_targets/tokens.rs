//! The item below `#[derive(AimRig)]`: whatever it is, the expansion is Rust.
#![no_main]

use libfuzzer_sys::{Corpus, fuzz_target};
use proc_macro2::TokenStream;

fuzz_target!(|text: &str| -> Corpus {
    // rustc and syn descend into brackets alike; how deep rustc lets an item go is not ours to test.
    if text.matches(['(', '[', '{', '<', '&', '*', '!', '-']).count() > 200 {
        return Corpus::Reject;
    }
    let Ok(tokens) = text.parse::<TokenStream>() else { return Corpus::Reject };
    syn::parse2::<syn::File>(aim_codegen::derive(tokens)).expect("an expansion is Rust");
    Corpus::Keep
});
