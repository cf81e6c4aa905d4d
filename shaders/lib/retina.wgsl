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

// Linear RGB of X, Y and Z as they are seen, and the luminance of each primary.
struct DisplayRows {
    red: vec4f,
    green: vec4f,
    blue: vec4f,
}

// Whether all is shown in red.
override IS_RED: bool = false;

// Given the rows of a display and X, Y and Z in shares of its peak, what its primaries are sent.
fn sent_of(red: vec4f, green: vec4f, blue: vec4f, xyz: vec3f) -> vec3f {
    let sent = gamut(vec3f(dot(red.xyz, xyz), dot(green.xyz, xyz), dot(blue.xyz, xyz)), xyz.y);
    if IS_RED {
        return vec3f(dot(vec3f(red.w, green.w, blue.w), sent), 0.0, 0.0);
    }
    return sent;
}
