//! How the picture is computed.

use super::{Area, Block, Field, Range, Type, field};

const RENDER: &[Field] = &[
    field(
        "method",
        Type::Method,
        "Path tracing, photon mapping, both in one (`hybrid`), whichever suits, or recursive ray tracing.",
    )
    .or_word("auto"),
    field("stop", Type::Stop, "When it is done: `samples`, `passes`, `time` or `error`, joined by `or`."),
    field("depth", Type::Int, "The most vertices of a path.")
        .or(64.0)
        .within(Range::closed(1.0, 65_535.0))
        .like("64"),
    field("seed", Type::Int, "Chooses the random numbers.")
        .or(0.0)
        .within(Range::closed(0.0, 9.0e15))
        .like("7"),
    field("photons", Type::Block("photons"), "For `ppm` and `hybrid`; without it, chosen by the compiler.")
        .like("{ count: 200000, k: 60, radius: 5cm }"),
];

const PHOTONS: &[Field] = &[
    field("count", Type::Int, "Emitted a pass.").within(Range::closed(1.0, 1e9).physical()).like("200000"),
    field("k", Type::Int, "The most photons of an estimate.")
        .within(Range::at_least(1.0).physical())
        .like("60"),
    field("radius", Type::Length, "The largest radius of an estimate in the first pass.")
        .within(Range::above(0.0).physical())
        .like("5cm"),
    field("shrink", Type::Number, "How fast the radius shrinks: 1 is never.")
        .or(2.0 / 3.0)
        .within(Range::open(0.0, 1.0).physical())
        .like("0.67"),
];

const CLASSIC: &[Field] = &[
    field("shading", Type::Choice(&["phong", "blinn"]), "The formula of highlights.").or_word("phong"),
    field("shadows", Type::Bool, "Whether things keep the light from each other.").or_bool(true),
    field("ambient", Type::Color, "Light on everything; times its diffuse colour.").or(0.0),
    field("backs", Type::Choice(&["lit", "dark"]), "How surfaces look from behind.").or_word("lit"),
    field(
        "pixel",
        Type::Choice(&["filter", "center", "corner"]),
        "Where rays go: by the film's filter, or all through one point of a pixel.",
    )
    .or_word("filter"),
    field("quantise", Type::Choice(&["round", "floor"]), "How display values become whole numbers.")
        .or_word("round"),
];

pub(super) const BLOCKS: &[Block] = &[
    Block {
        kind: "render",
        area: Area::Item,
        doc: "How the picture is computed; all of it may be left to the compiler.",
        example: "render { method: auto, stop: error(1%) or time(5min) }",
        own: RENDER,
        choices: &[],
    },
    Block {
        kind: "classic",
        area: Area::Render,
        doc: "Recursive ray tracing, as courses teach it: no light between matt surfaces, no law of energy.",
        example: "classic { shading: blinn, ambient: 0.1 }",
        own: CLASSIC,
        choices: &[],
    },
    Block {
        kind: "photons",
        area: Area::Render,
        doc: "Settings of photons. `hybrid` sends few, straight at glass and mirrors, and gathers them within about a pixel.",
        example: "photons: { count: 200000, k: 60, radius: 5cm }",
        own: PHOTONS,
        choices: &[],
    },
];
