//! `nocturne almanac` as its users meet it.

use std::collections::BTreeSet;
use std::fs;
use std::process::{Command, Output};

use serde_json::Value;

const WINTER: [&str; 7] =
    ["almanac", "--place", "Flagstaff", "--from", "2026-01-01", "--to", "2026-02-01"];

fn nocturne(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_nocturne")).args(arguments).output().expect("it runs")
}

fn written(arguments: &[&str]) -> String {
    let output = nocturne(arguments);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {stderr}");
    String::from_utf8(output.stdout).expect("text")
}

fn with<'a>(more: &[&'a str]) -> Vec<&'a str> {
    WINTER.iter().copied().chain(more.iter().copied()).collect()
}

/// Refused with exit code 2 and one sentence.
fn refused(arguments: &[&str], words: &[&str]) {
    let output = nocturne(arguments);
    let stderr = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {stderr}");
    assert!(output.stdout.is_empty(), "{arguments:?}");
    assert_eq!(stderr.lines().count(), 1, "{arguments:?}: {stderr}");
    assert!(words.iter().all(|word| stderr.contains(word)), "{arguments:?}: {stderr}");
}

#[test]
fn what_makes_no_sense_is_refused_in_a_sentence() {
    let span = ["--from", "2026-01-01", "--to", "2026-01-02"];
    refused(&["almanac", span[0], span[1]], &["give a place", "--place", "--lat and --lon"]);
    refused(&with(&["--events", "tides"]), &["--events", "'tides'", "phases"]);
    refused(&with(&["--events", ""]), &["--events", "''"]);
    refused(&with(&["--bodies", "sun,Vulcan"]), &["--bodies", "'Vulcan'", "nocturne objects"]);
    refused(&with(&["--horizon", "95"]), &["95", "-3.5", "--horizon"]);
    refused(&with(&["--horizon", "NaN"]), &["NaN", "--horizon"]);
    refused(&with(&["--dark-below", "5"]), &["5", "--dark-below"]);
    refused(&with(&["--within", "-1"]), &["--within -1"]);
    refused(&with(&["--format", "pdf"]), &["pdf", "table"]);
    refused(&with(&["--horizon", "1", "--dip"]), &["--dip"]);
    refused(
        &["almanac", "--place", "Flagstaff", "--from", "2026-01-02", "--to", "2026-01-01"],
        &["no time passes", "--to"],
    );
    refused(
        &["almanac", "--place", "Flagstaff", "--from", "4000-12-30", "--to", "4001-02-01"],
        &["4001", "-4000 to 4000"],
    );
    let bce = ["almanac", "--place", "Flagstaff", "--from", "-0584-05-01", "--to", "-0584-06-01"];
    let bce: Vec<&str> = bce.into_iter().chain(["--format", "ics"]).collect();
    refused(&bce, &["ics", "-584", "1 to 9999", "csv"]);
}

#[test]
fn the_table_tells_times_of_the_place_and_its_definitions() {
    // Named twice, it still rises once.
    let table = written(&with(&["--bodies", "Sun,sun", "--events", "rise,set,phases"]));
    // U.S. Naval Observatory, Flagstaff, 2026 January 1: 7:36 and 17:26, for a level horizon.
    let sunrise = table.lines().find(|line| line.contains("Sun rises")).expect("a sunrise");
    assert!(sunrise.starts_with("2026-01-01 07:35:"), "{sunrise}");
    assert!(sunrise.contains("MST") && sunrise.contains("UTC") && sunrise.contains("ESE"));
    assert_eq!(table.matches("Sun sets").count(), 31);
    assert_eq!(table.matches("Full Moon").count(), 1);
    assert!(table.contains("-50' for the Sun") && table.contains("Delta-T"), "{table}");
    assert!(!table.contains("perihelion"), "what was not asked for needs no definition");
}

#[test]
fn years_before_christ_are_listed() {
    // The eclipse of Thales, -584 May 28 (Julian).
    let table = written(&[
        "almanac",
        "--events",
        "eclipses",
        "--from",
        "-0584-05-01",
        "--to",
        "-0584-06-01",
    ]);
    let thales = table.lines().find(|line| line.starts_with("-0584-05-28 ")).expect("an eclipse");
    assert!(thales.contains("Greatest eclipse of the Sun, total"), "{thales}");
}

#[test]
fn csv_and_json_say_the_same() {
    let csv = written(&with(&["--format", "csv"]));
    let json: Value = serde_json::from_str(&written(&with(&["--format", "json"]))).expect("JSON");
    let mut lines = csv.lines().filter(|line| !line.starts_with('#'));
    let columns: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let events = json["events"].as_array().expect("an array");
    assert!(events.len() > 900, "{}", events.len());
    let mut lines = lines.map(|line| line.split(',').collect::<Vec<_>>());
    for event in events {
        let cells = lines.next().expect("as many lines");
        assert_eq!(cells.len(), columns.len());
        let cell = |name: &str| cells[columns.iter().position(|c| *c == name).expect("a column")];
        assert_eq!(event["event"], cell("event"));
        assert_eq!(event["utc"], cell("utc"));
        assert_eq!(event["local"], cell("local"));
        for number in ["jd_tt", "azimuth_deg", "separation_deg", "distance_km", "duration_h"] {
            match event[number].as_f64() {
                Some(value) => {
                    let written: f64 = cell(number).parse().expect("a number");
                    assert!((written - value).abs() < 6e-4, "{number}: {written} {value}");
                }
                None => assert_eq!(cell(number), ""),
            }
        }
    }
    assert!(lines.next().is_none());
    assert_eq!(json["place"]["time_zone"], "America/Phoenix");
    assert!(json["definitions"].as_array().is_some_and(|all| all.len() > 5));
    // Nothing happens in a second, and that is an array, too.
    let none = written(&[
        "almanac",
        "--events",
        "seasons",
        "--from",
        "2026-01-01",
        "--to",
        "2026-01-02",
        "--format",
        "json",
    ]);
    let none: Value = serde_json::from_str(&none).expect("JSON");
    assert_eq!(none["events"].as_array().map(Vec::len), Some(0));
}

/// Names and values of the lines of an iCalendar object, unfolded (RFC 5545, section 3.1).
fn unfolded(text: &str) -> Vec<(String, String)> {
    assert!(text.ends_with("\r\n"));
    assert_eq!(text.matches('\n').count(), text.matches("\r\n").count());
    assert!(text.split("\r\n").all(|line| line.len() <= 75), "a line is too long");
    let whole = text.replace("\r\n ", "");
    let lines = whole.split("\r\n").filter(|line| !line.is_empty());
    lines
        .map(|line| {
            let (name, value) = line.split_once(':').expect("a colon");
            (name.to_owned(), value.to_owned())
        })
        .collect()
}

fn is_date_time(text: &str) -> bool {
    let digits = |range: std::ops::Range<usize>| {
        text.get(range).is_some_and(|part| part.bytes().all(|b| b.is_ascii_digit()))
    };
    text.len() == 16 && digits(0..8) && &text[8..9] == "T" && digits(9..15) && text.ends_with('Z')
}

#[test]
fn calendars_can_read_it() {
    let lines = unfolded(&written(&with(&["--format", "ics"])));
    let pair = |name: &str, value: &str| (name.to_owned(), value.to_owned());
    assert_eq!(lines[0], pair("BEGIN", "VCALENDAR"));
    assert_eq!(lines[lines.len() - 1], pair("END", "VCALENDAR"));
    assert!(lines.contains(&pair("VERSION", "2.0")));
    assert!(lines.iter().any(|(name, _)| name == "PRODID"));

    let json: Value = serde_json::from_str(&written(&with(&["--format", "json"]))).expect("JSON");
    let events = json["events"].as_array().expect("an array");
    let mut identifiers = BTreeSet::new();
    let mut count = 0;
    for event in lines.split(|line| *line == pair("BEGIN", "VEVENT")).skip(1) {
        let all = |name: &str| -> Vec<&str> {
            event.iter().filter(|(n, _)| n == name).map(|(_, v)| v.as_str()).collect()
        };
        let one = |name: &str| match all(name)[..] {
            [value] => value,
            ref values => panic!("{name}: {values:?}"),
        };
        assert!(identifiers.insert(one("UID").to_owned()), "{} twice", one("UID"));
        assert!(is_date_time(one("DTSTAMP")) && is_date_time(one("DTSTART")));
        let known = &events[count];
        let title = known["title"].as_str().expect("a title").replace(',', "\\,");
        assert_eq!(one("SUMMARY"), title.replace(';', "\\;"));
        // To the second: the minute may be the next one.
        let utc = known["utc"].as_str().expect("a time").replace(['-', ':'], "");
        let (start, exact) = (one("DTSTART"), &utc[..13]);
        let second: f64 = utc[13..].trim_end_matches('Z').parse().expect("seconds");
        assert!(start.starts_with(exact) || second >= 59.5, "{start} {utc}");
        match known["end_utc"].as_str() {
            Some(_) => assert!(is_date_time(one("DTEND")) && one("DTEND") >= start),
            None => assert!(all("DTEND").is_empty()),
        }
        if !all("GEO").is_empty() {
            let (lat, lon) = one("GEO").split_once(';').expect("two numbers");
            assert!((lat.parse::<f64>().unwrap() - 35.198).abs() < 0.01);
            assert!((lon.parse::<f64>().unwrap() + 111.651).abs() < 0.01);
            assert_eq!(one("LOCATION"), "Flagstaff");
        }
        count += 1;
    }
    assert_eq!(count, events.len());
}

#[test]
fn files_are_written_whole_or_not_at_all() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("sky.ics");
    let name = path.to_str().expect("text");
    assert_eq!(written(&with(&["--format", "ics", "-o", name])), "");
    let content = fs::read_to_string(&path).expect("a file");
    assert!(content.starts_with("BEGIN:VCALENDAR\r\n") && content.ends_with("END:VCALENDAR\r\n"));

    refused(&with(&["--horizon", "95", "-o", name]), &["--horizon"]);
    assert_eq!(fs::read_to_string(&path).expect("the same file"), content);
    let output = nocturne(&with(&["-o", "no/such/folder/sky.csv"]));
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(fs::read_dir(folder.path()).expect("the folder").count(), 1);
    #[cfg(target_os = "linux")]
    {
        let output = nocturne(&with(&["-o", "/dev/full"]));
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{stderr}");
        assert!(stderr.contains("writing /dev/full failed"), "{stderr}");
    }
}
