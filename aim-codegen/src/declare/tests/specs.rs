//! Specs of correct declarations.

use core::f64::consts::PI;

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use syn::DeriveInput;

use super::parse;
use crate::declare::{Declared, from_derive_input};
use crate::{AngleRange, Frame, LimitsFrom, NaturalSpec, Role};

fn declared(item: &str) -> Declared {
    from_derive_input(&parse(item)).unwrap_or_else(|errors| panic!("{errors}"))
}

fn joint(settings: &str) -> Declared {
    declared(&format!("#[aim(axes(up = +X, forward = +Y))] struct Thug {{ #[joint({settings})] eye: Joint }}"))
}

fn frame(rig: &str) -> Frame {
    declared(&format!("#[aim({rig})] struct Thug {{ #[joint(heading = free, rate = 1rad)] eye: Joint }}")).spec.joints
        [0]
    .frame
}

#[test]
fn all_settings_are_read_together() {
    let found = declared(
        "#[aim(axes(up = +X, forward = +Y, left = +Z), crate = some::path, effector(origin = (0.0, 0.1, -2)),
            natural(eyes_only = 10deg, head_share = 1, engage = 3.141593rad, delay = 0.25))]
        pub struct Thug {
            #[joint(heading = -35deg..=35.5deg, pitch = -1e-1rad..=0deg, rate = 450deg, stiffness = 0.5, acceleration = 1_200deg,
                role = eye, bone = [\"a\", \"b\"], other_eye = \"R_eye\", upright = 0.5, pitch_taper = 0.25, limits_from = bind_pose,)]
            pub r#type: Joint,
            #[joint(heading = free, rate = 2rad, limits_from = animation, axes(up = +Z, forward = +Y), mirrored = true,
                hold = [\"clavicle_l\", \"clavicle_r\"])]
            neck: Joint,
            #[joint(heading = free, rate = 2rad, hold = [], axes(up = +Z, forward = +Y))]
            chest: Joint,
        }",
    );
    assert_eq!(found.ident, "Thug");
    assert_eq!(found.fields.iter().map(ToString::to_string).collect::<Vec<_>>(), ["r#type", "neck", "chest"]);
    assert_eq!(found.krate.map(|path| path.to_string()).as_deref(), Some("some :: path"));
    let [eye, neck, chest] = found.spec.joints.as_slice() else { panic!("three joints") };
    assert_eq!(eye.name, "type");
    assert_eq!(eye.bones, ["a", "b"]);
    assert_eq!(eye.heading, Some(AngleRange::Between(-35f64.to_radians(), 35.5f64.to_radians())));
    assert_eq!(eye.pitch, Some(AngleRange::Between(-0.1, 0.0)));
    assert_eq!((eye.rate, eye.acceleration), (450f64.to_radians(), Some(1200f64.to_radians())));
    assert_eq!(
        (eye.stiffness, eye.upright, eye.pitch_taper, eye.limits_from),
        (0.5, Some(0.5), Some(0.25), LimitsFrom::BindPose)
    );
    assert_eq!(eye.other_eye.as_deref(), Some("R_eye"));
    let clavicles = ["clavicle_l", "clavicle_r"].map(str::to_owned);
    assert_eq!([&eye.hold, &neck.hold, &chest.hold], [&None, &Some(clavicles.to_vec()), &Some(vec![])]);
    assert_eq!(neck.bones, ["neck"]);
    assert_eq!((neck.heading, neck.pitch), (Some(AngleRange::Free), None));
    assert_eq!((neck.stiffness, neck.upright, neck.pitch_taper), (1.0, None, None));
    assert_eq!((neck.acceleration, neck.limits_from), (None, LimitsFrom::Animation));
    // An undeclared role is `None`, whatever the field's name suggests.
    assert_eq!((eye.role, neck.role), (Role::Eye, Role::None));
    let natural = found.spec.natural.expect("it is declared");
    assert_eq!((natural.eyes_only, natural.head_share, natural.engage), (10f64.to_radians(), 1.0, PI));
    assert_eq!((natural.release, natural.delay), (NaturalSpec::default().release, 0.25));
    // Right-handed would be up × forward = Z × Y = -X.
    assert_eq!(neck.frame.left, [1.0, 0.0, 0.0]);
    assert_eq!(found.spec.effector.origin, [0.0, 0.1, -2.0]);
    assert_eq!(found.spec.effector.frame, eye.frame);
}

#[test]
fn half_a_turn_may_be_rounded() {
    for range in ["-180deg..=180deg", "-3.14159rad..=3.14160rad"] {
        let found = joint(&format!("heading = {range}, rate = 1rad"));
        let Some(AngleRange::Between(low, high)) = found.spec.joints[0].heading else { panic!("a range") };
        assert!(low >= -PI && high <= PI && high - low > 2.0 * PI - 1e-4, "{range}");
    }
}

#[test]
fn all_48_conventions_are_accepted_and_their_mirrors_refused() {
    const LETTERS: [&str; 3] = ["X", "Y", "Z"];
    let name = |v: [f64; 3]| {
        let at = v.iter().position(|x| *x != 0.0).expect("an axis");
        format!("{}{}", if v[at] < 0.0 { '-' } else { '+' }, LETTERS[at])
    };
    for wanted in Frame::cardinal() {
        let [up, forward, left] = [wanted.up, wanted.forward, wanted.left].map(name);
        let [down, back, right] = [wanted.up, wanted.forward, wanted.left].map(|v| name(v.map(|x| -x)));
        let (hand, other) = if wanted.handedness() > 0.0 { ("right", "left") } else { ("left", "right") };
        let declare = |axes: &str, hand: &str| format!("axes({axes}), handedness = {hand}");
        for axes in [
            format!("up = {up}, forward = {forward}, left = {left}"),
            format!("up = {up}, forward = {forward}"),
            format!("left = {left}, up = {up}"),
            format!("back = {back}, right = {right}"),
            format!("down = {down}, back = {back}, left = {left}"),
        ] {
            let frame = frame(&declare(&axes, hand));
            assert_eq!(frame, wanted, "{axes}");
            assert_eq!(frame.handedness(), wanted.handedness());
        }
        let triple = format!("up = {up}, forward = {forward}, left = {left}");
        let item = format!(
            "#[aim({})] struct Thug {{ #[joint(heading = free, rate = 1rad)] eye: Joint }}",
            declare(&triple, other)
        );
        let errors = from_derive_input(&parse(&item)).expect_err("the other handedness");
        let help = errors.iter().next().expect("an error").help().to_owned();
        // The flip that the help suggests is correct: with it, the declaration passes.
        let flip = help.split('`').nth(1).expect("a suggestion");
        let flipped = format!("up = {up}, forward = {forward}, {flip}");
        assert_eq!(frame(&declare(&flipped, other)).handedness(), -wanted.handedness());
    }
}

#[test]
fn slightly_skewed_vectors_are_made_perpendicular_to_forward() {
    let found = frame("axes(up = (0.0, 1.0003, 0.008), forward = (0.0, 0.0, 1.0))");
    assert_eq!((found.up, found.forward, found.left), ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]));
}

#[test]
fn the_nearest_frame_of_a_message_passes_the_checks() {
    for bones in [
        "up = (0.0, 0.8, 0.6), forward = +Z",
        "up = (0.6, 0.0, 0.8), left = (0.8, 0.6, 0.0)",
        "up = (0.0, 0.9701425, 0.2425356), forward = +Z, left = (0.9701425, 0.2425356, 0.0)",
    ] {
        for hand in ["left", "right"] {
            let item = format!(
                "#[aim(axes({bones}), handedness = {hand})] struct Thug {{ #[joint(heading = free, rate = 1rad)] eye: Joint }}"
            );
            let errors = from_derive_input(&parse(&item)).expect_err(bones);
            let help = errors
                .iter()
                .find(|error| error.message().contains("perpendicular"))
                .expect("not perpendicular")
                .help();
            let nearest = help.strip_prefix("the nearest orthonormal frame is ").expect("a frame");
            frame(&format!("axes({nearest}), handedness = {hand}"));
        }
    }
}

#[test]
fn the_effector_keeps_its_forward_and_makes_up_perpendicular() {
    let effector = |forward: &str| {
        let item = format!(
            "#[aim(axes(up = +X, forward = +Y), effector(forward = {forward}))] struct Thug {{ #[joint(heading = free, rate = 1rad)] eye: Joint }}"
        );
        declared(&item).spec.effector.frame
    };
    let x = [1.0, 0.0, 0.0];
    let y = [0.0, 1.0, 0.0];
    let z = [0.0, 0.0, 1.0];
    let minus = |v: [f64; 3]| v.map(|x| 0.0 - x);
    assert_eq!(effector("-Y"), Frame { up: x, forward: minus(y), left: minus(z) });
    assert_eq!(effector("+Z"), Frame { up: x, forward: z, left: minus(y) });
    // Looking straight up, up points to the old back; looking straight down, to the old forward.
    assert_eq!(effector("+X"), Frame { up: minus(y), forward: x, left: z });
    assert_eq!(effector("-X"), Frame { up: y, forward: minus(x), left: z });
    let tilted = effector("(0.6, 0.8, 0.0)");
    assert_eq!(tilted.forward, [0.6, 0.8, 0.0]);
    assert!((tilted.up[0] - 0.8).abs() < 1e-12 && (tilted.up[1] + 0.6).abs() < 1e-12 && tilted.left == z);
}

#[test]
fn joints_with_axes_of_their_own_need_none_of_the_rig() {
    declared("struct Thug { #[joint(heading = free, rate = 1rad, axes(up = +X, forward = +Y))] eye: Joint }");
}

#[test]
fn the_facade_path_may_be_a_string_as_in_serde() {
    for (path, wanted) in [
        ("\"::other::aim\"", ":: other :: aim"),
        ("crate", "crate"),
        ("crate::aim", "crate :: aim"),
        ("self::x", "self :: x"),
    ] {
        let item = format!(
            "#[aim(axes(up = +X, forward = +Y), crate = {path})] struct Thug {{ #[joint(heading = free, rate = 1rad)] eye: Joint }}"
        );
        assert_eq!(declared(&item).krate.map(|path| path.to_string()).as_deref(), Some(wanted), "{path}");
    }
}

/// Puts every token, and every literal with its sign, into invisible groups, twice, as nested macros do.
fn hide(tokens: TokenStream) -> TokenStream {
    tokens
        .into_iter()
        .map(|token| {
            let inner = match token {
                TokenTree::Group(group) => Group::new(group.delimiter(), hide(group.stream())).into(),
                TokenTree::Literal(_) => {
                    let once: TokenTree = Group::new(Delimiter::None, token.into()).into();
                    Group::new(Delimiter::None, once.into()).into()
                }
                other => other,
            };
            TokenStream::from(inner)
        })
        .collect()
}

#[test]
fn invisible_groups_are_ignored() {
    let item = "#[aim(axes(up = (0.0, 1.0, 0.0), forward = +Z), effector(origin = (0.0, -1.0, 2)))]
        struct Thug { #[joint(heading = -35deg..=35deg, rate = 450deg, bone = [\"a\", \"b\"])] eye: Joint }";
    let mut input: DeriveInput = parse(item);
    let plain = from_derive_input(&input).expect("no error").spec;
    let mut hidden = 0;
    let syn::Data::Struct(data) = &mut input.data else { panic!("a struct") };
    let fields = data.fields.iter_mut().flat_map(|field| field.attrs.iter_mut());
    for attribute in input.attrs.iter_mut().chain(fields) {
        if let syn::Meta::List(list) = &mut attribute.meta {
            list.tokens = hide(core::mem::take(&mut list.tokens));
            hidden += 1;
        }
    }
    assert_eq!(hidden, 2);
    assert_eq!(from_derive_input(&input).expect("no error").spec, plain);
}
