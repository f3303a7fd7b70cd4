//! Solvers other than the aim solvers turn the mannequin in the same way in the world, whatever axes its bones have.

use aim_animation::{Skeleton, Transform};
use aim_character::{PAPER_AXES, mannequin};
use aim_gltf::Document;
use aim_runtime::Axes;
use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3};
use aim_runtime::ik::{
    AimPose, AimPoses, AimPosesStatus, Ccd, CcdJoint, CcdLimit, CcdStatus, Limb, LookAt, LookAtStatus, OneBone,
    OneBoneStatus, Roll, TwoBone, TwoBoneStatus, grid,
};

/// The mannequin and the transforms of its bones in model space.
struct Character {
    document: Document,
    axes: Axes,
    skeleton: Skeleton,
    world: Vec<Affine3A>,
}

impl Character {
    fn new([up, forward, left]: [[f32; 3]; 3], seconds: f32) -> Self {
        let document = Document::from_bytes(&mannequin(|_| [up, forward, left]).unwrap()).unwrap();
        let skeleton = Skeleton::clone(document.skeleton());
        let world = document.skeleton().world_f64(&document.skeleton().pose(&document.clips()[0], seconds));
        let world = world.iter().map(|bone| bone.as_affine3a()).collect();
        Self { axes: Axes { up, forward, left }, skeleton, world, document }
    }

    fn bone(&self, name: &str) -> usize {
        self.skeleton.find(name).unwrap()
    }

    fn at(&self, bone: usize) -> Vec3 {
        self.world[bone].translation.into()
    }

    fn local(&self) -> Vec<Transform> {
        let mut local = vec![Transform::IDENTITY; self.world.len()];
        self.skeleton.to_local(&self.world, &mut local).unwrap();
        local
    }

    fn pose(&mut self, local: &[Transform]) {
        self.skeleton.to_model(local, &mut self.world).unwrap();
    }

    /// Turns bones and their descendants in world space, each bone by its own rotation.
    fn turn(&mut self, bones: &[usize], turns: &[Quat]) {
        let mut before = Quat::IDENTITY;
        for (&bone, turn) in bones.iter().zip(turns) {
            let mut local = self.local();
            self.world[bone].matrix3 = Mat3A::from_quat(*turn * before.conjugate()) * self.world[bone].matrix3;
            local[bone] = self.local()[bone];
            self.pose(&local);
            before = *turn;
        }
    }

    /// Returns the skinning matrices, world ← mesh, which determine the position of every vertex.
    fn picture(&self) -> Vec<Affine3A> {
        let nodes = self.document.skeleton().nodes().iter().zip(&self.world);
        nodes.filter_map(|(node, world)| Some(*world * node.inverse_bind?.as_affine3a())).collect()
    }
}

/// Solves one arm for a point by two bones, the other by CCD over the whole chain, the head for a target, and the eye
/// exactly.
fn solved(axes: [[f32; 3]; 3]) -> Vec<Affine3A> {
    let mut character = Character::new(axes, 0.31);
    let arm = ["right_upper_arm", "right_lower_arm", "right_hand"].map(|name| character.bone(name));
    let [root, middle, tip] = arm.map(|bone| character.at(bone));
    let target = root + Vec3::new(0.1, 0.05, 0.3);
    let outcome = TwoBone::new().with_pole(root - Vec3::Y).solve(&Limb { root, middle, tip }, target);
    assert_eq!(outcome.status, TwoBoneStatus::Reached);
    character.turn(&arm, &[outcome.upper, outcome.lower]);
    assert!(character.at(arm[2]).distance(target) < 1e-4);

    let chain = ["left_upper_arm", "left_lower_arm", "left_hand"].map(|name| character.bone(name));
    let places = chain.map(|bone| character.at(bone));
    let mut joints = [CcdJoint::new(places[0]).with_limit(CcdLimit::Ball { most_rad: 2.0 }), CcdJoint::new(places[1])];
    let target = places[0] + Vec3::new(-0.1, 0.1, 0.3);
    let outcome = Ccd::new().solve(&mut joints, places[2], target);
    assert_eq!(outcome.status, CcdStatus::Reached);
    character.turn(&chain, &joints.map(|joint| joint.turn));
    assert!(character.at(chain[2]).distance(target) < 1e-3);

    let [neck, head, eye] = ["neck", "head", "left_eye"].map(|name| character.bone(name));
    let target = character.at(eye) + Vec3::new(0.6, 0.2, 1.0);
    let look =
        LookAt::new(character.axes, character.axes).with_heading(-1.0, 1.0).with_pitch(-0.6, 0.6).with_speed(4.0);
    let mut status = LookAtStatus::Turning;
    for _ in 0..30 {
        let outcome = look.solve(&character.world[neck], &character.world[head], target, 1.0 / 60.0);
        character.turn(&[head], &[outcome.turn]);
        status = outcome.status;
    }
    assert_eq!(status, LookAtStatus::Reached);
    let roll = Roll::Up { bone: character.axes.up.into(), space: Vec3::Y };
    let pointed = OneBone::new(character.axes.forward.into()).with_roll(roll);
    let outcome = pointed.solve(&character.world[eye], target - character.at(eye));
    assert_eq!(outcome.status, OneBoneStatus::Reached);
    character.turn(&[eye], &[outcome.turn]);
    character.picture()
}

/// Blends neck and head from six poses.
fn blended(axes: [[f32; 3]; 3]) -> Vec<Affine3A> {
    let mut character = Character::new(axes, 0.31);
    let [neck, head] = ["neck", "head"].map(|name| character.bone(name));
    let rest = character.local();
    let forward = Vec3::from(character.axes.forward);
    let mut poses = Vec::new();
    for pitch in [0.4_f32, -0.4] {
        for heading in [-0.9_f32, 0.0, 0.9] {
            let part = Quat::from_rotation_y(0.5 * heading) * Quat::from_rotation_x(0.5 * pitch);
            character.turn(&[neck, head], &[part, part * part]);
            let local = character.local();
            poses.push((
                character.world[head].transform_vector3(forward),
                [neck, head].map(|bone| local[bone].rotation),
            ));
            character.pose(&rest);
        }
    }
    let poses: Vec<_> =
        poses.iter().map(|(direction, rotations)| AimPose { direction: *direction, rotations }).collect();
    let mut triangles = [[0; 3]; 4];
    let solver = AimPoses::new(&poses, grid(3, 2, &mut triangles).unwrap()).with_tolerance(1e-5);
    let mut rotations = [Quat::IDENTITY; 2];
    let mut posed = |rotations: &[Quat]| {
        let mut local = rest.clone();
        [neck, head].iter().zip(rotations).for_each(|(&bone, rotation)| local[bone].rotation = *rotation);
        character.pose(&local);
        character.world[head].transform_vector3(forward)
    };
    let outcome = solver.solve(Vec3::new(0.4, 0.1, 1.0), &mut rotations, &mut posed);
    assert_eq!(outcome.status, AimPosesStatus::Reached);
    posed(&rotations);
    character.picture()
}

#[test]
fn every_solver_gives_the_same_world_in_every_convention() {
    let pictures = |axes| [solved(axes), blended(axes)].concat();
    let reference = pictures(PAPER_AXES);
    let conventions = crate::conventions();
    assert_eq!(conventions.len(), 48);
    for axes in conventions {
        for (a, b) in reference.iter().zip(pictures(axes)) {
            assert!(a.abs_diff_eq(b, 2e-4), "{axes:?}: {a:?} {b:?}");
        }
    }
}
