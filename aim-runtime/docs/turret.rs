// The rig of the examples in the documentation: what `#[derive(AimRig)]` makes, by hand, of one joint at the origin.
pub(super) struct Turret;

const TURRET: aim_runtime::Description<'static> = aim_runtime::Description::new(&[aim_runtime::JointInfo::new(
    aim_runtime::Axes { up: [0.0, 1.0, 0.0], forward: [0.0, 0.0, 1.0], left: [1.0, 0.0, 0.0] },
    3.0,
)
.with_heading(-2.0, 2.0)
.with_pitch(-0.5, 1.0)]);

impl aim_runtime::Rig for Turret {
    fn description(&self) -> aim_runtime::Description<'_> {
        TURRET
    }

    fn joint_name(&self, joint: usize) -> Option<&str> {
        ["turret"].get(joint).copied()
    }

    fn bone_name(&self, _: usize, _: usize) -> Option<&str> {
        None
    }

    fn residual_jacobian(&self, _: &[[f32; 12]], &[x, y, z]: &[f32; 3], sin_cos: &[[f32; 4]], out: &mut [f32]) {
        let [sin_p, cos_p, sin_h, cos_h] = sin_cos[0];
        // The target as the turned joint sees it.
        let (left, ahead) = (cos_h * x - sin_h * z, sin_h * x + cos_h * z);
        let (up, forward) = (cos_p * y - sin_p * ahead, sin_p * y + cos_p * ahead);
        let distance = aim_runtime::glam::Vec3::new(x, y, z).length();
        let scale = if distance + forward > 1e-6 { 2.0 / (distance + forward) } else { 0.0 };
        // Of 2 · lateral / (distance + forward), where lateral and forward change by so much.
        let slope = |lateral: f32, by: f32, forward_by: f32| scale * by - 0.5 * scale * scale * lateral * forward_by;
        let by_pitch = [slope(left, 0.0, up), slope(up, -forward, up)];
        let by_heading = [slope(left, -ahead, cos_p * left), slope(up, -sin_p * left, cos_p * left)];
        out.copy_from_slice(&[scale * left, scale * up, by_pitch[0], by_heading[0], by_pitch[1], by_heading[1]]);
    }

    fn aim_gradient(&self, _: usize, _: &[f32; 12], _: &[f32; 3], _: &[f32; 4]) -> [f32; 3] {
        [0.0; 3]
    }
}

impl aim_runtime::AimRig for Turret {
    type Array<T: Copy> = [T; 1];
    const RIG: &'static Self = &Self;
    const DESCRIPTION: &'static aim_runtime::Description<'static> = &TURRET;

    fn array<T: Copy>(value: T) -> [T; 1] {
        [value]
    }

    fn from_joints(_: [aim_runtime::Joint; 1]) -> Self {
        Self
    }
}
