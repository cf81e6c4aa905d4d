// The screen, as in src/display.rs: the same names, in 32 bits.

struct Display {
    // Linear RGB of X, Y and Z: white (1, 1, 1) is D65 of luminance one.
    rgb_from_xyz: mat3x3f,
    // What is sent to the screen: the same, or its luminance in red alone.
    shown_from_rgb: mat3x3f,
}

// Whether codes follow the transfer curve of sRGB.
override IS_ENCODED: bool = true;
// The highest code, to which codes are dithered and rounded; 0: neither.
override CODE_STEPS: f32 = 255.0;

// Given linear RGB and its luminance, a colour within the gamut that keeps its hue.
fn gamut(rgb: vec3f, luminance: f32) -> vec3f {
    let grey = max(luminance, 0.0);
    let low = min(min(rgb.r, rgb.g), min(rgb.b, 0.0));
    let kept = grey / max(grey - low, 1e-37);
    let positive = grey + (rgb - grey) * kept;
    let high = max(max(positive.r, positive.g), positive.b);
    let white = min(grey, 1.0);
    let paler = white + (positive - grey) * ((1.0 - white) / max(high - white, 1e-37));
    return select(positive, 0.5 * paler + 0.5 / high * positive, high > 1.0);
}

// The transfer curve of sRGB, of linear shares from 0 to 1: a polynomial of least maximum in the fourth root,
// off by at most 3.5e-5, and the straight piece.
fn encode(rgb: vec3f) -> vec3f {
    let q = sqrt(sqrt(rgb));
    let curve = -0.064611494 + q * (0.19613561 + q * (1.1226822 + q * (-0.335502 + q * 0.081330083)));
    return select(min(curve, vec3f(1.0)), 12.92 * rgb, rgb <= vec3f(0.0031308));
}

// Noise of a pixel, 0 up to 1: the sequence R2.
fn dither(pixel: vec2f) -> f32 {
    let at = vec2u(pixel);
    return f32((at.x * 3242174889u + at.y * 2447445414u) >> 8u) * 0x1p-24;
}

// Codes of a highest one with noise in them, to be rounded.
fn dithered(codes: vec3f, noise: f32) -> vec3f {
    let centred = 2.0 * noise - 1.0;
    let triangular = sign(centred) * (1.0 - sqrt(1.0 - abs(centred)));
    let is_near_an_end = abs(codes - 0.5 * CODE_STEPS) > vec3f(0.5 * CODE_STEPS - 0.5);
    return codes + select(vec3f(triangular), vec3f(0.5 * centred), is_near_an_end);
}

// Given linear RGB within the gamut and the pixel, the codes, 0 to 1, as the target of 8 bits takes
// them or, without CODE_STEPS, as they are.
fn rgb_code(display: Display, rgb: vec3f, pixel: vec2f) -> vec4f {
    let shown = saturate(display.shown_from_rgb * rgb);
    var codes = shown;
    if IS_ENCODED {
        codes = encode(shown);
    }
    if CODE_STEPS > 0.0 {
        let steps = dithered(codes * CODE_STEPS, dither(pixel));
        codes = saturate(floor(steps + 0.5) / CODE_STEPS);
    }
    return vec4f(codes, 1.0);
}

// The same of X, Y and Z in shares of the screen's white.
fn display_code(display: Display, xyz: vec3f, pixel: vec2f) -> vec4f {
    return rgb_code(display, gamut(display.rgb_from_xyz * xyz, xyz.y), pixel);
}
