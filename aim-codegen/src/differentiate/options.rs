//! The attribute's arguments: `wrt(…)`, `budget = …`, `hessian` and the other companions, `crate = …`.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::budget::Budget;
use super::companion::Companion;
use super::manifold::{Side, VaryingPart};
use super::messages;
use crate::declare::SourcePlace;
use crate::declare::check::keys::Key;
use crate::declare::check::read::{self, ListedWord};
use crate::declare::check::settings::{Level, Setting, Settings};
use crate::declare::parse::tokens::entries;
use crate::declare::report::Report;
use crate::declare::report::expected::Expected;
use crate::declare::tree::{Entry, Item, Kind, Value, Word};

/// The attribute's parsed arguments.
pub(super) struct Options {
    /// The variables, each once; `None` if `wrt` is missing.
    pub(super) wrt: Option<Vec<Variable>>,
    /// Side on which the steps of rotations are composed.
    side: Side,
    /// Lengths of arguments that are slices, by name.
    pub(super) lengths: Vec<(Word, usize)>,
    pub(super) budget: Option<Budget>,
    /// Requested companions besides the first, and the place of each request.
    pub(super) companions: Vec<(Companion, SourcePlace)>,
    /// `true` if a test is to be emitted, and the place of that option.
    pub(super) check: Option<(bool, SourcePlace)>,
    /// Place of the request for companions over numbers in lanes.
    pub(super) lanes: Option<SourcePlace>,
    pub(super) krate: Option<TokenStream>,
    /// `false` if the companions are written in another language.
    in_rust: bool,
}

/// A variable, as the attribute names it.
pub(super) struct Variable {
    pub(super) name: Word,
    /// `true` if derivatives are taken with respect to its tangent.
    pub(super) tangent: bool,
}

const KEYS: &[Key] = &[
    ("wrt", Expected::ARGUMENTS),
    ("perturbation", Expected::SIDE),
    ("lengths", Expected::LENGTHS),
    ("budget", Expected::OPERATIONS),
    ("hessian", Expected::PRESENCE),
    ("jvp", Expected::PRESENCE),
    ("vjp", Expected::PRESENCE),
    ("hvp", Expected::PRESENCE),
    ("gauss_newton", Expected::PRESENCE),
    ("lanes", Expected::PRESENCE),
    ("check", Expected::FLAG),
    ("crate", Expected::PATH),
];

/// Options that a module may set for all of its functions.
const KEYS_OF_MODULE: &[Key] = &[("check", Expected::FLAG), ("crate", Expected::PATH)];

impl Options {
    /// Parses the attribute of a module.
    pub(super) fn parse_module(attribute: TokenStream, report: &mut Report) -> Self {
        let entries = entries(attribute);
        let settings = Settings::read(&entries, KEYS_OF_MODULE, Level::Options, report);
        let krate = settings.read_value("crate", report, read::path);
        Self {
            wrt: None,
            side: Side::default(),
            lengths: Vec::new(),
            budget: None,
            companions: Vec::new(),
            check: settings.read_value("check", report, check),
            lanes: None,
            krate,
            in_rust: true,
        }
    }

    /// Fills options that are missing here with those of the module.
    pub(super) fn within(self, module: &Self) -> Self {
        let krate = self.krate.or_else(|| module.krate.clone());
        Self { check: self.check.or_else(|| module.check.clone()), krate, ..self }
    }

    /// Sets the crate to `facade` if none is given.
    pub(super) fn beside(self, facade: &str) -> Self {
        let facade = format_ident!("{facade}");
        Self { krate: self.krate.or_else(|| Some(quote!(::#facade))), ..self }
    }

    /// For companions in another language, which have no loops and see no Rust constants.
    pub(super) fn in_another_language(self) -> Self {
        Self { in_rust: false, ..self }
    }

    /// Returns `true` if the companions may read constants that stand where they do.
    pub(super) fn may_read_constants(&self) -> bool {
        self.in_rust
    }

    /// Returns `true` if all requested companions may contain loops.
    pub(super) fn may_keep_loops(&self) -> bool {
        self.in_rust && self.companions.is_empty() && self.lanes.is_none()
    }

    /// Returns the part of a variable that derivatives are taken with respect to.
    pub(super) fn varying_part(&self, variable: &Variable) -> VaryingPart {
        if variable.tangent { VaryingPart::Tangent(self.side) } else { VaryingPart::Numbers }
    }

    pub(super) fn parse(attribute: TokenStream, report: &mut Report) -> Self {
        let entries = entries(attribute);
        let settings = Settings::read(&entries, KEYS, Level::Options, report);
        let wrt = settings.get("wrt").map(|setting| variables(report, setting));
        let side = settings.get("perturbation");
        if let (Some(side), Some(wrt)) = (side, &wrt)
            && !wrt.iter().any(|variable| variable.tangent)
        {
            report.error(side.place(), messages::no_tangents());
        }
        let is_left = settings.read_value("perturbation", report, |report, setting| {
            read::is_first_of(report, setting, ["left", "right"])
        });
        Self {
            side: if is_left == Some(true) { Side::Left } else { Side::Right },
            wrt: wrt.or_else(|| settings.has("wrt").then(Vec::new)),
            lengths: settings.read_value("lengths", report, lengths).unwrap_or_default(),
            budget: settings.read_value("budget", report, Budget::read),
            companions: Companion::OPTIONAL
                .into_iter()
                .filter_map(|companion| Some((companion, settings.read_value(companion.key(), report, presence)?)))
                .collect(),
            check: settings.read_value("check", report, check),
            lanes: settings.read_value("lanes", report, presence),
            krate: settings.read_value("crate", report, read::path),
            in_rust: true,
        }
    }
}

/// Wrapper around the names of variables that stand for their tangents.
const TANGENT: &str = "tangent";

fn variables(report: &mut Report, wrt: Setting<'_>) -> Vec<Variable> {
    let names_none = |entry: &Entry| match entry {
        Entry::Item(Item { value: Value { kind: Kind::Table(inner), .. }, .. }) => inner.is_empty(),
        _ => false,
    };
    if matches!(&wrt.value.kind, Kind::Table(entries) if entries.iter().all(names_none)) {
        report.error(wrt.place(), messages::wrt_empty());
    }
    let words = read::wrapped_words(report, wrt, "arguments", TANGENT);
    let variable = |ListedWord { text, place, wrapped }: ListedWord<'_>| Variable {
        name: Word { text: text.to_owned(), place: place.clone() },
        tangent: wrapped,
    };
    words.into_iter().map(variable).collect()
}

/// Reads `(values = 8, weights = 8)`.
fn lengths(report: &mut Report, setting: Setting<'_>) -> Option<Vec<(Word, usize)>> {
    let Kind::Table(entries) = &setting.value.kind else { return read::mismatch(report, setting) };
    let mut lengths = Vec::new();
    for entry in entries {
        let length = match entry {
            Entry::Item(Item { key, value }) => {
                value.number().replace('_', "").parse().ok().map(|length| (key, length))
            }
            _ => None,
        };
        let Some((name, length)) = length else { return read::mismatch(report, setting) };
        lengths.push((name.clone(), length));
    }
    Some(lengths)
}

fn presence(report: &mut Report, setting: Setting<'_>) -> Option<SourcePlace> {
    match setting.value.kind {
        Kind::Absent | Kind::Bool(true) => Some(setting.place().clone()),
        Kind::Bool(false) => None,
        _ => report.refuse(setting.place(), messages::flag_with_value(setting.key)),
    }
}

fn check(report: &mut Report, setting: Setting<'_>) -> Option<(bool, SourcePlace)> {
    match setting.value.kind {
        Kind::Bool(wanted) => Some((wanted, setting.place().clone())),
        _ => read::mismatch(report, setting),
    }
}
