// The light on the retina, from the frame and from what the pyramid spreads of it.

struct Retina {
    // Share of the light that is not scattered.
    in_place: f32,
    // What the light of the picture of half the resolution counts.
    spread: f32,
    size_px: vec2f,
    // A pixel on the picture of half the resolution, on that where what is shown is finished, and on
    // the one where points look at what is around them: from 0 to 1 across each.
    half_scale: vec2f,
    soft_scale: vec2f,
    around_scale: vec2f,
}
