//! Fuzz tests: no input makes the front ends panic.

use proc_macro2::{Delimiter, Group, Ident, Literal, Punct, Spacing, Span, TokenStream, TokenTree};
use syn::DeriveInput;

use super::parse;
use crate::declare::from_derive_input;
use crate::emit::fallback;

/// A small deterministic generator (xorshift), so that failures are reproducible.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        usize::try_from(self.0 % (bound as u64)).expect("below a usize")
    }
}

const SEEDS: [&str; 3] = [
    "#[aim(axes(up = +X, forward = +Y, left = +Z), handedness = left, effector(forward = (0.0, 1.0, 0.0), origin = (0.0, 0.1, 0.0)), natural(eyes_only = 9deg, head_share = 0.5, engage = 9deg, release = 9deg, delay = 1), crate = a::b)]
    struct Thug {
        #[joint(heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg, stiffness = 0.5, bone = [\"a\", \"b\"], other_eye = \"r\")]
        left_eye: Joint,
        #[joint(heading = free, rate = 170deg, upright = 0.5, limits_from = bind_pose, mirrored = true, hold = [\"c\"], axes(up = +Z, forward = +Y))]
        neck: Joint,
    }",
    "#[aim(axes(up = (0.6, 0.8, 0.0), back = (0.8, -0.6, 0.0)))] struct R { #[joint(pitch = -1rad..=1rad, rate = 1rad)] r#in: Joint }",
    "#[derive(Debug)] #[aim] enum E<'a, T> where T: Copy { #[joint(x)] A(T) }",
];

fn token(random: &mut Random, depth: usize) -> TokenTree {
    const WORDS: [&str; 12] =
        ["X", "up", "down", "deg", "free", "true", "crate", "self", "heading", "axes", "rate", "left"];
    const LITERALS: [&str; 10] =
        ["0", "35deg", "1e999deg", "0x1", "1.5rad", "\"s\"", "'c'", "b\"x\"", "1_f32", "r#\"é\"#"];
    const PUNCTS: [char; 10] = ['=', '.', ',', '-', '+', ':', '#', '<', '$', '\''];
    match random.below(if depth < 3 { 5 } else { 3 }) {
        0 => Ident::new(WORDS[random.below(WORDS.len())], Span::call_site()).into(),
        1 => {
            let text = LITERALS[random.below(LITERALS.len())];
            text.parse::<Literal>().expect("a literal").into()
        }
        2 => {
            let spacing = if random.below(2) == 0 { Spacing::Alone } else { Spacing::Joint };
            // A quote must have joint spacing to be a valid token.
            match PUNCTS[random.below(PUNCTS.len())] {
                '\'' => Punct::new('\'', Spacing::Joint).into(),
                punct => Punct::new(punct, spacing).into(),
            }
        }
        _ => {
            let delimiters = [Delimiter::Parenthesis, Delimiter::Bracket, Delimiter::Brace, Delimiter::None];
            let inner = (0..random.below(4)).map(|_| token(random, depth + 1)).collect();
            Group::new(delimiters[random.below(4)], inner).into()
        }
    }
}

/// Removes, duplicates, swaps, replaces or inserts a few tokens, at any depth.
fn mutate(tokens: TokenStream, random: &mut Random) -> TokenStream {
    let mut tokens: Vec<TokenTree> = tokens.into_iter().collect();
    for _ in 0..=random.below(2) {
        if tokens.is_empty() {
            tokens.push(token(random, 0));
        }
        let at = random.below(tokens.len());
        match random.below(8) {
            0 => drop(tokens.remove(at)),
            1 => tokens.insert(at, tokens[at].clone()),
            2 => {
                let other = random.below(tokens.len());
                tokens.swap(at, other);
            }
            3 => tokens[at] = token(random, 0),
            4 => tokens.insert(at, token(random, 0)),
            _ => {
                if let TokenTree::Group(group) = &tokens[at] {
                    tokens[at] = Group::new(group.delimiter(), mutate(group.stream(), random)).into();
                }
            }
        }
    }
    tokens.into_iter().collect()
}

fn attributes(input: &mut DeriveInput) -> Vec<&mut syn::Attribute> {
    let mut all: Vec<&mut syn::Attribute> = input.attrs.iter_mut().collect();
    if let syn::Data::Struct(data) = &mut input.data {
        all.extend(data.fields.iter_mut().flat_map(|field| field.attrs.iter_mut()));
    }
    all
}

/// Returns `true` if the tests run all their rounds, as in `.ci/run`; plain `cargo test` runs a part of them.
fn in_full() -> bool {
    std::env::var_os("AIM_TEST_SCALE").is_some_and(|scale| scale == "full")
}

#[test]
fn mutated_attributes_never_panic() {
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    let (mut accepted, mut refused) = (0, 0);
    let rounds = if in_full() { 6000 } else { 1200 };
    for round in 0..rounds {
        let mut input = parse(SEEDS[round % SEEDS.len()]);
        for attribute in attributes(&mut input) {
            if let syn::Meta::List(list) = &mut attribute.meta {
                if random.below(2) == 0 {
                    list.tokens = mutate(core::mem::take(&mut list.tokens), &mut random);
                }
            }
        }
        match from_derive_input(&input) {
            Ok(declared) => {
                accepted += 1;
                assert_eq!(declared.fields.len(), declared.spec.joints.len());
            }
            Err(errors) => {
                refused += 1;
                assert!(errors.iter().count() > 0, "refused without a reason");
                assert!(!errors.render().is_empty() && !errors.into_compile_error().is_empty());
                syn::parse2::<syn::File>(fallback(&input)).ok();
            }
        }
    }
    assert!(60 * accepted > rounds && 6 * refused > rounds, "{accepted} accepted, {refused} refused");
}

#[cfg(feature = "toml")]
#[test]
fn mutated_files_never_panic() {
    let seed = "name = \"Thug\"\nhandedness = \"left\"\naxes = { up = \"+X\", forward = [0.0, 1.0, 0.0] }\neffector = { forward = \"+Y\", origin = [0, 0.1, 0] }\nnatural = { eyes_only = \"9deg\", delay = 0.1 }\n[[joint]]\nname = \"eye\"\nbone = [\"a\", \"ü\"]\nheading = [\"-35deg\", \"35deg\"]\nrate = \"450deg\"\nmirrored = true\n";
    let pieces = [
        "\"",
        "[",
        "]",
        "=",
        "\n",
        "é",
        "..",
        "-",
        "0x",
        "\u{1F600}",
        "name",
        "[[joint]]",
        "\r",
        "\t",
        "{",
        "}",
        "°",
        "inf",
        "#",
        "1e9",
    ];
    let mut random = Random(0x2545_F491_4F6C_DD1D);
    for _ in 0..6000 {
        let mut text: Vec<char> = seed.chars().collect();
        for _ in 0..=random.below(3) {
            let at = random.below(text.len());
            match random.below(3) {
                0 => drop(text.drain(at..(at + 1 + random.below(6)).min(text.len()))),
                1 => drop(text.splice(at..at, pieces[random.below(pieces.len())].chars())),
                _ => text.swap(at, at.saturating_sub(1)),
            }
        }
        let text: String = text.into_iter().collect();
        if let Err(errors) = crate::declare::from_toml("rigs/thug.toml", &text) {
            let shown = errors.render();
            assert!(shown.contains("--> rigs/thug.toml:") && shown.contains("= help: "), "{text}\n{shown}");
        }
    }
}
