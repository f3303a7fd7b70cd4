//! `aim count`: counts the operations of the emitted code.

use aim_codegen::objective::{AIM_GRADIENT, FirstLink, Function, functions};
use aim_codegen::{Kernel, RigSpec, kernels};
use aim_symbolic::Count;
use serde_json::{Value, json};

use crate::args;
use crate::failure::Result;
use crate::files;

/// Returns the numbers of a count, each under its JSON key. Users rely on these keys.
pub(crate) fn numbers(count: Count) -> [(&'static str, usize); 7] {
    let Count { add, mul, div, sqrt, select, call: _, series: _ } = count;
    let (total, pow) = (count.total(), Count::POW);
    [("total", total), ("add", add), ("mul", mul), ("div", div), ("sqrt", sqrt), ("pow", pow), ("select", select)]
}

/// Operation counts of the code emitted for joint 0 and for the chain.
pub(crate) struct Counts {
    rig: String,
    rows: Vec<Row>,
}

/// Operation count of one program.
pub(crate) struct Row {
    /// Key in the JSON output, which users rely on.
    key: &'static str,
    /// Name of the program for readers.
    pub(crate) title: String,
    pub(crate) count: Count,
}

impl Counts {
    pub(crate) fn of(spec: &RigSpec, kernels: &[Kernel]) -> Self {
        let first = AIM_GRADIENT.statement(spec, &[0], FirstLink::Given);
        let single = [("aim", "aim"), ("aim_pitch", "∂aim/∂pitch"), ("aim_heading", "∂aim/∂heading")];
        let single = single.into_iter().enumerate().map(|(output, (key, title))| Row {
            key,
            title: title.to_owned(),
            count: first.program_of(output).count(),
        });
        let whole = functions(kernels).into_iter().filter(|function| function.joint.is_none_or(|joint| joint == 0));
        let whole = whole.map(|Function { kernel, joint }| {
            let title = kernel.objective.title;
            let title = if joint.is_some() { title.to_owned() } else { format!("chain: {title}") };
            Row { key: kernel.objective.name, title, count: kernel.program.count() }
        });
        Self { rig: spec.name.clone(), rows: single.chain(whole).collect() }
    }

    /// Returns the counts, in the order of the table.
    pub(crate) fn rows(&self) -> &[Row] {
        &self.rows
    }

    fn table(&self) -> String {
        const WIDTHS: [usize; 7] = [7, 6, 6, 5, 6, 5, 8];
        let row = |title: &str, cells: [String; 7]| {
            let cells = cells.iter().zip(WIDTHS).map(|(cell, width)| format!("{cell:>width$}"));
            format!("{title:<29}{}\n", cells.collect::<String>())
        };
        let head = row("", numbers(Count::default()).map(|(key, _)| key.to_owned()));
        let rows =
            self.rows.iter().map(|one| row(&one.title, numbers(one.count).map(|(_, number)| number.to_string())));
        let rows: String = rows.collect();
        format!("{}: operation counts (sines and cosines are inputs, negations are free)\n{head}{rows}", self.rig)
    }

    fn json(&self) -> Value {
        let mut json = json!({ "rig": self.rig });
        for Row { key, count, .. } in &self.rows {
            json[key] = numbers(*count).into_iter().collect();
        }
        json
    }
}

pub(super) fn run(arguments: &args::Count) -> Result {
    let spec = files::load_rig(&arguments.rig)?;
    let counts = Counts::of(&spec, &kernels(&spec));
    files::print(&if arguments.json { files::to_json(&counts.json())? } else { counts.table() })
}
