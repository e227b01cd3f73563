//! What varies over a surface.

use super::{Area, Block, Choice, Field, Range, Type, at_most_one_of, field};

const IMAGE: &[Field] = &[
    field("file", Type::Text, "A PNG, JPEG, BMP, TGA, HDR, EXR or PPM file, beside the scene.").required(),
    field("wrap", Type::Choice(&["repeat", "clamp", "mirror", "border"]), "What lies beyond its edges.")
        .or_word("repeat"),
    field("border", Type::Color, "The colour beyond its edges, for `wrap: border`.").or(0.0),
    field(
        "missing",
        Type::Choice(&["error", "skip"]),
        "Whether a missing file is a mistake, or leaves it out.",
    )
    .or_word("error"),
    field("uv_scale", Type::Pair, "A factor on the texture point.").or_pair(1.0, 1.0).like("(2, 2)"),
    field("uv_rotation", Type::Angle, "The angle it is turned by then.").or(0.0).like("90deg"),
    field("uv_offset", Type::Pair, "What is added to it then.").or_pair(0.0, 0.0).like("(0.5, 0)"),
    field("projection", Type::Projection, "Where the texture point comes from.").or_word("uv"),
    field("filter", Type::Choice(&["linear", "nearest"]), "Whether neighbouring pixels are blended.")
        .or_word("linear"),
    field(
        "space",
        Type::Choice(&["auto", "srgb", "linear"]),
        "What its numbers are: `auto` is display values for a colour, plain numbers for anything else.",
    )
    .or_word("auto"),
    field(
        "channel",
        Type::Choice(&["rgb", "red", "green", "blue", "alpha"]),
        "All of it, or one of its channels as a grey.",
    )
    .or_word("rgb"),
];

const CHECKER: &[Field] = &[
    field("a", Type::ColorInput, "The colour of the cell at the origin.").or(1.0).like("white"),
    field("b", Type::ColorInput, "The other.").or(0.0).like("black"),
    field("cells", Type::Cells, "How many along u and v.").or(8.0).within(Range::above(0.0).physical()),
    field("size", Type::Length, "The edge of solid cells in object space, instead of `cells`.")
        .within(Range::above(0.0).physical())
        .like("10cm"),
];

const A: Field = field("a", Type::ColorInput, "The colour where it begins.").or(0.0).like("black");
const B: Field = field("b", Type::ColorInput, "The colour where it ends.").or(1.0).like("white");

/// A size in space of what a block of stuff is cut from.
const fn size(doc: &'static str) -> Field {
    field("size", Type::Length, doc).required().within(Range::above(0.0).physical()).like("10cm")
}

const GRADIENT: &[Field] = &[
    A,
    B,
    field("start", Type::Point, "Where it begins, in object space; from v = 0 to v = 1 without.")
        .beside("end"),
    field("end", Type::Point, "Where it ends.").beside("start").like("(0m, 3m, 0m)"),
];

const NOISE: &[Field] = &[
    A,
    B,
    size("The distance of its largest features."),
    field("octaves", Type::Int, "How many scales of features, each half as large.")
        .or(4.0)
        .within(Range::closed(1.0, 16.0)),
];

const MARBLE: &[Field] = &[
    A,
    B,
    size("The distance of its veins, which run across x."),
    field("turbulence", Type::Number, "How far they are folded, in veins.")
        .or(2.0)
        .within(Range::closed(0.0, 100.0)),
];

const WOOD: &[Field] = &[
    field("a", Type::ColorInput, "The colour of spring wood.").or(0.6).like("#c99a5b"),
    field("b", Type::ColorInput, "The colour of summer wood.").or(0.2).like("#7a4a20"),
    size("The width of its rings, around the y axis of the object."),
    field("turbulence", Type::Number, "How far they are bent, in rings.")
        .or(0.5)
        .within(Range::closed(0.0, 100.0)),
];

const BRICK: &[Field] = &[
    field("a", Type::ColorInput, "The colour of the bricks.").or(0.3).like("#8c3b2a"),
    field("b", Type::ColorInput, "The colour of the mortar.").or(0.7).like("#b8b0a4"),
    field("cells", Type::Cells, "How many along u and v.")
        .or(8.0)
        .within(Range::above(0.0).physical())
        .like("(4, 8)"),
    field("mortar", Type::Number, "The width of a joint, as a share of a brick's height.")
        .or(0.12)
        .within(Range::closed(0.0, 1.0)),
    field(
        "aspect",
        Type::Number,
        "How wide a brick looks for its height, so that joints are as wide across.",
    )
    .or(2.0)
    .within(Range::closed(0.01, 100.0)),
];

const BLEND: &[Field] = &[
    A,
    B,
    field("amount", Type::NumberInput, "The share of `b`.")
        .or(0.5)
        .within(Range::closed(0.0, 1.0).physical()),
];

const SPHERICAL: &[Field] =
    &[field("center", Type::Point, "Where it is thrown from.").or_triple(0.0, 0.0, 0.0)];

const CUBIC: &[Field] = &[
    field("center", Type::Point, "The centre of the box.").or_triple(0.0, 0.0, 0.0),
    field("size", Type::Offset, "Its edges; each side shows the whole picture.")
        .or_triple(1.0, 1.0, 1.0)
        .like("(1m, 2m, 1m)"),
];

const fn texture(
    kind: &'static str,
    own: &'static [Field],
    doc: &'static str,
    example: &'static str,
    choices: &'static [Choice],
) -> Block {
    Block { kind, area: Area::Texture, doc, example, own, choices }
}

const PLANAR: &[Field] = &[
    field("origin", Type::Point, "Where the lower left corner of the picture lies.").or_triple(0.0, 0.0, 0.0),
    field("u", Type::Offset, "From its left to its right edge.").required().like("(1m, 0m, 0m)"),
    field("v", Type::Offset, "From its lower to its upper edge.").required().like("(0m, 0m, -1m)"),
];

pub(super) const BLOCKS: &[Block] = &[
    Block {
        kind: "image",
        area: Area::Texture,
        doc: "A picture; `image(\"wood.png\")` is short for one with only a file.",
        example: "image { file: \"wood.png\", wrap: mirror }",
        own: IMAGE,
        choices: &[],
    },
    Block {
        kind: "checker",
        area: Area::Texture,
        doc: "Two colours in turn: `cells` in uv, or `size` in space.",
        example: "checker { a: white, b: black, cells: 8 }",
        own: CHECKER,
        choices: &[at_most_one_of(&[&["cells"], &["size"]])],
    },
    Block {
        kind: "planar",
        area: Area::Texture,
        doc: "A projection that spans a picture between two vectors, in object space.",
        example: "planar { origin: (0m, 0m, 0m), u: (1m, 0m, 0m), v: (0m, 0m, -1m) }",
        own: PLANAR,
        choices: &[],
    },
    texture(
        "spherical",
        SPHERICAL,
        "A projection from a point outwards: u around y, v from pole to pole.",
        "spherical { center: (0m, 1m, 0m) }",
        &[],
    ),
    texture(
        "cubic",
        CUBIC,
        "A projection onto the six sides of a box, in object space.",
        "cubic { center: (0m, 0.5m, 0m), size: (1m, 1m, 1m) }",
        &[],
    ),
    texture(
        "gradient",
        GRADIENT,
        "One colour fading into another.",
        "gradient { a: #102040, b: #ffffff, start: (0m, 0m, 0m), end: (0m, 1m, 0m) }",
        &[],
    ),
    texture("noise", NOISE, "Clouds, cut from a block.", "noise { a: black, b: white, size: 10cm }", &[]),
    texture(
        "marble",
        MARBLE,
        "Veins, cut from a block.",
        "marble { a: #3a3a44, b: #f4f1ea, size: 10cm }",
        &[],
    ),
    texture(
        "wood",
        WOOD,
        "Rings of a tree, cut from a block.",
        "wood { a: #c99a5b, b: #7a4a20, size: 1cm }",
        &[],
    ),
    texture(
        "brick",
        BRICK,
        "Bricks in uv, rows of them shifted by half.",
        "brick { a: #8c3b2a, b: #b8b0a4, cells: (4, 8) }",
        &[],
    ),
    texture(
        "blend",
        BLEND,
        "Two textures or colours by shares.",
        "blend { a: #ff8800, b: image(\"wood.png\"), amount: noise { size: 10cm } }",
        &[],
    ),
];
