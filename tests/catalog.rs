//! The catalogues as they are shipped: complete, unspoilt, made from the raw tables, and right
//! where somebody else says what is right.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use nocturne::catalog::pack::{self, Packed};
use nocturne::catalog::{CatalogError, Catalogs, MoonMap, Star, sha256_hex, stars};
use nocturne::units::Angle;
use serde::Deserialize;

fn directory() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("catalogs")
}

fn catalogs() -> Catalogs {
    Catalogs::locate(Some(&directory())).unwrap()
}

fn by_hr(stars: &[Star], hr: u16) -> &Star {
    stars.iter().find(|star| star.hr == hr).unwrap_or_else(|| panic!("no HR {hr}"))
}

fn by_name<'a>(stars: &'a [Star], name: &str) -> &'a Star {
    stars
        .iter()
        .find(|star| star.name.as_deref() == Some(name))
        .unwrap_or_else(|| panic!("no {name}"))
}

#[test]
fn all_stars_of_the_bright_star_catalogue_are_there() {
    let stars = catalogs().stars().unwrap();
    assert_eq!(stars.len(), 9096);
    assert!(stars.windows(2).all(|pair| pair[0].hr < pair[1].hr));
    // The entries of the catalogue that are no stars: novae, clusters, galaxies, a supernova.
    let not_stars = [92, 95, 182, 1057, 1841, 2472, 2496, 3515, 3671, 6309, 6515, 7189, 7539, 8296];
    let present: BTreeSet<u16> = stars.iter().map(|star| star.hr).collect();
    let missing: Vec<u16> = (1..=9110).filter(|hr| !present.contains(hr)).collect();
    assert_eq!(missing, not_stars);
    for star in &stars {
        assert!((star.dir_j2000.vector().length() - 1.0).abs() < 1e-15, "HR {}", star.hr);
    }
    assert_eq!(stars.iter().filter(|star| star.hip.is_some()).count(), 9073);
    assert_eq!(stars.iter().filter(|star| star.hd.is_some()).count(), 9096);
    assert_eq!(stars.iter().filter(|star| star.designation.is_some()).count(), 3143);
    assert_eq!(stars.iter().filter(|star| star.flamsteed.is_some()).count(), 2554);
}

#[test]
fn sirius_is_as_the_catalogue_has_it() {
    let stars = catalogs().stars().unwrap();
    let sirius = by_hr(&stars, 2491);
    assert_eq!(sirius.hip, Some(32349));
    assert_eq!(sirius.name.as_deref(), Some("Sirius"));
    assert_eq!((sirius.hd, sirius.flamsteed.as_deref()), (Some(48915), Some("9 CMa")));
    assert_eq!(sirius.designation.as_deref(), Some("α CMa"));
    assert_eq!((sirius.magnitude.0, sirius.b_v), (-1.46, 0.0));
    assert_eq!(sirius.spectral_type, "A1Vm");
    assert_eq!((sirius.parallax_arcsec, sirius.radial_velocity_km_s), (0.375, -8.0));
    // BSC5: 06h 45m 08.9s, -16° 42' 58".
    let ra_s = sirius.dir_j2000.longitude().hours() * 3600.0;
    assert!((ra_s - (6.0 * 3600.0 + 45.0 * 60.0 + 8.9)).abs() < 0.001, "{ra_s}");
    let dec_arcsec = sirius.dir_j2000.latitude().arcsec();
    assert!((dec_arcsec + 16.0 * 3600.0 + 42.0 * 60.0 + 58.0).abs() < 0.01, "{dec_arcsec}");
}

#[test]
fn famous_stars_have_their_names_designations_and_light() {
    let stars = catalogs().stars().unwrap();
    for (name, hr, designation, v, spectral_type) in [
        ("Vega", 7001, "α Lyr", 0.03, "A0Va"),
        ("Polaris", 424, "α UMi", 2.02, "F7:Ib-II"),
        ("Arcturus", 5340, "α Boo", -0.04, "K1.5IIIFe-0.5"),
        ("Rigil Kentaurus", 5459, "α¹ Cen", -0.01, "G2V"),
        ("Toliman", 5460, "α² Cen", 1.33, "K1V"),
        ("Betelgeuse", 2061, "α Ori", 0.50, "M1-2Ia-Iab"),
        ("Alcor", 5062, "80 UMa", 4.01, "A5V"),
    ] {
        let star = by_name(&stars, name);
        assert_eq!(
            (star.hr, star.designation.as_deref(), star.magnitude.0, star.spectral_type.as_str()),
            (hr, Some(designation), v, spectral_type)
        );
    }
    // Of V 11, far too faint for this catalogue.
    assert!(!stars.iter().any(|star| star.hip == Some(70890)));
    assert!(!stars.iter().any(|star| star.name.as_deref() == Some("Proxima Centauri")));
}

/// The list of the IAU (IAU-CSN, 2018-06-19) for stars whose names are easily given to another:
/// components of doubles, and letters that several stars share.
#[test]
fn names_that_are_easily_misplaced_belong_to_the_right_star() {
    let stars = catalogs().stars().unwrap();
    for (name, hr) in [
        ("Acrab", 5984),
        ("Acrux", 4730),
        ("Albireo", 7417),
        ("Algieba", 4057),
        ("Alkalurops", 5733),
        ("Almach", 603),
        ("Alnair", 8425),
        ("Alnitak", 1948),
        ("Alniyat", 6084),
        ("Alrakis", 6370),
        ("Alrescha", 596),
        ("Aspidiske", 3699),
        ("Atik", 1131),
        ("Atria", 6217),
        ("Castor", 2891),
        ("Diadem", 4968),
        ("Dziban", 6636),
        ("Gienah", 4662),
        ("Izar", 5506),
        ("Marfik", 6149),
        ("Marsic", 6008),
        ("Meleph", 3429),
        ("Menkent", 5288),
        ("Mesarthim", 546),
        ("Mintaka", 1852),
        ("Mizar", 5054),
        ("Muscida", 3323),
        ("Okab", 7235),
        ("Porrima", 4825),
        ("Rasalgethi", 6406),
        ("Sargas", 6553),
        ("Scheat", 8775),
        ("Skat", 8709),
        ("Suhail", 3634),
        ("Tureis", 3185),
        ("Zubenelgenubi", 5531),
    ] {
        assert_eq!(by_name(&stars, name).hr, hr, "{name}");
    }
    let mut names: Vec<_> = stars.iter().filter_map(|star| star.name.as_deref()).collect();
    assert_eq!(names.len(), 376);
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), 376, "a name is given twice");
}

/// Proper motion in right ascension is times cos(declination): Hipparcos (ESA 1997) has, in
/// arcsec/yr, -0.546 -1.223 for Sirius, -1.093 -1.999 for Arcturus, 4.155 3.259 for 61 Cyg A and
/// 0.044 -0.012 for Polaris (the angle itself would be 3.4 arcsec/yr there).
#[test]
fn proper_motions_are_on_the_sky() {
    let stars = catalogs().stars().unwrap();
    for (hr, ra, dec) in
        [(2491, -0.546, -1.223), (5340, -1.093, -1.999), (8085, 4.155, 3.259), (424, 0.044, -0.012)]
    {
        let star = by_hr(&stars, hr);
        assert!((star.proper_motion_ra_arcsec_yr - ra).abs() < 0.02, "HR {hr}");
        assert!((star.proper_motion_dec_arcsec_yr - dec).abs() < 0.06, "HR {hr}");
    }
}

/// Both components of a double are there, each with its own light, next to each other.
#[test]
fn doubles_keep_both_stars() {
    let stars = catalogs().stars().unwrap();
    for (first, second, at_most_arcsec) in
        [(5459, 5460, 25.0), (8085, 8086, 30.0), (4730, 4731, 10.0)]
    {
        let (a, b) = (by_hr(&stars, first), by_hr(&stars, second));
        let apart = a.dir_j2000.separation(b.dir_j2000);
        assert!(apart < Angle::from_arcsec(at_most_arcsec), "{} arcsec", apart.arcsec());
        assert!(a.magnitude < b.magnitude);
    }
}

/// Where B-V was measured, the estimate used elsewhere can be judged: half of them are within
/// 0.05 mag of the measurement, for stars that are no supergiants.
#[test]
fn estimated_colours_are_as_good_as_stated() {
    let bytes = fs::read(directory().join("stars.bin")).unwrap();
    let records = stars::decode(&bytes).unwrap();
    let estimated: Vec<_> = records.iter().filter(|star| star.b_v_estimated).collect();
    assert_eq!(estimated.len(), 310);
    // The colours that stars have: none bluer than O5, none redder than late giants.
    assert!(estimated.iter().all(|star| (-0.33..=1.64).contains(&star.b_v)));
    // Types that occur with and without a measured B-V, compared by their medians.
    let mut measured: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    for star in records.iter().filter(|star| !star.b_v_estimated) {
        measured.entry(&star.spectral_type).or_default().push(star.b_v);
    }
    let mut errors: Vec<f64> = Vec::new();
    for star in &estimated {
        if let Some(colours) = measured.get(star.spectral_type.as_str()) {
            errors.extend(colours.iter().map(|b_v| (star.b_v - b_v).abs()));
        }
    }
    errors.sort_by(f64::total_cmp);
    assert!(errors.len() > 5000, "{}", errors.len());
    assert!(errors[errors.len() / 2] < 0.05, "{}", errors[errors.len() / 2]);
    assert!(errors[errors.len() * 9 / 10] < 0.20, "{}", errors[errors.len() * 9 / 10]);
}

#[test]
fn the_gazetteer_holds_every_place() {
    let text = catalogs().places_text().unwrap();
    assert!(text.starts_with(&format!("{}\n", nocturne::catalog::places::COLUMNS)));
    assert_eq!(text.lines().count(), 1 + 26_283);
    let line = |start: &str| text.lines().find(|line| line.starts_with(start)).unwrap();
    assert_eq!(
        line("Beijing,"),
        "Beijing,Beijing,Eastern Asia,capital,18960744,39.9075,116.39723,49,Asia/Shanghai"
    );
    assert!(line("Isaac Newton Group").contains("28.76206,-17.87764,"));
    // On a mountain of 2400 m; the raw table says 0.
    let elevation_m: f64 = line("Isaac Newton Group").split(',').nth(7).unwrap().parse().unwrap();
    assert!((2100.0..2500.0).contains(&elevation_m), "{elevation_m}");
}

/// REFF around a place, averaged over 9 x 9 pixels (1.6 degrees).
fn reff_around(map: &MoonMap, latitude_deg: f64, longitude_deg: f64) -> [f64; 3] {
    let column = ((longitude_deg + 180.0) / 360.0 * map.width as f64) as usize;
    let row = ((90.0 - latitude_deg) / 180.0 * map.height as f64) as usize;
    let mut sum = [0.0; 3];
    for row in row - 4..=row + 4 {
        for column in column - 4..=column + 4 {
            for (sum, reff) in sum.iter_mut().zip(map.reff[row * map.width + column]) {
                *sum += f64::from(reff) / 81.0;
            }
        }
    }
    sum
}

#[test]
fn the_moon_has_its_seas_and_rays_in_their_places() {
    let map = catalogs().moon_map().unwrap();
    assert_eq!((map.width, map.height, map.reff.len()), (2048, 1024, 2048 * 1024));
    let green = |latitude_deg, longitude_deg| reff_around(&map, latitude_deg, longitude_deg)[1];
    let crisium = green(17.0, 59.0);
    let tycho = green(-43.3, -11.2);
    let grimaldi = green(-5.5, -68.5);
    let aristarchus = green(23.7, -47.5);
    let procellarum = green(20.0, -57.0);
    let far_side_highlands = green(10.0, 165.0);
    assert!(crisium < 0.6 * green(17.0, 75.0), "{crisium}");
    assert!(grimaldi < 0.6 * far_side_highlands, "{grimaldi}");
    assert!(aristarchus > 1.5 * procellarum, "{aristarchus} {procellarum}");
    assert!(tycho > 1.3 * green(-25.0, -40.0), "{tycho}");
    // North is up: Plato, a dark crater floor at 51.6 N, has no counterpart at 51.6 S.
    assert!(green(51.6, -9.4) < 0.75 * green(-51.6, -9.4));
}

#[test]
fn the_moon_is_high_and_low_where_it_is() {
    let map = catalogs().moon_relief().unwrap();
    assert_eq!((map.width, map.height, map.elevation_m.len()), (2880, 1440, 2880 * 1440));
    let metres = |latitude_deg, longitude_deg| {
        map.elevation_m(Angle::from_deg(longitude_deg), Angle::from_deg(latitude_deg))
    };
    // Highest and lowest of LRO (Smith et al. 2010, GRL 37, L18204): 10.78 and -9.12 km, here means
    // over 4 km.
    let (low, high) = map
        .elevation_m
        .iter()
        .fold((0, 0), |(low, high), &metres| (i16::min(low, metres), i16::max(high, metres)));
    assert!((10_400..10_800).contains(&high), "{high}");
    assert!((-9_150..-8_500).contains(&low), "{low}");
    // The highest point stands at 5.4 N, 201.4 E, the lowest in Antoniadi.
    assert!(metres(5.4, -158.6) > 9_500.0, "{}", metres(5.4, -158.6));
    assert!(metres(-70.4, -172.6) < -8_000.0, "{}", metres(-70.4, -172.6));
    // Seas lie deep: Tranquillity base is -1.93 km, Crisium -3.8; Tycho's floor lies 4 km below its
    // rim, 43 km away.
    assert!((metres(0.674, 23.473) + 1_930.0).abs() < 100.0, "{}", metres(0.674, 23.473));
    assert!((metres(17.0, 59.0) + 3_800.0).abs() < 300.0, "{}", metres(17.0, 59.0));
    let rim = metres(-43.3 + 1.4, -11.2);
    assert!((3_000.0..5_500.0).contains(&(rim - metres(-43.3, -12.0))), "{rim}");
}

#[test]
fn the_ground_of_the_moon_is_dark_and_sends_light_back() {
    let map = catalogs().moon_hapke().unwrap();
    assert_eq!((map.width, map.height, map.cells.len()), (180, 90, 180 * 90));
    let cell = |latitude_deg: f64, longitude_deg: f64| {
        let row = ((90.0 - latitude_deg) / 2.0) as usize;
        map.cells[row * 180 + ((longitude_deg + 180.0) / 2.0) as usize]
    };
    let (crisium, highlands) = (cell(17.0, 59.0), cell(10.0, 165.0));
    for band in 0..3 {
        assert!(crisium[band].w < 0.75 * highlands[band].w);
        assert!(cell(17.0, 59.0)[band].b_s0 > cell(10.0, 165.0)[band].b_s0);
    }
    assert!(crisium[0].w < crisium[1].w && crisium[1].w < crisium[2].w);
    // Towards the poles those at 70 degrees go on.
    assert_eq!(cell(89.0, 31.0), cell(71.0, 31.0));
    assert_eq!(cell(-89.0, 31.0), cell(-71.0, 31.0));
}

/// The ROLO disc albedo (Kieffer & Stone 2005, *AJ* 129, 2887, eq. 10), at the phase angle 30°
/// that REFF(30°, 0°, 30°) belongs to and between its bands, is 1.66 times as large at 643 as at
/// 415 nm, and 1.20 times as large as at 566 nm. It knows one side of the Moon only.
#[test]
fn the_moon_is_dark_and_reddish_everywhere() {
    let map = catalogs().moon_map().unwrap();
    let mut mean = [0.0; 3];
    let mut area = 0.0;
    for (row, pixels) in map.reff.chunks(map.width).enumerate() {
        let weight = (std::f64::consts::PI * (row as f64 + 0.5) / map.height as f64).sin();
        for pixel in pixels {
            area += weight;
            for (sum, &reff) in mean.iter_mut().zip(pixel) {
                assert!((0.02..=0.25).contains(&reff), "{reff}");
                *sum += weight * f64::from(reff);
            }
        }
    }
    let [red, green, blue] = mean.map(|sum| sum / area);
    assert!((0.07..0.13).contains(&green), "{green}");
    let within = |ratio: f64, wanted: f64| (ratio / wanted - 1.0).abs() < 0.06;
    assert!(within(red / blue, 1.66), "{}", red / blue);
    assert!(within(red / green, 1.20), "{}", red / green);
}

/// Applies a change to each file in turn and expects one clear sentence that names the file.
fn refused(change: impl Fn(&mut Vec<u8>), what: &str) {
    for file in ["stars.bin", "places.csv", "moon_albedo.bin", "moon_relief.bin", "moon_hapke.bin"]
    {
        let message = message_about(file, &change);
        assert!(message.contains(file), "{message}");
        assert!(message.contains("cargo run --bin pack"), "{message}");
        assert!(message.contains(what), "{message}");
    }
}

fn message_about(file: &str, change: &impl Fn(&mut Vec<u8>)) -> String {
    let copy = tempfile::tempdir().unwrap();
    // The directory is found by its stars.
    fs::write(copy.path().join("stars.bin"), "").unwrap();
    let mut bytes = fs::read(directory().join(file)).unwrap();
    change(&mut bytes);
    fs::write(copy.path().join(file), bytes).unwrap();
    let catalogs = Catalogs::locate(Some(copy.path())).unwrap();
    let error = match file {
        "stars.bin" => catalogs.stars().map(drop),
        "places.csv" => catalogs.places_text().map(drop),
        "moon_relief.bin" => catalogs.moon_relief().map(drop),
        "moon_hapke.bin" => catalogs.moon_hapke().map(drop),
        _ => catalogs.moon_map().map(drop),
    };
    let error = error.expect_err(file);
    assert!(matches!(error, CatalogError::Damaged { .. }), "{error}");
    error.to_string()
}

#[test]
fn a_foreign_file_is_refused() {
    refused(|bytes| *bytes = b"\x89PNG\r\n\x1a\n and so on".repeat(20), "");
    refused(|bytes| bytes[2] ^= 0x20, "another kind of file");
    refused(Vec::clear, "");
}

#[test]
fn another_version_is_refused_and_said_to_be_one() {
    refused(
        |bytes| {
            // The version stands at byte 8 of a sealed file, and in the first line of the table.
            let at = if bytes[0] == b'#' { "# Nocturne gazetteer ".len() } else { 8 };
            bytes[at] += 1;
        },
        "in format version ",
    );
}

#[test]
fn a_file_with_more_at_its_end_is_refused() {
    refused(|bytes| bytes.push(b'\n'), "SHA-256");
}

#[test]
fn stars_cut_at_any_length_are_refused() {
    let bytes = fs::read(directory().join("stars.bin")).unwrap();
    for length in (0..bytes.len()).step_by(997) {
        assert!(stars::decode(&bytes[..length]).is_err(), "length {length}");
    }
}

#[test]
fn stars_with_a_flipped_bit_are_refused() {
    let bytes = fs::read(directory().join("stars.bin")).unwrap();
    // From the first bit of the header to the last of the text; the other bits of the header are
    // flipped one by one in the tests of the seal.
    for bit in (0..200).map(|nth| nth * (bytes.len() * 8 - 1) / 199) {
        let mut flipped = bytes.clone();
        flipped[bit / 8] ^= 1 << (bit % 8);
        assert!(stars::decode(&flipped).is_err(), "bit {bit}");
    }
}

#[test]
fn records_survive_writing_and_reading() {
    let bytes = fs::read(directory().join("stars.bin")).unwrap();
    let records = stars::decode(&bytes).unwrap();
    assert_eq!(stars::encode(&records).unwrap(), bytes);
}

#[test]
fn a_missing_file_is_named() {
    let empty = tempfile::tempdir().unwrap();
    fs::write(empty.path().join("stars.bin"), "").unwrap();
    let message = Catalogs::locate(Some(empty.path())).unwrap().moon_map().unwrap_err().to_string();
    assert!(message.contains("moon_albedo.bin"), "{message}");
    fs::remove_file(empty.path().join("stars.bin")).unwrap();
    let message = Catalogs::locate(Some(empty.path())).unwrap_err().to_string();
    assert!(message.contains(&empty.path().display().to_string()), "{message}");
    assert!(message.contains("NOCTURNE_CATALOGS"), "{message}");
}

/// The Moon's maps are checked by `pack --check` where their sources are at hand.
#[test]
fn packing_the_raw_tables_again_gives_the_same_bytes() {
    let raw = directory().join("raw");
    for packed in [pack::stars(&raw), pack::places(&raw)] {
        let Packed { file, bytes, summary } = packed.unwrap();
        assert!(fs::read(directory().join(file)).unwrap() == bytes, "{file}: {summary}");
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Sources {
    file: Vec<Source>,
}

/// One file; frame and epoch only where they mean something.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Source {
    path: String,
    source: String,
    reference: Option<String>,
    retrieved_from: String,
    licence: String,
    units: Option<String>,
    frame: Option<String>,
    epoch: Option<String>,
    columns: String,
    made_by: String,
    sha256: String,
    #[serde(default = "yes")]
    committed: bool,
}

fn yes() -> bool {
    true
}

#[test]
fn every_file_has_its_source_and_its_checksum() {
    let text = fs::read_to_string(directory().join(pack::SOURCES_FILE)).unwrap();
    let sources: Sources = toml::from_str(&text).unwrap();
    let mut listed = BTreeMap::new();
    for source in &sources.file {
        let said = [
            Some(&source.source),
            Some(&source.retrieved_from),
            Some(&source.licence),
            Some(&source.columns),
            Some(&source.made_by),
            source.reference.as_ref(),
            source.units.as_ref(),
            source.frame.as_ref(),
            source.epoch.as_ref(),
        ];
        assert!(said.into_iter().flatten().all(|said| !said.trim().is_empty()), "{}", source.path);
        assert!(listed.insert(source.path.as_str(), source).is_none(), "{} twice", source.path);
    }
    let mut present = BTreeSet::new();
    collect_files(&directory(), &directory(), &mut present);
    assert!(present.remove(pack::SOURCES_FILE));
    for path in &present {
        let source = listed.get(path.as_str());
        let source = source.unwrap_or_else(|| panic!("{path} has no table in SOURCES.toml"));
        let sha256 = sha256_hex(&fs::read(directory().join(path)).unwrap());
        assert_eq!(sha256, source.sha256, "{path} is not the file of SOURCES.toml");
    }
    for source in sources.file.iter().filter(|source| source.committed) {
        assert!(present.contains(&source.path), "{} is in SOURCES.toml only", source.path);
    }
}

/// Paths relative to `root`, with slashes.
fn collect_files(root: &Path, directory: &Path, paths: &mut BTreeSet<String>) {
    for entry in fs::read_dir(directory).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect_files(root, &path, paths);
        } else {
            let relative = path.strip_prefix(root).unwrap();
            let parts: Vec<_> = relative.iter().map(|part| part.to_str().unwrap()).collect();
            paths.insert(parts.join("/"));
        }
    }
}
