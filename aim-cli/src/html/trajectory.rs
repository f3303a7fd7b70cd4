//! The page about a trajectory guided through points: as animated and as written, on the character and from three
//! sides.

use aim_character::Goal;
use aim_codegen::AngleRange;
use aim_runtime::glam::DVec3;
use maud::{Markup, html};

use super::chart::{Base, Chart, Mark, Scale, Series};
use super::charts::speeds;
use super::scene::ends;
use super::summary::table;
use super::takes::Takes;
use crate::page::report as report_page;
use crate::projection::Projection;
use crate::reach_report::{ReachFrame, ReachReport};
use crate::words::{Wanted, chip, counted, n, points, shown, tiny, trimmed};

/// Statuses of a limb, each with its meaning.
const STATUSES: [(&str, &str); 4] = [
    ("follows", "the bone follows its path"),
    ("stretched", "the path is out of reach, and the limb is straight"),
    ("folded", "the path is closer than the limb can fold"),
    ("degenerate", "the limb has no length"),
];

/// Returns the limb's status in a frame.
fn follows(frame: &ReachFrame) -> &'static str {
    if frame.status == "reached" { "follows" } else { frame.status }
}

/// Returns the page about a report; `takes` contains the same clip before and after.
pub(crate) fn page(report: &ReachReport, goals: &[Goal], takes: &Takes<'_>) -> String {
    let title = format!("{} guided through {}", report.bone, report.clip);
    let content = html! {
        h1 { (report.bone) " guided through " q { (report.clip) } }
        (summary(report))
        section {
            h2 { "How it looks" }
            p {
                "As animated (above) and as written (below), at the same times and from the same side, with the path of "
                (report.bone) " around the target time. If the target is outside the picture, an arrow at the border "
                "points to it."
            }
            (takes.strips(goals))
        }
        section.film-strip {
            h2 { "Path" }
            p {
                span.key { svg.line viewBox="0 0 22 10" aria-hidden="true" { line.plain x1="0" y1="5" x2="22" y2="5" stroke-width="2" {} } "as animated" }
                " "
                span.key { svg.line viewBox="0 0 22 10" aria-hidden="true" { line.heading x1="0" y1="5" x2="22" y2="5" stroke-width="2" {} } "as written, one dot per frame" }
                " "
                span.key { svg.line viewBox="0 0 22 10" aria-hidden="true" { circle.target cx="11" cy="5" r="4" {} } "target" }
            }
            div.film.sides { @for sides in VIEWS { (view(report, sides)) } }
        }
        section.over-time {
            h2 { "Over time" }
            p {
                "Dotted lines mark the target times, dashed lines are limits; shading marks where the limb is at a limit, straight \
                 or folded. The band below each chart shows how the limb follows:"
            }
            p.statuses {
                @for (word, meaning) in STATUSES.iter().filter(|(word, _)| report.frames.iter().any(|frame| follows(frame) == *word)) {
                    span.chip title=(meaning) { (chip(word)) (word) }
                }
            }
            (charts(report, takes))
        }
    };
    report_page(&title, &content)
}

fn summary(report: &ReachReport) -> Markup {
    let ReachReport { bone, clip, limb: [upper, lower, _], length, frames, .. } = report;
    let moved = frames.iter().map(ReachFrame::moved).fold(0.0, f64::max);
    let count = |status: &str| frames.iter().filter(|frame| frame.status == status).count();
    let mut led = vec![
        ("Bone", bone.clone()),
        ("Followed by", format!("{lower} and {upper}")),
        ("Clip", clip.clone()),
        ("Frames", format!("{} at {} per second", frames.len(), trimmed(report.fps.into(), 3))),
        ("Limb length", shown(*length, 4)),
    ];
    led.extend(report.targets.iter().take(TARGETS_TOLD).map(|goal| {
        let point = goal.target.map(|x| shown(x, 4)).join(", ");
        ("Target", format!("({point}) at {} s", trimmed(goal.at.into(), 3)))
    }));
    let mut came = vec![
        ("On target", format!("{} of {}", report.summary.reached, counted(report.targets.len(), "target"))),
        (
            "Largest distance from a target",
            tiny(report.targets.iter().map(|target| target.error).fold(0.0, f64::max), ""),
        ),
        ("Largest distance from the path", tiny(report.summary.max_error, "")),
        (
            "Largest displacement",
            format!("{}, {} limb lengths", shown(moved, 4), shown(moved / length.max(f64::MIN_POSITIVE), 2)),
        ),
    ];
    for (word, name) in [("stretched", "Stretched"), ("folded", "Folded"), ("degenerate", "Without a length")] {
        if count(word) > 0 {
            came.push((name, counted(count(word), "frame")));
        }
    }
    html! {
        section.summary {
            p.lead {
                (bone) " was guided through " (counted(report.targets.len(), "point")) " in " q { (clip) } "; its whole path was deformed \
                 as rigidly as possible, and " (lower) " and " (upper) " follow."
            }
            @for line in report.in_words().lines() { p.lead { (line) "." } }
            div.facts { (table("Setup", &led)) (table("Result", &came)) }
        }
    }
}

/// Maximum number of targets listed in the summary.
const TARGETS_TOLD: usize = 8;

fn charts(report: &ReachReport, takes: &Takes<'_>) -> Markup {
    let ReachReport { bone, limb: [_, lower, _], length, frames, .. } = report;
    let times: Vec<f64> = frames.iter().map(|frame| frame.t.into()).collect();
    let statuses: Vec<&str> = frames.iter().map(follows).collect();
    let moments: Vec<f64> = report.targets.iter().map(|goal| goal.at.into()).collect();
    let base = Base { times: &times, statuses: &statuses, wanted: Wanted::Target };
    let bound: Vec<bool> = statuses.iter().map(|status| *status != "follows").collect();
    let limb_lengths = |distance: f64| distance / length.max(f64::MIN_POSITIVE);

    let label = format!("Distance of {bone} from its path over time, in limb lengths.");
    let lowest = 1e-8;
    let mut error =
        base.chart(label, "limb lengths, logarithmic; values below 10⁻⁸ drawn at 10⁻⁸", Scale::Log(lowest, 1.0));
    error.wide = true;
    let values = frames.iter().map(|frame| limb_lengths(frame.error())).collect();
    error.series.push(Series { name: "error", class: "one", values });
    error.marks.push(Mark { value: limb_lengths(report.tolerance()), class: "plain", label: "10⁻⁴".into() });

    let label = format!("Distance of {bone} from its animated position over time, in limb lengths.");
    let values: Vec<f64> = frames.iter().map(|frame| limb_lengths(frame.moved())).collect();
    let most = values.iter().copied().fold(0.01, f64::max);
    let mut moved = base.chart(label, "limb lengths", Scale::Linear(0.0, 1.08 * most));
    moved.series.push(Series { name: "moved", class: "heading", values });

    let way = |of: fn(&ReachFrame) -> [f64; 3]| -> Vec<f64> {
        let way = |pair: &[ReachFrame]| DVec3::from(of(&pair[0])).distance(of(&pair[1]).into());
        let between = frames.windows(2).zip(times.windows(2)).map(|(pair, t)| limb_lengths(way(pair)) / (t[1] - t[0]));
        std::iter::once(f64::NAN).chain(between).take(frames.len()).collect()
    };
    let label = format!("Speed of {bone} over time, as animated and as written, in limb lengths per second.");
    let speed = beside(&base, label, "limb lengths per second", [way(|frame| frame.before), way(|frame| frame.after)]);

    let [was, is] = [takes.before, takes.after].map(|clip| takes.bent(clip, &times));
    let label = format!("Angle between the bones at {lower} over time, as animated and as written; 180° is straight.");
    let mut bend = beside(&base, label, "degrees between the two bones", [was.clone(), is.clone()]);
    bend.scale = Scale::Degrees(was.iter().chain(&is).copied().fold(120.0, f64::min) - 5.0, 188.0);
    bend.marks.push(Mark { value: 180.0, class: "plain", label: "straight".into() });
    bend.bound.clone_from(&bound);

    let range = AngleRange::Between(0.0, std::f64::consts::PI);
    let label = format!("Angular speed of {lower} over time, as animated and as written.");
    let mut bending =
        beside(&base, label, "degrees per second", [speeds(&times, &was, range), speeds(&times, &is, range)]);
    bending.bound = bound;
    let charts = [
        (error, "Error: distance from the path".to_owned()),
        (moved, format!("{bone}: displacement")),
        (speed, format!("{bone}: speed")),
        (bend, format!("{lower}: angle and range")),
        (bending, format!("{lower}: speed")),
    ];
    html! {
        div.charts {
            @for (chart, title) in charts { (Chart { moments: &moments, ..chart }.figure(&title)) }
        }
    }
}

/// Returns a chart of two series, as animated and as written, on an axis from 0.
fn beside<'a>(base: &Base<'a>, label: String, unit: &'static str, values: [Vec<f64>; 2]) -> Chart<'a> {
    let most = values.iter().flatten().copied().filter(|value| value.is_finite()).fold(1e-3, f64::max);
    let mut chart = base.chart(label, unit, Scale::Linear(0.0, 1.08 * most));
    let looks = [("as animated", "plain"), ("as written", "heading")];
    chart.series =
        values.into_iter().zip(looks).map(|(values, (name, class))| Series { name, class, values }).collect();
    chart
}

/// Name of each view, and the directions drawn to the right and up.
const VIEWS: [(&str, DVec3, DVec3); 3] = [
    ("along −z, x to the right", DVec3::X, DVec3::Y),
    ("along −x, z to the left", DVec3::NEG_Z, DVec3::Y),
    ("from above, x to the right", DVec3::X, DVec3::NEG_Z),
];
const SIZE: f64 = 260.0;
const BORDER: f64 = 16.0;

/// Draws one view of the path. All three views have the same scale.
fn view(report: &ReachReport, (name, right, up): (&str, DVec3, DVec3)) -> Markup {
    let targets: Vec<[f64; 3]> = report.targets.iter().map(|goal| goal.target).collect();
    let [before, after] = [|frame: &ReachFrame| frame.before, |frame: &ReachFrame| frame.after]
        .map(|of| report.frames.iter().map(of).collect::<Vec<_>>());
    let all = before.iter().chain(&after).chain(&targets).map(|point| DVec3::from(*point));
    let (low, high) = ends(all).unwrap_or_default();
    let scale = (SIZE - 2.0 * BORDER) / (high - low).max_element().max(f64::MIN_POSITIVE);
    let (centre, middle) = ((low + high) * 0.5, [SIZE / 2.0; 2]);
    let view = Projection { right, up, toward: right.cross(up), centre, middle, scale };
    let flat = |point: &[f64; 3]| view.project((*point).into());
    let line = |all: &[[f64; 3]]| points(all.iter().map(flat));
    html! {
        figure {
            svg role="img" viewBox=(format!("0 0 {SIZE} {SIZE}")) aria-label=(format!("Path of {}, {name}", report.bone)) {
                polyline class="series plain" points=(line(&before)) {}
                polyline class="series heading" points=(line(&after)) {}
                @for p in after.iter().map(flat) { circle.joint cx=(n(p.x)) cy=(n(p.y)) r="1.6" {} }
                @for p in targets.iter().map(flat) { circle.target cx=(n(p.x)) cy=(n(p.y)) r="4.5" {} }
            }
            figcaption { (name) }
        }
    }
}
