//! Materials and textures, each lowered once; pictures are decoded once a file.

use crate::asset::{ModelMaterial, Picture, Pixels, picture};
use crate::ir::light::{Brightness, EnvironmentRadiance};
use crate::ir::material::{CheckerCells, Input, MaterialKind, MetalColor, Projection, TextureKind};
use crate::ir::{self, Handle, ImageUse};
use crate::load::{LoadError, Loaded, LoadedMesh, PictureFile};
use crate::math::{Rgb, rgb};
use crate::render::bsdf::{self, Material};
use crate::render::light::{Environment, EnvironmentRadiance as Radiance};
use crate::render::shape::MaterialId;
use crate::render::texture;
use crate::render::texture::{CheckerKind, Image, ImageFilter, ImageTexture, Texture, TextureId, Wrap};
use crate::source::Files;
use rustc_hash::FxHashMap;
use std::path::PathBuf;
use std::sync::Arc;

/// The albedo of what says nothing about its material.
const GRAY: Rgb = Rgb::gray(0.5);
/// The refractive index of a model's transparent material that states none.
const GLASS_IOR: f32 = 1.5;

/// The engine's materials and textures as they come up.
pub struct Materials<'a> {
    loaded: &'a Loaded<'a>,
    files: &'a dyn Files,
    materials: Vec<Material>,
    textures: Vec<Texture>,
    by_handle: FxHashMap<usize, MaterialId>,
    by_model: FxHashMap<(usize, usize), MaterialId>,
    texture_by_handle: FxHashMap<usize, TextureId>,
    images: FxHashMap<PathBuf, Option<Arc<Image>>>,
    gray: Option<MaterialId>,
    failed: Vec<LoadError>,
}

impl<'a> Materials<'a> {
    /// None yet.
    pub fn new(loaded: &'a Loaded<'a>, files: &'a dyn Files) -> Self {
        Self {
            loaded,
            files,
            materials: Vec::new(),
            textures: Vec::new(),
            by_handle: FxHashMap::default(),
            by_model: FxHashMap::default(),
            texture_by_handle: FxHashMap::default(),
            images: FxHashMap::default(),
            gray: None,
            failed: Vec::new(),
        }
    }

    /// All materials and textures, and the pictures that could not be decoded.
    pub fn finish(self) -> (Vec<Material>, Vec<Texture>, Vec<LoadError>) {
        (self.materials, self.textures, self.failed)
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
            MaterialKind::Mix { a, b, .. } => self.emits(*a) || self.emits(*b),
            _ => false,
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
        if !self.emits(handle) {
            self.by_handle.insert(handle.index(), id);
        }
        id
    }

    fn lower(&mut self, handle: Handle<ir::Material>, radiance: &dyn Fn(Brightness, Rgb) -> Rgb) -> Material {
        let scene = self.loaded.scene;
        match &scene.materials[handle].kind {
            MaterialKind::Diffuse { color } => Material::Diffuse { color: self.input(color) },
            MaterialKind::Phong { diffuse, specular, shininess } => Material::Phong {
                diffuse: self.input(diffuse),
                specular: self.input(specular),
                shininess: shininess.value as f32,
            },
            MaterialKind::Mirror { color } => Material::Mirror { color: self.input(color) },
            MaterialKind::Metal { color, roughness } => {
                let f0 = match color {
                    MetalColor::Named(_, f0) => bsdf::Input::Constant(*f0),
                    MetalColor::Color(color) => self.input(color),
                };
                Material::Metal { f0, roughness: self.input(roughness) }
            }
            MaterialKind::Glass { ior, tint, absorption } => {
                Material::Glass { ior: ior.value as f32, tint: tint.value, absorption: *absorption }
            }
            MaterialKind::Emissive { brightness, color } => {
                Material::Emissive { radiance: radiance(brightness.value, *color), two_sided: false }
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
                diffuse: self.input(diffuse),
                specular: self.input(specular),
                shininess: shininess.value as f32,
                reflection: self.input(reflection),
                transmission: self.input(transmission),
                ior: ior.value as f32,
                fresnel: *fresnel,
            },
            MaterialKind::Mix { a, b, amount } => {
                let (a, b) = (self.of_scene(*a, radiance), self.of_scene(*b, radiance));
                Material::Mix { a, b, amount: self.input(amount) }
            }
        }
    }

    /// A material of a mesh file.
    pub fn of_model(&mut self, mesh: &LoadedMesh, index: usize) -> MaterialId {
        let key = (std::ptr::from_ref(mesh).addr(), index);
        if let Some(&known) = self.by_model.get(&key) {
            return known;
        }
        let map = mesh.maps[index].as_ref();
        let lowered = self.lower_model(&mesh.model.materials[index], map);
        let id = self.add(lowered);
        self.by_model.insert(key, id);
        id
    }

    /// MTL says little: it shines, is see-through, has a highlight, or is matt.
    fn lower_model(&mut self, material: &ModelMaterial, map: Option<&PictureFile>) -> Material {
        let color =
            |written: Option<[f32; 3]>| written.map(Rgb::from).filter(|c| c.is_valid() && !c.is_black());
        if let Some(radiance) = color(material.emission) {
            return Material::Emissive { radiance, two_sided: false };
        }
        if material.is_clear() {
            let ior = material.ior.filter(|ior| *ior >= 1.0).unwrap_or(GLASS_IOR);
            return Material::Glass { ior, tint: Rgb::WHITE, absorption: Rgb::BLACK };
        }
        let diffuse = match map.and_then(|map| self.image(map)) {
            Some(image) => self.plain_texture(image),
            None => bsdf::Input::Constant(albedo(material.diffuse.map_or(GRAY, Rgb::from))),
        };
        match (color(material.specular), material.shininess) {
            (Some(specular), Some(shininess)) if shininess >= 1.0 => {
                Material::Phong { diffuse, specular: bsdf::Input::Constant(albedo(specular)), shininess }
            }
            _ => Material::Diffuse { color: diffuse },
        }
    }

    fn plain_texture(&mut self, image: Arc<Image>) -> bsdf::Input {
        self.add_texture(Texture::Image(ImageTexture {
            image,
            wrap: Wrap::Repeat,
            filter: ImageFilter::Linear,
            uv_scale: glam::Vec2::ONE,
            uv_offset: glam::Vec2::ZERO,
            projection: texture::Projection::Uv,
        }))
    }

    fn add_texture(&mut self, texture: Texture) -> bsdf::Input {
        self.textures.push(texture);
        bsdf::Input::Texture(TextureId(self.textures.len() as u32 - 1))
    }

    fn input(&mut self, input: &Input) -> bsdf::Input {
        match input {
            Input::Constant(color) => bsdf::Input::Constant(color.value),
            Input::Texture(texture) => self.texture(texture.value),
        }
    }

    fn texture(&mut self, handle: Handle<ir::Texture>) -> bsdf::Input {
        if let Some(&known) = self.texture_by_handle.get(&handle.index()) {
            return bsdf::Input::Texture(known);
        }
        let input = match &self.loaded.scene.textures[handle].kind {
            TextureKind::Image(image) => self.image_texture(handle, image),
            TextureKind::Checker(checker) => {
                let kind = match checker.cells {
                    CheckerCells::Uv(cells) => CheckerKind::Cells(cells.as_vec2()),
                    CheckerCells::Solid(edge) => CheckerKind::Solid(edge as f32),
                };
                self.add_texture(Texture::Checker { a: checker.a.value, b: checker.b.value, kind })
            }
        };
        if let bsdf::Input::Texture(id) = input {
            self.texture_by_handle.insert(handle.index(), id);
        }
        input
    }

    fn image_texture(&mut self, handle: Handle<ir::Texture>, image: &ImageUse) -> bsdf::Input {
        let wrap = match image.wrap {
            ir::Wrap::Repeat => Wrap::Repeat,
            ir::Wrap::Clamp => Wrap::Clamp,
            ir::Wrap::Mirror => Wrap::Mirror,
            ir::Wrap::Border(color) => Wrap::Border(color),
        };
        let Some(pixels) = self.loaded.picture(handle).and_then(|file| self.image(file)) else {
            // Left out with a warning: all of it is border.
            let color = if let Wrap::Border(color) = wrap { color } else { GRAY };
            return bsdf::Input::Constant(color);
        };
        let projection = match image.projection {
            Projection::Uv => texture::Projection::Uv,
            Projection::Planar { origin, u, v } => {
                texture::Projection::Planar { origin: origin.as_vec3(), u: u.as_vec3(), v: v.as_vec3() }
            }
        };
        self.add_texture(Texture::Image(ImageTexture {
            image: pixels,
            wrap,
            filter: if image.linear_filter { ImageFilter::Linear } else { ImageFilter::Nearest },
            uv_scale: image.uv_scale.as_vec2(),
            uv_offset: image.uv_offset.as_vec2(),
            projection,
        }))
    }

    /// The environment; `None` when its picture was left out.
    pub fn environment(&mut self, environment: &ir::Environment) -> Option<Environment> {
        let radiance = match environment.radiance {
            EnvironmentRadiance::Constant(color) => Radiance::Constant(color),
            EnvironmentRadiance::Image(texture) => {
                let file = self.loaded.picture(texture)?.clone();
                Radiance::Image(self.image(&file)?)
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
        let bytes = self.files.read(&file.path).map_err(|error| error.to_string());
        match bytes.and_then(|bytes| picture::brightness(&bytes).map_err(|error| error.to_string())) {
            Ok(values) => Some((file.width as usize, values)),
            Err(reason) => {
                self.failed.push(LoadError::BadPicture { name: file.name.clone(), reason, used: file.span });
                None
            }
        }
    }

    fn image(&mut self, file: &PictureFile) -> Option<Arc<Image>> {
        if let Some(known) = self.images.get(&file.path) {
            return known.clone();
        }
        let bytes = self.files.read(&file.path).map_err(|error| error.to_string());
        let image = match bytes.and_then(|bytes| picture::decode(&bytes).map_err(|error| error.to_string())) {
            Ok(picture) => Some(Arc::new(linear(&picture))),
            Err(reason) => {
                self.failed.push(LoadError::BadPicture { name: file.name.clone(), reason, used: file.span });
                None
            }
        };
        self.images.insert(file.path.clone(), image.clone());
        image
    }
}

/// Reflectances of model files are often out of range; they are brought to where no energy is made.
fn albedo(color: Rgb) -> Rgb {
    color.map(|x| x.clamp(0.0, 1.0))
}

fn linear(picture: &Picture) -> Image {
    let texels = match &picture.pixels {
        Pixels::Display(pixels) => {
            let table: Vec<f32> = (0..=255u8).map(|x| rgb::srgb_to_linear(f32::from(x) / 255.0)).collect();
            pixels.iter().map(|p| Rgb::from(p.map(|x| table[usize::from(x)]))).collect()
        }
        Pixels::Linear(pixels) => pixels.iter().map(|&p| Rgb::from(p)).collect(),
    };
    Image::new(picture.width, picture.height, texels)
}
