//! Reduced clips: errors by forward kinematics in f64, and key counts near what each kind of track needs.

use aim_animation::glam::{DAffine3, DVec3, Quat, Vec3};
use aim_animation::{Bone, Clip, Curve, HermiteKey, Reduction, ReductionError, Skeleton, Track, Transform};

use crate::common::{Rng, exact};

/// Returns each bone's transform in model space.
fn world(skeleton: &Skeleton, pose: &[Transform]) -> Vec<DAffine3> {
    let mut world: Vec<DAffine3> = Vec::new();
    for (bone, parent) in skeleton.parents().iter().enumerate() {
        let local = exact(&pose[bone]);
        world.push(parent.map_or(local, |parent| world[parent] * local));
    }
    world
}

/// Returns the sample points of each bone, in its space: its origin, its children's origins at rest, and points at the
/// bone's length along its axes in both directions.
fn points(skeleton: &Skeleton) -> Vec<Vec<DVec3>> {
    let rest = world(skeleton, skeleton.rest());
    let origin = |bone: usize| rest[bone].translation;
    let size = (0..skeleton.len()).map(|bone| origin(bone).distance(origin(0))).fold(0.0, f64::max);
    let own = |bone: usize| {
        let children = skeleton.children(bone).map(|child| origin(child).distance(origin(bone)));
        Some(children.fold(0.0, f64::max)).filter(|length| *length > 1e-4 * size)
    };
    (0..skeleton.len())
        .map(|bone| {
            let length = skeleton.ancestry(bone).find_map(own);
            let length = length.unwrap_or(if size > 0.0 { 0.1 * size } else { 1.0 });
            let mut points = vec![DVec3::ZERO];
            points.extend(skeleton.children(bone).map(|child| skeleton.rest()[child].translation.as_dvec3()));
            for axis in DVec3::AXES {
                let along = axis * (length / rest[bone].transform_vector3(axis).length());
                points.extend([along, -along]);
            }
            points
        })
        .collect()
}

/// Returns the times of all keys, eight times between neighbouring keys, and the time just before each key.
pub(crate) fn times(clip: &Clip) -> Vec<f32> {
    let mut keys: Vec<f32> = vec![0.0];
    for tracks in clip.tracks() {
        keys.extend(tracks.translation.iter().flat_map(|track| track.times()));
        keys.extend(tracks.rotation.iter().flat_map(|track| track.times()));
        keys.extend(tracks.scale.iter().flat_map(|track| track.times()));
    }
    keys.extend(clip.scalars().iter().flat_map(|(_, track)| track.times()));
    keys.sort_by(f32::total_cmp);
    keys.dedup();
    let between =
        |pair: &[f32]| [1, 2, 3, 4, 5, 6, 7, 8].map(|k: u8| pair[0] + (pair[1] - pair[0]) * (f32::from(k) / 9.0));
    let mut times: Vec<f32> = keys.windows(2).flat_map(between).collect();
    times.extend(keys.iter().flat_map(|key| [*key, key.next_down().max(0.0)]));
    times.sort_by(f32::total_cmp);
    times
}

/// Returns the largest distance between a bone's sample points in the clip and in another sampling of it.
pub(crate) fn error(skeleton: &Skeleton, clip: &Clip, mut sample: impl FnMut(f32, &mut [Transform])) -> f64 {
    let points = points(skeleton);
    let mut worst = 0.0_f64;
    for time in times(clip) {
        let mut poses = [skeleton.rest().to_vec(), skeleton.rest().to_vec()];
        clip.sample(time, &mut clip.cursor(), &mut poses[0]);
        sample(time, &mut poses[1]);
        let [a, b] = poses.map(|pose| world(skeleton, &pose));
        for (bone, points) in points.iter().enumerate() {
            for point in points {
                let off = a[bone].transform_point3(*point).distance(b[bone].transform_point3(*point));
                assert!(off.is_finite(), "bone {bone} at {time} s");
                worst = worst.max(off);
            }
        }
    }
    worst
}

/// Returns a tree or a chain of bones, some of them scaled or mirrored.
pub(crate) fn any_skeleton(rng: &mut Rng, bones: usize) -> Skeleton {
    let is_chain = rng.below(2) == 0;
    let bones = (0..bones).map(|bone| {
        let parent = bone.checked_sub(1).map(|last| if is_chain { last } else { rng.below(last + 1) });
        let mut rest = if rng.below(3) == 0 { rng.transform() } else { rng.rigid() };
        rest.translation *= 0.2;
        rest.scale = rest.scale.clamp(Vec3::splat(-1.1), Vec3::splat(1.1));
        Bone::new("b", parent).with_rest(rest)
    });
    Skeleton::new(bones.collect::<Vec<_>>()).unwrap()
}

/// Returns key times with equal or random steps, some of them repeated.
fn any_times(rng: &mut Rng, keys: usize) -> Vec<f32> {
    let is_even = rng.below(2) == 0;
    let mut time = if rng.below(4) == 0 { 0.3 } else { 0.0 };
    let mut times = Vec::new();
    for _ in 0..keys {
        times.push(time);
        let jumps = rng.below(8) == 0 && times.iter().rev().nth(1) != Some(&time);
        time += match (jumps, is_even) {
            (true, _) => 0.0,
            (_, true) => 1.0 / 32.0,
            _ => rng.between(0.01, 0.2),
        };
    }
    times
}

/// Returns a track of any kind through the values that `value` gives at its key times.
fn any_track<T: aim_animation::Value>(rng: &mut Rng, mut value: impl FnMut(&mut Rng, f32) -> T) -> Track<T> {
    let keys = [1, 2, 3, 20, 60][rng.below(5)];
    let times = any_times(rng, keys);
    let values: Vec<T> = times.iter().map(|time| value(rng, *time)).collect();
    match rng.below(4) {
        0 => Track::step(times, values),
        1 => Track::catmull_rom(times, values),
        _ => Track::linear(times, values),
    }
    .unwrap()
}

/// Returns a clip with all kinds of tracks.
pub(crate) fn any_clip(rng: &mut Rng, bones: usize) -> Clip {
    let mut clip = Clip::new("any").with_event(0.25, "step").unwrap();
    for bone in 0..bones {
        let (axis, noise, speed) = (rng.vector(1.0), [0.0, 0.0, 0.2][rng.below(3)], rng.between(0.5, 6.0));
        let from = rng.rotation();
        if rng.below(4) > 0 {
            let turn = |rng: &mut Rng, time: f32| {
                let sign = if rng.below(2) == 0 { 1.0 } else { -1.0 };
                from * Quat::from_scaled_axis(axis * (time * speed).sin() + rng.vector(noise)) * sign
            };
            clip = clip.with_rotation(bone, any_track(rng, turn));
        }
        if rng.below(3) == 0 {
            let way = |rng: &mut Rng, time: f32| axis * (time * speed).cos() * 0.1 + rng.vector(0.1 * noise);
            clip = clip.with_translation(bone, any_track(rng, way));
        }
        if rng.below(5) == 0 {
            let size =
                |rng: &mut Rng, time: f32| Vec3::ONE + axis * (time * speed).sin() * 0.1 + rng.vector(0.1 * noise);
            clip = clip.with_scale(bone, any_track(rng, size));
        }
    }
    let speed = rng.between(0.5, 6.0);
    clip.with_scalar(7, any_track(rng, |_, time| (time * speed).sin())).with_length(5.0)
}

/// Returns the largest difference of scalar 7.
pub(crate) fn scalar_error(clip: &Clip, mut sample: impl FnMut(f32, &mut [f32])) -> f64 {
    let off = |time: f32| {
        let [mut a, mut b] = [[0.0; 8]; 2];
        clip.sample_scalars(time, &mut clip.cursor(), &mut a);
        sample(time, &mut b);
        (f64::from(a[7]) - f64::from(b[7])).abs()
    };
    times(clip).into_iter().map(off).fold(0.0, f64::max)
}

#[test]
fn no_end_of_a_bone_is_farther_off_than_the_tolerance() {
    let mut rng = Rng(11);
    let mut smaller = 0;
    for case in 0..60 {
        let bones = 1 + rng.below(9);
        let skeleton = any_skeleton(&mut rng, bones);
        let clip = any_clip(&mut rng, bones);
        let tolerance = [1e-4, 1e-3, 1e-2, 0.1][rng.below(4)];
        let reduced = Reduction::new(tolerance).reduce(&clip, &skeleton).unwrap();
        let mut cursor = reduced.clip.cursor();
        let found = error(&skeleton, &clip, |time, pose| reduced.clip.sample(time, &mut cursor, pose));
        assert!(found <= f64::from(tolerance), "{case}: {found} of {tolerance}");
        // The reported error is attained at some time.
        assert!((found - f64::from(reduced.error)).abs() < 0.02 * f64::from(tolerance), "{case}: {found} {reduced:?}");
        assert_eq!(reduced.at.is_some(), reduced.error > 0.0, "{case}");
        let mut cursor = reduced.clip.cursor();
        let off = scalar_error(&clip, |time, scalars| reduced.clip.sample_scalars(time, &mut cursor, scalars));
        assert!(off <= 1e-3, "{case}: {off}");
        assert!(reduced.clip.bytes() <= clip.bytes(), "{case}");
        assert_eq!((reduced.clip.name(), reduced.clip.length_s()), (clip.name(), clip.length_s()));
        assert_eq!(reduced.clip.events(), clip.events());
        smaller += usize::from(2 * reduced.clip.bytes() < clip.bytes());
    }
    assert!(smaller > 10, "{smaller}");
}

/// Returns a rod of two bones along x, one metre each.
fn rod() -> Skeleton {
    let next = |parent| Bone::new("b", parent).with_rest(Transform::from_translation(Vec3::X));
    Skeleton::new([Bone::new("a", None), next(Some(0)), next(Some(1))]).unwrap()
}

#[expect(clippy::cast_precision_loss, reason = "a few hundred")]
fn frames(count: usize) -> Vec<f32> {
    (0..count).map(|k| k as f32 / 30.0).collect()
}

fn rotation_of(clip: &Clip, bone: usize) -> Option<&Track<Quat>> {
    clip.bone(bone)?.rotation.as_ref()
}

fn turning(angle: impl Fn(f32) -> f32) -> Track<Quat> {
    let times = frames(61);
    let turns: Vec<Quat> = times.iter().map(|time| Quat::from_rotation_z(angle(*time))).collect();
    Track::linear(times, turns).unwrap()
}

/// Asserts that a random clip with this many bones stays within its tolerance when packed.
fn assert_packed_holds(seed: u64, bones: usize, exponent: f32) {
    let mut rng = Rng(seed);
    let (skeleton, clip) = (any_skeleton(&mut rng, bones), any_clip(&mut rng, bones));
    let tolerance = 10.0_f32.powf(exponent);
    let packed = Reduction::new(tolerance).with_pins([0.4, 1.0]).pack(&clip, &skeleton).unwrap().clip;
    let found = error(&skeleton, &clip, |time, pose| packed.sample(time, &mut packed.cursor(), pose));
    assert!(found <= f64::from(tolerance), "{found} of {tolerance}");
}

/// A pin splits the interval between two keys, but the interval's own check points are still checked.
#[test]
fn errors_between_keys_are_measured_despite_a_pin() {
    assert_packed_holds(725_979_205_523_519_347, 4, -2.325_768_7);
}

/// Before its first key a track holds that key's value, even if the track jumps at that key.
#[test]
fn errors_before_a_jump_at_the_first_key_are_measured() {
    assert_packed_holds(5_658_204_085_348_885_501, 1, -5.895_981);
}

#[test]
fn constant_tracks_have_one_key_and_tracks_at_rest_none() {
    let skeleton = rod();
    let still = |value: Vec3| Track::linear(frames(61), vec![value; 61]).unwrap();
    let clip = Clip::new("c")
        .with_translation(0, still(Vec3::Y))
        .with_translation(1, still(Vec3::X))
        .with_rotation(1, turning(|_| 0.0))
        .with_scale(2, still(Vec3::ONE))
        .with_scalar(3, Track::linear(frames(61), vec![0.5; 61]).unwrap());
    let reduced = Reduction::new(1e-3).reduce(&clip, &skeleton).unwrap();
    let only = &reduced.clip.tracks()[0];
    assert_eq!((reduced.clip.tracks().len(), only.bone), (1, 0));
    assert_eq!(only.translation.as_ref().unwrap().values(), [Vec3::Y]);
    assert_eq!(reduced.clip.scalars()[0].1.values(), [0.5]);
    assert_eq!((reduced.error, reduced.at), (0.0, None));
    // One value each, sharing a single key time.
    assert_eq!(reduced.clip.bytes(), 4 * (3 + 1 + 1));
}

#[test]
fn straight_movements_have_two_keys_and_curved_ones_few() {
    let skeleton = rod();
    let clip = Clip::new("c").with_rotation(0, turning(|time| time * 0.7));
    let reduced = Reduction::new(1e-3).reduce(&clip, &skeleton).unwrap();
    let track = rotation_of(&reduced.clip, 0).unwrap();
    assert_eq!((track.curve(), track.times()), (Curve::Linear, &[0.0, 2.0][..]));

    let swing = Clip::new("c").with_rotation(0, turning(f32::sin));
    let reduced = Reduction::new(1e-3).reduce(&swing, &skeleton).unwrap();
    let track = rotation_of(&reduced.clip, 0).unwrap();
    assert!(track.curve() == Curve::Cubic && track.times().len() < 10, "{track:?}");
    // A larger tolerance needs fewer bytes.
    let rough = Reduction::new(1e-2).reduce(&swing, &skeleton).unwrap();
    assert!(rough.clip.bytes() < reduced.clip.bytes());
}

#[test]
fn a_rotation_error_counts_by_the_length_of_the_subtree() {
    // 1.5 mm at the ends of the rod, 0.5 mm at a tip bone of a third of its length.
    let wave = |_: usize| turning(|time| 7e-4 * (time * 9.0).sin());
    let skeleton = rod();
    let at_root = Reduction::new(1e-3).reduce(&Clip::new("c").with_rotation(0, wave(0)), &skeleton).unwrap();
    let at_tip = Reduction::new(1e-3).reduce(&Clip::new("c").with_rotation(2, wave(2)), &skeleton).unwrap();
    assert!(rotation_of(&at_root.clip, 0).is_some_and(|track| track.times().len() > 2), "{at_root:?}");
    assert!(rotation_of(&at_tip.clip, 2).is_none(), "{at_tip:?}");
    // A twist about the rod moves no origin.
    let times = frames(61);
    let twists: Vec<Quat> = times.iter().map(|time| Quat::from_rotation_x((time * 3.0).sin())).collect();
    let twist = Clip::new("c").with_rotation(2, Track::linear(times, twists).unwrap());
    let reduced = Reduction::new(1e-3).reduce(&twist, &skeleton).unwrap();
    assert!(rotation_of(&reduced.clip, 2).is_some_and(|track| track.times().len() > 5), "{reduced:?}");
}

#[test]
fn pins_and_ends_keep_their_exact_values() {
    let (mut rng, mut kept) = (Rng(5), 0);
    for case in 0..40 {
        let bones = 1 + rng.below(5);
        let skeleton = any_skeleton(&mut rng, bones);
        let clip = any_clip(&mut rng, bones);
        let pins = [rng.between(0.0, 3.0), 0.5, 1.0 / 3.0];
        let reduced = Reduction::new(1e-2).with_pins(pins).reduce(&clip, &skeleton).unwrap();
        for tracks in reduced.clip.tracks() {
            let original = clip.bone(tracks.bone).unwrap();
            if let (Some(track), Some(original)) = (&tracks.translation, &original.translation) {
                let ends = [original.times()[0], original.end_s()];
                for time in pins.into_iter().chain(ends.into_iter().filter(|_| track.times().len() > 1)) {
                    assert_eq!(track.sample(time), original.sample(time), "{case} {time}");
                    let is_within = original.times()[0] <= time && time <= original.end_s();
                    assert!(
                        track.times().len() == 1 || !is_within || track == original || track.times().contains(&time),
                        "{case}"
                    );
                    kept += 1;
                }
            }
            if let (Some(track), Some(original)) = (&tracks.rotation, &original.rotation) {
                for time in pins {
                    let off = (track.sample(time).dot(original.sample(time)).abs() - 1.0).abs();
                    assert!(off < 3e-7, "{case} {time}");
                    kept += 1;
                }
            }
        }
    }
    assert!(kept > 100, "{kept}");
    // A pinned pose during a hold keeps the clip's exact value, not a nearby one.
    let almost: Vec<Vec3> = frames(61).iter().map(|time| Vec3::Y + Vec3::X * 1e-4 * (time * 3.0).sin()).collect();
    let clip = Clip::new("c").with_translation(0, Track::linear(frames(61), almost.clone()).unwrap());
    let reduced = Reduction::new(1e-3).with_pins([0.5]).reduce(&clip, &rod()).unwrap();
    assert_eq!(reduced.clip.bone(0).unwrap().translation.as_ref().unwrap().sample(0.5), almost[15]);
}

#[test]
fn jumps_keep_both_sides_and_steps_stay_steps() {
    let times = [0.0, 0.5, 1.0, 1.0, 1.5, 2.0];
    let values = [0.0, 0.25, 0.5, 2.0, 2.1, 2.2].map(|x| Vec3::X * x);
    let steps = [0.0, 0.0, 1.0, 1.0, 1.0001, 3.0].map(|y| Vec3::Y * y);
    let step_times = [0.0, 0.3, 0.6, 0.9, 1.2, 1.5];
    let clip = Clip::new("c")
        .with_translation(0, Track::linear(times, values).unwrap())
        .with_translation(1, Track::step(step_times, steps).unwrap());
    let reduced = Reduction::new(1e-3).reduce(&clip, &rod()).unwrap();
    let track = |bone: usize| reduced.clip.bone(bone).unwrap().translation.as_ref().unwrap();
    assert_eq!(track(0).times(), [0.0, 1.0, 1.0, 2.0]);
    assert_eq!(track(0).values(), [values[0], values[2], values[3], values[5]]);
    assert_eq!((track(1).curve(), track(1).times()), (Curve::Step, &[0.0, 0.6, 1.5][..]));
}

#[test]
fn nothing_changes_at_tolerance_zero() {
    let mut rng = Rng(3);
    for case in 0..40 {
        let bones = 1 + rng.below(5);
        let skeleton = any_skeleton(&mut rng, bones);
        let clip = any_clip(&mut rng, bones);
        let reduced = Reduction::new(0.0).with_scalar_tolerance(0.0).reduce(&clip, &skeleton).unwrap();
        assert_eq!(reduced.error, 0.0, "{case}");
        let mut cursor = reduced.clip.cursor();
        assert!(error(&skeleton, &clip, |time, pose| reduced.clip.sample(time, &mut cursor, pose)) < 1e-12, "{case}");
    }
    let line = Track::linear([0.0, 0.5, 1.0, 2.0], [0.0, 0.5, 1.0, 2.0].map(|x| Vec3::Y * x)).unwrap();
    let reduced = Reduction::new(0.0).reduce(&Clip::new("c").with_translation(0, line), &rod()).unwrap();
    assert_eq!(reduced.clip.bone(0).unwrap().translation.as_ref().unwrap().times(), [0.0, 2.0]);
}

#[test]
fn invalid_tolerances_and_pins_are_refused() {
    let clip = Clip::new("c").with_rotation(0, turning(f32::sin));
    for tolerance in [-1.0, f32::NAN, f32::INFINITY] {
        let refused = [Reduction::new(tolerance), Reduction::new(1.0).with_scalar_tolerance(tolerance)];
        for reduction in refused {
            let found = reduction.reduce(&clip, &rod()).unwrap_err();
            assert!(matches!(found, ReductionError::Tolerance(t) if t.to_bits() == tolerance.to_bits()));
            assert!(reduction.pack(&clip, &rod()).is_err());
        }
        let found = Reduction::new(1.0).with_pins([0.0, tolerance]).reduce(&clip, &rod()).unwrap_err();
        assert!(matches!(found, ReductionError::Pin(t) if t.to_bits() == tolerance.to_bits()));
    }
}

/// A turn is measured at the child it moves most, even if that child lies between the axes.
#[test]
fn a_turn_is_measured_at_children_between_the_axes() {
    let child = Bone::new("child", Some(0)).with_rest(Transform::from_translation(Vec3::new(0.6, 0.8, 0.0)));
    let skeleton = Skeleton::new([Bone::new("b", None), child]).unwrap();
    let axis = Vec3::new(-0.8, 0.6, 0.0);
    let turns: Vec<Quat> = frames(40).iter().map(|t| Quat::from_axis_angle(axis, 0.5 * (2.0 * t).sin())).collect();
    let clip = Clip::new("c").with_rotation(0, Track::linear(frames(40), turns).unwrap());
    let reduced = Reduction::new(0.01).reduce(&clip, &skeleton).unwrap();
    let found = error(&skeleton, &clip, |time, pose| reduced.clip.sample(time, &mut reduced.clip.cursor(), pose));
    assert!(found > 1e-3 && (found - f64::from(reduced.error)).abs() < 1e-6, "{found}, told {}", reduced.error);
}

#[test]
fn a_pin_at_negative_zero_is_one_at_zero() {
    let clip = Clip::new("c").with_rotation(0, turning(|t| t * t));
    let reduced = |pin: f32| Reduction::new(1e-2).with_pins([pin]).pack(&clip, &rod()).unwrap().clip;
    let floats = |pin: f32| Reduction::new(1e-2).with_pins([pin]).reduce(&clip, &rod()).unwrap().clip;
    assert_eq!((reduced(-0.0), floats(-0.0)), (reduced(0.0), floats(0.0)));
    let times = floats(-0.0).bone(0).and_then(|tracks| tracks.rotation.clone()).unwrap();
    assert!(times.times()[0].is_sign_positive());
}

#[test]
fn clips_without_length_and_missing_bones_are_handled() {
    let empty = Reduction::new(1e-3).reduce(&Clip::new("c"), &rod()).unwrap();
    assert_eq!(empty.clip, Clip::new("c"));
    let none = Skeleton::new([]).unwrap();
    let clip = Clip::new("c").with_rotation(0, turning(f32::sin)).with_rotation(900, turning(f32::cos));
    assert_eq!(Reduction::new(10.0).reduce(&clip, &none).unwrap().clip, clip);
    let reduced = Reduction::new(10.0).reduce(&clip, &rod()).unwrap().clip;
    assert_eq!(reduced.bone(900), clip.bone(900));
    assert!(reduced.bone(0).is_none());
}

#[test]
fn quaternions_of_either_sign_are_one_rotation() {
    let times = frames(61);
    let turn = |k: usize| Quat::from_rotation_z(times[k].sin()) * if k % 2 == 0 { 1.0 } else { -1.0 };
    let turns: Vec<Quat> = (0..61).map(turn).collect();
    let clip = Clip::new("c").with_rotation(0, Track::linear(times.clone(), turns).unwrap());
    let reduced = Reduction::new(1e-3).reduce(&clip, &rod()).unwrap();
    assert!(rotation_of(&reduced.clip, 0).unwrap().times().len() < 10, "{reduced:?}");
}

/// If the quaternions of a cubic pass near zero, it turns by half a circle within a thousandth of its interval.
#[test]
fn a_fast_turn_between_measured_points_is_measured() {
    let key = |value: [f32; 4], tangent: [f32; 4]| {
        let [value, tangent] = [value, tangent].map(Quat::from_array);
        HermiteKey { value, into: tangent, out: tangent }
    };
    let first = key([-0.34, 0.14, -0.17, 0.35], [7.7, -2.9, 3.6, -7.1]);
    let keys = [first, first, key([0.07, 0.38, -0.36, 0.5], [6.4, -3.9, 3.8, 5.2])];
    let clip = Clip::new("c").with_rotation(0, Track::hermite([0.0, 0.01, 1.01], &keys).unwrap());
    let skeleton = Skeleton::new([Bone::new("b", None)]).unwrap();
    let reduced = Reduction::new(0.03).reduce(&clip, &skeleton).unwrap().clip;
    let mut worst = 0.0_f64;
    for k in 0..=20_000_u16 {
        let time = 0.01 + f32::from(k) / 20_000.0;
        let turns = [&clip, &reduced].map(|clip| rotation_of(clip, 0).unwrap().sample(time).as_dquat().normalize());
        for axis in DVec3::AXES {
            worst = worst.max((turns[0] * axis).distance(turns[1] * axis));
        }
    }
    assert!(worst < 0.045, "{worst}");
}

#[test]
fn cubic_keys_that_are_needed_stay() {
    let key = |x: f32, v: f32| HermiteKey { value: Vec3::Y * x, into: Vec3::Y * v, out: Vec3::Y * v };
    let cubic = Track::hermite([0.0, 0.7, 2.0], &[key(0.0, 3.0), key(1.0, -2.0), key(0.2, 1.0)]).unwrap();
    let clip = Clip::new("c").with_translation(0, cubic);
    assert_eq!(Reduction::new(1e-4).reduce(&clip, &rod()).unwrap().clip, clip);
    // A cubic split into pieces is merged again.
    let whole = Track::hermite([0.0, 2.0], &[key(0.0, 3.0), key(0.2, 1.0)]).unwrap();
    let divided: Vec<f32> = (0..=8_u8).map(|k| f32::from(k) / 4.0).collect();
    let at = |time: f32| {
        let (u, [d0, d1]) = (time / 2.0, [6.0, 2.0]);
        // Derivative of the Hermite cubic from 0 to 0.2 with these tangents.
        6.0 * u * (1.0 - u) * 0.2 + (1.0 - u) * (1.0 - 3.0 * u) * d0 + u * (3.0 * u - 2.0) * d1
    };
    let keys: Vec<_> = divided.iter().map(|time| key(whole.sample(*time).y, 0.5 * at(*time))).collect();
    let clip = Clip::new("c").with_translation(0, Track::hermite(divided, &keys).unwrap());
    let reduced = Reduction::new(1e-4).reduce(&clip, &rod()).unwrap();
    assert_eq!(reduced.clip.bone(0).unwrap().translation.as_ref().unwrap().times(), [0.0, 2.0]);
}

#[test]
fn long_clips_take_time_in_proportion() {
    let times: Vec<f32> = (0..20_000_u16).map(|k| f32::from(k) / 30.0).collect();
    let turns: Vec<Quat> = times.iter().map(|time| Quat::from_rotation_z((time * 0.01).sin())).collect();
    let clip = Clip::new("c").with_rotation(0, Track::linear(times, turns).unwrap());
    let reduced = Reduction::new(1e-2).reduce(&clip, &rod()).unwrap();
    assert!(rotation_of(&reduced.clip, 0).unwrap().times().len() < 60);
}
