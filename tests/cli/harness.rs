//! Running the program and judging what it did.

use std::collections::BTreeMap;
use std::ffi::{OsStr, OsString};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};

use libtest_mimic::Trial;
use tempfile::TempDir;

/// The program under test.
pub const PROGRAM: &str = env!("CARGO_BIN_EXE_nocturne");

/// An instant without Sun and Moon over Flagstaff, and who asks for it.
pub const DARK: [&str; 5] = ["render", "--at", "2026-08-12T21:30-07:00", "--place", "Flagstaff"];

/// Exit code: what was asked for makes no sense.
pub const NONSENSE: i32 = 2;
/// Exit code: it makes sense but could not be done.
pub const IMPOSSIBLE: i32 = 1;

/// What the machine that the tests run on has.
pub struct Machine {
    /// A graphics adapter.
    pub draws: bool,
    /// Files without a name, in the folder for temporary files.
    pub has_unnamed_files: bool,
    /// The right to mount a small disk where nobody else sees it.
    pub mounts: bool,
}

impl Machine {
    pub fn look_around() -> Machine {
        Machine {
            draws: nocturne(["adapter"]).run().code() == Some(0),
            has_unnamed_files: has_unnamed_files(&std::env::temp_dir()),
            mounts: nocturne([""; 0])
                .through(&["unshare", "-rm", "sh", "-c", "mount -t tmpfs none ."])
                .succeeds(),
        }
    }
}

#[cfg(target_os = "linux")]
fn has_unnamed_files(folder: &Path) -> bool {
    use rustix::fs::{Mode, OFlags, open};

    open(folder, OFlags::TMPFILE | OFlags::WRONLY, Mode::RUSR | Mode::WUSR).is_ok()
}

#[cfg(not(target_os = "linux"))]
fn has_unnamed_files(_folder: &Path) -> bool {
    false
}

/// A test that panics if it fails.
pub fn trial(name: impl Into<String>, test: impl FnOnce() + Send + 'static) -> Trial {
    Trial::test(name, || {
        test();
        Ok(())
    })
}

/// The words of a command line, with blanks between them; none of them holds a blank.
pub fn words(line: &str) -> Vec<&str> {
    line.split_whitespace().collect()
}

/// The program, about to be run in a new folder.
pub struct Nocturne {
    folder: TempDir,
    before: Vec<OsString>,
    arguments: Vec<OsString>,
    environment: Vec<(&'static str, OsString)>,
}

/// The program with its arguments.
pub fn nocturne<A: AsRef<OsStr>>(arguments: impl IntoIterator<Item = A>) -> Nocturne {
    Nocturne {
        folder: tempfile::tempdir().expect("a folder for temporary files"),
        before: Vec::new(),
        arguments: arguments.into_iter().map(|a| a.as_ref().to_owned()).collect(),
        environment: Vec::new(),
    }
}

impl Nocturne {
    /// With more arguments.
    pub fn and<A: AsRef<OsStr>>(mut self, arguments: impl IntoIterator<Item = A>) -> Self {
        self.arguments.extend(arguments.into_iter().map(|a| a.as_ref().to_owned()));
        self
    }

    pub fn with_variable(mut self, name: &'static str, value: impl AsRef<OsStr>) -> Self {
        self.environment.push((name, value.as_ref().to_owned()));
        self
    }

    /// With a file in the folder, before the program runs.
    pub fn with_file(self, name: &str, content: impl AsRef<[u8]>) -> Self {
        fs::write(self.path(name), content).unwrap();
        self
    }

    /// Run by another program, which gets the command line as its last arguments.
    pub fn through(mut self, program: &[&str]) -> Self {
        self.before = program.iter().map(OsString::from).collect();
        self
    }

    /// Run by a shell, which finds the command line in `"$@"`.
    pub fn through_shell(self, script: &str) -> Self {
        self.through(&["sh", "-c", script, "sh"])
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// What a child process is made of; the tests set its streams.
    pub fn command(&self) -> Command {
        let line = self.before.iter().cloned().chain([PROGRAM.into()]);
        let mut line = line.chain(self.arguments.iter().cloned());
        let mut command = Command::new(line.next().unwrap());
        command.args(line).current_dir(self.folder.path()).stdin(Stdio::null());
        // A layer of the Mesa drivers looks for a window system and complains if there is none.
        command.env_remove("NOCTURNE_CATALOGS").env("NODEVICE_SELECT", "1");
        // Nothing is left in the folders of the user.
        command.env("NOCTURNE_CACHE", "");
        command.envs(self.environment.iter().cloned());
        command
    }

    fn succeeds(self) -> bool {
        let mut command = self.command();
        command.stdout(Stdio::null()).stderr(Stdio::null());
        command.status().is_ok_and(|status| status.success())
    }

    /// Runs it.
    pub fn run(self) -> Run {
        let before = contents(self.folder());
        let output = self.command().output().unwrap();
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
        Run {
            line: self.arguments,
            status: output.status,
            stdout: text(output.stdout),
            stderr: text(output.stderr),
            before,
            folder: self.folder,
        }
    }

    /// Runs it and expects that it does as it is told, without a word about errors.
    pub fn done(self) -> Run {
        let run = self.run();
        run.assert_done();
        run
    }

    /// Runs it among files that it is told to write, and expects one sentence with these words,
    /// this exit code, and all files as they were.
    pub fn refused(self, code: i32, words: &[&str]) {
        let old = ["old.png", "old.exr", "old.json", "old.toml", "old.csv"];
        let run = old.iter().fold(self, |run, name| run.with_file(name, *name)).run();
        run.assert_refused(code, words);
    }
}

/// What the program did.
pub struct Run {
    line: Vec<OsString>,
    status: ExitStatus,
    pub stdout: String,
    pub stderr: String,
    before: BTreeMap<OsString, Vec<u8>>,
    folder: TempDir,
}

impl Run {
    /// The exit code; none if a signal ended it.
    pub fn code(&self) -> Option<i32> {
        self.status.code()
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// A file that it wrote.
    pub fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}\n{self}"))
    }

    /// Names of the files in its folder.
    pub fn files(&self) -> Vec<OsString> {
        contents(self.folder.path()).into_keys().collect()
    }

    pub fn assert_done(&self) {
        assert_eq!(self.code(), Some(0), "{self}");
        assert_eq!(self.stderr, "", "{self}");
    }

    pub fn assert_refused(&self, code: i32, words: &[&str]) {
        assert_eq!(self.code(), Some(code), "{self}");
        assert_eq!(self.stdout, "", "{self}");
        self.assert_one_sentence(words);
        self.assert_files_untouched();
    }

    pub fn assert_one_sentence(&self, words: &[&str]) {
        let is_one_line = self.stderr.ends_with('\n') && self.stderr.lines().count() == 1;
        assert!(is_one_line && self.stderr.starts_with("nocturne: "), "{self}");
        for word in words {
            assert!(self.stderr.contains(word), "'{word}' is missing\n{self}");
        }
    }

    pub fn assert_files_untouched(&self) {
        let after = contents(self.folder.path());
        let names = |files: &BTreeMap<OsString, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
        assert_eq!(names(&after), names(&self.before), "{self}");
        assert!(after == self.before, "a file was changed\n{self}");
    }
}

impl std::fmt::Display for Run {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        let head: String = self.stdout.chars().take(2000).collect();
        let line = self.line.join(OsStr::new(" "));
        write!(f, "nocturne {}\n{}\n{head}\n{}", line.display(), self.status, self.stderr)
    }
}

/// Files and what they hold; folders and what is no file hold nothing.
fn contents(folder: &Path) -> BTreeMap<OsString, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    let content = |path: &Path| if path.is_file() { fs::read(path).unwrap() } else { Vec::new() };
    entries.map(|entry| (entry.file_name(), content(&entry.path()))).collect()
}
