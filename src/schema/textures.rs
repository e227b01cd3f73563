//! What varies over a surface.

use super::{Area, Block, Field, Range, Type, at_most_one_of, field};

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
    field("uv_offset", Type::Pair, "What is added to it then.").or_pair(0.0, 0.0).like("(0.5, 0)"),
    field("projection", Type::Projection, "Where the texture point comes from.").or_word("uv"),
    field("filter", Type::Choice(&["linear", "nearest"]), "Whether neighbouring pixels are blended.")
        .or_word("linear"),
];

const CHECKER: &[Field] = &[
    field("a", Type::Color, "The colour of the cell at the origin.").or(1.0).like("white"),
    field("b", Type::Color, "The other.").or(0.0).like("black"),
    field("cells", Type::Cells, "How many along u and v.").or(8.0).within(Range::above(0.0).physical()),
    field("size", Type::Length, "The edge of solid cells in object space, instead of `cells`.")
        .within(Range::above(0.0).physical())
        .like("10cm"),
];

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
];
