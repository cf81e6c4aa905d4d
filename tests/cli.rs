//! The program as its users meet it: exit codes, messages, files, and the commands of the README.
//!
//! Every test runs the built binary in a folder of its own. Tests that draw are reported as
//! ignored where there is no graphics adapter; so are those that need something else that this
//! machine lacks.

mod cli {
    pub mod airs;
    pub mod brightness;
    pub mod catalogs;
    pub mod harness;
    pub mod nonsense;
    pub mod outputs;
    pub mod pictures;
    pub mod readme;
    pub mod scenes;
    pub mod viewers;
    pub mod words;
}

use cli::harness::{Machine, nocturne};

fn main() {
    let arguments = libtest_mimic::Arguments::from_args();
    let machine = Machine::look_around();
    if !machine.draws {
        eprint!("tests that draw are ignored: {}", nocturne(["adapter"]).run().stderr);
    }
    let trials = [
        cli::airs::trials(),
        cli::brightness::trials(),
        cli::nonsense::trials(),
        cli::outputs::trials(&machine),
        cli::catalogs::trials(&machine),
        cli::scenes::trials(),
        cli::words::trials(),
        cli::viewers::trials(&machine),
        cli::pictures::trials(&machine),
        cli::readme::trials(&machine),
    ];
    libtest_mimic::run(&arguments, trials.into_iter().flatten().collect()).exit();
}
