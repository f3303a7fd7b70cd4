//! The page about a trajectory that was led through points: as it was and as it is, on the character and from
//! three sides.

use aim_codegen::AngleRange;
use aim_gltf::{Clip, Goal};
use glam::DVec3;
use maud::{Markup, html};

use super::chart::{Chart, Mark, Scale, Series};
use super::charts::{Base, speeds};
use super::summary::table;
use super::takes::Takes;
use super::whole;
use super::words::{chip, counted, fixed, shown, tiny, trimmed};

/// What the page is about; points are in the world.
pub(crate) struct Course<'a> {
    pub(crate) bone: &'a str,
    pub(crate) clip: &'a str,
    /// The three bones that move, from the root.
    pub(crate) limb: [&'a str; 3],
    /// Of the limb.
    pub(crate) length: f64,
    pub(crate) fps: f32,
    /// What came of it, a sentence a line.
    pub(crate) words: &'a str,
    pub(crate) frames: Vec<Frame>,
    /// The points to come through, and how far the bone is off them at their times.
    pub(crate) goals: &'a [Goal],
    pub(crate) errors: Vec<f64>,
    /// As little as counts as being there.
    pub(crate) tolerance: f64,
    pub(crate) takes: Takes<'a>,
}

/// Where the bone is in a frame.
pub(crate) struct Frame {
    pub(crate) t: f64,
    /// As animated.
    pub(crate) before: DVec3,
    /// On the deformed way.
    pub(crate) wanted: DVec3,
    /// In the written file.
    pub(crate) after: DVec3,
    /// How the limb follows.
    pub(crate) status: &'static str,
}

/// How a limb follows: the status's word, what it means.
const STATUSES: [(&str, &str); 4] = [
    ("follows", "the bone is on its way"),
    ("stretched", "the way is beyond the limb, which is straight"),
    ("folded", "the way is nearer than the limb folds"),
    ("degenerate", "the limb has no length to turn"),
];

/// The page.
pub(crate) fn page(course: &Course<'_>) -> String {
    let title = format!("{} led through {}", course.bone, course.clip);
    let content = html! {
        h1 { (course.bone) " led through " q { (course.clip) } }
        (summary(course))
        section {
            h2 { "How it looks" }
            p {
                "Above as animated, below as written, at the same times and always from the same side, with the way of "
                (course.bone) " about the target's time; where the target is outside the picture, an arrow at the border "
                "points to it."
            }
            (course.takes.strips(course.goals))
        }
        section.film-strip {
            h2 { "Its way" }
            p {
                span.key { svg.line viewBox="0 0 22 10" aria-hidden="true" { line.plain x1="0" y1="5" x2="22" y2="5" stroke-width="2" {} } "as animated" }
                " "
                span.key { svg.line viewBox="0 0 22 10" aria-hidden="true" { line.heading x1="0" y1="5" x2="22" y2="5" stroke-width="2" {} } "as written, a dot a frame" }
                " "
                span.key { svg.line viewBox="0 0 22 10" aria-hidden="true" { circle.target cx="11" cy="5" r="4" {} } "where it is to be" }
            }
            div.film.sides {
                @for (name, axes) in VIEWS { (view(course, name, axes)) }
            }
        }
        section.over-time {
            h2 { "Over time" }
            p {
                "Dotted lines are the targets' times, dashed ones limits; shaded is where the limb is at a limit, straight or \
                 folded. The band below each chart tells how the limb follows:"
            }
            p.statuses {
                @for (word, meaning) in STATUSES.iter().filter(|(word, _)| course.frames.iter().any(|frame| frame.status == *word)) {
                    span.chip title=(meaning) { (chip(word)) (word) }
                }
            }
            (charts(course))
        }
    };
    whole(&title, &content)
}

fn summary(course: &Course<'_>) -> Markup {
    let Course { bone, clip, limb: [upper, lower, _], length, frames, .. } = course;
    let moved = frames.iter().map(|frame| frame.before.distance(frame.after)).fold(0.0, f64::max);
    let off = frames.iter().map(|frame| frame.wanted.distance(frame.after)).fold(0.0, f64::max);
    let count = |status: &str| frames.iter().filter(|frame| frame.status == status).count();
    let mut led = vec![
        ("Bone", (*bone).to_owned()),
        ("Followed by", format!("{lower} and {upper}")),
        ("Clip", (*clip).to_owned()),
        ("Frames", format!("{}, {} a second", frames.len(), trimmed(course.fps.into(), 3))),
        ("The limb's length", shown(*length, 4)),
    ];
    led.extend(course.goals.iter().take(TARGETS_TOLD).map(|goal| {
        let point = goal.target.to_array().map(|x| shown(x, 4)).join(", ");
        ("Target", format!("({point}) at {} s", trimmed(goal.at.into(), 3)))
    }));
    let on_target = course.errors.iter().filter(|error| **error <= course.tolerance).count();
    let mut came = vec![
        ("On target", format!("{on_target} of {}", counted(course.goals.len(), "target"))),
        ("Furthest off a target", tiny(course.errors.iter().copied().fold(0.0, f64::max), "")),
        ("Furthest off its way", tiny(off, "")),
        (
            "Moved at most",
            format!("{}, {} of the limb's length", shown(moved, 4), shown(moved / length.max(f64::MIN_POSITIVE), 2)),
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
                (bone) " was led through " (counted(course.goals.len(), "point")) " of " q { (clip) } ", its whole way deformed as \
                 rigidly as possible; " (lower) " and " (upper) " follow."
            }
            @for line in course.words.lines() { p.lead { (line) "." } }
            div.facts { (table("What was led", &led)) (table("What came of it", &came)) }
        }
    }
}

/// Targets listed in the summary.
const TARGETS_TOLD: usize = 8;

fn charts(course: &Course<'_>) -> Markup {
    let Course { bone, limb: [_, lower, _], length, frames, .. } = course;
    let times: Vec<f64> = frames.iter().map(|frame| frame.t).collect();
    let statuses: Vec<&str> = frames.iter().map(|frame| frame.status).collect();
    let moments: Vec<f64> = course.goals.iter().map(|goal| goal.at.into()).collect();
    let base = Base { times: &times, statuses: &statuses };
    let bound: Vec<bool> = statuses.iter().map(|status| *status != "follows").collect();
    let limb_lengths = |distance: f64| distance / length.max(f64::MIN_POSITIVE);

    let label = format!("Distance of {bone} from its way over time, in lengths of the limb.");
    let lowest = 1e-8;
    let mut error = base.chart(label, "limb lengths, logarithmic; below 10⁻⁸ drawn at 10⁻⁸", Scale::Log(lowest, 1.0));
    error.wide = true;
    let values = frames.iter().map(|frame| limb_lengths(frame.wanted.distance(frame.after))).collect();
    error.series.push(Series { name: "error", class: "one", values });
    error.marks.push(Mark { value: limb_lengths(course.tolerance), class: "plain", label: "10⁻⁴".into() });

    let label = format!("How far {bone} is from where it was animated, over time, in lengths of the limb.");
    let values: Vec<f64> = frames.iter().map(|frame| limb_lengths(frame.before.distance(frame.after))).collect();
    let most = values.iter().copied().fold(0.01, f64::max);
    let mut moved = base.chart(label, "limb lengths", Scale::Linear(0.0, 1.08 * most));
    moved.series.push(Series { name: "moved", class: "heading", values });

    let way = |of: fn(&Frame) -> DVec3| -> Vec<f64> {
        let between =
            frames.windows(2).map(|pair| limb_lengths(of(&pair[0]).distance(of(&pair[1]))) / (pair[1].t - pair[0].t));
        std::iter::once(f64::NAN).chain(between).take(frames.len()).collect()
    };
    let label = format!("Speed of {bone} over time, as animated and as written, in lengths of the limb a second.");
    let speed = beside(&base, label, "limb lengths a second", [way(|frame| frame.before), way(|frame| frame.after)]);

    let bent = |clip: &Clip| course.takes.bent(clip, &times);
    let [was, is] = [bent(course.takes.before), bent(course.takes.after)];
    let label = format!("Angle between the bones at {lower} over time, as animated and as written; 180° is straight.");
    let mut bend = beside(&base, label, "degrees between its bones", [was.clone(), is.clone()]);
    bend.scale = Scale::Degrees(was.iter().chain(&is).copied().fold(120.0, f64::min) - 5.0, 188.0);
    bend.marks.push(Mark { value: 180.0, class: "plain", label: "straight".into() });
    bend.bound.clone_from(&bound);

    let range = AngleRange::Between(0.0, std::f64::consts::PI);
    let label = format!("Angular speed of {lower} over time, as animated and as written.");
    let mut bending =
        beside(&base, label, "degrees a second", [speeds(&times, &was, range), speeds(&times, &is, range)]);
    bending.bound = bound;
    let charts = [
        (error, "Error: how far it is off its way".to_owned()),
        (moved, format!("{bone}: how far it was moved")),
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

/// What was and what is, from 0 on.
fn beside<'a>(base: &Base<'a>, label: String, unit: &'static str, values: [Vec<f64>; 2]) -> Chart<'a> {
    let most = values.iter().flatten().copied().filter(|value| value.is_finite()).fold(1e-3, f64::max);
    let mut chart = base.chart(label, unit, Scale::Linear(0.0, 1.08 * most));
    let looks = [("as animated", "plain"), ("as written", "heading")];
    chart.series =
        values.into_iter().zip(looks).map(|(values, (name, class))| Series { name, class, values }).collect();
    chart
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
    let [before, after] = [|frame: &Frame| frame.before.to_array(), |frame: &Frame| frame.after.to_array()]
        .map(|of| course.frames.iter().map(of).collect::<Vec<_>>());
    let all = || before.iter().chain(&after).chain(&targets);
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
                polyline class="series plain" points=(line(&before)) {}
                polyline class="series heading" points=(line(&after)) {}
                @for [x, y] in after.iter().map(flat) { circle.joint cx=(fixed(x, 1)) cy=(fixed(y, 1)) r="1.6" {} }
                @for [x, y] in targets.iter().map(flat) { circle.target cx=(fixed(x, 1)) cy=(fixed(y, 1)) r="4.5" {} }
            }
            figcaption { (name) }
        }
    }
}
