//! What a scene calls for: its effects with the lines that need them, and the method that suits them.

pub mod effects;
mod error;

use crate::diag::Problems;
use crate::ir::light::{Environment, EnvironmentRadiance, LightKind};
use crate::ir::{Camera, MaterialKind, Method, PixelPoint, ShapeKind};
use crate::load::Loaded;
use crate::source::Span;
pub use effects::{Effect, EffectUse};
pub use error::PlanWarning;

/// What will be simulated, and how.
#[derive(Clone, PartialEq, Debug)]
pub struct Plan {
    /// The effects that the scene calls for.
    pub effects: Vec<EffectUse>,
    /// The integrator.
    pub method: Method,
    /// Why it was chosen, in a sentence.
    pub why: String,
    /// Photons emitted a pass.
    pub photon_count: u32,
    /// The most photons of a gather.
    pub photon_k: u32,
    /// The gather radius of the first pass in metres; `None`: from the size of a pixel.
    pub photon_radius: Option<f64>,
    /// α of Knaus & Zwicker 2011.
    pub photon_shrink: f64,
    /// The most vertices of a path.
    pub depth: u32,
    /// Whether every pass would be like the first, because nothing is drawn at random.
    pub is_exact: bool,
}

impl Plan {
    /// Whether the scene calls for an effect.
    pub fn needs(&self, effect: Effect) -> bool {
        self.effects.iter().any(|used| used.effect == effect)
    }
}

/// Photons a pass, unless the scene says otherwise.
const PHOTON_COUNT: u32 = 200_000;
/// Photons a gather, unless the scene says otherwise.
const PHOTON_K: u32 = 60;
/// The same for caustics: a bound on the time that a focus may take, not a measure of detail.
const CAUSTIC_PHOTON_K: u32 = 500;
/// Camera paths to a photon for caustics.
const PIXELS_PER_CAUSTIC_PHOTON: u64 = 4;
/// The fewest and the most photons a pass for caustics, whatever the picture's size.
const CAUSTIC_PHOTONS: (u64, u64) = (2_000, 4_000_000);
/// The share of the radius kept: 2/3 balances noise and bias best (Kaplanyan & Dachsbacher 2013).
const PHOTON_SHRINK: f64 = 2.0 / 3.0;
/// The most vertices of a path, unless the scene says otherwise; roulette ends nearly all before.
const DEPTH: u32 = 64;
/// The same for recursive ray tracing, whose tree of rays may double at every vertex.
const CLASSIC_DEPTH: u32 = 10;

/// Derives the plan of a scene seen by `camera`. `forced` overrides the scene's method.
pub fn plan(loaded: &Loaded<'_>, camera: Option<&Camera>, forced: Option<Method>) -> Plan {
    let effects = effects::effects(loaded, camera);
    let render = &loaded.scene.render;
    let written = render.method.map(|method| method.value);
    let (method, why) = match (forced, written) {
        (Some(method), _) => (method, "asked for on the command line".to_owned()),
        (None, Some(method)) => (method, "asked for by the scene".to_owned()),
        (None, None) => {
            let (method, why) = choose(loaded, &effects);
            (method, why.to_owned())
        }
    };
    let photons = &render.photons;
    let (photon_count, photon_k) = match method {
        Method::Hybrid => (camera.map_or(PHOTON_COUNT, caustic_photons), CAUSTIC_PHOTON_K),
        _ => (PHOTON_COUNT, PHOTON_K),
    };
    let depth = if method == Method::Classic { CLASSIC_DEPTH } else { DEPTH };
    let draws =
        |used: &EffectUse| matches!(used.effect, Effect::LensBlur | Effect::SoftShadows | Effect::MeshLights);
    let is_exact =
        method == Method::Classic && render.classic.pixel != PixelPoint::Filter && !effects.iter().any(draws);
    Plan {
        effects,
        method,
        why,
        photon_count: photons.count.map_or(photon_count, |count| count.value),
        photon_k: photons.k.map_or(photon_k, |k| k.value),
        photon_radius: photons.radius.map(|radius| radius.value),
        photon_shrink: photons.shrink.map_or(PHOTON_SHRINK, |shrink| shrink.value),
        depth: render.depth.map_or(depth, |depth| depth.value),
        is_exact,
    }
}

/// Photons a pass for caustics: so few beside camera paths that these take most of the time, for they bring most of the noise.
fn caustic_photons(camera: &Camera) -> u32 {
    let (width, height) = camera.film.size.value;
    let (least, most) = CAUSTIC_PHOTONS;
    (u64::from(width) * u64::from(height) / PIXELS_PER_CAUSTIC_PHOTON).clamp(least, most) as u32
}

/// Notes what the method of `plan` cannot do justice to.
pub fn warn(plan: &Plan, loaded: &Loaded<'_>, problems: &mut Problems) {
    if plan.method != Method::Classic {
        classic_only(loaded, problems);
    }
    if let (Method::Ppm, Some((light, plane))) = (plan.method, endless(loaded)) {
        problems.push(PlanWarning::EndlessPhotons { light, plane });
    }
    let is_kept =
        [Effect::Indirect, Effect::Glossy, Effect::Textures].into_iter().any(|effect| plan.needs(effect));
    let specular = plan.effects.iter().find(|used| used.effect == Effect::Specular);
    if let (Method::Ppm | Method::Hybrid, false, Some(specular)) = (plan.method, is_kept, specular) {
        problems.push(PlanWarning::PhotonsWithoutReceiver { specular: specular.span });
    }
}

/// What means nothing to a method that simulates light.
fn classic_only(loaded: &Loaded<'_>, problems: &mut Problems) {
    let scene = loaded.scene;
    let mut report = |what, used| problems.push(PlanWarning::ClassicOnly { what, used });
    for material in scene.materials.iter() {
        if matches!(material.kind, MaterialKind::Whitted { .. }) {
            report("a `whitted` material", material.span);
        }
    }
    for light in &scene.lights {
        if let Some(falloff) = light.kind.falloff()
            && falloff.value != LightKind::PHYSICAL
        {
            report("such a falloff", falloff.span);
        }
    }
}

/// A light from infinitely far and a plane without end.
fn endless(loaded: &Loaded<'_>) -> Option<(Span, Span)> {
    let scene = loaded.scene;
    let far = scene
        .lights
        .iter()
        .find(|light| matches!(light.kind, LightKind::Directional { .. } | LightKind::SunSky(_)));
    let environment = scene.environment.as_ref().map(|environment| environment.span);
    let light = far.map(|light| light.span).or(environment)?;
    let is_plane =
        |object: &&crate::ir::Object| matches!(scene.shapes[object.shape].kind, ShapeKind::Plane { .. });
    Some((light, scene.objects.iter().find(is_plane)?.span))
}

/// The method that suits a scene, whatever it says itself.
pub fn suited(loaded: &Loaded<'_>, camera: Option<&Camera>) -> Method {
    choose(loaded, &effects::effects(loaded, camera)).0
}

/// Photons for the caustics where light from somewhere reaches matt surfaces by way of something sharp: paths from the
/// camera would find its source by luck. Path tracing alone otherwise.
fn choose(loaded: &Loaded<'_>, effects: &[EffectUse]) -> (Method, &'static str) {
    let has = |effect| effects.iter().any(|used| used.effect == effect);
    if !has(Effect::Caustics) {
        return (Method::Pt, "no light reaches a matt surface by way of a specular one");
    }
    let scene = loaded.scene;
    let is_picture =
        |environment: &Environment| matches!(environment.radiance, EnvironmentRadiance::Image(_));
    let has_source = scene.lights.iter().any(|light| light.brightness.value.is_lit())
        || scene.environment.as_ref().is_some_and(|sky| sky.is_lit() && is_picture(sky))
        || has(Effect::MeshLights);
    if has_source {
        (Method::Hybrid, "lights shine through or off something specular: caustics")
    } else {
        (Method::Pt, "light comes from everywhere, and paths find it through anything specular")
    }
}
