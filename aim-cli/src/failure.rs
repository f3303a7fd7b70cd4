//! Failures of commands: exit code 1 for a failed check, 2 for unusable input.

use std::fmt;
use std::path::Path;
use std::process::ExitCode;

use aim_codegen::declare::Diagnostics;

/// Result of a command.
pub(crate) type Result<T = ()> = std::result::Result<T, Failure>;

/// A failed command, with the message that the user sees.
#[derive(Debug)]
pub(crate) enum Failure {
    /// A check failed.
    Check(String),
    /// An input cannot be used.
    Input(String),
}

impl Failure {
    /// Creates a failure for unusable input. The message says what to do.
    pub(crate) fn input(message: impl Into<String>) -> Self {
        Self::Input(message.into())
    }

    /// Creates a failure for unusable input in a file.
    pub(crate) fn in_file(path: &Path, problem: impl fmt::Display) -> Self {
        Self::Input(format!("{}: {problem}", path.display()))
    }

    /// Returns a function that turns errors into failures for a file, for use with `map_err`.
    pub(crate) fn of<E: fmt::Display>(path: &Path) -> impl Fn(E) -> Self {
        move |problem| Self::in_file(path, problem)
    }

    /// Returns the exit code: 1 for a failed check, 2 for unusable input.
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

/// The diagnostics of a declaration already name its file, line and column.
impl From<Diagnostics> for Failure {
    fn from(errors: Diagnostics) -> Self {
        Self::Input(errors.render())
    }
}
