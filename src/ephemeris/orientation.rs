//! How the Earth stands in space: frame bias, precession, nutation and rotation.
//!
//! *Theory.* IAU 2006 precession, IAU 2000A nutation and the sidereal time that belongs to them; in
//! deep time the precession of Vondrák, Capitaine & Wallace 2011. Nutation is had in several forms,
//! from the whole series to a table ([`NutationForm`]). The files below say each theory, and how we
//! differ: `precession`, `nutation`, `sidereal`, `polar_motion`.
//!
//! *Accuracy.* From 1550 to 2650, with the whole series of IAU 2000A, true equinox and pole are within
//! 0.000002" of `pnm06a` of ERFA and sidereal time within 0.000002" of `gst06a`; out of the table within
//! 0.00005" ([`NutationForm::bound`]). Before 1340 and after 2860 the precession is good to a few
//! arcseconds in historical times (Vondrák et al.), and the rest is consistent with it. What the Earth
//! does beyond the models, 0.0003" now, can only be measured and is left out.

mod arguments;
pub mod nutation;
mod polar_motion;
mod precession;
mod series;
mod sidereal;

use crate::frame::{EclipticOfDate, Icrs, Itrs, MeanOfDate, Rot, TrueOfDate};
use crate::frame::{turn_axes_x, turn_axes_z};
use crate::time::Instant;
use crate::units::Angle;

pub use nutation::{Nutation, NutationForm, Nutations};
pub use polar_motion::{PolarMotion, polar_motion};
pub use precession::{ecliptic_from_icrs, mean_from_icrs, mean_obliquity};
pub use sidereal::{earth_rotation_angle, mean_sidereal_time};

/// All axes of one instant, computed together.
#[derive(Debug, Clone, Copy)]
pub struct Orientation {
    pub mean_from_icrs: Rot<MeanOfDate, Icrs>,
    pub ecliptic_from_mean: Rot<EclipticOfDate, MeanOfDate>,
    pub true_from_icrs: Rot<TrueOfDate, Icrs>,
    pub itrs_from_true: Rot<Itrs, TrueOfDate>,
    /// Angle from the mean equator to the mean ecliptic.
    pub mean_obliquity: Angle,
    pub nutation: Nutation,
    /// Greenwich apparent sidereal time, in `[0, 2 pi)`.
    pub sidereal_time: Angle,
}

impl Orientation {
    /// With a nutation of the same instant; without polar motion.
    pub fn at(instant: &Instant, nutation: &Nutation) -> Orientation {
        let mean = precession::Mean::at(instant.tt);
        let true_from_icrs = nutation.true_from_mean(mean.obliquity) * mean.mean_from_icrs;
        let sidereal_time = sidereal::apparent_sidereal_time(
            instant.ut1,
            instant.tt,
            &mean,
            true_from_icrs,
            nutation,
        );
        Orientation {
            mean_from_icrs: mean.mean_from_icrs,
            // Both share the equinox as x.
            ecliptic_from_mean: Rot::claim(turn_axes_x(mean.obliquity)),
            true_from_icrs,
            // By definition of the angle, as long as the pole stays where it is on the crust.
            itrs_from_true: Rot::claim(turn_axes_z(sidereal_time)),
            mean_obliquity: mean.obliquity,
            nutation: *nutation,
            sidereal_time,
        }
    }

    /// The same with the pole where it is on the crust of the Earth at `instant`, the one that these
    /// axes are of.
    pub fn with_polar_motion(self, instant: &Instant, pole: PolarMotion) -> Orientation {
        // `W` takes the axes that turn with the Earth to those of its crust.
        let itrs_from_true = pole.matrix(instant.tt) * turn_axes_z(self.sidereal_time);
        Orientation { itrs_from_true: Rot::claim(itrs_from_true), ..self }
    }

    pub fn itrs_from_icrs(&self) -> Rot<Itrs, Icrs> {
        self.itrs_from_true * self.true_from_icrs
    }
}
