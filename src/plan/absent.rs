//! Why a scene does not call for an effect, in words.

use super::effect::Effect;
use crate::ir::{Camera, Lens, MaterialKind, Scene, ShapeKind};

/// The reason why an effect is not called for, as the end of a sentence.
pub fn why(effect: Effect, scene: &Scene, camera: Option<&Camera>) -> String {
    let reason = match effect {
        Effect::LensBlur => match camera.map(|camera| &camera.lens) {
            Some(Lens::Pinhole { .. }) => "no lens opening: pinhole",
            Some(Lens::Thin { .. }) => "no lens opening: an aperture of 0",
            Some(Lens::Orthographic { .. }) => "no lens opening: orthographic",
            Some(Lens::Panorama { .. }) => "no lens opening: panorama",
            Some(Lens::Fisheye { .. }) => "no lens opening: fisheye",
            Some(Lens::Prescription { .. }) | None => "no camera",
        },
        Effect::Motion if camera.is_some_and(|camera| camera.shutter.value > 0.0) => "nothing moves",
        Effect::Motion => "the shutter is open for no time",
        Effect::SoftShadows if !scene.lights.is_empty() => {
            "every light is a point or comes from one direction"
        }
        Effect::SoftShadows => "no light with a size",
        Effect::Environment => "no environment, no sky",
        Effect::MeshLights => "no object shines",
        Effect::Textures => "every colour is the same all over",
        Effect::TextureFiltering => "no surface takes its colour from a picture",
        Effect::NormalMaps => "no normal map, no bump",
        Effect::Alpha => "no mask: nothing has holes",
        Effect::SmoothNormals => "no triangles with normals of their own",
        Effect::Instances if has_meshes(scene) => "no large mesh is placed twice",
        Effect::Instances => "no mesh",
        Effect::Specular => "no mirror, no clear glass",
        Effect::Dielectrics => "no glass",
        Effect::RoughSpecular => "nothing is glossy",
        Effect::Absorption if has_glass(scene) => "no glass is coloured inside",
        Effect::Dispersion if has_glass(scene) => "no glass has an Abbe number",
        Effect::Absorption | Effect::Dispersion => "no glass",
        Effect::Indirect => "no matt surface",
        Effect::Caustics => "no light, nothing sharp, or nothing matt",
    };
    reason.to_owned()
}

fn has_meshes(scene: &Scene) -> bool {
    scene.objects.iter().any(|object| matches!(scene.shapes[object.shape].kind, ShapeKind::Mesh { .. }))
}

fn has_glass(scene: &Scene) -> bool {
    scene.materials.iter().any(|material| matches!(material.kind, MaterialKind::Glass { .. }))
}
