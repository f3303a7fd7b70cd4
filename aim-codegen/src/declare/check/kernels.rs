//! Checks the kernels that are requested as functions of the rig: names of objectives, each at most once.

use super::read;
use super::settings::Setting;
use crate::declare::report::{Report, messages};
use crate::objective::OBJECTIVES;

/// Checks `kernels`; entries that were reported are left out.
pub(super) fn check(report: &mut Report, setting: Setting<'_>) -> Vec<&'static str> {
    let known = OBJECTIVES.map(|objective| objective.name);
    let words = read::words(report, setting, "kernels");
    let kernel = |(name, place)| {
        let found = known.into_iter().find(|known| *known == name);
        found.or_else(|| report.refuse(place, messages::unknown_kernel(name, &known)))
    };
    words.into_iter().filter_map(kernel).collect()
}
