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
    field(
        "shutter",
        Type::Number,
        "The share of a frame for which it is open, from the frame's beginning on: what `moving` moves is blurred.",
    )
    .or(0.0)
    .within(Range::closed(0.0, 1.0))
    .like("50%"),
    field("transform", Type::Transform, "Moves and turns the camera; with `moving`, while the shutter is open.")
        .like("moving(translate(0m, 0m, 0m), translate(10cm, 0m, 0m))"),
];

const FOCAL_LENGTH: Field =
    field("focal_length", Type::Length, "Gives the field of view, with the film's sensor.")
        .within(SIZE)
        .like("50mm");
const FOCUS: Field = field("focus", Type::Focus, "What is sharp; without it, what `look_at` names.");
const SHIFT: Field = field(
    "shift",
    Type::Pair,
    "How far the picture moves to the right and upwards, in shares of its width and height.",
)
.or_pair(0.0, 0.0)
.like("(0, 0.25)");

const PINHOLE: &[Field] = &[FOCAL_LENGTH, SHIFT];

const THIN: &[Field] = &[
    FOCAL_LENGTH,
    field("aperture", Type::FNumber, "The focal length by the width of the opening.")
        .within(SIZE)
        .beside("focal_length"),
    field("radius", Type::Length, "Of the opening, instead of `aperture`.")
        .within(Range::at_least(0.0).physical())
        .like("5mm"),
    FOCUS,
    field("blades", Type::Int, "Of the iris; 0 is round.").or(0.0).within(Range::at_least(0.0)).like("7"),
    field("rotation", Type::Angle, "Turn of the iris.").or(0.0),
    field("anamorphic", Type::Number, "How many times as high as wide the opening is.")
        .or(1.0)
        .within(SIZE)
        .like("2"),
    field("cat_eye", Type::Number, "How far the barrel cuts the opening in the corners, in its radii.")
        .or(0.0)
        .within(Range::closed(0.0, 2.0).physical())
        .like("0.5"),
    SHIFT,
    field("tilt", Type::Angle, "How far the lens is turned upwards, and with it what is sharp.")
        .or(0.0)
        .within(TURN)
        .like("-5deg"),
    field("swing", Type::Angle, "How far the lens is turned to the right.").or(0.0).within(TURN).like("5deg"),
];

/// A lens turned farther sees the film edge-on.
const TURN: Range = Range::open(-std::f64::consts::FRAC_PI_4, std::f64::consts::FRAC_PI_4).physical();

const ORTHOGRAPHIC: &[Field] = &[
    field("height", Type::Length, "How much is seen from bottom to top.").within(SIZE).like("2m"),
    field("width", Type::Length, "How much is seen from left to right, instead of `height`.")
        .within(SIZE)
        .like("3m"),
];

const PANORAMA: &[Field] = &[
    field("width", Type::Angle, "From left to right.")
        .or(std::f64::consts::TAU)
        .within(Range::above(0.0).physical()),
    field("height", Type::Angle, "From bottom to top.")
        .or(std::f64::consts::PI)
        .within(Range::above(0.0).physical()),
];

const FISHEYE: &[Field] = &[
    field("angle", Type::Angle, "From rim to rim.")
        .or(std::f64::consts::PI)
        .within(Range::above(0.0).physical()),
    field(
        "mapping",
        Type::Choice(&["equidistant", "equisolid", "stereographic", "orthographic"]),
        "How the angle from the axis becomes a distance from the middle.",
    )
    .or_word("equidistant"),
    field(
        "frame",
        Type::Choice(&["circle", "full"]),
        "Whether the round picture lies within the film, or its rim meets the corners.",
    )
    .or_word("circle"),
];

const PRESCRIPTION: &[Field] = &[
    field("file", Type::Text, "A table of the lens's surfaces, beside the scene.")
        .required()
        .like("\"achromat.dat\""),
    field("aperture", Type::FNumber, "The focal length by the width of the pupil; without it, wide open.")
        .within(SIZE)
        .like("f/4"),
    FOCUS,
];

const PHOTO: &[Field] = &[
    field("f_stop", Type::FNumber, "The f-number.").within(Range::above(0.0)).like("f/8"),
    field("time", Type::Time, "How long the shutter is open.")
        .within(Range::above(0.0))
        .beside("f_stop")
        .like("8ms"),
    field("iso", Type::Number, "The sensitivity of the film.")
        .or(100.0)
        .within(Range::above(0.0))
        .like("400"),
    field("ev", Type::Number, "The exposure value at ISO 100, instead of `f_stop` and `time`.").like("12"),
];

const CROP: &[Field] = &[
    field("left", Type::Number, "Where it begins, in shares of the picture's width.")
        .or(0.0)
        .within(UNIT)
        .like("0.25"),
    field("right", Type::Number, "Where it ends.").or(1.0).within(UNIT).like("0.75"),
    field("top", Type::Number, "Where it begins, in shares of the height from the top.")
        .or(0.0)
        .within(UNIT)
        .like("0.25"),
    field("bottom", Type::Number, "Where it ends.").or(1.0).within(UNIT).like("0.75"),
];
const UNIT: Range = Range::closed(0.0, 1.0);

const FILM: &[Field] = &[
    field("size", Type::Size, "Pixels, width by height.").or_size(640, 480),
    field("crop", Type::Block("crop"), "The part that is rendered.").like("{ left: 0.25, right: 0.75 }"),
    field("pixel_aspect", Type::Number, "The width of a pixel by its height.")
        .or(1.0)
        .within(SIZE)
        .like("1.2"),
    field("filter", Type::Filter, "How pixels share a sample.").or_word("tent(1px)"),
    field("sensor", Type::Length, "Its width.").or(0.036).within(SIZE).like("36mm"),
    field("exposure", Type::Exposure, "Steps brighter, `auto` for a log-average of 0.18, or a `photo`.")
        .or(0.0),
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
    part(
        "orthographic",
        ORTHOGRAPHIC,
        "Parallel rays: what is far is as large as what is near.",
        "orthographic { height: 2m }",
    )
    .choosing(&[one_of(&[&["height"], &["width"]])]),
    part("panorama", PANORAMA, "All around: longitude to the right, latitude upwards.", "panorama {}"),
    part("fisheye", FISHEYE, "A round picture of a wide view.", "fisheye { angle: 180deg }"),
    part(
        "prescription",
        PRESCRIPTION,
        "A real lens, traced through its surfaces (Kolb et al. 1995); docs/lenses.md tells what the file looks like.",
        "prescription { file: \"achromat.dat\", aperture: f/4, focus: 2m }",
    ),
    part(
        "photo",
        PHOTO,
        "The exposure of a photograph, where light is in real units: a film of ISO 100 that saturates at 1.2 · 2^EV cd/m².",
        "photo { f_stop: f/8, time: 8ms, iso: 100 }",
    )
    .choosing(&[one_of(&[&["f_stop", "time", "iso"], &["ev"]])]),
    part("crop", CROP, "A part of the picture.", "crop: { left: 0.25, right: 0.75 }"),
    part("film", FILM, "What light falls on.", "film: { size: 1024 x 768, tone: agx }"),
];
