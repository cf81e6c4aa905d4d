//! `nocturne`: the night sky as it would really look.

use std::process::ExitCode;

/// Switches Mesa's layer for the selection of devices off when set.
const SELECTOR: &str = "NODEVICE_SELECT";

fn main() -> ExitCode {
    // Outside a desktop session a layer of the Mesa drivers complains on standard error that it
    // finds no window system to ask. It chooses between adapters, which is no matter there.
    if std::env::var_os("XDG_RUNTIME_DIR").is_none() && std::env::var_os(SELECTOR).is_none() {
        // SAFETY: no other thread runs yet that could read the environment.
        unsafe { std::env::set_var(SELECTOR, "1") };
    }
    nocturne::memory::give_back();
    nocturne::cli::run()
}
