//! [`Lamp`]: a thing in the right hand.

use aim_animation::attached;
use aim_runtime::glam::{Affine3A, DAffine3, Mat3A, Vec3};

use crate::character::Character;
use crate::picture::{Colour, Fan, Picture, Rod};

/// Ends of the handle and of the head along the lamp, and how far it shines, metres of a character of 1.7 m; its handle
/// lies in the hand.
const ENDS: [f32; 4] = [-0.07, 0.08, 0.15, 0.75];
/// Radii of handle, head and light.
const RADII: [f32; 3] = [0.016, 0.03, 0.16];
const HANDLE: Colour = [60, 60, 66, 255];
const HEAD: Colour = [230, 230, 224, 255];
const LIGHT: Colour = [255, 226, 130, 70];
/// Corners of the light's rim.
const CORNERS: u8 = 24;
/// From the wrist to the middle of the hand.
const PALM: f32 = 0.08;

/// A lamp, and how the hand holds it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lamp {
    hand: usize,
    /// The lamp in the space of the hand: it shines along its Z, and its units are the file's.
    grip: Affine3A,
    metre: f32,
}

impl Lamp {
    /// In the middle of the hand, along the forearm as the bind pose has it. `None` without a right hand.
    pub(crate) fn new(character: &Character) -> Option<Self> {
        let hand = character.hand?;
        let bind = &character.measurement.bind_world;
        let wrist = bind[hand].translation.as_vec3();
        let metre = character.metre();
        // Some forearms end in a bone that only twists, at the wrist.
        let mut inward = character.skeleton().ancestry(hand).map(|bone| bind[bone].translation.as_vec3());
        let elbow = inward.find(|at| at.distance(wrist) > PALM * metre)?;
        let along = (wrist - elbow).try_normalize()?;
        let (side, across) = along.any_orthonormal_pair();
        let placed = Affine3A {
            matrix3: Mat3A::from_cols(side.into(), across.into(), along.into()),
            translation: (wrist + along * (PALM * metre)).into(),
        };
        let back = bind[hand].inverse().as_affine3a();
        back.is_finite().then(|| Self { hand, grip: back * placed, metre })
    }

    /// Where it is with the nodes in the world.
    pub(crate) fn place(&self, world: &[DAffine3]) -> Affine3A {
        attached(&world[self.hand].as_affine3a(), &self.grip)
    }

    pub(crate) fn show(&self, picture: &mut Picture, world: &[DAffine3], shift: Vec3) {
        let place = self.place(world);
        let at = |point: Vec3| place.transform_point3(point * self.metre) + shift;
        let [back, neck, front, far] = ENDS.map(|end| at(Vec3::Z * end));
        let [handle, head, _] = RADII.map(|radius| radius * self.metre);
        let rod = |from, to, radius, colour| Rod { from, to, radius, colour, is_lit: true, in_front: false };
        picture.rods.push(rod(back, neck, handle, HANDLE));
        picture.rods.push(rod(neck, front, head, HEAD));
        let corner = |corner: u8| {
            let (sin, cos) = (std::f32::consts::TAU * f32::from(corner) / f32::from(CORNERS)).sin_cos();
            at(Vec3::new(RADII[2] * cos, RADII[2] * sin, ENDS[3]))
        };
        if far.is_finite() {
            picture.fans.push(Fan { apex: front, rim: (0..CORNERS).map(corner).collect(), colour: LIGHT });
        }
    }
}
