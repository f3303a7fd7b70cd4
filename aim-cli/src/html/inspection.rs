//! The page of `aim inspect --html`: the character from several sides with its rig's axes as arrows, so that they can
//! be checked by eye.

use aim_character::{Fit, JointFit, Measurement, NAMES, Palette, evidence};
use aim_gltf::Document;
use aim_runtime::glam::DVec3;
use maud::{Markup, html};

use super::raster::{FADE, Paint, Raster, SkinnedSurface};
use super::scene::ends;
use crate::page::report as report_page;
use crate::projection::Projection;
use crate::words::{n, points, segment};

/// Width and height of a drawing.
const SIZE: f64 = 420.0;
/// Pixels of the embedded picture per unit of the drawing.
const PIXELS: f64 = 1.5;
/// Length of an arrow, as a share of the drawing.
const ARROW: f64 = 0.15;
/// Length of the gaze, as a share of the drawing.
const GAZE: f64 = 0.3;
/// Smallest window around the chain, as a share of the character's height.
const OF_HEIGHT: f64 = 0.42;
/// Smallest window around the chain, as a multiple of the chain's extent.
const OF_CHAIN: f64 = 2.4;
const CLAY: [f64; 3] = [0.80, 0.74, 0.68];
const COLOURS: [&str; 3] = ["axis-up", "axis-forward", "axis-left"];

/// Input of the page.
pub(crate) struct Inspected<'a> {
    pub(crate) file: &'a str,
    pub(crate) document: &'a Document,
    pub(crate) measurement: &'a Measurement,
    /// The rig whose axes are drawn, compared with the model; `None` if there is none.
    pub(crate) fit: Option<&'a Fit<'a>>,
    /// Origin of that rig, in words.
    pub(crate) rig: &'a str,
}

/// Returns the page.
pub(crate) fn page(inspected: &Inspected<'_>) -> String {
    let Inspected { file, document, measurement, fit, rig } = inspected;
    let skinned = SkinnedSurface::new(document);
    let positions = Palette::new(document.skeleton(), &measurement.bind_world).positions(&skinned.surface);
    let views = views(inspected, &positions);
    let title = format!("Axes of {file}");
    let content = html! {
        h1 { (title) }
        p.lead { (evidence::facing(measurement, document)) " Confidence " (n(measurement.confidence * 100.0)) " %." }
        @if let Some(doubt) = evidence::doubt(measurement) { p.wrong { (doubt) } }
        @for against in evidence::against(measurement, document) { p { "Contrary evidence: " (against) "." } }
        @if let Some(fit) = fit { (verdict(fit, rig)) }
        div.views {
            @for (name, view) in &views { (drawing(inspected, name, view, &skinned)) }
        }
        @if let Some(fit) = fit { (table(fit)) }
    };
    report_page(&title, &content)
}

fn verdict(fit: &Fit<'_>, rig: &str) -> Markup {
    html! {
        @if fit.problems.is_empty() {
            p { "The arrows show the axes of " (rig) ". They are right if every green arrow points up, every blue one "
                "forward and every red one to the left, as seen by the character." }
        } @else {
            p.wrong { strong { (rig) " does not match the file." } }
            ul.wrong { @for problem in &fit.problems { li { (problem) } } }
            p { "Wrong arrows are dashed and marked ✗; the thin arrow beside each shows the measured direction." }
        }
    }
}

/// Returns the views from the front, from the left and from above, and one of the whole character.
fn views(inspected: &Inspected<'_>, positions: &[DVec3]) -> Vec<(&'static str, Projection)> {
    let Measurement { up, forward, left, height, bones, .. } = inspected.measurement;
    let (up, forward, left) = (*up, *forward, *left);
    let places = bones.iter().map(|bone| bone.bind_world.translation).filter(|p| p.is_finite());
    let skin = positions.iter().copied().filter(|p| p.is_finite());
    let whole = ends(skin.chain(places)).unwrap_or_default();
    let joints = inspected.fit.map_or(&[][..], |fit| &fit.joints);
    let chain = ends(joints.iter().map(|joint| joint.bone.bind_world.translation)).unwrap_or(whole);
    let size = |(low, high): (DVec3, DVec3)| (high - low).length().max(1e-9);
    let close = (OF_HEIGHT * height).max(OF_CHAIN * size(chain)).min(1.1 * size(whole)).max(1e-9);
    let middle = |(low, high): (DVec3, DVec3)| (low + high) * 0.5;
    let view = |name, toward: DVec3, upward: DVec3, centre: DVec3, window: f64| {
        let view = Projection::new(toward, upward, left, [SIZE / 2.0; 2]);
        (name, Projection { centre, scale: SIZE / window, ..view })
    };
    let aside = (forward * 0.75 + left * 0.6 + up * 0.28).normalize_or(forward);
    vec![
        view("From the front", forward, up, middle(chain), close),
        view("From its left", left, up, middle(chain), close),
        view("From above", up, -forward, middle(chain), close),
        view("Whole figure", aside, up, middle(whole), 1.15 * size(whole)),
    ]
}

fn drawing(inspected: &Inspected<'_>, name: &str, view: &Projection, skinned: &SkinnedSurface) -> Markup {
    let Inspected { document, measurement, fit, .. } = inspected;
    let parents = document.skeleton().parents();
    let lines = measurement.bones.iter().filter_map(|bone| {
        let parent = measurement.bone(parents[bone.node]?)?;
        Some((view.project(bone.bind_world.translation), view.project(parent.bind_world.translation)))
    });
    html! {
        figure {
            svg viewBox=(format!("0 0 {SIZE} {SIZE}")) role="img" aria-label=(name) {
                @if let Some(picture) = figure(inspected, view, skinned) {
                    image href=(picture) width=(n(SIZE)) height=(n(SIZE)) opacity="0.5" {}
                }
                @for (bone, parent) in lines { (segment("bone", bone, parent)) }
                @if let Some(fit) = fit {
                    @if let Some(effector) = fit.joints.first() { (gaze(effector, view)) }
                    @for joint in &fit.joints { (arrows(joint, view)) }
                }
                (compass(measurement, view))
            }
            figcaption { (name) }
        }
    }
}

/// Draws the three declared axes of a joint. A wrong one is marked, and the measured axis is drawn beside it.
fn arrows(joint: &JointFit<'_>, view: &Projection) -> Markup {
    let place = &joint.bone.bind_world;
    let length = ARROW * SIZE / view.scale;
    let tip = |axis: DVec3| place.transform_vector3(axis).normalize_or_zero() * length;
    let at = place.translation;
    html! {
        @for side in 0..3 {
            @let wrong = joint.wrong[side];
            @if wrong {
                (arrow(view, at, tip(joint.measured[side]), &format!("{} expected", COLOURS[side]), ""))
            }
            @let mark = if wrong { " ✗" } else { "" };
            @let name = if wrong { NAMES[side] } else { "" };
            @let axis = evidence::direction(joint.declared[side]);
            // The components of a general direction are in the table, not at its arrow.
            @let axis = if axis.starts_with('(') { "" } else { &axis };
            @let class = format!("{}{}", COLOURS[side], if wrong { " dashed" } else { "" });
            (arrow(view, at, tip(joint.declared[side]), &class, format!("{name} {axis}{mark}").trim()))
        }
        @let p = view.project(at);
        circle.joint cx=(n(p.x)) cy=(n(p.y)) r="4" {}
        text.joint-name x=(n(p.x + 7.0)) y=(n(p.y + 14.0)) { (joint.joint) }
    }
}

/// Draws the effector's gaze.
fn gaze(effector: &JointFit<'_>, view: &Projection) -> Markup {
    let place = &effector.bone.bind_world;
    let ahead = place.transform_vector3(effector.declared[1]).normalize_or_zero() * (GAZE * SIZE / view.scale);
    arrow(view, place.translation, ahead, "gaze", "gaze")
}

/// Draws an arrow from a point along a vector, both in the world; nothing if it points along the line of sight.
fn arrow(view: &Projection, at: DVec3, along: DVec3, class: &str, label: &str) -> Markup {
    let (a, b) = (view.project(at), view.project(at + along));
    let flat = DVec3::new(b.x - a.x, b.y - a.y, 0.0);
    let length = flat.length();
    let ahead = flat.normalize_or_zero();
    let aside = DVec3::new(-ahead.y, ahead.x, 0.0);
    let corners = [b, b - ahead * 9.0 + aside * 4.5, b - ahead * 9.0 - aside * 4.5];
    let text = b + ahead * 12.0;
    html! {
        @if a.is_finite() && b.is_finite() {
            g class={ "arrow " (class) } {
                @if length > 6.0 {
                    line x1=(n(a.x)) y1=(n(a.y)) x2=(n(b.x - ahead.x * 7.0)) y2=(n(b.y - ahead.y * 7.0)) {}
                    polygon points=(points(corners)) {}
                    @if !label.is_empty() {
                        text x=(n(text.x)) y=(n(text.y + 4.0)) text-anchor="middle" { (label) }
                    }
                }
            }
        }
    }
}

/// Draws the directions of the character's up, forward and left in a view.
fn compass(measurement: &Measurement, view: &Projection) -> Markup {
    let corner = view.centre + (view.up * -0.34 - view.right * 0.34) * (SIZE / view.scale);
    let length = 0.075 * SIZE / view.scale;
    let ways = [measurement.up, measurement.forward, measurement.left];
    html! {
        g.compass {
            @for (at, way) in ways.into_iter().enumerate() {
                (arrow(view, corner, way * length, COLOURS[at], NAMES[at]))
            }
        }
    }
}

fn table(fit: &Fit<'_>) -> Markup {
    html! {
        div.scroll {
            table {
                thead { tr {
                    th { "Joint" } th { "Bone" }
                    @for name in NAMES { th { (name) ": declared" } th { "measured" } }
                } }
                tbody {
                    @for joint in &fit.joints {
                        tr {
                            th scope="row" { (joint.joint) }
                            td { (joint.bone.name) }
                            @for at in 0..3 {
                                td class=[joint.wrong[at].then_some("wrong")] { (evidence::direction(joint.declared[at])) }
                                td { (joint.nearest(at)) ", " (n(joint.bone.deviations_deg[at])) "° off" }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Returns the surface in the bind pose as a `data:` URI; `None` if nothing is visible.
fn figure(inspected: &Inspected<'_>, view: &Projection, skinned: &SkinnedSurface) -> Option<String> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a constant of some hundreds")]
    let pixels = (SIZE * PIXELS) as usize;
    let mut picture = Raster::new(pixels, pixels, FADE);
    picture.draw_surface(skinned, &inspected.measurement.bind_world, (view, PIXELS), |_| Paint::Plain(CLAY));
    picture.data_uri()
}
