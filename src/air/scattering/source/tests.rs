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
            for i in 0..2000 {
                let mu = (oracle.edge + radius.rad()).cos()
                    + (i as f64 / 2000.0).powi(2) * (1.0 - (oracle.edge + radius.rad()).cos());
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

/// Rays followed one by one.
struct Oracle<'a> {
    shells: &'a shells::Shells,
    optics: &'a Optics,
    h: f64,
    lowest: f64,
    edge: f64,
}
impl<'a> Oracle<'a> {
    fn new(beams: &'a Beams, optics: &'a Optics, h: f64) -> Self {
        let shells = beams.shells();
        let x = shells.level_at(h).x_km;
        let g = shells.ground().x_km;
        let lowest = g.atan2(-((x - g) * (x + g)).max(0.0).sqrt());
        Oracle { shells, optics, h, lowest, edge: shells.beam_at(h, lowest).true_zenith }
    }
    fn point(&self, tt: f64) -> [f64; 8] {
        if tt > self.edge {
            return [0.0; 8];
        }
        let (mut a, mut b) = (0.0, self.lowest);
        for _ in 0..45 {
            let m = 0.5 * (a + b);
            if self.shells.beam_at(self.h, m).true_zenith > tt { b = m } else { a = m }
        }
        let beam = self.shells.beam_at(self.h, 0.5 * (a + b));
        std::array::from_fn(|i| {
            let tau: f64 =
                (0..SPECIES).map(|k| beam.columns[k] * self.optics.extinction[k][i]).sum();
            (-tau).exp() * beam.divergence
        })
    }
    fn irradiance(&self, tt: f64, radius: f64) -> [f64; 8] {
        if radius == 0.0 {
            return self.point(tt);
        }
        self.point(tt)
    }
}
