//! Airs: what is listed, what is printed, and what a scene makes of them.

use libtest_mimic::Trial;

use super::harness::{DARK, IMPOSSIBLE, NONSENSE, Run, nocturne, trial, words};

pub fn trials() -> Vec<Trial> {
    vec![
        trial("airs::are_listed", || {
            let run = nocturne(["atmosphere"]).done();
            let lines: Vec<&str> = run.stdout.lines().collect();
            assert_eq!(lines.len(), 7, "{run}");
            assert!(lines[2].starts_with("maritime     The open sea"), "{run}");
        }),
        trial("airs::a_printed_file_is_read_back", || {
            let printed = nocturne(words("atmosphere volcanic")).done().stdout;
            assert!(printed.contains("[stratospheric_aerosol]"));
            let by_file = scene_with("my.toml", &printed);
            let by_name = scene_with("volcanic", "");
            assert_eq!(by_file, by_name);
            assert!(by_name.contains("kind = \"volcanic\""), "{by_name}");
        }),
        trial("airs::replace_the_air_of_the_scene", || {
            let scene = scene_with("desert", "");
            let run = nocturne(words(
                "render --scene old.toml --atmosphere reference-a --save-scene new.toml",
            ))
            .with_file("old.toml", scene)
            .done();
            let scene = String::from_utf8(run.read("new.toml")).unwrap();
            assert!(scene.contains("refracted = false") && !scene.contains("mie"), "{scene}");
        }),
        trial("airs::mistakes_are_told_with_their_line", || {
            let text = "[ozone]\ncolumn_du = 300\nthickness = 3\n";
            refused(text.as_bytes(), NONSENSE, &["--atmosphere my.toml", "line 3", "thickness"]);
        }),
        trial("airs::numbers_out_of_range", || {
            let text = b"aerosol.phase = { law = \"cornette-shanks\", g = 1 }";
            refused(
                text,
                NONSENSE,
                &["--atmosphere my.toml", "aerosol.phase.g is 1", "-0.9 to 0.9"],
            );
        }),
        trial("airs::no_text", || refused(b"\xff\xfe\x00", IMPOSSIBLE, &["UTF-8"])),
        trial("airs::missing", || {
            let run = nocturne(DARK).and(words("--atmosphere none.toml -o old.png"));
            run.refused(
                IMPOSSIBLE,
                &["--atmosphere none.toml", "No such file", "nocturne atmosphere"],
            );
        }),
    ]
}

/// The scene file of a render in an air, with the file `my.toml` beside.
fn scene_with(air: &str, file: &str) -> String {
    let run: Run = nocturne(DARK)
        .and(["--atmosphere", air, "--save-scene", "scene.toml"])
        .with_file("my.toml", file)
        .done();
    String::from_utf8(run.read("scene.toml")).unwrap()
}

fn refused(file: &[u8], code: i32, said: &[&str]) {
    let run = nocturne(DARK).and(words("--atmosphere my.toml -o old.png"));
    run.with_file("my.toml", file).refused(code, said);
}
