//! What the materials of mesh files call for.

use super::caustics::{LEAST_SPECULAR, SHARP_ROUGHNESS, SHARP_SHININESS};
use super::effect::Effect;
use super::effects::MIRROR_ROUGHNESS;
use crate::asset::Look;
use crate::asset::look::Shade;

/// What a material calls for.
#[derive(Default)]
pub struct Called {
    /// The effects, some of them perhaps more than once.
    pub effects: Vec<Effect>,
    /// Whether it throws caustics.
    pub casts: bool,
    /// Whether some of the light goes on so sharply that photons may be aimed at it.
    pub may_throw: bool,
}

/// What a material of a mesh file calls for. In doubt an effect is called for.
pub fn called(look: &Look) -> Called {
    use Effect::{
        Absorption, Alpha, Dielectrics, Dispersion, Indirect, MeshLights, NormalMaps, RoughSpecular, Specular,
    };
    let mut out = Called::default();
    if !look.pictures().is_empty() {
        out.effects.extend([Effect::Textures, Effect::TextureFiltering]);
    }
    match look {
        Look::Diffuse { .. } => out.effects.push(Indirect),
        Look::Phong { specular, shininess, .. } => {
            out.effects.extend([Indirect, RoughSpecular]);
            out.may_throw = f64::from(*shininess) > SHARP_SHININESS;
            out.casts = out.may_throw && specular.iter().sum::<f32>() / 3.0 >= LEAST_SPECULAR;
        }
        Look::Emissive { .. } => out.effects.push(MeshLights),
        Look::Glass(of) => {
            out.effects.push(Dielectrics);
            out.effects.extend(gloss(&of.roughness));
            out.effects.extend(of.attenuation.is_some().then_some(Absorption));
            out.effects.extend(of.abbe.is_some().then_some(Dispersion));
            (out.casts, out.may_throw) = (true, true);
        }
        Look::Principled(of) => {
            let is_clear = !of.transmission.is_black();
            out.effects.extend([Indirect, RoughSpecular]);
            out.effects.extend(is_clear.then_some([Specular, Dielectrics]).into_iter().flatten());
            out.effects.extend((of.emission != [0.0; 3]).then_some(MeshLights));
            let is_sharp = of.roughness.map.is_some() || of.roughness.factor[0] < SHARP_ROUGHNESS;
            out.casts = is_clear || !of.metallic.is_black() && is_sharp;
            out.may_throw = true;
        }
        Look::Mask { base, .. } | Look::NormalMap { base, .. } => {
            let inner = called(base);
            out.effects.extend(inner.effects);
            out.effects.push(if matches!(look, Look::Mask { .. }) { Alpha } else { NormalMaps });
            (out.casts, out.may_throw) = (inner.casts, inner.may_throw);
        }
    }
    out
}

/// How sharply a surface of this roughness scatters.
fn gloss(roughness: &Shade) -> Vec<Effect> {
    let value = roughness.factor[0];
    match roughness.map {
        None if value < MIRROR_ROUGHNESS[0] => vec![Effect::Specular],
        None if value > MIRROR_ROUGHNESS[1] => vec![Effect::RoughSpecular, Effect::Indirect],
        _ => vec![Effect::Specular, Effect::RoughSpecular, Effect::Indirect],
    }
}
