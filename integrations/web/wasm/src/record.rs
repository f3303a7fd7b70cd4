//! Records characters that are aimed by the native build. `record FILE.json` writes the inputs, frame by frame, and a
//! hash of the outputs; `tests/recorded.mjs` replays them through the package.

#[cfg(target_arch = "wasm32")]
fn main() {}

#[cfg(not(target_arch = "wasm32"))]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let out = std::env::args().nth(1).ok_or("give FILE.json")?;
    Ok(std::fs::write(out, record::cases()?)?)
}

#[cfg(not(target_arch = "wasm32"))]
mod record {
    use std::error::Error;
    use std::fmt::Write as _;

    use aim::animation::Transform;
    use aim_character::{MANNEQUIN_RIG, Mannequin, PAPER_AXES};
    use aim_gaze_wasm::{Bones, Character, Found, declared, layout, measured, of_file, preset};
    use aim_gltf::Document;

    const FRAMES: u32 = 600;

    type Axes = [[f32; 3]; 3];
    /// Up +Y, forward +Z, left +X.
    const UPRIGHT: Axes = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];

    /// A walking character: its file, and the names of its bones in an engine.
    struct Walker {
        file: Vec<u8>,
        document: Document,
        names: Vec<String>,
    }

    impl Walker {
        fn new(axes: Axes, renamed: &[(&str, &str)]) -> Result<Self, Box<dyn Error>> {
            let file = Mannequin::new().with_moves().glb(|_| axes)?;
            let document = Document::from_bytes(&file)?;
            let name = |name: &String| {
                renamed.iter().find(|(of_file, _)| of_file == name).map_or(name.clone(), |(_, name)| (*name).to_owned())
            };
            let names = document.skeleton().names().iter().map(name).collect();
            Ok(Self { file, document, names })
        }

        fn bones(&self) -> Bones {
            let skeleton = self.document.skeleton();
            let mut bones = Bones::default();
            for (bone, rest) in skeleton.rest().iter().enumerate() {
                let parent = skeleton.parents()[bone].and_then(|parent| i32::try_from(parent).ok()).unwrap_or(-1);
                bones.add(&self.names[bone], parent, &numbers(rest));
                bones.node(skeleton.source_of(bone).unwrap_or(bone));
            }
            bones
        }
    }

    /// Returns the cases as JSON. Floats are written as their bytes in hexadecimal.
    pub(crate) fn cases() -> Result<String, Box<dyn Error>> {
        let eyes = [("left_eye", "leftEye"), ("right_eye", "rightEye"), ("spine3", "upperChest")];
        let mixamo = [("left_eye", "LeftEye"), ("right_eye", "RightEye"), ("neck", "Neck"), ("spine3", "Spine2")];
        let (vrm, mixamo) = (Walker::new(UPRIGHT, &eyes)?, Walker::new(UPRIGHT, &mixamo)?);
        let plain = Walker::new(PAPER_AXES, &[])?;
        let cases = [
            case("vrm", "\"vrm\"", true, &vrm, &preset(&vrm.bones(), "vrm", true)?)?,
            case("vrm, one eye follows", "\"vrm\"", false, &vrm, &preset(&vrm.bones(), "vrm", false)?)?,
            case("mixamo", "\"mixamo\"", true, &mixamo, &preset(&mixamo.bones(), "mixamo", true)?)?,
            case("measured", "\"measure\"", true, &plain, &measured(&plain.bones(), true)?)?,
            case("measured from its file", "\"file\"", true, &plain, &of_file(&plain.bones(), &plain.file, true)?)?,
            case("declared", "\"toml\"", true, &plain, &declared(&plain.bones(), "rig.toml", MANNEQUIN_RIG, true)?)?,
        ];
        let file: String = hex(plain.file.iter().copied());
        Ok(format!("{{\"file\":\"{file}\",\"toml\":{MANNEQUIN_RIG:?},\"cases\":[{}]}}\n", cases.join(",\n")))
    }

    fn case(name: &str, rig: &str, both_eyes: bool, walker: &Walker, found: &Found) -> Result<String, Box<dyn Error>> {
        let (document, skeleton) = (&walker.document, walker.document.skeleton());
        let mut character = Character::new(found);
        let bones = character.bones().to_vec();
        let (mut input, mut hash) = (Vec::new(), Fnv::default());
        let mut random = Random(name.len() as u64);
        let (walk, mut target) = (document.clip("walk")?, [0.3, 1.6, 2.0]);
        for frame in 0..FRAMES {
            let pose = skeleton.pose(walk, frame as f32 / 60.0);
            let dt = if frame % 31 == 7 { 0.0 } else { [1.0 / 60.0, 1.0 / 144.0, 1.0 / 24.0][frame as usize / 200] };
            // The target wanders, jumps from time to time, and passes behind, above and far from the character.
            let step: [f32; 3] = std::array::from_fn(|_| 0.02 * random.next());
            target = std::array::from_fn(|axis| target[axis] + step[axis]);
            if frame % 97 == 0 {
                target = [3.0 * random.next(), 1.6 + random.next(), 3.0 * random.next()];
            }
            let count = [1, 1, 2, 0][frame as usize / 50 % 4];
            let settings = [
                if frame % 300 > 250 { 0.5 } else { 1.0 },
                if frame % 200 > 100 { 0.6 } else { 0.0 },
                f32::INFINITY,
                0.002,
                (frame / 150 % 5) as f32,
            ];
            let snap = frame % 113 == 0;
            let block = character.block();
            // The character is turned, and mirrored in the third quarter of the frames.
            let sign = if frame / 150 == 2 { -1.0 } else { 1.0 };
            block[layout::PLACE..][..16].copy_from_slice(&[
                0.6 * sign,
                0.0,
                -0.8 * sign,
                0.0,
                0.0,
                1.0,
                0.0,
                0.0,
                0.8,
                0.0,
                0.6,
                0.0,
                0.25,
                0.5,
                -0.125,
                1.0,
            ]);
            block[layout::SETTINGS..][..settings.len()].copy_from_slice(&settings);
            let points = [target[0], target[1], target[2], 0.75, -target[0], 1.5, target[2], 0.25];
            block[layout::TARGETS..][..8].copy_from_slice(&points);
            for (at, &bone) in bones.iter().enumerate() {
                block[layout::BONES + 10 * at..][..10].copy_from_slice(&numbers(&pose[bone]));
            }
            let written = layout::BONES + 10 * bones.len();
            input.extend([dt, count as f32, f32::from(u8::from(snap))]);
            input.extend_from_slice(&block[..layout::SETTINGS + settings.len()]);
            input.extend(points);
            input.extend_from_slice(&block[layout::BONES..written]);
            character.update(dt, count, snap);
            let moved = character.written().to_vec();
            let block = character.block();
            for bone in moved {
                block[layout::BONES + 10 * bone..][..7].iter().for_each(|x| hash.float(*x));
            }
            block[layout::OUTCOME..][..4].iter().chain(&block[written..]).for_each(|x| hash.float(*x));
        }
        let mut told = String::new();
        for (bone, name) in walker.names.iter().enumerate() {
            let parent = skeleton.parents()[bone].map_or(-1, |parent| parent as i64);
            let node = skeleton.source_of(bone).unwrap_or(bone);
            let rest = hex(numbers(&skeleton.rest()[bone]).iter().flat_map(|x| x.to_le_bytes()));
            write!(told, "{}[{name:?},{parent},{node},\"{rest}\"]", if bone == 0 { "" } else { "," })?;
        }
        let input = hex(input.iter().flat_map(|x| x.to_le_bytes()));
        Ok(format!(
            "{{\"name\":\"{name}\",\"rig\":{rig},\"bothEyes\":{both_eyes},\"hash\":\"{:016x}\",\"bones\":[{told}],\"used\":{bones:?},\"input\":\"{input}\"}}",
            hash.0
        ))
    }

    fn numbers(Transform { translation, rotation, scale }: &Transform) -> [f32; 10] {
        let ([x, y, z], [i, j, k, w], [a, b, c]) = (translation.to_array(), rotation.to_array(), scale.to_array());
        [x, y, z, i, j, k, w, a, b, c]
    }

    fn hex(bytes: impl IntoIterator<Item = u8>) -> String {
        bytes.into_iter().fold(String::new(), |mut text, byte| {
            let _ = write!(text, "{byte:02x}");
            text
        })
    }

    /// Pseudorandom numbers in −1…1 (splitmix64).
    struct Random(u64);

    impl Random {
        fn next(&mut self) -> f32 {
            self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut z = self.0;
            z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
            (z >> 40) as f32 / (1_u64 << 23) as f32 - 1.0
        }
    }

    /// FNV-1a hash.
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
    }
}
