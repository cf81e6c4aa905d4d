//! From a function of time to the layers of a table. For packing; a reader does not need it.

use glam::DVec3;
use rayon::prelude::*;

use super::bits::{BitWriter, width_of};
use super::chebyshev::Lobatto;
use super::header::{self, Layout, Recipe};
use super::rounding::Rounding;
use super::{COMPONENTS, LAYERS, moment};
use crate::catalog::layered;
use crate::time::{JulianDate, Tdb};

/// A channel to be made: how, and of what.
pub struct ChannelSource<'a> {
    pub recipe: Recipe,
    /// The quantity at a moment, from the begin to the end of the span; smooth in between.
    pub sample: &'a (dyn Fn(JulianDate<Tdb>) -> DVec3 + Sync),
}

/// Numbers of one segment: the border at its begin, then degrees 2, 3, ...; by component.
type Record = [Vec<i64>; COMPONENTS];

/// Nodes above the degree of the segment: what is cut off must not fold back into what is kept.
const SPARE_DEGREES: usize = 6;

/// Sums of such numbers and of their halves are exact.
const MAX_NUMBER: u64 = 1 << 46;

/// The bytes of a table with these channels, in this order. The same sources give the same bytes.
pub fn encode(sources: &[ChannelSource]) -> Result<Vec<u8>, String> {
    let mut layouts = Vec::new();
    let mut bodies = vec![Vec::new(); LAYERS];
    for source in sources {
        source.recipe.check()?;
        let (layout, layers) = channel(source)?;
        layouts.push(layout);
        bodies.iter_mut().zip(layers).for_each(|(body, layer)| body.extend(layer));
    }
    bodies[0] = [header::write(&layouts), std::mem::take(&mut bodies[0])].concat();
    Ok(layered::seal_layers(&bodies))
}

fn channel(source: &ChannelSource) -> Result<(Layout, Vec<Vec<u8>>), String> {
    let recipe = &source.recipe;
    let rounding = Rounding::new(recipe.degree, recipe.degree + SPARE_DEGREES);
    let records: Vec<Record> = (0..=recipe.segments)
        .into_par_iter()
        .map(|segment| record(source, &rounding, segment))
        .collect();
    if records.iter().flatten().flatten().any(|number| number.unsigned_abs() > MAX_NUMBER) {
        return Err(format!(
            "{}: a value is missing, or a quantum gives numbers beyond {MAX_NUMBER}; enlarge it",
            recipe.id
        ));
    }
    let mut layout = Layout { recipe: recipe.clone(), widths: Default::default() };
    for (layer, widths) in layout.widths.iter_mut().enumerate() {
        for (component, widths) in widths[..recipe.components].iter_mut().enumerate() {
            for place in 0..recipe.degree {
                let shares = records.iter().filter_map(|record| record[component].get(place));
                let (mut low, mut high) = (0, 0);
                for share in shares.map(|&number| shares_of(number, recipe)[layer]) {
                    (low, high) = (share.min(low), share.max(high));
                }
                widths.push(width_of(low, high));
            }
        }
    }
    let layers = (0..LAYERS).map(|layer| {
        let mut writer = BitWriter::default();
        for record in &records {
            // Borders first: a reader finds them at the begin of the next record.
            for places in [0..1, 1..record[0].len()] {
                for (numbers, widths) in
                    record.iter().zip(&layout.widths[layer][..recipe.components])
                {
                    let numbers = &numbers[places.clone()];
                    for (&number, &width) in numbers.iter().zip(&widths[places.start..]) {
                        writer.put(shares_of(number, recipe)[layer], width);
                    }
                }
            }
        }
        writer.finish()
    });
    let layers = layers.collect();
    Ok((layout, layers))
}

/// What each layer says of a number. Each layer rounds what the next one says: no bias, and the sum
/// of all is the number.
fn shares_of(number: i64, recipe: &Recipe) -> [i64; LAYERS] {
    let [first, second] = recipe.omitted_bits;
    let round = |number: i64, bits: u32| (number + ((1 << bits) >> 1)) >> bits;
    let upper_two = round(number, second);
    let upper = round(upper_two, first - second);
    [upper, upper_two - (upper << (first - second)), number - (upper_two << second)]
}

/// The numbers of a segment; behind the last one there is a border alone.
fn record(source: &ChannelSource, rounding: &Rounding, segment: u32) -> Record {
    let recipe = &source.recipe;
    let residual = |x: f64| {
        let tdb = moment(recipe, segment as usize, x);
        let station = recipe.reference.at(tdb);
        let stray = station.axes.transpose() * ((source.sample)(tdb) - station.origin);
        DVec3::from_array([0, 1, 2].map(|component| stray[component] / recipe.quantum[component]))
    };
    let [begin, end] = [-1.0, 1.0].map(residual);
    let coefficients = if segment == recipe.segments {
        Vec::new()
    } else {
        let lobatto = Lobatto::new(recipe.degree + SPARE_DEGREES);
        let values: Vec<DVec3> = lobatto.nodes.iter().map(|&x| residual(x)).collect();
        lobatto.coefficients(&values)
    };
    let mut record = Record::default();
    for (component, numbers) in record[..recipe.components].iter_mut().enumerate() {
        numbers.push(whole(begin[component]));
        if segment < recipe.segments {
            let errors = [begin, end].map(|border| border[component].round() - border[component]);
            let known: Vec<f64> = coefficients[2..].iter().map(|c| c[component]).collect();
            numbers.extend(rounding.round(&known, errors));
        }
    }
    record
}

/// The nearest number; one that is too large in place of a missing value.
fn whole(value: f64) -> i64 {
    if value.is_nan() { i64::MAX } else { value.round() as i64 }
}
