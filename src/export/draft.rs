//! A file while it is being written: without a name where the system can do that, so that nothing
//! is left of it whatever ends the program.

use std::fs::File;
use std::io;
use std::path::Path;

use tempfile::NamedTempFile;

/// What the name of a draft begins with, for as long as it has one.
const PREFIX: &str = ".nocturne-";

/// A file that is not yet under its name.
#[derive(Debug)]
pub(super) enum Draft {
    #[cfg(target_os = "linux")]
    Unnamed(File),
    Named(NamedTempFile),
}

impl Draft {
    /// A draft on the disk of a folder.
    pub fn in_folder(folder: &Path) -> io::Result<Draft> {
        #[cfg(target_os = "linux")]
        if let Ok(file) = unnamed::open(folder) {
            return Ok(Draft::Unnamed(file));
        }
        Draft::named_in(folder)
    }

    fn named_in(folder: &Path) -> io::Result<Draft> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(PREFIX);
        // The umask takes its share, as from any other program; the default would be private.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let file = builder.tempfile_in(folder);
        // The name of the temporary file would mean nothing to anybody.
        Ok(Draft::Named(file.map_err(|error| io::Error::from(error.kind()))?))
    }

    pub fn file(&mut self) -> &mut File {
        match self {
            #[cfg(target_os = "linux")]
            Draft::Unnamed(file) => file,
            Draft::Named(file) => file.as_file_mut(),
        }
    }

    /// Puts the finished file under its name, in place of what was there.
    pub fn put(mut self, path: &Path) -> io::Result<()> {
        self.file().sync_all()?;
        match self {
            #[cfg(target_os = "linux")]
            Draft::Unnamed(file) => {
                let folder = path.parent().unwrap_or(Path::new("."));
                let mut builder = tempfile::Builder::new();
                let named =
                    builder.prefix(PREFIX).make_in(folder, |at| unnamed::link(&file, at))?;
                named.persist(path).map_err(|error| error.error)
            }
            Draft::Named(file) => file.persist(path).map(drop).map_err(|error| error.error),
        }
    }
}

/// Files without a name (`O_TMPFILE` of open(2)), which vanish with the program.
#[cfg(target_os = "linux")]
mod unnamed {
    use std::fs::File;
    use std::io;
    use std::os::fd::AsRawFd;
    use std::os::unix::fs::OpenOptionsExt;
    use std::path::Path;

    use rustix::fs::{AtFlags, CWD, OFlags, linkat};

    /// Where the system shows the open files of a program.
    const OPEN_FILES: &str = "/proc/self/fd";

    pub fn open(folder: &Path) -> io::Result<File> {
        // Without it there is no way back to a name.
        Path::new(OPEN_FILES).metadata()?;
        let flags = OFlags::TMPFILE.bits() as i32;
        File::options().read(true).write(true).mode(0o666).custom_flags(flags).open(folder)
    }

    /// Gives the file a name that is not taken.
    pub fn link(file: &File, path: &Path) -> io::Result<()> {
        let number = format!("{OPEN_FILES}/{}", file.as_raw_fd());
        Ok(linkat(CWD, number, CWD, path, AtFlags::SYMLINK_FOLLOW)?)
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::io::Write;

    use super::*;

    #[test]
    fn drafts_with_and_without_a_name_take_the_place_of_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sky.txt");
        for make in [Draft::in_folder, Draft::named_in] {
            fs::write(&path, "old").unwrap();
            let mut draft = make(folder.path()).unwrap();
            draft.file().write_all(b"new").unwrap();
            assert_eq!(fs::read(&path).unwrap(), b"old");
            draft.put(&path).unwrap();
            assert_eq!(fs::read(&path).unwrap(), b"new");
            assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
        }
    }

    #[test]
    fn a_draft_that_is_given_up_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        for make in [Draft::in_folder, Draft::named_in] {
            let mut draft = make(folder.path()).unwrap();
            draft.file().write_all(b"half").unwrap();
            drop(draft);
            assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
        }
    }

    #[cfg(unix)]
    #[test]
    fn both_kinds_of_draft_may_be_read_by_the_same_people() {
        use std::os::unix::fs::PermissionsExt;

        let folder = tempfile::tempdir().unwrap();
        let modes = [Draft::in_folder, Draft::named_in].map(|make| {
            let path = folder.path().join("sky.txt");
            make(folder.path()).unwrap().put(&path).unwrap();
            fs::metadata(&path).unwrap().permissions().mode()
        });
        assert_eq!(modes[0], modes[1]);
    }
}
