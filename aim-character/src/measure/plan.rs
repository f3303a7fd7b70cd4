//! The body plan: legs, trunk, arms, neck and head, found without names from the tree of bones and their positions.

use aim_runtime::glam::{DAffine3, DVec3};

use aim_gltf::Skeleton;

/// Largest difference between the lengths of the limbs of a pair, as a share of the length.
const ALIKE: f64 = 0.05;
/// Largest distance of a bone on the plane of symmetry from that plane, as a share of the distance between two limbs.
const MIDDLE: f64 = 0.15;
/// Cosine between the axes of two pairs above which they mirror across the same plane.
const PARALLEL: f64 = 0.97;
/// Largest difference between two heights that count as equal, as a share of the distance from hips to head.
const LEVEL: f64 = 0.02;
/// Largest distance between bones at the same position, as a share of their limb's length.
const ONE_PLACE: f64 = 1e-3;
/// Least length of arms, as a share of the longest pair of limbs on the column, which may be hair. Shorter pairs are
/// passed over.
const ARM: f64 = 0.5;
/// Largest tree that is searched: the work grows with the square of the number of bones.
const MOST_BONES: usize = 4096;
/// Largest number of limbs of one bone that are compared: the work grows with its square.
const MOST_LIMBS: usize = 64;

/// Node indices of the parts of a body with mirror symmetry.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BodyPlan {
    /// Bone that carries both legs.
    pub(crate) hips: usize,
    /// Bones from above the hips to where the arms (or forelegs) begin.
    pub(crate) trunk: Vec<usize>,
    /// Bones from the trunk to the head, without the head.
    pub(crate) neck: Vec<usize>,
    /// Bone of the column that carries most of the skin above the trunk.
    pub(crate) head: usize,
    /// First bones of the two legs; which one is left is unknown.
    pub(crate) legs: [usize; 2],
    /// First bones of the two arms (or forelegs): the longest pair on trunk and neck.
    pub(crate) arms: [usize; 2],
}

/// The tree of bones, with data for comparing limbs.
struct Tree<'a> {
    skeleton: &'a Skeleton,
    bind: &'a [DAffine3],
    is_bone: &'a [bool],
    /// For each node, a number that is equal for subtrees with the same branching.
    shape: Vec<u64>,
    /// Number of bones in each node's subtree.
    size: Vec<usize>,
}

impl Tree<'_> {
    fn children(&self, node: usize) -> impl Iterator<Item = usize> + '_ {
        self.skeleton.children(node).filter(|child| self.is_bone[*child])
    }

    fn at(&self, node: usize) -> DVec3 {
        self.bind[node].translation
    }

    /// Returns the pairs among a node's children that are limbs mirrored in a plane through the node (perpendicular to
    /// `across`, if it is given).
    fn pairs(&self, node: usize, across: Option<DVec3>) -> Vec<[usize; 2]> {
        let limbs: Vec<usize> = self.children(node).filter(|child| self.size[*child] >= 2).take(MOST_LIMBS).collect();
        let mut pairs = Vec::new();
        for (k, a) in limbs.iter().enumerate() {
            for b in &limbs[k + 1..] {
                if self.are_mirrored(node, [*a, *b], across) {
                    pairs.push([*a, *b]);
                }
            }
        }
        pairs
    }

    fn are_mirrored(&self, node: usize, [a, b]: [usize; 2], across: Option<DVec3>) -> bool {
        if self.shape[a] != self.shape[b] {
            return false;
        }
        let [a, b] = self.parting([a, b]);
        let [p, q, from] = [a, b, node].map(|node| self.at(node));
        let apart = p - q;
        let (one, other) = (p.distance(from), q.distance(from));
        let length = self.length(a);
        let unit = apart.normalize_or_zero();
        unit != DVec3::ZERO
            && (one - other).abs() < ALIKE * one.max(other)
            && (length - self.length(b)).abs() < ALIKE * length
            && ((p + q) * 0.5 - from).dot(unit).abs() < MIDDLE * apart.length()
            && across.is_none_or(|across| across.dot(unit).abs() > PARALLEL)
    }

    /// Returns the first bones of the widest pair: fingers and clothes are closer together than limbs.
    fn pair(&self, node: usize, across: Option<DVec3>) -> Option<[usize; 2]> {
        let wide = |[a, b]: &[usize; 2]| self.at(*a).distance(self.at(*b));
        self.pairs(node, across).into_iter().map(|pair| self.parting(pair)).max_by(|a, b| wide(a).total_cmp(&wide(b)))
    }

    /// Returns the first bones of two limbs that are at different positions; the limbs' own first bones if there are
    /// none.
    fn parting(&self, [a, b]: [usize; 2]) -> [usize; 2] {
        let least = ONE_PLACE * self.length(a);
        let mut down = self.way_down(a).into_iter().zip(self.way_down(b));
        down.find(|(a, b)| self.at(*a).distance(self.at(*b)) > least).map_or([a, b], |(a, b)| [a, b])
    }

    /// Returns the length of the path down a limb, always into its largest branch.
    fn length(&self, node: usize) -> f64 {
        self.way_down(node).windows(2).map(|w| self.at(w[0]).distance(self.at(w[1]))).sum()
    }

    /// Returns the path from a node down to a leaf, always into the largest branch.
    fn way_down(&self, node: usize) -> Vec<usize> {
        let deeper = |at: &usize| self.children(*at).max_by_key(|child| (self.size[*child], usize::MAX - child));
        core::iter::successors(Some(node), deeper).collect()
    }
}

impl BodyPlan {
    /// Finds the body plan: a bone with two legs, and a column that continues from it. `weight` returns how many
    /// vertices a node carries.
    pub(crate) fn find(
        skeleton: &Skeleton,
        bind: &[DAffine3],
        is_bone: &[bool],
        weight: &dyn Fn(usize) -> usize,
    ) -> Option<Self> {
        if is_bone.iter().filter(|bone| **bone).count() > MOST_BONES {
            return None;
        }
        let tree = Tree::new(skeleton, bind, is_bone);
        let mut bones = (0..skeleton.len()).filter(|node| is_bone[*node]);
        let (hips, legs) = bones.find_map(|node| Some((node, tree.pair(node, None)?)))?;
        let across = (tree.at(legs[0]) - tree.at(legs[1])).normalize_or_zero();
        let middle = (tree.at(legs[0]) + tree.at(legs[1])) * 0.5;
        let wide = tree.at(legs[0]).distance(tree.at(legs[1]));
        let on_plane = |node: &usize| (tree.at(*node) - middle).dot(across).abs() < MIDDLE * wide;
        let pairs_below =
            |node: usize| below(&tree, node).filter(on_plane).filter_map(|at| tree.pair(at, Some(across)));
        let ways = |at: usize| {
            // A child that mirrors a sibling is a limb, even if it begins near the plane of symmetry.
            let limbs = tree.pairs(at, Some(across));
            tree.children(at).filter(move |child| !limbs.as_flattened().contains(child)).filter(on_plane)
        };
        let next = |at: usize| {
            ways(at).max_by_key(|way| (pairs_below(*way).next().is_some(), tree.size[*way], usize::MAX - way))
        };
        let column: Vec<usize> = core::iter::successors(next(hips), |at| next(*at)).collect();
        let length = |[limb, _]: [usize; 2]| tree.length(limb);
        let pairs: Vec<(usize, [usize; 2])> =
            column.iter().enumerate().filter_map(|(k, at)| Some((k, tree.pair(*at, Some(across))?))).collect();
        let least = ARM * pairs.iter().map(|(_, pair)| length(*pair)).fold(0.0, f64::max);
        let (arms, shoulders) = *pairs.iter().find(|(_, pair)| length(*pair) >= least)?;
        // If two branches carry limbs, the legs may be forelegs, and it is unknown which branch leads to the head:
        // there is no plan.
        if ways(hips).filter(|way| *way != column[0]).flat_map(pairs_below).any(|pair| length(pair) >= least) {
            return None;
        }
        let (mut trunk, above) = column.split_at(arms + 1);
        // The head is the bone that carries most skin, jaw included, even if the column seems to continue into the jaw.
        let skin = |node: usize| below(&tree, node).map(weight).sum::<usize>();
        let carried = |at: usize| skin(above[at]) - above.get(at + 1).map_or(0, |next| skin(*next));
        let head = (0..above.len()).max_by_key(|at| (carried(*at), *at))?;
        let mut neck = above[..head].to_vec();
        // Some rigs attach the collarbones to the neck. If the bone that carries the arms begins no lower than they do,
        // it is a neck bone.
        let spine = tree.at(above[head]) - tree.at(hips);
        let rise = tree.at(column[arms]) - (tree.at(shoulders[0]) + tree.at(shoulders[1])) * 0.5;
        if neck.is_empty() && trunk.len() > 1 && rise.dot(spine) > -LEVEL * spine.length_squared() {
            trunk = &trunk[..arms];
            neck.push(column[arms]);
        }
        let of_trunk_and_neck = pairs.iter().filter(|(at, _)| (arms..=arms + head).contains(at));
        let (_, limbs) = *of_trunk_and_neck.max_by(|(_, a), (_, b)| length(*a).total_cmp(&length(*b)))?;
        Some(Self { hips, trunk: trunk.to_vec(), neck, head: above[head], legs, arms: limbs })
    }

    /// Returns the path down each leg, always into the largest branch.
    pub(crate) fn ways_down(&self, skeleton: &Skeleton, bind: &[DAffine3], is_bone: &[bool]) -> [Vec<usize>; 2] {
        let tree = Tree::new(skeleton, bind, is_bone);
        self.legs.map(|leg| tree.way_down(leg))
    }
}

impl<'a> Tree<'a> {
    fn new(skeleton: &'a Skeleton, bind: &'a [DAffine3], is_bone: &'a [bool]) -> Self {
        let (mut shape, mut size) = (vec![1_u64; skeleton.len()], vec![0; skeleton.len()]);
        for node in (0..skeleton.len()).rev() {
            let children = skeleton.children(node).filter(|child| is_bone[*child]);
            let mut below: Vec<u64> = children.clone().map(|child| shape[child]).collect();
            below.sort_unstable();
            // FNV-1a over the sorted shapes of the children.
            let mix = |hash: u64, x: &u64| (hash ^ x).wrapping_mul(0x0100_0000_01b3) ^ (x >> 7);
            shape[node] = below.iter().fold(0xcbf2_9ce4_8422_2325, mix);
            size[node] = usize::from(is_bone[node]) + children.map(|child| size[child]).sum::<usize>();
        }
        Self { skeleton, bind, is_bone, shape, size }
    }
}

fn below<'a>(tree: &'a Tree<'_>, node: usize) -> impl Iterator<Item = usize> + 'a {
    let mut open = vec![node];
    core::iter::from_fn(move || {
        let at = open.pop()?;
        open.extend(tree.children(at));
        Some(at)
    })
}
