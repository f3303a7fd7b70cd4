//! Builds the viewer's web page: three files for any static web server.
//!
//! `cargo run -p aim-viewer-web -- OUT` compiles the viewer to WebAssembly and writes `index.html` and the files that
//! it loads to the folder OUT, by default `target/web`. It requires `rustup target add wasm32-unknown-unknown`.

#[cfg(target_arch = "wasm32")]
fn main() {}

#[cfg(not(target_arch = "wasm32"))]
fn main() -> std::process::ExitCode {
    let out = std::env::args_os().nth(1).map_or_else(|| "target/web".into(), std::path::PathBuf::from);
    match make::page(&out) {
        Ok(said) => {
            println!("{said}");
            std::process::ExitCode::SUCCESS
        }
        Err(trouble) => {
            eprintln!("error: {trouble}");
            std::process::ExitCode::from(2)
        }
    }
}

#[cfg(not(target_arch = "wasm32"))]
mod make {
    use std::path::{Path, PathBuf};
    use std::process::Command;

    const PAGE: &str = include_str!("../index.html");
    const TARGET: &str = "wasm32-unknown-unknown";

    /// Builds the page in `out`, and returns a message with the command to view it.
    pub(crate) fn page(out: &Path) -> Result<String, String> {
        let module = module()?;
        let mut bindgen = wasm_bindgen_cli_support::Bindgen::new();
        bindgen.input_path(&module).typescript(false).omit_default_module_path(false);
        bindgen.web(true).map_err(|error| error.to_string())?;
        bindgen.generate(out).map_err(|error| format!("{}: {error:#}", module.display()))?;
        let page = out.join("index.html");
        std::fs::write(&page, PAGE).map_err(|error| format!("{}: cannot be written ({error})", page.display()))?;
        Ok(format!("wrote {}; look at it with: python3 -m http.server -d {}", page.display(), out.display()))
    }

    /// Compiles the page's code to WebAssembly.
    fn module() -> Result<PathBuf, String> {
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let built = Command::new(&cargo)
            .args(["build", "--profile", "web", "--target", TARGET, "--package", "aim-viewer-web", "--lib"])
            .current_dir(&workspace)
            .status()
            .map_err(|error| format!("cargo cannot be started: {error}"))?;
        if !built.success() {
            return Err(format!("the viewer does not build for {TARGET}; was `rustup target add {TARGET}` run?"));
        }
        let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| workspace.join("target"), PathBuf::from);
        Ok(target.join(TARGET).join("web/aim_viewer_web.wasm"))
    }
}
