//! What objects are made of.

use super::{Area, Block, Field, Range, Type, at_most_one_of, field, one_of};

/// Metals whose reflectance is known by name.
pub(super) const METALS: Type =
    Type::Choice(&["silver", "gold", "copper", "aluminium", "iron", "chromium", "nickel", "titanium"]);

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
    field("edge", Type::ColorInput, "The tint just before grazing, at 82°, where metals often dip.")
        .or(1.0)
        .within(SHARE),
    field("roughness", Type::NumberInput, "0 is a mirror, 1 is matt; alpha is its square.")
        .or(0.2)
        .within(SHARE),
];

const GLASS: &[Field] = &[
    field("ior", Type::Number, "Index of refraction.")
        .or(1.5)
        .within(Range::at_least(1.0).physical())
        .like("1.52"),
    field("roughness", Type::NumberInput, "0 is polished, 1 is frosted; alpha is its square.")
        .or(0.0)
        .within(SHARE),
    field("tint", Type::Color, "A factor at every crossing of the surface.").or(1.0).within(SHARE),
    field("absorption", Type::Absorption, "What is left of white light after that way inside."),
    field(
        "abbe",
        Type::Number,
        "Its Abbe number: how little it spreads colours. Crown glass has 60, flint 30.",
    )
    .within(Range::closed(5.0, 1000.0))
    .like("60"),
    field("thin", Type::Bool, "Whether it is a pane: no inside, and nothing shifts behind it.")
        .or_bool(false),
    field("priority", Type::Int, "Where solids overlap, the highest fills the space; of equals, the inner.")
        .or(0.0)
        .within(Range::closed(-1000.0, 1000.0)),
];

const PLASTIC: &[Field] = &[
    field("color", Type::ColorInput, "Albedo of the body.").or(0.5).within(SHARE),
    field("ior", Type::Number, "Index of refraction of its clear coat.")
        .or(1.5)
        .within(Range::closed(1.0, 4.0).physical())
        .like("1.46"),
    field("roughness", Type::NumberInput, "Of the coat: 0 is polished; alpha is its square.")
        .or(0.1)
        .within(SHARE),
];

const LAYER: &[Field] = &[
    field("base", Type::Material, "What lies under the coat.").required().like("metal { kind: copper }"),
    field("ior", Type::Number, "Index of refraction of the coat.")
        .or(1.5)
        .within(Range::closed(1.0, 4.0).physical())
        .like("1.46"),
    field("roughness", Type::NumberInput, "Of the coat: 0 is polished; alpha is its square.")
        .or(0.0)
        .within(SHARE),
    field("cover", Type::NumberInput, "The share of the surface that is coated.").or(1.0).within(SHARE),
];

const PRINCIPLED: &[Field] = &[
    field("color", Type::ColorInput, "Albedo of what is matt, reflectance of metal, tint of what is clear.")
        .or(0.8)
        .within(SHARE),
    field("metallic", Type::NumberInput, "The share that is metal.").or(0.0).within(SHARE),
    field("roughness", Type::NumberInput, "0 is polished, 1 is matt; alpha is its square.")
        .or(0.5)
        .within(SHARE),
    field("transmission", Type::NumberInput, "The share of what is not metal that is clear.")
        .or(0.0)
        .within(SHARE),
    field("ior", Type::Number, "Index of refraction of what is not metal.")
        .or(1.5)
        .within(Range::closed(1.0, 4.0).physical())
        .like("1.46"),
    field("clearcoat", Type::NumberInput, "The share of the surface under a clear coat.")
        .or(0.0)
        .within(SHARE),
    field("clearcoat_roughness", Type::NumberInput, "Of that coat.").or(0.0).within(SHARE),
    field(
        "emission",
        Type::RadianceInput,
        "What it shines by itself, in W/m²/sr; by a picture: `image(..) * 5`.",
    )
    .or(0.0),
];

const MASK: &[Field] = &[
    field("material", Type::Material, "What is there between the holes.")
        .required()
        .like("diffuse { color: #336622 }"),
    field("opacity", Type::NumberInput, "The share of the surface that is there: 0 is a hole.")
        .required()
        .within(SHARE)
        .like("checker { cells: 8 }"),
    field("cutoff", Type::Number, "From this opacity on all is there, and nothing below.")
        .within(Range::closed(0.0, 1.0)),
];

const TWO_SIDED: &[Field] = &[
    field("front", Type::Material, "On the side of the normal, outwards from a closed shape.")
        .required()
        .like("diffuse { color: #ff8800 }"),
    field("back", Type::Material, "On the other side.").required().like("metal { kind: gold }"),
];

const NORMAL_MAP: &[Field] = &[
    field("material", Type::Material, "What the surface is made of.")
        .required()
        .like("plastic { color: 0.4 }"),
    field("map", Type::Texture, "Normals: red along u, green along v, blue outwards, 0.5 is 0.")
        .required()
        .like("image(\"wood.png\")"),
    field("strength", Type::Number, "A factor on how far normals lean.")
        .or(1.0)
        .within(Range::closed(0.0, 100.0)),
];

const BUMP: &[Field] = &[
    field("material", Type::Material, "What the surface is made of.")
        .required()
        .like("plastic { color: 0.4 }"),
    field("height", Type::Texture, "Heights: where it is brighter it is higher.")
        .required()
        .like("noise { size: 2cm }"),
    field("depth", Type::Length, "How much higher white is than black.").required().like("2mm"),
];

const EMISSIVE: &[Field] = &[
    field(
        "radiance",
        Type::RadianceInput,
        "W/m²/sr, times `color`; 1 if neither this nor `power` is said; by a picture: `image(..) * 5`.",
    ),
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
        .choosing(&[one_of(&[&["kind"], &["color", "edge"]])]),
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
        "plastic",
        PLASTIC,
        "A matt body under a clear coat: paint, ceramics, plastic.",
        "plastic { color: #aa2211, roughness: 0.2 }",
    ),
    material(
        "layer",
        LAYER,
        "A clear coat over another material.",
        "layer { base: metal { kind: copper, roughness: 0.4 }, roughness: 0.05 }",
    ),
    material(
        "principled",
        PRINCIPLED,
        "The metallic-roughness model of glTF, with transmission and a clear coat.",
        "principled { color: #cc3311, metallic: 0, roughness: 0.3, clearcoat: 1 }",
    ),
    material(
        "mask",
        MASK,
        "A material with holes, for light and shadow too.",
        "mask { material: diffuse { color: #336622 }, opacity: checker { cells: 8 } }",
    ),
    material(
        "two_sided",
        TWO_SIDED,
        "Another material on each side.",
        "two_sided { front: diffuse { color: #ff8800 }, back: diffuse { color: white } }",
    ),
    material(
        "normal_map",
        NORMAL_MAP,
        "A material on a surface whose normals a picture bends.",
        "normal_map { material: plastic { color: 0.4 }, map: image(\"wood.png\") }",
    ),
    material(
        "bump",
        BUMP,
        "A material on a surface whose normals follow a picture of heights.",
        "bump { material: plastic { color: 0.4 }, height: noise { size: 2cm }, depth: 2mm }",
    ),
    material(
        "mix",
        MIX,
        "Two materials by shares.",
        "mix { a: metal { kind: gold }, b: glass { ior: 1.5 }, amount: 0.3 }",
    ),
];
