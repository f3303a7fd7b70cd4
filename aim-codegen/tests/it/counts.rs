//! Operation counts of the derived programs.

use aim_codegen::objective::{AIM_GRADIENT, CHAIN_RESIDUAL_JACOBIAN, CHAIN_VALUE_GRADIENT, FirstLink};
use aim_codegen::{AngleRange, EffectorSpec, Frame, JointSpec, LimitsFrom, Objective, RigSpec, Role};

fn joint(name: String, frame: Frame) -> JointSpec {
    JointSpec {
        bones: vec![name.clone()],
        name,
        role: Role::None,
        frame,
        pitch: Some(AngleRange::Between(-1.0, 1.0)),
        heading: Some(AngleRange::Between(-1.0, 1.0)),
        limits_from: LimitsFrom::Animation,
        rate: 1.0,
        acceleration: None,
        stiffness: 1.0,
        upright: None,
        pitch_taper: None,
        other_eye: None,
        hold: None,
    }
}

pub(crate) fn rig(joints: usize, frame: Frame) -> RigSpec {
    RigSpec {
        name: "Rig".into(),
        joints: (0..joints).map(|i| joint(format!("joint{i}"), frame)).collect(),
        effector: EffectorSpec { frame, origin: [0.0; 3] },
        natural: None,
        region: None,
        kernels: Vec::new(),
    }
}

#[test]
fn one_joint_is_at_the_hand_derived_floor_in_every_convention() {
    for frame in Frame::cardinal() {
        let spec = rig(1, frame);
        let statement = AIM_GRADIENT.statement(&spec, &[0], FirstLink::Given);
        let all = statement.program().count();
        assert_eq!((all.total(), all.sqrt, all.div), (46, 1, 1), "{frame:?}: {all}");
        let singly = [0, 1, 2].map(|output| statement.program_of(output).count().total());
        assert_eq!(singly, [27, 37, 42], "aim, by pitch, by heading: {frame:?}");
    }
}

#[test]
fn a_chain_grows_by_the_same_count_with_every_joint() {
    let frame = Frame::cardinal().next().expect("there are 48");
    let mut residuals = Vec::new();
    for joints in 2..=12 {
        let spec = rig(joints, frame);
        let count = |objective: &'static Objective| objective.kernels(&spec, FirstLink::Given)[0].program.count();
        let aim = count(&CHAIN_VALUE_GRADIENT);
        assert_eq!(aim.total(), 63 * joints - 16, "{joints} joints: {aim}");
        residuals.push(count(&CHAIN_RESIDUAL_JACOBIAN).total());
    }
    let growth: Vec<usize> = residuals.windows(2).map(|pair| pair[1] - pair[0]).collect();
    assert!(growth.iter().all(|&step| step == growth[0]), "{residuals:?}");
}
