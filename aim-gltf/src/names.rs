//! Node names taken apart into words and a side, whatever the naming tradition.

/// Left or right of the character, as a name states it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    Left,
    Right,
}

/// A name's lower-case words (numbers are words of their own), its side taken out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Words {
    pub(crate) words: Vec<String>,
    pub(crate) side: Option<Side>,
}

impl Words {
    pub(crate) fn of(name: &str) -> Self {
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

    pub(crate) fn has(&self, any_of: &[&str]) -> bool {
        self.words.iter().any(|word| any_of.contains(&word.as_str()))
    }

    /// The words without numbers, joined: equal for the left and the right of a pair.
    pub(crate) fn key(&self) -> String {
        self.words.iter().filter(|w| !w.starts_with(|c: char| c.is_ascii_digit())).map(String::as_str).collect()
    }

    /// The last number in the name.
    pub(crate) fn number(&self) -> Option<u32> {
        self.words.iter().rev().find_map(|word| word.parse().ok())
    }
}

/// Splits at separators, between letters and digits, and where capitals start a word (`LEyeTop` → l, eye, top).
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
            let capital = c.is_uppercase() && (b.is_lowercase() || chars.get(i + 1).is_some_and(|n| n.is_lowercase()));
            capital || c.is_ascii_digit() != b.is_ascii_digit()
        });
        match words.last_mut() {
            Some(word) if open && !starts => word.extend(c.to_lowercase()),
            _ => words.push(c.to_lowercase().collect()),
        }
        open = true;
    }
    words
}

/// The side that a word names, and what is left of the word.
fn side_of(word: &str) -> (Option<Side>, &str) {
    // `headbone`, `neckjoint`: what every bone is tells nothing.
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
    use super::{Side, Words};

    #[test]
    fn names_of_many_traditions_come_apart() {
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
            let words = Words::of(name);
            assert_eq!((words.side, words.key().as_str()), (side, key), "{name}");
        }
    }
}
