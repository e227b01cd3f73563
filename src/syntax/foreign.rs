//! Scenes of other programs, known by how they begin.

use super::error::SyntaxError;
use crate::source::Span;

/// The report for a text that begins as no scene of this language does, but one of another; `text` has no comments.
pub(super) fn recognise(text: &str, base: u32) -> Option<SyntaxError> {
    let start = text.len() - text.trim_start().len();
    let line = text[start..].lines().next()?;
    let word = line.split(|c: char| !(c.is_ascii_alphanumeric() || "#_<?!".contains(c))).next()?;
    let (language, hint) = language(word, line)?;
    let at = Span::new(base + start as u32, base + (start + line.trim_end().len()) as u32);
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
        "<?xml" | "<scene" | "<!--" => (
            "XML, as Mitsuba reads it,",
            "begin with `snell 1`; a shape is `sphere { radius: 5cm, material: glass { ior: 1.5 } }`",
        ),
        "mtllib" | "v" | "vn" | "usemtl" => ("a mesh", "name it in a scene: `mesh { file: \"model.obj\" }`"),
        _ => return None,
    })
}

/// What those hear who bring a scene for pbrt.
const PBRT: (&str, &str) = (
    "pbrt's language",
    "begin with `snell 1`; a shape is `sphere { radius: 5cm }`, what moves it is its `transform`",
);
