//! `aim clip`: reports the size of clips, and writes them smaller, as loops, or in place.

use aim_animation::{Clip, Motion};
use aim_character::{Measurement, in_place, mended_loop, root_path};
use aim_gltf::Document;
use clap::ValueEnum;

use crate::args::{self, Extract};
use crate::clip_report::{ClipCost, ClipReport, Extracted, ReducedReport, RootReport, Side, bone_bytes, sampled};
use crate::deviation::Deviation;
use crate::failure::{Failure, Result};
use crate::files;
use crate::html::{self, ClipPage, ClipTakes};
use crate::outputs::{Outputs, Targets};
use crate::reduction::{Kept, Millimetres, WrittenError, millimetre, reduced};

/// Tolerance of the reduction that is proposed if no change is requested.
const PREVIEW: Millimetres = Millimetres(1.0);

pub(super) fn run(arguments: &args::Clip) -> Result {
    let file = &arguments.file;
    let changes = arguments.extract.is_some() || arguments.looped || arguments.reduce.is_some();
    if let (false, Some(out)) = (changes, &arguments.out) {
        let what = "--out would write the model unchanged; add --reduce, --loop or --extract";
        return Err(Failure::in_file(out, what));
    }
    let document = files::load_model(file)?;
    let targets =
        Targets { out: arguments.out.as_deref(), report: arguments.report.as_deref(), html: arguments.html.as_deref() };
    Outputs::default().reading_parts_of(&document).write_model(targets, file)?;
    let measurement = arguments.facing.measure(file, &document)?;
    let request = Request {
        document: &document,
        measurement: &measurement,
        extract: arguments.extract,
        looped: arguments.looped,
        tolerance: arguments.reduce.or((!changes).then_some(PREVIEW)),
        pins: &arguments.pin,
    };
    let clips = chosen(arguments, &document)?;
    check_pins(arguments, &clips)?;
    let changed = clips.iter().map(|clip| request.change(clip)).collect::<std::result::Result<Vec<_>, _>>();
    let changed = changed.map_err(Failure::of(file))?;
    let new: Vec<Clip> = changed.iter().filter_map(|change| change.after.clone()).collect();
    let model = document.with_clips_compacted(&new).map_err(Failure::of(file))?;
    let written = Document::from_bytes(&model).map_err(Failure::of(file))?;
    let [sizes, sizes_after] = [&document, &written].map(Document::clip_sizes);
    let mut costs = Vec::new();
    let mut takes = Vec::new();
    for (clip, change) in clips.iter().zip(changed) {
        let at = |document: &Document| document.clips().iter().position(|known| known.name() == clip.name());
        let (Some(old), Some(new)) = (at(&document), at(&written)) else { continue };
        let (after, before_reduction) = (&written.clips()[new], change.before_reduction);
        let mut deviation = None;
        let mut told = None;
        if let Some(tolerance) = request.tolerance {
            let measured = Deviation::measure(&document, [&before_reduction, after]);
            let error = measured.written_error(&document, millimetre(&measurement));
            error.check(file, clip.name(), tolerance)?;
            let WrittenError { mm, at, weights } = error;
            let (bone, t) = at.unzip();
            told = Some(ReducedReport {
                tolerance_mm: tolerance.0,
                proposed: !changes,
                pins: arguments.pin.clone(),
                error_mm: mm,
                bone,
                t,
                weights_error: weights,
            });
            deviation = Some(measured);
        }
        costs.push(ClipCost {
            clip: clip.name().to_owned(),
            length_s: clip.length_s(),
            before: Side::new(&document, &measurement, clip, &sizes[old]),
            after: Side::new(&written, &measurement, after, &sizes_after[new]),
            root: change.root,
            extracted: change.extracted,
            mended: change.mended,
            reduced: told,
            bones: bone_bytes(&document, [&sizes[old], &sizes_after[new]]),
        });
        takes.push(ClipTakes { before: clip, after, deviation });
    }
    let report = ClipReport {
        file: file.display().to_string(),
        millimetre: millimetre(&measurement),
        file_bytes: [files::bytes_as_binary(file, &document)?, model.len()],
        out: arguments.out.clone(),
        clips: costs,
    };
    let page = ClipPage { report: &report, takes: &takes, document: &document, is_preview: !changes };
    targets.write(&model, &report, || html::clips_page(&page))?;
    files::print(&report.in_words(!changes))?;
    for page in [targets.report, targets.html].into_iter().flatten() {
        files::print(&format!("wrote {}\n", page.display()))?;
    }
    Ok(())
}

/// Returns the requested clips in the file's order. Of several clips with one name, it returns the first and prints a
/// warning.
fn chosen<'d>(arguments: &args::Clip, document: &'d Document) -> Result<Vec<&'d Clip>> {
    for name in &arguments.clip {
        document.clip(name).map_err(Failure::of(&arguments.file))?;
    }
    let is_asked = |clip: &&Clip| arguments.clip.is_empty() || arguments.clip.iter().any(|name| name == clip.name());
    let mut chosen: Vec<&Clip> = Vec::new();
    for clip in document.clips().iter().filter(is_asked) {
        if chosen.iter().any(|other| other.name() == clip.name()) {
            let file = arguments.file.display();
            eprintln!("warning: {file} has several clips named {:?}; using the first", clip.name());
        } else {
            chosen.push(clip);
        }
    }
    if chosen.is_empty() {
        return Err(Failure::in_file(&arguments.file, "no clips; export the character with an animation"));
    }
    Ok(chosen)
}

/// Checks that every pin is a time of every requested clip.
fn check_pins(arguments: &args::Clip, clips: &[&Clip]) -> Result {
    for pin in &arguments.pin {
        if let Some(clip) = clips.iter().find(|clip| !(0.0..=clip.length_s()).contains(pin)) {
            return Err(Failure::in_file(
                &arguments.file,
                format!(
                    "--pin {pin} s is outside the clip {:?}, which is {} s long; give times from 0 to its length, or select \
                     clips with --clip",
                    clip.name(),
                    clip.length_s()
                ),
            ));
        }
    }
    Ok(())
}

/// Changes requested for all clips.
struct Request<'a> {
    document: &'a Document,
    measurement: &'a Measurement,
    extract: Option<Extract>,
    looped: bool,
    tolerance: Option<Millimetres>,
    pins: &'a [f32],
}

/// Result of the requested changes to a clip.
struct Changed {
    root: Option<RootReport>,
    extracted: Option<Extracted>,
    mended: Option<bool>,
    before_reduction: Clip,
    /// The changed clip; `None` if it stays as it is.
    after: Option<Clip>,
}

impl Request<'_> {
    fn change(&self, clip: &Clip) -> std::result::Result<Changed, String> {
        let Self { document, measurement, .. } = *self;
        let of_clip = |error: aim_character::Error| format!("clip {:?}: {error}", clip.name());
        let path = root_path(document, measurement, clip).map_err(of_clip)?;
        let mut changed = clip.clone();
        let mut extracted = None;
        if let Some(kind) = self.extract {
            let Some(path) = &path else {
                return Err(format!(
                    "cannot extract root motion from clip {:?}: {}",
                    clip.name(),
                    if clip.length_s() > 0.0 {
                        "no hips found in the file (see `aim inspect`)"
                    } else {
                        "it has no length"
                    }
                ));
            };
            let motion = match kind {
                Extract::Linear => Motion::linear(path),
                Extract::Composite => Motion::composite(path),
                Extract::Delta => Motion::variable(path),
            };
            let word = kind.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned());
            let taken = Extracted::new(&motion, &word, &sampled(clip), 1700.0 * millimetre(measurement));
            if !taken.nothing {
                changed = in_place(document, &changed, motion).map_err(of_clip)?;
            }
            extracted = Some(taken);
        }
        let mut mended = None;
        if self.looped {
            let found = mended_loop(document, measurement, &changed).map_err(of_clip)?;
            mended = Some(found.is_some());
            changed = found.map_or(changed, |found| found.clip);
        }
        let before_reduction = changed.clone();
        if let Some(tolerance) = self.tolerance {
            let kept = Kept { tolerance: tolerance.0 * millimetre(measurement), pins: self.pins, points: &[] };
            changed = reduced(&changed, document, &kept).map_err(|error| format!("clip {:?}: {error}", clip.name()))?;
        }
        let after = (changed != *clip).then_some(changed);
        Ok(Changed {
            root: path.map(|path| RootReport::new(&path, measurement, &sampled(clip))),
            extracted,
            mended,
            before_reduction,
            after,
        })
    }
}
