//! Materials of glTF: the metallic-roughness model with its extensions.

use super::json::At;
use super::texture::Textures;
use crate::asset::look::{GlassLook, Look, Map, MapChannel, PrincipledLook, Shade};
use crate::asset::model::{MeshError, ModelMaterial};
use crate::asset::report::{About, ImportReport};

/// The largest refractive index that there is a use for: it reflects a third.
const MOST_IOR: f32 = 4.0;
const PBR: &str = "pbrMetallicRoughness";
const SPECULAR_GLOSSINESS: &str = "KHR_materials_pbrSpecularGlossiness";
/// The extensions of materials that are used.
const USED: [&str; 8] = [
    "KHR_materials_clearcoat",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
];

/// A material, and the set of texture points that it looks up.
pub(super) struct Read {
    pub(super) material: ModelMaterial,
    pub(super) uv_set: u32,
}

/// All materials of a file; one that makes no sense is grey, and that is said.
pub(super) fn all<'a>(
    root: &At<'a>,
    textures: &mut Textures<'a, '_>,
    report: &mut ImportReport,
) -> Result<Vec<Read>, MeshError> {
    let mut out = Vec::new();
    for (index, at) in root.list("materials")?.iter().enumerate() {
        let name = at.name().map_or_else(|| format!("material {index}"), str::to_owned);
        textures.begin_material();
        let look = Reader { at, textures, report }.look().unwrap_or_else(|error| {
            report.left_out(About::Material, format!("the material `{name}`, as {error}"));
            Look::gray()
        });
        let material = ModelMaterial { name, look };
        out.push(Read { material, uv_set: textures.uv_set() });
    }
    Ok(out)
}

struct Reader<'r, 'a, 'b> {
    at: &'r At<'a>,
    textures: &'r mut Textures<'a, 'b>,
    report: &'r mut ImportReport,
}

/// What the terms of the model come to before they become one material.
struct Terms {
    color: Shade,
    alpha: Shade,
    metallic: Shade,
    roughness: Shade,
    ior: f32,
}

impl Reader<'_, '_, '_> {
    fn look(&mut self) -> Result<Look, MeshError> {
        self.extensions();
        let mut terms = match self.at.extension(SPECULAR_GLOSSINESS) {
            Some(old) => self.specular_glossiness(&old)?,
            None => self.metallic_roughness()?,
        };
        let base = match self.at.extension("KHR_materials_unlit") {
            Some(_) => {
                self.report.approximated(About::Material, "materials without lighting, by matt ones");
                Look::Diffuse { color: terms.color.clone() }
            }
            None => self.lit(&mut terms)?,
        };
        let base = self.with_normals(base)?;
        if self.at.get("occlusionTexture").is_some() {
            self.report.passed_over(About::Material, "pictures of occlusion, as shadows are simulated");
        }
        self.with_holes(base, terms.alpha)
    }

    /// Says which extensions are used, and which are not.
    fn extensions(&mut self) {
        for name in self.at.extensions() {
            match name {
                SPECULAR_GLOSSINESS => {
                    self.report.approximated(About::Material, format!("{name}, by metal and plastic"));
                }
                _ if USED.contains(&name) => self.report.used(About::Material, name),
                _ => self.report.ignored(About::Material, format!("{name} of materials")),
            }
        }
    }

    fn metallic_roughness(&mut self) -> Result<Terms, MeshError> {
        let empty = serde_json::Value::Null;
        let pbr = self.at.get(PBR).unwrap_or_else(|| At { value: &empty, path: PBR.to_owned() });
        let [r, g, b, alpha] = pbr.numbers::<4>("baseColorFactor")?.unwrap_or([1.0; 4]).map(|x| x as f32);
        let color = self.textures.map(&pbr, "baseColorTexture", self.report)?;
        let both = self.textures.map(&pbr, "metallicRoughnessTexture", self.report)?;
        let [r, g, b, alpha] = [r, g, b, alpha].map(|x| self.within(f64::from(x), 0.0, 1.0));
        let mut number = |name: &str| Ok(self.within(pbr.number(name)?.unwrap_or(1.0), 0.0, 1.0));
        Ok(Terms {
            alpha: Shade::number(alpha).times(color.as_ref().map(|map| map.only(MapChannel::Alpha))),
            color: Shade::color([r, g, b]).times(color),
            metallic: Shade::number(number("metallicFactor")?)
                .times(both.as_ref().map(|map| map.only(MapChannel::Blue))),
            roughness: Shade::number(number("roughnessFactor")?)
                .times(both.as_ref().map(|map| map.only(MapChannel::Green))),
            ior: 1.5,
        })
    }

    /// A number brought to where it has to be, which is told.
    fn within(&mut self, x: f64, least: f64, most: f64) -> f32 {
        if !(least..=most).contains(&x) {
            self.report.approximated(About::Material, "numbers beyond their range, by the nearest within");
        }
        x.clamp(least, most) as f32
    }

    /// What reflects much is metal of that colour, the rest plastic whose index gives that reflectance.
    fn specular_glossiness(&mut self, old: &At<'_>) -> Result<Terms, MeshError> {
        let [r, g, b, alpha] = old.numbers::<4>("diffuseFactor")?.unwrap_or([1.0; 4]).map(|x| x as f32);
        let specular = old.numbers::<3>("specularFactor")?.unwrap_or([1.0; 3]).map(|x| x as f32);
        let glossiness = old.number("glossinessFactor")?.unwrap_or(1.0) as f32;
        let color = self.textures.map(old, "diffuseTexture", self.report)?;
        if old.get("specularGlossinessTexture").is_some() {
            self.report.ignored(About::Material, "pictures of specular colour and glossiness");
        }
        let brightest = specular.iter().fold(0.0_f32, |most, x| most.max(*x));
        let is_metal = brightest > 0.25 && old.get("specularGlossinessTexture").is_none();
        let alpha = Shade::number(alpha).times(color.as_ref().map(|map| map.only(MapChannel::Alpha)));
        Ok(Terms {
            alpha,
            color: if is_metal { Shade::color(specular) } else { Shade::color([r, g, b]).times(color) },
            metallic: Shade::number(if is_metal { 1.0 } else { 0.0 }),
            roughness: Shade::number(1.0 - glossiness),
            ior: if is_metal { 1.5 } else { index_of(brightest.min(0.25)) },
        })
    }

    /// What is lit: glass where all of it is clear, else the whole model.
    fn lit(&mut self, terms: &mut Terms) -> Result<Look, MeshError> {
        let extension = |name: &str| self.at.extension(&format!("KHR_materials_{name}"));
        if let Some(ior) = extension("ior").map(|at| at.number("ior")).transpose()?.flatten() {
            // 0 stands for an index without end, which reflects everything.
            terms.ior = if ior == 0.0 { MOST_IOR } else { self.within(ior, 1.0, f64::from(MOST_IOR)) };
        }
        let (transmission, volume) = (extension("transmission"), extension("volume"));
        let (coat, dispersion) = (extension("clearcoat"), extension("dispersion"));
        let (emission, emission_map) = self.emission()?;
        self.specular(terms, transmission.is_some())?;
        let clear = match &transmission {
            Some(at) => {
                let factor = at.number("transmissionFactor")?.unwrap_or(0.0) as f32;
                let map = self.textures.map(at, "transmissionTexture", self.report)?;
                Shade::number(factor).times(map.map(|map| map.only(MapChannel::Red)))
            }
            None => Shade::number(0.0),
        };
        let thickness = volume.as_ref().map(|at| at.number("thicknessFactor")).transpose()?.flatten();
        let thin = thickness.unwrap_or(0.0) <= 0.0;
        let attenuation = volume.as_ref().filter(|_| !thin).map(attenuation).transpose()?.flatten();
        let abbe = dispersion.map(|at| at.number("dispersion")).transpose()?.flatten();
        let abbe = abbe.filter(|dispersion| *dispersion > 0.0 && !thin);

        let is_glass = clear.factor == [1.0; 3]
            && clear.map.is_none()
            && terms.metallic.is_black()
            && terms.color.map.is_none()
            && coat.is_none()
            && emission == [0.0; 3];
        if is_glass {
            return Ok(Look::Glass(GlassLook {
                ior: terms.ior,
                roughness: terms.roughness.clone(),
                tint: terms.color.factor,
                attenuation,
                // Twenty over Abbe's number (KHR_materials_dispersion).
                abbe: abbe.map(|dispersion| (20.0 / dispersion).clamp(5.0, 1000.0) as f32),
                thin,
            }));
        }
        if !clear.is_black() && thin {
            let text = "materials that are clear in part without thickness, by solid ones";
            self.report.approximated(About::Material, text);
        }
        if attenuation.is_some() || abbe.is_some() {
            let text = "what colours or spreads light inside of materials that are clear in part";
            self.report.ignored(About::Material, text);
        }
        let (clearcoat, clearcoat_roughness) = self.coat(coat.as_ref())?;
        Ok(Look::Principled(Box::new(PrincipledLook {
            color: terms.color.clone(),
            metallic: terms.metallic.clone(),
            roughness: terms.roughness.clone(),
            transmission: clear,
            ior: terms.ior,
            clearcoat,
            clearcoat_roughness,
            emission,
            emission_map,
        })))
    }

    fn coat(&mut self, coat: Option<&At<'_>>) -> Result<(Shade, Shade), MeshError> {
        let Some(at) = coat else { return Ok((Shade::number(0.0), Shade::number(0.0))) };
        if at.get("clearcoatNormalTexture").is_some() {
            self.report.ignored(About::Material, "normals of clear coats");
        }
        let mut shade = |name: &str, channel: MapChannel| {
            let factor = at.number(&format!("{name}Factor"))?.unwrap_or(0.0) as f32;
            let map = self.textures.map(at, &format!("{name}Texture"), self.report)?;
            Ok::<_, MeshError>(Shade::number(factor).times(map.map(|map| map.only(channel))))
        };
        Ok((shade("clearcoat", MapChannel::Red)?, shade("clearcoatRoughness", MapChannel::Green)?))
    }

    fn emission(&mut self) -> Result<([f32; 3], Option<Map>), MeshError> {
        let strength = self.at.extension("KHR_materials_emissive_strength");
        let strength = strength.map(|at| at.number("emissiveStrength")).transpose()?.flatten().unwrap_or(1.0);
        let factor = self.at.numbers::<3>("emissiveFactor")?.unwrap_or([0.0; 3]);
        if factor.iter().any(|x| *x < 0.0) || strength < 0.0 {
            self.report.approximated(About::Material, "light of less than nothing, by none");
        }
        let emission = factor.map(|x| (x * strength).max(0.0) as f32);
        if emission.iter().any(|x| !x.is_finite()) {
            return Err(self.at.wrong("shines beyond all numbers"));
        }
        if emission == [0.0; 3] || self.at.get("emissiveTexture").is_none() {
            return Ok((emission, None));
        }
        // A picture that cannot be read is told of, and leaves no light: it would shine all over.
        let map = self.textures.map(self.at, "emissiveTexture", self.report)?;
        Ok(if map.is_some() { (emission, map) } else { ([0.0; 3], None) })
    }

    /// A share of the reflectance, where it is the same everywhere and for all colours, is that of another index.
    fn specular(&mut self, terms: &mut Terms, is_clear: bool) -> Result<(), MeshError> {
        let Some(at) = self.at.extension("KHR_materials_specular") else { return Ok(()) };
        let factor = at.number("specularFactor")?.unwrap_or(1.0).clamp(0.0, 1.0) as f32;
        let color = at.numbers::<3>("specularColorFactor")?.unwrap_or([1.0; 3]).map(|x| x as f32);
        let is_plain = color[0] == color[1] && color[1] == color[2];
        if at.get("specularTexture").or_else(|| at.get("specularColorTexture")).is_some() || !is_plain {
            self.report.approximated(About::Material, "coloured reflectance, by grey");
        }
        let share = factor * (color[0] + color[1] + color[2]) / 3.0;
        if share != 1.0 && !is_clear {
            terms.ior = index_of(reflectance_of(terms.ior) * share).clamp(1.0, MOST_IOR);
            self.report
                .approximated(About::Material, "a share of reflectance, by another index of refraction");
        } else if share != 1.0 {
            self.report.ignored(About::Material, "a share of the reflectance of what is clear");
        }
        Ok(())
    }

    fn with_normals(&mut self, base: Look) -> Result<Look, MeshError> {
        let Some(map) = self.textures.map(self.at, "normalTexture", self.report)? else { return Ok(base) };
        let scale = self.at.need("normalTexture")?.number("scale")?.unwrap_or(1.0) as f32;
        Ok(Look::NormalMap { base: Box::new(base), map, strength: scale.clamp(0.0, 100.0) })
    }

    fn with_holes(&mut self, base: Look, opacity: Shade) -> Result<Look, MeshError> {
        let cutoff = match self.at.text("alphaMode")? {
            None | Some("OPAQUE") => return Ok(base),
            Some("MASK") => Some(self.at.number("alphaCutoff")?.unwrap_or(0.5) as f32),
            Some("BLEND") => None,
            Some(other) => {
                self.report.left_out(About::Material, format!("the alpha mode `{other}`, which is unknown"));
                return Ok(base);
            }
        };
        let is_whole = opacity.factor == [1.0; 3] && opacity.map.is_none();
        match cutoff {
            _ if is_whole => Ok(base),
            // Everything is there from 0 on.
            Some(cutoff) if cutoff <= 0.0 => Ok(base),
            _ => {
                let cutoff = cutoff.map(|cutoff| cutoff.min(1.0));
                Ok(Look::Mask { base: Box::new(base), opacity, cutoff })
            }
        }
    }
}

/// The colour that is left after a distance, if light is lost at all.
fn attenuation(volume: &At<'_>) -> Result<Option<([f32; 3], f32)>, MeshError> {
    let color = volume.numbers::<3>("attenuationColor")?.unwrap_or([1.0; 3]);
    let color = color.map(|x| x.clamp(1e-6, 1.0) as f32);
    let distance = volume.number("attenuationDistance")?.map(|x| x as f32);
    let distance = distance.filter(|x| x.is_finite() && *x > 0.0).map(|x| x.max(1e-9));
    Ok(distance.filter(|_| color != [1.0; 3]).map(|distance| (color, distance)))
}

/// The reflectance straight on of a refractive index (Fresnel).
fn reflectance_of(ior: f32) -> f32 {
    ((ior - 1.0) / (ior + 1.0)).powi(2)
}

/// The refractive index of a reflectance straight on.
fn index_of(reflectance: f32) -> f32 {
    let root = reflectance.max(0.0).sqrt();
    (1.0 + root) / (1.0 - root)
}
