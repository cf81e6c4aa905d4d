//! How far the table is from the kernel, as the Earth sees it.

use glam::DVec3;
use rayon::prelude::*;

use super::{DAYS, FIRST_JD, PLANS, Place};
use crate::ephemeris::kernel::Kernel;
use crate::ephemeris::moon::EARTH_MOON_MASS_RATIO;
use crate::ephemeris::resampled::{Channel, Depth, Table};
use crate::time::{JulianDate, Tdb};
use crate::units::Angle;

/// The largest errors of one channel at one depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyErrors {
    /// Name of the channel.
    pub id: &'static str,
    pub depth: Depth,
    /// Of the direction from the Earth (the Sun's for the Earth-Moon barycentre).
    pub direction: Angle,
    /// Of the distance from the Earth, km.
    pub distance_km: f64,
    /// Of the position in the channel itself, km.
    pub position_km: f64,
    /// What folding adds to that, km.
    pub folding_km: f64,
}

/// The largest errors of every channel and depth at so many dates spread over the span.
///
/// Positions are geometric, at the same moment from the Earth of the kernel and of the table: light
/// time moves the dates, not the errors.
pub fn errors(kernel: &Kernel, table: &Table, dates: u32) -> Result<Vec<BodyErrors>, String> {
    let channels: Vec<&Channel> = PLANS
        .iter()
        .map(|plan| table.channel(plan.id).ok_or(format!("has no channel {:?}", plan.id)))
        .collect::<Result<_, _>>()?;
    let blank = || {
        let row = |depth| {
            PLANS.iter().map(move |plan| BodyErrors {
                id: plan.id,
                depth,
                direction: Angle::ZERO,
                distance_km: 0.0,
                position_km: 0.0,
                folding_km: 0.0,
            })
        };
        Depth::ALL.into_iter().flat_map(row).collect::<Vec<_>>()
    };
    (0..dates)
        .into_par_iter()
        .map(|index| {
            // The golden ratio spreads dates evenly, off all borders.
            let part = (f64::from(index) * 0.618_033_988_749_894_9 + 0.3).fract();
            let tdb = JulianDate::from_parts(FIRST_JD, part * f64::from(DAYS));
            at(kernel, &channels, tdb, blank())
        })
        .try_reduce(blank, |one, other| {
            Ok(one.into_iter().zip(other).map(|(one, other)| one.larger(other)).collect())
        })
}

fn at(
    kernel: &Kernel,
    channels: &[&Channel],
    tdb: JulianDate<Tdb>,
    mut rows: Vec<BodyErrors>,
) -> Result<Vec<BodyErrors>, String> {
    let truth: Vec<DVec3> =
        PLANS.iter().map(|plan| plan.body.km(kernel, tdb)).collect::<Result<_, _>>()?;
    let true_views = views(&truth);
    for (depth, rows) in Depth::ALL.into_iter().zip(rows.chunks_exact_mut(PLANS.len())) {
        let seen: Vec<DVec3> = channels.iter().map(|channel| channel.value(tdb, depth)).collect();
        for (index, (row, view)) in rows.iter_mut().zip(views(&seen)).enumerate() {
            let true_view = true_views[index];
            row.direction =
                Angle::from_rad(view.cross(true_view).length().atan2(view.dot(true_view)));
            row.distance_km = (view.length() - true_view.length()).abs();
            row.position_km = (seen[index] - truth[index]).length();
            row.folding_km = (seen[index] - channels[index].unfolded_value(tdb, depth)).length();
        }
    }
    Ok(rows)
}

/// From the Earth, in the order of the channels.
fn views(positions: &[DVec3]) -> Vec<DVec3> {
    let place = |id: &str| {
        let index = PLANS.iter().position(|plan| plan.id == id);
        index.map_or(DVec3::ZERO, |index| positions[index])
    };
    let (sun, moon) = (place("sun"), place("moon"));
    let earth = sun + place("earth-moon") - moon / (1.0 + EARTH_MOON_MASS_RATIO);
    let view = |(plan, &position): (&super::Plan, &DVec3)| match plan.body {
        Place::MoonFromEarth => position,
        // From the Earth this is the Sun: its own channel says where both stand.
        Place::FromSun(super::EARTH_MOON) | Place::FromBarycentre(super::SUN) => sun - earth,
        Place::FromSun(_) => sun + position - earth,
        Place::FromBarycentre(_) => position - earth,
    };
    PLANS.iter().zip(positions).map(view).collect()
}

impl BodyErrors {
    fn larger(self, other: BodyErrors) -> BodyErrors {
        BodyErrors {
            direction: self.direction.max(other.direction),
            distance_km: self.distance_km.max(other.distance_km),
            position_km: self.position_km.max(other.position_km),
            folding_km: self.folding_km.max(other.folding_km),
            ..self
        }
    }
}
