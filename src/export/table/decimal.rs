//! Numbers with a fixed count of decimals, exact to the last digit and without floating point.
//!
//! An `f64` is an integer times a power of two. Times ten to the count of decimals, it is shifted to
//! an integer and rounded, ties to even: the digits of `format!("{:.9}")`.

use std::io::Write;

/// Digits of 00 to 99.
const PAIRS: [[u8; 2]; 100] = {
    let mut pairs = [[0; 2]; 100];
    let mut n = 0;
    while n < 100 {
        pairs[n] = [b'0' + (n / 10) as u8, b'0' + (n % 10) as u8];
        n += 1;
    }
    pairs
};

/// Sign, twenty digits and the point.
const LONGEST: usize = 22;

/// Writes a finite number with so many decimals.
pub fn write_fixed(out: &mut Vec<u8>, value: f64, decimals: u8) {
    let written = match decimals {
        4 => scaled::<10_000>(value).map(|n| digits::<4, 10_000>(out, value.is_sign_negative(), n)),
        9 => scaled::<1_000_000_000>(value)
            .map(|n| digits::<9, 1_000_000_000>(out, value.is_sign_negative(), n)),
        _ => None,
    };
    if written.is_none() {
        let places = usize::from(decimals);
        write!(out, "{value:.places$}").expect("memory takes all that is written");
    }
}

/// Writes degrees with so many decimals; what rounds to a full turn is zero.
pub fn write_turn(out: &mut Vec<u8>, degrees: f64, decimals: u8) {
    let start = out.len();
    write_fixed(out, degrees, decimals);
    if out[start..].starts_with(b"360.") {
        out.truncate(start);
        write_fixed(out, 0.0, decimals);
    }
}

/// `|value| * SCALE`, rounded half to even; none where it takes more than 64 bits.
fn scaled<const SCALE: u64>(value: f64) -> Option<u64> {
    let bits = value.to_bits();
    let (exponent, fraction) = ((bits >> 52) as i32 & 0x7ff, bits & ((1 << 52) - 1));
    // Numbers below 2^-1022 have no leading one; numbers from 2^63 up, infinity and NaN are not for us.
    let (mantissa, exponent) = match exponent {
        0 => (fraction, -1074),
        1086.. => return None,
        _ => (fraction | 1 << 52, exponent - 1075),
    };
    let product = u128::from(mantissa) * u128::from(SCALE);
    if exponent >= 0 {
        return u64::try_from(product << exponent).ok();
    }
    let shift = exponent.unsigned_abs();
    // The product has at most 53 + 30 bits.
    if shift > 127 {
        return Some(0);
    }
    let (whole, rest) = (product >> shift, product & ((1 << shift) - 1));
    let half = 1 << (shift - 1);
    let is_up = rest > half || rest == half && whole & 1 == 1;
    u64::try_from(whole + u128::from(is_up)).ok()
}

/// Writes an integer with the point before its last `PLACES` digits.
fn digits<const PLACES: usize, const SCALE: u64>(out: &mut Vec<u8>, is_negative: bool, n: u64) {
    let mut buffer = [b'0'; LONGEST];
    let (mut whole, mut part) = (n / SCALE, n % SCALE);
    let mut at = LONGEST;
    let mut left = PLACES;
    while left >= 2 {
        at -= 2;
        buffer[at..at + 2].copy_from_slice(&PAIRS[(part % 100) as usize]);
        part /= 100;
        left -= 2;
    }
    if left == 1 {
        at -= 1;
        buffer[at] += part as u8;
    }
    at -= 1;
    buffer[at] = b'.';
    while whole >= 100 {
        at -= 2;
        buffer[at..at + 2].copy_from_slice(&PAIRS[(whole % 100) as usize]);
        whole /= 100;
    }
    at -= 2;
    buffer[at..at + 2].copy_from_slice(&PAIRS[whole as usize]);
    if whole < 10 {
        at += 1;
    }
    if is_negative {
        at -= 1;
        buffer[at] = b'-';
    }
    out.extend_from_slice(&buffer[at..]);
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn fixed(value: f64, decimals: u8) -> String {
        let mut out = b"x".to_vec();
        write_fixed(&mut out, value, decimals);
        String::from_utf8(out).unwrap().split_off(1)
    }

    #[test]
    fn ties_and_extremes_are_those_of_the_standard_library() {
        let mut values = vec![0.0, -0.0, f64::MIN_POSITIVE, 5e-324, f64::MAX, 1e9, 9.3e9, 1.9e15];
        values.extend([359.999_999_999_5, 0.999_999_999_5, 99.999_999_999_9, 9.999_95, 1e300]);
        // Exact ties at nine and at four decimals: odd multiples of 2^-10 and of 2^-5.
        values.extend((0..4096).map(|n| f64::from(n) / 1024.0));
        values.extend((0..64).map(|n| (2.0f64).powi(n)));
        values.extend((0..1080).map(|n| (0.5f64).powi(n)));
        for value in values {
            for value in [value, -value] {
                assert_eq!(fixed(value, 9), format!("{value:.9}"));
                assert_eq!(fixed(value, 4), format!("{value:.4}"));
                assert_eq!(fixed(value, 3), format!("{value:.3}"));
            }
        }
    }

    #[test]
    fn a_full_turn_is_none() {
        let turn = |degrees| {
            let mut out = Vec::new();
            write_turn(&mut out, degrees, 9);
            String::from_utf8(out).unwrap()
        };
        assert_eq!(turn(359.999_999_999_9), "0.000000000");
        assert_eq!(turn(359.999_999_999_1), "359.999999999");
        assert_eq!(turn(36.0), "36.000000000");
    }

    proptest! {
        #[test]
        fn any_number_is_written_as_the_standard_library_does(bits: u64, small in -1e4..1e4) {
            let any = f64::from_bits(bits);
            for value in [small, if any.is_finite() { any } else { 0.5 }] {
                prop_assert_eq!(fixed(value, 9), format!("{value:.9}"));
                prop_assert_eq!(fixed(value, 4), format!("{value:.4}"));
            }
        }
    }
}
