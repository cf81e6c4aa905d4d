//! A sealed file: a header that says what follows, and a SHA-256 over all the rest of the file.
//!
//! ```text
//! offset  bytes
//!      0      8  magic: which kind of file
//!      8      4  format version, u32 little-endian
//!     12     12  three counts, u32 little-endian; their meaning belongs to the kind of file
//!     24     32  SHA-256 of every byte of the file but these 32
//!     56         payload
//! ```

use sha2::{Digest, Sha256};

const DIGEST_AT: usize = 24;
/// Bytes before the payload.
pub(super) const HEADER_LEN: usize = 56;

/// Which kind of file, and in which version of its format.
#[derive(Debug, Clone, Copy)]
pub(super) struct Kind {
    pub magic: &'static [u8; 8],
    pub version: u32,
}

/// SHA-256 as 64 lower-case hexadecimal digits.
pub fn sha256_hex(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Puts the header before a payload.
pub(super) fn seal(kind: Kind, counts: [u32; 3], payload: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(HEADER_LEN + payload.len());
    bytes.extend(kind.magic);
    bytes.extend(kind.version.to_le_bytes());
    for count in counts {
        bytes.extend(count.to_le_bytes());
    }
    let digest = digest(&bytes, payload);
    bytes.extend(digest);
    bytes.extend(payload);
    bytes
}

/// Checks the header and the SHA-256 of a sealed file; gives the counts and the payload.
pub(super) fn open(kind: Kind, bytes: &[u8]) -> Result<([u32; 3], &[u8]), String> {
    let Some((header, payload)) = bytes.split_at_checked(HEADER_LEN) else {
        return Err(format!("has {} bytes, too few for its header of {HEADER_LEN}", bytes.len()));
    };
    check_kind(kind, header)?;
    if header[DIGEST_AT..] != digest(&header[..DIGEST_AT], payload) {
        return Err("does not match the SHA-256 in its header".into());
    }
    Ok(([u32_at(header, 12), u32_at(header, 16), u32_at(header, 20)], payload))
}

/// Refuses a header that belongs to another kind or version of file.
pub(super) fn check_kind(kind: Kind, header: &[u8]) -> Result<(), String> {
    if header[..8] != kind.magic[..] {
        let wanted = String::from_utf8_lossy(kind.magic);
        return Err(format!("does not begin with the mark {wanted:?}: it is another kind of file"));
    }
    match u32_at(header, 8) {
        version if version == kind.version => Ok(()),
        version => Err(format!(
            "is in format version {version}, and this program reads version {}",
            kind.version
        )),
    }
}

/// The first four bytes of the SHA-256 in the header of a sealed file: whom its parts belong to.
pub(super) fn mark(sealed: &[u8]) -> u32 {
    u32_at(sealed, DIGEST_AT)
}

pub(super) fn u32_at(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
}

fn digest(before: &[u8], after: &[u8]) -> [u8; 32] {
    Sha256::new().chain_update(before).chain_update(after).finalize().into()
}

#[cfg(test)]
mod tests {
    use super::*;

    const KIND: Kind = Kind { magic: b"TESTTEST", version: 3 };

    #[test]
    fn sha256_of_abc_is_the_one_of_fips_180() {
        assert_eq!(
            sha256_hex(b"abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
        );
    }

    #[test]
    fn what_was_sealed_opens() {
        let bytes = seal(KIND, [1, 2, 70_000], b"payload");
        assert_eq!(open(KIND, &bytes).unwrap(), ([1, 2, 70_000], &b"payload"[..]));
    }

    #[test]
    fn every_flipped_bit_and_every_cut_is_refused() {
        let bytes = seal(KIND, [1, 2, 3], b"payload");
        for at in 0..bytes.len() * 8 {
            let mut flipped = bytes.clone();
            flipped[at / 8] ^= 1 << (at % 8);
            assert!(open(KIND, &flipped).is_err(), "bit {at}");
        }
        for length in 0..bytes.len() {
            assert!(open(KIND, &bytes[..length]).is_err(), "length {length}");
        }
    }

    #[test]
    fn another_kind_and_another_version_are_named_as_such() {
        let bytes = seal(KIND, [0; 3], b"");
        let other = open(Kind { magic: b"OTHEROTH", ..KIND }, &bytes).unwrap_err();
        assert!(other.contains("another kind"), "{other}");
        let newer = open(Kind { version: 4, ..KIND }, &bytes).unwrap_err();
        assert!(newer.contains("version 3"), "{newer}");
    }
}
