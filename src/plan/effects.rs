//! The effects that a scene calls for, each with the places that call for it.
//!
//! What a scene does not place calls for nothing. In doubt an effect is called for: to leave one out may change no bit.

use super::absent;
use super::caustics::{self, Caster};
use super::effect::Effect;
use super::look;
use crate::check::{Region, region};
use crate::ir::light::{EnvironmentRadiance, LightKind};
use crate::ir::material::{Input, MaterialKind, Projection, TextureKind};
use crate::ir::{
    Camera, Handle, Lens, Material, Object, RevolveMethod, Scene, Shape, ShapeKind, Texture, first_moving,
};
use crate::load::{Loaded, LoadedMesh};
use crate::source::Span;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeSet;
use std::sync::Arc;

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

/// What the scene says about every effect.
pub struct Survey {
    /// Those called for, in the order of [`Effect::ALL`].
    pub uses: Vec<EffectUse>,
    /// Those, and what may be there though nobody would look for it.
    pub in_doubt: Vec<Effect>,
    /// The others, each with the reason.
    pub absent: Vec<(Effect, String)>,
}

/// Looks for every effect in a scene seen by `camera`.
pub fn survey(loaded: &Loaded<'_>, camera: Option<&Camera>) -> Survey {
    let mut found = Found {
        loaded,
        scene: loaded.scene,
        uses: Vec::new(),
        seen: FxHashSet::default(),
        placed: FxHashMap::default(),
        casters: Vec::new(),
        may_throw: false,
    };
    if let Some(camera) = camera {
        found.camera(camera);
    }
    for object in &loaded.scene.objects {
        found.object(object);
    }
    found.lights();
    let no_caustics = found.caustics();
    found.uses.sort_by_key(|used| used.effect);
    let is_used = |effect: &Effect| found.of(*effect).is_some();
    let mut in_doubt: Vec<Effect> = Effect::ALL.into_iter().filter(is_used).collect();
    if found.may_throw && !in_doubt.contains(&Effect::Caustics) {
        in_doubt.push(Effect::Caustics);
    }
    let absent = Effect::ALL.into_iter().filter(|effect| !is_used(effect)).map(|effect| {
        let why = match (effect, no_caustics) {
            (Effect::Caustics, Some(why)) => why.to_owned(),
            _ => absent::why(effect, loaded.scene, camera),
        };
        (effect, why)
    });
    Survey { absent: absent.collect(), uses: found.uses, in_doubt }
}

struct Found<'a> {
    loaded: &'a Loaded<'a>,
    scene: &'a Scene,
    uses: Vec<EffectUse>,
    seen: FxHashSet<usize>,
    /// How often each mesh file is placed in each size.
    placed: FxHashMap<(*const LoadedMesh, u64, Option<bool>), u32>,
    /// What throws caustics, once lit.
    casters: Vec<Caster>,
    /// Whether something is sharp at all, be it ever so weak.
    may_throw: bool,
}

/// Below this many triangles a copy of a mesh is cheaper for rays than a tree of its own, and small anyway.
pub const LEAST_SHARED: usize = 1000;

impl Found<'_> {
    fn add(&mut self, effect: Effect, span: Span) {
        match self.uses.iter_mut().find(|used| used.effect == effect) {
            Some(used) => used.count += 1,
            None => self.uses.push(EffectUse { effect, span, count: 1 }),
        }
    }

    fn add_all(&mut self, effects: &[Effect], span: Span) {
        effects.iter().for_each(|&effect| self.add(effect, span));
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
        if camera.shutter.value > 0.0 {
            let own = first_moving(&camera.transform).into_iter();
            let things = self.scene.objects.iter().filter_map(|object| object.motion.as_ref());
            let moving: Vec<Span> = own.chain(things.map(|motion| motion.span)).collect();
            moving.into_iter().for_each(|span| self.add(Effect::Motion, span));
        }
    }

    fn object(&mut self, object: &Object) {
        let shape = &self.scene.shapes[object.shape];
        let written = object.material.or(shape.material);
        self.shape(object, shape, written);
        let throws = match written {
            Some(material) => {
                self.material(material);
                caustics::caster(self.scene, material)
            }
            // A mesh brings its own materials; grey otherwise.
            None if matches!(shape.kind, ShapeKind::Mesh { .. }) => {
                self.own_materials(object.shape, shape.span)
            }
            None => {
                self.add(Effect::Indirect, object.span);
                None
            }
        };
        if let Some(span) = throws {
            self.casters.push(Caster { span, region: self.region(object) });
        }
    }

    /// What holds an object on all of its way; `None` for what has no end.
    fn region(&self, object: &Object) -> Option<Region> {
        region(object, self.scene, self.loaded)
    }

    fn shape(&mut self, object: &Object, shape: &Shape, material: Option<Handle<Material>>) {
        let is_smooth = match &shape.kind {
            ShapeKind::Mesh { scale, smooth, .. } => {
                let Some(mesh) = self.loaded.mesh(object.shape) else { return };
                self.instance(mesh, scale.value, *smooth, object.span);
                let has_normals = || mesh.model.parts.iter().any(|part| part.normals.is_some());
                smooth.unwrap_or_else(has_normals)
            }
            ShapeKind::Heightfield { smooth, .. } => *smooth,
            ShapeKind::Revolve { method: RevolveMethod::Exact, .. } => {
                material.is_some_and(|material| shines(self.scene, material))
            }
            ShapeKind::Revolve { .. } | ShapeKind::Sweep { .. } | ShapeKind::Extrude { .. } => true,
            _ => false,
        };
        if is_smooth {
            self.add(Effect::SmoothNormals, shape.span);
        }
    }

    fn instance(&mut self, mesh: &Arc<LoadedMesh>, scale: f64, smooth: Option<bool>, span: Span) {
        let count = self.placed.entry((Arc::as_ptr(mesh), scale.to_bits(), smooth)).or_default();
        *count += 1;
        let is_large = mesh.model.parts.iter().any(|part| part.triangles.len() >= LEAST_SHARED);
        if *count >= 2 && is_large {
            self.add(Effect::Instances, span);
        }
    }

    /// Those that a mesh brings; the mesh, if one of them throws caustics.
    fn own_materials(&mut self, shape: Handle<Shape>, span: Span) -> Option<Span> {
        let mesh = self.loaded.mesh(shape)?.clone();
        let mut throws = None;
        let own: BTreeSet<Option<usize>> = mesh.model.parts.iter().map(|part| part.material).collect();
        for material in own {
            let Some(index) = material else {
                self.add(Effect::Indirect, span);
                continue;
            };
            let called = look::called(&mesh.model.materials[index].look);
            self.add_all(&called.effects, span);
            self.may_throw |= called.may_throw;
            throws = throws.or(called.casts.then_some(span));
        }
        throws
    }

    fn material(&mut self, handle: Handle<Material>) {
        if !self.seen.insert(handle.index()) {
            return;
        }
        let scene = self.scene;
        let material = &scene.materials[handle];
        self.may_throw |= caustics::may_throw(&material.kind);
        self.add_all(&surface_effects(&material.kind), material.span);
        match &material.kind {
            MaterialKind::Glass { absorption, abbe, .. } => {
                if let Some(abbe) = abbe {
                    self.add(Effect::Dispersion, abbe.span);
                }
                if !absorption.is_black() {
                    self.add(Effect::Absorption, material.span);
                }
            }
            MaterialKind::Principled(of) if !of.emission.is_black() => {
                self.add(Effect::MeshLights, of.emission.span());
            }
            _ => {}
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
        if matches!(texture.kind, TextureKind::Image(_)) {
            self.add(Effect::TextureFiltering, span);
        }
        texture.kind.inputs().iter().for_each(|input| self.input(input));
    }

    fn lights(&mut self) {
        let scene = self.scene;
        for light in &scene.lights {
            match light.kind {
                LightKind::Sphere { .. } | LightKind::Rect { .. } | LightKind::Disk { .. } => {
                    self.add(Effect::SoftShadows, light.span)
                }
                LightKind::SunSky(_) => self.add_all(&[Effect::SoftShadows, Effect::Environment], light.span),
                LightKind::Point { .. } | LightKind::Spot { .. } | LightKind::Directional { .. } => {}
            }
        }
        if let Some(used) = self.of(Effect::MeshLights) {
            self.add(Effect::SoftShadows, used.span);
        }
        if let Some(environment) = &scene.environment {
            self.add(Effect::Environment, environment.span);
            if let EnvironmentRadiance::Image(texture) = environment.radiance {
                self.add(Effect::Textures, scene.textures[texture].span);
            }
        }
    }

    /// Caustics need a light with power, something sharp that it reaches, and a surface for them to fall on. What is
    /// missing comes back.
    fn caustics(&mut self) -> Option<&'static str> {
        let shines = self.of(Effect::MeshLights).is_some();
        let is_received = self.of(Effect::Indirect).is_some();
        self.may_throw = (self.may_throw || !self.casters.is_empty()) && is_received;
        match caustics::missing(&self.casters, self.scene, shines, is_received) {
            Some(why) => Some(why),
            None => {
                let lit = self.casters.iter().filter(|caster| caustics::is_lit(caster, self.scene, shines));
                let mut spans: Vec<Span> = lit.map(|caster| caster.span).collect();
                let first = spans[0];
                spans.sort_by_key(|span| (span.start, span.end));
                spans.dedup();
                self.uses.push(EffectUse { effect: Effect::Caustics, span: first, count: spans.len() });
                None
            }
        }
    }
}

/// What the engine takes for a mirror: α = roughness² below 10⁻³. Near it, both are called for.
pub const MIRROR_ROUGHNESS: [f32; 2] = [0.031, 0.032];

/// How sharply a surface of this roughness scatters.
fn gloss(roughness: &Input) -> &'static [Effect] {
    match roughness {
        Input::Constant(roughness) if roughness.value.mean() < MIRROR_ROUGHNESS[0] => &[Effect::Specular],
        Input::Constant(roughness) if roughness.value.mean() > MIRROR_ROUGHNESS[1] => {
            &[Effect::RoughSpecular, Effect::Indirect]
        }
        _ => &[Effect::Specular, Effect::RoughSpecular, Effect::Indirect],
    }
}

/// What a material calls for by its kind. Whatever scatters into more than one direction calls for indirect light.
fn surface_effects(kind: &MaterialKind) -> Vec<Effect> {
    use Effect::{Alpha, Dielectrics, Indirect, MeshLights, NormalMaps, RoughSpecular, Specular};
    match kind {
        MaterialKind::Diffuse { .. } => vec![Indirect],
        MaterialKind::Phong { .. } => vec![Indirect, RoughSpecular],
        MaterialKind::Mirror { .. } => vec![Specular],
        MaterialKind::Metal { roughness, .. } => gloss(roughness).to_vec(),
        MaterialKind::Glass { roughness, .. } => [gloss(roughness), &[Dielectrics]].concat(),
        MaterialKind::Plastic { roughness, .. } | MaterialKind::Layer { roughness, .. } => {
            let mut called = gloss(roughness).to_vec();
            called.extend((!called.contains(&Indirect)).then_some(Indirect));
            called
        }
        MaterialKind::Principled(of) => match is_black(&of.transmission) {
            true => vec![Indirect, RoughSpecular],
            false => vec![Indirect, RoughSpecular, Specular, Dielectrics],
        },
        MaterialKind::Mask { .. } => vec![Alpha],
        MaterialKind::NormalMap { .. } | MaterialKind::Bump { .. } => vec![NormalMaps],
        MaterialKind::Emissive { .. } => vec![MeshLights],
        MaterialKind::Whitted { reflection, transmission, .. } => {
            match (is_black(transmission), is_black(reflection)) {
                (true, true) => vec![Indirect],
                (true, false) => vec![Indirect, Specular],
                (false, _) => vec![Indirect, Specular, Dielectrics],
            }
        }
        MaterialKind::TwoSided { .. } | MaterialKind::Mix { .. } => Vec::new(),
    }
}

/// Whether a material shines, alone or in a mix.
pub fn shines(scene: &Scene, material: Handle<Material>) -> bool {
    let kind = &scene.materials[material].kind;
    match kind {
        MaterialKind::Emissive { .. } => true,
        MaterialKind::Principled(of) => !of.emission.is_black(),
        _ => kind.parts().into_iter().any(|part| shines(scene, part)),
    }
}

/// Whether an input is black all over.
pub fn is_black(input: &Input) -> bool {
    matches!(input, Input::Constant(color) if color.is_black())
}
