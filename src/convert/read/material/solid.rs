//! Solid textures of MIT's edition of 2004: two materials, blended by a function of space.

use crate::convert::fields::{Field, Part};
use crate::convert::mistake::Mistake;
use crate::convert::model::{Look, Texture};
use crate::convert::parse::{Block, Span};
use crate::convert::read::Reader;
use crate::convert::words::blocks::Solid;
use crate::convert::words::{SOLID, TRANSFORM};

/// The most blends inside one another; looking through them takes time that doubles with each.
const MOST_BLENDS: usize = 8;

impl Reader<'_> {
    /// `Checkerboard { [Transform { .. }] materialIndex i materialIndex j }`, and its relatives with noise.
    ///
    /// Cells are as wide as 1 in the space that the transform leads to. Noise, marble and wood are blended evenly, as
    /// on the average.
    pub(super) fn solid_look(&mut self, block: Block<'_>, solid: Solid, notes: &mut Vec<String>) -> Look {
        let (name, head) = (block.name().to_string(), block.head.clone());
        let (mut indices, mut scale, mut size) = (Vec::new(), 1.0, 1.0);
        for part in self.log.parts(block.body, &SOLID) {
            match part {
                Part::Field(field) if field.role == "material" => indices.extend(self.part_index(&field)),
                Part::Field(field) if field.role == "size" && field.sound => {
                    self.log.mapped(&field.span, "`size` of the cells");
                    size = field.number(0);
                }
                Part::Field(field) => self.log.dropped(&field.span, "an even blend stands in"),
                Part::Block(block) if block.name() == "Transform" => scale = self.scale_of(block),
                Part::Block(block) => self.log.unknown_block(&block, format!("in `{name}`"), &["Transform"]),
            }
        }
        let [first, second] = indices[..] else {
            self.log.approximated(&head, "a grey placeholder");
            self.log.notes.note(Mistake::MissingField {
                block: name,
                field: "materialIndex",
                at: head.into(),
                help: "write two of them, of materials further up".into(),
            });
            return Look::Placeholder;
        };
        let cells = (size / scale).abs();
        let is_sound = (1e-6..1e9).contains(&cells);
        match solid {
            Solid::Checkerboard if is_sound => {
                self.log.approximated(&head, "`mix` by a `checker` in the object's own space");
                Look::Solid { parts: [first, second], cells: Some(cells) }
            }
            _ => {
                self.log.approximated(&head, "an even `mix` of the two materials");
                self.note_not_read(format!("the solid texture `{name}`"), &head, "an even blend stands in");
                notes.push(format!("The original blends the two by a solid `{name}`; here it is even."));
                Look::Solid { parts: [first, second], cells: None }
            }
        }
    }

    /// An index of a material further up.
    fn part_index(&mut self, field: &Field<'_>) -> Option<usize> {
        self.log.mapped(&field.span, "one of the two materials");
        let (index, count) = (field.number(0).trunc() as i64, self.materials.len());
        let valid = usize::try_from(index).ok().filter(|index| *index < count && field.sound);
        let Some(index) = valid else {
            self.log.dropped(&field.span, "no material further up");
            let at = field.span.clone().into();
            self.log.notes.note(Mistake::IndexOutOfRange { index, count, at });
            return None;
        };
        let why = match &self.materials[index].look {
            Look::Emissive { .. } => "a surface that shines in places only",
            _ if self.depth_of_blends(index) >= MOST_BLENDS => "so many blends of blends",
            _ => return Some(index),
        };
        self.log.dropped(&field.span, "no material that can be blended");
        self.log.not_convertible("this part of a solid texture", &field.span, why);
        None
    }

    /// How many blends are inside one another in a material; a plain one has none. Blends refer backwards only.
    fn depth_of_blends(&self, index: usize) -> usize {
        let parts = self.materials[index].look.parts();
        parts.map(|part| 1 + self.depth_of_blends(part)).max().unwrap_or(0)
    }

    /// How many times the transform of a texture magnifies; all else about it is lost.
    fn scale_of(&mut self, block: Block<'_>) -> f64 {
        self.log.approximated(&block.head, "its scale, as the size of the cells");
        let mut scale = 1.0;
        for part in self.log.parts(block.body, &TRANSFORM) {
            match part {
                Part::Field(field) if ["UniformScale", "Scale"].contains(&field.role) && field.sound => {
                    self.log.approximated(&field.span, "the size of the cells");
                    scale *= field.number(0);
                }
                Part::Field(field) => self.log.dropped(&field.span, "a texture keeps its place here"),
                Part::Block(block) => {
                    self.log.unknown_block(&block, "in a `Transform` of a texture".into(), &[])
                }
            }
        }
        scale
    }

    /// `Noise { color V color V .. }` inside a material: the mean of the two colours.
    pub(super) fn noise_inside(&mut self, block: Block<'_>, look: &mut Look, notes: &mut Vec<String>) {
        let head: Span = block.head.clone();
        self.log.approximated(&head, "the mean of its two colours");
        self.note_not_read("noise in a material", &head, "the mean of its two colours stands in");
        let mut colors = Vec::new();
        for part in self.log.parts(block.body, &SOLID) {
            match part {
                Part::Field(field) if field.role == "color" && field.sound => {
                    self.log.approximated(&field.span, "half of the mean colour");
                    colors.push(self.reflectance(&field));
                }
                Part::Field(field) => self.log.dropped(&field.span, "the mean of the colours stands in"),
                Part::Block(block) => self.log.unknown_block(&block, "in `Noise`".into(), &[]),
            }
        }
        let [first, second] = colors[..] else { return };
        notes.push(
            "The original's diffuse colour is noise between two colours; here it is their mean.".into(),
        );
        if let Some(texture) = look.textures().into_iter().next() {
            let room = texture.color.max_element().max(1e-6);
            *texture = Texture::plain((first + second) * 0.5 * room.min(1.0));
        }
    }
}
