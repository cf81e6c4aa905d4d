//! The all-weather sky of Perez, Seals & Michalsky 1993, *Solar Energy* 50, 235 (erratum 51, 423).
//!
//! The weather is two numbers of Perez et al. 1990, *Solar Energy* 44, 271: clearness
//! `E = ((D + I) / D + k) / (1 + k)`, `k = 1.041 zs^3` (eq. 1), and brightness `Q = m D / I0` (eq. 2),
//! with `D` the diffuse irradiance of level ground, `I` the direct one on a plane that faces the Sun,
//! `I0` outside the air, `m` the air mass, `zs` the zenith distance of the Sun, radians. Eight classes
//! of clearness choose rows of table 1, and `a` to `e` of the gradation follow by
//! `x = x1 + x2 zs + Q (x3 + x4 zs)` (eq. 6), in the first class `c` and `d` by eqs. 7 and 8. Between
//! clearnesses 1.065 and 2.8 the brightness counts as 0.2 at least (erratum).
//!
//! The level is that of the paper: the sky lights level ground with `D` times the luminous efficacy of
//! Perez et al. 1990, eq. 7 and table 4.
//!
//! Without a given weather the sky is cloudless: `D` and `I` come from Linke's turbidity by the clear
//! sky of the European Solar Radiation Atlas (Rigollier, Bauer & Wald 2000, *Solar Energy* 68, 33).
//!
//! The tables are as in Radiance's `gendaymtx`, its air mass is Kasten's of 1966. Negative luminances,
//! which the formula can give, are set to zero as there. The Sun counts as no higher than 87 degrees,
//! which keeps the aureole off the zenith.

use std::f64::consts::PI;

use crate::units::Angle;

use super::gradation::{Direction, Gradation};
use super::turbidity::WATER_CM;

/// Clearnesses that occur.
pub const CLEARNESSES: (f64, f64) = (1.0, 12.0);
/// Brightnesses that occur.
pub const BRIGHTNESSES: (f64, f64) = (0.01, 0.6);

/// Irradiance outside the air, as in the publications, W/m2.
const SOLAR_CONSTANT_W_M2: f64 = 1367.0;
/// The Sun of the model stands no higher.
const HIGHEST_SUN: Angle = Angle::from_deg(87.0);

/// Where each class of clearness but the first begins (Perez et al. 1990, table 1).
const CLASSES: [f64; 7] = [1.065, 1.230, 1.500, 1.950, 2.800, 4.500, 6.200];
/// The clearnesses between which a low brightness counts as more (erratum).
const BRIGHTENED: (f64, f64) = (1.065, 2.8);
const LEAST_BRIGHTNESS_THERE: f64 = 0.2;

/// Table 1 of 1993: by class, four numbers for each of a to e.
#[rustfmt::skip]
const TABLE: [[[f64; 4]; 5]; 8] = [
    [[1.3525, -0.2576, -0.2690, -1.4366], [-0.7670, 0.0007, 1.2734, -0.1233],
     [2.8000, 0.6004, 1.2375, 1.0000], [1.8734, 0.6297, 0.9738, 0.2809],
     [0.0356, -0.1246, -0.5718, 0.9938]],
    [[-1.2219, -0.7730, 1.4148, 1.1016], [-0.2054, 0.0367, -3.9128, 0.9156],
     [6.9750, 0.1774, 6.4477, -0.1239], [-1.5798, -0.5081, -1.7812, 0.1080],
     [0.2624, 0.0672, -0.2190, -0.4285]],
    [[-1.1000, -0.2515, 0.8952, 0.0156], [0.2782, -0.1812, -4.5000, 1.1766],
     [24.7219, -13.0812, -37.7000, 34.8438], [-5.0000, 1.5218, 3.9229, -2.6204],
     [-0.0156, 0.1597, 0.4199, -0.5562]],
    [[-0.5484, -0.6654, -0.2672, 0.7117], [0.7234, -0.6219, -5.6812, 2.6297],
     [33.3389, -18.3000, -62.2500, 52.0781], [-3.5000, 0.0016, 1.1477, 0.1062],
     [0.4659, -0.3296, -0.0876, -0.0329]],
    [[-0.6000, -0.3566, -2.5000, 2.3250], [0.2937, 0.0496, -5.6812, 1.8415],
     [21.0000, -4.7656, -21.5906, 7.2492], [-3.5000, -0.1554, 1.4062, 0.3988],
     [0.0032, 0.0766, -0.0656, -0.1294]],
    [[-1.0156, -0.3670, 1.0078, 1.4051], [0.2875, -0.5328, -3.8500, 3.3750],
     [14.0000, -0.9999, -7.1406, 7.5469], [-3.4000, -0.1078, -1.0750, 1.5702],
     [-0.0672, 0.4016, 0.3017, -0.4844]],
    [[-1.0000, 0.0211, 0.5025, -0.5119], [-0.3000, 0.1922, 0.7023, -1.6317],
     [19.0000, -5.0000, 1.2438, -1.9094], [-4.0000, 0.0250, 0.3844, 0.2656],
     [1.0468, -0.3788, -2.4517, 1.4656]],
    [[-1.0500, 0.0289, 0.4260, 0.3590], [-0.3250, 0.1156, 0.7781, 0.0025],
     [31.0625, -14.5000, -46.1148, 55.3750], [-7.2312, 0.4050, 13.3500, 0.6234],
     [1.5000, -0.6426, 1.8564, 0.5636]],
];

/// Luminous efficacy of diffuse light, lm/W (Perez et al. 1990, table 4): by class, alone, with the
/// water (cm), with the cosine of the Sun's zenith distance, with the logarithm of the brightness.
const EFFICACY: [[f64; 4]; 8] = [
    [97.24, -0.46, 12.00, -8.91],
    [107.22, 1.15, 0.59, -3.95],
    [104.97, 2.96, -5.53, -8.77],
    [102.39, 5.59, -13.95, -13.90],
    [100.71, 5.94, -22.75, -23.74],
    [106.42, 3.83, -36.15, -28.83],
    [141.88, 1.90, -53.24, -14.03],
    [152.23, 0.35, -45.27, -7.98],
];

/// The weather in two numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weather {
    /// 1 without any direct light, 6 and more without clouds.
    pub clearness: f64,
    /// 0.05 for a dark sky, 0.5 for bright clouds.
    pub brightness: f64,
}

impl Weather {
    /// From irradiances (W/m2): diffuse on level ground, direct on a plane that faces the Sun.
    pub fn of_irradiances(diffuse_w_m2: f64, direct_w_m2: f64, sun_altitude: Angle) -> Weather {
        let k = 1.041 * (PI / 2.0 - sun_altitude.rad()).powi(3);
        let clearness = ((diffuse_w_m2 + direct_w_m2) / diffuse_w_m2 + k) / (1.0 + k);
        let brightness = air_mass(sun_altitude) * diffuse_w_m2 / SOLAR_CONSTANT_W_M2;
        Weather {
            clearness: clearness.clamp(CLEARNESSES.0, CLEARNESSES.1),
            brightness: brightness.clamp(BRIGHTNESSES.0, BRIGHTNESSES.1),
        }
    }

    /// Without clouds, at Linke's turbidity.
    pub fn cloudless(turbidity: f64, sun_altitude: Angle) -> Weather {
        let (diffuse, direct) = cloudless_irradiances(turbidity, sun_altitude);
        Weather::of_irradiances(diffuse, direct, sun_altitude)
    }

    fn class(&self) -> usize {
        CLASSES.iter().filter(|&&begin| self.clearness >= begin).count()
    }

    /// Diffuse illuminance of level ground, lux.
    pub fn illuminance_lx(&self, sun_altitude: Angle) -> f64 {
        let [alone, water, cosine, log] = EFFICACY[self.class()];
        let efficacy =
            alone + water * WATER_CM + cosine * sun_altitude.sin() + log * self.brightness.ln();
        let diffuse_w_m2 = self.brightness * SOLAR_CONSTANT_W_M2 / air_mass(sun_altitude);
        efficacy.max(0.0) * diffuse_w_m2
    }

    /// The gradation of this weather.
    pub fn gradation(&self, sun_altitude: Angle) -> Gradation {
        let sun_zenith = PI / 2.0 - sun_altitude.rad().min(HIGHEST_SUN.rad());
        let low = (BRIGHTENED.0..BRIGHTENED.1).contains(&self.clearness);
        let brightness =
            if low { self.brightness.max(LEAST_BRIGHTNESS_THERE) } else { self.brightness };
        let class = self.class();
        let [a, b, mut c, mut d, e] = TABLE[class]
            .map(|[x1, x2, x3, x4]| x1 + x2 * sun_zenith + brightness * (x3 + x4 * sun_zenith));
        if class == 0 {
            let [c1, c2, c3, c4] = TABLE[0][2];
            c = (brightness * (c1 + c2 * sun_zenith)).powf(c3).exp() - c4;
            let [d1, d2, d3, d4] = TABLE[0][3];
            d = -(brightness * (d1 + d2 * sun_zenith)).exp() + d3 + brightness * d4;
        }
        Gradation { a, b, c, d, e }
    }
}

/// Relative air mass; Kasten 1966, as the publications of Perez use it.
fn air_mass(sun_altitude: Angle) -> f64 {
    1.0 / (sun_altitude.sin() + 0.15 * (sun_altitude.deg() + 3.885).powf(-1.253))
}

/// Diffuse irradiance of level ground and direct irradiance facing the Sun, W/m2, at sea level under no
/// clouds: Rigollier et al. 2000, with the optical depth of clean air of Kasten 1996.
fn cloudless_irradiances(turbidity: f64, sun_altitude: Angle) -> (f64, f64) {
    let sine = sun_altitude.sin();
    // Kasten & Young 1989.
    let mass = 1.0 / (sine + 0.505_72 * (sun_altitude.deg() + 6.079_95).powf(-1.6364));
    let inverse_depth = if mass <= 20.0 {
        6.6296 + mass * (1.7513 + mass * (-0.1202 + mass * (0.0065 - mass * 0.000_13)))
    } else {
        10.4 + 0.718 * mass
    };
    let direct = (-0.8662 * turbidity * mass / inverse_depth).exp();
    let in_zenith = -0.015_843 + turbidity * (0.030_543 + turbidity * 3.797e-4);
    let a0 = 0.264_63 + turbidity * (-0.061_581 + turbidity * 0.003_140_8);
    let a0 = a0.max(0.002 / in_zenith);
    let a1 = 2.0402 + turbidity * (0.018_945 - turbidity * 0.011_161);
    let a2 = -1.3025 + turbidity * (0.039_231 + turbidity * 0.008_507_9);
    let diffuse = in_zenith * (a0 + sine * (a1 + sine * a2));
    (diffuse * SOLAR_CONSTANT_W_M2, direct * SOLAR_CONSTANT_W_M2)
}

/// A sky.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AllWeather {
    pub weather: Weather,
    pub gradation: Gradation,
    /// Luminance where the gradation is one, cd/m2.
    unit_cd_m2: f64,
}

impl AllWeather {
    pub fn under(weather: Weather, sun_altitude: Angle) -> AllWeather {
        let mut sky =
            AllWeather { weather, gradation: weather.gradation(sun_altitude), unit_cd_m2: 1.0 };
        sky.unit_cd_m2 = weather.illuminance_lx(sun_altitude) / sky.relative_lx(sun_altitude);
        sky
    }

    /// Luminance, cd/m2.
    pub fn cd_m2(&self, direction: &Direction) -> f64 {
        self.unit_cd_m2 * self.gradation.at(direction).max(0.0)
    }

    /// Illuminance of level ground, lux; the integral of `SkyUnderSun::illuminance`.
    fn relative_lx(&self, sun_altitude: Angle) -> f64 {
        super::over_the_sky(|altitude, azimuth| {
            self.cd_m2(&Direction::of(altitude, azimuth, sun_altitude))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weather_of_irradiances_is_that_of_the_definition() {
        let sun = Angle::from_deg(90.0);
        let weather = Weather::of_irradiances(100.0, 800.0, sun);
        assert!((weather.clearness - 9.0).abs() < 1e-12);
        assert!((weather.brightness - 100.0 / 1367.0).abs() < 1e-4);
        assert_eq!(Weather::of_irradiances(100.0, 0.0, sun).clearness, 1.0);
        for (clearness, class) in [(1.0, 0), (1.0649, 0), (1.065, 1), (6.199, 6), (6.2, 7)] {
            assert_eq!(Weather { clearness, brightness: 0.2 }.class(), class);
        }
    }

    #[test]
    fn cloudless_irradiances_are_those_of_clear_days() {
        // Turbidity 3, Sun at 60 degrees, worked outside this program.
        let (diffuse, direct) = cloudless_irradiances(3.0, Angle::from_deg(60.0));
        assert!((direct - 960.630).abs() < 0.01, "{direct}");
        assert!((diffuse - 108.928).abs() < 0.01, "{diffuse}");
        // The two branches of the optical depth meet at an air mass of 20.
        let polynomial: f64 =
            6.6296 + 20.0 * (1.7513 + 20.0 * (-0.1202 + 20.0 * (0.0065 - 0.0026)));
        assert!((polynomial / (10.4 + 0.718 * 20.0) - 1.0).abs() < 0.01, "{polynomial}");
    }
}
