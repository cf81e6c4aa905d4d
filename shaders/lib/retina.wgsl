// The light on the retina, from the frame and from what the pyramid spreads of it.

struct Retina {
    // Share of the light that is not scattered.
    in_place: f32,
    // What the light of the picture of half the resolution counts.
    spread: f32,
    size_px: vec2f,
}

// Given a pixel of the frame, its light in a picture of half the resolution.
fn from_half(picture: texture_2d<f32>, between: sampler, pixel: vec2f) -> LuminanceXyzv {
    let place = 0.5 * pixel / vec2f(textureDimensions(picture));
    return textureSampleLevel(picture, between, place, 0.0);
}
