//! Which of the family's dialects a file, and each of its materials, is written in.
//!
//! All dialects share one syntax; what differs is the meaning of fields. Camera and lights follow the file's dialect,
//! shading follows each material's own.

use super::parse::{Block, Node};
use super::words::blocks;

/// A dialect, named after what makes it recognisable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Dialect {
    /// Of `arsenal.txt`: integer `reflection`, `emissionColor`, pictures on planes, meshes with `scale` and `offset`.
    Arsenal,
    /// The course's official first and second assignments: `diffuseColor`, `specularColor`, `shininess`.
    Pa1,
    /// Materials with `type` and three weights.
    Weights,
    /// Materials with `type` and a word or an integer.
    Enum,
    /// Materials with bare words: `SPEC`, `DIFF`, `REFR`, `prop Glass`.
    Flags,
    /// The material block's name is its kind: `ReflectiveMaterial { .. }`.
    Typed,
    /// One number per lobe: `diff` `refl` `refr`, `spec_factor`, ..
    Factors,
    /// A hybrid of the course's and MIT's: which colours a material has implies its kind.
    Implied,
    /// MIT 6.837 of 2003: materials inline in groups, braces round arguments.
    Mit2003,
    /// MIT 6.837 of 2004: `exponent`, `reflectiveColor`, solid textures, orthographic cameras.
    Mit2004,
    /// MIT 6.837 of 2010 to 2015: no picture size, `refractionIndex`, `falloff`.
    Mit2010,
    /// MIT 6.837 of 2016 and later: paths relative to the scene.
    Mit2016,
}

impl Dialect {
    /// Every dialect.
    pub const ALL: [Self; 12] = [
        Self::Arsenal,
        Self::Pa1,
        Self::Weights,
        Self::Enum,
        Self::Flags,
        Self::Typed,
        Self::Factors,
        Self::Implied,
        Self::Mit2003,
        Self::Mit2004,
        Self::Mit2010,
        Self::Mit2016,
    ];

    /// The name by which a person picks it.
    pub fn id(self) -> &'static str {
        match self {
            Self::Arsenal => "arsenal",
            Self::Pa1 => "pa1",
            Self::Weights => "weights",
            Self::Enum => "enum",
            Self::Flags => "flags",
            Self::Typed => "typed",
            Self::Factors => "factors",
            Self::Implied => "implied",
            Self::Mit2003 => "mit2003",
            Self::Mit2004 => "mit2004",
            Self::Mit2010 => "mit2010",
            Self::Mit2016 => "mit2016",
        }
    }

    /// The dialect with this name.
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|dialect| dialect.id() == id)
    }

    /// The dialect in words.
    pub fn title(self) -> &'static str {
        match self {
            Self::Arsenal => "the dialect of arsenal.txt",
            Self::Pa1 => "the course's own dialect (PA1, PA2)",
            Self::Weights => "the dialect of weighted lobes",
            Self::Enum => "the dialect of enumerated materials",
            Self::Flags => "the dialect of bare material words",
            Self::Typed => "the dialect of typed material blocks",
            Self::Factors => "the dialect of numeric factors",
            Self::Implied => "the hybrid dialect of implied materials",
            Self::Mit2003 => "MIT 6.837 of 2003",
            Self::Mit2004 => "MIT 6.837 of 2004",
            Self::Mit2010 => "MIT 6.837 of 2010 to 2015",
            Self::Mit2016 => "MIT 6.837 of 2016 and later",
        }
    }

    /// Whether it is one of MIT's own rather than a descendant from Tsinghua.
    pub fn is_mit(self) -> bool {
        matches!(self, Self::Mit2003 | Self::Mit2004 | Self::Mit2010 | Self::Mit2016)
    }
}

/// A file's dialect and why it was taken for that.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Detection {
    /// The dialect of camera, lights and of materials that do not tell.
    pub dialect: Dialect,
    /// What gave it away.
    pub reason: String,
}

/// The dialect of a file: MIT's by their cameras and materials, the others by the first material that tells; the
/// course's own materials are part of every dialect and tell least.
pub fn of_file(tree: &Block<'_>) -> Detection {
    let telling = |(dialect, _): &(Dialect, String)| *dialect != Dialect::Pa1;
    let (dialect, reason) = mit(tree)
        .or_else(|| arsenal_geometry(tree))
        .or_else(|| materials(tree).filter_map(of_material).find(telling))
        .or_else(|| materials(tree).find_map(of_material))
        .unwrap_or((Dialect::Pa1, "nothing in it goes beyond the course's format".into()));
    Detection { dialect, reason }
}

/// The dialect of a material, if its fields tell.
pub fn of_material(material: &Block<'_>) -> Option<(Dialect, String)> {
    let name = material.name();
    if SOLID_TEXTURES.contains(&name) {
        return Some((Dialect::Mit2004, format!("a material is a `{name}`")));
    }
    if !["Material", "PhongMaterial"].contains(&name) {
        let is_typed = blocks::material(name).is_some_and(|kind| kind != blocks::Material::Plain);
        return is_typed.then(|| (Dialect::Typed, format!("a material is a `{name}`")));
    }
    if let Some(values) = material.after("type") {
        return Some(by_type(values));
    }
    let has =
        |words: &[&'static str]| words.iter().copied().find(|&word| material.words().any(|it| it == word));
    let because = |word: &str| format!("a material has `{word}`");
    if let Some(word) = has(&["DIFF", "SPEC", "REFR", "prop"]) {
        return Some((Dialect::Flags, because(word)));
    }
    if let Some(word) = has(FACTORS) {
        return Some((Dialect::Factors, because(word)));
    }
    if let Some(word) = has(&["exponent", "transparentColor", "indexOfRefraction"]) {
        return Some((Dialect::Mit2004, because(word)));
    }
    if let Some(word) = has(&["refractionIndex", "lightColor"]) {
        return Some((Dialect::Implied, because(word)));
    }
    // The renderer of arsenal.txt takes `color` alone.
    let is_foreign = has(&["diffuseColor", "specularColor", "emission"]).is_some();
    let telling = || integer_reflection(material).or_else(|| has(&["emissionColor"]));
    if let Some(word) = (!is_foreign).then(telling).flatten() {
        return Some((Dialect::Arsenal, because(word)));
    }
    if let Some(word) = has(&["refr", "emission"]) {
        return Some((Dialect::Weights, because(word)));
    }
    has(&["diffuseColor", "specularColor"]).map(|word| (Dialect::Pa1, because(word)))
}

const SOLID_TEXTURES: &[&str] = &["Checkerboard", "Noise", "Marble", "Wood"];

/// Keys that only the dialects of numeric factors have.
const FACTORS: &[&str] = &[
    "diff",
    "refl",
    "diff_factor",
    "spec_factor",
    "refr_factor",
    "w_diffusion",
    "w_reflection",
    "w_transmission",
    "refract",
    "diffuseRate",
    "specularRate",
    "refractRate",
    "perDiffuse",
    "perReflect",
    "perRefract",
    "diffidx",
    "reflidx",
    "refridx",
    "refraction_rate",
    "reflectiveColor",
    "transparency",
    "luminance",
];

/// MIT's files know no picture size, and their oldest editions have blocks of their own.
fn mit(tree: &Block<'_>) -> Option<(Dialect, String)> {
    let groups = || tree.blocks().filter(|block| block.name() == "Group");
    if groups().any(|group| holds(group, &|block| block.name() == "Material")) {
        return Some((Dialect::Mit2003, "a `Material` stands inside a `Group`".into()));
    }
    if tree.blocks().any(|block| block.name() == "OrthographicCamera") {
        return Some((Dialect::Mit2004, "the camera is an `OrthographicCamera`".into()));
    }
    let camera = tree.blocks().find(|block| block.name() == "PerspectiveCamera")?;
    if camera.words().any(|word| word == "width" || word == "height") {
        return None;
    }
    let solid_or_2004 = |material| matches!(of_material(material), Some((Dialect::Mit2004, _)));
    if materials(tree).any(solid_or_2004)
        || materials(tree).any(|it| it.words().any(|w| w == "reflectiveColor"))
    {
        return Some((Dialect::Mit2004, "a material is of the edition of 2004".into()));
    }
    if holds(tree, &|block| block.name() == "PointLight" && block.words().any(|word| word == "attenuation")) {
        return Some((Dialect::Mit2004, "a `PointLight` has `attenuation`".into()));
    }
    let relative = |word: &str| word.starts_with("models/") || word.starts_with("tex/");
    if holds(tree, &|block| block.words().any(relative)) {
        return Some((Dialect::Mit2016, "no picture size, and files are in `models/` or `tex/`".into()));
    }
    Some((Dialect::Mit2010, "the camera has no `width` and `height`".into()))
}

/// The geometry of `arsenal.txt` gives the dialect away even without a telling material.
fn arsenal_geometry(tree: &Block<'_>) -> Option<(Dialect, String)> {
    let has = |name: &str, key: &str| {
        holds(tree, &|block| block.name() == name && block.words().any(|word| word == key))
    };
    let telling = [("Plane", "x-axis"), ("TriangleMesh", "Y_inverse")];
    let (block, key) = telling.into_iter().find(|(block, key)| has(block, key))?;
    Some((Dialect::Arsenal, format!("a `{block}` has `{key}`")))
}

/// Three or four numbers are weights; one number or a word picks a kind.
fn by_type(values: &[Node<'_>]) -> (Dialect, String) {
    let count = values.iter().take_while(|node| matches!(node, Node::Number(_))).count();
    match count {
        0 => (Dialect::Enum, "a material has `type` and a word".into()),
        1 => (Dialect::Enum, "a material has `type` and one number".into()),
        _ => (Dialect::Weights, format!("a material has `type` and {count} weights")),
    }
}

/// `reflection 0`, `1` or `2`, written as an integer.
fn integer_reflection(material: &Block<'_>) -> Option<&'static str> {
    match material.after("reflection")?.first()? {
        Node::Number(number) if ["0", "1", "2"].contains(&number.text) => Some("reflection"),
        _ => None,
    }
}

fn materials<'a, 't>(tree: &'a Block<'t>) -> impl Iterator<Item = &'a Block<'t>> {
    let is_list = |block: &&Block<'_>| blocks::top(block.name()) == Some(blocks::Top::Materials);
    tree.blocks().filter(is_list).flat_map(Block::blocks)
}

/// Whether any block inside satisfies `test`. Nesting is bounded by the parser.
fn holds(block: &Block<'_>, test: &dyn Fn(&Block<'_>) -> bool) -> bool {
    block.blocks().any(|inner| test(inner) || holds(inner, test))
}
