//! Operation counts of the derived programs.

use aim_codegen::{AngleRange, EffectorSpec, Frame, JointOutput, JointSpec, RigPrograms, RigSpec, joint_program};

fn joint(name: String, frame: Frame) -> JointSpec {
    JointSpec {
        bones: vec![name.clone()],
        name,
        frame,
        pitch: Some(AngleRange::Between(-1.0, 1.0)),
        heading: Some(AngleRange::Between(-1.0, 1.0)),
        absolute: false,
        rate: 1.0,
        acceleration: None,
        comfort: 1.0,
        level: None,
        narrowing: None,
        pair: None,
    }
}

fn rig(joints: usize, frame: Frame) -> RigSpec {
    RigSpec {
        name: "Rig".into(),
        joints: (0..joints).map(|i| joint(format!("joint{i}"), frame)).collect(),
        effector: EffectorSpec { frame, origin: [0.0; 3] },
        natural: None,
    }
}

#[test]
fn one_joint_is_at_the_hand_derived_floor_in_every_convention() {
    for frame in Frame::cardinal() {
        let spec = rig(1, frame);
        let count = |outputs: &[JointOutput]| joint_program(&spec, 0, outputs).count();
        let all = count(JointOutput::ALL);
        assert_eq!((all.total(), all.sqrt, all.div), (46, 1, 1), "{frame:?}: {all}");
        assert_eq!(count(&[JointOutput::Aim]).total(), 27, "{frame:?}");
        assert_eq!(count(&[JointOutput::ByPitch]).total(), 37, "{frame:?}");
        assert_eq!(count(&[JointOutput::ByHeading]).total(), 42, "{frame:?}");
    }
}

#[test]
fn a_chain_grows_by_the_same_count_with_every_joint() {
    let frame = Frame::cardinal().next().expect("there are 48");
    let mut residuals = Vec::new();
    for joints in 2..=12 {
        let programs = RigPrograms::derive(&rig(joints, frame));
        let count = programs.chain_value_gradient.count();
        assert_eq!(count.total(), 63 * joints - 16, "{joints} joints: {count}");
        residuals.push(programs.chain_residual_jacobian.count().total());
    }
    let growth: Vec<usize> = residuals.windows(2).map(|pair| pair[1] - pair[0]).collect();
    assert!(growth.iter().all(|&step| step == growth[0]), "{residuals:?}");
}
