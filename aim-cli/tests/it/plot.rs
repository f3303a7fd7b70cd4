//! `aim plot`: the drawing, read back through its own axis labels, shows the aim function by the tests' own forward
//! kinematics, the declared ranges, and the paths that the solvers take.

use crate::common::plot::{Picture, Plot, classed, lines, number, text, worst_of_fit};
use crate::common::rig::{Joint, conventions, joints};
use crate::common::{Place, different_rigs, in_full};
use aim_character::InterpretedRig;
use aim_runtime::glam::{Affine3A, DQuat, DVec3};
use aim_runtime::{Ascent, DynAim, Pose, Settings, Solver};
use roxmltree::Document;

/// Unusual rigs with one joint each.
const ODD: [(&str, &str); 5] = [
    (
        "a left-handed rig that turns all round",
        r#"name = "Odd"
        handedness = "left"
        axes = { up = "+Z", forward = "+Y", left = "+X" }
        [[joint]]
        name = "odd"
        heading = ["-180deg", "180deg"]
        pitch = ["-180deg", "180deg"]
        rate = "170deg""#,
    ),
    (
        "an eye in front of its joint",
        r#"name = "Odd"
        handedness = "right"
        axes = { up = "+Y", forward = "+Z", left = "+X" }
        effector = { origin = [0.2, 0.3, 0.4] }
        [[joint]]
        name = "odd"
        heading = ["-80deg", "70deg"]
        pitch = ["-40deg", "35deg"]
        rate = "170deg""#,
    ),
    (
        "axes that are no axes of coordinates",
        r#"name = "Odd"
        handedness = "right"
        axes = { up = [0.0, 0.8, 0.6], forward = [0.0, -0.6, 0.8] }
        [[joint]]
        name = "odd"
        heading = ["-50deg", "0deg"]
        pitch = ["-30deg", "0deg"]
        rate = "170deg""#,
    ),
    (
        "a mirrored bone",
        r#"name = "Odd"
        handedness = "right"
        [[joint]]
        name = "odd"
        axes = { up = "+X", forward = "+Y", left = "-Z" }
        mirrored = true
        heading = ["-30deg", "40deg"]
        pitch = ["-20deg", "25deg"]
        rate = "300deg""#,
    ),
    (
        "a heading without end",
        r#"name = "Odd"
        handedness = "right"
        axes = { up = "+Y", forward = "-Z", left = "-X" }
        [[joint]]
        name = "odd"
        heading = "free"
        pitch = ["-40deg", "35deg"]
        rate = "90deg""#,
    ),
];

/// A rig's joint with the effector and target that it is drawn for.
struct Aimed {
    joint: Joint,
    origin: DVec3,
    target: DVec3,
}

impl Aimed {
    /// Returns the aim by its definition: pitch turns forward towards up, then heading turns forward towards left.
    fn aim(&self, [heading, pitch]: [f64; 2]) -> f64 {
        let Joint { forward, up, left, .. } = self.joint;
        let about = |to: DVec3, angle: f64| DQuat::from_axis_angle(forward.cross(to).normalize(), angle.to_radians());
        let turn = about(left, heading) * about(up, pitch);
        (turn * forward).dot((self.target - turn * self.origin).normalize())
    }

    fn off(&self, angles: [f64; 2]) -> f64 {
        self.aim(angles).clamp(-1.0, 1.0).acos().to_degrees()
    }
}

/// Calls `look` for each joint of the bundled and the odd rigs, with a folder that holds `rig.toml`.
fn each_joint(mut look: impl FnMut(&Place, &str, &str, Joint, DVec3)) {
    let bundled = different_rigs().into_iter().map(|path| {
        let text = std::fs::read_to_string(&path).expect("a rig");
        (path.display().to_string(), text)
    });
    let odd = ODD.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned()));
    for (name, text) in bundled.chain(odd) {
        let place = Place::new();
        place.write("rig.toml", &text);
        let value: toml::Table = toml::from_str(&text).expect("TOML");
        let names: Vec<String> = value["joint"]
            .as_array()
            .expect("joints")
            .iter()
            .map(|joint| joint["name"].as_str().expect("a name").to_owned())
            .collect();
        let origin = value.get("effector").and_then(|effector| effector.get("origin")).map_or(DVec3::ZERO, |origin| {
            let numbers = origin.as_array().expect("numbers").iter();
            DVec3::from_slice(&numbers.map(|x| x.as_float().expect("a number")).collect::<Vec<f64>>())
        });
        for (index, (joint_name, joint)) in names.iter().zip(joints(&text)).enumerate() {
            let origin = if index == 0 { origin } else { DVec3::ZERO };
            look(&place, &format!("{name}, {joint_name}"), joint_name, joint, origin);
        }
    }
}

#[test]
fn contours_are_where_the_aim_function_has_their_value() {
    let (mut plots, mut points, mut worst) = (0, 0, 0.0_f64);
    each_joint(|place, what, name, joint, origin| {
        if joint.heading.is_none() || joint.pitch.is_none() {
            return;
        }
        place.done(&format!("plot rig.toml --joint {name} -o plot.svg"));
        let svg = String::from_utf8(place.read("plot.svg")).expect("UTF-8");
        let document = Document::parse(&svg).expect("XML");
        let plot = Plot::read(&document);
        let aimed = Aimed { joint, origin, target: plot.target() };
        let scale: Vec<f64> = classed(document.root(), "scale")[0]
            .children()
            .filter(|node| node.has_tag_name("text") && node.attribute("fill").is_some())
            .skip(1)
            .map(|node| number(&text(node)))
            .collect();
        let range = scale[0] - scale[scale.len() - 1];
        let contours = plot.drawn("contour");
        assert_eq!(contours.len() + 2, scale.len(), "{what}: a contour between each two bands");
        let [left, top, right, bottom] = plot.panel;
        for contour in contours {
            let title = text(contour);
            let (off, aim) = title.split_once("° off target, aim ").expect("a title");
            assert!((number(off).to_radians().cos() - number(aim)).abs() < 1e-4, "{title}");
            for line in lines(contour) {
                // Points of the polyline, and the midpoints between them.
                let middles = line.windows(2).map(|pair| [0, 1].map(|k| 0.5 * (pair[0][k] + pair[1][k])));
                let inside = |at: &[f64; 2]| (left..=right).contains(&at[0]) && (top..=bottom).contains(&at[1]);
                for at in line.iter().copied().chain(middles).filter(inside) {
                    let error = (aimed.aim(plot.angles(at)) - number(aim)).abs() / range;
                    assert!(error < 0.01, "{what}: {title}, {:?} is {error} of the range off", plot.angles(at));
                    (worst, points) = (worst.max(error), points + 1);
                }
            }
        }
        plots += 1;
    });
    println!("{plots} plots, {points} points of contours, at worst {worst:.1e} of the range off");
    let [least, fewest] = if in_full() { [24, 50_000] } else { [10, 20_000] };
    assert!(plots >= least && points > fewest, "{plots} plots, {points} points");
}

#[test]
#[cfg_attr(not(feature = "pictures"), ignore = "needs the feature pictures")]
fn bands_have_the_colours_of_the_scale_in_png_too() {
    each_joint(|place, what, name, joint, origin| {
        if joint.heading.is_none() || joint.pitch.is_none() {
            return;
        }
        // One unit of the drawing is one pixel.
        for ending in ["svg", "png"] {
            place.done(&format!("plot rig.toml --joint {name} -o plot.{ending}"));
        }
        let svg = String::from_utf8(place.read("plot.svg")).expect("UTF-8");
        let document = Document::parse(&svg).expect("XML");
        let plot = Plot::read(&document);
        let aimed = Aimed { joint, origin, target: plot.target() };
        let scale = classed(document.root(), "scale")[0];
        let colours: Vec<&str> =
            scale.children().filter_map(|node| node.attribute("fill")?.strip_prefix('#')).collect();
        let colours: Vec<[u8; 3]> = colours
            .iter()
            .filter(|colour| **colour != "55606b")
            .map(|colour| [0, 2, 4].map(|k| u8::from_str_radix(&colour[k..k + 2], 16).expect("a colour")))
            .collect();
        let edges: Vec<f64> = scale.children().filter_map(|node| text(node).strip_suffix('°').map(number)).collect();
        let picture = Picture::of(&place.read("plot.png"));
        let [left, top, right, bottom] = plot.panel;
        let (mut seen, mut all) = (0, 0);
        let mut y = top + 1.5;
        while y < bottom {
            let mut x = left + 1.5;
            while x < right {
                all += 1;
                if let Some(band) = colours.iter().position(|colour| *colour == picture.at(x, y)) {
                    let off = aimed.off(plot.angles([x, y]));
                    let [near, far] = [edges[band], edges[band] + (edges[1] - edges[0])];
                    let blur = 0.02 * (edges[1] - edges[0]) + 0.3;
                    assert!((near - blur..far + blur).contains(&off), "{what}: {off}° in {near}…{far}°, at {x},{y}");
                    seen += 1;
                }
                x += 7.0;
            }
            y += 7.0;
        }
        assert!(seen * 10 > all * 8, "{what}: {seen} of {all} pixels have a band's colour");
    });
}

#[test]
fn the_box_is_at_the_declared_ranges() {
    each_joint(|place, what, name, joint, _| {
        let (Some([left, right]), Some([down, up])) = (joint.heading, joint.pitch) else { return };
        place.done(&format!("plot rig.toml --joint {name} -o plot.svg"));
        let svg = String::from_utf8(place.read("plot.svg")).expect("UTF-8");
        let document = Document::parse(&svg).expect("XML");
        let plot = Plot::read(&document);
        let corners: Vec<[f64; 2]> =
            plot.drawn("range").into_iter().flat_map(lines).flatten().map(|at| plot.angles(at)).collect();
        let fold = |k: usize, f: fn(f64, f64) -> f64, start: f64| corners.iter().map(|at| at[k]).fold(start, f);
        let found = [0, 1].map(|k| [fold(k, f64::min, f64::INFINITY), fold(k, f64::max, f64::NEG_INFINITY)]);
        // A free heading extends over the whole panel.
        let sides = if left.is_finite() { [left, right] } else { [-180.0, 180.0] };
        for (found, declared) in found.iter().flatten().zip(sides.iter().chain(&[down, up])) {
            assert!((found - declared).abs() < 0.02, "{what}: {found:?} instead of {declared}");
        }
    });
}

#[test]
fn a_narrowing_range_is_drawn_as_it_narrows() {
    let place = Place::new();
    place.write("rig.toml", &ODD[3].1.replace("rate =", "pitch_taper = 0.4\nrate ="));
    place.done("plot rig.toml -o plot.svg");
    let svg = String::from_utf8(place.read("plot.svg")).expect("UTF-8");
    let document = Document::parse(&svg).expect("XML");
    let plot = Plot::read(&document);
    let corners: Vec<[f64; 2]> = lines(plot.drawn("range")[0]).concat().into_iter().map(|at| plot.angles(at)).collect();
    for expected in [[-30.0, -12.0], [0.0, -20.0], [40.0, -12.0], [40.0, 15.0], [0.0, 25.0], [-30.0, 15.0]] {
        let nearest = corners.iter().map(|at| (at[0] - expected[0]).hypot(at[1] - expected[1])).fold(9.0, f64::min);
        assert!(nearest < 0.02, "{expected:?} is no corner of {corners:?}");
    }
}

/// Returns the angles of a solver from rest, frame by frame, degrees.
fn way(toml: &str, target: DVec3, solver: Solver) -> Vec<[f64; 2]> {
    let spec = aim_codegen::declare::from_toml("rig.toml", toml).expect("a rig");
    let mut rig = DynAim::new(InterpretedRig::new(&spec));
    let pose = Pose::new(vec![Affine3A::IDENTITY]);
    let settings = Settings::default().with_solver(solver).with_ascent(Ascent::paper());
    let frame = |_| {
        rig.aim(&pose, target.as_vec3(), 1.0 / 60.0, &settings);
        let joint = rig.state.joints[0];
        [joint.heading(), joint.pitch()].map(|angle| f64::from(angle).to_degrees())
    };
    std::iter::once([0.0; 2]).chain((0..1200).map(frame)).collect()
}

#[test]
fn ways_begin_at_rest_and_end_where_the_solvers_do() {
    let out_of_reach = [DVec3::new(1.5, 1.0, 0.7), DVec3::new(-0.4, -1.0, -2.0), DVec3::new(0.3, -0.2, 1.0)];
    for (what, toml) in ODD {
        let targets = [None].into_iter().chain(out_of_reach.into_iter().map(Some));
        let targets = targets.take(if in_full() { 4 } else { 2 });
        for target in targets {
            let place = Place::new();
            place.write("rig.toml", toml);
            let target = target.map_or_else(String::new, |at| format!(" --target={},{},{}", at.x, at.y, at.z));
            place.done(&format!("plot rig.toml -o plot.svg{target}"));
            let svg = String::from_utf8(place.read("plot.svg")).expect("UTF-8");
            let document = Document::parse(&svg).expect("XML");
            let plot = Plot::read(&document);
            let [start] = plot.drawn("start")[..] else { panic!("{what}: one start") };
            assert!(plot.place(start).iter().all(|angle| angle.abs() < 0.02), "{what}: {:?}", plot.place(start));
            let ends = plot.drawn("end");
            for (end, solver) in ends.iter().zip([Solver::Ascent, Solver::Exact]) {
                let way = way(toml, plot.target(), solver);
                let (found, expected) = (plot.place(*end), way[way.len() - 1]);
                // The target is printed with three decimals.
                assert!(
                    (0..2).all(|k| (found[k] - expected[k]).abs() < 0.1),
                    "{what}{target}, {solver:?}: {found:?} instead of {expected:?}"
                );
            }
            assert_eq!(ends.len(), 2, "{what}");
        }
    }
}

#[test]
fn ways_come_through_every_frame_and_break_where_a_heading_wraps() {
    let place = Place::new();
    let toml = ODD[4].1;
    place.write("rig.toml", toml);
    // Behind, so that the path to it is long.
    place.done("plot rig.toml --target=0.5,0.1,1 -o plot.svg");
    let svg = String::from_utf8(place.read("plot.svg")).expect("UTF-8");
    let document = Document::parse(&svg).expect("XML");
    let plot = Plot::read(&document);
    let [ascent, exact] = [0, 1].map(|k| {
        let drawn = plot.drawn("way");
        lines(drawn[k]).concat().into_iter().map(|at| plot.angles(at)).collect::<Vec<_>>()
    });
    for (drawn, solver) in [(ascent, Solver::Ascent), (exact, Solver::Exact)] {
        let frames = way(toml, plot.target(), solver);
        assert!(drawn.len() > 60, "{}", drawn.len());
        for (found, expected) in drawn.iter().zip(&frames) {
            assert!((0..2).all(|k| (found[k] - expected[k]).abs() < 0.02), "{solver:?}: {found:?}, not {expected:?}");
        }
        let longest = drawn.windows(2).map(|pair| (pair[0][0] - pair[1][0]).abs()).fold(0.0, f64::max);
        assert!(longest <= 1.5 + 0.02, "{solver:?}: {longest}° in a frame at 90°/s");
    }
}

#[test]
fn a_slow_joint_is_followed_for_twenty_seconds() {
    let place = Place::new();
    place.write("rig.toml", &ODD[3].1.replace("300deg", "0.01deg"));
    place.done("plot rig.toml -o plot.svg");
    let svg = String::from_utf8(place.read("plot.svg")).expect("UTF-8");
    let document = Document::parse(&svg).expect("XML");
    assert!(text(document.root()).contains("exact solver: 1200 frames"));
}

#[test]
fn every_convention_has_the_same_picture() {
    let place = Place::new();
    let numbers = |up: [f32; 3], forward: [f32; 3], left: [f32; 3]| {
        let mirrored = {
            let [u, f, l] = [up, forward, left].map(|axis| DVec3::from_array(axis.map(f64::from)));
            if u.cross(f).dot(l) < 0.0 { "mirrored = true" } else { "" }
        };
        let rig = format!(
            "name = \"Rig\"\nhandedness = \"right\"\n[[joint]]\nname = \"eye\"\nrole = \"eye\"\naxes = {{ up = {up:?}, forward = \
             {forward:?}, left = {left:?} }}\n{mirrored}\nheading = [\"-35deg\", \"35deg\"]\npitch = [\"-25deg\", \
             \"20deg\"]\nrate = \"450deg\"\n"
        );
        place.write("rig.toml", &rig);
        place.done("plot rig.toml -o plot.svg --size 500x360");
        let svg = String::from_utf8(place.read("plot.svg")).expect("UTF-8");
        let document = Document::parse(&svg).expect("XML");
        let plot = Plot::read(&document);
        ["contour", "way", "range"].map(|class| plot.drawn(class).into_iter().flat_map(lines).collect::<Vec<_>>())
    };
    let sampled = conventions().into_iter().step_by(if in_full() { 1 } else { 5 });
    let mut all = sampled.map(|[up, forward, left]| numbers(up, forward, left));
    let first = all.next().expect("a convention");
    assert!(first[0].concat().len() > 300);
    for other in all {
        for (one, other) in first.iter().flatten().zip(other.iter().flatten()) {
            assert_eq!(one.len(), other.len());
            for (a, b) in one.iter().zip(other) {
                assert!((a[0] - b[0]).abs() < 0.03 && (a[1] - b[1]).abs() < 0.03, "{a:?} {b:?}");
            }
        }
    }
}

#[test]
fn a_hinge_has_a_curve() {
    let mut curves = 0;
    each_joint(|place, what, name, joint, origin| {
        if joint.heading.is_some() && joint.pitch.is_some() {
            return;
        }
        place.done(&format!("plot rig.toml --joint {name} -o plot.svg"));
        let svg = String::from_utf8(place.read("plot.svg")).expect("UTF-8");
        let document = Document::parse(&svg).expect("XML");
        let plot = Plot::read(&document);
        let turns = joint.heading.is_some();
        let aimed = Aimed { joint, origin, target: plot.target() };
        let [curve] = classed(document.root(), "curve")[..] else { panic!("{what}: one curve") };
        let points = lines(curve).concat();
        assert!(points.len() > 300, "{what}");
        for at in points {
            let [angle, aim] = plot.angles(at);
            let expected = aimed.aim(if turns { [angle, 0.0] } else { [0.0, angle] });
            assert!((aim - expected).abs() < 2e-3, "{what}: {aim} at {angle}° instead of {expected}");
        }
        place.refused(&format!("plot rig.toml --joint {name} --surface -o plot.svg"), &["rig.toml", name, "--surface"]);
        curves += 1;
    });
    assert_eq!(curves, 2, "the turret's barrel and base");
}

#[test]
fn a_surface_is_the_aim_function_seen_at_an_angle() {
    each_joint(|place, what, name, joint, origin| {
        if joint.heading.is_none() || joint.pitch.is_none() {
            return;
        }
        place.done(&format!("plot rig.toml --joint {name} --surface -o plot.svg"));
        let svg = String::from_utf8(place.read("plot.svg")).expect("UTF-8");
        let document = Document::parse(&svg).expect("XML");
        let description = text(document.descendants().find(|node| node.has_tag_name("desc")).expect("one"));
        let span = |angle: &str| {
            let (from, to) =
                description.split_once(&format!("{angle} ")).expect(angle).1.split_once("° to ").expect("to");
            [number(from), number(to.split('°').next().expect("an end"))]
        };
        let spans = [span("over heading"), span("and pitch")];
        let about = description.split_once("at (").expect("a target").1.split(')').next().expect("a point");
        let target = DVec3::from_slice(&about.split(", ").map(number).collect::<Vec<f64>>());
        let aimed = Aimed { joint, origin, target };
        let meshes: Vec<Vec<[f64; 2]>> = classed(document.root(), "surface")[0]
            .children()
            .filter(|mesh| mesh.attribute("fill").is_some_and(|fill| fill != "none"))
            .flat_map(lines)
            .collect();
        let side = (1..).find(|side| side * side >= meshes.len()).expect("a square");
        assert_eq!(side * side, meshes.len(), "{what}");
        // Faces are drawn back to front. Try all four orders of rows and columns: one of them must match.
        let reversed = [false, true].into_iter().flat_map(|x| [[x, false], [x, true]]);
        let residual = reversed.map(|reversed| {
            let mut rows = Vec::new();
            for (k, mesh) in meshes.iter().enumerate().step_by(7) {
                let cell = [k % side, k / side];
                let corner = [0, 1].map(|axis| {
                    let cell = if reversed[axis] { side - 1 - cell[axis] } else { cell[axis] };
                    let share =
                        f64::from(u32::try_from(cell).expect("few")) / f64::from(u32::try_from(side).expect("few"));
                    spans[axis][0] + share * (spans[axis][1] - spans[axis][0])
                });
                rows.push(([corner[0], corner[1], aimed.aim(corner), 1.0], mesh[0]));
            }
            (0..2).map(|k| worst_of_fit(rows.iter().map(|(row, at)| (*row, at[k])).collect())).fold(0.0, f64::max)
        });
        let residual = residual.fold(f64::INFINITY, f64::min);
        assert!(residual < 0.1, "{what}: points are up to {residual} beside an affine picture of the aim function");
    });
}

const SIZES: [(&str, &str); 4] =
    [("1000x720", ""), ("640x360", " --surface"), ("400x900", ""), ("321x320", " --surface")];

/// Plots twice, to `one` and `two` with this ending, and asserts that both files are equal.
fn plot_twice(place: &Place, size: &str, more: &str, ending: &str) {
    place.done(&format!("plot m.toml --size {size}{more} -o one.{ending}"));
    place.done(&format!("plot m.toml --size {size}{more} -o two.{ending}"));
    assert_eq!(place.read(&format!("one.{ending}")), place.read(&format!("two.{ending}")), "{size}");
}

#[test]
fn drawings_have_the_asked_size_and_are_the_same_every_time() {
    let place = Place::with_mannequin();
    for (size, more) in SIZES {
        let (width, height) = size.split_once('x').expect("a size");
        plot_twice(&place, size, more, "svg");
        let svg = String::from_utf8(place.read("one.svg")).expect("UTF-8");
        let document = Document::parse(&svg).expect("XML");
        let root = document.root_element();
        assert_eq!((root.attribute("width"), root.attribute("height")), (Some(width), Some(height)));
        assert_eq!(root.default_namespace(), Some("http://www.w3.org/2000/svg"));
        for outside in ["href", "<script", "<style", "NaN", "inf,", "@"] {
            assert!(!svg.contains(outside), "{outside}");
        }
    }
}

#[test]
#[cfg_attr(not(feature = "pictures"), ignore = "needs the feature pictures")]
fn pictures_have_the_asked_size_and_are_the_same_every_time() {
    let place = Place::with_mannequin();
    for (size, more) in SIZES {
        let (width, height) = size.split_once('x').expect("a size");
        plot_twice(&place, size, more, "png");
        let picture = Picture::of(&place.read("one.png"));
        assert_eq!((picture.width.to_string(), picture.height.to_string()), (width.to_owned(), height.to_owned()));
    }
    // Text is drawn with built-in fonts, so none needs to be installed.
    place.done("plot m.toml -o one.png");
    let picture = Picture::of(&place.read("one.png"));
    let dark = (74..500).flat_map(|x| (20..40).map(move |y| (f64::from(x), f64::from(y))));
    let dark = dark.filter(|(x, y)| picture.at(*x, *y).iter().all(|part| *part < 80)).count();
    assert!(dark > 400, "{dark} dark pixels in the title");
}

#[test]
#[cfg_attr(feature = "pictures", ignore = "needs aim without the feature pictures")]
fn without_the_feature_png_is_refused() {
    let place = Place::with_mannequin();
    place.refused("plot m.toml -o one.png", &["pictures", ".svg"]);
}

#[test]
fn what_cannot_be_drawn_is_told() {
    let place = Place::with_mannequin();
    place.refused("plot m.toml -o plot.svg --joint nose", &["m.toml", "nose", "left_eye, neck and spine3"]);
    place.refused("plot m.toml -o plot.svg --target 0,0,0", &["m.toml", "--target", "cannot aim at"]);
    for target in ["NaN,0,0", "inf,0,0", "1,2", "1e300,0,0", "a,b,c"] {
        place.refused(&format!("plot m.toml -o plot.svg --target {target}"), &["--target", "three numbers"]);
    }
    for name in ["plot.jpg", "plot", "plot.svg.gz", ".svg"] {
        place.refused(&format!("plot m.toml -o {name}"), &[name, ".svg", ".png"]);
    }
    for size in ["0x0", "1000", "99999x720", "-5x5", "1000x720x3", "x"] {
        place.refused(&format!("plot m.toml -o plot.svg --size={size}"), &["--size", "WIDTHxHEIGHT"]);
    }
    place.refused("plot m.toml -o gone/plot.svg", &["gone"]);
    place.refused("plot gone.toml -o plot.svg", &["gone.toml"]);
    place.refused("plot m.glb -o plot.svg", &["m.glb"]);
    place.refused("plot m.toml", &["--output"]);
    place.write("rig.svg", &place.read("m.toml"));
    place.refused("plot rig.svg -o rig.svg", &["rig.svg", "it is the rig"]);
}
