//! The eye of Jensen et al. 2001, *A Physically-Based Night Sky Model*, as their paper describes it.
//!
//! Section 7 names three parts, and gives no constants:
//!
//! 1. "The histogram-adjustment method proposed by Ward et al." (their \[22\]; Ward Larson, Rushmeier & Piatko
//!    1997), which "discounts the empty portions of the histogram", with rods, cones and loss of
//!    acuity: [`curve`].
//! 2. The blue shift "for XYZV images as described in" Jensen, Premože et al. 2000, *Night Rendering*,
//!    UUCS-00-016: [`blue_shifted`].
//! 3. Section 5.2: "the physically-based glare filter by Spencer et al." 1995, for the stars.
//!
//! *What they leave open, and what we chose.*
//! - Which luminance the histogram is made of: that of the light as it comes in, Y, before the blue shift, averaged
//!   over a degree of the field by whoever samples; black is where Y is 0.
//! - The screen: white as asked, black a thousandth of it (Ward Larson et al. take a hundredth in examples).
//! - Order: glare, then blue shift, then the curve; the curve is that of Y before the shift and multiplies what
//!   the shift made of it, as `pcond` multiplies all channels by one factor.
//! - Ward Larson et al. blend to grey between 0.0056 and 5.6 cd/m2. The paper replaces that blend by its
//!   blue shift, and so do we; doing both would desaturate twice.
//! - The veil of Ward Larson et al. (8 %) is left out: Spencer's filter has it already.
//! - The glare is for the stars alone, "in the color pages a close-up"; whether the Moon has it is not said.
//! - Acuity: Ward Larson et al. blur by Shaler's curve, `R(L) = 17.25 atan(1.4 log10 L + 0.35) + 25.72` cycles per
//!   degree ([`acuity_cpd`]).

use crate::units::Xyzv;

use super::histogram_adjustment::histogram_adjustment;
use super::tone_curve::{Screen, ToneCurve};

/// Log10 of cd/m2: rods see alone below, cones above (Jensen et al. 2000).
const RODS_ALONE_LOG: f64 = -2.0;
const CONES_ALONE_LOG: f64 = 0.6;
/// Chromaticity to which night is shifted.
const BLUE: [f64; 2] = [0.25, 0.25];
/// Luminance that a scotopic cd/m2 is shown as.
const ROD_GAIN: f64 = 0.4468;

/// The tone curve: samples are (luminance in cd/m2, weight).
pub fn curve(samples: &[(f64, f64)], screen: Screen) -> ToneCurve {
    histogram_adjustment(samples, screen)
}

/// What is seen of a light: blue-grey by the rods in the dark, unchanged by day (Jensen et al. 2000).
/// The chromaticity is mixed, and the luminance apart from it; cd/m2 in and out, V as it was.
pub fn blue_shifted(light: Xyzv) -> Xyzv {
    let cones = cone_share(light.y);
    let sum = light.x + light.y + light.z;
    // No light, no colour.
    let [x, y] = if sum > 0.0 { [light.x / sum, light.y / sum] } else { BLUE };
    let mixed = |own: f64, blue: f64| cones * own + (1.0 - cones) * blue;
    let (x, y) = (mixed(x, BLUE[0]), mixed(y, BLUE[1]));
    let luminance = ROD_GAIN * (1.0 - cones) * light.v + cones * light.y;
    if y <= 0.0 {
        return Xyzv::new(0.0, 0.0, 0.0, light.v);
    }
    Xyzv::new(x / y * luminance, luminance, (1.0 - x - y) / y * luminance, light.v)
}

/// The share of the cones at a luminance, 0 to 1.
fn cone_share(luminance_cd_m2: f64) -> f64 {
    let log = luminance_cd_m2.max(1e-12).log10();
    let x = ((log - RODS_ALONE_LOG) / (CONES_ALONE_LOG - RODS_ALONE_LOG)).clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// The finest grating that is seen at a luminance in cd/m2, cycles per degree; not less than 1
/// (Shaler 1937 as fitted by Ward Larson et al. 1997, Eq. 13, recalled number).
pub fn acuity_cpd(luminance_cd_m2: f64) -> f64 {
    let log = luminance_cd_m2.max(1e-12).log10();
    (17.25 * (1.4 * log + 0.35).atan() + 25.72).max(1.0)
}
