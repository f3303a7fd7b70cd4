//! The film strips: drawings of the character with its line of sight over time, each strip from one side.

use aim_character::{AimedFrame, ChainNodes, Criterion, chain_nodes};
use aim_runtime::glam::{DAffine3, DVec3};
use maud::{Markup, html};

use super::directions::Directions;
use super::gaze::between;
use super::scene::{BESIDE, EYES_HEIGHT, Eye, GazeView, HEIGHT, IN_FRONT, Scene, Stand, WIDTH};
use super::subject::BakePage;
use crate::bake_report::BakeFrame;
use crate::effector::Effector;
use crate::words::{self, Wanted, n, segment};

/// Number of drawings in a strip over time.
const DRAWINGS: usize = 8;
/// Least movement of gaze and head that decides which frames are drawn, degrees.
const MOVED: f64 = 5.0;
/// Smallest worst value that makes an event, degrees or degrees per second.
const SEEN: f64 = 1.0;
/// Distance from the eye to the start of the drawn line of sight, in units of the drawing.
const START: f64 = 13.0;
/// Radius of the plan view in the corner, in units of the drawing.
const PLAN: f64 = 24.0;

/// The film strips of a gaze.
pub(super) struct Strips {
    /// The whole length from the front.
    pub(super) front: Markup,
    /// The eyes in the face, if the character has eyeballs.
    pub(super) eyes: Option<Markup>,
    /// The whole length from the side.
    pub(super) side: Markup,
    /// The events from the side, if there are any.
    pub(super) events: Option<Markup>,
}

/// Returns the film strips, or `None` if the document lacks bones of the rig.
pub(super) fn strips(subject: &BakePage<'_>, directions: &Directions) -> Option<Strips> {
    let BakePage { spec, report, document, baked, .. } = *subject;
    let chain = chain_nodes(spec, document.skeleton()).ok()?;
    let all = baked.frames.len().min(report.frames.len());
    let times: Vec<f64> = baked.frames[..all].iter().map(|frame| frame.t.into()).collect();
    let chosen: Vec<Moment> = spread(&progress(&times, directions)).into_iter().map(|frame| (frame, None)).collect();
    let events = events(subject, all);
    Some(Strips {
        front: strip(subject, &chain, IN_FRONT, &chosen),
        eyes: eye_strip(subject, &chain, &chosen),
        side: strip(subject, &chain, BESIDE, &chosen),
        events: (!events.is_empty()).then(|| strip(subject, &chain, BESIDE, &events)),
    })
}

/// Returns how far each frame is on the way from the first to the last, 0 to 1: half by time, half by the angles by which
/// gaze and head have moved until then.
fn progress(times: &[f64], directions: &Directions) -> Vec<f64> {
    let courses = [Some(&directions.gaze), directions.head.as_ref()];
    let mut moved = 0.0;
    let way: Vec<f64> = (0..times.len())
        .map(|k| {
            let steps = courses.iter().flatten().filter(|_| k > 0).map(|course| between(course[k - 1], course[k]));
            moved += steps.filter(|step| step.is_finite()).sum::<f64>();
            moved
        })
        .collect();
    let length = times.last().zip(times.first()).map_or(0.0, |(last, first)| last - first);
    let by_time = |k: usize| if length > 0.0 { (times[k] - times[0]) / length } else { 0.0 };
    (0..times.len()).map(|k| if moved < MOVED { by_time(k) } else { 0.5 * (by_time(k) + way[k] / moved) }).collect()
}

/// Returns the indices of at most [`DRAWINGS`] frames: the first, the last, and those between them that divide the
/// progress evenly.
fn spread(progress: &[f64]) -> Vec<usize> {
    let (all, count) = (progress.len(), DRAWINGS.min(progress.len()));
    let mut frames: Vec<usize> = Vec::with_capacity(count);
    for k in 0..count {
        let part = words::count(k) / words::count(count - 1).max(1.0);
        let at = progress.partition_point(|done| *done < part - 1e-9);
        // No frame is drawn twice, and enough are left for the rest.
        frames.push(at.clamp(frames.last().map_or(0, |last| last + 1), all - count + k));
    }
    frames
}

/// Index of a frame, and what is notable in it.
type Moment = (usize, Option<String>);

/// Returns the frames in which a criterion is worst, and the first in which the target is out of reach, in order of
/// time. The first frame is never an event.
fn events(subject: &BakePage<'_>, all: usize) -> Vec<Moment> {
    let BakePage { report, .. } = *subject;
    let measured = &report.plausibility;
    let at = |t: f64| report.frames[..all].partition_point(|frame| f64::from(frame.t) < t - 1e-6);
    let worst = [
        (Criterion::HeadToChestHeading, "head turned furthest from the chest"),
        (Criterion::ElevationError, "largest vertical gaze error"),
        (Criterion::HeadingError, "largest horizontal gaze error"),
        (Criterion::HeadRoll, "largest head roll"),
        (Criterion::HeadSpeed, "fastest head motion"),
    ];
    let mut moments: Vec<Moment> = Vec::new();
    for (criterion, what) in worst {
        let told = measured.worst(criterion).filter(|worst| worst.value > SEEN);
        moments.extend(told.map(|worst| (at(worst.t), Some(what.to_owned()))));
    }
    let out = report.frames[..all].iter().position(|frame| matches!(frame.status, "at_limit" | "behind"));
    moments.extend(out.map(|frame| (frame, Some("first out of reach".to_owned()))));
    moments.retain(|(frame, _)| (1..all).contains(frame));
    moments.sort_by_key(|(frame, _)| *frame);
    // Events in the same frame share one drawing.
    moments.dedup_by(|later, first| {
        let same = later.0 == first.0;
        if let (true, Some(first), Some(later)) = (same, &mut first.1, &later.1) {
            *first += &format!(", {later}");
        }
        same
    });
    moments
}

fn scene<'a>(subject: &BakePage<'a>, chain: &ChainNodes, view: GazeView, drawn: &[Moment]) -> Scene<'a> {
    let frames = drawn.iter().map(|(k, _)| &subject.baked.frames[*k]);
    Scene::of_gaze(subject, chain, eye(chain, Effector::of(subject.spec, 0)), view, frames)
}

fn eye(chain: &ChainNodes, Effector { joint, ray }: Effector) -> Eye {
    Eye { node: chain.joints[joint], centre: ray.origin.into(), forward: ray.frame.forward.into() }
}

/// Returns the strip of the eyes in the face; `None` if the surface has no eyeballs.
fn eye_strip(subject: &BakePage<'_>, chain: &ChainNodes, drawn: &[Moment]) -> Option<Markup> {
    let scene = scene(subject, chain, GazeView::Eyes, drawn);
    if !scene.has_eyeballs() {
        return None;
    }
    Some(html! {
        ol.film {
            @for (k, _) in drawn {
                @let frame = &subject.baked.frames[*k];
                @let time = words::fixed(frame.t.into(), 2);
                li {
                    figure {
                        svg viewBox={ "0 0 " (n(WIDTH)) " " (n(EYES_HEIGHT)) } role="img"
                            aria-label={ "The eyes at " (time) " s." } { (scene.character(&frame.world)) }
                        figcaption { span.time { (time) " s" } }
                    }
                }
            }
        }
    })
}

fn strip(subject: &BakePage<'_>, chain: &ChainNodes, stand: Stand, drawn: &[Moment]) -> Markup {
    let BakePage { report, baked, .. } = *subject;
    let effector = eye(chain, report.aimed);
    let scene = scene(subject, chain, GazeView::Head(stand), drawn);
    html! {
        ol.film {
            @for (k, what) in drawn {
                @let told = &report.frames[*k];
                @let status = report.wanted().status(told.status);
                li {
                    figure {
                        (scene.drawing(effector, &baked.frames[*k], told, report.wanted()))
                        figcaption {
                            span.time { (words::fixed(told.t.into(), 2)) " s" }
                            span.chip { (words::chip(told.status)) (status) }
                            span.number { (words::degrees(told.off_deg())) }
                        }
                        @if let Some(what) = what { p.event { (what) } }
                    }
                }
            }
        }
    }
}

impl Scene<'_> {
    fn drawing(&self, effector: Eye, frame: &AimedFrame, told: &BakeFrame, wanted: Wanted) -> Markup {
        let status = told.status;
        let world = &frame.world;
        let eye = &world[effector.node];
        let eye_ws = eye.transform_point3(effector.centre);
        let gaze_ws = eye.transform_vector3(effector.forward).normalize_or_zero();
        let target = self.camera.project(frame.target, world);
        let (from, to) = self.sight(eye_ws, gaze_ws, world);
        let mut lines = vec![(from, to)];
        if let (Some(_), Some(other)) = (frame.pair_error_deg, self.eyes.get(1)) {
            let at = &world[other.node];
            let gaze_ws = at.transform_vector3(other.forward).normalize_or_zero();
            lines.push(self.sight(at.transform_point3(other.centre), gaze_ws, world));
        }
        let ray = html! {
            @for &(from, to) in &lines {
                (segment("ray-case", from, to))
                (segment(&format!("ray {status}"), from, to))
            }
        };
        let away = gaze_ws.dot(self.camera.view.toward) < 0.0;
        let label = format!(
            "At {} s: {}, {} between gaze and {}.",
            words::fixed(frame.t.into(), 2),
            wanted.status(status),
            words::degrees(told.off_deg()),
            wanted.noun()
        );
        html! {
            svg viewBox={ "0 0 " (n(WIDTH)) " " (n(HEIGHT)) } role="img" aria-label=(label) {
                @if away { (ray) }
                (self.character(world))
                @if !away { (ray) }
                (self.target(from, target))
                (self.plan(frame, gaze_ws, eye_ws, status))
            }
        }
    }

    /// Returns the ends of a line of sight in the drawing. It begins in front of the eye, so that the eye stays
    /// visible.
    fn sight(&self, eye_ws: DVec3, gaze_ws: DVec3, world: &[DAffine3]) -> (DVec3, DVec3) {
        let (near, far) = (START / self.camera.view.scale, HEIGHT / self.camera.view.scale * 4.0);
        (self.camera.project(eye_ws + gaze_ws * near, world), self.camera.project(eye_ws + gaze_ws * far, world))
    }

    /// Draws the target, or, if it is outside the drawing, an arrow at the border towards it.
    pub(super) fn target(&self, from: DVec3, target: DVec3) -> Markup {
        const MARGIN: f64 = 9.0;
        let inside = |p: DVec3| (MARGIN..=WIDTH - MARGIN).contains(&p.x) && (MARGIN..=HEIGHT - MARGIN).contains(&p.y);
        if !(target.is_finite() && from.is_finite()) {
            return html! {};
        }
        if inside(target) {
            return html! { circle.target cx=(n(target.x)) cy=(n(target.y)) r="5" {} };
        }
        let step = target - from;
        let share = |step: f64, from: f64, size: f64| match step {
            s if s > 0.0 => (size - MARGIN - from) / s,
            s if s < 0.0 => (MARGIN - from) / s,
            _ => f64::INFINITY,
        };
        let edge = from + step * share(step.x, from.x, WIDTH).min(share(step.y, from.y, HEIGHT)).clamp(0.0, 1.0);
        let angle = step.y.atan2(step.x).to_degrees();
        html! {
            path.target d="M8 0L-5 -6L-2 0L-5 6Z"
                transform={ "translate(" (n(edge.x)) " " (n(edge.y)) ") rotate(" (n(angle)) ")" } {}
        }
    }

    /// Draws the plan view from above, with the viewer at the lower edge: the front as a notch, the gaze, and the
    /// target's direction.
    fn plan(&self, frame: &AimedFrame, gaze_ws: DVec3, eye_ws: DVec3, status: &str) -> Markup {
        let level = self.camera.view.right.cross(self.measurement.up);
        let plan = |v: DVec3| (v.dot(self.camera.view.right), v.dot(level));
        let unit = |v: DVec3| {
            let (x, y) = plan(v);
            let length = x.hypot(y);
            if length > 1e-9 && length.is_finite() { Some((x / length, y / length)) } else { None }
        };
        let front = unit(self.measurement.forward).unwrap_or((0.0, 1.0));
        let angle = front.1.atan2(front.0).to_degrees();
        html! {
            g.plan transform={ "translate(" (n(WIDTH - PLAN - 8.0)) " " (n(HEIGHT - PLAN - 8.0)) ")" } {
                circle.plan-ground r=(n(PLAN)) {}
                path.plan-head d="M-6 0a6 6 0 1 0 12 0a6 6 0 1 0 -12 0M4 4.4L10.5 0L4 -4.4Z" transform={ "rotate(" (n(angle)) ")" } {}
                @if let Some((x, y)) = unit(gaze_ws) {
                    line class={ "ray " (status) } x2=(n(x * PLAN)) y2=(n(y * PLAN)) {}
                }
                @if let Some((x, y)) = unit(frame.target - eye_ws) {
                    circle.target cx=(n(x * PLAN)) cy=(n(y * PLAN)) r="3.5" {}
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the drawn frames of a gaze and a head at 60 frames per second, as azimuths.
    fn drawn(count: u32, gaze: impl Fn(f64) -> f64, head: impl Fn(f64) -> f64) -> Vec<usize> {
        let times: Vec<f64> = (0..count).map(|k| f64::from(k) / 60.0).collect();
        let course = |at: &dyn Fn(f64) -> f64| times.iter().map(|t| [at(*t), 0.0]).collect();
        let (gaze, head) = (course(&gaze), Some(course(&head)));
        spread(&progress(&times, &Directions { target: Vec::new(), gaze, head, animated: Vec::new(), carrier: None }))
    }

    #[test]
    fn a_leap_gets_several_of_the_drawings() {
        // 60° within 0.4 s, half a second before the end of three seconds.
        let leap = |t: f64| 60.0 * ((t - 2.1) / 0.4).clamp(0.0, 1.0);
        let frames = drawn(181, leap, leap);
        assert_eq!((frames.len(), frames[0], frames[7]), (8, 0, 180));
        let during = frames.iter().filter(|frame| (126..=150).contains(*frame)).count();
        assert!((3..=5).contains(&during), "{frames:?}");
        // At one speed, the frames are at even intervals.
        assert_eq!(drawn(71, |t| 30.0 * t, |t| 20.0 * t), [0, 10, 20, 30, 40, 50, 60, 70]);
    }

    #[test]
    fn rest_cuts_and_few_frames_are_drawn_once_each() {
        assert_eq!(drawn(71, |_| 3.0, |t| 0.1 * t.sin()), [0, 10, 20, 30, 40, 50, 60, 70]);
        assert_eq!(drawn(71, |_| f64::NAN, |_| f64::NAN).len(), 8);
        // A cut from one frame to the next.
        let cut = |t: f64| if t < 1.0 { 0.0 } else { 90.0 };
        let frames = drawn(121, cut, cut);
        assert!(frames.windows(2).all(|pair| pair[0] < pair[1]) && frames[0] == 0 && frames[7] == 120, "{frames:?}");
        assert!(frames.contains(&60), "{frames:?}");
        for count in 0..9 {
            assert_eq!(drawn(count, |t| 9.0 * t, |t| t), (0..drawn(count, |t| t, |t| t).len()).collect::<Vec<_>>());
        }
    }
}
