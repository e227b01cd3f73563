//! Materials of the dialects that name their lobes: by weights, by bare words, or by the block's own name.

use super::{Dialect, Reader, vocab};
use crate::convert::fields::Fields;
use crate::convert::model::{Look, Material, Texture};
use crate::convert::parse::Block;
use crate::math::DVec3;

/// The index of refraction of glass where a file does not say it.
const USUAL_INDEX: f64 = 1.5;

/// The keys of one program's weights: diffuse, mirror and glass, and the index of refraction.
const FACTORS: &[([&str; 3], &str)] = &[
    (["diff", "refl", "refr"], "n"),
    (["diff_factor", "spec_factor", "refr_factor"], "n"),
    (["w_diffusion", "w_reflection", "w_transmission"], "ref_index"),
    (["diffuseRate", "specularRate", "refractRate"], "refractIndex"),
    (["perDiffuse", "perReflect", "perRefract"], "refractRate"),
    (["diffidx", "reflidx", "refridx"], "refrN"),
];

/// Materials that one program knows by name, with their weights; its glass has the index [`PROP_INDEX`].
const PROPS: &[(&str, [f64; 3])] = &[
    ("Matte", [1.0, 0.0, 0.0]),
    ("Mirror", [0.0, 1.0, 0.0]),
    ("Glass", [0.0, 0.0, 1.0]),
    ("DiffLight", [1.0, 0.0, 0.0]),
    ("Light", [1.0, 0.0, 0.0]),
    ("China", [0.8, 0.2, 0.0]),
    ("Photo", [0.8, 0.2, 0.0]),
    ("Apple", [0.99, 0.1, 0.0]),
    ("Marble", [0.9, 0.1, 0.0]),
    ("Cobble", [0.7, 0.3, 0.0]),
];

/// See [`PROPS`].
const PROP_INDEX: f64 = 1.65;

/// What a typed block is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Diffuse,
    Mirror,
    Metal,
    Glass,
    Light,
}

/// Typed blocks: their kind, the keys that may hold their colour, and those of one number: the index of refraction of
/// glass, the spread of a metal's reflection.
const TYPED: &[(&str, Kind, &[&str], &[&str])] = &[
    ("Lambert", Kind::Diffuse, &["diffuseColor", "color"], &[]),
    ("LambertMaterial", Kind::Diffuse, &["color"], &[]),
    ("DiffuseMaterial", Kind::Diffuse, &["attenuation"], &[]),
    ("Reflective", Kind::Mirror, &["specularColor"], &[]),
    ("ReflectiveMaterial", Kind::Mirror, &["attenuationColor", "transmittance"], &[]),
    ("MirrorMaterial", Kind::Mirror, &["color"], &[]),
    ("Metal", Kind::Metal, &["color"], &["fuzziness"]),
    ("MetalMaterial", Kind::Metal, &["attenuation"], &["fuzz"]),
    ("Glass", Kind::Glass, &["transmissiveColor"], &["refractionIndex"]),
    ("Dielectric", Kind::Glass, &["color"], &["refractionIndex"]),
    ("DielecMaterial", Kind::Glass, &["attenuation"], &["refractive"]),
    ("TransparentMaterial", Kind::Glass, &["color"], &["index"]),
    (
        "RefractiveMaterial",
        Kind::Glass,
        &["attenuationColor", "transmittance"],
        &["refractiveIndex", "refractive_index", "n"],
    ),
    ("Emissive", Kind::Light, &["color"], &[]),
    ("EmissiveMaterial", Kind::Light, &["emissionColor"], &[]),
    ("LightMaterial", Kind::Light, &["specularColor", "lightColor"], &[]),
];

impl Reader<'_> {
    /// One number for each lobe, under the names that one of several programs gives them.
    pub(super) fn factors_material(&mut self, mut fields: Fields<'_>) -> Material {
        let Some((keys, index_key)) = FACTORS.iter().find(|(keys, _)| keys.iter().any(|key| fields.has(key)))
        else {
            return self.unread_material(fields, Dialect::Factors);
        };
        self.log.mapped(&fields.head, "a material");
        let weights = keys.map(|key| {
            let field = self.log.take(&mut fields, key)?;
            self.log.mapped(&field.span, "the share of a lobe");
            Some(field.number(0).max(0.0))
        });
        let sum: f64 = weights.iter().flatten().sum();
        let weights =
            if sum > 0.0 { weights.map(|weight| weight.unwrap_or(0.0) / sum) } else { [1.0, 0.0, 0.0] };
        let index = self.index(&mut fields, &[index_key]).unwrap_or(USUAL_INDEX);
        self.weighted(fields, weights, index)
    }

    /// `DIFF`, `SPEC` or `REFR` as a word of its own, or the name of a material after `prop`.
    pub(super) fn flags_material(&mut self, mut fields: Fields<'_>) -> Material {
        self.log.mapped(&fields.head, "a material");
        let mut weights = [1.0, 0.0, 0.0];
        for (lobe, flag) in ["DIFF", "SPEC", "REFR"].into_iter().enumerate() {
            if let Some(field) = self.log.take(&mut fields, flag) {
                self.log.mapped(&field.span, ["`diffuse`", "`mirror`", "`glass`"][lobe]);
                weights = [0.0; 3];
                weights[lobe] = 1.0;
            }
        }
        let mut usual_index = USUAL_INDEX;
        if let Some(prop) = self.log.take(&mut fields, "prop") {
            let name = prop.word.as_ref().map_or("", |word| word.text);
            match PROPS.iter().find(|(known, _)| *known == name) {
                Some((_, known)) => {
                    let sum: f64 = known.iter().sum();
                    weights = known.map(|weight| weight / sum);
                    usual_index = PROP_INDEX;
                    self.log.approximated(&prop.span, "the weights that the program gives this name");
                }
                None => {
                    self.log.dropped(&prop.span, "an unknown name, taken as diffuse");
                    self.note_not_read("this name of a material".into(), &prop.span, "taken as diffuse");
                }
            }
        }
        let index = self.index(&mut fields, &["N"]).unwrap_or(usual_index);
        self.weighted(fields, weights, index)
    }

    /// A block whose name says what the material is; blocks that are not read come back.
    pub(super) fn typed_material<'t>(&mut self, block: Block<'t>) -> Result<Material, Block<'t>> {
        let Some((_, kind, color_keys, number_keys)) = TYPED.iter().find(|row| row.0 == block.name()) else {
            return Err(block);
        };
        let mut fields = self.log.fields(block, vocab::TYPED_MATERIAL);
        self.log.mapped(&fields.head, "a material");
        let color = color_keys.iter().find_map(|key| self.log.take(&mut fields, key));
        let number = number_keys.iter().find_map(|key| {
            let field = self.log.take(&mut fields, key)?;
            self.log.mapped(
                &field.span,
                if *kind == Kind::Glass { "`ior`" } else { "`roughness`, its square root" },
            );
            Some(field.number(0))
        });
        let tint = match &color {
            Some(field) if *kind == Kind::Light => field.vector().max(DVec3::ZERO),
            Some(field) => self.reflectance(field),
            None => DVec3::ONE,
        };
        let mut look = match kind {
            Kind::Diffuse => Look::Diffuse { color: Texture::plain(tint) },
            Kind::Mirror => Look::Mirror { color: Texture::plain(tint) },
            // The original spreads the reflection over a ball of this radius, about as wide as a GGX lobe of this alpha.
            Kind::Metal => match number.unwrap_or(0.0).clamp(0.0, 1.0) {
                0.0 => Look::Mirror { color: Texture::plain(tint) },
                spread => Look::Metal { color: tint, roughness: spread.sqrt() },
            },
            Kind::Glass => Look::Glass { ior: number.unwrap_or(USUAL_INDEX).max(1.0), tint },
            Kind::Light => Look::Emissive { radiance: tint },
        };
        if let Some(field) = color {
            self.log.mapped(&field.span, if *kind == Kind::Light { "`emissive` radiance" } else { "colour" });
        }
        self.dress(&mut look, &mut fields);
        self.log.finish(fields);
        Ok(super::material::material(look, Vec::new()))
    }
}
