//! The registry: every block of the language and every field in it, declared once.
//!
//! Whoever needs to know what may stand between which braces asks here: `resolve` to read blocks and to say what is
//! wrong with them, `check` for the ranges that physics sets, and whatever prints a reference of the language. The
//! tables are data; adding a field is adding a line.

mod camera;
mod items;
mod lights;
mod materials;
mod range;
mod render;
mod shapes;
mod textures;
mod types;

pub use range::Range;
pub use types::{Type, quoted};

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

/// A field of a block.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// The word before the colon.
    pub name: &'static str,
    /// What may stand after it.
    pub ty: Type,
    /// What happens without it.
    pub need: Need,
    /// Which values make sense, in SI units.
    pub range: Option<Range>,
    /// What it is, in one sentence.
    pub doc: &'static str,
    /// A value that could stand there, where the type's own example would mislead.
    sample: Option<&'static str>,
}

/// What happens when a field is left out.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Need {
    /// That is a mistake.
    Required,
    /// Nothing stands in for it, or the block's documentation says what does.
    Optional,
    /// This stands in for it.
    Default(Literal),
}

/// A default, in SI units.
#[derive(Clone, Copy, PartialEq, Debug)]
#[expect(missing_docs, reason = "each is its type")]
pub enum Literal {
    Number(f64),
    Word(&'static str),
    Bool(bool),
    Triple([f64; 3]),
    Pair([u32; 2]),
}

/// A field that may be left out, with nothing in its place.
const fn field(name: &'static str, ty: Type, doc: &'static str) -> Field {
    Field { name, ty, need: Need::Optional, range: None, doc, sample: None }
}

impl Field {
    const fn required(self) -> Self {
        Self { need: Need::Required, ..self }
    }

    /// A default number, in SI units.
    const fn or(self, value: f64) -> Self {
        Self { need: Need::Default(Literal::Number(value)), ..self }
    }

    const fn or_word(self, word: &'static str) -> Self {
        Self { need: Need::Default(Literal::Word(word)), ..self }
    }

    const fn or_bool(self, value: bool) -> Self {
        Self { need: Need::Default(Literal::Bool(value)), ..self }
    }

    const fn or_triple(self, x: f64, y: f64, z: f64) -> Self {
        Self { need: Need::Default(Literal::Triple([x, y, z])), ..self }
    }

    const fn or_size(self, width: u32, height: u32) -> Self {
        Self { need: Need::Default(Literal::Pair([width, height])), ..self }
    }

    const fn within(self, range: Range) -> Self {
        Self { range: Some(range), ..self }
    }

    const fn like(self, sample: &'static str) -> Self {
        Self { sample: Some(sample), ..self }
    }

    /// A value that could stand there: `30cm`.
    pub fn example(&self) -> &'static str {
        self.sample.unwrap_or_else(|| self.ty.example())
    }

    /// The default as it would be written.
    pub fn default_text(&self) -> Option<String> {
        let Need::Default(literal) = self.need else { return None };
        Some(match literal {
            Literal::Number(value) => self.ty.write(value),
            Literal::Word(word) => word.to_owned(),
            Literal::Bool(value) => value.to_string(),
            Literal::Triple([x, y, z]) => {
                format!("({}, {}, {})", self.ty.write(x), self.ty.write(y), self.ty.write(z))
            }
            Literal::Pair([width, height]) => format!("{width} x {height}"),
        })
    }
}

impl Block {
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
    blocks().find(|block| block.kind == kind)
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
        "texture" | "bsdf" | "shader" => "material",
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
