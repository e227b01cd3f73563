//! Which effects the engine simulates, and the scene without those that are left out.

use super::camera::Seen;
use crate::ir;
use crate::plan::{Effect, Plan};
use crate::render::Effects;
use crate::render::camera::LensSpec;
use crate::render::light::Environment;

/// What rays ask about, by the name that a plan has for it.
const ASKED: [(Effect, Effects); 9] = [
    (Effect::LensBlur, Effects::LENS_BLUR),
    (Effect::Alpha, Effects::ALPHA),
    (Effect::Dispersion, Effects::DISPERSION),
    (Effect::Absorption, Effects::ABSORPTION),
    (Effect::NormalMaps, Effects::NORMAL_MAPS),
    (Effect::Caustics, Effects::CAUSTICS),
    (Effect::Indirect, Effects::INDIRECT),
    (Effect::Motion, Effects::MOTION),
    (Effect::TextureFiltering, Effects::TEXTURE_FILTERING),
];

/// The effects that the engine is to simulate.
pub(super) fn effects(plan: &Plan) -> Effects {
    let asked = ASKED.into_iter().filter(|(effect, _)| plan.simulates(*effect));
    let effects = asked.fold(Effects::NONE, |all, (_, effect)| all | effect);
    // What paths leave to photons that nobody sends is in no picture.
    if drops_caustics(plan) { effects | Effects::CAUSTICS } else { effects }
}

/// Whether caustics are there, and left out.
pub(super) fn drops_caustics(plan: &Plan) -> bool {
    plan.may_need(Effect::Caustics) && !plan.simulates(Effect::Caustics)
}

/// What surrounds the scene, where that is simulated.
pub(super) fn surroundings(plan: &Plan, environment: Option<Environment>) -> Option<Environment> {
    environment.filter(|_| plan.simulates(Effect::Environment))
}

/// A camera without an opening, and one that stands still, where those are not simulated.
pub(super) fn hold_camera(plan: &Plan, camera: &mut Seen) {
    if !plan.simulates(Effect::Motion) {
        camera.spec.motion = None;
    }
    if let (false, Some(LensSpec::Thin(lens))) = (plan.simulates(Effect::LensBlur), &mut camera.spec.lens) {
        lens.radius = 0.0;
    }
}

/// Whether pictures are filtered; not by recursive ray tracing, whose pictures are to be those of others, pixel by pixel.
pub(super) fn filters(plan: &Plan) -> bool {
    plan.simulates(Effect::TextureFiltering) && plan.method != ir::Method::Classic
}

/// The share of a frame for which the shutter is open; 0 where motion is left out.
pub(super) fn shutter(plan: &Plan, camera: &ir::Camera) -> f64 {
    if plan.simulates(Effect::Motion) { camera.shutter.value } else { 0.0 }
}

/// Whether a method can do without an effect that the scene calls for; why not, in a sentence.
///
/// # Errors
/// What bars it.
pub fn can_leave_out(effect: Effect, plan: &Plan, camera: &ir::Camera) -> Result<(), String> {
    match (effect, plan.method) {
        (Effect::Caustics, ir::Method::Ppm) => {
            Err("photons bring all light in `ppm`: leave caustics out of `--method hybrid` or `pt`"
                .to_owned())
        }
        (Effect::Caustics | Effect::Indirect, ir::Method::Classic) => {
            Err(format!("`classic` never has `{}`", effect.name()))
        }
        (Effect::LensBlur, _) if matches!(camera.lens, ir::Lens::Prescription { .. }) => {
            Err("a real lens has an opening: use `lens: thin` or `pinhole`".to_owned())
        }
        _ => Ok(()),
    }
}
