//! [`Pointed`]: the point of a figure under the mouse pointer. Also draws the bounding boxes of bones, which speed up
//! the ray cast.

use aim_animation::{OrientedBox, Ray};
use aim_runtime::glam::Vec3;

use crate::actor::Actor;
use crate::character::Character;
use crate::gizmos::{BLUE, ORANGE, VERMILION};
use crate::picture::{Colour, Picture, Rod};

/// Radius of the edges of boxes and triangles, metres of a 1.7 m character.
const EDGE: f32 = 0.0015;
/// Radius of the edges of the box of the bone that is pointed at, metres of a 1.7 m character.
const THICK: f32 = 0.004;
/// Radius of the point that is hit, metres of a 1.7 m character.
const POINT: f32 = 0.009;

/// The nearest hit of a ray with the figures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pointed {
    /// Index of the actor that is hit.
    pub(crate) actor: usize,
    pub(crate) bone: usize,
    /// Corners of the triangle that is hit, world space.
    pub(crate) triangle: [Vec3; 3],
    /// Point of the hit, world space.
    pub(crate) point: Vec3,
}

impl Pointed {
    /// Returns the nearest hit of a ray with the figures; `None` if it misses all.
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

/// Draws the boxes of an actor's bones. The box of the bone in `pointed` is highlighted, with the triangle and the
/// point.
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

/// Returns the twelve edges of a box. Corners whose indices differ in exactly one bit are connected.
fn edges(oriented: &OrientedBox) -> impl Iterator<Item = [Vec3; 2]> {
    let corners = oriented.corners();
    let ends = (0..8_usize).flat_map(|from| [1, 2, 4].map(|bit| (from, from | bit)));
    ends.filter(|(from, to)| from != to).map(move |(from, to)| [corners[from], corners[to]])
}
