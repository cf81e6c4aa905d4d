//! The eye of Jensen et al. 2001, *A Physically-Based Night Sky Model*, as their paper describes it.
//!
//! Section 7 names three parts, and gives no constants:
//!
//! 1. "The histogram-adjustment method proposed by Ward et al." (their \[22\]; Ward Larson, Rushmeier & Piatko
//!    1997), which "discounts the empty portions of the histogram", with rods, cones and loss of
//!    acuity: [`curve`].
//! 2. The blue shift "for XYZV images as described in" Jensen, Premože et al. 2000, *Night Rendering*,
//!    UUCS-00-016: [`super::rods`].
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
//! - Acuity: the blur of Ward Larson et al., with their limit ([`super::acuity`]), at the luminance of each place.

use super::histogram_adjustment::histogram_adjustment;
use super::tone_curve::{Screen, ToneCurve};

/// The tone curve: samples are (luminance in cd/m2, weight).
pub fn curve(samples: &[(f64, f64)], screen: Screen) -> ToneCurve {
    histogram_adjustment(samples, screen)
}
