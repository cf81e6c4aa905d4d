//! Files are whole or not there at all, and what reads our output may stop when it likes.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use libtest_mimic::Trial;

use super::harness::{DARK, IMPOSSIBLE, Machine, NONSENSE, Nocturne, nocturne, trial, words};

pub fn trials(machine: &Machine) -> Vec<Trial> {
    let mut trials = vec![
        trial("outputs::nothing_to_write", || {
            nocturne(DARK).refused(NONSENSE, &["nothing to write", "--output FILE", "--describe"]);
        }),
        trial("outputs::unknown_extensions", || {
            for name in ["sky.jpg", "sky", ".png", "sky.png.txt", "-"] {
                let run = nocturne(DARK).and(["-o", name]);
                run.refused(NONSENSE, &["--output", name, ".png or .exr"]);
            }
        }),
        trial("outputs::no_name", || {
            nocturne(DARK).and(["-o", ""]).refused(NONSENSE, &["--output <FILE>", "--help"]);
        }),
        trial("outputs::one_file_for_two_outputs", one_file_for_two_outputs),
        trial("outputs::folders_that_are_none", folders_that_are_none),
        trial("outputs::a_file_is_no_folder", || {
            for option in ["-o", "--describe", "--save-scene"] {
                let run = nocturne(DARK).and([option, "old.png/sky.png"]);
                run.refused(IMPOSSIBLE, &["old.png/sky.png", "no folder old.png", "another"]);
            }
        }),
        trial("outputs::a_folder_is_no_file", || {
            for option in ["-o", "--describe", "--save-scene"] {
                let run = nocturne(DARK).and([option, "folder.png"]);
                fs::create_dir(run.path("folder.png")).unwrap();
                run.refused(IMPOSSIBLE, &["folder.png", "is a folder", "another file"]);
            }
        }),
        trial("outputs::a_good_output_beside_a_bad_one_is_not_begun", || {
            let run = nocturne(DARK).and(words("-o old.png --describe old.json -o none/sky.exr"));
            run.refused(IMPOSSIBLE, &["none/sky.exr", "no folder none"]);
        }),
        trial("outputs::the_old_file_gives_way_to_the_whole_new_one", || {
            let run = nocturne(DARK).and(words("--quiet --describe sky.json"));
            let run = run.with_file("sky.json", "old").done();
            assert!(serde_json::from_slice::<serde_json::Value>(&run.read("sky.json")).is_ok());
            assert_eq!(run.files(), ["sky.json"]);
        }),
        trial("outputs::standard_output_that_is_full", || {
            for line in ["place", "--help", "render --place Flagstaff --quiet --describe -"] {
                let run = nocturne(words(line)).through_shell(r#"exec "$@" >/dev/full"#);
                run.refused(IMPOSSIBLE, &["standard output", "No space left"]);
            }
        })
        .with_ignored_flag(!Path::new("/dev/full").exists()),
        trial("outputs::standard_error_that_is_full", || {
            let run = nocturne(["place", "Xqzzyv"]).through_shell(r#"exec "$@" 2>/dev/full"#).run();
            assert_eq!(run.code(), Some(NONSENSE), "{run}");
        })
        .with_ignored_flag(!Path::new("/dev/full").exists()),
        trial("outputs::readers_may_stop", readers_may_stop),
        trial("outputs::nobody_listens_at_all", || {
            let run = nocturne(["place"]).through_shell(r#"exec "$@" >&-"#).done();
            assert_eq!(run.stdout, "");
        }),
    ];
    #[cfg(unix)]
    trials.extend([
        trial("outputs::a_file_as_large_as_is_allowed", the_limit_of_a_file_is_reached),
        trial("outputs::a_limit_that_kills_leaves_nothing", a_limit_that_kills_leaves_nothing)
            .with_ignored_flag(!machine.has_unnamed_files),
        trial("outputs::a_killed_program_leaves_nothing", a_killed_program_leaves_nothing)
            .with_ignored_flag(!machine.has_unnamed_files),
        trial("outputs::a_full_disk", a_full_disk).with_ignored_flag(!machine.mounts),
        trial("outputs::pipes_are_written_into", pipes_are_written_into),
        trial("outputs::links_are_followed", links_are_followed),
    ]);
    trials
}

fn one_file_for_two_outputs() {
    for line in [
        "-o old.png -o ./old.png",
        "-o old.png --describe old.png",
        "-o new.png --save-scene ./new.png",
        "--describe old.json --save-scene old.json",
    ] {
        let run = nocturne(DARK).and(words(line));
        run.refused(NONSENSE, &["two outputs", "a file of its own"]);
    }
}

fn folders_that_are_none() {
    for (option, name) in [
        ("-o", "none/sky.png"),
        ("-o", "none/sky.exr"),
        ("--describe", "none/sky.json"),
        ("--save-scene", "none/sky.toml"),
    ] {
        let run = nocturne(DARK).and([option, name]);
        run.refused(IMPOSSIBLE, &[name, "there is no folder none", "choose another"]);
    }
}

/// More than a pipe holds is written and not read.
fn readers_may_stop() {
    for line in [
        "objects --place Flagstaff --at 2026-08-12T21:30-07:00",
        "render --place Flagstaff --at 2026-08-12T21:30-07:00 --quiet --describe -",
    ] {
        let run = nocturne(words(line));
        let mut child =
            run.command().stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut first = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut first).unwrap();
        assert!(!first.is_empty());
        let output = child.wait_with_output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success() && said.is_empty(), "{line}: {} {said}", output.status);
    }
}

/// A description is some megabytes; these shells allow files of some kilobytes.
fn described() -> Nocturne {
    nocturne(DARK).and(words("--quiet --describe old.json"))
}

#[cfg(unix)]
fn the_limit_of_a_file_is_reached() {
    let run = described().through_shell(r#"trap '' XFSZ; ulimit -f 8; exec "$@""#);
    run.refused(IMPOSSIBLE, &["writing old.json failed and left nothing behind", "too large"]);
}

#[cfg(unix)]
fn a_limit_that_kills_leaves_nothing() {
    let run = described().with_file("old.json", "old");
    let run = run.through_shell(r#"ulimit -c 0; ulimit -f 8; exec "$@""#).run();
    assert_eq!(run.code(), None, "a signal should have ended it: {run}");
    run.assert_files_untouched();
}

/// The program is stopped for good while it waits for somebody to read its scene, when the file of
/// the picture is already open.
#[cfg(unix)]
fn a_killed_program_leaves_nothing() {
    let run = nocturne(DARK).and(words("-o sky.exr --save-scene pipe")).with_file("sky.exr", "old");
    make_pipe(&run.path("pipe"));
    let folder = run.folder().canonicalize().unwrap();
    let mut child = run.command().stdout(Stdio::null()).spawn().unwrap();
    let waiting_since = Instant::now();
    while !has_open_file_in(&child, &folder) {
        assert!(waiting_since.elapsed() < Duration::from_secs(30), "it opens no file");
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    assert!(!child.wait().unwrap().success());
    let mut files: Vec<_> =
        fs::read_dir(&folder).unwrap().map(|e| e.unwrap().file_name()).collect();
    files.sort();
    assert_eq!(files, ["pipe", "sky.exr"]);
    assert_eq!(fs::read(folder.join("sky.exr")).unwrap(), b"old");
}

#[cfg(unix)]
fn has_open_file_in(child: &Child, folder: &Path) -> bool {
    let open = fs::read_dir(format!("/proc/{}/fd", child.id()));
    open.into_iter().flatten().flatten().any(|entry| {
        entry.path().read_link().is_ok_and(|path| path.parent().is_some_and(|p| p == folder))
    })
}

#[cfg(unix)]
fn make_pipe(path: &Path) {
    let made = std::process::Command::new("mkfifo").arg(path).status().unwrap();
    assert!(made.success());
}

/// On a disk of 64 kilobytes, which only the program's own shell can see.
#[cfg(unix)]
fn a_full_disk() {
    let script = r#"mount -t tmpfs -o size=64k none "$1" || exit 77
        cd "$1"; shift; printf old >old.json; "$@"; code=$?
        ls -A; cat old.json; exit $code"#;
    let run = described();
    fs::create_dir(run.path("disk")).unwrap();
    let run = run.through(&["unshare", "-rm", "sh", "-c", script, "sh", "disk"]).run();
    assert_eq!(run.code(), Some(IMPOSSIBLE), "{run}");
    run.assert_one_sentence(&["writing old.json failed and left nothing behind", "No space left"]);
    assert_eq!(run.stdout, "old.json\nold", "{run}");
}

#[cfg(unix)]
fn pipes_are_written_into() {
    let run = nocturne(DARK).and(words("--quiet --describe pipe"));
    make_pipe(&run.path("pipe"));
    let pipe = run.path("pipe");
    let reader = std::thread::spawn(move || fs::read(pipe).unwrap());
    let run = run.done();
    assert!(serde_json::from_slice::<serde_json::Value>(&reader.join().unwrap()).is_ok());
    run.assert_files_untouched();
    assert!(!run.path("pipe").is_file(), "the pipe was replaced by a file");
}

#[cfg(unix)]
fn links_are_followed() {
    let run = nocturne(DARK).and(words("--quiet --describe link.json"));
    let run = run.with_file("sky.json", "old");
    std::os::unix::fs::symlink("sky.json", run.path("link.json")).unwrap();
    let run = run.done();
    assert!(run.path("link.json").is_symlink());
    assert!(run.read("sky.json").starts_with(b"{"));
    assert_eq!(run.files(), ["link.json", "sky.json"]);
}
