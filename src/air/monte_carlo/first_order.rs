//! Light scattered once, by quadrature along the line of sight.
//!
//! The line is cut where it crosses shells and where the shadow of the Earth begins, which on a
//! straight line is the root of a quadratic; each piece is cut again until it is short and thin,
//! then integrated with four points (Gauss-Legendre). Columns are exact.

use glam::DVec3;

use crate::air::scattering::lanes::LANES;

use super::matter::Light;
use super::shells::Path;
use super::walk::Scene;

/// No step is longer, kilometres.
const LONGEST_KM: f64 = 5.0;
/// No step is deeper.
const DEEPEST: f64 = 0.25;

/// Nodes and weights of Gauss-Legendre quadrature from 0 to 1.
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Radiance of light scattered once by air, or sent once by the ground.
pub(super) fn first_order(scene: &Scene, eye: DVec3, dir: DVec3, sun: DVec3) -> Light {
    let (shells, matter) = (scene.shells, scene.matter);
    let r = eye.length();
    let mut path = Path::default();
    shells.cut(r, eye.dot(dir) / r, &mut path);
    let mut cuts: Vec<f64> = (0..=path.pieces()).map(|mark| path.distance_km(mark)).collect();
    let length = path.length_km();
    cuts.extend(shadow_edges(eye, dir, sun, shells.ground_km()).filter(|&s| s > 0.0 && s < length));
    cuts.sort_by(f64::total_cmp);
    let nu = dir.dot(sun);
    let mut light = [0.0; LANES];
    for pair in cuts.windows(2) {
        let width = pair[1] - pair[0];
        if width <= 0.0 {
            continue;
        }
        let piece = path.piece_at(0.5 * (pair[0] + pair[1]));
        let deepest = {
            let near = matter.depth(&path.columns_at(shells, piece, pair[0]));
            let far = matter.depth(&path.columns_at(shells, piece, pair[1]));
            near.iter().zip(far).fold(0.0, |most: f64, (near, far)| most.max(far - near))
        };
        let steps = (width / LONGEST_KM).max(deepest / DEEPEST).ceil().max(1.0);
        for step in 0..steps as usize {
            for (node, share) in GAUSS {
                let s = pair[0] + width * (step as f64 + node) / steps;
                let at = eye + dir * s;
                let Some(beam) = scene.beam(at, sun) else { continue };
                let seen = matter.transmittance(&path.columns_at(shells, piece, s));
                let density = shells.density(path.layer(piece), at.length());
                let scattered = matter.scattered(&matter.scatter(&density), nu);
                for i in 0..matter.count {
                    light[i] += share * width / steps * scattered[i] * seen[i] * beam[i];
                }
            }
        }
    }
    let up = (eye + dir * length).normalize();
    if path.hits_ground()
        && sun.dot(up) > 0.0
        && let Some(beam) = scene.beam(up * shells.ground_km(), sun)
    {
        let seen = matter.transmittance(path.all_columns());
        for i in 0..matter.count {
            let lambert = matter.ground_albedo / std::f64::consts::PI * sun.dot(up);
            light[i] += seen[i] * lambert * beam[i];
        }
    }
    light
}

/// Distances at which the line of sight crosses the edge of the Earth's shadow or the plane where
/// the source stands level.
fn shadow_edges(eye: DVec3, dir: DVec3, sun: DVec3, ground_km: f64) -> impl Iterator<Item = f64> {
    // The distance of a point from the axis of the shadow is |point x sun|.
    let (from, per_km) = (eye.cross(sun), dir.cross(sun));
    let (a, b) = (per_km.length_squared(), from.dot(per_km));
    let c = from.length_squared() - ground_km * ground_km;
    let root = (b * b - a * c).max(0.0).sqrt();
    let level = -eye.dot(sun) / dir.dot(sun);
    [(-b - root) / a, (-b + root) / a, level].into_iter().filter(|s| s.is_finite())
}
