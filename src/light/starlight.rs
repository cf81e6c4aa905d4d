//! The light of the stars as an even glow: those that no catalogue lists, and what dust and galaxies
//! add to them.
//!
//! - [`Starlight`]: all stars outside the Bright Star Catalogue, from the map of
//!   [`crate::catalog::milky_way`], which says how it was calibrated and how far to trust it. With the
//!   catalogue's stars beside it the whole sky has a mean of 103 S10(V), 100 after Benn & Ellison 1998.
//! - [`StarGlow`]: stars of the catalogue that are not drawn one by one, spread over texels of two to
//!   four degrees; their light is neither lost nor counted twice.
//! - [`diffuse_galactic`]: starlight that dust scatters back. [`cosmic`]: galaxies beyond our own.
//!
//! **Unit**: one S10(V) is a star of tenth magnitude in V per square degree, 27.78 mag per square
//! arcsecond, [`S10_CD_M2`]. Spectra are scaled by their luminance.
//!
//! **Spectra**: `catalogs/spectra/integrated_starlight.csv` has two mixes of the templates of Pickles
//! 1998, *PASP* 110, 863, with B-V 0.50 and 1.20 (`scripts/starlight_spectra.py`); the colour of a place
//! mixes them linearly. Half of each has B-V 0.8, as the sky's starlight in the mean (Mattila 1980,
//! *A&AS* 39, 53, recalled: 0.7 to 0.9 with latitude). Reddening by dust is left to the red mix.
//!
//! **Diffuse galactic light**: 20 to 30 % of the light of the Milky Way (Leinert et al. 1998, *A&AS* 127,
//! 1, section 11; Toller 1981; both recalled): taken as 0.25 of the starlight of the same place in V in
//! the plane, falling to 0.17 at the poles, where there is less dust. Dust scatters blue light better: the
//! bluer mix of stars times `(550 nm / wavelength)^0.8`; Brandt & Draine 2012, *ApJ* 744, 129, find it very
//! blue too. Its luminance is uncertain by a third. Dust clouds as such are not drawn.
//!
//! **Cosmic background**: Matsuoka et al. 2011, *ApJ* 736, 119 (Pioneer 10 and 11): 1.8e-9 and 1.2e-9
//! erg s-1 cm-2 sr-1 Å-1, each ± 0.9e-9, at 440 and 640 nm, a power law between and beyond; 1.2 S10(V).

use std::f64::consts::PI;
use std::sync::{Arc, LazyLock};

use glam::DVec3;

use crate::air::scattering::above::SkyHarmonics;
use crate::catalog::MilkyWay;
use crate::catalog::milky_way::{around, direction, solid_angle_density, solid_angles};
use crate::frame::{Dir, Galactic};
use crate::light::spectrum::{Spectrum, shipped_column};
use crate::units::{Angle, Illuminance};

/// Luminance of one S10(V), cd/m2: 27.78 mag per square arcsecond, where 12.58 is that of 1 cd/m2.
pub const S10_CD_M2: f64 = 8.317_637_711_026_71e-7;

/// Share of starlight that dust adds, in V: in the galactic plane, and at its poles.
const DIFFUSE_SHARE: (f64, f64) = (0.25, 0.17);
/// Colour of the stars that dust scatters, 0 to 1, and the power of the wavelength by which it does.
const DIFFUSE_COLOUR: f64 = 0.4;
const DIFFUSE_POWER: f64 = -0.8;
/// Cosmic background: wavelength in nm and radiance in W m-2 sr-1 nm-1.
const COSMIC: [(f64, f64); 2] = [(440.0, 1.8e-11), (640.0, 1.2e-11)];

const INTEGRATED: &str = include_str!("../../catalogs/spectra/integrated_starlight.csv");

/// Spectral radiance of one S10(V) of starlight, W m-2 sr-1 nm-1: the bluest and the reddest mix of
/// stars. A colour from 0 to 1 mixes them linearly; both have the luminance of 1 S10(V).
pub fn spectra_of_s10() -> [Spectrum; 2] {
    static SPECTRA: LazyLock<[Spectrum; 2]> = LazyLock::new(|| {
        [1, 2].map(|column| {
            Spectrum::from_table(&shipped_column(INTEGRATED, column)).scaled_to_photopic(S10_CD_M2)
        })
    });
    *SPECTRA
}

/// Starlight of a brightness in S10(V) and a colour.
fn starlight(s10: f64, colour: f64) -> Spectrum {
    let [blue, red] = spectra_of_s10();
    blue * (s10 * (1.0 - colour)) + red * (s10 * colour)
}

/// What dust scatters at a galactic latitude, as a share of the light of all stars there, by luminance.
pub fn diffuse_share(b: Angle) -> f64 {
    let (plane, poles) = DIFFUSE_SHARE;
    plane + (poles - plane) * b.sin().abs()
}

/// Spectral radiance of the starlight that dust scatters, W m-2 sr-1 nm-1, by the brightness of all
/// stars there in S10(V) and the galactic latitude.
pub fn diffuse_galactic(s10_of_starlight: f64, b: Angle) -> Spectrum {
    static OF_S10: LazyLock<Spectrum> = LazyLock::new(|| {
        starlight(1.0, DIFFUSE_COLOUR)
            .weighted(|nm| (nm / 550.0).powf(DIFFUSE_POWER))
            .scaled_to_photopic(S10_CD_M2)
    });
    *OF_S10 * (s10_of_starlight * diffuse_share(b))
}

/// Spectral radiance of the galaxies beyond our own, W m-2 sr-1 nm-1: the same everywhere.
pub fn cosmic() -> Spectrum {
    let [(blue_nm, blue), (red_nm, red)] = COSMIC;
    let power = (red / blue).ln() / (red_nm / blue_nm).ln();
    Spectrum::from_fn(|nm| blue * (nm / blue_nm).powf(power))
}

/// The light of all stars outside the Bright Star Catalogue.
#[derive(Debug, Clone)]
pub struct Starlight {
    map: Arc<MilkyWay>,
    harmonics: Arc<SkyHarmonics>,
}

impl Starlight {
    pub fn new(map: Arc<MilkyWay>) -> Starlight {
        let harmonics = Arc::new(harmonics_of(&map));
        Starlight { map, harmonics }
    }

    /// The map: what a renderer needs.
    pub fn map(&self) -> &Arc<MilkyWay> {
        &self.map
    }

    /// Brightness in S10(V).
    pub fn s10(&self, dir: Dir<Galactic>) -> f64 {
        self.map.s10(dir.vector())
    }

    /// 0 for the bluest mix of stars to 1 for the reddest.
    pub fn colour(&self, dir: Dir<Galactic>) -> f64 {
        self.map.colour(dir.vector())
    }

    /// Spectral radiance outside the air, W m-2 sr-1 nm-1.
    pub fn spectrum(&self, dir: Dir<Galactic>) -> Spectrum {
        starlight(self.s10(dir), self.colour(dir))
    }

    /// The map in harmonics to degree 8 about the galactic pole, S10(V): elevation is latitude,
    /// azimuth is longitude. The sums see every texel, so that no detail is mistaken for a coarse
    /// shape.
    pub fn harmonics(&self) -> &SkyHarmonics {
        &self.harmonics
    }
}

/// Blocks of texels are points: they are no wider than 2 degrees, degree 8 has waves of 45.
fn harmonics_of(map: &MilkyWay) -> SkyHarmonics {
    let size = map.size();
    let edge = size.div_ceil(128);
    let angles = solid_angles(size);
    let blocks = size.div_ceil(edge);
    let point = |block: usize| {
        let (first_row, first_column) = (block / blocks * edge, block % blocks * edge);
        let (mut light, mut middle) = (0.0, DVec3::ZERO);
        for row in first_row..(first_row + edge).min(size) {
            for column in first_column..(first_column + edge).min(size) {
                let [s10, _] = map.texels()[row * size + column];
                light += f64::from(s10) * angles[row * size + column];
            }
        }
        for (row, column) in [(0, 0), (0, edge), (edge, 0), (edge, edge)] {
            let place = |index: usize| index.min(size) as f64 / size as f64;
            middle += direction([place(first_column + column), place(first_row + row)]);
        }
        (middle.normalize(), light)
    };
    SkyHarmonics::of_points((0..blocks * blocks).map(point))
}

/// Stars as an even glow, in texels of two to four degrees that lie as those of the map.
///
/// A star is shared between the four texels around it. A texel's brightness is its light over the
/// solid angle for which it stands when it is read bilinearly, so that the light that is read over
/// the sphere is that of the stars.
#[derive(Debug, Clone, PartialEq)]
pub struct StarGlow {
    /// S10(V), row by row.
    texels: Vec<f64>,
}

impl StarGlow {
    /// Edge length in texels.
    pub const SIZE: usize = 64;

    /// The glow of some stars, given by where they are and what they shine outside the air.
    pub fn of(stars: impl Iterator<Item = (Dir<Galactic>, Illuminance)>) -> StarGlow {
        let mut texels = vec![0.0; Self::SIZE * Self::SIZE];
        for (dir, illuminance) in stars {
            for (at, weight) in around(Self::SIZE, dir.vector()) {
                texels[at] += weight * illuminance.lx();
            }
        }
        for (texel, angle_sr) in texels.iter_mut().zip(&*GLOW_ANGLES) {
            *texel /= angle_sr * S10_CD_M2;
        }
        StarGlow { texels }
    }

    /// Row by row, [`SIZE`](StarGlow::SIZE) squared of them, S10(V).
    pub fn texels(&self) -> &[f64] {
        &self.texels
    }

    /// Brightness in S10(V), straight between texels.
    pub fn s10(&self, dir: Dir<Galactic>) -> f64 {
        let around = around(Self::SIZE, dir.vector());
        around.iter().map(|&(at, weight)| self.texels[at] * weight).sum()
    }

    /// The glow in harmonics to degree 8 about the galactic pole, S10(V): elevation is latitude,
    /// azimuth is longitude.
    pub fn harmonics(&self) -> SkyHarmonics {
        let place = |index: usize| (index as f64 + 0.5) / Self::SIZE as f64;
        let lit = self.texels.iter().zip(&*GLOW_ANGLES).enumerate();
        SkyHarmonics::of_points(lit.filter(|(_, (texel, _))| **texel > 0.0).map(
            |(at, (texel, angle_sr))| {
                let dir = direction([place(at % Self::SIZE), place(at / Self::SIZE)]);
                (dir, texel * angle_sr)
            },
        ))
    }
}

/// The integral over the sphere of what bilinear reading makes of each texel of 1, sr.
static GLOW_ANGLES: LazyLock<Vec<f64>> = LazyLock::new(|| {
    /// Samples along the edge of a texel.
    const FINE: usize = 8;
    let edge = StarGlow::SIZE * FINE;
    let mut angles = vec![0.0; StarGlow::SIZE * StarGlow::SIZE];
    for row in 0..edge {
        for column in 0..edge {
            let place = [column, row].map(|index| (index as f64 + 0.5) / edge as f64);
            let angle_sr = solid_angle_density(place) / (edge * edge) as f64;
            for (at, weight) in around(StarGlow::SIZE, direction(place)) {
                angles[at] += weight * angle_sr;
            }
        }
    }
    let total: f64 = angles.iter().sum();
    angles.into_iter().map(|angle| angle * 4.0 * PI / total).collect()
});

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Magnitude;

    fn towards(l_deg: f64, b_deg: f64) -> Dir<Galactic> {
        Dir::from_spherical(Angle::from_deg(l_deg), Angle::from_deg(b_deg))
    }

    /// The mean over the sphere of something.
    fn mean(value: impl Fn(Dir<Galactic>) -> f64) -> f64 {
        let count = 200_000;
        let each = (0..count).map(|k| {
            let z = 1.0 - 2.0 * (k as f64 + 0.5) / f64::from(count);
            let turn = PI * (3.0 - 5f64.sqrt()) * f64::from(k);
            let flat = (1.0 - z * z).sqrt();
            value(Dir::from_vector(DVec3::new(flat * turn.cos(), flat * turn.sin(), z)))
        });
        each.sum::<f64>() / f64::from(count)
    }

    #[test]
    fn one_s10_is_a_tenth_magnitude_star_in_a_square_degree() {
        assert!((10f64.powf((12.58 - 27.78) / 2.5) / S10_CD_M2 - 1.0).abs() < 1e-12);
        let square_degree_sr = (PI / 180.0).powi(2);
        let star = Magnitude(10.0).illuminance().lx() / square_degree_sr;
        // The zeros of magnitudes of lights and of skies agree to 0.3 %.
        assert!((star / S10_CD_M2 - 1.0).abs() < 4e-3, "{}", star / S10_CD_M2);
        for spectrum in spectra_of_s10() {
            assert!((spectrum.xyzv().y / S10_CD_M2 - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn the_mixes_have_their_colours() {
        let [blue, red] = spectra_of_s10();
        // Energy about 440 over 550 nm: a difference of 0.7 in B-V is a factor of 1.9.
        let ratio = |s: &Spectrum| {
            let about = |nm: f64| (-4..=4).map(|k| s.at_nm(nm + 10.0 * f64::from(k))).sum::<f64>();
            about(440.0) / about(550.0)
        };
        assert!(
            (1.7..2.1).contains(&(ratio(&blue) / ratio(&red))),
            "{}",
            ratio(&blue) / ratio(&red)
        );
        let sp = |s: &Spectrum| s.xyzv().v / s.xyzv().y;
        assert!((2.0..2.8).contains(&sp(&blue)) && (1.4..2.0).contains(&sp(&red)));
        // The dust's light is bluer than the stars'.
        let dust = diffuse_galactic(100.0, Angle::ZERO);
        assert!(sp(&dust) > sp(&starlight(100.0, 0.5)) + 0.1);
        assert!((dust.xyzv().y / S10_CD_M2 - 25.0).abs() < 1e-9);
        let at_pole = diffuse_galactic(26.0, Angle::from_deg(-90.0)).xyzv().y / S10_CD_M2;
        assert!((at_pole - 0.17 * 26.0).abs() < 1e-9);
        let cosmic = cosmic().xyzv().y / S10_CD_M2;
        assert!((0.9..1.6).contains(&cosmic), "{cosmic}");
    }

    #[test]
    fn a_glow_has_the_light_of_its_stars() {
        let stars = || {
            (0..500).map(|k| {
                let k = f64::from(k);
                (
                    towards(137.5 * k, 90.0 * (0.7 * k).sin()),
                    Magnitude(4.0 + (k % 3.0)).illuminance(),
                )
            })
        };
        let lx: f64 = stars().map(|(_, illuminance)| illuminance.lx()).sum();
        let expected = lx / (4.0 * PI) / S10_CD_M2;
        let glow = StarGlow::of(stars());
        let read = mean(|dir| glow.s10(dir));
        assert!((read / expected - 1.0).abs() < 3e-3, "{read} {expected}");
        let (monopole, _) = glow.harmonics().coefficients(0, 0);
        assert!((monopole / (4.0 * PI).sqrt() / expected - 1.0).abs() < 1e-9, "{monopole}");
        // One star at a time, wherever: at a pole, on a fold, at a corner of the square.
        for (l, b) in [(0.0, 90.0), (0.0, -90.0), (45.0, 0.0), (90.0, -0.3), (10.0, -60.0)] {
            let one = || std::iter::once((towards(l, b), Illuminance::from_lx(1e-6)));
            let glow = StarGlow::of(one());
            let read = mean(|dir| glow.s10(dir)) * 4.0 * PI * S10_CD_M2 / 1e-6;
            assert!((read - 1.0).abs() < 0.01, "{l} {b}: {read}");
            // Where it is: the dipole points to it.
            let sky = glow.harmonics();
            let here = sky.radiance(Angle::from_deg(b), Angle::from_deg(l));
            let away = sky.radiance(Angle::from_deg(-b), Angle::from_deg(l + 180.0));
            assert!(here > 5.0 * away.abs(), "{l} {b}: {here} {away}");
        }
        assert!(StarGlow::of(std::iter::empty()).texels().iter().all(|texel| *texel == 0.0));
    }
}
