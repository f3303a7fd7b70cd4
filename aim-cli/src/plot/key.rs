//! Lines and marks of a plot, and its key.

use maud::{Markup, html};

use super::bands::{Bands, aim};
use super::picture::{Size, c, path};
use super::subject::{FPS, JointPlot, SolverPath};
use crate::words::{count, counted, degrees, fixed, shown};

/// Smallest distance between marks; nearer ones are thinned out.
const APART: f64 = 7.0;

/// Returns the number of frames from mark to mark, such that marks do not touch on these drawn paths.
pub(super) fn frames_a_mark(ways: &[Vec<[f64; 2]>]) -> usize {
    let apart = |way: &Vec<[f64; 2]>| {
        let length: f64 = way.windows(2).map(|pair| distance(pair[0], pair[1])).sum();
        length / count(way.len().saturating_sub(1).max(1))
    };
    let apart = ways.iter().map(apart).fold(f64::INFINITY, f64::min);
    let fits = |frames: &u16| f64::from(*frames) * apart >= APART;
    [1, 2, 3, 6, 10, 20, 30].into_iter().find(fits).unwrap_or(60).into()
}

pub(super) fn distance([ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> f64 {
    (ax - bx).hypot(ay - by)
}

/// Draws a line with a light casing, so that it stands out from any colour.
pub(super) fn line(points: &[[f64; 2]], colour: &str) -> Markup {
    let d = path(points, false);
    html! {
        path d=(d) fill="none" stroke="#ffffff" stroke-width="5" stroke-linejoin="round" stroke-linecap="round" {}
        path class="way" d=(d) fill="none" stroke=(colour) stroke-width="2.4" stroke-linejoin="round" stroke-linecap="round" {}
    }
}

/// Draws the mark of a frame: round for the first path, square for the second.
fn mark(course: usize, colour: &str, [x, y]: [f64; 2], size: f64) -> Markup {
    html! {
        @if course == 0 {
            circle cx=(c(x)) cy=(c(y)) r=(c(size)) fill=(colour) stroke="#ffffff" stroke-width="1.2" {}
        } @else {
            rect x=(c(x - 0.9 * size)) y=(c(y - 0.9 * size)) width=(c(1.8 * size)) height=(c(1.8 * size)) fill=(colour) stroke="#ffffff" stroke-width="1.2" {}
        }
    }
}

/// Draws the mark of the common start of both paths.
fn start([x, y]: [f64; 2]) -> Markup {
    html! { circle class="start" cx=(c(x)) cy=(c(y)) r="6" fill="#ffffff" stroke="#000000" stroke-width="2" {} }
}

/// Draws the mark of the end of a path: a ring for the first, a lozenge within it for the second.
fn end(course: usize, colour: &str, [x, y]: [f64; 2]) -> Markup {
    html! {
        @if course == 0 {
            circle class="end" cx=(c(x)) cy=(c(y)) r="9.5" fill="none" stroke="#ffffff" stroke-width="5.5" {}
            circle cx=(c(x)) cy=(c(y)) r="9.5" fill="none" stroke=(colour) stroke-width="2.8" {}
        } @else {
            rect class="end" x=(c(x - 4.2)) y=(c(y - 4.2)) width="8.4" height="8.4" transform=(format!("rotate(45 {} {})", c(x), c(y)))
                fill=(colour) stroke="#ffffff" stroke-width="1.6" {}
        }
    }
}

/// Draws the marks of both paths: one every `frames_a_mark` frames where the path is visible, their start and their
/// ends.
pub(super) fn frames(
    subject: &JointPlot,
    drawn: &[Vec<[f64; 2]>; 2],
    frames_a_mark: usize,
    sizes: [f64; 2],
    is_seen: impl Fn([f64; 2]) -> bool,
) -> Markup {
    let all = || drawn.iter().zip(&subject.courses).enumerate();
    html! {
        @for (k, (way, course)) in all() {
            @for (at, _) in way.iter().zip(&course.angles).step_by(frames_a_mark).skip(1).filter(|(_, angles)| is_seen(**angles)) {
                (mark(k, course.colour, *at, sizes[k]))
            }
        }
        (start(drawn[0][0]))
        @for (k, (way, course)) in all() { (end(k, course.colour, way[way.len() - 1])) }
    }
}

/// Draws the border of the range of motion.
pub(super) fn range(outline: &[[f64; 2]]) -> Markup {
    let d = path(outline, outline.first() == outline.last());
    html! {
        path d=(d) fill="none" stroke="#000000" stroke-width="3.6" stroke-linejoin="round" {}
        path class="range" d=(d) fill="none" stroke="#ffffff" stroke-width="1.8" stroke-linejoin="round" {}
    }
}

/// Draws the key, two entries in a row, in the lowest part of the picture.
pub(super) fn legend(subject: &JointPlot, size: Size, frames_a_mark: usize, range_patch: &Markup) -> Markup {
    let [width, height] = size.units();
    let (first, second) = (74.0, 74.0 + 0.56 * (width - 74.0));
    let row = |k: usize| height - if k == 0 { 44.0 } else { 18.0 };
    html! {
        g class="key" font-size="12.5" {
            @for (k, course) in subject.courses.iter().enumerate() {
                @let y = row(k) - 4.5;
                (line(&[[first, y], [first + if k == 0 { 36.0 } else { 46.0 }, y]], course.colour))
                (mark(k, course.colour, [first + 15.0, y], 3.2))
                (end(k, course.colour, [first + 46.0, y]))
                text x=(c(first + 66.0)) y=(c(row(k))) { (ending(course)) }
            }
            g transform=(format!("translate({} {})", c(second), c(row(0) - 11.0))) { (range_patch) }
            text x=(c(second + 34.0)) y=(c(row(0))) { "range of motion" }
            (start([second + 12.0, row(1) - 4.5]))
            text x=(c(second + 34.0)) y=(c(row(1))) {
                "rest (start); one mark "
                @if frames_a_mark == 1 { "per frame" } @else { "every " (frames_a_mark) " frames" }
                " of 1/" (FPS) " s"
            }
        }
    }
}

/// Returns the result of a solver's path, in words.
pub(super) fn ending(course: &SolverPath) -> String {
    format!("{}: {}, ends {} off", course.name, counted(course.angles.len() - 1, "frame"), degrees(course.off_deg))
}

/// Draws a box in the style of [`range`] for the key.
pub(super) fn range_patch() -> Markup {
    range(&[[2.0, 0.0], [22.0, 0.0], [22.0, 13.0], [2.0, 13.0], [2.0, 0.0]])
}

/// Draws the scale of the bands, with the angle off the target and the aim at their edges.
pub(super) fn scale(bands: &Bands, size: Size, top: f64, bottom: f64) -> Markup {
    const WIDTH: f64 = 18.0;
    let left = size.units()[0] - 120.0;
    let edges = bands.edges();
    let (first, last) = (edges[0], edges[edges.len() - 1]);
    let y = |off: f64| top + (off - first) / (last - first) * (bottom - top);
    html! {
        g class="scale" font-size="12" {
            text x=(c(left)) y=(c(top - 12.0)) { "off target" }
            text x=(c(left + WIDTH + 91.0)) y=(c(top - 12.0)) text-anchor="end" fill="#55606b" { "aim" }
            @for pair in edges.windows(2) {
                rect x=(c(left)) y=(c(y(pair[0]))) width=(c(WIDTH)) height=(c(y(pair[1]) - y(pair[0]) + 0.3)) fill=(bands.beginning_at(pair[0])) {}
            }
            rect x=(c(left)) y=(c(top)) width=(c(WIDTH)) height=(c(bottom - top)) fill="none" stroke="#1b2127" {}
            @for edge in &edges {
                line x1=(c(left + WIDTH)) x2=(c(left + WIDTH + 4.0)) y1=(c(y(*edge))) y2=(c(y(*edge))) stroke="#1b2127" {}
                text x=(c(left + WIDTH + 36.0)) y=(c(y(*edge) + 4.2)) text-anchor="end" { (shown(*edge, 1)) "°" }
                text x=(c(left + WIDTH + 91.0)) y=(c(y(*edge) + 4.2)) text-anchor="end" fill="#55606b" { (fixed(aim(*edge), 3).replace('-', "−")) }
            }
        }
    }
}
