//! The tests' hand-written kernels agree with central differences in f64 of the independent forward kinematics.

use crate::common::*;
use aim_runtime::glam::{Affine3A, Quat, Vec3};

#[test]
fn kernels_agree_with_central_differences() {
    let mut rng = Rng(11);
    for case in 0..200 {
        let mut rig = NumericRig::thug();
        if case % 3 == 0 {
            rig.infos[1].pitch = None;
        }
        rig.effector.origin = [0.02, 0.05, -0.01];
        let link = |at: Vec3, rng: &mut Rng| {
            let turn = Quat::from_axis_angle(rng.direction(), rng.between(0.0, 0.5));
            let mirror = Affine3A::from_scale(Vec3::new(if rng.below(2) == 0 { -1.0 } else { 1.0 }, 1.0, 1.0));
            Affine3A::from_rotation_translation(turn, at) * mirror
        };
        let links = [
            Affine3A::from_translation(rig.effector.origin.into()),
            link(Vec3::new(0.12, 0.1, 0.03), &mut rng),
            link(Vec3::new(0.25, 0.0, 0.0), &mut rng),
        ];
        let links = links.map(|link| link.to_cols_array().map(f64::from));
        let target = (Vec3::from([0.2, 1.0, 0.1]) + rng.direction() * 0.7).to_array().map(f64::from);
        let angles: [[f64; 2]; 3] =
            core::array::from_fn(|_| [rng.between(-0.5, 0.5).into(), rng.between(-0.5, 0.5).into()]);
        let sin_cos = |angles: &[[f64; 2]; 3]| angles.map(|[p, h]| [p.sin(), p.cos(), h.sin(), h.cos()]);
        let count: usize = if case % 3 == 0 { 5 } else { 6 };
        let evaluate = |angles: &[[f64; 2]; 3]| {
            let value: Vec<f64> = rig.chain_gradient(&links, &target, &sin_cos(angles));
            let residual: Vec<f64> = rig.chain_residual(&links, &target, &sin_cos(angles));
            (value, residual)
        };
        let (value, residual) = evaluate(&angles);
        // The residual has length 2·tan(angle/2), as far as the links are orthogonal in f32.
        let length = (residual[0] * residual[0] + residual[1] * residual[1]).sqrt();
        assert!((length - 2.0 * (0.5 * value[0].acos()).tan()).abs() < 1e-5 * length.max(1.0));
        let mut column = 0;
        for joint in 0..3 {
            for which in 0..2 {
                if which == 0 && rig.infos[joint].pitch.is_none() {
                    continue;
                }
                let step = 1e-5;
                let [mut lo, mut hi] = [angles; 2];
                lo[joint][which] -= step;
                hi[joint][which] += step;
                let ((value_lo, residual_lo), (value_hi, residual_hi)) = (evaluate(&lo), evaluate(&hi));
                let by = |hi: f64, lo: f64| (hi - lo) / (2.0 * step);
                let near = |a: f64, b: f64| (a - b).abs() < 1e-6 * a.abs().max(1.0);
                assert!(near(value[1 + column], by(value_hi[0], value_lo[0])), "case {case}");
                for row in 0..2 {
                    let derived = residual[2 + row * count + column];
                    assert!(near(derived, by(residual_hi[row], residual_lo[row])), "case {case}");
                }
                column += 1;
            }
        }

        // A joint's own gradient is that of the chain up to that joint.
        let state = sin_cos(&angles);
        let alone = rig.chain_gradient(&links[..1], &target, &state[..1]);
        assert_eq!(rig.joint_gradient(0, &links[0], &target, &state[0]), alone[..3]);
    }
}
