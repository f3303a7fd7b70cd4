//! [`Feet`]: planted feet on a sloped floor.

use aim_animation::{Figure, Ground, Layer as _, Plant, PoseError, Stance, Transform};
use aim_character::Role;
use aim_gltf::Skeleton;
use aim_runtime::glam::Vec3;

use crate::character::Character;

/// How far the floor rises for a way ahead and to the left.
const AHEAD: f32 = 0.16;
const LEFT: f32 = 0.1;
/// From the ankle to the ball, metres of a character of 1.7 m.
const BALL: f32 = 0.1;
/// A foot stands while its ball is no higher and no faster than this: metres, and metres a second, of a character of 1.7 m.
const LOW: f32 = 0.045;
const SLOW: f32 = 0.35;
/// What goes further than this in a frame has jumped: a clip that begins again. Metres of a character of 1.7 m.
const JUMP: f32 = 0.5;

/// A plane through the point below the character.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Slope {
    centre: Vec3,
    up: Vec3,
    pub(crate) normal: Vec3,
}

impl Slope {
    pub(crate) fn new(character: &Character) -> Self {
        let [up, forward, left] = character.directions();
        let normal = (up - forward * AHEAD - left * LEFT).normalize_or(up);
        Self { centre: character.floor, up, normal }
    }

    /// Height of the floor at a point over the floor's middle.
    pub(crate) fn height(&self, point: Vec3) -> f32 {
        let off = point - self.centre;
        (off - self.up * off.dot(self.up)).dot(self.normal) / -self.up.dot(self.normal)
    }

    fn ground(&self, point: Vec3) -> Ground {
        let over = (point - self.centre).dot(self.up);
        Ground::new(point + self.up * (self.height(point) - over), self.normal)
    }
}

/// The feet of one character.
#[derive(Clone, Debug)]
pub(crate) struct Feet {
    figure: Figure,
    stance: Stance,
    /// The ankles, and the balls in their spaces.
    balls: Vec<(usize, Vec3)>,
    pelvis: usize,
    metre: f32,
    /// Where the balls were in the frame before, as animated.
    before: Vec<Vec3>,
}

impl Feet {
    /// `None` of a character whose legs are not told by the names of its bones.
    pub(crate) fn new(character: &Character) -> Option<Self> {
        let skeleton = character.skeleton();
        let pelvis = character.measurement.with_role(Role::Hips)?.node;
        let rest = skeleton.world_f64(&[]);
        let [up, forward, _] = character.directions();
        let feet = feet(skeleton, pelvis);
        let mut plants = Vec::new();
        let mut balls = Vec::new();
        for &foot in &feet {
            let bind = character.measurement.bind_world[foot];
            let ankle = bind.translation.as_vec3();
            let ball = ankle - up * (ankle - character.floor).dot(up) + forward * (BALL * character.metre());
            let of_foot = bind.inverse().transform_point3(ball.as_dvec3());
            let at_rest = rest[foot].transform_point3(of_foot).as_vec3();
            let mut leg: Vec<usize> = skeleton.ancestry(foot).take(3).collect();
            leg.reverse();
            plants.push(Plant::new(skeleton, leg, at_rest).ok()?);
            balls.push((foot, of_foot.as_vec3()));
        }
        let mut stance = Stance::new(skeleton, pelvis, plants).ok().filter(|_| !feet.is_empty())?;
        stance.up = up;
        let bones: &aim_animation::Skeleton = skeleton;
        Some(Self {
            figure: Figure::new(bones.clone()),
            stance,
            balls,
            pelvis,
            metre: character.metre(),
            before: Vec::new(),
        })
    }

    /// Puts a pose that is so far aside onto the slope.
    pub(crate) fn apply(
        &mut self,
        slope: &Slope,
        shift: Vec3,
        dt: f32,
        pose: &mut [Transform],
    ) -> Result<(), PoseError> {
        self.figure.edit(|local| {
            local.copy_from_slice(pose);
            Ok::<(), PoseError>(())
        })?;
        let metre = self.metre;
        let model = self.figure.model();
        let balls: Vec<Vec3> = self.balls.iter().map(|&(bone, ball)| model[bone].transform_point3(ball)).collect();
        let raised = slope.up * slope.height(Vec3::from(model[self.pelvis].translation) + shift);
        for (at, foot) in self.stance.feet_mut().iter_mut().enumerate() {
            // As animated: low, and at rest.
            let height = (balls[at] - slope.centre).dot(slope.up);
            let way = self.before.get(at).map_or(0.0, |before| balls[at].distance(*before));
            if way > JUMP * metre {
                foot.reset();
            }
            let stands = height < LOW * metre && way <= SLOW * metre * dt;
            // Nothing is decided while no time passes.
            if dt > 0.0 && stands {
                foot.plant();
            } else if dt > 0.0 {
                foot.release();
            }
        }
        if dt > 0.0 {
            self.before = balls;
        }
        self.figure.place = Transform::from_translation(shift + raised);
        self.stance.on(|point| slope.ground(point)).apply(&mut self.figure, dt)?;
        pose.copy_from_slice(self.figure.local());
        let roots = self.figure.skeleton().parents().iter().zip(pose);
        roots.filter(|(parent, _)| parent.is_none()).for_each(|(_, root)| root.translation += raised);
        Ok(())
    }

    /// Points at which the feet are planted.
    pub(crate) fn anchors(&self) -> impl Iterator<Item = Vec3> {
        self.plants().iter().filter_map(Plant::anchor)
    }

    pub(crate) fn plants(&self) -> &[Plant] {
        self.stance.feet()
    }

    /// The ankles, and the balls in their spaces.
    #[cfg(test)]
    pub(crate) fn balls(&self) -> impl Iterator<Item = (usize, Vec3)> {
        self.balls.iter().copied()
    }
}

/// The first bone that is named for a foot, of each leg: a pelvis, a thigh and a shank are above it.
fn feet(skeleton: &Skeleton, pelvis: usize) -> Vec<usize> {
    let name = |bone: usize| skeleton.nodes()[bone].vrm_bone.as_ref().unwrap_or(&skeleton.names()[bone]).to_lowercase();
    let mut found: Vec<usize> = Vec::new();
    for bone in skeleton.subtree(pelvis).skip(3) {
        let depth = skeleton.ancestry(bone).position(|above| above == pelvis).unwrap_or(0);
        let is_new = !found.iter().any(|foot| skeleton.subtree(*foot).contains(&bone));
        if depth >= 3 && is_new && name(bone).contains("foot") {
            found.push(bone);
        }
    }
    found
}
