//! The radii that eclipses are reckoned with.
//!
//! Eclipses are compared between almanacs to a thousandth of a diameter and to a second, and there
//! the radii are a matter of convention. We follow the canons of Espenak & Meeus
//! (NASA/TP-2006-214141 for the Sun, NASA/TP-2009-214172 for the Moon), but for the Moon in the
//! shadow:
//!
//! - **Sun** 696,000 km (959.63" at 1 au: Auwers 1891, IAU 1976). The nominal 695,700 km of IAU
//!   2015 would make magnitudes of solar eclipses 0.0002 to 0.0004 larger.
//! - **Moon before the Sun**: two radii. Where the rim as a whole counts (partial phases, first
//!   and fourth contact) k = 0.272 5076 radii of the Earth, the mean radius with its mountains
//!   (IAU 1982). Where light through the deepest valleys counts (second and third contact, total
//!   or annular, width of the path) k = 0.272 281. With the larger one alone the eclipses of
//!   1927-01-03 and 1948-05-09 are hybrid and not annular, and totality is 2 to 3 s longer.
//! - **Moon in the shadow of the Earth**: 1,737.4 km, its mean radius; 0.272 5076 radii of the
//!   Earth would change magnitudes by 0.0005.
//! - **Shadow of the Earth**: the radius of the Earth is enlarged by 1 % for the air: 1/85 for the
//!   air less 1/594 for the flattening (Danjon 1951, *L'Astronomie* 65, 51). The older rule of
//!   Chauvenet, 2 % of the shadow, gives penumbral magnitudes larger by 0.026.

use crate::units::EARTH_EQUATORIAL_RADIUS_KM;
pub use crate::units::MOON_RADIUS_KM as MOON_IN_SHADOW_KM;

/// Radius of the Sun, kilometres (IAU 1976).
pub const SUN_KM: f64 = 696_000.0;

/// Radius of the Moon for partial phases and outer contacts of solar eclipses, kilometres.
pub const MOON_OUTER_KM: f64 = 0.272_507_6 * EARTH_EQUATORIAL_RADIUS_KM;

/// Radius of the Moon for total and annular phases, kilometres.
pub const MOON_INNER_KM: f64 = 0.272_281 * EARTH_EQUATORIAL_RADIUS_KM;

/// How much larger than the Earth it is that casts the shadow (Danjon).
pub const SHADOW_ENLARGEMENT: f64 = 1.01;
