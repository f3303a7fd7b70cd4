//! Problems with recorded operation counts, by which the simplification rules are judged.

use aim_codegen::objective::{CHAIN_RESIDUAL_JACOBIAN, CHAIN_VALUE_GRADIENT, FirstLink};
use aim_codegen::{EffectorSpec, Frame, Objective, RigSpec};
use aim_symbolic::{
    Angle, Attitude, Function, Graph, Matrix, Plane, Rigid, Scalar, Stumpff, Variable, Vector, VectorNode, Want,
};

use crate::random::Random;
use crate::rigs::{bare_joint, general_frame};

/// An objective, with the outputs wanted of it.
#[derive(Debug)]
pub struct Problem {
    /// Name of the problem.
    pub name: &'static str,
    /// The graph that contains the expressions.
    pub g: Graph,
    /// Wanted outputs: values and derivatives.
    pub wanted: Vec<Want>,
    /// Number of operations of the derived program.
    pub operations: usize,
}

impl Problem {
    fn new(
        name: &'static str,
        operations: usize,
        state: impl FnOnce(&mut Graph) -> (Vec<Scalar>, Vec<Variable>),
    ) -> Self {
        let mut g = Graph::new();
        let (values, variables) = state(&mut g);
        Self { name, wanted: Want::all(&values, &variables), g, operations }
    }
}

/// Returns every recorded problem.
pub fn all() -> Vec<Problem> {
    vec![
        arap_term(),
        arap_term_backwards(),
        squared_distance(),
        aim_with_roll(),
        two_targets(),
        aim_without_offset(),
        aim_in_components(),
        divided_by_hand(),
        hessian(),
        quotient(),
        under_one_turn(),
        turned_centroid(),
        along_turned_axis(),
        force_seen_from_the_body(),
        projected_distance(),
        length_times_direction(),
        seen_from_a_turned_frame(),
        both_ways_round(),
        squared_length(),
        chain_aim("aim of a chain", 110, &[CARDINAL; 2], CARDINAL),
        chain_aim("aim in a general frame", 99, &[general()], general()),
        chain_aim("aim of a general effector", 60, &[CARDINAL], general()),
        residual(),
        spun("spun point", 76, 1),
        spun("spun points", 159, 2),
        turned_point(),
        angle_of_directions(),
        middle_direction(),
        points_on_planes(),
        turned_in_words(),
        chord(),
        pull_of_a_spring(),
        distance_from_axis(),
        gaussian(),
        dihedral_angle(),
        angle_between(),
        turned_form(),
        beside_a_chord(),
    ]
}

/// A frame with up = +X, forward = +Y, left = +Z.
const CARDINAL: Frame = Frame { up: [1.0, 0.0, 0.0], forward: [0.0, 1.0, 0.0], left: [0.0, 0.0, 1.0] };

fn general() -> Frame {
    general_frame(&mut Random::new(5))
}

fn rig(frames: &[Frame], effector: Frame) -> RigSpec {
    let joints = (0..).zip(frames).map(|(i, &frame)| bare_joint(i, frame, true, true)).collect();
    RigSpec {
        name: "Rig".into(),
        joints,
        effector: EffectorSpec { frame: effector, origin: [0.0; 3] },
        natural: None,
        region: None,
        kernels: Vec::new(),
    }
}

/// States the paper's objective over all joints of a rig.
fn chain_aim(name: &'static str, operations: usize, frames: &[Frame], effector: Frame) -> Problem {
    of_rig(name, operations, &CHAIN_VALUE_GRADIENT, &rig(frames, effector))
}

/// States the chain's stereographic residual, with its Jacobian.
fn residual() -> Problem {
    of_rig("residual and Jacobian", 183, &CHAIN_RESIDUAL_JACOBIAN, &rig(&[CARDINAL; 2], CARDINAL))
}

/// States an objective of a rig's chain.
fn of_rig(name: &'static str, operations: usize, objective: &Objective, spec: &RigSpec) -> Problem {
    let statement = objective.statement(spec, &[], FirstLink::Given);
    Problem { name, wanted: statement.wanted(), g: statement.graph, operations }
}

/// Plane of pitch. Components are forward, left, up: pitch turns the first towards the third, heading the first towards
/// the second.
const PITCH: Plane = Plane::XZ;
const HEADING: Plane = Plane::XY;
const ROLL: Plane = Plane::YZ;
const FORWARD: [f64; 3] = [1.0, 0.0, 0.0];

struct Joint {
    link: Rigid,
    angles: Vec<Angle>,
    /// The effector's origin after the rotations.
    origin: Vector,
    /// The effector's direction after the rotations.
    forward: Vector,
}

/// Returns a joint with these rotations, the innermost first.
fn joint(g: &mut Graph, planes: &[Plane]) -> Joint {
    let link = g.rigid_input("m");
    let angles: Vec<Angle> = (0..planes.len()).map(|i| g.angle(&format!("a{i}"))).collect();
    let forward = g.constant_vector(FORWARD);
    let (mut origin, mut forward) = (link.translation, g.rotate(link.rotation, forward));
    for (&plane, &angle) in planes.iter().zip(&angles) {
        let turn = g.turn(plane, angle);
        (origin, forward) = (g.rotate(turn, origin), g.rotate(turn, forward));
    }
    Joint { link, angles, origin, forward }
}

fn variables(angles: &[Angle]) -> Vec<Variable> {
    angles.iter().map(|&angle| angle.into()).collect()
}

fn components(g: &Graph, v: Vector) -> [Variable; 3] {
    match g.vector_node(v) {
        VectorNode::Components(c) => c.map(Variable::from),
        other => panic!("{other:?} has no variables"),
    }
}

/// States the as-rigid-as-possible term of three points, with its nine derivatives.
pub fn arap_term() -> Problem {
    arap("ARAP term", |g, from, to| g.sub_vectors(to, from))
}

/// States [`arap_term`] with every difference reversed and negated.
fn arap_term_backwards() -> Problem {
    arap("ARAP term backwards", |g, from, to| {
        let back = g.sub_vectors(from, to);
        g.neg_vector(back)
    })
}

fn arap(name: &'static str, side: fn(&mut Graph, Vector, Vector) -> Vector) -> Problem {
    Problem::new(name, 58, |g| {
        let p = ["p0", "p1", "p2"].map(|name| g.vector_input(name));
        let initial = ["alpha0", "beta0"].map(|name| g.input(name));
        let (a, c) = (side(g, p[0], p[1]), side(g, p[0], p[2]));
        let axis = g.normalize(c);
        let alpha = g.dot(a, axis);
        let aside = g.cross(a, axis.into());
        let beta = g.norm(aside);
        let squares = [alpha, beta].into_iter().zip(initial).map(|(now, initial)| {
            let change = g.sub(initial, now);
            g.mul(change, change)
        });
        let [first, second] = squares.collect::<Vec<_>>()[..] else { unreachable!("there are two") };
        let by = p.iter().flat_map(|&v| components(g, v)).collect();
        (vec![g.add(first, second)], by)
    })
}

/// States the squared distance |P − R t|².
pub fn squared_distance() -> Problem {
    Problem::new("squared distance", 28, |g| {
        let t = g.vector_input("t");
        let target = g.vector_input("target");
        let angles = [g.angle("p"), g.angle("h")];
        let (pitch, heading) = (g.turn(PITCH, angles[0]), g.turn(HEADING, angles[1]));
        let turned = g.rotate(pitch, t);
        let turned = g.rotate(heading, turned);
        let way = g.sub_vectors(target, turned);
        (vec![g.dot(way, way)], variables(&angles))
    })
}

/// States the aim of a joint that also rolls.
pub fn aim_with_roll() -> Problem {
    Problem::new("aim with roll", 62, |g| {
        let joint = joint(g, &[ROLL, PITCH, HEADING]);
        let target = g.vector_input("target");
        let way = g.sub_vectors(target, joint.origin);
        let way = g.normalize(way);
        (vec![g.dot(way, joint.forward)], variables(&joint.angles))
    })
}

/// States the weighted aim of one joint at two targets.
pub fn two_targets() -> Problem {
    Problem::new("two targets", 93, |g| {
        let joint = joint(g, &[PITCH, HEADING]);
        let aims = ["a", "b"].map(|name| {
            let (target, weight) = (g.vector_input(name), g.input(&format!("w_{name}")));
            let way = g.sub_vectors(target, joint.origin);
            let way = g.normalize(way);
            let aim = g.dot(way, joint.forward);
            g.mul(weight, aim)
        });
        (vec![g.add(aims[0], aims[1])], variables(&joint.angles))
    })
}

/// States the aim with the effector at the joint, where the radial parts of the derivatives vanish.
pub fn aim_without_offset() -> Problem {
    Problem::new("aim without offset", 33, |g| {
        let target = g.vector_input("target");
        let forward = g.vector_input("f");
        let angles = [g.angle("p"), g.angle("h")];
        let (pitch, heading) = (g.turn(PITCH, angles[0]), g.turn(HEADING, angles[1]));
        let turn = g.compose(heading, pitch);
        let forward = g.rotate(turn, forward);
        let way = g.normalize(target);
        (vec![g.dot(way, forward)], variables(&angles))
    })
}

/// States the aim with an explicit division by the length instead of a normalisation.
pub fn divided_by_hand() -> Problem {
    Problem::new("aim, divided by hand", 46, |g| {
        let joint = joint(g, &[PITCH, HEADING]);
        let target = g.vector_input("target");
        let way = g.sub_vectors(target, joint.origin);
        let square = g.dot(way, way);
        let length = g.sqrt(square);
        let one = g.constant(1.0);
        let reciprocal = g.div(one, length);
        let way = g.scale(reciprocal, way);
        (vec![g.dot(way, joint.forward)], variables(&joint.angles))
    })
}

/// States the aim as a cosine is defined: a dot product divided by a length.
fn quotient() -> Problem {
    Problem::new("aim as a quotient", 46, |g| {
        let joint = joint(g, &[PITCH, HEADING]);
        let target = g.vector_input("target");
        let way = g.sub_vectors(target, joint.origin);
        let along = g.dot(way, joint.forward);
        let length = g.norm(way);
        (vec![g.div(along, length)], variables(&joint.angles))
    })
}

/// States quantities that a rotation does not change: a length, the cosine between two vectors, their dot product.
fn under_one_turn() -> Problem {
    Problem::new("under one turn", 19, |g| {
        let angle = g.angle("p");
        let turn = g.turn(PITCH, angle);
        let [a, b] = ["a", "b"].map(|name| {
            let v = g.vector_input(name);
            g.rotate(turn, v)
        });
        let directions = [a, b].map(|v| g.normalize(v));
        let values = vec![g.norm(a), g.dot(a, b), g.dot(directions[0], directions[1])];
        (values, vec![angle.into()])
    })
}

/// States the component of the sum of two rotated points along a direction.
fn turned_centroid() -> Problem {
    Problem::new("turned centroid", 17, |g| {
        let angle = g.angle("p");
        let turn = g.turn(PITCH, angle);
        let [a, b, along] = ["a", "b", "u"].map(|name| g.vector_input(name));
        let (a, b) = (g.rotate(turn, a), g.rotate(turn, b));
        let sum = g.add_vectors(a, b);
        (vec![g.dot(along, sum)], vec![angle.into()])
    })
}

/// States the distance of a point ahead of a rotated one, along the axis that rotates with it.
fn along_turned_axis() -> Problem {
    Problem::new("along a turned axis", 7, |g| {
        let angle = g.angle("p");
        let turn = g.turn(PITCH, angle);
        let [target, t] = ["target", "t"].map(|name| g.vector_input(name));
        let forward = g.constant_vector(FORWARD);
        let (t, forward) = (g.rotate(turn, t), g.rotate(turn, forward));
        let way = g.sub_vectors(target, t);
        (vec![g.dot(way, forward)], vec![angle.into()])
    })
}

/// States Rᵀ (a + k (R b + c)): a force that the body carries, added to others and seen from the body.
fn force_seen_from_the_body() -> Problem {
    Problem::new("force seen from the body", 17, |g| {
        let angle = g.angle("p");
        let turn = g.turn(PITCH, angle);
        let [a, own, c] = ["a", "b", "c"].map(|name| g.vector_input(name));
        let (k, back) = (g.input("k"), g.transpose(turn));
        let own = g.rotate(turn, own);
        let sum = g.add_vectors(own, c);
        let scaled = g.scale(k, sum);
        let all = g.add_vectors(a, scaled);
        let seen = g.rotate(back, all);
        ([0, 1, 2].map(|axis| g.component(seen, axis)).to_vec(), vec![angle.into()])
    })
}

/// States a point mapped by an inverse transform: the point rotated back minus the origin rotated back.
fn seen_from_a_turned_frame() -> Problem {
    Problem::new("seen from a turned frame", 86, |g| {
        let joint = joint(g, &[PITCH, HEADING]);
        let target = g.vector_input("target");
        let turns = joint.angles.iter().zip([PITCH, HEADING]);
        let back = |g: &mut Graph, v: Vector| {
            turns.clone().rev().fold(v, |v, (&angle, plane)| {
                let turn = g.turn(plane, angle);
                let back = g.transpose(turn);
                g.rotate(back, v)
            })
        };
        let (target, origin) = (back(g, target), back(g, joint.origin));
        let to_effector = g.transpose(joint.link.rotation);
        let (target, origin) = (g.rotate(to_effector, target), g.rotate(to_effector, origin));
        let seen = g.sub_vectors(target, origin);
        let [ahead, aside, above] = [0, 1, 2].map(|axis| g.component(seen, axis));
        let distance = g.norm(seen);
        let sum = g.add(distance, ahead);
        let values = [aside, above].map(|c| {
            let twice = g.add(c, c);
            g.div(twice, sum)
        });
        (values.to_vec(), variables(&joint.angles))
    })
}

/// States differences and products in both orders of their operands.
fn both_ways_round() -> Problem {
    Problem::new("both ways round", 6, |g| {
        let [x, y] = ["x", "y"].map(|name| g.input(name));
        let (there, back) = (g.sub(x, y), g.sub(y, x));
        let (first, second) = (g.mul(x, y), g.mul(y, x));
        (vec![g.mul(there, back), g.add(first, second)], vec![x.into(), y.into()])
    })
}

/// States an energy by a length: k |v| · |v|.
fn squared_length() -> Problem {
    Problem::new("squared length", 10, |g| {
        let v = g.vector_input("v");
        let stiffness = g.input("k");
        let length = g.norm(v);
        let once = g.mul(stiffness, length);
        let by = components(g, v).to_vec();
        (vec![g.mul(once, length)], by)
    })
}

/// States a distance as the projection on its own direction.
fn projected_distance() -> Problem {
    Problem::new("projected distance", 10, |g| {
        let v = g.vector_input("v");
        let direction = g.normalize(v);
        let by = components(g, v).to_vec();
        (vec![g.dot(direction, v)], by)
    })
}

/// States the squared distance from a vector that is given as its length times its direction.
fn length_times_direction() -> Problem {
    Problem::new("length times direction", 11, |g| {
        let (v, goal) = (g.vector_input("v"), g.vector_input("goal"));
        let (length, direction) = (g.norm(v), g.normalize(v));
        let again = g.scale(length, direction.into());
        let off = g.sub_vectors(again, goal);
        let by = components(g, v).to_vec();
        (vec![g.dot(off, off)], by)
    })
}

/// States distances of rotated points from planes, differentiated by the tangent of the quaternion that rotates them.
fn points_on_planes() -> Problem {
    Problem::new("points on planes", 81, |g| {
        let (u, w, step) = (g.vector_input("q"), g.input("q_w"), g.step());
        let (still, turn) = (g.quaternion(u, w), g.turn_by_step(step));
        let rotation = g.compose(still, turn);
        let distance = |g: &mut Graph, i: usize| {
            let [point, normal] = ["p", "n"].map(|name| g.vector_input(&format!("{name}{i}")));
            let turned = g.rotate(rotation, point);
            g.dot(normal, turned)
        };
        let distances = vec![distance(g, 0), distance(g, 1)];
        (distances, components(g, step).to_vec())
    })
}

/// States a point rotated about a vector by its length, and then in a plane, with both rotations written out.
fn turned_in_words() -> Problem {
    Problem::new("turned in words", 91, |g| {
        let (turn, point, along) = (g.vector_input("r"), g.vector_input("p"), g.vector_input("n"));
        let heading = g.input("h");
        let square = g.dot(turn, turn);
        let [cos, sine, versine] = [0, 1, 2].map(|order| g.stumpff(Stumpff { hyperbolic: false, order }, square));
        let (aside, dot) = (g.cross(turn, point), g.dot(turn, point));
        let along_turn = g.mul(versine, dot);
        let terms = [g.scale(cos, point), g.scale(sine, aside), g.scale(along_turn, turn)];
        let sum = g.add_vectors(terms[0], terms[1]);
        let turned = g.add_vectors(sum, terms[2]);
        let turned = turned_in_components(g, turned, heading);
        let by = components(g, turn).into_iter().chain([heading.into()]).collect();
        (vec![g.dot(along, turned)], by)
    })
}

/// States the aim of a joint whose rotation is written in components.
fn aim_in_components() -> Problem {
    Problem::new("aim of a turn in components", 31, |g| {
        let (link, heading, target) = (g.rigid_input("m"), g.input("h"), g.vector_input("target"));
        let forward = g.constant_vector(FORWARD);
        let forward = g.rotate(link.rotation, forward);
        let [origin, forward] = [link.translation, forward].map(|v| turned_in_components(g, v, heading));
        let way = g.sub_vectors(target, origin);
        let way = g.normalize(way);
        (vec![g.dot(way, forward)], vec![heading.into()])
    })
}

/// Returns (x cos h − y sin h, x sin h + y cos h, z).
fn turned_in_components(g: &mut Graph, v: Vector, heading: Scalar) -> Vector {
    let [x, y, z] = [0, 1, 2].map(|axis| g.component(v, axis));
    let (sin, cos) = (g.call(Function::Sin, heading), g.call(Function::Cos, heading));
    let [xc, ys, xs, yc] = [(x, cos), (y, sin), (x, sin), (y, cos)].map(|(a, b)| g.mul(a, b));
    let (x, y) = (g.sub(xc, ys), g.add(xs, yc));
    g.components([x, y, z])
}

/// States the squared chord between the direction of a joint and the direction to its target.
fn chord() -> Problem {
    Problem::new("chord", 49, |g| {
        let joint = joint(g, &[PITCH, HEADING]);
        let target = g.vector_input("target");
        let way = g.sub_vectors(target, joint.origin);
        let way = g.normalize(way);
        let chord = g.sub_vectors(joint.forward, way.into());
        (vec![g.dot(chord, chord)], variables(&joint.angles))
    })
}

/// States the force of a damped spring.
fn pull_of_a_spring() -> Problem {
    Problem::new("pull of a spring", 62, |g| {
        let [way, speed] = ["d", "v"].map(|name| g.vector_input(name));
        let [stiffness, damping, rest] = ["k", "c", "l"].map(|name| g.input(name));
        let (length, direction) = (g.norm(way), g.normalize(way));
        let (stretch, rate) = (g.sub(length, rest), g.dot(speed, direction));
        let (spring, damper) = (g.mul(stiffness, stretch), g.mul(damping, rate));
        let force = g.add(spring, damper);
        let pull = g.scale(force, direction.into());
        let by = components(g, way).into_iter().chain(components(g, speed)).collect();
        ([0, 1, 2].map(|axis| g.component(pull, axis)).to_vec(), by)
    })
}

/// States a point's distance from a line through the origin, as the length of the point's rejection from it.
fn distance_from_axis() -> Problem {
    Problem::new("distance from an axis", 30, |g| {
        let (point, axis) = (g.vector_input("p"), g.vector_input("a"));
        let direction = g.normalize(axis).into();
        let along = g.dot(point, direction);
        let along = g.scale(along, direction);
        let aside = g.sub_vectors(point, along);
        let by = components(g, point).to_vec();
        (vec![g.norm(aside)], by)
    })
}

/// States the negative log-likelihood of a point under a Gaussian with a mean and a covariance.
fn gaussian() -> Problem {
    Problem::new("Gaussian", 110, |g| {
        let (point, mean) = (g.vector_input("x"), g.vector_input("mean"));
        let columns = ["a", "b", "c"].map(|name| g.vector_input(name));
        let way = g.sub_vectors(point, mean);
        let solution = g.solve(Matrix::new(columns), way);
        let distance = g.dot(way, solution);
        let normal = g.cross(columns[0], columns[1]);
        let determinant = g.dot(columns[2], normal);
        let log = g.call(Function::Ln, determinant);
        let half = g.constant(0.5);
        let terms = [g.mul(half, distance), g.mul(half, log)];
        let by = [point].into_iter().chain(columns).flat_map(|v| components(g, v)).collect();
        (vec![g.add(terms[0], terms[1])], by)
    })
}

/// States the dihedral angle of four points, by the normals of both planes.
fn dihedral_angle() -> Problem {
    Problem::new("dihedral angle", 92, |g| {
        let points = ["a", "b", "c", "d"].map(|name| g.vector_input(name));
        let [first, middle, last] = [0, 1, 2].map(|i| g.sub_vectors(points[i + 1], points[i]));
        let (m, n) = (g.cross(first, middle), g.cross(middle, last));
        let (length, along) = (g.norm(middle), g.dot(first, n));
        let (sine, cosine) = (g.mul(length, along), g.dot(m, n));
        let by = points.into_iter().flat_map(|v| components(g, v)).collect();
        (vec![g.atan2(sine, cosine)], by)
    })
}

/// States the angle between the vectors from one point to two others.
fn angle_between() -> Problem {
    Problem::new("angle between", 66, |g| {
        let points = ["a", "b", "c"].map(|name| g.vector_input(name));
        let [u, v] = [0, 2].map(|i| g.sub_vectors(points[i], points[1]));
        let cross = g.cross(u, v);
        let (sine, cosine) = (g.norm(cross), g.dot(u, v));
        let by = points.into_iter().flat_map(|v| components(g, v)).collect();
        (vec![g.atan2(sine, cosine)], by)
    })
}

/// States the products of two vectors under a diagonal form in a rotated frame, by the frame and by both vectors.
fn turned_form() -> Problem {
    Problem::new("turned quadratic form", 222, |g| {
        let (u, w) = (g.vector_input("q"), g.input("q_w"));
        let vectors = ["v", "w"].map(|name| g.vector_input(name));
        let scales = ["x", "y", "z"].map(|name| g.input(name));
        let rotation = g.attitude(Attitude::Quaternion(u, w));
        let back = g.transpose(rotation);
        let images = vectors.map(|v| {
            let seen = g.rotate(back, v);
            let scaled = [0, 1, 2].map(|axis| {
                let component = g.component(seen, axis);
                g.mul(scales[usize::from(axis)], component)
            });
            let scaled = g.components(scaled);
            g.rotate(rotation, scaled)
        });
        let by = vectors.into_iter().chain([u]).flat_map(|v| components(g, v)).chain([w.into()]).collect();
        let products = [(0, 0), (0, 1), (1, 1)].map(|(i, k)| g.dot(vectors[i], images[k]));
        (products.to_vec(), by)
    })
}

/// States the squared distances of points from others after a product with a quaternion of any length on both sides
/// and, for several points, a shift.
fn spun(name: &'static str, operations: usize, points: usize) -> Problem {
    Problem::new(name, operations, |g| {
        let (u, w, shift) = (g.vector_input("q"), g.input("q_w"), (points > 1).then(|| g.vector_input("shift")));
        let square = |g: &mut Graph, place: usize| {
            let [point, goal] = ["point", "goal"].map(|name| g.vector_input(&format!("{name}{place}")));
            let (u_square, w_square, along) = (g.dot(u, u), g.mul(w, w), g.dot(u, point));
            let (kept, two) = (g.sub(w_square, u_square), g.constant(2.0));
            let (along, aside) = (g.mul(two, along), g.mul(two, w));
            let cross = g.cross(u, point);
            let terms = [(kept, point), (along, u), (aside, cross)].map(|(k, v)| g.scale(k, v));
            let spun = g.add_vectors(terms[0], terms[1]);
            let spun = g.add_vectors(spun, terms[2]);
            let way = shift.map_or(goal, |shift| g.sub_vectors(goal, shift));
            let off = g.sub_vectors(spun, way);
            g.dot(off, off)
        };
        let squares: Vec<Scalar> = (0..points).map(|place| square(g, place)).collect();
        let all = squares.into_iter().reduce(|a, b| g.add(a, b)).expect("some points");
        let by = [u].into_iter().chain(shift).flat_map(|v| components(g, v));
        (vec![all], by.chain([w.into()]).collect())
    })
}

/// States the components along two vectors of a point rotated about another vector by its length, by that vector and
/// the point.
fn turned_point() -> Problem {
    Problem::new("turned point", 137, |g| {
        let [turn, point] = ["turn", "point"].map(|name| g.vector_input(name));
        let rotation = g.attitude(Attitude::Turn(turn));
        let turned = g.rotate(rotation, point);
        let places = ["m", "n"].map(|name| {
            let normal = g.vector_input(name);
            g.dot(normal, turned)
        });
        (places.to_vec(), [turn, point].into_iter().flat_map(|v| components(g, v)).collect())
    })
}

/// States the angle between the directions of two vectors, by the vectors.
fn angle_of_directions() -> Problem {
    Problem::new("angle of directions", 46, |g| {
        let [a, b] = ["a", "b"].map(|name| g.vector_input(name));
        let [u, v] = [a, b].map(|v| g.normalize(v));
        let cross = g.cross(u.into(), v.into());
        let (sine, cosine) = (g.norm(cross), g.dot(u, v));
        (vec![g.atan2(sine, cosine)], [a, b].into_iter().flat_map(|v| components(g, v)).collect())
    })
}

/// States the component of a vector along the bisector of two others, both divided by a distance that cancels.
fn middle_direction() -> Problem {
    Problem::new("middle direction", 26, |g| {
        let [a, b, way, along] = ["a", "b", "way", "along"].map(|name| g.vector_input(name));
        let distance = g.norm(way);
        let per_distance = g.reciprocal(distance);
        let [near, far] = [a, b].map(|v| g.scale(per_distance, v));
        let both = g.add_vectors(near, far);
        let middle = g.normalize(both);
        (vec![g.dot(along, middle)], components(g, a).into())
    })
}

/// States the aim with its second derivatives.
pub fn hessian() -> Problem {
    let mut problem = Problem::new("aim and Hessian", 121, |g| {
        let joint = joint(g, &[PITCH, HEADING]);
        let target = g.vector_input("target");
        let way = g.sub_vectors(target, joint.origin);
        let way = g.normalize(way);
        (vec![g.dot(way, joint.forward)], variables(&joint.angles))
    });
    let [Want::Value(aim), Want::Derivative(_, p), Want::Derivative(_, h)] = problem.wanted[..] else {
        unreachable!("a value and two derivatives")
    };
    problem.wanted.extend([Want::Second(aim, p, p), Want::Second(aim, p, h), Want::Second(aim, h, h)]);
    problem
}

/// States the distance of a point from the chord of two others, with lengths √(|v|² + δ²), and its second derivatives.
fn beside_a_chord() -> Problem {
    let mut problem = Problem::new("beside a chord", 114, |g| {
        let [before, here, after] = ["p0", "p1", "p2"].map(|name| g.vector_input(name));
        let delta = g.input("delta");
        let least = g.mul(delta, delta);
        let length = |g: &mut Graph, v: Vector| {
            let square = g.dot(v, v);
            let sum = g.add(square, least);
            g.sqrt(sum)
        };
        let (step, chord) = (g.sub_vectors(here, before), g.sub_vectors(after, before));
        let long = length(g, chord);
        let per_length = g.reciprocal(long);
        let chord = g.scale(per_length, chord);
        let along = g.dot(step, chord);
        let part = g.scale(along, chord);
        let aside = g.sub_vectors(step, part);
        (vec![length(g, aside)], components(g, here).to_vec())
    });
    let [Want::Value(aside), Want::Derivative(_, x), Want::Derivative(_, y), Want::Derivative(_, z)] =
        problem.wanted[..]
    else {
        unreachable!("a value and three derivatives")
    };
    let second = [(x, x), (x, y), (y, y), (x, z), (y, z), (z, z)];
    problem.wanted.extend(second.map(|(a, b)| Want::Second(aside, a, b)));
    problem
}
