// The sky and the ground below it: tables looked up once a pixel, nothing marched.

struct Sky {
    // Azimuths of the Sun and the Moon, from north through east.
    source_azimuth: vec2<Radians>,
    // Whether the table of the Sun and that of the Moon hold anything.
    source_shines: vec2u,
    azimuths: u32,
    altitudes: u32,
    // Half the height of a pixel at the horizon: the horizon is drawn that soft.
    half_pixel: Radians,
    padding: f32,
    ground: LuminanceXyzv,
}

@group(0) @binding(0) var<uniform> camera: Camera;
@group(0) @binding(1) var<uniform> sky: Sky;
// Sun, then Moon: azimuths from the source (0 to pi) innermost, by altitude; then the dark sky by
// altitude alone. Altitudes are pi/2 t^2 for t from 0 to 1.
@group(0) @binding(2) var<storage, read> table: array<vec4f>;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return full_screen_corner(index);
}

// Given the source's table number, the azimuth from it and the row by altitude, its skylight.
fn scattered(source: u32, azimuth_from_source: Radians, row: f32) -> LuminanceXyzv {
    let column = azimuth_from_source / PI * f32(sky.azimuths - 1u);
    let c0 = min(u32(column), sky.azimuths - 2u);
    let r0 = min(u32(row), sky.altitudes - 2u);
    let start = (source * sky.altitudes + r0) * sky.azimuths + c0;
    let along = column - f32(c0);
    let lower = mix(table[start], table[start + 1u], along);
    let upper = mix(table[start + sky.azimuths], table[start + sky.azimuths + 1u], along);
    return mix(lower, upper, row - f32(r0));
}

// Given an apparent direction at or above the horizon, the light of the sky there.
fn skylight(dir: vec3f) -> LuminanceXyzv {
    let altitude = max(atan2(dir.z, length(dir.xy)), 0.0);
    let azimuth = atan2(dir.x, dir.y);
    let row = sqrt(altitude / (0.5 * PI)) * f32(sky.altitudes - 1u);
    let r0 = min(u32(row), sky.altitudes - 2u);
    let dark = 2u * sky.altitudes * sky.azimuths + r0;
    var light = mix(table[dark], table[dark + 1u], row - f32(r0));
    for (var source = 0u; source < 2u; source++) {
        if sky.source_shines[source] != 0u {
            let turned = abs(azimuth - sky.source_azimuth[source]);
            let from_source = abs(turned - 2.0 * PI * round(turned / (2.0 * PI)));
            light += scattered(source, from_source, row);
        }
    }
    return light;
}

@fragment
fn fragment(@builtin(position) position: vec4f) -> @location(0) LuminanceXyzv {
    let sight = apparent_from_pixel(camera, position.xy);
    if !sight.exists {
        return vec4f(0.0);
    }
    let altitude = atan2(sight.dir.z, length(sight.dir.xy));
    let above = clamp(0.5 + 0.5 * altitude / sky.half_pixel, 0.0, 1.0);
    var light = (1.0 - above) * sky.ground;
    if above > 0.0 {
        light += above * skylight(sight.dir);
    }
    return light;
}
