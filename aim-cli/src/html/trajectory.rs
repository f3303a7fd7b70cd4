//! The page about a trajectory that was led through points: as it was and as it is, on the character and from
//! three sides.

use aim_gltf::Goal;
use maud::{Markup, html};

use super::takes::Takes;
use super::whole;
use super::words::fixed;

/// What the page is about; points are in the world.
pub(crate) struct Course<'a> {
    pub(crate) bone: &'a str,
    pub(crate) clip: &'a str,
    /// What came of it, a sentence a line.
    pub(crate) words: &'a str,
    /// As animated.
    pub(crate) before: Vec<[f64; 3]>,
    /// In the written file.
    pub(crate) after: Vec<[f64; 3]>,
    /// The points to come through.
    pub(crate) goals: &'a [Goal],
    pub(crate) takes: Takes<'a>,
}

/// The page.
pub(crate) fn page(course: &Course<'_>) -> String {
    let title = format!("{} led through {}", course.bone, course.clip);
    let content = html! {
        h1 { (course.bone) " led through " q { (course.clip) } }
        @for line in course.words.lines() { p.lead { (line) "." } }
        section {
            h2 { "How it looks" }
            p {
                "Above as animated, below as written, at the same times and always from the same side, with the way of "
                (course.bone) " about the target's time; where the target is outside the picture, an arrow at the border "
                "points to it."
            }
            (course.takes.strips(course.goals))
        }
        section {
            h2 { "Its way" }
            p {
                span.key { svg.line viewBox="0 0 22 10" { line.plain x1="0" y1="5" x2="22" y2="5" stroke-width="2" {} } "as animated" }
                " "
                span.key { svg.line viewBox="0 0 22 10" { line.heading x1="0" y1="5" x2="22" y2="5" stroke-width="2" {} } "as written, a dot a frame" }
                " "
                span.key { svg.line viewBox="0 0 22 10" { circle.target cx="11" cy="5" r="4" {} } "where it is to be" }
            }
            div.film {
                @for (name, axes) in VIEWS { (view(course, name, axes)) }
            }
        }
    };
    whole(&title, &content)
}

/// What is to the right and what is up in each picture: an axis and its sign.
const VIEWS: [(&str, [(usize, f64); 2]); 3] = [
    ("along −z, x to the right", [(0, 1.0), (1, 1.0)]),
    ("along −x, z to the left", [(2, -1.0), (1, 1.0)]),
    ("from above, x to the right", [(0, 1.0), (2, -1.0)]),
];

const SIZE: f64 = 260.0;
const BORDER: f64 = 16.0;

/// All three pictures have one scale.
fn view(course: &Course<'_>, name: &str, axes: [(usize, f64); 2]) -> Markup {
    let targets: Vec<[f64; 3]> = course.goals.iter().map(|goal| goal.target.to_array()).collect();
    let all = || course.before.iter().chain(&course.after).chain(&targets);
    let range = |axis: usize| {
        all().fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), point| (lo.min(point[axis]), hi.max(point[axis])))
    };
    let widest = (0..3).map(range).map(|(lo, hi)| hi - lo).fold(f64::MIN_POSITIVE, f64::max);
    let scale = (SIZE - 2.0 * BORDER) / widest;
    let flat = |point: &[f64; 3]| {
        let [x, y] = axes.map(|(axis, sign)| {
            let (lo, hi) = range(axis);
            sign * (point[axis] - 0.5 * (lo + hi)) * scale
        });
        [0.5 * SIZE + x, 0.5 * SIZE - y]
    };
    let line = |points: &[[f64; 3]]| {
        let points: Vec<String> = points.iter().map(&flat).map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        points.join(" ")
    };
    html! {
        figure {
            svg role="img" viewBox=(format!("0 0 {SIZE} {SIZE}")) aria-label=(format!("The way of {}, {name}", course.bone)) {
                polyline class="series plain" points=(line(&course.before)) {}
                polyline class="series heading" points=(line(&course.after)) {}
                @for [x, y] in course.after.iter().map(flat) { circle.joint cx=(fixed(x, 1)) cy=(fixed(y, 1)) r="1.6" {} }
                @for [x, y] in targets.iter().map(flat) { circle.target cx=(fixed(x, 1)) cy=(fixed(y, 1)) r="4.5" {} }
            }
            figcaption { (name) }
        }
    }
}
