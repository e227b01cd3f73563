//! Materials of mesh files.

use super::texture::Reading;
use super::{Glass, LoadedMesh, Material, Materials, Origin, Principled, Relief};
use crate::asset::Look;
use crate::asset::look::{GlassLook, Map, MapChannel, MapWrap, PrincipledLook, Shade};
use crate::ir::material::Channel;
use crate::math::{Rgb, Vec2, float};
use crate::render::bsdf::Input;
use crate::render::shape::MaterialId;
use crate::render::texture::{self, ImageFilter, ImageTexture, Join, Texture, TextureId, Wrap};
use std::sync::Arc;

/// What the numbers of a picture are wanted as.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Wanted {
    Color,
    Number,
}

impl Materials<'_> {
    /// A material of a mesh file.
    pub fn of_model(&mut self, mesh: &LoadedMesh, index: usize) -> MaterialId {
        let key = (std::ptr::from_ref(mesh).addr(), index);
        if let Some(&known) = self.by_model.get(&key) {
            return known;
        }
        let material = &mesh.model.materials[index];
        let id = self.look(mesh, &material.look);
        self.origins.insert(id, Origin { name: Some(material.name.clone()), span: None });
        self.by_model.insert(key, id);
        id
    }

    fn look(&mut self, mesh: &LoadedMesh, look: &Look) -> MaterialId {
        let lowered = match look {
            Look::Diffuse { color } => Material::Diffuse { color: self.shade(mesh, color, Wanted::Color) },
            Look::Phong { diffuse, specular, shininess } => Material::Phong {
                diffuse: self.shade(mesh, diffuse, Wanted::Color),
                specular: Input::Constant(Rgb::from(*specular)),
                shininess: *shininess,
            },
            Look::Emissive { radiance } => {
                Material::Emissive { radiance: Rgb::from(*radiance), two_sided: false }
            }
            Look::Glass(of) => self.model_glass(mesh, of),
            Look::Principled(of) => {
                let (mut of, map) = (of.clone(), of.emission_map.as_ref());
                let map = map.map(|map| self.map(mesh, map, Wanted::Color));
                if let Some(None) = map {
                    of.emission = [0.0; 3]; // its picture was left out, with a word
                }
                let model = self.model_principled(mesh, &of);
                match map.flatten() {
                    Some(map) => self.glow(model, Input::Texture(map)),
                    None => model,
                }
            }
            Look::Mask { base, opacity, cutoff } => {
                let base = self.look(mesh, base);
                let has_alpha = |map: &Map| {
                    map.channel != MapChannel::Alpha
                        || self.loaded.model_picture(mesh, map.picture).is_some_and(|file| file.has_alpha)
                };
                let opacity = match opacity.map.as_ref().is_none_or(has_alpha) {
                    true => self.shade(mesh, opacity, Wanted::Number),
                    false => Input::Constant(Rgb::from(opacity.factor)),
                };
                Material::Mask { base, opacity, cutoff: cutoff.unwrap_or(0.0) }
            }
            Look::NormalMap { base, map, strength } => {
                let base = self.look(mesh, base);
                match self.map(mesh, map, Wanted::Number) {
                    Some(map) => {
                        Material::Relief { base, relief: Relief::NormalMap { map, strength: *strength } }
                    }
                    None => return base,
                }
            }
        };
        self.add(lowered)
    }

    fn model_glass(&mut self, mesh: &LoadedMesh, of: &GlassLook) -> Material {
        let absorption = |(color, distance): ([f32; 3], f32)| {
            // Beer's law: what is left after the distance is the colour.
            Rgb::from(color.map(|left| (-libm::log(f64::from(left)) / f64::from(distance)) as f32))
        };
        Material::Glass(Glass {
            ior: of.ior,
            tint: Rgb::from(of.tint),
            absorption: of.attenuation.map_or(Rgb::BLACK, absorption),
            roughness: self.shade(mesh, &of.roughness, Wanted::Number),
            thin: of.thin,
            priority: 0,
            spread: of.abbe.map_or(0.0, |abbe| (of.ior - 1.0) / abbe),
        })
    }

    fn model_principled(&mut self, mesh: &LoadedMesh, of: &PrincipledLook) -> Material {
        let mut number = |shade: &Shade| self.shade(mesh, shade, Wanted::Number);
        let (metallic, roughness) = (number(&of.metallic), number(&of.roughness));
        let transmission = number(&of.transmission);
        let (clearcoat, clearcoat_roughness) = (number(&of.clearcoat), number(&of.clearcoat_roughness));
        Material::Principled(Principled {
            color: self.shade(mesh, &of.color, Wanted::Color),
            metallic,
            roughness,
            transmission,
            ior: of.ior,
            clearcoat,
            clearcoat_roughness,
            emission: Rgb::from(of.emission),
        })
    }

    fn shade(&mut self, mesh: &LoadedMesh, shade: &Shade, wanted: Wanted) -> Input {
        let Some(map) = &shade.map else { return Input::Constant(Rgb::from(shade.factor)) };
        let Some(map) = self.map(mesh, map, wanted) else { return Input::Constant(Rgb::from(shade.without)) };
        if shade.factor == [1.0; 3] {
            return Input::Texture(map);
        }
        let (a, b) = (Input::Texture(map), Input::Constant(Rgb::from(shade.factor)));
        Input::Texture(self.add_texture(Texture::Join { op: Join::Multiply, a, b }))
    }

    /// A picture of a mesh file; `None` when it was left out.
    fn map(&mut self, mesh: &LoadedMesh, map: &Map, wanted: Wanted) -> Option<TextureId> {
        let channel = match map.channel {
            MapChannel::Rgb => Channel::Rgb,
            MapChannel::Red => Channel::Red,
            MapChannel::Green => Channel::Green,
            MapChannel::Blue => Channel::Blue,
            MapChannel::Alpha => Channel::Alpha,
        };
        let file = self.loaded.model_picture(mesh, map.picture)?.clone();
        let image = self.image(&file, Reading { linear: wanted == Wanted::Number, channel })?;
        let coarser = if wanted == Wanted::Number { Arc::new([]) } else { self.coarser(&image) };
        let (sin, cos) = float::sin_cos(map.uv_rotation);
        Some(self.add_texture(Texture::Image(ImageTexture {
            image,
            coarser,
            wrap: match map.wrap {
                MapWrap::Repeat => Wrap::Repeat,
                MapWrap::Clamp => Wrap::Clamp,
                MapWrap::Mirror => Wrap::Mirror,
            },
            filter: if map.is_blended { ImageFilter::Linear } else { ImageFilter::Nearest },
            uv_scale: Vec2::from(map.uv_scale),
            uv_turn: if map.uv_rotation == 0.0 { Vec2::X } else { Vec2::new(cos, sin) },
            uv_offset: Vec2::from(map.uv_offset),
            projection: texture::Projection::Uv,
        })))
    }
}
