//! Materials, each by the rules of its own dialect.

mod colors;
mod dress;
mod fresnel;
mod lobes;
mod solid;
mod typed;

use super::{Dialect, Reader};
use crate::convert::dialect;
use crate::convert::fields::{Field, Fields, Part};
use crate::convert::model::{Look, Material, Texture};
use crate::convert::parse::{Block, Span};
use crate::convert::words::{MATERIAL, MATERIALS, blocks};
use crate::math::DVec3;

/// Names of blocks whose fields alone tell what they are.
const USUAL_NAMES: &[&str] = &["Material", "PhongMaterial", "GenericMaterial"];

/// The index of refraction of glass where a file does not say it.
const USUAL_INDEX: f64 = 1.5;

impl Reader<'_> {
    /// `Materials { numMaterials n .. }`. A block that is not read keeps its index as a placeholder.
    pub(super) fn materials(&mut self, block: Block<'_>) -> Vec<Material> {
        self.log.mapped(&block.head, "`let` bindings");
        let mut counts = Vec::new();
        for part in self.log.parts(block.body, &MATERIALS) {
            match part {
                Part::Field(field) if field.role == "count" => counts.push(field),
                Part::Field(field) => self.log.unknown_field(&field, "Materials", &MATERIALS),
                Part::Block(block) => {
                    let material = self.material(block);
                    self.materials.push(material); // solid textures refer to those before them
                }
            }
        }
        for count in counts {
            self.log.check_count(&count, self.materials.len());
        }
        std::mem::take(&mut self.materials)
    }

    pub(super) fn material(&mut self, block: Block<'_>) -> Material {
        let span = block.span.clone();
        let mut notes = Vec::new();
        let look = self.look(block, &mut notes);
        Material { span, look, notes }
    }

    fn look(&mut self, block: Block<'_>, notes: &mut Vec<String>) -> Look {
        let name = block.name().to_string();
        let Some(kind) = blocks::material(&name) else {
            self.guess_block(&name, "a material, by its fields", &block.head);
            return self.plain_look(block, notes);
        };
        if kind == blocks::Material::Plain && !USUAL_NAMES.contains(&name.as_str()) {
            self.guess_block(&name, "a material, by its fields", &block.head);
        }
        match kind {
            blocks::Material::Plain => self.plain_look(block, notes),
            blocks::Material::Solid(solid) => self.solid_look(block, solid, notes),
            typed => self.typed_look(block, typed, notes),
        }
    }

    /// A material whose fields tell what it is.
    fn plain_look(&mut self, block: Block<'_>, notes: &mut Vec<String>) -> Look {
        let told = dialect::of_material(&block).map(|(dialect, _)| dialect);
        let dialect = match self.options.dialect {
            Some(forced) => forced,
            // Editions with mirrors and glass reflect and refract by the specular colour, which the course's does not.
            None if self.dialect.is_mit() || self.dialect == Dialect::Implied => self.dialect,
            None => told.unwrap_or(self.dialect),
        };
        let mut fields = self.log.fields(block, &MATERIAL);
        self.log.mapped(&fields.head, "a material");
        let has_factors = ["diffuse factor", "specular factor"].iter().any(|role| fields.has(role));
        let look = if dialect == Dialect::Arsenal {
            self.arsenal_look(&mut fields, notes)
        } else if let Some(lobes) = self.lobes_of_fresnel(&mut fields) {
            self.lobed_look(&mut fields, lobes, dialect)
        } else if has_factors {
            self.glossy_look(&mut fields, notes)
        } else if let Some(lobes) = self.lobes(&mut fields) {
            self.lobed_look(&mut fields, lobes, dialect)
        } else {
            self.colored_look(&mut fields, dialect, notes)
        };
        self.finish_look(look, fields, notes)
    }

    /// Light, pictures, and what is left over, as with every kind of material.
    fn finish_look(&mut self, mut look: Look, mut fields: Fields<'_>, notes: &mut Vec<String>) -> Look {
        let lamp = self.emission(&mut fields);
        if let Some((radiance, _)) = lamp {
            look = Look::Emissive { radiance };
        }
        self.dress(&mut look, &mut fields, notes);
        if let Some((_, span)) = lamp {
            self.log.lose(&fields.span, "a lamp reflects nothing here");
            self.log.mapped(&fields.head, "a material");
            self.log.mapped(&span, "`emissive` radiance");
            notes.clear();
        }
        let aside = "has no counterpart in the scene language";
        self.log.put_aside(&mut fields, &["aside"], aside);
        let ambient = "part of the ambient light, for which an environment stands";
        self.log.put_aside(&mut fields, &["ambient"], ambient);
        self.log.finish(fields);
        look
    }

    /// A material of `arsenal.txt`: one of a matt surface, a mirror and glass, tinted by `color`; or a lamp.
    fn arsenal_look(&mut self, fields: &mut Fields<'_>, notes: &mut Vec<String>) -> Look {
        let color = self.one_color(fields);
        let kind = self.log.take(fields, "reflection");
        let shininess = self.log.take(fields, "shininess");
        if let Some(texture) = self.log.take(fields, "texture") {
            self.log.ignored(&texture.span, "the original reads it and shows no picture");
        }
        let kind_number = kind.as_ref().map_or(0.0, |field| field.number(0));
        if let Some(kind) = &kind {
            self.log.mapped(&kind.span, "the kind of material: 0 diffuse, 1 mirror, 2 glass of index 1.5");
            if ![0.0, 1.0, 2.0].contains(&kind_number) {
                self.log.bad_value(
                    "`reflection` is 0, 1 or 2 in this dialect",
                    &kind.span,
                    "it was taken as diffuse; a share of light instead belongs to `--dialect factors`",
                );
            }
        }
        let look = match kind_number {
            1.0 => Look::Mirror { color: Texture::plain(color) },
            // The original's glass has one index, and Schlick's approximation with R0 = 0.04, that of 1.5.
            2.0 => clear(USUAL_INDEX, color),
            _ => Look::Diffuse { color: Texture::plain(color) },
        };
        match shininess {
            Some(field) => self.arsenal_highlight(look, &field, notes),
            None => look,
        }
    }

    fn arsenal_highlight(&mut self, look: Look, field: &Field<'_>, notes: &mut Vec<String>) -> Look {
        let shininess = field.number(0).min(1e5);
        match look {
            Look::Diffuse { color } if shininess > 0.0 => {
                self.log.approximated(&field.span, "`phong` with 0.3 of the colour as its highlight");
                notes.push(
                    "The original adds 0.3 of the colour as a highlight of each lamp, even where the lamp is hidden."
                        .into(),
                );
                let specular = 0.3 * color.color;
                Look::Phong { diffuse: color, specular, shininess }
            }
            look if shininess > 0.0 => {
                self.log.dropped(&field.span, "a highlight on a surface that is not diffuse");
                look
            }
            look => {
                self.log.mapped(&field.span, "no highlight");
                look
            }
        }
    }

    /// The colour of a surface, white where none is said.
    fn one_color(&mut self, fields: &mut Fields<'_>) -> DVec3 {
        let diffuse = fields.peek_where("diffuse", Field::is_vector).is_some();
        let field = match self.log.take(fields, "color") {
            None if diffuse => self.log.take_where(fields, "diffuse", Field::is_vector),
            field => field,
        };
        match field {
            Some(field) => {
                self.log.mapped(&field.span, "colour");
                self.reflectance(&field)
            }
            None => DVec3::ONE,
        }
    }

    /// A colour of a surface: each component in 0..=1, as no surface returns more than it receives.
    fn reflectance(&mut self, field: &Field<'_>) -> DVec3 {
        let color = field.vector();
        let clamped = color.clamp(DVec3::ZERO, DVec3::ONE);
        if clamped != color {
            self.log.differs(
                "this surface reflects more light than it receives, or less than none",
                &field.span,
                "the colour was brought into 0 to 1",
            );
        }
        clamped
    }

    /// Emitted light and where it is said, if there is any.
    fn emission(&mut self, fields: &mut Fields<'_>) -> Option<(DVec3, Span)> {
        let field = self.log.take(fields, "emission")?;
        let radiance = field.vector().max(DVec3::ZERO);
        if radiance == DVec3::ZERO {
            self.log.mapped(&field.span, "no light");
            return None;
        }
        self.log.mapped(&field.span, "`emissive` radiance");
        Some((radiance, field.span))
    }

    /// An index of refraction. Below 1 it is that of air in glass, which is taken as none.
    fn index(&mut self, fields: &mut Fields<'_>, roles: &[&str]) -> Option<f64> {
        let field = self.log.take_any(fields, roles)?;
        self.log.mapped(&field.span, "`ior`, where it refracts");
        Some(field.number(0))
    }

    /// How rough a mirror is, 0 if nothing says so.
    fn roughness(&mut self, fields: &mut Fields<'_>) -> f64 {
        let rough = self.log.take(fields, "roughness");
        let gloss = self.log.take(fields, "gloss");
        for field in [&rough, &gloss].into_iter().flatten() {
            self.log.approximated(&field.span, "`roughness`; programs spread light in different ways");
        }
        let value = match (rough, gloss) {
            (Some(field), _) => field.number(0),
            (None, Some(field)) => 1.0 - field.number(0),
            (None, None) => 0.0,
        };
        // A spread of this width is about that of a GGX lobe of this alpha, and alpha is the square of roughness.
        value.clamp(0.0, 1.0).sqrt()
    }
}

/// A mirror, or a metal where it is rough.
fn shiny(color: DVec3, roughness: f64) -> Look {
    match roughness {
        0.0 => Look::Mirror { color: Texture::plain(color) },
        roughness => Look::Metal { color: Texture::plain(color), roughness },
    }
}

/// Glass; an index below 1 cannot be said.
fn clear(index: f64, tint: DVec3) -> Look {
    frosted(index, tint, 0.0)
}

/// The same, frosted where it is rough.
fn frosted(index: f64, tint: DVec3, roughness: f64) -> Look {
    Look::Glass { ior: index.clamp(1.0, 1e3), tint, roughness }
}
