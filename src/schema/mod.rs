//! The registry: every block, field, function, unit, type and word of the language, declared once.
//!
//! Whoever needs to know what may stand where asks here: `resolve` to read blocks and calls and to say what is wrong
//! with them, `check` for the ranges that physics sets, `reference` to print all of it. The tables are data; adding a
//! field is adding a line.

mod camera;
mod colors;
mod field;
mod foreign;
mod function;
mod items;
mod library;
mod lights;
mod materials;
mod range;
mod render;
mod shapes;
mod textures;
mod types;
mod units;
mod words;

pub use colors::COLORS;
pub use field::{Field, Literal, Need};
pub use function::{Arg, Function, Takes, Times, Topic};
pub use range::Range;
pub use types::{NamedType, Type, quoted};
pub use units::{UNITS, Unit};
pub use words::{FORMS, Form, Place};

use field::field;
use std::collections::HashMap;
use std::sync::LazyLock;

/// A kind of block: `sphere { .. }`, `light sphere { .. }`.
#[derive(Debug)]
pub struct Block {
    /// The words before the brace.
    pub kind: &'static str,
    /// Where it belongs.
    pub area: Area,
    /// What it is, in one sentence.
    pub doc: &'static str,
    /// A whole one.
    pub example: &'static str,
    /// Its own fields; [`Block::fields`] adds those that all objects have.
    own: &'static [Field],
    /// Which of its fields exclude one another.
    pub choices: &'static [Choice],
}

/// The parts of the language.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[expect(missing_docs, reason = "each is its word")]
pub enum Area {
    Item,
    Shape,
    Material,
    Texture,
    Light,
    Camera,
    Render,
}

impl Area {
    /// All of them, in the order of the reference.
    pub const ALL: [Self; 7] =
        [Self::Item, Self::Camera, Self::Light, Self::Shape, Self::Material, Self::Texture, Self::Render];

    /// What stands above its blocks.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Item => "items",
            Self::Shape => "objects",
            Self::Material => "materials",
            Self::Texture => "textures and projections",
            Self::Light => "lights",
            Self::Camera => "lenses and film",
            Self::Render => "settings of the renderer",
        }
    }

    /// How a report calls a block of this area.
    pub const fn noun(self) -> &'static str {
        match self {
            Self::Item => "an item",
            Self::Shape => "an object",
            Self::Material => "a material",
            Self::Texture => "a texture",
            Self::Light => "a light",
            Self::Camera => "part of a camera",
            Self::Render => "a setting of the renderer",
        }
    }
}

/// Fields that say the same thing in different ways, of which one is taken.
#[derive(Debug)]
pub struct Choice {
    /// The ways, each the fields that make it up; those with a default may be left out of it.
    pub ways: &'static [&'static [&'static str]],
    /// Whether one of them has to be taken.
    pub required: bool,
}

/// One of these ways has to be taken.
const fn one_of(ways: &'static [&'static [&'static str]]) -> Choice {
    Choice { ways, required: true }
}

/// At most one of these ways is taken.
const fn at_most_one_of(ways: &'static [&'static [&'static str]]) -> Choice {
    Choice { ways, required: false }
}

impl Block {
    const fn choosing(self, choices: &'static [Choice]) -> Self {
        Self { choices, ..self }
    }

    /// Its fields in the order of the reference, with those that every object has.
    pub fn fields(&self) -> impl Iterator<Item = &'static Field> + use<> {
        let common: &[Field] = if self.is_object() { shapes::COMMON } else { &[] };
        self.own.iter().chain(common)
    }

    /// The field of this name.
    pub fn field(&self, name: &str) -> Option<&'static Field> {
        self.fields().find(|field| field.name == name)
    }

    /// The position of a field in [`Block::fields`].
    pub fn position(&self, name: &str) -> Option<usize> {
        self.fields().position(|field| field.name == name)
    }

    /// The number of its fields.
    pub fn field_count(&self) -> usize {
        self.own.len() + if self.is_object() { shapes::COMMON.len() } else { 0 }
    }

    /// Whether it takes what every object takes: `transform` and `material`.
    fn is_object(&self) -> bool {
        self.area == Area::Shape
    }

    /// Whether items may stand in it beside fields.
    pub fn holds_items(&self) -> bool {
        self.kind == "group"
    }
}

/// Every block of the language, area by area.
pub fn blocks() -> impl Iterator<Item = &'static Block> {
    [
        items::BLOCKS,
        camera::BLOCKS,
        lights::BLOCKS,
        shapes::BLOCKS,
        materials::BLOCKS,
        textures::BLOCKS,
        render::BLOCKS,
    ]
    .into_iter()
    .flatten()
}

/// The block of this kind; the kind of a light has both its words.
pub fn block(kind: &str) -> Option<&'static Block> {
    static BY_KIND: LazyLock<HashMap<&str, &Block>> =
        LazyLock::new(|| blocks().map(|block| (block.kind, block)).collect());
    BY_KIND.get(kind).copied()
}

/// Every function of the language, topic by topic.
pub fn functions() -> impl Iterator<Item = &'static Function> + Clone {
    library::FUNCTIONS.iter()
}

/// The unit of this name.
pub fn unit(name: &str) -> Option<&'static Unit> {
    UNITS.iter().find(|unit| unit.name == name)
}

/// What other renderers, or other spellings of English, call a field of this one.
pub fn foreign_field(name: &str) -> Option<&'static str> {
    let ours = match name {
        "colour" | "kd" | "Kd" | "albedo" | "reflectance" | "diffuse_color" | "base_color" => "color",
        "ks" | "Ks" | "specular_color" => "specular",
        "diffuseColor" => "diffuse",
        "r" | "rad" => "radius",
        "centre" | "pos" | "location" | "origin" => "center",
        "eye" | "from" => "position",
        "target" | "lookat" | "look" | "to" | "at" => "look_at",
        "angle" | "fovy" | "field_of_view" => "fov",
        "translate" | "rotate" | "scale" | "rotation" | "matrix" => "transform",
        "index" | "refraction" | "eta" | "n" | "refractive_index" => "ior",
        "exponent" | "phong_exponent" | "glossiness" => "shininess",
        "filename" | "path" | "src" | "obj_file" => "file",
        "intensity" | "brightness" | "strength" | "watts" => "power",
        "emission" | "emit" | "L" => "radiance",
        "texture" | "pigment" | "finish" | "bsdf" | "shader" => "material",
        "resolution" | "width" | "height" => "size",
        "samples" | "spp" => "stop",
        "max_depth" | "bounces" | "max_bounces" => "depth",
        "f_stop" | "fstop" => "aperture",
        "focal_distance" | "focus_distance" => "focus",
        _ => return None,
    };
    Some(ours)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_block_and_field_is_declared_once_and_documented() {
        for (i, block) in blocks().enumerate() {
            assert!(block.doc.ends_with('.'), "`{}` lacks its sentence", block.kind);
            assert!(!blocks().skip(i + 1).any(|other| other.kind == block.kind), "`{}` twice", block.kind);
            for (j, field) in block.fields().enumerate() {
                assert!(field.doc.ends_with('.'), "`{}.{}` lacks its sentence", block.kind, field.name);
                assert_eq!(block.position(field.name), Some(j), "`{}.{}` twice", block.kind, field.name);
                assert!(!field.example().is_empty());
            }
        }
    }

    #[test]
    fn defaults_lie_in_their_ranges_and_can_be_written() {
        for field in blocks().flat_map(Block::fields) {
            if let (Need::Default(Literal::Number(value)), Some(range)) = (field.need, field.range) {
                assert!(range.contains(value), "default of `{}`", field.name);
            }
            assert_eq!(field.default_text().is_some(), matches!(field.need, Need::Default(_)));
        }
        let fov = block("camera").and_then(|camera| camera.field("fov_x")).expect("declared");
        assert_eq!(fov.ty.write(std::f64::consts::FRAC_PI_4), "45deg");
    }

    #[test]
    fn examples_hold_what_is_required() {
        for block in blocks() {
            for field in block.fields().filter(|field| field.need == Need::Required) {
                let written = block.example.contains(&format!("{}:", field.name));
                assert!(written, "the example of `{}` leaves out `{}`", block.kind, field.name);
            }
        }
    }
}
