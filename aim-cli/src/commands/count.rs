//! `aim count`: the operations of what is emitted.

use aim_codegen::{JointOutput, RigPrograms, RigSpec, joint_program};
use serde::Serialize;

use crate::args;
use crate::failure::Result;
use crate::files;

#[derive(Serialize)]
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

/// What the command tells, under the contract's keys.
#[derive(Serialize)]
pub(crate) struct Counts {
    rig: String,
    aim: Count,
    aim_pitch: Count,
    aim_heading: Count,
    aim_gradient: Count,
    chain_value_gradient: Count,
    chain_residual_jacobian: Count,
}

impl Counts {
    pub(crate) fn of(spec: &RigSpec, programs: &RigPrograms) -> Self {
        let single = |outputs: &[JointOutput]| joint_program(spec, 0, outputs).count().into();
        Self {
            rig: spec.name.clone(),
            aim: single(&[JointOutput::Aim]),
            aim_pitch: single(&[JointOutput::ByPitch]),
            aim_heading: single(&[JointOutput::ByHeading]),
            aim_gradient: programs.joints[0].count().into(),
            chain_value_gradient: programs.chain_value_gradient.count().into(),
            chain_residual_jacobian: programs.chain_residual_jacobian.count().into(),
        }
    }

    /// Each count with its name.
    pub(crate) fn rows(&self) -> [(&'static str, &Count); 6] {
        [
            ("aim", &self.aim),
            ("∂aim/∂pitch", &self.aim_pitch),
            ("∂aim/∂heading", &self.aim_heading),
            ("aim and gradient", &self.aim_gradient),
            ("chain: aim and gradient", &self.chain_value_gradient),
            ("chain: residual, Jacobian", &self.chain_residual_jacobian),
        ]
    }

    fn table(&self) -> String {
        let mut out = format!("{}: operations, sines and cosines given, negations free\n", self.rig);
        out += &format!(
            "{:<26}{:>7}{:>6}{:>6}{:>5}{:>6}{:>5}{:>8}\n",
            "", "total", "add", "mul", "div", "sqrt", "pow", "select"
        );
        for (name, c) in self.rows() {
            out += &format!(
                "{name:<26}{:>7}{:>6}{:>6}{:>5}{:>6}{:>5}{:>8}\n",
                c.total, c.add, c.mul, c.div, c.sqrt, c.pow, c.select
            );
        }
        out
    }
}

pub(super) fn run(arguments: &args::Count) -> Result {
    let spec = files::load_rig(&arguments.rig)?;
    let counts = Counts::of(&spec, &RigPrograms::derive(&spec));
    files::print(&if arguments.json { files::to_json(&counts)? } else { counts.table() })
}
