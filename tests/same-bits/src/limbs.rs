//! The solvers other than the aim solvers, one after another on the same bones.

use aim::Axes;
use aim::glam::{Affine3A, Quat, Vec3};
use aim::ik::{
    AimPose, AimPoses, Bend, Ccd, CcdJoint, CcdLimit, Hinge, Limb, LookAt, OneBone, Path, Roll, TwoBone, triangulated,
};
use aim::rotation::{nlerp, slerp};

use crate::{FRAMES, Fnv, World};

/// Axes of eye and neck.
const AXES: Axes = Axes { up: [1.0, 0.0, 0.0], forward: [0.0, 1.0, 0.0], left: [0.0, 0.0, 1.0] };

pub(crate) fn run(mut world: World) -> u64 {
    let mut hash = Fnv::default();
    let look = LookAt::new(AXES, AXES).with_heading(-1.0, 1.1).with_pitch(-0.6, 0.5).with_speed(3.0);
    let mut head = world.pose().joints[0];
    for frame in 0..FRAMES {
        world.pass(frame, false);
        let [eye, neck, spine] = world.pose().joints;
        let [root, middle, tip] = [spine, neck, eye].map(|bone| Vec3::from(bone.translation));
        let target = Vec3::new(0.2 * world.target.x, 1.3 + 0.2 * world.target.y, 0.2 * world.target.z);

        let bend = if frame % 2 == 0 { Bend::AsAnimated } else { Bend::Pole(world.target) };
        let mut two = TwoBone::new().with_softening(0.95).with_twist(0.2);
        two.bend = bend;
        if frame % 3 == 0 {
            two = two.with_hinge(Hinge { axis: Vec3::X, least_rad: 0.1, most_rad: 2.0 });
        }
        let outcome = two.solve(&Limb { root, middle, tip }, target);
        hash.turns(&[outcome.upper, outcome.lower]);

        let hinge = CcdLimit::Hinge { axis: Vec3::X, least_rad: -1.0, most_rad: 0.7 };
        let mut chain =
            [CcdJoint::new(root).with_limit(CcdLimit::Ball { most_rad: 1.0 }), CcdJoint::new(middle).with_limit(hinge)];
        hash.float(Ccd::new().with_iterations(10).solve(&mut chain, tip, target).error);
        hash.turns(&chain.map(|joint| joint.turn));

        let path = if frame % 400 < 200 { Path::Level } else { Path::Slerp };
        let outcome = look.with_path(path).solve(&neck, &head, world.target, world.dt);
        hash.turns(&[outcome.turn]);
        head = Affine3A { translation: eye.translation, ..Affine3A::from_quat(outcome.turn) * head };

        let roll = Roll::Up { bone: Vec3::X, space: Vec3::Y };
        let one = OneBone::new(Vec3::Y).with_roll(roll).with_weight(0.9).solve(&eye, world.target - tip).turn;
        hash.turns(&[one]);
        by_poses(&mut hash, world.target - tip, [slerp(outcome.turn, one, 0.3), nlerp(outcome.turn, one, 0.6)]);
    }
    hash.0
}

/// Runs aim poses of one bone that look up, down and to the sides, with a second bone that disturbs the blend.
fn by_poses(hash: &mut Fnv, wanted: Vec3, [a, b]: [Quat; 2]) {
    let looks = [[0.3, 0.0], [-0.3, 0.0], [0.0, 0.3], [0.0, -0.3], [0.05, 0.02]];
    let rotations = looks.map(|[x, y]: [f32; 2]| {
        let w = (1.0 - x * x - y * y).sqrt();
        [Quat::from_xyzw(x, y, 0.0, w), if x > y { a } else { b }]
    });
    // The rotated −Z.
    let aim = |rotations: &[Quat]| {
        let [x, y, z, w] = rotations[0].to_array();
        Vec3::new(-2.0 * (x * z + w * y), -2.0 * (y * z - w * x), 2.0 * (x * x + y * y) - 1.0)
    };
    let poses: [_; 5] = core::array::from_fn(|i| AimPose { direction: aim(&rotations[i]), rotations: &rotations[i] });
    let mut triangles = [[0; 3]; 6];
    let Some(triangles) = triangulated(&poses.map(|pose| pose.direction), &mut triangles) else { return };
    let mut blended = [Quat::IDENTITY; 2];
    let outcome = AimPoses::new(&poses, triangles).solve(wanted, &mut blended, aim);
    hash.float(outcome.remaining_rad);
    hash.turns(&blended);
}
