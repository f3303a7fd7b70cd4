//! [`Role`]: the part that a joint plays in a gaze.

use core::fmt;

/// The part that a joint plays in a gaze, as declared. It determines the default solver (natural or exact), the body
/// region that a joint belongs to, and the joints whose heading turns about the character's up by default.
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
    /// No particular role.
    #[default]
    None,
    /// An eye: moves first and fastest, and turns back as the other joints arrive.
    Eye,
    /// A head.
    Head,
    /// A neck.
    Neck,
    /// A joint of the upper torso.
    Chest,
}

impl Role {
    /// Every role, in the order in which messages list them.
    pub const ALL: [Self; 5] = [Self::Eye, Self::Head, Self::Neck, Self::Chest, Self::None];

    /// Returns the keyword that declares the role: `eye`, `head`, `neck`, `chest` or `none`.
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

    /// Returns `true` if a joint of this role turns about the character's up unless its declaration says otherwise.
    #[must_use]
    pub const fn is_upright(self) -> bool {
        matches!(self, Self::Head | Self::Neck)
    }

    /// Returns `true` if the joint belongs to the head or neck, eyes included.
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
