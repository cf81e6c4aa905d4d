//! The shaders, each assembled from its sources in order: plain concatenation, nothing edited.

const QUANTITIES: &str = include_str!("../../shaders/lib/quantities.wgsl");
const CAMERA: &str = include_str!("../../shaders/lib/camera.wgsl");
const SKYLIGHT: &str = include_str!("../../shaders/skylight.wgsl");
const GLOBE: &str = include_str!("../../shaders/lib/globe.wgsl");
const DISCS: &str = include_str!("../../shaders/discs.wgsl");
const DISC_FAR: &str = include_str!("../../shaders/lib/disc_far.wgsl");
const DISC_NEAR: &str = include_str!("../../shaders/lib/disc_near.wgsl");
const PLANET: &str = include_str!("../../shaders/planet.wgsl");
const SPLAT: &str = include_str!("../../shaders/lib/splat.wgsl");

const LIGHT_TABLE: &str = include_str!("../../shaders/lib/light_table.wgsl");
const CODES: &str = include_str!("../../shaders/lib/codes.wgsl");
const RETINA: &str = include_str!("../../shaders/lib/retina.wgsl");
const DISPLAY: &str = include_str!("../../shaders/lib/display.wgsl");

/// Every shader of the renderer: the name of its pass, and the sources that make it.
pub const SHADERS: [(&str, &[&str]); 20] = [
    ("sky", &[QUANTITIES, CAMERA, SKYLIGHT, include_str!("../../shaders/sky.wgsl")]),
    ("sky-in", &[QUANTITIES, SKYLIGHT, include_str!("../../shaders/sky_in.wgsl")]),
    ("milky-way", &[QUANTITIES, CAMERA, include_str!("../../shaders/milky_way.wgsl")]),
    ("globe", &[QUANTITIES, GLOBE, include_str!("../../shaders/globe.wgsl")]),
    ("globe-mean", &[QUANTITIES, GLOBE, include_str!("../../shaders/globe_mean.wgsl")]),
    ("discs", &[QUANTITIES, CAMERA, GLOBE, DISC_FAR, DISCS]),
    ("planets", &[QUANTITIES, CAMERA, GLOBE, DISC_FAR, DISCS, PLANET]),
    ("near-discs", &[QUANTITIES, CAMERA, GLOBE, DISC_NEAR, DISCS]),
    ("near-planets", &[QUANTITIES, CAMERA, GLOBE, DISC_NEAR, DISCS, PLANET]),
    ("splats", &[QUANTITIES, CAMERA, SPLAT, include_str!("../../shaders/splats.wgsl")]),
    (
        "pyramid",
        &[
            QUANTITIES,
            CAMERA,
            LIGHT_TABLE,
            DISPLAY,
            RETINA,
            include_str!("../../shaders/pyramid.wgsl"),
        ],
    ),
    (
        "eye",
        &[QUANTITIES, CAMERA, LIGHT_TABLE, RETINA, DISPLAY, include_str!("../../shaders/eye.wgsl")],
    ),
    (
        "points",
        &[
            QUANTITIES,
            SPLAT,
            LIGHT_TABLE,
            RETINA,
            DISPLAY,
            CODES,
            include_str!("../../shaders/points.wgsl"),
        ],
    ),
    (
        "flare",
        &[
            QUANTITIES,
            LIGHT_TABLE,
            RETINA,
            DISPLAY,
            CODES,
            include_str!("../../shaders/flare.wgsl"),
        ],
    ),
    ("point-light", &[QUANTITIES, include_str!("../../shaders/point_light.wgsl")]),
    ("spikes", &[QUANTITIES, CAMERA, include_str!("../../shaders/spikes.wgsl")]),
    ("meter", &[QUANTITIES, CAMERA, include_str!("../../shaders/meter.wgsl")]),
    ("photo", &[QUANTITIES, DISPLAY, include_str!("../../shaders/photo.wgsl")]),
    ("lines", &[include_str!("../../shaders/lines.wgsl")]),
    ("window", &[include_str!("../../shaders/window.wgsl")]),
];

/// The functions without bindings, for the probes that compare them with their twins.
pub const LIBRARY: &[&str] = &[QUANTITIES, CAMERA, SPLAT, DISPLAY];

/// The whole text of a shader.
pub fn assembled(pass: &str) -> String {
    let sources = SHADERS.iter().find(|(name, _)| *name == pass).map(|(_, sources)| *sources);
    sources.unwrap_or_default().join("\n")
}
