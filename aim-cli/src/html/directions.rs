//! Directions to the target, of the gaze and of the head, in the effector's bind frame. The frame moves with the bone
//! that carries the chain, but not with the joints of the chain.

use aim_character::chain_nodes;
use aim_codegen::Role;
use aim_runtime::glam::{DAffine3, DMat3, DVec3};

use super::subject::BakePage;
use crate::effector::Effector;

/// Azimuth and elevation of one direction in every frame, degrees; NaN if it is not finite.
pub(super) type Bearings = Vec<[f64; 2]>;

pub(super) struct Directions {
    pub(super) target: Bearings,
    pub(super) gaze: Bearings,
    /// Direction of the head: of the gaze if the eye were as in the bind pose. `None` if the effector is not an eye.
    pub(super) head: Option<Bearings>,
    /// Direction of the head, or of the effector if it is not an eye, in the clip that was aimed over.
    pub(super) animated: Bearings,
    /// Name of the bone that carries the chain; `None` if the chain hangs on nothing.
    pub(super) carrier: Option<String>,
}

impl Directions {
    /// Computes the directions; `None` if the document lacks bones of the rig.
    pub(super) fn new(subject: &BakePage<'_>) -> Option<Self> {
        let BakePage { spec, report, document, measurement, source, baked } = *subject;
        let skeleton = document.skeleton();
        let chain = chain_nodes(spec, skeleton).ok()?;
        let bind = &measurement.bind_world;
        let Effector { joint, ray } = report.aimed;
        let eye = chain.joints[joint];
        let carrier = chain.joints.last().and_then(|node| skeleton.parents()[*node]);
        let head = skeleton.parents()[eye].filter(|_| spec.joints[joint].role == Role::Eye);
        let axes = [ray.frame.left, ray.frame.up, ray.frame.forward];
        let rest = axes.map(|axis| bind[eye].transform_vector3(DVec3::from(axis)));
        let moved = |node: Option<usize>, world: &[DAffine3]| -> DMat3 {
            node.map_or(DMat3::IDENTITY, |node| world[node].matrix3 * bind[node].matrix3.inverse())
        };
        let mut found = Self {
            target: Vec::new(),
            gaze: Vec::new(),
            head: head.map(|_| Vec::new()),
            animated: Vec::new(),
            carrier: carrier.map(|node| skeleton.names()[node].clone()),
        };
        let source = source.map(|clip| clip.repeated(baked.clip.length_s()));
        for frame in &baked.frames {
            let pose = source.as_ref().map_or_else(|| skeleton.rest().to_vec(), |clip| skeleton.pose(clip, frame.t));
            let animated = skeleton.world_f64(&pose);
            let world = &frame.world;
            let carried = moved(carrier, world);
            let frame_of = rest.map(|axis| (carried * axis).normalize_or_zero());
            let seen = |v: DVec3| {
                let [left, up, forward] = frame_of.map(|axis| axis.dot(v));
                [left.atan2(forward).to_degrees(), up.atan2(left.hypot(forward)).to_degrees()]
            };
            let origin = world[eye].transform_point3(DVec3::from(ray.origin));
            found.target.push(seen(frame.target - origin));
            found.gaze.push(seen(world[eye].transform_vector3(DVec3::from(ray.frame.forward))));
            if let Some(course) = &mut found.head {
                course.push(seen(moved(head, world) * rest[2]));
            }
            found.animated.push(seen(moved(head.or(Some(eye)), &animated) * rest[2]));
        }
        Some(found)
    }
}

/// Returns the difference of two angles, degrees, in −180…180.
pub(super) fn apart(a: f64, b: f64) -> f64 {
    let difference = a - b;
    difference - 360.0 * (difference / 360.0).round()
}
