//! Settings of one joint. Every combination that can be set is a valid declaration.

use aim_codegen::{AngleRange, JointSpec, LimitsFrom};
use eframe::egui::{self, Ui};

use super::widgets::{button, check, named, row};

/// Least magnitude of the larger end of a range, degrees. Smaller ranges cannot be declared.
const NARROWEST: f64 = 1.0;
/// Range of an angle that is no longer free and has no declared range, degrees to either side.
const LIMITED: f64 = 90.0;
/// Range of rates, degrees per second. The declared rate may be higher.
const RATES: std::ops::RangeInclusive<f64> = 1.0..=2000.0;
/// Range of accelerations, degrees per second squared. The declared acceleration may be higher.
const ACCELERATIONS: std::ops::RangeInclusive<f64> = 10.0..=20_000.0;
const STIFFNESSES: std::ops::RangeInclusive<f64> = 0.01..=100.0;

pub(super) fn show(ui: &mut Ui, joint: &mut JointSpec, declared: &JointSpec) {
    let name = joint.name.clone();
    let header = egui::CollapsingHeader::new(&name).id_salt(("joint", &name));
    let shown = header.show(ui, |ui| settings(ui, joint, declared));
    named(shown.header_response, &format!("joint {name}"))
        .on_hover_text(format!("The bone {}.", joint.bones.join(" or ")));
}

fn settings(ui: &mut Ui, joint: &mut JointSpec, declared: &JointSpec) {
    let name = joint.name.clone();
    let from = if joint.limits_from == LimitsFrom::BindPose { "the bind pose" } else { "the animation" };
    if let Some(heading) = &mut joint.heading {
        row(ui, "Heading", &format!("How far it turns to the left, from {from}, degrees."), |ui| {
            ends(ui, heading, &format!("{name} heading"));
            let mut free = *heading == AngleRange::Free;
            let can = (joint.pitch_taper.is_none(), "The declared narrowing needs a heading with ends.");
            let hover = "Turns without end, as a turret does.";
            if check(ui, &mut free, "Free", &format!("{name} heading free"), can, hover).changed() {
                *heading = match (free, declared.heading) {
                    (true, _) => AngleRange::Free,
                    (false, Some(between @ AngleRange::Between(..))) => between,
                    (false, _) => AngleRange::Between(-LIMITED.to_radians(), LIMITED.to_radians()),
                };
            }
        });
    }
    if let Some(pitch) = &mut joint.pitch {
        row(ui, "Pitch", &format!("How far it nods upward, from {from}, degrees."), |ui| {
            ends(ui, pitch, &format!("{name} pitch"));
        });
    }
    row(ui, "Rate", "The largest speed of each angle.", |ui| {
        degrees(ui, &mut joint.rate, RATES, "°/s", &format!("{name} rate"));
    });
    if let Some(acceleration) = &mut joint.acceleration {
        row(ui, "Acceleration", "The largest change of speed of each angle.", |ui| {
            degrees(ui, acceleration, ACCELERATIONS, "°/s²", &format!("{name} acceleration"));
        });
    }
    row(ui, "Stiffness", "What a turn of this joint costs: the more, the more reluctant it is.", |ui| {
        let value = egui::DragValue::new(&mut joint.stiffness).speed(0.02).range(STIFFNESSES).max_decimals(2);
        named(ui.add(value.clamp_existing_to_range(false)), &format!("{name} stiffness"));
    });
    row(ui, "", "", |ui| {
        let reset = button(ui, "↺ As declared", &format!("{name} as declared"), "What the rig declares of this joint.");
        if reset.clicked() {
            joint.clone_from(declared);
        }
    });
}

/// Shows the two ends of a range: the lower one at most 0, the upper one at least 0, and not both 0.
fn ends(ui: &mut Ui, range: &mut AngleRange, name: &str) {
    let AngleRange::Between(lo, hi) = range else { return };
    let shown = [lo.to_degrees(), hi.to_degrees()];
    // If one end is nearer to 0 than `NARROWEST`, the other one must be at least that far.
    let least = |other: f64| if other.abs() >= NARROWEST { 0.0 } else { NARROWEST };
    degrees(ui, lo, -180.0..=-least(shown[1]), "°", &format!("{name} from"));
    ui.label("…");
    degrees(ui, hi, least(shown[0])..=180.0, "°", &format!("{name} to"));
}

/// Shows an angle in degrees. An angle that is not edited keeps its exact value in radians.
fn degrees(ui: &mut Ui, angle: &mut f64, range: std::ops::RangeInclusive<f64>, unit: &str, name: &str) {
    let mut degrees = angle.to_degrees();
    let speed = (degrees.abs() * 0.01).max(0.2);
    let value = egui::DragValue::new(&mut degrees).speed(speed).range(range).max_decimals(1).suffix(unit);
    if named(ui.add(value.clamp_existing_to_range(false)), name).changed() {
        *angle = degrees.to_radians();
    }
}
