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
    FALLOFF,
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

const FALLOFF: Field = field(
    "falloff",
    Type::Falloff,
    "How it fades with the distance d in metres: `none`, or (a, b, c) for 1 / (a + b·d + c·d²); for `method: classic` alone.",
)
.or_word("physical");

const SPOT: &[Field] = &[
    field("position", Type::Point, "Where it is.").required(),
    field("look_at", Type::Point, "What it shines at; this or `direction`.").like("(0m, 0m, 0m)"),
    field("direction", Type::Vector, "The way it shines, instead of `look_at`.").like("(0, -1, 0)"),
    field("angle", Type::Angle, "From one edge of its cone to the other.")
        .or(std::f64::consts::FRAC_PI_4)
        .within(Range::open(0.0, std::f64::consts::PI).physical()),
    field("blend", Type::Number, "The share of the cone's half-angle over which it fades at the edge.")
        .or(0.15)
        .within(Range::closed(0.0, 1.0).physical()),
    POWER,
    field("intensity", Type::Radiance, "W/sr in the middle, times `color`, instead of `power`."),
    COLOR,
    FALLOFF,
];

const DISK: &[Field] = &[
    field("center", Type::Point, "Its middle.").required().like("(0m, 3m, 0m)"),
    field("normal", Type::Vector, "The way it faces.").or_triple(0.0, -1.0, 0.0),
    field("radius", Type::Length, "From its middle to its rim.")
        .required()
        .within(Range::above(0.0).physical()),
    POWER,
    RADIANCE,
    COLOR,
    field("two_sided", Type::Bool, "Whether it shines to both sides.").or_bool(false),
];

const MESH: &[Field] = &[
    field("object", Type::Object, "What shines: any object, in place of its own material.")
        .required()
        .like("mesh { file: \"teapot.obj\" }"),
    field("power", Type::Power, "All the light that each shape of it sends out.")
        .within(Range::above(0.0).physical()),
    RADIANCE,
    COLOR,
];

const SUN_SKY: &[Field] = &[
    field("elevation", Type::Angle, "How high the sun stands, with `azimuth`.")
        .within(Range::open(0.0, std::f64::consts::PI).physical()),
    field("azimuth", Type::Angle, "Where it stands: from the north (−z) by the east (+x).").or(0.0),
    field("direction", Type::Vector, "The way to the sun, instead of its angles.").like("(1, 2, 0)"),
    field("latitude", Type::Angle, "The place, north counted positive, instead of the angles.").like("48deg"),
    field("longitude", Type::Angle, "The place, east counted positive.").or(0.0).like("11deg"),
    field("day", Type::Int, "The day of the year.").or(172.0).within(Range::closed(1.0, 366.0)).like("172"),
    field("hour", Type::Number, "The time by the clock, in hours.")
        .or(12.0)
        .within(Range::closed(0.0, 24.0))
        .like("15.5"),
    field("zone", Type::Number, "How many hours the clock is ahead of UTC.")
        .or(0.0)
        .within(Range::closed(-14.0, 14.0))
        .like("1"),
    field("turbidity", Type::Number, "Haze: 2 is a clear day, 10 a hazy one.").or(3.0).like("3"),
    field("ground", Type::Color, "The albedo of the ground.").or(0.2),
    field("sun", Type::Bool, "Whether the sun itself shines.").or_bool(true),
    field("sun_size", Type::Angle, "The angle from rim to rim of the sun; its light stays the same.")
        .or(0.533 * std::f64::consts::PI / 180.0)
        .like("0.533deg"),
    field("scale", Type::Number, "A factor on all of it.").or(1.0).within(Range::above(0.0).physical()),
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
        "light spot",
        SPOT,
        "Shines from a point into a cone.",
        "light spot { position: (0m, 3m, 0m), look_at: (0m, 0m, 0m), angle: 40deg, power: 60W }",
    )
    .choosing(&[one_of(&[&["power"], &["intensity"]]), one_of(&[&["look_at"], &["direction"]])]),
    light(
        "light disk",
        DISK,
        "A glowing round plate.",
        "light disk { center: (0m, 3m, 0m), radius: 20cm, power: 60W }",
    )
    .choosing(BRIGHTNESS),
    light(
        "light mesh",
        MESH,
        "An object that glows, whatever its shape.",
        "light mesh { object: torus { radius: 30cm, tube: 2cm }, power: 60W }",
    )
    .choosing(BRIGHTNESS),
    light(
        "light sun_sky",
        SUN_SKY,
        "Sun and sky of a clear day (Preetham et al. 1999): by angles, by a direction, or by place and time.",
        "light sun_sky { elevation: 40deg, azimuth: 120deg, turbidity: 3 }",
    )
    .choosing(&[one_of(&[
        &["elevation", "azimuth"],
        &["direction"],
        &["latitude", "longitude", "day", "hour", "zone"],
    ])]),
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
