use super::super::columns;
use super::super::profile::{Profile, TOP_KM};
use super::*;
use crate::air::Atmosphere;
use std::time::Instant;

const REFRACTIVITY: f64 = 2.777e-4;
const SUN: f64 = 0.2666;

#[test]
fn explore() {
    let air = Atmosphere::default();
    let profile = Profile::new(&air);
    let optics = Optics::new(&air, 1.0, &[385.0, 400.0, 450.0, 505.0, 545.0, 595.0, 635.0, 665.0]);
    for (n, radius) in [(0.0, 0.0), (REFRACTIVITY, 0.0), (REFRACTIVITY, SUN)] {
        let radius = Angle::from_deg(radius);
        for _ in 0..3 {
            let t = Instant::now();
            let beams = Beams::new(&profile, 0.0, n, radius);
            let t1 = t.elapsed();
            let table = SourceTable::new(&beams, &optics);
            println!(
                "beams {t1:?}, table {:?}, levels {}, nodes {}",
                t.elapsed() - t1,
                beams.heights_km().len(),
                beams.nodes(100).len()
            );
        }
        let beams = Beams::new(&profile, 0.0, n, radius);
        let table = SourceTable::new(&beams, &optics);
        let fine = Beams::finer(&profile, 0.0, n, radius, 4);
        for h in [0.0, 0.001, 0.03, 0.37, 1.9, 8.1, 14.2, 33.3, 50.5, 77.7, 98.0, 119.5] {
            let row = table.row(h);
            let oracle = Oracle::new(&fine, &optics, h);
            let mut worst = [(0.0f64, 0.0, 0.0); 3];
            for i in 0..1000 {
                let mu = (oracle.edge + radius.rad()).cos()
                    + (i as f64 / 1000.0).powi(3) * (1.0 - (oracle.edge + radius.rad()).cos());
                let want = oracle.irradiance(mu.acos(), radius.rad());
                let got = table.irradiance(&row, mu);
                for lane in 0..8 {
                    let (g, w) = (f64::from(got.0[lane]), want[lane]);
                    let (e, k) = if w > 1e-3 { (g / w - 1.0, 0) } else { (g - w, 1) };
                    if e.abs() > worst[k].0.abs() {
                        worst[k] = (e, mu.acos().to_degrees(), w);
                    }
                    if w > 1e-2 && (g / w - 1.0).abs() > worst[2].0.abs() {
                        worst[2] = (g / w - 1.0, mu.acos().to_degrees(), w);
                    }
                }
            }
            println!(
                "{n} {h} edge {:.4}: rel {:.5} at {:.3} ({:.4}); abs {:.6} at {:.3}; >1e-2 rel {:.5} at {:.3} ({:.4})",
                oracle.edge.to_degrees(),
                worst[0].0,
                worst[0].1,
                worst[0].2,
                worst[1].0,
                worst[1].1,
                worst[2].0,
                worst[2].1,
                worst[2].2
            );
        }
        // speed
        let rows: Vec<SourceRow> = (0..64).map(|i| table.row(0.9 + 1.7 * i as f64)).collect();
        let mus: Vec<f64> = (0..1000).map(|i| -0.15 + 0.0007 * ((i * 379) % 1000) as f64).collect();
        for _ in 0..3 {
            let t = Instant::now();
            let mut sum = Lanes::ZERO;
            for row in &rows {
                for mu in &mus {
                    sum += table.irradiance(row, *mu);
                }
            }
            println!("{:.2} ns {}", t.elapsed().as_nanos() as f64 / 64e3, sum.0[0]);
            let t = Instant::now();
            let mut sum = Lanes::ZERO;
            for row in &rows {
                for k in 0..1000 {
                    sum += table.irradiance(row, 0.5 - 0.0006 * k as f64);
                }
            }
            println!("  sweep {:.2} ns {}", t.elapsed().as_nanos() as f64 / 64e3, sum.0[0]);
        }
    }
}

/// Rays followed to one height, many.
struct Oracle<'a> {
    optics: &'a Optics,
    beams: Vec<shells::Beam>,
    edge: f64,
}
impl<'a> Oracle<'a> {
    fn new(beams: &Beams, optics: &'a Optics, h: f64) -> Self {
        let shells = beams.shells();
        let x = shells.level_at(h).x_km;
        let g = shells.ground().x_km;
        let lowest = g.atan2(-((x - g) * (x + g)).max(0.0).sqrt());
        let beams: Vec<_> = (0..=4000)
            .rev()
            .map(|i| shells.beam_at(h, lowest * (1.0 - (i as f64 / 4000.0).powi(2))))
            .collect();
        Oracle { optics, edge: beams[4000].true_zenith, beams }
    }
    fn point(&self, tt: f64) -> [f64; 8] {
        if tt > self.edge {
            return [0.0; 8];
        }
        let i = self.beams.partition_point(|b| b.true_zenith < tt).clamp(1, 4000);
        let (a, b) = (&self.beams[i - 1], &self.beams[i]);
        let t = (tt - a.true_zenith) / (b.true_zenith - a.true_zenith);
        std::array::from_fn(|i| {
            let ln = |b: &shells::Beam| {
                b.divergence.ln()
                    - (0..SPECIES).map(|k| b.columns[k] * self.optics.extinction[k][i]).sum::<f64>()
            };
            (ln(a) + (ln(b) - ln(a)) * t).exp()
        })
    }
    fn irradiance(&self, tt: f64, radius: f64) -> [f64; 8] {
        if radius == 0.0 {
            return self.point(tt);
        }
        let (mut sum, mut all) = ([0.0; 8], 0.0);
        for i in 0..200 {
            let x = (i as f64 + 0.5) / 100.0 - 1.0;
            let c = (1.0 - x * x).sqrt();
            let w = 2.0 * 0.4 * c + 0.6 * PI / 2.0 * c * c;
            all += w;
            let f = self.point((tt + radius * x).abs());
            for i in 0..8 {
                sum[i] += w * f[i];
            }
        }
        sum.map(|s| s / all)
    }
}

#[test]
fn explore_divergence() {
    let profile = Profile::new(&Atmosphere::default());
    let shells: Vec<_> =
        [1, 2, 4, 8].map(|f| shells::Shells::new(&profile, 0.0, REFRACTIVITY, f)).into();
    for i in 0..200 {
        let z = 0.02 + 0.2 * i as f64;
        print!("{z:.2}");
        for s in &shells {
            let p = s.level_at(z).x_km;
            let x = s.level_at(98.0).x_km;
            let b = s.beam_at(98.0, p.atan2(-((x - p) * (x + p)).sqrt()));
            print!(" {:.5} {:.5}", b.divergence, b.true_zenith.to_degrees());
        }
        println!();
    }
}
