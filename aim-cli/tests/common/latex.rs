//! What can be said of LaTeX without a compiler.

/// Environments and braces close as they open, and the document ends.
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
