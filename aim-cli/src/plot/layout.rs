//! Layout of a plot: heading, panel, axes and ticks.

use maud::{Markup, html};

use super::key;
use super::picture::{PlotPicture, Size, c};
use super::subject::JointPlot;
use crate::axis::{Axis, multiples};
use crate::words::shown;

/// Margin to the left of the panel, in units of the picture.
const LEFT: f64 = 74.0;
/// Margin to the right of the panel, in units of the picture.
const RIGHT: f64 = 148.0;
/// Margin above the panel, in units of the picture.
const TOP: f64 = 76.0;
/// Margin below the panel, in units of the picture.
const BOTTOM: f64 = 126.0;
const SOFT: &str = "#55606b";

/// The area in which values are drawn, with its axes.
pub(super) struct Panel {
    pub(super) x: Axis,
    pub(super) y: Axis,
}

impl Panel {
    /// Creates a panel whose axes show these intervals.
    pub(super) fn new(size: Size, x: [f64; 2], y: [f64; 2]) -> Self {
        let [left, top, right, bottom] = Self::places(size);
        Self { x: Axis { values: x, places: [left, right] }, y: Axis { values: y, places: [bottom, top] } }
    }

    /// Returns left, top, right and bottom of the panel.
    fn places(size: Size) -> [f64; 4] {
        let [width, height] = size.units();
        [LEFT, TOP, width - RIGHT, height - BOTTOM]
    }

    /// Returns the ratio of the panel's width to its height.
    pub(super) fn aspect(size: Size) -> f64 {
        let [left, top, right, bottom] = Self::places(size);
        (right - left) / (bottom - top)
    }

    /// Returns the place of a pair of values in the picture.
    pub(super) fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.x.at(x), self.y.at(y)]
    }

    /// Returns left, top, width and height of the panel.
    pub(super) fn rectangle(&self) -> [f64; 4] {
        let ([left, right], [bottom, top]) = (self.x.places, self.y.places);
        [left, top, right - left, bottom - top]
    }

    /// Draws the border, ticks at these values, and the titles of the axes.
    pub(super) fn axes(&self, x_ticks: &[f64], x_title: &str, y_ticks: &[f64], y_title: &str) -> Markup {
        let [left, top, width, height] = self.rectangle();
        let (bottom, middle) = (top + height, top + height / 2.0);
        html! {
            g stroke="#1b2127" stroke-width="1" fill="none" {
                rect x=(c(left)) y=(c(top)) width=(c(width)) height=(c(height)) {}
                @for tick in x_ticks { line x1=(c(self.x.at(*tick))) x2=(c(self.x.at(*tick))) y1=(c(bottom)) y2=(c(bottom + 5.0)) {} }
                @for tick in y_ticks { line x1=(c(left - 5.0)) x2=(c(left)) y1=(c(self.y.at(*tick))) y2=(c(self.y.at(*tick))) {} }
            }
            g class="x-ticks" text-anchor="middle" {
                @for tick in x_ticks { text x=(c(self.x.at(*tick))) y=(c(bottom + 20.0)) { (shown(*tick, 3)) } }
            }
            g class="y-ticks" text-anchor="end" {
                @for tick in y_ticks { text x=(c(left - 10.0)) y=(c(self.y.at(*tick) + 4.5)) { (shown(*tick, 3)) } }
            }
            text x=(c(left + width / 2.0)) y=(c(bottom + 43.0)) text-anchor="middle" { (x_title) }
            text x="22" y=(c(middle)) text-anchor="middle" transform=(format!("rotate(-90 22 {})", c(middle))) { (y_title) }
        }
    }
}

/// Draws the title of the picture, and a smaller line about the target.
pub(super) fn heading(subject: &JointPlot) -> Markup {
    html! {
        text x=(c(LEFT)) y="34" font-size="18" font-weight="bold" { (title(subject)) }
        text x=(c(LEFT)) y="57" fill=(SOFT) { (about(subject)) }
    }
}

fn title(subject: &JointPlot) -> String {
    let angles = match (subject.joint.heading, subject.joint.pitch) {
        (Some(_), Some(_)) => "heading and pitch",
        (Some(_), None) => "heading",
        _ => "pitch",
    };
    format!("{}, {}: aim over {angles}", subject.rig_name, subject.joint.name)
}

fn about(subject: &JointPlot) -> String {
    let point = subject.target.to_array().map(|x| shown(x, 3)).join(", ");
    format!("Target {}, at ({point}) in the joint’s space", subject.target_in_words())
}

/// Returns the picture, with a description for readers who cannot see it: `how` the aim is drawn, and `over` which
/// angles.
pub(super) fn finished(
    subject: &JointPlot,
    size: Size,
    how: &str,
    over: &[(&str, [f64; 2])],
    content: &Markup,
) -> PlotPicture {
    let over: Vec<String> =
        over.iter().map(|(angle, [lo, hi])| format!("{angle} {}° to {}°", shown(*lo, 2), shown(*hi, 2))).collect();
    let courses: Vec<String> = subject.courses.iter().map(key::ending).collect();
    let description = format!(
        "The aim of {}, the cosine of its angle off the target, as {how} over {}, with its range of motion and the paths of \
         two solvers. {}. From rest, {}.",
        subject.joint.name,
        over.join(" and "),
        about(subject),
        courses.join("; ")
    );
    PlotPicture::new(size, &title(subject), &description, content)
}

/// Returns round angles in this interval, degrees.
pub(super) fn angle_ticks([lo, hi]: [f64; 2]) -> Vec<f64> {
    let steps = [1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 60.0, 90.0];
    let step = steps.into_iter().find(|step| hi - lo <= step * 10.0).unwrap_or(90.0);
    multiples(lo, hi, step)
}
