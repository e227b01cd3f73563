//! The blocks of the family and what belongs to each of their keys.
//!
//! The format does not mark where a field ends; only the count of its values tells. Keys that are not listed here take
//! the numbers and the one word that follow them.

/// What follows a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Args {
    /// Nothing.
    Flag,
    /// So many numbers.
    Numbers(usize),
    /// A file name, and numbers that some programs put after it.
    Path,
    /// Numbers, or a word if there are none.
    Free,
    /// Lists in brackets.
    Lists,
}

/// The fields of one kind of block.
pub type Vocabulary = &'static [(&'static str, Args)];

use Args::*;

/// `PerspectiveCamera`, `OrthographicCamera` and their relatives.
pub const CAMERA: Vocabulary = &[
    ("center", Numbers(3)),
    ("direction", Numbers(3)),
    ("up", Numbers(3)),
    ("angle", Numbers(1)),
    ("w-angle", Numbers(1)),
    ("h-angle", Numbers(1)),
    ("width", Numbers(1)),
    ("height", Numbers(1)),
    ("size", Numbers(1)),
    ("focal", Numbers(1)),
    ("focalLength", Numbers(1)),
    ("focal_length", Numbers(1)),
    ("aperture", Numbers(1)),
    ("aperture_size", Numbers(1)),
    ("distance", Numbers(1)),
    ("dist", Numbers(1)),
    ("radius", Numbers(1)),
    ("focus", Numbers(1)),
    ("focusDist", Numbers(1)),
    ("focusDistance", Numbers(1)),
    ("focus_distance", Numbers(1)),
    ("lens_radius", Numbers(1)),
    ("defocusAngle", Numbers(1)),
    ("field", Numbers(1)),
];

/// `Background`.
pub const BACKGROUND: Vocabulary = &[("color", Numbers(3)), ("ambientLight", Numbers(3)), ("cubeMap", Path)];

/// `Lights`.
pub const LIGHTS: Vocabulary = &[("numLights", Numbers(1))];

/// Any one light.
pub const LIGHT: Vocabulary = &[
    ("position", Numbers(3)),
    ("direction", Numbers(3)),
    ("color", Numbers(3)),
    ("attenuation", Numbers(3)),
    ("falloff", Numbers(1)),
    ("radius", Numbers(1)),
    ("emission", Numbers(1)),
    ("x_axis", Numbers(3)),
    ("y_axis", Numbers(3)),
    ("dirX", Numbers(3)),
    ("dirY", Numbers(3)),
];

/// `Materials`.
pub const MATERIALS: Vocabulary = &[("numMaterials", Numbers(1))];

/// `Material` and `PhongMaterial`, with the fields of every dialect that is read.
pub const MATERIAL: Vocabulary = &[
    ("diffuseColor", Numbers(3)),
    ("specularColor", Numbers(3)),
    ("shininess", Numbers(1)),
    ("color", Numbers(3)),
    ("emissionColor", Numbers(3)),
    ("reflection", Numbers(1)),
    ("texture", Path),
    ("type", Free),
    ("emission", Numbers(3)),
    ("refr", Numbers(1)),
    ("refraction", Numbers(1)),
    ("refractive", Numbers(1)),
    ("refractive_rate", Numbers(1)),
    ("reflectRate", Numbers(1)),
    ("texture_file", Path),
    ("bump", Path),
    ("mColor", Numbers(3)),
    ("diff", Numbers(1)),
    ("refl", Numbers(1)),
    ("diff_factor", Numbers(1)),
    ("spec_factor", Numbers(1)),
    ("refr_factor", Numbers(1)),
    ("n", Numbers(1)),
    ("w_diffusion", Numbers(1)),
    ("w_reflection", Numbers(1)),
    ("w_transmission", Numbers(1)),
    ("ref_index", Numbers(1)),
    ("diffuseRate", Numbers(1)),
    ("specularRate", Numbers(1)),
    ("refractRate", Numbers(1)),
    ("refractIndex", Numbers(1)),
    ("perDiffuse", Numbers(1)),
    ("perReflect", Numbers(1)),
    ("perRefract", Numbers(1)),
    ("diffidx", Numbers(1)),
    ("reflidx", Numbers(1)),
    ("refridx", Numbers(1)),
    ("refrN", Numbers(1)),
];

/// Materials whose block name is their kind.
pub const TYPED_MATERIAL: Vocabulary = &[
    ("color", Numbers(3)),
    ("diffuseColor", Numbers(3)),
    ("specularColor", Numbers(3)),
    ("emissionColor", Numbers(3)),
    ("lightColor", Numbers(3)),
    ("attenuation", Numbers(3)),
    ("attenuationColor", Numbers(3)),
    ("transmittance", Numbers(3)),
    ("transmissiveColor", Numbers(3)),
    ("refractionIndex", Numbers(1)),
    ("refractiveIndex", Numbers(1)),
    ("refractive_index", Numbers(1)),
    ("refractive", Numbers(1)),
    ("index", Numbers(1)),
    ("n", Numbers(1)),
    ("fuzz", Numbers(1)),
    ("fuzziness", Numbers(1)),
    ("texture", Free),
];

/// `Group`.
pub const GROUP: Vocabulary =
    &[("numObjects", Numbers(1)), ("num_objects", Numbers(1)), ("MaterialIndex", Numbers(1))];

/// `Sphere`.
pub const SPHERE: Vocabulary = &[("center", Numbers(3)), ("radius", Numbers(1)), ("velocity", Numbers(3))];

/// `Plane`, with the picture that the course's own renderer can lay on it.
pub const PLANE: Vocabulary = &[
    ("normal", Numbers(3)),
    ("offset", Numbers(1)),
    ("texture", Path),
    ("x-axis", Numbers(3)),
    ("y-axis", Numbers(3)),
    ("x-offset", Numbers(1)),
    ("y-offset", Numbers(1)),
];

/// `Triangle`.
pub const TRIANGLE: Vocabulary = &[("vertex0", Numbers(3)), ("vertex1", Numbers(3)), ("vertex2", Numbers(3))];

/// `Rectangle` and `Quad`, by a point and two vectors with different names.
pub const QUAD: Vocabulary = &[
    ("origin", Numbers(3)),
    ("u", Numbers(3)),
    ("v", Numbers(3)),
    ("point", Numbers(3)),
    ("x", Numbers(3)),
    ("y", Numbers(3)),
    ("position", Numbers(3)),
    ("x_axis", Numbers(3)),
    ("y_axis", Numbers(3)),
];

/// `Disk`.
pub const DISK: Vocabulary = &[("center", Numbers(3)), ("normal", Numbers(3)), ("radius", Numbers(1))];

/// `Cube`.
pub const CUBE: Vocabulary = &[("min_p", Numbers(3)), ("max_p", Numbers(3))];

/// `TriangleMesh`.
pub const MESH: Vocabulary =
    &[("obj_file", Path), ("scale", Numbers(1)), ("offset", Numbers(3)), ("Y_inverse", Flag)];

/// `Transform`: each key is an operation, their order matters.
pub const TRANSFORM: Vocabulary = &[
    ("Translate", Numbers(3)),
    ("Scale", Numbers(3)),
    ("UniformScale", Numbers(1)),
    ("XRotate", Numbers(1)),
    ("YRotate", Numbers(1)),
    ("ZRotate", Numbers(1)),
    ("Rotate", Numbers(4)),
    ("Matrix", Numbers(16)),
    ("Matrix4f", Numbers(16)),
];

/// `RevSurface`.
pub const REV_SURFACE: Vocabulary = &[("profile", Flag)];

/// `BezierCurve` and `BsplineCurve`.
pub const CURVE: Vocabulary = &[("controls", Lists)];

/// Blocks at the top level.
pub const TOP: &[&str] =
    &["PerspectiveCamera", "OrthographicCamera", "Background", "Lights", "Materials", "Group"];

/// Objects of a group.
pub const OBJECTS: &[&str] = &[
    "Group",
    "Sphere",
    "Plane",
    "Triangle",
    "TriangleMesh",
    "Transform",
    "RevSurface",
    "BezierCurve",
    "BsplineCurve",
];

/// The key's entry, exactly as it is spelt.
pub fn find(vocabulary: Vocabulary, word: &str) -> Option<(&'static str, Args)> {
    vocabulary.iter().find(|(key, _)| *key == word).copied()
}

/// The entry of a key that is spelt with a capital, `Color` for `color`, as some programs do.
pub fn find_capitalised(vocabulary: Vocabulary, word: &str) -> Option<(&'static str, Args)> {
    let first = word.chars().next().filter(char::is_ascii_uppercase)?;
    let lower = format!("{}{}", first.to_ascii_lowercase(), &word[1..]);
    find(vocabulary, &lower)
}
