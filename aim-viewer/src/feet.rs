//! [`Feet`]: planted feet on a sloped floor.

use aim_animation::{Figure, Ground, Layer as _, Plant, PoseError, Stance, Transform};
use aim_character::Role;
use aim_gltf::Skeleton;
use aim_runtime::glam::Vec3;

use crate::character::Character;

/// Slope of the floor in the character's forward direction, rise over run.
const AHEAD: f32 = 0.16;
/// Slope of the floor to the character's left, rise over run.
const LEFT: f32 = 0.1;
/// Horizontal distance from the ankle to the ball of the foot, metres of a 1.7 m character.
const BALL: f32 = 0.1;
/// Height of the ball above the floor below which a foot may be planted, metres of a 1.7 m character.
const LOW: f32 = 0.045;
/// Speed of the ball up to which a foot may be planted, metres of a 1.7 m character per second.
const SLOW: f32 = 0.35;
/// Movement in one frame above which the foot is taken to have jumped, as when a clip restarts, metres of a 1.7 m
/// character.
const JUMP: f32 = 0.5;

/// The sloped floor: a plane through the point below the character.
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

    /// Returns the height of the floor at a point, relative to the floor's centre.
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
    /// For each foot, the node of the ankle, and the position of the ball in the ankle's space.
    balls: Vec<(usize, Vec3)>,
    pelvis: usize,
    metre: f32,
    /// Animated positions of the balls in the previous frame.
    before: Vec<Vec3>,
}

impl Feet {
    /// Returns `None` if the names of the bones do not identify the character's legs.
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

    /// Adapts the pose of a figure with offset `shift` to the slope.
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
            // A foot stands if its animated ball is low and slow.
            let height = (balls[at] - slope.centre).dot(slope.up);
            let way = self.before.get(at).map_or(0.0, |before| balls[at].distance(*before));
            if way > JUMP * metre {
                foot.reset();
            }
            let stands = height < LOW * metre && way <= SLOW * metre * dt;
            // A frame without time changes no foot.
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

    /// Returns the points at which feet are planted.
    pub(crate) fn anchors(&self) -> impl Iterator<Item = Vec3> {
        self.plants().iter().filter_map(Plant::anchor)
    }

    pub(crate) fn plants(&self) -> &[Plant] {
        self.stance.feet()
    }

    /// Returns, for each foot, the node of the ankle and the position of the ball in the ankle's space.
    #[cfg(test)]
    pub(crate) fn balls(&self) -> impl Iterator<Item = (usize, Vec3)> {
        self.balls.iter().copied()
    }
}

/// Returns the first bone of each leg whose name contains `foot`, at least three bones below the pelvis, so that the
/// pelvis, a thigh and a shank lie above it.
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
