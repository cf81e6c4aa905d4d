//! Every command that the README shows works, in the order in which it shows them.

use std::fs;
use std::path::Path;

use libtest_mimic::Trial;

use super::harness::{Machine, PROGRAM, nocturne, trial};

pub fn trials(machine: &Machine) -> Vec<Trial> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md");
    let readme = fs::read_to_string(path).ok();
    let has_readme = readme.is_some();
    let commands = commands(&readme.unwrap_or_default());
    let wordy: Vec<String> = commands.iter().filter(|line| !draws(line)).cloned().collect();
    vec![
        trial("readme::its_commands_are_found", commands_are_found),
        trial("readme::commands_that_do_not_draw_work", move || run_all(&wordy))
            .with_ignored_flag(!has_readme),
        trial("readme::all_commands_work", move || run_all(&commands))
            .with_ignored_flag(!has_readme || !machine.draws),
    ]
}

/// The command lines of its `sh` blocks that run the program, as a shell reads them.
fn commands(readme: &str) -> Vec<String> {
    let mut commands = Vec::new();
    let mut is_shell = false;
    let readme = readme.replace("\\\n", " ");
    for line in readme.lines().map(str::trim) {
        if let Some(language) = line.strip_prefix("```") {
            is_shell = !is_shell && matches!(language, "sh" | "bash" | "console");
        } else if is_shell {
            let line = line.strip_prefix("$ ").unwrap_or(line);
            let by_cargo = line.strip_prefix("cargo run ").and_then(|rest| rest.split_once("-- "));
            let arguments = match by_cargo {
                // Another binary of the package is another matter.
                Some((options, _)) if options.contains("--bin ") => None,
                Some((_, arguments)) => Some(arguments),
                None => ["nocturne ", "target/release/nocturne ", "./target/release/nocturne "]
                    .iter()
                    .find_map(|program| line.strip_prefix(program)),
            };
            commands.extend(arguments.map(|arguments| format!("nocturne {arguments}")));
        }
    }
    commands
}

/// Whether it needs an adapter, or a file that such a command wrote.
fn draws(line: &str) -> bool {
    [" -o", " --output", " adapter", " --scene"].iter().any(|option| line.contains(option))
}

/// Runs command lines, which may build on one another, in one folder.
fn run_all(lines: &[String]) {
    assert!(!lines.is_empty(), "the README shows no command of this kind in its sh blocks");
    let folder = Path::new(PROGRAM).parent().unwrap();
    let path = std::env::var_os("PATH").unwrap_or_default();
    let path = [folder.into()].into_iter().chain(std::env::split_paths(&path));
    let path = std::env::join_paths(path).unwrap();
    let mut script = "set -e\n".to_owned();
    for line in lines {
        // The line that fails is the last that is said.
        script += &format!("echo '> {}' >&2\n{line}\n", line.replace('\'', "'\\''"));
    }
    let run = nocturne([""; 0]).with_variable("PATH", path).through(&["sh", "-c", &script]).run();
    assert_eq!(run.code(), Some(0), "{run}");
}

fn commands_are_found() {
    let readme = "Text\n\n```sh\ncargo build --release\nnocturne place Flagstaff  # a comment\n\
        nocturne render \\\n    --place Paris -o a.png\n```\nnocturne talks\n```rust\nnocturne x\n\
        ```\n```sh\n$ nocturne adapter\ncargo run --release -- place Rome\n\
        cargo run --release --bin pack -- all\ntarget/release/nocturne place\n```\n";
    let expected = [
        "nocturne place Flagstaff  # a comment",
        "nocturne render      --place Paris -o a.png",
        "nocturne adapter",
        "nocturne place Rome",
        "nocturne place",
    ];
    let found = commands(readme);
    assert_eq!(found, expected);
    let drawn: Vec<bool> = found.iter().map(|line| draws(line)).collect();
    assert_eq!(drawn, [false, true, true, false, false]);
}
