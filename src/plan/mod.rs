//! What a scene calls for: its effects with the lines that need them, and the method that suits them.

mod absent;
mod caustics;
mod effect;
mod effects;
mod error;
mod look;
mod wanted;

use crate::diag::Problems;
use crate::ir::light::{Environment, EnvironmentRadiance, LightKind};
use crate::ir::{Camera, MaterialKind, Method, PixelPoint, ShapeKind};
use crate::load::Loaded;
use crate::source::Span;
pub use effect::Effect;
pub use effects::{EffectUse, LEAST_SHARED};
pub use error::PlanWarning;
pub use wanted::Wanted;

/// What will be simulated, and how.
#[derive(Clone, PartialEq, Debug)]
pub struct Plan {
    /// The effects that the scene calls for.
    pub effects: Vec<EffectUse>,
    /// The others, each with the reason why it does not.
    pub absent: Vec<(Effect, String)>,
    /// What is simulated: by default what is called for or may be there, so that nothing is lost; see [`Plan::want`].
    pub simulated: Vec<Effect>,
    in_doubt: Vec<Effect>,
    /// The integrator.
    pub method: Method,
    /// Who chose it.
    pub chosen_by: ChosenBy,
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
    /// How shapes that triangles may stand for are made.
    pub tessellation: Tessellation,
    /// Whether every pass would be like the first, because nothing is drawn at random.
    pub is_exact: bool,
}

/// How shapes that triangles may stand for, those of `revolve`, `sweep` and `extrude`, are made.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Tessellation {
    /// As each of them says.
    AsWritten,
    /// Without triangles where there is another way, which is so for `revolve`; the others as they say.
    Exact,
    /// Of triangles that lie within so many metres of the shape in its own frame, whatever it says.
    Within(f64),
}

impl Plan {
    /// Whether the scene calls for an effect.
    pub fn needs(&self, effect: Effect) -> bool {
        self.effects.iter().any(|used| used.effect == effect)
    }

    /// Whether the scene may call for an effect, be it ever so weakly.
    pub fn may_need(&self, effect: Effect) -> bool {
        self.in_doubt.contains(&effect)
    }

    /// Whether an effect is simulated.
    pub fn simulates(&self, effect: Effect) -> bool {
        self.simulated.contains(&effect)
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

/// Which method a command asks for.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub enum Wish {
    /// None: what the scene asks for counts.
    #[default]
    Scene,
    /// The one that suits the scene, also against what the scene says.
    Auto,
    /// This one.
    Method(Method),
}

impl From<Option<Method>> for Wish {
    fn from(method: Option<Method>) -> Self {
        method.map_or(Self::Scene, Self::Method)
    }
}

/// Who chose the method of a plan.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ChosenBy {
    /// The compiler, because it suits the scene.
    Compiler,
    /// The scene, here.
    Scene(Span),
    /// The command.
    Command,
}

/// Derives the plan of a scene seen by `camera`. A wish for a method overrides the scene's own.
pub fn plan(loaded: &Loaded<'_>, camera: Option<&Camera>, wish: impl Into<Wish>) -> Plan {
    let effects::Survey { uses: effects, in_doubt, absent } = effects::survey(loaded, camera);
    let render = &loaded.scene.render;
    let (method, chosen_by, why) = match (wish.into(), render.method) {
        (Wish::Method(method), _) => (method, ChosenBy::Command, "asked for on the command line"),
        (Wish::Scene, Some(method)) => (method.value, ChosenBy::Scene(method.span), "asked for by the scene"),
        (Wish::Scene | Wish::Auto, _) => {
            let (method, why) = choose(loaded, &effects);
            (method, ChosenBy::Compiler, why)
        }
    };
    let photons = &render.photons;
    let (photon_count, photon_k) = match method {
        Method::Hybrid => (camera.map_or(PHOTON_COUNT, caustic_photons), CAUSTIC_PHOTON_K),
        _ => (PHOTON_COUNT, PHOTON_K),
    };
    let depth = if method == Method::Classic { CLASSIC_DEPTH } else { DEPTH };
    let draws = |used: &EffectUse| {
        use Effect::{LensBlur, MeshLights, Motion, SoftShadows};
        matches!(used.effect, LensBlur | SoftShadows | MeshLights | Motion)
    };
    let is_exact =
        method == Method::Classic && render.classic.pixel != PixelPoint::Filter && !effects.iter().any(draws);
    Plan {
        effects,
        absent,
        simulated: in_doubt.clone(),
        in_doubt,
        method,
        chosen_by,
        why: why.to_owned(),
        photon_count: photons.count.map_or(photon_count, |count| count.value),
        photon_k: photons.k.map_or(photon_k, |k| k.value),
        photon_radius: photons.radius.map(|radius| radius.value),
        photon_shrink: photons.shrink.map_or(PHOTON_SHRINK, |shrink| shrink.value),
        depth: render.depth.map_or(depth, |depth| depth.value),
        tessellation: Tessellation::AsWritten,
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
    let asked = match plan.chosen_by {
        ChosenBy::Compiler => None,
        ChosenBy::Scene(span) => Some(Some(span)),
        ChosenBy::Command => Some(None),
    };
    if let (Method::Pt, Some(asked)) = (plan.method, asked) {
        crate::check::paths_miss(loaded.scene, loaded, asked, problems);
    }
    let is_kept = plan.needs(Effect::Indirect);
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
