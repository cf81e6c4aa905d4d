// The globe of the Moon and its picture: the numbers that src/plan/globe.rs says.

// Half of the edge of the picture, in radii of the Moon.
const EXTENT: f32 = 1.01;
// Half of the edge of the maps of the near side.
const MAP_EDGE: f32 = 1.35;
// Angles from the subsolar point, of the first and the last row of the shadows, and their cosines.
const FIRST_SHADOW: f32 = 0.90757121;
const LAST_SHADOW: f32 = 1.69296937;
const COS_FIRST_SHADOW: f32 = 0.61566148;
const COS_LAST_SHADOW: f32 = -0.12186934;
// Least ratios that a texel of colours holds.
const LEAST_RED: f32 = 0.6;
const LEAST_BLUE: f32 = 0.3;
// Within this no valley reaches, in radii of the Moon; and what a texel of the outline counts in.
const INSIDE: f32 = 0.99;
const OUTLINE_UNIT: f32 = 0.01;

// Given a point of the picture in radii of the Moon, the part of a pixel of that width around it that is
// within the outline.
fn within_limb(outline: texture_2d<f32>, around: sampler, at: vec2f, width: f32) -> f32 {
    let radius = length(at);
    if radius < INSIDE - width {
        return 1.0;
    }
    let turn = atan2(at.y, at.x) / (2.0 * PI);
    // Values belong to the nodes: the middles of the texels.
    let place = vec2f(fract(turn) + 0.5 / f32(textureDimensions(outline).x), 0.5);
    let limb = 1.0 + OUTLINE_UNIT * textureSampleLevel(outline, around, place, 0.0).x;
    return clamp((limb - radius) / width + 0.5, 0.0, 1.0);
}
