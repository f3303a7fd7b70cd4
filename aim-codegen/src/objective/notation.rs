//! Symbols of the objectives' inputs: the paper's letters, where the paper has one.

use aim_symbolic::print::{Formula, Notation};

use super::chain::{HEADING, PITCH};
use super::statement::Scope;
use crate::{Frame, RigSpec};

/// Returns the symbols for the formulas of objectives with this scope.
///
/// **P** is the target; M and **t** are the effector's rotation and position in a joint's space, Lᵢ and **t**ᵢ those of
/// link i; p and h (in a chain pᵢ and hᵢ) are pitch and heading; B is the basis of the bone's axes; **f**, **l**, **u**
/// are the effector's axes; J is a quarter turn.
#[must_use]
pub fn notation(spec: &RigSpec, scope: Scope) -> Notation {
    let mut inputs = vec![("target".to_owned(), Formula::vector("P"))];
    match scope {
        Scope::Joint => {
            inputs.extend([
                ("m".to_owned(), Formula::italic("M")),
                ("m_t".to_owned(), Formula::vector("t")),
                ("p".to_owned(), Formula::italic("p")),
                ("h".to_owned(), Formula::italic("h")),
            ]);
        }
        Scope::Chain => {
            inputs.extend((0..spec.joints.len()).flat_map(|i| {
                [
                    (format!("l{i}"), Formula::italic("L").numbered(i)),
                    (format!("l{i}_t"), Formula::vector("t").numbered(i)),
                    (format!("p{i}"), Formula::italic("p").numbered(i)),
                    (format!("h{i}"), Formula::italic("h").numbered(i)),
                ]
            }));
        }
    }
    let Frame { up, forward, left } = spec.effector.frame;
    let quarter = |angle| Formula::italic("J").indexed(Formula::italic(angle));
    Notation {
        inputs,
        vectors: vec![(forward, Formula::vector("f")), (left, Formula::vector("l")), (up, Formula::vector("u"))],
        bases: basis_symbols(spec).into_iter().map(|(frame, symbol, _)| (images(&frame), symbol)).collect(),
        planes: vec![(HEADING, quarter("h")), (PITCH, quarter("p"))],
        parts: Vec::new(),
        grouped: false,
    }
}

/// Returns each distinct frame with its symbol and the joints that have it. The symbol is B if there is only one frame,
/// else B with the index of the frame's first joint.
#[must_use]
pub fn basis_symbols(spec: &RigSpec) -> Vec<(Frame, Formula, Vec<usize>)> {
    let mut frames: Vec<(Frame, Vec<usize>)> = Vec::new();
    for (i, joint) in spec.joints.iter().enumerate() {
        match frames.iter_mut().find(|(frame, _)| *frame == joint.frame) {
            Some((_, joints)) => joints.push(i),
            None => frames.push((joint.frame, vec![i])),
        }
    }
    let is_one = frames.len() == 1;
    let symbol = |first: usize| {
        let symbol = Formula::italic("B");
        if is_one { symbol } else { symbol.numbered(first) }
    };
    frames.into_iter().map(|(frame, joints)| (frame, symbol(joints[0]), joints)).collect()
}

fn images(frame: &Frame) -> [[f64; 3]; 3] {
    [frame.forward, frame.left, frame.up]
}
