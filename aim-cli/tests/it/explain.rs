//! `aim explain`: the page is complete, and its formulas, counts and listings agree with the derivation and with the
//! other commands.

use std::path::Path;
use std::sync::OnceLock;

use crate::common::{Place, bundled_rig, bundled_rigs, in_full, installed};
use aim_codegen::objective::Scope;
use aim_codegen::{RigSpec, emit, kernels};
use scraper::{ElementRef, Html, Selector};

/// Rig with hinges, a free heading, a mirrored joint, a general frame, and names that contain markup.
const ODD: &str = r#"
    name = "Odd"
    handedness = "left"
    axes = { up = "+Y", forward = "+Z" }
    effector = { forward = [0.0, 0.6, 0.8], origin = [0.1, -0.2, 0.3] }
    [[joint]]
    name = "barrel"
    bone = ["<b>\"barrel\"</b>", "a & b_c #1 $x^2$ 50% {~\\}"]
    pitch = ["-10deg", "80deg"]
    rate = "90deg"
    [[joint]]
    name = "base"
    axes = { up = [0.0, 0.8, 0.6], forward = [0.0, -0.6, 0.8] }
    heading = "free"
    rate = "120deg"
    [[joint]]
    name = "mount"
    mirrored = true
    axes = { up = "+X", forward = "+Y", left = "+Z" }
    heading = ["-20deg", "20deg"]
    pitch = ["-20deg", "20deg"]
    rate = "20deg"
"#;

/// Simplest possible rig: one joint with one angle.
const HINGE: &str = r#"
    name = "Hinge"
    axes = { up = "+Z", forward = "+X" }
    [[joint]]
    name = "lid"
    pitch = ["0deg", "90deg"]
    rate = "90deg"
"#;

/// Bundled rig that represents all others by default.
const SHORT: &str = "turret";

/// Returns name and declaration of the odd rigs and of all bundled ones, by default only of [`SHORT`].
fn rigs() -> Vec<(String, String)> {
    let read = |path: &Path| {
        let name = path.file_stem().expect("a rig's file has a name").to_string_lossy().into_owned();
        (name, std::fs::read_to_string(path).expect("the rig is there"))
    };
    let mut rigs: Vec<_> = bundled_rigs().iter().map(|path| read(path)).collect();
    assert!(rigs.iter().any(|(name, _)| name == SHORT), "{rigs:?}");
    rigs.retain(|(name, _)| in_full() || name == SHORT);
    rigs.extend([("odd".to_owned(), ODD.to_owned()), ("hinge".to_owned(), HINGE.to_owned())]);
    rigs
}

/// Rig with its page.
struct Page {
    name: String,
    rig: String,
    page: String,
    found: Found,
}

/// Facts extracted from a page, once for all tests: a parsed page cannot be shared between threads.
struct Found {
    ids: Vec<String>,
    links: Vec<String>,
    /// Number of formulas.
    formulas: usize,
    /// `true` if a formula is empty.
    empty_formula: bool,
    /// `true` if every drawing has an accessible name.
    drawings_are_named: bool,
    /// `true` if all tables and displayed formulas scroll, by keyboard, too.
    wide_scrolls: bool,
    counts: Vec<Vec<String>>,
    captions: Vec<String>,
    headings: Vec<String>,
    /// Rows of all listings.
    code: Vec<Vec<String>>,
}

impl Found {
    fn on(page: &str) -> Self {
        let html = parsed(page);
        let attributes = |selector: &str, name: &str| {
            all(&html, selector).iter().filter_map(|one| one.value().attr(name).map(str::to_owned)).collect()
        };
        let texts = |selector: &str| all(&html, selector).iter().map(text).collect();
        let formulas = all(&html, "math");
        let scrolls = |wide: &ElementRef<'_>| {
            let parent = wide.parent().and_then(ElementRef::wrap).expect("it is in something");
            parent.value().attr("tabindex") == Some("0")
        };
        Self {
            ids: attributes("[id]", "id"),
            links: attributes("nav a", "href"),
            formulas: formulas.len(),
            empty_formula: formulas.iter().any(|formula| text(formula).trim().is_empty()),
            drawings_are_named: all(&html, "svg").iter().all(|svg| svg.value().attr("aria-label").is_some()),
            wide_scrolls: all(&html, "table, math[display=block]").iter().all(scrolls),
            counts: rows(all(&html, "#counts table").first().expect("the counts")),
            captions: texts("caption"),
            headings: texts("h3"),
            code: all(&html, "table.code").iter().flat_map(rows).collect(),
        }
    }
}

/// Returns the pages of all rigs, generated once; in full test runs including the long chain.
fn pages() -> &'static [Page] {
    static PAGES: OnceLock<Vec<Page>> = OnceLock::new();
    PAGES.get_or_init(|| {
        let place = Place::new();
        let mut rigs = rigs();
        rigs.extend(in_full().then(|| (LONG.to_owned(), long_chain())));
        let made = rigs.into_iter().map(|(name, rig)| {
            let page = page(&place, &rig);
            Page { found: Found::on(&page), page, name, rig }
        });
        made.collect()
    })
}

/// Name of a rig whose full derivation takes as long as all others together.
const LONG: &str = "long";

/// Returns all pages but that of the long chain.
fn short_pages() -> impl Iterator<Item = &'static Page> {
    pages().iter().filter(|page| page.name != LONG)
}

/// Returns the declaration of a chain of ten joints.
fn long_chain() -> String {
    let joint = |i: usize| {
        format!(
            "[[joint]]\nname = \"j{i}\"\nheading = [\"-20deg\", \"20deg\"]\npitch = [\"-9deg\", \"9deg\"]\nrate = \"9deg\"\n"
        )
    };
    let joints: String = (0..10).map(joint).collect();
    format!("name = \"Chain\"\naxes = {{ up = \"+X\", forward = \"+Y\", left = \"+Z\" }}\n{joints}")
}

fn spec(text: &str) -> RigSpec {
    aim_codegen::declare::from_toml("rig.toml", text).expect("a sound rig")
}

/// Returns the page of this declaration.
#[track_caller]
fn page(place: &Place, rig: &str) -> String {
    place.write("rig.toml", rig);
    place.done("explain rig.toml -o rig.html --samples 5");
    String::from_utf8(place.read("rig.html")).expect("a page is text")
}

/// Returns the page of the paper's own rig.
fn thug() -> &'static str {
    static PAGE: OnceLock<String> = OnceLock::new();
    PAGE.get_or_init(|| {
        let rig = std::fs::read_to_string(bundled_rig("thug")).expect("the thug is bundled");
        page(&Place::new(), &rig)
    })
}

/// Parses a page and panics on anything that a strict parser must repair.
#[track_caller]
fn parsed(page: &str) -> Html {
    let html = Html::parse_document(page);
    assert!(html.errors.is_empty(), "{:?}", html.errors);
    html
}

fn all<'a>(html: &'a Html, selector: &str) -> Vec<ElementRef<'a>> {
    html.select(&Selector::parse(selector).expect("a selector")).collect()
}

fn text(element: &ElementRef<'_>) -> String {
    element.text().collect()
}

/// Returns the cells of a table's rows.
fn rows(table: &ElementRef<'_>) -> Vec<Vec<String>> {
    let [row, cell] = ["tbody tr", "th, td"].map(|one| Selector::parse(one).expect("a selector"));
    table.select(&row).map(|row| row.select(&cell).map(|cell| text(&cell)).collect()).collect()
}

#[test]
fn every_page_is_whole_and_needs_nothing_else() {
    for Page { name, page, found, .. } in pages() {
        for outside in ["http:", "https:", "<script", "<link", "@import", "NaN", "<b>"] {
            assert!(!page.contains(outside), "{name}: {outside}");
        }
        assert_eq!(found.links, found.ids.iter().map(|id| format!("#{id}")).collect::<Vec<_>>(), "{name}");
        assert!(found.formulas > 100, "{name}");
        assert!(!found.empty_formula, "{name}: a formula is empty");
        assert!(found.drawings_are_named, "{name}");
        assert!(found.wide_scrolls, "{name}: what is wide scrolls, by keys, too");
        assert!(page.len() < 2_500_000, "{name}: {} bytes", page.len());
    }
}

#[test]
fn counts_are_those_of_aim_count_and_of_the_trace() {
    let place = Place::new();
    // By default only for rigs that are quickly derived.
    for Page { name, rig, found: on_page, .. } in short_pages().filter(|page| in_full() || page.name != "odd") {
        place.write("rig.toml", rig);
        place.write("counts.json", &place.done("count rig.toml --json").stdout);
        let counts = place.json("counts.json");
        let keys =
            ["aim", "aim_pitch", "aim_heading", "aim_gradient", "chain_value_gradient", "chain_residual_jacobian"];
        let expected: Vec<Vec<String>> = keys
            .iter()
            .map(|key| {
                let number = |kind: &str| counts[key][kind].to_string();
                ["total", "add", "mul", "div", "sqrt", "pow", "select"].map(number).to_vec()
            })
            .collect();
        let found: Vec<Vec<String>> = on_page.counts.iter().map(|row| row[1..].to_vec()).collect();
        assert_eq!(found, expected, "{name}");

        // Each kernel's derivation ends with the number of emitted operations, and its listing shows the same.
        let spec = spec(rig);
        let (captions, headings) = (&on_page.captions, &on_page.headings);
        let traced = place.done("generate rig.toml --trace").stdout;
        for kernel in kernels(&spec) {
            let derivation = kernel.statement(&spec).derivation();
            let function = emit::rust_kernels::function_name(&kernel);
            let is_counted = kernel.objective.scope == Scope::Chain || kernel.joints[0] == 0;
            let key = is_counted.then_some(kernel.objective.name);
            let count = derivation.program.count();
            assert!(captions.contains(&format!("{function}: {count}")), "{name} {function}: {captions:?}");
            if let Some(key) = key {
                assert_eq!(counts[key]["total"], count.total(), "{name} {key}");
            }
            for (place, step) in derivation.steps.iter().enumerate() {
                let (before, after) = (step.before.total(), step.after.total());
                let heading = format!("Step {}: {before} → {after} operations", place + 1);
                assert!(headings.contains(&heading), "{name}: {heading}");
                assert!(traced.contains(&format!("{after:>6}  ")), "{name}: {after}");
            }
        }
    }
}

#[test]
fn lines_are_those_of_aim_generate() {
    let place = Place::new();
    for Page { name, rig, found, .. } in short_pages() {
        place.write("rig.toml", rig);
        let words = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<String>>();
        let emitted = words(&place.done("generate rig.toml --lang rust").stdout).join(" ");
        let mut steps = 0;
        for row in found.code.iter().filter(|row| row[0].starts_with("let ")) {
            steps += 1;
            let line = words(&row[0]).join(" ");
            assert!(emitted.contains(&line), "{name}: {line}");
            assert!(row[1].starts_with('v'), "{name}: beside it stands its formula: {row:?}");
        }
        // The generic kernels come after those of the trait, which compute the same in `f32`.
        let (_, generic) = emitted.split_once("fn aim_gradient_0<").expect("the generic kernels are emitted");
        assert_eq!(steps, generic.matches("let __v").count(), "{name}: every line is there");
    }
}

#[test]
fn most_lines_say_what_they_compute() {
    let html = parsed(thug());
    let listing = *all(&html, "#code table").last().expect("the listing");
    let rows = rows(&listing);
    assert_eq!(rows.len(), 18 + 3, "eighteen lines and three results");
    let told = rows.iter().filter(|row| !row[2].is_empty()).count();
    assert!(told >= 19, "{told} of {}", rows.len());
    // The second result and the line that computes it are labelled as the derivative by pitch.
    assert_eq!(rows[rows.len() - 2][2], "∂aim∂p");
    assert!(rows.iter().any(|row| row[0].starts_with("let __v15") && row[2] == "∂aim∂p"), "{rows:?}");
}

#[test]
fn the_paper_is_met_where_it_has_numbers() {
    let html = parsed(thug());
    let statement = text(all(&html, "#aim math[display=block]").first().expect("the statement"));
    for number in 4..=6 {
        assert!(statement.contains(&format!("paper ({number})")), "{statement}");
    }
    // Johnson's (1) is the transpose of the heading rotation in the thug's axes; (3) is that of pitch with opposite
    // sign.
    let matrices = text(all(&html, "#conventions math[display=block]").last().expect("the turns in the bones' axes"));
    let plain: String = matrices.chars().filter(|letter| !letter.is_whitespace() && *letter != '\u{2062}').collect();
    assert!(plain.contains("BRhBᵀ=1000ch−sh0shch"), "{plain}");
    assert!(plain.contains("BRpBᵀ=cpsp0−spcp0001"), "{plain}");
}

#[test]
fn latex_is_balanced_and_says_the_same() {
    let place = Place::new();
    for (name, rig) in rigs() {
        place.write("rig.toml", &rig);
        place.done("explain rig.toml -o rig.tex --samples 5");
        let text = String::from_utf8(place.read("rig.tex")).expect("text");
        crate::common::latex::assert_balanced(&text, &name);
        assert!(text.is_ascii(), "{name}: a compiler without Unicode fonts stumbles over {:?}", odd(&text));
        for kernel in kernels(&spec(&rig)) {
            let total = kernel.program.count().total();
            assert!(text.contains(&total.to_string()), "{name}: {total}");
        }
    }
}

#[test]
fn latex_compiles() {
    let Some(compiler) = ["tectonic", "pdflatex"].into_iter().find(|program| installed(program)) else { return };
    let place = Place::new();
    for (name, rig) in rigs().into_iter().filter(|(name, _)| ["thug", "odd", "hinge"].contains(&name.as_str())) {
        place.write("rig.toml", &rig);
        place.done("explain rig.toml -o rig.tex --samples 5");
        crate::common::latex::compile(&place, compiler, "rig.tex", &name);
    }
}

fn odd(text: &str) -> Vec<char> {
    let mut letters: Vec<char> = text.chars().filter(|c| !c.is_ascii()).collect();
    letters.sort_unstable();
    letters.dedup();
    letters
}

#[test]
fn the_same_rig_gives_the_same_bytes() {
    let place = Place::new();
    place.write("hinge.toml", HINGE);
    place.write("turret.toml", &std::fs::read_to_string(bundled_rig("turret")).expect("the turret is bundled"));
    for (rig, format) in [("turret", "html"), ("hinge", "latex")] {
        let printed = place.done(&format!("explain {rig}.toml --format {format} --samples 5")).stdout;
        place.done(&format!("explain {rig}.toml --format {format} --samples 5 -o again"));
        assert!(printed.as_bytes() == place.read("again"), "{format}");
    }
}

#[test]
fn bad_input_is_told() {
    let place = Place::with_mannequin();
    place.refused("explain gone.toml -o out.html", &["gone.toml", "in TOML"]);
    place.refused("explain m.glb -o out.html", &["m.glb"]);
    place.refused("explain m.toml -o out.pdf", &["out.pdf", ".html", ".tex", "--format"]);
    place.refused("explain m.toml -o out", &["out", "--format"]);
    place.refused("explain m.toml -o m.toml --format html", &["m.toml", "it is the rig"]);
    place.refused("explain m.toml -o no-folder/out.html", &["no-folder"]);
    place.write("bad.toml", "name = \"Bad\"\n[[joint]]\nname = \"eye\"\nrole = \"eye\"\n");
    assert_eq!(place.aim("explain bad.toml -o out.html").code, 2);
    assert_eq!(place.names(), ["bad.toml", "m.glb", "m.toml"]);
    place.write("hinge.toml", HINGE);
    place.done("explain hinge.toml -o out.pdf --format latex --samples 5");
    place.done("explain hinge.toml -o OUT.HTM --samples 5");
}
