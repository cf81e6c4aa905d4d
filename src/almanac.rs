//! What happens in the sky, and when.

pub mod eclipse;
