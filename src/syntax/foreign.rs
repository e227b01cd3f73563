//! Scenes of other programs, known by how they begin.

use super::ast::{Expr, ExprKind};
use super::error::SyntaxError;
use super::text::Text;

/// The report for a text that begins as no scene of this language does, but one of another.
pub(super) fn recognise(place: &Text<'_>) -> Option<SyntaxError> {
    let text = place.text;
    let start = text.len() - text.trim_start().len();
    let line = text[start..].lines().next()?;
    let word = line.split(|c: char| !(c.is_ascii_alphanumeric() || "#_<?!".contains(c))).next()?;
    let (language, hint) = language(word, line)?;
    let at = place.span(start, start + line.trim_end().len());
    Some(SyntaxError::Foreign { language, hint: hint.to_owned(), at })
}

/// The language in which a first line begins with `word`, and what to do about it.
fn language(word: &str, line: &str) -> Option<(&'static str, &'static str)> {
    let quoted = line[word.len()..].trim_start().starts_with('"');
    Some(match word {
        "PerspectiveCamera" | "OrthographicCamera" | "SimplePerspectiveCamera" => (
            "a text of the arsenal family",
            "`snell convert` translates it: `snell convert scene.txt -o scene.snell`",
        ),
        "#declare" | "#version" | "#include" | "#local" | "#default" | "#macro" | "global_settings" => (
            "POV-Ray's language",
            "begin with `snell 1`; blocks look alike, but fields have names: `sphere { center: (0m, 1m, 0m), radius: 5cm }`",
        ),
        "LookAt" | "WorldBegin" | "AttributeBegin" | "MakeNamedMaterial" => PBRT,
        "Camera" | "Film" | "Sampler" | "Integrator" | "Shape" | "Material" | "PixelFilter" if quoted => PBRT,
        "Transform" | "Translate" | "Rotate" | "Scale" | "ConcatTransform" => PBRT,
        "<?xml" | "<scene" | "<!--" => XML,
        "mtllib" | "v" | "vn" | "usemtl" => ("a mesh", "name it in a scene: `mesh { file: \"model.obj\" }`"),
        _ => return None,
    })
}

/// How a line of POV-Ray that begins with `#` is said here.
pub(super) fn directive_hint(line: &str) -> String {
    let word = line[1..].split(|c: char| !c.is_ascii_alphanumeric()).next().unwrap_or_default();
    let hint = match word {
        "include" => match line.split('"').nth(1) {
            Some(file) => return format!("write `include \"{}.snell\"`", file.trim_end_matches(".inc")),
            None => "write `include \"room.snell\"`",
        },
        "declare" | "local" => {
            let name = line.split_ascii_whitespace().nth(1).unwrap_or("goblet");
            return format!("write `let {name} = ..`");
        }
        "macro" => "write `fn ring(n: int) -> object { .. }`",
        "while" | "for" => "write `for i in 0..10 { .. }`",
        "if" | "else" => "write `if CONDITION { .. } else { .. }`",
        "end" => "a block ends with `}`",
        _ => "remove this line",
    };
    hint.to_owned()
}

/// What those hear who bring a scene for pbrt.
const PBRT: (&str, &str) = (
    "pbrt's language",
    "begin with `snell 1`; a shape is `sphere { radius: 5cm }`, what moves it is its `transform`",
);

/// What those hear who bring a scene for Mitsuba.
const XML: (&str, &str) = (
    "XML, as Mitsuba reads it",
    "begin with `snell 1`; a shape is `sphere { radius: 5cm, material: glass { ior: 1.5 } }`",
);

/// How a line of pbrt is said here.
pub(super) fn command_hint(line: &str) -> String {
    let mut words = line.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let (command, kind) = (words.next().unwrap_or_default(), words.next().unwrap_or_default());
    let hint = match command {
        "LookAt" | "Camera" => {
            "write `camera { position: (0m, 1.6m, 4m), look_at: (0m, 1m, 0m), fov: 45deg }`"
        }
        "Film" => "the size of the picture belongs to the camera: `film: { size: 1024 x 768 }`",
        "Sampler" | "Integrator" => "write `render { stop: samples(64) }`",
        "Shape" if kind == "sphere" => {
            "write `sphere { center: (0m, 1m, 0m), radius: 30cm, material: diffuse { color: 0.5 } }`"
        }
        "Shape" => "write `mesh { file: \"model.obj\", material: diffuse { color: 0.5 } }`",
        "Material" | "MakeNamedMaterial" | "NamedMaterial" | "Texture" => {
            "give the material a name, `let clay = diffuse { color: #c4553a }`, and each object its own: `material: clay`"
        }
        "LightSource" | "AreaLightSource" => "write `light point { position: (0m, 3m, 0m), power: 60W }`",
        "Transform" | "ConcatTransform" | "Translate" | "Rotate" | "Scale" => {
            "an object has its own `transform`: `transform: rotate_y(30deg) then translate(1m, 0m, 0m)`"
        }
        _ => "remove this line",
    };
    hint.to_owned()
}

/// How a line of XML is said here.
pub(super) fn tag_hint(line: &str) -> &'static str {
    let tag = line.trim_start_matches(['<', '/']).split(|c: char| !c.is_ascii_alphanumeric()).next();
    match tag.unwrap_or_default() {
        "bsdf" | "texture" => {
            "write `let clay = diffuse { color: #c4553a }`, and in an object `material: clay`"
        }
        "shape" => "write `sphere { center: (0m, 1m, 0m), radius: 30cm, material: diffuse { color: 0.5 } }`",
        "emitter" => "write `light point { position: (0m, 3m, 0m), power: 60W }`",
        "sensor" | "film" | "sampler" => {
            "write `camera { position: (0m, 1.6m, 4m), look_at: (0m, 1m, 0m), fov: 45deg }`"
        }
        _ => "blocks stand between braces, and fields have names: `sphere { radius: 5cm }`",
    }
}

/// Whether a text that cannot be read is a tag.
pub(super) fn is_tag(written: &str) -> bool {
    let inside = written.strip_prefix('<').map(|rest| rest.trim_start_matches(['/', '!', '?']));
    inside.is_some_and(|inside| {
        inside.starts_with(|c: char| c.is_ascii_alphabetic()) || inside.starts_with("--")
    })
}

/// The unit that a word spells out.
pub fn spelled_out(unit: &str) -> Option<&'static str> {
    let lower = unit.to_ascii_lowercase();
    Some(match lower.strip_suffix('s').unwrap_or(&lower) {
        "millimeter" | "millimetre" => "mm",
        "centimeter" | "centimetre" => "cm",
        "meter" | "metre" => "m",
        "kilometer" | "kilometre" => "km",
        "inch" | "inche" => "in",
        "foot" | "feet" => "ft",
        "degree" | "°" => "deg",
        "radian" => "rad",
        "sec" | "second" => "s",
        "minute" => "min",
        "watt" => "W",
        "lumen" => "lm",
        "kelvin" => "K",
        "pixel" => "px",
        "percent" => "%",
        _ => return None,
    })
}

/// A number without a unit and the unit that the word after it spells out, as they would be written: `100W`.
pub(super) fn glued_unit(value: &Expr, before: &str, after: &str) -> Option<String> {
    let ExprKind::Number { unit: None, .. } = value.kind else { return None };
    let unit = spelled_out(after.split(|c: char| !c.is_alphanumeric()).next()?)?;
    let numeral = before.trim_end().rsplit(|c: char| !(c.is_ascii_digit() || "._".contains(c))).next()?;
    Some(format!("{numeral}{unit}"))
}
