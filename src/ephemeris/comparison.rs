//! How far a table of motion is from what it was made of, as the Earth sees it.

use glam::DVec3;
use rayon::prelude::*;

use super::moon::EARTH_MOON_MASS_RATIO;
use super::resampled::{Channel, Depth, Table};
use crate::time::{JulianDate, Tdb};
use crate::units::Angle;

/// Where a channel should be at a moment, km; or why that is not known.
pub type Truth<'a> = dyn Fn(&str, JulianDate<Tdb>) -> Result<DVec3, String> + Sync + 'a;

/// The largest errors of one channel at one depth.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyErrors {
    /// Name of the channel.
    pub id: String,
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

/// The largest errors of every channel and depth at so many dates spread over the span of the table.
///
/// The truth is asked by channel and moment, in km as the channel is. Positions are geometric, at the
/// same moment from the Earth of the truth and of the table: light time moves the dates, not the errors.
pub fn errors(
    table: &Table,
    truth: &Truth,
    depths: &[Depth],
    dates: u32,
) -> Result<Vec<BodyErrors>, String> {
    let channels: Vec<&Channel> = table.channels().collect();
    let (first, last) = match channels.first() {
        Some(channel) => channel.span(),
        None => return Err("has no channels".into()),
    };
    let blank = || {
        let row = |&depth| {
            channels.iter().map(move |channel| BodyErrors {
                id: channel.id().into(),
                depth,
                direction: Angle::ZERO,
                distance_km: 0.0,
                position_km: 0.0,
                folding_km: 0.0,
            })
        };
        depths.iter().flat_map(row).collect::<Vec<_>>()
    };
    (0..dates)
        .into_par_iter()
        .map(|index| {
            // The golden ratio spreads dates evenly, off all borders.
            let part = (f64::from(index) * 0.618_033_988_749_894_9 + 0.3).fract();
            let mut rows = blank();
            compare(&channels, truth, first.plus_days(part * (last - first)), &mut rows)?;
            Ok(rows)
        })
        .try_reduce(blank, |one, other| {
            Ok(one.into_iter().zip(other).map(|(one, other)| one.larger(other)).collect())
        })
}

fn compare(
    channels: &[&Channel],
    truth: &Truth,
    tdb: JulianDate<Tdb>,
    rows: &mut [BodyErrors],
) -> Result<(), String> {
    let true_places: Vec<DVec3> =
        channels.iter().map(|channel| truth(channel.id(), tdb)).collect::<Result<_, _>>()?;
    let true_views = views(channels, &true_places);
    for rows in rows.chunks_exact_mut(channels.len()) {
        let depth = rows[0].depth;
        let places: Vec<DVec3> = channels.iter().map(|channel| channel.value(tdb, depth)).collect();
        for (index, (row, view)) in rows.iter_mut().zip(views(channels, &places)).enumerate() {
            let true_view = true_views[index];
            row.direction =
                Angle::from_rad(view.cross(true_view).length().atan2(view.dot(true_view)));
            row.distance_km = (view.length() - true_view.length()).abs();
            row.position_km = (places[index] - true_places[index]).length();
            row.folding_km = (places[index] - channels[index].unfolded_value(tdb, depth)).length();
        }
    }
    Ok(())
}

/// From the Earth, in the order of the channels.
fn views(channels: &[&Channel], places: &[DVec3]) -> Vec<DVec3> {
    let place = |id: &str| {
        let index = channels.iter().position(|channel| channel.id() == id);
        index.map_or(DVec3::ZERO, |index| places[index])
    };
    let (sun, moon) = (place("sun"), place("moon"));
    let earth = sun + place("earth-moon") - moon / (1.0 + EARTH_MOON_MASS_RATIO);
    let view = |(channel, &place): (&&Channel, &DVec3)| match channel.id() {
        "moon" => place,
        // From the Earth this is the Sun: its own channel says where both stand.
        "earth-moon" | "sun" => sun - earth,
        "mercury" | "venus" | "mars" => sun + place - earth,
        _ => place - earth,
    };
    channels.iter().zip(places).map(view).collect()
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
