//! The rigs of the numeric tests: every convention, general frames, hinges, chains of one to four joints. The build
//! script, which emits them, and the tests, which check them, share this file.

use aim_codegen::{AngleRange, EffectorSpec, Frame, JointSpec, LimitsFrom, RigSpec, Role};

use crate::random::Random;

/// Returns one rig for each of the 48 conventions of the effector's joint, then sixteen with general frames.
pub fn rigs() -> Vec<RigSpec> {
    let cardinal: Vec<Frame> = Frame::cardinal().collect();
    let mut random = Random::new(48);
    (0..64)
        .map(|number| {
            let joints = 1 + number % 4;
            let joints: Vec<JointSpec> = (0..joints)
                .map(|i| {
                    let frame = match (number, i) {
                        (0..48, 0) => cardinal[number],
                        (0..48, _) => cardinal[random.below(48)],
                        _ => general_frame(&mut random),
                    };
                    // One joint in six is a hinge.
                    let kind = random.below(12);
                    bare_joint(i, frame, kind != 0, kind != 1)
                })
                .collect();
            let frame = if number % 5 == 4 { general_frame(&mut random) } else { joints[0].frame };
            RigSpec {
                name: format!("Rig{number}"),
                joints,
                effector: EffectorSpec { frame, origin: [0.0; 3] },
                natural: None,
                region: None,
                kernels: Vec::new(),
            }
        })
        .collect()
}

/// Returns a joint that has these angles and otherwise default settings.
pub fn bare_joint(number: usize, frame: Frame, pitch: bool, heading: bool) -> JointSpec {
    let range = AngleRange::Between(-2.0, 2.0);
    JointSpec {
        name: format!("joint{number}"),
        bones: vec![format!("bone{number}")],
        role: Role::None,
        frame,
        pitch: pitch.then_some(range),
        heading: heading.then_some(range),
        limits_from: LimitsFrom::Animation,
        rate: 3.0,
        acceleration: None,
        stiffness: 1.0,
        upright: None,
        pitch_taper: None,
        other_eye: None,
        hold: None,
    }
}

/// Returns axes off every cardinal direction, of random handedness.
pub fn general_frame(random: &mut Random) -> Frame {
    let [forward, left, up] = random.rotation();
    let sign = if random.below(2) == 0 { 1.0 } else { -1.0 };
    Frame { up, forward, left: left.map(|c| sign * c) }
}
