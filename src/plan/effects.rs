//! The effects that a scene calls for, each with the places that call for it.

use crate::ir::light::{EnvironmentRadiance, LightKind};
use crate::ir::material::{Input, MaterialKind, Projection, TextureKind};
use crate::ir::{self, Camera, Handle, Lens, Material, Object, Scene, Shape, ShapeKind, Texture};
use crate::load::Loaded;
use crate::source::Span;
use rustc_hash::FxHashSet;

/// Something that a picture may need simulated.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Effect {
    /// A lens opening: depth of field.
    LensBlur,
    /// Lights with a size.
    SoftShadows,
    /// Colours looked up at points.
    Textures,
    /// Perfect mirrors and glass.
    Specular,
    /// Light that goes through.
    Dielectrics,
    /// Highlights with a width.
    Glossy,
    /// Glass that colours light on its way.
    Absorption,
    /// Light that reaches a matt surface by way of a mirror or through glass.
    Caustics,
    /// Light that bounces between surfaces.
    Indirect,
    /// Light from everywhere.
    Environment,
    /// Emissive objects.
    MeshLights,
    /// Normals bent by pictures.
    NormalMaps,
    /// Surfaces with holes.
    Alpha,
    /// Glass that bends each wavelength in its own way.
    Dispersion,
}

impl Effect {
    /// All of them, in the order in which they are listed.
    pub const ALL: [Self; 14] = [
        Self::LensBlur,
        Self::SoftShadows,
        Self::Textures,
        Self::Specular,
        Self::Dielectrics,
        Self::Glossy,
        Self::Absorption,
        Self::Caustics,
        Self::Indirect,
        Self::Environment,
        Self::MeshLights,
        Self::NormalMaps,
        Self::Alpha,
        Self::Dispersion,
    ];

    /// The name by which people know it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::LensBlur => "lens_blur",
            Self::SoftShadows => "soft_shadows",
            Self::Textures => "textures",
            Self::Specular => "specular",
            Self::Dielectrics => "dielectrics",
            Self::Glossy => "glossy",
            Self::Absorption => "absorption",
            Self::Caustics => "caustics",
            Self::Indirect => "indirect",
            Self::Environment => "environment",
            Self::MeshLights => "mesh_lights",
            Self::NormalMaps => "normal_maps",
            Self::Alpha => "alpha",
            Self::Dispersion => "dispersion",
        }
    }
}

/// An effect with its users.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct EffectUse {
    /// Which.
    pub effect: Effect,
    /// The first place that calls for it.
    pub span: Span,
    /// How many places do.
    pub count: usize,
}

/// The effects of a scene, in the order of [`Effect::ALL`].
pub fn effects(loaded: &Loaded<'_>, camera: Option<&Camera>) -> Vec<EffectUse> {
    let mut found = Found {
        loaded,
        scene: loaded.scene,
        uses: Vec::new(),
        seen: FxHashSet::default(),
        casters: Vec::new(),
    };
    if let Some(camera) = camera {
        found.camera(camera);
    }
    for object in &loaded.scene.objects {
        found.object(object);
    }
    found.lights();
    found.caustics();
    found.uses.sort_by_key(|used| used.effect);
    found.uses
}

struct Found<'a> {
    loaded: &'a Loaded<'a>,
    scene: &'a Scene,
    uses: Vec<EffectUse>,
    seen: FxHashSet<usize>,
    /// What throws caustics, once lit.
    casters: Vec<Span>,
}

impl Found<'_> {
    fn add(&mut self, effect: Effect, span: Span) {
        match self.uses.iter_mut().find(|used| used.effect == effect) {
            Some(used) => used.count += 1,
            None => self.uses.push(EffectUse { effect, span, count: 1 }),
        }
    }

    fn of(&self, effect: Effect) -> Option<EffectUse> {
        self.uses.iter().find(|used| used.effect == effect).copied()
    }

    fn camera(&mut self, camera: &Camera) {
        match &camera.lens {
            Lens::Thin { radius, .. } if radius.value > 0.0 => self.add(Effect::LensBlur, radius.span),
            Lens::Prescription { file, .. } => self.add(Effect::LensBlur, file.span),
            _ => {}
        }
    }

    fn object(&mut self, object: &Object) {
        let shape = &self.scene.shapes[object.shape];
        match object.material.or(shape.material) {
            Some(material) => self.material(material),
            // A mesh brings its own materials; grey otherwise.
            None if matches!(shape.kind, ShapeKind::Mesh { .. }) => {
                self.own_materials(object.shape, shape.span)
            }
            None => self.add(Effect::Indirect, object.span),
        }
    }

    /// Those that a mesh brings.
    fn own_materials(&mut self, shape: Handle<Shape>, span: Span) {
        self.add(Effect::Textures, span);
        let Some(mesh) = self.loaded.mesh(shape) else { return };
        if mesh.model.materials.iter().any(|material| material.is_clear()) {
            [Effect::Specular, Effect::Dielectrics].into_iter().for_each(|effect| self.add(effect, span));
            self.casters.push(span);
        }
        if mesh.model.materials.iter().any(|material| material.shines()) {
            self.add(Effect::MeshLights, span);
        }
    }

    fn material(&mut self, handle: Handle<Material>) {
        if !self.seen.insert(handle.index()) {
            return;
        }
        let scene = self.scene;
        let material = &scene.materials[handle];
        let called: &[Effect] = match &material.kind {
            MaterialKind::Diffuse { .. } => &[Effect::Indirect],
            MaterialKind::Phong { .. } => &[Effect::Indirect, Effect::Glossy],
            MaterialKind::Mirror { .. } => &[Effect::Specular],
            MaterialKind::Metal { .. } => &[Effect::Glossy],
            MaterialKind::Glass { absorption, roughness, abbe, .. } => {
                if let Some(abbe) = abbe {
                    self.add(Effect::Dispersion, abbe.span);
                }
                match (is_black(roughness), absorption.is_black()) {
                    (true, true) => &[Effect::Specular, Effect::Dielectrics],
                    (true, false) => &[Effect::Specular, Effect::Dielectrics, Effect::Absorption],
                    (false, true) => &[Effect::Specular, Effect::Dielectrics, Effect::Glossy],
                    (false, false) => {
                        &[Effect::Specular, Effect::Dielectrics, Effect::Glossy, Effect::Absorption]
                    }
                }
            }
            MaterialKind::Plastic { .. } => &[Effect::Indirect, Effect::Glossy],
            MaterialKind::Layer { .. } => &[Effect::Glossy],
            MaterialKind::Principled(of) => {
                if !of.emission.value.is_black() {
                    self.add(Effect::MeshLights, of.emission.span);
                }
                match is_black(&of.transmission) {
                    true => &[Effect::Indirect, Effect::Glossy],
                    false => &[Effect::Indirect, Effect::Glossy, Effect::Specular, Effect::Dielectrics],
                }
            }
            MaterialKind::Mask { .. } => &[Effect::Alpha],
            MaterialKind::NormalMap { .. } | MaterialKind::Bump { .. } => &[Effect::NormalMaps],
            MaterialKind::TwoSided { .. } => &[],
            MaterialKind::Emissive { .. } => &[Effect::MeshLights],
            MaterialKind::Whitted { reflection, transmission, .. } => {
                if is_black(transmission) && is_black(reflection) {
                    &[]
                } else if is_black(transmission) {
                    &[Effect::Specular]
                } else {
                    &[Effect::Specular, Effect::Dielectrics]
                }
            }
            MaterialKind::Mix { .. } => &[],
        };
        called.iter().for_each(|&effect| self.add(effect, material.span));
        if casts(&material.kind) {
            self.casters.push(material.span);
        }
        material.kind.inputs().iter().for_each(|input| self.input(input));
        material.kind.parts().into_iter().for_each(|part| self.material(part));
    }

    fn input(&mut self, input: &Input) {
        if let Input::Texture(texture) = input {
            self.texture(texture.value);
        }
    }

    fn texture(&mut self, handle: Handle<Texture>) {
        let texture = &self.scene.textures[handle];
        let span = match &texture.kind {
            TextureKind::Image(image) if image.projection == Projection::Uv => image.file.span,
            _ => texture.span,
        };
        self.add(Effect::Textures, span);
        texture.kind.inputs().iter().for_each(|input| self.input(input));
    }

    fn lights(&mut self) {
        let scene = self.scene;
        for light in &scene.lights {
            match light.kind {
                LightKind::Sphere { .. } | LightKind::Rect { .. } | LightKind::Disk { .. } => {
                    self.add(Effect::SoftShadows, light.span)
                }
                LightKind::SunSky(_) => {
                    self.add(Effect::SoftShadows, light.span);
                    self.add(Effect::Environment, light.span);
                }
                LightKind::Point { .. } | LightKind::Spot { .. } | LightKind::Directional { .. } => {}
            }
        }
        if let Some(used) = self.of(Effect::MeshLights) {
            self.add(Effect::SoftShadows, used.span);
        }
        if let Some(environment) = &scene.environment {
            self.add(Effect::Environment, environment.span);
            if let EnvironmentRadiance::Image(texture) = environment.radiance {
                self.texture(texture);
            }
        }
    }

    /// Caustics need a light with power, something sharp that it can reach, and a surface that is not to fall on.
    /// Over-approximates: what the light can reach is not looked at.
    fn caustics(&mut self) {
        let scene = self.scene;
        let lit = scene.lights.iter().any(|light| light.brightness.value.is_lit())
            || scene.environment.as_ref().is_some_and(ir::light::Environment::is_lit)
            || self.of(Effect::MeshLights).is_some();
        let receives = [Effect::Indirect, Effect::Glossy, Effect::Textures];
        let receiver = receives.into_iter().any(|effect| self.of(effect).is_some());
        if let (Some(&span), true, true) = (self.casters.first(), lit, receiver) {
            self.uses.push(EffectUse { effect: Effect::Caustics, span, count: self.casters.len() });
        }
    }
}

/// A metal smoother than this, and a Phong lobe narrower, gathers light into caustics rather than spreading it: the
/// engine's own threshold, which draws the line between photons and paths.
const SHARP_ROUGHNESS: f32 = 0.5;
const SHARP_SHININESS: f64 = 32.0;
/// A glossy lobe weaker than this throws nothing that is worth photons.
const LEAST_SPECULAR: f32 = 0.1;

/// Whether light goes on from a material so sharply that it throws caustics.
fn casts(kind: &MaterialKind) -> bool {
    let may_exceed = |input: &Input, least: f32| match input {
        Input::Constant(color) => color.value.mean() >= least,
        Input::Texture(_) => true,
    };
    let is_sharp = |roughness: &Input| match roughness {
        Input::Constant(roughness) => roughness.value.mean() < SHARP_ROUGHNESS,
        Input::Texture(_) => true,
    };
    match kind {
        MaterialKind::Glass { .. } => true,
        MaterialKind::Mirror { color } => may_exceed(color, f32::MIN_POSITIVE),
        MaterialKind::Metal { roughness, .. } => is_sharp(roughness),
        MaterialKind::Principled(of) => {
            !is_black(&of.transmission) || !is_black(&of.metallic) && is_sharp(&of.roughness)
        }
        MaterialKind::Phong { specular, shininess, .. } => {
            shininess.value > SHARP_SHININESS && may_exceed(specular, LEAST_SPECULAR)
        }
        // The coat of plastic mirrors too little; what is made of other materials casts as those do.
        MaterialKind::Diffuse { .. }
        | MaterialKind::Plastic { .. }
        | MaterialKind::Emissive { .. }
        | MaterialKind::Whitted { .. }
        | MaterialKind::Layer { .. }
        | MaterialKind::Mask { .. }
        | MaterialKind::TwoSided { .. }
        | MaterialKind::NormalMap { .. }
        | MaterialKind::Bump { .. }
        | MaterialKind::Mix { .. } => false,
    }
}

fn is_black(input: &Input) -> bool {
    matches!(input, Input::Constant(color) if color.is_black())
}
