//! [`BoneName`]: a bone name split into words and a side, and the body part that it suggests. The result is a guess for
//! measurements and proposals: how a declared joint moves never depends on its name.

use alloc::borrow::ToOwned;
use alloc::string::String;
use alloc::vec::Vec;

use crate::Role;

/// The character's left or right, as stated by a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The character's left.
    Left,
    /// The character's right.
    Right,
}

/// The part of the body that a name suggests.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BodyPart {
    /// An eye, with the side that the name states.
    Eye(Option<Side>),
    /// The head.
    Head,
    /// A bone of the neck.
    Neck,
    /// A bone of the trunk above the hips.
    Spine,
    /// The pelvis.
    Hips,
}

/// The lower-case words of a bone name, with the side removed. Numbers are separate words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BoneName {
    /// The words in the order of the name.
    pub words: Vec<String>,
    /// The first side that a word states.
    pub side: Option<Side>,
}

/// Words that mark helpers, tips, controls and worn items, which only resemble the bone that they accompany.
const HELPERS: &str = "
    end nub tip top target ctrl control ik pole socket helper twist mch tweak aim look master hat hair tail attach
    attachment slot mount locator dummy gear";
/// Words for the parts around an eye.
const AROUND_EYES: &str = "
    lid lids brow brows blink lash lashes eyelid eyelids eyebrow eyebrows eyelash eyelashes bottom upper lower
    inner outer corner squint bag socket highlight cheek";
const EYES: &str = "eye eyes eyeball eyeballs 目";
const HEADS: &str = "head skull cranium 頭";
const NECKS: &str = "neck cervical 首";
const SPINES: &str = "spine chest upperchest torso thorax ribcage abdomen belly waist lowerback 上半身";
const HIPS: &str = "hips hip pelvis 下半身";

impl BoneName {
    /// Splits a bone name; accepts the common naming conventions.
    #[must_use]
    pub fn new(name: &str) -> Self {
        let mut words = Vec::new();
        let mut side = None;
        for word in split(name) {
            let (found, rest) = side_of(&word);
            side = side.or(found);
            if !rest.is_empty() {
                words.push(rest.to_owned());
            }
        }
        Self { words, side }
    }

    /// Returns `true` if one of the words in the name is in `any_of`, a list separated by white space.
    #[must_use]
    pub fn has(&self, any_of: &str) -> bool {
        any_of.split_whitespace().any(|word| self.words.iter().any(|own| own == word))
    }

    /// Returns the name without the words that mark a control.
    #[must_use]
    pub fn without_control(mut self) -> Self {
        self.words.retain(|word| !matches!(word.as_str(), "ctrl" | "control"));
        self
    }

    /// Returns the words without the numbers, joined. The key is the same for the left and right bone of a pair.
    #[must_use]
    pub fn key(&self) -> String {
        self.words.iter().filter(|w| !w.starts_with(|c: char| c.is_ascii_digit())).map(String::as_str).collect()
    }

    /// Returns the last number in the name.
    #[must_use]
    pub fn number(&self) -> Option<u32> {
        self.words.iter().rev().find_map(|word| word.parse().ok())
    }

    /// Returns `true` if the name is that of an eyeball. If a character has eyeballs, its other "eyes" are lids.
    #[must_use]
    pub fn is_eyeball(&self) -> bool {
        self.has("eyeball eyeballs") || (self.has("eye") && self.has("ball"))
    }

    /// Returns the part of the body that the name suggests, if any. Only eyes may have a side.
    #[must_use]
    pub fn body_part(&self) -> Option<BodyPart> {
        let eye = self.has(EYES);
        if self.has(HELPERS) || (eye && self.has(AROUND_EYES)) {
            return None;
        }
        if eye {
            return Some(BodyPart::Eye(self.side));
        }
        if self.side.is_some() {
            return None;
        }
        if self.has(HEADS) {
            Some(BodyPart::Head)
        } else if self.has(NECKS) {
            Some(BodyPart::Neck)
        } else if self.has(SPINES) || (self.has("lower") && self.has("back")) || (self.has("rib") && self.has("cage")) {
            Some(BodyPart::Spine)
        } else if self.has(HIPS) {
            Some(BodyPart::Hips)
        } else {
            None
        }
    }

    /// Returns the most likely role of a joint with this name, if the name suggests one.
    #[must_use]
    pub fn role(&self) -> Option<Role> {
        match self.body_part()? {
            BodyPart::Eye(_) => Some(Role::Eye),
            BodyPart::Head => Some(Role::Head),
            BodyPart::Neck => Some(Role::Neck),
            BodyPart::Spine => Some(Role::Chest),
            BodyPart::Hips => None,
        }
    }
}

/// Splits a name at separators, between letters and digits, and where a capital starts a word (`LEyeTop` → l, eye,
/// top). Only ASCII capitals are recognised, because the known words are ASCII: full Unicode case tables would be
/// larger than the rest of a downloaded program's name handling.
fn split(name: &str) -> Vec<String> {
    let chars: Vec<char> = name.chars().collect();
    let mut words: Vec<String> = Vec::new();
    let mut open = false;
    for (i, &c) in chars.iter().enumerate() {
        if !c.is_alphanumeric() {
            open = false;
            continue;
        }
        let before = i.checked_sub(1).map(|k| chars[k]);
        let starts = before.is_some_and(|b| {
            let is_small = |c: &char| c.is_ascii_lowercase();
            let capital = c.is_ascii_uppercase() && (is_small(&b) || chars.get(i + 1).is_some_and(is_small));
            capital || c.is_ascii_digit() != b.is_ascii_digit()
        });
        match words.last_mut() {
            Some(word) if open && !starts => word.push(c.to_ascii_lowercase()),
            _ => words.push(c.to_ascii_lowercase().into()),
        }
        open = true;
    }
    words
}

/// Splits the side off a word. Returns the side and the rest of the word.
fn side_of(word: &str) -> (Option<Side>, &str) {
    // Drop the generic suffix of `headbone`, `neckjoint`.
    let word = ["bone", "joint", "jnt"].iter().find_map(|end| word.strip_suffix(end)).unwrap_or(word);
    match word {
        "l" | "lft" => return (Some(Side::Left), ""),
        "r" | "rgt" => return (Some(Side::Right), ""),
        "leye" => return (Some(Side::Left), "eye"),
        "reye" => return (Some(Side::Right), "eye"),
        _ => {}
    }
    for (text, side) in [("left", Side::Left), ("right", Side::Right), ("左", Side::Left), ("右", Side::Right)] {
        if let Some(rest) = word.strip_prefix(text).or_else(|| word.strip_suffix(text)) {
            return (Some(side), rest);
        }
    }
    (None, word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bone_names_are_split_into_side_and_key() {
        let cases = [
            ("L_eyeBall_joint2", Some(Side::Left), "eyeball"),
            ("Bip01 REyeBlinkTop", Some(Side::Right), "bipeyeblinktop"),
            ("mixamorig:LeftEye", Some(Side::Left), "mixamorigeye"),
            ("UpperArm.R", Some(Side::Right), "upperarm"),
            ("upperarm_l", Some(Side::Left), "upperarm"),
            ("UpperArmL", Some(Side::Left), "upperarm"),
            ("b_LeftUpperArm_09", Some(Side::Left), "bupperarm"),
            ("Lefthand", Some(Side::Left), "hand"),
            ("J_Bip_C_Head", None, "jbipchead"),
            ("左目", Some(Side::Left), "目"),
            ("headJoint", None, "head"),
        ];
        for (name, side, key) in cases {
            let words = BoneName::new(name);
            assert_eq!((words.side, words.key().as_str()), (side, key), "{name}");
        }
    }

    #[test]
    fn bone_names_are_assigned_roles() {
        for (names, role) in [
            ("eye left_eye leftEye L_eyeBall_joint2 mixamorig:LeftEye LEYE lefteye eye_l DEF-eye.L", Some(Role::Eye)),
            ("FACIAL_L_Eye J_Adj_L_FaceEye LEye Eyeball_R eyes r_eye_01 EyeL", Some(Role::Eye)),
            ("head Head_01 HEAD headbone J_Bip_C_Head VRMHead skull", Some(Role::Head)),
            ("neck neck_01 Neck1 mixamorig:Neck neckJoint vertebra_cervical_5", Some(Role::Neck)),
            ("spine3 Spine2 spine_03 DEF-spine.003 chest upper_chest upperChest upperchest", Some(Role::Chest)),
            ("torso J_Bip_C_UpperChest lower_back lowerback waist abdomen thorax RibCage", Some(Role::Chest)),
            ("L_eyelid LeftEyeLid eye_brow_l Eyebrow leye_lash REyeBlinkTop eyelids", None),
            ("barrel base hat_head headlight backpack necklace forehead arm _ joint0 aheadof", None),
        ] {
            for name in names.split(' ') {
                assert_eq!(BoneName::new(name).role(), role, "{name}");
            }
        }
        assert_eq!(BoneName::new("Bip01 LEye").role(), Some(Role::Eye));
        assert_eq!(BoneName::new("").role(), None);
    }
}
