//! Whole numbers in fields of any width, packed without gaps.

/// Widest field that can be read with one load of eight bytes from any bit.
pub(super) const MAX_WIDTH: u32 = 57;

/// Bytes that must follow the last field, so that the last load stays inside.
pub(super) const PADDING: usize = 8;

/// Bits that hold every number between two others as two's complement; none if both are zero.
pub(super) fn width_of(low: i64, high: i64) -> u32 {
    if (low, high) == (0, 0) {
        return 0;
    }
    // -2^(w-1) <= low and high < 2^(w-1).
    let bits = |value: i64| 65 - (if value < 0 { !value } else { value }).leading_zeros();
    bits(low).max(bits(high))
}

/// Appends fields, lowest bit first.
#[derive(Default)]
pub(super) struct BitWriter {
    bytes: Vec<u8>,
    pending: u128,
    bits: u32,
}

impl BitWriter {
    /// The lowest `width` bits of a number that fits into them.
    pub fn put(&mut self, value: i64, width: u32) {
        debug_assert!(width <= MAX_WIDTH && width_of(value, value) <= width);
        let mask = (1u128 << width) - 1;
        self.pending |= (value as u128 & mask) << self.bits;
        self.bits += width;
        while self.bits >= 8 {
            self.bytes.push(self.pending as u8);
            self.pending >>= 8;
            self.bits -= 8;
        }
    }

    /// What was written, up to the next whole byte.
    pub fn finish(mut self) -> Vec<u8> {
        if self.bits > 0 {
            self.bytes.push(self.pending as u8);
        }
        self.bytes
    }
}

/// Reads fields one after the other, from any bit on.
pub(super) struct BitReader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> BitReader<'a> {
    /// `bytes` go on for [`PADDING`] bytes behind the last field.
    pub fn at(bytes: &'a [u8], bit: usize) -> Self {
        BitReader { bytes, at: bit }
    }

    /// The next number of so many bits, at most [`MAX_WIDTH`].
    pub fn take(&mut self, width: u32) -> i64 {
        if width == 0 {
            return 0;
        }
        let byte = self.at / 8;
        let mut word = [0; 8];
        word.copy_from_slice(&self.bytes[byte..byte + 8]);
        let above = 64 - width - (self.at % 8) as u32;
        self.at += width as usize;
        (i64::from_le_bytes(word) << above) >> (64 - width)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_width_is_the_smallest_that_holds() {
        let widths = [(0, 0, 0), (-1, 0, 1), (0, 1, 2), (-2, 1, 2), (-3, 0, 3), (-128, 127, 8)];
        for (low, high, width) in widths {
            assert_eq!(width_of(low, high), width, "{low} to {high}");
        }
        assert_eq!(width_of(0, i64::MAX), 64);
    }

    #[test]
    fn fields_come_back() {
        let fields: Vec<(i64, u32)> = (0..=MAX_WIDTH)
            .flat_map(|width| {
                let half = if width == 0 { 0 } else { 1i64 << (width - 1) };
                let largest = if width == 0 { 0 } else { half - 1 };
                [(-half, width), (largest, width), (-half / 3, width), (largest / 5, width)]
            })
            .collect();
        let mut writer = BitWriter::default();
        for &(value, width) in &fields {
            writer.put(value, width);
        }
        let mut bytes = writer.finish();
        let bits: u32 = fields.iter().map(|field| field.1).sum();
        assert_eq!(bytes.len(), bits.div_ceil(8) as usize);
        bytes.extend([0xff; PADDING]);
        let mut reader = BitReader::at(&bytes, 0);
        for &(value, width) in &fields {
            assert_eq!(reader.take(width), value, "{width} bits");
        }
        let ahead: u32 = fields[..30].iter().map(|field| field.1).sum();
        let mut reader = BitReader::at(&bytes, ahead as usize);
        assert_eq!(reader.take(fields[30].1), fields[30].0);
    }
}
