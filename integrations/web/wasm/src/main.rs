//! Generates the JavaScript bindings of a compiled module: `aim-gaze-wasm MODULE.wasm FOLDER NAME` writes `NAME.js`,
//! `NAME.d.ts` and `NAME_bg.wasm` into the folder.

#[cfg(target_arch = "wasm32")]
fn main() {}

#[cfg(not(target_arch = "wasm32"))]
fn main() -> std::process::ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [module, folder, name] = &arguments[..] else {
        eprintln!("error: give MODULE.wasm FOLDER NAME");
        return std::process::ExitCode::from(2);
    };
    // No default module path, because the package locates the module itself.
    let mut bindgen = wasm_bindgen_cli_support::Bindgen::new();
    bindgen.input_path(module).out_name(name).typescript(true).omit_default_module_path(true);
    match bindgen.web(true).and_then(|bindgen| bindgen.generate(folder)) {
        Ok(()) => std::process::ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {module}: {error:#}");
            std::process::ExitCode::from(2)
        }
    }
}
