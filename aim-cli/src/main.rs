//! The `aim` command.

fn main() -> std::process::ExitCode {
    aim_cli::run()
}
