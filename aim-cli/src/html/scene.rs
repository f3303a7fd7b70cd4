//! The drawn character: one camera for a whole film strip, and the skinned surface as a picture, or the bones if there
//! is none.

use aim_character::{AimedFrame, ChainNodes, LimbNodes, Measurement, Palette, Role};
use aim_gltf::{Document, Surface, Triangle};
use aim_runtime::glam::{DAffine3, DVec3};
use maud::{Markup, html};

use super::raster::{FADE, Paint, Raster, SkinnedSurface};
use super::subject::BakePage;
use crate::projection::Projection;
use crate::words::{n, segment, span};

/// Width of a drawing.
pub(super) const WIDTH: f64 = 240.0;
/// Height of a drawing.
pub(super) const HEIGHT: f64 = 250.0;
/// Height of a drawing of the eyes.
pub(super) const EYES_HEIGHT: f64 = 72.0;

/// The picture in a drawing.
#[derive(Clone, Copy)]
struct Picture {
    /// Height of the drawing.
    height: f64,
    /// Pixels per unit of the drawing.
    pixels: f64,
    /// Share of the height at the lower edge over which the figure fades out.
    fade: f64,
}

const OF_GAZE: Picture = Picture { height: HEIGHT, pixels: 2.0, fade: FADE };
/// The face fills the drawing and compresses less.
const OF_EYES: Picture = Picture { height: EYES_HEIGHT, pixels: 1.2, fade: 0.0 };
const OF_LIMB: Picture = Picture { height: HEIGHT, pixels: 2.0, fade: 0.0 };

/// Angle of the front camera towards the side of the effector, degrees.
const ASIDE_DEG: f64 = 27.0;
/// Angle of the camera for limbs towards the side of the limb, degrees. It is larger, because limbs move mostly
/// forwards.
const LIMB_ASIDE_DEG: f64 = 55.0;
/// Angle of these cameras above the horizontal, degrees.
const ABOVE_DEG: f64 = 9.0;
/// Position of a camera: its angles from the character's front and above the horizontal, degrees.
#[derive(Clone, Copy)]
pub(super) struct Stand {
    aside_deg: f64,
    above_deg: f64,
}

/// A camera in front of the character, as in a portrait.
pub(super) const IN_FRONT: Stand = Stand { aside_deg: ASIDE_DEG, above_deg: ABOVE_DEG };
/// A level camera at the side of the character, where a head that leans back is clearly visible.
pub(super) const BESIDE: Stand = Stand { aside_deg: 90.0, above_deg: 0.0 };
/// A level camera right in front of the face.
pub(super) const BEFORE_THE_FACE: Stand = Stand { aside_deg: 0.0, above_deg: 0.0 };
/// A camera for the path of a limb.
const BEFORE_THE_LIMB: Stand = Stand { aside_deg: LIMB_ASIDE_DEG, above_deg: ABOVE_DEG };

/// The part of a character that a film strip of a gaze shows.
#[derive(Clone, Copy)]
pub(super) enum GazeView {
    /// The head and its surroundings, seen from one side.
    Head(Stand),
    /// The eyes in the face, seen by a camera that turns with the head.
    Eyes,
}

/// Largest size of a head, as a multiple of its width.
const WIDE: f64 = 1.6;
/// Height of the window, in sizes of the head.
const HEADS: f64 = 2.5;
/// Height of the window as a share of the character's height, if there is no surface to measure the head.
const OF_HEIGHT: f64 = 0.9;
/// Height of the head above the middle of the window, as a share of the window.
const RAISED: f64 = 0.14;
/// Width of a close view of two eyes, in distances between them.
const OF_DISTANCE: f64 = 2.6;
/// Width of a close view of one eye, as a share of the head's height.
const OF_HEAD: f64 = 0.6;
/// Size of the window as a multiple of its content.
const AROUND: f64 = 1.1;
/// Distance from the character up to which a target is kept in the window, as a share of the character.
const BEYOND: f64 = 0.4;
/// Colour of surfaces without a known one, sRGB.
const CLAY: [f64; 3] = [0.80, 0.70, 0.62];

/// Data shared by all drawings of a film strip.
pub(super) struct Scene<'a> {
    document: &'a Document,
    pub(super) measurement: &'a Measurement,
    skinned: SkinnedSurface,
    /// Nodes of the rig's joints, or of the limb.
    joints: Vec<usize>,
    /// Nodes whose surface is drawn as an eyeball.
    pub(super) eyes: Vec<Eye>,
    pub(super) camera: FollowingCamera,
    picture: Picture,
}

/// A bone that looks along `forward` of its own space.
#[derive(Clone, Copy)]
pub(super) struct Eye {
    pub(super) node: usize,
    pub(super) centre: DVec3,
    pub(super) forward: DVec3,
}

/// A camera that moves with the bone `follows`. It never turns, and the centre of its view is relative to that bone,
/// unless it is `fixed` to the bone.
pub(super) struct FollowingCamera {
    pub(super) view: Projection,
    follows: Option<usize>,
    /// The inverse transform of the bone in the bind pose, for which `view` is given, if the camera turns with the bone.
    fixed: Option<DAffine3>,
}

impl FollowingCamera {
    /// Creates a camera in front of the character, towards the side of the effector.
    fn new(measurement: &Measurement, stand: Stand, follows: Option<usize>, eye_bind: DVec3) -> Self {
        let &Measurement { up, forward, left, height, .. } = measurement;
        let (low, high) = span(measurement.bones.iter().map(|bone| bone.bind_world.translation.dot(left)));
        let is_right = eye_bind.dot(left) * 2.0 < low + high - 1e-6 * height;
        let aside_deg = if is_right { -stand.aside_deg } else { stand.aside_deg };
        let middle = [WIDTH / 2.0, HEIGHT / 2.0];
        Self {
            view: Projection::from_aside([up, forward, left], aside_deg, stand.above_deg, middle),
            follows,
            fixed: None,
        }
    }

    /// Frames the head wherever the effector is. `head` is the head's extent and `eye_bind` the effector's place, both
    /// in the bind pose; `places` are the effector's places in the drawings, relative to the followed bone.
    fn framing(
        mut self,
        measurement: &Measurement,
        head: Option<(DVec3, DVec3)>,
        eye_bind: DVec3,
        places: impl Iterator<Item = DVec3>,
    ) -> Self {
        let known = if measurement.height > 0.0 { measurement.height } else { 1.0 };
        let (mut size, mut middle) = (OF_HEIGHT * known / HEADS, DVec3::ZERO);
        if let Some((low, high)) = head {
            // The width limits the size, however long the hair is.
            let extent = high - low;
            let wide = extent.dot(measurement.left.abs());
            size = extent.max_element().min(WIDE * wide).clamp(0.04 * known, 0.6 * known);
            middle = (low + high) * 0.5 + measurement.up * ((extent.dot(measurement.up) - size) * 0.5) - eye_bind;
        }
        // The window contains all places of the effector: a long neck moves it by more than the length of a head.
        let seen = places.filter(|place| place.is_finite()).map(|place| self.view.turn(place));
        let (low, high) = ends(seen).unwrap_or_default();
        let spread = high - low;
        let room = (spread.x + 1.5 * size).max((spread.y + 1.1 * size) / (1.0 - 2.0 * RAISED));
        let window = (HEADS * size).max(room);
        let centre = self.view.unturn((low + high) * 0.5);
        self.view.scale = HEIGHT / window;
        self.view.centre = centre + middle - self.view.up * (RAISED * window);
        self
    }

    /// Creates a camera fixed to the bone `carrier` of the `eyes`, with these in the middle of its view. `head` is the
    /// head's extent in the bind pose.
    fn before_eyes(measurement: &Measurement, carrier: usize, eyes: &[Eye], head: Option<(DVec3, DVec3)>) -> Self {
        let bind = &measurement.bind_world;
        let places = eyes.iter().map(|eye| bind[eye.node].transform_point3(eye.centre));
        let (low, high) = ends(places).unwrap_or_default();
        let apart = (high - low).length();
        let height = head.map_or(measurement.height / 8.0, |(low, high)| (high - low).dot(measurement.up));
        let mut camera = Self::new(measurement, BEFORE_THE_FACE, Some(carrier), low);
        let window = if apart > 0.0 { OF_DISTANCE * apart } else { OF_HEAD * height };
        camera.view.scale = WIDTH / if window > 0.0 { window } else { 1.0 };
        camera.view.centre = (low + high) * 0.5;
        camera.view.middle[1] = EYES_HEIGHT / 2.0;
        camera.fixed = Some(rigid(&bind[carrier]).inverse());
        camera
    }

    /// Frames all points of `character`, and `target` unless it is far away.
    fn around(mut self, character: impl Iterator<Item = DVec3>, target: DVec3) -> Self {
        let seen = character.filter(|point| point.is_finite()).map(|point| self.view.turn(point));
        let (low, high) = ends(seen).unwrap_or_default();
        let target = self.view.turn(target);
        let near = target.clamp(low, high).distance(target) < BEYOND * (high - low).max_element();
        let (low, high) = if near { (low.min(target), high.max(target)) } else { (low, high) };
        let (size, centre) = (high - low, (low + high) * 0.5);
        let window = AROUND * size.y.max(size.x * HEIGHT / WIDTH);
        self.view.scale = HEIGHT / if window > 0.0 { window } else { 1.0 };
        self.view.centre = self.view.unturn(centre);
        self
    }

    /// Returns the place in the drawing of a point of the world, with the nodes at `world`.
    pub(super) fn project(&self, point: DVec3, world: &[DAffine3]) -> DVec3 {
        self.view_of(world).project(point)
    }

    /// Returns the view with the nodes at `world`.
    fn view_of(&self, world: &[DAffine3]) -> Projection {
        if let Some((node, bind)) = self.follows.zip(self.fixed) {
            return self.view.moved(rigid(&world[node]) * bind);
        }
        Projection { centre: self.view.centre + at(self.follows, world), ..self.view }
    }
}

/// Returns the lowest and highest coordinates of some points; `None` if there are none.
pub(super) fn ends(points: impl Iterator<Item = DVec3>) -> Option<(DVec3, DVec3)> {
    points.map(|p| (p, p)).reduce(|(low, high), (p, _)| (low.min(p), high.max(p)))
}

/// Returns a transform without its scale.
fn rigid(transform: &DAffine3) -> DAffine3 {
    let (_, rotation, translation) = transform.to_scale_rotation_translation();
    DAffine3::from_rotation_translation(rotation, translation)
}

fn at(node: Option<usize>, world: &[DAffine3]) -> DVec3 {
    node.map_or(DVec3::ZERO, |node| world[node].translation)
}

impl<'a> Scene<'a> {
    /// Creates the scene of a gaze: the head, or the bone that carries the `eye` of joint 0, in all the frames that are
    /// `drawn`.
    pub(super) fn of_gaze<'f>(
        subject: &BakePage<'a>,
        chain: &ChainNodes,
        eye: Eye,
        view: GazeView,
        drawn: impl Iterator<Item = &'f AimedFrame>,
    ) -> Self {
        let BakePage { document, measurement, .. } = *subject;
        let skeleton = document.skeleton();
        let skinned = SkinnedSurface::new(document);
        let surface = &skinned.surface;
        let Eye { node: first, centre: origin, forward } = eye;
        let bind = &measurement.bind_world;
        let role = |node: usize| measurement.bone(node).and_then(|bone| bone.role);
        let is_eye =
            chain.other_eye.is_some() || matches!(role(first), Some(Role::LeftEye | Role::RightEye | Role::Eyes));
        let mut eyes = Vec::new();
        if is_eye {
            eyes.push(eye);
            let forward = bind[first].transform_vector3(forward);
            eyes.extend(chain.other_eye.map(|node| Eye {
                node,
                centre: DVec3::ZERO,
                forward: bind[node].inverse().transform_vector3(forward).normalize_or_zero(),
            }));
        }
        // The framed surface is that of the nearest bone with the role head, or else of the eye's parent, or, if the
        // effector is not an eye, of its own bone.
        let carrier = skeleton.ancestry(first).find(|node| role(*node) == Some(Role::Head));
        let carrier = carrier.or_else(|| skeleton.parents()[first].filter(|_| is_eye)).unwrap_or(first);
        let positions = Palette::new(skeleton, bind).positions(surface);
        let head = extent(document, surface, &positions, carrier);
        let eye_bind = bind[first].transform_point3(origin);
        let follows = chain.joints.last().and_then(|node| skeleton.parents()[*node]);
        let places = drawn.map(|frame| frame.world[first].transform_point3(origin) - at(follows, &frame.world));
        let (camera, picture) = match view {
            GazeView::Head(stand) => {
                let camera = FollowingCamera::new(measurement, stand, follows, eye_bind);
                (camera.framing(measurement, head, eye_bind, places), OF_GAZE)
            }
            GazeView::Eyes => (FollowingCamera::before_eyes(measurement, carrier, &eyes, head), OF_EYES),
        };
        Self { document, measurement, skinned, joints: chain.joints.clone(), eyes, camera, picture }
    }

    /// Creates the scene of a limb: the whole character in each of the poses `worlds`, and the limb's target.
    pub(super) fn of_limb<'w>(
        document: &'a Document,
        measurement: &'a Measurement,
        limb: LimbNodes,
        worlds: impl Iterator<Item = &'w Vec<DAffine3>>,
        target: DVec3,
    ) -> Self {
        let (skeleton, skinned, bind) = (document.skeleton(), SkinnedSurface::new(document), &measurement.bind_world);
        let character = worlds.flat_map(|world| {
            let skin = Palette::new(skeleton, world).positions(&skinned.surface);
            let bones = || measurement.bones.iter().map(|bone| world[bone.node].translation).collect();
            if skin.is_empty() { bones() } else { skin }
        });
        let camera = FollowingCamera::new(measurement, BEFORE_THE_LIMB, None, bind[limb.tip].translation);
        let camera = camera.around(character, target);
        let joints = vec![limb.upper, limb.lower, limb.tip];
        Self { document, measurement, skinned, joints, eyes: Vec::new(), camera, picture: OF_LIMB }
    }

    /// Returns `true` if the surface has eyeballs.
    pub(super) fn has_eyeballs(&self) -> bool {
        let surface = &self.skinned.surface;
        let is_eye = |node: Option<usize>| self.eyes.iter().any(|eye| Some(eye.node) == node);
        surface.triangles().iter().any(|t| is_eye(surface.node_of(self.document.skeleton(), t.vertices[0])))
    }

    /// Draws the surface, or the bones if there is none.
    pub(super) fn character(&self, world: &[DAffine3]) -> Markup {
        match self.figure(world) {
            Some(uri) => html! { image width=(n(WIDTH)) height=(n(self.picture.height)) href=(uri) {} },
            None => self.bones(world),
        }
    }

    /// Returns the surface as a `data:` URI; `None` if nothing is visible.
    fn figure(&self, world: &[DAffine3]) -> Option<String> {
        let (skeleton, surface) = (self.document.skeleton(), &self.skinned.surface);
        let paint = |triangle: &Triangle| {
            let node = surface.node_of(skeleton, triangle.vertices[0]);
            if let Some(eye) = self.eyes.iter().find(|eye| Some(eye.node) == node) {
                let centre = world[eye.node].transform_point3(eye.centre);
                let gaze = world[eye.node].transform_vector3(eye.forward).normalize_or_zero();
                return Paint::Eye { centre, gaze };
            }
            let material = triangle.material.map(|at| &surface.materials()[at]);
            Paint::Plain(material.filter(|material| material.texture.is_none()).map_or(CLAY, |m| srgb(m.colour)))
        };
        let Picture { height, pixels, fade } = self.picture;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few hundred")]
        let [width, height] = [WIDTH, height].map(|size| (size * pixels) as usize);
        let mut picture = Raster::new(width, height, fade);
        picture.draw_surface(&self.skinned, world, (&self.camera.view_of(world), pixels), paint);
        picture.data_uri()
    }

    /// Draws lines from bone to bone, and circles at the joints of the rig or limb.
    fn bones(&self, world: &[DAffine3]) -> Markup {
        let parents = self.document.skeleton().parents();
        let shown = |node: usize| self.camera.project(world[node].translation, world);
        let lines = self.measurement.bones.iter().filter_map(|bone| Some((bone.node, parents[bone.node]?)));
        html! {
            @for (node, parent) in lines { (segment("bone", shown(parent), shown(node))) }
            @for &joint in &self.joints {
                @let p = shown(joint);
                @if p.is_finite() { circle.joint cx=(n(p.x)) cy=(n(p.y)) r="4.5" {} }
            }
        }
    }
}

/// Returns the extent of the surface on `carrier`, or, if it has none, of the surface on the bones below it.
fn extent(document: &Document, surface: &Surface, positions: &[DVec3], carrier: usize) -> Option<(DVec3, DVec3)> {
    let skeleton = document.skeleton();
    let below: Vec<bool> = (0..skeleton.len()).map(|node| skeleton.ancestry(node).any(|at| at == carrier)).collect();
    let among = |wanted: &dyn Fn(usize) -> bool| {
        let vertices = surface.triangles().iter().flat_map(|triangle| triangle.vertices);
        let on_it = vertices.filter(|vertex| surface.node_of(skeleton, *vertex).is_some_and(wanted));
        let finite = on_it.map(|vertex| positions[vertex]).filter(|p| p.is_finite());
        ends(finite)
    };
    among(&|node| node == carrier).or_else(|| among(&|node| below[node]))
}

fn srgb(linear: [f32; 4]) -> [f64; 3] {
    // A tenth of clay keeps black cloth visible on a dark page.
    std::array::from_fn(|i| 0.9 * f64::from(linear[i]).powf(1.0 / 2.2) + 0.1 * CLAY[i])
}
