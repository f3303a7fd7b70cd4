//! The aim over heading and pitch as filled contours, with the range of motion and the paths of both solvers.

use aim_codegen::AngleRange;
use contour::ContourBuilder;
use maud::{Markup, html};

use super::bands::{Bands, aim};
use super::key;
use super::labels::Ground;
use super::layout::{Panel, angle_ticks, finished, heading};
use super::picture::{PlotPicture, Size, c, cased, path};
use super::subject::{JointPlot, degrees};
use crate::words::{fixed, shown, trimmed};

/// Number of grid cells along each side of the panel.
const CELLS: u16 = 180;
/// Number of further grid cells beyond each border, so that contour lines leave the panel.
const BEYOND: u16 = 2;

pub(super) fn picture(subject: &JointPlot, size: Size) -> PlotPicture {
    let [x, y] = window(subject, Panel::aspect(size));
    let panel = Panel::new(size, x, y);
    let [left, top, width, height] = panel.rectangle();
    let grid = Grid::sample(subject, &panel);
    let bands = Bands::over(grid.least, grid.most);
    let ranges: Vec<Vec<[f64; 2]>> =
        subject.range_outlines(x).iter().map(|line| line.iter().map(|at| panel.at(*at)).collect()).collect();
    let courses = subject.courses.each_ref().map(|course| pieces(&course.angles, &panel));
    let marks = key::frames_a_mark(&courses.concat());
    let drawn = subject.courses.each_ref().map(|course| course.angles.iter().map(|at| panel.at(*at)).collect());
    let mut ground = Ground::new(panel.rectangle());
    for line in courses.iter().flatten().chain(&ranges) {
        ground.keep_clear_of(line);
    }
    let contours: Vec<(f64, Vec<Vec<[f64; 2]>>)> =
        bands.levels().into_iter().map(|off| (off, grid.lines(aim(off), &panel))).collect();
    let content = html! {
        defs { clipPath id="panel" { rect x=(c(left)) y=(c(top)) width=(c(width)) height=(c(height)) {} } }
        (heading(subject))
        g clip-path="url(#panel)" {
            rect x=(c(left)) y=(c(top)) width=(c(width)) height=(c(height)) fill=(bands.beginning_at(furthest(&bands))) {}
            @for (off, rings) in &contours { (filled(*off, rings, &bands)) }
            @for (off, rings) in &contours {
                @if let Some(place) = ground.place(rings) {
                    (cased(&format!("{}°", shown(*off, 1)), place.at, place.turned, ink(&bands, *off), &bands.colour(*off)))
                }
            }
            @for line in &ranges { (key::range(line)) }
            @for (pieces, course) in courses.iter().zip(&subject.courses) {
                @for piece in pieces { (key::line(piece, course.colour)) }
            }
            (key::frames(subject, &drawn, marks, [3.2; 2], |_| true))
        }
        (panel.axes(&angle_ticks(x), "heading, degrees to the left", &angle_ticks(y), "pitch, degrees up"))
        (key::scale(&bands, size, top, top + height))
        (key::legend(subject, size, marks, &key::range_patch()))
    };
    finished(subject, size, "filled contours", &[("heading", x), ("pitch", y)], &content)
}

/// Returns the drawn intervals of heading and pitch, degrees: the range of motion with a margin. Both have the same
/// scale, unless that would lead beyond ±180° of heading or ±90° of pitch.
pub(super) fn window(subject: &JointPlot, aspect: f64) -> [[f64; 2]; 2] {
    let [x, y] = [subject.joint.heading, subject.joint.pitch].map(|range| with_room(range, 0.18));
    let span = |[lo, hi]: [f64; 2]| hi - lo;
    let grown = |[lo, hi]: [f64; 2], to: f64, most: f64| {
        let more = 0.5 * (to - (hi - lo)).max(0.0);
        [(lo - more).max(lo.min(-most)), (hi + more).min(hi.max(most))]
    };
    let (wide, high) = (span(y) * aspect, span(x) / aspect);
    [grown(x, wide, 180.0), grown(y, high, 90.0)]
}

/// Returns a range, degrees, with the share `part` of it as a margin at either end, 4° to 40°; a whole turn if the
/// range has no ends.
pub(super) fn with_room(range: Option<AngleRange>, part: f64) -> [f64; 2] {
    match range.map(degrees) {
        Some([lo, hi]) if lo.is_finite() => {
            let room = (part * (hi - lo)).clamp(4.0, 40.0);
            [lo - room, hi + room]
        }
        _ => [-180.0, 180.0],
    }
}

/// Returns the angle at which the furthest band begins, degrees off the target.
fn furthest(bands: &Bands) -> f64 {
    let edges = bands.edges();
    edges[edges.len() - 2]
}

fn ink(bands: &Bands, off: f64) -> &'static str {
    if bands.lightness(off) < 0.55 { "#ffffff" } else { "#000000" }
}

/// Draws the area nearer than `off`, with its border as a contour line.
fn filled(off: f64, rings: &[Vec<[f64; 2]>], bands: &Bands) -> Markup {
    let nearer = bands.edges().into_iter().rfind(|edge| *edge < off - 1e-9).unwrap_or(off);
    let d: String = rings.iter().map(|ring| path(ring, true)).collect();
    html! {
        path class="contour" d=(d) fill=(bands.beginning_at(nearer)) fill-rule="evenodd" stroke=(ink(bands, off)) stroke-opacity="0.7" stroke-width="0.8" {
            title { (trimmed(off, 1)) "° off target, aim " (fixed(aim(off), 4)) }
        }
    }
}

/// Returns a path as drawn, broken where its heading wraps.
fn pieces(angles: &[[f64; 2]], panel: &Panel) -> Vec<Vec<[f64; 2]>> {
    angles
        .chunk_by(|a, b| (a[0] - b[0]).abs() < 180.0)
        .map(|piece| piece.iter().map(|angles| panel.at(*angles)).collect())
        .collect()
}

/// The aim at evenly spaced angles.
struct Grid {
    columns: usize,
    rows: usize,
    /// Row by row, from the lowest heading and pitch.
    values: Vec<f64>,
    first: [f64; 2],
    steps: [f64; 2],
    least: f64,
    most: f64,
}

impl Grid {
    fn sample(subject: &JointPlot, panel: &Panel) -> Self {
        let cells = f64::from(CELLS);
        let steps = [panel.x.span() / cells, panel.y.span() / cells];
        let first =
            [panel.x.values[0] - f64::from(BEYOND) * steps[0], panel.y.values[0] - f64::from(BEYOND) * steps[1]];
        let along = |k: usize| -> Vec<f64> {
            (0..=CELLS + 2 * BEYOND).map(|place| first[k] + f64::from(place) * steps[k]).collect()
        };
        let (headings, pitches) = (along(0), along(1));
        let values: Vec<f64> =
            pitches.iter().flat_map(|pitch| headings.iter().map(|heading| subject.aim([*heading, *pitch]))).collect();
        let (least, most) = values.iter().fold((1.0, -1.0), |(least, most), aim| (aim.min(least), aim.max(most)));
        Self { columns: headings.len(), rows: pitches.len(), values, first, steps, least, most }
    }

    /// Returns the closed lines around the area with at least this aim, as drawn.
    fn lines(&self, aim: f64, panel: &Panel) -> Vec<Vec<[f64; 2]>> {
        // Values belong to the centres of their cells.
        let [x, y] = [0, 1].map(|k| self.first[k] - 0.5 * self.steps[k]);
        let builder = ContourBuilder::new(self.columns, self.rows, true)
            .x_origin(x)
            .y_origin(y)
            .x_step(self.steps[0])
            .y_step(self.steps[1]);
        // Fails only for a grid of another size.
        let lines = builder.lines(&self.values, &[aim]).unwrap_or_default();
        let rings = lines.iter().flat_map(|line| &line.geometry().0);
        rings.map(|ring| ring.coords().map(|at| panel.at([at.x, at.y])).collect()).collect()
    }
}
