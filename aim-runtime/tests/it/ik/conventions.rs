//! A chain authored in each convention gives the same picture: 24 right-handed and 24 left-handed triples of bone axes,
//! the latter as mirrored bones, and all of them in a mirrored world, too.

use aim_runtime::Axes;
use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3};
use aim_runtime::ik::{
    AimPose, AimPoses, AimPosesStatus, Ccd, CcdJoint, CcdLimit, Limb, LookAt, OneBone, OneBoneStatus, Roll, TwoBone,
    grid,
};

use crate::common::{Rng, bone, triples};

/// Positions of chest, upper arm or neck, forearm or head, hand or eye: each the parent of the next.
const PLACES: [Vec3; 4] =
    [Vec3::new(0.0, 1.3, 0.0), Vec3::new(-0.2, 1.4, 0.05), Vec3::new(-0.5, 1.3, -0.1), Vec3::new(-0.7, 1.2, 0.1)];

type Chain = [Affine3A; 4];

fn chain(axes: &Axes, turns: &[Quat; 4]) -> Chain {
    core::array::from_fn(|i| bone(axes, turns[i], PLACES[i]))
}

/// Returns what a picture shows of each bone: its position and its axes.
fn picture(axes: &Axes, chain: &Chain) -> [Vec3; 12] {
    core::array::from_fn(|i| match i % 3 {
        0 => chain[i / 3].translation.into(),
        1 => chain[i / 3].transform_vector3(axes.forward.into()),
        _ => chain[i / 3].transform_vector3(axes.up.into()),
    })
}

/// Rotates a bone in world space, together with all of its descendants.
fn turn(chain: &mut Chain, which: usize, by: Quat) {
    let carried = chain[which].inverse();
    let mut posed = chain[which];
    posed.matrix3 = Mat3A::from_quat(by) * posed.matrix3;
    chain[which..].iter_mut().for_each(|bone| *bone = posed * (carried * *bone));
}

/// Returns each bone's scale, rotation and translation in its parent's space.
fn parts(chain: &Chain) -> [(Vec3, Quat, Vec3); 4] {
    let parent = |i: usize| if i == 0 { Affine3A::IDENTITY } else { chain[i - 1].inverse() };
    core::array::from_fn(|i| (parent(i) * chain[i]).to_scale_rotation_translation())
}

/// Applies the world-space rotations of a limb's bones, from the root outward, each with all descendants.
fn turn_limb(chain: &mut Chain, first: usize, turns: &[Quat]) {
    let mut before = Quat::IDENTITY;
    for (index, by) in turns.iter().enumerate() {
        turn(chain, first + index, *by * before.conjugate());
        before = *by;
    }
}

/// Runs every solver, one after another, on the same chain.
fn solved(axes: &Axes, mut chain: Chain, target: Vec3) -> Chain {
    let places = chain.map(|bone| Vec3::from(bone.translation));
    let limb = Limb { root: places[1], middle: places[2], tip: places[3] };
    let outcome = TwoBone::new().with_pole(target + Vec3::Y).with_weight(0.7).solve(&limb, target);
    turn_limb(&mut chain, 1, &[outcome.upper, outcome.lower]);
    assert!(Vec3::from(chain[3].translation).distance(outcome.limb.tip) < 1e-4);

    let places = chain.map(|bone| Vec3::from(bone.translation));
    let mut joints = [
        CcdJoint::new(places[0]).with_limit(CcdLimit::Ball { most_rad: 0.3 }),
        CcdJoint::new(places[1]),
        CcdJoint::new(places[2]).with_limit(CcdLimit::Hinge { axis: Vec3::Y, least_rad: -0.5, most_rad: 1.0 }),
    ];
    let outcome = Ccd::new().with_iterations(5).solve(&mut joints, places[3], target * 0.9);
    turn_limb(&mut chain, 0, &joints.map(|joint| joint.turn));
    assert!(Vec3::from(chain[3].translation).distance(outcome.tip) < 1e-4);

    let look = LookAt::new(*axes, *axes).with_heading(-0.8, 0.9).with_pitch(-0.5, 0.6).with_speed(4.0);
    for _ in 0..10 {
        let outcome = look.solve(&chain[1], &chain[2], target, 1.0 / 60.0);
        turn(&mut chain, 2, outcome.turn);
    }

    let roll = Roll::Up { bone: axes.up.into(), space: Vec3::Y };
    let to = target - Vec3::from(chain[3].translation);
    let outcome = OneBone::new(axes.forward.into()).with_roll(roll).with_roll_by(0.2).solve(&chain[3], to);
    assert_eq!(outcome.status, OneBoneStatus::Reached);
    turn(&mut chain, 3, outcome.turn);
    chain
}

/// Returns the chain blended from poses that are authored with its own bones.
fn blended(axes: &Axes, turns: &[Quat; 4], wanted: Vec3) -> Chain {
    let base = chain(axes, turns);
    let rest = parts(&base);
    let with = |rotations: &[Quat]| {
        let mut parent = Affine3A::IDENTITY;
        let model: Chain = core::array::from_fn(|i| {
            let (scale, _, translation) = rest[i];
            parent *= Affine3A::from_scale_rotation_translation(scale, rotations[i], translation);
            parent
        });
        model
    };
    let aim = |rotations: &[Quat]| with(rotations)[3].transform_vector3(axes.forward.into());
    let poses: Vec<[Quat; 4]> = [-0.6_f32, 0.6]
        .iter()
        .flat_map(|&pitch| {
            [-1.0_f32, 0.0, 1.0].map(|heading| {
                let mut posed = base;
                for which in 0..4 {
                    let by = Quat::from_rotation_y(0.25 * heading) * Quat::from_rotation_x(0.25 * pitch);
                    turn(&mut posed, which, by);
                }
                parts(&posed).map(|(_, rotation, _)| rotation)
            })
        })
        .collect();
    let poses: Vec<_> = poses.iter().map(|r| AimPose { direction: aim(r), rotations: r }).collect();
    let mut triangles = [[0; 3]; 4];
    let solver = AimPoses::new(&poses, grid(3, 2, &mut triangles).unwrap()).with_tolerance(1e-5);
    let mut rotations = [Quat::IDENTITY; 4];
    let outcome = solver.solve(wanted, &mut rotations, aim);
    assert_eq!(outcome.status, AimPosesStatus::Reached);
    with(&rotations)
}

#[test]
fn the_same_picture_in_every_convention() {
    let mut rng = Rng(48);
    let reference = triples()[0].0;
    let mut worst = 0.0_f32;
    for _ in 0..20 {
        let turns: [Quat; 4] = core::array::from_fn(|_| Quat::from_axis_angle(rng.direction(), rng.between(0.0, 0.4)));
        let target = Vec3::new(rng.between(-0.8, 0.2), rng.between(0.9, 1.6), rng.between(-0.8, -0.3));
        let wanted = chain(&reference, &turns)[3].transform_vector3(reference.forward.into());
        let by = Quat::from_rotation_y(rng.between(-0.6, 0.6)) * Quat::from_rotation_x(rng.between(-0.3, 0.3));
        let expected = [
            picture(&reference, &solved(&reference, chain(&reference, &turns), target)),
            picture(&reference, &blended(&reference, &turns, by * wanted)),
        ];
        for (axes, _) in triples() {
            let found = [
                picture(&axes, &solved(&axes, chain(&axes, &turns), target)),
                picture(&axes, &blended(&axes, &turns, by * wanted)),
            ];
            for (a, b) in expected.iter().flatten().zip(found.iter().flatten()) {
                worst = worst.max(a.distance(*b));
            }
        }
    }
    println!("pictures differ by {worst:.1e}");
    assert!(worst < 2e-4, "{worst}");
}

/// In a mirrored world, the mirror image of a chain looks at the mirror image of the target.
#[test]
fn the_mirror_image_in_a_mirrored_world() {
    let mirror = Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0));
    let mut rng = Rng(49);
    for (axes, _) in triples() {
        let turns: [Quat; 4] = core::array::from_fn(|_| Quat::from_axis_angle(rng.direction(), rng.between(0.0, 0.4)));
        let target = Vec3::new(rng.between(-0.8, 0.8), rng.between(0.9, 1.6), rng.between(-2.0, -0.3));
        let bones = chain(&axes, &turns);
        let look = LookAt::new(axes, axes).with_heading(-0.8, 0.5).with_pitch(-0.5, 0.6).with_speed(10.0);
        let turn = look.solve(&bones[1], &bones[2], target, 0.05).turn;
        let [neck, head] = [bones[1], bones[2]].map(|bone| mirror * bone);
        let mirrored = look.solve(&neck, &head, mirror.transform_point3(target), 0.05).turn;
        for axis in [axes.forward, axes.up, axes.left] {
            let own = mirror.transform_vector3(turn * bones[2].transform_vector3(axis.into()));
            assert!(own.distance(mirrored * head.transform_vector3(axis.into())) < 1e-5, "{axes:?}");
        }
    }
}
