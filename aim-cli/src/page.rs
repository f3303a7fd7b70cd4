//! The common HTML frame of all pages that the command writes. A page is one file without network access or scripts.
//! The same content gives the same bytes.

use maud::{DOCTYPE, Markup, PreEscaped, html};

/// Returns a page in the style of reports.
pub(crate) fn report(title: &str, content: &Markup) -> String {
    page(title, include_str!("html/style.css"), content)
}

/// Returns a page with this title, style sheet and main content.
pub(crate) fn page(title: &str, style: &str, content: &Markup) -> String {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta name="generator" content=(concat!("aim ", env!("CARGO_PKG_VERSION")));
                title { (title) }
                style { (PreEscaped(style)) }
            }
            body { main { (content) } }
        }
    }
    .into_string()
}
