//! How the Earth stands, against ERFA: the standard models over their span, the long-term precession
//! over millennia, and the joins between them.

use glam::{DMat3, DVec3};
use nocturne::ephemeris::orientation::{
    Nutation, NutationForm, Orientation, PolarMotion, earth_rotation_angle, ecliptic_from_icrs,
    mean_from_icrs, mean_obliquity, mean_sidereal_time, polar_motion,
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
        assert_eq!(n.len(), 13, "{line}");
        Row {
            instant: instant(JulianDate::from_parts(n[0], n[1]), (n[2], n[3])),
            longitude: Angle::from_arcsec(n[4]),
            obliquity: Angle::from_arcsec(n[5]),
            equinox: DVec3::new(n[6], n[7], n[8]),
            pole: DVec3::new(n[9], n[10], n[11]),
            sidereal_time: Angle::from_rad(n[12]),
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

fn orientation(instant: &Instant, form: NutationForm) -> Orientation {
    Orientation::at(instant, &Nutation::at(instant.tt, form))
}

#[test]
fn the_whole_series_is_the_standard_over_its_span() {
    let rows = rows(IAU_2006);
    assert_eq!(rows.len(), 180);
    let mut worst = [0.0_f64; 4];
    for row in rows {
        let axes = orientation(&row.instant, NutationForm::Iau2000a);
        let errors = [
            off(axes.nutation.longitude, row.longitude),
            off(axes.nutation.obliquity, row.obliquity),
            off_axes(axes.true_from_icrs.matrix(), row.equinox, row.pole),
            off(axes.sidereal_time, row.sidereal_time),
        ];
        for (worst, error) in worst.iter_mut().zip(errors) {
            assert!(error < 2e-6, "{}: {errors:?}", row.year());
            *worst = worst.max(error);
        }
    }
    println!("longitude, obliquity, axes, sidereal time, arcsec: {worst:?}");
}

#[test]
fn the_short_series_stays_within_its_bound() {
    let bound = NutationForm::Iau2000b.bound().arcsec();
    for row in rows(IAU_2006) {
        let axes = orientation(&row.instant, NutationForm::Iau2000b);
        assert!(off(axes.nutation.longitude, row.longitude) < bound, "{}", row.year());
        assert!(off(axes.nutation.obliquity, row.obliquity) < bound, "{}", row.year());
        assert!(off(axes.sidereal_time, row.sidereal_time) < bound, "{}", row.year());
        assert!(off_axes(axes.true_from_icrs.matrix(), row.equinox, row.pole) < bound);
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
        for form in NutationForm::ALL {
            let nutation = Nutation::at(tt, form);
            let error =
                off(nutation.longitude, row.longitude).max(off(nutation.obliquity, row.obliquity));
            assert!(error < form.bound().arcsec(), "{year}, {form:?}: {error}");
        }
    }
}

/// What precession, nutation and sidereal time do in a tenth of a day is the same on either side of
/// every join: no step, and no kink that the eye of a telescope would see.
#[test]
fn nothing_steps_where_the_models_are_joined() {
    let day = 0.1 / 365.25;
    for join in [1340.0, 1540.0, 2660.0, 2860.0, -2200.0, -4000.0] {
        let at = |year: f64| {
            let instant = at_year(year);
            let axes = orientation(&instant, NutationForm::Iau2000b);
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

/// While the blend lasts, the equinox and sidereal time stay between the two models, which are
/// 0.03" apart: they must move together, or the stars would turn.
#[test]
fn the_blend_does_not_turn_the_sky() {
    // The hour angle of a star at the equinox of J2000.0 grows with UT1 and the motion of the pole
    // alone. Over a century of the blend it may depart from that by what the origins differ.
    let origin = |year: f64| {
        let instant = at_year(year);
        let mean = mean_from_icrs(instant.tt).matrix();
        let sidereal = mean_sidereal_time(instant.ut1, instant.tt);
        let past = sidereal - earth_rotation_angle(instant.ut1);
        let (sin, cos) = past.sin_cos();
        // The origin that the Earth rotation angle counts from, in ICRS axes.
        (mean.row(0) * cos + mean.row(1) * sin, mean.row(2))
    };
    for (start, end) in [(1540.0, 1340.0), (2660.0, 2860.0)] {
        let mut turned = Angle::ZERO;
        let steps = 2000;
        for i in 0..steps {
            let at = |i: i32| origin(start + (end - start) * f64::from(i) / f64::from(steps));
            let ((a, pole), (b, _)) = (at(i), at(i + 1));
            // A non-rotating origin moves towards the pole or away from it, never along the equator.
            turned += Angle::from_rad((b - a).dot(pole.cross(a)));
        }
        assert!(turned.abs().arcsec() < 0.05, "{start}: {}", turned.arcsec());
    }
}

#[test]
fn axes_stay_at_right_angles_and_agree_with_each_other() {
    for i in 0..400 {
        let instant = at_year(-4000.0 + 20.03 * f64::from(i));
        let axes = orientation(&instant, NutationForm::Iau2000b);
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
    let still = orientation(&instant, NutationForm::Iau2000b);
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
fn the_cheapest_form_that_is_good_enough_is_chosen() {
    assert_eq!(NutationForm::choose(Angle::from_arcsec(1.0)), NutationForm::Iau2000b);
    assert_eq!(NutationForm::choose(Angle::from_arcsec(0.001)), NutationForm::Iau2000a);
    assert_eq!(NutationForm::choose(Angle::ZERO), NutationForm::Iau2000a);
}
