//! Emits the bundled rigs of `rigs/*.toml` for `aim::rigs`; nothing without the feature `rigs`.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    #[cfg(feature = "rigs")]
    aim_codegen::build::Rigs::new("rigs").crate_path("crate").build();
}
