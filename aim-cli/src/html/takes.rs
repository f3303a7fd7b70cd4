//! The film strip of a limb guided to a target: the character around the target's time, as animated above and as
//! written below.

use aim_animation::Clip;
use aim_character::{Goal, LimbNodes, Measurement};
use aim_gltf::Document;
use aim_runtime::glam::{DAffine3, DVec3};
use maud::{Markup, html};

use super::scene::{HEIGHT, Scene, WIDTH};
use crate::words::{self, n};

/// Number of moments drawn before a target's time, and also after it. With several targets there are fewer, to limit
/// the size of the page.
const AROUND: i16 = 2;
/// Maximum number of targets drawn.
const TARGETS: usize = 8;
/// Longest time between moments, seconds.
const STEP: f32 = 0.15;
/// Longest time between moments, as a share of the clip.
const SHARE: f32 = 0.1;
/// Number of points of the path between moments.
const POINTS: i16 = 8;

/// A character in a clip before and after it was changed.
pub(crate) struct Takes<'a> {
    pub(crate) document: &'a Document,
    /// Measurement of `document`.
    pub(crate) measurement: &'a Measurement,
    pub(crate) limb: LimbNodes,
    pub(crate) before: &'a Clip,
    pub(crate) after: &'a Clip,
}

/// The character at one time, before and after: the world transforms of all nodes.
struct Take {
    t: f32,
    before: Vec<DAffine3>,
    after: Vec<DAffine3>,
}

impl Takes<'_> {
    /// Returns a strip for each of the first [`TARGETS`] goals.
    pub(super) fn strips(&self, goals: &[Goal]) -> Markup {
        let around = match goals.len() {
            0 | 1 => AROUND,
            2 => 1,
            _ => 0,
        };
        html! {
            @for goal in goals.iter().take(TARGETS) { (self.strip(goal, around)) }
            @if goals.len() > TARGETS { p { "The first " (TARGETS) " targets are drawn." } }
        }
    }

    /// Returns a strip with the moment of the goal, and up to `around` moments before and after it within the clip.
    fn strip(&self, goal: &Goal, around: i16) -> Markup {
        let moments = self.moments(goal, around, 1);
        let way = self.moments(goal, AROUND, POINTS);
        let worlds = moments.iter().flat_map(|moment| [&moment.before, &moment.after]);
        let scene = Scene::of_limb(self.document, self.measurement, self.limb, worlds, goal.target);
        let line = |world: fn(&Take) -> &[DAffine3]| {
            let points = way.iter().map(|moment| scene.camera.project(self.tip(world(moment)), &[]));
            words::points(points.filter(|p| p.is_finite()))
        };
        let was = html! { (way_line("plain", &line(|moment| &moment.before))) };
        let is = html! { (was) (way_line("heading", &line(|moment| &moment.after))) };
        html! {
            ol.film.takes {
                @for Take { t, before, after } in &moments {
                    @let time = words::fixed((*t).into(), 2);
                    li {
                        figure {
                            (self.drawing(&scene, before, goal.target, &was, &format!("As animated at {time} s")))
                            (self.drawing(&scene, after, goal.target, &is, &format!("As written at {time} s")))
                            figcaption {
                                span.time { (time) " s" }
                                @if *t == goal.at { span.number { "target time" } }
                            }
                        }
                    }
                }
            }
        }
    }

    /// Returns the moments around a goal in order of time, `parts` of them per step.
    fn moments(&self, goal: &Goal, around: i16, parts: i16) -> Vec<Take> {
        let skeleton = self.document.skeleton();
        let seconds = self.before.length_s();
        let step = STEP.min(SHARE * seconds) / f32::from(parts);
        let times = (-around * parts..=around * parts).map(|k| goal.at + step * f32::from(k));
        let mut times: Vec<f32> = times.filter(|t| *t == goal.at || (0.0..=seconds).contains(t)).collect();
        times.dedup();
        let world = |clip, t| skeleton.world_f64(&skeleton.pose(clip, t));
        times.iter().map(|&t| Take { t, before: world(self.before, t), after: world(self.after, t) }).collect()
    }

    /// Returns the angle between the limb's two bones at each time, degrees; 180 is straight.
    pub(super) fn bent(&self, clip: &Clip, times: &[f64]) -> Vec<f64> {
        let skeleton = self.document.skeleton();
        let at = |t: &f64| {
            #[expect(clippy::cast_possible_truncation, reason = "clips have their times in single precision")]
            let world = skeleton.world_f64(&skeleton.pose(clip, *t as f32));
            let [upper, lower, tip] =
                [self.limb.upper, self.limb.lower, self.limb.tip].map(|node| world[node].translation);
            (upper - lower).angle_between(tip - lower).to_degrees()
        };
        times.iter().map(at).collect()
    }

    fn tip(&self, world: &[DAffine3]) -> DVec3 {
        world[self.limb.tip].translation
    }

    fn drawing(&self, scene: &Scene<'_>, world: &[DAffine3], target: DVec3, ways: &Markup, label: &str) -> Markup {
        let [tip, target] = [self.tip(world), target].map(|point| scene.camera.project(point, world));
        html! {
            svg viewBox={ "0 0 " (n(WIDTH)) " " (n(HEIGHT)) } role="img" aria-label=(label) {
                (scene.character(world))
                (ways)
                (scene.target(tip, target))
                @if tip.is_finite() { circle.tip cx=(n(tip.x)) cy=(n(tip.y)) r="3" {} }
            }
        }
    }
}

fn way_line(class: &str, points: &str) -> Markup {
    html! {
        polyline.ray-case points=(points) {}
        polyline class={ "series " (class) } points=(points) {}
    }
}
