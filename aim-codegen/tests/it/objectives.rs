//! A custom objective is a constant that every back end emits.

use aim_codegen::emit::{self, Rig};
use aim_codegen::objective::{Chain, FirstLink, Scope};
use aim_codegen::{Frame, Objective};
use aim_symbolic::print::Formula;
use aim_symbolic::{Graph, Scalar};

use crate::counts::rig;

/// Squared distance from the effector to the target.
const SQUARED_DISTANCE: Objective = Objective {
    name: "chain_squared_distance",
    title: "squared distance and gradient",
    scope: Scope::Chain,
    outputs: |_, angles| format!("The squared distance, then its {angles} derivatives."),
    symbols: || vec![Formula::italic("d")],
    state,
};

fn state(g: &mut Graph, chain: &Chain<'_>) -> Vec<Scalar> {
    let origin = chain.effector_at_end(g).origin;
    let way = g.sub_vectors(chain.inputs.target, origin);
    vec![g.dot(way, way)]
}

#[test]
fn a_user_defined_objective_is_emitted_in_every_language() {
    let spec = rig(2, Frame::cardinal().next().expect("there are 48"));
    let kernels = SQUARED_DISTANCE.kernels(&spec, FirstLink::Given);
    let rig = Rig { spec: &spec, kernels: &kernels };
    let count = kernels[0].program.count().to_string();
    type Emit = fn(&Rig<'_>) -> String;
    let languages: [(Emit, &str); 3] = [
        (
            emit::c::emit,
            "void rig_chain_squared_distance(const float links[24], const float target[3], const float sin_cos[8],\n    float out[5])\n{",
        ),
        (emit::wgsl::emit, "fn rig_chain_squared_distance(\n    links: array<f32, 24>,"),
        (emit::maxima::emit, "rig_chain_squared_distance("),
    ];
    for (emit, signature) in languages {
        let text = emit(&rig);
        for expected in [signature, "The squared distance, then its 4 derivatives.", &count] {
            assert!(text.contains(expected), "{expected} is not in\n{text}");
        }
    }
}

#[test]
fn a_first_link_that_is_the_identity_is_not_read() {
    for frame in Frame::cardinal() {
        let spec = rig(3, frame);
        let [given, identity] = [FirstLink::Given, FirstLink::Identity]
            .map(|link| aim_codegen::objective::CHAIN_RESIDUAL_JACOBIAN.kernels(&spec, link).remove(0).program);
        assert!(identity.count().total() < given.count().total(), "{}", identity.count());
        assert_eq!(given.inputs(), identity.inputs());
        // With an identity first link, both programs give the same results, up to rounding.
        let link = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
        let (mut inputs, turned) = (link.to_vec(), [0.8, 0.6, 0.0, -0.6, 0.8, 0.0, 0.0, 0.0, 1.0, 0.02, 0.1, 0.05]);
        inputs.extend(turned.repeat(2));
        inputs.extend([1.3, 2.1, -0.7]);
        inputs.extend([0.28, 0.96, -0.6, 0.8].repeat(3));
        let outputs = [given, identity].map(|program| {
            let mut outputs = vec![0.0; program.outputs().len()];
            program.run(&inputs, &mut outputs);
            inputs[..12].fill(f64::NAN);
            outputs
        });
        for (given, identity) in outputs[0].iter().zip(&outputs[1]) {
            assert!((given - identity).abs() < 1e-12, "{outputs:?}");
        }
    }
}
