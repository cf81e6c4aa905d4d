//! How the Earth stands, against ERFA: the standard models over their span, the long-term precession
//! over millennia, and the joins between them.

use glam::{DMat3, DVec3};
use nocturne::catalog::Catalogs;
use nocturne::ephemeris::orientation::{
    Nutation, NutationForm, Nutations, Orientation, PolarMotion, earth_rotation_angle,
    ecliptic_from_icrs, mean_from_icrs, mean_obliquity, mean_sidereal_time, polar_motion,
};
use nocturne::ephemeris::resampled::{
    ChannelSource, Depth, Folding, Recipe, Reference, Table, encode,
};
use nocturne::time::{Instant, JulianDate, Tt};
use nocturne::units::Angle;

const IAU_2006: &str = include_str!("truth/earth_iau2006.csv");
const LONG_TERM: &str = include_str!("truth/earth_long_term.csv");

struct Row {
    instant: Instant,
    longitude: Angle,
    obliquity: Angle,
    equinox: DVec3,
    pole: DVec3,
    sidereal_time: Angle,
    /// In the table of the standard alone.
    mean_sidereal_time: Option<Angle>,
}

impl Row {
    fn year(&self) -> f64 {
        2000.0 + 100.0 * self.instant.tt.centuries_since_j2000()
    }
}

/// The same reading on every clock but UT1: a table may say what no clock of ours would.
fn instant(tt: JulianDate<Tt>, ut1: (f64, f64)) -> Instant {
    let ut1 = JulianDate::from_parts(ut1.0, ut1.1);
    Instant { utc: ut1.read_on(0.0), ut1, tt, tdb: tt.read_on(0.0) }
}

fn rows(table: &str) -> Vec<Row> {
    let is_row = |line: &&str| line.starts_with(|c: char| c.is_ascii_digit());
    let row = |line: &str| {
        let n: Vec<f64> = line.split(',').map(|cell| cell.parse().expect("a number")).collect();
        assert!(n.len() >= 13, "{line}");
        Row {
            instant: instant(JulianDate::from_parts(n[0], n[1]), (n[2], n[3])),
            longitude: Angle::from_arcsec(n[4]),
            obliquity: Angle::from_arcsec(n[5]),
            equinox: DVec3::new(n[6], n[7], n[8]),
            pole: DVec3::new(n[9], n[10], n[11]),
            sidereal_time: Angle::from_rad(n[12]),
            mean_sidereal_time: n.get(13).copied().map(Angle::from_rad),
        }
    };
    table.lines().filter(is_row).map(row).collect()
}

fn at_year(year: f64) -> Instant {
    let tt = JulianDate::from_jd(2_451_545.0 + (year - 2000.0) * 365.25);
    instant(tt, (tt.day(), tt.fraction()))
}

/// The larger of the distances of equinox and pole from those of a matrix, arcseconds.
fn off_axes(matrix: DMat3, equinox: DVec3, pole: DVec3) -> f64 {
    let off = (matrix.row(0) - equinox).length().max((matrix.row(2) - pole).length());
    Angle::from_rad(off).arcsec()
}

fn off(a: Angle, b: Angle) -> f64 {
    (a - b).signed().abs().arcsec()
}

fn short(instant: &Instant) -> Orientation {
    Orientation::at(instant, &Nutation::iau2000b(instant.tt))
}

fn with_table() -> Nutations {
    let catalogs = Catalogs::locate(None).expect("the catalogues of the source tree");
    Nutations::load(&catalogs).expect("a table as it was packed")
}

/// Largest differences from ERFA over its table: longitude, obliquity, axes, sidereal time, arcsec.
fn worst(nutations: &Nutations, form: NutationForm) -> [f64; 4] {
    let rows = rows(IAU_2006);
    assert_eq!(rows.len(), 180);
    rows.iter().fold([0.0; 4], |worst, row| {
        let nutation = nutations.at(row.instant.tt, form);
        let axes = Orientation::at(&row.instant, &nutation);
        let errors = [
            off(nutation.longitude, row.longitude),
            off(nutation.obliquity, row.obliquity),
            off_axes(axes.true_from_icrs.matrix(), row.equinox, row.pole),
            off(axes.sidereal_time, row.sidereal_time),
        ];
        std::array::from_fn(|i| errors[i].max(worst[i]))
    })
}

#[test]
fn the_whole_series_is_the_standard_over_its_span() {
    let worst = worst(&Nutations::series(), NutationForm::Iau2000a);
    assert!(worst.iter().all(|&error| error < 2e-6), "{worst:?}");
}

#[test]
fn mean_sidereal_time_is_the_published_polynomial_until_that_wears_out() {
    for row in rows(IAU_2006) {
        let published = row.mean_sidereal_time.expect("a column of gmst06");
        let error = off(mean_sidereal_time(row.instant.ut1, row.instant.tt), published);
        let bound = if row.year() < 2400.0 { 3e-5 } else { 7e-4 };
        assert!(error < bound, "{}: {error}", row.year());
    }
}

#[test]
fn the_cheaper_forms_stay_within_their_bounds() {
    let nutations = with_table();
    for form in [NutationForm::Interpolated, NutationForm::Iau2000b] {
        let worst = worst(&nutations, form);
        assert!(worst.iter().all(|&error| error < form.bound().arcsec()), "{form:?}: {worst:?}");
        // They are not the whole series by another name.
        assert!(worst[0] > 2e-6, "{form:?}");
    }
}

#[test]
fn millennia_away_the_long_term_precession_is_that_of_erfa() {
    let rows = rows(LONG_TERM);
    assert_eq!(rows.len(), 70);
    for row in rows {
        let (tt, year) = (row.instant.tt, row.year());
        let error = off_axes(mean_from_icrs(tt).matrix(), row.equinox, row.pole);
        assert!(error < 1e-7, "{year}: {error}");
        let error = off(mean_sidereal_time(row.instant.ut1, tt), row.sidereal_time);
        assert!(error < 1e-6, "{year}: {error}");
        for form in [NutationForm::Iau2000b, NutationForm::Iau2000a] {
            let nutation = Nutations::series().at(tt, form);
            let error =
                off(nutation.longitude, row.longitude).max(off(nutation.obliquity, row.obliquity));
            assert!(error < form.bound().arcsec(), "{year}, {form:?}: {error}");
        }
    }
}

/// A tenth of a day before a join and a tenth after it the axes move alike: no step, no kink.
#[test]
fn nothing_steps_where_the_models_are_joined() {
    let day = 0.1 / 365.25;
    for join in [1340.0, 1540.0, 2660.0, 2860.0, -4200.0, 4200.0] {
        let at = |year: f64| {
            let instant = at_year(year);
            let axes = short(&instant);
            // Less the even rotation.
            let drift = axes.sidereal_time - earth_rotation_angle(instant.ut1);
            (axes.true_from_icrs.matrix(), drift.signed(), axes.mean_obliquity)
        };
        let [before, middle, after] = [join - day, join, join + day].map(at);
        let bend = |a: f64, b: f64, c: f64| Angle::from_rad(a - 2.0 * b + c).abs().arcsec();
        // The curvature of nutation itself is 0.0006" in so short a time.
        assert!(bend(before.1.rad(), middle.1.rad(), after.1.rad()) < 0.001, "{join}");
        assert!(bend(before.2.rad(), middle.2.rad(), after.2.rad()) < 1e-6, "{join}");
        for i in 0..3 {
            let [a, b, c] = [before.0, middle.0, after.0].map(|matrix| matrix.row(i));
            let bend = Angle::from_rad((a - 2.0 * b + c).length()).arcsec();
            assert!(bend < 0.001, "{join}: {bend}");
        }
    }
}

/// How far the origin of the Earth rotation angle turns about the pole between two years, arcseconds:
/// by its definition, nothing. `axes` gives sidereal time, and the matrix to the equator and
/// equinox that it belongs to.
fn turned(start: f64, end: f64, steps: i32, axes: impl Fn(&Instant) -> (Angle, DMat3)) -> f64 {
    let origin = |step: i32| {
        let instant = at_year(start + (end - start) * f64::from(step) / f64::from(steps));
        let (sidereal_time, matrix) = axes(&instant);
        let (sin, cos) = (sidereal_time - earth_rotation_angle(instant.ut1)).sin_cos();
        (matrix.row(0) * cos + matrix.row(1) * sin, matrix.row(2))
    };
    let mut last = origin(0);
    let mut turned = 0.0;
    for step in 1..=steps {
        let next = origin(step);
        // Along the equator, at the middle of the step.
        turned += (next.0 - last.0).dot((next.1 + last.1).cross(next.0 + last.0)) / 4.0;
        last = next;
    }
    Angle::from_rad(turned).arcsec()
}

/// While the blend lasts, the equinox and sidereal time must move together, or the stars would turn.
#[test]
fn the_blend_does_not_turn_the_sky() {
    let mean = |instant: &Instant| {
        let matrix = mean_from_icrs(instant.tt).matrix();
        (mean_sidereal_time(instant.ut1, instant.tt), matrix)
    };
    for (start, end) in [(1540.0, 1340.0), (2660.0, 2860.0)] {
        // The loops of nutation, which the mean equator does not make, are made up for.
        let loops = -0.003_808_65 * (end - start) / 100.0;
        let turned = turned(start, end, 2000, mean) - loops;
        assert!(turned.abs() < 0.001, "{start}: {turned}");
    }
}

#[test]
fn the_origin_of_the_rotation_angle_drifts_as_documented() {
    let nutations = with_table();
    let apparent = |instant: &Instant| {
        let nutation = nutations.at(instant.tt, NutationForm::Interpolated);
        let axes = Orientation::at(instant, &nutation);
        (axes.sidereal_time, axes.true_from_icrs.matrix())
    };
    let bounds = [(1560.0, 3e-5), (1800.0, 3e-5), (2200.0, 3e-5), (2400.0, 5e-5), (2600.0, 5e-4)];
    for (year, bound) in bounds {
        // Steps of half a day.
        let steps = (f64::abs(year - 2000.0) * 365.25 * 2.0) as i32;
        let drift = turned(2000.0, year, steps, apparent);
        assert!(drift.abs() < bound, "{year}: {drift}");
    }
}

#[test]
fn axes_stay_at_right_angles_and_agree_with_each_other() {
    for i in 0..400 {
        let instant = at_year(-4000.0 + 20.03 * f64::from(i));
        let axes = short(&instant);
        let ecliptic = ecliptic_from_icrs(instant.tt).matrix();
        for matrix in [
            axes.mean_from_icrs.matrix(),
            axes.true_from_icrs.matrix(),
            axes.itrs_from_icrs().matrix(),
            ecliptic,
        ] {
            assert!((matrix * matrix.transpose()).abs_diff_eq(DMat3::IDENTITY, 2e-14), "{i}");
        }
        let over_equator = axes.ecliptic_from_mean * axes.mean_from_icrs;
        assert!(over_equator.matrix().abs_diff_eq(ecliptic, 2e-14), "{i}");
        assert_eq!(mean_obliquity(instant.tt), axes.mean_obliquity);
    }
}

#[test]
fn polar_motion_tips_the_crust_and_nothing_else() {
    // 2020-01-01: x 0.0768", y 0.2820" (IERS C04).
    let instant = Instant::from_utc(JulianDate::from_jd(2_458_849.5)).expect("a date");
    let pole = polar_motion(instant.utc);
    assert!(off(pole.x, Angle::from_arcsec(0.0768)) < 0.001, "{pole:?}");
    assert!(off(pole.y, Angle::from_arcsec(0.2820)) < 0.001, "{pole:?}");
    let still = short(&instant);
    let moved = still.with_polar_motion(&instant, pole);
    assert_eq!(moved.true_from_icrs.matrix(), still.true_from_icrs.matrix());
    // The intermediate pole stands at x towards Greenwich and y towards 90 degrees west.
    let on_crust = moved.itrs_from_true.matrix() * DVec3::Z;
    let expected = DVec3::new(pole.x.rad(), -pole.y.rad(), 1.0);
    assert!(on_crust.abs_diff_eq(expected, 1e-11), "{on_crust}");
    let none = still.with_polar_motion(&instant, PolarMotion::default());
    assert!(none.itrs_from_true.matrix().abs_diff_eq(still.itrs_from_true.matrix(), 1e-10));
}

#[test]
fn the_table_is_the_series_between_the_rows_too() {
    let nutations = with_table();
    let bound = NutationForm::Interpolated.bound().arcsec();
    // Eleven years less a little apart, so that all phases of a segment come.
    for i in 0..1100 {
        let tt = at_year(1550.0 + 0.99917 * f64::from(i)).tt;
        let (table, series) =
            (nutations.at(tt, NutationForm::Interpolated), Nutation::iau2000a(tt));
        assert!(off(table.longitude, series.longitude) < bound, "{i}");
        assert!(off(table.obliquity, series.obliquity) < bound, "{i}");
        assert!(off(table.locator, series.locator) < bound, "{i}");
    }
}

#[test]
fn the_table_has_no_steps() {
    let nutations = with_table();
    // Borders of segments: every sixteenth midnight from the first.
    for i in 1..1000 {
        let border = JulianDate::<Tt>::from_jd(2_287_160.5 + 16.0 * 25.0 * f64::from(i));
        let at = |seconds| {
            nutations.at(border.plus_seconds(seconds), NutationForm::Interpolated).longitude
        };
        // 0.0001" are what nutation itself may do in a minute.
        assert!(off(at(-30.0), at(30.0)) < 0.0003, "{border:?}");
        assert!(off(at(-0.001), at(0.001)) < 1e-7, "{border:?}");
    }
}

#[test]
fn a_table_of_something_else_is_refused() {
    let recipe = Recipe {
        id: "libration".into(),
        start_jd: 2_451_544.5,
        segment_days: 16.0,
        segments: 1,
        components: 1,
        degree: 3,
        quantum: [1e-9; 3],
        omitted_bits: [0, 0],
        reference: Reference::None,
        folding: [Folding { pieces: 1, degree: 3 }; 3],
    };
    let bytes = encode(&[ChannelSource { recipe, sample: &|_| DVec3::ZERO }]).expect("a table");
    let other = Table::from_bytes(&bytes, Depth::Thousandth).expect("a table");
    assert!(Nutations::with_table(other).unwrap_err().contains("nutation"));
}

#[test]
fn the_cheapest_form_that_is_good_enough_is_chosen() {
    let (now, antiquity) = (at_year(2026.0).tt, at_year(-500.0).tt);
    let series = Nutations::series();
    let table = with_table();
    for (arcsec, nutations, tt, form) in [
        (1.0, &series, now, NutationForm::Iau2000b),
        (0.001, &series, now, NutationForm::Iau2000a),
        (0.0, &series, now, NutationForm::Iau2000a),
        (1.0, &table, now, NutationForm::Interpolated),
        (0.001, &table, now, NutationForm::Interpolated),
        (0.0, &table, now, NutationForm::Iau2000a),
        (1.0, &table, antiquity, NutationForm::Iau2000b),
        (0.001, &table, antiquity, NutationForm::Iau2000a),
    ] {
        assert_eq!(nutations.choose(Angle::from_arcsec(arcsec), tt), form, "{arcsec} {tt:?}");
    }
    // Outside its table the interpolated form is the whole series.
    assert_eq!(table.at(antiquity, NutationForm::Interpolated), Nutation::iau2000a(antiquity));
}
