//! The item under `#[derive(AimRig)]`: the expansion of any tokens is valid Rust.
#![no_main]

use libfuzzer_sys::{Corpus, fuzz_target};
use proc_macro2::TokenStream;

fuzz_target!(|text: &str| -> Corpus {
    // rustc and syn recurse into brackets alike; the nesting that they can take is not tested here.
    if text.matches(['(', '[', '{', '<', '&', '*', '!', '-']).count() > 200 {
        return Corpus::Reject;
    }
    let Ok(tokens) = text.parse::<TokenStream>() else { return Corpus::Reject };
    syn::parse2::<syn::File>(aim_codegen::derive(tokens)).expect("an expansion is Rust");
    Corpus::Keep
});
