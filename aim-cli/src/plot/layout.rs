//! Where things are in a flat plot: the panel, its axes and ticks.

use maud::{Markup, html};

use super::picture::{Size, c};
use crate::html::words::shown;
use crate::ticks::multiples;

/// The room around the panel, in units of the picture.
const LEFT: f64 = 74.0;
const RIGHT: f64 = 148.0;
const TOP: f64 = 76.0;
const BOTTOM: f64 = 126.0;
const SOFT: &str = "#55606b";

/// An axis: values and where they are drawn.
#[derive(Clone, Copy)]
pub(super) struct Axis {
    pub(super) values: [f64; 2],
    pub(super) places: [f64; 2],
}

impl Axis {
    pub(super) fn at(&self, value: f64) -> f64 {
        let [(lo, hi), (from, to)] = [self.values, self.places].map(|[a, b]| (a, b));
        from + (value - lo) / (hi - lo) * (to - from)
    }

    pub(super) fn span(&self) -> f64 {
        self.values[1] - self.values[0]
    }
}

/// The panel that values are drawn in.
pub(super) struct Panel {
    pub(super) x: Axis,
    pub(super) y: Axis,
}

impl Panel {
    /// With these values from end to end.
    pub(super) fn new(size: Size, x: [f64; 2], y: [f64; 2]) -> Self {
        let [left, top, right, bottom] = Self::places(size);
        Self { x: Axis { values: x, places: [left, right] }, y: Axis { values: y, places: [bottom, top] } }
    }

    /// Left, top, right and bottom.
    fn places(size: Size) -> [f64; 4] {
        let [width, height] = size.units();
        [LEFT, TOP, width - RIGHT, height - BOTTOM]
    }

    /// Its width by its height.
    pub(super) fn aspect(size: Size) -> f64 {
        let [left, top, right, bottom] = Self::places(size);
        (right - left) / (bottom - top)
    }

    pub(super) fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.x.at(x), self.y.at(y)]
    }

    /// Left, top, width and height.
    pub(super) fn rectangle(&self) -> [f64; 4] {
        let ([left, right], [bottom, top]) = (self.x.places, self.y.places);
        [left, top, right - left, bottom - top]
    }

    /// The border with ticks at these values, and what the axes mean.
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

/// The picture's name and, smaller, what it is of.
pub(super) fn heading(title: &str, about: &str) -> Markup {
    html! {
        text x=(c(LEFT)) y="34" font-size="18" font-weight="bold" { (title) }
        text x=(c(LEFT)) y="57" fill=(SOFT) { (about) }
    }
}

/// Round angles over this span, degrees.
pub(super) fn angle_ticks([lo, hi]: [f64; 2]) -> Vec<f64> {
    let steps = [1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 60.0, 90.0];
    let step = steps.into_iter().find(|step| hi - lo <= step * 10.0).unwrap_or(90.0);
    multiples(lo, hi, step)
}
