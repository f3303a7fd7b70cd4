//! The table of the rig, and of the angles and speeds that the bake used.

use aim_codegen::{AngleRange, JointSpec, LimitsFrom};
use maud::{Markup, html};

use super::charts::{ranges, speeds};
use super::subject::BakePage;
use crate::bake_report::JointReport;
use crate::words::{axis, fixed, shown, trimmed};

/// Returns the table of joints.
pub(super) fn section(subject: &BakePage<'_>) -> Markup {
    let BakePage { spec, report, .. } = *subject;
    let moves = spec.joints.iter().any(|joint| joint.limits_from == LimitsFrom::BindPose);
    let times: Vec<f64> = report.frames.iter().map(|frame| frame.t.into()).collect();
    html! {
        section.rig-table {
            h2 { "The rig" }
            p {
                "Joints from the effector inward. Heading turns a bone's forward axis to its left, pitch turns it up; both are "
                "added to the animation. The columns “used” show what this bake used."
                @if moves {
                    " A range that counts from the bind pose moves with the animation; the table shows each of its ends in \
                     the frame in which the angle was largest in that direction, and below them the declared ends."
                }
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
                    tbody { @for (k, joint) in spec.joints.iter().enumerate() { (row(joint, subject, k, &times)) } }
                }
            }
        }
    }
}

fn row(joint: &JointSpec, subject: &BakePage<'_>, index: usize, times: &[f64]) -> Markup {
    let told: Vec<&JointReport> = subject.report.frames.iter().filter_map(|frame| frame.joints.get(index)).collect();
    let bone = told.first().map_or(joint.bones[0].as_str(), |joint| joint.bone.name.as_str());
    let heading: Vec<f64> = told.iter().map(|joint| joint.heading_deg).collect();
    let pitch: Vec<f64> = told.iter().map(|joint| joint.pitch_deg).collect();
    let parts = [(joint.heading, &heading), (joint.pitch, &pitch)];
    let speeds = parts.into_iter().filter_map(|(range, values)| Some(speeds(times, values, range?))).flatten();
    let fastest = speeds.filter(|speed| speed.is_finite()).fold(0.0, f64::max);
    let limited = told.iter().filter(|joint| joint.at_limit).count();
    let frame = &joint.frame;
    let [headings, pitches] = ranges(subject, index);
    html! {
        tr {
            th scope="row" {
                (bone)
                @if bone != joint.name { " " small { "declared as " (joint.name) } }
            }
            td.axes { @for one in [frame.up, frame.forward, frame.left] { span { (axis(one)) } " " } }
            (angle(joint.heading, moved(joint, &heading, &headings), &heading))
            (angle(joint.pitch, moved(joint, &pitch, &pitches), &pitch))
            td { (trimmed(joint.rate.to_degrees(), 1)) }
            td { (fixed(fastest, 1)) }
            td { (trimmed(joint.stiffness, 3)) }
            td { (limited) " of " (told.len()) }
        }
    }
}

/// Returns the ends of a range that counts from the bind pose: the lower one in the frame of the lowest value, the upper
/// one in that of the highest, degrees. `None` for other ranges.
fn moved(joint: &JointSpec, values: &[f64], [lower, upper]: &[Vec<f64>; 2]) -> Option<[f64; 2]> {
    let by_value = |a: &(&f64, &f64), b: &(&f64, &f64)| a.0.total_cmp(b.0);
    let low = values.iter().zip(lower).min_by(by_value)?;
    let high = values.iter().zip(upper).max_by(by_value)?;
    (joint.limits_from == LimitsFrom::BindPose).then_some([*low.1, *high.1])
}

/// Returns the cells of an angle: its range, or the `moved` one above the declared one, and the used part of it.
fn angle(range: Option<AngleRange>, moved: Option<[f64; 2]>, values: &[f64]) -> Markup {
    let span = |low: f64, high: f64| format!("{}° … {}°", shown(low, 1), shown(high, 1));
    let (low, high) = values.iter().fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(*v), high.max(*v)));
    html! {
        td {
            @match (range, moved) {
                (None, _) => "–",
                (Some(AngleRange::Free), _) => "free",
                (Some(AngleRange::Between(low, high)), None) => (span(low.to_degrees(), high.to_degrees())),
                (Some(AngleRange::Between(low, high)), Some([moved_low, moved_high])) => {
                    (span(moved_low, moved_high))
                    " " small { (span(low.to_degrees(), high.to_degrees())) " from the bind pose" }
                }
            }
        }
        td { @if range.is_some() && low <= high { (span(low, high)) } @else { "–" } }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_from_the_bind_pose_is_that_of_the_largest_use() {
        let toml = include_str!("../../../rigs/mannequin.toml");
        let neck =
            |toml: &str| aim_codegen::declare::from_toml("rig.toml", toml).expect("a sound rig").joints[1].clone();
        let (values, ends) = ([-40.6, 3.0, 40.7], [vec![-40.6, -39.0, -37.0], vec![38.0, 39.0, 41.2]]);
        assert_eq!(moved(&neck(toml), &values, &ends), None);
        let from_bind = neck(&toml.replace("rate = ", "limits_from = \"bind_pose\"\nrate = "));
        assert_eq!(moved(&from_bind, &values, &ends), Some([-40.6, 41.2]));
        assert_eq!(moved(&from_bind, &[], &[vec![], vec![]]), None);
        let shown = angle(from_bind.heading, Some([-40.6, 41.2]), &values).0;
        assert!(shown.contains("<td>−40.6° … 41.2° <small>−60° … 60° from the bind pose</small></td>"), "{shown}");
    }
}
