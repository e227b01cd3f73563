//! What objects are made of.

use super::{Area, Block, Field, Range, Type, at_most_one_of, field, one_of};

/// Metals whose reflectance is known by name.
pub(super) const METALS: Type = Type::Choice(&["silver", "gold", "copper", "aluminium", "iron", "chromium"]);

/// Shares of the light that arrives; `check` explains what lies outside.
const SHARE: Range = Range::closed(0.0, 1.0).physical();

const DIFFUSE: &[Field] =
    &[field("color", Type::ColorInput, "Albedo: the share of light it sends back.").or(0.5).within(SHARE)];

const PHONG: &[Field] = &[
    field("diffuse", Type::ColorInput, "Albedo of the matt part.").or(0.5).within(SHARE),
    field("specular", Type::ColorInput, "Albedo of the gloss.").or(0.04).within(SHARE),
    field("shininess", Type::Number, "How sharp the gloss is.").or(40.0).within(Range::closed(0.0, 1e5)),
];

const MIRROR: &[Field] =
    &[field("color", Type::ColorInput, "The share of light it reflects.").or(1.0).within(SHARE)];

const METAL: &[Field] = &[
    field("kind", METALS, "A metal by name."),
    field("color", Type::ColorInput, "Reflectance seen straight on, instead of `kind`.").within(SHARE),
    field("roughness", Type::NumberInput, "0 is a mirror, 1 is matt; alpha is its square.")
        .or(0.2)
        .within(SHARE),
];

const GLASS: &[Field] = &[
    field("ior", Type::Number, "Index of refraction.")
        .or(1.5)
        .within(Range::at_least(1.0).physical())
        .like("1.52"),
    field("tint", Type::Color, "A factor at every crossing of the surface.").or(1.0).within(SHARE),
    field("absorption", Type::Absorption, "What is left of white light after that way inside."),
];

const EMISSIVE: &[Field] = &[
    field("radiance", Type::Radiance, "W/m²/sr, times `color`; 1 if neither this nor `power` is said."),
    field("power", Type::Power, "Over the whole object, instead of `radiance`."),
    field("color", Type::LightColor, "The colour of the light.").or(1.0),
];

const WHITTED: &[Field] = &[
    field("diffuse", Type::ColorInput, "The factor of the cosine towards each light.").or(0.5),
    field("specular", Type::ColorInput, "The factor of the highlight.").or(0.0),
    field("shininess", Type::Number, "The exponent of the highlight.")
        .or(0.0)
        .within(Range::closed(0.0, 1e5)),
    field("reflection", Type::ColorInput, "The factor of what is seen mirrored.").or(0.0),
    field("transmission", Type::ColorInput, "The factor of what is seen through it.").or(0.0),
    field("ior", Type::Number, "Index of refraction.")
        .or(1.0)
        .within(Range::at_least(1.0).physical())
        .like("1.5"),
    field("fresnel", Type::Bool, "Whether the angle shares light between reflection and transmission.")
        .or_bool(false),
];

const MIX: &[Field] = &[
    field("a", Type::Material, "The material where `amount` is 0.").required().like("metal { kind: gold }"),
    field("b", Type::Material, "The material where it is 1.").required().like("glass { ior: 1.5 }"),
    field("amount", Type::NumberInput, "The share of `b`.").or(0.5).within(SHARE),
];

const fn material(
    kind: &'static str,
    own: &'static [Field],
    doc: &'static str,
    example: &'static str,
) -> Block {
    Block { kind, area: Area::Material, doc, example, own, choices: &[] }
}

pub(super) const BLOCKS: &[Block] = &[
    material("diffuse", DIFFUSE, "Matt: light leaves in all directions alike.", "diffuse { color: #ff8800 }"),
    material(
        "phong",
        PHONG,
        "Matt under a gloss that keeps the energy.",
        "phong { diffuse: #663311, specular: 0.2, shininess: 40 }",
    ),
    material("mirror", MIRROR, "A perfect mirror.", "mirror { color: 0.9 }"),
    material("metal", METAL, "A rough conductor: `kind` or `color`.", "metal { kind: gold, roughness: 0.2 }")
        .choosing(&[one_of(&[&["kind"], &["color"]])]),
    material(
        "glass",
        GLASS,
        "A clear solid that refracts.",
        "glass { ior: 1.52, absorption: #f4fff6 per 10cm }",
    ),
    material(
        "emissive",
        EMISSIVE,
        "Shines to the side of the normal, outwards from a closed shape.",
        "emissive { power: 60W, color: 3200K }",
    )
    .choosing(&[at_most_one_of(&[&["radiance"], &["power"]])]),
    material(
        "whitted",
        WHITTED,
        "The sum of the terms of recursive ray tracing (Whitted 1980), for `method: classic` alone.",
        "whitted { diffuse: #663311, specular: 0.3, shininess: 20, reflection: 0.2 }",
    ),
    material(
        "mix",
        MIX,
        "Two materials by shares.",
        "mix { a: metal { kind: gold }, b: glass { ior: 1.5 }, amount: 0.3 }",
    ),
];
