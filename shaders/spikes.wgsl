// Diffraction spikes: lines of light through bright points, added. The twin of `Spike` in
// src/photo/lens.rs.

struct Spike {
    @location(0) centre_px: vec2f,
    // Unit vector, right and down.
    @location(1) direction: vec2f,
    // Half the length and half the width, pixels.
    @location(2) half_size_px: vec2f,
    @location(3) amplitude: vec4f,
}

struct Corner {
    @builtin(position) position: vec4f,
    // Along the line and across it, pixels from the centre.
    @location(0) off_px: vec2f,
    @location(1) @interpolate(flat) half_size_px: vec2f,
    @location(2) @interpolate(flat) amplitude: vec4f,
}

// Where the light of a spike ends in that of its point, pixels: squared.
const CORE_SQUARED: f32 = 1.0;

@group(0) @binding(0) var<storage, read> camera: Camera;

@vertex
fn vertex(spike: Spike, @builtin(vertex_index) index: u32) -> Corner {
    let side = vec2f(f32(index & 1u), f32(index >> 1u)) * 2.0 - 1.0;
    let off_px = side * spike.half_size_px;
    let across = vec2f(-spike.direction.y, spike.direction.x);
    let pixel = spike.centre_px + off_px.x * spike.direction + off_px.y * across;
    return Corner(clip_from_pixel(camera, pixel), off_px, spike.half_size_px, spike.amplitude);
}

@fragment
fn fragment(corner: Corner) -> @location(0) LuminanceXyzv {
    let t = corner.off_px / corner.half_size_px;
    let ends = max(1.0 - t * t, vec2f(0.0));
    let along = ends.x * ends.x / (corner.off_px.x * corner.off_px.x + CORE_SQUARED);
    // The integral of (1 - t^2)^2 is 16/15.
    let across = ends.y * ends.y * (0.9375 / corner.half_size_px.y);
    let solid_angle = pixel_solid_angle(camera, corner.position.xy);
    if solid_angle <= 0.0 {
        return vec4f(0.0);
    }
    return corner.amplitude * (along * across / solid_angle);
}
