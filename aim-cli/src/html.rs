//! `report.html`: one page that needs nothing but itself (no network, no script), for screens light and dark and for
//! paper. The same bake gives the same bytes; names from files are escaped wherever they appear.

mod chart;
mod charts;
mod directions;
mod film;
mod gaze;
mod inspection;
mod raster;
mod rig;
mod scene;
mod summary;
mod takes;
#[cfg(test)]
mod tests;
mod trajectory;

use aim_codegen::RigSpec;
use aim_gltf::{Baked, Document, Measurement};
use maud::{Markup, html};

use crate::bake_report::BakeReport;

pub(crate) use inspection::{Inspected, page as inspection_page};
pub(crate) use takes::Takes;
pub(crate) use trajectory::page as trajectory_page;

/// Subject of a page: `report` describes `baked`, which is `document` aimed by `spec`.
pub(crate) struct BakePage<'a> {
    pub(crate) spec: &'a RigSpec,
    pub(crate) report: &'a BakeReport,
    pub(crate) document: &'a Document,
    /// Of the document.
    pub(crate) measurement: &'a Measurement,
    pub(crate) baked: &'a Baked,
}

/// The page about one bake.
pub(crate) fn page(subject: &BakePage<'_>) -> String {
    let BakePage { spec, report, .. } = *subject;
    let title = format!("{} aimed over {}", report.rig, report.clip);
    let content = html! {
        h1 { (report.rig) " aimed over " q { (report.clip) } }
        (summary::section(spec, report))
        @if let Some(strip) = film::strip(subject) { (film(strip)) }
        (rig::section(spec, report))
        section.over-time {
            h2 { "Over time" }
            (charts::all(subject))
        }
    };
    whole(&title, &content)
}

/// A page in the style of reports.
fn whole(title: &str, content: &Markup) -> String {
    crate::page::page(title, include_str!("html/style.css"), content)
}

fn film(strip: Markup) -> Markup {
    html! {
        section.film-strip {
            h2 { "How it looks" }
            p {
                "Evenly over the whole length, always from the same side. The line is the gaze, the dot the target; where "
                "the target is outside the picture, an arrow at the border points to it. The disc shows both from above, "
                "with the viewer at its lower edge."
            }
            (strip)
        }
    }
}
