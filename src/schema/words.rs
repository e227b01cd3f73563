//! The words and signs of the language that are neither blocks nor functions.

/// A way to write an item, a value or an operation.
#[derive(Debug)]
pub struct Form {
    /// The words or signs that tell it.
    pub words: &'static [&'static str],
    /// Where it stands.
    pub place: Place,
    /// What it means, in one or two sentences.
    pub doc: &'static str,
    /// It, written.
    pub example: &'static str,
}

/// Where a form stands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Place {
    /// At the top level; some also in groups and functions.
    Item,
    /// Wherever a value is wanted.
    Value,
    /// Between values or before one; those that bind loosest come first.
    Operator,
}

const fn item(words: &'static [&'static str], doc: &'static str, example: &'static str) -> Form {
    Form { words, place: Place::Item, doc, example }
}

const fn value(words: &'static [&'static str], doc: &'static str, example: &'static str) -> Form {
    Form { words, place: Place::Value, doc, example }
}

const fn operator(words: &'static [&'static str], doc: &'static str, example: &'static str) -> Form {
    Form { words, place: Place::Operator, doc, example }
}

/// Every form, items first.
pub const FORMS: &[Form] = &[
    item(&["snell"], "The version of the language; the first item of every file.", "snell 1"),
    item(
        &["include"],
        "Puts the items of a file here, once, however often it is included.",
        "include \"room.snell\"",
    ),
    item(
        &["import", "as"],
        "Makes what a file defines known under a name: `mat.gold`. Such a file holds definitions only.",
        "import \"materials.snell\" as mat",
    ),
    item(
        &["param", "in"],
        "A value that the command line may set: `--set seats=6`; its type and its range are checked.",
        "param seats: int = 12 in 1..=500",
    ),
    item(
        &["let"],
        "Names a value. That alone adds nothing to the picture: an object comes into it with `place`.",
        "let ball = sphere { radius: 30cm }",
    ),
    item(
        &["fn", "->"],
        "A function: its arguments have types and may have defaults; its value stands last.",
        "fn ball(size: length = 30cm) -> object { sphere { radius: size } }",
    ),
    item(
        &["for", "in"],
        "Repeats items over a range or a list.",
        "for i in 0..4 { sphere { center: (i * 1m, 0m, 0m), radius: 30cm } }",
    ),
    item(
        &["if", "else"],
        "Takes one of two blocks of items.",
        "if 1 < 2 { sphere { radius: 30cm } } else { sphere { radius: 40cm } }",
    ),
    item(
        &["place", "as", "at"],
        "Puts an object into the picture: `at` a point, `as` a name that `on` finds, with a transform in braces.",
        "place sphere { radius: 30cm } as hero at (0m, 1m, 0m)",
    ),
    item(
        &["allow"],
        "Silences a warning about the item after it, and says why.",
        "allow(snell::resolve::unused, \"kept for tomorrow\")\nlet spare = sphere { radius: 30cm }",
    ),
    value(
        &["number", "1e3", "1_000"],
        "Digits with a point or an exponent; a unit is glued to them.",
        "1_000.5e-3m",
    ),
    value(&["f/", "f/2.8"], "An f-number: the focal length by the width of the opening.", "f/2.8"),
    value(&["size", "x"], "A size in pixels, width by height.", "1024 x 768"),
    value(&["#", "#ff8800"], "A colour in display values, of six or three hexadecimal digits.", "#ff8800"),
    value(&["string", "\""], "A text, on one line.", "\"wood.png\""),
    value(&["true", "false"], "What comparisons give.", "true"),
    value(
        &["point", "vector", "()"],
        "Two or three values: a point where they are lengths, a direction where they are plain. Its parts are \
         `.x`, `.y` and `.z`.",
        "(0m, 1m, 2m)",
    ),
    value(
        &["list", "[]"],
        "Values of any kind. The first is `xs[0]`; `len(xs)` counts them.",
        "[1m, 2m, 5m]",
    ),
    value(
        &["comprehension"],
        "A list of what each turn gives; `if` says which turns count.",
        "[i * 2cm for i in 0..4 if i > 1]",
    ),
    value(&["data"], "Plain numbers in bulk, parted by blanks.", "data [ 0 0.5 1 -2e3 ]"),
    value(&["if", "else"], "One of two values.", "if 1 < 2 { 30cm } else { 40cm }"),
    operator(
        &["then"],
        "Joins transforms; the left one is applied first.",
        "scale(2) then rotate_y(30deg) then translate(0m, 1m, 0m)",
    ),
    operator(
        &["or"],
        "Either of two conditions; of rules to stop by, whichever comes first.",
        "samples(64) or time(5min)",
    ),
    operator(&["and"], "Both of two conditions.", "1 < 2 and 2 < 3"),
    operator(&["not"], "The opposite of a condition.", "not 1 > 2"),
    operator(
        &["==", "!=", "<", "<=", ">", ">="],
        "Compare numbers of one unit; `==` and `!=` also texts and truth values.",
        "1m < 200cm",
    ),
    operator(&["..", "..="], "A range: `..` leaves its end out, `..=` takes it in.", "0..4"),
    operator(&["per"], "What is left of white light after that way through glass.", "#f4fff6 per 10cm"),
    operator(&["+", "-"], "Add and subtract numbers of one unit, points and colours.", "1m + 20cm"),
    operator(
        &["*", "/", "%"],
        "Multiply, divide, take the remainder; units go with the numbers. `%` with blanks is the remainder.",
        "7 % 2",
    ),
    operator(&["-"], "Before a number or a point: its opposite.", "-30deg"),
    operator(&["^"], "A power; `2 ^ 3 ^ 2` is `2 ^ (3 ^ 2)`, and `-2 ^ 2` is -4.", "2 ^ 3"),
    operator(
        &["on"],
        "Before the name of an object, where a lens is told its focus: `focus: on hero`.",
        "thin { focal_length: 50mm, aperture: f/2.8, focus: on hero }",
    ),
];
