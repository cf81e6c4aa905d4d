// Lines on the picture of a window: triangles that carry their colour.

struct Place {
    // Points of the window where the picture begins, and clip units for a point.
    origin: vec2f,
    scale: vec2f,
}

@group(0) @binding(0) var<uniform> place: Place;

struct Corner {
    @builtin(position) position: vec4f,
    // Codes, multiplied with the opacity.
    @location(0) colour: vec4f,
}

@vertex
fn vertex(@location(0) point: vec2f, @location(1) colour: vec4f) -> Corner {
    let away = (point - place.origin) * place.scale;
    return Corner(vec4f(away.x - 1.0, 1.0 - away.y, 0.0, 1.0), colour);
}

@fragment
fn fragment(corner: Corner) -> @location(0) vec4f {
    return corner.colour;
}
