//! Every function of the language.

use super::Type;
use super::function::{Arg, Function, Takes, Times, Topic};

const fn of(name: &'static str, ty: Type) -> Arg {
    Arg { name, takes: Takes::Of(ty), times: Times::Once }
}

const fn any(name: &'static str, takes: Takes) -> Arg {
    Arg { name, takes, times: Times::Once }
}

const fn function(
    topic: Topic,
    name: &'static str,
    forms: &'static [&'static [Arg]],
    result: &'static str,
    doc: &'static str,
    example: &'static str,
) -> Function {
    Function { name, topic, forms, result, doc, method: None, domain: None, example }
}

impl Function {
    const fn computed(self, method: &'static str) -> Self {
        Self { method: Some(method), ..self }
    }

    const fn defined_for(self, domain: &'static str) -> Self {
        Self { domain: Some(domain), ..self }
    }
}

const X: &[&[Arg]] = &[&[of("x", Type::Number)]];
const ANY: &[&[Arg]] = &[&[any("x", Takes::Number)]];
const ANGLE: &[&[Arg]] = &[&[of("angle", Type::Angle)]];
const VECTOR: &[&[Arg]] = &[&[any("a", Takes::Tuple)]];
const VECTORS: &[&[Arg]] = &[&[any("a", Takes::Tuple), any("b", Takes::Tuple)]];
const MANY: &[&[Arg]] = &[&[Arg { name: "a", takes: Takes::Alike, times: Times::Often }]];
const RADIUS: &[&[Arg]] = &[&[of("radius", Type::Pixels)]];
const COUNT: &[&[Arg]] = &[&[of("count", Type::Int)]];
const POINTS: &[&[Arg]] = &[&[any("points", Takes::Points)]];
const BEZIER: &[&[Arg]] =
    &[&[any("points", Takes::Points)], &[of("degree", Type::Choice(&["all"])), any("points", Takes::Points)]];

use Topic::{Angles, Chance, Colors, Curves, Filters, Lists, Numbers, Stops, Textures, Transforms, Vectors};

pub(super) const FUNCTIONS: &[Function] = &[
    // ── Numbers ────────────────────────────────────────────────────────────────────────────────────────────────
    function(Numbers, "abs", ANY, "a number of the same unit", "A number without its sign.", "abs(-1m)"),
    function(Numbers, "min", MANY, "a number of the same unit", "The smallest of its arguments.", "min(1m, 2m)"),
    function(Numbers, "max", MANY, "a number of the same unit", "The largest of its arguments.", "max(1m, 2m)"),
    function(
        Numbers,
        "clamp",
        &[&[any("x", Takes::Alike), any("min", Takes::Alike), any("max", Takes::Alike)]],
        "a number of the same unit",
        "`x`, or the end of the range from `min` to `max` beyond which it lies.",
        "clamp(1.5, 0, 1)",
    )
    .defined_for("ranges whose `min` is not above their `max`"),
    function(
        Numbers,
        "lerp",
        &[&[any("a", Takes::Mixable), any("b", Takes::Mixable), of("t", Type::Number)]],
        "what `a` and `b` are",
        "On the straight way from `a` at t = 0 to `b` at t = 1; beyond them for other `t`.",
        "lerp(1m, 3m, 0.25)",
    )
    .computed("a + (b - a) t"),
    function(Numbers, "floor", X, "a whole number", "The next whole number downwards.", "floor(2.5)"),
    function(Numbers, "ceil", X, "a whole number", "The next whole number upwards.", "ceil(2.5)"),
    function(Numbers, "round", X, "a whole number", "The nearest whole number.", "round(2.5)")
        .computed("halves are rounded away from 0: round(2.5) is 3, round(-2.5) is -3"),
    function(
        Numbers,
        "sqrt",
        ANY,
        "a number of half the dimension",
        "The square root; that of an area is a length.",
        "sqrt(2)",
    )
    .defined_for("numbers of 0 and more"),
    function(
        Numbers,
        "pow",
        &[&[any("x", Takes::Number), of("exponent", Type::Number)]],
        "a number of the power's dimension",
        "`x` to the power of `exponent`, as `x ^ exponent` is.",
        "pow(2, 0.5)",
    ),
    function(Numbers, "exp", X, "a plain number", "The exponential function: e to the power of `x`.", "exp(1)")
    .defined_for("numbers up to 709"),
    function(Numbers, "log", X, "a plain number", "The natural logarithm.", "log(2)")
    .defined_for("numbers greater than 0"),
    // ── Angles ─────────────────────────────────────────────────────────────────────────────────────────────────
    function(Angles, "sin", ANGLE, "a plain number", "The sine of an angle.", "sin(30deg)"),
    function(Angles, "cos", ANGLE, "a plain number", "The cosine of an angle.", "cos(30deg)"),
    function(Angles, "tan", ANGLE, "a plain number", "The tangent of an angle.", "tan(30deg)")
    .defined_for("angles other than 90deg and its odd multiples"),
    function(Angles, "asin", X, "an angle", "The angle from -90deg to 90deg whose sine is `x`.", "asin(0.5)")
    .defined_for("numbers from -1 to 1"),
    function(Angles, "acos", X, "an angle", "The angle from 0deg to 180deg whose cosine is `x`.", "acos(0.5)")
    .defined_for("numbers from -1 to 1"),
    function(Angles, "atan", X, "an angle", "The angle from -90deg to 90deg whose tangent is `x`.", "atan(0.5)"),
    function(
        Angles,
        "atan2",
        &[&[any("y", Takes::Alike), any("x", Takes::Alike)]],
        "an angle",
        "The angle from the x axis to the point (x, y), from -180deg to 180deg.",
        "atan2(1m, 2m)",
    ),
    // ── Points and vectors ─────────────────────────────────────────────────────────────────────────────────────
    function(Vectors, "dot", VECTORS, "a number", "The dot product of two vectors.", "dot((1, 0, 0), (0, 1, 0))"),
    function(
        Vectors,
        "cross",
        VECTORS,
        "a vector",
        "The cross product of two vectors: normal to both, right-handed.",
        "cross((1, 0, 0), (0, 1, 0))",
    ),
    function(
        Vectors,
        "length",
        VECTOR,
        "a number of the vector's unit",
        "How long a vector is; for lists there is `len`.",
        "length((3m, 4m, 0m))",
    ),
    function(
        Vectors,
        "normalize",
        VECTOR,
        "a vector of plain numbers",
        "The vector of length 1 in the same direction.",
        "normalize((0m, 2m, 0m))",
    )
    .defined_for("vectors longer than 0"),
    // ── Lists ──────────────────────────────────────────────────────────────────────────────────────────────────
    function(
        Lists,
        "len",
        &[&[of("list", Type::List)]],
        "a whole number",
        "How many elements a list has.",
        "len([1m, 2m, 5m])",
    ),
    // ── Chance ─────────────────────────────────────────────────────────────────────────────────────────────────
    function(
        Chance,
        "random",
        &[&[of("seed", Type::Number), of("i", Type::Number)]],
        "a plain number in [0, 1)",
        "A number that looks random, and is the same in every run for the same `seed` and `i`.",
        "random(7, 0)",
    )
    .computed(
        "mix(mix(bits of seed) + bits of i), the upper 53 of its 64 bits over 2^53; the bits are those of IEEE 754 \
         doubles, the sum is modulo 2^64, and mix adds 0x9e3779b97f4a7c15 and applies the finaliser of SplitMix64 \
         (Steele, Lea, Flood 2014)",
    ),
    function(
        Chance,
        "noise",
        &[&[any("x", Takes::Number)], &[any("point", Takes::Tuple)]],
        "a plain number in [0, 1)",
        "A smooth number that looks random, with hills about 1 apart; lengths count in metres.",
        "noise((0.3, 1.2, 0.5))",
    )
    .computed(
        "value noise: each corner (x, y, z) of the unit cell has mix(mix(mix(x) ^ y) ^ z) of the bits of its \
         coordinates, read as by `random`; between corners, quintic steps 6t^5 - 15t^4 + 10t^3 (Perlin 2002); a \
         single number x is the point (x, 0, 0)",
    ),
    // ── Colours ────────────────────────────────────────────────────────────────────────────────────────────────
    function(
        Colors,
        "rgb",
        &[&[of("r", Type::Number), of("g", Type::Number), of("b", Type::Number)]],
        "a colour",
        "Linear light, with the primaries of Rec. 709.",
        "rgb(1, 0.5, 0)",
    ),
    function(
        Colors,
        "srgb",
        &[&[of("r", Type::Number), of("g", Type::Number), of("b", Type::Number)]],
        "a colour",
        "Display values from 0 to 1, as a colour picker shows them; `#ff8000` in numbers.",
        "srgb(1, 0.5, 0)",
    ),
    function(
        Colors,
        "hsv",
        &[&[of("hue", Type::Angle), of("saturation", Type::Number), of("value", Type::Number)]],
        "a colour",
        "Hue, saturation and value of display values (Smith 1978); red is 0deg, green 120deg, blue 240deg.",
        "hsv(30deg, 1, 1)",
    ),
    // ── Textures ───────────────────────────────────────────────────────────────────────────────────────────────
    function(
        Textures,
        "image",
        &[&[of("file", Type::Text)]],
        "a texture",
        "A picture from a file, repeated beyond its edges.",
        "image(\"wood.png\")",
    ),
    // ── Transforms ─────────────────────────────────────────────────────────────────────────────────────────────
    function(
        Transforms,
        "translate",
        &[
            &[of("x", Type::Length), of("y", Type::Length), of("z", Type::Length)],
            &[of("offset", Type::Offset)],
        ],
        "a transform",
        "Moves.",
        "translate(0m, 1m, 0m)",
    ),
    function(
        Transforms,
        "scale",
        &[
            &[of("factor", Type::Number)],
            &[of("x", Type::Number), of("y", Type::Number), of("z", Type::Number)],
            &[of("factors", Type::Vector)],
        ],
        "a transform",
        "Stretches, by one factor or along the axes; a negative factor mirrors.",
        "scale(1, 2, 1)",
    ),
    function(
        Transforms,
        "rotate_x",
        ANGLE,
        "a transform",
        "Turns about the x axis, counter-clockwise seen from its tip.",
        "rotate_x(30deg)",
    ),
    function(
        Transforms,
        "rotate_y",
        ANGLE,
        "a transform",
        "Turns about the y axis, counter-clockwise seen from its tip.",
        "rotate_y(30deg)",
    ),
    function(
        Transforms,
        "rotate_z",
        ANGLE,
        "a transform",
        "Turns about the z axis, counter-clockwise seen from its tip.",
        "rotate_z(30deg)",
    ),
    function(
        Transforms,
        "rotate",
        &[&[of("axis", Type::Vector), of("angle", Type::Angle)]],
        "a transform",
        "Turns about an axis through the origin, counter-clockwise seen from its tip.",
        "rotate((0, 1, 0), 30deg)",
    ),
    function(
        Transforms,
        "look_at",
        &[&[
            of("from", Type::Point),
            of("to", Type::Point),
            Arg { name: "up", takes: Takes::Of(Type::Vector), times: Times::Perhaps },
        ]],
        "a transform",
        "Moves the origin to `from` and turns the -z axis towards `to`; `up` is (0, 1, 0) where it is not given.",
        "look_at((0m, 1m, 2m), (0m, 0m, 0m))",
    ),
    function(
        Transforms,
        "matrix",
        &[&[of("rows", Type::List)]],
        "a transform",
        "Sixteen numbers, row by row, for column vectors; translations in metres, the last row 0, 0, 0, 1.",
        "matrix([1, 0, 0, 2, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])",
    ),
    function(
        Transforms,
        "moving",
        &[&[of("from", Type::Transform), of("to", Type::Transform)]],
        "a transform",
        "Goes from one transform to another in the time of a frame; the camera's `shutter` says how much of it is seen.",
        "moving(rotate_y(0deg), rotate_y(360deg))",
    )
    .computed(
        "a way at an even speed for each pair of shifts, scales or turns about one axis, whole turns included; \
         other pairs are taken apart into shift, rotation and stretch, and turn the short way round (Shoemake & Duff 1992)",
    ),
    // ── Curves ─────────────────────────────────────────────────────────────────────────────────────────────────
    function(
        Curves,
        "bezier",
        BEZIER,
        "a curve",
        "Cubic pieces that share their ends, of 3k + 1 points; with `degree: all`, one curve of all points.",
        "bezier [(0cm, 0cm), (4cm, 0cm), (4cm, 6cm), (0cm, 6cm)]",
    ),
    function(
        Curves,
        "bspline",
        POINTS,
        "a curve",
        "A uniform cubic B-spline: smooth, near its points rather than through them.",
        "bspline [(0cm, 0cm), (4cm, 0cm), (4cm, 6cm), (0cm, 6cm), (0cm, 8cm)]",
    ),
    function(
        Curves,
        "polyline",
        POINTS,
        "a curve",
        "Straight lines from point to point.",
        "polyline [(0cm, 0cm), (4cm, 0cm), (0cm, 9cm)]",
    ),
    function(
        Curves,
        "polygon",
        POINTS,
        "an outline",
        "Straight lines from point to point, and back to the first.",
        "polygon [(0cm, 0cm), (4cm, 0cm), (0cm, 3cm)]",
    ),
    // ── Filters ────────────────────────────────────────────────────────────────────────────────────────────────
    function(Filters, "box", RADIUS, "a pixel filter", "Each sample counts fully within the radius.", "box(0.5px)"),
    function(
        Filters,
        "tent",
        RADIUS,
        "a pixel filter",
        "Samples count less with their distance, down to nothing at the radius.",
        "tent(1px)",
    ),
    function(
        Filters,
        "gaussian",
        RADIUS,
        "a pixel filter",
        "Samples count by a bell curve, cut off at the radius.",
        "gaussian(1.5px)",
    ),
    function(
        Filters,
        "mitchell",
        RADIUS,
        "a pixel filter",
        "Samples count by the cubic of Mitchell and Netravali, negative at its rim: sharp edges.",
        "mitchell(2px)",
    ),
    function(
        Filters,
        "blackman_harris",
        RADIUS,
        "a pixel filter",
        "Samples count by the window of Blackman and Harris: smooth, and narrower than it looks.",
        "blackman_harris(2px)",
    ),
    // ── Stops ──────────────────────────────────────────────────────────────────────────────────────────────────
    function(Stops, "samples", COUNT, "a rule to stop by", "After so many samples a pixel.", "samples(64)"),
    function(
        Stops,
        "passes",
        COUNT,
        "a rule to stop by",
        "After so many passes, each one sample a pixel.",
        "passes(64)",
    ),
    function(
        Stops,
        "time",
        &[&[of("time", Type::Time)]],
        "a rule to stop by",
        "When the time is over.",
        "time(5min)",
    ),
    function(
        Stops,
        "error",
        &[&[of("share", Type::Number)]],
        "a rule to stop by",
        "When the relative error of the picture is below this share.",
        "error(1%)",
    ),
];
