//! Why a command ended: exit code 1 for a check that failed, 2 for input that cannot be used.

use std::fmt;
use std::path::Path;
use std::process::ExitCode;

use aim_codegen::declare::Diagnostics;

/// Result of a command.
pub(crate) type Result<T = ()> = std::result::Result<T, Failure>;

/// A failed command, with the message that the user sees.
#[derive(Debug)]
pub(crate) enum Failure {
    /// A check was made and did not hold.
    Check(String),
    /// Something given cannot be used.
    Input(String),
}

impl Failure {
    /// Unusable input, in a sentence that says what to do.
    pub(crate) fn input(message: impl Into<String>) -> Self {
        Self::Input(message.into())
    }

    /// Unusable input in a file.
    pub(crate) fn in_file(path: &Path, problem: impl fmt::Display) -> Self {
        Self::Input(format!("{}: {problem}", path.display()))
    }

    /// The same of an error, for [`Result::map_err`].
    pub(crate) fn of<E: fmt::Display>(path: &Path) -> impl Fn(E) -> Self {
        move |problem| Self::in_file(path, problem)
    }

    /// The exit code of the contract.
    pub(crate) fn exit_code(&self) -> ExitCode {
        match self {
            Self::Check(_) => ExitCode::from(1),
            Self::Input(_) => ExitCode::from(2),
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (Self::Check(message) | Self::Input(message)) = self;
        if message.starts_with("error") { f.write_str(message) } else { write!(f, "error: {message}") }
    }
}

/// Declarations say where they are wrong themselves.
impl From<Diagnostics> for Failure {
    fn from(errors: Diagnostics) -> Self {
        Self::Input(errors.render())
    }
}
