//! Where people live, and the light of their lamps summed up.
//!
//! A disc is cut into rings around the observer, each an arc of the even disc: the light of a patch is
//! near one over its distance, its area grows with the distance, so nothing diverges inside a town.

use std::f64::consts::PI;

use super::dome::{COLUMNS, Dome, azimuth_of};
use super::*;

/// Square kilometres of a square mile.
const SQUARE_MILE_KM2: f64 = 2.589_988;
/// Towns with less than this part of all the glow are taken for a ring of one distance.
const FAINT: f64 = 0.005;
/// Nodes and weights of Gauss and Legendre's rule on [-1, 1], of orders 2 and 4.
const GAUSS_2: [(f64, f64); 2] = [(-0.577_350_269_189_625_8, 1.0), (0.577_350_269_189_625_8, 1.0)];
const GAUSS_4: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
    (-0.339_981_043_584_856_3, 0.652_145_154_862_546_1),
    (0.339_981_043_584_856_3, 0.652_145_154_862_546_1),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
];
/// People on a square kilometre of settled land all round in its middle, how fast they grow fewer
/// outwards (a city of two millions: Clark 1951 has an exponential fall, the numbers are ours), and how
/// far it is followed.
const LAND_PER_KM2: f64 = 2000.0;
const LAND_FALLS_KM: f64 = 12.0;
const LAND_KM: f64 = 100.0;
/// The widest gap in it, kilometres.
const WIDEST_GAP_KM: f64 = 50.0;
/// Rings of the land; the nearest reaches to this distance.
const LAND_RINGS: usize = 60;
const NEAREST_RING_KM: f64 = 0.1;
/// From kilometres to metres: per square.
const PER_M2: f64 = 1e-6;

/// Radius of the disc that so many people live on, kilometres: of an area of `P^(3/4) / 350` square
/// miles, Stewart & Warntz 1958 (recalled): 1.5 km for ten thousand, 8.6 km for a million.
pub(super) fn radius_km(population: f64) -> f64 {
    (population.max(1.0).powf(0.75) / 350.0 * SQUARE_MILE_KM2 / PI).sqrt()
}

/// Artificial over natural light at 45 degrees towards a town, after Walker 1977; within a town as at
/// its edge.
pub(super) fn walker(population: f64, distance_km: f64) -> f64 {
    0.01 * population * distance_km.max(radius_km(population)).powf(-2.5)
}

/// An arc of lamps around the observer.
struct Ring {
    lumens: f64,
    distance_km: f64,
    /// Azimuth of its middle and half its width, radians.
    azimuth: f64,
    half_width: f64,
}

/// The disc of a town in arcs that together have all its lamps.
fn rings(town: &Town, is_faint: bool) -> Vec<Ring> {
    let (d, r) = (town.distance_km, radius_km(town.population));
    let lumens = LUMENS_A_HEAD * town.population;
    let azimuth = town.bearing.rad();
    // Half the angle at which the disc is seen at a distance.
    let half_angle = |s: f64| {
        if s + d <= r {
            return PI;
        }
        ((s * s + d * d - r * r) / (2.0 * s * d)).clamp(-1.0, 1.0).acos()
    };
    if is_faint && d > 2.0 * r {
        // An arc as wide as a square of the disc's area.
        let half_width = 0.5 * PI.sqrt() * r / d;
        return vec![Ring { lumens, distance_km: d, azimuth, half_width }];
    }
    let rule: &[(f64, f64)] = if d < 4.0 * r { &GAUSS_4 } else { &GAUSS_2 };
    let mut pieces = vec![((d - r).abs(), d + r)];
    if d < r {
        pieces.push((0.0, r - d));
    } else if d < 3.0 * r {
        pieces = vec![(d - r, d), (d, d + r)];
    }
    let mut rings: Vec<Ring> = pieces
        .iter()
        .flat_map(|&(from, to)| {
            rule.iter().map(move |&(node, weight)| {
                let s = 0.5 * (from + to) + 0.5 * (to - from) * node;
                let half_width = half_angle(s);
                let area = weight * 0.5 * (to - from) * 2.0 * half_width * s;
                Ring { lumens: area, distance_km: s, azimuth, half_width }
            })
        })
        .collect();
    let area: f64 = rings.iter().map(|ring| ring.lumens).sum();
    rings.iter_mut().for_each(|ring| ring.lumens *= lumens / area);
    rings
}

/// The sky of towns; none if nobody lives there.
pub(super) fn of_towns(towns: &[Town], light: &GroundLight) -> Option<Dome> {
    let glow = |town: &Town| walker(town.population, town.distance_km);
    let all: f64 = towns.iter().map(glow).sum();
    let is_seen = |town: &&Town| town.population > 0.0;
    let rings: Vec<Ring> = towns
        .iter()
        .filter(is_seen)
        .flat_map(|town| rings(town, glow(town) < FAINT * all))
        .collect();
    if rings.is_empty() {
        return None;
    }
    // No arc is narrower than a column: all of its light falls on some.
    let narrowest = PI / COLUMNS as f64;
    let rows: Vec<Vec<NodeLight>> = (0..ALTITUDES_DEG.len())
        .into_par_iter()
        .map(|altitude| {
            let mut row = vec![[0.0; SKY_NODES_NM.len()]; COLUMNS];
            for ring in &rings {
                let arc = light.arc(altitude, ring.distance_km);
                let half = ring.half_width.max(narrowest);
                let scale = ring.lumens * PER_M2;
                for (column, sum) in row.iter_mut().enumerate() {
                    // Light is the same on both sides of the town.
                    let turn = (azimuth_of(column) - ring.azimuth).rem_euclid(2.0 * PI);
                    let apart = turn.min(2.0 * PI - turn);
                    let mean = arc.mean([apart - half, apart + half]);
                    sum.iter_mut().zip(mean).for_each(|(sum, mean)| *sum += scale * mean.max(0.0));
                }
            }
            row
        })
        .collect();
    Some(Dome::new(&rows))
}

/// The sky over a gap in settled land, as wide as gives the zenith an artificial luminance, cd/m2;
/// scaled where none does.
pub(super) fn all_round(
    light: &GroundLight,
    zenith_cd_m2: f64,
    luminance: impl Fn(&NodeLight) -> f64,
) -> Dome {
    let zenith = ALTITUDES_DEG.len() - 1;
    let edge = |ring: usize| {
        if ring == 0 {
            return 0.0;
        }
        let share = (ring - 1) as f64 / (LAND_RINGS - 1) as f64;
        NEAREST_RING_KM * (LAND_KM / NEAREST_RING_KM).powf(share)
    };
    // Lumens of a ring, and the distance that stands for it.
    let ring = |ring: usize| {
        let (from, to) = (edge(ring), edge(ring + 1));
        let distance_km = (0.5 * (from * from + to * to)).sqrt();
        let per_km2 = LAND_PER_KM2 * (-distance_km / LAND_FALLS_KM).exp();
        let people = per_km2 * PI * (to * to - from * from);
        (LUMENS_A_HEAD * people * PER_M2, distance_km)
    };
    let of_ring = |altitude: usize, lumens: f64, distance_km: f64| {
        light.mean(altitude, distance_km, [0.0, PI]).map(|value| lumens * value)
    };
    // From far to near until the zenith is bright enough.
    let mut weights = [0.0; LAND_RINGS];
    let mut bright = 0.0;
    for i in (0..LAND_RINGS).rev() {
        let (lumens, distance_km) = ring(i);
        let more = luminance(&of_ring(zenith, lumens, distance_km));
        let is_beyond = edge(i) >= WIDEST_GAP_KM;
        let missing = zenith_cd_m2 - bright;
        if !is_beyond && more > missing {
            weights[i] = (missing / more).max(0.0);
            break;
        }
        weights[i] = 1.0;
        bright += more;
    }
    // Luminance is not quite additive over spectra rebuilt from nodes: the last word is the sum's.
    let sum = |altitude: usize| {
        let mut nodes = [0.0; SKY_NODES_NM.len()];
        for (i, weight) in weights.iter().enumerate().filter(|(_, weight)| **weight > 0.0) {
            let (lumens, distance_km) = ring(i);
            let of_ring = of_ring(altitude, lumens * weight, distance_km);
            nodes.iter_mut().zip(of_ring).for_each(|(sum, value)| *sum += value);
        }
        nodes
    };
    let scale = zenith_cd_m2 / luminance(&sum(zenith)).max(f64::MIN_POSITIVE);
    let rows: Vec<Vec<NodeLight>> = (0..ALTITUDES_DEG.len())
        .map(|altitude| vec![sum(altitude).map(|value| value * scale)])
        .collect();
    Dome::new(&rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rings_hold_all_lamps_around_the_middle_of_the_town() {
        for (population, distance_km) in
            [(1e6, 0.0), (1e6, 3.0), (1e6, 8.0), (1e5, 12.0), (1e4, 50.0)]
        {
            let bearing = Angle::from_deg(40.0);
            let town = Town { name: String::new(), population, bearing, distance_km };
            for is_faint in [false, true] {
                let rings = rings(&town, is_faint);
                let sum = |of: fn(&Ring) -> f64| {
                    rings.iter().map(|ring| ring.lumens * of(ring)).sum::<f64>()
                };
                let lumens = sum(|_| 1.0);
                assert!((lumens / population / LUMENS_A_HEAD - 1.0).abs() < 1e-9);
                // The middle of an arc lies at a part sin(w) / w of its distance.
                let middle_km = sum(|ring| {
                    let w = ring.half_width.max(1e-9);
                    ring.distance_km * w.sin() / w
                }) / lumens;
                let r = radius_km(population);
                assert!((middle_km - distance_km).abs() < 0.03 * r + 0.02 * distance_km);
            }
        }
        assert!((radius_km(1e6) - 8.6).abs() < 0.1 && (radius_km(1e4) - 1.5).abs() < 0.05);
    }
}
