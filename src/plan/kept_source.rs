//! The sky of one source from frame to frame: the same table again, one between two that were made, or
//! a new one.
//!
//! A table depends on the altitude of its source and on its light, not on its azimuth. A frame whose
//! source stands where it stood shows the same table. A source that moves by little, as in frames in a
//! row, is read between two tables a [`step`] apart on its way, in logarithms; the aureole is drawn where
//! the source stands. One that moves farther, or whose light changes, has a table of its own, as a single
//! still has.
//!
//! Between tables the light errs by 0.14 % at most where it is over 1/1000 of the brightest of its table,
//! and by 0.025 % in the mean, from noon to night (`tests/rows.rs` holds it to 0.2 %). Tables half
//! a degree apart err by 1.4 % at sunset.

use crate::air::scattering::SkyView;
use crate::light::spectrum::{LEN, Spectrum, wavelength_nm};
use crate::units::Angle;

/// Between two tables.
const STEP: Angle = Angle::from_arcmin(8.0);
/// The same of a source above [`HIGH`], where light changes slowly.
const HIGH_STEP: Angle = Angle::from_arcmin(30.0);
const HIGH: Angle = Angle::from_deg(10.0);
/// Light whose colour differs by more at any wavelength is another light.
const SAME_COLOUR: f64 = 2e-4;
/// The logarithm of less light than this is not taken.
const DARK: f32 = 1e-30;

/// What is kept of the sky of a source.
#[derive(Debug, Clone, Default)]
pub(super) struct KeptSource {
    /// What was asked last, and its table.
    last: Option<Lit>,
    /// Whether that table is none between others.
    is_exact: bool,
    /// Where tables were made, at most two.
    nodes: Vec<Node>,
}

/// A table of a source of a true altitude.
#[derive(Debug, Clone)]
struct Lit {
    altitude: Angle,
    irradiance: Spectrum,
    view: SkyView,
}

/// The same, ready to be mixed.
#[derive(Debug, Clone)]
struct Node {
    altitude: Angle,
    irradiance: Spectrum,
    /// Logarithms of the smooth part.
    logs: Vec<f32>,
    /// Haze over the smooth part.
    ratios: Vec<f32>,
}

impl KeptSource {
    /// How many tables are kept.
    pub(super) fn tables(&self) -> usize {
        self.nodes.len() + usize::from(self.last.is_some())
    }

    /// The table of a source of a true altitude; `make` makes one, `seen_at` tells the apparent altitude of
    /// a source.
    pub(super) fn view(
        &mut self,
        altitude: Angle,
        irradiance: &Spectrum,
        make: impl Fn(Angle) -> SkyView,
        seen_at: impl Fn(Angle) -> Angle,
    ) -> SkyView {
        if let Some(last) = &self.last
            && last.altitude == altitude
            && last.irradiance == *irradiance
        {
            return last.view.clone();
        }
        let between = self.between(altitude, irradiance, &make, &seen_at);
        self.is_exact = between.is_none();
        let view = between.unwrap_or_else(|| {
            self.nodes.clear();
            make(altitude)
        });
        self.last = Some(Lit { altitude, irradiance: *irradiance, view: view.clone() });
        view
    }

    fn between(
        &mut self,
        altitude: Angle,
        irradiance: &Spectrum,
        make: &impl Fn(Angle) -> SkyView,
        seen_at: &impl Fn(Angle) -> Angle,
    ) -> Option<SkyView> {
        self.nodes.retain(|node| share(irradiance, &node.irradiance).is_some());
        if !self.holds(altitude) {
            let last = self
                .last
                .as_ref()
                .filter(|last| self.is_exact && share(irradiance, &last.irradiance).is_some());
            let from_last = last.map(|last| Node::of(last.altitude, last.irradiance, &last.view));
            let known = self.nodes.drain(..).chain(from_last);
            let away = |node: &Node| (node.altitude - altitude).rad().abs();
            let start = known
                .filter(|node| away(node) < 0.5 * step(node.altitude).rad())
                .min_by(|a, b| away(a).total_cmp(&away(b)))?;
            let step = step(start.altitude);
            let end = start.altitude + if altitude < start.altitude { -step } else { step };
            let end = Node::of(end, *irradiance, &make(end));
            self.nodes = vec![start, end];
        }
        let [start, end] = self.nodes.as_slice() else { return None };
        let along = (altitude - start.altitude).rad() / (end.altitude - start.altitude).rad();
        let like = &self.last.as_ref()?.view;
        let brighter = |node: &Node| share(irradiance, &node.irradiance).map(f64::ln);
        let gain = brighter(start)? * (1.0 - along) + brighter(end)? * along;
        let (low, high, gain) = ((1.0 - along) as f32, along as f32, gain as f32);
        let light = |(a, b): (&f32, &f32)| {
            if *a <= DARK.ln() && *b <= DARK.ln() { 0.0 } else { (a * low + b * high + gain).exp() }
        };
        let smooth: Vec<f32> = start.logs.iter().zip(&end.logs).map(light).collect();
        let ratios = start.ratios.iter().zip(&end.ratios);
        let haze = ratios.zip(&smooth).map(|((a, b), light)| (a * low + b * high) * light);
        Some(SkyView {
            source_elevation: seen_at(altitude),
            haze: haze.collect(),
            smooth,
            phase: like.phase.clone(),
            ..*like
        })
    }

    /// Whether an altitude lies between the two nodes.
    fn holds(&self, altitude: Angle) -> bool {
        match self.nodes.as_slice() {
            [a, b] => {
                let (a, b) = (a.altitude, b.altitude);
                (a <= altitude && altitude <= b) || (b <= altitude && altitude <= a)
            }
            _ => false,
        }
    }
}

impl Node {
    fn of(altitude: Angle, irradiance: Spectrum, view: &SkyView) -> Node {
        let logs = view.smooth.iter().map(|light| light.max(DARK).ln());
        let parts = view.haze.iter().zip(&view.smooth);
        let ratios = parts.map(|(haze, light)| haze / light.max(DARK));
        Node { altitude, irradiance, logs: logs.collect(), ratios: ratios.collect() }
    }
}

/// Between the table of an altitude and the next. A source that has moved by more than half of it gets a
/// table of its own.
fn step(altitude: Angle) -> Angle {
    if altitude > HIGH { HIGH_STEP } else { STEP }
}

/// How many times as bright a light is as one of the same colour; none of another.
fn share(light: &Spectrum, like: &Spectrum) -> Option<f64> {
    let nodes = || (0..LEN).map(wavelength_nm).map(|nm| (light.at_nm(nm), like.at_nm(nm)));
    let sums = nodes().fold((0.0, 0.0), |sums, (a, b)| (sums.0 + a, sums.1 + b));
    let share = sums.0 / sums.1;
    let is_like = nodes().all(|(a, b)| (a - share * b).abs() <= SAME_COLOUR * share * b);
    (share > 0.0 && is_like).then_some(share)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::air::scattering::SkyShape;
    use std::cell::Cell;

    /// A sky whose light goes with the altitude of its source as `exp` does.
    fn table(altitude: Angle) -> SkyView {
        let shape = SkyShape { above: 2, below: 2, azimuths: 2 };
        let light = |node: usize| (0.02 * (node as f64 + 1.0) * altitude.deg()).exp() as f32;
        SkyView {
            shape,
            horizon: Angle::ZERO,
            source_elevation: altitude,
            channels: 4,
            smooth: (0..16).map(light).collect(),
            haze: (0..16).map(|node| 0.5 * light(node)).collect(),
            phase: None,
        }
    }

    #[test]
    fn ten_thousand_frames_keep_no_more_than_a_few() {
        let mut kept = KeptSource::default();
        let (made, light) = (Cell::new(0), Spectrum::from_fn(|_| 1.0));
        let make = |altitude: Angle| {
            made.set(made.get() + 1);
            table(altitude)
        };
        let at = |frame: u32| Angle::from_deg(-10.0) + Angle::from_arcsec(12.0 * f64::from(frame));
        for frame in 0..10_000 {
            let view = kept.view(at(frame), &light, make, |altitude| altitude);
            let exact = table(at(frame));
            for (a, b) in
                view.smooth.iter().chain(&view.haze).zip(exact.smooth.iter().chain(&exact.haze))
            {
                assert!((a / b - 1.0).abs() < 1e-5, "frame {frame}: {a} for {b}");
            }
            assert!(kept.tables() <= 3, "frame {frame}: {}", kept.tables());
        }
        let way = (at(10_000) - at(0)).rad() / STEP.rad();
        assert!(made.get() as f64 <= way + 3.0, "{} tables on {way} steps", made.get());
    }

    #[test]
    fn the_same_altitude_has_the_same_table_and_a_far_one_its_own() {
        let mut kept = KeptSource::default();
        let (made, light) = (Cell::new(0), Spectrum::from_fn(|_| 1.0));
        let make = |altitude: Angle| {
            made.set(made.get() + 1);
            table(altitude)
        };
        let mut at = |deg: f64| kept.view(Angle::from_deg(deg), &light, make, |altitude| altitude);
        assert_eq!(at(5.0), table(Angle::from_deg(5.0)));
        assert_eq!(made.get(), 1);
        // The end of the step alone is made.
        let near = 5.0 + 0.3 * STEP.deg();
        let between = at(near);
        assert_eq!(between, at(near));
        assert_eq!(made.get(), 2);
        assert_eq!(at(7.0), table(Angle::from_deg(7.0)));
        assert_eq!(made.get(), 3);
    }
}
