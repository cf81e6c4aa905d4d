//! The mesh of the globe: bands of rings around the point below the observer, and a skirt that carries the
//! ground at the limb outwards, for the [outline](super::limb) to cut.

use glam::DVec3;

use super::shadows::Shadows;
use super::{EXTENT, Globe};

/// A band of the mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MeshBand {
    /// Angles from the point below the observer, degrees.
    pub from_deg: u32,
    pub to_deg: u32,
    pub rings: u32,
    pub sectors: u32,
    /// Whether its last ring is drawn out over the limb.
    pub is_skirt: bool,
}

impl MeshBand {
    pub fn triangles(&self) -> u32 {
        2 * self.rings * self.sectors
    }

    /// The direction from the centre of a corner, ring by ring from the first, in axes of the picture: the
    /// twin of `vertex` in `shaders/globe.wgsl`.
    fn corner(&self, index: u32) -> DVec3 {
        let (ring, sector) = (index / (self.sectors + 1), index % (self.sectors + 1));
        let span_deg = f64::from(self.to_deg - self.from_deg);
        let theta_deg =
            f64::from(self.from_deg) + span_deg * f64::from(ring) / f64::from(self.rings);
        let turn = std::f64::consts::TAU * f64::from(sector) / f64::from(self.sectors);
        let (sin, cos) = theta_deg.to_radians().sin_cos();
        DVec3::new(sin * turn.cos(), sin * turn.sin(), -cos)
    }

    /// The corners of its triangles, from the outermost ring inwards, parted by how the Sun stands over them.
    fn parted(&self, to_sun: DVec3) -> MeshParts {
        let [first, last] = [Shadows::FIRST, Shadows::LAST].map(|angle| angle.cos());
        let corners = (self.rings + 1) * (self.sectors + 1);
        let cosines: Vec<f64> = (0..corners).map(|index| self.corner(index).dot(to_sun)).collect();
        let mut parts = MeshParts::default();
        for ring in (0..self.rings).rev() {
            for sector in 0..self.sectors {
                let a = ring * (self.sectors + 1) + sector;
                let c = a + self.sectors + 1;
                for triangle in [[a, a + 1, c], [c, a + 1, c + 1]] {
                    let sun = triangle.map(|corner| cosines[corner as usize]);
                    let part = match sun {
                        _ if sun.iter().all(|cos| *cos < last) => &mut parts.dark,
                        _ if sun.iter().all(|cos| *cos > first) => &mut parts.high_sun,
                        _ => &mut parts.low_sun,
                    };
                    part.extend(triangle);
                }
            }
        }
        parts
    }
}

/// Numbers of corners, three for a triangle.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct MeshParts {
    /// Where the Sun is nowhere seen, where shadows may fall, where none do.
    pub dark: Vec<u32>,
    pub low_sun: Vec<u32>,
    pub high_sun: Vec<u32>,
}

impl Globe {
    /// The mesh, each band nearer to the limb than the one before: coarse where a picture shows slopes by their light, fine where they stand before others.
    pub fn mesh(&self) -> [MeshBand; 4] {
        mesh_for(self.view.picture_px)
    }

    /// Its bands in parts, the skirt and what is near the limb first.
    pub fn parted_mesh(&self) -> Vec<(MeshBand, MeshParts)> {
        let to_sun = self.view.body_from_picture().transpose() * self.view.to_sun;
        self.mesh().into_iter().rev().map(|band| (band, band.parted(to_sun))).collect()
    }
}

/// The mesh for a picture with an edge of so many pixels; no finer than the relief.
fn mesh_for(picture_px: u32) -> [MeshBand; 4] {
    let radius_px = 0.5 * f64::from(picture_px) / EXTENT;
    let band = |[from_deg, to_deg]: [u32; 2], ring_px: f64, sector_px: f64| {
        let finest = 8 * (to_deg - from_deg);
        let sectors = radius_px * std::f64::consts::TAU / sector_px;
        MeshBand {
            from_deg,
            to_deg,
            rings: ((radius_px / ring_px) as u32).clamp(2, finest),
            sectors: (sectors as u32).clamp(24, 2880),
            is_skirt: false,
        }
    };
    let limb = band([82, 96], 80.0, 16.0);
    let skirt = MeshBand { from_deg: 78, to_deg: 90, rings: 1, is_skirt: true, ..limb };
    // Each reaches under the one before, so that no crack is left between their corners.
    [band([0, 75], 24.0, 32.0), band([72, 85], 120.0, 16.0), limb, skirt]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_parted_where_they_say_and_are_the_whole() {
        let (sin, cos) = 70f64.to_radians().sin_cos();
        let to_sun = DVec3::new(sin, 0.0, -cos);
        for band in mesh_for(500) {
            let MeshParts { dark, low_sun, high_sun } = band.parted(to_sun);
            let count = dark.len() + low_sun.len() + high_sun.len();
            assert_eq!(count, 3 * band.triangles() as usize);
            let angle_deg = |corner: &u32| band.corner(*corner).dot(to_sun).acos().to_degrees();
            assert!(dark.iter().all(|corner| angle_deg(corner) > 97.0));
            assert!(high_sun.iter().all(|corner| angle_deg(corner) < 58.0));
            assert!(!low_sun.is_empty() && !dark.is_empty());
        }
    }

    #[test]
    fn small_discs_are_drawn_with_few_triangles() {
        let triangles = |px| mesh_for(px).map(|band| band.triangles()).iter().sum::<u32>();
        assert!(triangles(64) < 600, "{}", triangles(64));
        assert!((20_000..60_000).contains(&triangles(2000)), "{}", triangles(2000));
        assert_eq!(mesh_for(16_000)[2].sectors, 2880);
    }
}
