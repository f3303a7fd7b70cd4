//! [`Role`]: what part a joint has in a gaze, as the names of the joint and of its bones tell it.

/// What part a joint has in a gaze.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Role {
    /// An eye.
    Eye,
    /// A head.
    Head,
    /// A neck.
    Neck,
    /// A spine or chest.
    Spine,
    /// None in particular.
    #[default]
    Other,
}

/// Words that tell a role.
const TELLING: &[(&str, Role)] = &[
    ("eye", Role::Eye),
    ("eyeball", Role::Eye),
    ("head", Role::Head),
    ("neck", Role::Neck),
    ("spine", Role::Spine),
    ("chest", Role::Spine),
    ("torso", Role::Spine),
    ("trunk", Role::Spine),
    ("back", Role::Spine),
    ("waist", Role::Spine),
    ("abdomen", Role::Spine),
];
/// What stands around them in one word, as in `lefteye`, `UPPERCHEST` or `headbone`.
const BEFORE: &[&str] = &["left", "right", "upper", "lower", "middle", "mid", "l", "r", "c"];
const AFTER: &[&str] = &["left", "right", "bone", "joint", "jnt", "s", "l", "r", "c"];
/// Words of the parts around an eye, and of what is worn on a head: with one of them the name tells nothing.
const OTHERS: &[&str] = &[
    "lid",
    "brow",
    "lash",
    "blink",
    "socket",
    "cheek",
    "squint",
    "eyelid",
    "eyebrow",
    "eyelash",
    "eyebrows",
    "eyelids",
    "eyelashes",
    "lids",
    "brows",
    "lashes",
    "hat",
    "hair",
    "light",
    "pack",
];

impl Role {
    /// The role that a name tells, if it tells one.
    pub(crate) fn of_name(name: &str) -> Option<Self> {
        let words = words(name);
        if words.iter().any(|word| OTHERS.contains(&word.as_str()) || OTHERS.contains(&bare(word))) {
            return None;
        }
        words.iter().find_map(|word| telling(word))
    }
}

fn telling(word: &str) -> Option<Role> {
    let whole = |word: &str| TELLING.iter().find(|(telling, _)| *telling == word).map(|(_, role)| *role);
    whole(word).or_else(|| whole(bare(word)))
}

/// The word without what may stand around the one that tells.
fn bare(word: &str) -> &str {
    let word = BEFORE.iter().find_map(|before| word.strip_prefix(before)).unwrap_or(word);
    AFTER.iter().find_map(|after| word.strip_suffix(after)).unwrap_or(word)
}

/// Lower-case words: split at what is no letter, and where a capital begins one (`mixamorig:LeftEye`, `LEyeTop`).
fn words(name: &str) -> Vec<String> {
    let letters: Vec<char> = name.chars().collect();
    let mut words: Vec<String> = Vec::new();
    let mut open = false;
    for (at, &letter) in letters.iter().enumerate() {
        if !letter.is_alphabetic() {
            open = false;
            continue;
        }
        let before = at.checked_sub(1).is_some_and(|before| letters[before].is_lowercase());
        let after = letters.get(at + 1).is_some_and(|after| after.is_lowercase());
        let begins = letter.is_uppercase() && (before || after);
        match words.last_mut() {
            Some(word) if open && !begins => word.extend(letter.to_lowercase()),
            _ => words.push(letter.to_lowercase().collect()),
        }
        open = true;
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_many_traditions_tell_a_role() {
        for (names, role) in [
            ("eye left_eye leftEye L_eyeBall_joint2 mixamorig:LeftEye LEYE lefteye eye_l DEF-eye.L", Some(Role::Eye)),
            ("FACIAL_L_Eye J_Adj_L_FaceEye LEye Eyeball_R eyes r_eye_01 EyeL", Some(Role::Eye)),
            ("head Head_01 HEAD headbone J_Bip_C_Head VRMHead", Some(Role::Head)),
            ("neck neck_01 Neck1 mixamorig:Neck neckJoint", Some(Role::Neck)),
            ("spine3 Spine2 spine_03 DEF-spine.003 chest upper_chest upperChest upperchest", Some(Role::Spine)),
            ("torso J_Bip_C_UpperChest lower_back lowerback waist abdomen", Some(Role::Spine)),
            ("L_eyelid LeftEyeLid eye_brow_l Eyebrow leye_lash REyeBlinkTop eyelids", None),
            ("barrel base hat_head headlight backpack necklace forehead arm _ joint0 aheadof", None),
        ] {
            for name in names.split(' ') {
                assert_eq!(Role::of_name(name), role, "{name}");
            }
        }
        assert_eq!(Role::of_name("Bip01 LEye"), Some(Role::Eye));
        assert_eq!(Role::of_name(""), None);
    }
}
