//! Lights: never negative, seldom dark.

use super::Check;
use super::error::CheckError;
use super::space::{Meshes, OwnMaterial};
use crate::ir::light::{Daylight, EnvironmentRadiance};
use crate::ir::{Brightness, Environment, Light, LightKind, MaterialKind, Method, Object, Scene, ShapeKind};
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
        self.one_sky();
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
            LightKind::Spot { position, direction, angle, blend, .. } => {
                self.near("the position of this light", Spanned::new(position, light.span));
                self.direction("this light", direction);
                self.within("the angle of its cone", angle, Type::Angle, 0.0, std::f64::consts::PI, "30deg");
                self.part("its `blend`", blend, "0.2");
            }
            LightKind::Disk { center, radius, .. } => {
                self.positive("the radius of this light", radius, Type::Length);
                self.near("the centre of this light", Spanned::new(center, light.span));
                self.near("the radius of this light", radius.map(DVec3::splat));
            }
            LightKind::SunSky(ref day) => self.daylight(day),
            LightKind::Point { position, .. } => {
                self.near("the position of this light", Spanned::new(position, light.span))
            }
        }
        self.brightness(light.brightness, light.color, light.span);
    }

    /// The formula knows the sun above the horizon, in air that is neither empty nor fog.
    fn daylight(&mut self, day: &Daylight) {
        self.direction("the way to the sun", day.to_sun);
        let sine = day.to_sun.value.normalize_or(DVec3::Y).y;
        if sine <= 0.0 {
            let degrees = (libm::asin(sine).to_degrees() * 10.0).round() / 10.0;
            let found = format!("{degrees}deg");
            let (what, range) = ("the sun's height", "above the horizon".to_owned());
            let example = "elevation: 30deg".to_owned();
            self.report(CheckError::OutOfRange { what, found, range, example, used: day.to_sun.span });
        }
        self.within("the turbidity", day.turbidity, Type::Number, 1.7, 10.0, "3");
        self.within("the size of the sun", day.sun_size, Type::Angle, 0.0, 1.6, "0.533deg");
        for channel in [day.ground.min_component(), day.ground.max_component()] {
            if !(0.0..=1.0).contains(&channel) {
                let (what, found) = ("the colour of the ground", channel.to_string());
                let (range, example) = ("from 0 to 1".to_owned(), "ground: 0.2".to_owned());
                self.report(CheckError::OutOfRange { what, found, range, example, used: day.to_sun.span });
                break;
            }
        }
    }

    /// Notes a share outside of [0, 1].
    pub(super) fn part(&mut self, what: &'static str, share: Spanned<f64>, example: &str) {
        if !(0.0..=1.0).contains(&share.value) {
            let (found, range) = (Type::Number.write(share.value), "from 0 to 1".to_owned());
            let example = example.to_owned();
            self.report(CheckError::OutOfRange { what, found, range, example, used: share.span });
        }
    }

    /// Notes a number that is not greater than `least` or is greater than `most`.
    pub(super) fn within(
        &mut self,
        what: &'static str,
        number: Spanned<f64>,
        ty: Type,
        least: f64,
        most: f64,
        example: &str,
    ) {
        if !(least < number.value && number.value <= most) {
            let found = ty.write(number.value);
            let range = format!("greater than {} and at most {}", ty.write(least), ty.write(most));
            let example = example.to_owned();
            self.report(CheckError::OutOfRange { what, found, range, example, used: number.span });
        }
    }

    /// Notes a second source of light from everywhere.
    fn one_sky(&mut self) {
        let mut skies = self.scene.lights.iter().filter(|light| matches!(light.kind, LightKind::SunSky(_)));
        let environment = self.scene.environment.as_ref().map(|environment| environment.span);
        let Some(first) = environment.or_else(|| skies.next().map(|light| light.span)) else { return };
        if let Some(second) = skies.next().map(|light| light.span) {
            self.report(CheckError::SecondSky { second, first });
        }
    }

    /// Notes planes that shine: light is drawn from an area, and theirs is endless.
    fn endless_lights(&mut self) {
        let scene = self.scene;
        let emits = emitting(scene);
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
            || self.placed_materials().any(|(kind, _)| shines(kind))
            || scene.objects.iter().any(is_lamp);
        let may_be_lit = lit || !self.whole && scene.intent.light;
        let camera = scene.cameras.first().map(|camera| camera.span).or(scene.intent.camera);
        if let (false, Some(camera)) = (may_be_lit, camera) {
            self.report(CheckError::NoLight { camera });
        }
    }
}

/// Of each material, whether it or a part of it sends out light of its own.
pub(super) fn emitting(scene: &Scene) -> Vec<bool> {
    let mut emits: Vec<bool> = Vec::with_capacity(scene.materials.len());
    for material in scene.materials.iter() {
        // Parts are written before what is made of them.
        let parts = material.kind.parts();
        emits.push(shines(&material.kind) || parts.into_iter().any(|part| emits[part.index()]));
    }
    emits
}

/// Whether a material sends out light of its own.
fn shines(kind: &MaterialKind) -> bool {
    match kind {
        MaterialKind::Emissive { .. } => true,
        MaterialKind::Principled(of) => !of.emission.is_black(),
        _ => false,
    }
}
