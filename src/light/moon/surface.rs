//! The Moon's ground as maps and a law of reflection say, its sum over the disc, and what takes that
//! sum to ROLO.
//!
//! Theory: the calibrated map gives REFF(30°, 0°, 30°) of each place in three bands; a law says how
//! the radiance factor goes with the directions of Sun and observer, relative to that. The sum over
//! the lit and visible lune is taken over a grid of its own coordinates: with `L` the longitude along
//! the great circle through both, `B` the latitude from it, the disc's area is
//! `cos L cos B dL d(sin B)`.
//!
//! ROLO is the truth for the light of the whole disc: it was measured from the Earth for years. The
//! sum of the maps is scaled to it, in each band and for each phase. With [`Reflectance::Hapke`], mean
//! of waxing and waning, sum over ROLO:
//!
//! ```text
//! phase    450 nm  550 nm  650 nm   550 nm by Jensen   550 nm, waxing over waning
//!   1.55    1.057   1.046   1.041         0.980               1.001
//!   3       1.059   1.048   1.037         1.054               1.002
//!   5       1.056   1.046   1.032         1.115               1.005
//!  10       1.047   1.039   1.028         1.166               1.014
//!  20       1.038   1.031   1.032         1.151               1.028
//!  30       1.050   1.044   1.054         1.148               1.047
//!  50       1.066   1.062   1.083         1.141               1.095
//!  70       1.070   1.068   1.096         1.085               1.138
//!  90       1.098   1.094   1.126         1.014               1.157
//!  97       1.119   1.114   1.144         1.004               1.149
//! 110       1.153   1.147   1.165         1.016               1.133
//! 120       1.154   1.150   1.142         1.071               1.110
//! ```
//!
//! Omitted: mountains and their shadows beyond the roughness of the law; the parallax across the
//! disc (0.3 degrees of phase from limb to limb); earthshine.
//!
//! Accuracy: the sum is within 0.4 % of a grid of 400 by 400 pixels, 0.8 % for a thin crescent. With
//! one set of parameters all over, the full Moon's inner third is 1.02 to 1.03 times as bright as its
//! outer (Jensen: 1.001).

use std::f64::consts::PI;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::catalog::moon::hapke::BANDS_NM;
use crate::catalog::moon::{HapkeCell, MoonHapke, MoonMap};
use crate::frame::{Dir, MoonFixed};
use crate::light::moon::hapke::{self, Facets};
use crate::light::moon::rolo::{self, MoonView};
use crate::light::moon::{bands, jensen};
use crate::light::spectrum::Spectrum;
use crate::light::sun;
use crate::units::{Angle, MOON_RADIUS_KM};

/// Grid of the sum: along the great circle and across it.
const GRID: (usize, usize) = (64, 48);

/// How light leaves the ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Reflectance {
    /// Jensen et al. 2001; the same all over the Moon.
    Jensen,
    /// Hapke 2012 with the parameters of each place.
    #[default]
    Hapke,
}

impl Reflectance {
    /// Radiance factor (pi times the radiance over the irradiance of a plane that faces the Sun) of
    /// ground whose REFF(30°, 0°, 30°) is 1; multiply by the REFF of the map.
    pub fn relative(
        self,
        cell: &HapkeCell,
        cos_incidence: f64,
        cos_emission: f64,
        phase: Angle,
    ) -> f64 {
        match self {
            Reflectance::Jensen => jensen_relative(cos_incidence, cos_emission, phase),
            Reflectance::Hapke => {
                hapke::radiance_factor(cell, cos_incidence, cos_emission, phase)
                    / hapke::reff_30_0_30(cell)
            }
        }
    }
}

fn jensen_relative(cos_incidence: f64, cos_emission: f64, phase: Angle) -> f64 {
    let thirty = Angle::from_deg(30.0);
    jensen::lunar_brdf(cos_incidence, cos_emission, phase) * cos_incidence
        / jensen::lunar_brdf(thirty.cos(), 1.0, thirty)
}

/// One band of one cell at one phase angle. The radiance factor of ground with the REFF `r` of the
/// map is, with [`Facets`] `f`,
/// `r * hapke::radiance_factor_of(f, w, single, multiple)`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PhaseCell {
    /// Light scattered once, [`hapke::single_scattering`] over REFF(30°, 0°, 30°) of the cell.
    pub single: f64,
    /// A quarter of `w` over REFF(30°, 0°, 30°) of the cell.
    pub multiple: f64,
    /// Single-scattering albedo.
    pub w: f64,
}

impl PhaseCell {
    /// A share of the way to another cell.
    pub fn towards(&self, other: &PhaseCell, share: f64) -> PhaseCell {
        let mix = |a: f64, b: f64| a + (b - a) * share;
        PhaseCell {
            single: mix(self.single, other.single),
            multiple: mix(self.multiple, other.multiple),
            w: mix(self.w, other.w),
        }
    }
}

/// The ground in cells of 2 degrees, bands at 415, 566 and 643 nm; see [`crate::catalog::moon`] for
/// how the map lies.
#[derive(Debug, Clone, PartialEq)]
pub struct MoonSurface {
    width: usize,
    height: usize,
    cells: Vec<Cell>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Cell {
    /// Means of the map over the cell.
    reff: [f64; 3],
    hapke: [HapkeCell; 3],
    /// One over REFF(30°, 0°, 30°) by the parameters.
    per_reff: [f64; 3],
}

/// The light of the disc's parts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiscLight {
    /// Radiance, W m-2 sr-1 nm-1, per radiance factor at 415, 566 and 643 nm: a place sends
    /// the sum over the bands of its radiance factor times this.
    pub radiance_per_factor: [Spectrum; 3],
    /// ROLO over the sum of the maps, in the bands.
    pub rolo_over_maps: [f64; 3],
}

impl MoonSurface {
    /// From the maps; both cover the whole Moon and neither is empty.
    pub fn new(map: &MoonMap, parameters: &MoonHapke) -> Self {
        let (width, height) = (parameters.width, parameters.height);
        let mut sums = vec![([0.0; 3], 0.0); width * height];
        for (row, pixels) in map.reff.chunks(map.width.max(1)).enumerate() {
            let from_pole = (row as f64 + 0.5) / map.height as f64;
            // The area of a pixel goes with the cosine of its latitude.
            let area = (PI * from_pole).sin();
            let start = (from_pole * height as f64) as usize * width;
            for (column, &[red, green, blue]) in pixels.iter().enumerate() {
                let cell = start + (2 * column + 1) * width / (2 * map.width);
                let (sum, total) = &mut sums[cell];
                for (sum, reff) in sum.iter_mut().zip([blue, green, red]) {
                    *sum += area * f64::from(reff);
                }
                *total += area;
            }
        }
        let cells = sums.iter().zip(&parameters.cells).map(|((sum, area), &hapke)| {
            let per_reff = hapke.map(|cell| 1.0 / hapke::reff_30_0_30(&cell));
            // A map coarser than the cells leaves some without a pixel.
            let from_parameters = per_reff.map(|per| 1.0 / per);
            let reff = if *area > 0.0 { sum.map(|sum| sum / area) } else { from_parameters };
            Cell { reff, hapke, per_reff }
        });
        MoonSurface { width, height, cells: cells.collect() }
    }

    /// Cells across and down.
    pub fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// What of the law is the same all over a cell at a phase angle, in the bands; row by row.
    pub fn at_phase(&self, phase: Angle) -> Vec<[PhaseCell; 3]> {
        self.cells.iter().map(|cell| cell.at_phase(phase)).collect()
    }

    /// Radiance factor of the cell around a place, lit and seen from these directions (from the
    /// Moon's centre), in the bands. 0 in the dark and behind the limb.
    pub fn radiance_factor(
        &self,
        law: Reflectance,
        place: Dir<MoonFixed>,
        sun: Dir<MoonFixed>,
        observer: Dir<MoonFixed>,
    ) -> [f64; 3] {
        let (cos_incidence, cos_emission) = (place.dot(sun), place.dot(observer));
        let phase = sun.separation(observer);
        let cell = self.cell(place.vector());
        std::array::from_fn(|band| {
            cell.reff[band] * law.relative(&cell.hapke[band], cos_incidence, cos_emission, phase)
        })
    }

    /// The disc's equivalent reflectance by maps and law, in the bands, without any scaling: the mean
    /// of the radiance factor over the whole disc, dark parts included.
    pub fn disc_reflectance(
        &self,
        law: Reflectance,
        sun: Dir<MoonFixed>,
        observer: Dir<MoonFixed>,
    ) -> [f64; 3] {
        let phase = sun.separation(observer);
        let (along, across) = GRID;
        let forward = observer.vector();
        let aside = (sun.vector() - forward * forward.dot(sun.vector()))
            .try_normalize()
            .unwrap_or_else(|| forward.any_orthonormal_vector());
        let up = forward.cross(aside);
        let first = phase.rad() - 0.5 * PI;
        let step = (PI - phase.rad()) / along as f64;
        let mut sum = [0.0; 3];
        for column in 0..along {
            let longitude = first + (column as f64 + 0.5) * step;
            let (sin, cos) = longitude.sin_cos();
            let cos_to_sun = (longitude - phase.rad()).cos();
            let meridian = forward * cos + aside * sin;
            for row in 0..across {
                let sin_latitude = (2.0 * row as f64 + 1.0) / across as f64 - 1.0;
                let cos_latitude = (1.0 - sin_latitude * sin_latitude).sqrt();
                let cell = self.cell(meridian * cos_latitude + up * sin_latitude);
                let (cos_i, cos_e) = (cos_latitude * cos_to_sun, cos_latitude * cos);
                match law {
                    Reflectance::Jensen => {
                        let factor = jensen_relative(cos_i, cos_e, phase) * cos_e;
                        for (sum, reff) in sum.iter_mut().zip(cell.reff) {
                            *sum += reff * factor;
                        }
                    }
                    Reflectance::Hapke => {
                        let facets = Facets::of(cos_i, cos_e, phase);
                        for (band, part) in cell.at_phase(phase).iter().enumerate() {
                            let PhaseCell { w, single, multiple } = *part;
                            let factor = hapke::radiance_factor_of(&facets, w, single, multiple);
                            sum[band] += cell.reff[band] * factor * cos_e;
                        }
                    }
                }
            }
        }
        sum.map(|sum| sum * step * 2.0 / (across as f64 * PI))
    }

    /// ROLO over [`MoonSurface::disc_reflectance`], in the bands: what the radiance factors of maps
    /// and law must be multiplied by for the disc to send what the Moon sends. 0 at new Moon.
    pub fn rolo_over_maps(
        &self,
        law: Reflectance,
        view: &MoonView,
        sun: Dir<MoonFixed>,
        observer: Dir<MoonFixed>,
    ) -> [f64; 3] {
        let maps = self.disc_reflectance(law, sun, observer);
        std::array::from_fn(|band| match maps[band] {
            sum if sum > 0.0 => rolo::disc_reflectance_at(view, BANDS_NM[band]) / sum,
            _ => 0.0,
        })
    }

    /// The light of the disc's parts, such that the mean of its radiance is
    /// [`rolo::irradiance`] over the solid angle of the disc, at every wavelength.
    pub fn disc_light(
        &self,
        law: Reflectance,
        view: &MoonView,
        sun: Dir<MoonFixed>,
        observer: Dir<MoonFixed>,
    ) -> DiscLight {
        let solid_angle_sr =
            sun::projected_solid_angle_sr(MOON_RADIUS_KM, view.observer_distance_km);
        let rolo_over_maps = self.rolo_over_maps(law, view, sun, observer);
        let mut radiance_per_factor = bands::irradiance_by_band(view);
        for (band, part) in radiance_per_factor.iter_mut().enumerate() {
            let rolo = rolo::disc_reflectance_at(view, BANDS_NM[band]);
            let per_factor = if rolo > 0.0 { rolo_over_maps[band] / rolo } else { 0.0 };
            *part = part.weighted(|_| per_factor / solid_angle_sr);
        }
        DiscLight { radiance_per_factor, rolo_over_maps }
    }

    fn cell(&self, place: DVec3) -> &Cell {
        let longitude = place.y.atan2(place.x) / (2.0 * PI) + 0.5;
        let from_pole = place.z.clamp(-1.0, 1.0).acos() / PI;
        let column = ((longitude * self.width as f64) as usize).min(self.width - 1);
        let row = ((from_pole * self.height as f64) as usize).min(self.height - 1);
        &self.cells[row * self.width + column]
    }
}

impl Cell {
    fn at_phase(&self, phase: Angle) -> [PhaseCell; 3] {
        std::array::from_fn(|band| {
            let (cell, per_reff) = (&self.hapke[band], self.per_reff[band]);
            PhaseCell {
                single: per_reff * hapke::single_scattering(cell, phase),
                multiple: per_reff * 0.25 * cell.w,
                w: cell.w,
            }
        })
    }
}
