//! The mesh of the globe: bands of rings around the point below the observer, and a skirt that carries the
//! ground at the limb outwards, for the [outline](super::limb) to cut.

use super::{EXTENT, Globe};

/// A band of the mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MeshBand {
    /// Angles from the point below the observer, degrees.
    pub from_deg: u32,
    pub to_deg: u32,
    pub rings: u32,
    pub sectors: u32,
    /// Whether its last ring is drawn out over the limb, behind all else.
    pub is_skirt: bool,
}

impl MeshBand {
    pub fn triangles(&self) -> u32 {
        2 * self.rings * self.sectors
    }
}

impl Globe {
    /// The mesh: coarse where a picture shows slopes by their light, fine where they stand before others.
    pub fn mesh(&self) -> [MeshBand; 4] {
        mesh_for(self.view.picture_px)
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
    let limb = band([85, 96], 80.0, 16.0);
    let skirt = MeshBand { from_deg: 80, to_deg: 90, rings: 1, is_skirt: true, ..limb };
    [band([0, 75], 24.0, 32.0), band([75, 85], 160.0, 16.0), limb, skirt]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_discs_are_drawn_with_few_triangles() {
        let triangles = |px| mesh_for(px).map(|band| band.triangles()).iter().sum::<u32>();
        assert!(triangles(64) < 600, "{}", triangles(64));
        assert!((20_000..60_000).contains(&triangles(2000)), "{}", triangles(2000));
        assert_eq!(mesh_for(16_000)[2].sectors, 2880);
    }
}
