// The rig of the examples in the documentation: what `#[derive(AimRig)]` makes, by hand, of one joint at the origin. A single
// joint is aimed in closed form, so its kernels are not asked.
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

    fn residual_jacobian(&self, _: &[[f32; 12]], _: &[f32; 3], _: &[[f32; 4]], _: &mut [f32]) {}

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
