//! Table, rays and spreading against formulas, against each other, and against the refraction of
//! `air::refraction`.

use std::ops::Range;

use super::super::columns;
use super::super::lanes::LANES;
use super::super::profile::{EARTH_RADIUS_KM, Profile, TOP_KM};
use super::shells::{Beam, Shells};
use super::*;
use crate::air::Atmosphere;
use crate::air::refraction::{ObserverAir, Refraction};

const REFRACTIVITY: f64 = 2.777e-4;
const WAVELENGTHS_NM: [f64; LANES] = [385.0, 400.0, 450.0, 505.0, 545.0, 595.0, 635.0, 665.0];
/// Between levels and on them.
const HEIGHTS_KM: [f64; 9] = [0.0, 0.001, 0.37, 1.9, 8.1, 14.2, 33.3, 77.7, TOP_KM];

fn sun() -> Angle {
    Angle::from_arcmin(16.0)
}

fn default_air() -> (Profile, Optics) {
    let air = Atmosphere::default();
    (Profile::new(&air, 0.0), Optics::new(&air, 1.0, &WAVELENGTHS_NM))
}

/// Cosines from dark to the zenith, dense at the edge of the shadow.
fn cosines(from: f64) -> impl Iterator<Item = f64> {
    (0..400).map(move |i| from + (1.0 - from) * (f64::from(i) / 400.0).powi(3))
}

/// Largest relative error above `floor`, largest absolute error below.
fn compare(worst: &mut [f64; 2], floor: f64, got: Lanes, want: [f64; LANES]) {
    for (got, want) in got.0.into_iter().zip(want) {
        let got = f64::from(got);
        if want > floor {
            worst[0] = worst[0].max((got / want - 1.0).abs());
        } else {
            worst[1] = worst[1].max((got - want).abs());
        }
    }
}

#[test]
fn straight_rays_of_a_point_follow_the_formula() {
    let (profile, optics) = default_air();
    let table = SourceTable::new(&Beams::new(&profile, 0.0, 0.0, Angle::ZERO), &optics);
    let mut worst = [0.0; 2];
    for height_km in HEIGHTS_KM {
        let row = table.row(height_km);
        let edge = (std::f64::consts::FRAC_PI_2
            + (EARTH_RADIUS_KM / (EARTH_RADIUS_KM + height_km)).acos())
        .cos();
        for mu in cosines(edge + 1e-7) {
            let columns = columns::to_space(&profile, height_km, mu).unwrap();
            let want = std::array::from_fn(|i| {
                let parts = columns.iter().zip(&optics.extinction);
                (-parts.map(|(n, e)| n * e[i]).sum::<f64>()).exp()
            });
            compare(&mut worst, 1e-3, table.irradiance(&row, mu), want);
        }
        assert_eq!(table.irradiance(&row, edge - 1e-6), Lanes::ZERO, "{height_km} km");
    }
    println!("straight: {worst:?}");
    assert!(worst[0] < 1.5e-2 && worst[1] < 2e-5, "{worst:?}");
}

/// Rays that come to one height, many and close.
struct Followed {
    beams: Vec<Beam>,
}

impl Followed {
    fn to(shells: &Shells, height_km: f64) -> Followed {
        const RAYS: usize = 3000;
        let x_km = shells.level_at(height_km).x_km;
        let ground_x_km = shells.ground().x_km;
        let u_km = ((x_km - ground_x_km) * (x_km + ground_x_km)).max(0.0).sqrt();
        let lowest = ground_x_km.atan2(-u_km);
        let part = |i: usize| 1.0 - (i as f64 / RAYS as f64).powi(2);
        let beams = (0..=RAYS).rev().map(|i| shells.beam_at(height_km, lowest * part(i))).collect();
        Followed { beams }
    }

    fn edge(&self) -> f64 {
        self.beams[self.beams.len() - 1].true_zenith
    }

    fn point(&self, optics: &Optics, true_zenith: f64) -> [f64; LANES] {
        if true_zenith > self.edge() {
            return [0.0; LANES];
        }
        let above = self.beams.partition_point(|b| b.true_zenith < true_zenith);
        let above = above.clamp(1, self.beams.len() - 1);
        let (a, b) = (&self.beams[above - 1], &self.beams[above]);
        let t = (true_zenith - a.true_zenith) / (b.true_zenith - a.true_zenith);
        std::array::from_fn(|i| {
            let depth = |beam: &Beam| {
                let parts = beam.columns.iter().zip(&optics.extinction);
                parts.map(|(n, e)| n * e[i]).sum::<f64>() - beam.divergence.ln()
            };
            (-(depth(a) * (1.0 - t) + depth(b) * t)).exp()
        })
    }

    fn disc(&self, optics: &Optics, true_zenith: f64, radius: f64) -> [f64; LANES] {
        const CHORDS: usize = 200;
        // What the ground leaves of the disc, from its upper limb down.
        let lowest = ((self.edge() - true_zenith) / radius).clamp(-1.0, 1.0);
        let step = (1.0 + lowest) / CHORDS as f64;
        let mut sum = [0.0; LANES];
        for i in 0..CHORDS {
            let x = -1.0 + (i as f64 + 0.5) * step;
            let half = (1.0 - x * x).sqrt();
            // Int (1 - u + u sqrt(1 - x^2 - y^2)) dy over the chord; over the disc, pi (1 - u/3).
            let chord =
                (1.0 - LIMB_DARKENING) * 2.0 * half + LIMB_DARKENING * PI / 2.0 * half * half;
            let share = chord * step / (PI * (1.0 - LIMB_DARKENING / 3.0));
            let point = self.point(optics, (true_zenith + radius * x).abs());
            sum.iter_mut().zip(point).for_each(|(s, f)| *s += share * f);
        }
        sum
    }
}

#[test]
fn bent_rays_of_a_disc_follow_rays_followed_one_by_one() {
    let (profile, optics) = default_air();
    for ground_km in [0.0, 2.7] {
        let beams = Beams::new(&profile, ground_km, REFRACTIVITY, sun());
        let table = SourceTable::new(&beams, &optics);
        let fine = Shells::new(&profile, ground_km, REFRACTIVITY, 4);
        let (mut worst, mut worst_bright) = ([0.0; 2], [0.0; 2]);
        for height_km in HEIGHTS_KM.map(|h| ground_km + h * (1.0 - ground_km / TOP_KM)) {
            let row = table.row(height_km);
            let followed = Followed::to(&fine, height_km);
            for mu in cosines((followed.edge() + sun().rad()).cos()) {
                let want = followed.disc(&optics, mu.acos(), sun().rad());
                compare(&mut worst, 1e-3, table.irradiance(&row, mu), want);
                compare(&mut worst_bright, 1e-2, table.irradiance(&row, mu), want);
            }
        }
        println!("disc, ground at {ground_km} km: {worst:?} {worst_bright:?}");
        assert!(worst[0] < 2e-2 && worst_bright[0] < 8e-3, "{worst:?} {worst_bright:?}");
        assert!(worst[1] < 1e-4, "{worst:?}");
    }
}

/// Against differences of the total bending of rays 20 m apart, integrated in 400 000 steps through cubics
/// in the logarithm of the density, by a program of its own. A thin screen gives
/// `1 / (1 + L w / H) = 0.25` at the top of the air.
#[test]
fn grazing_light_is_diluted() {
    let (profile, _) = default_air();
    let shells = Shells::new(&profile, 0.0, REFRACTIVITY, 1);
    for (height_km, want) in [(0.0, 0.83), (31.0, 0.440), (98.0, 0.302), (TOP_KM, 0.280)] {
        let grazing = Followed::to(&shells, height_km).beams.pop().unwrap();
        println!("divergence at {height_km} km: {:.4}", grazing.divergence);
        assert!((grazing.divergence / want - 1.0).abs() < 0.01, "{height_km} km: {grazing:?}");
    }
    // Overhead nothing is spread.
    let overhead = shells.beam_at(0.0, 0.0);
    assert!((overhead.divergence - 1.0).abs() < 1e-5, "{overhead:?}");
}

/// Light that air takes nothing from is only spread: what crosses a level between two rays is what came
/// in between them, `(p_2^2 - p_1^2) / 2`.
#[test]
fn spreading_conserves_energy() {
    let (profile, _) = default_air();
    let shells = Shells::new(&profile, 0.0, REFRACTIVITY, 1);
    for height_km in [0.0, 3.0, 31.0, 80.0] {
        let followed = Followed::to(&shells, height_km).beams;
        let r_km = EARTH_RADIUS_KM + height_km;
        let x_km = shells.level_at(height_km).x_km;
        let through = |b: &Beam| {
            r_km * r_km * b.divergence * b.apparent_zenith.cos().abs() * b.true_zenith.sin()
        };
        for part in [0..followed.len() - 1, followed.len() - 300..followed.len() - 1] {
            let Range { start, end } = part.clone();
            let pairs = followed[start..=end].windows(2);
            let got: f64 = pairs
                .map(|b| {
                    0.5 * (through(&b[0]) + through(&b[1])) * (b[1].true_zenith - b[0].true_zenith)
                })
                .sum();
            let p2 = |b: &Beam| (x_km * b.apparent_zenith.sin()).powi(2);
            let level = x_km * x_km;
            let (first, last) = (&followed[start], &followed[end]);
            let is_past_level = first.apparent_zenith > FRAC_PI_2;
            let want = if is_past_level {
                0.5 * (p2(first) - p2(last))
            } else {
                0.5 * (level - p2(first)) + 0.5 * (level - p2(last))
            };
            println!("{height_km} km {part:?}: {got} {want}");
            assert!((got / want - 1.0).abs() < 2e-3, "{height_km} km, {part:?}: {got}, not {want}");
        }
    }
}

#[test]
fn refraction_is_that_of_traced_rays() {
    let (profile, _) = default_air();
    // Ciddor's dry air at 550 nm.
    let observer = |height_m: f64| ObserverAir {
        height_m,
        pressure_mbar: crate::air::standard::standard_pressure_mbar(height_m),
        temperature_c: 15.0 - 6.5e-3 * height_m,
        relative_humidity: 0.0,
        wavelength_nm: 550.0,
    };
    for height_m in [0.0, 2000.0f64] {
        let traced = Refraction::traced(&observer(height_m)).unwrap();
        let ground_km = height_m / 1000.0;
        let beams = Beams::new(&profile, ground_km, 2.778e-4, Angle::ZERO);
        for (apparent_deg, most_arcsec) in [
            (0.0, 8.0),
            (0.5, 4.0),
            (2.0, 1.5),
            (5.0, 0.5),
            (20.0, 0.1),
            (60.0, 0.03),
            (90.0, 0.01),
        ] {
            let apparent = Angle::from_deg(apparent_deg);
            let want = traced.at_apparent_altitude(apparent);
            let got = beams.refraction(ground_km, (apparent - want).sin());
            let off = (got - want).arcsec();
            println!("{height_m} m {apparent_deg}: {:.3}, off {off:.3}", want.arcsec());
            assert!(off.abs() < most_arcsec, "{height_m} m, {apparent_deg} deg: {off} arcsec");
        }
        // Below the horizon it stays as it is there.
        let below = beams.refraction(ground_km, -0.5);
        assert!((below - beams.refraction(ground_km, -0.02)).arcsec().abs() < 1e-3);
    }
    let straight = Beams::new(&profile, 0.0, 0.0, Angle::ZERO);
    assert_eq!(straight.refraction(0.0, 0.01), Angle::ZERO);
}

/// First order at the zenith, refracted over straight, 550 nm, molecules and ozone, light not spread:
/// sasktran2 (`refraction_effect_single_scatter.csv` of the reference data).
#[test]
fn bent_columns_are_those_of_another_program() {
    let air = Atmosphere::molecular();
    let profile = Profile::new(&air, 0.0);
    let optics = Optics::new(&air, 1.0, &[550.0]);
    let beams = Beams::new(&profile, 0.0, REFRACTIVITY, Angle::ZERO);
    let depth = |columns: &[f64]| -> f64 {
        columns.iter().zip(&optics.extinction).map(|(n, e)| n * e[0]).sum()
    };
    let heights_km = beams.heights_km();
    for (elevation_deg, want) in [
        (5.0f64, 1.0043),
        (0.0, 1.0615),
        (-1.0, 1.1212),
        (-2.0, 1.2056),
        (-3.0, 1.3233),
        (-4.0, 1.4512),
        (-5.0, 1.5219),
        (-6.0, 1.5576),
    ] {
        let zenith = (90.0 - elevation_deg).to_radians();
        let mut bent = Vec::new();
        let mut straight = Vec::new();
        for (level, &height_km) in heights_km.iter().enumerate() {
            let up = columns::to_space(&profile, 0.0, 1.0).unwrap();
            let above = columns::to_space(&profile, height_km, 1.0).unwrap();
            let view: Vec<f64> = up.iter().zip(above).map(|(a, b)| a - b).collect();
            let scattered = profile.density(height_km)[0] * (-depth(&view)).exp();
            let source = PointSource { nodes: beams.nodes(level), optics: &optics };
            let light = if zenith < source.edge() {
                (-depth(&source.values(zenith)[..SPECIES])).exp()
            } else {
                0.0
            };
            bent.push(scattered * light);
            let direct = columns::to_space(&profile, height_km, zenith.cos());
            straight.push(scattered * direct.map_or(0.0, |c| (-depth(&c)).exp()));
        }
        let sum = |of: &[f64]| -> f64 {
            let steps = heights_km.windows(2).zip(of.windows(2));
            steps.map(|(h, f)| 0.5 * (f[0] + f[1]) * (h[1] - h[0])).sum()
        };
        let ratio = sum(&bent) / sum(&straight);
        println!("{elevation_deg}: {ratio:.4} {want}");
        assert!((ratio / want - 1.0).abs() < 6e-3, "{elevation_deg} deg: {ratio}, not {want}");
    }
}

/// A disc blurs the edge of the shadow; it makes no light and loses none.
#[test]
fn the_disc_moves_light_but_keeps_it() {
    let (profile, optics) = default_air();
    for height_km in [0.0, 8.0, 40.0] {
        let sums = [Angle::ZERO, sun()].map(|radius| {
            let beams = Beams::new(&profile, 0.0, REFRACTIVITY, radius);
            let table = SourceTable::new(&beams, &optics);
            let row = table.row(height_km);
            // From full shadow to 20 degrees above the horizontal, in steps of 0.001 degree.
            let zeniths = (0..28_000).map(|i| (70.0 + 0.001 * (f64::from(i) + 0.5)).to_radians());
            let lights = zeniths.map(|zenith| table.irradiance(&row, zenith.cos()));
            lights.fold([0.0; LANES], |mut sum, light| {
                sum.iter_mut().zip(light.0).for_each(|(s, f)| *s += f64::from(f));
                sum
            })
        });
        for (point, disc) in sums[0].into_iter().zip(sums[1]) {
            println!("{height_km}: {}", disc / point - 1.0);
            assert!((disc / point - 1.0).abs() < 1e-3, "{height_km} km: {point} {disc}");
        }
    }
}

/// Any air and any question has an answer between darkness and a mirage.
#[test]
fn nothing_breaks_in_air_that_cannot_be() {
    let (profile, optics) = default_air();
    for refractivity in [0.0, 2.777e-4, 1e-3, 1e-2] {
        for ground_km in [-0.4, 0.0, 8.999, 9.0] {
            let beams = Beams::new(&profile, ground_km, refractivity, sun());
            let table = SourceTable::new(&beams, &optics);
            for height_km in [-1.0, 0.0, 9.0, 60.0, TOP_KM, 500.0] {
                let row = table.row(height_km);
                for mu in [-1.0, -0.2, -0.1, -0.01, 0.0, 0.01, 0.3, 1.0] {
                    let light = table.irradiance(&row, mu);
                    let is_sane = |f: f32| (0.0..30.0).contains(&f);
                    assert!(
                        light.0.into_iter().all(is_sane),
                        "{refractivity}, {height_km}: {light:?}"
                    );
                    assert!(beams.refraction(height_km, mu).rad().is_finite());
                }
            }
        }
    }
}
