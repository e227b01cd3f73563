//! The camera, its lens and its film.

use super::{Area, Block, Field, Range, Type, at_most_one_of, field, one_of};

/// Full angles of view; `check` looks at them.
const VIEW: Range = Range::open(0.0, std::f64::consts::PI).physical();
const SIZE: Range = Range::above(0.0).physical();

const CAMERA: &[Field] = &[
    field("position", Type::Point, "Where it is.").required().like("(0m, 1.6m, 4m)"),
    field("look_at", Type::Point, "What is in the middle of the picture; this or `direction`.")
        .like("(0m, 0m, 0m)"),
    field("direction", Type::Vector, "The way it looks, instead of `look_at`.").like("(0, 0, -1)"),
    field("up", Type::Vector, "What is up.").or_triple(0.0, 1.0, 0.0),
    field("fov", Type::Angle, "From the bottom to the top of the picture; without a focal length, 45deg.")
        .within(VIEW)
        .like("45deg"),
    field("fov_x", Type::Angle, "From its left to its right, instead of `fov`.").within(VIEW).like("60deg"),
    field("lens", Type::Lens, "How light gets in.").or_word("pinhole"),
    field("film", Type::Block("film"), "What it falls on.").like("{ size: 1024 x 768, tone: agx }"),
];

const PINHOLE: &[Field] =
    &[field("focal_length", Type::Length, "Gives the field of view, with the film's sensor.")
        .within(SIZE)
        .like("50mm")];

const THIN: &[Field] = &[
    field("focal_length", Type::Length, "Gives the field of view, with the film's sensor.")
        .within(SIZE)
        .like("50mm"),
    field("aperture", Type::FNumber, "The focal length by the width of the opening.")
        .within(SIZE)
        .beside("focal_length"),
    field("radius", Type::Length, "Of the opening, instead of `aperture`.")
        .within(Range::at_least(0.0).physical())
        .like("5mm"),
    field("focus", Type::Focus, "What is sharp; without it, what `look_at` names."),
    field("blades", Type::Int, "Of the iris; 0 is round.").or(0.0).within(Range::at_least(0.0)).like("7"),
    field("rotation", Type::Angle, "Turn of the iris.").or(0.0),
];

const FILM: &[Field] = &[
    field("size", Type::Size, "Pixels, width by height.").or_size(640, 480),
    field("pixel_aspect", Type::Number, "The width of a pixel by its height.")
        .or(1.0)
        .within(SIZE)
        .like("1.2"),
    field("filter", Type::Filter, "How pixels share a sample.").or_word("tent(1px)"),
    field("sensor", Type::Length, "Its width.").or(0.036).within(SIZE).like("36mm"),
    field("exposure", Type::Exposure, "Steps brighter, or `auto` for a log-average of 0.18.").or(0.0),
    field("tone", Type::Choice(&["srgb", "linear", "reinhard", "agx"]), "From radiance to display values.")
        .or_word("srgb"),
];

const fn part(kind: &'static str, own: &'static [Field], doc: &'static str, example: &'static str) -> Block {
    Block { kind, area: Area::Camera, doc, example, own, choices: &[] }
}

pub(super) const BLOCKS: &[Block] = &[
    Block {
        kind: "camera",
        area: Area::Item,
        doc: "Takes the picture.",
        example: "camera { position: (0m, 1.6m, 4m), look_at: (0m, 0m, 0m), fov: 45deg }",
        own: CAMERA,
        choices: &[one_of(&[&["look_at"], &["direction"]]), at_most_one_of(&[&["fov"], &["fov_x"]])],
    },
    part("pinhole", PINHOLE, "A lens that keeps everything sharp.", "pinhole { focal_length: 50mm }"),
    part(
        "thin",
        THIN,
        "A lens that is sharp at one distance.",
        "thin { focal_length: 50mm, aperture: f/2.8, focus: 2m, blades: 7 }",
    )
    .choosing(&[one_of(&[&["aperture"], &["radius"]])]),
    part("film", FILM, "What light falls on.", "film: { size: 1024 x 768, tone: agx }"),
];
