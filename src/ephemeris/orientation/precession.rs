//! Frame bias and precession: the mean equator, ecliptic and equinox of date.
//!
//! *Theory.* From 1540 to 2660 IAU 2006, the standard (`iau2006`); before 1340 and after 2860 the
//! long-term model of Vondrák et al. 2011 (`long_term`); in the two centuries between, the poles of
//! both are blended.
//!
//! *How the models differ.* The standard is a polynomial of the fifth degree. Equinox and pole of the
//! long-term model lie off it by 0.009" in 1540, 0.021" in 1340, 0.016" in 2660, 0.030" in 2860, and
//! 12" at -3000: the sooner one changes over outside the span of the standard, the less there is to
//! blend.

mod iau2006;
mod long_term;
mod terms;

use glam::{DMat3, DVec3};

use crate::frame::{EclipticOfDate, Icrs, MeanOfDate, Rot, turn_axes_x};
use crate::time::{JulianDate, Tt};
use crate::units::Angle;

/// The mean axes of date.
#[derive(Debug, Clone, Copy)]
pub struct Mean {
    pub mean_from_icrs: Rot<MeanOfDate, Icrs>,
    pub ecliptic_from_icrs: Rot<EclipticOfDate, Icrs>,
    /// Angle between mean equator and mean ecliptic.
    pub obliquity: Angle,
    /// The share of the long-term model, and what its equinox has travelled along the equator since
    /// J2000.0; `None` where the standard holds alone.
    pub(super) long_term: Option<(f64, Angle)>,
}

/// The standard holds alone from the first to the second, Julian centuries from J2000.0.
const STANDARD: (f64, f64) = (-4.6, 6.6);
/// How long the change to the long-term model takes, centuries.
const BLEND: f64 = 2.0;

/// The share of the long-term model: 0 within the span of the standard, 1 far outside, with a
/// continuous slope.
fn long_term_share(t: f64) -> f64 {
    let outside = (STANDARD.0 - t).max(t - STANDARD.1);
    let u = (outside / BLEND).clamp(0.0, 1.0);
    u * u * (3.0 - 2.0 * u)
}

impl Mean {
    pub fn at(tt: JulianDate<Tt>) -> Mean {
        let t = tt.centuries_since_j2000();
        let share = long_term_share(t);
        if share == 0.0 {
            return Mean::standard(t);
        }
        let (mut equator, mut ecliptic, travel) = long_term_poles(t);
        if share < 1.0 {
            let standard = Mean::standard(t);
            let blend =
                |standard: DMat3, pole: DVec3| standard.row(2).lerp(pole, share).normalize();
            equator = blend(standard.mean_from_icrs.matrix(), equator);
            ecliptic = blend(standard.ecliptic_from_icrs.matrix(), ecliptic);
        }
        let node = equator.cross(ecliptic);
        let equinox = node.normalize();
        Mean {
            // The equinox is where the ecliptic rises through the equator, by definition.
            mean_from_icrs: Rot::claim(axes(equinox, equator.cross(equinox), equator)),
            ecliptic_from_icrs: Rot::claim(axes(equinox, ecliptic.cross(equinox), ecliptic)),
            obliquity: Angle::from_rad(node.length().atan2(equator.dot(ecliptic))),
            long_term: Some((share, travel)),
        }
    }

    fn standard(t: f64) -> Mean {
        let ecliptic_from_icrs = iau2006::ecliptic_from_icrs(t);
        let obliquity = iau2006::mean_obliquity(t);
        Mean {
            // The angles are made for this.
            ecliptic_from_icrs: Rot::claim(ecliptic_from_icrs),
            mean_from_icrs: Rot::claim(turn_axes_x(-obliquity) * ecliptic_from_icrs),
            obliquity,
            long_term: None,
        }
    }
}

/// Poles of equator and ecliptic in ICRS axes, and the travel of the equinox, by the long-term model.
fn long_term_poles(t: f64) -> (DVec3, DVec3, Angle) {
    let long_term = long_term::at(t);
    let icrs_from_j2000 = frame_bias().transpose();
    (icrs_from_j2000 * long_term.equator, icrs_from_j2000 * long_term.ecliptic, long_term.travel)
}

/// The matrix whose rows are the three axes.
fn axes(x: DVec3, y: DVec3, z: DVec3) -> DMat3 {
    DMat3::from_cols(x, y, z).transpose()
}

/// ICRS axes to mean axes of J2000.0: offsets of the pole -16.617 and -6.8192 mas, of the equinox
/// -14.6 mas (Capitaine & Wallace 2006; IERS Conventions 2010, eq. 5.21 and 5.33).
fn frame_bias() -> DMat3 {
    let [x, y, equinox] =
        [-0.016_617, -0.006_819_2, -0.014_600].map(|arcsec| Angle::from_arcsec(arcsec).rad());
    // First order in the offsets: 1e-14 from orthogonal.
    axes(DVec3::new(1.0, equinox, -x), DVec3::new(-equinox, 1.0, -y), DVec3::new(x, y, 1.0))
}

/// Mean equator and equinox of date from ICRS axes: frame bias and precession.
pub fn mean_from_icrs(tt: JulianDate<Tt>) -> Rot<MeanOfDate, Icrs> {
    Mean::at(tt).mean_from_icrs
}

/// Mean ecliptic and equinox of date from ICRS axes.
pub fn ecliptic_from_icrs(tt: JulianDate<Tt>) -> Rot<EclipticOfDate, Icrs> {
    Mean::at(tt).ecliptic_from_icrs
}

/// Angle between mean equator and mean ecliptic of date.
pub fn mean_obliquity(tt: JulianDate<Tt>) -> Angle {
    Mean::at(tt).obliquity
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_models_differ_by_what_the_documentation_says() {
        for (t, arcsec) in [(-4.6, 0.009), (-6.6, 0.021), (6.6, 0.016), (8.6, 0.030), (-50.0, 12.3)]
        {
            let standard = Mean::standard(t).mean_from_icrs.matrix();
            let (equator, ecliptic, _) = long_term_poles(t);
            let equinox = equator.cross(ecliptic).normalize();
            let off =
                (standard.row(0) - equinox).length().max((standard.row(2) - equator).length());
            let off = Angle::from_rad(off).arcsec();
            assert!((0.9 * arcsec..arcsec).contains(&off), "{t}: {off}");
        }
    }
}
