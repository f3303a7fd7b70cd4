//! Parses attribute tokens into entries of the neutral tree. Reports nothing; faulty tokens are recorded in the tree.

use proc_macro2::{Delimiter, Group, Ident, Span, TokenStream, TokenTree};

use super::literal;
use crate::declare::source_place::SourcePlace;
use crate::declare::tree::{Entry, Item, Kind, Value, Word};

/// Returns the entries of `#[attribute(…)]`'s tokens.
pub(crate) fn entries(tokens: TokenStream) -> Vec<Entry> {
    let tokens = flatten(tokens);
    let mut entries = Vec::new();
    let mut rest = tokens.as_slice();
    while !rest.is_empty() {
        let end = chunk_end(rest);
        let chunk = &rest[..end];
        match chunk {
            [] => entries.push(Entry::Stray(Word { text: ",".into(), place: SourcePlace::span(rest[0].span()) })),
            [TokenTree::Ident(key), after @ ..] => read_item(key, after, &mut entries),
            [other, ..] => {
                let place = SourcePlace::tokens(chunk, other.span());
                entries.push(Entry::Stray(Word { text: shorten(chunk), place }));
            }
        }
        rest = &rest[end..];
        match rest {
            [comma, after @ ..] if is_punct(comma, ',') => rest = after,
            [TokenTree::Ident(key), ..] => entries.push(Entry::NoComma(word_of(key))),
            _ => {}
        }
    }
    entries
}

/// Returns the end of the first entry: its comma, or the next `key =` if a comma is missing.
fn chunk_end(tokens: &[TokenTree]) -> usize {
    for (at, token) in tokens.iter().enumerate() {
        if is_punct(token, ',') {
            return at;
        }
        let assigned = tokens.get(at + 1).is_some_and(|next| is_punct(next, '='))
            && !tokens.get(at + 2).is_some_and(|next| is_punct(next, '='));
        // `left bones(…)` is two entries, `-f(x)` is one expression.
        let called = matches!(tokens.get(at + 1), Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis)
            && at >= 3
            && !matches!(tokens[at - 1], TokenTree::Punct(_));
        if at >= 2 && matches!(token, TokenTree::Ident(_)) && (assigned || called) {
            return at;
        }
    }
    tokens.len()
}

fn read_item(key: &Ident, after: &[TokenTree], entries: &mut Vec<Entry>) {
    let mut extra: &[TokenTree] = &[];
    let value = match after {
        [] => Value { kind: Kind::Absent, place: SourcePlace::span(key.span()) },
        [equals, value @ ..] if is_punct(equals, '=') => {
            if value.is_empty() {
                Value { kind: Kind::Absent, place: SourcePlace::tokens(after, key.span()) }
            } else if key == "crate" {
                crate_path(value)
            } else {
                read_value(value, equals.span())
            }
        }
        [TokenTree::Group(group), rest @ ..] if group.delimiter() == Delimiter::Parenthesis => {
            extra = rest;
            Value { kind: Kind::Table(self::entries(group.stream())), place: SourcePlace::span(group.span()) }
        }
        _ => Value { kind: Kind::Unassigned, place: SourcePlace::tokens(after, key.span()) },
    };
    entries.push(Entry::Item(Item { key: word_of(key), value }));
    if let Some(first) = extra.first() {
        let place = SourcePlace::tokens(extra, first.span());
        entries.push(Entry::Stray(Word { text: shorten(extra), place }));
    }
}

/// Reads a path, bare or, as in serde, in a string; anything else goes through the ordinary reader.
fn crate_path(tokens: &[TokenTree]) -> Value {
    let span = tokens.first().map_or_else(Span::call_site, TokenTree::span);
    let place = SourcePlace::tokens(tokens, span);
    let stream = match tokens {
        [TokenTree::Literal(literal)] => {
            let text = syn::parse2::<syn::LitStr>(TokenTree::from(literal.clone()).into());
            text.and_then(|text| text.parse::<TokenStream>()).ok()
        }
        _ => Some(tokens.iter().cloned().collect()),
    };
    match stream {
        Some(stream) if is_module_path(&stream) => Value { kind: Kind::Path(stream), place },
        _ => read_value(tokens, span),
    }
}

/// Returns `true` if the tokens are a plain path. Generic arguments are excluded: `::AimRig` could not follow them.
fn is_module_path(tokens: &TokenStream) -> bool {
    use syn::parse::Parser;
    syn::Path::parse_mod_style.parse2(tokens.clone()).is_ok_and(|path| !path.segments.is_empty())
}

fn read_value(tokens: &[TokenTree], before: Span) -> Value {
    let place = SourcePlace::tokens(tokens, before);
    let kind = range(tokens).unwrap_or_else(|| single(tokens));
    Value { kind, place }
}

/// Reads `low..=high`, `low..high` and their open forms; `None` if there is no `..`.
fn range(tokens: &[TokenTree]) -> Option<Kind> {
    let dots = |pair: &[TokenTree]| is_punct(&pair[0], '.') && is_punct(&pair[1], '.');
    let at = tokens.windows(2).position(dots)?;
    let low = &tokens[..at];
    let (inclusive, high) = match &tokens[at + 2..] {
        [equals, high @ ..] if is_punct(equals, '=') => (true, high),
        high => (false, high),
    };
    if high.first().is_some_and(|next| is_punct(next, '.')) || high.windows(2).any(dots) {
        return Some(Kind::Other("an expression"));
    }
    let span = tokens[at].span();
    let end = |tokens: &[TokenTree]| (!tokens.is_empty()).then(|| Box::new(read_value(tokens, span)));
    Some(Kind::Range { low: end(low), high: end(high), inclusive })
}

fn single(tokens: &[TokenTree]) -> Kind {
    let (sign, unsigned) = match tokens {
        [sign, rest @ ..] if is_punct(sign, '-') => ("-", rest),
        [sign, rest @ ..] if is_punct(sign, '+') => ("+", rest),
        _ => ("", tokens),
    };
    let number = |text: &str| literal::number(text).map_or(Kind::Other("a literal"), Kind::Number);
    match unsigned {
        [TokenTree::Literal(literal)] => {
            let text = literal.to_string();
            if text.starts_with(|c: char| c.is_ascii_digit() || c == '-') {
                return number(&format!("{}{text}", sign.replace('+', "")));
            }
            match syn::parse2::<syn::LitStr>(unsigned[0].clone().into()) {
                Ok(text) if sign.is_empty() => Kind::Text(text.value()),
                _ => Kind::Other("a literal of another kind"),
            }
        }
        // `35 deg`: the meaning is clear, so keep it for the message.
        [TokenTree::Literal(literal), TokenTree::Ident(unit)] => match literal::number(&literal.to_string()) {
            Some(plain) if plain.unit.is_empty() && plain.radix.is_none() => {
                number(&format!("{}{literal} {unit}", sign.replace('+', "")))
            }
            _ => Kind::Other("an expression"),
        },
        [TokenTree::Ident(ident)] => match (sign, ident.to_string().as_str()) {
            ("", "true") => Kind::Bool(true),
            ("", "false") => Kind::Bool(false),
            ("", word) => Kind::Word(word.to_owned()),
            (sign, letter) => Kind::Axis { negative: sign == "-", letter: letter.to_owned() },
        },
        [TokenTree::Group(group)] if sign.is_empty() => match group.delimiter() {
            Delimiter::Parenthesis => Kind::Tuple(values(group)),
            Delimiter::Bracket => Kind::List(values(group)),
            Delimiter::Brace | Delimiter::None => Kind::Other("an expression"),
        },
        _ => Kind::Other("an expression"),
    }
}

fn values(group: &Group) -> Vec<Value> {
    let tokens = flatten(group.stream());
    let mut values = Vec::new();
    let mut rest = tokens.as_slice();
    while !rest.is_empty() {
        let end = rest.iter().position(|token| is_punct(token, ',')).unwrap_or(rest.len());
        values.push(read_value(&rest[..end], rest[0].span()));
        rest = rest.get(end + 1..).unwrap_or_default();
    }
    values
}

/// Replaces invisible groups by their content: `macro_rules!` wraps its fragments in them.
fn flatten(tokens: TokenStream) -> Vec<TokenTree> {
    let mut flat = Vec::new();
    // An explicit stack instead of recursion: the user's macros may nest arbitrarily deep.
    let mut stack = vec![tokens.into_iter()];
    while let Some(top) = stack.last_mut() {
        match top.next() {
            Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::None => {
                stack.push(group.stream().into_iter());
            }
            Some(token) => flat.push(token),
            None => {
                stack.pop();
            }
        }
    }
    flat
}

fn is_punct(token: &TokenTree, punct: char) -> bool {
    matches!(token, TokenTree::Punct(found) if found.as_char() == punct)
}

/// Returns an identifier as a word, without `r#`.
pub(crate) fn word_of(ident: &Ident) -> Word {
    let text = ident.to_string();
    let text = text.strip_prefix("r#").map_or(text.clone(), str::to_owned);
    Word { text, place: SourcePlace::span(ident.span()) }
}

/// Returns the tokens as text, cut after 24 characters.
fn shorten(tokens: &[TokenTree]) -> String {
    let text: String = tokens.iter().cloned().collect::<TokenStream>().to_string();
    match text.char_indices().nth(24) {
        Some((cut, _)) => format!("{}…", &text[..cut]),
        None => text,
    }
}
