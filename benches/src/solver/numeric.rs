//! [`NumericRig`]: a rig of up to seven joints that is made in no time, for random rigs by the hundred thousand.
//!
//! Its kernels are the geometry of turning about a pivot, not derived; those of the compiled rigs are judged elsewhere.

use aim::{Axes, Description, Effector, JointInfo, Rig, Scalar};

/// The most joints of such a rig.
pub const MOST_JOINTS: usize = 7;

/// A value a joint.
#[derive(Clone, Copy, Debug)]
pub struct Few<T> {
    items: [T; MOST_JOINTS],
    count: usize,
}

impl<T> AsRef<[T]> for Few<T> {
    fn as_ref(&self) -> &[T] {
        &self.items[..self.count]
    }
}

impl<T> AsMut<[T]> for Few<T> {
    fn as_mut(&mut self) -> &mut [T] {
        &mut self.items[..self.count]
    }
}

/// A rig with geometric kernels.
#[derive(Clone, Copy, Debug)]
pub struct NumericRig {
    /// What is declared of each joint.
    pub infos: Few<JointInfo>,
    /// What is aimed.
    pub effector: Effector,
}

impl NumericRig {
    /// The rig at rest; the first joint's forward is aimed.
    ///
    /// # Panics
    /// Without a joint, or with more than [`MOST_JOINTS`].
    pub fn new(infos: &[JointInfo]) -> Self {
        assert!((1..=MOST_JOINTS).contains(&infos.len()), "between one joint and {MOST_JOINTS}");
        let count = infos.len();
        let items = std::array::from_fn(|i| *infos.get(i).unwrap_or(&infos[0]));
        let effector = Effector { forward: infos[0].axes().forward, origin: [0.0; 3] };
        Self { infos: Few { items, count }, effector }
    }

    /// The same rig as another declares it.
    pub fn like(rig: &dyn Rig) -> Self {
        let description = rig.description();
        Self { effector: *description.effector(), ..Self::new(description.joints()) }
    }
}

type V<S> = [S; 3];

fn dot<S: Scalar>(a: V<S>, b: V<S>) -> S {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn sub<S: Scalar>(a: V<S>, b: V<S>) -> V<S> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn constant<S: Scalar>(v: [f32; 3]) -> V<S> {
    v.map(|x| S::constant(x.into()))
}

/// A turn of what it carries: its plane and its pivot in the last joint's space.
#[derive(Clone, Copy)]
struct Turn<S> {
    from: V<S>,
    towards: V<S>,
    pivot: V<S>,
}

impl<S: Scalar> Turn<S> {
    /// How `axis · p` changes with the angle for a point `p` that is carried.
    fn lever(&self, axis: V<S>, arm: V<S>) -> S {
        dot(axis, self.towards) * dot(self.from, arm) - dot(axis, self.from) * dot(self.towards, arm)
    }
}

/// The chain seen from its last joint.
struct Carried<S> {
    /// Images of the three axes, and of the origin.
    frame: [V<S>; 4],
    turns: [Turn<S>; 2 * MOST_JOINTS],
    count: usize,
}

impl<S: Scalar> Carried<S> {
    fn new(infos: &[JointInfo], links: &[[S; 12]], sin_cos: &[[S; 4]]) -> Self {
        let (zero, one) = (S::ZERO, S::constant(1.0));
        let still = Turn { from: [zero; 3], towards: [zero; 3], pivot: [zero; 3] };
        let frame = [[one, zero, zero], [zero, one, zero], [zero, zero, one], [zero; 3]];
        let mut carried = Self { frame, turns: [still; 2 * MOST_JOINTS], count: 0 };
        // From the last joint outward; the turns are put in the declared order afterwards.
        for ((info, link), sin_cos) in infos.iter().zip(links).zip(sin_cos).rev() {
            let axes = info.axes();
            let [sin_p, cos_p, sin_h, cos_h] = *sin_cos;
            if info.heading.is_some() {
                carried.turn(axes, axes.left, sin_h, cos_h);
            }
            if info.pitch.is_some() {
                carried.turn(axes, axes.up, sin_p, cos_p);
            }
            carried.pass(link);
        }
        let count = carried.count;
        carried.turns[..count].reverse();
        carried
    }

    fn image(&self, v: V<S>) -> V<S> {
        let [x, y, z, _] = self.frame;
        std::array::from_fn(|k| v[0] * x[k] + v[1] * y[k] + v[2] * z[k])
    }

    fn turn(&mut self, axes: &Axes, towards: [f32; 3], sin: S, cos: S) {
        let (from, towards) = (constant::<S>(axes.forward), constant::<S>(towards));
        self.turns[self.count] = Turn { from: self.image(from), towards: self.image(towards), pivot: self.frame[3] };
        self.count += 1;
        let one = S::constant(1.0);
        let turned = |v: V<S>| -> V<S> {
            let (x, y) = (dot(v, from), dot(v, towards));
            let (a, b) = (x * (cos - one) - y * sin, x * sin + y * (cos - one));
            std::array::from_fn(|k| v[k] + a * from[k] + b * towards[k])
        };
        let (zero, origin) = (S::ZERO, self.frame[3]);
        let axes = [[one, zero, zero], [zero, one, zero], [zero, zero, one]];
        let [x, y, z] = axes.map(|axis| self.image(turned(axis)));
        self.frame = [x, y, z, origin];
    }

    fn pass(&mut self, link: &[S; 12]) {
        let row = |i: usize| [link[3 * i], link[3 * i + 1], link[3 * i + 2]];
        let [x, y, z, by] = [0, 1, 2, 3].map(|i| self.image(row(i)));
        let origin = self.frame[3];
        self.frame = [x, y, z, std::array::from_fn(|k| origin[k] + by[k])];
    }

    /// Aim, then its derivatives.
    fn aim(&self, forward: [f32; 3], target: &V<S>, out: &mut [S]) {
        let forward = self.image(constant(forward));
        let to_target = sub(*target, self.frame[3]);
        let length = dot(to_target, to_target).sqrt();
        let one = S::constant(1.0);
        let inverse = S::select_less(S::TINY, length, one, S::ZERO) / S::select_less(S::TINY, length, length, one);
        let unit = to_target.map(|x| x * inverse);
        let aim = dot(unit, forward);
        let across: V<S> = std::array::from_fn(|k| (forward[k] - aim * unit[k]) * inverse);
        out[0] = aim;
        for (out, turn) in out[1..].iter_mut().zip(&self.turns[..self.count]) {
            // The origin moves and the direction turns.
            *out = turn.lever(unit, forward) - turn.lever(across, sub(self.frame[3], turn.pivot));
        }
    }

    /// The stereographic residual along two axes, then its derivatives.
    fn residual(&self, [forward, left, up]: [[f32; 3]; 3], target: &V<S>, out: &mut [S]) {
        let [forward, left, up] = [forward, left, up].map(|axis| self.image(constant(axis)));
        let to_target = sub(*target, self.frame[3]);
        let length = dot(to_target, to_target).sqrt();
        let (one, two) = (S::constant(1.0), S::constant(2.0));
        let below = length + dot(to_target, forward);
        let least = S::constant(1e-6) * length + S::TINY;
        let inverse = S::select_less(least, below, one, S::ZERO) / S::select_less(least, below, below, one);
        let per_length = S::select_less(S::TINY, length, one, S::ZERO) / S::select_less(S::TINY, length, length, one);
        for (k, axis) in [left, up].into_iter().enumerate() {
            let lateral = dot(to_target, axis);
            out[k] = two * lateral * inverse;
            let of_below = lateral * inverse;
            for (i, turn) in self.turns[..self.count].iter().enumerate() {
                // Seen from the effector, the target turns the other way about the same pivot.
                let arm = sub(*target, turn.pivot);
                let d_lateral = -turn.lever(axis, arm);
                let d_length = -(turn.lever(to_target, sub(self.frame[3], turn.pivot)) * per_length);
                let d_below = d_length - turn.lever(forward, arm);
                out[2 + k * self.count + i] = two * inverse * (d_lateral - of_below * d_below);
            }
        }
    }
}

/// The effector's forward with two directions square to it, near the first joint's left and up.
fn squared(forward: [f32; 3], axes: &Axes) -> [[f32; 3]; 3] {
    let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let unit = |a: [f32; 3]| a.map(|x| x / dot(a, a).sqrt());
    let without = |a: [f32; 3], b: [f32; 3]| -> [f32; 3] { std::array::from_fn(|k| a[k] - dot(a, b) * b[k]) };
    let up = unit(without(axes.up, forward));
    let left = unit(without(without(axes.left, forward), up));
    [forward, left, up]
}

impl Rig for NumericRig {
    fn description(&self) -> Description<'_> {
        Description::new(self.infos.as_ref()).with_effector(self.effector)
    }

    fn joint_name(&self, _: usize) -> Option<&str> {
        None
    }

    fn bone_name(&self, _: usize, _: usize) -> Option<&str> {
        None
    }

    fn residual_jacobian(&self, links: &[[f32; 12]], target: &[f32; 3], sin_cos: &[[f32; 4]], out: &mut [f32]) {
        let infos = self.infos.as_ref();
        let axes = squared(self.effector.forward, infos[0].axes());
        Carried::new(infos, links, sin_cos).residual(axes, target, out);
    }

    fn aim_gradient(
        &self,
        joint: usize,
        effector_to_joint: &[f32; 12],
        target: &[f32; 3],
        sin_cos: &[f32; 4],
    ) -> [f32; 3] {
        let mut out = [0.0; 3];
        let Some(info) = self.infos.as_ref().get(joint) else {
            return out;
        };
        Carried::new(&[*info], &[*effector_to_joint], &[*sin_cos]).aim(self.effector.forward, target, &mut out);
        if info.pitch.is_none() {
            out.swap(1, 2);
        }
        out
    }
}
