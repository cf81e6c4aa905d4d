//! Files: each whole or not there at all.

pub mod describe;
mod draft;
#[cfg(feature = "cli")]
pub mod exif;
#[cfg(feature = "cli")]
pub mod exr;
#[cfg(feature = "cli")]
pub mod png;
pub mod table;

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use thiserror::Error;

use draft::Draft;

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
///
/// A device or a pipe is written into as it is: there is nothing to put in its place.
#[derive(Debug)]
pub struct OutputFile {
    path: PathBuf,
    target: Target,
}

#[derive(Debug)]
enum Target {
    /// Where the file goes, behind any symbolic links, and the file until then.
    Whole {
        at: PathBuf,
        draft: Draft,
    },
    Through(File),
}

impl OutputFile {
    /// Opens a draft beside the target, so that an output that cannot be written is known before
    /// the work begins.
    pub fn create(path: &Path) -> Result<OutputFile, ExportError> {
        let target = Target::open(path).map_err(|source| {
            let path = path.display().to_string();
            ExportError::Create { path, source }
        })?;
        Ok(OutputFile { path: path.to_owned(), target })
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether both would end up in the same place, so that one would be lost.
    pub fn is_same_as(&self, other: &OutputFile) -> bool {
        match (&self.target, &other.target) {
            (Target::Whole { at, .. }, Target::Whole { at: other, .. }) => at == other,
            _ => false,
        }
    }

    /// Writes the whole content and puts the file under its name.
    pub fn write(
        self,
        content: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>,
    ) -> Result<(), ExportError> {
        let OutputFile { path, target } = self;
        let fill = |file: &mut File| {
            let mut writer = BufWriter::new(file);
            content(&mut writer).and_then(|()| writer.flush())
        };
        let written = match target {
            Target::Through(mut file) => fill(&mut file),
            Target::Whole { at, mut draft } => fill(draft.file()).and_then(|()| draft.put(&at)),
        };
        written.map_err(|source| ExportError::Write { path: path.display().to_string(), source })
    }
}

impl Target {
    fn open(path: &Path) -> io::Result<Target> {
        let wrong = |kind, what: String| Err(io::Error::new(kind, what));
        match path.metadata() {
            Ok(known) if known.is_dir() => {
                return wrong(io::ErrorKind::IsADirectory, "it is a folder".to_owned());
            }
            Ok(known) if !known.is_file() => {
                return Ok(Target::Through(File::options().write(true).open(path)?));
            }
            _ => {}
        }
        let folder = match path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let Some(name) = path.file_name() else {
            return wrong(io::ErrorKind::InvalidInput, "it names no file".to_owned());
        };
        if !folder.is_dir() {
            let what = format!("there is no folder {}", folder.display());
            return wrong(io::ErrorKind::NotFound, what);
        }
        // A link stays a link: what it leads to is replaced, there.
        let at = path.canonicalize().or_else(|_| folder.canonicalize().map(|f| f.join(name)))?;
        let draft = Draft::in_folder(at.parent().unwrap_or(folder))?;
        Ok(Target::Whole { at, draft })
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

    #[cfg(unix)]
    #[test]
    fn links_stay_links_and_what_is_no_file_is_not_replaced() {
        use std::os::unix::fs::{FileTypeExt, symlink};

        let folder = tempfile::tempdir().unwrap();
        let [file, link] = ["sky.txt", "link.txt"].map(|name| folder.path().join(name));
        std::fs::write(&file, "old").unwrap();
        symlink("sky.txt", &link).unwrap();
        let [first, second] = [&file, &link].map(|path| OutputFile::create(path).unwrap());
        assert!(first.is_same_as(&second));
        second.write(|w| w.write_all(b"new")).unwrap();
        assert!(link.is_symlink());
        assert_eq!(std::fs::read(&file).unwrap(), b"new");

        // A socket cannot be opened like a file; the point is that it is not replaced.
        let socket = folder.path().join("socket");
        let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
        assert!(OutputFile::create(&socket).is_err());
        assert!(socket.metadata().unwrap().file_type().is_socket());
    }
}
