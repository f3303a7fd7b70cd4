//! [`Pointed`]: the place of a figure that is under the mouse pointer; and the boxes of bones, by which it is found.

use aim_animation::{OrientedBox, Ray};
use aim_runtime::glam::Vec3;

use crate::actor::Actor;
use crate::character::Character;
use crate::gizmos::{BLUE, ORANGE, VERMILION};
use crate::picture::{Colour, Picture, Rod};

/// Half the thickness of edges, and the radius of the point that is hit, metres of a character of 1.7 m.
const EDGE: f32 = 0.0015;
const THICK: f32 = 0.004;
const POINT: f32 = 0.009;

/// What a ray hits of the figures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pointed {
    /// Which of the actors.
    pub(crate) actor: usize,
    pub(crate) bone: usize,
    /// The corners of the triangle, in the world.
    pub(crate) triangle: [Vec3; 3],
    /// The point of it, in the world.
    pub(crate) point: Vec3,
}

impl Pointed {
    /// The nearest that a ray hits.
    pub(crate) fn new(character: &Character, actors: &[Actor], ray: &Ray) -> Option<Self> {
        let hits = actors.iter().enumerate().filter_map(|(at, actor)| {
            let ray = Ray { origin: ray.origin - actor.shift, ..*ray };
            Some((at, character.skinning.hit(&actor.posed, &ray)?))
        });
        let (at, hit) = hits.min_by(|a, b| a.1.part.total_cmp(&b.1.part))?;
        let actor = &actors[at];
        let triangle = character.skinning.triangle(&actor.posed, hit.triangle)?.map(|corner| corner + actor.shift);
        Some(Self { actor: at, bone: hit.bone, triangle, point: hit.point + actor.shift })
    }
}

/// Shows the boxes of an actor's bones; that of `pointed` with its triangle and the point.
pub(crate) fn show(picture: &mut Picture, character: &Character, actor: &Actor, pointed: Option<&Pointed>) {
    let metre = character.metre();
    let mut edge = |[from, to]: [Vec3; 2], radius: f32, colour: Colour, in_front: bool| {
        picture.rods.push(Rod { from, to, radius: radius * metre, colour, is_lit: false, in_front });
    };
    for (bone, oriented) in character.skinning.boxes(&actor.posed) {
        let is_pointed = pointed.is_some_and(|pointed| pointed.bone == bone);
        let (radius, colour) = if is_pointed { (THICK, ORANGE) } else { (EDGE, BLUE) };
        for ends in edges(&oriented) {
            edge(ends.map(|end| end + actor.shift), radius, colour, is_pointed);
        }
    }
    if let Some(Pointed { triangle: [a, b, c], point, .. }) = pointed {
        for ends in [[*a, *b], [*b, *c], [*c, *a]] {
            edge(ends, EDGE, VERMILION, true);
        }
        edge([*point; 2], POINT, VERMILION, true);
    }
}

/// The twelve edges of a box: between corners whose numbers differ in one bit, once each.
fn edges(oriented: &OrientedBox) -> impl Iterator<Item = [Vec3; 2]> {
    let corners = oriented.corners();
    let ends = (0..8_usize).flat_map(|from| [1, 2, 4].map(|bit| (from, from | bit)));
    ends.filter(|(from, to)| from != to).map(move |(from, to)| [corners[from], corners[to]])
}
