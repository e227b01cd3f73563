//! Lights: never negative, seldom dark.

use super::Check;
use super::error::CheckError;
use super::space::{Meshes, OwnMaterial};
use crate::ir::light::EnvironmentRadiance;
use crate::ir::{Brightness, Environment, Light, LightKind, MaterialKind, Method, Object, ShapeKind};
use crate::math::{DVec3, Rgb};
use crate::schema::Type;
use crate::source::{Span, Spanned};

impl Check<'_> {
    /// Checks every light, and that there is one.
    pub(super) fn lights(&mut self) {
        for light in &self.scene.lights {
            self.light(light);
        }
        self.endless_lights();
        self.environment();
    }

    fn light(&mut self, light: &Light) {
        match light.kind {
            LightKind::Sphere { center, radius } => {
                self.positive("the radius of this light", radius, Type::Length);
                self.near("the centre of this light", Spanned::new(center, light.span));
                self.near("the radius of this light", radius.map(DVec3::splat));
            }
            LightKind::Rect { origin, edge_u, edge_v, .. } => {
                let farthest = origin.abs().max((origin + edge_u).abs()).max((origin + edge_v).abs());
                self.near("a corner of this light", Spanned::new(farthest, light.span));
                self.spanned("the edges of this light span no area", edge_u, edge_v, light.span);
            }
            LightKind::Directional { direction } => self.direction("this light", direction),
            LightKind::Point { position, .. } => {
                self.near("the position of this light", Spanned::new(position, light.span))
            }
        }
        self.brightness(light.brightness, light.color, light.span);
    }

    /// Notes planes that shine: light is drawn from an area, and theirs is endless.
    fn endless_lights(&mut self) {
        let scene = self.scene;
        let mut emits: Vec<bool> = Vec::with_capacity(scene.materials.len());
        for material in scene.materials.iter() {
            emits.push(match &material.kind {
                MaterialKind::Emissive { .. } => true,
                MaterialKind::Mix { a, b, .. } => emits[a.index()] || emits[b.index()],
                _ => false,
            });
        }
        for object in &scene.objects {
            let shape = &scene.shapes[object.shape];
            let material = object.material.or(shape.material);
            let is_plane = matches!(shape.kind, ShapeKind::Plane { .. });
            if is_plane && material.is_some_and(|material| emits[material.index()]) {
                self.report(CheckError::EndlessLight { used: object.span });
            }
        }
    }

    /// Notes negative light, and none at all.
    pub(super) fn brightness(&mut self, brightness: Spanned<Brightness>, color: Rgb, light: Span) {
        let (what, least, most) = match brightness.value {
            Brightness::Power(watts) => ("this power", watts, watts),
            Brightness::Irradiance(value) => ("this irradiance", value, value),
            Brightness::Radiance(value) => {
                ("this radiance", value.min_component().into(), value.max_component().into())
            }
            Brightness::Intensity(value) => {
                ("this intensity", value.min_component().into(), value.max_component().into())
            }
        };
        if least < 0.0 {
            let found = match brightness.value {
                Brightness::Power(watts) => Type::Power.write(watts),
                _ => (least as f32).to_string(), // as a colour holds it
            };
            self.report(CheckError::NegativeLight { what, found, used: brightness.span });
        } else if color.min_component() < 0.0 {
            let (what, found) = ("a channel of this light's colour", color.min_component().to_string());
            self.report(CheckError::NegativeLight { what, found, used: light });
        } else if most == 0.0 {
            let help = "give it a power, such as `60W`, or take it away";
            self.report(CheckError::DarkLight { used: brightness.span, help });
        } else if color.is_black() {
            let help = "give it a colour other than black, or take it away";
            self.report(CheckError::DarkLight { used: light, help });
        }
    }

    fn environment(&mut self) {
        let Some(environment) = &self.scene.environment else { return };
        if environment.scale.value < 0.0 {
            let (what, found) = ("the scale of the environment", environment.scale.value.to_string());
            self.report(CheckError::NegativeLight { what, found, used: environment.scale.span });
        }
        if let EnvironmentRadiance::Constant(radiance) = environment.radiance
            && radiance.min_component() < 0.0
        {
            let (what, found) = ("the radiance of the environment", radiance.min_component().to_string());
            self.report(CheckError::NegativeLight { what, found, used: environment.span });
        }
    }

    /// Notes that there is no light at all. A mesh may bring one of its own.
    pub(super) fn any_light(&mut self, meshes: &dyn Meshes) {
        let scene = self.scene;
        let is_lamp = |object: &Object| {
            let is_painted = object.material.or(scene.shapes[object.shape].material).is_some();
            !is_painted && meshes.parts(object.shape).iter().any(|part| part.own == OwnMaterial::Shining)
        };
        let is_ambient = scene.render.method.is_some_and(|method| method.value == Method::Classic)
            && !scene.render.classic.ambient.is_black();
        let lit = is_ambient
            || !scene.lights.is_empty()
            || scene.environment.as_ref().is_some_and(Environment::is_lit)
            || self.placed_materials().any(|(kind, _)| matches!(kind, MaterialKind::Emissive { .. }))
            || scene.objects.iter().any(is_lamp);
        let may_be_lit = lit || !self.whole && scene.intent.light;
        let camera = scene.cameras.first().map(|camera| camera.span).or(scene.intent.camera);
        if let (false, Some(camera)) = (may_be_lit, camera) {
            self.report(CheckError::NoLight { camera });
        }
    }
}
