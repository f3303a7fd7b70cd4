//! Compares every solver that can turn a gaze to a target on one workload: targets in front of a character in a random
//! pose, each solved from the animation.

use aim::glam::{Affine3A, Mat3A, Quat, Vec3};
use aim::ik::{AimPose, AimPoses, Ccd, CcdJoint, CcdLimit, LookAt, OneBone, grid};
use aim::{Aim, AimRig, Ascent, Behind, JointInfo, Pose, Rig, Settings, Solver};

use super::chain::{Gazer, posed};
use super::workload::{Still, Where, bearing};

/// A character's bones, from the eye inward.
type Bones = [Affine3A; 3];

/// A named solver that is compared.
#[derive(Clone, Copy, Debug)]
pub struct Contender {
    /// Name in the table.
    pub name: &'static str,
    /// Page of the documentation that describes the solver.
    pub page: &'static str,
    solve: fn(&Still, &Authored) -> Bones,
}

/// All compared solvers, in the order of the table.
pub const CONTENDERS: [Contender; 8] = [
    Contender { name: "exact", page: "#the-aim-solvers", solve: |case, _| snapped(case, Solver::Exact) },
    Contender { name: "natural", page: "#the-aim-solvers", solve: |case, _| snapped(case, Solver::Natural) },
    Contender { name: "ascent, as published, two seconds", page: "paper.md", solve: |case, _| ascended(case) },
    Contender { name: "one bone: the eye", page: "one-bone.md", solve: |case, _| one_bone(case) },
    Contender { name: "look-at: the head", page: "look-at.md", solve: |case, _| look_at(case) },
    Contender { name: "CCD: chest, head, eye", page: "ccd.md", solve: |case, _| ccd(case) },
    Contender { name: "aim poses", page: "aim-poses.md", solve: |case, authored| by_poses(case, authored) },
    Contender {
        name: "aim poses, then exact",
        page: "aim-poses.md",
        solve: |case, authored| snapped(&Still { pose: by_poses(case, authored), target: case.target }, Solver::Exact),
    },
];

impl Contender {
    /// Solves a case and returns the resulting bones.
    pub fn solve(&self, case: &Still, authored: &Authored) -> Bones {
        (self.solve)(case, authored)
    }
}

/// Returns the workload: targets in the cone in front, at 0.5 to 5 m.
pub fn cases(count: usize) -> Vec<Still> {
    Where::Cone.cases(count)
}

/// Fifteen aim poses, as an animator would author them: each joint's correction from the eye inward, and the direction
/// of the gaze.
#[derive(Clone, Debug)]
pub struct Authored {
    poses: Vec<([Quat; 3], Vec3)>,
}

impl Default for Authored {
    fn default() -> Self {
        let upright = posed([Quat::IDENTITY; 3]);
        let directions =
            [-45.0, 0.0, 45.0].iter().flat_map(|&up| [-80.0, -40.0, 0.0, 40.0, 80.0].map(|left| (left, up)));
        let pose = |(left, up): (f32, f32)| {
            let target = Vec3::from(upright[0].translation) + 2.0 * bearing(left, up);
            let turns = corrections(&upright, target, Solver::Exact);
            (turns, gaze(&corrected(&upright, turns)))
        };
        Self { poses: directions.map(pose).collect() }
    }
}

fn settings(solver: Solver) -> Settings {
    Settings::default().with_behind(Behind::Off).with_solver(solver)
}

fn corrections(pose: &Bones, target: Vec3, solver: Solver) -> [Quat; 3] {
    Aim::<Gazer>::new().snap(&Pose::new(*pose), target, &settings(solver)).corrections
}

fn snapped(case: &Still, solver: Solver) -> Bones {
    corrected(&case.pose, corrections(&case.pose, case.target, solver))
}

fn ascended(case: &Still) -> Bones {
    let mut gazer = Aim::<Gazer>::new();
    let settings = settings(Solver::Ascent).with_ascent(Ascent::paper());
    let mut turns = [Quat::IDENTITY; 3];
    for _ in 0..120 {
        turns = gazer.aim(&Pose::new(case.pose), case.target, 1.0 / 60.0, &settings).corrections;
    }
    corrected(&case.pose, turns)
}

fn one_bone(case: &Still) -> Bones {
    let [eye, head, chest] = case.pose;
    let turn = OneBone::new(Vec3::Y).solve(&eye, case.target - Vec3::from(eye.translation)).turn;
    [turned(turn, &eye), head, chest]
}

fn look_at(case: &Still) -> Bones {
    let [eye, head, chest] = case.pose;
    let [_, info, _] = infos();
    let ([left, right], [down, up]) = (info.heading.unwrap_or_default(), info.pitch.unwrap_or_default());
    let look = LookAt::new(*info.axes(), *info.axes()).with_heading(left, right).with_pitch(down, up);
    let turn = look.solve(&chest, &head, case.target, 1.0).turn;
    let turned_head = turned(turn, &head);
    [turned_head * (head.inverse() * eye), turned_head, chest]
}

fn ccd(case: &Still) -> Bones {
    let [eye, head, chest] = case.pose;
    let at = |bone: &Affine3A| Vec3::from(bone.translation);
    let most = infos().map(|info| info.heading.unwrap_or_default()[1]);
    let joint = |bone: &Affine3A, most_rad: f32| CcdJoint::new(at(bone)).with_limit(CcdLimit::Ball { most_rad });
    let mut joints = [joint(&chest, most[2]), joint(&head, most[1]), joint(&eye, most[0])];
    // The tip that should meet the target is the point straight ahead of the eye, at the target's distance.
    let tip = at(&eye) + gaze(&case.pose) * at(&eye).distance(case.target);
    Ccd::new().solve(&mut joints, tip, case.target);
    let chest_posed = turned(joints[0].turn, &chest);
    let carried = |joint: usize, bone: &Affine3A, before: &Affine3A, before_posed: &Affine3A| {
        let at = before_posed.transform_point3(before.inverse().transform_point3(at(bone)));
        Affine3A { translation: at.into(), ..turned(joints[joint].turn, bone) }
    };
    let head_posed = carried(1, &head, &chest, &chest_posed);
    [carried(2, &eye, &head, &head_posed), head_posed, chest_posed]
}

fn by_poses(case: &Still, authored: &Authored) -> Bones {
    let poses: Vec<AimPose<'_>> =
        authored.poses.iter().map(|(rotations, direction)| AimPose { direction: *direction, rotations }).collect();
    let mut triangles = [[0; 3]; 16];
    let triangles = grid(5, 3, &mut triangles).expect("a grid of five by three");
    let to_target = |bones: &Bones| (case.target - Vec3::from(bones[0].translation)).normalize();
    let wanted = to_target(&case.pose);
    let mut turns = [Quat::IDENTITY; 3];
    // Turning the joints also moves the eye. The gaze is therefore measured relative to the direction in which the
    // target is seen from the moved eye.
    let aim = |turns: &[Quat]| {
        let bones = corrected(&case.pose, [turns[0], turns[1], turns[2]]);
        Quat::from_rotation_arc(to_target(&bones), wanted) * gaze(&bones)
    };
    AimPoses::new(&poses, triangles).solve(wanted, &mut turns, aim);
    corrected(&case.pose, turns)
}

fn infos() -> [JointInfo; 3] {
    let rig = Gazer::RIG;
    [0, 1, 2].map(|joint| rig.description().joints()[joint])
}

fn turned(turn: Quat, bone: &Affine3A) -> Affine3A {
    Affine3A { matrix3: Mat3A::from_quat(turn) * bone.matrix3, translation: bone.translation }
}

fn corrected([eye, head, chest]: &Bones, turns: [Quat; 3]) -> Bones {
    let [eye_turn, head_turn, chest_turn] = turns.map(Affine3A::from_quat);
    let posed_chest = *chest * chest_turn;
    let posed_head = posed_chest * (chest.inverse() * *head) * head_turn;
    [posed_head * (head.inverse() * *eye) * eye_turn, posed_head, posed_chest]
}

fn gaze(bones: &Bones) -> Vec3 {
    bones[0].transform_vector3(Vec3::Y).normalize()
}

/// Quality of a solver's result on one case.
#[derive(Clone, Copy, Debug)]
pub struct Judged {
    /// Angle between the eye's gaze and its target, degrees.
    pub error_deg: f64,
    /// Largest excess of an angle over its range, degrees. The range of an angle that the rig does not declare is zero.
    pub beyond_deg: f64,
    /// Half the stiffness-weighted sum of the squares of the joints' rotation angles.
    pub displacement: f64,
    /// Roll of the eye about its gaze relative to the animation, degrees.
    pub roll_deg: f64,
}

/// Judges the result of a case from the bones alone.
pub fn judged(case: &Still, bones: &Bones) -> Judged {
    let error = gaze(bones).angle_between(case.target - Vec3::from(bones[0].translation));
    let (mut beyond, mut displacement) = (0.0_f32, 0.0_f64);
    for (joint, info) in infos().iter().enumerate() {
        let local = |bones: &Bones| match bones.get(joint + 1) {
            Some(parent) => parent.inverse() * bones[joint],
            None => bones[joint],
        };
        let correction = Quat::from_mat3a(&(local(&case.pose).inverse() * local(bones)).matrix3).normalize();
        // +X is up, +Y forward, +Z left.
        let forward = correction * Vec3::Y;
        let (heading, pitch) = (forward.z.atan2(forward.y), forward.x.clamp(-1.0, 1.0).asin());
        for (angle, range) in [(heading, info.heading), (pitch, info.pitch)] {
            let [lo, hi] = range.unwrap_or_default();
            beyond = beyond.max(lo - angle).max(angle - hi);
        }
        let turn = f64::from(correction.angle_between(Quat::IDENTITY));
        displacement += 0.5 * f64::from(info.stiffness) * turn * turn;
    }
    let roll = |bones: &Bones| {
        let (gaze, up) = (gaze(bones), bones[0].transform_vector3(Vec3::X));
        let level = Vec3::Y.reject_from(gaze);
        level.cross(up).dot(gaze).atan2(level.dot(up))
    };
    let rolled = (roll(bones) - roll(&case.pose)).abs();
    Judged {
        error_deg: f64::from(error).to_degrees(),
        beyond_deg: f64::from(beyond).to_degrees(),
        displacement,
        roll_deg: f64::from(rolled).to_degrees(),
    }
}
