//! What makes no sense is refused with exit code 2 and one sentence, before a file is touched.

use libtest_mimic::Trial;

use super::harness::{NONSENSE, nocturne, trial, words};

/// Name, arguments, and what the sentence must say: the thing, its value, the way out.
type Case = (&'static str, &'static [&'static str], &'static [&'static str]);

const HERE: &[&str] = &["--place", "Flagstaff"];
const FILES: &[&str] = &["-o", "old.png", "-o", "old.exr", "--describe", "old.json"];

/// Dates, in Flagstaff.
const DATES: &[Case] = &[
    ("after_the_last_year", &["5000-01-01"], &["year 5000", "-4000 to 4000"]),
    ("before_the_first_year", &["-5000-01-01"], &["year -5000", "-4000 to 4000"]),
    ("february_30", &["2026-02-30"], &["2026-02 has 28 days", "30"]),
    ("february_29_in_1900", &["1900-02-29"], &["1900-02 has 28 days", "29"]),
    ("month_13", &["2026-13-01"], &["month 13", "1 to 12"]),
    ("25_o_clock", &["2026-08-12T25:00"], &["hour 25", "0 to 23"]),
    ("minute_60", &["2026-08-12T21:60"], &["minute 60", "0 to 59"]),
    ("dropped_by_gregory", &["1582-10-10"], &["1582-10-10 never was", "1582-10-15"]),
    ("garbage", &["garbage"], &["'garbage'", "2026-08-12T21:30-07:00"]),
    ("nothing", &[""], &["''", "2026-08-12T21:30-07:00"]),
    ("american_order", &["08/12/2026"], &["'08/12/2026'", "2026-08-12"]),
    ("no_leap_second", &["2015-12-31T23:59:60Z"], &["no leap second", "second 59"]),
    ("second_61", &["2016-12-31T23:59:61Z"], &["second 61", "0 to 60"]),
    ("offset_of_a_day", &["2026-08-12T21:30+24:00"], &["'+24:00'", "-18:00 to +18:00"]),
];

/// Places.
const PLACES: &[Case] = &[
    ("latitude_91", &["--lat", "91", "--lon", "0"], &["latitude 91°", "-90° to +90°"]),
    ("latitude_nan", &["--lat", "NaN", "--lon", "0"], &["latitude NaN°", "-90° to +90°"]),
    ("longitude_infinite", &["--lat", "0", "--lon", "inf"], &["longitude inf°", "+360°"]),
    ("longitude_400", &["--lat", "0", "--lon", "400"], &["longitude 400°", "+360°"]),
    ("height_nan", &["--lat", "0", "--lon", "0", "--height", "NaN"], &["height NaN m", "100000 m"]),
    ("below_the_sea", &["--place", "Flagstaff", "--height", "-9000"], &["height -9000 m", "-430"]),
    ("latitude_alone", &["--lat", "35"], &["--lon", "--help"]),
    ("longitude_alone", &["--lon", "35"], &["--lat", "--help"]),
    ("latitude_in_words", &["--lat", "north", "--lon", "0"], &["'north'", "--lat <DEG>"]),
    ("height_alone", &["--height", "300"], &["--place NAME", "--lat and --lon"]),
    ("nowhere", &[], &["--place NAME", "--lat and --lon"]),
    ("misspelt", &["--place", "Flagstaf"], &["'Flagstaf'", "did you mean Flagstaff (Arizona)"]),
    ("unknown", &["--place", "Xqzzyv"], &["'Xqzzyv'", "`nocturne place`", "--lat and --lon"]),
    ("in_the_wrong_country", &["--place", "Paris, Japan"], &["'Paris, Japan'", "did you mean"]),
    ("empty", &["--place", ""], &["--place names nothing", "Flagstaff", "--lat and --lon"]),
    ("blank", &["--place", "  "], &["--place names nothing", "Flagstaff", "--lat and --lon"]),
    (
        "twice",
        &["--place", "Flagstaff", "--lat", "3", "--lon", "4"],
        &["--place", "--lat", "--lon"],
    ),
];

/// Cameras, eyes and tolerances, in Flagstaff.
const CAMERAS: &[Case] = &[
    ("field_0", &["--fov", "0"], &["field of view 0°", "0.00028° to 340°", "projection"]),
    ("field_negative", &["--fov", "-5"], &["field of view -5°", "0.00028° to 340°"]),
    ("field_400", &["--fov", "400"], &["field of view 400°", "0.00028° to 340°"]),
    ("field_nan", &["--fov", "NaN"], &["field of view NaN°", "0.00028° to 340°"]),
    ("field_in_words", &["--fov", "wide"], &["'wide'", "--fov <DEG>"]),
    (
        "perspective_180",
        &["--projection", "perspective", "--fov", "180"],
        &["field of view 180°", "170° of the perspective", "another field or projection"],
    ),
    ("projection_unknown", &["--projection", "mercator"], &["'mercator'", "stereographic"]),
    ("size_0", &["--size", "0x0"], &["size 0x0", "1x1 to 16384x16384"]),
    ("size_0_high", &["--size", "640x0"], &["size 640x0", "1x1 to 16384x16384"]),
    ("size_too_wide", &["--size", "99999x10"], &["size 99999x10", "1x1 to 16384x16384"]),
    ("size_in_words", &["--size", "abc"], &["'abc'", "--size <WxH>", "1920x1080"]),
    ("size_negative", &["--size", "-5x5"], &["'-5x5'", "--size <WxH>", "1920x1080"]),
    ("size_overflows", &["--size", "4294967297x10"], &["--size <WxH>", "1920x1080"]),
    ("altitude_95", &["--altitude", "95"], &["altitude of view 95°", "-90° to 90°"]),
    ("altitude_nan", &["--altitude", "NaN"], &["altitude of view NaN°", "-90° to 90°"]),
    ("roll_nan", &["--roll", "NaN"], &["roll NaN°", "-360° to 360°"]),
    ("look_at_nothing", &["--look", ""], &["''", "--look"]),
    ("look_at_400", &["--look", "400"], &["'400'", "--look", "-360 and 360 degrees"]),
    ("look_at_nan", &["--look", "NaN"], &["'NaN'", "--look", "-360 and 360 degrees"]),
    ("look_at_nonsense", &["--look", "nonsense"], &["--look", "'nonsense'", "nocturne objects"]),
    (
        "look_below_the_horizon",
        &["--at", "2026-08-12T21:30-07:00", "--look", "Sun"],
        &["--look", "Sun is below the horizon", "choose another instant or direction"],
    ),
    ("tolerance_negative", &["--tolerance", "-1"], &["tolerance_arcsec is -1", "0 to 360000"]),
    ("tolerance_nan", &["--tolerance", "NaN"], &["tolerance_arcsec is NaN", "0 to 360000"]),
    ("exposure_nan", &["--exposure", "NaN"], &["exposure_stops is NaN", "-40 to 40"]),
    ("exposure_infinite", &["--exposure", "-inf"], &["exposure_stops is -inf", "-40 to 40"]),
    (
        "classic_sky_at_night",
        &["--at", "2026-08-12T21:30-07:00", "--sky", "preetham"],
        &["preetham", "only a Sun above the horizon", "choose another time"],
    ),
    ("classic_sky_unknown", &["--sky", "hosek"], &["'hosek'", "cie-overcast", "preetham"]),
    (
        "turbidity_nan",
        &["--sky", "cie-clear", "--turbidity", "NaN"],
        &["turbidity is NaN", "cie-clear holds from 1.5 to 10"],
    ),
    (
        "turbidity_of_the_overcast",
        &["--sky", "cie-overcast", "--turbidity", "3"],
        &["cie-overcast has no turbidity", "leave it out"],
    ),
    ("turbidity_alone", &["--turbidity", "3"], &["--turbidity is for a classic sky", "--sky"]),
    ("magnitude_nan", &["--magnitude-limit", "NaN"], &["magnitude_limit is NaN", "-30 to 100"]),
];

/// Eyes, cameras that record, and screens, in Flagstaff.
const VIEWERS: &[Case] = &[
    ("eye_unknown", &["--eye", "cat"], &["'cat'", "--eye <MODEL>", "standard, paper"]),
    ("adapted_nan", &["--adapted-to", "NaN"], &["eye.adaptation_cd_m2 is NaN", "to 1"]),
    ("adapted_negative", &["--adapted-to", "-1"], &["eye.adaptation_cd_m2 is -1", "choose"]),
    ("adapted_to_nothing", &["--adapted-to", "0"], &["eye.adaptation_cd_m2 is 0", "choose"]),
    ("coming_from_alone", &["--coming-from", "100"], &["--after", "--help"]),
    ("after_alone", &["--after", "10"], &["--coming-from", "--help"]),
    (
        "coming_from_negative",
        &["--coming-from", "-1", "--after", "3"],
        &["eye.coming_from_cd_m2 is -1", "choose"],
    ),
    ("after_negative", &["--coming-from", "9", "--after", "-3"], &["eye.since_s is -180", "0 to"]),
    ("after_nan", &["--coming-from", "9", "--after", "NaN"], &["eye.since_s is NaN", "0 to"]),
    ("field_factor_0", &["--field-factor", "0"], &["eye.field_factor is 0", "1 to 10"]),
    ("age_nan", &["--age", "NaN"], &["eye.optics.age_years is NaN", "0 to 100"]),
    ("age_200", &["--age", "200"], &["eye.optics.age_years is 200", "0 to 100"]),
    ("glare_unknown", &["--glare", "much"], &["'much'", "cie, spencer, none"]),
    ("night_colour_unknown", &["--night-colour", "green"], &["'green'", "jensen, intrusion, day"]),
    ("grain_in_words", &["--grain", "coarse"], &["'coarse'", "--grain <SEED>"]),
    ("peak_0", &["--display-peak", "0"], &["display.peak_cd_m2 is 0", "1 to 10000"]),
    ("peak_nan", &["--display-peak", "NaN"], &["display.peak_cd_m2 is NaN", "1 to 10000"]),
    ("peak_negative", &["--display-peak", "-100"], &["display.peak_cd_m2 is -100", "1 to 10000"]),
    ("display_unknown", &["--display", "crt"], &["'crt'", "srgb, p3, linear"]),
    ("bits_12", &["--bits", "12"], &["--bits 12", "8 or 16"]),
    ("bits_nothing", &["--bits", ""], &["--bits", "8 or 16"]),
    ("iso_without_camera", &["--iso", "800"], &["--iso is for", "add --camera"]),
    ("focal_without_camera", &["--focal", "50"], &["--focal is for", "add --camera"]),
    ("no_noise_without_camera", &["--no-noise"], &["--no-noise is for", "add --camera"]),
    ("sensor_unknown", &["--camera", "--sensor", "huge"], &["'huge'", "full-frame", "aps-c"]),
    ("iso_in_words", &["--camera", "--iso", "fast"], &["--iso fast", "3200 or auto"]),
    ("iso_nan", &["--camera", "--iso", "NaN"], &["photo.iso is NaN", "choose"]),
    ("iso_1", &["--camera", "--iso", "1"], &["1", "100"]),
    ("shutter_0", &["--camera", "--shutter", "0"], &["photo.shutter_s is 0", "choose"]),
    ("shutter_by_0", &["--camera", "--shutter", "1/0"], &["photo.shutter_s is inf", "choose"]),
    ("shutter_in_words", &["--camera", "--shutter", "bulb"], &["--shutter bulb", "1/60 or auto"]),
    ("aperture_negative", &["--camera", "--aperture", "-2"], &["-2", "choose"]),
    ("focal_nan", &["--camera", "--focal", "NaN"], &["NaN", "choose"]),
    (
        "focal_and_field",
        &["--camera", "--focal", "50", "--fov", "40"],
        &["--focal and --fov", "give one of them"],
    ),
    (
        "white_in_words",
        &["--camera", "--white-balance", "warm"],
        &["--white-balance warm", "daylight, tungsten, auto"],
    ),
    ("white_nan", &["--camera", "--white-balance", "NaN"], &["white_balance is NaN", "choose"]),
    ("vignetting_some", &["--camera", "--vignetting", "some"], &["'some'", "on, off"]),
    (
        "seed_of_no_noise",
        &["--camera", "--no-noise", "--noise-seed", "3"],
        &["--no-noise", "--noise-seed"],
    ),
];

/// Airs, in Flagstaff.
const AIRS: &[Case] = &[
    ("misspelt", &["--atmosphere", "maritme"], &["'maritme'", "did you mean maritime", ".toml"]),
    ("unknown", &["--atmosphere", "xyzzy"], &["'xyzzy'", "clear, continental", ".toml"]),
    ("nothing", &["--atmosphere", " "], &["--atmosphere names nothing", "`nocturne atmosphere`"]),
];

/// Whole command lines that are no render.
const LINES: &[Case] = &[
    ("unknown_command", &["paint"], &["'paint'", "--help"]),
    ("unknown_option", &["render", "--fob", "9"], &["'--fob'", "'--fov'"]),
    ("word_too_many", &["adapter", "please"], &["'please'", "--help"]),
    ("objects_up_nowhere", &["objects", "--up"], &["--up", "--place NAME", "--lat and --lon"]),
    ("objects_unknown", &["objects", "Vulcan", "--place", "Flagstaff"], &["'Vulcan'", "lists all"]),
    ("objects_kind", &["objects", "--kind", "comet", "--place", "Flagstaff"], &["'comet'", "moon"]),
    (
        "objects_magnitude_nan",
        &["objects", "--magnitude-limit", "NaN", "--place", "Flagstaff"],
        &["--magnitude-limit", "give a magnitude"],
    ),
    ("atmosphere_unknown", &["atmosphere", "dessert"], &["'dessert'", "did you mean desert"]),
    ("place_unknown", &["place", "Flagstaf", "--limit", "-1"], &["'-1'", "--limit <N>"]),
];

pub fn trials() -> Vec<Trial> {
    let at = |(name, value, said): &Case| {
        let arguments = [&["render", "--at"], *value, HERE, FILES].concat();
        case(format!("nonsense::date::{name}"), arguments, said)
    };
    let place = |(name, value, said): &Case| {
        let arguments = [&["render"], *value, FILES].concat();
        case(format!("nonsense::place::{name}"), arguments, said)
    };
    let camera = |(name, value, said): &Case| {
        let arguments = [&["render"], *value, HERE, FILES].concat();
        case(format!("nonsense::camera::{name}"), arguments, said)
    };
    let viewer = |(name, value, said): &Case| {
        let arguments = [&["render"], *value, HERE, FILES].concat();
        case(format!("nonsense::viewer::{name}"), arguments, said)
    };
    let air = |(name, value, said): &Case| {
        let arguments = [&["render"], *value, HERE, FILES].concat();
        case(format!("nonsense::air::{name}"), arguments, said)
    };
    let line =
        |(name, line, said): &Case| case(format!("nonsense::line::{name}"), line.to_vec(), said);
    let skipped = "render --at 2026-03-08T02:30 --place Denver --describe old.json";
    let skipped = case(
        "nonsense::date::skipped_by_daylight_saving".to_owned(),
        words(skipped),
        &["America/Denver", "jumped over 2026-03-08T02:30:00", "before or after the jump"],
    );
    let tables = DATES.iter().map(at).chain(PLACES.iter().map(place));
    tables
        .chain(CAMERAS.iter().map(camera))
        .chain(VIEWERS.iter().map(viewer))
        .chain(AIRS.iter().map(air))
        .chain(LINES.iter().map(line))
        .chain([skipped])
        .collect()
}

fn case(name: String, arguments: Vec<&'static str>, said: &[&'static str]) -> Trial {
    let said = said.to_vec();
    trial(name, move || nocturne(arguments).refused(NONSENSE, &said))
}
