//! What shines. `power` is luminance-weighted: 1 W is 683 lm.

use super::{Area, Block, Choice, Field, Range, Type, field, one_of};

const COLOR: Field = field("color", Type::LightColor, "The colour of the light.").or(1.0);
const POWER: Field =
    field("power", Type::Power, "All the light it sends out.").within(Range::above(0.0).physical());
const RADIANCE: Field = field("radiance", Type::Radiance, "W/m²/sr, times `color`, instead of `power`.");

const POINT: &[Field] = &[
    field("position", Type::Point, "Where it is.").required(),
    POWER,
    field("intensity", Type::Radiance, "W/sr, times `color`, instead of `power`."),
    COLOR,
    field(
        "falloff",
        Type::Falloff,
        "How it fades with the distance d in metres: `none`, or (a, b, c) for 1 / (a + b·d + c·d²); for `method: classic` alone.",
    )
    .or_word("physical"),
];

const SPHERE: &[Field] = &[
    field("center", Type::Point, "Its middle.").required(),
    field("radius", Type::Length, "From its middle to its surface.")
        .required()
        .within(Range::above(0.0).physical())
        .like("5cm"),
    POWER,
    RADIANCE,
    COLOR,
];

const RECT: &[Field] = &[
    field("origin", Type::Point, "One corner.").required(),
    field("edge_u", Type::Offset, "From that corner to a neighbour.").required(),
    field("edge_v", Type::Offset, "To its other neighbour; it shines to edge_u × edge_v.")
        .required()
        .like("(0m, 0m, 1m)"),
    POWER,
    RADIANCE,
    COLOR,
    field("two_sided", Type::Bool, "Whether it shines to both sides.").or_bool(false),
];

const DIRECTIONAL: &[Field] = &[
    field("direction", Type::Vector, "The way the light travels.").required().like("(0, -1, 0)"),
    field("irradiance", Type::Number, "W/m² on a surface that faces it.")
        .or(1.0)
        .within(Range::above(0.0).physical()),
    COLOR,
];

const ENVIRONMENT: &[Field] = &[
    field("radiance", Type::SkyInput, "W/m²/sr: a colour, or an equirectangular picture.").or(1.0),
    field("scale", Type::Number, "A factor on it.").or(1.0).within(Range::at_least(0.0).physical()),
    field("rotation", Type::Angle, "Turn about the y axis.").or(0.0),
];

/// How a light with a surface says how bright it is.
const BRIGHTNESS: &[Choice] = &[one_of(&[&["power"], &["radiance"]])];

const fn light(kind: &'static str, own: &'static [Field], doc: &'static str, example: &'static str) -> Block {
    Block { kind, area: Area::Light, doc, example, own, choices: &[] }
}

pub(super) const BLOCKS: &[Block] = &[
    light(
        "light point",
        POINT,
        "Shines from a point, all around.",
        "light point { position: (0m, 3m, 0m), power: 60W }",
    )
    .choosing(&[one_of(&[&["power"], &["intensity"]])]),
    light(
        "light sphere",
        SPHERE,
        "A glowing ball.",
        "light sphere { center: (0m, 3m, 0m), radius: 5cm, power: 60W, color: 3200K }",
    )
    .choosing(BRIGHTNESS),
    light(
        "light rect",
        RECT,
        "A glowing parallelogram.",
        "light rect { origin: (0m, 3m, 0m), edge_u: (1m, 0m, 0m), edge_v: (0m, 0m, 1m), power: 60W }",
    )
    .choosing(BRIGHTNESS),
    light(
        "light directional",
        DIRECTIONAL,
        "Shines from infinitely far away, as the sun nearly does.",
        "light directional { direction: (0, -1, 0), irradiance: 3 }",
    ),
    light(
        "environment",
        ENVIRONMENT,
        "The light that comes from everywhere.",
        "environment { radiance: image(\"sky.hdr\"), scale: 2 }",
    ),
];
