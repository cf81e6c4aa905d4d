//! How the ground of the globe sends light back at one phase angle, in the few numbers that a picture
//! needs of it.
//!
//! *Theory.* The radiance factor of [`crate::light::moon::surface`] at one phase angle is
//! `reff x (once + often x again(i, e)) x lit(i, e)`: `once` and `often` are the ground's, `lit` is what
//! roughness and the law of Lommel and Seeliger make of the directions, the same everywhere, and
//! `again = H(i) H(e) - 1` knows the ground only by its single-scattering albedo. That goes into
//! `often`: what it does to `again` half-way up is taken for what it does at all heights. A table of
//! `lit` and `lit x again` for the mean ground is then all there is to look up.
//!
//! *Accuracy.* 0.8 % of the radiance factor, for ground as dark and as bright as the Moon has (tested).

use crate::light::moon::hapke::{self, Facets};
use crate::light::moon::surface::PhaseCell;
use crate::light::moon::{MoonSurface, Reflectance};
use crate::units::Angle;

/// Cosine at which the albedo's share in what is scattered often is taken.
const HALF_WAY: f64 = 0.5;

/// The ground at one phase angle; colours at 643, 566 and 415 nm.
#[derive(Debug, Clone, PartialEq)]
pub struct Ground {
    /// Cells across and down, as maps lie.
    pub size: (usize, usize),
    /// By cell, row by row: what is scattered once, and often, over the reflectance of the map.
    pub once: Vec<[f64; 3]>,
    pub often: Vec<[f64; 3]>,
    /// By the cosine of emission, then of incidence, each at [`Ground::NODES`] nodes in steps of its root:
    /// what multiplies the one and the other.
    pub by_directions: Vec<[f64; 2]>,
}

impl Ground {
    pub const NODES: usize = 64;

    pub fn at_phase(law: Reflectance, surface: &MoonSurface, phase: Angle) -> Ground {
        let cosine = |node: usize| (node as f64 / (Ground::NODES - 1) as f64).powi(2).max(1e-4);
        let nodes = (0..Ground::NODES * Ground::NODES)
            .map(|at| (cosine(at % Ground::NODES), cosine(at / Ground::NODES)));
        match law {
            Reflectance::Hapke => {
                let cells = evened_at_poles(surface.at_phase(phase), surface.size());
                let mean = mean_albedo(&cells);
                let half_way = hapke::again(mean, HALF_WAY, HALF_WAY);
                // Bands run from 415 to 643 nm, colours from red to blue.
                let colours = |cell: &[PhaseCell; 3], of: fn(&PhaseCell, f64) -> f64| {
                    [2, 1, 0].map(|band| of(&cell[band], half_way))
                };
                let often = |part: &PhaseCell, half_way: f64| {
                    part.multiple * hapke::again(part.w, HALF_WAY, HALF_WAY) / half_way
                };
                Ground {
                    size: surface.size(),
                    once: cells.iter().map(|cell| colours(cell, |part, _| part.single)).collect(),
                    often: cells.iter().map(|cell| colours(cell, often)).collect(),
                    by_directions: nodes
                        .map(|(i, e)| {
                            let facets = Facets::of(i, e, phase);
                            let lit = hapke::radiance_factor_of(&facets, mean, 1.0, 0.0);
                            [lit, hapke::radiance_factor_of(&facets, mean, 0.0, 1.0)]
                        })
                        .collect(),
                }
            }
            // The phase is the same all over the disc: what it takes is the same too.
            Reflectance::Jensen => Ground {
                size: (2, 1),
                once: vec![[1.0; 3]; 2],
                often: vec![[0.0; 3]; 2],
                by_directions: nodes.map(|(i, e)| [i / (i + e), 0.0]).collect(),
            },
        }
    }
}

/// Single-scattering albedo at 566 nm, the mean of all ground.
fn mean_albedo(cells: &[[PhaseCell; 3]]) -> f64 {
    cells.iter().map(|cell| cell[1].w).sum::<f64>() / cells.len().max(1) as f64
}

/// Latitudes between which single places give way to a mean, and those that the mean is of, degrees.
const EVEN_DEG: [f64; 2] = [42.0, 56.0];
const MEAN_DEG: [f64; 2] = [30.0, 42.0];

/// From orbit the ground is seen at phase angles down to its latitude, and no smaller: towards the poles
/// the surge of a place is not measured, and at 643 nm the parameters of places make it anything. There all
/// longitudes share the mean of those at middle latitudes.
fn evened_at_poles(
    mut cells: Vec<[PhaseCell; 3]>,
    (width, height): (usize, usize),
) -> Vec<[PhaseCell; 3]> {
    let latitude_deg = |row: usize| 90.0 - 180.0 * (row as f64 + 0.5) / height as f64;
    for hemisphere in [1.0, -1.0] {
        let (mut mean, mut count) = ([PhaseCell::default(); 3], 0.0);
        for row in 0..height {
            let from_equator = hemisphere * latitude_deg(row);
            if (MEAN_DEG[0]..MEAN_DEG[1]).contains(&from_equator) {
                for cell in &cells[row * width..][..width] {
                    count += 1.0;
                    mean = std::array::from_fn(|band| mean[band].towards(&cell[band], 1.0 / count));
                }
            }
        }
        for row in 0..height {
            let from_equator = hemisphere * latitude_deg(row);
            let share = (from_equator - EVEN_DEG[0]) / (EVEN_DEG[1] - EVEN_DEG[0]);
            if count > 0.0 && share > 0.0 {
                for cell in &mut cells[row * width..][..width] {
                    *cell =
                        std::array::from_fn(|band| cell[band].towards(&mean[band], share.min(1.0)));
                }
            }
        }
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::moon::{HapkeCell, MoonHapke, MoonMap};

    /// Seas and highlands, and ground that is darker and brighter than both.
    fn surface() -> MoonSurface {
        let cell = |w| HapkeCell { w, b: 0.233, c: 0.370, b_s0: 1.716, h_s: 0.060 };
        let cells: Vec<[HapkeCell; 3]> = (0..36 * 18)
            .map(|at| [0.6, 1.0, 1.15].map(|colour| cell(colour * (0.22 + 0.06 * (at % 4) as f64))))
            .collect();
        let map = MoonMap { width: 36, height: 18, reff: vec![[0.1; 3]; 36 * 18] };
        MoonSurface::new(&map, &MoonHapke { width: 36, height: 18, cells })
    }

    #[test]
    fn the_few_numbers_say_what_the_law_says() {
        let surface = surface();
        for phase_deg in [2.0, 20.0, 60.0, 90.0, 120.0] {
            let phase = Angle::from_deg(phase_deg);
            let ground = Ground::at_phase(Reflectance::Hapke, &surface, phase);
            let cells = surface.at_phase(phase);
            // Away from the poles, which are evened.
            for (at, cell) in cells.iter().enumerate().skip(36 * 8).take(4) {
                for node in 0..Ground::NODES * Ground::NODES {
                    let [i, e] = [node % Ground::NODES, node / Ground::NODES]
                        .map(|node| (node as f64 / (Ground::NODES - 1) as f64).powi(2).max(1e-4));
                    let facets = Facets::of(i, e, phase);
                    let [lit, again] = ground.by_directions[node];
                    for (colour, band) in [2, 1, 0].into_iter().enumerate() {
                        let PhaseCell { w, single, multiple } = cell[band];
                        let law = hapke::radiance_factor_of(&facets, w, single, multiple);
                        let got = ground.once[at][colour] * lit + ground.often[at][colour] * again;
                        assert!(
                            (got - law).abs() <= 0.008 * law,
                            "{phase_deg} {i} {e}: {got} {law}"
                        );
                    }
                }
            }
        }
    }
}
