//! Bakes a character in process, with the libraries behind the command.

use aim_animation::Clip;
use aim_character::{
    Baked, ChainNodes, InterpretedRig, Measurement, Plan, Plausibility, Settle, bake, chain_nodes, propose,
};
use aim_codegen::RigSpec;
use aim_gltf::Document;
use aim_runtime::glam::DVec3;
use aim_runtime::{DynAim, Settings};

pub(crate) struct Character {
    pub(crate) document: Document,
    pub(crate) measurement: Measurement,
    pub(crate) spec: RigSpec,
    pub(crate) chain: ChainNodes,
}

/// Parameters of a bake.
#[derive(Clone, Copy)]
pub(crate) struct Order {
    pub(crate) seconds: f32,
    pub(crate) settle: Settle,
    pub(crate) settings: Settings,
}

impl Order {
    /// Returns the command's default settings for this duration, seconds.
    pub(crate) fn of(seconds: f32) -> Self {
        Self { seconds, settle: Settle::Snap, settings: Settings::default() }
    }
}

impl Character {
    /// Loads a model with the rig that is proposed for it.
    pub(crate) fn new(model: &[u8]) -> Self {
        let document = Document::from_bytes(model).expect("a sound model");
        let measurement = Measurement::of(&document);
        let spec = propose(&document, &measurement, None).expect("a rig").spec;
        let chain = chain_nodes(&spec, document.skeleton()).expect("its bones");
        Self { document, measurement, spec, chain }
    }

    /// Returns the index of the node with this name.
    pub(crate) fn node(&self, name: &str) -> usize {
        self.document.skeleton().find(name).expect("a bone")
    }

    /// Bakes, applies `change` to the clip, writes it, and measures the result.
    pub(crate) fn measure(
        &self,
        order: Order,
        target: impl Fn(f64) -> DVec3,
        change: impl FnOnce(&mut Clip),
    ) -> (Baked, Plausibility) {
        let Self { document, measurement, spec, chain } = self;
        let plan = Plan {
            document,
            clip: document.clips().first(),
            measurement,
            chain,
            both_eyes: false,
            seconds: order.seconds,
            fps: 60.0,
            settle: order.settle,
            looped: false,
            settings: order.settings,
            target_node: None,
        };
        let mut character = DynAim::new(InterpretedRig::new(spec));
        let mut baked = bake(&mut character, &plan, |t, _| target(t.into()), |_, _| {}).expect("a bake");
        change(&mut baked.clip);
        let written = document.with_clips(std::slice::from_ref(&baked.clip)).expect("it can be written");
        let written = Document::from_bytes(&written).expect("it can be read");
        let measured = Plausibility::measure(&character.rig, &plan, &baked, &written).expect("the clip is there");
        (baked, measured)
    }

    /// Bakes with default settings and without changes, and measures the result.
    pub(crate) fn bake(&self, seconds: f32, target: impl Fn(f64) -> DVec3) -> Plausibility {
        self.measure(Order::of(seconds), target, |_| {}).1
    }

    /// Returns the effector's position in the bind pose.
    pub(crate) fn eye(&self) -> DVec3 {
        self.measurement.bind_world[self.chain.joints[0]].transform_point3(self.spec.effector.origin.into())
    }

    /// Returns the point at this distance from the eye, to its left and above by these angles in degrees. Distances are
    /// in metres of a character 1.7 m tall.
    pub(crate) fn seen_at(&self, metres: f64, left_deg: f64, above_deg: f64) -> DVec3 {
        let &Measurement { forward, left, up, .. } = &self.measurement;
        let ((sin, cos), (above, level)) = (left_deg.to_radians().sin_cos(), above_deg.to_radians().sin_cos());
        self.eye() + ((forward * cos + left * sin) * level + up * above) * (metres * self.measurement.metre())
    }
}
