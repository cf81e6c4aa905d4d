//! Which constellation holds a direction, and where the boundaries run.
//!
//! *Theory.* Boundaries run along circles of right ascension and declination of B1875.0 (Delporte 1930):
//! a direction is turned to those axes, and looked up as Roman 1987, *PASP* 99, 695, does it: of the
//! southern sides at its right ascension the first below it belongs to its constellation.
//!
//! *Accuracy.* The corners are exact. The axes are those of the IAU 2006 precession; by the theories that
//! Delporte had, Newcomb's precession and the equinox of his time, they lie 0.5" from these (estimated):
//! which side of a line is meant is not defined any better.

use std::sync::LazyLock;

use crate::catalog::{ConstellationId, Corner, constellations};
use crate::ephemeris::orientation::mean_from_icrs;
use crate::frame::{Dir, Icrs, MeanOfDate, Rot};
use crate::time::JulianDate;
use crate::units::Angle;

/// B1875.0 as a Julian date: Besselian years of 365.242198781 days from B1900.0 (Lieske 1979).
const B1875_JD: f64 = 2_405_889.258_55;
/// Seconds of right ascension around the sky.
const AROUND_S: i32 = 86_400;
/// Greatest length of a side of the drawn boundaries.
const STEP: Angle = Angle::from_deg(1.0);

/// The constellation that holds a direction. One on a boundary belongs to the north and the east.
pub fn constellation_at(dir: Dir<Icrs>) -> ConstellationId {
    let dir = SKY.b1875_from_icrs * dir;
    let ra_s = dir.longitude().rad().rem_euclid(std::f64::consts::TAU).to_degrees() * 240.0;
    let dec_arcmin = dir.latitude().deg() * 60.0;
    let holds =
        |side: &&Side| side.dec_arcmin <= dec_arcmin && side.from_s <= ra_s && ra_s < side.to_s;
    SKY.sides.iter().find(holds).map_or(SKY.around_south_pole, |side| side.above)
}

/// All boundaries between constellations as lines to be drawn, each once, in steps of a degree or less.
pub fn boundary_lines() -> &'static [Vec<Dir<Icrs>>] {
    &SKY.lines
}

/// The boundary of one constellation, in steps of a degree or less: one ring, of Serpens two. The last
/// point is the first again.
pub fn boundary_rings(constellation: ConstellationId) -> Vec<Vec<Dir<Icrs>>> {
    let rings = constellation.get().rings.iter();
    rings
        .map(|ring| {
            let sides = ring.iter().zip(ring.iter().cycle().skip(1));
            let mut points: Vec<_> = sides.flat_map(|(&a, &b)| SKY.along(a, b)).collect();
            points.extend(points.first().copied());
            points
        })
        .collect()
}

/// A side that bounds a constellation to the south.
struct Side {
    dec_arcmin: f64,
    /// Right ascension from west to east, seconds of time.
    from_s: f64,
    to_s: f64,
    above: ConstellationId,
}

struct Sky {
    b1875_from_icrs: Rot<MeanOfDate, Icrs>,
    /// From north to south.
    sides: Vec<Side>,
    around_south_pole: ConstellationId,
    lines: Vec<Vec<Dir<Icrs>>>,
}

static SKY: LazyLock<Sky> = LazyLock::new(|| {
    let first = ConstellationId::all().next().expect("there are 88 constellations");
    let b1875_from_icrs = mean_from_icrs(JulianDate::from_jd(B1875_JD));
    let mut sky =
        Sky { b1875_from_icrs, sides: Vec::new(), around_south_pole: first, lines: Vec::new() };
    for constellation in ConstellationId::all() {
        for ring in &constellation.get().rings {
            sky.add(constellation, ring);
        }
    }
    sky.sides.sort_by(|a, b| b.dec_arcmin.total_cmp(&a.dec_arcmin));
    sky.lines = all_lines(&sky);
    sky
});

impl Sky {
    /// The southern sides of a ring.
    fn add(&mut self, constellation: ConstellationId, ring: &[Corner]) {
        let parallels: Vec<(i32, i32, i32)> = corners(ring)
            .filter(|(a, b)| a.dec_arcmin == b.dec_arcmin)
            .map(|(a, b)| (a.dec_arcmin, a.ra_s, eastward_s(a, b)))
            .collect();
        let turned: i32 = parallels.iter().map(|&(_, _, east)| east).sum();
        let around_north = turned != 0 && parallels[0].0 > 0;
        if turned != 0 && !around_north {
            self.around_south_pole = constellation;
        }
        for &(dec_arcmin, ra_s, east) in &parallels {
            let (from, width) = (if east < 0 { ra_s + east } else { ra_s }, east.abs());
            let from = from.rem_euclid(AROUND_S);
            // Is it inside just above the side's middle? Then an odd number of sides lie farther north,
            // or an even one if the pole is inside.
            let middle = f64::from(from) + 0.5 * f64::from(width);
            let north = parallels.iter().filter(|&&(other, ra_s, east)| {
                let west = f64::from(if east < 0 { ra_s + east } else { ra_s });
                let from_west = (middle - west).rem_euclid(f64::from(AROUND_S));
                other > dec_arcmin && from_west < f64::from(east.abs())
            });
            if (north.count() % 2 == 1) == around_north {
                continue;
            }
            let to = from + width;
            let mut push = |from: i32, to: i32| {
                let dec_arcmin = f64::from(dec_arcmin);
                let (from_s, to_s) = (f64::from(from), f64::from(to));
                self.sides.push(Side { dec_arcmin, from_s, to_s, above: constellation });
            };
            push(from, to.min(AROUND_S));
            if to > AROUND_S {
                push(0, to - AROUND_S);
            }
        }
    }

    /// Points from one corner towards the next, the second left out.
    fn along(&self, a: Corner, b: Corner) -> impl Iterator<Item = Dir<Icrs>> {
        let icrs_from_b1875 = self.b1875_from_icrs.inverse();
        let (east_s, north_arcmin) = (eastward_s(&a, &b), b.dec_arcmin - a.dec_arcmin);
        let dec = Angle::from_arcmin(f64::from(a.dec_arcmin));
        let length = Angle::from_deg(f64::from(east_s) / 240.0) * dec.rad().cos()
            + Angle::from_arcmin(f64::from(north_arcmin));
        let steps = (length.rad().abs() / STEP.rad()).ceil().max(1.0);
        (0..steps as u32).map(move |step| {
            let share = f64::from(step) / steps;
            let ra_s = f64::from(a.ra_s) + share * f64::from(east_s);
            let dec_arcmin = f64::from(a.dec_arcmin) + share * f64::from(north_arcmin);
            icrs_from_b1875
                * Dir::from_spherical(Angle::from_deg(ra_s / 240.0), Angle::from_arcmin(dec_arcmin))
        })
    }
}

/// The sides of a ring.
fn corners(ring: &[Corner]) -> impl Iterator<Item = (&Corner, &Corner)> {
    ring.iter().zip(ring.iter().cycle().skip(1))
}

/// The way from one corner to another along the equator, seconds of time, the short way around.
fn eastward_s(a: &Corner, b: &Corner) -> i32 {
    (b.ra_s - a.ra_s + AROUND_S / 2).rem_euclid(AROUND_S) - AROUND_S / 2
}

/// The sides of all rings without those that two of them share, joined where one goes on straight.
fn all_lines(sky: &Sky) -> Vec<Vec<Dir<Icrs>>> {
    // Circle (0 for one of right ascension), its place, and the part of it, which may pass 24 h.
    let mut parts: Vec<(u8, i32, i32, i32)> = Vec::new();
    for ring in constellations().iter().flat_map(|one| &one.rings) {
        for (a, b) in corners(ring) {
            let east = eastward_s(a, b);
            if east == 0 {
                let (south, north) =
                    (a.dec_arcmin.min(b.dec_arcmin), a.dec_arcmin.max(b.dec_arcmin));
                parts.push((0, a.ra_s, south, north));
            } else {
                let west = if east > 0 { a.ra_s } else { b.ra_s };
                let end = west + east.abs();
                parts.push((1, a.dec_arcmin, west, end.min(AROUND_S)));
                if end > AROUND_S {
                    parts.push((1, a.dec_arcmin, 0, end - AROUND_S));
                }
            }
        }
    }
    parts.sort_unstable();
    let mut joined: Vec<(u8, i32, i32, i32)> = Vec::new();
    for part in parts {
        match joined.last_mut() {
            Some(last) if (last.0, last.1) == (part.0, part.1) && part.2 <= last.3 => {
                last.3 = last.3.max(part.3);
            }
            _ => joined.push(part),
        }
    }
    let line = |&(circle, place, from, to): &(u8, i32, i32, i32)| {
        let corner = |at: i32| match circle {
            0 => Corner { ra_s: place, dec_arcmin: at },
            _ => Corner { ra_s: at, dec_arcmin: place },
        };
        // In parts of less than half a turn, the short way between which is the right one.
        let middle = from + (to - from) / 2;
        let pieces = [(from, middle), (middle, to)].into_iter();
        let points = pieces.flat_map(|(from, to)| sky.along(corner(from), corner(to)));
        let end = sky.along(corner(to), corner(from)).next();
        points.chain(end).collect()
    };
    joined.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::catalog::Catalogs;

    fn at_b1875(ra_h: f64, dec_deg: f64) -> &'static str {
        let dir = Dir::from_spherical(Angle::from_deg(15.0 * ra_h), Angle::from_deg(dec_deg));
        constellation_at(SKY.b1875_from_icrs.inverse() * dir).get().abbreviation
    }

    fn at_j2000(ra_deg: f64, dec_deg: f64) -> &'static str {
        let dir = Dir::from_spherical(Angle::from_deg(ra_deg), Angle::from_deg(dec_deg));
        constellation_at(dir).get().abbreviation
    }

    /// ρ Aql has moved into Delphinus, by its own motion, in 1992 (Wagman 2003, recalled); Delporte drew
    /// the boundaries so that all others stayed in their constellations.
    const ELSEWHERE: [(u16, &str); 1] = [(7724, "Del")];

    #[test]
    fn stars_stand_in_the_constellations_of_their_designations() {
        let stars = Catalogs::locate(None).unwrap().stars().unwrap();
        let mut elsewhere = BTreeSet::new();
        let mut designated = 0;
        for star in &stars {
            let Some((_, name)) = star.designation.as_deref().and_then(|d| d.rsplit_once(' '))
            else {
                continue;
            };
            designated += 1;
            let found = constellation_at(star.dir_j2000).get().abbreviation;
            if found != name {
                elsewhere.insert((star.hr, star.designation.clone().unwrap(), found));
            }
        }
        assert_eq!(designated, 3143);
        let found: Vec<(u16, &str)> = elsewhere.iter().map(|(hr, _, is)| (*hr, *is)).collect();
        assert_eq!(found, ELSEWHERE, "{elsewhere:?}");
    }

    #[test]
    fn poles_and_labels_are_where_they_belong() {
        assert_eq!((at_j2000(0.0, 90.0), at_j2000(0.0, -90.0)), ("UMi", "Oct"));
        assert_eq!((at_b1875(3.0, 90.0), at_b1875(3.0, -90.0)), ("UMi", "Oct"));
        for id in ConstellationId::all() {
            for &label in &id.get().labels {
                assert_eq!(constellation_at(label), id);
            }
        }
    }

    /// The examples of Roman 1987, at B1950.0 there (recalled), and places of known answers.
    #[test]
    fn places_of_known_answers() {
        for (ra_h, dec_deg, wanted) in
            [(5.5, -5.4, "Ori"), (0.0, 28.5, "And"), (18.0, -30.0, "Sgr")]
        {
            assert_eq!(at_b1875(ra_h, dec_deg), wanted);
        }
        // The Sun's way leads through Ophiuchus; the middle of the Galaxy is in Sagittarius, its north
        // pole in Coma Berenices; the vernal equinox is in Pisces, the autumnal one in Virgo.
        assert_eq!(at_j2000(255.0, -22.8), "Oph");
        assert_eq!(at_j2000(266.405, -28.936), "Sgr");
        assert_eq!(at_j2000(192.859, 27.128), "Com");
        assert_eq!((at_j2000(0.0, 0.0), at_j2000(180.0, 0.0)), ("Psc", "Vir"));
        // The two parts of Serpens.
        assert_eq!((at_j2000(236.07, 6.43), at_j2000(275.33, -2.9)), ("Ser", "Ser"));
    }

    /// On both sides of every side of every ring: 2 arcseconds inside it is the ring's own
    /// constellation, 2 outside it is not.
    #[test]
    fn boundaries_divide_what_they_should() {
        let step = Angle::from_arcsec(2.0).deg();
        for id in ConstellationId::all() {
            for (a, b) in id.get().rings.iter().flat_map(|ring| corners(ring)) {
                let east = eastward_s(a, b);
                let middle = (f64::from(a.ra_s) + 0.5 * f64::from(east)) / 3600.0;
                let dec = f64::from(a.dec_arcmin + b.dec_arcmin) / 120.0;
                let (one, other) = if east == 0 {
                    let aside = step / 15.0 / dec.to_radians().cos();
                    (at_b1875(middle - aside, dec), at_b1875(middle + aside, dec))
                } else {
                    (at_b1875(middle, dec - step), at_b1875(middle, dec + step))
                };
                let own = id.get().abbreviation;
                assert!(one != other && (one == own || other == own), "{own} {a:?} {one} {other}");
            }
        }
    }

    /// By a thousand points all over the sky: the share of each constellation is its area. Areas of the
    /// IAU, square degrees (recalled).
    #[test]
    fn areas_are_as_published() {
        let count = 60_000;
        let mut hits = vec![0; constellations().len()];
        for n in 0..count {
            let height = 1.0 - (2.0 * f64::from(n) + 1.0) / f64::from(count);
            let turn = f64::from(n) * 2.399_963_229_728_653;
            let dir = Dir::from_spherical(Angle::from_rad(turn), Angle::from_rad(height.asin()));
            hits[constellation_at(dir).index()] += 1;
        }
        for (name, wanted) in [
            ("Hya", 1302.844),
            ("Vir", 1294.428),
            ("UMa", 1279.660),
            ("UMi", 255.864),
            ("Oct", 291.045),
            ("Ser", 636.928),
            ("Cep", 587.787),
            ("Cru", 68.447),
        ] {
            let id = ConstellationId::from_abbreviation(name).unwrap();
            let area = 41_252.96 * f64::from(hits[id.index()]) / f64::from(count);
            assert!((area - wanted).abs() < 5.0, "{name}: {area} not {wanted}");
        }
    }

    #[test]
    fn drawn_lines_have_short_steps_and_no_doubles() {
        let length = |points: &[Dir<Icrs>]| {
            let steps = points.windows(2).map(|pair| pair[0].separation(pair[1]).deg());
            steps.inspect(|&step| assert!(step > 0.0 && step < 1.001, "{step}")).sum::<f64>()
        };
        let once: f64 = boundary_lines().iter().map(|line| length(line)).sum();
        let rings = ConstellationId::all().flat_map(boundary_rings);
        let twice: f64 = rings.map(|ring| length(&ring)).sum();
        // Steps along a parallel are cut across, a little more where they are longer.
        assert!((twice / once - 2.0).abs() < 1e-4, "{twice} {once}");
    }
}
