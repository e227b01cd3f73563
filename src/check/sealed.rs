//! What an opaque ball hides: a light in it that nobody sees, a camera in it that sees nothing.

use super::Check;
use super::error::CheckError;
use crate::ir::{LightKind, MaterialKind, Object, ShapeKind, is_singular};
use crate::math::DVec3;

/// How many lights are looked for in each ball: enough to show the mistake where there are thousands.
const LIGHTS: usize = 64;

impl Check<'_> {
    /// Notes lights and cameras that an opaque ball seals up. Both in one ball are a room, and that is well.
    pub(super) fn sealed(&mut self) {
        if !self.whole {
            return;
        }
        let scene = self.scene;
        let glows =
            scene.materials.iter().any(|material| matches!(material.kind, MaterialKind::Emissive { .. }));
        for object in &scene.objects {
            let Some(is_inside) = self.inside_of(object) else { continue };
            let camera = scene.cameras.iter().find(|camera| is_inside(camera.position.value));
            let light = scene.lights.iter().take(LIGHTS).find(|light| match light.kind {
                LightKind::Point { position: p, .. } | LightKind::Sphere { center: p, .. } => is_inside(p),
                LightKind::Rect { origin, .. } => is_inside(origin),
                LightKind::Directional { .. } => false,
            });
            match (camera, light) {
                (Some(camera), None) if !glows => {
                    let (camera, object) = (camera.position.span, object.span);
                    self.report(CheckError::CameraSealed { camera, object });
                }
                // Lights of some size may stick out.
                (None, Some(light)) if matches!(light.kind, LightKind::Point { .. }) => {
                    self.report(CheckError::LightSealed { light: light.span, object: object.span });
                }
                _ => {}
            }
        }
    }

    /// Tells of a point of the world whether it lies in this object, when it is a ball that lets no light through.
    fn inside_of(&self, object: &Object) -> Option<impl Fn(DVec3) -> bool + use<>> {
        let shape = &self.scene.shapes[object.shape];
        let ShapeKind::Sphere { center, radius } = shape.kind else { return None };
        let material = object.material.or(shape.material).map(|handle| &self.scene.materials[handle].kind);
        let is_opaque = matches!(
            material,
            None | Some(
                MaterialKind::Diffuse { .. }
                    | MaterialKind::Phong { .. }
                    | MaterialKind::Mirror { .. }
                    | MaterialKind::Metal { .. }
            )
        );
        if !is_opaque || is_singular(&object.world_from_object) {
            return None;
        }
        let object_from_world = object.world_from_object.inverse();
        Some(move |p| object_from_world.transform_point3(p).distance(center) < radius.value)
    }
}
