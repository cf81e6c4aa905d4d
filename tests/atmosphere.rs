//! The air as a document: what is shipped, what a user may write, and what is refused.

use nocturne::air::aerosol::{Aerosol, AerosolProfile, MieKind, PhaseLaw};
use nocturne::air::scattering::{Quality, ScatteringTables};
use nocturne::air::{AirError, Atmosphere, Ground};
use nocturne::units::Angle;

fn named(name: &str) -> Atmosphere {
    Atmosphere::named(name).unwrap_or_else(|error| panic!("{name}: {error}"))
}

#[test]
fn every_name_is_an_air_and_survives_a_file() {
    let names: Vec<&str> = Atmosphere::names().collect();
    let expected = "clear continental maritime desert volcanic reference-a reference-b";
    assert_eq!(names.join(" "), expected);
    for name in names {
        let air = named(name);
        air.validate().unwrap();
        let text = toml::to_string(&air).unwrap();
        assert_eq!(Atmosphere::from_toml(&text).unwrap(), air, "{name}:\n{text}");
        assert_eq!(named(&format!(" {} ", name.to_uppercase())), air);
        let file = Atmosphere::file_of(name).unwrap();
        let first = file.lines().next().unwrap();
        assert!(first.starts_with("# ") && first.len() < 100, "{name}: {first}");
    }
}

#[test]
fn clear_air_is_the_default() {
    assert_eq!(named("clear"), Atmosphere::default());
}

#[test]
fn the_references_are_straight_air_over_level_ground() {
    let ground = Ground { albedo: 0.1, height_m: Some(0.0) };
    let b = Atmosphere { ground: ground.clone(), ..Atmosphere::default().straight() };
    assert_eq!(named("reference-b"), b);
    let a = Atmosphere { ground, ..Atmosphere::molecular().straight() };
    assert_eq!(named("reference-a"), a);
}

#[test]
fn every_number_of_a_shipped_file_has_its_source() {
    for name in Atmosphere::names().filter(|name| !name.starts_with("reference")) {
        for line in Atmosphere::file_of(name).unwrap().lines() {
            let code = line.split('#').next().unwrap_or_default();
            let has_number = code
                .split_once('=')
                .is_some_and(|(_, value)| value.chars().any(|c| c.is_ascii_digit()));
            assert!(!has_number || line.contains("# "), "{name}: {line}");
        }
    }
}

#[test]
fn all_phase_laws_and_profiles_can_be_written() {
    let read = |aerosol: &str| {
        let text = format!("[aerosol]\noptical_depth_550 = 0.2\n{aerosol}");
        Atmosphere::from_toml(&text).unwrap_or_else(|error| panic!("{aerosol}: {error}")).aerosol
    };
    for law in [
        r#"{ law = "henyey-greenstein", g = 0.6 }"#,
        r#"{ law = "double-henyey-greenstein", forward_g = 0.8, backward_g = -0.5, forward_share = 0.9 }"#,
        r#"{ law = "cornette-shanks", g = 0.7 }"#,
        r#"{ law = "schlick", k = 0.8 }"#,
        r#"{ law = "table", degrees = [0, 10.0, 60, 180], values = [9, 1.2, 0.1, 0.02] }"#,
        r#"{ law = "mie", kind = "maritime" }"#,
    ] {
        let aerosol = read(&format!("phase = {law}"));
        assert!((aerosol.moment(550.0, 0) - 1.0).abs() < 1e-9, "{law}");
        assert!(aerosol.phase(550.0, 0.9) > aerosol.phase(550.0, -0.2), "{law}");
        let air = Atmosphere { aerosol, ..Atmosphere::default() };
        let again = Atmosphere::from_toml(&toml::to_string(&air).unwrap()).unwrap();
        assert_eq!(again, air, "{law}");
    }
    let layer = read(r#"profile = { shape = "layer", bottom_km = 2.0, top_km = 5 }"#);
    assert_eq!(layer.profile, AerosolProfile::Layer { bottom_km: 2.0, top_km: 5.0 });
    // Left out, the usual ones; with a kind, its own.
    assert!((read("").optical_depth(1100.0) - 0.2 * 0.5f64.powf(1.3)).abs() < 1e-12);
    assert_eq!(read("").albedo(450.0), 0.95);
    assert_eq!(read(r#"phase = { law = "mie", kind = "volcanic" }"#).albedo(550.0), 1.0);
}

#[test]
fn a_layer_holds_its_whole_column() {
    let profile = AerosolProfile::Layer { bottom_km: 15.0, top_km: 25.0 };
    let column: f64 = (0..6000).map(|i| profile.density_per_km(f64::from(i) * 0.01) * 0.01).sum();
    assert!((column - 1.0).abs() < 1e-6, "{column}");
    assert_eq!((profile.density_per_km(15.0), profile.density_per_km(26.0)), (0.0, 0.0));
    assert!((profile.density_per_km(20.0) - 0.2).abs() < 1e-12);
}

#[test]
fn mistakes_are_named_with_their_place() {
    let message = |text: &str| Atmosphere::from_toml(text).unwrap_err().to_string();
    let cases: [(&str, &[&str]); 12] = [
        ("[ozone]\ncolumn = 300", &["line 2", "unknown field `column`"]),
        ("[ozone]\n\ncolumn_du = \"much\"", &["line 3", "expected f64"]),
        ("[ozone\n", &["line 1"]),
        ("ozone.column_du = 2000", &["ozone.column_du is 2000", "0 to 1000"]),
        (
            "aerosol.phase = { law = \"henyey-greenstein\", g = 0.95 }",
            &["aerosol.phase.g is 0.95", "-0.9 to 0.9"],
        ),
        ("\naerosol.phase = { law = \"magic\" }", &["line 2", "unknown variant `magic`", "`mie`"]),
        ("aerosol.phase = { law = \"mie\", kind = \"lunar\" }", &["line 1", "`lunar`", "`desert`"]),
        (
            "aerosol.phase = { law = \"table\", degrees = [0, 90], values = [1, 1] }",
            &["line 1", "0 to 180 degrees"],
        ),
        (
            "aerosol.phase = { law = \"table\", degrees = [0, 1, 180], values = [1e9, 1, 1e-9] }",
            &["mean cosine of aerosol.phase"],
        ),
        (
            "aerosol.profile = { shape = \"layer\", bottom_km = 31.0, top_km = 33.0 }",
            &["aerosol.profile.top_km is 33", "35 to 60"],
        ),
        (
            "stratospheric_aerosol.single_scattering_albedo = 1.5",
            &["stratospheric_aerosol.single_scattering_albedo is 1.5", "0 to 1"],
        ),
        ("ground.albedo = nan", &["ground.albedo is NaN", "0 to 1"]),
    ];
    for (text, said) in cases {
        let message = message(text);
        assert!(message.starts_with("air: ") && !message.contains('\n'), "{message}");
        for word in said {
            assert!(message.contains(word), "{text}: {message} does not say {word}");
        }
    }
}

#[test]
fn unknown_names_are_answered_with_near_ones() {
    let message = |name: &str| Atmosphere::named(name).unwrap_err().to_string();
    let said = message("maritme");
    assert!(said.starts_with("air: none is called 'maritme'; did you mean maritime?"), "{said}");
    assert!(message("xyzzy").contains("known are clear, continental"), "{}", message("xyzzy"));
    assert!(matches!(Atmosphere::named(""), Err(AirError::Unknown { .. })));
}

/// Radiance towards the Sun's azimuth at each wavelength, the Sun 4 degrees down.
fn twilight(air: &Atmosphere, elevation_deg: f64) -> [f64; 2] {
    let tables = ScatteringTables::solve(air, &[450.0, 650.0], Quality::PREVIEW).unwrap();
    let mut out = [0.0; 2];
    let elevation = Angle::from_deg(elevation_deg);
    tables.radiance(0.0, Angle::from_deg(-4.0).sin(), elevation, Angle::ZERO, &mut out);
    out
}

#[test]
fn volcanic_air_has_a_purple_light() {
    let volcanic = named("volcanic").straight();
    let calm = Atmosphere { stratospheric_aerosol: None, ..volcanic.clone() };
    let ratio = |air: &Atmosphere| {
        let [blue, red] = twilight(air, 25.0);
        red / blue
    };
    let (with, without) = (ratio(&volcanic), ratio(&calm));
    assert!(with > 1.5 * without, "red over blue is {with}, without droplets {without}");
    let [_, red] = twilight(&volcanic, 25.0);
    let [_, red_calm] = twilight(&calm, 25.0);
    assert!(red > 2.0 * red_calm, "red {red}, without droplets {red_calm}");
}

#[test]
fn aureoles_are_those_of_their_kinds() {
    // 3 degrees beside a Sun at 45: sea salt throws more light straight on than a haze of the same
    // depth by Henyey and Greenstein.
    let beside = |aerosol: Aerosol| {
        let air = Atmosphere { aerosol, ..Atmosphere::default().straight() };
        let tables = ScatteringTables::solve(&air, &[550.0], Quality::PREVIEW).unwrap();
        let mut out = [0.0];
        let up = Angle::from_deg(48.0);
        tables.radiance(0.0, Angle::from_deg(45.0).sin(), up, Angle::ZERO, &mut out);
        out[0]
    };
    let salt = beside(Aerosol::mie(MieKind::Maritime, 0.1));
    let law = PhaseLaw::HenyeyGreenstein { g: 0.7 };
    let smooth = beside(Aerosol { phase: law, ..Aerosol::mie(MieKind::Maritime, 0.1) });
    assert!(salt > 1.5 * smooth, "{salt} against {smooth}");
}
