//! The README's table of operation counts, counted in emitted C. `AIM_BLESS=1 cargo test -p aim-tests --test it counts`
//! writes it.

use aim_codegen::emit::{self, Precision, Procedure, Rig};
use aim_codegen::{EffectorSpec, Frame, RigSpec, kernels};
use aim_symbolic::{Count, Program};
use aim_tests::c;
use aim_tests::page::hold_table;
use aim_tests::problems::{self, Problem};
use aim_tests::random::Random;
use aim_tests::rigs::{bare_joint, general_frame};

const MARKS: [&str; 2] = ["<!-- counts: begin -->\n", "<!-- counts: end -->\n"];

fn cardinal(_: &mut Random) -> Frame {
    Frame::cardinal().next().expect("there are 48")
}

/// Returns the operations in the C of a rig with this number of joints: of its first joint alone, and of the chain.
fn counted(joints: usize, frame: fn(&mut Random) -> Frame) -> [Count; 2] {
    let random = &mut Random::new(7);
    let joints: Vec<_> = (0..joints).map(|i| bare_joint(i, frame(random), true, true)).collect();
    let effector = EffectorSpec { frame: joints[0].frame, origin: [0.0; 3] };
    let name = format!("rig_{}_aim_gradient", joints[0].name);
    let spec = RigSpec { name: "Rig".into(), joints, effector, natural: None, region: None, kernels: Vec::new() };
    let source = emit::c::emit(&Rig { spec: &spec, kernels: &kernels(&spec) });
    [name.as_str(), "rig_chain_value_gradient"].map(|name| c::count(c::function(&source, name).1))
}

/// Describes the chain's counts from two joints on as a N − b, exact or as a close upper bound.
fn of_chain(frame: fn(&mut Random) -> Frame) -> String {
    let counts = [2, 3, 4, 7].map(|joints| (joints, counted(joints, frame)[1].total()));
    let slope = (counts[3].1 - counts[0].1).div_ceil(5);
    let less = counts.map(|(joints, count)| slope * joints - count);
    let least = less.into_iter().min().unwrap_or_default();
    assert!(less.iter().all(|less| less - least < counts.len()), "{counts:?}");
    if less == [least; 4] { format!("**{slope}N − {least}**") } else { format!("at most **{slope}N − {least}**") }
}

fn of_problem(Problem { g, wanted, .. }: &Problem) -> Count {
    let program = &Program::derive_wanted(g, wanted);
    let parameters = vec![("inputs".to_owned(), Some(program.inputs().len()))];
    let (name, precision) = ("problem".to_owned(), Precision::Double);
    let procedure = Procedure { name, doc: Vec::new(), parameters, precision, program };
    let source = emit::c::emit_procedures("problem", &[procedure]);
    c::count(c::function(&source, "problem").1)
}

#[test]
fn the_readme_has_the_counts_of_what_is_emitted() {
    let [joint, _] = counted(1, cardinal);
    assert_eq!((joint.sqrt, joint.div), (1, 1));
    let rows = [
        (
            "one joint: aim and both derivatives",
            format!("**{}**, one square root, one division", joint.total()),
            "1087",
            "57",
        ),
        ("N ≥ 2 joints: aim and 2N derivatives", of_chain(cardinal), "–", "75N − 12"),
        (
            "one joint whose bone axes are any directions",
            format!("**{}**", counted(1, general_frame)[0].total()),
            "–",
            "–",
        ),
        ("N ≥ 2 of those", of_chain(general_frame), "–", "–"),
        (
            "three points’ as-rigid-as-possible term and its nine derivatives",
            format!("**{}**", of_problem(&problems::arap_term()).total()),
            "–",
            "103",
        ),
    ];
    let mut table = String::from("| problem | `aim` | expanded and pasted | best other tool |\n|---|---|---|---|\n");
    for (problem, derived, pasted, other) in rows {
        table += &format!("| {problem} | {derived} | {pasted} | {other} |\n");
    }
    hold_table("README.md", MARKS, &table, "counts");
}
