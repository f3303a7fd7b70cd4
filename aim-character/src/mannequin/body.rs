//! The mannequin's body: one surface per material, each part bound to the joints inside it.

use aim_runtime::glam::DVec3;

use super::joints::Joint;
use super::shape::{Binding, Ring, ShapeMesh, between, rigid};

/// A material of the mannequin.
pub(crate) struct Tint {
    pub(crate) name: &'static str,
    /// Colour in linear RGB.
    pub(crate) colour: [f64; 3],
    pub(crate) roughness: f64,
}

/// Materials, in the order of [`surfaces`].
pub(crate) const MATERIALS: [Tint; 8] = [
    Tint { name: "skin", colour: [0.72, 0.42, 0.29], roughness: 0.7 },
    Tint { name: "shirt", colour: [0.06, 0.22, 0.34], roughness: 0.9 },
    Tint { name: "trousers", colour: [0.09, 0.09, 0.12], roughness: 0.9 },
    Tint { name: "shoes", colour: [0.16, 0.07, 0.03], roughness: 0.6 },
    Tint { name: "hair", colour: [0.06, 0.03, 0.015], roughness: 0.8 },
    Tint { name: "eye_white", colour: [0.88, 0.88, 0.86], roughness: 0.25 },
    Tint { name: "iris", colour: [0.05, 0.2, 0.3], roughness: 0.25 },
    Tint { name: "pupil", colour: [0.005, 0.005, 0.005], roughness: 0.2 },
];

/// Radius of an eyeball, metres.
const EYE: f64 = 0.0185;

struct BodyBuilder<'a> {
    joints: &'a [Joint],
    surfaces: [ShapeMesh; 8],
}

/// Returns the surfaces of all materials, in the order of [`MATERIALS`].
pub(crate) fn surfaces(joints: &[Joint]) -> [ShapeMesh; 8] {
    let mut body = BodyBuilder { joints, surfaces: Default::default() };
    body.trunk();
    body.head();
    for (side, sign) in [("left", 1.0), ("right", -1.0)] {
        body.eye(side);
        body.arm(side, sign);
        body.leg(side, sign);
    }
    body.surfaces
}

impl BodyBuilder<'_> {
    fn joint(&self, name: &str) -> usize {
        self.joints.iter().position(|joint| joint.name == name).unwrap_or(0)
    }

    fn sided(&self, side: &str, name: &str) -> usize {
        self.joint(&format!("{side}_{name}"))
    }

    /// Returns the binding along the column: a point follows the joint below it, and within 3.5 cm of a joint it blends
    /// with that joint.
    fn column(&self) -> impl Fn(f64) -> Binding + use<> {
        let names = ["hips", "spine", "spine1", "spine2", "spine3", "neck"];
        let column: Vec<(usize, f64)> =
            names.iter().map(|name| self.joint(name)).map(|index| (index, self.joints[index].position.y)).collect();
        move |y| {
            for pair in column.windows(2) {
                let ((a, _), (b, joint)) = (pair[0], pair[1]);
                if y < joint + 0.035 {
                    return between(a, b, (y - joint + 0.035) / 0.07);
                }
            }
            rigid(column[column.len() - 1].0)
        }
    }

    fn trunk(&mut self) {
        let column = self.column();
        let ring = |y: f64, aside: f64, ahead: f64, z: f64| Ring::new([0.0, y, z], ahead, aside);
        let trousers = [
            ring(0.85, 0.05, 0.05, 0.0),
            ring(0.865, 0.115, 0.085, 0.0),
            ring(0.90, 0.158, 0.103, -0.005),
            ring(0.95, 0.165, 0.108, -0.008),
            ring(1.00, 0.152, 0.102, -0.002),
            ring(1.03, 0.142, 0.097, 0.0),
        ];
        self.surfaces[2].loft(&trousers, 32, |p| column(p.y));
        let shirt = [
            ring(0.985, 0.150, 0.100, -0.002),
            ring(0.99, 0.158, 0.107, -0.002),
            ring(1.03, 0.150, 0.104, 0.0),
            ring(1.09, 0.143, 0.100, 0.002),
            ring(1.16, 0.150, 0.104, 0.002),
            ring(1.23, 0.162, 0.112, 0.003),
            ring(1.30, 0.172, 0.117, 0.003),
            ring(1.36, 0.178, 0.112, 0.0),
            ring(1.40, 0.183, 0.100, -0.005),
            ring(1.43, 0.180, 0.084, -0.008),
            ring(1.448, 0.158, 0.074, -0.008),
            ring(1.466, 0.120, 0.066, -0.008),
            ring(1.48, 0.085, 0.060, -0.007),
            ring(1.49, 0.062, 0.057, -0.006),
        ];
        let clavicles = [self.joint("left_clavicle"), self.joint("right_clavicle")];
        let spine3 = self.joint("spine3");
        let bind = |p: DVec3| {
            // The outer, upper part of the shoulders follows the clavicles.
            let share = ((p.x.abs() - 0.09) / 0.08).clamp(0.0, 1.0) * ((p.y - 1.36) / 0.05).clamp(0.0, 1.0) * 0.7;
            if share > 0.0 { between(spine3, clavicles[usize::from(p.x < 0.0)], share) } else { column(p.y) }
        };
        self.surfaces[1].loft(&shirt, 40, bind);
    }

    fn head(&mut self) {
        let (spine3, neck, head) = (self.joint("spine3"), self.joint("neck"), self.joint("head"));
        let rings = [
            Ring::new([0.0, 1.45, -0.012], 0.054, 0.058),
            Ring::new([0.0, 1.49, -0.008], 0.051, 0.054),
            Ring::new([0.0, 1.52, -0.004], 0.049, 0.050),
            Ring::new([0.0, 1.555, 0.0], 0.049, 0.049),
            Ring::new([0.0, 1.585, 0.0], 0.052, 0.050),
        ];
        let bind = |p: DVec3| {
            if p.y < 1.53 {
                between(spine3, neck, (p.y - 1.46) / 0.06)
            } else {
                between(neck, head, (p.y - 1.545) / 0.05)
            }
        };
        self.surfaces[0].loft(&rings, 28, bind);
        let on_head = |_: DVec3| rigid(head);
        let skin = &mut self.surfaces[0];
        let level = |y: f64, aside: f64, ahead: f64, z: f64| Ring::new([0.0, y, z], ahead, aside);
        let skull = [
            level(1.523, 0.012, 0.012, 0.046),
            level(1.528, 0.028, 0.030, 0.044),
            level(1.540, 0.042, 0.052, 0.031),
            level(1.556, 0.051, 0.066, 0.021),
            level(1.575, 0.058, 0.077, 0.013),
            level(1.600, 0.065, 0.087, 0.007),
            level(1.630, 0.0725, 0.096, 0.003),
            level(1.660, 0.0765, 0.1045, 0.001),
            level(1.685, 0.0765, 0.103, -0.001),
            level(1.705, 0.072, 0.094, -0.003),
            level(1.722, 0.061, 0.080, -0.005),
            level(1.734, 0.044, 0.058, -0.007),
            level(1.741, 0.024, 0.032, -0.008),
            level(1.743, 0.010, 0.014, -0.008),
        ];
        skin.stack(&skull, 40, on_head);
        // The nose, its bridge, the ears.
        skin.ellipsoid([0.0, 1.622, 0.099], [0.0125, 0.013, 0.015], 12, on_head);
        skin.ellipsoid([0.0, 1.640, 0.096], [0.0085, 0.030, 0.011], 14, on_head);
        for x in [0.076, -0.076] {
            skin.ellipsoid([x, 1.640, -0.008], [0.009, 0.029, 0.017], 14, on_head);
        }
        // The hair is the part of its ellipsoid outside the skull. Then brows, and the line of the mouth.
        let hair = &mut self.surfaces[4];
        hair.ellipsoid([0.0, 1.671, -0.021], [0.083, 0.085, 0.097], 32, on_head);
        for x in [0.031, -0.031] {
            hair.ellipsoid([x, 1.6905, 0.090], [0.017, 0.0032, 0.005], 12, on_head);
        }
        hair.ellipsoid([0.0, 1.579, 0.0895], [0.019, 0.0020, 0.003], 12, on_head);
    }

    fn eye(&mut self, side: &str) {
        let eye = self.sided(side, "eye");
        let centre = self.joints[eye].position;
        let bind = |_: DVec3| rigid(eye);
        self.surfaces[5].ellipsoid(centre, DVec3::splat(EYE), 20, bind);
        self.surfaces[6].cap(centre, EYE * 1.012, 0.50, bind);
        self.surfaces[7].cap(centre, EYE * 1.024, 0.24, bind);
    }

    fn arm(&mut self, side: &str, sign: f64) {
        let [clavicle, upper, lower, hand] =
            ["clavicle", "upper_arm", "lower_arm", "hand"].map(|n| self.sided(side, n));
        let [shoulder, elbow, wrist] = [upper, lower, hand].map(|j| self.joints[j].position);
        let ring = |a: DVec3, b: DVec3, t: f64, r: f64| Ring::new(a.lerp(b, t), r, r);
        let tip = wrist + (wrist - elbow).normalize() * 0.17;
        let bind = |p: DVec3| {
            if p.y > shoulder.y - 0.07 {
                between(upper, clavicle, (p.y - shoulder.y + 0.05) / 0.14)
            } else if p.y > wrist.y + 0.05 {
                between(upper, lower, (elbow.y - p.y + 0.04) / 0.08)
            } else {
                between(lower, hand, (wrist.y - p.y + 0.02) / 0.04)
            }
        };
        let sleeve = [
            Ring::new(shoulder + DVec3::new(-0.022 * sign, 0.030, 0.0), 0.018, 0.016),
            Ring::new(shoulder + DVec3::new(-0.016 * sign, 0.024, 0.0), 0.036, 0.031),
            Ring::new(shoulder + DVec3::new(-0.008 * sign, 0.008, 0.0), 0.050, 0.045),
            ring(shoulder, elbow, 0.06, 0.055),
            ring(shoulder, elbow, 0.16, 0.056),
            ring(shoulder, elbow, 0.35, 0.053),
            ring(shoulder, elbow, 0.6, 0.049),
            ring(shoulder, elbow, 0.72, 0.0485),
            ring(shoulder, elbow, 0.725, 0.043),
        ];
        self.surfaces[1].loft(&sleeve, 24, bind);
        let skin = &mut self.surfaces[0];
        let forearm = [
            ring(shoulder, elbow, 0.6, 0.040),
            ring(shoulder, elbow, 0.85, 0.040),
            ring(shoulder, elbow, 0.97, 0.0395),
            ring(elbow, wrist, 0.06, 0.0395),
            ring(elbow, wrist, 0.2, 0.041),
            ring(elbow, wrist, 0.5, 0.036),
            ring(elbow, wrist, 0.8, 0.028),
            ring(elbow, wrist, 0.97, 0.0255),
            Ring::new(wrist.lerp(tip, 0.12), 0.032, 0.020),
            Ring::new(wrist.lerp(tip, 0.3), 0.041, 0.019),
            Ring::new(wrist.lerp(tip, 0.55), 0.042, 0.018),
            Ring::new(wrist.lerp(tip, 0.8), 0.037, 0.015),
            Ring::new(wrist.lerp(tip, 0.95), 0.027, 0.011),
            Ring::new(tip, 0.012, 0.006),
        ];
        skin.loft(&forearm, 24, bind);
        let thumb = [
            Ring::new(wrist.lerp(tip, 0.15) + DVec3::Z * 0.018, 0.012, 0.011),
            Ring::new(wrist.lerp(tip, 0.3) + DVec3::Z * 0.042, 0.013, 0.012),
            Ring::new(wrist.lerp(tip, 0.5) + DVec3::Z * 0.054, 0.011, 0.010),
            Ring::new(wrist.lerp(tip, 0.6) + DVec3::Z * 0.057, 0.006, 0.005),
        ];
        skin.loft(&thumb, 14, |_| rigid(hand));
    }

    fn leg(&mut self, side: &str, sign: f64) {
        let [upper, lower, foot, toes] = ["upper_leg", "lower_leg", "foot", "toes"].map(|n| self.sided(side, n));
        let [hip, knee, ankle] = [upper, lower, foot].map(|j| self.joints[j].position);
        let hips = self.joint("hips");
        let ring = |a: DVec3, b: DVec3, t: f64, r: f64| Ring::new(a.lerp(b, t), r, r * 0.95);
        let bind = |p: DVec3| {
            if p.y > hip.y - 0.14 {
                between(upper, hips, (p.y - hip.y + 0.06) / 0.12)
            } else if p.y > knee.y - 0.12 {
                between(upper, lower, (knee.y - p.y + 0.06) / 0.12)
            } else {
                between(lower, foot, (ankle.y - p.y + 0.03) / 0.05)
            }
        };
        let rings = [
            Ring::new(hip + DVec3::new(-0.006 * sign, 0.035, -0.004), 0.075, 0.055),
            Ring::new(hip + DVec3::new(-0.004 * sign, 0.0, -0.004), 0.092, 0.076),
            ring(hip, knee, 0.12, 0.090),
            ring(hip, knee, 0.35, 0.083),
            ring(hip, knee, 0.65, 0.071),
            ring(hip, knee, 0.9, 0.062),
            ring(knee, ankle, 0.02, 0.060),
            ring(knee, ankle, 0.15, 0.061),
            ring(knee, ankle, 0.35, 0.061),
            ring(knee, ankle, 0.7, 0.052),
            ring(knee, ankle, 0.93, 0.049),
            ring(knee, ankle, 0.97, 0.048),
            ring(knee, ankle, 0.975, 0.040),
        ];
        // The loft runs downward from hip to ankle. Its rings turn with the path, so the triangles still face outward.
        self.surfaces[2].loft(&rings, 28, bind);
        let shoe_bind = |p: DVec3| {
            if p.z > 0.05 { between(foot, toes, (p.z - 0.075) / 0.04) } else { rigid(foot) }
        };
        let shoes = &mut self.surfaces[3];
        let first = shoes.positions.len();
        let x = ankle.x;
        shoes.ellipsoid([x + 0.004 * sign, 0.035, 0.055], [0.046, 0.046, 0.125], 24, shoe_bind);
        shoes.ellipsoid([x, 0.055, -0.022], [0.043, 0.062, 0.052], 20, shoe_bind);
        // Flatten the soles on the ground.
        shoes.positions.iter_mut().skip(first).for_each(|p| p.y = p.y.max(0.0));
    }
}
