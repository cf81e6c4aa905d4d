//! The almanac against brute force, against its own definitions, and as a program.

mod almanac {
    mod definitions;
    mod geocentric;
    mod places;
    #[cfg(feature = "cli")]
    mod program;
    mod truth;
}
