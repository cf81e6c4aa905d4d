//! What is computed rather than stored: a motion that a channel follows, and the axes in which it is
//! said how far it strays.

use glam::{DMat3, DVec3};

use super::header::{Fields, Writer};
use crate::ephemeris::orientation::Nutation;
use crate::ephemeris::polynomial::polynomial;
use crate::time::{JulianDate, Tdb};

/// Sine and cosine of the obliquity of the ecliptic J2000.0, 84381.406" (IAU 2006). It tilts the
/// reference alone: another value would change the residuals, not their sum.
const OBLIQUITY_SIN: f64 = 0.397776969112606;
const OBLIQUITY_COS: f64 = 0.9174821430652418;

/// Coefficients of the powers of Julian centuries from J2000.0.
pub type Powers = [f64; 4];

/// A motion of which only the residuals are stored.
///
/// `value = origin + axes * residual`, with [`Reference::at`] for origin and axes.
#[derive(Debug, Clone, PartialEq)]
pub enum Reference {
    /// Nothing: the residual is the value itself.
    None,
    /// Nutation by the 77 terms of IAU 2000B: longitude, obliquity and locator, radians.
    ShortNutation,
    /// A mean ellipse; residuals are radial, transverse and normal to its plane.
    Orbit(Box<Orbit>),
}

/// A Kepler ellipse whose elements change with time, in ecliptic and equinox J2000.0.
///
/// Elements are those of Lagrange, free of singularities: `k = e cos ϖ`, `h = e sin ϖ`,
/// `q = sin(i/2) cos Ω`, `p = sin(i/2) sin Ω`. Both pairs are told in axes that turn by themselves,
/// so that the Moon's perigee and node, which run around, have elements that hardly change.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Orbit {
    /// Semi-major axis, km.
    pub axis_km: Powers,
    /// Mean longitude, rad.
    pub longitude_rad: Powers,
    /// `k` and `h` in axes that have turned by `perihelion_turn_rad`.
    pub eccentricity_cos: Powers,
    pub eccentricity_sin: Powers,
    pub perihelion_turn_rad: Powers,
    /// `q` and `p` in axes that have turned by `node_turn_rad`.
    pub inclination_cos: Powers,
    pub inclination_sin: Powers,
    pub node_turn_rad: Powers,
}

/// Where the reference is, and its axes as columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Station {
    pub origin: DVec3,
    pub axes: DMat3,
}

impl Reference {
    /// Origin and axes at a moment, in the frame of the channel.
    pub(super) fn at(&self, tdb: JulianDate<Tdb>) -> Station {
        match self {
            Reference::None => Station { origin: DVec3::ZERO, axes: DMat3::IDENTITY },
            Reference::ShortNutation => {
                // TT and TDB differ by 2 ms, nutation by 1e-9" in that time.
                let nutation = Nutation::iau2000b(tdb.read_on(0.0));
                Station { origin: nutation.vector_rad(), axes: DMat3::IDENTITY }
            }
            Reference::Orbit(orbit) => orbit.at(tdb),
        }
    }

    pub(super) fn write(&self, writer: &mut Writer) {
        match self {
            Reference::None => writer.u8(0),
            Reference::ShortNutation => writer.u8(2),
            Reference::Orbit(orbit) => {
                writer.u8(1);
                for powers in orbit.powers() {
                    powers.iter().for_each(|&value| writer.f64(value));
                }
            }
        }
    }

    pub(super) fn read(fields: &mut Fields) -> Result<Reference, String> {
        match fields.u8()? {
            0 => Ok(Reference::None),
            1 => {
                let mut orbit = Orbit::default();
                for powers in orbit.powers_mut() {
                    for value in powers {
                        *value = fields.f64()?;
                    }
                }
                Ok(Reference::Orbit(Box::new(orbit)))
            }
            2 => Ok(Reference::ShortNutation),
            other => Err(format!("asks for reference {other}, which this program does not know")),
        }
    }
}

impl Orbit {
    fn powers(&self) -> [&Powers; 8] {
        [
            &self.axis_km,
            &self.longitude_rad,
            &self.eccentricity_cos,
            &self.eccentricity_sin,
            &self.perihelion_turn_rad,
            &self.inclination_cos,
            &self.inclination_sin,
            &self.node_turn_rad,
        ]
    }

    fn powers_mut(&mut self) -> [&mut Powers; 8] {
        [
            &mut self.axis_km,
            &mut self.longitude_rad,
            &mut self.eccentricity_cos,
            &mut self.eccentricity_sin,
            &mut self.perihelion_turn_rad,
            &mut self.inclination_cos,
            &mut self.inclination_sin,
            &mut self.node_turn_rad,
        ]
    }

    fn at(&self, tdb: JulianDate<Tdb>) -> Station {
        let t = tdb.centuries_since_j2000();
        let [axis_km, longitude, k0, h0, perihelion_turn, q0, p0, node_turn] =
            self.powers().map(|powers| polynomial(powers, t));
        let turned = |x: f64, y: f64, angle: f64| {
            let (sin, cos) = angle.sin_cos();
            (x * cos - y * sin, x * sin + y * cos)
        };
        let (k, h) = turned(k0, h0, perihelion_turn);
        let (q, p) = turned(q0, p0, node_turn);

        // Kepler's equation for the eccentric longitude F = E + ϖ: λ = F - k sin F + h cos F.
        // Newton's method doubles the digits with every step; eccentricities are below 0.3.
        let (sin, cos) = longitude.sin_cos();
        let mut eccentric = longitude + k * sin - h * cos;
        for _ in 0..10 {
            let (sin, cos) = eccentric.sin_cos();
            let excess = eccentric - k * sin + h * cos - longitude;
            let step = excess / (1.0 - k * cos - h * sin);
            eccentric -= step;
            if step.abs() < 1e-8 {
                break;
            }
        }
        let (sin, cos) = eccentric.sin_cos();
        let beta = 1.0 / (1.0 + (1.0 - h * h - k * k).sqrt());
        let x = axis_km * ((1.0 - beta * h * h) * cos + beta * h * k * sin - k);
        let y = axis_km * ((1.0 - beta * k * k) * sin + beta * h * k * cos - h);

        // From the plane of the orbit to the ecliptic, to the equator.
        let root = (1.0 - p * p - q * q).sqrt();
        let first = DVec3::new(1.0 - 2.0 * p * p, 2.0 * p * q, -2.0 * p * root);
        let second = DVec3::new(2.0 * p * q, 1.0 - 2.0 * q * q, 2.0 * q * root);
        let equatorial = |v: DVec3| {
            let (sin, cos) = (OBLIQUITY_SIN, OBLIQUITY_COS);
            DVec3::new(v.x, cos * v.y - sin * v.z, sin * v.y + cos * v.z)
        };
        let origin = equatorial(x * first + y * second);
        let radial = origin.normalize();
        let normal = equatorial(first.cross(second));
        Station { origin, axes: DMat3::from_cols(radial, normal.cross(radial), normal) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::{AU_KM, Angle};

    fn mercury() -> Orbit {
        // Simon et al. 1994, table 6, rounded.
        let (e, perihelion, tilt, node) = (0.205_63, 1.351_89, 0.122_26f64, 0.843_53f64);
        let half = (tilt / 2.0).sin();
        Orbit {
            axis_km: [0.387_098_31 * AU_KM, 0.0, 0.0, 0.0],
            longitude_rad: [4.402_608_84, 2_608.790_314_16, 0.0, 0.0],
            eccentricity_cos: [e * f64::cos(perihelion), 0.0, 0.0, 0.0],
            eccentricity_sin: [e * f64::sin(perihelion), 0.0, 0.0, 0.0],
            inclination_cos: [half * node.cos(), 0.0, 0.0, 0.0],
            inclination_sin: [half * node.sin(), 0.0, 0.0, 0.0],
            ..Orbit::default()
        }
    }

    #[test]
    fn an_ellipse_obeys_kepler() {
        let orbit = mercury();
        let at = |day: f64| orbit.at(JulianDate::from_jd(2_451_545.0 + day)).origin;
        let areal = |day: f64| at(day).cross((at(day + 0.01) - at(day - 0.01)) / 0.02);
        let first = areal(0.0);
        let (mut low, mut high) = (f64::INFINITY, 0.0f64);
        for day in 0..88 {
            let day = f64::from(day);
            assert!((areal(day) - first).length() / first.length() < 1e-6, "day {day}");
            low = low.min(at(day).length());
            high = high.max(at(day).length());
        }
        let axis = 0.5 * (low + high) / AU_KM;
        assert!(
            (axis - 0.3871).abs() < 2e-4 && ((high - low) / (high + low) - 0.2056).abs() < 1e-3
        );
    }

    #[test]
    fn mercury_is_where_its_elements_put_it() {
        // x, y, z in au by the textbook: E from M, then the three rotations (numpy).
        let station = mercury().at(JulianDate::from_jd(2_451_545.0));
        let textbook = textbook_position(&mercury());
        assert!((station.origin - textbook).length() < 1e-3, "{:?} {textbook:?}", station.origin);
        assert!((station.axes * DVec3::X - textbook.normalize()).length() < 1e-11);
        assert!((station.axes.determinant() - 1.0).abs() < 1e-14);
    }

    /// The usual way, with angles.
    fn textbook_position(orbit: &Orbit) -> DVec3 {
        use crate::frame::{turn_axes_x, turn_axes_z};
        let e = orbit.eccentricity_cos[0].hypot(orbit.eccentricity_sin[0]);
        let perihelion = orbit.eccentricity_sin[0].atan2(orbit.eccentricity_cos[0]);
        let node = orbit.inclination_sin[0].atan2(orbit.inclination_cos[0]);
        let tilt = 2.0 * orbit.inclination_cos[0].hypot(orbit.inclination_sin[0]).asin();
        let mean = orbit.longitude_rad[0] - perihelion;
        let mut anomaly = mean;
        for _ in 0..100 {
            anomaly = mean + e * anomaly.sin();
        }
        let a = orbit.axis_km[0];
        let flat =
            DVec3::new(a * (anomaly.cos() - e), a * (1.0 - e * e).sqrt() * anomaly.sin(), 0.0);
        let turn = |rad: f64| Angle::from_rad(-rad);
        turn_axes_x(Angle::from_arcsec(-84_381.406))
            * turn_axes_z(turn(node))
            * turn_axes_x(turn(tilt))
            * turn_axes_z(turn(perihelion - node))
            * flat
    }

    #[test]
    fn axes_that_turn_carry_perihelion_and_node_along() {
        let still = mercury();
        let quarter = std::f64::consts::FRAC_PI_2;
        let unturned = |x: [f64; 4], y: [f64; 4]| (y, [-x[0], 0.0, 0.0, 0.0]);
        let (k, h) = unturned(still.eccentricity_cos, still.eccentricity_sin);
        let (q, p) = unturned(still.inclination_cos, still.inclination_sin);
        let turned = Orbit {
            eccentricity_cos: k,
            eccentricity_sin: h,
            perihelion_turn_rad: [quarter, 0.0, 0.0, 0.0],
            inclination_cos: q,
            inclination_sin: p,
            node_turn_rad: [quarter, 0.0, 0.0, 0.0],
            ..still.clone()
        };
        let at = JulianDate::from_jd(2_455_555.5);
        assert!((turned.at(at).origin - still.at(at).origin).length() < 1e-6);
    }
}
