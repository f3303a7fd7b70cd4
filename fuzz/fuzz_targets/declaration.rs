//! A declaration in TOML: refused with reasons that name the file, or emitted as Rust that parses.
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
    // What a longer chain costs is measured elsewhere, and its errors are the same.
    if spec.joints.len() <= 2 {
        syn::parse2::<syn::File>(aim_codegen::rust_of(&spec, quote::quote!(::aim))).expect("emitted code is Rust");
    }
});
