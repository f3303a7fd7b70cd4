//! The summary of a bake in words and numbers, all counted or measured from the report.

use aim_character::Plausibility;
use aim_codegen::RigSpec;
use maud::{Markup, html};

use crate::bake_report::{BakeFrame, BakeReport};
use crate::effector::Effector;
use crate::plausibility;
use crate::words::{self, Wanted, chip, counted, fixed, listed, shown, trimmed};

/// Excess over a rate or a range that is attributed to rounding, degrees per second or degrees.
const ROUNDING: f64 = 1e-2;

fn percent(part: usize, of: usize) -> f64 {
    words::count(part) / words::count(of.max(1)) * 100.0
}

/// Returns a table of names and values under a caption.
pub(super) fn table(caption: &str, rows: &[(&str, String)]) -> Markup {
    html! {
        table {
            caption { (caption) }
            tbody { @for (name, value) in rows { tr { th scope="row" { (name) } td { (value) } } } }
        }
    }
}

/// Returns the summary: a paragraph, the share of each status, and the facts.
pub(super) fn section(spec: &RigSpec, report: &BakeReport) -> Markup {
    let counts = report.counts();
    let all = report.frames.len();
    html! {
        section.summary {
            p.lead { (in_words(spec, report)) }
            @for warning in &report.warnings { p.warning { strong { "Warning: " } (warning) } }
            (shares(report.wanted(), &counts, all))
            div.facts {
                (table("Setup", &facts(spec, report)))
                table {
                    caption { "Result" }
                    tbody {
                        @for (word, frames, _) in &counts {
                            tr {
                                th scope="row" { span.chip { (chip(word)) (report.wanted().status(word)) } }
                                td { (counted(*frames, "frame")) ", " (fixed(percent(*frames, all), 1)) " %" }
                            }
                        }
                        @for (name, value) in measured(report) { tr { th scope="row" { (name) } td { (value) } } }
                    }
                }
                (looks(&report.plausibility))
            }
        }
    }
}

/// Returns the table of plausibility criteria with their limits, measured on the written model.
fn looks(measured: &Plausibility) -> Markup {
    let sentence =
        |name: &str| name.chars().take(1).flat_map(char::to_uppercase).chain(name.chars().skip(1)).collect::<String>();
    html! {
        table.looks {
            caption { "Plausibility" }
            tbody {
                @for row in plausibility::rows(measured) {
                    tr.exceeded[row.is_exceeded] {
                        th scope="row" { (sentence(row.name)) }
                        td {
                            @if row.is_exceeded { strong { (row.value) } } @else { (row.value) }
                            @if let Some(limit) = &row.limit { " (limit " (limit) ")" }
                            @if let Some(when) = &row.when { ", at " (when) }
                        }
                    }
                }
            }
        }
    }
}

fn solver(word: &str) -> &str {
    match word {
        "ascent" => "steepest ascent",
        "exact" => "the exact whole-chain solver",
        "natural" => "the natural solver",
        other => other,
    }
}

fn in_words(spec: &RigSpec, report: &BakeReport) -> String {
    let bones: Vec<&str> = match report.frames.first() {
        Some(frame) => frame.joints.iter().map(|joint| joint.bone.name.as_str()).collect(),
        None => spec.joints.iter().map(|joint| joint.name.as_str()).collect(),
    };
    let all = report.frames.len();
    let mut text = format!(
        "{} of {} followed a target for {} s, aimed by {} on top of the clip “{}”. ",
        listed(&bones),
        report.rig,
        trimmed(seconds(report), 2),
        solver(report.solver),
        report.over
    );
    let reached = report.summary.reached;
    text += &match reached {
        0 => format!("None of the {} is {}", counted(all, "frame"), report.on_it()),
        n if n == all => format!("All {} are {}", counted(all, "frame"), report.on_it()),
        n => format!("{n} of {} are {}", counted(all, "frame"), report.on_it()),
    };
    if reached > 0 {
        text += &format!(" (error at most {})", words::degrees(report.summary.max_error_deg_reached));
    }
    let others = report.counts().into_iter().filter(|(word, ..)| *word != "reached");
    let others: Vec<String> = others.map(|(_, frames, words)| format!("{frames} {words}")).collect();
    if !others.is_empty() {
        text += &format!("; {}", listed(&others.iter().map(String::as_str).collect::<Vec<_>>()));
    }
    text += ". ";
    let (range, rate) = (report.summary.max_limit_violation_deg, report.summary.max_rate_violation_deg_s);
    text += match (range <= ROUNDING, rate <= ROUNDING) {
        (true, true) => "Every angle stayed within its range and every speed within its rate.",
        (true, false) => "Every angle stayed within its range, but a rate was exceeded.",
        (false, true) => "Every speed stayed within its rate, but an angle left its range.",
        (false, false) => "A rate was exceeded and an angle left its range.",
    };
    text
}

fn seconds(report: &BakeReport) -> f64 {
    match (report.frames.first(), report.frames.last()) {
        (Some(first), Some(last)) => f64::from(last.t) - f64::from(first.t),
        _ => 0.0,
    }
}

/// Returns a bar that shows the share of each status.
fn shares(wanted: Wanted, counts: &[(&str, usize, &str)], all: usize) -> Markup {
    let label: Vec<String> =
        counts.iter().map(|(word, n, _)| format!("{} {} %", wanted.status(word), fixed(percent(*n, all), 1))).collect();
    let mut start = 0.0;
    let parts = counts.iter().map(|(word, frames, _)| {
        let (from, width) = (start, percent(*frames, all));
        start += width;
        (word, from, width)
    });
    html! {
        @if !counts.is_empty() {
            svg.shares viewBox="0 0 100 2" preserveAspectRatio="none" role="img" aria-label=(label.join(", ")) {
                @for (word, from, width) in parts {
                    rect class={ "status " (word) } x=(trimmed(from, 3)) width=(trimmed(width, 3)) height="2" {}
                }
            }
        }
    }
}

fn facts(spec: &RigSpec, report: &BakeReport) -> Vec<(&'static str, String)> {
    let vector = |v: [f64; 3]| v.map(|x| shown(x, 4)).join(", ");
    let Effector { joint, ray } = report.aimed;
    let bone =
        report.frames.first().and_then(|frame| frame.joints.get(joint)).map_or("", |joint| joint.bone.name.as_str());
    let mut facts = vec![
        ("Rig", report.rig.clone()),
        ("Aimed over", report.over.clone()),
        ("Written as", report.clip.clone()),
        ("Length", format!("{} s", trimmed(seconds(report), 3))),
        ("Frames", format!("{} at {} per second", report.frames.len(), trimmed(report.fps.into(), 3))),
        ("Solver", solver(report.solver).to_owned()),
        ("Weight", trimmed(report.weight.into(), 3)),
        ("Effector", format!("{bone}, along ({})", vector(ray.frame.forward))),
    ];
    if let Some(reduction) = &report.reduction {
        facts.push(("Reduction", reduction.in_words()));
    }
    if ray.origin != [0.0; 3] {
        facts.push(("Effector origin", format!("({})", vector(ray.origin))));
    }
    if let Some(pair) = &spec.joints[0].other_eye {
        let both = report.frames.iter().any(|frame| frame.pair_error_deg.is_some());
        facts.push((if both || joint > 0 { "Other eye" } else { "Following eye" }, pair.clone()));
    }
    facts
}

fn measured(report: &BakeReport) -> Vec<(&'static str, String)> {
    let held = |value: f64, unit: &str| match value {
        x if x <= 0.0 => "respected".to_owned(),
        x if x <= ROUNDING => format!("respected, within {}{unit}", trimmed((x * 1e3).ceil() / 1e3, 3)),
        x => format!("exceeded by up to {}{unit}", trimmed(x, 3)),
    };
    let summary = &report.summary;
    let worst = report.frames.iter().map(BakeFrame::off_deg).fold(0.0, f64::max);
    let on_target = if summary.reached > 0 { words::degrees(summary.max_error_deg_reached) } else { "–".into() };
    let [when_on_it, of_all] = match report.wanted() {
        Wanted::Target => ["Largest error on target", "Largest error overall"],
        Wanted::Goal => ["Largest error on the weighted goal", "Largest error from the weighted goal"],
    };
    let mut rows = vec![(when_on_it, on_target), (of_all, words::degrees(worst))];
    if let Some(worst) = report.frames.iter().filter_map(BakeFrame::pair_off_deg).reduce(f64::max) {
        rows.push(("Largest error of the other eye", words::degrees(worst)));
    }
    if report.wanted() == Wanted::Goal {
        let worst = report.frames.iter().map(|frame| frame.error_deg).fold(0.0, f64::max);
        rows.push(("Largest angle from the target", words::degrees(worst)));
    }
    rows.extend([
        ("Largest added roll", words::degrees(summary.max_roll_deg)),
        ("Ranges of motion", held(summary.max_limit_violation_deg, "°")),
        ("Rates", held(summary.max_rate_violation_deg_s, "°/s")),
    ]);
    rows
}
