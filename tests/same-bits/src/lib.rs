//! Runs the solvers for thousands of frames on random targets, poses and time steps, and hashes every bit of the
//! results. The hashes are the same in debug and release builds, on x86-64 with and without newer instructions, and on
//! wasm32.
//!
//! `golden.txt` holds the hashes, and `.ci/run` compares them. After an intended change of bits,
//! `cargo run --manifest-path tests/same-bits/Cargo.toml -- --write tests/same-bits/golden.txt` writes them anew.
//!
//! The inputs are made by sums, products, quotients and square roots alone, which are exactly rounded on every machine.

mod animated;
mod layered;
mod limbs;

use aim::glam::{Affine3A, Quat, Vec3};
use aim::{Aim, AimRig, Aimed, Ascent, Behind, Joint, Outcome, Pose, Settings, Solver, State, Status, Target};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z), effector(forward = (0.6, 0.8, 0.0), origin = (0.01, 0.02, 0.0)))]
struct Gazer {
    #[joint(role = eye, heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg, stiffness = 0.5)]
    left_eye: Joint,
    #[joint(role = neck, heading = -60deg..=60deg, pitch = -40deg..=35deg, rate = 170deg, acceleration = 1200deg, upright = 1.0)]
    neck: Joint,
    #[joint(role = chest, axes(up = +Y, forward = +Z), heading = -20deg..=20deg, pitch = -10deg..=10deg, rate = 70deg,
        stiffness = 4.0, acceleration = 500deg, limits_from = bind_pose)]
    spine3: Joint,
}

/// A rig whose effector has no offset, so that two eyes converge.
#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Eyes {
    #[joint(role = eye, heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg, stiffness = 0.5)]
    left_eye: Joint,
    #[joint(role = neck, heading = -60deg..=60deg, pitch = -40deg..=35deg, rate = 170deg, acceleration = 1200deg)]
    neck: Joint,
    #[joint(role = chest, heading = free, rate = 70deg, stiffness = 4.0)]
    spine3: Joint,
}

/// A rig without optional settings, like most rigs, which takes the code path of ordinary frames.
#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Plain {
    #[joint(role = eye, heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg, stiffness = 0.5)]
    left_eye: Joint,
    #[joint(role = neck, heading = -60deg..=60deg, pitch = -40deg..=35deg, rate = 170deg)]
    neck: Joint,
    #[joint(role = chest, axes(up = +Y, forward = +Z), heading = -20deg..=20deg, pitch = -10deg..=10deg, rate = 70deg,
        stiffness = 4.0)]
    spine3: Joint,
}

/// A single eye, which is solved in closed form.
#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Alone {
    #[joint(role = eye, heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg)]
    left_eye: Joint,
}

/// Names of the runs, in the order of `golden.txt`.
pub const RUNS: [&str; 13] = [
    "exact",
    "natural",
    "ascent",
    "published ascent",
    "snaps",
    "both eyes",
    "stretched poses",
    "several targets",
    "ordinary frames",
    "an eye alone",
    "limbs and looks",
    "an animated character",
    "layers on a stored clip",
];

const FRAMES: u32 = 2000;

/// Returns the hash of a run; 0 if there is no run with this number.
#[unsafe(no_mangle)]
pub extern "C" fn hash(run: u32) -> u64 {
    let Some(name) = RUNS.get(run as usize) else { return 0 };
    if *name == "limbs and looks" {
        return limbs::run(World::new(u64::from(run)));
    }
    if *name == "an animated character" {
        return animated::run(World::new(u64::from(run)));
    }
    if *name == "layers on a stored clip" {
        return layered::run(World::new(u64::from(run)));
    }
    let solver = match *name {
        "exact" | "ordinary frames" | "an eye alone" => Solver::Exact,
        "ascent" | "published ascent" => Solver::Ascent,
        _ => Solver::Natural,
    };
    let mut settings = Settings::default().with_solver(solver);
    if *name == "published ascent" {
        settings = settings.with_ascent(Ascent::paper());
    }
    let (mut gazer, mut eyes, mut plain, mut alone) =
        (Aim::<Gazer>::new(), Aim::<Eyes>::new(), Aim::<Plain>::new(), Aim::<Alone>::new());
    let (mut world, mut hash) = (World::new(u64::from(run)), Fnv::default());
    for frame in 0..FRAMES {
        world.pass(frame, *name == "stretched poses");
        if frame % 200 == 0 {
            settings = settings
                .with_solver(if *name == "natural" || frame % 400 == 0 { solver } else { Solver::Exact })
                .with_behind([Behind::Clip, Behind::Off, Behind::Hold, Behind::Release][frame as usize / 200 % 4])
                .with_weight(if frame % 600 == 400 { 0.7 } else { 1.0 })
                .with_attention(if frame % 800 == 600 { 0.5 } else { 0.0 });
            if solver == Solver::Ascent {
                settings = settings.with_solver(solver);
            }
        }
        let pose = world.pose();
        match *name {
            "snaps" => hash.aimed(&gazer.snap(&pose, world.target, &settings), &gazer.state),
            "both eyes" => {
                let pose = pose.with_other_eye(world.pair());
                hash.aimed(&eyes.aim(&pose, world.target, world.dt, &settings), &eyes.state);
            }
            "several targets" => {
                let targets = [Target::new(world.target, 0.6), Target::new(-world.target, 0.3)];
                hash.aimed(&gazer.aim(&pose, &targets, world.dt, &settings), &gazer.state);
            }
            "ordinary frames" => hash.aimed(&plain.aim(&pose, world.target, world.dt, &settings), &plain.state),
            "an eye alone" => {
                let pose = Pose::new([pose.joints[0]]);
                hash.aimed(&alone.aim(&pose, world.target, world.dt, &settings), &alone.state);
            }
            _ => hash.aimed(&gazer.aim(&pose, world.target, world.dt, &settings), &gazer.state),
        }
    }
    hash.0
}

/// A 64-bit FNV-1a hash.
struct Fnv(u64);

impl Default for Fnv {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Fnv {
    fn float(&mut self, x: f32) {
        for byte in x.to_bits().to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    fn turns(&mut self, turns: &[Quat]) {
        turns.iter().flat_map(|turn| turn.to_array()).for_each(|x| self.float(x));
    }

    fn outcome(&mut self, outcome: &Outcome) {
        self.float(outcome.aim);
        self.float(outcome.remaining);
        self.float(match outcome.status {
            Status::Reached => 1.0,
            Status::RateLimited => 2.0,
            Status::AtLimit => 3.0,
            Status::Behind => 4.0,
            _ => 5.0,
        });
    }

    fn aimed<const N: usize>(&mut self, aimed: &Aimed<[Quat; N]>, state: &State<[Joint; N]>) {
        self.outcome(&aimed.outcome);
        for joint in &state.joints {
            self.float(joint.heading());
            self.float(joint.pitch());
        }
        self.turns(&aimed.corrections);
        if let Some(correction) = aimed.outcome.other_eye_correction {
            self.turns(&[correction]);
        }
    }
}

/// A random animation, target and clock.
struct World {
    random: u64,
    /// Orientation of each bone in the character, a quaternion.
    turns: [[f32; 4]; 3],
    target: Vec3,
    velocity: Vec3,
    stretch: Vec3,
    dt: f32,
}

impl World {
    fn new(seed: u64) -> Self {
        let upright = [[0.0, 0.0, 0.0, 1.0]; 3];
        let target = Vec3::new(0.3, 1.6, -2.0);
        Self { random: seed, turns: upright, target, velocity: Vec3::ZERO, stretch: Vec3::ONE, dt: 0.0 }
    }

    /// Returns a random number in −1…1 (splitmix64).
    fn random(&mut self) -> f32 {
        self.random = self.random.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.random;
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        (z >> 40) as f32 / (1_u64 << 23) as f32 - 1.0
    }

    fn vector(&mut self) -> Vec3 {
        Vec3::new(self.random(), self.random(), self.random())
    }

    /// Advances to the next frame.
    fn pass(&mut self, frame: u32, stretched: bool) {
        for joint in 0..3 {
            // Pull the orientation back towards upright, and add a small random change.
            let by = self.vector();
            let [x, y, z, w] = self.turns[joint];
            let [x, y, z] = [0.98 * x + 0.02 * by.x, 0.98 * y + 0.02 * by.y, 0.98 * z + 0.02 * by.z];
            let per_length = 1.0 / (x * x + y * y + z * z + w * w).sqrt();
            self.turns[joint] = [x, y, z, w].map(|x| x * per_length);
        }
        // The target wanders, jumps now and then, and passes overhead, behind and close to the nose.
        let pull = self.vector();
        let home = Vec3::new(0.0, 1.6, -1.0);
        let towards = |from: f32, to: f32, pull: f32| 0.02 * pull + 0.001 * (to - from);
        self.velocity = Vec3::new(
            0.97 * self.velocity.x + towards(self.target.x, home.x, pull.x),
            0.97 * self.velocity.y + towards(self.target.y, home.y, pull.y),
            0.97 * self.velocity.z + towards(self.target.z, home.z, pull.z),
        );
        let step = [self.target.x + self.velocity.x, self.target.y + self.velocity.y, self.target.z + self.velocity.z];
        self.target = Vec3::from(step);
        if frame % 97 == 0 {
            let by = self.vector();
            self.target = Vec3::new(3.0 * by.x, 1.6 + 2.0 * by.y, 3.0 * by.z);
        }
        if frame % 500 == 250 {
            self.target = Vec3::new(0.0, 4.0, 0.0);
        }
        self.dt = match frame % 31 {
            7 => 0.0,
            13 => 0.05 + 0.05 * self.random(),
            _ => [1.0 / 30.0, 1.0 / 60.0, 1.0 / 144.0][frame as usize / 300 % 3],
        };
        if stretched && frame % 50 == 0 {
            let by = self.vector();
            self.stretch = Vec3::new(1.0 + 0.4 * by.x, 1.0 + 0.4 * by.y, 1.0 + 0.4 * by.z);
        }
    }

    /// Returns a bone at a position of the character; `columns` are its own axes in the world before rotation.
    fn bone(&self, joint: usize, columns: [Vec3; 3], at: Vec3) -> Affine3A {
        let [x, y, z, w] = self.turns[joint];
        let turn = |v: Vec3| {
            let (tx, ty, tz) = (2.0 * (y * v.z - z * v.y), 2.0 * (z * v.x - x * v.z), 2.0 * (x * v.y - y * v.x));
            [
                (v.x + w * tx + (y * tz - z * ty)) * self.stretch.x,
                (v.y + w * ty + (z * tx - x * tz)) * self.stretch.y,
                (v.z + w * tz + (x * ty - y * tx)) * self.stretch.z,
            ]
        };
        let [a, b, c] = columns.map(turn);
        let at = [at.x * self.stretch.x, at.y * self.stretch.y, at.z * self.stretch.z];
        Affine3A::from_cols_array_2d(&[a, b, c, at])
    }

    /// Returns the pose of the character, which faces −Z with +Y up.
    fn pose(&self) -> Pose<[Affine3A; 3]> {
        let [up, forward, left] = [Vec3::Y, Vec3::NEG_Z, Vec3::NEG_X];
        Pose::new([
            self.bone(0, [up, forward, left], Vec3::new(-0.03, 1.68, -0.1)),
            self.bone(1, [up, forward, left], Vec3::new(0.0, 1.55, 0.02)),
            self.bone(2, [left, up, forward], Vec3::new(0.0, 1.3, 0.03)),
        ])
    }

    fn pair(&self) -> Affine3A {
        self.bone(0, [Vec3::NEG_Z, Vec3::Y, Vec3::X], Vec3::new(0.03, 1.68, -0.1))
    }
}
