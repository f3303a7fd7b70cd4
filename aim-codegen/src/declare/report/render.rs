//! Renders diagnostics for a terminal, in the usual format of compilers. Plain text, no colours.

use core::fmt::{self, Write};
use core::ops::Range;

use super::diagnostics::{Diagnostics, Source};
use crate::declare::source_place::SourcePlace;

/// Maximum number of characters shown before a place, and from it on.
const LONGEST: usize = 200;

impl Diagnostics {
    /// Formats the errors like a compiler, separated by empty lines: message, file, line and column, the line itself,
    /// help. Ends with a newline.
    #[must_use]
    pub fn render(&self) -> String {
        let source = self.source.as_ref();
        let mut out = String::new();
        for diagnostic in self {
            if !out.is_empty() {
                out.push('\n');
            }
            // Writing to a string cannot fail.
            let _ = writeln!(out, "error: {}", diagnostic.message());
            let gutter = match (source, diagnostic.place()) {
                (Some(source), SourcePlace::Text(range)) => snippet(&mut out, source, range),
                _ => 1,
            };
            let help = diagnostic.help().replace('\n', &format!("\n{:gutter$}           ", ""));
            let _ = writeln!(out, "{:gutter$} = help: {help}", "");
            if let (Some((note, SourcePlace::Text(range))), Some(source)) = (diagnostic.note(), source) {
                let _ = writeln!(out, "note: {note}");
                snippet(&mut out, source, range);
            }
        }
        out
    }
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render())
    }
}

impl core::error::Error for Diagnostics {}

/// Writes ` --> file:line:column` and the underlined line; returns the gutter's width.
fn snippet(out: &mut String, source: &Source, range: &Range<usize>) -> usize {
    let (start, text) = line_at(&source.text, range.start);
    let line = source.text[..start].matches('\n').count() + 1;
    let column = source.text[start..].char_indices().take_while(|(at, _)| start + at < range.start).count() + 1;
    let gutter = line.to_string().len();
    let from = range.start.saturating_sub(start).min(text.len());
    let to = range.end.saturating_sub(start).clamp(from, text.len());
    let width = text.get(from..to).map_or(1, |part| part.chars().count()).clamp(1, LONGEST);
    // Of an overlong line, show only the surroundings of the place.
    let skipped = (column - 1).saturating_sub(LONGEST);
    let indent = column - 1 - skipped;
    // Replace each tab by one space, so that the underline is aligned at any tab width of the terminal.
    let shown = text.chars().skip(skipped).take(indent + LONGEST).collect::<String>().replace('\t', " ");
    let _ = writeln!(out, "{:gutter$}--> {}:{line}:{column}", "", source.name);
    let _ = writeln!(out, "{:gutter$} |", "");
    let _ = writeln!(out, "{line} | {shown}");
    let _ = writeln!(out, "{:gutter$} | {}{}", "", " ".repeat(indent), "^".repeat(width));
    gutter
}

/// Returns the start of the line that contains this byte, and its text without the line ending.
fn line_at(text: &str, offset: usize) -> (usize, &str) {
    let before = text.bytes().take(offset).rposition(|byte| byte == b'\n');
    let start = before.map_or(0, |at| at + 1);
    let line = text[start..].lines().next().unwrap_or_default();
    (start, line.trim_end_matches('\r'))
}
