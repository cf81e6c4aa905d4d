//! The description of a channel: what its maker chooses, and how its bits lie in the layers.

use super::bits::MAX_WIDTH;
use super::reference::Reference;
use super::{COMPONENTS, LAYERS};

/// Largest degree of a stored segment and of a folded piece.
pub(super) const MAX_DEGREE: usize = 47;
/// Mark of the first layer's payload, with the version of this layout.
const MARK: &[u8; 8] = b"RESAMPL1";

/// What the maker of a channel chooses.
#[derive(Debug, Clone, PartialEq)]
pub struct Recipe {
    /// Name by which [`super::Table::channel`] finds it.
    pub id: String,
    /// Julian date (TDB) at which the span begins: a whole or half day.
    pub start_jd: f64,
    /// Length of a segment, days: a multiple of 1/64 day.
    pub segment_days: f64,
    /// Number of segments.
    pub segments: u32,
    /// Components in use, 1 to 3; the others are zero.
    pub components: usize,
    /// Degree of the Chebyshev polynomial in a segment.
    pub degree: usize,
    /// What one unit of a stored number stands for, by component, in the unit of the channel.
    pub quantum: [f64; COMPONENTS],
    /// Bits that a reader of one and of two layers does without; zero where a layer has no share.
    pub omitted_bits: [u32; LAYERS - 1],
    /// What is computed rather than stored.
    pub reference: Reference,
    /// How a segment is unfolded for use at each depth.
    pub folding: [Folding; LAYERS],
}

/// How a segment and its reference become plain polynomials.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Folding {
    /// Pieces of equal length in a segment: a power of two.
    pub pieces: usize,
    /// Degree of the polynomial in a piece: odd.
    pub degree: usize,
}

/// Bits of each number in one layer: the border first, then degrees 2, 3, ...; by component.
pub(super) type Widths = [Vec<u32>; COMPONENTS];

/// A channel as the header tells it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Layout {
    pub recipe: Recipe,
    pub widths: [Widths; LAYERS],
}

impl Recipe {
    /// Refuses what the codec cannot hold.
    pub(super) fn check(&self) -> Result<(), String> {
        let refuse = |what: &str| Err(format!("has a channel {:?} with {what}", self.id));
        if self.id.is_empty() || self.id.len() > 255 {
            return refuse("a name that is empty or too long");
        }
        if (self.start_jd * 2.0).fract() != 0.0 || self.start_jd.abs() > 1e8 {
            return refuse("a start that is no whole or half day");
        }
        let length = self.segment_days;
        if !(1.0 / 64.0..=1e6).contains(&length) || (length * 64.0).fract() != 0.0 {
            return refuse("segments that are no multiple of 1/64 day");
        }
        if self.segments == 0 || self.segments > 10_000_000 {
            return refuse("no segments, or too many");
        }
        if !(1..=COMPONENTS).contains(&self.components) {
            return refuse("a number of components outside 1 to 3");
        }
        if !(1..=MAX_DEGREE).contains(&self.degree) {
            return refuse("a degree out of range");
        }
        if !self.quantum[..self.components].iter().all(|q| q.is_finite() && *q > 0.0) {
            return refuse("a quantum that is not positive");
        }
        if self.omitted_bits[0] < self.omitted_bits[1] || self.omitted_bits[0] > 30 {
            return refuse("omitted bits that do not fall from layer to layer");
        }
        for folding in self.folding {
            let Folding { pieces, degree } = folding;
            if !pieces.is_power_of_two() || pieces > 128 {
                return refuse("a number of pieces that is no power of two up to 128");
            }
            if degree % 2 == 0 || degree > MAX_DEGREE {
                return refuse("pieces whose degree is even or too high");
            }
        }
        Ok(())
    }
}

impl Layout {
    /// Bits of the borders of one moment in a layer.
    pub fn border_bits(&self, layer: usize) -> usize {
        self.used(layer).map(|widths| widths[0] as usize).sum()
    }
    /// Bits from one segment to the next in a layer: a border and what follows it.
    pub fn record_bits(&self, layer: usize) -> usize {
        self.used(layer).flatten().map(|&width| width as usize).sum()
    }
    /// Bytes of the channel in a layer: all segments, and the border behind the last.
    pub fn bytes(&self, layer: usize) -> usize {
        let records = self.record_bits(layer) * self.recipe.segments as usize;
        (records + self.border_bits(layer)).div_ceil(8)
    }
    fn used(&self, layer: usize) -> impl Iterator<Item = &Vec<u32>> {
        self.widths[layer][..self.recipe.components].iter()
    }

    fn write(&self, writer: &mut Writer) {
        let recipe = &self.recipe;
        writer.u8(recipe.id.len() as u8);
        writer.bytes.extend(recipe.id.as_bytes());
        writer.f64(recipe.start_jd);
        writer.f64(recipe.segment_days);
        writer.bytes.extend(recipe.segments.to_le_bytes());
        writer.u8(recipe.components as u8);
        writer.u8(recipe.degree as u8);
        recipe.quantum.iter().for_each(|&quantum| writer.f64(quantum));
        recipe.omitted_bits.iter().for_each(|&bits| writer.u8(bits as u8));
        for folding in recipe.folding {
            writer.u8(folding.pieces.ilog2() as u8);
            writer.u8(folding.degree as u8);
        }
        recipe.reference.write(writer);
        for widths in self.widths.iter().flat_map(|widths| &widths[..recipe.components]) {
            widths.iter().for_each(|&width| writer.u8(width as u8));
        }
    }

    fn read(fields: &mut Fields) -> Result<Layout, String> {
        let length = fields.u8()?;
        let id = String::from_utf8(fields.take(length as usize)?.to_vec())
            .map_err(|_| "has a channel whose name is no text")?;
        let start_jd = fields.f64()?;
        let segment_days = fields.f64()?;
        let segments = fields.u32()?;
        let components = fields.u8()? as usize;
        let degree = fields.u8()? as usize;
        let mut quantum = [0.0; COMPONENTS];
        for value in &mut quantum {
            *value = fields.f64()?;
        }
        let mut omitted_bits = [0; LAYERS - 1];
        for bits in &mut omitted_bits {
            *bits = fields.u8()?;
        }
        let mut folding = [Folding { pieces: 1, degree: 1 }; LAYERS];
        for folding in &mut folding {
            let log2 = fields.u8()?.min(31);
            *folding = Folding { pieces: 1 << log2, degree: fields.u8()? as usize };
        }
        let reference = Reference::read(fields)?;
        let recipe = Recipe {
            id,
            start_jd,
            segment_days,
            segments,
            components,
            degree,
            quantum,
            omitted_bits,
            reference,
            folding,
        };
        recipe.check()?;
        let mut layout = Layout { recipe, widths: Default::default() };
        for widths in &mut layout.widths {
            for widths in &mut widths[..components] {
                for _ in 0..degree {
                    widths.push(fields.u8()?);
                }
                if widths.iter().any(|&width| width > MAX_WIDTH) {
                    return Err(format!("has numbers of more than {MAX_WIDTH} bits"));
                }
            }
        }
        Ok(layout)
    }
}

/// The head of the first layer's payload.
pub(super) fn write(layouts: &[Layout]) -> Vec<u8> {
    let mut writer = Writer { bytes: MARK.to_vec() };
    writer.bytes.extend((layouts.len() as u32).to_le_bytes());
    layouts.iter().for_each(|layout| layout.write(&mut writer));
    writer.bytes
}

/// The channels that a first layer's payload describes, and the bytes of the description.
pub(super) fn read(payload: &[u8]) -> Result<(Vec<Layout>, usize), String> {
    let mut fields = Fields { rest: payload };
    if fields.take(MARK.len())? != MARK {
        return Err("holds no resampled quantities that this program reads".into());
    }
    let count = fields.u32()?;
    let layouts: Vec<Layout> =
        (0..count).map(|_| Layout::read(&mut fields)).collect::<Result<_, _>>()?;
    Ok((layouts, payload.len() - fields.rest.len()))
}

/// Appends little-endian numbers.
pub(super) struct Writer {
    bytes: Vec<u8>,
}

impl Writer {
    pub fn u8(&mut self, value: u8) {
        self.bytes.push(value);
    }
    pub fn f64(&mut self, value: f64) {
        self.bytes.extend(value.to_le_bytes());
    }
}

/// Takes little-endian numbers from the front.
pub(super) struct Fields<'a> {
    rest: &'a [u8],
}

impl<'a> Fields<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], String> {
        let (taken, rest) =
            self.rest.split_at_checked(count).ok_or("ends within its description")?;
        self.rest = rest;
        Ok(taken)
    }
    fn array<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let mut array = [0; N];
        array.copy_from_slice(self.take(N)?);
        Ok(array)
    }
    pub fn u8(&mut self) -> Result<u32, String> {
        Ok(u32::from(self.array::<1>()?[0]))
    }
    fn u32(&mut self) -> Result<u32, String> {
        Ok(u32::from_le_bytes(self.array()?))
    }
    pub fn f64(&mut self) -> Result<f64, String> {
        Ok(f64::from_le_bytes(self.array()?))
    }
}
