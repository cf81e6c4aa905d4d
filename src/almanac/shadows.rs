//! Eclipses among the other events: the greatest moments, the contacts, and what the place sees.

use super::AlmanacError;
use super::eclipse::{LocalMoment, LunarEclipse, SolarEclipse, lunar_eclipses, solar_eclipses};
use super::event::{Contact, Event, View, What};
use super::span::Stretch;
use super::theory::Theory;
use crate::place::Place;

/// No moment of an eclipse is farther from the greatest.
const MARGIN_S: f64 = 6.0 * 3600.0;

/// What belongs to eclipses between two instants.
pub fn run(
    theory: &Theory,
    place: Option<&Place>,
    stretch: &Stretch,
) -> Result<Vec<Event>, AlmanacError> {
    // At the very end of all years there is nothing to look beyond.
    let from = stretch.start.plus_seconds(-MARGIN_S).unwrap_or(stretch.start);
    let to = stretch.end.plus_seconds(MARGIN_S).unwrap_or(stretch.end);
    let mut events = Vec::new();
    for eclipse in lunar_eclipses(&theory.ephemeris, from, to, theory.tolerance) {
        note_lunar(&eclipse?, place, &mut events)?;
    }
    for eclipse in solar_eclipses(&theory.ephemeris, from, to, theory.tolerance) {
        note_solar(&eclipse?, place, &mut events)?;
    }
    events.retain(|event| stretch.contains(&event.instant));
    Ok(events)
}

fn note_lunar(
    eclipse: &LunarEclipse,
    place: Option<&Place>,
    events: &mut Vec<Event>,
) -> Result<(), AlmanacError> {
    let local = place.map(|place| eclipse.at(place)).transpose()?;
    let what = What::LunarEclipse {
        kind: eclipse.kind,
        umbral_magnitude: eclipse.umbral_magnitude,
        penumbral_magnitude: eclipse.penumbral_magnitude,
        view: local.as_ref().map(|local| View::from(&local.greatest)),
    };
    events.push(Event { instant: eclipse.greatest, what });

    let phases = [
        ([Contact::P1, Contact::P4], Some(eclipse.contacts.penumbral)),
        ([Contact::U1, Contact::U4], eclipse.contacts.partial),
        ([Contact::U2, Contact::U3], eclipse.contacts.total),
    ];
    let views = local.map(|local| {
        let contacts = local.contacts;
        [Some(contacts.penumbral), contacts.partial, contacts.total]
    });
    for (phase, (names, instants)) in phases.into_iter().enumerate() {
        for (end, instant) in instants.into_iter().flatten().enumerate() {
            let moment = views.and_then(|views| views[phase]).map(|moments| moments[end]);
            let view = moment.as_ref().map(View::from);
            let what = What::EclipseContact { contact: names[end], view };
            events.push(Event { instant, what });
        }
    }
    Ok(())
}

fn note_solar(
    eclipse: &SolarEclipse,
    place: Option<&Place>,
    events: &mut Vec<Event>,
) -> Result<(), AlmanacError> {
    let what = What::SolarEclipse {
        kind: eclipse.kind,
        magnitude: eclipse.magnitude,
        obscuration: eclipse.obscuration,
        latitude: eclipse.place.latitude,
        longitude: eclipse.place.longitude,
    };
    events.push(Event { instant: eclipse.greatest, what });

    let local = place.map(|place| eclipse.at(place)).transpose()?.flatten();
    let Some((local, seen)) = local.and_then(|local| local.seen.map(|seen| (local, seen))) else {
        return Ok(());
    };
    let what = What::SolarEclipseHere {
        kind: local.kind,
        magnitude: seen.magnitude,
        obscuration: seen.obscuration,
        view: View::from(&seen.moment),
    };
    events.push(Event { instant: seen.moment.instant, what });
    let [first, last] = local.partial;
    let mut contacts = vec![(Contact::C1, first.moment), (Contact::C4, last.moment)];
    if let Some([second, third]) = local.central {
        contacts.extend([(Contact::C2, second.moment), (Contact::C3, third.moment)]);
    }
    // Below the horizon nobody sees a contact.
    for (contact, moment) in contacts.into_iter().filter(|(_, moment)| moment.is_up()) {
        let what = What::EclipseContact { contact, view: Some(View::from(&moment)) };
        events.push(Event { instant: moment.instant, what });
    }
    Ok(())
}

impl From<&LocalMoment> for View {
    fn from(moment: &LocalMoment) -> View {
        View { azimuth: moment.azimuth, altitude: moment.altitude }
    }
}
