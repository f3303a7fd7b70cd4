//! A line chart over time as inline SVG: axes with units, lines that break where values wrap, and a band of statuses.
//! All colours come from the page's style, so that the same drawing works on light and dark screens and on paper.

use maud::{Markup, html};

use crate::axis::{Axis, multiples, nice};
use crate::words::{self, Wanted, n, shown, trimmed};

/// One line of a chart.
pub(super) struct Series<'a> {
    /// Name in the key; empty if the line has no entry there.
    pub(super) name: &'a str,
    /// CSS class of the line.
    pub(super) class: &'static str,
    /// One value per frame; a value that is not finite is a gap.
    pub(super) values: Vec<f64>,
}

/// A dashed horizontal line.
pub(super) struct Mark {
    pub(super) value: f64,
    pub(super) class: &'static str,
    pub(super) label: String,
}

/// Mapping of values to heights.
#[derive(Clone, Copy)]
pub(super) enum Scale {
    /// Linear, from the first to the second value.
    Linear(f64, f64),
    /// Linear in degrees, from the first to the second value, with ticks at round parts of a turn.
    Degrees(f64, f64),
    /// Logarithmic, from one power of ten to another; values outside are drawn at the nearer end.
    Log(f64, f64),
}

/// A chart; `times` are shared by all series and the statuses.
pub(super) struct Chart<'a> {
    /// Description for readers who cannot see the chart.
    pub(super) label: String,
    pub(super) unit: &'static str,
    pub(super) wide: bool,
    pub(super) times: &'a [f64],
    pub(super) statuses: &'a [&'a str],
    pub(super) wanted: Wanted,
    pub(super) scale: Scale,
    /// Period of the values, if they wrap: the line breaks where it jumps by more than half of this.
    pub(super) wraps: Option<f64>,
    pub(super) series: Vec<Series<'a>>,
    pub(super) marks: Vec<Mark>,
    /// Frames to shade because something is at its limit.
    pub(super) bound: Vec<bool>,
    /// Times to mark with vertical lines.
    pub(super) moments: &'a [f64],
}

/// Times and statuses that all charts of a page share.
pub(super) struct Base<'a> {
    pub(super) times: &'a [f64],
    pub(super) statuses: &'a [&'a str],
    pub(super) wanted: Wanted,
}

impl<'a> Base<'a> {
    pub(super) fn chart(&self, label: String, unit: &'static str, scale: Scale) -> Chart<'a> {
        let Self { times, statuses, wanted } = *self;
        Chart {
            label,
            unit,
            wide: false,
            times,
            statuses,
            wanted,
            scale,
            wraps: None,
            series: Vec::new(),
            marks: Vec::new(),
            bound: Vec::new(),
            moments: &[],
        }
    }
}

/// Margin to the left of the plot.
const LEFT: f64 = 44.0;
/// Margin to the right of the plot.
const RIGHT: f64 = 44.0;
/// Margin above the plot.
const TOP: f64 = 22.0;
/// Margin below the plot.
const BELOW: f64 = 44.0;
/// Approximate maximum number of points drawn of a series. Longer series are drawn by the extremes of each stretch.
const MOST_POINTS: usize = 1600;

impl Chart<'_> {
    fn size(&self) -> (f64, f64) {
        if self.wide { (1060.0, 250.0) } else { (520.0, 210.0) }
    }

    fn span(&self) -> (f64, f64) {
        let start = self.times.first().copied().unwrap_or(0.0);
        let end = self.times.last().copied().unwrap_or(0.0);
        (start, if end > start { end } else { start + 1.0 })
    }

    fn x(&self, t: f64) -> f64 {
        let (start, end) = self.span();
        Axis { values: [start, end], places: [LEFT, self.size().0 - RIGHT] }.at(t)
    }

    fn y(&self, value: f64) -> f64 {
        let places = [self.size().1 - BELOW, TOP];
        match self.scale {
            Scale::Linear(low, high) | Scale::Degrees(low, high) => Axis { values: [low, high], places }.at(value),
            Scale::Log(low, high) => Axis { values: [low, high].map(f64::ln), places }.at(value.clamp(low, high).ln()),
        }
    }

    /// Returns the chart with its title and key.
    pub(super) fn figure(&self, title: &str) -> Markup {
        let (width, height) = self.size();
        let bottom = height - BELOW;
        html! {
            figure.chart.wide[self.wide] {
                figcaption {
                    span.title { (title) }
                    @for series in self.series.iter().filter(|series| self.series.len() > 1 && !series.name.is_empty()) {
                        span.key {
                            svg.line viewBox="0 0 22 10" aria-hidden="true" { line class={ "series " (series.class) } x2="22" y1="5" y2="5" {} }
                            (series.name)
                        }
                    }
                }
                svg viewBox={ "0 0 " (n(width)) " " (n(height)) } role="img" aria-label=(self.label) {
                    text.unit x="4" y="9" { (self.unit) }
                    (self.shading(bottom))
                    @for value in self.ticks() {
                        @let y = self.y(value);
                        line.grid x1=(n(LEFT)) x2=(n(width - RIGHT)) y1=(n(y)) y2=(n(y)) {}
                        text.tick x=(n(LEFT - 6.0)) y=(n(y + 3.5)) text-anchor="end" {
                            @if let Scale::Log(..) = self.scale { (words::power_of_ten(value)) } @else { (shown(value, 3)) }
                        }
                    }
                    (self.time_axis(bottom, width))
                    (self.band(bottom + 1.0, if self.wide { 15.0 } else { 6.0 }))
                    @for t in self.moments { line.moment x1=(n(self.x(*t))) x2=(n(self.x(*t))) y1=(n(TOP)) y2=(n(bottom)) {} }
                    (self.limits(width))
                    @for series in &self.series {
                        path class={ "series " (series.class) } d=(self.path(&series.values)) {}
                    }
                }
            }
        }
    }

    fn ticks(&self) -> Vec<f64> {
        match self.scale {
            Scale::Linear(low, high) => nice(low, high, 5.0),
            Scale::Degrees(low, high) => {
                let step = [10.0, 15.0, 30.0, 45.0, 90.0].into_iter().find(|step| high - low <= step * 6.0);
                match step {
                    Some(step) if high - low >= 30.0 => multiples(low, high, step),
                    _ => nice(low, high, 5.0),
                }
            }
            Scale::Log(low, high) => {
                let powers = std::iter::successors(Some(low), |tick| Some(tick * 10.0)).take(20);
                powers.take_while(|tick| *tick <= high * 1.000_001).collect()
            }
        }
    }

    fn time_axis(&self, bottom: f64, width: f64) -> Markup {
        let (start, end) = self.span();
        let below = bottom + if self.wide { 30.0 } else { 21.0 };
        html! {
            @for t in nice(start, end, if self.wide { 12.0 } else { 6.0 }) {
                line.grid x1=(n(self.x(t))) x2=(n(self.x(t))) y1=(n(TOP)) y2=(n(bottom)) {}
                text.tick x=(n(self.x(t))) y=(n(below)) text-anchor="middle" { (shown(t, 3)) }
            }
            text.unit x=(n(width - RIGHT)) y=(n(below + 13.0)) text-anchor="end" { "time, s" }
        }
    }

    /// Returns the time of a frame, or the end if there is no such frame.
    fn time(&self, frame: usize) -> f64 {
        self.times.get(frame).copied().unwrap_or(self.span().1)
    }

    fn stretch(&self, start: usize, stop: usize) -> String {
        format!("{}–{} s", trimmed(self.time(start), 2), trimmed(self.time(stop), 2))
    }

    /// Draws the shading of the frames at a limit.
    fn shading(&self, bottom: f64) -> Markup {
        html! {
            @for (start, stop) in runs(&self.bound).into_iter().filter(|(start, _)| self.bound[*start]) {
                @let (from, to) = (self.x(self.time(start)), self.x(self.time(stop)));
                rect.bound x=(trimmed(from, 2)) width=(trimmed((to - from).max(0.4), 2)) y=(n(TOP)) height=(n(bottom - TOP)) {
                    title { "at a limit, " (self.stretch(start, stop)) }
                }
            }
        }
    }

    /// Draws the band of statuses: one rectangle for each run of equal statuses, labelled if there is room.
    fn band(&self, top: f64, thick: f64) -> Markup {
        html! {
            @for (start, stop) in runs(self.statuses) {
                @let (from, to) = (self.x(self.time(start)), self.x(self.time(stop)));
                @let name = self.wanted.status(self.statuses[start]);
                g {
                    title { (name) ", " (self.stretch(start, stop)) }
                    rect class={ "status " (self.statuses[start]) } x=(trimmed(from, 2)) width=(trimmed((to - from).max(0.4), 2)) y=(n(top)) height=(n(thick)) {}
                    @if thick > 12.0 && to - from > 7.0 + 5.8 * words::count(name.chars().count()) {
                        text.on-status x=(n((from + to) / 2.0)) y=(n(top + 11.0)) text-anchor="middle" { (name) }
                    }
                }
            }
        }
    }

    /// Draws the dashed lines. Their labels at the right are moved down where they would overlap.
    fn limits(&self, width: f64) -> Markup {
        let mut marks: Vec<(f64, &Mark)> = self.marks.iter().map(|mark| (self.y(mark.value), mark)).collect();
        marks.sort_by(|a, b| a.0.total_cmp(&b.0));
        let labels = marks.iter().scan(f64::NEG_INFINITY, |above, (y, _)| {
            *above = y.max(*above + 11.0);
            Some(*above)
        });
        html! {
            @for ((y, mark), label) in marks.iter().zip(labels) {
                line class={ "limit " (mark.class) } x1=(n(LEFT)) x2=(n(width - RIGHT)) y1=(n(*y)) y2=(n(*y)) {}
                text class={ "mark " (mark.class) } x=(n(width - RIGHT + 5.0)) y=(n(label + 3.5)) { (mark.label) }
            }
        }
    }

    fn path(&self, values: &[f64]) -> String {
        let points: Vec<(f64, f64)> = self.times.iter().copied().zip(values.iter().copied()).collect();
        let mut d = String::new();
        let mut before: Option<f64> = None;
        for (t, value) in thinned(&points) {
            if !value.is_finite() {
                before = None;
                continue;
            }
            let broken = before.is_none_or(|before| self.wraps.is_some_and(|turn| (value - before).abs() > turn / 2.0));
            d += if broken { "M" } else { "L" };
            d += &format!("{} {}", n(self.x(t)), n(self.y(value)));
            if broken {
                // Zero-length segment with round caps: draws an isolated frame as a dot.
                d += "h0";
            }
            before = Some(value);
        }
        d
    }
}

/// Returns the runs of equal values, as the index of the first and the index after the last.
fn runs<T: PartialEq>(values: &[T]) -> Vec<(usize, usize)> {
    let mut start = 0;
    let run = |same: &[T]| {
        let from = start;
        start += same.len();
        (from, start)
    };
    values.chunk_by(|a, b| a == b).map(run).collect()
}

/// Returns all points, or the extremes of each stretch if there are more than [`MOST_POINTS`].
fn thinned(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    if points.len() <= MOST_POINTS {
        return points.to_vec();
    }
    let stretch = points.len().div_ceil(MOST_POINTS / 2);
    let extremes = |part: &[(f64, f64)]| {
        let by = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let mut pair: Vec<(f64, f64)> =
            part.iter().min_by(by).into_iter().chain(part.iter().max_by(by)).copied().collect();
        pair.sort_by(|a, b| a.0.total_cmp(&b.0));
        pair
    };
    points.chunks(stretch).flat_map(extremes).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_series_keep_their_extremes() {
        let points: Vec<(f64, f64)> =
            (0..100_000_u32).map(|k| (f64::from(k), if k == 77_777 { 9.0 } else { 0.0 })).collect();
        let drawn = thinned(&points);
        assert!(drawn.len() <= MOST_POINTS + 2, "{}", drawn.len());
        assert!(drawn.contains(&(77_777.0, 9.0)), "the spike is drawn");
        assert!(drawn.windows(2).all(|pair| pair[0].0 <= pair[1].0), "in order");
    }
}
