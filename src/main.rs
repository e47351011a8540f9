//! The `yont` program: exit codes only.

use std::process::ExitCode;

fn main() -> ExitCode {
    yont::cli::main(std::env::args_os(), yont::repl::start).into()
}
