//! Materials and textures, each lowered once; pictures are decoded once a file.

mod model;
mod texture;

use crate::asset::picture;
use crate::ir::light::{Brightness, EnvironmentRadiance};
use crate::ir::material::{MaterialKind, MetalColor};
use crate::ir::{self, Handle};
use crate::load::{LoadError, Loaded, LoadedMesh};
use crate::math::Rgb;
use crate::render::bsdf::{self, Glass, Material, Principled, Relief};
use crate::render::light::{Environment, EnvironmentRadiance as Radiance};
use crate::render::shape::MaterialId;
use crate::render::texture::{Image, Texture, TextureId};
use crate::source::{Files, Span};
use rustc_hash::FxHashMap;
use std::path::PathBuf;
use std::sync::Arc;
use texture::{Reading, Slot};

/// The albedo of what says nothing about its material.
const GRAY: Rgb = Rgb::gray(0.5);

/// The engine's materials and textures as they come up.
pub struct Materials<'a> {
    loaded: &'a Loaded<'a>,
    files: &'a dyn Files,
    materials: Vec<Material>,
    textures: Vec<Texture>,
    by_handle: FxHashMap<usize, MaterialId>,
    by_model: FxHashMap<(usize, usize), MaterialId>,
    texture_by_handle: FxHashMap<(usize, Slot), TextureId>,
    images: FxHashMap<(PathBuf, Reading), Option<Arc<Image>>>,
    /// Whether pictures are filtered.
    filters: bool,
    /// The coarser ones of those of `images` that are.
    coarser: FxHashMap<*const Image, Arc<[Image]>>,
    gray: Option<MaterialId>,
    failed: Vec<LoadError>,
    origins: FxHashMap<MaterialId, Origin>,
}

/// Where a material was defined.
#[derive(Clone, PartialEq, Debug)]
pub struct Origin {
    /// The name that the scene or a mesh file gives it.
    pub name: Option<String>,
    /// Where the scene does so.
    pub span: Option<Span>,
}

/// What was lowered, and what could not be.
pub struct Finished {
    /// The engine's materials.
    pub materials: Vec<Material>,
    /// Its textures.
    pub textures: Vec<Texture>,
    /// Pictures that could not be decoded.
    pub failed: Vec<LoadError>,
    /// Where materials were defined, but for those that only lights have.
    pub origins: FxHashMap<MaterialId, Origin>,
}

impl<'a> Materials<'a> {
    /// None yet. Whether pictures are to be filtered, `filters` says.
    pub fn new(loaded: &'a Loaded<'a>, files: &'a dyn Files, filters: bool) -> Self {
        Self {
            loaded,
            files,
            filters,
            materials: Vec::new(),
            textures: Vec::new(),
            by_handle: FxHashMap::default(),
            by_model: FxHashMap::default(),
            texture_by_handle: FxHashMap::default(),
            images: FxHashMap::default(),
            coarser: FxHashMap::default(),
            gray: None,
            failed: Vec::new(),
            origins: FxHashMap::default(),
        }
    }

    /// All of it.
    pub fn finish(self) -> Finished {
        let Self { materials, textures, failed, origins, .. } = self;
        Finished { materials, textures, failed, origins }
    }

    /// Adds a material that the scene does not name.
    pub fn add(&mut self, material: Material) -> MaterialId {
        self.materials.push(material);
        MaterialId(self.materials.len() as u32 - 1)
    }

    /// The grey of what says nothing.
    pub fn gray(&mut self) -> MaterialId {
        match self.gray {
            Some(id) => id,
            None => {
                let id = self.add(Material::Diffuse { color: bsdf::Input::Constant(GRAY) });
                *self.gray.insert(id)
            }
        }
    }

    /// Whether a material shines, alone or in a mix.
    pub fn emits(&self, handle: Handle<ir::Material>) -> bool {
        match &self.loaded.scene.materials[handle].kind {
            MaterialKind::Emissive { .. } => true,
            MaterialKind::Principled(of) => !of.emission.is_black(),
            kind => kind.parts().into_iter().any(|part| self.emits(part)),
        }
    }

    /// A material of the scene. `radiance` turns a brightness into a radiance for the object at hand: a power depends on
    /// its area, so what shines by power is lowered anew for each object.
    pub fn of_scene(
        &mut self,
        handle: Handle<ir::Material>,
        radiance: &dyn Fn(Brightness, Rgb) -> Rgb,
    ) -> MaterialId {
        if let Some(&known) = self.by_handle.get(&handle.index()) {
            return known;
        }
        let lowered = self.lower(handle, radiance);
        let id = self.add(lowered);
        let written = &self.loaded.scene.materials[handle];
        self.origins.insert(id, Origin { name: written.name.clone(), span: Some(written.span) });
        if !self.emits(handle) {
            self.by_handle.insert(handle.index(), id);
        }
        id
    }

    fn lower(&mut self, handle: Handle<ir::Material>, radiance: &dyn Fn(Brightness, Rgb) -> Rgb) -> Material {
        let scene = self.loaded.scene;
        match &scene.materials[handle].kind {
            MaterialKind::Diffuse { color } => Material::Diffuse { color: self.color(color) },
            MaterialKind::Phong { diffuse, specular, shininess } => Material::Phong {
                diffuse: self.color(diffuse),
                specular: self.color(specular),
                shininess: shininess.value as f32,
            },
            MaterialKind::Mirror { color } => Material::Mirror { color: self.color(color) },
            MaterialKind::Metal { color, roughness } => {
                let constant = bsdf::Input::Constant;
                let (f0, edge) = match color {
                    MetalColor::Named { straight, edge, .. } => (constant(*straight), constant(*edge)),
                    MetalColor::Color { straight, edge } => (self.color(straight), self.color(edge)),
                };
                Material::Metal { f0, edge, roughness: self.data(roughness) }
            }
            MaterialKind::Glass { ior, roughness, tint, absorption, abbe, thin, priority } => {
                Material::Glass(Glass {
                    ior: ior.value as f32,
                    tint: tint.value,
                    absorption: *absorption,
                    roughness: self.data(roughness),
                    thin: thin.is_some(),
                    priority: *priority,
                    spread: abbe.map_or(0.0, |abbe| ((ior.value - 1.0) / abbe.value) as f32),
                })
            }
            MaterialKind::Plastic { color, ior, roughness } => Material::Plastic {
                color: self.color(color),
                ior: ior.value as f32,
                roughness: self.data(roughness),
            },
            MaterialKind::Layer { base, ior, roughness, cover } => Material::Layer {
                base: self.of_scene(*base, radiance),
                ior: ior.value as f32,
                roughness: self.data(roughness),
                cover: self.data(cover),
            },
            MaterialKind::Principled(of) => {
                let emission = self.color(&of.emission);
                let factor =
                    if let bsdf::Input::Constant(radiance) = emission { radiance } else { Rgb::WHITE };
                let model = Material::Principled(Principled {
                    color: self.color(&of.color),
                    metallic: self.data(&of.metallic),
                    roughness: self.data(&of.roughness),
                    transmission: self.data(&of.transmission),
                    ior: of.ior.value as f32,
                    clearcoat: self.data(&of.clearcoat),
                    clearcoat_roughness: self.data(&of.clearcoat_roughness),
                    emission: factor,
                });
                self.glow(model, emission)
            }
            MaterialKind::Mask { base, opacity, cutoff } => Material::Mask {
                base: self.of_scene(*base, radiance),
                opacity: self.data(opacity),
                cutoff: cutoff.unwrap_or(0.0) as f32,
            },
            MaterialKind::TwoSided { front, back } => {
                let (front, back) = (self.of_scene(*front, radiance), self.of_scene(*back, radiance));
                Material::TwoSided { front, back }
            }
            MaterialKind::NormalMap { base, map, strength } => {
                let relief = match self.texture(map.value, Slot::Data) {
                    bsdf::Input::Texture(map) => Some(Relief::NormalMap { map, strength: *strength as f32 }),
                    bsdf::Input::Constant(_) => None,
                };
                self.relief(*base, relief, radiance)
            }
            MaterialKind::Bump { base, height, depth } => {
                let relief = match self.texture(height.value, Slot::Data) {
                    bsdf::Input::Texture(height) => Some(Relief::Bump { height, depth: *depth as f32 }),
                    bsdf::Input::Constant(_) => None,
                };
                self.relief(*base, relief, radiance)
            }
            MaterialKind::Emissive { brightness, map, color } => {
                let radiance = radiance(brightness.value, *color);
                match map.map(|map| self.texture(map.value, Slot::Color)) {
                    None => Material::Emissive { radiance, two_sided: false },
                    Some(bsdf::Input::Constant(mean)) => {
                        Material::Emissive { radiance: radiance * mean, two_sided: false }
                    }
                    Some(map) => self.glow(Material::Emissive { radiance, two_sided: false }, map),
                }
            }
            MaterialKind::Whitted {
                diffuse,
                specular,
                shininess,
                reflection,
                transmission,
                ior,
                fresnel,
            } => Material::Whitted {
                diffuse: self.color(diffuse),
                specular: self.color(specular),
                shininess: shininess.value as f32,
                reflection: self.color(reflection),
                transmission: self.color(transmission),
                ior: ior.value as f32,
                fresnel: *fresnel,
            },
            MaterialKind::Mix { a, b, amount } => {
                let (a, b) = (self.of_scene(*a, radiance), self.of_scene(*b, radiance));
                Material::Mix { a, b, amount: self.data(amount) }
            }
        }
    }

    /// A material with a relief, or the material alone where the picture was left out.
    fn relief(
        &mut self,
        base: Handle<ir::Material>,
        relief: Option<Relief>,
        radiance: &dyn Fn(Brightness, Rgb) -> Rgb,
    ) -> Material {
        match relief {
            Some(relief) => Material::Relief { base: self.of_scene(base, radiance), relief },
            None => self.lower(base, radiance),
        }
    }

    /// A material that shines by a picture, if it does.
    pub(super) fn glow(&mut self, model: Material, map: bsdf::Input) -> Material {
        match map {
            bsdf::Input::Texture(_) => Material::Glow { base: self.add(model), map },
            bsdf::Input::Constant(_) => model,
        }
    }

    /// The environment; `None` when its picture was left out.
    pub fn environment(&mut self, environment: &ir::Environment) -> Option<Environment> {
        let radiance = match environment.radiance {
            EnvironmentRadiance::Constant(color) => Radiance::Constant(color),
            EnvironmentRadiance::Image(texture) => {
                let file = self.loaded.picture(texture)?.clone();
                Radiance::Image(self.image(&file, Reading::DISPLAY)?)
            }
        };
        Some(Environment {
            radiance,
            scale: environment.scale.value as f32,
            rotation: environment.rotation as f32,
        })
    }

    /// The brightness of a picture as it is stored, from 0 to 1: how many in a row, and row by row.
    pub fn heights(&mut self, texture: Handle<ir::Texture>) -> Option<(usize, Vec<f32>)> {
        let file = self.loaded.picture(texture)?.clone();
        let bytes = file.read(self.files).map_err(|error| error.to_string());
        match bytes.and_then(|bytes| picture::brightness(&bytes).map_err(|error| error.to_string())) {
            Ok(values) => Some((file.width as usize, values)),
            Err(reason) => {
                self.failed.push(LoadError::BadPicture { name: file.name.clone(), reason, used: file.span });
                None
            }
        }
    }
}
