//! The memory of the program: how much it is, and that what is no longer used goes back to the system.

/// Blocks of this size and above are taken from the system and given back to it one by one.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const LARGE_BYTES: i32 = 1 << 20;

/// Tells the allocator of the C library, which the graphics driver uses too, to keep no large blocks.
///
/// By itself it keeps blocks of up to 32 MB for later, for every thread: with pictures of many sizes
/// memory would grow to twice and three times of what is in use. To be called before the first thread.
pub fn give_back() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    // SAFETY: it sets numbers of the allocator, which it guards by a lock of its own.
    unsafe {
        libc::mallopt(libc::M_MMAP_THRESHOLD, LARGE_BYTES);
        libc::mallopt(libc::M_TRIM_THRESHOLD, LARGE_BYTES);
        libc::mallopt(libc::M_ARENA_MAX, 2);
    }
}

/// Memory that the program holds, MiB; where Linux tells it.
pub fn resident_mib() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    let kib: f64 = line.split_whitespace().next()?.parse().ok()?;
    Some(kib / 1024.0)
}
