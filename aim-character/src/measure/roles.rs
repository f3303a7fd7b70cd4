//! Roles of nodes (eyes, head, neck, spine, hips): from VRM if stated, otherwise from names.

use core::cmp::Reverse;
use core::fmt;

use aim_model::{BodyPart, BoneName, Side};

use crate::measure::plan::BodyPlan;
use aim_gltf::{Node, Skeleton};

/// The part that a bone plays in aiming.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Role {
    /// The eyeball on the character's left.
    LeftEye,
    /// The eyeball on the character's right.
    RightEye,
    /// Both eyes together, if the file turns them together by morph targets.
    Eyes,
    /// The head.
    Head,
    /// A bone of the neck.
    Neck,
    /// A bone of the trunk above the hips.
    Spine,
    /// The pelvis.
    Hips,
}

impl Role {
    /// Returns `left_eye`, `right_eye`, `eyes`, `head`, `neck`, `spine` or `hips`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::LeftEye => "left_eye",
            Self::RightEye => "right_eye",
            Self::Eyes => "eyes",
            Self::Head => "head",
            Self::Neck => "neck",
            Self::Spine => "spine",
            Self::Hips => "hips",
        }
    }
}

impl fmt::Display for Role {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

/// The roles of a document's nodes.
#[derive(Debug, Clone)]
pub(crate) struct Roles(Vec<Option<Role>>);

impl Roles {
    /// Returns the role of a node.
    pub(crate) fn of(&self, node: usize) -> Option<Role> {
        self.0.get(node).copied().flatten()
    }

    /// Finds roles by VRM and by name. Eyes without a side in their name get no role.
    pub(crate) fn find(skeleton: &Skeleton) -> Self {
        let words: Vec<BoneName> = skeleton.names().iter().map(|name| BoneName::new(name)).collect();
        let bones = bones(skeleton);
        let stated_role = |node: usize| vrm_role(&skeleton.nodes()[node]);
        let mut roles: Vec<Option<Role>> =
            (0..skeleton.len()).map(|node| stated_role(node).filter(|_| skeleton.is_in_file(node))).collect();
        let stated: Vec<Role> = roles.iter().copied().flatten().collect();
        // If any bone is named an eyeball, other bones named eyes are lids.
        let balls = words.iter().zip(&bones).any(|(w, bone)| *bone && w.is_eyeball());
        for (index, words) in words.iter().enumerate() {
            if roles[index].is_some() || !skeleton.is_in_file(index) {
                continue;
            }
            let role = by_name(words).filter(|role| match role {
                Role::LeftEye | Role::RightEye => !balls || words.is_eyeball(),
                _ => true,
            });
            // An eye may be a plain node with its own mesh, below a bone of the head.
            let eye = matches!(role, Some(Role::LeftEye | Role::RightEye));
            let allowed = bones[index] || (eye && skeleton.ancestry(index).any(|at| bones[at]));
            roles[index] = role.filter(|role| allowed && !stated.contains(role));
        }
        rigify(skeleton, &words, &bones, &mut roles);
        // If no bone is called a head, the skin may be bound to control bones: read their names without the words for
        // controls.
        if !roles.contains(&Some(Role::Head)) {
            let found = roles.clone();
            for (index, words) in words.into_iter().enumerate().filter(|(index, _)| skeleton.is_in_file(*index)) {
                let role = by_name(&words.without_control()).filter(|role| !found.contains(&Some(*role)));
                roles[index] = roles[index].or(role.filter(|_| skeleton.nodes()[index].is_joint));
            }
        }
        keep_best(skeleton, &mut roles);
        keep_carrying(skeleton, &mut roles);
        let is_eye = |role: &Role| matches!(role, Role::LeftEye | Role::RightEye);
        // Morph targets are eyes only if no bone is an eye.
        let has_eyes = roles.iter().flatten().any(is_eye);
        for eye in skeleton.morph_eyes() {
            roles[eye.node] = stated_role(eye.node).filter(|role| !(has_eyes && is_eye(role)));
        }
        Self(roles)
    }
}

impl Roles {
    /// Adds the roles that names leave open, from the body plan: all of them if no name has a role, otherwise those of
    /// head, hips and neck that are missing. Returns `true` if any role was added.
    pub(crate) fn complete(&mut self, skeleton: &Skeleton, plan: &BodyPlan) -> bool {
        let before = self.0.clone();
        let nameless = self.0.iter().all(Option::is_none);
        let known = |roles: &[Option<Role>], role| roles.iter().position(|of| *of == Some(role));
        // Of numbered necks the last one is the head.
        let last_neck =
            self.of(plan.head) == Some(Role::Neck) && plan.neck.iter().any(|n| self.of(*n) == Some(Role::Neck));
        if known(&self.0, Role::Head).is_none() && (self.of(plan.head).is_none() || last_neck) {
            self.0[plan.head] = Some(Role::Head);
        }
        let Some(head) = known(&self.0, Role::Head) else { return false };
        if known(&self.0, Role::Hips).is_none() && skeleton.ancestry(head).any(|node| node == plan.hips) {
            self.0[plan.hips].get_or_insert(Role::Hips);
        }
        if known(&self.0, Role::Neck).is_none() {
            let neck = if head == plan.head { plan.neck.clone() } else { neck_of(skeleton, head) };
            neck.into_iter().for_each(|node| {
                self.0[node].get_or_insert(Role::Neck);
            });
        }
        // Every bone between a named neck bone and the head is a neck bone.
        let carry = || skeleton.ancestry(head).skip(1);
        if let Some(gap) = carry().position(|node| self.of(node) == Some(Role::Neck)) {
            carry().take(gap).for_each(|node| {
                self.0[node].get_or_insert(Role::Neck);
            });
        }
        if nameless {
            plan.trunk.iter().for_each(|node| self.0[*node] = Some(Role::Spine));
        }
        self.0 != before
    }
}

/// Returns the bones between the head and the trunk, excluding both; none if there is no trunk.
fn neck_of(skeleton: &Skeleton, head: usize) -> Vec<usize> {
    let trunk = trunk_of(skeleton, head);
    skeleton.ancestry(head).skip(1).take_while(|node| trunk.is_some_and(|trunk| *node != trunk)).collect()
}

/// Returns the nearest ancestor of the head that also carries limbs with a side.
pub(crate) fn trunk_of(skeleton: &Skeleton, head: usize) -> Option<usize> {
    let has_side: Vec<bool> = skeleton.names().iter().map(|name| BoneName::new(name).side.is_some()).collect();
    let carries_side = carrying(skeleton, &has_side);
    let way: Vec<usize> = skeleton.ancestry(head).collect();
    let is_limb = |child: usize| has_side[child] || carries_side[child];
    let carries_limbs = |step: &&[usize]| skeleton.children(step[1]).any(|child| child != step[0] && is_limb(child));
    way.windows(2).find(carries_limbs).map(|step| step[1])
}

/// Returns, for each node, whether any of `these` is a descendant of it.
pub(crate) fn carrying(skeleton: &Skeleton, these: &[bool]) -> Vec<bool> {
    let mut carries = vec![false; these.len()];
    for node in (0..these.len()).rev() {
        if let Some(parent) = skeleton.parents()[node] {
            carries[parent] |= these[node] || carries[node];
        }
    }
    carries
}

/// Returns, for each node, whether it is a bone: a joint or the ancestor of one; in a file without skins, every node.
pub(crate) fn bones(skeleton: &Skeleton) -> Vec<bool> {
    let nodes = skeleton.nodes();
    let is_bone = |(at, node): (usize, &Node)| node.is_joint || (!skeleton.has_skin() && skeleton.is_in_file(at));
    let mut bones: Vec<bool> = nodes.iter().enumerate().map(is_bone).collect();
    for index in (0..skeleton.len()).rev() {
        if let (true, Some(parent)) = (bones[index], skeleton.parents()[index]) {
            bones[parent] = true;
        }
    }
    bones
}

fn vrm_role(node: &Node) -> Option<Role> {
    Some(match node.vrm_bone.as_deref()? {
        "leftEye" => Role::LeftEye,
        "rightEye" => Role::RightEye,
        "eyes" => Role::Eyes,
        "head" => Role::Head,
        "neck" => Role::Neck,
        "spine" | "chest" | "upperChest" => Role::Spine,
        "hips" => Role::Hips,
        _ => return None,
    })
}

/// Returns the role by name. An eye without a side has none.
fn by_name(name: &BoneName) -> Option<Role> {
    Some(match name.body_part()? {
        BodyPart::Eye(Some(Side::Left)) => Role::LeftEye,
        BodyPart::Eye(Some(Side::Right)) => Role::RightEye,
        BodyPart::Eye(None) => return None,
        BodyPart::Head => Role::Head,
        BodyPart::Neck => Role::Neck,
        BodyPart::Spine => Role::Spine,
        BodyPart::Hips => Role::Hips,
    })
}

/// Assigns roles in a Rigify armature. It numbers a single column `spine`, `spine.001` … `spine.006` and on: from the
/// pelvis in people, from the tip of the tail in animals. The end with the highest number is the head.
fn rigify(skeleton: &Skeleton, words: &[BoneName], bones: &[bool], roles: &mut [Option<Role>]) {
    let any = |roles: &[Option<Role>], role| roles.contains(&Some(role));
    let in_column: Vec<bool> = words.iter().zip(bones).map(|(words, bone)| *bone && words.has("spine")).collect();
    let number = |node: &usize| words[*node].number().unwrap_or(0);
    let column = || (0..words.len()).filter(|node| in_column[*node]);
    if any(roles, Role::Head) || any(roles, Role::Neck) || column().all(|node| number(&node) != 6) {
        return;
    }
    let carries_more = carrying(skeleton, &in_column);
    // Among several, a joint is preferred, then the shortest name.
    let rank = |node: &usize| (number(node), skeleton.nodes()[*node].is_joint, Reverse(skeleton.names()[*node].len()));
    let Some(head) = column().filter(|node| !carries_more[*node]).max_by_key(rank) else { return };
    let neck: Vec<usize> = match trunk_of(skeleton, head) {
        Some(trunk) if in_column[trunk] => neck_of(skeleton, head),
        // If only deforming bones were exported, limbs hang on bones outside the column. The neck is then the two bones
        // below the head, as in people.
        _ => column().filter(|node| (1..=2).any(|below| number(node) + below == number(&head))).collect(),
    };
    neck.into_iter().for_each(|node| roles[node] = Some(Role::Neck));
    roles[head] = Some(Role::Head);
    if !any(roles, Role::Hips) {
        let hangs_on_none = |node: &usize| skeleton.parents()[*node].is_none_or(|parent| !in_column[parent]);
        let hips = column().filter(hangs_on_none).min_by_key(number);
        hips.into_iter().for_each(|node| roles[node] = Some(Role::Hips));
    }
}

/// If a neck bone carries the head, removes the role from neck bones that do not (such as bones of a face or a collar).
fn keep_carrying(skeleton: &Skeleton, roles: &mut [Option<Role>]) {
    let Some(head) = roles.iter().position(|role| *role == Some(Role::Head)) else { return };
    let mut carries = vec![false; roles.len()];
    skeleton.ancestry(head).for_each(|node| carries[node] = true);
    let is_neck = |node: usize| roles[node] == Some(Role::Neck);
    let necks: Vec<usize> = (0..roles.len()).filter(|node| is_neck(*node)).collect();
    if necks.iter().any(|node| carries[*node]) {
        necks.iter().filter(|node| !carries[**node]).for_each(|node| roles[*node] = None);
    }
}

/// Resolves several claims to a single role: a VRM bone wins, then a joint, then the shortest name, then the first.
fn keep_best(skeleton: &Skeleton, roles: &mut [Option<Role>]) {
    let (nodes, names) = (skeleton.nodes(), skeleton.names());
    for role in [Role::LeftEye, Role::RightEye, Role::Head, Role::Hips] {
        let claimants: Vec<usize> = (0..nodes.len()).filter(|i| roles[*i] == Some(role)).collect();
        let rank = |i: &&usize| (nodes[**i].vrm_bone.is_none(), !nodes[**i].is_joint, names[**i].len(), **i);
        let best = claimants.iter().min_by_key(rank).copied();
        claimants.iter().filter(|i| Some(**i) != best).for_each(|i| roles[*i] = None);
    }
}
