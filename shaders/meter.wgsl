// What the meter of a camera looks at: one pixel of each block of the frame.

const METERED_PX: u32 = 16u;

@group(0) @binding(0) var frame: texture_2d<f32>;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return full_screen_corner(index);
}

@fragment
fn fragment(@builtin(position) pixel: vec4f) -> @location(0) LuminanceXyzv {
    let middle = METERED_PX * vec2u(pixel.xy) + METERED_PX / 2u;
    return textureLoad(frame, min(middle, textureDimensions(frame) - 1u), 0);
}
