//! A derive and a TOML file with the same declaration give the same code, except for the struct item, which only TOML
//! needs.

use std::fmt::Write;
use std::path::Path;

use aim_codegen::{
    AngleRange, Budget, Budgets, EffectorSpec, Frame, JointSpec, LimitsFrom, NaturalSpec, RigSpec, declare,
};
use aim_tests::rigs;
use aim_tests::scale::sampled;
use quote::ToTokens;
use syn::{File, Item};

/// The notation of a declaration.
#[derive(Clone, Copy, PartialEq)]
enum Notation {
    Derive,
    Toml,
}

impl Notation {
    fn quoted(self, text: &str) -> String {
        if self == Self::Toml { format!("\"{text}\"") } else { text.to_owned() }
    }

    fn vector(self, [x, y, z]: [f64; 3]) -> String {
        if self == Self::Toml { format!("[{x:?}, {y:?}, {z:?}]") } else { format!("({x:?}, {y:?}, {z:?})") }
    }

    /// Writes up and forward; left follows from the handedness.
    fn bones(self, frame: &Frame) -> String {
        let axes = format!("up = {}, forward = {}", self.vector(frame.up), self.vector(frame.forward));
        if self == Self::Toml { format!("axes = {{ {axes} }}") } else { format!("axes({axes})") }
    }

    fn effector(self, effector: &EffectorSpec) -> String {
        let settings =
            format!("forward = {}, origin = {}", self.vector(effector.frame.forward), self.vector(effector.origin));
        if self == Self::Toml { format!("effector = {{ {settings} }}") } else { format!("effector({settings})") }
    }

    fn natural(self, natural: &NaturalSpec) -> String {
        let angle = |value: f64| self.quoted(&format!("{value:?}rad"));
        let settings = format!(
            "eyes_only = {}, head_share = {:?}, engage = {}, release = {}, delay = {:?}",
            angle(natural.eyes_only),
            natural.head_share,
            angle(natural.engage),
            angle(natural.release),
            natural.delay
        );
        if self == Self::Toml { format!("natural = {{ {settings} }}") } else { format!("natural({settings})") }
    }

    fn region(self, budgets: &Budgets) -> String {
        let angle = |value: f64| self.quoted(&format!("{value:?}rad"));
        let budget = |part: &str, budget: &Budget| {
            let [heading, pitch] =
                [budget.heading, budget.pitch].map(|[lo, hi]| self.range(AngleRange::Between(lo, hi)));
            let settings = format!(
                "heading = {heading}, pitch = {pitch}, rate = {}, acceleration = {}",
                angle(budget.rate),
                angle(budget.acceleration)
            );
            if self == Self::Toml { format!("{part} = {{ {settings} }}") } else { format!("{part}({settings})") }
        };
        let settings = format!("{}, {}", budget("head", &budgets.head), budget("chest", &budgets.chest));
        if self == Self::Toml { format!("region = {{ {settings} }}") } else { format!("region({settings})") }
    }

    /// Returns the settings of the rig.
    fn rig(self, rig: &RigSpec) -> Vec<String> {
        let mut settings = vec![self.bones(&rig.joints[0].frame), self.effector(&rig.effector)];
        settings.extend(rig.natural.as_ref().map(|natural| self.natural(natural)));
        settings.extend(rig.region.as_ref().map(|budgets| self.region(budgets)));
        settings
    }

    fn range(self, range: AngleRange) -> String {
        match range {
            AngleRange::Free => self.quoted("free"),
            AngleRange::Between(lo, hi) if self == Self::Toml => format!("[\"{lo:?}rad\", \"{hi:?}rad\"]"),
            AngleRange::Between(lo, hi) => format!("{lo:?}rad..={hi:?}rad"),
        }
    }

    fn joint(self, joint: &JointSpec) -> Vec<String> {
        let angle = |value: f64| self.quoted(&format!("{value:?}rad"));
        let mut settings = vec![
            self.bones(&joint.frame),
            format!("mirrored = {}", joint.frame.handedness() < 0.0),
            format!("bone = {:?}", joint.bones),
            format!("role = {}", self.quoted(joint.role.as_str())),
            format!("rate = {}", angle(joint.rate)),
            format!("stiffness = {:?}", joint.stiffness),
        ];
        settings.extend(joint.heading.map(|range| format!("heading = {}", self.range(range))));
        settings.extend(joint.pitch.map(|range| format!("pitch = {}", self.range(range))));
        settings.extend(joint.acceleration.map(|value| format!("acceleration = {}", angle(value))));
        settings.extend(joint.upright.map(|value| format!("upright = {value:?}")));
        settings.extend(joint.pitch_taper.map(|value| format!("pitch_taper = {value:?}")));
        settings.extend(joint.other_eye.as_ref().map(|node| format!("other_eye = {node:?}")));
        settings.extend(joint.hold.as_ref().map(|names| format!("hold = {names:?}")));
        settings.extend(
            (joint.limits_from == LimitsFrom::BindPose).then(|| format!("limits_from = {}", self.quoted("bind_pose"))),
        );
        settings
    }

    /// Writes the whole declaration.
    fn write(self, rig: &RigSpec) -> String {
        let mut text = String::new();
        match self {
            Self::Derive => {
                let settings = self.rig(rig).join(", ");
                let _ = write!(text, "#[derive(AimRig)] #[aim({settings})] struct {} {{", rig.name);
                for joint in &rig.joints {
                    let _ = write!(text, "#[joint({})] {}: Joint,", self.joint(joint).join(", "), joint.name);
                }
                text += "}";
            }
            Self::Toml => {
                let _ = writeln!(text, "name = {:?}\n{}", rig.name, self.rig(rig).join("\n"));
                for joint in &rig.joints {
                    let _ = writeln!(text, "[[joint]]\nname = {:?}\n{}", joint.name, self.joint(joint).join("\n"));
                }
            }
        }
        text
    }
}

fn derived(declaration: &str) -> Vec<Item> {
    let tokens = declaration.parse().expect("a declaration is made of tokens");
    syn::parse2::<File>(aim_codegen::derive(tokens)).expect("an expansion is made of items").items
}

fn assert_same_code(rig: &RigSpec, toml: &str) {
    let spec = declare::from_toml("rig.toml", toml).unwrap_or_else(|errors| panic!("{}", errors.render()));
    let tokens = aim_codegen::rust_of(&spec, quote::quote!(::aim));
    let from_toml = syn::parse2::<File>(tokens).expect("emitted code is made of items").items;
    let from_derive = derived(&Notation::Derive.write(rig).replacen("struct ", "pub struct ", 1));
    let Some((Item::Struct(item), implementation)) = from_toml.split_first() else {
        panic!("the code of {} begins with its struct", rig.name)
    };
    let fields: Vec<String> = item.fields.iter().filter_map(|f| Some(f.ident.as_ref()?.to_string())).collect();
    assert_eq!(item.ident, rig.name);
    assert_eq!(fields, rig.joints.iter().map(|joint| joint.name.as_str()).collect::<Vec<_>>());
    let text = |items: &[Item]| items.iter().map(|item| item.to_token_stream().to_string()).collect::<Vec<_>>();
    assert_eq!(text(&from_derive), text(implementation), "{}", rig.name);
}

#[test]
fn of_the_bundled_rigs() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../rigs");
    let mut rigs = 0;
    for entry in std::fs::read_dir(folder).expect("the bundled rigs have a folder") {
        let path = entry.expect("the folder can be listed").path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let toml = std::fs::read_to_string(&path).expect("a rig is readable text");
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let rig = declare::from_toml(&name, &toml).unwrap_or_else(|errors| panic!("{}", errors.render()));
        assert_same_code(&rig, &toml);
        rigs += 1;
    }
    assert!(rigs >= 6, "{rigs} bundled rigs were found");
}

#[test]
fn of_every_convention() {
    for mut rig in sampled(rigs::rigs()) {
        // Left is derived from up and forward, so neither notation can state a third vector that differs by rounding.
        let eye = &mut rig.joints[0];
        eye.acceleration = Some(20.0);
        eye.other_eye = Some("other eye".to_owned());
        eye.hold = Some(vec!["eyelash".to_owned()]);
        eye.upright = Some(0.25);
        eye.limits_from = LimitsFrom::BindPose;
        eye.pitch_taper = (eye.angles() == 2).then_some(0.5);
        rig.region = Some(Budgets { chest: Budgets::BIRD.head, ..Budgets::TOON });
        rig.natural = Some(NaturalSpec { eyes_only: 0.3, delay: 0.05, ..NaturalSpec::default() });
        assert_same_code(&rig, &Notation::Toml.write(&rig));
    }
}
