//! Who sees or takes the picture, and on which screen it is shown: what the options do, and what the files
//! say of it.

use exif::{In, Tag, Value};
use image::{ColorType, GenericImageView};
use libtest_mimic::Trial;

use super::harness::{DARK, Machine, Nocturne, Run, nocturne, trial, words};

/// Options that each make another picture of the same sky.
const WAYS: [&str; 15] = [
    "",
    "--eye paper",
    "--exposure 2",
    "--adapted-to 100",
    "--coming-from 1000 --after 2",
    "--night-colour intrusion",
    "--night-colour day",
    "--field-factor 1.4",
    "--grain 7",
    "--display p3",
    "--display linear",
    "--display-peak 400",
    "--red",
    "--camera --fov 90",
    "--camera --fov 90 --no-noise --white-balance tungsten",
];

/// Tables of a scene file, and options that write them.
const SCENES: [(&str, &str, &[&str]); 4] = [
    (
        "eye",
        "--adapted-to 0.5 --coming-from 100 --after 7.5 --night-colour intrusion --glare spencer \
         --no-acuity --field-factor 1.7 --age 61 --grain 5 --exposure -1.5",
        &[
            "adaptation_cd_m2 = 0.5",
            "coming_from_cd_m2 = 100.0",
            "since_s = 450.0",
            "field_factor = 1.7",
            "age_years = 61.0",
            "grain = 5",
            "acuity = false",
            "glare = \"spencer\"",
            "night_colour = \"intrusion\"",
        ],
    ),
    ("paper", "--eye paper --bits 16", &["model = \"paper\""]),
    (
        "display",
        "--display p3 --display-peak 250 --red",
        &["[display]", "space = \"display-p3\"", "peak_cd_m2 = 250.0", "red = true"],
    ),
    (
        "photo",
        "--camera --sensor aps-c --focal 35 --aperture 1.8 --shutter 13 --iso 1600 \
         --compensation 0.5 --white-balance 4000K --vignetting off --spikes 7 --noise-seed 9",
        &[
            "[photo]",
            "shutter_s = 13.0",
            "iso = 1600.0",
            "compensation_stops = 0.5",
            "seed = 9",
            "[photo.body]",
            "sensor = \"aps-c\"",
            "[photo.lens]",
            "focal_mm = 35.0",
            "f_number = 1.8",
            "vignetting = false",
            "blades = 7",
        ],
    ),
];

pub fn trials(machine: &Machine) -> Vec<Trial> {
    let mut trials = vec![
        trial("viewers::each_option_makes_another_picture", each_makes_another_picture),
        trial("viewers::sixteen_bits_are_written", sixteen_bits_are_written),
        trial("viewers::red_is_red_alone", red_is_red_alone),
        trial("viewers::screens_have_their_profile", screens_have_their_profile),
        trial("viewers::a_picture_says_when_and_where", a_picture_says_when_and_where),
        trial("viewers::a_camera_says_how_it_was_set", a_camera_says_how_it_was_set),
        trial("viewers::a_metered_camera_says_what_it_chose", a_metered_camera_says),
        trial("viewers::the_light_is_whose_picture_it_ever_is", the_light_is_the_same),
    ];
    for (name, line, said) in SCENES {
        let test = move || a_scene_file_keeps_it(line, said);
        trials.push(trial(format!("viewers::a_scene_file_keeps_{name}"), test));
    }
    trials.into_iter().map(|trial| trial.with_ignored_flag(!machine.draws)).collect()
}

/// A small picture of a dark sky.
fn small(line: &str) -> Nocturne {
    nocturne(DARK).and(words("--look S --size 96x54 -q")).and(words(line))
}

fn opened(run: &Run, name: &str) -> image::DynamicImage {
    image::load_from_memory(&run.read(name)).expect("a picture")
}

fn each_makes_another_picture() {
    let mut pictures: Vec<(&str, Vec<u8>)> = Vec::new();
    for line in WAYS {
        let run = small(line).and(words("-o sky.png")).done();
        let pixels = opened(&run, "sky.png").to_rgb8().into_raw();
        let lit = pixels.iter().filter(|code| **code > 0).count();
        assert!(lit > 96 * 54 / 4, "{line}: {lit} codes are not black");
        if let Some((other, _)) = pictures.iter().find(|(_, other)| *other == pixels) {
            panic!("'{line}' and '{other}' make one picture");
        }
        pictures.push((line, pixels));
    }
}

fn sixteen_bits_are_written() {
    for who in ["", "--eye paper", "--camera --fov 90 --no-noise"] {
        let run = small(who).and(words("--bits 16 -o sky.png")).done();
        let deep = opened(&run, "sky.png");
        assert_eq!(deep.color(), ColorType::Rgb16, "{who}");
        assert_eq!(deep.dimensions(), (96, 54));
        let plain = small(who).and(words("-o sky.png")).done();
        let plain = opened(&plain, "sky.png");
        assert_eq!(plain.color(), ColorType::Rgb8, "{who}");
        let (deep, plain) = (deep.to_rgb16(), plain.to_rgb8());
        let mean = |codes: &mut dyn Iterator<Item = f64>| codes.sum::<f64>() / (96.0 * 54.0 * 3.0);
        let deep_mean = mean(&mut deep.as_raw().iter().map(|code| f64::from(*code) / 257.0));
        let plain_mean = mean(&mut plain.as_raw().iter().map(|code| f64::from(*code)));
        assert!((deep_mean - plain_mean).abs() < 0.2, "{who}: {deep_mean} {plain_mean}");
        let between = deep.as_raw().iter().filter(|code| **code % 257 != 0).count();
        assert!(between > 96 * 54, "{who}: only {between} codes are between those of 8 bits");
    }
}

fn red_is_red_alone() {
    for who in ["--red", "--red --eye paper", "--red --camera --fov 90", "--red --bits 16"] {
        // Lines and letters too.
        let run = small(who).and(words("-o sky.png")).done();
        let picture = opened(&run, "sky.png").to_rgb16();
        let all = |n: usize| picture.pixels().map(move |pixel| u32::from(pixel.0[n])).max();
        assert!(all(0) > Some(0), "{who}: black");
        assert_eq!((all(1), all(2)), (Some(0), Some(0)), "{who}");
    }
}

fn screens_have_their_profile() {
    let has_profile = |line: &str| {
        let run = small(line).and(words("-o sky.png")).done();
        run.read("sky.png").windows(4).any(|bytes| bytes == b"iCCP")
    };
    assert!(!has_profile(""));
    for line in ["--display p3", "--display linear", "--display p3 --bits 16 --camera"] {
        assert!(has_profile(line), "{line}");
    }
}

/// The tags of a PNG.
fn tags(run: &Run) -> exif::Exif {
    let bytes = run.read("sky.png");
    let mut reader = std::io::Cursor::new(bytes);
    exif::Reader::new().read_from_container(&mut reader).expect("EXIF")
}

fn text(tags: &exif::Exif, tag: Tag) -> String {
    let field = tags.get_field(tag, In::PRIMARY).unwrap_or_else(|| panic!("no {tag}"));
    match &field.value {
        Value::Ascii(lines) => String::from_utf8(lines[0].clone()).expect("ASCII"),
        _ => panic!("{tag}: {:?}", field.value),
    }
}

/// Numbers of a tag, fractions as decimals.
fn numbers(tags: &exif::Exif, tag: Tag) -> Vec<f64> {
    let field = tags.get_field(tag, In::PRIMARY).unwrap_or_else(|| panic!("no {tag}"));
    match &field.value {
        Value::Rational(all) => all.iter().map(exif::Rational::to_f64).collect(),
        value => vec![f64::from(value.get_uint(0).expect("a number"))],
    }
}

fn a_picture_says_when_and_where() {
    for who in ["", "--eye paper", "--bits 16", "--camera --bits 16"] {
        let tags = tags(&small(who).and(words("-o sky.png")).done());
        assert_eq!(text(&tags, Tag::DateTimeOriginal), "2026:08:13 04:30:00", "{who}");
        assert_eq!(text(&tags, Tag::OffsetTimeOriginal), "+00:00");
        let sides = [Tag::GPSLatitudeRef, Tag::GPSLongitudeRef].map(|tag| text(&tags, tag));
        assert_eq!(sides, ["N", "W"]);
        for (tag, meant) in [(Tag::GPSLatitude, 35.198), (Tag::GPSLongitude, 111.651)] {
            let parts = numbers(&tags, tag);
            let angle_deg = parts[0] + parts[1] / 60.0 + parts[2] / 3600.0;
            assert!((angle_deg - meant).abs() < 1e-3, "{tag}: {angle_deg}");
        }
        // An eye has no exposure time.
        let is_camera = tags.get_field(Tag::ExposureTime, In::PRIMARY).is_some();
        assert_eq!(is_camera, who.contains("camera"), "{who}");
    }
}

fn a_camera_says_how_it_was_set() {
    let line = "--camera --sensor aps-c --focal 35 --aperture 1.8 --shutter 1/60 --iso 1600";
    let tags = tags(&small(line).and(words("-o sky.png")).done());
    for (tag, meant) in [
        (Tag::ExposureTime, 1.0 / 60.0),
        (Tag::FNumber, 1.8),
        (Tag::PhotographicSensitivity, 1600.0),
        (Tag::FocalLength, 35.0),
        (Tag::FocalLengthIn35mmFilm, (35.0 * 36.0 / 23.5f64).round()),
    ] {
        let said = numbers(&tags, tag)[0];
        assert!((said / meant - 1.0).abs() < 1e-3, "{tag}: {said}, not {meant}");
    }
}

/// By night the shutter is open for seconds.
fn a_metered_camera_says() {
    let run = small("--camera").and(words("-o sky.png -o sky.exr")).done();
    let tags = tags(&run);
    let shutter_s = numbers(&tags, Tag::ExposureTime)[0];
    assert!((0.5..=60.0).contains(&shutter_s), "{shutter_s}");
    assert!(numbers(&tags, Tag::PhotographicSensitivity)[0] >= 800.0);
    assert!(run.files().len() == 2, "{run}");
}

/// The frame is the light itself, whoever looks at it.
fn the_light_is_the_same() {
    let frame = |line: &str| {
        let run = small(line).and(words("-o sky.png -o sky.exr")).done();
        nocturne::export::exr::read(&run.path("sky.exr")).expect("a frame").0
    };
    let plain = frame("");
    for line in ["--eye paper", "--red", "--adapted-to 100", "--display p3", "--glare none"] {
        assert!(frame(line) == plain, "{line}: other light");
    }
    let alone = small("").and(words("-o sky.exr")).done();
    let alone = nocturne::export::exr::read(&alone.path("sky.exr")).expect("a frame").0;
    assert!(alone == plain, "without a picture beside it: other light");
}

fn a_scene_file_keeps_it(line: &str, said: &[&str]) {
    let first = small(line).and(words("-o first.png --save-scene first.toml")).done();
    let scene = String::from_utf8(first.read("first.toml")).expect("text");
    for line in said {
        assert!(scene.lines().any(|written| written == *line), "no {line} in\n{scene}");
    }
    let bits = if line.contains("--bits 16") { "--bits 16" } else { "" };
    let again =
        nocturne(words("render --scene scene.toml -q -o again.png --save-scene again.toml"));
    let again = again.and(words(bits)).with_file("scene.toml", first.read("first.toml")).done();
    assert_eq!(scene, String::from_utf8(again.read("again.toml")).expect("text"));
    assert!(first.read("first.png") == again.read("again.png"), "{line}: another picture");
}
