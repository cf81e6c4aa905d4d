//! The Moon's axes and its physical ephemeris against the librations of DE421, by other programs.

use glam::DVec3;
use nocturne::catalog::Catalogs;
use nocturne::ephemeris::moon_orientation::{
    FADE_DAYS, LibrationSource, MoonOrientation, MoonPhysical,
};
use nocturne::ephemeris::orientation::{Nutation, Orientation};
use nocturne::frame::{Icrs, MoonFixed, Pos, Rot, turn_axes_x, turn_axes_y, turn_axes_z};
use nocturne::time::{Instant, JulianDate, Tdb, Tt};
use nocturne::units::{Angle, DAY_S};

const PHYSICAL: &str = include_str!("truth/moon_physical.csv");
const LIBRATION: &str = include_str!("truth/libration_de421.csv");

/// First and last moment of the table.
const FIRST_JD: f64 = 2_414_992.5;
const LAST_JD: f64 = 2_524_624.5;

fn with_table() -> MoonOrientation {
    let catalogs = Catalogs::locate(None).expect("the catalogues of the source tree");
    MoonOrientation::load(&catalogs).expect("the table of the source tree")
}

/// The lines of a table as numbers, with the names of their columns.
fn rows(table: &str) -> (Vec<&str>, Vec<Vec<f64>>) {
    let mut lines = table.lines().filter(|line| !line.starts_with('#'));
    let columns = lines.next().expect("a header").split(',').collect();
    let number = |cell: &str| cell.parse().unwrap_or_else(|_| panic!("{cell:?} is no number"));
    (columns, lines.map(|line| line.split(',').map(number).collect()).collect())
}

/// The turn that takes one rotation to another.
fn between(one: Rot<MoonFixed, Icrs>, other: Rot<MoonFixed, Icrs>) -> Angle {
    let turn = (one * other.inverse()).matrix();
    let twice = DVec3::new(
        turn.y_axis.z - turn.z_axis.y,
        turn.z_axis.x - turn.x_axis.z,
        turn.x_axis.y - turn.y_axis.x,
    );
    Angle::from_rad((0.5 * twice.length()).min(1.0).asin())
}

#[test]
fn the_axes_are_those_of_de421_by_table_and_by_series() {
    let (table, series) = (with_table(), MoonOrientation::series());
    let (_, rows) = rows(LIBRATION);
    assert_eq!(rows.len(), 120);
    let (mut worst_table, mut worst_series) = (Angle::ZERO, Angle::ZERO);
    for row in rows {
        let [day, fraction, phi, theta, psi] = row[..] else { panic!("{row:?}") };
        let tdb: JulianDate<Tdb> = JulianDate::from_parts(day, fraction);
        let [phi, theta, psi] = [phi, theta, psi].map(Angle::from_rad);
        // Williams, Boggs & Folkner 2008: principal axes, then mean Earth and mean rotation.
        let truth = Rot::claim(
            turn_axes_x(Angle::from_arcsec(-0.30))
                * turn_axes_y(Angle::from_arcsec(-78.56))
                * turn_axes_z(Angle::from_arcsec(-67.92))
                * turn_axes_z(psi)
                * turn_axes_x(theta)
                * turn_axes_z(phi),
        );
        for (orientation, source, worst) in [
            (&table, LibrationSource::Integrated, &mut worst_table),
            (&series, LibrationSource::Series, &mut worst_series),
        ] {
            assert_eq!(orientation.source(tdb), source);
            let error = between(orientation.moon_fixed_from_icrs(tdb), truth);
            assert!(error < orientation.bound(tdb).unwrap(), "{source:?}, {tdb:?}: {error:?}");
            *worst = worst.max(error);
        }
    }
    println!("table {:.4}\", series {:.2}\"", worst_table.arcsec(), worst_series.arcsec());
    // A bound that nothing comes near would be no measure.
    assert!(worst_table.deg() > 2e-6 && worst_series.deg() > 1e-3);
}

#[test]
fn the_series_stay_near_the_table_all_over_its_span() {
    let (table, series) = (with_table(), MoonOrientation::series());
    let mut worst = Angle::ZERO;
    for step in 0..15_000 {
        let tdb = JulianDate::from_jd(FIRST_JD + (LAST_JD - FIRST_JD) * f64::from(step) / 15_000.0);
        let off = between(series.moon_fixed_from_icrs(tdb), table.moon_fixed_from_icrs(tdb));
        assert!(off < series.bound(tdb).unwrap(), "{tdb:?}: {off:?}");
        worst = worst.max(off);
    }
    println!("series against table: {:.5} degrees", worst.deg());
    assert!(worst.deg() > 0.0015);
}

#[test]
fn librations_axis_and_phase_are_those_of_the_table() {
    let orientation = with_table();
    let (columns, rows) = rows(PHYSICAL);
    let (mut largest, mut sizes) = (vec![0.0f64; columns.len()], 0.0f64);
    for row in &rows {
        let at = |name: &str| columns.iter().position(|column| *column == name).expect(name);
        let number = |name: &str| row[at(name)];
        let position = |origin: &str| -> Pos<Icrs> {
            Pos::from_km(DVec3::from(
                ["x", "y", "z"].map(|axis| number(&format!("{origin}_{axis}_km"))),
            ))
        };
        let day = number("jd_tt_1");
        let tt: JulianDate<Tt> = JulianDate::from_parts(day, number("jd_tt_2"));
        let tdb: JulianDate<Tdb> = JulianDate::from_parts(day, number("jd_tdb_2"));
        // The hour of the Earth does not matter here.
        let instant = Instant::from_tt_ut1(tt, tt.read_on(-60.0)).expect("a date within range");
        let physical = MoonPhysical::of(
            orientation.moon_fixed_from_icrs(tdb.plus_days(-number("light_s") / DAY_S)),
            Orientation::at(&instant, &Nutation::iau2000a(tt)).true_from_icrs,
            position("earth"),
            position("observer"),
            position("sun"),
        );
        let (earth, observer) = (physical.geocentric, physical.topocentric);
        let phase_rad = physical.phase.angle;
        for (name, angle, weight) in [
            ("geo_libr_lon_deg", earth.libration.longitude, 1.0),
            ("geo_libr_lat_deg", earth.libration.latitude, 1.0),
            ("topo_libr_lon_deg", observer.libration.longitude, 1.0),
            ("topo_libr_lat_deg", observer.libration.latitude, 1.0),
            ("subsolar_lon_deg", physical.subsolar.longitude, 1.0),
            ("subsolar_lat_deg", physical.subsolar.latitude, 1.0),
            ("colongitude_deg", physical.colongitude, 1.0),
            ("axis_PA_deg", earth.axis_position_angle, 1.0),
            ("topo_axis_PA_deg", observer.axis_position_angle, 1.0),
            ("phase_angle_deg", phase_rad, 1.0),
            // Opposite to the Sun, or in front of it, the middle of the limb has no firm place.
            ("bright_limb_PA_deg", physical.phase.bright_limb, phase_rad.sin()),
        ] {
            let error_deg = (angle - Angle::from_deg(number(name))).signed().deg() * weight;
            largest[at(name)] = largest[at(name)].max(error_deg.abs());
            assert!(error_deg.abs() < 2e-5, "{name} at {tt:?}: {error_deg}");
        }
        for (name, diameter) in [
            ("geo_ang_diam_arcsec", earth.angular_diameter),
            ("topo_ang_diam_arcsec", observer.angular_diameter),
        ] {
            sizes = sizes.max((diameter.arcsec() - number(name)).abs());
        }
        let lit = physical.phase.illuminated_fraction - number("illum_frac");
        assert!(lit.abs() < 1e-8, "{lit}");
    }
    for (name, largest) in columns.iter().zip(&largest).filter(|(_, largest)| **largest > 0.0) {
        println!("{name}: {largest:.7}");
    }
    assert_eq!(rows.len(), 201);
    assert!(sizes < 2e-5, "{sizes}");
}

#[test]
fn the_series_are_led_to_the_table_without_a_step() {
    let (table, series) = (with_table(), MoonOrientation::series());
    for (end_jd, outwards) in [(FIRST_JD, -1.0), (LAST_JD, 1.0)] {
        let beyond = |days: f64| JulianDate::<Tdb>::from_jd(end_jd).plus_days(outwards * days);
        let lacking = |days: f64| {
            let tdb = beyond(days);
            between(table.moon_fixed_from_icrs(tdb), series.moon_fixed_from_icrs(tdb))
        };
        assert_eq!(table.source(beyond(0.0)), LibrationSource::Integrated);
        assert_eq!(table.source(beyond(1e-6)), LibrationSource::Series);
        // A microsecond on either side; the Moon turns by 0.55" in a second.
        let step = between(
            table.moon_fixed_from_icrs(beyond(1e-11)),
            table.moon_fixed_from_icrs(beyond(-1e-11)),
        );
        assert!(step.arcsec() < 1e-4, "{end_jd}: {}\"", step.arcsec());
        let at_end = lacking(0.0);
        assert!(at_end.arcsec() > 0.5, "the series lack {at_end:?} at {end_jd}");
        let mut before = at_end;
        for day in 1..=100 {
            let now = lacking(f64::from(day));
            assert!(now <= before && before.arcsec() - now.arcsec() < 0.02 * at_end.arcsec());
            before = now;
        }
        assert_eq!(lacking(FADE_DAYS), Angle::ZERO);
    }
}

#[test]
fn bounds_are_stated_where_they_are_known() {
    let (table, series) = (with_table(), MoonOrientation::series());
    let jd = |jd: f64| JulianDate::<Tdb>::from_jd(jd);
    assert!(table.bound(jd(2_451_545.0)).unwrap() < series.bound(jd(2_451_545.0)).unwrap());
    let antiquity = series.bound(jd(1_000_000.0)).unwrap();
    assert!(antiquity.deg() > 0.03 && antiquity == table.bound(jd(1_000_000.0)).unwrap());
    assert!(series.bound(jd(-1e6)).is_none());
}
