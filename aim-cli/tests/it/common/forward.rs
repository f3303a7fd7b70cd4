//! Checks a bake: compares the written file, its report, the source model and the rig with one another, by the tests'
//! own forward kinematics.

use aim_runtime::glam::{DMat3, DMat4, DQuat, DVec3};
use serde_json::Value;

use super::gltf::{Local, Model};
use super::rig::Joint;

/// Input and output of a bake.
pub(crate) struct Bake<'a> {
    /// Source model.
    pub(crate) source: &'a [u8],
    pub(crate) output: &'a [u8],
    pub(crate) report: &'a Value,
    /// Joints declared by the rig. If `None`, checks that need the joints' axes are skipped.
    pub(crate) joints: Option<&'a [Joint]>,
}

/// Frame of the report, with the poses of both models at its time.
struct Frame<'a> {
    report: &'a Value,
    t: f64,
    source: Vec<Local>,
    output: Vec<Local>,
}

/// Returns the `f32` that a time in the report stands for.
fn time(value: &Value) -> f64 {
    #[expect(clippy::cast_possible_truncation, reason = "the report's times are single precision")]
    let single = number(value) as f32;
    single.into()
}

pub(crate) fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is not a number"))
}

pub(crate) fn vector(value: &Value) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|i| number(&value[i])))
}

pub(crate) fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

/// Returns the angle between two directions, degrees; accurate for small angles and for nearly opposite directions.
pub(crate) fn angle_between(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b)).to_degrees()
}

impl Bake<'_> {
    /// Checks everything that holds for every bake.
    #[track_caller]
    pub(crate) fn check(&self) {
        let (source, output) = (Model::new(self.source), Model::new(self.output));
        let clip_name = self.report["clip"].as_str().expect("the clip's name");
        // The clip is written beside its source, or in its place.
        let over = clip_name.strip_suffix("_aimed").unwrap_or(clip_name);
        let source_clip = source.clip_index(over).map(|at| source.clip(at));
        let output_at = output.clip_index(clip_name).expect("the baked clip is in the output");
        let output_clip = output.clip(output_at);
        let frames = list(&self.report["frames"]);
        assert!(!frames.is_empty(), "a bake has frames");
        let seconds = time(&frames[frames.len() - 1]["t"]);
        assert!((output_clip.seconds - seconds).abs() < 1e-5, "{} against {seconds}", output_clip.seconds);

        let chain: Vec<usize> = bones(&frames[0]["joints"]).map(|bone| output.node(bone)).collect();
        let (held, trunk) = arms_on_the_neck(&output, &chain);
        let followers: Vec<usize> = bones(&frames[0]["followers"]).map(|bone| output.node(bone)).collect();
        assert!(held.iter().all(|arm| followers.contains(arm)), "{held:?} of {followers:?}");
        let pair: Vec<usize> = followers.into_iter().filter(|node| !held.contains(node)).collect();
        self.only_the_clip_differs(&source, &output, output_at, &[&chain[..], &pair[..], &held[..]].concat());

        let period = source_clip.as_ref().map_or(0.0, |clip| clip.seconds);
        let before = |t: f64| match &source_clip {
            Some(clip) => source.pose(clip, if t > period && period > 0.0 { t % period } else { t }),
            None => source.rest().to_vec(),
        };
        // Skip the seams, where a clip that does not close jumps.
        let seam = |t: f64| period > 0.0 && t > 0.5 * period && (t / period - (t / period).round()).abs() < 1e-4;
        for k in 0..200_u32 {
            let t = seconds * f64::from(k) / 199.3;
            if !seam(t) {
                untouched(&before(t), &output.pose(&output_clip, t), &[&chain[..], &pair[..]].concat(), &held, t);
            }
        }
        let frames = frames.iter().map(|report| {
            let t = time(&report["t"]);
            Frame { report, t, source: before(t), output: output.pose(&output_clip, t) }
        });
        let frames: Vec<Frame<'_>> = frames.collect();
        let up = self.joints.map(|joints| standing(&source, &chain, joints));
        let effector = output.node(self.report["effector"]["bone"].as_str().expect("the effector's bone"));
        let aimed = chain.iter().position(|node| *node == effector).expect("the effector is a joint");
        for frame in &frames {
            self.error_is_true(frame, &output, effector);
            if !seam(frame.t) {
                for &arm in &held {
                    stays_on_the_trunk(frame, &output, trunk, arm);
                }
                if let Some(up) = up {
                    self.roll_is_true(frame, &output, (aimed, effector), up);
                }
                self.angles_make_the_rotations(frame, &source, &chain, up.unwrap_or(DVec3::Y));
                // An eye scaled to zero has no rotation in world space.
                if let ([pair], true) = (&pair[..], frame.report["status"] != "degenerate") {
                    pair_turns_alike(frame, &output, chain[0], *pair);
                }
            }
        }
        if let Some(joints) = self.joints {
            within_limits(joints, &frames);
            within_rates(joints, &frames);
        }
        self.summary_is_true();
    }

    /// Checks that only the clip differs: meshes, skins, materials and other clips are equal, new binary data is
    /// appended to the old, and nodes are equal except for the matrices of aimed ones.
    fn only_the_clip_differs(&self, source: &Model, output: &Model, clip: usize, aimed: &[usize]) {
        assert!(output.bin.starts_with(&source.bin), "the old binary chunk is not first in the new");
        let (old, new) = (source.json.as_object().expect("an object"), output.json.as_object().expect("an object"));
        for (key, old) in old {
            match key.as_str() {
                "nodes" => {
                    for (at, (old, new)) in list(old).iter().zip(list(&new["nodes"])).enumerate() {
                        let released =
                            old.get("matrix").is_some() && new.get("matrix").is_none() && moved(output, clip, at);
                        assert!(released || old == new, "node {at} ({}) changed", old["name"]);
                    }
                    assert_eq!(list(old).len(), list(&new["nodes"]).len(), "the number of nodes");
                }
                "animations" => {
                    for (at, (old, new)) in list(old).iter().zip(list(&new["animations"])).enumerate() {
                        assert!(at == clip || old == new, "animation {at} changed");
                    }
                }
                "accessors" | "bufferViews" => {
                    assert!(list(&new[key]).starts_with(list(old)), "the old {key} are not first in the new");
                }
                "buffers" => assert_eq!(list(old).len(), list(&new["buffers"]).len(), "the number of buffers"),
                _ => assert_eq!(Some(old), new.get(key), "{key} changed"),
            }
        }
        let more: Vec<&String> = new.keys().filter(|key| !old.contains_key(*key)).collect();
        let allowed = ["animations", "accessors", "bufferViews", "buffers"];
        assert!(more.iter().all(|key| allowed.contains(&key.as_str())), "{more:?} are new");
        assert!(aimed.iter().all(|node| moved(output, clip, *node)), "an aimed node is not in the clip");
    }

    /// Checks that the reported error is the angle in the written file.
    fn error_is_true(&self, frame: &Frame<'_>, output: &Model, eye: usize) {
        let effector = &self.report["effector"];
        let world = output.world(&frame.output, eye);
        let origin = world.transform_point3(vector(&effector["origin"]));
        let gaze = world.transform_vector3(vector(&effector["forward"]));
        let to_target = vector(&frame.report["target"]) - origin;
        let (error, status) = (number(&frame.report["error_deg"]), frame.report["status"].as_str().expect("a status"));
        if status == "degenerate" {
            return;
        }
        let found = angle_between(gaze, to_target);
        // Files are single precision, which limits how exactly a near target far from the origin can be hit.
        let blur = (1e-6 * origin.length() / to_target.length()).to_degrees();
        let off = (found - error).abs();
        assert!(off < 0.01 + blur, "t {}: the file is {found}° off, the report says {error}°", frame.t);
        // The tolerance is 0.1°; near it, rounding to single precision decides.
        let sure = if status == "reached" { error < 0.1 + 2e-3 + blur } else { error > 0.1 - 2e-3 - blur };
        assert!(sure, "t {}: {status} at {error}°", frame.t);
    }

    /// Checks the reported roll: that of the written file relative to the source's, both measured from the horizon.
    fn roll_is_true(&self, frame: &Frame<'_>, output: &Model, (joint, node): (usize, usize), character_up: DVec3) {
        let (Some(joints), true) = (self.joints, frame.report["status"] != "degenerate") else { return };
        let forward = vector(&self.report["effector"]["forward"]);
        let roll = |pose: &[Local]| {
            let world = output.world(pose, node);
            let (gaze, up) = (world.transform_vector3(forward).normalize(), world.transform_vector3(joints[joint].up));
            let left = character_up.cross(gaze);
            // Near vertical there is no horizon to measure from.
            (left.length() > 0.03).then(|| {
                let (left, above) = (left.normalize(), gaze.cross(left.normalize()));
                up.dot(left).atan2(up.dot(above)).to_degrees()
            })
        };
        let (Some(before), Some(after)) = (roll(&frame.source), roll(&frame.output)) else { return };
        let told = number(&frame.report["roll_deg"]);
        let off = after - before - told;
        let off = off - 360.0 * (off / 360.0).round();
        assert!(off.abs() < 0.02, "t {}: the roll is {after}° from {before}°, the report says {told}°", frame.t);
    }

    /// Checks `local' = local · R_heading · R_pitch` with the reported angles. They are about the bone's axes or, if
    /// its heading is level, about the axes of the bone tilted upright from its animated pose.
    fn angles_make_the_rotations(&self, frame: &Frame<'_>, source: &Model, chain: &[usize], character_up: DVec3) {
        for (at, (joint, &node)) in list(&frame.report["joints"]).iter().zip(chain).enumerate() {
            let (heading, pitch) =
                (number(&joint["heading_deg"]).to_radians(), number(&joint["pitch_deg"]).to_radians());
            let (before, after) = (&frame.source[node], &frame.output[node]);
            let found = DMat3::from_quat(before.rotation).transpose() * DMat3::from_quat(after.rotation);
            let off = match self.joints {
                Some(joints) => {
                    let Joint { forward, up, left, upright: part, .. } = joints[at];
                    // The correction acts inside the bone's own scale; only the mirroring of that scale is visible
                    // outside.
                    let sign = DMat3::from_diagonal(before.scale.signum());
                    let tilt = if part > 0.0 && self.report["solver"] != "ascent" {
                        upright(source.world(&frame.source, node), before.scale, up, character_up, part)
                    } else {
                        DQuat::IDENTITY
                    };
                    let turn = tilt * turn(forward, left, heading) * turn(forward, up, pitch) * tilt.inverse();
                    let turn = DMat3::from_quat(turn);
                    angle(found * (sign * turn * sign).transpose())
                }
                // Without the axes, only the total angle can be checked.
                None => angle(found) - 2.0 * ((heading / 2.0).cos() * (pitch / 2.0).cos()).clamp(-1.0, 1.0).acos(),
            };
            // The tilt of an upright bone is known only to single precision. In degenerate frames the angles are held,
            // and so are the axes they are about.
            let is_upright = self.joints.is_some_and(|joints| joints[at].upright > 0.0);
            let most = match is_upright {
                true if frame.report["status"] == "degenerate" => 1e-3,
                true => 1e-4,
                false => 2e-5,
            };
            assert!(off.abs() < most, "t {}, {}: the rotation is {off} rad off", frame.t, joint["bone"]);
        }
    }

    fn summary_is_true(&self) {
        let (summary, frames) = (&self.report["summary"], list(&self.report["frames"]));
        let reached: Vec<&Value> = frames.iter().filter(|frame| frame["status"] == "reached").collect();
        assert_eq!(summary["frames"], frames.len(), "summary.frames");
        assert_eq!(summary["reached"], reached.len(), "summary.reached");
        let worst = reached.iter().map(|frame| number(&frame["error_deg"])).fold(0.0, f64::max);
        assert!((number(&summary["max_error_deg_reached"]) - worst).abs() < 1e-9, "summary.max_error_deg_reached");
        assert!(number(&summary["max_rate_violation_deg_s"]).abs() < 1e-3, "{summary}");
        // If a range is relative to the bind pose, a clip may exceed it faster than the joint's rate; the joint is then
        // returning to its range.
        let recovers = |frame: &Value| list(&frame["joints"]).iter().any(|joint| joint["recovering"] == true);
        let is_held = number(&summary["max_limit_violation_deg"]).abs() < 1e-4;
        assert!(is_held || frames.iter().any(recovers), "{summary}");
        let most = frames.iter().map(|frame| number(&frame["roll_deg"]).abs()).fold(0.0, f64::max);
        assert!((number(&summary["max_roll_deg"]) - most).abs() < 1e-9, "summary.max_roll_deg");
    }
}

fn bones(joints: &Value) -> impl Iterator<Item = &str> {
    list(joints).iter().map(|joint| joint["bone"].as_str().expect("a bone's name"))
}

fn moved(model: &Model, clip: usize, node: usize) -> bool {
    list(&model.json["animations"][clip]["channels"]).iter().any(|channel| channel["target"]["node"] == node)
}

/// Returns the clavicles attached to joints of the head and neck while the chain also turns the trunk, and the trunk's
/// outermost bone.
fn arms_on_the_neck(model: &Model, chain: &[usize]) -> (Vec<usize>, usize) {
    let has = |node: usize, words: [&str; 2]| {
        let name = model.json["nodes"][node]["name"].as_str().unwrap_or_default().to_lowercase();
        words.iter().any(|word| name.contains(word))
    };
    let Some(trunk) = chain.iter().position(|node| has(*node, ["spine", "chest"])) else {
        return (Vec::new(), chain[0]);
    };
    let neck = &chain[..trunk];
    let is_clavicle = |node: &usize| has(*node, ["clavicle", "shoulder"]);
    let hangs = |node: &usize| model.parent(*node).is_some_and(|parent| neck.contains(&parent));
    ((0..list(&model.json["nodes"]).len()).filter(is_clavicle).filter(hangs).collect(), chain[trunk])
}

/// Checks that an arm keeps its transform relative to the trunk.
fn stays_on_the_trunk(frame: &Frame<'_>, model: &Model, trunk: usize, arm: usize) {
    let on_trunk = |pose: &[Local]| model.world(pose, trunk).inverse() * model.world(pose, arm);
    let (before, after) = (on_trunk(&frame.source), on_trunk(&frame.output));
    let size = before.w_axis.truncate().length();
    assert!(after.abs_diff_eq(before, 1e-4 * size.max(1.0)), "t {}: {before} to {after}", frame.t);
}

/// Checks that every node has the source's local transform. Turned nodes may differ in rotation; held ones keep only
/// scale.
fn untouched(before: &[Local], after: &[Local], turned: &[usize], held: &[usize], t: f64) {
    for (node, (before, after)) in before.iter().zip(after).enumerate() {
        let mut after = *after;
        if turned.contains(&node) || held.contains(&node) {
            after.rotation = before.rotation;
        }
        if held.contains(&node) {
            after.translation = before.translation;
        }
        let difference = before.difference(&after);
        assert!(difference < 5e-5, "t {t}: node {node} moved by {difference}: {before:?} to {after:?}");
    }
}

/// Checks that the second eye turns like joint 0 in world space, with all parents posed as they are.
fn pair_turns_alike(frame: &Frame<'_>, output: &Model, eye: usize, pair: usize) {
    let turn = |node: usize| {
        let mut without = frame.output.clone();
        without[node].rotation = frame.source[node].rotation;
        let frame_of = |pose: &[Local]| {
            let m = DMat3::from_mat4(output.world(pose, node));
            DMat3::from_cols(m.x_axis.normalize(), m.y_axis.normalize(), m.z_axis.normalize())
        };
        frame_of(&frame.output) * frame_of(&without).transpose()
    };
    let off = angle(turn(eye) * turn(pair).transpose());
    assert!(off < 2e-5, "t {}: the pair turns {off} rad otherwise", frame.t);
}

fn within_limits(joints: &[Joint], frames: &[Frame<'_>]) {
    for frame in frames {
        for (declared, joint) in joints.iter().zip(list(&frame.report["joints"])) {
            let mut at_an_end = false;
            for (range, key) in [(declared.heading, "heading_deg"), (declared.pitch, "pitch_deg")] {
                let (angle, [lo, hi]) = (number(&joint[key]), range.unwrap_or_default());
                assert!(angle >= lo - 1e-4 && angle <= hi + 1e-4, "t {}: {key} {angle} beyond {lo}…{hi}", frame.t);
                at_an_end |= range.is_some() && (angle - lo).min(hi - angle) < 1e-3;
            }
            assert!(at_an_end || joint["at_limit"] == false, "t {}: {joint} is at no limit", frame.t);
        }
    }
}

fn within_rates(joints: &[Joint], frames: &[Frame<'_>]) {
    for pair in frames.windows(2) {
        let dt = pair[1].t - pair[0].t;
        for (at, declared) in joints.iter().enumerate() {
            for (range, key) in [(declared.heading, "heading_deg"), (declared.pitch, "pitch_deg")] {
                let angle = |frame: &Frame<'_>| number(&frame.report["joints"][at][key]);
                let mut change = angle(&pair[1]) - angle(&pair[0]);
                if range.is_some_and(|[lo, _]| lo.is_infinite()) {
                    change -= 360.0 * (change / 360.0).round();
                }
                let rate = change.abs() / dt;
                assert!(rate <= declared.rate + 1e-3, "t {}: {key} at {rate}°/s", pair[1].t);
            }
        }
    }
}

/// Returns the rotation by an angle that turns `from` towards `to`, two perpendicular directions.
fn turn(from: DVec3, to: DVec3, angle_rad: f64) -> DQuat {
    DQuat::from_axis_angle(from.cross(to).normalize(), angle_rad)
}

/// Checks both eyes' errors against the written file and returns the largest angle between their gazes, degrees. The
/// second eye's forward axis is the one parallel to the first's in the skin's bind pose.
#[track_caller]
pub(crate) fn both_eyes(source: &[u8], output: &[u8], report: &Value, eyes: [&str; 2]) -> f64 {
    let (source, output) = (Model::new(source), Model::new(output));
    let clip = output.clip(output.clip_index(report["clip"].as_str().expect("a name")).expect("the clip"));
    let [left, right] = eyes.map(|eye| output.node(eye));
    let turned = |m: DMat4| {
        let m = DMat3::from_mat4(m);
        DMat3::from_cols(m.x_axis.normalize(), m.y_axis.normalize(), m.z_axis.normalize())
    };
    let forward = vector(&report["effector"]["forward"]);
    let bind = turned(source.bind(left)) * forward;
    let of_pair = turned(source.bind(right)).transpose() * bind;
    let mut widest: f64 = 0.0;
    for frame in list(&report["frames"]) {
        let pose = output.pose(&clip, time(&frame["t"]));
        let target = vector(&frame["target"]);
        let [one, other] =
            [(left, forward, "error_deg"), (right, of_pair, "pair_error_deg")].map(|(eye, axis, key)| {
                let world = output.world(&pose, eye);
                let gaze = turned(world) * axis;
                let found = angle_between(gaze, target - world.transform_point3(DVec3::ZERO));
                assert!((found - number(&frame[key])).abs() < 0.01, "t {}: {key} is {found}°: {frame}", frame["t"]);
                assert!(found < 0.1, "t {}: {key} is {found}°", frame["t"]);
                gaze
            });
        widest = widest.max(angle_between(one, other));
    }
    widest
}

/// Returns the world axis nearest to the up direction of the character as it stands in the file.
fn standing(source: &Model, chain: &[usize], joints: &[Joint]) -> DVec3 {
    let ups = chain
        .iter()
        .zip(joints)
        .map(|(node, joint)| source.world(source.rest(), *node).transform_vector3(joint.up).normalize_or_zero());
    let up: DVec3 = ups.sum();
    let axes = DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]);
    axes.max_by(|a, b| a.dot(up).total_cmp(&b.dot(up))).expect("six axes")
}

/// Returns the rotation, in the bone's own space without its `scale`, that tilts `up` towards the character's up by the
/// fraction `part`.
fn upright(world: DMat4, scale: DVec3, up: DVec3, character_up: DVec3, part: f64) -> DQuat {
    let m = DMat3::from_mat4(world) * DMat3::from_diagonal(scale.abs().recip());
    if m.determinant() == 0.0 || !m.is_finite() {
        return DQuat::IDENTITY;
    }
    // A sheared bone's frame follows its first axis, then its second.
    let x = m.x_axis.normalize();
    let y = m.y_axis.reject_from_normalized(x).normalize();
    let frame = DMat3::from_cols(x, y, x.cross(y) * m.determinant().signum());
    DQuat::IDENTITY.slerp(DQuat::from_rotation_arc(up, (frame.transpose() * character_up).normalize()), part)
}

/// Returns the angle of a rotation, radians; accurate for small angles.
fn angle(turn: DMat3) -> f64 {
    let axis = DVec3::new(turn.y_axis.z - turn.z_axis.y, turn.z_axis.x - turn.x_axis.z, turn.x_axis.y - turn.y_axis.x);
    let trace = turn.x_axis.x + turn.y_axis.y + turn.z_axis.z;
    axis.length().atan2(trace - 1.0)
}
