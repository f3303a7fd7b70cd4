//! `aim check FILE --rig` and `aim inspect --html`: report what is wrong with a declaration, in words and in a drawing.

use crate::common::rig::{conventions, for_mannequin};
use crate::common::{Place, Ran, in_full};
use scraper::{Html, Selector};

/// Returns the page written with these arguments; it must be valid HTML without scripts or addresses.
fn page(place: &Place, arguments: &str) -> Html {
    place.done(arguments);
    let text = String::from_utf8(place.read("o.html")).expect("UTF-8");
    let page = Html::parse_document(&text);
    assert!(page.errors.is_empty(), "{:?}", page.errors);
    for word in ["<script", "http:", "https:", "src="] {
        assert!(!text.contains(word), "the page has {word}");
    }
    page
}

fn count(page: &Html, selector: &str) -> usize {
    page.select(&Selector::parse(selector).expect("a selector")).count()
}

#[test]
fn of_48_declarations_the_right_one_passes_and_47_are_told_where_they_are_wrong() {
    let conventions = conventions();
    for truth in [5, 20, 46].into_iter().take(if in_full() { 3 } else { 1 }) {
        let place = Place::new();
        place.write("m.glb", &aim_character::mannequin(|_| conventions[truth]).expect("a frame"));
        for (number, axes) in conventions.iter().enumerate() {
            // Only the neck's declaration differs.
            let rig = for_mannequin(|bone| if bone == "neck" { *axes } else { conventions[truth] });
            place.write("r.toml", &rig);
            let Ran { code, stdout, stderr } = place.aim("check m.glb --rig r.toml");
            assert_eq!(code, i32::from(number != truth), "{number} for {truth}: {stdout}{stderr}");
            if number == truth {
                assert!(
                    stdout.contains("r.toml matches m.glb") && stdout.contains("neck: axes as declared"),
                    "{stdout}"
                );
            } else {
                let wrong = (0..3).filter(|at| axes[*at] != conventions[truth][*at]).count();
                let told = stderr.lines().filter(|line| line.trim_start().starts_with("neck: declared ")).count();
                assert_eq!((told, stdout.as_str()), (wrong, ""), "{number} for {truth}: {stderr}");
                assert!(!stderr.contains("left_eye:") && !stderr.contains("spine3:"), "{stderr}");
            }
        }
    }
}

#[test]
fn the_sentence_says_where_it_points_and_what_is_right() {
    let place = Place::with_mannequin();
    let rig = String::from_utf8(place.read("m.toml")).expect("UTF-8");
    let axes = "axes = { up = \"+X\", forward = \"+Y\", left = \"+Z\" }";
    assert!(rig.contains(axes), "{rig}");
    place.write("bad.toml", &rig.replace(axes, "axes = { up = \"+Y\", forward = \"-X\", left = \"+Z\" }"));
    let ran = place.aim("check m.glb --rig bad.toml");
    assert_eq!(ran.code, 1);
    for sentence in [
        "bad.toml does not match m.glb",
        "neck: declared forward -X points down in the bind pose; measured forward is +Y (0° off)",
        "neck: declared up +Y points forward in the bind pose; measured up is +X (0° off)",
        "aim inspect m.glb --rig bad.toml --html",
    ] {
        assert!(ran.stderr.contains(sentence), "no {sentence:?} in {}", ran.stderr);
    }
}

#[test]
fn bones_that_are_missing_exchanged_mirrored_or_far_away_are_told() {
    let place = Place::with_mannequin();
    let rig = String::from_utf8(place.read("m.toml")).expect("UTF-8");
    let mirrored = aim_character::mannequin(|bone| {
        let [up, forward, left] = aim_character::PAPER_AXES;
        if bone == "neck" { [up, forward, left.map(|c| -c)] } else { [up, forward, left] }
    });
    place.write("mirrored.glb", &mirrored.expect("a frame"));
    let far = rig.replace("handedness", "effector = { origin = [160.0, 0.0, 0.0] }\nhandedness");
    for (model, rig, words) in [
        (
            "m.glb",
            rig.replace("bone = \"neck\"", "bone = \"nek\""),
            "neck: no node named \"nek\"; the nearest names are neck",
        ),
        (
            "m.glb",
            rig.replace("bone = \"left_eye\"", "bone = \"right_eye\"").replace("other_eye = \"right_eye\"\n", ""),
            "left_eye: \"right_eye\" is the eye on the other side",
        ),
        ("m.glb", rig.replace("bone = \"spine3\"", "bone = \"left_foot\""), "is not below"),
        (
            "mirrored.glb",
            rig.clone(),
            "neck: \"neck\" is mirrored in the file but declared not mirrored; set mirrored = true",
        ),
        ("m.glb", far, "effector: its origin is 91"),
    ] {
        place.write("r.toml", &rig);
        let ran = place.aim(&format!("check {model} --rig r.toml"));
        assert!(ran.code == 1 && ran.stderr.contains(words), "no {words:?} in {ran:?}");
    }
    place.refused("check m.glb --rig gone.toml", &["gone.toml"]);
    place.refused("check gone.glb --rig m.toml", &["gone.glb"]);
    place.refused("check m.glb --rig m.toml --samples 3", &["--samples"]);
}

#[test]
fn the_drawing_marks_what_is_wrong_and_nothing_else() {
    let place = Place::with_mannequin();
    let rig = String::from_utf8(place.read("m.toml")).expect("UTF-8");
    let right = page(&place, "inspect m.glb --html o.html --rig m.toml");
    assert_eq!((count(&right, ".views svg"), count(&right, ".dashed"), count(&right, ".wrong")), (4, 0, 0));
    // Three joints, their axes and a compass, in four views.
    assert_eq!(count(&right, ".axis-up:not(.expected)"), 4 * 4);
    assert_eq!(count(&right, ".gaze"), 4);
    let turned = "axes = { up = \"+X\", forward = \"+Z\", left = \"-Y\" }";
    place.write("bad.toml", &rig.replace("axes = { up = \"+X\", forward = \"+Y\", left = \"+Z\" }", turned));
    let wrong = page(&place, "inspect m.glb --html o.html --rig bad.toml");
    assert_eq!((count(&wrong, ".dashed"), count(&wrong, ".expected")), (2 * 3 * 4, 2 * 3 * 4));
    assert_eq!(count(&wrong, "ul.wrong li"), 6);
    let proposed = page(&place, "inspect m.glb --html o.html");
    assert_eq!((count(&proposed, ".gaze"), count(&proposed, ".dashed")), (4, 0));
    // A model without a chain is drawn without one.
    place.write("thing.gltf", r#"{"asset":{"version":"2.0"},"nodes":[{"name":"<b>thing"}]}"#);
    assert_eq!(count(&page(&place, "inspect thing.gltf --html o.html"), ".gaze"), 0);
    place.refused("inspect m.glb --rig m.toml", &["--html"]);
    assert_eq!(page(&place, "inspect m.glb --html o.html").html(), proposed.html(), "the same again");
}
