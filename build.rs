//! Emits the bundled rigs of `rigs/*.toml` for `aim::rigs`; nothing without the feature `rigs`.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    #[cfg(feature = "rigs")]
    rigs::emit();
}

#[cfg(feature = "rigs")]
mod rigs {
    use std::path::{Path, PathBuf};
    use std::{env, fs, process};

    pub(super) fn emit() {
        println!("cargo::rerun-if-changed=rigs");
        let mut files: Vec<PathBuf> = fs::read_dir("rigs")
            .expect("the package has a folder rigs")
            .map(|entry| entry.expect("the folder rigs can be listed").path())
            .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
            .collect();
        files.sort();
        let code: String = files.iter().map(|file| emit_file(file)).collect();
        let out = env::var_os("OUT_DIR").expect("cargo sets OUT_DIR for build scripts");
        fs::write(Path::new(&out).join("rigs.rs"), code).expect("OUT_DIR is writable");
    }

    fn emit_file(file: &Path) -> String {
        let text = fs::read_to_string(file).expect("a rig file is readable text");
        match aim_codegen::rust_from_toml(&file.display().to_string(), &text, "crate".parse().expect("it is a token")) {
            Ok(tokens) => aim_codegen::format_rust(tokens),
            Err(errors) => {
                eprintln!("{}", errors.render());
                process::exit(1);
            }
        }
    }
}
