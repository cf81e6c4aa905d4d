//! Random numbers: xoshiro256++ seeded by splitmix64 (Blackman & Vigna 2021, *ACM Trans. Math. Softw.*
//! 47, 36; recalled, held by the sequence of their reference code in the test below).

/// One stream of random numbers.
#[derive(Debug, Clone)]
pub(super) struct Random {
    state: [u64; 4],
}

impl Random {
    /// The stream with this number among those of a seed.
    pub fn stream(seed: u64, number: u64) -> Random {
        // Neighbouring seeds and numbers are mixed apart before they meet.
        let mut mixer = splitmix(&mut { seed }) ^ number.wrapping_mul(0xd134_2543_de82_ef95);
        Random { state: std::array::from_fn(|_| splitmix(&mut mixer)) }
    }

    fn bits(&mut self) -> u64 {
        let s = &mut self.state;
        let result = s[0].wrapping_add(s[3]).rotate_left(23).wrapping_add(s[0]);
        let shifted = s[1] << 17;
        s[2] ^= s[0];
        s[3] ^= s[1];
        s[1] ^= s[2];
        s[0] ^= s[3];
        s[2] ^= shifted;
        s[3] = s[3].rotate_left(45);
        result
    }

    /// From 0 up to, not including, 1.
    #[inline]
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
    }
}

fn splitmix(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sequence_is_that_of_the_reference_code() {
        // Published test vectors: state 1, 2, 3, 4 of the generator; state 1234567 of the mixer.
        let mut random = Random { state: [1, 2, 3, 4] };
        let first: [u64; 4] = std::array::from_fn(|_| random.bits());
        assert_eq!(first, [41_943_041, 58_720_359, 3_588_806_011_781_223, 3_591_011_842_654_386]);
        assert_eq!(splitmix(&mut 1_234_567), 6_457_827_717_110_365_317);
    }

    #[test]
    fn numbers_are_even_and_streams_differ() {
        let n = 100_000;
        for number in 0..3 {
            let mut random = Random::stream(7, number);
            let numbers: Vec<f64> = (0..n).map(|_| random.unit()).collect();
            let mean = numbers.iter().sum::<f64>() / f64::from(n);
            let square = numbers.iter().map(|x| x * x).sum::<f64>() / f64::from(n);
            // Four standard errors: 0.289 and 0.298 over the root of n.
            assert!((mean - 0.5).abs() < 0.0037, "{mean}");
            assert!((square - 1.0 / 3.0).abs() < 0.0038, "{square}");
        }
        assert_ne!(Random::stream(7, 0).bits(), Random::stream(7, 1).bits());
        assert_ne!(Random::stream(7, 0).bits(), Random::stream(8, 0).bits());
    }
}
