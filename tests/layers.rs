//! The layers of the source tree: a file may import what lies below it, never what lies above.
//!
//! Two modules of one rank may stand in one folder, and then one may import the other. Within a
//! module files are free: a parent uses its children, a child the plain data of its parent. Tests
//! inside the source may use anything.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Lowest first. `light::spectrum` stands below the rest of its module: the air is told in spectra.
const RANKS: [&[&str]; 14] = [
    &["units", "frame", "image", "store", "background", "memory"],
    &["time", "place", "catalog", "camera"],
    &["ephemeris"],
    &["sky", "almanac", "light::spectrum"],
    &["air", "eye", "photo", "display"],
    &["light"],
    &["scene"],
    &["plan"],
    &["render"],
    &["studio"],
    &["export", "overlay"],
    &["job"],
    &["app"],
    &["cli", "bin"],
];

/// Words that only some modules may use.
const DOORS: [(&str, &[&str]); 5] = [
    ("wgpu", &["render", "app"]),
    ("clap", &["cli", "bin"]),
    ("fs::read", &["store", "memory", "catalog", "cli", "bin", "export"]),
    ("File::open", &["store", "catalog", "cli", "bin", "export"]),
    ("read_to_string", &["memory", "catalog", "app", "cli", "bin", "export"]),
];

#[test]
fn files_import_only_what_lies_below_them() {
    let mut faults = Vec::new();
    let mut level = BTreeSet::new();
    for (file, module, code) in sources() {
        let (rank, from) = ranked(&module).unwrap_or_else(|| panic!("{file} has no rank"));
        for (line, import) in imports(&module, &code) {
            let place = format!("{file}:{line}: {import}");
            let Some((other, to)) = ranked(&import) else {
                faults.push(format!("{place} has no rank"));
                continue;
            };
            let apart = from.contains("::") || to.contains("::");
            if other > rank || other == rank && from != to && apart {
                faults.push(format!("{place} lies no lower than {from}"));
            } else if other == rank && from != to {
                level.insert((from, to));
                if level.contains(&(to, from)) {
                    faults.push(format!("{place}, and {to} imports {from}"));
                }
            }
        }
    }
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
    assert!(level.contains(&("frame", "units")), "no imports were found: {level:?}");
}

#[test]
fn what_has_a_door_is_used_behind_it() {
    let mut faults = Vec::new();
    let mut used = BTreeSet::new();
    for (file, module, code) in sources() {
        let top = module.split("::").next().unwrap_or_default();
        for (number, line) in code.lines().enumerate() {
            for (word, allowed) in DOORS.iter().filter(|(word, _)| line.contains(word)) {
                used.insert(*word);
                if !allowed.contains(&top) {
                    faults.push(format!("{file}:{}: {word} is for {allowed:?}", number + 1));
                }
            }
        }
    }
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
    assert!(used.contains("wgpu") && used.contains("clap") && used.contains("fs::read"));
}

/// The rank of a path such as `light::night::Night`, and the module that has it.
fn ranked(path: &str) -> Option<(usize, &'static str)> {
    let holds = |module: &str| path == module || path.starts_with(&format!("{module}::"));
    let all =
        RANKS.iter().enumerate().flat_map(|(rank, names)| names.iter().map(move |n| (rank, *n)));
    all.filter(|(_, module)| holds(module)).max_by_key(|(_, module)| module.len())
}

/// Every file of the crate but its root: name, module path, code without comments and tests.
fn sources() -> Vec<(String, String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    collect(&root, &mut files);
    let source = |path: &PathBuf| {
        let name = path.strip_prefix(&root).expect("below the root").with_extension("");
        let module = name.iter().map(|part| part.to_string_lossy()).collect::<Vec<_>>().join("::");
        let text = fs::read_to_string(path).expect("source is text");
        (format!("src/{}.rs", module.replace("::", "/")), module, code_of(&text))
    };
    let all = files.iter().map(source).filter(|(_, module, _)| module != "lib");
    all.map(|(file, module, code)| (file, module.replace("main", "bin"), code)).collect()
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder of the source") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
}

/// Blanks comments and what is compiled for tests alone; the lines keep their numbers.
fn code_of(text: &str) -> String {
    let mut test_column = None;
    let mut blanked = |line: &str| {
        let column = line.len() - line.trim_start().len();
        match test_column {
            None if line.trim_start().starts_with("#[cfg(test)]") => test_column = Some(column),
            None => return line.split("//").next().unwrap_or_default().to_owned() + "\n",
            // rustfmt ends an item in the column in which it began.
            Some(begun) if begun == column && line.ends_with(['}', ';']) => test_column = None,
            Some(_) => {}
        }
        "\n".to_owned()
    };
    text.lines().map(&mut blanked).collect()
}

/// What a file names inside the crate: lines, and paths without `crate::`.
///
/// Of `crate::light::{moon, sun}` the path is `light`; `crate::{air, light}` has none, so that it is
/// refused: one `use` for each module reads better.
fn imports(module: &str, code: &str) -> Vec<(usize, String)> {
    // Repeated so many times, `super` leaves so many names of the path of the file.
    let names: Vec<&str> = module.split("::").collect();
    let absolute = (1..=names.len()).rev().fold(code.to_owned(), |code, up| {
        let parent: String = names[..names.len() - up].iter().map(|n| format!("{n}::")).collect();
        code.replace(&"super::".repeat(up), &format!("crate::{parent}"))
    });
    let path_at = |at: usize| {
        let rest = &absolute[at..];
        let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_' && c != ':');
        rest[..end.unwrap_or(rest.len())].trim_end_matches(':').to_owned()
    };
    let found = absolute.match_indices("crate::");
    found.map(|(at, word)| (absolute[..at].lines().count(), path_at(at + word.len()))).collect()
}
