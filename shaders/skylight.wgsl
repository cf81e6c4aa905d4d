// The light of the sky, and of the ground below it, in an apparent direction: tables looked up,
// nothing marched. The twin of SkyPlan::luminance.

// A source of light, by where it is seen.
struct Source {
    // Unit vector to where the turn of its light is counted from, in local axes; w is its azimuth.
    dir: vec4f,
}

struct Sky {
    // The Sun and the Moon, or both sides of the Sun.
    sources: array<Source, 2>,
    // For each: 0 without light, 1 without haze, 2 with haze; and 4 if it is for the side clockwise from
    // its source alone, 8 if for the other.
    shines: vec2u,
    // Columns, rows above the horizon and below it, and values of the phase function.
    azimuths: u32,
    above: u32,
    below: u32,
    phases: u32,
    // Apparent elevation of the horizon.
    horizon: Radians,
    // Half the height of a pixel at the horizon: the horizon is drawn that soft.
    half_pixel: Radians,
    // Columns of the dark sky.
    dark_azimuths: u32,
    // On a narrow picture, how high its middle is over the horizon and what a pixel gains to the right and
    // down, pixels: small numbers keep their digits. Zero on others.
    middle_over: f32,
    over_right: f32,
    over_down: f32,
}

@group(0) @binding(1) var<storage, read> sky: Sky;
// Sun, then Moon: by row and by azimuth from the source (0 to pi), the smooth part and that of the
// haze over its phase function; then the dark sky by row and by azimuth from north (0 to 2 pi). Rows lie above the horizon h at
// h + (pi/2 - h) t^2, then below it at h - (pi/2 + h) t^4, for t from 0 to 1.
@group(0) @binding(2) var<storage, read> table: array<vec4f>;
// The phase function of the haze, in equal steps of the square root of the turn, 0 to pi.
@group(0) @binding(3) var<storage, read> phase: array<f32>;

// The row at or before a direction, and the share of the next one.
struct Row {
    row: u32,
    share: f32,
}

fn row_at(altitude: Radians, above: bool) -> Row {
    var first = 0u;
    var last = sky.above - 1u;
    var t = sqrt(clamp((altitude - sky.horizon) / (0.5 * PI - sky.horizon), 0.0, 1.0));
    if !above {
        first = sky.above;
        last = sky.below - 1u;
        t = sqrt(sqrt(clamp((sky.horizon - altitude) / (0.5 * PI + sky.horizon), 0.0, 1.0)));
    }
    let place = t * f32(last);
    let row = min(u32(place), last - 1u);
    return Row(first + row, place - f32(row));
}

// Given the angle that light turns by, the phase function, per steradian.
fn phase_at(turn: Radians) -> f32 {
    let place = sqrt(turn / PI) * f32(sky.phases - 1u);
    let node = min(u32(place), sky.phases - 2u);
    return mix(phase[node], phase[node + 1u], place - f32(node));
}

// Given a source's number, a direction, its azimuth from the source and its row, the source's light.
fn scattered(source: u32, dir: vec3f, azimuth_from_source: Radians, row: Row) -> LuminanceXyzv {
    let column = azimuth_from_source / PI * f32(sky.azimuths - 1u);
    let c0 = min(u32(column), sky.azimuths - 2u);
    let along = column - f32(c0);
    let low = 2u * (((source * (sky.above + sky.below)) + row.row) * sky.azimuths + c0);
    let high = low + 2u * sky.azimuths;
    let smooth_low = mix(table[low], table[low + 2u], along);
    let smooth_high = mix(table[high], table[high + 2u], along);
    var light = mix(smooth_low, smooth_high, row.share);
    if (sky.shines[source] & 2u) != 0u {
        let haze_low = mix(table[low + 1u], table[low + 3u], along);
        let haze_high = mix(table[high + 1u], table[high + 3u], along);
        let to_source = sky.sources[source].dir.xyz;
        let turn = atan2(length(cross(dir, to_source)), dot(dir, to_source));
        light += mix(haze_low, haze_high, row.share) * phase_at(turn);
    }
    return light;
}

// Given an azimuth and a row, the light of the dark sky.
fn dark_sky(azimuth: Radians, row: Row) -> LuminanceXyzv {
    let place = fract(azimuth / (2.0 * PI)) * f32(sky.dark_azimuths);
    let column = min(u32(place), sky.dark_azimuths - 1u);
    let along = place - f32(column);
    let beside = select(column + 1u, 0u, column + 1u == sky.dark_azimuths);
    let low = 4u * (sky.above + sky.below) * sky.azimuths + row.row * sky.dark_azimuths;
    let high = low + sky.dark_azimuths;
    let in_low = mix(table[low + column], table[low + beside], along);
    let in_high = mix(table[high + column], table[high + beside], along);
    return mix(in_low, in_high, row.share);
}

// Given an apparent direction and its altitude, the light there, from a side of the horizon.
fn light_of_side(dir: vec3f, altitude: Radians, above: bool) -> LuminanceXyzv {
    let row = row_at(altitude, above);
    let azimuth = atan2(dir.x, dir.y);
    var light = dark_sky(azimuth, row);
    for (var source = 0u; source < 2u; source++) {
        if sky.shines[source] != 0u {
            let turned = azimuth - sky.sources[source].dir.w;
            let from_source = turned - 2.0 * PI * round(turned / (2.0 * PI));
            let other_side = select(8u, 4u, from_source < 0.0);
            if (sky.shines[source] & other_side) == 0u {
                light += scattered(source, dir, abs(from_source), row);
            }
        }
    }
    return light;
}

fn altitude_of(dir: vec3f) -> Radians {
    return atan2(dir.z, length(dir.xy));
}

// Given an apparent direction, the light of the sky there, or of the ground below the horizon.
fn skylight(dir: vec3f) -> LuminanceXyzv {
    let altitude = altitude_of(dir);
    return light_of_side(dir, altitude, altitude >= sky.horizon);
}
