//! `nocturne`: the night sky as it would really look.

use std::process::ExitCode;

fn main() -> ExitCode {
    nocturne::cli::run()
}
