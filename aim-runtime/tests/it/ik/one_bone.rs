use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3};
use aim_runtime::ik::{OneBone, OneBoneStatus, Roll};

use crate::common::exact::*;
use crate::common::{Rng, parents};

fn any_bone(rng: &mut Rng) -> Affine3A {
    Affine3A::from_quat(Quat::from_axis_angle(rng.direction(), rng.between(-3.0, 3.0)))
}

fn in_space(bone: &Affine3A, v: Vec3) -> Vec3 {
    bone.transform_vector3(v).normalize()
}

#[test]
fn any_bone_is_turned_along_any_direction() {
    let mut rng = Rng(1);
    for (name, parent, _) in parents() {
        for _ in 0..5000 {
            let bone = parent * any_bone(&mut rng);
            let (axis, to, up) = (rng.direction(), rng.direction(), rng.direction());
            for roll in [Roll::Shortest, Roll::Up { bone: rng.direction(), space: up }] {
                let outcome = OneBone::new(axis * 3.0).with_roll(roll).solve(&bone, to * 7.0);
                assert_eq!(outcome.status, OneBoneStatus::Reached, "{name}");
                assert!(is_sound(outcome.turn));
                let aimed = turned(outcome.turn, exact(in_space(&bone, axis)));
                assert!(angle(aimed, exact(to)) < 1e-5, "{name}: {:e}", angle(aimed, exact(to)));
                match roll {
                    Roll::Shortest => {
                        let shortest = angle(exact(in_space(&bone, axis)), exact(to));
                        assert!((angle_of(outcome.turn) - shortest).abs() < 1e-5, "{name}");
                    }
                    Roll::Up { bone: side, .. } => {
                        // Up, the direction and the bone's own up are coplanar: no roll.
                        let side = turned(outcome.turn, exact(in_space(&bone, side)));
                        let normal = cross(aimed, exact(up));
                        if length(normal) > 0.1 && length(cross(aimed, side)) > 0.1 {
                            assert!((dot(normal, side) / length(normal)).abs() < 1e-5, "{name}");
                            assert!(dot(cross(aimed, side), normal) > 0.0, "{name}: upside down");
                        }
                    }
                }
            }
        }
    }
}

/// Nearly aligned and nearly opposite directions, where products of unit vectors lose all precision.
#[test]
fn nearly_aligned_and_nearly_opposite_directions_are_accurate() {
    let mut rng = Rng(2);
    for exponent in 0..9 {
        for _ in 0..2000 {
            let (from, across) = (rng.direction(), rng.direction() * 10.0_f32.powi(-exponent));
            for to in [from + across, across - from, from, -from] {
                let outcome = OneBone::new(from).solve(&Affine3A::IDENTITY, to);
                let off = angle(turned(outcome.turn, exact(from)), exact(to));
                assert!(off < 1e-5 && outcome.status == OneBoneStatus::Reached, "{from} to {to}: {off:e}");
            }
        }
    }
}

#[test]
fn roll_and_weight_take_effect() {
    let mut rng = Rng(3);
    for _ in 0..5000 {
        let (bone, axis, to) = (any_bone(&mut rng), rng.direction(), rng.direction());
        let by = rng.between(-3.0, 3.0);
        let [plain, rolled] = [0.0, by].map(|by| OneBone::new(axis).with_roll_by(by).solve(&bone, to).turn);
        let side = to.any_orthonormal_vector();
        let between = rolled * plain.conjugate() * side;
        assert!((to.dot(side.cross(between)).atan2(side.dot(between)) - by).abs() < 1e-5);
        let whole = angle_of(plain);
        for (weight, is) in [(0.0, 0.0), (-0.5, 0.0), (0.5, 0.5), (1.0, 1.0), (2.0, 1.0), (f32::NAN, 0.0)] {
            let outcome = OneBone::new(axis).with_weight(weight).solve(&bone, to);
            assert!((angle_of(outcome.turn) - is * whole).abs() < 1e-5, "{weight}");
            assert_eq!(outcome.status == OneBoneStatus::Partial, is * whole < whole - 1e-4, "{weight}");
        }
    }
}

#[test]
fn up_along_the_direction_and_nothing_to_point_at() {
    let level = OneBone::new(Vec3::Z).with_roll(Roll::Up { bone: Vec3::Y, space: Vec3::Y });
    let outcome = level.solve(&Affine3A::IDENTITY, Vec3::Y);
    assert_eq!(outcome.status, OneBoneStatus::RollUndefined);
    assert!((outcome.turn * Vec3::Z).distance(Vec3::Y) < 1e-6);
    let flat = Affine3A { matrix3: Mat3A::ZERO, translation: Vec3::ZERO.into() };
    for (bone, to) in [(Affine3A::IDENTITY, Vec3::ZERO), (flat, Vec3::X), (Affine3A::IDENTITY, Vec3::NAN)] {
        let outcome = level.solve(&bone, to);
        assert_eq!((outcome.status, outcome.turn), (OneBoneStatus::Degenerate, Quat::IDENTITY));
    }
}

#[test]
fn random_bits_are_harmless() {
    let mut rng = Rng(4);
    for _ in 0..100_000 {
        let n: [f32; 23] = numbers(&mut rng);
        let v = |at: usize| Vec3::from_slice(&n[at..]);
        let bone = Affine3A::from_cols(v(0).into(), v(3).into(), v(6).into(), Vec3::ZERO.into());
        let roll = if n[21] < 0.0 { Roll::Shortest } else { Roll::Up { bone: v(9), space: v(12) } };
        let solver = OneBone::new(v(15)).with_roll(roll).with_roll_by(n[21]).with_weight(n[22]);
        let outcome = solver.solve(&bone, v(18));
        assert!(is_sound(outcome.turn) && outcome.remaining_rad.is_finite(), "{bone:?} {solver:?} {outcome:?}");
    }
}
