//! The moons of Jupiter against an integration by JPL.

use glam::DVec3;
use nocturne::ephemeris::Galilean;
use nocturne::time::{JulianDate, Tdb};
use nocturne::units::{AU_KM, Angle};

const JUP310: &str = include_str!("truth/galilean.csv");

#[test]
fn moons_stand_where_jup310_has_them() {
    let rows: Vec<&str> = JUP310.lines().filter(|line| !line.starts_with('#')).skip(1).collect();
    assert_eq!(rows.len(), 56);
    for row in rows {
        let (name, numbers) = row.split_once(',').expect("a name and numbers");
        let numbers: Vec<f64> =
            numbers.split(',').map(|cell| cell.parse().expect("a number")).collect();
        let [jd, x, y, z] = numbers[..] else { panic!("{row:?}") };
        let tdb: JulianDate<Tdb> = JulianDate::from_jd(jd);
        let moon = Galilean::ALL.into_iter().find(|moon| moon.name() == name);
        let at = moon.expect("a Galilean moon").from_jupiter(tdb).km();
        let apart_km = (at - DVec3::new(x, y, z)).length();
        // At a mean opposition.
        let seen = Angle::from_rad(apart_km / (4.2 * AU_KM));
        assert!(seen < Galilean::bound(tdb), "{}: {apart_km:.0} km", name);
        let most_km = if tdb.jd() < 2_460_000.0 { 480.0 } else { 1850.0 };
        assert!(apart_km < most_km, "{} at {}: {apart_km:.0} km", name, tdb.jd());
    }
}
