//! Objects. Each has its own frame; `transform` leads out of it.

use super::{Area, Block, Choice, Field, Range, Type, field, one_of};

/// What every object takes.
pub(super) const COMMON: &[Field] = &[
    field("transform", Type::Transform, "Where it is, how large, and how turned."),
    field("material", Type::Material, "What it is made of; without it, grey."),
];

/// Sizes that `check` looks at.
const SIZE: Range = Range::above(0.0).physical();

const MISSING: Type = Type::Choice(&["error", "skip"]);

const SPHERE: &[Field] = &[
    field("center", Type::Point, "Its middle.").or_triple(0.0, 0.0, 0.0),
    field("radius", Type::Length, "From its middle to its surface.").required().within(SIZE),
];

const PLANE: &[Field] = &[
    field("x", Type::Length, "It is all points with this x; seen from larger x."),
    field("y", Type::Length, "It is all points with this y; seen from above.").like("0m"),
    field("z", Type::Length, "It is all points with this z; seen from larger z."),
    field("normal", Type::Vector, "The direction it faces."),
    field("offset", Type::Length, "Its distance from the origin along `normal`.").or(0.0),
];

const DISK: &[Field] = &[
    field("center", Type::Point, "Its middle.").or_triple(0.0, 0.0, 0.0),
    field("normal", Type::Vector, "The direction it faces.").or_triple(0.0, 1.0, 0.0),
    field("radius", Type::Length, "From its middle to its rim.").required().within(SIZE),
];

const QUAD: &[Field] = &[
    field("origin", Type::Point, "One corner.").required().like("(0m, 0m, 0m)"),
    field("edge_u", Type::Offset, "From that corner to a neighbour.").required(),
    field("edge_v", Type::Offset, "To its other neighbour; it faces edge_u × edge_v.")
        .required()
        .like("(0m, 1m, 0m)"),
];

const BOX: &[Field] = &[
    field("min", Type::Point, "The corner with the smallest coordinates.").like("(0m, 0m, 0m)"),
    field("max", Type::Point, "The corner with the largest.").like("(1m, 1m, 1m)"),
    field("center", Type::Point, "Its middle, instead of `min` and `max`.").like("(0m, 0m, 0m)"),
    field("size", Type::Offset, "Its edges along x, y and z, with `center`.").like("(1m, 1m, 1m)"),
];

const TRIANGLE: &[Field] = &[
    field("a", Type::Point, "A corner.").required().like("(0m, 0m, 0m)"),
    field("b", Type::Point, "The next, counter-clockwise seen from the front.")
        .required()
        .like("(1m, 0m, 0m)"),
    field("c", Type::Point, "The last.").required().like("(0m, 1m, 0m)"),
];

const CAPS: Field = field("caps", Type::Bool, "Whether flat ends close it.").or_bool(true);
const BASE: Field = field("base", Type::Point, "The middle of its bottom.").or_triple(0.0, 0.0, 0.0);
const TOP: Field = field("top", Type::Point, "The middle of its top.").like("(0m, 1m, 0m)");
const HEIGHT: Field =
    field("height", Type::Length, "How far up it reaches, instead of `top`.").within(SIZE).like("1m");

const CYLINDER: &[Field] = &[
    BASE,
    TOP,
    HEIGHT,
    field("radius", Type::Length, "From its axis to its side.").required().within(SIZE),
    CAPS,
];

const CONE: &[Field] = &[
    BASE,
    TOP,
    HEIGHT,
    field("radius", Type::Length, "The radius of its bottom.").required().within(SIZE),
    field("top_radius", Type::Length, "The radius of its top; 0 is a tip.")
        .or(0.0)
        .within(Range::at_least(0.0).physical()),
    CAPS,
];

const TORUS: &[Field] = &[
    field("center", Type::Point, "Its middle.").or_triple(0.0, 0.0, 0.0),
    field("normal", Type::Vector, "What it goes around.").or_triple(0.0, 1.0, 0.0),
    field("radius", Type::Length, "From its middle to the middle of its tube.").required().within(SIZE),
    field("tube", Type::Length, "The radius of the tube, less than `radius`.")
        .required()
        .within(SIZE)
        .like("5cm"),
];

/// How far along its axis a cylinder or cone reaches.
const REACH: &[Choice] = &[one_of(&[&["top"], &["height"]])];

const MESH: &[Field] = &[
    field("file", Type::Text, "An OBJ or glTF file, beside the scene.").required().like("\"teapot.obj\""),
    field("part", Type::Text, "Only this: what has a material in OBJ, a mesh in glTF, in its own frame.")
        .like("\"lid\""),
    field("scale", Type::Number, "A factor on its coordinates, which count as metres.").or(1.0).within(SIZE),
    field("smooth", Type::Bool, "Whether normals are interpolated; without it, as the file says."),
    field("missing", MISSING, "Whether a missing file is a mistake, or leaves the mesh out.")
        .or_word("error"),
];

const TOLERANCE: Field = field(
    "tolerance",
    Type::Length,
    "How far triangles may lie from it; without it, a thousandth of its size.",
)
.within(SIZE)
.like("0.1mm");

const REVOLVE: &[Field] = &[
    field("profile", Type::Curve, "Points (radius, height), turned about the y axis.").required(),
    field("method", Type::Choice(&["exact", "tessellated"]), "By its equation, or as triangles.")
        .or_word("exact"),
    TOLERANCE,
];

const EXTRUDE: &[Field] = &[
    field("outline", Type::Outline, "Its edge in the xy plane; the last point joins the first.").required(),
    field("holes", Type::Outlines, "What is cut out of it."),
    field("depth", Type::Length, "It reaches from z = 0 to this.").required().within(SIZE).like("10cm"),
    field(
        "tolerance",
        Type::Length,
        "How far its sides may lie from a curve; without it, a ten-thousandth of its size.",
    )
    .within(SIZE)
    .like("0.1mm"),
];

const SWEEP: &[Field] = &[
    field("path", Type::Path, "The middle of the tube, through points of space.").required(),
    field("radius", Type::Length, "From its middle to its side.").required().within(SIZE).like("2cm"),
    field("end_radius", Type::Length, "The radius at its end; without it, the same.")
        .within(Range::at_least(0.0).physical())
        .like("1cm"),
    field("caps", Type::Choice(&["flat", "round", "none"]), "What closes its ends.").or_word("flat"),
    field("closed", Type::Bool, "Whether its end is joined to its start.").or_bool(false),
    field("tolerance", Type::Length, "How far triangles may lie from it; without it, a 200th of its radius.")
        .within(SIZE)
        .like("0.1mm"),
];

const HEIGHTFIELD: &[Field] = &[
    field(
        "heights",
        Type::Heights,
        "Shares of the height: a picture, rows of numbers, or a function of two numbers from 0 to 1.",
    )
    .required(),
    field("size", Type::Offset, "What it spans from the origin: width, height of a 1, depth.")
        .required()
        .like("(4m, 1m, 4m)"),
    field("resolution", Type::Size, "How many points a function is asked for.").or_size(65, 65),
    field("smooth", Type::Bool, "Whether normals are interpolated.").or_bool(true),
];

const fn shape(kind: &'static str, own: &'static [Field], doc: &'static str, example: &'static str) -> Block {
    Block { kind, area: Area::Shape, doc, example, own, choices: &[] }
}

pub(super) const BLOCKS: &[Block] = &[
    shape("sphere", SPHERE, "A ball.", "sphere { center: (0m, 1m, 0m), radius: 30cm }"),
    shape("plane", PLANE, "An endless plane: one of `x`, `y`, `z`, or `normal`.", "plane { y: 0m }")
        .choosing(&[one_of(&[&["y"], &["x"], &["z"], &["normal", "offset"]])]),
    shape(
        "disk",
        DISK,
        "A flat round plate.",
        "disk { center: (0m, 1m, 0m), normal: (0, 1, 0), radius: 30cm }",
    ),
    shape(
        "quad",
        QUAD,
        "A parallelogram.",
        "quad { origin: (0m, 0m, 0m), edge_u: (1m, 0m, 0m), edge_v: (0m, 1m, 0m) }",
    ),
    shape(
        "box",
        BOX,
        "A box along the axes: `min` and `max`, or `center` and `size`.",
        "box { center: (0m, 50cm, 0m), size: (1m, 1m, 1m) }",
    )
    .choosing(&[one_of(&[&["min", "max"], &["center", "size"]])]),
    shape(
        "triangle",
        TRIANGLE,
        "One triangle.",
        "triangle { a: (0m, 0m, 0m), b: (1m, 0m, 0m), c: (0m, 1m, 0m) }",
    ),
    shape("cylinder", CYLINDER, "A round column.", "cylinder { height: 1m, radius: 30cm }").choosing(REACH),
    shape("cone", CONE, "A cone, pointed or cut off.", "cone { height: 1m, radius: 30cm }").choosing(REACH),
    shape("torus", TORUS, "A ring.", "torus { center: (0m, 1m, 0m), radius: 30cm, tube: 5cm }"),
    shape("mesh", MESH, "Triangles from a file.", "mesh { file: \"teapot.obj\", scale: 0.01 }"),
    shape(
        "revolve",
        REVOLVE,
        "A profile turned about the y axis.",
        "revolve { profile: polyline [(0cm, 0cm), (4cm, 0cm), (0cm, 9cm)] }",
    ),
    shape(
        "extrude",
        EXTRUDE,
        "An outline drawn out along z.",
        "extrude { outline: polygon [(0cm, 0cm), (4cm, 0cm), (0cm, 3cm)], depth: 1cm }",
    ),
    shape(
        "sweep",
        SWEEP,
        "A tube along a curve.",
        "sweep { path: bspline [(0m, 0m, 0m), (1m, 0m, 0m), (1m, 1m, 0m), (2m, 1m, 1m), (2m, 2m, 1m)], radius: 5cm }",
    ),
    shape(
        "heightfield",
        HEIGHTFIELD,
        "Heights over a grid, such as a landscape.",
        "heightfield { heights: [[0, 0, 0], [0, 1, 0], [0, 0, 0]], size: (2m, 50cm, 2m) }",
    ),
    shape("group", &[], "Several items that move together.", "group { sphere { radius: 30cm } }"),
];
