//! The Moon as a globe: its relief, the shadows of its mountains, and how light leaves it.
//!
//! A large disc is drawn in two steps. First the globe, a mesh displaced by the measured relief, is
//! drawn as it would look without air, onto a square picture of its own: where its mountains stand on
//! the limb, what the Sun and the Earth light, relative to the mean of the disc. Then the disc is drawn
//! through the air with that picture as its surface. The first step knows nothing of the air, the
//! second nothing of the Moon.
//!
//! *Shadows.* Sunlight is parallel but for the size of the Sun: a point is in shadow if anything between
//! it and the Sun stands higher over the axis from the Moon to the Sun than the point does. All that
//! can hide the Sun from a point lies on its meridian through the subsolar point, so each such meridian
//! is walked outwards once. How much of the Sun's disc is hidden follows from how high the highest ridge
//! stands against its centre.
//!
//! *Accuracy.* The relief has 8 samples a degree, 3.8 km: peaks are lower than in truth by what lies
//! between samples. Ridges more than 12 degrees away are left out.

use std::sync::Arc;

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use crate::catalog::{MoonMap, MoonRelief};
use crate::light::earth_shadow::{EarthShadow, ShadowedMoon};
use crate::light::moon::hapke::Facets;
use crate::light::moon::surface::PhaseCell;
use crate::light::moon::{MoonSurface, Reflectance};
use crate::units::{Angle, MOON_RADIUS_KM};

/// The picture of the globe reaches over the mean radius by this share: the highest mountains are 0.6 %.
pub const EXTENT: f64 = 1.01;
/// Colours of the surface: reflectances at 643, 566 and 415 nm; and what the Earth lights.
pub const CHANNELS: usize = 4;
/// Wavelengths of the colours, nanometres.
const COLOURS_NM: [f64; 3] = [643.0, 566.0, 415.0];

/// What the mesh of the globe is made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Globe {
    pub relief: Arc<MoonRelief>,
    pub albedo: Arc<MoonMap>,
    /// Takes axes of the disc (level, up, away from the observer) to the Moon's own.
    pub body_from_disc: DMat3,
    /// Of the observer from the centre, in radii of the Moon.
    pub distance: f64,
    /// Edge of its picture, pixels, and how many of them lie along a pixel of the frame.
    pub picture_px: u32,
    pub fineness: u32,
    pub ground: Arc<Ground>,
    pub shadows: Arc<Shadows>,
    /// The shadow of the Earth, in an eclipse.
    pub shadow: Option<UmbraTable>,
}

/// The shadow of the Earth on the Moon.
#[derive(Debug, Clone, PartialEq)]
pub struct UmbraTable {
    /// Of the Sun and of the Earth from the Moon's centre, in the Moon's own axes and radii.
    pub to_sun: DVec3,
    pub to_earth: DVec3,
    /// Angle between the two, seen from a point, at the last node.
    pub rim: Angle,
    /// What is left of the Sun's light at 643, 566 and 415 nm, from the axis to the rim in even steps, over
    /// the most that is left anywhere on the Moon.
    pub shares: Vec<[f64; 3]>,
}

impl UmbraTable {
    const NODES: usize = 512;

    pub fn of(shadow: &EarthShadow, place: &ShadowedMoon, body_from_horizon: &DMat3) -> UmbraTable {
        let radii = |km: DVec3| *body_from_horizon * km / MOON_RADIUS_KM;
        let [to_sun, to_earth] = place.to_sun_and_earth_km().map(radii);
        let rim = place.distances.outer_rim();
        let share = |offset: Angle| {
            let light = shadow.light_at(offset);
            COLOURS_NM.map(|nm| light.at_nm(nm))
        };
        let most = share(place.offset + place.disc_radius()).into_iter().fold(1e-9, f64::max);
        let node = |node: usize| {
            share(rim * (node as f64 / (UmbraTable::NODES - 1) as f64)).map(|share| share / most)
        };
        UmbraTable { to_sun, to_earth, rim, shares: (0..UmbraTable::NODES).map(node).collect() }
    }
}

/// How the ground sends light back at one phase angle.
#[derive(Debug, Clone, PartialEq)]
pub struct Ground {
    /// Cells across and down, as maps lie.
    pub size: (usize, usize),
    /// Row by row, at 415, 566 and 643 nm.
    pub cells: Vec<[PhaseCell; 3]>,
    /// By the cosine of emission, then of incidence, each at [`Ground::NODES`] nodes in steps of its root.
    pub facets: Vec<Facets>,
}

impl Ground {
    pub const NODES: usize = 64;

    pub fn at_phase(law: Reflectance, surface: &MoonSurface, phase: Angle) -> Ground {
        let cosine = |node: usize| (node as f64 / (Ground::NODES - 1) as f64).powi(2).max(1e-4);
        let nodes = (0..Ground::NODES * Ground::NODES)
            .map(|at| (cosine(at % Ground::NODES), cosine(at / Ground::NODES)));
        match law {
            Reflectance::Hapke => Ground {
                size: surface.size(),
                cells: evened_at_poles(surface.at_phase(phase), surface.size()),
                facets: nodes.map(|(i, e)| Facets::of(i, e, phase)).collect(),
            },
            // The phase is the same all over the disc: what it takes is the same too.
            Reflectance::Jensen => Ground {
                size: (2, 1),
                cells: vec![[PhaseCell { single: 1.0, multiple: 0.0, w: 0.0 }; 3]; 2],
                facets: nodes
                    .map(|(i, e)| Facets { cos_incidence: i, cos_emission: e, shadowing: 1.0 })
                    .collect(),
            },
        }
    }
}

/// Towards the poles the parameters of single places are noise, and beyond 70 degrees there are none:
/// there all longitudes share the mean of those at 60 to 70 degrees.
fn evened_at_poles(
    mut cells: Vec<[PhaseCell; 3]>,
    (width, height): (usize, usize),
) -> Vec<[PhaseCell; 3]> {
    const EVEN_DEG: [f64; 2] = [60.0, 70.0];
    let latitude_deg = |row: usize| 90.0 - 180.0 * (row as f64 + 0.5) / height as f64;
    for north in [true, false] {
        let is_of_cap = |row: usize| (latitude_deg(row) > 0.0) == north;
        let evenness = |row: usize| {
            ((latitude_deg(row).abs() - EVEN_DEG[0]) / (EVEN_DEG[1] - EVEN_DEG[0])).clamp(0.0, 1.0)
        };
        let (mut mean, mut count) = ([PhaseCell::default(); 3], 0.0);
        for row in (0..height).filter(|&row| is_of_cap(row)) {
            if evenness(row) > 0.0 && evenness(row) < 1.0 {
                for cell in &cells[row * width..][..width] {
                    count += 1.0;
                    for (mean, part) in mean.iter_mut().zip(cell) {
                        *mean = mean.towards(part, 1.0 / count);
                    }
                }
            }
        }
        for row in (0..height).filter(|&row| is_of_cap(row)) {
            for cell in &mut cells[row * width..][..width] {
                *cell = std::array::from_fn(|band| cell[band].towards(&mean[band], evenness(row)));
            }
        }
    }
    cells
}

/// How finely the sphere is divided: bands around the point below the observer, and their parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MeshBand {
    /// Angles from the point below the observer, degrees.
    pub from_deg: u32,
    pub to_deg: u32,
    pub rings: u32,
    pub sectors: u32,
}

impl MeshBand {
    pub fn triangles(&self) -> u32 {
        2 * self.rings * self.sectors
    }
}

impl Globe {
    /// The mesh: coarse where a picture shows slopes by their light, fine where they stand on the limb.
    /// No finer than the relief.
    pub fn mesh(&self) -> [MeshBand; 3] {
        let radius_px = 0.5 * f64::from(self.picture_px) / EXTENT;
        let band = |[from_deg, to_deg]: [u32; 2], ring_px: f64, sector_px: f64| {
            let finest = 8 * (to_deg - from_deg);
            let sectors = radius_px * std::f64::consts::TAU / sector_px;
            MeshBand {
                from_deg,
                to_deg,
                rings: ((radius_px / ring_px) as u32).clamp(2, finest),
                sectors: (sectors as u32).clamp(24, 2880),
            }
        };
        [band([0, 75], 16.0, 24.0), band([75, 85], 64.0, 12.0), band([85, 96], 30.0, 4.0)]
    }

    /// How often the relief may be halved and still have a sample for each pixel of the picture.
    pub fn relief_level(&self) -> u32 {
        halvings(self.relief.width, self.picture_px)
    }

    /// The same for the reflectances.
    pub fn albedo_level(&self) -> u32 {
        halvings(self.albedo.width, self.picture_px)
    }
}

/// In the middle of the disc a picture of `px` shows a turn of the globe in `pi px` pixels.
fn halvings(width: usize, px: u32) -> u32 {
    let samples_per_px = width as f64 / (std::f64::consts::PI * f64::from(px));
    samples_per_px.log2().floor().max(0.0) as u32
}

/// The part of the Sun's disc that is seen from the ground near the terminator.
#[derive(Debug, Clone, PartialEq)]
pub struct Shadows {
    /// The frame: two axes across, then towards the Sun, in the Moon's own axes, as columns.
    pub body_from_sun: DMat3,
    pub rows: usize,
    pub columns: usize,
    /// By angle from the subsolar point, [`Shadows::FIRST`] to [`Shadows::LAST`], then by azimuth around it
    /// from the first axis to the second, a turn; 0 to 1.
    pub sunlit: Vec<f32>,
}

impl Shadows {
    pub const FIRST: Angle = Angle::from_deg(52.0);
    pub const LAST: Angle = Angle::from_deg(97.0);
    /// At their finest.
    const ROWS: usize = 361;
    const COLUMNS: usize = 2880;
    /// How far ridges are looked for.
    const REACH: Angle = Angle::from_deg(12.0);

    /// For the Sun in a direction in the Moon's own axes, of a given angular radius, as fine as a picture
    /// of the disc with a radius of so many pixels needs them.
    pub fn cast(
        relief: &MoonRelief,
        to_sun: DVec3,
        sun_radius: Angle,
        radius_px: usize,
    ) -> Shadows {
        let coarser = (Shadows::COLUMNS as f64 / std::f64::consts::TAU / radius_px as f64).floor();
        let coarser = (coarser as usize).clamp(1, 40);
        let (rows, columns) = ((Shadows::ROWS - 1) / coarser + 1, Shadows::COLUMNS / coarser);
        let across = to_sun.any_orthonormal_vector();
        let body_from_sun = DMat3::from_cols(across, to_sun.cross(across), to_sun);
        let step = (Shadows::LAST - Shadows::FIRST) / (rows - 1) as f64;
        let reach = (Shadows::REACH.rad() / step.rad()).ceil() as usize;
        let meridians: Vec<Vec<f32>> = (0..columns)
            .into_par_iter()
            .map(|column| {
                let azimuth = std::f64::consts::TAU * column as f64 / columns as f64;
                let (sin_azimuth, cos_azimuth) = azimuth.sin_cos();
                // Ridges before the first row count too.
                let first = Shadows::FIRST - step * reach as f64;
                // Over the axis to the Sun, and along it.
                let points: Vec<[f64; 2]> = (0..rows + reach)
                    .map(|row| {
                        let (sin, cos) = (first + step * row as f64).sin_cos();
                        let normal =
                            body_from_sun * DVec3::new(sin * cos_azimuth, sin * sin_azimuth, cos);
                        let elevation_m = relief.elevation_m(
                            Angle::from_rad(normal.y.atan2(normal.x)),
                            Angle::from_rad(normal.z.clamp(-1.0, 1.0).asin()),
                        );
                        let radius = 1.0 + elevation_m / (1000.0 * MOON_RADIUS_KM);
                        [radius * sin, radius * cos]
                    })
                    .collect();
                (reach..points.len())
                    .map(|row| {
                        let [over, along] = points[row];
                        // The tangent of how high the highest ridge stands against the Sun's centre.
                        let ridge = points[row - reach..row]
                            .iter()
                            .map(|[ridge_over, ridge_along]| {
                                (ridge_over - over) / (ridge_along - along)
                            })
                            .fold(f64::MIN, f64::max);
                        share_above(ridge / sun_radius.rad()) as f32
                    })
                    .collect()
            })
            .collect();
        let sunlit =
            (0..rows).flat_map(|row| meridians.iter().map(move |column| column[row])).collect();
        Shadows { body_from_sun, rows, columns, sunlit }
    }
}

/// The share of a disc above a level line, given how high the line stands over its middle, in radii.
fn share_above(line: f64) -> f64 {
    let line = line.clamp(-1.0, 1.0);
    (line.acos() - line * (1.0 - line * line).sqrt()) / std::f64::consts::PI
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A smooth globe with one mountain on the equator, as high as wide.
    fn globe_with(mountain: impl Fn(f64, f64) -> f64) -> MoonRelief {
        let (width, height) = (2880, 1440);
        let elevation_m = (0..height)
            .flat_map(|row| (0..width).map(move |column| (row, column)))
            .map(|(row, column)| {
                let longitude_deg = (column as f64 + 0.5) / 8.0 - 180.0;
                mountain(longitude_deg, 90.0 - (row as f64 + 0.5) / 8.0) as i16
            })
            .collect();
        MoonRelief { width, height, elevation_m }
    }

    fn sunlit(shadows: &Shadows, longitude_deg: f64) -> f32 {
        let normal =
            DVec3::new(longitude_deg.to_radians().cos(), longitude_deg.to_radians().sin(), 0.0);
        let in_sun = shadows.body_from_sun.transpose() * normal;
        let angle = Angle::from_rad(in_sun.z.clamp(-1.0, 1.0).acos());
        let share = (angle - Shadows::FIRST).rad() / (Shadows::LAST - Shadows::FIRST).rad();
        let row = (share * (shadows.rows - 1) as f64).round() as usize;
        let turn = in_sun.y.atan2(in_sun.x) / std::f64::consts::TAU;
        let column = (turn.rem_euclid(1.0) * shadows.columns as f64).round() as usize;
        shadows.sunlit[row * shadows.columns + column % shadows.columns]
    }

    const SUN_RADIUS: Angle = Angle::from_deg(0.267);

    #[test]
    fn half_of_the_sun_is_seen_from_the_terminator_of_a_smooth_globe() {
        let shadows = Shadows::cast(&globe_with(|_, _| 0.0), DVec3::X, SUN_RADIUS, 2000);
        assert!((sunlit(&shadows, 90.0) - 0.5).abs() < 0.2, "{}", sunlit(&shadows, 90.0));
        assert_eq!((sunlit(&shadows, 89.0), sunlit(&shadows, 91.0)), (1.0, 0.0));
    }

    #[test]
    fn a_mountain_throws_its_shadow_away_from_the_sun() {
        // A wall of 3 km at 80 degrees, where the Sun is 10 degrees high: 17 km of shadow, 0.56 degrees.
        let wall =
            |longitude: f64, _: f64| if (79.8..80.2).contains(&longitude) { 3000.0 } else { 0.0 };
        let shadows = Shadows::cast(&globe_with(wall), DVec3::X, SUN_RADIUS, 2000);
        assert!(sunlit(&shadows, 80.45) < 0.1, "{}", sunlit(&shadows, 80.45));
        assert!(sunlit(&shadows, 81.2) > 0.9 && sunlit(&shadows, 79.5) > 0.9);
        assert!(sunlit(&shadows, -80.45) > 0.9);
    }

    #[test]
    fn peaks_are_lit_beyond_the_terminator() {
        // 5 km see over the horizon by acos(1 / (1 + 5 / 1737)) = 4.3 degrees.
        let peak = |longitude: f64, latitude: f64| {
            let off = (longitude - 93.0).hypot(latitude);
            5000.0 * (1.0 - off / 0.5).max(0.0)
        };
        let shadows = Shadows::cast(&globe_with(peak), DVec3::X, SUN_RADIUS, 2000);
        assert!(sunlit(&shadows, 93.0) > 0.9, "{}", sunlit(&shadows, 93.0));
        assert!(sunlit(&shadows, 92.0) < 0.01 && sunlit(&shadows, 94.0) < 0.01);
    }

    #[test]
    fn small_discs_are_drawn_with_few_triangles() {
        let relief = Arc::new(globe_with(|_, _| 0.0));
        let albedo = Arc::new(MoonMap { width: 8, height: 4, reff: vec![[0.1; 3]; 32] });
        let shadows = Arc::new(Shadows::cast(&relief, DVec3::X, SUN_RADIUS, 2000));
        let ground = Arc::new(Ground { size: (2, 1), cells: Vec::new(), facets: Vec::new() });
        let globe = |picture_px| Globe {
            relief: Arc::clone(&relief),
            albedo: Arc::clone(&albedo),
            body_from_disc: DMat3::IDENTITY,
            distance: 220.0,
            picture_px,
            fineness: 1,
            ground: Arc::clone(&ground),
            shadows: Arc::clone(&shadows),
            shadow: None,
        };
        let triangles = |px| globe(px).mesh().map(|band| band.triangles()).iter().sum::<u32>();
        assert!(triangles(12) < 500 && (100_000..300_000).contains(&triangles(2000)));
        assert_eq!(globe(4000).mesh()[2].sectors, 2880);
        assert_eq!((globe(30).relief_level(), globe(2000).relief_level()), (4, 0));
    }

    #[test]
    fn shares_of_a_disc() {
        assert_eq!((share_above(-2.0), share_above(0.0), share_above(2.0)), (1.0, 0.5, 0.0));
        // A line at half the radius leaves 1/3 - sqrt(3) / 4 pi.
        assert!((share_above(0.5) - 0.195_501).abs() < 1e-6);
    }
}
