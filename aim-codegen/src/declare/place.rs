//! [`Place`]: where the user wrote something, in a macro's tokens or in a TOML file's text.

use core::ops::Range;

use proc_macro2::{Span, TokenTree};
use quote::ToTokens;

/// Where something stands in what the user wrote.
#[derive(Clone, Debug)]
pub enum Place {
    /// From one token to another of a macro's input; both may be the same.
    Tokens {
        /// The first token.
        first: Span,
        /// The last token.
        last: Span,
    },
    /// A byte range of a file's text.
    Text(Range<usize>),
}

impl Place {
    /// The place of one token.
    pub(crate) fn span(span: Span) -> Self {
        Self::Tokens { first: span, last: span }
    }

    /// The place of these tokens, or `fallback` where there are none.
    pub(crate) fn tokens(tokens: &[TokenTree], fallback: Span) -> Self {
        match (tokens.first(), tokens.last()) {
            (Some(first), Some(last)) => Self::Tokens { first: first.span(), last: last.span() },
            _ => Self::span(fallback),
        }
    }

    /// The place of what these tokens write.
    pub(crate) fn of(tokens: &impl ToTokens) -> Self {
        let tokens: Vec<TokenTree> = tokens.to_token_stream().into_iter().collect();
        Self::tokens(&tokens, Span::call_site())
    }

    /// The place in the text that its tokens were read from; tokens of a macro do not know it.
    pub(crate) fn in_text(&self) -> Self {
        match self {
            Self::Tokens { first, last } => Self::Text(first.byte_range().start..last.byte_range().end),
            Self::Text(range) => Self::Text(range.clone()),
        }
    }

    /// Orders places of one file; places in tokens all compare equal, as spans have no order on stable.
    pub(crate) fn offset(&self) -> usize {
        match self {
            Self::Tokens { .. } => 0,
            Self::Text(range) => range.start,
        }
    }
}
