//! The binary `fretwear`.

use std::process::ExitCode;

fn main() -> ExitCode {
    server::cli::main()
}
