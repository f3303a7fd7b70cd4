//! [`Role`]: what a joint is in a gaze.

use core::fmt;

/// What a joint is in a gaze, as declared. It decides what is left to the solver: whether the gaze is a natural
/// one, which part of the body a joint belongs to, which headings turn about the character's up.
///
/// ```
/// use aim_model::Role;
///
/// assert_eq!(Role::Neck.to_string(), "neck");
/// assert!(Role::ALL.into_iter().filter(|role| role.is_upright()).eq([Role::Head, Role::Neck]));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Role {
    /// None in particular.
    #[default]
    None,
    /// An eye: quick, leads, and returns as the others arrive.
    Eye,
    /// A head.
    Head,
    /// A neck.
    Neck,
    /// A chest: any joint of the upper torso.
    Chest,
}

impl Role {
    /// Every role, in the order in which messages list them.
    pub const ALL: [Self; 5] = [Self::Eye, Self::Head, Self::Neck, Self::Chest, Self::None];

    /// The word that declares it: `eye`, `head`, `neck`, `chest` or `none`.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Eye => "eye",
            Self::Head => "head",
            Self::Neck => "neck",
            Self::Chest => "chest",
            Self::None => "none",
        }
    }

    /// Whether a joint of this role turns about the character's up, where its declaration does not say.
    #[must_use]
    pub const fn is_upright(self) -> bool {
        matches!(self, Self::Head | Self::Neck)
    }

    /// Whether it is a part of the head or neck, as an eye is.
    #[must_use]
    pub const fn is_of_head(self) -> bool {
        matches!(self, Self::Eye | Self::Head | Self::Neck)
    }
}

impl fmt::Display for Role {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}
