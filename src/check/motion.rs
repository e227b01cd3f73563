//! What moves, and whether it can be seen to.

use super::Check;
use super::error::CheckError;
use super::light::emitting;
use super::space::{Meshes, OwnMaterial};
use crate::ir::{Camera, Object, is_singular};
use crate::math::Motion;
use crate::source::{Span, Spanned};

impl Check<'_> {
    /// Checks what moves, and the shutters.
    pub(super) fn motions(&mut self) {
        let scene = self.scene;
        for object in scene.objects.iter().filter(|object| !is_singular(&object.world_from_object)) {
            if let Some(motion) = &object.motion {
                self.flattening(motion, object.span);
            }
        }
        for camera in &scene.cameras {
            self.camera_motion(camera);
        }
        let first = scene.objects.iter().find_map(|object| object.motion.as_ref().map(|motion| motion.span));
        let first = first.or_else(|| scene.lights.iter().find_map(|light| light.moves));
        let moving = |camera: &Camera| first.or_else(|| crate::ir::first_moving(&camera.transform));
        for camera in scene.cameras.iter().filter(|camera| camera.shutter.value > 0.0) {
            if moving(camera).is_none() && self.whole {
                self.report(CheckError::IdleShutter { shutter: camera.shutter.span });
            }
        }
        if let (Some(camera), false) = (scene.cameras.first(), self.is_exposed())
            && let Some(motion) = scene.cameras.iter().find_map(moving)
        {
            let camera = Span::new(camera.span.start, camera.span.start + 1);
            self.report(CheckError::ClosedShutter { motion, camera });
        }
        self.moving_lights();
    }

    /// Whether some camera sees motion.
    fn is_exposed(&self) -> bool {
        self.scene.cameras.iter().any(|camera| camera.shutter.value > 0.0)
    }

    /// A motion through something flat.
    fn flattening(&mut self, motion: &Spanned<Motion>, object: Span) {
        if let Some(s) = motion.value.factors().iter().find_map(|factor| factor.flat_at()) {
            let object = Span::new(object.start, object.start + 1);
            let percent = (s * 100.0).round() as u32;
            self.report(CheckError::FlatteningMotion { percent, motion: motion.span, object });
        }
    }

    /// A camera may be moved and turned.
    fn camera_motion(&mut self, camera: &Camera) {
        if let Some(step) = camera.transform.iter().find(|step| !step.factor.is_rigid()) {
            self.report(CheckError::StretchedCamera { factor: step.span });
        }
    }

    /// Lights that move while a shutter is open. Points of lights are drawn, and their power is known, where they stand.
    fn moving_lights(&mut self) {
        let scene = self.scene;
        if !self.is_exposed() {
            return;
        }
        for light in &scene.lights {
            if let Some(motion) = light.moves {
                self.report(CheckError::MovingLight { light: light.span, motion });
            }
        }
        let emits = emitting(scene);
        for object in &scene.objects {
            let material = object.material.or(scene.shapes[object.shape].material);
            if let Some(motion) = &object.motion
                && material.is_some_and(|material| emits[material.index()])
            {
                self.report(CheckError::MovingLight { light: object.span, motion: motion.span });
            }
        }
    }

    /// The same of meshes that bring their own light.
    pub(super) fn moving_meshes(&mut self, meshes: &dyn Meshes) {
        let scene = self.scene;
        let is_painted = |object: &Object| object.material.or(scene.shapes[object.shape].material).is_some();
        if !self.is_exposed() {
            return;
        }
        for object in scene.objects.iter().filter(|object| !is_painted(object)) {
            if let Some(motion) = &object.motion
                && meshes.parts(object.shape).iter().any(|part| part.own == OwnMaterial::Shining)
            {
                self.report(CheckError::MovingLight { light: object.span, motion: motion.span });
            }
        }
    }
}
