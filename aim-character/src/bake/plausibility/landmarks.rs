//! The bones by which a pose is judged: the head, the chest that carries it, and the arms on the chest.

use aim_model::BoneName;
use aim_runtime::Rig;

use crate::bake::Plan;
use crate::measure::arms::name_of;
use crate::measure::limbs::limbs_on;
use crate::measure::roles::Role;
use crate::measure::stance::BodyKind;
use aim_gltf::Skeleton;

/// Node indices of the judged bones.
pub(super) struct Landmarks {
    /// The head, or the outermost bone of the neck if there is no head.
    pub(super) head: Option<usize>,
    /// The bone that carries neck and head. `Some` exactly if `head` is.
    pub(super) chest: Option<usize>,
    /// First bones and hands of the arms on the chest.
    pub(super) limbs: Vec<usize>,
    /// `true` if the trunk below the head is upright in the bind pose and the body is a human's by its limbs; `false` if
    /// head or hips are unknown.
    pub(super) is_humanoid: bool,
}

/// Cosine of the largest lean of an upright trunk in the bind pose (45°). The trunks of four-legged animals are level.
const UPRIGHT: f64 = core::f64::consts::FRAC_1_SQRT_2;
const HANDS: &str = "hand palm wrist 手首";

impl Landmarks {
    pub(super) fn find(rig: &dyn Rig, plan: &Plan<'_>) -> Self {
        let (skeleton, measurement) = (plan.document.skeleton(), plan.measurement);
        let joints = rig.description().joints();
        let is_head = |node: usize| {
            let declared = plan.chain.joints.iter().position(|joint| *joint == node).map(|joint| joints[joint].role);
            matches!(declared, Some(aim_runtime::Role::Head | aim_runtime::Role::Neck))
                || matches!(measurement.bone(node).and_then(|bone| bone.role), Some(Role::Head | Role::Neck))
        };
        // From the effector inward. A rig that aims something else has no head to be judged.
        let mut inward = skeleton.ancestry(plan.chain.joints[0]).skip_while(|node| !is_head(*node)).peekable();
        let head = inward.peek().copied();
        let chest = inward.find(|node| !is_head(*node));
        let head = head.filter(|_| chest.is_some());
        let limbs = chest.map_or_else(Vec::new, |chest| {
            limbs_on(skeleton, measurement, chest).into_iter().flat_map(|limb| [limb, hand(skeleton, limb)]).collect()
        });
        let at = |node: usize| measurement.bind_world[node].translation;
        let hips = measurement.with_role(Role::Hips).map(|bone| bone.node);
        let trunk = head.zip(chest).zip(hips).map(|((head, chest), hips)| {
            // If the hips carry the neck directly, use the direction to the head.
            at(if hips == chest { head } else { chest }) - at(hips)
        });
        let is_humanoid = measurement.kind == BodyKind::Human
            && trunk.is_some_and(|trunk| trunk.normalize_or_zero().dot(measurement.up) > UPRIGHT);
        Self { head, chest, limbs, is_humanoid }
    }
}

/// Returns the hand of an arm: the first bone with the name of a hand, otherwise the end of the longest branch.
fn hand(skeleton: &Skeleton, limb: usize) -> usize {
    let (mut level, mut last) = (vec![limb], limb);
    while let Some(&first) = level.first() {
        if let Some(&hand) = level.iter().find(|node| BoneName::new(name_of(skeleton, **node)).has(HANDS)) {
            return hand;
        }
        last = first;
        level = level.iter().flat_map(|node| skeleton.children(*node)).collect();
    }
    last
}
