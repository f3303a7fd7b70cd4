//! Packed clips: they sample like their unpacked clips, keep the tolerance of the reduction, and survive arbitrary
//! bytes.

use aim_animation::glam::{Quat, Vec3};
use aim_animation::{
    Bone, Clip, ClipControl, Control, Cursor, HermiteKey, Instance, Looping, Model, PackedClip, PackedError, Reduction,
    Skeleton, Track, Transform,
};

use crate::common::Rng;
use crate::reducing::{any_clip, any_skeleton, error, scalar_error, times};

fn packed(rng: &mut Rng) -> (Skeleton, Clip, f32, aim_animation::Packed) {
    let bones = 1 + rng.below(9);
    let (skeleton, clip) = (any_skeleton(rng, bones), any_clip(rng, bones));
    let tolerance = [0.0, 1e-6, 1e-4, 1e-3, 1e-2, 0.1][rng.below(6)];
    let packed = Reduction::new(tolerance).pack(&clip, &skeleton).unwrap();
    (skeleton, clip, tolerance, packed)
}

#[test]
fn the_tolerance_is_that_of_keys_and_rounding_together() {
    let mut rng = Rng(21);
    for case in 0..60 {
        let (skeleton, clip, tolerance, packed) = packed(&mut rng);
        let mut cursor = packed.clip.cursor();
        let found = error(&skeleton, &clip, |time, pose| packed.clip.sample(time, &mut cursor, pose));
        assert!(found <= f64::from(tolerance).max(1e-12), "{case}: {found} of {tolerance}");
        assert!(
            (found - f64::from(packed.error)).abs() <= 0.02 * f64::from(tolerance) + 1e-12,
            "{case}: {found} {tolerance} {}",
            packed.error
        );
        let mut cursor = packed.clip.cursor();
        let off = scalar_error(&clip, |time, scalars| packed.clip.sample_scalars(time, &mut cursor, scalars));
        assert!(off <= 1e-3, "{case}: {off}");
        assert_eq!((packed.clip.name(), packed.clip.length_s()), (clip.name(), clip.length_s()));
        assert_eq!(packed.clip.events(), clip.events());
    }
}

fn same_bits(a: &Transform, b: &Transform) -> bool {
    let bits = |numbers: &[f32]| numbers.iter().map(|number| number.to_bits()).collect::<Vec<_>>();
    let rotation = |q: Quat| q.to_array().map(|number| number + 0.0);
    (rotation(a.rotation) == rotation(b.rotation) || rotation(a.rotation) == rotation(-b.rotation))
        && bits(&a.translation.to_array()) == bits(&b.translation.to_array())
        && bits(&a.scale.to_array()) == bits(&b.scale.to_array())
}

#[test]
fn samples_equal_those_of_the_unpacked_clip_for_any_cursor() {
    let mut rng = Rng(22);
    for case in 0..40 {
        let (skeleton, clip, _, packed) = packed(&mut rng);
        let (packed, floats) = (&packed.clip, packed.clip.unpacked());
        assert_eq!(packed.events(), floats.events());
        assert_eq!(packed.length_s(), floats.length_s());
        let mut all = times(&clip);
        all.extend([-1.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e9]);
        all.extend((0..50).map(|_| rng.between(0.0, 4.0)));
        let mut cursors = [packed.cursor(), clip.cursor(), Cursor::default()];
        for time in all {
            let mut expected = skeleton.rest().to_vec();
            floats.sample(time, &mut floats.cursor(), &mut expected);
            for cursor in &mut cursors {
                let mut pose = skeleton.rest().to_vec();
                packed.sample(time, cursor, &mut pose);
                let is_same = pose.iter().zip(&expected).all(|(a, b)| same_bits(a, b));
                assert!(is_same, "{case} {time}: {pose:?} {expected:?}");
                let [mut a, mut b] = [[9.0; 8]; 2];
                packed.sample_scalars(time, cursor, &mut a);
                floats.sample_scalars(time, &mut floats.cursor(), &mut b);
                assert_eq!(a, b, "{case} {time}");
            }
        }
    }
}

/// A cursor's cached keys of one clip are never used for another, even if that clip reuses the same memory.
#[test]
fn a_cursor_may_be_used_with_several_clips() {
    let mut rng = Rng(26);
    let mut cursor: Option<Cursor> = None;
    for case in 0..60 {
        let (skeleton, _, _, packed) = packed(&mut rng);
        let floats = packed.clip.unpacked();
        let cursor = cursor.get_or_insert_with(|| packed.clip.cursor());
        for time in [0.1, 0.11, 0.4] {
            let [mut a, mut b] = [skeleton.rest().to_vec(), skeleton.rest().to_vec()];
            packed.clip.sample(time, cursor, &mut a);
            floats.sample(time, &mut floats.cursor(), &mut b);
            assert!(a.iter().zip(&b).all(|(a, b)| same_bits(a, b)), "{case} {time}");
        }
    }
}

/// If neighbouring keys are half a turn apart, both signs are equally near; the unpacked clip still takes the same arc.
#[test]
fn half_turns_unpack_to_the_same_arc() {
    let still = Quat::from_xyzw(0.0, 0.0, 0.0, 0.0);
    let keys = [(0.0, -1.0), (0.8, -0.6), (0.6, 0.8)].map(|(x, w)| HermiteKey {
        value: Quat::from_xyzw(x, 0.0, 0.0, w),
        into: still,
        out: still,
    });
    let clip = Clip::new("c").with_rotation(0, Track::hermite([0.0, 1.0, 2.0], &keys).unwrap());
    let skeleton = Skeleton::new([Bone::new("b", None)]).unwrap();
    let packed = Reduction::new(0.05).pack(&clip, &skeleton).unwrap().clip;
    let floats = packed.unpacked();
    for k in 0..=200_u8 {
        let time = f32::from(k) * 0.01;
        let [mut a, mut b] = [[Transform::IDENTITY]; 2];
        packed.sample(time, &mut packed.cursor(), &mut a);
        floats.sample(time, &mut floats.cursor(), &mut b);
        assert!(same_bits(&a[0], &b[0]), "{time}: {a:?} {b:?}");
    }
}

/// A model plays packed clips like unpacked ones; they are numbered after these.
#[test]
fn instances_play_packed_clips() {
    let mut rng = Rng(25);
    for _ in 0..20 {
        let (skeleton, clip, _, packed) = packed(&mut rng);
        let models = [
            Model::new(skeleton.clone(), [clip.clone(), packed.clip.unpacked()]),
            Model::new(skeleton.clone(), [clip.clone()]).with_packed(packed.clip.clone()),
        ];
        assert_eq!(models[1].packed_clips(), std::slice::from_ref(&packed.clip));
        let mut poses = [skeleton.rest().to_vec(), skeleton.rest().to_vec()];
        let mut heroes = models.each_ref().map(Instance::new);
        for hero in &mut heroes {
            hero.play(ClipControl::new(0).with_weight(0.5));
            hero.play(ClipControl::new(1));
        }
        for _ in 0..40 {
            for ((hero, model), pose) in heroes.iter_mut().zip(&models).zip(&mut poses) {
                hero.advance(model, 0.06);
                hero.pose(model, pose).unwrap();
            }
            assert!(poses[0].iter().zip(&poses[1]).all(|(a, b)| same_bits(a, b)), "{poses:?}");
            let [a, b] =
                [0, 1].map(|k| heroes[k].events(&models[k]).map(|(n, event)| (n, event.clone())).collect::<Vec<_>>());
            assert_eq!(a, b);
        }
    }
}

#[test]
fn written_bytes_read_back_the_same() {
    let mut rng = Rng(23);
    for case in 0..40 {
        let (_, _, _, packed) = packed(&mut rng);
        let bytes = packed.clip.to_bytes();
        assert_eq!(PackedClip::from_bytes(&bytes).as_ref(), Ok(&packed.clip), "{case}");
        for end in 0..bytes.len() {
            assert!(PackedClip::from_bytes(&bytes[..end]).is_err(), "{case}: cut at {end}");
        }
        let longer = [&bytes[..], &[0]].concat();
        assert_eq!(PackedClip::from_bytes(&longer), Err(PackedError::Rest(1)), "{case}");
    }
}

#[test]
fn damaged_bytes_give_an_error_or_sound_samples() {
    let mut rng = Rng(24);
    let mut sound = 0;
    for case in 0..60 {
        let (_, _, _, packed) = packed(&mut rng);
        let bytes = packed.clip.to_bytes();
        for _ in 0..60 {
            let mut bytes = bytes.clone();
            for _ in 0..1 + rng.below(3) {
                let (at, bit) = (rng.below(bytes.len()), rng.below(8));
                bytes[at] ^= 1 << bit;
            }
            let Ok(damaged) = PackedClip::from_bytes(&bytes) else { continue };
            sound += 1;
            let mut cursor = damaged.cursor();
            for k in 0..20_u8 {
                let mut pose = [Transform::IDENTITY; 12];
                damaged.sample(f32::from(k) * 0.2, &mut cursor, &mut pose);
                assert!(pose.iter().all(Transform::is_sound), "{case}: {pose:?}");
            }
            assert_eq!(PackedClip::from_bytes(&damaged.to_bytes()).as_ref(), Ok(&damaged), "{case}");
        }
    }
    assert!(sound > 100, "{sound}");
}

#[test]
fn each_damage_has_its_error() {
    let skeleton = Skeleton::new([Bone::new("b", None)]).unwrap();
    let clip = Clip::new("é").with_event(0.5, "e").unwrap().with_length(2.0);
    let clip = clip.with_translation(0, Track::linear([0.0, 1.0], [Vec3::ZERO, Vec3::X]).unwrap());
    let bytes = Reduction::new(1e-3).pack(&clip, &skeleton).unwrap().clip.to_bytes();
    let with = |at: usize, byte: u8| {
        let mut bytes = bytes.clone();
        bytes[at] = byte;
        PackedClip::from_bytes(&bytes).unwrap_err()
    };
    assert_eq!(with(0, b'X'), PackedError::Magic);
    assert_eq!(with(4, 9), PackedError::Version(9));
    assert_eq!(with(12, 0xff), PackedError::Name);
    // Corrupt the length's sign, the event's exponent, and the length of a name.
    assert_eq!(with(17, 0xc0), PackedError::Time);
    assert_eq!(with(25, 0x7f), PackedError::Time);
    assert_eq!(with(11, 0xff), PackedError::End);
    let replaced = |old: &[u8], new: &[u8]| {
        let at = bytes.windows(old.len()).position(|window| window == old).unwrap();
        PackedClip::from_bytes(&[&bytes[..at], new, &bytes[at + old.len()..]].concat()).unwrap_err()
    };
    // Two keys at 0 and 1 s: with a time past the end, out of order, negative; and a clip of infinite length.
    let times = |from: f32, to: f32| [&2_u32.to_le_bytes()[..], &from.to_le_bytes(), &to.to_le_bytes()].concat();
    assert_eq!(replaced(&times(0.0, 1.0), &times(0.0, 2.5)), PackedError::Time);
    assert_eq!(replaced(&times(0.0, 1.0), &times(1.0, 0.5)), PackedError::Time);
    assert_eq!(replaced(&times(0.0, 1.0), &times(-1.0, 1.0)), PackedError::Time);
    assert_eq!(replaced(&2.0_f32.to_le_bytes(), &f32::INFINITY.to_le_bytes()), PackedError::Time);
    // Extra bytes after the last track.
    let size = u32::try_from(bytes.len() - bytes.windows(8).position(|w| w == [1, 0, 0, 0, 1, 0, 0, 0]).unwrap() - 12)
        .unwrap();
    let at = bytes.len() - size as usize;
    let padded = [&bytes[..at - 4], &(size + 3).to_le_bytes(), &bytes[at..], &[0; 3]].concat();
    assert_eq!(PackedClip::from_bytes(&padded), Err(PackedError::Rest(3)));
    let messages = [PackedError::Track(3), PackedError::Rest(2), PackedError::Version(9), PackedError::End];
    let messages = messages.map(|error| error.to_string());
    for (message, part) in messages.iter().zip(["track 3", "2 bytes", "version 9", "cut"]) {
        assert!(message.contains(part), "{message}");
    }
}

#[test]
fn a_packed_clip_reports_the_same_events() {
    let clip = Clip::new("c").with_length(2.0).with_event(0.0, "a").unwrap().with_event(1.5, "b").unwrap();
    let skeleton = Skeleton::new([]).unwrap();
    let packed = Reduction::new(0.1).pack(&clip, &skeleton).unwrap().clip;
    let step = Control::new().with_looping(Looping::Repeat).advance(5.0, 2.0);
    assert!(packed.events_passed(&step).eq(clip.events_passed(&step)));
    assert!(packed.events_passed(&step).count() > 1);
}

#[test]
fn a_packed_clip_is_small() {
    let times: Vec<f32> = (0..=90_u8).map(|k| f32::from(k) / 30.0).collect();
    let turns: Vec<Quat> = times.iter().map(|time| Quat::from_rotation_z((time * 2.0).sin())).collect();
    let clip = Clip::new("c").with_rotation(0, Track::linear(times, turns).unwrap());
    let skeleton = Skeleton::new([Bone::new("b", None)]).unwrap();
    let packed = Reduction::new(1e-3).pack(&clip, &skeleton).unwrap();
    assert!(packed.clip.bytes() * 10 < clip.bytes(), "{} of {}", packed.clip.bytes(), clip.bytes());
    // A scalar curve is packed like a bone's.
    let weights: Vec<f32> = (0..=90_u8).map(|k| 0.5 + 0.5 * (f32::from(k) / 15.0).sin()).collect();
    let frames: Vec<f32> = (0..=90_u8).map(|k| f32::from(k) / 30.0).collect();
    let smile = Clip::new("c").with_scalar(2, Track::linear(frames, weights).unwrap());
    let smile_packed = Reduction::new(1e-3).pack(&smile, &skeleton).unwrap().clip;
    assert!(smile_packed.bytes() * 4 < smile.bytes(), "{} of {}", smile_packed.bytes(), smile.bytes());
    // The serialised form is about as large as the one in memory.
    assert!(packed.clip.to_bytes().len() < packed.clip.bytes() + 48);
}

#[test]
fn the_bytes_of_version_one_do_not_change() {
    let skeleton = Skeleton::new([Bone::new("b", None)]).unwrap();
    let clip = Clip::new("n").with_event(0.5, "e").unwrap();
    let clip = clip.with_translation(0, Track::linear([0.0, 1.0], [Vec3::ZERO, Vec3::X]).unwrap());
    let packed = Reduction::new(1e-2).pack(&clip, &skeleton).unwrap().clip;
    let hex: String = packed.to_bytes().iter().map(|byte| format!("{byte:02x}")).collect();
    let expected = "41494d5001000000010000006e0000803f010000000000003f010000006502000000000000000000803f010000000100000009\
        000000210060780000000080";
    assert_eq!(hex, expected);
    // Two times, the offset of the track, and 9 bytes of data with 8 bytes of padding.
    assert_eq!(packed.bytes(), 4 * (2 + 1) + 9 + 8);
}

/// A swing about three axes around an orientation, sampled at 30 Hz for three seconds.
fn swinging(about: Quat) -> Track<Quat> {
    let times: Vec<f32> = (0..=90_u8).map(|k| f32::from(k) / 30.0).collect();
    let turn = |t: &f32| Quat::from_scaled_axis(0.4 * Vec3::new(t.sin(), (1.7 * t).cos(), (2.3 * t).sin())) * about;
    let turns: Vec<Quat> = times.iter().map(turn).collect();
    Track::linear(times, turns).unwrap()
}

/// Every kind of track is packed in few bits, with any component of a rotation the largest and over whole turns: none
/// falls back to floats unnoticed.
#[test]
fn every_kind_of_track_packs() {
    let times: Vec<f32> = (0..=90_u8).map(|k| f32::from(k) / 30.0).collect();
    let wave = |k: f32| times.iter().map(move |t| 0.5 + 0.5 * (k * t).sin());
    let vectors: Vec<Vec3> = wave(1.0).zip(wave(2.1)).map(|(a, b)| Vec3::new(a, b, a - b)).collect();
    let weights: Vec<f32> = wave(1.9).collect();
    let whole: Vec<Quat> = times
        .iter()
        .map(|t| Quat::from_axis_angle(Vec3::new(0.6, 0.0, 0.8), 2.5 * t + 0.3 * (3.0 * t).sin()))
        .collect();
    let steps: Vec<Vec3> = (0..=90_u8).map(|k| Vec3::splat(f32::from(k / 13))).collect();
    let clip = || Clip::new("c");
    let turned = |x, y, z, w| clip().with_rotation(0, swinging(Quat::from_xyzw(x, y, z, w)));
    let linear = |values: Vec<Vec3>| clip().with_translation(0, Track::linear(times.clone(), values).unwrap());
    // Each case with its limit in bytes: 2 % above the present size.
    let cases = [
        ("x", turned(1.0, 0.0, 0.0, 0.0), 127_usize),
        ("y", turned(0.0, 1.0, 0.0, 0.0), 126),
        ("z", turned(0.0, 0.0, 1.0, 0.0), 127),
        ("w", turned(0.0, 0.0, 0.0, 1.0), 126),
        ("whole turns", clip().with_rotation(0, Track::linear(times.clone(), whole).unwrap()), 141),
        ("vectors", linear(vectors.clone()), 128),
        ("scale", clip().with_scale(0, Track::catmull_rom(times.clone(), vectors).unwrap()), 126),
        ("steps", clip().with_translation(0, Track::step(times.clone(), steps).unwrap()), 86),
        ("weights", clip().with_scalar(3, Track::linear(times.clone(), weights.clone()).unwrap()), 69),
        ("smooth weights", clip().with_scalar(900, Track::catmull_rom(times.clone(), weights).unwrap()), 69),
    ];
    let skeleton = Skeleton::new([Bone::new("b", None)]).unwrap();
    for (name, clip, most) in cases {
        let packed = Reduction::new(1e-3).pack(&clip, &skeleton).unwrap().clip;
        assert!(packed.bytes() <= most, "{name}: {} bytes, {most} before", packed.bytes());
    }
}

/// Regression limits on the total size of many random clips: half a percent above the sizes when they were set.
#[test]
fn clips_of_all_kinds_stay_as_small() {
    let mut rng = Rng(27);
    let (mut floats, mut reduced, mut packed) = (0, 0, 0);
    for _ in 0..60 {
        let bones = 1 + rng.below(9);
        let (skeleton, clip) = (any_skeleton(&mut rng, bones), any_clip(&mut rng, bones));
        let reduction = Reduction::new([0.0, 1e-4, 1e-3, 1e-2, 0.1][rng.below(5)]);
        floats += clip.bytes();
        reduced += reduction.reduce(&clip, &skeleton).unwrap().clip.bytes();
        packed += reduction.pack(&clip, &skeleton).unwrap().clip.bytes();
    }
    assert!(reduced <= 133_300 && packed <= 87_900, "{reduced} and {packed} of {floats}");
}
