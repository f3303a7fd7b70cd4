//! The aim of a hinge over its only angle, with its range and the place of both solvers in each frame.

use maud::{Markup, html};

use super::bands::{Bands, aim};
use super::contours::with_room;
use super::key;
use super::layout::{Panel, angle_ticks, finished, heading};
use super::picture::{PlotPicture, Size, c, path};
use super::subject::{JointPlot, SolverPath, degrees};
use crate::axis::nice;
use crate::words::{shown, span};

/// Number of steps of the curve.
const STEPS: u16 = 360;
const CURVE: &str = "#0072b2";

pub(super) fn picture(subject: &JointPlot, size: Size) -> PlotPicture {
    let turns = subject.joint.heading.is_some();
    let angles = move |angle: f64| if turns { [angle, 0.0] } else { [0.0, angle] };
    let (axis, range) = if turns {
        ("heading, degrees to the left", subject.joint.heading)
    } else {
        ("pitch, degrees up", subject.joint.pitch)
    };
    let x = with_room(range, 0.4);
    let step = (x[1] - x[0]) / f64::from(STEPS);
    let curve: Vec<[f64; 2]> =
        (0..=STEPS).map(|k| x[0] + f64::from(k) * step).map(|angle| [angle, subject.aim(angles(angle))]).collect();
    let (least, most) = span(curve.iter().map(|[_, aim]| *aim));
    let room = 0.06 * (most - least).max(1e-3);
    let panel = Panel::new(size, x, [least - room, most + room]);
    let [left, top, width, height] = panel.rectangle();
    let on_curve = |course: &SolverPath| -> Vec<[f64; 2]> {
        course.angles.iter().map(|at| panel.at([at[usize::from(!turns)], subject.aim(*at)])).collect()
    };
    let ways = subject.courses.each_ref().map(on_curve);
    let marks = key::frames_a_mark(&ways);
    let [lo, hi] = range.map_or([0.0; 2], degrees);
    let [from, to] = [lo.max(x[0]), hi.min(x[1])].map(|end| panel.x.at(end));
    let drawn: Vec<[f64; 2]> = curve.iter().map(|at| panel.at(*at)).collect();
    let content = html! {
        (heading(subject))
        rect x=(c(from)) y=(c(top)) width=(c(to - from)) height=(c(height)) fill="#e6ebf0" {}
        @if lo.is_finite() { (ends(&panel, [lo, hi])) }
        path class="curve" d=(path(&drawn, false)) fill="none" stroke=(CURVE) stroke-width="2.2" stroke-linejoin="round" {}
        (key::frames(subject, &ways, marks, [5.0, 2.8], |_| true))
        (panel.axes(&angle_ticks(x), axis, &nice(panel.y.values[0], panel.y.values[1], 8.0), "aim, cosine of the angle off the target"))
        (degrees_off(&panel, &Bands::over(least, most), left + width))
        (key::legend(subject, size, marks, &patch()))
    };
    finished(subject, size, "a curve", &[(if turns { "heading" } else { "pitch" }, x)], &content)
}

/// Draws both ends of the range as lines.
fn ends(panel: &Panel, range: [f64; 2]) -> Markup {
    let [_, top, _, height] = panel.rectangle();
    html! {
        @for x in range.map(|end| panel.x.at(end)) {
            line class="range" x1=(c(x)) x2=(c(x)) y1=(c(top)) y2=(c(top + height)) stroke="#1b2127" stroke-dasharray="5 4" {}
        }
    }
}

/// Draws the range for the key.
fn patch() -> Markup {
    html! {
        rect x="2" width="20" height="13" fill="#e6ebf0" stroke="#1b2127" stroke-dasharray="5 4" {}
    }
}

/// Draws an axis at the right with the angles off the target, of which the aims are the cosines.
fn degrees_off(panel: &Panel, bands: &Bands, x: f64) -> Markup {
    let [low, high] = panel.y.values;
    let middle = 0.5 * (panel.y.places[0] + panel.y.places[1]);
    let mut clear_from = f64::NEG_INFINITY;
    // The cosine crowds small angles, so labels that would overlap are left out.
    let apart = |edge: &f64| {
        let y = panel.y.at(aim(*edge));
        let fits = y >= clear_from + 14.0;
        if fits {
            clear_from = y;
        }
        fits
    };
    let edges = bands.edges().into_iter().filter(|edge| (low..=high).contains(&aim(*edge)));
    let edges: Vec<f64> = edges.filter(apart).collect();
    html! {
        g class="off-ticks" {
            @for edge in edges {
                @let y = panel.y.at(aim(edge));
                line x1=(c(x)) x2=(c(x + 5.0)) y1=(c(y)) y2=(c(y)) stroke="#1b2127" {}
                text x=(c(x + 10.0)) y=(c(y + 4.5)) { (shown(edge, 1)) "°" }
            }
            text x=(c(x + 62.0)) y=(c(middle)) text-anchor="middle" transform=(format!("rotate(-90 {} {})", c(x + 62.0), c(middle))) { "degrees off the target" }
        }
    }
}
