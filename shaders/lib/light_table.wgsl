// Tables over light: columns by the logarithm of Y, rows by that of V over Y. The numbers are those of
// src/eye/light_table.rs.

const LOWEST_LOG2: f32 = -30.0;
const COLUMNS_PER_OCTAVE: f32 = 8.0;
const COLUMNS: f32 = 513.0;
const LOWEST_RATIO_LOG2: f32 = -4.0;
const ROWS_PER_OCTAVE: f32 = 4.0;
const ROWS: f32 = 33.0;
const HIGHEST_RATIO: f32 = 16.0;
const DARKEST: f32 = 1e-10;

// Given a light, its column, 0 to 1 across the table.
fn light_column(light: LuminanceXyzv) -> f32 {
    let place = (log2(max(light.y, DARKEST)) - LOWEST_LOG2) * COLUMNS_PER_OCTAVE;
    return (place + 0.5) / COLUMNS;
}

// Given a light, what a table holds for it.
fn at_light(table: texture_2d<f32>, between: sampler, light: LuminanceXyzv) -> vec4f {
    let luminance = max(light.y, DARKEST);
    let ratio = max(light.w, DARKEST) / luminance;
    let row = (log2(ratio) - LOWEST_RATIO_LOG2) * ROWS_PER_OCTAVE;
    let place = vec2f(light_column(light), (row + 0.5) / ROWS);
    return textureSampleLevel(table, between, place, 0.0);
}

// Given a light, the level of a pyramid that is just as fine as the eye resolves by it.
fn level_resolved(levels: texture_2d<f32>, between: sampler, light: LuminanceXyzv) -> f32 {
    return textureSampleLevel(levels, between, vec2f(light_column(light), 0.5), 0.0).x;
}

// Given the light on the retina, what is shown of it: X, Y and Z in shares of the screen's peak.
// The table has the luminance that cones give, and the X, Y and Z that rods give of a scotopic luminance as
// large as the photopic one.
fn seen_of(shown: texture_2d<f32>, between: sampler, light: LuminanceXyzv) -> vec4f {
    let by = at_light(shown, between, light);
    let of_luminance = 1.0 / max(light.y, DARKEST);
    let ratio = min(light.w * of_luminance, HIGHEST_RATIO);
    return vec4f(by.x * of_luminance * light.xyz + ratio * by.yzw, light.y);
}
