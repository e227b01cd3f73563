//! Which light is thrown onto matt surfaces by what: lights, casters and receivers as volumes that hold them.

use super::effects::is_black;
use crate::check::Region;
use crate::ir::light::{Environment, LightKind};
use crate::ir::material::{Input, MaterialKind};
use crate::ir::{Handle, Light, Material, Scene};
use crate::math::DVec3;
use crate::source::Span;
use std::f64::consts::FRAC_PI_2;

/// A metal smoother than this, and a Phong lobe narrower, gathers light into caustics rather than spreading it: the
/// engine's own threshold, which draws the line between photons and paths.
pub const SHARP_ROUGHNESS: f32 = 0.5;
pub const SHARP_SHININESS: f64 = 32.0;
/// A glossy lobe weaker than this throws nothing that is worth photons.
pub const LEAST_SPECULAR: f32 = 0.1;

/// An object that throws caustics where light meets it.
pub struct Caster {
    /// Its material.
    pub span: Span,
    /// What holds it; `None` for what has no end.
    pub region: Option<Region>,
}

/// What is missing for caustics; `None` where nothing is.
pub fn missing(
    casters: &[Caster],
    scene: &Scene,
    objects_shine: bool,
    is_received: bool,
) -> Option<&'static str> {
    let any_light = objects_shine
        || scene.lights.iter().any(|light| light.brightness.value.is_lit())
        || scene.environment.as_ref().is_some_and(Environment::is_lit);
    match () {
        () if casters.is_empty() => Some("nothing focuses light: no glass, no mirror, no polished metal"),
        () if !any_light => Some("no light that could be focused"),
        () if !is_received => Some("no matt surface for them to fall on"),
        () if !casters.iter().any(|caster| is_lit(caster, scene, objects_shine)) => {
            Some("no light reaches what would throw them")
        }
        () => None,
    }
}

/// Whether some light may reach a caster.
pub fn is_lit(caster: &Caster, scene: &Scene, objects_shine: bool) -> bool {
    let lit = scene.lights.iter().filter(|light| light.brightness.value.is_lit());
    objects_shine
        || scene.environment.as_ref().is_some_and(Environment::is_lit)
        || lit.into_iter().any(|light| reaches(light, caster.region.as_ref()))
}

/// Whether light may get from a light to something in a region, or to something endless, with nothing in between.
fn reaches(light: &Light, region: Option<&Region>) -> bool {
    let Some(region) = region else { return true };
    let is_before = |p: DVec3, u: DVec3, v: DVec3| {
        let n = u.cross(v);
        region.support(n) > n.dot(p)
    };
    match light.kind {
        LightKind::Rect { origin, edge_u, edge_v, two_sided: false } => is_before(origin, edge_u, edge_v),
        LightKind::Disk { center, edge_u, edge_v, two_sided: false, .. } => is_before(center, edge_u, edge_v),
        LightKind::Spot { position, direction, angle, .. } => {
            let (center, radius) = region.ball();
            let to = center - position;
            let half_width = FRAC_PI_2 * radius / to.length(); // no less than the arc sine
            radius >= to.length() || to.angle_between(direction.value) - half_width <= angle.value / 2.0
        }
        _ => true,
    }
}

/// The material by which an object throws caustics, if it does.
pub fn caster(scene: &Scene, material: Handle<Material>) -> Option<Span> {
    let Material { kind, span, .. } = &scene.materials[material];
    if casts(kind) {
        return Some(*span);
    }
    kind.parts().into_iter().find_map(|part| caster(scene, part))
}

/// Whether light goes on from a material so sharply that it throws caustics.
fn casts(kind: &MaterialKind) -> bool {
    let may_exceed = |input: &Input, least: f32| match input {
        Input::Constant(color) => color.value.mean() >= least,
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

fn is_sharp(roughness: &Input) -> bool {
    match roughness {
        Input::Constant(roughness) => roughness.value.mean() < SHARP_ROUGHNESS,
        Input::Texture(_) => true,
    }
}

/// Whether some of the light goes on so sharply that the engine may aim photons at it, be it ever so little: the coat of
/// plastic, for one. Too weak to choose a method by, but no promise that there is nothing.
pub fn may_throw(kind: &MaterialKind) -> bool {
    match kind {
        MaterialKind::Plastic { roughness, .. } | MaterialKind::Layer { roughness, .. } => {
            is_sharp(roughness)
        }
        MaterialKind::Phong { shininess, .. } => shininess.value > SHARP_SHININESS,
        MaterialKind::Principled(_) => true,
        kind => casts(kind),
    }
}
