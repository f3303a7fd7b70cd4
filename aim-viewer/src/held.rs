//! [`Lamp`]: a lamp attached to the right hand.

use aim_animation::attached;
use aim_runtime::glam::{Affine3A, DAffine3, Mat3A, Vec3};

use crate::character::Character;
use crate::picture::{Colour, Fan, Picture, Rod};

/// Positions along the lamp: back and front of the handle, front of the head, end of the light; metres of a 1.7 m
/// character. The origin lies in the hand.
const ENDS: [f32; 4] = [-0.07, 0.08, 0.15, 0.75];
/// Radii of the handle, the head, and the end of the light, metres of a 1.7 m character.
const RADII: [f32; 3] = [0.016, 0.03, 0.16];
const HANDLE: Colour = [60, 60, 66, 255];
const HEAD: Colour = [230, 230, 224, 255];
const LIGHT: Colour = [255, 226, 130, 70];
/// Number of corners of the light's rim.
const CORNERS: u8 = 24;
/// Distance from the wrist to the middle of the hand, metres of a 1.7 m character.
const PALM: f32 = 0.08;

/// A lamp and its attachment to the hand.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lamp {
    hand: usize,
    /// Transform of the lamp in the hand's space, in the file's units. The lamp shines along its Z.
    grip: Affine3A,
    metre: f32,
}

impl Lamp {
    /// Places the lamp in the middle of the right hand, along the forearm in the bind pose. Returns `None` if the
    /// character has no right hand.
    pub(crate) fn new(character: &Character) -> Option<Self> {
        let hand = character.hand?;
        let bind = &character.measurement.bind_world;
        let wrist = bind[hand].translation.as_vec3();
        let metre = character.metre();
        // Skip twist bones at the wrist, which some forearms have.
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

    /// Returns the lamp's world transform for these world transforms of the nodes.
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
