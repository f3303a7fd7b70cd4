//! The attribute's own arguments: `wrt(…)`, `budget = …`, `hessian` and its like, `crate = …`.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::budget::Budget;
use super::companion::Companion;
use super::manifold::{Side, Varies};
use super::messages;
use crate::declare::Place;
use crate::declare::check::keys::Key;
use crate::declare::check::read::{self, FoundWord};
use crate::declare::check::settings::{Level, Setting, Settings};
use crate::declare::parse::tokens::entries;
use crate::declare::report::Report;
use crate::declare::report::expected::Expected;
use crate::declare::tree::{Entry, Item, Kind, Value, Word};

/// What the attribute asks for.
pub(super) struct Options {
    /// The variables, each once; `None` where `wrt` is missing.
    pub(super) wrt: Option<Vec<Variable>>,
    /// The side of rotations that tangents are on.
    side: Side,
    /// How long arguments are that are slices, by name.
    pub(super) lengths: Vec<(Word, usize)>,
    pub(super) budget: Option<Budget>,
    /// Further companions, and where they are asked for.
    pub(super) companions: Vec<(Companion, Place)>,
    /// Whether a test is to be written, and where that is said.
    pub(super) check: Option<(bool, Place)>,
    /// The place that asks for companions of numbers in lanes.
    pub(super) lanes: Option<Place>,
    pub(super) krate: Option<TokenStream>,
    /// False where what is made has no loops.
    loops: bool,
}

/// A variable as the attribute names it.
pub(super) struct Variable {
    pub(super) name: Word,
    /// Whether derivatives are by its tangent.
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

/// What a module may say for all of its functions.
const KEYS_OF_MODULE: &[Key] = &[("check", Expected::FLAG), ("crate", Expected::PATH)];

impl Options {
    /// The arguments of the attribute of a module.
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
            loops: true,
        }
    }

    /// What is not said here is as the module says.
    pub(super) fn within(self, module: &Self) -> Self {
        let krate = self.krate.or_else(|| module.krate.clone());
        Self { check: self.check.or_else(|| module.check.clone()), krate, ..self }
    }

    /// Where no crate is named, it is `facade`.
    pub(super) fn beside(self, facade: &str) -> Self {
        let facade = format_ident!("{facade}");
        Self { krate: self.krate.or_else(|| Some(quote!(::#facade))), ..self }
    }

    /// For a language in which nothing has loops.
    pub(super) fn without_loops(self) -> Self {
        Self { loops: false, ..self }
    }

    /// True if everything that is asked for may have loops.
    pub(super) fn may_keep_loops(&self) -> bool {
        self.loops && self.companions.is_empty() && self.lanes.is_none()
    }

    /// What of a variable derivatives are taken by.
    pub(super) fn varies(&self, variable: &Variable) -> Varies {
        if variable.tangent { Varies::Tangent(self.side) } else { Varies::Numbers }
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
            loops: true,
        }
    }
}

/// What stands around the names of variables whose tangents are meant.
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
    let variable = |FoundWord { text, place, wrapped }: FoundWord<'_>| Variable {
        name: Word { text: text.to_owned(), place: place.clone() },
        tangent: wrapped,
    };
    words.into_iter().map(variable).collect()
}

/// `(values = 8, weights = 8)`
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

fn presence(report: &mut Report, setting: Setting<'_>) -> Option<Place> {
    match setting.value.kind {
        Kind::Absent | Kind::Bool(true) => Some(setting.place().clone()),
        Kind::Bool(false) => None,
        _ => report.refuse(setting.place(), messages::flag_with_value(setting.key)),
    }
}

fn check(report: &mut Report, setting: Setting<'_>) -> Option<(bool, Place)> {
    match setting.value.kind {
        Kind::Bool(wanted) => Some((wanted, setting.place().clone())),
        _ => read::mismatch(report, setting),
    }
}
