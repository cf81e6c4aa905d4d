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

// Share of the room between grey and white that a channel uses as it is.
const FREE: f32 = 0.6;

// Given linear RGB and its luminance, a colour within the gamut that keeps its hue.
fn gamut(rgb: vec3f, luminance: f32) -> vec3f {
    let grey = max(luminance, 0.0);
    let low = min(min(rgb.r, rgb.g), min(rgb.b, 0.0));
    let within = grey / max(grey - low, 1e-37);
    let positive = grey + (rgb - grey) * within;
    let high = max(max(positive.r, positive.g), positive.b);
    // A part of it moved to the grey of its luminance, or to white, the more the brighter it is, once it uses
    // more of the room there than is free, the rest dimmed; what is divided by zero is within the gamut.
    let white = min(grey, 1.0);
    let share = white * white;
    let room = 1.0 - white;
    let used = high - white;
    let left = (1.0 - FREE) * (1.0 - FREE) * room / (used + (1.0 - 2.0 * FREE) * room);
    let kept = share * (room / used) * (1.0 - left);
    let dimmed = (1.0 - share) / max(high, 1.0);
    let brought = positive * (kept + dimmed) + (share * white - grey * kept);
    return select(positive, brought, used > FREE * room);
}

// The transfer curve of sRGB, of linear shares from 0 to 1: a polynomial of least maximum in the square root,
// off by at most 1.5e-4, and the straight piece.
fn encode(rgb: vec3f) -> vec3f {
    let q = sqrt(rgb);
    let steep = -0.04223199 + q * (1.5752707 + q * (-1.89946906 + q * 3.8984006));
    let curve = steep + (q * q) * (q * q) * (-5.00308021 + q * (3.41860335 - q * 0.94764237));
    return select(curve, 12.92 * rgb, rgb <= vec3f(0.0031308));
}

// Noise of a pixel, 0 up to 1: the sequence R2.
fn dither(pixel: vec2f) -> f32 {
    let at = vec2u(pixel);
    return f32((at.x * 3242174889u + at.y * 2447445414u) >> 8u) * 0x1p-24;
}

// Codes, 0 to 1, with noise in them: rounded by the target they are dithered.
fn dithered(codes: vec3f, noise: f32) -> vec3f {
    let one = 1.0 / max(CODE_STEPS, 1.0);
    let centred = 2.0 * noise - 1.0;
    let triangular = sign(centred) * (one - one * sqrt(1.0 - abs(centred)));
    let is_near_an_end = abs(codes - 0.5) > vec3f(0.5 - 0.5 * one);
    return codes + select(vec3f(triangular), vec3f(0.5 * one * centred), is_near_an_end);
}

// Given what is sent to the screen, linear and from 0 to 1, and the pixel, what a target of 8 bits rounds to
// its codes or, without CODE_STEPS, the codes from 0 to 1 as they are.
fn shown_code(shown: vec3f, pixel: vec2f) -> vec4f {
    var codes = shown;
    if IS_ENCODED {
        codes = encode(shown);
    }
    if CODE_STEPS > 0.0 {
        return vec4f(dithered(codes, dither(pixel)), 1.0);
    }
    return vec4f(saturate(codes), 1.0);
}

// The same of X, Y and Z in shares of the screen's white.
fn display_code(display: Display, xyz: vec3f, pixel: vec2f) -> vec4f {
    let rgb = gamut(display.rgb_from_xyz * xyz, xyz.y);
    return shown_code(saturate(display.shown_from_rgb * rgb), pixel);
}
