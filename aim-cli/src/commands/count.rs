//! `aim count`: the operations of what is emitted.

use aim_codegen::objective::{AIM_GRADIENT, FirstLink, Function, functions};
use aim_codegen::{Kernel, RigSpec, kernels};
use serde::ser::{Serialize, SerializeMap, Serializer};

use crate::args;
use crate::failure::Result;
use crate::files;

#[derive(serde::Serialize)]
pub(crate) struct Count {
    pub(crate) add: usize,
    pub(crate) mul: usize,
    pub(crate) div: usize,
    pub(crate) sqrt: usize,
    pub(crate) pow: usize,
    pub(crate) select: usize,
    pub(crate) total: usize,
}

impl From<aim_symbolic::Count> for Count {
    fn from(count: aim_symbolic::Count) -> Self {
        let aim_symbolic::Count { add, mul, div, sqrt, select, call: _ } = count;
        Self { add, mul, div, sqrt, pow: aim_symbolic::Count::POW, select, total: count.total() }
    }
}

/// The operations of what is emitted for joint 0 and for the chain.
pub(crate) struct Counts {
    rig: String,
    rows: Vec<Row>,
}

/// The count of one program.
pub(crate) struct Row {
    /// Its key in JSON, which is part of the contract.
    key: &'static str,
    /// What readers are told.
    pub(crate) title: String,
    pub(crate) count: Count,
}

impl Counts {
    pub(crate) fn of(spec: &RigSpec, kernels: &[Kernel]) -> Self {
        let first = AIM_GRADIENT.statement(spec, &[0], FirstLink::Given);
        let single = [("aim", "aim"), ("aim_pitch", "∂aim/∂pitch"), ("aim_heading", "∂aim/∂heading")];
        let single = single.into_iter().enumerate().map(|(output, (key, title))| {
            let count = first.program_of(output).count().into();
            Row { key, title: title.to_owned(), count }
        });
        let whole = functions(kernels).into_iter().filter(|function| function.joint.is_none_or(|joint| joint == 0));
        let whole = whole.map(|Function { kernel, joint }| {
            let title = kernel.objective.title;
            let title = if joint.is_some() { title.to_owned() } else { format!("chain: {title}") };
            Row { key: kernel.objective.name, title, count: kernel.program.count().into() }
        });
        Self { rig: spec.name.clone(), rows: single.chain(whole).collect() }
    }

    /// The counts in their order.
    pub(crate) fn rows(&self) -> &[Row] {
        &self.rows
    }

    fn table(&self) -> String {
        let mut out = format!("{}: operations, sines and cosines given, negations free\n", self.rig);
        out += &format!(
            "{:<29}{:>7}{:>6}{:>6}{:>5}{:>6}{:>5}{:>8}\n",
            "", "total", "add", "mul", "div", "sqrt", "pow", "select"
        );
        for Row { title, count: c, .. } in &self.rows {
            out += &format!(
                "{title:<29}{:>7}{:>6}{:>6}{:>5}{:>6}{:>5}{:>8}\n",
                c.total, c.add, c.mul, c.div, c.sqrt, c.pow, c.select
            );
        }
        out
    }
}

impl Serialize for Counts {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(1 + self.rows.len()))?;
        map.serialize_entry("rig", &self.rig)?;
        for Row { key, count, .. } in &self.rows {
            map.serialize_entry(key, count)?;
        }
        map.end()
    }
}

pub(super) fn run(arguments: &args::Count) -> Result {
    let spec = files::load_rig(&arguments.rig)?;
    let counts = Counts::of(&spec, &kernels(&spec));
    files::print(&if arguments.json { files::to_json(&counts)? } else { counts.table() })
}
