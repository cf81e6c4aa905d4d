//! What goes wrong at the command line: one sentence and an exit code.

use std::io;
use std::process::ExitCode;

use crate::job::JobError;

/// Why a command did not do what it was asked.
#[derive(Debug)]
pub enum CliError {
    /// What was asked for makes no sense: exit code 2.
    Usage(String),
    /// It makes sense but could not be done: exit code 1.
    Failure(String),
    /// Whoever read our output has stopped reading: no error of ours.
    NobodyReads,
}

impl CliError {
    /// The sentence, on one line.
    pub fn message(&self) -> Option<String> {
        match self {
            CliError::Usage(message) | CliError::Failure(message) => {
                Some(message.split_whitespace().collect::<Vec<_>>().join(" "))
            }
            CliError::NobodyReads => None,
        }
    }

    pub fn exit_code(&self) -> ExitCode {
        match self {
            CliError::Usage(_) => ExitCode::from(2),
            CliError::Failure(_) => ExitCode::FAILURE,
            CliError::NobodyReads => ExitCode::SUCCESS,
        }
    }
}

impl From<io::Error> for CliError {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => CliError::NobodyReads,
            _ => CliError::Failure(format!("standard output: {error}")),
        }
    }
}

impl From<clap::Error> for CliError {
    /// What clap says, without the usage that follows.
    fn from(error: clap::Error) -> Self {
        let said = error.render().to_string();
        let is_usage = |line: &str| line.starts_with("Usage:") || line.starts_with("For more");
        let lines: Vec<&str> = said.lines().take_while(|line| !is_usage(line)).collect();
        let said = lines.join(" ").replace("  tip: ", "; ");
        let said = said.trim().trim_start_matches("error: ");
        CliError::Usage(format!("{said}; try --help"))
    }
}

macro_rules! from_error {
    ($kind:ident: $($error:ty),* $(,)?) => {
        $(impl From<$error> for CliError {
            fn from(error: $error) -> Self {
                CliError::$kind(error.to_string())
            }
        })*
    };
}

impl From<JobError> for CliError {
    fn from(error: JobError) -> Self {
        match error {
            JobError::Extension { .. } => CliError::Usage(format!("--output {error}")),
            JobError::Twice { .. }
            | JobError::NoOutput
            | JobError::Scene(_)
            | JobError::Ephemeris(_) => CliError::Usage(error.to_string()),
            _ => CliError::Failure(error.to_string()),
        }
    }
}

from_error!(Usage:
    crate::time::TimeError,
    crate::place::PlaceError,
    crate::place::gazetteer::GazetteerError,
    crate::scene::SceneError,
    crate::ephemeris::EphemerisError,
    crate::air::AirError,
    crate::air::classic::ClassicSkyError,
    crate::almanac::AlmanacError,
);
from_error!(Failure:
    crate::catalog::CatalogError,
    crate::export::ExportError,
    crate::plan::PlanError,
);
#[cfg(feature = "gpu")]
from_error!(Failure: crate::render::gpu::GpuError);
