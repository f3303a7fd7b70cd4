//! The sections on the bones' axes and the effects of heading and pitch, on the notation, and on the chain.

use aim_codegen::objective::{HEADING, PITCH, Scope, basis_symbols};
use aim_codegen::{AngleRange, Frame, JointSpec, LimitsFrom, RigSpec};
use aim_symbolic::print::{self, Formula, Notation, Sign};
use aim_symbolic::{Graph, Rotation, Vector, VectorNode};

use super::document::{Block, Drawing, Equation, Inline, Kind, Section, Table, code, text};
use super::drawing;
use super::kernel::{Kernel, joint_names};
use super::statement::Points;
use crate::words;

pub(super) fn section(spec: &RigSpec) -> Section {
    let frames = basis_symbols(spec);
    let mut blocks = vec![
        Block::Paragraph(text![
            "Every bone has its own axes, and only the declaration states which of them points up, forward or left on the \
             character. ",
            Inline::Strong("In every convention, heading turns a bone’s forward towards its left, and pitch turns it towards its up".into()),
            "; pitch is applied first, next to the effector, then heading. Both are added to the animation: 0 leaves it \
             unchanged.",
        ]),
        Block::Drawings(frames.iter().map(|(frame, _, joints)| axes(spec, frame, joints)).collect()),
        Block::Paragraph(text![
            "In the axes forward, left and up, the two rotations are the same for every rig. The formulas here use column vectors: \
             a rotation is written to the left of the vector that it turns. Its columns are the images of forward, left and up.",
        ]),
        Block::Equations(turns()),
        Block::Paragraph(text![
            "Conventions differ only in the components of forward, left and up in the bone’s own axes: the columns of ",
            frames[0].1.clone(),
            if frames.len() > 1 { " and the others." } else { "." },
            " An added rotation therefore changes into these axes, turns, and changes back. In the bone’s own axes it is",
        ]),
    ];
    blocks.extend(frames.iter().map(|(frame, symbol, joints)| Block::Equations(in_bones(spec, frame, symbol, joints))));
    blocks.push(Block::Paragraph(text![
        "The paper uses row vectors, written to the left of the matrix, so its matrices (1) to (3) are the transposes of these, in \
         reverse order. Its pitch has the opposite sign: a positive angle about the thug’s left axis looks down. Here, a \
         positive pitch looks up and a positive heading looks left, whatever the axes.",
    ]));
    Section { id: "conventions", title: "Conventions".into(), blocks }
}

fn axes(spec: &RigSpec, frame: &Frame, joints: &[usize]) -> Drawing {
    let names = joint_names(spec, joints);
    let [up, forward, left] = [frame.up, frame.forward, frame.left].map(axis);
    let hand = if frame.handedness() > 0.0 {
        "a right-handed frame: up × forward = left"
    } else {
        "a left-handed frame: up × forward = −left"
    };
    let mirrored = if frame.handedness() == spec.joints[0].frame.handedness() { "" } else { ", mirrored" };
    let said = format!("up = {up}, forward = {forward}, left = {left}; {hand}{mirrored}");
    let told = format!("The axes of {names}, seen from the character’s front left: {said}.");
    drawing::of_axes(frame, declared_turns(spec, joints), told, text![code(names), format!(": {said}.")])
}

/// Returns for heading and for pitch whether any of these joints has that angle.
fn declared_turns(spec: &RigSpec, joints: &[usize]) -> [bool; 2] {
    let any = |has: fn(&JointSpec) -> bool| joints.iter().any(|&joint| has(&spec.joints[joint]));
    [any(|joint| joint.heading.is_some()), any(|joint| joint.pitch.is_some())]
}

/// Formats a unit vector like [`words::axis`], with a typographic minus sign.
fn axis(v: [f64; 3]) -> String {
    words::axis(v).replace('-', "−")
}

/// Returns the notation for a single joint, in which angles have no joint number.
fn letters(spec: &RigSpec) -> Notation {
    aim_codegen::objective::notation(spec, Scope::Joint)
}

/// Returns the matrices of heading and pitch in the axes forward, left, up.
fn turns() -> Vec<Equation> {
    let mut g = Graph::new();
    let notation = Notation::default();
    [("h", HEADING), ("p", PITCH)]
        .map(|(name, plane)| {
            let angle = g.angle(name);
            let turn = g.turn(plane, angle);
            (print::rotation(&g, turn, &notation), matrix(&mut g, turn, &notation)).into()
        })
        .to_vec()
}

/// Returns the matrix of a rotation; its columns are the images of the axes.
fn matrix(g: &mut Graph, rotation: Rotation, notation: &Notation) -> Formula {
    let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| {
        let axis = g.constant_vector(axis);
        let image = g.rotate(rotation, axis);
        g.in_components(image)
    });
    let row = |k: usize| columns.iter().map(|column| print::scalar(g, column[k], notation)).collect();
    Formula::Matrix((0..3).map(row).collect())
}

/// Returns the matrix of a frame, and those of its joints' heading and pitch in the bone's own axes.
fn in_bones(spec: &RigSpec, frame: &Frame, symbol: &Formula, joints: &[usize]) -> Vec<Equation> {
    let notation = letters(spec);
    let mut g = Graph::new();
    let basis = g.basis([frame.forward, frame.left, frame.up]);
    let mut equations: Vec<Equation> = vec![(symbol.clone(), matrix(&mut g, basis, &notation)).into()];
    for ((name, plane), declared) in [("h", HEADING), ("p", PITCH)].into_iter().zip(declared_turns(spec, joints)) {
        if declared {
            let angle = g.angle(name);
            let turn = g.turn(plane, angle);
            let back = g.transpose(basis);
            let inner = g.compose(turn, back);
            let whole = g.compose(basis, inner);
            equations.push((print::rotation(&g, whole, &notation), matrix(&mut g, whole, &notation)).into());
        }
    }
    equations
}

/// Returns the symbol for an entry of row k of M.
fn entry(axis: usize) -> Formula {
    let index = Formula::Row(vec![Formula::italic("k"), Formula::Number(axis.to_string())]);
    Formula::italic("M").indexed(index)
}

/// Returns the section on symbols.
pub(super) fn notation(spec: &RigSpec) -> Section {
    let letters = letters(spec);
    let [f, l, u] = ["f", "l", "u"].map(Formula::vector);
    let [p, h] = ["p", "h"].map(Formula::italic);
    let function = |function: &str, angle: &Formula| Formula::italic(function).indexed(angle.clone());
    let effector = spec.effector.frame;
    let (v, w) = (Formula::vector("v"), Formula::vector("w"));
    let across =
        Formula::Index(Box::new(v.clone()), Box::new(Formula::Row(vec![Formula::Sign(Sign::Across), w.clone()])));
    let image = Formula::infix(Formula::italic("M"), Sign::Times, Formula::vector("x"));
    let image = Formula::infix(image, Sign::Plus, Formula::vector("t"));
    let i = Formula::italic("i");
    let [forward, left, up] = [effector.forward, effector.left, effector.up].map(axis);
    let rows = [
        [text![Formula::vector("P")], text!["the target, in the joint’s space (of a chain: in the last joint’s)"]],
        [
            text![Formula::italic("M"), ", ", Formula::vector("t")],
            text![
                "from effector space to the joint’s space before its added rotation: the point ",
                Formula::vector("x"),
                " goes to ",
                image,
                "; the image of axis ",
                Formula::italic("k"),
                " has the components ",
                Formula::list((0..3).map(entry)),
                ", in the order of the paper’s rows and of the code’s arrays",
            ],
        ],
        [
            text![Formula::italic("L").indexed(i.clone()), ", ", Formula::vector("t").indexed(i)],
            text!["link i of a chain, in the same way: from the effector to joint 0, then from joint i − 1 to joint i"],
        ],
        [
            text![p.clone(), ", ", h.clone()],
            text!["a joint’s pitch and heading, radians; in a chain with the joint’s number, from the effector inward"],
        ],
        [
            text![function("s", &p), ", ", function("c", &p), ", ", function("s", &h), ", ", function("c", &h)],
            text!["their sines and cosines"],
        ],
        [
            text![f, ", ", l, ", ", u],
            text![format!("the effector’s forward, left and up in its own space: {forward}, {left} and {up}")],
        ],
        [
            text![v.clone(), " · ", w.clone(), ", ", Formula::Bars(Box::new(v.clone()))],
            text!["the dot product of two vectors; the length of a vector"],
        ],
        [text![across], text!["the part of ", v, " perpendicular to ", w]],
        [text![Formula::italic("R").transposed()], text!["the inverse of a rotation, its transpose: R Rᵀ = 1"]],
        [
            text![Formula::italic("ε")],
            text![
                "the threshold for divisions by a length. The reciprocal of a length that does not exceed it counts as 0, so no \
                 input makes a result infinite",
            ],
        ],
    ];
    let rows = rows.map(Vec::from).to_vec();
    Section {
        id: "notation",
        title: "Notation".into(),
        blocks: vec![
            Block::Table(Table::new(Kind::Code, "Symbols of the formulas", &["symbol", "meaning"], rows)),
            Block::Paragraph(text![
                "Two quarter turns occur in derivatives: a vector’s part in the plane of heading, or of pitch, turned by 90°. In the \
                 axes forward, left and up:",
            ]),
            Block::Equations(quarter_turns(&letters)),
        ],
    }
}

/// Returns the components of a vector after a quarter turn in the plane of heading and in that of pitch.
fn quarter_turns(letters: &Notation) -> Vec<Equation> {
    let mut g = Graph::new();
    let v = g.vector_input("v");
    let mut notation = letters.clone();
    notation.inputs.push(("v".into(), Formula::vector("v")));
    [HEADING, PITCH]
        .map(|plane| {
            let turned = g.perp(plane, v);
            let left = print::vector(&g, turned, &notation);
            let components = g.in_components(turned).map(|c| vec![print::scalar(&g, c, &notation)]);
            (left, Formula::Matrix(components.to_vec())).into()
        })
        .to_vec()
}

/// Returns the section on the joints, and on the formula that leads from the effector to the last one.
pub(super) fn chain(spec: &RigSpec, kernel: &Kernel<'_>) -> Section {
    let g = &kernel.derivation.graph;
    let mut blocks = vec![Block::Paragraph(text![
        "Joints from the effector inward. The aimed direction is ",
        code(spec.joints[0].name.clone()),
        format!(
            "’s {}, starting at the point ({}) of its bone.",
            axis(spec.effector.frame.forward),
            spec.effector.origin.map(|c| format!("{c}").replace('-', "−")).join(", ")
        ),
        " This point is the translation of the first link; the caller supplies it, so it does not appear in the formulas.",
    ])];
    blocks.push(Block::Table(joints(spec)));
    blocks.push(Block::Paragraph(text![
        "Each link leads from one joint to the next, and each joint adds its rotation. Applied in order, starting at the \
         effector, they transform a direction from effector space to the last joint’s space:",
    ]));
    if let Some(direction) = direction(g, kernel) {
        let formula = print::vector(g, direction, &kernel.notation);
        blocks.push(Block::Equations(vec![(Formula::upright("direction"), formula).into()]));
    }
    blocks.push(Block::Paragraph(text![
        "Ranges, rates and stiffness concern the solvers: they decide how far a joint may follow the gradient, not what the \
         gradient is. They do not appear in what follows.",
    ]));
    Section { id: "chain", title: "The chain".into(), blocks }
}

/// Returns the effector's direction in the chain's stated aim.
fn direction(g: &Graph, kernel: &Kernel<'_>) -> Option<Vector> {
    let Points { tip, .. } = Points::find(g, kernel.derivation.stated[0])?;
    match g.vector_node(tip) {
        VectorNode::Add(rotated, _) => Some(rotated),
        _ => None,
    }
}

fn joints(spec: &RigSpec) -> Table {
    let head = ["", "joint", "bone", "heading", "pitch", "rate", "stiffness", "more"];
    let rows = spec.joints.iter().enumerate().map(|(number, joint)| {
        vec![
            text![number.to_string()],
            text![code(joint.name.clone())],
            text![code(joint.bones.join(" or "))],
            text![range(joint.heading)],
            text![range(joint.pitch)],
            text![format!("{}/s", degrees(joint.rate))],
            text![format!("{}", joint.stiffness)],
            text![more(joint)],
        ]
    });
    Table::new(Kind::Facts, "The joints, from the effector inward", &head, rows.collect())
}

fn more(joint: &JointSpec) -> String {
    let mut more = Vec::new();
    more.extend(joint.other_eye.as_ref().map(|pair| format!("with {pair}")));
    more.extend((joint.limits_from == LimitsFrom::BindPose).then(|| "ranges from the bind pose".to_owned()));
    more.extend(joint.upright.map(|upright| format!("upright {upright}")));
    more.extend(joint.acceleration.map(|limit| format!("acceleration {}/s²", degrees(limit))));
    more.extend(joint.pitch_taper.map(|part| format!("pitch taper {part}")));
    more.join(", ")
}

fn range(range: Option<AngleRange>) -> String {
    match range {
        None => "none".into(),
        Some(AngleRange::Free) => "free".into(),
        Some(AngleRange::Between(low, high)) => format!("{}\u{a0}…\u{a0}{}", degrees(low), degrees(high)),
    }
}

/// Formats an angle in degrees as it was declared, without the rounding error of its conversion to radians.
fn degrees(radians: f64) -> String {
    let rounded = (radians.to_degrees() * 1e6).round() / 1e6;
    format!("{rounded}°").replace('-', "−")
}
