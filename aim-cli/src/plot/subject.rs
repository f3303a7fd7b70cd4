//! Input of a plot: a joint's aim function for one target, and the solvers' paths from rest to that target.

use aim_character::InterpretedRig;
use aim_codegen::objective::{AIM_GRADIENT, FirstLink};
use aim_codegen::{AngleRange, EffectorSpec, Frame, JointSpec, RigSpec};
use aim_runtime::glam::{Affine3A, DVec3, Vec3};
use aim_runtime::{Ascent, Axes, DynAim, JointInfo, Pose, Rig, Settings, Solver, Status};
use aim_symbolic::Program;

use crate::words::{listed, shown};

/// Frames per second.
pub(super) const FPS: f32 = 60.0;
/// Maximum number of frames (20 s), after which a solver that has not settled is stopped.
const MOST_FRAMES: usize = 1200;
/// Turn per frame below which a joint has settled, radians. It is smaller for a joint with a very low rate.
const SETTLED: f64 = 2e-5;

/// One joint with the others at rest, and the effector's direction as on the standing character. The effector's origin
/// is the declared one for the joint that carries the effector, and the joint's own origin for the others.
pub(crate) struct JointPlot {
    /// Name of the rig.
    pub(super) rig_name: String,
    /// The joint that turns.
    pub(super) joint: JointSpec,
    /// Target in the joint's space.
    pub(super) target: DVec3,
    /// Effector at rest, in the joint's space.
    effector: EffectorSpec,
    /// Derived program of the joint's aim and gradient.
    program: Program,
    /// Transform from effector space to the joint's space, in the layout of the kernels' input.
    link: [f64; 12],
    /// Paths of the solvers: the paper's ascent, then the exact solver.
    pub(super) courses: [SolverPath; 2],
}

/// Path of a solver from rest.
pub(super) struct SolverPath {
    pub(super) name: &'static str,
    pub(super) colour: &'static str,
    /// Heading and pitch in each frame, degrees; the first is rest.
    pub(super) angles: Vec<[f64; 2]>,
    /// Final angle between effector and target by forward kinematics, degrees.
    pub(super) off_deg: f64,
}

impl JointPlot {
    /// Creates the plot of the joint named `joint`, or of the first if `None`, with a `target` in its space, or, if
    /// `None`, a target that needs every angle.
    ///
    /// # Errors
    /// There is no such joint, or no direction from the effector to the target.
    pub(crate) fn new(spec: &RigSpec, joint: Option<&str>, target: Option<DVec3>) -> Result<Self, String> {
        let index = match joint {
            None => 0,
            Some(name) => spec.joints.iter().position(|joint| joint.name == name).ok_or_else(|| {
                let names: Vec<&str> = spec.joints.iter().map(|joint| joint.name.as_str()).collect();
                format!("the rig {} has no joint {name}; it has {}", spec.name, listed(&names))
            })?,
        };
        let joint = spec.joints[index].clone();
        let (from, to) = (&spec.joints[0].frame, &joint.frame);
        let Frame { up, forward, left } = spec.effector.frame;
        let frame = Frame { up: seen(up, from, to), forward: seen(forward, from, to), left: seen(left, from, to) };
        let effector = EffectorSpec { frame, origin: if index == 0 { spec.effector.origin } else { [0.0; 3] } };
        let target = target.unwrap_or_else(|| usual_target(&joint, &effector));
        let alone = RigSpec {
            name: spec.name.clone(),
            joints: vec![joint.clone()],
            effector,
            natural: None,
            region: None,
            kernels: Vec::new(),
        };
        let solvers =
            [("steepest ascent, as published", "#d55e00", Solver::Ascent), ("exact solver", "#000000", Solver::Exact)];
        let rig = InterpretedRig::new(&alone);
        let snapped = DynAim::new(&rig).snap(&standing(), target.as_vec3(), &Settings::default());
        if snapped.status == Status::Degenerate {
            return Err(format!(
                "cannot aim at --target {},{},{}: it is at the effector, or too far away for single precision; give another \
                 point in the space of the joint {}",
                target.x, target.y, target.z, joint.name
            ));
        }
        let courses =
            solvers.map(|(name, colour, solver)| SolverPath::follow(&rig, target.as_vec3(), solver, name, colour));
        let kernels = AIM_GRADIENT.kernels(spec, FirstLink::Given);
        let kernel = kernels.into_iter().find(|kernel| kernel.joints.contains(&index));
        let program = kernel.map(|kernel| kernel.program).ok_or("the rig has no such joint")?;
        let rows = DVec3::AXES.map(|axis| seen(axis.to_array(), from, to));
        let mut link = [0.0; 12];
        for (number, of) in link.iter_mut().zip(rows.iter().flatten().chain(&effector.origin)) {
            *number = *of;
        }
        Ok(Self { rig_name: spec.name.clone(), joint, target, effector, program, link, courses })
    }

    /// Returns the aim at this heading and pitch, degrees, by the rig's derived program.
    pub(super) fn aim(&self, [heading, pitch]: [f64; 2]) -> f64 {
        let ((sin_h, cos_h), (sin_p, cos_p)) = (heading.to_radians().sin_cos(), pitch.to_radians().sin_cos());
        let (target, sin_cos) = (self.target.to_array(), [sin_p, cos_p, sin_h, cos_h]);
        let inputs: Vec<f64> = self.link.into_iter().chain(target).chain(sin_cos).collect();
        let mut out = [0.0; 3];
        self.program.run(&inputs, &mut out);
        out[0]
    }

    /// Returns `true` if the joint has only one angle.
    pub(super) fn is_hinge(&self) -> bool {
        self.joint.angles() == 1
    }

    /// Returns the border of the range of motion, as headings and pitches in degrees: a closed line, or, for a free
    /// heading, the two limits of pitch over these headings.
    pub(super) fn range_outlines(&self, over: [f64; 2]) -> Vec<Vec<[f64; 2]>> {
        let [lo, hi] = self.joint.heading.map_or([0.0; 2], degrees);
        let is_free = lo.is_infinite();
        // The range of pitch narrows linearly to either side of heading 0.
        let headings = if is_free { over.to_vec() } else { vec![lo, 0.0, hi] };
        let side = |end: usize| -> Vec<[f64; 2]> { headings.iter().map(|h| [*h, self.pitch_range(*h)[end]]).collect() };
        if is_free {
            return vec![side(0), side(1)];
        }
        let mut around = side(0);
        around.extend(side(1).into_iter().rev());
        around.push(around[0]);
        vec![around]
    }

    /// Returns the range of pitch at a heading, degrees.
    fn pitch_range(&self, heading: f64) -> [f64; 2] {
        let range = self.joint.range_of_motion(None).pitch_at(heading.to_radians());
        range.ends().map(f64::to_degrees)
    }

    /// Returns the direction of the target from the effector at rest, in words.
    pub(super) fn target_in_words(&self) -> String {
        let Frame { up, forward, left } = self.joint.frame;
        let to_target = self.target - DVec3::from(self.effector.origin);
        let along = |axis: [f64; 3]| to_target.dot(axis.into());
        let azimuth = along(left).atan2(along(forward)).to_degrees();
        let elevation = (along(up) / to_target.length()).clamp(-1.0, 1.0).asin().to_degrees();
        let parts = [(azimuth, "to the left", "to the right"), (elevation, "up", "down")];
        let parts = parts.into_iter().filter(|(angle, ..)| angle.abs() >= 0.05).map(|(angle, positive, negative)| {
            format!("{}° {}", shown(angle.abs(), 1), if angle < 0.0 { negative } else { positive })
        });
        let parts: Vec<String> = parts.collect();
        if parts.is_empty() { "straight ahead".into() } else { parts.join(" and ") }
    }
}

impl SolverPath {
    fn follow(rig: &InterpretedRig, target: Vec3, solver: Solver, name: &'static str, colour: &'static str) -> Self {
        let settings = Settings::default().with_solver(solver).with_ascent(Ascent::paper());
        let mut angles = vec![[0.0; 2]];
        let mut off_deg = f64::NAN;
        let rate = rig.description().joints().first().map_or(0.0, |info| f64::from(info.rate));
        let mut character = DynAim::new(rig);
        let settled = SETTLED.min(0.01 * rate / f64::from(FPS)).to_degrees();
        for _ in 0..MOST_FRAMES {
            let outcome = character.aim(&standing(), target, FPS.recip(), &settings);
            off_deg = f64::from(outcome.remaining).to_degrees();
            let now =
                character.state.joints.first().map_or([0.0; 2], |joint| {
                    [joint.heading(), joint.pitch()].map(|angle| f64::from(angle).to_degrees())
                });
            let before = angles[angles.len() - 1];
            if (0..2).all(|k| (now[k] - before[k]).abs() < settled) {
                break;
            }
            angles.push(now);
        }
        Self { name, colour, angles, off_deg }
    }

    /// Returns the final heading and pitch, degrees.
    pub(super) fn end(&self) -> [f64; 2] {
        self.angles[self.angles.len() - 1]
    }
}

/// Returns a pose in which the joint's space is the world.
fn standing() -> Pose<Vec<Affine3A>> {
    Pose::new(vec![Affine3A::IDENTITY])
}

/// Transforms a vector from the space of one bone to that of another, such that its components up, forward and left
/// stay the same.
fn seen(v: [f64; 3], from: &Frame, to: &Frame) -> [f64; 3] {
    let along = |axis: [f64; 3]| DVec3::from(v).dot(axis.into());
    (along(from.up) * DVec3::from(to.up)
        + along(from.forward) * DVec3::from(to.forward)
        + along(from.left) * DVec3::from(to.left))
    .to_array()
}

/// Converts a range to degrees; the ends of a free one are infinite.
pub(super) fn degrees(range: AngleRange) -> [f64; 2] {
    range.ends().map(f64::to_degrees)
}

/// Returns the point that the effector looks at with each angle well inside its range. Its distance is ten times that
/// of the effector from the joint, or 2 if the effector is at the joint.
fn usual_target(joint: &JointSpec, effector: &EffectorSpec) -> DVec3 {
    let well_inside = |range: Option<AngleRange>, most: f64| {
        let [lo, hi] = range.map_or([0.0; 2], degrees);
        let far = 0.7 * if hi >= -0.5 * lo { hi } else { lo };
        far.clamp(-most, most)
    };
    let heading = well_inside(joint.heading, 60.0);
    let pitch = well_inside(joint.pitch, 45.0) * (1.0 - joint.pitch_taper.unwrap_or(0.0));
    let Frame { up, forward, left } = joint.frame;
    #[expect(clippy::cast_possible_truncation, reason = "joints turn in single precision")]
    let turn = {
        let axes = Axes { up: up.map(|c| c as f32), forward: forward.map(|c| c as f32), left: left.map(|c| c as f32) };
        JointInfo::new(axes, 0.0).rotation(heading.to_radians() as f32, pitch.to_radians() as f32).as_dquat()
    };
    let origin = DVec3::from(effector.origin);
    let distance = if origin == DVec3::ZERO { 2.0 } else { 10.0 * origin.length() };
    turn * (origin + distance * DVec3::from(effector.frame.forward))
}
