// Light that is added to codes.

// Given linear shares of white, how much light a code is worth there: the slope of the transfer curve.
fn code_sizes(linear: vec3f) -> vec3f {
    if CODE_STEPS == 0.0 {
        return vec3f(0.0);
    }
    if !IS_ENCODED {
        return vec3f(1.0 / max(CODE_STEPS, 1.0));
    }
    let curved = 2.2748815 * pow(linear, vec3f(0.58333333));
    return select(curved, vec3f(1.0 / 12.92), linear <= vec3f(0.0031308)) / max(CODE_STEPS, 1.0);
}

// Given light to add and the size of a code, the light to send: the target rounds each sum to a code, so
// what is less than one is given whole, in so many pixels.
fn whole_codes(light: vec3f, code: vec3f, pixel: vec2f) -> vec3f {
    let steps = light / max(code, vec3f(1e-20));
    let rounded = code * floor(steps + dither(pixel.yx));
    let are_few = (steps < vec3f(8.0)) & (code > vec3f(0.0));
    return select(light, rounded, are_few);
}
