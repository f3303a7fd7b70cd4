//! Tests of the whole page: it parses, escapes hostile names, and works for nearly empty input.

use std::sync::LazyLock;

use aim_character::{
    Baked, ChainNodes, InterpretedRig, Measurement, PAPER_AXES, Plan, Plausibility, Settle, bake, mannequin,
};
use aim_codegen::{AngleRange, RigSpec};
use aim_gltf::Document;
use aim_runtime::glam::{DAffine3, DVec3};
use aim_runtime::{DynAim, Settings, Solver};
use scraper::{Html, Selector};

use super::scene::{Eye, GazeView, IN_FRONT, Scene};
use super::{BakePage, page};
use crate::bake_report::{BakeReport, JointReport, Reported};
use crate::effector::Effector;

const RIG: &str = include_str!("../../../rigs/mannequin.toml");

/// A bone's name that looks like markup.
const HOSTILE: &str = "<script>alert(\"1\")</script>&'";
/// A file of bones without a surface, one of them with the hostile name.
const BONES: &str = r#"{"asset":{"version":"2.0"},"nodes":[
    {"name":"hips","children":[1],"translation":[0,1,0]},
    {"name":"neck","children":[2],"translation":[0,0.4,0]},
    {"name":"<script>alert(\"1\")</script>&'","translation":[0,0.2,0.1]}]}"#;
const BONES_RIG: &str = r#"
    name = "Bones"
    handedness = "right"
    axes = { up = "+Y", forward = "+Z", left = "+X" }
    [[joint]]
    name = "eye"
    role = "eye"
    bone = "<script>alert(\"1\")</script>&'"
    heading = ["-30deg", "30deg"]
    rate = "90deg"
    [[joint]]
    name = "neck"
    role = "neck"
    heading = "free"
    pitch = ["-40deg", "30deg"]
    rate = "60deg"
"#;

struct Case {
    spec: RigSpec,
    document: Document,
    chain: ChainNodes,
    measurement: Measurement,
    baked: Baked,
    report: BakeReport,
}

impl Case {
    fn new(rig: &str, model: &[u8], seconds: f32) -> Self {
        let spec = aim_codegen::declare::from_toml("rig.toml", rig).expect("a sound rig");
        let document = Document::from_bytes(model).expect("a sound model");
        let bones = spec.joints.iter().map(|joint| joint.bones.as_slice());
        let chain = ChainNodes::find(document.skeleton(), bones, spec.joints[0].other_eye.as_deref()).expect("bones");
        let measurement = Measurement::of(&document);
        let plan = Plan {
            document: &document,
            clip: document.clips().first(),
            measurement: &measurement,
            chain: &chain,
            both_eyes: false,
            seconds,
            fps: 30.0,
            settle: Settle::Animation,
            looped: false,
            // The exact solver moves joints at their rates and to their limits.
            settings: Settings::default().with_solver(Solver::Exact),
            target_node: None,
        };
        let target = |t: f32, _: &[_]| DVec3::new(2.0 * f64::from(t).sin(), 1.7, 2.0 * f64::from(t).cos());
        let baked = bake(&mut DynAim::new(InterpretedRig::new(&spec)), &plan, target, |_, _| {}).expect("a clip");
        let written = document.with_clips(std::slice::from_ref(&baked.clip)).expect("a sound clip");
        let written = Document::from_bytes(&written).expect("what was written");
        let rig = InterpretedRig::new(&spec);
        let plausibility = Plausibility::measure(&rig, &plan, &baked, &written).expect("the clip is there");
        let report = BakeReport::new(Reported {
            reduction: None,
            spec: &spec,
            effector: Effector::of(&spec, 0),
            solver: "ascent",
            fps: 30.0,
            weight: 1.0,
            over: "its clip",
            replaces: false,
            skeleton: document.skeleton(),
            chain: &chain,
            held: &[],
            baked: &baked,
            warnings: vec![HOSTILE.to_owned()],
            plausibility,
        });
        Self { spec, document, chain, measurement, baked, report }
    }

    fn mannequin(seconds: f32) -> Self {
        Self::new(RIG, &mannequin(|_| PAPER_AXES).expect("constants"), seconds)
    }

    /// Keeps only the first `frames` frames.
    fn cut(mut self, frames: usize) -> Self {
        self.baked.frames.truncate(frames);
        self.report.frames.truncate(frames);
        self
    }

    fn subject(&self) -> BakePage<'_> {
        let Self { spec, report, document, measurement, baked, .. } = self;
        BakePage { spec, report, document, measurement, source: document.clips().first(), baked }
    }

    fn page(&self) -> String {
        page(&self.subject())
    }
}

/// A bake of the mannequin and its page, shared by two tests because drawing it takes seconds.
static WHOLE: LazyLock<(Case, String)> = LazyLock::new(|| {
    let case = Case::mannequin(6.3);
    let page = case.page();
    (case, page)
});

/// Parses a page. Panics on markup errors, references to other resources, and numbers that are not finite.
#[track_caller]
fn parsed(page: &str) -> Html {
    let html = Html::parse_document(page);
    assert!(html.errors.is_empty(), "{:?}", html.errors);
    // Base64 data may contain any of these strings by chance.
    let text: String = page
        .split("base64,")
        .enumerate()
        .map(|(k, part)| part.split_at(if k > 0 { part.find('"').unwrap_or(0) } else { 0 }).1)
        .collect();
    for outside in ["http:", "https:", "<script", "<link", "@import", "NaN", "inf "] {
        assert!(!text.contains(outside), "{outside}");
    }
    html
}

fn count(html: &Html, selector: &str) -> usize {
    html.select(&Selector::parse(selector).expect("a selector")).count()
}

#[test]
fn the_mannequins_page_is_whole() {
    let (case, text) = &*WHOLE;
    let html = parsed(text);
    assert_eq!(count(&html, "head > title"), 1);
    let events = count(&html, ".film .event");
    assert_eq!(
        count(&html, ".film li image"),
        24 + events,
        "eight drawings of the skin from before and from the side, and of the eyes"
    );
    assert!(
        (3..=6).contains(&events) && text.contains("fastest head motion") && text.contains("first out of reach"),
        "{events}"
    );
    let charts = 8 + 2 * case.spec.joints.len();
    assert_eq!(
        count(&html, ".chart"),
        charts + 1,
        "error, two directions and a close-up, roll, four of looks, two for each joint"
    );
    assert!(text.contains("eye in head") && text.contains("Close-up"), "how eye and head share the gaze");
    for title in ["Head relative to chest", "Vertical gaze error", "Horizontal gaze error", "Head acceleration"] {
        // Once in the table and once above a chart.
        assert_eq!(text.matches(&format!(">{title}<")).count(), 2, "{title}");
    }
    assert_eq!(count(&html, ".looks tr"), 8);
    assert_eq!(count(&html, "path.clip"), 4, "azimuth, its close-up and elevation, and the head relative to the chest");
    assert_eq!(count(&html, "p.warning"), 1);
    assert!(!text.contains(" × 10") && !text.contains("0 in 0.5 s, at"), "numbers without noise");
    assert_eq!(count(&html, ".rig tbody tr"), case.spec.joints.len());
    for joint in &case.spec.joints {
        assert!(text.contains(&format!("{}: angles and ranges", joint.name)), "{}", joint.name);
    }
    let drawings = count(&html, "svg");
    assert_eq!(count(&html, "svg[aria-label], svg[aria-hidden]"), drawings, "every drawing is named or an ornament");
    assert!(text.len() < 1_500_000, "{} bytes", text.len());
    assert_eq!(*text, case.page(), "the same bake makes the same page");
}

#[test]
fn limits_are_shaded_just_where_they_bind() {
    let (case, text) = &*WHOLE;
    let html = parsed(text);
    let charts: Vec<_> = html.select(&Selector::parse(".chart").expect("a selector")).collect();
    let [title, bound] = [".title", ".bound title"].map(|css| Selector::parse(css).expect("a selector"));
    let time = |text: &str| text.parse::<f64>().expect("a time");
    let shaded = |name: String| -> Vec<(f64, f64)> {
        let named = |chart: &&scraper::ElementRef<'_>| {
            chart.select(&title).next().is_some_and(|title| title.text().collect::<String>() == name)
        };
        let chart = charts.iter().find(named).unwrap_or_else(|| panic!("no chart {name}"));
        let stretch = |at: scraper::ElementRef<'_>| {
            let text: String = at.text().collect();
            let (from, to) = text.strip_prefix("at a limit, ")?.strip_suffix(" s")?.split_once('–')?;
            Some((time(from), time(to)))
        };
        chart.select(&bound).map(|at| stretch(at).expect("from, to")).collect()
    };
    // Times are printed in hundredths of a second; frames are at least three hundredths apart.
    let is_in =
        |stretches: &[(f64, f64)], t: f64| stretches.iter().any(|(from, to)| (from - 0.006..to - 0.006).contains(&t));
    let frames = &case.report.frames;
    let (mut limits, mut rates) = (0, 0);
    for (k, joint) in case.spec.joints.iter().enumerate() {
        let bone = &frames[0].joints[k].bone.name;
        let at_limit = shaded(format!("{bone}: angles and ranges"));
        let at_rate = shaded(format!("{bone}: speed and rate"));
        for (before, frame) in frames.iter().zip(&frames[1..]) {
            let t = f64::from(frame.t);
            let at = &frame.joints[k];
            let off_ends =
                [(joint.heading, at.heading_deg), (joint.pitch, at.pitch_deg)].into_iter().flat_map(|(range, at)| {
                    let Some(AngleRange::Between(lo, hi)) = range else { panic!("the mannequin's ranges have ends") };
                    [lo, hi].map(|end| (at - end.to_degrees()).abs())
                });
            let binds = off_ends.fold(f64::INFINITY, f64::min) < 0.01;
            assert!(binds || !at.at_limit, "{bone} at {t}");
            assert_eq!(is_in(&at_limit, t), binds, "{bone} at {t}");
            limits += usize::from(binds);
            let speed = |of: fn(&JointReport) -> f64| {
                (of(&frame.joints[k]) - of(&before.joints[k])).abs() / f64::from(frame.t - before.t)
            };
            let share = speed(|at| at.heading_deg).max(speed(|at| at.pitch_deg)) / joint.rate.to_degrees();
            if !(0.998..0.9995).contains(&share) {
                assert_eq!(is_in(&at_rate, t), share > 0.999, "{bone} at {t}: {share} of its rate");
                rates += usize::from(share > 0.999);
            }
        }
    }
    assert!(limits > 20 && rates > 3, "{limits} frames at a limit, {rates} at a rate");
}

#[test]
fn the_camera_of_the_eyes_turns_with_the_head() {
    let (case, _) = &*WHOLE;
    let Effector { joint, ray } = Effector::of(&case.spec, 0);
    let eye = Eye { node: case.chain.joints[joint], centre: ray.origin.into(), forward: ray.frame.forward.into() };
    let skeleton = case.document.skeleton();
    let head = skeleton.parents()[eye.node].expect("a head");
    // The place of the eye in the drawing, and of a point in front of the head.
    let places = |view| {
        let frames = &case.baked.frames;
        let scene = Scene::of_gaze(&case.subject(), &case.chain, eye, view, frames.iter());
        let bind = case.measurement.bind_world[head].inverse();
        let ahead = bind.transform_vector3(case.measurement.forward) * 0.1;
        let at = |world: &[DAffine3]| {
            let place = world[eye.node].transform_point3(eye.centre);
            [place, place + world[head].transform_vector3(ahead)].map(|point| scene.camera.project(point, world))
        };
        frames.iter().map(|frame| at(&frame.world)).collect::<Vec<_>>()
    };
    let moved = |places: Vec<[DVec3; 2]>| {
        let moves = places.iter().map(|place| (0..2).map(|k| place[k].distance(places[0][k])).fold(0.0, f64::max));
        moves.fold(0.0, f64::max)
    };
    assert!(moved(places(GazeView::Eyes)) < 0.1);
    assert!(moved(places(GazeView::Head(IN_FRONT))) > 10.0);
}

#[test]
fn bones_without_skin_or_clip_are_lines_and_hostile_names_are_text() {
    let case = Case::new(BONES_RIG, BONES.as_bytes(), 2.0);
    assert_eq!(case.spec.joints[0].bones, [HOSTILE]);
    let text = case.page();
    let html = parsed(&text);
    assert!(count(&html, ".film line.bone") >= 8, "bones are drawn");
    assert_eq!((count(&html, "image"), count(&html, "script")), (0, 0));
    let rows: Vec<String> =
        html.select(&Selector::parse(".rig tbody th").expect("a selector")).map(|cell| cell.text().collect()).collect();
    assert!(rows[0].starts_with(HOSTILE) && rows[1].starts_with("neck"), "{rows:?}");
}

#[test]
fn one_frame_and_none_make_a_page() {
    for frames in [1, 0] {
        let text = Case::mannequin(0.5).cut(frames).page();
        let html = parsed(&text);
        assert_eq!(count(&html, ".film li"), 3 * frames, "from before, from the side, and of the eyes");
        assert_eq!(count(&html, ".rig tbody tr"), 3);
    }
}

#[test]
fn a_target_without_a_direction_is_told() {
    let mut case = Case::mannequin(0.5);
    for (frame, told) in case.baked.frames.iter_mut().zip(&mut case.report.frames) {
        frame.target = DVec3::NAN;
        (told.status, told.error_deg) = ("degenerate", 90.0);
    }
    let text = case.page();
    assert!(text.contains("no direction"));
    parsed(&text);
}

#[test]
fn an_hour_is_hardly_larger_than_a_second() {
    let mut case = Case::mannequin(0.5);
    let frame = case.baked.frames[0].clone();
    let times = (0_u16..20_000).map(|k| f32::from(k) * 0.18);
    case.baked.frames = times.map(|t| aim_character::AimedFrame { t, ..frame.clone() }).collect();
    case.report = BakeReport::new(Reported {
        reduction: None,
        spec: &case.spec,
        effector: Effector::of(&case.spec, 0),
        solver: "ascent",
        fps: 30.0,
        weight: 1.0,
        over: "its clip",
        replaces: false,
        skeleton: case.document.skeleton(),
        chain: &case.chain,
        held: &[],
        baked: &case.baked,
        warnings: Vec::new(),
        plausibility: case.report.plausibility.clone(),
    });
    let size = case.page().len();
    assert!(size < 1_500_000, "{size} bytes");
}
