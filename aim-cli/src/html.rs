//! HTML reports: self-contained pages without network access or scripts, for light and dark screens and for paper. The
//! same bake gives the same bytes. Names from files are always escaped.

mod chart;
mod charts;
mod clips;
mod directions;
mod film;
mod gaze;
mod inspection;
mod key_bars;
mod looks;
mod raster;
mod rig;
mod scene;
mod subject;
mod summary;
mod takes;
#[cfg(test)]
mod tests;
mod trajectory;

use maud::{Markup, html};

pub(crate) use clips::{ClipPage, ClipTakes, page as clips_page};
use directions::Directions;
use film::Strips;
pub(crate) use inspection::{Inspected, page as inspection_page};
pub(crate) use subject::BakePage;
pub(crate) use takes::Takes;
pub(crate) use trajectory::page as trajectory_page;

/// Returns the page about one bake.
pub(crate) fn page(subject: &BakePage<'_>) -> String {
    let BakePage { spec, report, .. } = *subject;
    let title = format!("{} aimed over {}", report.rig, report.over);
    let directions = Directions::new(subject);
    let content = html! {
        h1 { (report.rig) " aimed over " q { (report.over) } }
        (summary::section(spec, report))
        @if let Some(strips) = directions.as_ref().and_then(|directions| film::strips(subject, directions)) {
            (film(&strips))
        }
        (rig::section(subject))
        section.over-time {
            h2 { "Over time" }
            (charts::all(subject, directions.as_ref()))
        }
    };
    crate::page::report(&title, &content)
}

fn film(Strips { front, eyes, side, events }: &Strips) -> Markup {
    html! {
        section.film-strip {
            h2 { "How it looks" }
            p {
                "Frames from the first to the last, more of them where gaze and head move more, all from the same side. The "
                "line is the gaze, the dot is the target; if the target is outside the picture, an arrow at the border "
                "points to it. The disc shows both from above, with the viewer at its lower edge."
            }
            (front)
            @if let Some(eyes) = eyes {
                p { "The eyes in the face, seen by a camera that turns with the head." }
                (eyes)
            }
            p { "The same frames from the side, where a head that tilts back or leans is easy to see." }
            (side)
            @if let Some(events) = events {
                p { "Notable moments, from the side." }
                (events)
            }
        }
    }
}
