//! Materials whose block name is their kind: `ReflectiveMaterial { .. }`, `Lambert { .. }`, `GGX { .. }`.

use super::colors::{exponent_of, fitted_phong};
use super::lobes::mixed;
use super::{USUAL_INDEX, frosted, shiny};
use crate::convert::fields::{Field, Fields};
use crate::convert::model::{Look, Texture};
use crate::convert::parse::Block;
use crate::convert::read::Reader;
use crate::convert::words::{MATERIAL, blocks};
use crate::math::DVec3;

impl Reader<'_> {
    pub(super) fn typed_look(
        &mut self,
        block: Block<'_>,
        kind: blocks::Material,
        notes: &mut Vec<String>,
    ) -> Look {
        let mut fields = self.log.fields(block, &MATERIAL);
        self.log.mapped(&fields.head, "a material");
        let look = match kind {
            blocks::Material::Mirror | blocks::Material::Metal => {
                let color = self.tint(&mut fields, &["color", "mirror", "specular", "glass"]);
                let roughness = self.roughness(&mut fields);
                shiny(color, roughness)
            }
            blocks::Material::Glass => {
                let color = self.tint(&mut fields, &["color", "glass", "specular", "mirror"]);
                let index = self.index(&mut fields, &["index", "refr", "refraction"]).unwrap_or(USUAL_INDEX);
                let roughness = self.roughness(&mut fields);
                frosted(index, color, roughness)
            }
            blocks::Material::Light => return self.lamp(fields, notes),
            blocks::Material::Glossy => self.glossy_look(&mut fields, notes),
            _ => Look::Diffuse { color: Texture::plain(self.one_color(&mut fields)) },
        };
        self.finish_look(look, fields, notes)
    }

    /// The first of several colours; numbers under these names are shares, which such a block needs none of.
    fn tint(&mut self, fields: &mut Fields<'_>, roles: &[&str]) -> DVec3 {
        let mut tint = None;
        for role in roles {
            let Some(field) = self.log.take(fields, role) else { continue };
            if field.is_vector() && tint.is_none() {
                self.log.mapped(&field.span, "colour");
                tint = Some(self.reflectance(&field));
            } else {
                self.log.dropped(&field.span, "its kind and colour are said already");
            }
        }
        tint.unwrap_or(DVec3::ONE)
    }

    /// A block of light: its emission has whatever name a colour can have.
    fn lamp(&mut self, mut fields: Fields<'_>, notes: &mut Vec<String>) -> Look {
        let mut radiance = self.emission(&mut fields).map(|(radiance, _)| radiance);
        for role in ["specular", "color"] {
            if let Some(field) = self.log.take(&mut fields, role) {
                if radiance.is_none() {
                    self.log.mapped(&field.span, "`emissive` radiance");
                    radiance = Some(field.vector().max(DVec3::ZERO));
                } else {
                    self.log.dropped(&field.span, "a lamp reflects nothing here");
                }
            }
        }
        let mut look = Look::Emissive { radiance: radiance.unwrap_or(DVec3::ONE) };
        self.dress(&mut look, &mut fields, notes);
        self.log.finish(fields);
        look
    }

    /// A glossy coat over a matt base, and as much metal as `metallic` says.
    pub(super) fn glossy_look(&mut self, fields: &mut Fields<'_>, notes: &mut Vec<String>) -> Look {
        let metallic =
            self.log.number(fields, "metallic", "the share of metal").map_or(0.0, |it| it.clamp(0.0, 1.0));
        let weights =
            [["diffuse", "diffuse factor"], ["specular or share", "specular factor"]].map(|roles| {
                let mut share = |role| self.log.take_where(fields, role, Field::is_share);
                share(roles[0]).or_else(|| share(roles[1])).map(|field| {
                    self.log.approximated(&field.span, "a factor of its colour");
                    field.number(0).clamp(0.0, 1.0)
                })
            });
        let color = self.one_color(fields);
        let tint = self.log.take(fields, "specular").map(|field| {
            self.log.approximated(&field.span, "the colour of a `phong` highlight");
            self.reflectance(&field)
        });
        let specular = match (tint, weights[1]) {
            (Some(tint), weight) => tint * weight.unwrap_or(1.0),
            (None, Some(weight)) => DVec3::splat(weight),
            (None, None) => DVec3::splat(0.04), // of plastic
        };
        let shininess = self.log.number(fields, "shininess", "`shininess`");
        let roughness = self.roughness(fields);
        let exponent = shininess.unwrap_or_else(|| exponent_of(roughness.max(0.1))).clamp(0.0, 1e5);
        let diffuse = Texture::plain(color * weights[0].unwrap_or(1.0));
        let coat = match shininess {
            Some(_) if weights[1].is_none() => fitted_phong(diffuse, specular, exponent, notes),
            _ => {
                let room = DVec3::ONE - diffuse.color;
                Look::Phong { specular: specular.min(room), diffuse, shininess: exponent }
            }
        };
        let metal = shiny(color, roughness.max(0.05));
        mixed(vec![(1.0 - metallic, coat), (metallic, metal)])
    }
}
