//! `nocturne ephemeris` as its users meet it: columns, order, formats, promises, refusals.

#[path = "cli/harness.rs"]
#[allow(dead_code, reason = "what draws is tested elsewhere")]
mod harness;
mod ephemeris_cli {
    pub mod parquet;
}

use std::collections::HashMap;
use std::fmt::Write;
use std::path::Path;

use ephemeris_cli::parquet;
use harness::{IMPOSSIBLE, NONSENSE, Nocturne, nocturne, words};
use serde_json::Value;

/// DE440 reduced by ERFA: see the head of the table.
const DE440: &str = include_str!("truth/ephemeris_de440.csv");

const KEYS: &str = "body,jd_tt_1,jd_tt_2,jd_ut1_1,jd_ut1_2,lon_deg_E,lat_deg_N,height_m";
const FIGURES: &str = "geo_ra_app_deg,geo_dec_app_deg,geo_dist_km,topo_ra_app_deg,topo_dec_app_deg,\
    topo_dist_km,az_deg,alt_deg_airless,geo_libr_lon_deg,geo_libr_lat_deg,subsolar_lon_deg,\
    subsolar_lat_deg,colongitude_deg,phase_angle_deg,illum_frac,axis_PA_deg,bright_limb_PA_deg,\
    geo_ang_diam_arcsec,topo_libr_lon_deg,topo_libr_lat_deg,topo_axis_PA_deg,topo_ang_diam_arcsec";
/// A row about the Moon.
const MOON: &str =
    "moon,2450618.5,-0.045750869,2450618.0,0.453524094123,-152.32122,-37.86056,334.5";

/// A table by the names of its columns.
struct Csv<'a> {
    columns: Vec<&'a str>,
    rows: Vec<HashMap<&'a str, &'a str>>,
}

fn csv(text: &str) -> Csv<'_> {
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let columns: Vec<&str> = lines.next().expect("a head").split(',').collect();
    let rows = lines.map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(cells.len(), columns.len(), "{line}");
        columns.iter().copied().zip(cells).collect()
    });
    Csv { rows: rows.collect(), columns: columns.clone() }
}

fn number(cell: &str) -> f64 {
    cell.parse().unwrap_or_else(|_| panic!("{cell:?} is no number"))
}

/// The program with rows in a file.
fn with_rows(rows: &str) -> Nocturne {
    nocturne(words("ephemeris --rows rows.csv")).with_file("rows.csv", rows)
}

/// Arcseconds between two directions given in degrees.
fn separation_arcsec(a: [f64; 2], b: [f64; 2]) -> f64 {
    let vector = |[lon, lat]: [f64; 2]| {
        let ((sin_lon, cos_lon), (sin_lat, cos_lat)) =
            (lon.to_radians().sin_cos(), lat.to_radians().sin_cos());
        [cos_lat * cos_lon, cos_lat * sin_lon, sin_lat]
    };
    let (a, b) = (vector(a), vector(b));
    let chord: f64 = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    (2.0 * (chord / 2.0).asin()).to_degrees() * 3600.0
}

#[test]
fn rows_are_answered_as_well_as_each_promises() {
    let run = with_rows(DE440).done();
    let (asked, given) = (csv(DE440), csv(&run.stdout));
    assert_eq!(given.columns.join(","), format!("{KEYS},{FIGURES},tier,error_bound_arcsec"));
    assert_eq!(given.rows.len(), asked.rows.len());
    let mut moons = 0;
    for (asked, given) in asked.rows.iter().zip(&given.rows) {
        for key in KEYS.split(',') {
            assert_eq!(asked[key], given[key]);
        }
        let bound_arcsec = number(given["error_bound_arcsec"]);
        for [lon, lat] in [
            ["geo_ra_app_deg", "geo_dec_app_deg"],
            ["topo_ra_app_deg", "topo_dec_app_deg"],
            ["az_deg", "alt_deg_airless"],
        ] {
            let dir = |row: &HashMap<&str, &str>| [number(row[lon]), number(row[lat])];
            let error = separation_arcsec(dir(asked), dir(given));
            assert!(error <= bound_arcsec, "{lon}: {error} > {bound_arcsec}, {given:?}");
        }
        for distance in ["geo_dist_km", "topo_dist_km"] {
            assert_eq!(asked[distance].is_empty(), given[distance].is_empty(), "{given:?}");
            if !asked[distance].is_empty() {
                let ratio = number(given[distance]) / number(asked[distance]);
                assert!((ratio - 1.0).abs() < 1e-3, "{distance}: {ratio}");
            }
        }
        for column in FIGURES.split(',').skip(8) {
            assert_eq!(given[column].is_empty(), asked["body"] != "moon", "{column}: {given:?}");
            if asked[column].is_empty() {
                continue;
            }
            let error = number(given[column]) - number(asked[column]);
            let (error, tolerance) = match column {
                "illum_frac" => (error, 1e-4),
                _ if column.ends_with("arcsec") => (error, 0.3),
                // Of the Moon's axis, and the Moon itself.
                _ => ((error + 180.0).rem_euclid(360.0) - 180.0, 0.012 + bound_arcsec / 3600.0),
            };
            // The limb of a thin Moon turns about itself.
            let is_sharp = column != "bright_limb_PA_deg" || number(asked["illum_frac"]) > 0.01;
            assert!(error.abs() < tolerance || !is_sharp, "{column}: {error}, {given:?}");
            moons += 1;
        }
    }
    assert!(moons > 500, "{moons}");
}

#[test]
fn columns_stand_in_any_order_beside_others() {
    let plain = with_rows(&format!("{KEYS}\n{MOON}\n")).done().stdout;
    let shuffled = "\u{feff}# made by hand\r\n\r\n\
        note,height_m,lat_deg_N , jd_ut1_2,jd_ut1_1,body,jd_tt_2,jd_tt_1,lon_deg_E,utc_iso\r\n\
        # a comment\r\n\
        \"by day, \"\"high\"\"\", 334.5,-37.86056,0.453524094123,2450618.0,\"moon\" ,-0.045750869,\
        2450618.5,-152.32122,\r\n\r\n";
    assert_eq!(with_rows(shuffled).done().stdout, plain);
    // A file may end without an end of its last line.
    assert_eq!(with_rows(&format!("{KEYS}\n{MOON}")).done().stdout, plain);
}

#[test]
fn ut1_is_computed_where_nobody_gives_it() {
    let cells: Vec<&str> = MOON.split(',').collect();
    let kept: Vec<&str> = [&cells[..3], &cells[5..]].concat();
    let without =
        format!("body,jd_tt_1,jd_tt_2,lon_deg_E,lat_deg_N,height_m\n{}\n", kept.join(","));
    let blank = format!("{KEYS}\n{},,,{}\n", cells[..3].join(","), cells[5..].join(","));
    let (without, blank) = (with_rows(&without).done().stdout, with_rows(&blank).done().stdout);
    assert_eq!(without, blank);
    let computed = csv(&without);
    let ut1 =
        number(computed.rows[0]["jd_ut1_1"]) - 2_450_618.0 + number(computed.rows[0]["jd_ut1_2"]);
    // 1997: measured by the IERS; the row has it from there.
    assert!(((ut1 - 0.453_524_094_123) * 86_400.0).abs() < 1e-3, "{ut1}");
    // What was computed can be given back.
    assert_eq!(with_rows(&without).done().stdout, without);
}

#[test]
fn a_span_is_what_its_rows_are() {
    let line = "ephemeris --body all,Sirius,barnard --place Flagstaff --from 1969-07-16T06:32 \
        --to 1969-07-24 --step 37h";
    let span = nocturne(words(line)).done().stdout;
    let rows = with_rows(&span).done().stdout;
    let (span, rows) = (csv(&span), csv(&rows));
    assert_eq!(span.rows.len(), 12 * 6);
    assert_eq!(rows.rows.len(), span.rows.len());
    for (span, row) in span.rows.iter().zip(&rows.rows) {
        for column in &rows.columns {
            assert_eq!(span[column], row[column], "{column}");
        }
    }
    let utc: Vec<&str> = span.rows.iter().step_by(12).map(|row| row["utc_iso"]).collect();
    let first = ["1969-07-16T13:32:00Z", "1969-07-18T02:32:00Z", "1969-07-19T15:32:00Z"];
    assert_eq!(utc[..3], first);
    let bodies: Vec<&str> = span.rows[..12].iter().map(|row| row["body"]).collect();
    let all = "Sun Moon Mercury Venus Mars Jupiter Saturn Uranus Neptune Pluto Sirius barnard";
    assert_eq!(bodies, words(all));
}

#[test]
fn without_a_place_the_earth_is_looked_out_of() {
    let at = "--body Moon --from 2026-08-20T17:46Z";
    let centre = nocturne(words(&format!("ephemeris {at}"))).done().stdout;
    let place = nocturne(words(&format!("ephemeris {at} --lat 40 --lon -4"))).done().stdout;
    let (centre, place) = (csv(&centre), csv(&place));
    let is_of_a_place = |column: &str| {
        column.starts_with("topo_")
            || ["lon_deg_E", "lat_deg_N", "height_m", "az_deg", "alt_deg_airless"].contains(&column)
    };
    let expected: Vec<&str> =
        place.columns.iter().copied().filter(|column| !is_of_a_place(column)).collect();
    assert_eq!(centre.columns, expected);
    for column in &centre.columns {
        let (centre, place) = (centre.rows[0][column], place.rows[0][column]);
        // Where the Sun shines on the Moon is told for the light that arrives at the place.
        let is_near = |place: f64| (number(centre) - place).abs() < 1e-6;
        assert!(centre == place || is_near(number(place)), "{column}: {centre} {place}");
    }
}

#[test]
fn steps_keep_the_hour_across_leap_seconds_and_calendars() {
    let utc = |from: &str, to: &str, step: &str| -> Vec<String> {
        let line = ["ephemeris", "--body", "Sun", "--from", from, "--to", to, "--step", step];
        let run = nocturne(line).done();
        csv(&run.stdout).rows.iter().map(|row| row["utc_iso"].to_owned()).collect()
    };
    assert_eq!(
        utc("2016-12-31T06:00Z", "2017-01-01T18:00Z", "12h"),
        [
            "2016-12-31T06:00:00Z",
            "2016-12-31T18:00:00Z",
            "2017-01-01T06:00:00Z",
            "2017-01-01T18:00:00Z"
        ]
    );
    assert_eq!(
        utc("2016-12-31T23:59:60.5Z", "2017-01-01T00:00:02Z", "1s"),
        ["2016-12-31T23:59:60.5Z", "2017-01-01T00:00:01.5Z"]
    );
    assert_eq!(
        utc("1582-10-03", "1582-10-16", "1d"),
        ["1582-10-03", "1582-10-04", "1582-10-15", "1582-10-16"]
            .map(|day| format!("{day}T00:00:00Z"))
    );
    assert_eq!(utc("-0584-05-28", "-0584-05-28", "1d"), ["-0584-05-28T00:00:00Z"]);
    // The end belongs to the span, however the step divides it.
    assert_eq!(utc("2026-01-01", "2026-01-01T00:01", "0.1s").len(), 601);
}

/// The columns of a table, each cell as the shortest text of its number.
type Columns = Vec<(String, Vec<Option<String>>)>;

fn shortest(cell: &str) -> Option<String> {
    match cell.parse::<f64>() {
        Ok(number) => Some(number.to_string()),
        Err(_) => (!cell.is_empty()).then(|| cell.to_owned()),
    }
}

fn columns_of_csv(text: &str) -> Columns {
    let csv = csv(text);
    let column = |name: &&str| {
        let cells = csv.rows.iter().map(|row| shortest(row[name]));
        ((*name).to_owned(), cells.collect())
    };
    csv.columns.iter().map(column).collect()
}

fn columns_of_json(text: &str) -> Columns {
    let rows: Vec<Value> =
        text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    let cell = |value: &Value| match value {
        Value::Null => None,
        Value::String(text) => Some(text.clone()),
        number => Some(number.as_f64().expect("a number").to_string()),
    };
    // serde_json sorts the names: the order is that of the line.
    let mut names: Vec<&String> = rows[0].as_object().unwrap().keys().collect();
    let first = text.lines().next().unwrap();
    names.sort_by_key(|name| first.find(&format!("\"{name}\":")));
    let column = |name: &String| (name.clone(), rows.iter().map(|row| cell(&row[name])).collect());
    names.into_iter().map(column).collect()
}

/// As text has it: numbers rounded, 360 degrees turned into none.
fn assert_rounded(rounded: &Columns, exact: &Columns) {
    assert_eq!(rounded.len(), exact.len());
    for ((name, rounded), (other, exact)) in rounded.iter().zip(exact) {
        assert_eq!((name, rounded.len()), (other, exact.len()));
        for (rounded, exact) in rounded.iter().zip(exact) {
            let is_near = match (rounded, exact) {
                (Some(rounded), Some(exact)) => match (rounded.parse(), exact.parse::<f64>()) {
                    (Ok(rounded), Ok(exact)) => {
                        let rounded: f64 = rounded;
                        let half = if name.ends_with("_km") { 0.51e-4 } else { 0.51e-9 };
                        let half = if name.starts_with("error") { 0.51e-4 } else { half };
                        (rounded - exact).abs() <= half
                    }
                    _ => rounded == exact,
                },
                _ => rounded == exact,
            };
            assert!(is_near, "{name}: {rounded:?} {exact:?}");
        }
    }
}

#[test]
fn every_format_says_the_same() {
    let asked = "ephemeris --body all,polaris --lat 35.2 --lon -111.65 --from 2026-01-01T00:00Z \
        --to 2026-12-31T00:00Z --step 3d";
    let csv_text = nocturne(words(asked)).done().stdout;
    let columns = columns_of_csv(&csv_text);
    let json = nocturne(words(asked)).and(["--format", "jsonl"]).done().stdout;
    // Other readers of JSON may round the last digit of a double.
    assert_rounded(&columns, &columns_of_json(&json));
    let file = nocturne(words(asked)).and(["-o", "sky.parquet"]).done();
    assert_eq!(file.stdout, "");
    assert_rounded(&columns, &parquet::read(&file.read("sky.parquet")));

    // For people: the dates instead of the Julian dates, and each column under its name.
    let table = nocturne(words(asked)).and(["--format", "table"]).done().stdout;
    let mut lines = table.lines();
    let head = lines.next().unwrap();
    let names = words(head);
    assert!(names.contains(&"utc_iso") && !head.contains("jd_") && !head.contains("lat_deg_N"));
    let csv = csv(&csv_text);
    assert_eq!(lines.clone().count(), csv.rows.len());
    for (line, row) in lines.zip(&csv.rows) {
        for name in names.iter().filter(|name| !row[*name].is_empty()) {
            assert!(line.contains(row[*name]), "{name}: {line}");
        }
    }
    // Azimuth ends where its name ends.
    let end = head.find(" az_deg").unwrap() + " az_deg".len();
    assert!(table.lines().skip(1).zip(&csv.rows).all(|(l, row)| l[..end].ends_with(row["az_deg"])));
}

#[test]
fn rows_come_in_parquet_too() {
    let rows = format!("{KEYS}\n{MOON}\n{}\n", MOON.replace("moon", "sirius"));
    let text = with_rows(&rows).done().stdout;
    let file = with_rows(&rows).and(["-o", "rows.parquet"]).done();
    let columns = parquet::read(&file.read("rows.parquet"));
    assert_rounded(&columns_of_csv(&text), &columns);
    let distances = &columns.iter().find(|(name, _)| name == "geo_dist_km").unwrap().1;
    assert!(distances[0].is_some() && distances[1].is_none());
}

#[test]
fn the_name_of_the_output_says_the_format() {
    let asked = "ephemeris --body Sun --from 2026-01-01T00:00Z";
    let run = |more: &str| nocturne(words(asked)).and(words(more)).done();
    let written = run("").stdout;
    assert!(written.starts_with(KEYS.split(',').next().unwrap()));
    assert_eq!(run("-o sky.csv").read("sky.csv"), written.as_bytes());
    assert_eq!(run("-o sky.CSV").read("sky.CSV"), written.as_bytes());
    assert_eq!(run("-o -").stdout, written);
    assert_eq!(run("--format csv -o sky.dat").read("sky.dat"), written.as_bytes());
    assert_eq!(run("--format csv -o sky.parquet").read("sky.parquet"), written.as_bytes());
    let json = run("--format jsonl").stdout;
    assert_eq!(run("-o sky.jsonl").read("sky.jsonl"), json.as_bytes());
    assert_eq!(run("-o sky.ndjson").read("sky.ndjson"), json.as_bytes());
    let table = run("--format table").stdout;
    assert_eq!(run("-o sky.txt").read("sky.txt"), table.as_bytes());
    let piped = nocturne(words(asked))
        .and(words("--format parquet"))
        .through_shell(r#""$@" >piped.parquet"#);
    assert_eq!(piped.done().read("piped.parquet"), run("-o sky.parquet").read("sky.parquet"));
    // Columns of other bodies are blank from end to end.
    let parquet = parquet::read(&run("-o sky.parquet").read("sky.parquet"));
    assert_rounded(&columns_of_csv(&written), &parquet);
    for wrong in ["-o sky.xls", "-o sky", "-o sky.csv.gz"] {
        let run = nocturne(words(asked)).and(words(wrong));
        run.refused(NONSENSE, &["--output", ".csv, .txt, .jsonl or .parquet", "--format"]);
    }
}

/// More rows than fit into a batch, each to be told from the others.
fn many_rows(count: usize) -> String {
    let mut text = format!("{KEYS}\n");
    for index in 0..count {
        let body = ["sun", "moon"][index % 2];
        writeln!(text, "{body},2451545,0.{index:06},2451545,0,{},45.5,{index}", index % 180)
            .unwrap();
    }
    text
}

#[test]
fn rows_keep_their_order_on_any_number_of_threads() {
    let rows = many_rows(40_000);
    let on = |threads: &str| {
        let run = with_rows(&rows).and(words("--tolerance 3600"));
        run.with_variable("RAYON_NUM_THREADS", threads).done().stdout
    };
    let three = on("3");
    let csv = csv(&three);
    assert_eq!(csv.rows.len(), 40_000);
    for (index, row) in csv.rows.iter().enumerate() {
        assert_eq!(row["jd_tt_2"], format!("0.{index:06}"));
        assert_eq!(row["height_m"], index.to_string());
    }
    assert!(on("1") == three, "threads change the table");
}

#[test]
fn a_bad_row_late_in_a_long_file_leaves_nothing_behind() {
    let mut rows = many_rows(30_000);
    rows.push_str("sun,2451545,0,2451545,0,0,95,0\n");
    with_rows(&rows)
        .and(words("--tolerance 3600 -o old.csv"))
        .with_file("old.csv", "old")
        .refused(NONSENSE, &["rows.csv, line 30002", "latitude 95", "-90° to +90°"]);
}

#[test]
fn what_is_promised_is_kept_or_refused() {
    let at = |tolerance: &str| {
        let line = "ephemeris --body all,Vega --from 1800-01-01 --to 2000-01-01 --step 20000d";
        nocturne(words(line)).and(["--tolerance", tolerance])
    };
    let run = at("400").done();
    for row in csv(&run.stdout).rows {
        assert!(number(row["error_bound_arcsec"]) <= 400.0, "{row:?}");
    }
    at("0.0000001").refused(NONSENSE, &["Sun, 1800-01-01", "0.0000001 arcsec", "--tolerance"]);
    for (wrong, said) in
        [("0", "0"), ("-5", "-5"), ("NaN", "NaN"), ("inf", "inf"), ("1e9", "1000000000")]
    {
        at(wrong).refused(NONSENSE, &["--tolerance", said, "give arcseconds"]);
    }
    at("fine").refused(NONSENSE, &["'fine'", "--tolerance"]);
}

#[test]
fn years_beyond_three_thousand_are_for_those_who_say_how_good_is_good_enough() {
    let far = |year: &str| nocturne(["ephemeris", "--body", "Sun", "--from", year]);
    for year in ["-3500-06-01", "3500-06-01"] {
        far(year).refused(NONSENSE, &["Sun", "-3000 to 3000", "--tolerance ARCSEC"]);
        let run = far(year).and(["--tolerance", "600"]).done();
        assert_eq!(csv(&run.stdout).rows.len(), 1);
    }
    far("5000-01-01").refused(NONSENSE, &["year 5000", "-4000 to 4000"]);
    let row = "sun,600000.5,0,600000.5,0,0,0,0";
    with_rows(&format!("{KEYS}\n{row}\n"))
        .refused(NONSENSE, &["rows.csv, line 2", "-3000 to 3000", "--tolerance ARCSEC"]);
}

#[test]
fn stars_have_no_distance_and_as_many_names_as_people_use() {
    let run = nocturne([
        "ephemeris",
        "--body",
        "sirius,Barnard's Star,HR 7001,α Lyr,hip 91262",
        "--from",
        "2000-01-01T12:00Z",
    ]);
    let run = run.done();
    let table = csv(&run.stdout);
    let names: Vec<&str> = table.rows.iter().map(|row| row["body"]).collect();
    assert_eq!(names, ["sirius", "Barnard's Star", "HR 7001", "α Lyr", "hip 91262"]);
    for row in &table.rows {
        assert!(row["geo_dist_km"].is_empty() && row["colongitude_deg"].is_empty(), "{row:?}");
    }
    assert_eq!(table.rows[2]["geo_ra_app_deg"], table.rows[4]["geo_ra_app_deg"]);
    // Catalogues of a second say so; those of a milliarcsecond do not add to the error.
    let bounds: Vec<f64> = table.rows.iter().map(|row| number(row["error_bound_arcsec"])).collect();
    assert!(bounds[0] < 0.1 && bounds[1] < 0.1 && bounds[2] >= 1.0, "{bounds:?}");
}

#[test]
fn rows_that_make_no_sense_are_refused_with_their_line() {
    let head_without = |column: &str| KEYS.replace(&format!("{column},"), "");
    let row = |from: &str, to: &str| format!("{KEYS}\n# one\n{}\n", MOON.replace(from, to));
    let cases: Vec<(String, &[&str])> = vec![
        (String::new(), &["rows.csv", "no rows", "body,jd_tt_1"]),
        ("\n# nothing\n\n".to_owned(), &["rows.csv", "no rows"]),
        (head_without("lon_deg_E"), &["line 1", "no column lon_deg_E"]),
        (head_without("jd_ut1_2"), &["line 1", "no column jd_ut1_2"]),
        (format!("{KEYS},body\n"), &["line 1", "column body", "twice"]),
        (format!("{KEYS}\n{MOON},\n"), &["line 2", "9 fields under 8 columns"]),
        (format!("{KEYS}\n{KEYS}\n"), &["line 2", "'body'"]),
        (row("moon", "vulcan"), &["line 3", "'vulcan'", "`nocturne objects`"]),
        (row("moon", ""), &["line 3", "''"]),
        (row("moon", "\"moon"), &["line 3", "quoted field"]),
        (row("-37.86056", "95"), &["line 3", "latitude 95", "-90° to +90°"]),
        (row("-37.86056", "south"), &["line 3", "lat_deg_N 'south' is no number"]),
        (row("-152.32122", "NaN"), &["line 3", "lon_deg_E 'NaN' is no number"]),
        (row("334.5", "inf"), &["line 3", "height_m 'inf' is no number"]),
        (row("334.5", "1e9"), &["line 3", "height 1000000000 m"]),
        (row("334.5", ""), &["line 3", "height_m is blank"]),
        (row("2450618.5", "1e300"), &["line 3", "days apart"]),
        (row(",2450618.0,", ",,"), &["line 3", "jd_ut1_1 is blank"]),
        (row("2450618.0", "2450718.0"), &["line 3", "TT and UT1", "days apart"]),
        (row("24506", "34506"), &["line 3", "-4000 to 4000"]),
    ];
    for (content, said) in cases {
        with_rows(&content).and(words("-o old.csv")).refused(NONSENSE, said);
        with_rows(&content).refused(NONSENSE, said);
    }
    let mut latin = format!("{KEYS}\n{MOON}\n").into_bytes();
    latin.extend(b"caf\xe9,1,2,3,4,5,6,7\n");
    let run = nocturne(words("ephemeris --rows rows.csv")).with_file("rows.csv", latin);
    run.refused(NONSENSE, &["rows.csv, line 3", "not UTF-8"]);
}

#[test]
fn files_that_cannot_be_read_or_written_are_named() {
    let rows = |name: &str| nocturne(["ephemeris", "--rows", name]);
    rows("none.csv").refused(IMPOSSIBLE, &["cannot read none.csv", "another file"]);
    rows("none/none.csv").refused(IMPOSSIBLE, &["cannot read none/none.csv"]);
    let folder = rows("folder.csv");
    std::fs::create_dir(folder.path("folder.csv")).unwrap();
    folder.refused(IMPOSSIBLE, &["cannot read folder.csv", "directory"]);
    let whole = || with_rows(&format!("{KEYS}\n{MOON}\n"));
    whole().and(["-o", "none/sky.csv"]).refused(IMPOSSIBLE, &["none/sky.csv", "no folder none"]);
    if Path::new("/dev/full").exists() {
        let full = whole().through_shell(r#"exec "$@" >/dev/full"#);
        full.refused(IMPOSSIBLE, &["standard output", "No space left"]);
        whole().and(words("--format csv -o /dev/full")).refused(IMPOSSIBLE, &["/dev/full"]);
    }
}

#[test]
fn spans_that_make_no_sense_are_refused() {
    let cases: [(&str, &[&str]); 14] = [
        ("", &["--body", "--help"]),
        ("--body Vulcan", &["'Vulcan'", "`nocturne objects`"]),
        ("--body Mars,,Venus", &["''", "the Moon"]),
        ("--body Mars --from 2026-01-02 --to 2026-01-01", &["--to", "before --from", "later"]),
        ("--body Mars --from tomorrow", &["'tomorrow'", "2026-08-12"]),
        ("--body Mars --step 0d", &["--step '0d'", "1d, 6h, 10m or 30s"]),
        ("--body Mars --step -1d", &["--step '-1d'", "1d, 6h, 10m or 30s"]),
        ("--body Mars --step NaNd", &["--step 'NaNd'"]),
        ("--body Mars --step 5", &["--step '5'"]),
        ("--body Mars --step é", &["--step 'é'"]),
        ("--body Mars --height 300", &["--height", "--place NAME", "--lat and --lon"]),
        ("--body Mars --lat 95 --lon 0", &["latitude 95", "-90° to +90°"]),
        ("--body Mars --rows old.csv", &["--body", "--rows"]),
        ("--rows old.csv --step 1d", &["--rows", "--step"]),
    ];
    for (line, said) in cases {
        nocturne(["ephemeris"]).and(words(line)).refused(NONSENSE, said);
    }
}

#[test]
fn whoever_stops_reading_is_left_in_peace() {
    let line = "ephemeris --body all --from 2000-01-01 --to 2001-01-01 --step 1h --tolerance 3600";
    let run = nocturne(words(line)).through_shell(r#""$@" | head -n 2"#).done();
    assert_eq!(run.stdout.lines().count(), 2);
}

#[test]
fn rows_come_from_standard_input_too() {
    let rows = format!("{KEYS}\n{MOON}\n");
    let piped = nocturne(words("ephemeris --rows -"))
        .with_file("rows.csv", &rows)
        .through_shell(r#""$@" <rows.csv"#);
    assert_eq!(piped.done().stdout, with_rows(&rows).done().stdout);
    let empty = nocturne(words("ephemeris --rows -"));
    empty.refused(NONSENSE, &["standard input", "no rows"]);
}
