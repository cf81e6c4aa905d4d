//! A file in layers: each refines what the layers before it say, so a beginning is enough.
//!
//! The file is a row of sealed parts (see `seal.rs`), one for each layer. Counts in the header of a
//! part: its place in the row times 256 plus the number of parts; the bytes of its payload; and the
//! first four bytes of the SHA-256 of the first part, which say to whom it belongs (zero in the
//! first). Whoever wants fewer layers reads a prefix of the file and checks that alone.

use std::io::Read;

use super::seal::{self, HEADER_LEN, Kind};

const KIND: Kind = Kind { magic: b"NOCTLAYR", version: 1 };
/// Where the header has the number of bytes of the payload.
const LENGTH_AT: usize = 16;

/// Seals the payloads of the layers, first one first, into one file.
pub fn seal_layers(payloads: &[Vec<u8>]) -> Vec<u8> {
    let mut file = Vec::new();
    let mut owner = 0;
    for (index, payload) in payloads.iter().enumerate() {
        let place = (index * 256 + payloads.len()) as u32;
        let part = seal::seal(KIND, [place, payload.len() as u32, owner], payload);
        if index == 0 {
            owner = seal::mark(&part);
        }
        file.extend(part);
    }
    file
}

/// The payloads of the first `depth` layers; an error says what is wrong with the file.
///
/// Nothing behind those layers is read.
pub fn open_layers(mut file: impl Read, depth: usize) -> Result<Vec<Vec<u8>>, String> {
    let mut payloads = Vec::with_capacity(depth);
    let mut owner = 0;
    for index in 0..depth {
        let layer = index + 1;
        let mut part = Vec::new();
        take(&mut file, HEADER_LEN, &mut part, layer)?;
        // A header of another kind must be named as such, before its length is believed.
        seal::check_kind(KIND, &part)?;
        let length = seal::u32_at(&part, LENGTH_AT) as usize;
        take(&mut file, length, &mut part, layer)?;
        let ([place, _, of], _) =
            seal::open(KIND, &part).map_err(|what| format!("{what} (layer {layer})"))?;
        let total = place as usize % 256;
        if place as usize / 256 != index || of != owner {
            return Err(format!("has a layer of another file where its layer {layer} should be"));
        }
        if total < depth {
            return Err(format!("has {total} layers, and {depth} are asked for"));
        }
        if index == 0 {
            owner = seal::mark(&part);
        }
        if layer == total && file.read(&mut [0]).unwrap_or(0) > 0 {
            return Err("goes on behind its last layer".into());
        }
        payloads.push(part.split_off(HEADER_LEN));
    }
    Ok(payloads)
}

/// Appends exactly so many bytes of the file.
fn take(
    file: &mut impl Read,
    length: usize,
    bytes: &mut Vec<u8>,
    layer: usize,
) -> Result<(), String> {
    let read = file.by_ref().take(length as u64).read_to_end(bytes);
    match read.map_err(|error| format!("cannot be read: {error}"))? {
        read if read == length => Ok(()),
        _ => Err(format!("ends before its layer {layer} is complete")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn payloads() -> Vec<Vec<u8>> {
        vec![b"coarse".to_vec(), b"finer".to_vec(), vec![]]
    }

    #[test]
    fn a_prefix_is_enough_for_fewer_layers() {
        let file = seal_layers(&payloads());
        let first_two = 2 * HEADER_LEN + 6 + 5;
        for depth in 0..=3 {
            assert_eq!(open_layers(&file[..], depth).unwrap(), payloads()[..depth]);
        }
        assert_eq!(open_layers(&file[..first_two], 2).unwrap(), payloads()[..2]);
        assert!(open_layers(&file[..first_two], 3).unwrap_err().contains("layer 3"));
        assert!(open_layers(&file[..], 4).unwrap_err().contains("has 3 layers"));
    }

    #[test]
    fn every_flipped_bit_every_cut_and_every_tail_is_refused() {
        let file = seal_layers(&payloads());
        for at in 0..file.len() * 8 {
            let mut flipped = file.clone();
            flipped[at / 8] ^= 1 << (at % 8);
            assert!(open_layers(&flipped[..], 3).is_err(), "bit {at}");
        }
        for length in 0..file.len() {
            assert!(open_layers(&file[..length], 3).is_err(), "length {length}");
        }
        let longer = [&file[..], b"x"].concat();
        assert!(open_layers(&longer[..], 3).unwrap_err().contains("goes on"));
    }

    #[test]
    fn layers_of_different_files_do_not_mix() {
        let (one, mut other) = (payloads(), payloads());
        other[0] = b"course".to_vec();
        let first = HEADER_LEN + 6;
        let mixed = [&seal_layers(&one)[..first], &seal_layers(&other)[first..]].concat();
        assert!(open_layers(&mixed[..], 3).unwrap_err().contains("another file"));
    }

    #[test]
    fn another_version_is_named_as_such() {
        let mut file = seal_layers(&payloads());
        file[8] += 1;
        let what = open_layers(&file[..], 1).unwrap_err();
        assert!(what.contains("version 2") && what.contains("reads version 1"), "{what}");
    }
}
