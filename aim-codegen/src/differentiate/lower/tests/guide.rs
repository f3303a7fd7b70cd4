//! Test that the guide names every supported function.

use super::{Algebra, Value};
use crate::differentiate::lower::{arrays, iterators, loop_sequences, methods, optional};
use crate::differentiate::types::Shape;

const GUIDE: &str = include_str!("../../../../../aim-derive/src/differentiate.md");

/// Returns the guide's name of each kind of value, and the names of its functions and methods.
fn callables() -> Vec<(&'static str, Vec<&'static str>)> {
    let of = |shape: Shape| {
        methods::functions_of(&shape).iter().copied().flatten().map(|function| function.name).collect::<Vec<_>>()
    };
    let whole = Value::Integer(Algebra::new().g.input("n"));
    let of_whole = methods::methods_of(&whole).iter().copied().flatten().map(|function| function.name).collect();
    vec![
        ("numbers", of(Shape::Scalar)),
        ("whole numbers", of_whole),
        ("vectors of two", of(Shape::Planar)),
        ("vectors of three", of(Shape::Vector)),
        ("vectors of four", of(Shape::Four)),
        ("quaternions", of(Shape::Quaternion)),
        ("matrices of three columns", of(Shape::Matrix)),
        ("matrices of two or four", [of(Shape::Square(2)), of(Shape::Square(4))].concat()),
        ("transforms", of(Shape::Rigid)),
        ("arrays, slices and lists", arrays::names()),
        ("slices in loops that stay", loop_sequences::METHODS.to_vec()),
        ("iterators", iterators::names()),
        ("options", optional::METHODS.to_vec()),
    ]
}

#[test]
fn the_guide_names_every_function() {
    let rows: Vec<String> = callables()
        .into_iter()
        .map(|(of, mut names)| {
            names.sort_unstable();
            names.dedup();
            format!("| {of} | `{}` |", names.join(" "))
        })
        .collect();
    let missing: Vec<&str> = rows.iter().map(String::as_str).filter(|row| !GUIDE.contains(row)).collect();
    assert!(missing.is_empty(), "aim-derive/src/differentiate.md lacks these rows:\n{}", missing.join("\n"));
}
