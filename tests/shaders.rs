//! Every assembled shader parses and validates, and its structs lie in memory as the Rust ones
//! do. Needs no GPU.

use std::mem::offset_of;

use nocturne::eye::light_table;
use nocturne::plan::globe::EXTENT;
use nocturne::plan::globe::near_side::EDGE;
use nocturne::plan::globe::shadows::Shadows;
use nocturne::render::shaders::{LIBRARY, SHADERS, assembled};
use nocturne::render::uniforms::{
    CameraUniform, DiscBandUniform, DiscUniform, DisplayUniform, FlareUniform, GlobeUniform,
    GrainUniform, HaloUniform, LevelUniform, MeshBandUniform, NearBandUniform, NearUniform,
    PhotoUniform, PlanetUniform, PyramidStepUniform, RetinaUniform, RingUniform, SkyUniform,
};

fn parsed(name: &str, source: &str) -> naga::Module {
    let module = naga::front::wgsl::parse_str(source)
        .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(source)));
    let flags = naga::valid::ValidationFlags::all();
    let capabilities = naga::valid::Capabilities::empty();
    naga::valid::Validator::new(flags, capabilities)
        .validate(&module)
        .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(source)));
    module
}

/// Names and offsets of the members of a struct, and its size.
fn layout(module: &naga::Module, name: &str) -> (Vec<(String, usize)>, usize) {
    let found = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name));
    let (_, ty) = found.unwrap_or_else(|| panic!("no struct {name}"));
    let naga::TypeInner::Struct { members, span } = &ty.inner else { panic!("{name}: no struct") };
    let members = members
        .iter()
        .map(|member| (member.name.clone().unwrap_or_default(), member.offset as usize))
        .collect();
    (members, *span as usize)
}

macro_rules! same_layout {
    ($module:expr, $name:literal, $uniform:ty, [$($member:ident),*]) => {
        let (members, size) = layout(&$module, $name);
        let rust = vec![$((stringify!($member).to_owned(), offset_of!($uniform, $member))),*];
        assert_eq!(members, rust, $name);
        assert_eq!(size, size_of::<$uniform>(), $name);
    };
}

#[test]
fn every_shader_is_valid() {
    for (name, _) in SHADERS {
        parsed(name, &assembled(name));
    }
    parsed("library", &LIBRARY.join("\n"));
}

#[test]
fn uniforms_have_one_layout_on_both_sides() {
    let sky = parsed("sky", &assembled("sky"));
    same_layout!(sky, "Camera", CameraUniform, [apparent_from_view, size_px, focal_px, projection]);
    same_layout!(
        sky,
        "Sky",
        SkyUniform,
        [
            sources,
            shines,
            azimuths,
            above,
            below,
            phases,
            horizon,
            half_pixel,
            dark_azimuths,
            middle_over,
            over_right,
            over_down
        ]
    );

    let pyramid = parsed("pyramid", &assembled("pyramid"));
    let step = layout(&pyramid, "Step");
    let rust = |name: &str, at: usize| (name.to_owned(), at);
    let of_step = [
        rust("share", offset_of!(PyramidStepUniform, share)),
        rust("coarser", offset_of!(PyramidStepUniform, coarser)),
        rust("level", offset_of!(PyramidStepUniform, level)),
        rust("in_place", offset_of!(PyramidStepUniform, in_place)),
        rust("within_x", offset_of!(PyramidStepUniform, within)),
        rust("within_y", offset_of!(PyramidStepUniform, within) + size_of::<[f32; 4]>()),
    ];
    assert_eq!(step, (of_step.to_vec(), size_of::<PyramidStepUniform>()));
    let eye = parsed("eye", &assembled("eye"));
    same_layout!(
        eye,
        "Retina",
        RetinaUniform,
        [in_place, spread, size_px, soft_scale, around_scale]
    );
    same_layout!(eye, "Grain", GrainUniform, [place, size_px, strength]);
    let (rows, size) = layout(&eye, "DisplayRows");
    let named = ["red", "green", "blue"].map(str::to_owned).into_iter().zip([0, 16, 32]);
    assert_eq!((rows, size), (named.collect(), size_of::<DisplayUniform>()));
    let points = parsed("points", &assembled("points"));
    same_layout!(points, "Halo", HaloUniform, [rows_per_octave, first_log2_px, rows, pad]);
    let flare = layout(&parsed("flare", &assembled("flare")), "Flare");
    assert_eq!(flare.0[0], ("radius_px".to_owned(), offset_of!(FlareUniform, radius_px)));
    assert_eq!(flare.1, size_of::<FlareUniform>());
    let lights = parsed("point-light", &assembled("point-light"));
    same_layout!(lights, "Level", LevelUniform, [size, scale, per_lux]);

    let photo = parsed("photo", &assembled("photo"));
    let (members, size) = layout(&photo, "Setting");
    assert_eq!(size, size_of::<PhotoUniform>());
    let at = |name: &str| members.iter().find(|(member, _)| member == name).map(|(_, at)| *at);
    assert_eq!(at("rgb_from_balanced"), Some(offset_of!(PhotoUniform, rgb_from_balanced)));
    assert_eq!(at("natural"), Some(offset_of!(PhotoUniform, natural)));
    assert_eq!(at("mechanical_root"), Some(offset_of!(PhotoUniform, mechanical_root)));
    assert_eq!(at("seed"), Some(offset_of!(PhotoUniform, seed)));
    assert_eq!(at("luminance_from_rgb"), Some(offset_of!(PhotoUniform, luminance_from_rgb)));
    assert_eq!(at("centre_px"), Some(offset_of!(PhotoUniform, centre_px)));
    let globe = parsed("globe", &assembled("globe"));
    same_layout!(
        globe,
        "Globe",
        GlobeUniform,
        [body_from_picture, body_from_sun, observer, sun, earth, alike]
    );
    same_layout!(globe, "MeshBand", MeshBandUniform, [first, last, rings, sectors, is_skirt]);
    let near = parsed("near-discs", &assembled("near-discs"));
    same_layout!(
        near,
        "NearBand",
        NearBandUniform,
        [
            at,
            over,
            beside,
            right,
            down,
            bend_xx,
            bend_xy,
            bend_yy,
            from_occluder,
            texel,
            texel_part,
            from_first
        ]
    );
    same_layout!(
        near,
        "Near",
        NearUniform,
        [
            anchor_px,
            place,
            pixel,
            place_gain,
            place_bend,
            texels,
            outline_steps,
            radius,
            first,
            shift,
            outline
        ]
    );
    let discs = parsed("discs", &assembled("discs"));
    same_layout!(
        discs,
        "Disc",
        DiscUniform,
        [
            first_px,
            last_px,
            lowest_in_view,
            lowest,
            centre,
            to_sun,
            occluder,
            samples,
            per_step,
            edge,
            north,
            bands
        ]
    );
    same_layout!(discs, "Band", DiscBandUniform, [limb, luminance, above_centre]);
    let planets = parsed("planets", &assembled("planets"));
    same_layout!(
        planets,
        "Ring",
        RingUniform,
        [inner, outer, brightness, to_observer, from_sun, padding]
    );
    same_layout!(
        planets,
        "Planet",
        PlanetUniform,
        [
            pole,
            albedo,
            exponent,
            limb_cosine,
            reach,
            ring_count,
            is_lommel_seeliger,
            belt_count,
            belt_edge,
            belts,
            rings
        ]
    );
}

#[test]
fn numbers_of_the_globe_are_those_of_the_plan() {
    let module = parsed("globe", &assembled("globe"));
    for (name, meant) in [
        ("EXTENT", EXTENT),
        ("MAP_EDGE", EDGE),
        ("COS_FIRST_SHADOW", Shadows::FIRST.cos()),
        ("COS_LAST_SHADOW", Shadows::LAST.cos()),
    ] {
        let said = said(&module, name);
        assert!((said - meant).abs() < 1e-7, "{name}: {said}, not {meant}");
    }
}

#[test]
fn numbers_of_the_tables_over_light_are_those_of_the_eye() {
    let module = parsed("eye", &assembled("eye"));
    for (name, meant) in [
        ("LOWEST_LOG2", light_table::LOWEST_LOG2),
        ("COLUMNS_PER_OCTAVE", light_table::COLUMNS_PER_OCTAVE),
        ("COLUMNS", light_table::COLUMNS as f64),
        ("LOWEST_RATIO_LOG2", light_table::LOWEST_RATIO_LOG2),
        ("ROWS_PER_OCTAVE", light_table::ROWS_PER_OCTAVE),
        ("ROWS", light_table::ROWS as f64),
        ("HIGHEST_RATIO", light_table::scotopic_ratio(light_table::ROWS - 1)),
        ("DARKEST", light_table::DARKEST_CD_M2),
    ] {
        assert_eq!(said(&module, name) as f32, meant as f32, "{name}");
    }
}

/// What a constant of a shader is.
fn said(module: &naga::Module, name: &str) -> f64 {
    let found = module.constants.iter().find(|(_, c)| c.name.as_deref() == Some(name));
    let (_, constant) = found.unwrap_or_else(|| panic!("no constant {name}"));
    match module.global_expressions[constant.init] {
        naga::Expression::Literal(naga::Literal::F32(value)) => value.into(),
        naga::Expression::Unary { op: naga::UnaryOperator::Negate, expr } => {
            match module.global_expressions[expr] {
                naga::Expression::Literal(naga::Literal::F32(value)) => -f64::from(value),
                ref other => panic!("{name} is {other:?}"),
            }
        }
        ref other => panic!("{name} is {other:?}"),
    }
}
