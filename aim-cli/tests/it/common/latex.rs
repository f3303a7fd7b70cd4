//! Checks of LaTeX output.

use std::process::Command;

use super::Place;

/// Asserts that environments and braces are balanced and the document ends.
#[track_caller]
pub(crate) fn assert_balanced(text: &str, name: &str) {
    let mut open = Vec::new();
    for part in text.split('\\').skip(1) {
        if let Some(name) = part.strip_prefix("begin{") {
            open.push(name.split('}').next());
        } else if let Some(ended) = part.strip_prefix("end{") {
            assert_eq!(open.pop(), Some(ended.split('}').next()), "{name}");
        }
    }
    let plain = text.replace("\\{", "").replace("\\}", "");
    let braces = |brace: char| plain.matches(brace).count();
    assert!(open.is_empty() && braces('{') == braces('}'), "{name}");
    assert!(text.trim_end().ends_with("\\end{document}"), "{name}");
}

/// Asserts that the compiler accepts the file.
#[track_caller]
pub(crate) fn compile(place: &Place, compiler: &str, file: &str, name: &str) {
    let options: &[&str] = if compiler == "pdflatex" { &["-interaction=nonstopmode", "-halt-on-error"] } else { &[] };
    let output = Command::new(compiler).current_dir(place.path(".")).args(options).arg(file).output();
    let output = output.expect("the compiler starts");
    assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stdout));
}
