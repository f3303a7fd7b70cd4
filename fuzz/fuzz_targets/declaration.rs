//! A declaration in TOML is either refused with errors that name the file, or compiled to Rust that parses.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let spec = match aim_codegen::declare::from_toml("rig.toml", text) {
        Ok(spec) => spec,
        Err(errors) => {
            let shown = errors.render();
            assert!(shown.starts_with("error: ") && shown.contains("--> rig.toml:"), "{shown}");
            return;
        }
    };
    // Longer chains are skipped: they are expensive to derive and have no errors of their own.
    if spec.joints.len() <= 2 {
        syn::parse2::<syn::File>(aim_codegen::rust_of(&spec, quote::quote!(::aim))).expect("emitted code is Rust");
    }
});
