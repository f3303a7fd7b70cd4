//! Checks the book in `docs/`: its links and headings, the rigs that it shows, the lists in its tables, and that its
//! code is run.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Component, Path, PathBuf};

use aim::glam::{Affine3A, Quat, Vec3};
use aim::{DynAim, Joint, Pose, Settings};
use aim_character::InterpretedRig;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

fn names(folder: &str) -> Vec<String> {
    let entries = fs::read_dir(root().join(folder)).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// The page whose code belongs to the plugin.
const BEVY: &str = "five-minutes-bevy.md";

/// Returns the names of the pages in `docs/`.
fn chapters() -> Vec<String> {
    names("docs").into_iter().filter(|name| name.ends_with(".md") && name != "SUMMARY.md").collect()
}

/// Returns all pages with their text.
fn pages() -> BTreeMap<String, String> {
    let mut paths: Vec<String> =
        ["README.md", "ARCHITECTURE.md", "CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md"].map(str::to_owned).into();
    paths.push("examples/compiled-rigs/README.md".to_owned());
    paths.extend(["bevy", "web"].map(|engine| format!("integrations/{engine}/README.md")));
    paths.extend(names(".").into_iter().map(|name| format!("{name}/README.md")));
    paths.extend(names("docs").into_iter().filter(|name| name.ends_with(".md")).map(|name| format!("docs/{name}")));
    paths.retain(|path| root().join(path).is_file());
    assert!(paths.len() > 30, "{paths:?}");
    paths.into_iter().map(|path| (path.clone(), read(&path))).collect()
}

/// A fenced block: its language and its text.
struct Block {
    language: String,
    text: String,
}

/// Splits a page into its fenced blocks and its other lines.
fn take_apart(text: &str) -> (Vec<Block>, Vec<&str>) {
    let (mut blocks, mut prose, mut open) = (Vec::<Block>::new(), Vec::new(), false);
    for line in text.lines() {
        match (open, line.trim_start().strip_prefix("```")) {
            (false, Some(info)) => {
                assert!(!info.is_empty(), "a block without a language");
                blocks.push(Block { language: info.to_owned(), text: String::new() });
                open = true;
            }
            (true, Some(_)) => open = false,
            (true, None) => blocks.last_mut().expect("an open block").text.push_str(&format!("{line}\n")),
            (false, None) => prose.push(line),
        }
    }
    assert!(!open, "a block without an end");
    (blocks, prose)
}

/// Returns a line without its code spans.
fn without_code(line: &str) -> String {
    line.split('`').step_by(2).collect()
}

/// Returns the anchor of a heading, as mdBook and GitHub generate it.
fn anchor(heading: &str) -> String {
    let kept = heading.trim().to_lowercase();
    kept.chars()
        .filter_map(|c| match c {
            ' ' => Some('-'),
            c if c.is_alphanumeric() || c == '-' || c == '_' => Some(c),
            _ => None,
        })
        .collect()
}

fn anchors(text: &str) -> BTreeSet<String> {
    let (_, prose) = take_apart(text);
    prose
        .iter()
        .filter_map(|line| line.trim_start_matches('#').strip_prefix(' ').filter(|_| line.starts_with('#')))
        .map(anchor)
        .collect()
}

/// Returns the targets of a page's links within the project: `[text](target)`, `[name]: target` and `src="target"`.
fn targets(text: &str) -> Vec<String> {
    let (_, prose) = take_apart(text);
    let mut targets = Vec::new();
    for line in &prose {
        if let Some((_, target)) = line.strip_prefix('[').and_then(|rest| rest.split_once("]: ")) {
            targets.push(target.to_owned());
        }
        let line = without_code(line);
        for mark in ["](", "src=\""] {
            let ends = if mark == "](" { ')' } else { '"' };
            targets.extend(
                line.split(mark).skip(1).filter_map(|rest| rest.split_once(ends)).map(|(target, _)| target.to_owned()),
            );
        }
    }
    // Skip URLs and items of a crate; rustdoc checks the latter.
    targets.retain(|target| !target.starts_with("https://") && !target.contains("::"));
    targets
}

/// Resolves a link of a page to a path from the root.
fn followed(page: &str, link: &str) -> String {
    let mut path = Vec::new();
    for part in Path::new(page).parent().expect("a folder").join(link).components() {
        match part {
            Component::ParentDir => drop(path.pop().unwrap_or_else(|| panic!("{page}: {link} leaves the project"))),
            Component::Normal(name) => path.push(name.to_string_lossy().into_owned()),
            _ => {}
        }
    }
    path.join("/")
}

/// Returns the broken links of these pages.
fn dead_links(pages: &BTreeMap<String, String>) -> Vec<String> {
    let mut dead = Vec::new();
    for (page, text) in pages {
        for target in targets(text) {
            let (file, heading) = target.split_once('#').map_or((target.as_str(), None), |(file, at)| (file, Some(at)));
            let path = if file.is_empty() { page.clone() } else { followed(page, file) };
            let text = pages.get(&path).cloned().or_else(|| fs::read_to_string(root().join(&path)).ok());
            if !root().join(&path).exists() && !pages.contains_key(&path) {
                dead.push(format!("{page}: {target}: there is no {path}"));
            } else if page.starts_with("docs/") && !path.starts_with("docs/") {
                dead.push(format!("{page}: {target}: {path} is not in the book"));
            } else if heading.is_some_and(|heading| !text.is_some_and(|text| anchors(&text).contains(heading))) {
                dead.push(format!("{page}: {target}: {path} has no such heading"));
            }
        }
    }
    dead
}

#[test]
fn links_lead_somewhere() {
    let pages = pages();
    assert_eq!(dead_links(&pages), [""; 0]);
    let links: usize = pages.values().map(|text| targets(text).len()).sum();
    assert!(links > 100, "only {links} links are read");
}

#[test]
fn dead_links_are_found() {
    let page = "# One heading\n[a](b.md) [c](c.md#one-heading) [d](#two) [e](../README.md) `[f](f.md)`\n[g]: c.md#two\n\n```sh\n[h](h.md)\n```\n";
    let pages = [("docs/a.md", page), ("docs/c.md", "## One heading\n")];
    let dead = dead_links(&pages.map(|(path, text)| (path.to_owned(), text.to_owned())).into());
    let expected = [
        "docs/a.md: c.md#two: docs/c.md has no such heading",
        "docs/a.md: b.md: there is no docs/b.md",
        "docs/a.md: #two: docs/a.md has no such heading",
        "docs/a.md: ../README.md: README.md is not in the book",
    ];
    assert_eq!(BTreeSet::from_iter(dead.iter().map(String::as_str)), BTreeSet::from(expected));
}

#[test]
fn every_page_is_a_chapter_and_every_chapter_a_page() {
    let summary = read("docs/SUMMARY.md");
    let listed = targets(&summary);
    let pages = chapters();
    assert_eq!(listed.len(), listed.iter().collect::<BTreeSet<_>>().len(), "a page is listed twice");
    assert_eq!(BTreeSet::from_iter(listed), BTreeSet::from_iter(pages));
}

#[test]
fn every_block_of_rust_is_run_or_included_from_a_program() {
    let documentation = read("src/lib.rs") + &read("src/guide.rs") + &read("derivand/src/lib.rs");
    let plugin = root()
        .join("integrations/bevy/README.md")
        .is_file()
        .then(|| read("integrations/bevy/README.md") + &read("integrations/bevy/examples/examples/walking.rs"));
    let mut run = 0;
    for chapter in chapters() {
        let text = read(&format!("docs/{chapter}"));
        for Block { language, text } in take_apart(&text).0 {
            match language.as_str() {
                "rust" => {
                    // Either as an included file, or as one in the guide's list.
                    let is_run = [format!("docs/{chapter}\")"), format!(" \"{chapter}\"\n")]
                        .iter()
                        .any(|words| documentation.contains(words));
                    assert!(is_run, "{chapter}: its blocks are no documentation of a crate, so nobody runs them");
                    run += 1;
                }
                "rust,ignore" if chapter == BEVY => {
                    // The plugin's workspace needs a newer Rust and tests its own code.
                    let Some(plugin) = &plugin else { continue };
                    assert!(plugin.contains(&text), "{chapter}: not in the plugin's README or its example:\n{text}");
                }
                // `.ci/five-minutes` runs it in an empty folder, with a model and a build script.
                "rust,ignore" if chapter == "five-minutes.md" => {}
                "rust,ignore" => {
                    let included = text.trim().strip_prefix("{{#include ").and_then(|rest| rest.strip_suffix("}}"));
                    let path = included.unwrap_or_else(|| panic!("{chapter}: neither run nor included:\n{text}"));
                    let path = followed(&format!("docs/{chapter}"), path);
                    assert!(root().join(&path).is_file(), "{chapter}: there is no {path}");
                }
                // These are lines of programs in the package's README, which `.ci/web` runs.
                "js" if chapter == "web.md" => {
                    let package = read("integrations/web/README.md");
                    let mut lines = text.lines().filter(|line| !line.is_empty() && !line.starts_with("//"));
                    assert!(
                        lines.all(|line| package.contains(line)),
                        "{chapter}: not in the package's README:\n{text}"
                    );
                }
                "wgsl" => drop(aim_tests::wgsl::Module::read(&text)),
                "toml" | "sh" | "console" | "text" => {}
                other => panic!("{chapter}: a block of {other}"),
            }
        }
    }
    assert!(run >= 18, "{run} blocks");
}

#[test]
fn every_block_of_toml_is_a_rig_or_a_manifest() {
    let joint = "[[joint]]\nname = 'j'\nheading = 'free'\nrate = '1rad'\n";
    let (mut rigs, mut manifests) = (0, 0);
    for (page, text) in pages() {
        for Block { text, .. } in take_apart(&text).0.into_iter().filter(|block| block.language == "toml") {
            if text.contains("dependencies]") {
                let manifest: toml::Table = toml::from_str(&text).unwrap_or_else(|error| panic!("{page}: {error}"));
                assert!(manifest.keys().all(|key| key.ends_with("dependencies")), "{page}: {manifest:?}");
                manifests += 1;
                continue;
            }
            let text = match text.trim().strip_prefix("{{#include ").and_then(|rest| rest.strip_suffix("}}")) {
                Some(path) => read(&followed(&page, path)),
                None => text,
            };
            // Add the parts that an excerpt of a rig leaves out.
            let mut whole = text.clone();
            if !text.split("[[joint]]").next().is_some_and(|rig| rig.contains("name =")) {
                whole.insert_str(0, "name = 'R'\n");
            }
            if !text.contains("[[joint]]") {
                whole.push_str(joint);
            } else if !text.contains("rate =") {
                whole.push_str("heading = 'free'\nrate = '1rad'\n");
            }
            aim_codegen::declare::from_toml(&page, &whole).unwrap_or_else(|errors| panic!("{errors}"));
            rigs += 1;
        }
    }
    assert!(rigs >= 6 && manifests >= 1, "{rigs} rigs, {manifests} manifests");
}

/// Returns the pages that the registry shows for packages, from `readme` in their manifests.
fn front_pages() -> Vec<String> {
    let folders =
        names(".").into_iter().map(|name| format!("{name}/")).chain(["", "integrations/bevy/"].map(str::to_owned));
    let mut pages = Vec::new();
    for folder in folders.filter(|folder| root().join(folder).join("Cargo.toml").is_file()) {
        let manifest: toml::Table = toml::from_str(&read(&format!("{folder}Cargo.toml"))).expect("a manifest");
        let readme = manifest.get("package").and_then(|package| package.get("readme")?.as_str());
        pages.extend(readme.map(|readme| format!("{folder}{readme}")));
    }
    pages
}

/// Returns the parts of a page that cannot be read without the repository and rustdoc: links to files, items in
/// brackets without a definition, and code lines that rustdoc would hide.
fn unreadable_alone(page: &str) -> Vec<String> {
    let (blocks, prose) = take_apart(page);
    let mut found: Vec<String> = targets(page).into_iter().filter(|target| !target.starts_with('#')).collect();
    let items = prose.iter().flat_map(|line| line.match_indices("[`").map(|(at, _)| &line[at..]));
    for item in items.filter_map(|rest| Some(&rest[..rest.find("`]")? + 2])) {
        let is_led = [format!("{item}("), format!("{item}["), format!("{item}: ")].iter().any(|way| page.contains(way));
        found.extend((!is_led).then(|| item.to_owned()));
    }
    let code = blocks.iter().filter(|block| block.language.starts_with("rust")).flat_map(|block| block.text.lines());
    found.extend(code.filter(|line| *line == "#" || line.starts_with("# ")).map(str::to_owned));
    found
}

#[test]
fn pages_of_packages_are_readable_alone() {
    let pages = front_pages();
    assert!(pages.len() >= 12, "{pages:?}");
    for page in pages {
        assert_eq!(unreadable_alone(&read(&page)), [""; 0], "{page}");
    }
    let page =
        "![a](a.png) [`B`] [`C`] [d](#d) `[e]`\n[f]: docs/f.md\n[`C`]: https://c\n\n```rust\n# hidden\n#[shown]\n```\n";
    assert_eq!(unreadable_alone(page), ["a.png", "docs/f.md", "[`B`]", "# hidden"]);
}

#[test]
fn the_registry_shows_the_example_of_the_readme() {
    let first = |page: &str| take_apart(&read(page)).0.into_iter().find(|block| block.language == "rust");
    let [shown, run] = ["src/registry.md", "README.md"].map(|page| first(page).expect("an example").text);
    assert_eq!(shown, run);
    let features = |table: &str| -> BTreeSet<String> {
        let rows = table.lines().filter_map(|line| line.strip_prefix("| `")?.split('`').next());
        rows.map(str::to_owned).collect()
    };
    let manifest: toml::Table = toml::from_str(&read("Cargo.toml")).expect("a manifest");
    let declared = manifest["features"].as_table().expect("a table").keys().filter(|name| *name != "default");
    assert_eq!(features(&read("src/registry.md")), declared.cloned().collect());
}

/// Returns the names in the first column of a section's tables.
fn listed(page: &str, section: &str) -> BTreeSet<String> {
    let text = read(page);
    let (_, rest) = text.split_once(&format!("\n## {section}\n")).unwrap_or_else(|| panic!("{page} has no {section}"));
    let section = rest.split("\n## ").next().expect("a first part");
    // Skip the header row, which is above the rule.
    let lines: Vec<&str> = section.lines().collect();
    let rows =
        lines.windows(2).filter(|pair| !pair[1].starts_with("|---")).map(|pair| pair[0]).chain(lines.last().copied());
    let cells = rows.filter_map(|line| line.strip_prefix("| `")?.split(" |").next());
    cells
        .flat_map(|cell| format!("`{cell}").split('`').skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>())
        .collect()
}

/// Returns the variants of an enum, or the public fields of a struct, in a source file.
fn parts(file: &str, item: &str) -> BTreeSet<String> {
    let file = syn::parse_file(&read(file)).expect("Rust");
    let found = file.items.iter().find_map(|one| match one {
        syn::Item::Enum(one) if one.ident == item => {
            Some(one.variants.iter().map(|one| one.ident.to_string()).collect())
        }
        syn::Item::Struct(one) if one.ident == item => {
            Some(one.fields.iter().filter_map(|field| Some(field.ident.as_ref()?.to_string())).collect())
        }
        _ => None,
    });
    found.unwrap_or_else(|| panic!("there is no {item}"))
}

/// Returns the keys of a list in the source of the declarations.
fn keys(list: &str) -> BTreeSet<String> {
    let source = read("aim-codegen/src/declare/check/keys.rs");
    let (_, rest) = source.split_once(&format!("const {list}: ")).expect("a list");
    let list = rest.split("];").next().expect("its end").replace("]; 6", "");
    list.split("(\"").skip(1).filter_map(|rest| rest.split('"').next()).map(str::to_owned).collect()
}

#[test]
fn the_reference_lists_what_there_is() {
    let reference = "docs/reference.md";
    assert_eq!(listed(reference, "Settings"), parts("aim-runtime/src/rig/settings.rs", "Settings"));
    assert_eq!(listed(reference, "Status"), parts("aim-runtime/src/rig/outcome.rs", "Status"));
    assert_eq!(listed(reference, "Outcome"), parts("aim-runtime/src/rig/outcome.rs", "Outcome"));
    let mistakes = listed("docs/troubleshooting.md", "Mistakes that the check names");
    assert_eq!(mistakes, parts("aim-runtime/src/check/mistake.rs", "Mistake"));

    let manifest: toml::Table = toml::from_str(&read("Cargo.toml")).expect("a manifest");
    let features = manifest["features"].as_table().expect("a table").keys().filter(|name| *name != "default");
    assert_eq!(listed(reference, "Features"), features.cloned().collect());

    let name = || ["name".to_owned()];
    assert_eq!(listed("docs/rig-files.md", "Of the rig"), keys("RIG_KEYS").into_iter().chain(name()).collect());
    assert_eq!(listed("docs/rig-files.md", "Of a joint"), keys("JOINT_KEYS").into_iter().chain(name()).collect());
}

#[test]
fn the_oldest_rust_of_each_crate_is_told() {
    let oldest = |manifest: &str| {
        let text = read(manifest);
        text.lines().find_map(|line| Some(line.strip_prefix("rust-version = \"")?.trim_end_matches('"').to_owned()))
    };
    for (manifest, told) in [
        ("Cargo.toml", ["Rust {} will do", "need Rust {}"]),
        ("aim-viewer/Cargo.toml", ["(`aim-viewer`, {})", "`view` of `aim-cli` ({})"]),
        ("integrations/bevy/Cargo.toml", ["the plugin for Bevy ({})"; 2]),
    ] {
        let version = oldest(manifest).unwrap_or_else(|| panic!("{manifest} has no rust-version"));
        for (page, words) in ["README.md", "docs/reference.md"].into_iter().zip(told) {
            assert!(
                read(page).contains(&words.replace("{}", &version)),
                "{page} does not tell {version} of {manifest}"
            );
        }
    }
}

#[test]
fn percentages_per_bone_are_parts_of_the_turn() {
    let page = read("docs/recipes.md");
    let numbers = |cell: &str, between: &str| -> Vec<f32> {
        cell.trim_end_matches(" %").split(between).map(|number| number.parse().expect("a number")).collect()
    };
    let (_, rows) = page.split_once("| the percentages are |").expect("a table");
    let mut judged = 0;
    for row in rows.lines().skip(2).take_while(|line| line.starts_with('|')) {
        let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
        let [meaning, weights, parts, stiffness] = cells[..] else { panic!("{row}") };
        let [weights, parts, stiffness] = [numbers(weights, " / "), numbers(parts, " / "), numbers(stiffness, ", ")];

        // Convert the percentages to shares, from the chest outward.
        let mut left = 100.0;
        let mut meant: Vec<f32> = weights
            .iter()
            .rev()
            .map(|weight| {
                if meaning.starts_with("each of what") {
                    let part = left * weight / 100.0;
                    left -= part;
                    part
                } else {
                    100.0 * weight / weights.iter().sum::<f32>()
                }
            })
            .collect();
        meant.reverse();

        let joint = |(number, stiffness)| {
            format!(
                "[[joint]]\nname = 'j{number}'\nheading = ['-60deg', '60deg']\npitch = ['-60deg', '60deg']\nrate = '1rad'\nstiffness = {stiffness:?}\n"
            )
        };
        let joints: String = stiffness.iter().enumerate().map(joint).collect();
        let rig = format!("name = 'R'\naxes = {{ up = '+Y', forward = '+Z' }}\n{joints}");
        let spec = aim_codegen::declare::from_toml("recipes.md", &rig).unwrap_or_else(|errors| panic!("{errors}"));
        let mut character = DynAim::new(InterpretedRig::new(&spec));
        let pose = [1.65, 1.5, 1.35].map(|y| Affine3A::from_translation(Vec3::Y * y));
        // Far targets at 0.3 rad, to the side or above.
        for (turn, of) in [
            (Quat::from_rotation_y(0.3), Joint::heading as fn(&Joint) -> f32),
            (Quat::from_rotation_x(-0.3), Joint::pitch),
        ] {
            character.snap(&Pose::new(&pose[..]), turn * Vec3::Z * 1e4, &Settings::default());
            let found: Vec<f32> = character.state.joints.iter().map(|joint| 100.0 * of(joint) / 0.3).collect();
            for expected in [&meant, &parts] {
                let is_right = found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 0.5);
                assert!(is_right, "{row}: {found:?} instead of {expected:?}");
            }
        }
        judged += 1;
    }
    assert_eq!(judged, 3);
}
