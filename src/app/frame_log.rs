//! A line for each frame that was presented, for measurements: seconds of the monotonic clock, and how many
//! pictures of the sky were drawn so far.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use super::AppError;

/// The log.
pub struct FrameLog {
    file: BufWriter<File>,
}

impl FrameLog {
    /// Begins a log; one that is there is written over.
    pub fn create(path: &Path) -> Result<FrameLog, AppError> {
        let file = File::create(path)
            .map_err(|source| AppError::FrameLog { path: path.to_owned(), source })?;
        Ok(FrameLog { file: BufWriter::new(file) })
    }

    /// Notes that the frame before was presented.
    pub fn note(&mut self, pictures: u64) {
        // A log that cannot be written is no reason to stop.
        let line = writeln!(self.file, "{:.6} {pictures}", monotonic_s());
        let _ = line.and_then(|()| self.file.flush());
    }
}

#[cfg(target_os = "linux")]
fn monotonic_s() -> f64 {
    let now = rustix::time::clock_gettime(rustix::time::ClockId::Monotonic);
    now.tv_sec as f64 + now.tv_nsec as f64 / 1e9
}

/// Since the first frame.
#[cfg(not(target_os = "linux"))]
fn monotonic_s() -> f64 {
    use std::sync::OnceLock;
    use std::time::Instant;
    static FIRST: OnceLock<Instant> = OnceLock::new();
    FIRST.get_or_init(Instant::now).elapsed().as_secs_f64()
}
