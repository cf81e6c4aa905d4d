//! Files: each whole or not there at all.

pub mod describe;
#[cfg(feature = "cli")]
pub mod exr;
#[cfg(feature = "cli")]
pub mod png;

use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;
use thiserror::Error;

/// Why a file was not written.
#[derive(Debug, Error)]
pub enum ExportError {
    #[error("cannot write {path}: {source}; choose another file or folder")]
    Create { path: String, source: io::Error },
    #[error("writing {path} failed and left nothing behind: {source}")]
    Write { path: String, source: io::Error },
    #[error("cannot read {path}: {source}")]
    Read { path: String, source: io::Error },
}

/// A file that appears under its name when it is complete, and leaves no trace before.
#[derive(Debug)]
pub struct OutputFile {
    path: PathBuf,
    temporary: NamedTempFile,
}

impl OutputFile {
    /// Opens a temporary file beside the target, so that an output that cannot be written is
    /// known before the work begins.
    pub fn create(path: &Path) -> Result<OutputFile, ExportError> {
        let fail = |source| ExportError::Create { path: path.display().to_string(), source };
        if path.is_dir() {
            return Err(fail(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder")));
        }
        let folder = match path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        if path.file_name().is_none() {
            return Err(fail(io::Error::new(io::ErrorKind::InvalidInput, "it names no file")));
        }
        let mut builder = tempfile::Builder::new();
        builder.prefix(".nocturne-");
        // The umask takes its share, as from any other program; the default would be private.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let temporary = builder.tempfile_in(folder).map_err(|error| {
            // The name of the temporary file would mean nothing to anybody.
            fail(io::Error::from(error.kind()))
        })?;
        Ok(OutputFile { path: path.to_owned(), temporary })
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the whole content and puts the file under its name.
    pub fn write(
        self,
        content: impl FnOnce(&mut BufWriter<&mut std::fs::File>) -> io::Result<()>,
    ) -> Result<(), ExportError> {
        let OutputFile { path, mut temporary } = self;
        let fail = |source| ExportError::Write { path: path.display().to_string(), source };
        let mut writer = BufWriter::new(temporary.as_file_mut());
        content(&mut writer).and_then(|()| writer.flush()).map_err(fail)?;
        drop(writer);
        temporary.as_file().sync_all().map_err(fail)?;
        temporary.persist(&path).map_err(|error| fail(error.error))?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_write_leaves_the_old_file_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sky.txt");
        OutputFile::create(&path).unwrap().write(|w| w.write_all(b"whole")).unwrap();
        let failed = OutputFile::create(&path).unwrap().write(|w| {
            w.write_all(b"half")?;
            Err(io::Error::other("the disk is full"))
        });
        assert!(failed.unwrap_err().to_string().contains("the disk is full"));
        assert_eq!(std::fs::read(&path).unwrap(), b"whole");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn folders_that_are_not_there_are_refused_before_the_work() {
        let path = Path::new("no/such/folder/sky.png");
        let message = OutputFile::create(path).unwrap_err().to_string();
        assert!(message.contains("no/such/folder/sky.png"), "{message}");
    }
}
