//! Builds the picture of a stage: the figures, and rays, cones, axes and trails that visualise the aiming.

use std::f32::consts::PI;

use aim_character::{AimedFrame, range_in_frame};
use aim_runtime::glam::{DAffine3, DVec3, Quat, Vec3};
use aim_runtime::{Solver, Status};

use crate::actor::Actor;
use crate::camera::Camera;
use crate::feet::Feet;
use crate::picture::{Colour, Fan, Ground, Picture, Rod};
use crate::pointed;
use crate::stage::Stage;

/// Parts of the scene that are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shown {
    /// Local axes of the bones.
    pub axes: bool,
    /// Rays of the gazes.
    pub gaze: bool,
    /// Ranges of motion of the joints, as cones.
    pub limits: bool,
    /// Bounding boxes of the bones, and the triangle under the mouse pointer.
    pub boxes: bool,
    /// A lamp in the right hand.
    pub lamp: bool,
    /// A sloped floor with planted feet.
    pub feet: bool,
    /// Trail of the target.
    pub trail: bool,
    /// Plots of the error and the angles over time.
    pub plots: bool,
    /// Time that solving takes.
    pub timing: bool,
    /// The settings panel.
    pub panel: bool,
    /// Dark background.
    pub dark: bool,
}

impl Default for Shown {
    fn default() -> Self {
        Self {
            axes: false,
            gaze: true,
            limits: false,
            boxes: false,
            lamp: false,
            feet: false,
            trail: true,
            plots: true,
            timing: true,
            panel: true,
            dark: true,
        }
    }
}

// The palette of Okabe and Ito, which is distinguishable with colour blindness.
pub(crate) const GREEN: Colour = [0, 158, 115, 255];
pub(crate) const ORANGE: Colour = [230, 159, 0, 255];
pub(crate) const VERMILION: Colour = [213, 94, 0, 255];
pub(crate) const BLUE: Colour = [86, 180, 233, 255];
pub(crate) const PURPLE: Colour = [204, 121, 167, 255];
/// Colours of a bone's X, Y and Z axes: red, green and blue, as usual.
const AXES: [Colour; 3] = [[232, 72, 85, 255], [120, 190, 60, 255], [66, 135, 245, 255]];
/// Colours of each joint's cone and curves, from the effector inward.
const CONES: [Colour; 4] = [[86, 180, 233, 70], [230, 159, 0, 60], [204, 121, 167, 60], [0, 158, 115, 60]];

/// Radius of the target, metres of a 1.7 m character.
pub(crate) const TARGET: f32 = 0.035;
/// Radius of gaze rays, metres of a 1.7 m character.
const RAY: f32 = 0.004;
/// Radius of the points at which feet are planted, metres of a 1.7 m character.
const ANCHOR: f32 = 0.018;
/// Radius of the axes of an aimed bone, metres of a 1.7 m character. Other bones have half of it.
const AXIS: f32 = 0.005;
/// Radius of the target's trail, metres of a 1.7 m character.
const TRAIL: f32 = 0.003;
/// Length of the axes of an aimed bone, metres of a 1.7 m character.
const AXIS_LENGTH: f32 = 0.14;
/// Length of the axes of other bones, metres of a 1.7 m character.
const SMALL_AXIS_LENGTH: f32 = 0.05;
/// Length of limit cones, metres of a 1.7 m character.
const CONE_LENGTH: f32 = 0.3;

/// Returns the colour of a solver's curves.
pub(crate) fn colour_of_solver(solver: Solver) -> Colour {
    match solver {
        Solver::Natural => BLUE,
        Solver::Exact => ORANGE,
        _ => PURPLE,
    }
}

/// Returns the colour of a joint's curves: the colour of its cone, opaque.
pub(crate) fn colour_of_joint(at: usize) -> Colour {
    let [r, g, b, _] = CONES[at % CONES.len()];
    [r, g, b, 255]
}

/// Returns the colour of a gaze with this status.
pub(crate) fn colour_of(status: Status) -> Colour {
    match status {
        Status::Reached => GREEN,
        Status::RateLimited => ORANGE,
        Status::AtLimit => VERMILION,
        Status::Behind => PURPLE,
        _ => VERMILION,
    }
}

impl Stage {
    /// Returns the picture as seen by the camera.
    pub(crate) fn picture(&self, camera: &Camera, shown: Shown) -> Picture {
        let character = &self.character;
        let metre = character.metre();
        let [up, ..] = character.directions();
        let mut picture = Picture {
            view: camera.view(metre),
            surface: character.surface.clone(),
            skinning: character.skinning.clone(),
            figures: Vec::new(),
            rods: Vec::new(),
            fans: Vec::new(),
            ground: Ground {
                centre: character.floor,
                up: if self.is_sloped { self.slope.normal } else { up },
                radius: 6.0 * metre,
                step: 0.5 * metre,
            },
            dark: shown.dark,
        };
        for (at, actor) in self.actors.iter().enumerate() {
            if let Some(frame) = &actor.frame {
                self.show(&mut picture, (at, actor), frame, shown);
            }
        }
        for member in &self.crowd {
            if let Some(frame) = &member.frame {
                picture.figures.push(self.character.skinning.figure(&member.posed, member.shift));
                if shown.gaze {
                    self.show_gaze(&mut picture, member, frame);
                }
            }
        }
        picture
    }

    fn show(&self, picture: &mut Picture, (at, actor): (usize, &Actor), frame: &AimedFrame, shown: Shown) {
        let metre = self.character.metre();
        picture.figures.push(self.character.skinning.figure(&actor.posed, actor.shift));
        let target = self.target_now() + actor.shift;
        let (radius, colour) = (TARGET * metre, VERMILION);
        picture.rods.push(Rod { from: target, to: target, radius, colour, is_lit: true, in_front: false });
        if shown.gaze {
            self.show_gaze(picture, actor, frame);
        }
        if shown.trail {
            let step = |a: &crate::stage::Memory, b: &crate::stage::Memory| Rod {
                from: a.target + actor.shift,
                to: b.target + actor.shift,
                radius: TRAIL * metre,
                colour: [213, 94, 0, 120],
                ..Rod::default()
            };
            let (before, after) = (self.memory.iter(), self.memory.iter().skip(1));
            let moved = before.zip(after).filter(|(a, b)| a.target.distance(b.target) > 1e-4 * metre);
            picture.rods.extend(moved.map(|(a, b)| step(a, b)));
        }
        if shown.axes {
            self.show_axes(picture, frame, actor.shift);
        }
        if shown.limits {
            self.show_limits(picture, actor, frame);
        }
        if shown.boxes {
            let pointed = self.pointed.as_ref().filter(|pointed| pointed.actor == at);
            pointed::show(picture, &self.character, actor, pointed);
        }
        for anchor in actor.feet.iter().flat_map(Feet::anchors) {
            let (radius, colour) = (ANCHOR * metre, GREEN);
            picture.rods.push(Rod { from: anchor, to: anchor, radius, colour, is_lit: true, in_front: true });
        }
        if let Some(lamp) = self.lamp.filter(|_| shown.lamp) {
            lamp.show(picture, &frame.world, actor.shift);
        }
    }

    /// Adds a ray from each eye along its gaze, as long as the distance to the target.
    fn show_gaze(&self, picture: &mut Picture, actor: &Actor, frame: &AimedFrame) {
        let shift = actor.shift;
        let radius = RAY * self.character.metre();
        let colour = colour_of(frame.outcome.status);
        let target = frame.target.as_vec3();
        picture.rods.extend(actor.gazes.iter().map(|&[from, direction]| {
            let to = from + direction * from.distance(target);
            Rod { from: from + shift, to: to + shift, radius, colour, ..Rod::default() }
        }));
    }

    /// Adds the local X, Y and Z axes of each bone, as in the paper's figures; those of aimed bones are longer.
    fn show_axes(&self, picture: &mut Picture, frame: &AimedFrame, shift: Vec3) {
        let metre = self.character.metre();
        let chain = &self.character.chain;
        for bone in &self.character.measurement.bones {
            let at = &frame.world[bone.node];
            let is_aimed = chain.joints.contains(&bone.node) || chain.other_eye == Some(bone.node);
            let (length, radius) = if is_aimed { (AXIS_LENGTH, AXIS) } else { (SMALL_AXIS_LENGTH, AXIS / 2.0) };
            let from = at.translation.as_vec3() + shift;
            for (axis, colour) in DVec3::AXES.into_iter().zip(AXES) {
                let direction = at.transform_vector3(axis).as_vec3().normalize_or_zero();
                let to = from + direction * (length * metre);
                picture.rods.push(Rod { from, to, radius: radius * metre, colour, is_lit: false, in_front: true });
            }
        }
    }

    /// Adds each joint's range of motion, relative to its forward direction without its own correction.
    fn show_limits(&self, picture: &mut Picture, actor: &Actor, frame: &AimedFrame) {
        let length = CONE_LENGTH * self.character.metre();
        for (at, &correction) in actor.character.corrections().iter().enumerate() {
            let Some(&node) = self.character.chain.joints.get(at) else { continue };
            let joint = &self.tuning.spec.joints[at];
            let [up, forward, left] = [joint.frame.up, joint.frame.forward, joint.frame.left].map(direction);
            let unturned = unturned(&frame.world[node], correction);
            let ends = |ends: [f64; 2]| ends.map(|end| single(end).clamp(-PI, PI));
            let [heading, pitch] = range_in_frame(joint, &frame.joints[at]).map(ends);
            let apex = frame.world[node].translation.as_vec3() + actor.shift;
            let point = |[heading, pitch]: [f32; 2]| {
                let ((sh, ch), (sp, cp)) = (heading.sin_cos(), pitch.sin_cos());
                apex + unturned(forward * (ch * cp) + left * (sh * cp) + up * sp) * length
            };
            let rim = around(heading, pitch).map(point).collect();
            picture.fans.push(Fan { apex, rim, colour: CONES[at % CONES.len()] });
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "angles and directions are drawn in single precision")]
fn single(x: f64) -> f32 {
    x as f32
}

fn direction(v: [f64; 3]) -> Vec3 {
    DVec3::from_array(v).as_vec3()
}

/// Returns a map from a bone's local directions to unit vectors in the world, without the bone's correction.
fn unturned(world: &DAffine3, correction: Quat) -> impl Fn(Vec3) -> Vec3 {
    let (world, back) = (*world, correction.inverse());
    move |v| world.transform_vector3((back * v).as_dvec3()).as_vec3().normalize_or_zero()
}

/// Returns points along the outline of a heading × pitch rectangle, in order.
fn around(heading: [f32; 2], pitch: [f32; 2]) -> impl Iterator<Item = [f32; 2]> {
    const STEPS: u8 = 16;
    let side = |a: [f32; 2], b: [f32; 2]| {
        (0..STEPS).map(move |k| {
            let share = f32::from(k) / f32::from(STEPS);
            [a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share]
        })
    };
    let [[left, right], [low, high]] = [[heading[1], heading[0]], pitch];
    let corners = [[left, low], [right, low], [right, high], [left, high], [left, low]];
    corners.into_iter().zip(corners.into_iter().skip(1)).flat_map(move |(a, b)| side(a, b))
}
