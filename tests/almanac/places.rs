//! Rise, set, transit and twilight against tables.

use nocturne::almanac::{Class, Request};
use nocturne::ephemeris::Body;

use super::truth::{
    TOLERANCE, almanac, body, ephemeris, list, local_rate_arcsec_s, rows, seconds, uncertainty_s,
};
use nocturne::frame::{Dir, Horizon};
use nocturne::units::Angle;

/// Events of places by DE440 reduced with ERFA; its header says how.
const REFERENCE: &str = include_str!("../truth/rise_set_twilight.csv");
/// Whole windows of time at difficult places, from `truth/make_almanac.py`.
const WINDOWS: &str = include_str!("../truth/almanac_local.csv");

/// What the almanac may add to the error of its ephemeris.
const OWN_ERROR_S: f64 = 0.05;

const CLASSES: [Class; 5] =
    [Class::Rise, Class::Set, Class::Transit, Class::LowerTransit, Class::Twilight];

fn request(bodies: &[Body]) -> Request {
    Request { classes: CLASSES.to_vec(), bodies: bodies.to_vec(), ..Request::default() }
}

#[test]
fn the_first_crossing_of_a_day_is_that_of_the_reference() {
    let ephemeris = ephemeris();
    let (mut checked, mut worst_s) = (0, 0.0f64);
    for row in rows(REFERENCE) {
        let place = row.place();
        let almanac = almanac(&ephemeris, Some(&place), request(&[Body::Sun, Body::Moon]));
        let day = row.ut1_instant(0.0);
        let (body, code) = match row.text("event") {
            "sun_rise" => (Body::Sun, "rise"),
            "sun_set" => (Body::Sun, "set"),
            "moon_rise" => (Body::Moon, "rise"),
            "moon_set" => (Body::Moon, "set"),
            "astro_dawn" => (Body::Sun, "astronomical-dawn"),
            "astro_dusk" => (Body::Sun, "astronomical-dusk"),
            twilight => (Body::Sun, &*twilight.replace('_', "-").leak()),
        };
        let events = list(&almanac, &day, &day.plus_seconds(86_400.0).unwrap());
        let is_it = |what: &nocturne::almanac::What| {
            what.code() == code && super::truth::body(&what.targets()[0]) == body
        };
        let event = events
            .iter()
            .find(|event| is_it(&event.what))
            .unwrap_or_else(|| panic!("no {code} of {body} at {}", row.text("place")));
        let expected = row.ut1_instant(row.number("jd_ut1_frac"));
        let rate = local_rate_arcsec_s(&ephemeris, &place, &expected, body, false);
        let allowed_s = OWN_ERROR_S + uncertainty_s(&almanac, &expected, &[body], rate);
        let error_s = seconds(&expected, &event.instant);
        worst_s = worst_s.max(error_s.abs());
        let name = row.text("event");
        assert!(error_s.abs() < allowed_s, "{name} {expected}: {error_s} s > {allowed_s} s");
        let azimuth = event.what.azimuth().expect("it rises or sets");
        let azimuth_error = (azimuth - Angle::from_deg(row.number("az_deg"))).signed();
        // Along a slanting way the time's error is one of azimuth, too.
        let slack = Angle::from_arcsec(1.0 + 20.0 * allowed_s);
        assert!(
            azimuth_error.abs() < slack,
            "{name} {expected}: {} arcsec",
            azimuth_error.arcsec()
        );
        checked += 1;
    }
    println!("{checked} events, the worst {worst_s:.4} s off");
    assert_eq!(checked, 30);
}

#[test]
fn windows_hold_the_events_of_the_table_and_no_others() {
    let ephemeris = ephemeris();
    let rows: Vec<_> = rows(WINDOWS).collect();
    let (mut windows, mut checked, mut worst_s) = (0, 0, 0.0f64);
    let mut rest = &rows[..];
    while let [window, after @ ..] = rest {
        let length = after.iter().take_while(|row| row.text("event") != "window").count();
        let (truth, next) = after.split_at(length);
        rest = next;
        let place = window.place();
        let name = window.text("place");
        let almanac =
            almanac(&ephemeris, Some(&place), request(&[Body::Sun, Body::Moon, Body::Mars]));
        let from = window.ut1_instant(window.number("jd_ut1_frac"));
        let to = from.plus_seconds(window.number("body") * 86_400.0).unwrap();
        let mut events = list(&almanac, &from, &to);
        for row in truth {
            let wanted = row.text("body").parse::<Body>().unwrap();
            let code = row.text("event");
            let position = events
                .iter()
                .position(|e| e.what.code() == code && body(&e.what.targets()[0]) == wanted);
            let expected = row.ut1_instant(row.number("jd_ut1_frac"));
            let event = events.remove(
                position.unwrap_or_else(|| panic!("{name}: no {code} of {wanted} at {expected}")),
            );
            let rate = local_rate_arcsec_s(
                &ephemeris,
                &place,
                &expected,
                wanted,
                code.ends_with("transit"),
            );
            let allowed_s = OWN_ERROR_S + uncertainty_s(&almanac, &expected, &[wanted], rate);
            let error_s = seconds(&expected, &event.instant);
            worst_s = worst_s.max(error_s.abs());
            assert!(
                error_s.abs() < allowed_s,
                "{name}: {code} of {wanted} at {expected}: {error_s} s > {allowed_s} s"
            );
            let dir = |azimuth: Angle| -> Dir<Horizon> {
                Dir::from_azimuth_altitude(azimuth, event.what.altitude().unwrap_or(Angle::ZERO))
            };
            let off = dir(event.what.azimuth().unwrap())
                .separation(dir(Angle::from_deg(row.number("az_deg"))));
            assert!(off.arcsec() < 1.0 + 20.0 * allowed_s, "{name}: {code} of {wanted}: {off:?}");
            checked += 1;
        }
        assert!(events.is_empty(), "{name}: too many: {events:?}");
        windows += 1;
    }
    println!("{checked} events in {windows} windows, the worst {worst_s:.4} s off");
    assert!(windows == 11 && checked > 1000, "{windows} windows, {checked} events");
    assert!(TOLERANCE.arcsec() < 0.01);
}
