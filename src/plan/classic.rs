//! A classic sky as the light of a frame: its sky above the horizon, level ground through Hoffman &
//! Preetham's air below it.
//!
//! The ground is a Lambert plane of the albedo of the air's document, lit by the model's sky and by the
//! Sun through the air of this program (not under the overcast sky). It is flat, and ends where the
//! horizon of a round Earth would be, without refraction. The sky above the mathematical horizon is that
//! of the model; between it and the visible one, which lies lower, the model's horizon goes on.

use std::f64::consts::PI;

use rayon::prelude::*;

use crate::air::EARTH_RADIUS_KM;
use crate::air::classic::aerial::AerialPerspective;
use crate::air::classic::{ClassicSky, ClassicSkyError, SkyUnderSun, daylight};
use crate::air::extinction::transmittance;
use crate::air::scattering::{SkyView, horizon};
use crate::light::night::Night;
use crate::light::spectrum::{Spectrum, chromaticity_xy};
use crate::units::{Angle, Xyzv};

use super::{SKY_SHAPE, SkyPlan, SourceSky};

/// A classic sky over its ground, in the weather and under the Sun of a night.
#[derive(Debug, Clone, PartialEq)]
pub struct ClassicLight {
    pub sky: SkyUnderSun,
    air: AerialPerspective,
    /// Irradiance of the Sun at the ground on a plane that faces it, W m-2 nm-1.
    sun: Spectrum,
    /// Radiance of the ground where one stands, W m-2 sr-1 nm-1.
    ground: Spectrum,
    eye_above_ground_km: f64,
}

impl ClassicLight {
    pub fn of(document: &ClassicSky, night: &Night) -> Result<ClassicLight, ClassicSkyError> {
        let (air, height_m) = (&night.air, night.sky.place.height_m);
        let sun_altitude =
            air.refraction_at(height_m).apparent_from_horizon(night.sky.sun.dir).altitude();
        let sky = document.under(air, height_m, sun_altitude)?;
        let sun = match document.model.lets_sun_through() {
            true => night.irradiance(&night.sky.sun) * transmittance(air, height_m, sun_altitude),
            false => Spectrum::DARK,
        };
        let from_sky = sky.illuminance();
        let xy = chromaticity_xy(from_sky).unwrap_or(daylight::D65_XY);
        let lit = daylight::spectrum(xy).scaled_to_photopic(from_sky.y) + sun * sun_altitude.sin();
        Ok(ClassicLight {
            sky,
            air: AerialPerspective::new(air, height_m),
            sun,
            ground: lit * (air.ground.albedo / PI),
            eye_above_ground_km: air.eye_km(height_m) - air.ground_km(height_m),
        })
    }

    /// Luminance of the ground in an apparent direction below the horizon, cd/m2.
    pub fn ground(&self, altitude: Angle, azimuth_from_sun: Angle) -> Xyzv {
        let farthest_km = (2.0 * EARTH_RADIUS_KM * self.eye_above_ground_km).sqrt();
        let distance_km = match -altitude.sin() {
            down if down > 0.0 => (self.eye_above_ground_km / down).min(farthest_km),
            _ => farthest_km,
        };
        let ((sin, cos), (sun_sin, sun_cos)) =
            (altitude.sin_cos(), self.sky.sun_altitude.sin_cos());
        let cos_from_sun = sin * sun_sin + cos * sun_cos * azimuth_from_sun.cos();
        self.air.seen(self.ground, distance_km, cos_from_sun, &self.sun).xyzv()
    }

    /// The tables of a frame, in place of those of the solved air.
    pub fn plan(&self, night: &Night) -> SkyPlan {
        let height_m = night.sky.place.height_m;
        let shape = SKY_SHAPE;
        let mut plan = SkyPlan::black(horizon(&night.air, height_m, night.air.eye_km(height_m)));
        let light = |node: usize| {
            let (row, azimuth) = (node / shape.azimuths, shape.azimuth(node % shape.azimuths));
            let altitude = shape.elevation(row, plan.horizon);
            match shape.is_above(row) {
                true => self.sky.luminance(altitude.max(Angle::ZERO), azimuth),
                false => self.ground(altitude, azimuth),
            }
        };
        let lights: Vec<[f32; 4]> =
            (0..shape.nodes()).into_par_iter().map(|node| light(node).to_f32()).collect();
        let view = SkyView {
            shape,
            horizon: plan.horizon,
            source_elevation: self.sky.sun_altitude,
            channels: 4,
            smooth: lights.concat(),
            haze: Vec::new(),
            phase: None,
        };
        plan.sun = Some(SourceSky { azimuth: night.sky.sun.dir.azimuth(), view });
        plan
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::air::Atmosphere;
    use crate::air::classic::ClassicModel;
    use crate::ephemeris::Ephemeris;
    use crate::frame::Dir;
    use crate::place::Place;
    use crate::sky::SkyState;
    use crate::time;

    fn night(clock: &str) -> Night {
        let instant = time::parse(&format!("2027-03-20T{clock}Z")).unwrap();
        let instant = time::to_instant(&instant, None).unwrap();
        let place = Place::new(51.478, 0.0, 47.0).unwrap();
        let tolerance = Angle::from_arcmin(10.0);
        let sky = SkyState::at(&Ephemeris::analytic(), &instant, &place, tolerance).unwrap();
        Night::of(sky, Vec::new(), &Atmosphere::default())
    }

    #[test]
    fn the_tables_hold_the_model() {
        let night = night("15:00");
        for model in ClassicModel::ALL {
            let light = ClassicLight::of(&ClassicSky::new(model), &night).unwrap();
            let plan = light.plan(&night);
            for (altitude_deg, azimuth_deg) in [(90.0, 0.0), (40.0, 50.0), (7.0, 130.0), (0.5, 0.0)]
            {
                let (altitude, azimuth) =
                    (Angle::from_deg(altitude_deg), Angle::from_deg(azimuth_deg));
                let towards =
                    Dir::from_azimuth_altitude(night.sky.sun.dir.azimuth() + azimuth, altitude);
                let (got, wanted) =
                    (plan.luminance(towards), light.sky.luminance(altitude, azimuth));
                // Straight lines between nodes: 1 % away from the Sun.
                assert!((got.y / wanted.y - 1.0).abs() < 0.01, "{model:?}: {got:?} {wanted:?}");
            }
        }
    }

    #[test]
    fn the_ground_fades_into_its_air() {
        let night = night("15:00");
        let light = ClassicLight::of(&ClassicSky::new(ClassicModel::Preetham), &night).unwrap();
        let below = |altitude_deg, azimuth_deg| {
            light.ground(Angle::from_deg(altitude_deg), Angle::from_deg(azimuth_deg))
        };
        let (feet, towards, away) = (below(-90.0, 0.0), below(-0.05, 0.0), below(-0.05, 180.0));
        // A Lambert plane under sky and Sun, and little air before it.
        let sun = night.body(crate::ephemeris::Body::Sun).unwrap();
        let lx = light.sky.illuminance().y + sun.ground.y * sun.apparent.altitude().sin();
        assert!((feet.y / (lx * 0.1 / PI) - 1.0).abs() < 0.01, "{feet:?} {lx}");
        // Near the horizon haze shines before it under the Sun, and opposite takes more than it gives.
        assert!(towards.y > 2.0 * feet.y && away.y < feet.y, "{towards:?} {feet:?} {away:?}");
    }

    #[test]
    fn no_sun_no_sky() {
        for model in ClassicModel::ALL {
            let refused = ClassicLight::of(&ClassicSky::new(model), &night("19:00")).unwrap_err();
            assert!(refused.to_string().contains("Sun above the horizon"), "{refused}");
        }
    }
}
