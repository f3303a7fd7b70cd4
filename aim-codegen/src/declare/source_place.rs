//! [`SourcePlace`]: position of something in the user's source, as tokens of a macro or as a range of a TOML file's text.

use core::ops::Range;

use proc_macro2::{Span, TokenTree};
use quote::ToTokens;

/// Position of something in the user's source.
#[derive(Clone, Debug)]
pub enum SourcePlace {
    /// From one token to another of a macro's input; both may be the same.
    Tokens {
        /// First token.
        first: Span,
        /// Last token.
        last: Span,
    },
    /// Byte range in a file's text.
    Text(Range<usize>),
}

impl SourcePlace {
    /// Returns the place of one token.
    pub(crate) fn span(span: Span) -> Self {
        Self::Tokens { first: span, last: span }
    }

    /// Returns the place of these tokens, or of `fallback` if there are none.
    pub(crate) fn tokens(tokens: &[TokenTree], fallback: Span) -> Self {
        match (tokens.first(), tokens.last()) {
            (Some(first), Some(last)) => Self::Tokens { first: first.span(), last: last.span() },
            _ => Self::span(fallback),
        }
    }

    /// Returns the place of all tokens of a syntax item.
    pub(crate) fn of(tokens: &impl ToTokens) -> Self {
        let tokens: Vec<TokenTree> = tokens.to_token_stream().into_iter().collect();
        Self::tokens(&tokens, Span::call_site())
    }

    /// Converts to a range of the text that the tokens were parsed from. Meaningless for tokens of a macro call.
    pub(crate) fn in_text(&self) -> Self {
        match self {
            Self::Tokens { first, last } => Self::Text(first.byte_range().start..last.byte_range().end),
            Self::Text(range) => Self::Text(range.clone()),
        }
    }

    /// Returns a key that orders places of one file. All places in tokens compare equal, because spans have no order on
    /// stable Rust.
    pub(crate) fn offset(&self) -> usize {
        match self {
            Self::Tokens { .. } => 0,
            Self::Text(range) => range.start,
        }
    }
}
