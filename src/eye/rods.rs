//! The colour of the night: the blue shift of Jensen et al.
//!
//! *Source.* Jensen, Premoze, Shirley, Thompson, Ferwerda & Stark 2000, *Night Rendering*, UUCS-00-016,
//! section 4; the same in Jensen et al. 2001 (*SIGGRAPH*, 399). Painters and films show what rods see
//! as a bluish grey. With `x = (log10 Y + 2) / 2.6` within 0 to 1, `s = 3 x^2 - 2 x^3`,
//!
//! - chromaticity: `s (x, y) + (1 - s) (0.25, 0.25)`,
//! - luminance: `s Y + 0.4468 (1 - s) V`.
//!
//! The colour is a convention of pictures, not a measurement; [`super::rod_intrusion`] is the other way.

use crate::units::Xyzv;

/// Below this the rods see alone, and above [`CONES_ALONE_LOG`] the cones: log10 of cd/m2.
pub const RODS_ALONE_LOG: f64 = -2.0;
/// See [`RODS_ALONE_LOG`].
pub const CONES_ALONE_LOG: f64 = 0.6;
/// CIE 1931 chromaticity of what rods see.
pub const CHROMATICITY: [f64; 2] = [0.25, 0.25];
/// The share of scotopic luminance that rods show as light.
pub const GAIN: f64 = 0.4468;
/// X, Y and Z of what rods see, for a luminance of 1.
pub const GREY_XYZ: [f64; 3] = [
    CHROMATICITY[0] / CHROMATICITY[1],
    1.0,
    (1.0 - CHROMATICITY[0] - CHROMATICITY[1]) / CHROMATICITY[1],
];

/// The share `s` of the cones in the colour of a light, 0 to 1.
pub fn cone_share(photopic_cd_m2: f64) -> f64 {
    if photopic_cd_m2 <= 0.0 {
        return 0.0;
    }
    let place = (photopic_cd_m2.log10() - RODS_ALONE_LOG) / (CONES_ALONE_LOG - RODS_ALONE_LOG);
    let x = place.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// The light that is seen of a light, X, Y, Z in cd/m2, as published.
pub fn shifted_xyz(light: Xyzv) -> [f64; 3] {
    let s = cone_share(light.y);
    let luminance = s * light.y + GAIN * (1.0 - s) * light.v;
    let sum = light.x + light.y + light.z;
    let mixed = |own: f64, night: f64| {
        if sum > 0.0 { s * own / sum + (1.0 - s) * night } else { night }
    };
    let (x, y) = (mixed(light.x, CHROMATICITY[0]), mixed(light.y, CHROMATICITY[1]));
    if y <= 0.0 {
        return [0.0; 3];
    }
    [luminance * x / y, luminance, luminance * (1.0 - x - y) / y]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_has_the_published_values() {
        for (log, want) in [
            (-3.0, 0.0),
            (-2.0, 0.0),
            (-1.0, 0.329_995),
            (-0.7, 0.5),
            (0.0, 0.864_816),
            (0.6, 1.0),
            (3.0, 1.0),
        ] {
            let got = cone_share(10f64.powf(log));
            assert!((got - want).abs() <= 1e-3 * want, "{log}: {got}, not {want}");
        }
        assert_eq!(cone_share(0.0), 0.0);
        assert_eq!(GREY_XYZ, [1.0, 1.0, 2.0]);
    }

    #[test]
    fn the_shift_goes_from_grey_to_the_colour_of_day() {
        let orange = |y: f64| Xyzv::new(1.2 * y, y, 0.3 * y, 0.9 * y);
        // By night 0.4468 V of the grey, by day the light itself.
        let night = shifted_xyz(orange(1e-3));
        for (got, want) in night.iter().zip([4.021_2e-4, 4.021_2e-4, 8.042_4e-4]) {
            assert!((got / want - 1.0).abs() < 1e-3, "{night:?}");
        }
        for (got, want) in shifted_xyz(orange(100.0)).iter().zip([120.0, 100.0, 30.0]) {
            assert!((got / want - 1.0).abs() < 1e-9);
        }
        // In the middle, 10^-0.7 cd/m2, both halves.
        let y = 10f64.powf(-0.7);
        let [got_x, got_y, got_z] = shifted_xyz(orange(y));
        let sum = got_x + got_y + got_z;
        assert!((got_x / sum - 0.5 * (0.48 + 0.25)).abs() < 1e-9);
        assert!((got_y / sum - 0.5 * (0.40 + 0.25)).abs() < 1e-9);
        assert!((got_y / (y * 0.5 * (1.0 + 0.4468 * 0.9)) - 1.0).abs() < 1e-9);
        assert_eq!(shifted_xyz(Xyzv::BLACK), [0.0; 3]);
    }
}
