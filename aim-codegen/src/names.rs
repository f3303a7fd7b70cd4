//! Names of emitted items: conversion to `snake_case`, and the keywords of C, WGSL and Rust.

/// Converts a Rust name to its C and WGSL form: lower case, with `_` inserted only between a lower-case letter or digit
/// and a capital.
///
/// `LeftEye` → `left_eye`, `VRMHead` → `vrmhead`, `spine3` → `spine3`.
#[must_use]
pub fn snake_case(name: &str) -> String {
    let mut snake = String::with_capacity(name.len() + 4);
    let mut after_small = false;
    for c in name.chars() {
        if after_small && c.is_ascii_uppercase() {
            snake.push('_');
        }
        after_small = c.is_ascii_lowercase() || c.is_ascii_digit();
        snake.push(c.to_ascii_lowercase());
    }
    snake
}

/// Returns the language in which the word is a keyword: `C`, `WGSL` or `C and WGSL`.
///
/// Words that WGSL merely reserves (`target`, `filter`, …) are not included: emitted names always have the form
/// `rig_joint_function`, so a reserved word never stands alone, and many of them are good names for a joint.
pub(crate) fn keyword_of(snake: &str) -> Option<&'static str> {
    match (is_among(snake, C), is_among(snake, WGSL)) {
        (true, true) => Some("C and WGSL"),
        (true, false) => Some("C"),
        (false, true) => Some("WGSL"),
        (false, false) => None,
    }
}

/// Returns `true` if the word is a keyword of Rust, edition 2024.
pub(crate) fn is_rust_keyword(name: &str) -> bool {
    is_among(name, RUST)
}

fn is_among(word: &str, words: &str) -> bool {
    words.split_whitespace().any(|other| other == word)
}

/// Returns the known name that was probably meant.
pub(crate) fn nearest<'n>(name: &str, known: &[&'n str]) -> Option<&'n str> {
    let name = name.to_ascii_lowercase();
    let is_shortened = |known: &&&str| name.len() >= 3 && known.starts_with(name.as_str());
    known.iter().find(is_shortened).copied().or_else(|| {
        // Edit distance: insertions, deletions, replacements, transpositions.
        let (distance, nearest) = known.iter().map(|known| (strsim::osa_distance(&name, known), *known)).min()?;
        // If no letter is left, it is a different name.
        (distance <= (nearest.len() / 3).max(1) && distance < name.len()).then_some(nearest)
    })
}

const C: &str = "
    alignas alignof auto bool break case char const constexpr continue default do double else enum extern false float for
    goto if inline int long nullptr register restrict return short signed sizeof static static_assert struct switch
    thread_local true typedef typeof typeof_unqual union unsigned void volatile while";

const WGSL: &str = "
    alias break case const const_assert continue continuing default diagnostic discard else enable false fn for if let
    loop override requires return struct switch true var while";

const RUST: &str = "
    Self abstract as async await become box break const continue crate do dyn else enum extern false final fn for gen if
    impl in let loop macro match mod move mut override priv pub ref return self static struct super trait true try type
    typeof unsafe unsized use virtual where while yield";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn snake_case_breaks_between_a_small_letter_and_a_capital() {
        for (name, snake) in [
            ("Thug", "thug"),
            ("LeftEye", "left_eye"),
            ("left_eye", "left_eye"),
            ("leftEye2Bone", "left_eye2_bone"),
            ("VRMHead", "vrmhead"),
            ("HeadVRM", "head_vrm"),
            ("spine3", "spine3"),
            ("Left_Eye", "left_eye"),
            ("_Neck", "_neck"),
            ("A", "a"),
            ("", ""),
        ] {
            assert_eq!(snake_case(name), snake, "{name}");
        }
    }

    #[test]
    fn keywords_name_their_language() {
        assert_eq!(keyword_of("float"), Some("C"));
        assert_eq!(keyword_of("fn"), Some("WGSL"));
        assert_eq!(keyword_of("switch"), Some("C and WGSL"));
        assert_eq!(keyword_of("target"), None);
    }
}
