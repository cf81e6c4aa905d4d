//! What lies between the eye and the light.

pub mod scattering;
