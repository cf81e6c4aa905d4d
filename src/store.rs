//! A store on disk for what takes long to compute: blocks of bytes, found by what they were made from.
//!
//! A block is named by the SHA-256 of everything that went into it, so it never goes out of date; it is
//! written under a temporary name and then renamed, and carries its own digest, so that half a block is
//! no block. A store that cannot be read or written is an empty one: nothing fails for want of it.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use sha2::{Digest, Sha256};

/// Names another folder than the platform's; empty for no store.
pub const FOLDER_VARIABLE: &str = "NOCTURNE_CACHE";
/// Bytes that a store may hold before the blocks that were used longest ago are dropped.
const CAPACITY: u64 = 256 << 20;
const DIGEST_LEN: usize = 32;

/// A folder of blocks, or none.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Store {
    folder: Option<PathBuf>,
    capacity: u64,
}

/// The name of a block: the digest of what it is made from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Key([u8; DIGEST_LEN]);

impl Key {
    /// Of parts that are told apart by their lengths.
    pub fn of(parts: &[&[u8]]) -> Key {
        let mut digest = Sha256::new();
        for part in parts {
            digest.update((part.len() as u64).to_le_bytes());
            digest.update(part);
        }
        Key(digest.finalize().into())
    }

    fn file_name(&self) -> String {
        self.0.iter().map(|byte| format!("{byte:02x}")).collect::<String>() + ".bin"
    }
}

impl Store {
    /// Keeps nothing.
    pub const NONE: Store = Store { folder: None, capacity: 0 };

    /// In the user's folder for such things, or where `NOCTURNE_CACHE` says.
    pub fn of_user() -> Store {
        let folder = match std::env::var_os(FOLDER_VARIABLE) {
            Some(named) => Some(PathBuf::from(named)).filter(|path| !path.as_os_str().is_empty()),
            None => dirs::cache_dir().map(|folder| folder.join("nocturne")),
        };
        Store { folder, capacity: CAPACITY }
    }

    /// In a folder, which is made when it is needed; it holds about so many bytes.
    pub fn in_folder(folder: &Path, capacity: u64) -> Store {
        Store { folder: Some(folder.to_owned()), capacity }
    }

    /// The block of that name, if it is there and whole.
    pub fn get(&self, key: &Key) -> Option<Vec<u8>> {
        let path = self.folder.as_ref()?.join(key.file_name());
        let mut block = fs::read(&path).ok()?;
        let body = block.len().checked_sub(DIGEST_LEN)?;
        if Sha256::digest(&block[..body])[..] != block[body..] {
            // Better gone than read again.
            fs::remove_file(&path).ok();
            return None;
        }
        // The time of change tells when a block was last of use.
        if let Ok(file) = fs::File::options().append(true).open(&path) {
            file.set_modified(SystemTime::now()).ok();
        }
        block.truncate(body);
        Some(block)
    }

    /// Keeps a block. False if it could not be kept.
    pub fn put(&self, key: &Key, block: &[u8]) -> bool {
        let Some(folder) = &self.folder else { return false };
        let kept = self.write(folder, key, block).is_ok();
        self.drop_oldest(folder);
        kept
    }

    fn write(&self, folder: &Path, key: &Key, block: &[u8]) -> std::io::Result<()> {
        use std::io::Write;
        fs::create_dir_all(folder)?;
        let mut file = tempfile::Builder::new().suffix(".part").tempfile_in(folder)?;
        file.write_all(block)?;
        file.write_all(&Sha256::digest(block))?;
        file.persist(folder.join(key.file_name())).map_err(|error| error.error)?;
        Ok(())
    }

    fn drop_oldest(&self, folder: &Path) {
        let Ok(entries) = fs::read_dir(folder) else { return };
        let mut blocks: Vec<(SystemTime, u64, PathBuf)> = entries
            .flatten()
            .filter(|entry| entry.path().extension().is_some_and(|name| name == "bin"))
            .filter_map(|entry| {
                let data = entry.metadata().ok()?;
                Some((data.modified().ok()?, data.len(), entry.path()))
            })
            .collect();
        blocks.sort();
        let mut total: u64 = blocks.iter().map(|(_, len, _)| len).sum();
        for (_, len, path) in blocks {
            if total <= self.capacity {
                return;
            }
            fs::remove_file(path).ok();
            total -= len;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_comes_back_whole_or_not_at_all() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::in_folder(&folder.path().join("new"), 1 << 20);
        let key = Key::of(&[b"air", b"42"]);
        assert_eq!(store.get(&key), None);
        assert!(store.put(&key, b"field"));
        assert_eq!(store.get(&key).unwrap(), b"field");
        assert_ne!(key, Key::of(&[b"air4", b"2"]));
        assert_eq!(store.get(&Key::of(&[b"air"])), None);

        let path = folder.path().join("new").join(key.file_name());
        let whole = fs::read(&path).unwrap();
        for damaged in [&whole[..whole.len() - 1], &whole[1..], b"", b"short"] {
            fs::write(&path, damaged).unwrap();
            assert_eq!(store.get(&key), None);
            assert!(damaged.len() < DIGEST_LEN || !path.exists());
        }
        let mut flipped = whole.clone();
        flipped[2] ^= 1;
        fs::write(&path, &flipped).unwrap();
        assert_eq!(store.get(&key), None);
    }

    #[test]
    fn what_was_used_longest_ago_goes_first() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::in_folder(folder.path(), 2 * 132);
        let keys: Vec<Key> = (0..3u8).map(|k| Key::of(&[&[k]])).collect();
        let touch = |key: &Key, seconds: u64| {
            let file = fs::File::options().append(true).open(folder.path().join(key.file_name()));
            let then = SystemTime::UNIX_EPOCH + std::time::Duration::from_secs(seconds);
            file.unwrap().set_modified(then).unwrap();
        };
        for (second, key) in keys.iter().enumerate().take(2) {
            store.put(key, &[0; 100]);
            touch(key, 10 + second as u64);
        }
        // The first is read again, and outlives the second.
        assert!(store.get(&keys[0]).is_some());
        store.put(&keys[2], &[0; 100]);
        assert!(store.get(&keys[0]).is_some() && store.get(&keys[2]).is_some());
        assert_eq!(store.get(&keys[1]), None);
    }

    #[test]
    fn no_store_and_no_room_are_no_error() {
        let key = Key::of(&[]);
        assert!(!Store::NONE.put(&key, b"x") && Store::NONE.get(&key).is_none());
        let file = tempfile::NamedTempFile::new().unwrap();
        let store = Store::in_folder(file.path(), 1 << 20);
        assert!(!store.put(&key, b"x") && store.get(&key).is_none());
    }
}
