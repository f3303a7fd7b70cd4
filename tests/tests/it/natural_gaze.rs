//! The natural gaze compared with measurements of people, and the figure of `docs/natural-gaze.md`.
//!
//! `AIM_BLESS=1 cargo test -p aim-tests --test it natural_gaze` rewrites the figure. The test prints the numbers that
//! the page quotes; `-- --nocapture` shows them.

use std::fmt::Write;

use aim_benches::solver::natural::{HZ, Headings, SHIFTS_DEG, people, shift};
use aim_benches::solver::row::markdown;

#[test]
fn a_gaze_shift_is_of_the_size_that_is_measured_of_people() {
    let rows = people();
    println!("{}", markdown("shift", &rows));
    let judged: Vec<_> = rows.into_iter().filter(|row| row.held.is_some()).collect();
    assert_eq!(judged.len(), 10);
    for row in judged {
        assert_eq!(row.held, Some(true), "{}: {} is not in {}", row.what, row.measured, row.must);
    }
}

/// A curve of the figure: its name, a colour that is legible on white and on black, its dashes, and the plotted
/// heading.
type Curve = (&'static str, &'static str, &'static str, fn(&Headings) -> f32);

const CURVES: [Curve; 4] = [
    ("gaze", "#2f86c8", "none", |frame| frame.gaze),
    ("head in space", "#d55e00", "none", |frame| frame.head),
    ("chest", "#009e73", "2 3", |frame| frame.chest),
    ("eye in head", "#c264a0", "7 3", |frame| frame.eye),
];
const GREY: &str = "#808080";

/// Returns the figure as SVG: the headings over time of all shifts, side by side.
fn figure() -> String {
    const SIZE: [f32; 2] = [220.0, 200.0];
    const TOP: f32 = 58.0;
    let mut svg = String::new();
    let text = |svg: &mut String, x: f32, y: f32, anchor: &str, fill: &str, words: &str| {
        writeln!(svg, r#"<text x="{x:.1}" y="{y:.1}" text-anchor="{anchor}" fill="{fill}">{words}</text>"#)
            .expect("a string is written to");
    };
    let line = |svg: &mut String, stroke: &str, width: f32, dashes: &str, points: &[[f32; 2]]| {
        let points: Vec<String> = points.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        let points = points.join(" ");
        writeln!(
            svg,
            r#"<polyline stroke="{stroke}" stroke-width="{width:.1}" stroke-dasharray="{dashes}" points="{points}"/>"#
        )
        .expect("a string is written to");
    };
    svg.push_str("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 820 300\" font-family=\"sans-serif\" ");
    svg.push_str("font-size=\"12\" fill=\"none\">\n");
    for (number, (name, colour, dashes, _)) in CURVES.into_iter().enumerate() {
        let x = 48.0 + 130.0 * number as f32;
        line(&mut svg, colour, 2.0, dashes, &[[x, 16.0], [x + 24.0, 16.0]]);
        text(&mut svg, x + 30.0, 20.0, "start", GREY, name);
    }
    for (panel, degrees) in SHIFTS_DEG.into_iter().enumerate() {
        let left = 48.0 + 264.0 * panel as f32;
        let at = |t: f32, heading: f32| [left + SIZE[0] * t, TOP + SIZE[1] * (1.0 - heading / (1.05 * degrees))];
        text(&mut svg, left, TOP - 12.0, "start", GREY, &format!("a target {degrees}° to the side"));
        let steps = if degrees < 20.0 { 2_u8 } else { 3 };
        for tick in 0..=steps {
            let heading = degrees * f32::from(tick) / f32::from(steps);
            let [x, y] = at(0.0, heading);
            line(&mut svg, GREY, if tick == 0 { 1.0 } else { 0.3 }, "none", &[[x, y], at(1.0, heading)]);
            text(&mut svg, x - 6.0, y + 4.0, "end", GREY, &format!("{heading}°"));
        }
        for (t, words) in [(0.0, "0"), (0.5, "0.5"), (1.0, "1 s")] {
            let [x, y] = at(t, 0.0);
            line(&mut svg, GREY, 1.0, "none", &[[x, y], [x, y + 4.0]]);
            text(&mut svg, x, y + 18.0, "middle", GREY, words);
        }
        let frames = shift(degrees);
        for (_, colour, dashes, heading) in CURVES {
            let place = |(frame, headings)| at(frame as f32 / HZ, heading(headings));
            let points: Vec<[f32; 2]> = frames.iter().enumerate().step_by(4).map(place).collect();
            line(&mut svg, colour, 2.0, dashes, &points);
        }
    }
    svg.push_str("</svg>\n");
    svg
}

#[test]
fn the_figure_shows_what_the_solver_does() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/natural-gaze.svg");
    let svg = figure();
    if std::env::var_os("AIM_BLESS").is_some_and(|update| update == "1") {
        std::fs::write(path, &svg).expect("the figure is written");
    }
    let stored = std::fs::read_to_string(path).unwrap_or_default().replace("\r\n", "\n");
    assert!(
        stored == svg,
        "docs/natural-gaze.svg is not what the solver does.\n\
         If it is meant to be so: AIM_BLESS=1 cargo test -p aim-tests --test it natural_gaze"
    );
}

#[test]
fn the_table_of_bakes_has_a_row_for_everything_that_is_measured() {
    let model = aim_character::mannequin(|_| aim_character::PAPER_AXES).expect("constants");
    let document = aim_gltf::Document::from_bytes(&model).expect("a sound model");
    let rows = aim_benches::bakes::looks("mannequin", &document).expect("a rig is proposed");
    assert_eq!(rows.len(), aim_character::Criterion::ALL.len());
    for row in &rows {
        assert_eq!(row.held, Some(true), "{}: {}, must be {}", row.what, row.measured, row.must);
    }
    // A criterion's worst value comes from the most demanding bake.
    assert!(rows[0].measured.contains("orbit") || rows[0].measured.contains("150°"), "{}", rows[0].measured);
    // A row that does not hold is marked.
    let broken = aim_benches::solver::row::Row { held: Some(false), ..rows[0].clone() };
    assert!(markdown("bakes", &[broken]).contains("**broken**"));
}
