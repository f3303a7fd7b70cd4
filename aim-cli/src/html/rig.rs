//! The table of the declared rig, and of the angles and speeds that the bake used.

use aim_codegen::{AngleRange, JointSpec, LimitsFrom, RigSpec};
use maud::{Markup, html};

use super::charts::speeds;
use crate::bake_report::{BakeReport, JointReport};
use crate::words::{axis, fixed, shown, trimmed};

/// Returns the table of joints.
pub(super) fn section(spec: &RigSpec, report: &BakeReport) -> Markup {
    let times: Vec<f64> = report.frames.iter().map(|frame| frame.t.into()).collect();
    html! {
        section.rig-table {
            h2 { "The rig" }
            p {
                "Joints from the effector inward. Heading turns a bone's forward axis to its left, pitch turns it up; both are "
                "added to the animation. The columns “used” show what this bake used."
            }
            div.scroll {
                table.rig {
                    thead {
                        tr {
                            th scope="col" rowspan="2" { "Joint" }
                            th scope="col" rowspan="2" { "Up, forward, left" }
                            th scope="colgroup" colspan="2" { "Heading" }
                            th scope="colgroup" colspan="2" { "Pitch" }
                            th scope="colgroup" colspan="2" { "Speed, °/s" }
                            th scope="col" rowspan="2" { "Stiffness" }
                            th scope="col" rowspan="2" { "At a limit" }
                        }
                        tr {
                            @for _ in 0..2 {
                                th scope="col" { "range" }
                                th scope="col" { "used" }
                            }
                            th scope="col" { "rate" }
                            th scope="col" { "used" }
                        }
                    }
                    tbody { @for (k, joint) in spec.joints.iter().enumerate() { (row(joint, report, k, &times)) } }
                }
            }
        }
    }
}

fn row(joint: &JointSpec, report: &BakeReport, index: usize, times: &[f64]) -> Markup {
    let told: Vec<&JointReport> = report.frames.iter().filter_map(|frame| frame.joints.get(index)).collect();
    let bone = told.first().map_or(joint.bones[0].as_str(), |joint| joint.bone.name.as_str());
    let heading: Vec<f64> = told.iter().map(|joint| joint.heading_deg).collect();
    let pitch: Vec<f64> = told.iter().map(|joint| joint.pitch_deg).collect();
    let parts = [(joint.heading, &heading), (joint.pitch, &pitch)];
    let speeds = parts.into_iter().filter_map(|(range, values)| Some(speeds(times, values, range?))).flatten();
    let fastest = speeds.filter(|speed| speed.is_finite()).fold(0.0, f64::max);
    let limited = told.iter().filter(|joint| joint.at_limit).count();
    let frame = &joint.frame;
    html! {
        tr {
            th scope="row" {
                (bone)
                @if bone != joint.name { " " small { "declared as " (joint.name) } }
            }
            td.axes { @for one in [frame.up, frame.forward, frame.left] { span { (axis(one)) } " " } }
            (angle(joint.heading, joint.limits_from, &heading))
            (angle(joint.pitch, joint.limits_from, &pitch))
            td { (trimmed(joint.rate.to_degrees(), 1)) }
            td { (fixed(fastest, 1)) }
            td { (trimmed(joint.stiffness, 3)) }
            td { (limited) " of " (told.len()) }
        }
    }
}

fn angle(range: Option<AngleRange>, limits_from: LimitsFrom, values: &[f64]) -> Markup {
    let span = |low: f64, high: f64| format!("{}° … {}°", shown(low, 1), shown(high, 1));
    let (low, high) = values.iter().fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(*v), high.max(*v)));
    html! {
        td {
            @match range {
                None => "–",
                Some(AngleRange::Free) => "free",
                Some(AngleRange::Between(low, high)) => {
                    (span(low.to_degrees(), high.to_degrees()))
                    @if limits_from == LimitsFrom::BindPose { " " small { "from the bind pose" } }
                }
            }
        }
        td { @if range.is_some() && low <= high { (span(low, high)) } @else { "–" } }
    }
}
