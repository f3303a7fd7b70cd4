//! Operation counts of the derived programs.

use aim_codegen::{AngleRange, EffectorSpec, Frame, JointOutput, JointSpec, RigPrograms, RigSpec, joint_program};

fn unit(axis: usize, sign: f64) -> [f64; 3] {
    core::array::from_fn(|k| if k == axis { sign } else { 0.0 })
}

/// All 48 triples of signed axes, both handednesses.
fn conventions() -> Vec<Frame> {
    let mut frames = Vec::new();
    for up in 0..3 {
        for forward in (0..3).filter(|&f| f != up) {
            let left = 3 - up - forward;
            for signs in 0..8 {
                let sign = |bit: u32| if signs >> bit & 1 == 0 { 1.0 } else { -1.0 };
                frames.push(Frame {
                    up: unit(up, sign(0)),
                    forward: unit(forward, sign(1)),
                    left: unit(left, sign(2)),
                });
            }
        }
    }
    frames
}

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
        pair: None,
    }
}

fn rig(joints: usize, frame: Frame) -> RigSpec {
    RigSpec {
        name: "Rig".into(),
        joints: (0..joints).map(|i| joint(format!("joint{i}"), frame)).collect(),
        effector: EffectorSpec { frame, origin: [0.0; 3] },
    }
}

#[test]
fn one_joint_is_at_the_hand_derived_floor_in_every_convention() {
    for frame in conventions() {
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
fn a_chain_grows_by_63_operations_a_joint() {
    let frame = conventions()[0];
    for joints in 2..=12 {
        let count = RigPrograms::derive(&rig(joints, frame)).chain_value_gradient.count();
        assert_eq!(count.total(), 63 * joints - 16, "{joints} joints: {count}");
    }
}
#[test]
fn show() {
    use aim_codegen::objective::{ChainInputs, chain_aim, chain_residual};
    let spec = rig(2, conventions()[0]);
    let mut g = aim_symbolic::Graph::new();
    let inputs = ChainInputs::declare(&mut g, 2);
    let s = chain_aim(&mut g, &spec, &inputs);
    println!("{}", aim_symbolic::print::plain_scalar(&g, s));
    let r = g.rewrite(s);
    println!("{}", aim_symbolic::print::plain_scalar(&g, r));
    let s = chain_residual(&mut g, &spec, &inputs)[0];
    let r = g.rewrite(s);
    println!("{}", aim_symbolic::print::plain_scalar(&g, r));
}
