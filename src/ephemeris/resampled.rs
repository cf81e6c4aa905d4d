//! Quantities of time, resampled: large tables of motion in few bytes, read at the depth asked for.
//!
//! A [`Table`] holds [`Channel`]s, each a vector of up to three components over a span of equal
//! segments. A channel is a [`Reference`], which is computed, and residuals, which are stored.
//!
//! # Theory
//!
//! In a segment, x from -1 to 1, the residual is
//! `a (1-x)/2 + b (1+x)/2 + sum over n >= 2 of c_n (T_n - T_(n mod 2))`: every term of the sum
//! vanishes at both borders, whose values a and b are stored once, shared with the neighbours. So the
//! residual is continuous whatever is rounded, and a coefficient is saved. All numbers are whole
//! multiples of one quantum, in bit fields whose width belongs to component and degree: any segment
//! can be read without the others.
//!
//! The bits lie in three layers (see `catalog::layered`): the first holds the numbers rounded, the
//! others what was cut off. Every layer that is read divides the error by about ten.
//!
//! On its first touch a segment is folded with its reference into plain polynomials, by interpolation
//! at Lobatto nodes, which keep the borders. After that an evaluation is one look-up and one Horner
//! scheme, on any number of threads, without a lock.
//!
//! How we differ from JPL's files: theirs hold Chebyshev coefficients of the motion itself in 64-bit
//! numbers, and neighbours meet within rounding only because nothing was rounded much.

mod bits;
mod chebyshev;
mod encode;
mod fold;
mod header;
mod reference;
mod rounding;
#[cfg(test)]
mod tests;

use std::fmt;
use std::sync::{Arc, OnceLock};

use glam::DVec3;

use bits::{BitReader, PADDING};
pub use encode::{ChannelSource, encode};
use fold::Folded;
use header::Layout;
pub use header::{Folding, Recipe};
pub use reference::{Orbit, Powers, Reference};

use crate::catalog::layered;
use crate::time::{JulianDate, Tdb};

/// Components of a vector.
const COMPONENTS: usize = 3;
/// Layers of a table.
pub const LAYERS: usize = 3;

/// How many layers are used: named by the error that a table of positions then keeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Depth {
    /// A tenth of an arcsecond: the first layer alone.
    Tenth,
    /// A hundredth of an arcsecond: two layers.
    Hundredth,
    /// A thousandth of an arcsecond: all three.
    Thousandth,
}

impl Depth {
    /// All depths, the coarsest first.
    pub const ALL: [Depth; LAYERS] = [Depth::Tenth, Depth::Hundredth, Depth::Thousandth];

    /// Number of layers.
    pub const fn layers(self) -> usize {
        self as usize + 1
    }
}

/// A file of resampled quantities, or its first layers.
pub struct Table {
    channels: Vec<Channel>,
    depth: Depth,
}

/// A quantity of time.
pub struct Channel {
    layout: Layout,
    /// Payloads of the layers, each padded for the bit reader.
    layers: Arc<Vec<Vec<u8>>>,
    /// The first bit of the channel in each layer.
    first_bit: [usize; LAYERS],
    /// Numbers of layers loaded.
    loaded: usize,
    folded: [OnceLock<Folded>; LAYERS],
}

impl Table {
    /// From the payloads of the first layers of a file, as
    /// [`crate::catalog::Catalogs::layers`] reads them; as deep as there are layers.
    ///
    /// An error says what is wrong, to be read behind the name of the file.
    pub fn open(mut layers: Vec<Vec<u8>>) -> Result<Table, String> {
        let Some(depth) = layers.len().checked_sub(1).and_then(|i| Depth::ALL.get(i).copied())
        else {
            return Err(format!("gave {} layers; ask for 1 to {LAYERS}", layers.len()));
        };
        let (layouts, described) = header::read(&layers[0])?;
        let mut at = [described, 0, 0];
        let mut first_bits = Vec::new();
        for layout in &layouts {
            first_bits.push(at.map(|byte| byte * 8));
            for (layer, at) in at.iter_mut().enumerate() {
                *at += layout.bytes(layer);
            }
        }
        for (index, (layer, wanted)) in layers.iter_mut().zip(at).enumerate() {
            if layer.len() != wanted {
                return Err(format!(
                    "holds {} bytes in layer {} where its description says {wanted}",
                    layer.len(),
                    index + 1
                ));
            }
            layer.extend([0; PADDING]);
        }
        let layers = Arc::new(layers);
        let channel = |(layout, first_bit)| Channel {
            layout,
            layers: Arc::clone(&layers),
            first_bit,
            loaded: layers.len(),
            folded: Default::default(),
        };
        let channels = layouts.into_iter().zip(first_bits).map(channel).collect();
        Ok(Table { channels, depth })
    }

    /// From the bytes of a whole file, or of its first layers, to a depth.
    pub fn from_bytes(bytes: &[u8], depth: Depth) -> Result<Table, String> {
        Table::open(layered::open_layers(bytes, depth.layers())?)
    }

    /// The depth to which the table was read.
    pub fn depth(&self) -> Depth {
        self.depth
    }

    /// The channel of that name.
    pub fn channel(&self, id: &str) -> Option<&Channel> {
        self.channels.iter().find(|channel| channel.id() == id)
    }

    /// The channels themselves, in the order of the file.
    pub fn into_channels(self) -> Vec<Channel> {
        self.channels
    }

    /// All channels, in the order of the file.
    pub fn channels(&self) -> impl Iterator<Item = &Channel> {
        self.channels.iter()
    }
}

impl Channel {
    /// Its name.
    pub fn id(&self) -> &str {
        &self.layout.recipe.id
    }

    /// How it was made.
    pub fn recipe(&self) -> &Recipe {
        &self.layout.recipe
    }

    /// Bytes in each layer.
    pub fn bytes(&self) -> [usize; LAYERS] {
        [0, 1, 2].map(|layer| self.layout.bytes(layer))
    }

    /// The first and the last moment that the channel knows.
    pub fn span(&self) -> (JulianDate<Tdb>, JulianDate<Tdb>) {
        let recipe = self.recipe();
        (moment(recipe, 0, -1.0), moment(recipe, recipe.segments as usize, -1.0))
    }

    /// Whether a moment lies within the span, borders included.
    pub fn holds(&self, tdb: JulianDate<Tdb>) -> bool {
        let (first, last) = self.span();
        first <= tdb && tdb <= last
    }

    /// The value, in the unit and the frame of the channel; at most as deep as the table was read.
    ///
    /// The moment must lie within [`Channel::span`]; beyond it the polynomial at the border goes on,
    /// which is good for rounding alone.
    #[inline]
    pub fn value(&self, tdb: JulianDate<Tdb>, depth: Depth) -> DVec3 {
        let layers = depth.layers().min(self.loaded);
        self.folded(layers).value(tdb, |segment| self.unfold(segment, layers))
    }

    /// The value as [`Channel::value`] gives it, and its rate per day: the exact derivative of the
    /// same polynomial.
    #[inline]
    pub fn value_and_rate(&self, tdb: JulianDate<Tdb>, depth: Depth) -> (DVec3, DVec3) {
        let layers = depth.layers().min(self.loaded);
        self.folded(layers).value_and_rate(tdb, |segment| self.unfold(segment, layers))
    }

    /// The value straight from the bits and the reference: slow, and what folding is measured by.
    pub fn unfolded_value(&self, tdb: JulianDate<Tdb>, depth: Depth) -> DVec3 {
        let recipe = self.recipe();
        let days = tdb - JulianDate::from_jd(recipe.start_jd);
        let segment = ((days / recipe.segment_days) as usize).min(recipe.segments as usize - 1);
        let x = 2.0 * (days / recipe.segment_days - segment as f64) - 1.0;
        self.unfold(segment, depth.layers().min(self.loaded))(x)
    }

    #[inline]
    fn folded(&self, layers: usize) -> &Folded {
        self.folded[layers - 1].get_or_init(|| {
            let recipe = self.recipe();
            let folding = recipe.folding[layers - 1];
            Folded::new(recipe.start_jd, recipe.segment_days, recipe.segments, folding)
        })
    }

    /// A segment with its bits decoded.
    fn unfold(&self, segment: usize, layers: usize) -> impl Fn(f64) -> DVec3 {
        let residual = self.residual(segment, layers);
        let quantum = DVec3::from_array(self.recipe().quantum);
        move |x| {
            let station = self.recipe().reference.at(moment(self.recipe(), segment, x));
            station.origin + station.axes * (chebyshev::sum(&residual, x) * quantum)
        }
    }

    /// The residual of a segment in its own axes: coefficients of Chebyshev polynomials, in quanta.
    ///
    /// Whole numbers and halves of them: sums are exact, also at the borders.
    fn residual(&self, segment: usize, layers: usize) -> Vec<DVec3> {
        let recipe = self.recipe();
        let (mut begin, mut end) = (DVec3::ZERO, DVec3::ZERO);
        let mut residual = vec![DVec3::ZERO; recipe.degree + 1];
        for layer in 0..layers {
            // In the place of the bits of the layers behind it there are none.
            let omitted = recipe.omitted_bits.get(layer).copied().unwrap_or(0);
            let unit = f64::from(1u32 << omitted);
            let widths = &self.layout.widths[layer][..recipe.components];
            let record = self.first_bit[layer] + segment * self.layout.record_bits(layer);
            let mut reader = BitReader::at(&self.layers[layer], record);
            for (component, widths) in widths.iter().enumerate() {
                begin[component] += unit * reader.take(widths[0]) as f64;
            }
            for (component, widths) in widths.iter().enumerate() {
                for (value, &width) in residual[2..].iter_mut().zip(&widths[1..]) {
                    value[component] += unit * reader.take(width) as f64;
                }
            }
            // The next record begins with the border between both.
            for (component, widths) in widths.iter().enumerate() {
                end[component] += unit * reader.take(widths[0]) as f64;
            }
        }
        (residual[0], residual[1]) = (0.5 * (begin + end), 0.5 * (end - begin));
        for n in 2..residual.len() {
            let c = residual[n];
            residual[n % 2] -= c;
        }
        residual
    }
}

/// The moment `x` of a segment, from -1 at its begin to +1 at its end; exact at both.
fn moment(recipe: &Recipe, segment: usize, x: f64) -> JulianDate<Tdb> {
    let begin = segment as f64 * recipe.segment_days;
    JulianDate::from_parts(recipe.start_jd + begin, 0.5 * (1.0 + x) * recipe.segment_days)
}

impl fmt::Debug for Channel {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "Channel({:?})", self.id())
    }
}

impl fmt::Debug for Table {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let ids: Vec<_> = self.channels().map(Channel::id).collect();
        write!(f, "Table({ids:?} to {:?})", self.depth)
    }
}
