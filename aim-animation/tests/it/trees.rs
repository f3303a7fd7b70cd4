use aim_animation::glam::{DQuat, DVec3, Quat, Vec2, Vec3};
use aim_animation::{
    BlendLine, BlendPlane, Bone, Mask, Method, Node, Parameter, PoseError, Skeleton, Transform, Tree, TreeError,
};

use crate::common::{Rng, angle_between};

const BONES: usize = 3;

fn skeleton() -> Skeleton {
    let bone = |k: usize, parent| {
        let rest = Transform::new(Vec3::splat(0.3), Quat::from_rotation_y(0.2 + f32::from(u8::try_from(k).unwrap())));
        Bone::new("b", parent).with_rest(rest)
    };
    Skeleton::new([bone(0, None), bone(1, Some(0)), bone(2, Some(1))]).unwrap()
}

/// Returns poses within half a turn of the rest pose, so that no sum of quaternions comes near zero.
fn poses(rng: &mut Rng, skeleton: &Skeleton) -> Vec<[Transform; BONES]> {
    let transform = |rng: &mut Rng, rest: &Transform| Transform {
        translation: rng.vector(1.0),
        rotation: rest.rotation * Quat::from_scaled_axis(rng.vector(0.6)),
        scale: Vec3::ONE + 0.3 * rng.vector(1.0),
    };
    (0..6).map(|_| [0, 1, 2].map(|bone| transform(rng, &skeleton.rest()[bone]))).collect()
}

/// Pose in f64: translation, rotation and scale of each bone.
type Exact = [(DVec3, DQuat, DVec3); BONES];

fn exact(pose: &[Transform]) -> Exact {
    [0, 1, 2].map(|k| (pose[k].translation.as_dvec3(), pose[k].rotation.as_dquat(), pose[k].scale.as_dvec3()))
}

fn near(q: DQuat, like: DQuat) -> DQuat {
    if q.dot(like) < 0.0 { -q } else { q }
}

/// Expected result of a node: its pose, and the share of each source in the root bone.
struct Truth {
    pose: Exact,
    shares: [f64; 6],
}

struct Random<'a> {
    rng: &'a mut Rng,
    skeleton: &'a Skeleton,
    poses: &'a [[Transform; BONES]],
    inputs: &'a [f32],
    /// Sources with a weight, in the order of evaluation.
    asked: Vec<usize>,
    has_layers: bool,
}

impl Random<'_> {
    fn weight(&mut self) -> (Parameter, f64) {
        let input = self.rng.below(self.inputs.len());
        let fixed = [0.0, 1.0, 0.4, 7.0][self.rng.below(4)];
        let parameter = if self.rng.below(2) == 0 { Parameter::Input(input) } else { Parameter::Fixed(fixed) };
        let number = if matches!(parameter, Parameter::Input(_)) { self.inputs[input] } else { fixed };
        (parameter, f64::from(if number.is_nan() { 0.0 } else { number.clamp(0.0, 1.0) }))
    }

    /// Returns a random node and its expected result. `counts` is `true` if the node has a weight.
    fn node(&mut self, depth: usize, counts: bool) -> (Node, Truth) {
        let kind = if depth == 0 { 0 } else { self.rng.below(7) };
        match kind {
            0 => {
                let number = self.rng.below(6);
                if counts {
                    self.asked.push(number);
                }
                let mut shares = [0.0; 6];
                shares[number] = 1.0;
                (Node::source(number), Truth { pose: exact(&self.poses[number]), shares })
            }
            1..=3 => {
                let count = self.rng.below(4) + usize::from(kind > 1);
                let (at, weights, space) = match kind {
                    1 => {
                        let weights: Vec<_> = (0..count).map(|_| self.weight()).collect();
                        let (parameters, numbers): (Vec<_>, Vec<_>) = weights.into_iter().unzip();
                        (parameters, numbers, None)
                    }
                    2 => {
                        let input = self.rng.below(self.inputs.len());
                        let line = BlendLine::new([-0.5, 0.1, 0.6, 1.1][..count].to_vec()).unwrap();
                        let mut weights = vec![0.0; count];
                        line.weights(self.inputs[input], &mut weights);
                        let numbers = weights.into_iter().map(f64::from).collect();
                        (vec![Parameter::Input(input)], numbers, Some(Ok(line)))
                    }
                    _ => {
                        let plane = BlendPlane::new([Vec2::ZERO, Vec2::X, Vec2::Y, -Vec2::X]).unwrap();
                        let at = [self.rng.below(self.inputs.len()), self.rng.below(self.inputs.len())];
                        let mut weights = vec![0.0; 4];
                        plane.weights(Vec2::from(at.map(|input| self.inputs[input])), &mut weights);
                        let numbers = weights.into_iter().map(f64::from).collect();
                        (at.map(Parameter::Input).to_vec(), numbers, Some(Err(plane)))
                    }
                };
                let nodes: Vec<(Node, Truth)> =
                    weights.iter().map(|weight| self.node(depth - 1, counts && *weight > 0.0)).collect();
                let (nodes, truths): (Vec<Node>, Vec<Truth>) = nodes.into_iter().unzip();
                let truth = self.sum(&truths, &weights);
                let node = match space {
                    None => Node::sum(nodes.into_iter().zip(at)),
                    Some(Ok(line)) => Node::line(line, at[0], nodes),
                    Some(Err(plane)) => Node::plane(plane, [at[0], at[1]], nodes),
                };
                (node, truth)
            }
            _ => {
                let (parameter, weight) = self.weight();
                let mask = (self.rng.below(2) == 0).then(|| {
                    let part = self.rng.between(0.0, 1.0);
                    Mask::new(self.skeleton, 1.0).with_bone(self.rng.below(BONES), 0.0).with_bone(0, part)
                });
                let is_layer = kind == 6;
                let (one, a) = self.node(depth - 1, counts && (is_layer || mask.is_some() || weight < 1.0));
                let (other, b) = self.node(depth - 1, counts && weight > 0.0);
                let weights =
                    [0, 1, 2].map(|bone| weight * mask.as_ref().map_or(1.0, |m| f64::from(m.weights()[bone])));
                let mut node = if is_layer { one.add(other, parameter) } else { one.blend(other, parameter) };
                if let Some(mask) = mask {
                    node = node.with_mask(mask);
                }
                let mut reference = exact(self.skeleton.rest());
                if is_layer {
                    self.has_layers = true;
                    if self.rng.below(2) == 0 {
                        reference = exact(&self.poses[0]);
                        node = node.with_reference(self.poses[0]);
                    }
                    (node, Truth { pose: layered(&a.pose, &b.pose, &reference, weights), shares: a.shares })
                } else {
                    let shares =
                        [0, 1, 2, 3, 4, 5].map(|k| a.shares[k] * (1.0 - weights[0]) + b.shares[k] * weights[0]);
                    (node, Truth { pose: blended(&a.pose, &b.pose, weights), shares })
                }
            }
        }
    }

    fn sum(&self, terms: &[Truth], weights: &[f64]) -> Truth {
        let total: f64 = weights.iter().sum();
        let rest = exact(self.skeleton.rest());
        if total == 0.0 {
            return Truth { pose: rest, shares: [0.0; 6] };
        }
        let terms = || terms.iter().zip(weights.iter().map(|weight| weight / total));
        let pose = [0, 1, 2].map(|k| {
            let quaternions = terms().map(|(term, w)| near(term.pose[k].1, rest[k].1) * w);
            (
                terms().map(|(term, w)| term.pose[k].0 * w).sum(),
                quaternions.reduce(|a, b| a + b).unwrap().normalize(),
                terms().map(|(term, w)| term.pose[k].2 * w).sum(),
            )
        });
        Truth { pose, shares: [0, 1, 2, 3, 4, 5].map(|k| terms().map(|(term, w)| term.shares[k] * w).sum()) }
    }
}

fn blended(a: &Exact, b: &Exact, weights: [f64; BONES]) -> Exact {
    [0, 1, 2].map(|k| {
        let w = weights[k];
        let rotation = (a[k].1 * (1.0 - w) + near(b[k].1, a[k].1) * w).normalize();
        (a[k].0.lerp(b[k].0, w), rotation, a[k].2.lerp(b[k].2, w))
    })
}

fn layered(a: &Exact, b: &Exact, reference: &Exact, weights: [f64; BONES]) -> Exact {
    [0, 1, 2].map(|k| {
        let w = weights[k];
        let turn = near(reference[k].1.conjugate() * b[k].1, DQuat::IDENTITY);
        let turn = (DQuat::IDENTITY * (1.0 - w) + turn * w).normalize();
        let scale = DVec3::ONE.lerp(b[k].2 / reference[k].2, w);
        (a[k].0 + (b[k].0 - reference[k].0) * w, a[k].1 * turn, a[k].2 * scale)
    })
}

/// Random trees give the pose of their definition in f64, evaluate only sources with a weight, and report their shares
/// in the root bone.
#[test]
fn trees_agree_with_their_definition() {
    let (mut rng, skeleton) = (Rng(1), skeleton());
    for case in 0..3000 {
        let poses = poses(&mut rng, &skeleton);
        let mut inputs = [0; 4].map(|_| rng.between(-0.5, 1.5));
        inputs[rng.below(4)] = [0.0, 1.0, f32::NAN, 0.5][rng.below(4)];
        let mut random = Random {
            rng: &mut rng,
            skeleton: &skeleton,
            poses: &poses,
            inputs: &inputs,
            asked: Vec::new(),
            has_layers: false,
        };
        let (node, truth) = random.node(case % 5, true);
        let (expected, has_layers) = (random.asked, random.has_layers);
        let tree = Tree::new(&skeleton, node).unwrap();
        let (mut scratch, mut pose, mut asked) = (tree.scratch(), [Transform::IDENTITY; BONES], Vec::new());
        let mut sample = |source: usize, pose: &mut [Transform]| {
            assert_eq!(pose, skeleton.rest(), "from the rest pose");
            asked.push(source);
            pose.copy_from_slice(&poses[source]);
        };
        tree.evaluate(&inputs, &mut scratch, &mut pose, &mut sample).unwrap();
        assert_eq!(asked, expected, "{tree:?}");
        for (found, (translation, rotation, scale)) in pose.iter().zip(&truth.pose) {
            assert!(found.translation.as_dvec3().distance(*translation) < 2e-5, "case {case}: {tree:?}");
            assert!(found.scale.as_dvec3().distance(*scale) < 2e-5, "case {case}: {tree:?}");
            assert!(angle_between(found.rotation, *rotation) < 1e-4, "case {case}: {tree:?}");
        }
        // A second evaluation gives the same, whatever is left in the scratch memory.
        let first = pose;
        tree.evaluate(&inputs, &mut scratch, &mut pose, |source, pose| pose.copy_from_slice(&poses[source])).unwrap();
        assert_eq!(pose, first);
        let mut shares = [9.0; 6];
        tree.shares(0, &inputs, &mut scratch, &mut shares).unwrap();
        for (share, truth) in shares.iter().zip(truth.shares) {
            assert!((f64::from(*share) - truth).abs() < 1e-5, "case {case}: {shares:?} {truth:?}");
        }
        if !has_layers && truth.shares.iter().sum::<f64>() > 0.999 {
            let moved = poses.iter().zip(shares).map(|(pose, share)| pose[0].translation * share).sum::<Vec3>();
            assert!(moved.distance(pose[0].translation) < 2e-5, "what shares are for");
        }
    }
}

#[test]
fn the_method_applies_to_every_blend_of_a_tree() {
    let (mut rng, skeleton) = (Rng(2), skeleton());
    let poses = poses(&mut rng, &skeleton);
    let node = Node::sum([(Node::source(0), 0.3), (Node::source(1), 0.9)]).blend(Node::source(2), 0.4);
    let evaluated = |method| {
        let tree = Tree::new(&skeleton, node.clone()).unwrap().with_method(method);
        let mut pose = [Transform::IDENTITY; BONES];
        tree.evaluate(&[], &mut tree.scratch(), &mut pose, |k, pose| pose.copy_from_slice(&poses[k])).unwrap();
        pose[1].rotation
    };
    let vector = |q: DQuat| near(q, DQuat::IDENTITY).to_scaled_axis();
    let rest = skeleton.rest()[1].rotation.as_dquat();
    let [a, b, c] = [0, 1, 2].map(|k: usize| vector(rest.conjugate() * poses[k][1].rotation.as_dquat()));
    let truth = rest * DQuat::from_scaled_axis((a * 0.25 + b * 0.75).lerp(c, 0.4));
    assert!(angle_between(evaluated(Method::Log), truth) < 5e-6);
    assert!(angle_between(evaluated(Method::Nlerp), truth) > 1e-3, "another one");
}

#[test]
fn invalid_trees_are_refused() {
    let skeleton = skeleton();
    let none = Skeleton::new([]).unwrap();
    let source = Node::source;
    let refused = |node: Node| Tree::new(&skeleton, node).unwrap_err();
    let line = BlendLine::new([0.0, 1.0]).unwrap();
    assert_eq!(refused(Node::line(line, 0.0, [source(0)])), TreeError::Places { places: 2, nodes: 1 });
    let foreign = TreeError::Length { bones: 3, found: 0 };
    assert_eq!(refused(source(0).blend(source(1), 1.0).with_mask(Mask::new(&none, 1.0))), foreign);
    assert_eq!(refused(source(0).add(source(1), 1.0).with_reference([])), foreign);
    let mut bad = [Transform::IDENTITY; BONES];
    bad[1].rotation.w = 2.0;
    assert_eq!(refused(source(0).add(source(1), 1.0).with_reference(bad)), TreeError::Reference(1));
    assert_eq!(refused(source(0).with_mask(Mask::new(&skeleton, 1.0))), TreeError::Mistaken);
    assert_eq!(refused(source(0).blend(source(1), 1.0).with_reference(bad)), TreeError::Mistaken);
    let nested = |depth| (1..depth).fold(source(0), |node, _| node.blend(source(1), 0.5));
    assert!(Tree::new(&skeleton, nested(64)).is_ok());
    assert_eq!(refused(nested(65)), TreeError::Deep);

    let tree = Tree::new(&skeleton, nested(3)).unwrap();
    let mut pose = [Transform::IDENTITY; BONES];
    let mut foreign = Tree::new(&skeleton, source(0)).unwrap().scratch();
    assert!(tree.evaluate(&[], &mut foreign, &mut pose, |_, _| ()).is_err());
    assert!(tree.shares(0, &[], &mut foreign, &mut []).is_err());
    let short = Err(PoseError::Length { bones: 3, found: 2 });
    assert_eq!(tree.evaluate(&[], &mut tree.scratch(), &mut pose[..2], |_, _| ()), short);
    // An empty tree gives the rest pose.
    let tree = Tree::new(&skeleton, Node::sum::<f32>([])).unwrap();
    tree.evaluate(&[], &mut tree.scratch(), &mut pose, |_, _| ()).unwrap();
    assert_eq!(pose, skeleton.rest());
}

/// A tree that is too deep is rejected, but can still be cloned, compared and dropped on a test thread's stack.
#[test]
fn very_deep_trees_are_refused_without_overflow() {
    let skeleton = Skeleton::new([Bone::new("a", None)]).unwrap();
    let source = Node::source;
    let nodes: [fn(Node) -> Node; 3] = [
        |node| node.blend(Node::source(1), 0.5),
        |node| Node::source(1).add(node, 0.5),
        |node| Node::sum([(node, 1.0), (Node::source(1), 1.0)]),
    ];
    for outer in nodes {
        let deep = (0..100_000).fold(source(0), |node, _| outer(node));
        assert_eq!(deep, deep.clone());
        assert_eq!(Tree::new(&skeleton, deep.clone()).unwrap_err(), TreeError::Deep);
        // A mask does not change the error.
        assert_eq!(Tree::new(&skeleton, deep.with_mask(Mask::new(&skeleton, 1.0))).unwrap_err(), TreeError::Deep);
        let deepest = (1..64).fold(source(0), |node, _| outer(node));
        assert!(Tree::new(&skeleton, deepest.clone()).is_ok());
        assert_eq!(Tree::new(&skeleton, outer(deepest)).unwrap_err(), TreeError::Deep);
    }
}
