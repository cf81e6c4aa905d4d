// The light on the retina, from the frame and from what the pyramid spreads of it.

struct Retina {
    // Share of the light that is not scattered, or so little that it stays within its pixel.
    in_place: f32,
    // What the light that is spread counts: all, or nothing.
    spread: f32,
    size_px: vec2f,
    // A pixel on the level where what is shown is finished, and on that which spreads: from 0 to 1 across
    // each.
    soft_scale: vec2f,
    around_scale: vec2f,
}
