// The light on the retina, from the frame and from what the pyramid spreads of it.

struct Retina {
    // Share of the light that is not scattered.
    in_place: f32,
    // What the light of the picture of half the resolution counts.
    spread: f32,
    size_px: vec2f,
    // Texels to a pixel where what is shown is finished at a coarser level, and where points look at
    // what is around them.
    soft_scale: f32,
    around_scale: f32,
    pad: vec2f,
}

// Given a pixel of the frame, its light in a level of the pyramid with so many texels to a pixel.
fn from_level(picture: texture_2d<f32>, between: sampler, pixel: vec2f, scale: f32) -> LuminanceXyzv {
    let place = scale * pixel / vec2f(textureDimensions(picture));
    return textureSampleLevel(picture, between, place, 0.0);
}
