//! The page about the clips of a file: their sizes before and after, by bone, and the error of their reduction.

use aim_animation::Clip;
use aim_gltf::Document;
use maud::{Markup, html};

use super::chart::{Base, Mark, Scale, Series};
use super::key_bars;
use super::summary::table;
use crate::clip_report::{ClipCost, ClipReport, Side, percent, rounded};
use crate::deviation::Deviation;
use crate::page::report as report_page;
use crate::words::{Wanted, counted, grouped, trimmed};

/// Input of the page: a report and the clips it describes.
pub(crate) struct ClipPage<'a> {
    pub(crate) report: &'a ClipReport,
    /// Clips of the report, in its order.
    pub(crate) takes: &'a [ClipTakes<'a>],
    pub(crate) document: &'a Document,
    /// `true` if no change was requested and the page shows a proposed reduction.
    pub(crate) is_preview: bool,
}

/// A clip before and after it was changed.
pub(crate) struct ClipTakes<'a> {
    pub(crate) before: &'a Clip,
    pub(crate) after: &'a Clip,
    /// Deviation of the reduced clip; `None` if the clip was not reduced.
    pub(crate) deviation: Option<Deviation>,
}

/// Returns the page.
pub(crate) fn page(page: &ClipPage<'_>) -> String {
    let ClipPage { report, takes, is_preview, .. } = *page;
    let file = report.file.rsplit(['/', '\\']).next().unwrap_or(&report.file);
    let content = html! {
        h1 { "Clips of " (file) }
        section.summary {
            p.lead { (lead(report, is_preview)) }
            div.scroll { (costs(report, is_preview)) }
        }
        @for (cost, take) in report.clips.iter().zip(takes) { (clip(page, cost, take)) }
    };
    report_page(&format!("Clips of {file}"), &content)
}

fn lead(report: &ClipReport, is_preview: bool) -> String {
    let sum = |side: fn(&ClipCost) -> &Side| report.clips.iter().map(|cost| side(cost).key_bytes).sum::<usize>();
    let (before, after) = (sum(|cost| &cost.before), sum(|cost| &cost.after));
    let [file_before, file_after] = report.file_bytes;
    let verb = match (is_preview, &report.out) {
        (true, _) => "would remain at a tolerance of 1 mm of a 1.7 m figure",
        (false, Some(_)) => "remain",
        (false, None) => "would remain",
    };
    let share = percent(after, before);
    let share = if share.is_empty() { share } else { format!(" ({share})") };
    format!(
        "{}: {} bytes of keys, of which {}{share} {verb}. File size: {} bytes (before: {}).",
        counted(report.clips.len(), "clip"),
        grouped(before),
        grouped(after),
        grouped(file_after),
        grouped(file_before),
    )
}

fn costs(report: &ClipReport, is_preview: bool) -> Markup {
    html! {
        table.costs {
            thead {
                tr {
                    @for head in ["Clip", "Length", "Moving tracks", "Constant", "At rest", "Keys", "Bytes", "Bytes/s"] {
                        th scope="col" { (head) }
                    }
                    th scope="col" { @if is_preview { "At 1 mm" } @else { "After" } }
                    th scope="col" { "Share" }
                }
            }
            tbody {
                @for cost in &report.clips {
                    tr {
                        th scope="row" { (cost.clip) }
                        td { (trimmed(cost.length_s.into(), 3)) " s" }
                        td { (cost.before.tracks.moving) }
                        td { (cost.before.tracks.constant) }
                        td { (cost.before.tracks.at_rest) }
                        td { (grouped(cost.before.keys)) }
                        td { (grouped(cost.before.key_bytes)) }
                        td { (grouped(rounded(cost.before.key_bytes_a_second))) }
                        td { (grouped(cost.after.key_bytes)) }
                        td { (percent(cost.after.key_bytes, cost.before.key_bytes)) }
                    }
                }
            }
        }
    }
}

fn clip(page: &ClipPage<'_>, cost: &ClipCost, take: &ClipTakes<'_>) -> Markup {
    let side = |side: &Side| {
        vec![
            ("Tracks", side.tracks.in_words()),
            ("Keys", grouped(side.keys)),
            (
                "Bytes of keys",
                format!("{}, {} per second", grouped(side.key_bytes), grouped(rounded(side.key_bytes_a_second))),
            ),
            ("Bytes of JSON", format!("{}, which describes the keys", grouped(side.text_bytes))),
            ("Seam", side.seam.in_words()),
        ]
    };
    let mut before = side(&cost.before);
    before.insert(0, ("Length", format!("{} s", trimmed(cost.length_s.into(), 3))));
    if let Some(root) = &cost.root {
        before.push(("Hips", root.in_words()));
    }
    let mut after = side(&cost.after);
    if let Some(taken) = &cost.extracted {
        let way =
            format!("path length {} units, final turn {}°", trimmed(taken.distance, 3), trimmed(taken.turn_deg, 1));
        let nothing = "nothing: the clip is already in place".to_owned();
        after.push(("Extracted", if taken.nothing { nothing } else { format!("{}: {way}", taken.motion) }));
    }
    if let Some(words) = cost.loop_in_words() {
        after.push(("Loop", words));
    }
    if let Some(reduced) = &cost.reduced {
        after.push(("Reduced", format!("at {} mm: {}", reduced.tolerance_mm, reduced.in_words())));
    }
    let caption = if page.is_preview { "With --reduce 1mm" } else { "After" };
    html! {
        section.over-time {
            h2 { (cost.clip) }
            div.facts { (table("Before", &before)) (table(caption, &after)) }
            div.charts {
                (key_bars::charts(page.document, cost, take))
                @if let Some(deviation) = &take.deviation { (error(page, cost, deviation)) }
            }
        }
    }
}

fn error(page: &ClipPage<'_>, cost: &ClipCost, deviation: &Deviation) -> Markup {
    let values: Vec<f64> = deviation.distances.iter().map(|distance| distance / page.report.millimetre).collect();
    let tolerance = cost.reduced.as_ref().map_or(0.0, |reduced| reduced.tolerance_mm);
    let label = format!("Largest distance of any bone from its original place over {}, in millimetres.", cost.clip);
    // Gives the axis a length even if both tolerance and error are 0.
    let most = values.iter().copied().fold(tolerance.max(1e-3), f64::max);
    let base = Base { times: &deviation.times, statuses: &[], wanted: Wanted::Target };
    let mut chart = base.chart(label, "mm of a 1.7 m figure, largest of all bones", Scale::Linear(0.0, 1.1 * most));
    chart.wide = true;
    chart.series.push(Series { name: "error", class: "one", values });
    chart.marks.push(Mark { value: tolerance, class: "plain", label: format!("{tolerance} mm") });
    chart.figure("Error over time")
}
