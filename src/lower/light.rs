//! Lights: points and directions as they are, balls and parallelograms as shapes that emit.

use super::Lowering;
use super::tessellate::Triangles;
use crate::ir::light::{Brightness, LightKind};
use crate::ir::{self};
use crate::math::{DAffine3, DVec3, Rgb};
use crate::render::bsdf::Material;
use crate::render::light::{Falloff, Light};
use crate::render::shape::{Solid, SolidKind};
use std::f64::consts::PI;

impl Lowering<'_> {
    /// Lowers a light; one with a surface becomes a shape, and the engine finds it by its emission.
    pub(super) fn light(&mut self, light: &ir::Light) -> Option<Light> {
        let source = self.source(light.span);
        match &light.kind {
            LightKind::Point { position, falloff } => {
                let p = (*position - self.center).as_vec3();
                let falloff = Falloff(falloff.value.map(|x| x as f32));
                return Some(Light::Point { p, intensity: intensity(light), falloff });
            }
            LightKind::Directional { direction } => {
                let direction = direction.value.normalize().as_vec3();
                return Some(Light::Directional { direction, irradiance: irradiance(light) });
            }
            LightKind::Sphere { center, radius } => {
                let area = 4.0 * PI * radius.value * radius.value;
                let radiance = radiance(light.brightness.value, light.color, area);
                let material = self.materials.add(Material::Emissive { radiance, two_sided: false });
                let scale = DVec3::splat(radius.value);
                let world_from_object =
                    DAffine3::from_translation(*center - self.center) * DAffine3::from_scale(scale);
                let texture_from_object = DAffine3::IDENTITY;
                self.shapes.solids.push(Solid {
                    kind: SolidKind::Sphere,
                    world_from_object,
                    texture_from_object,
                    material,
                    source,
                });
            }
            LightKind::Rect { origin, edge_u, edge_v, two_sided } => {
                let sides = if *two_sided { 2.0 } else { 1.0 };
                let area = edge_u.cross(*edge_v).length() * sides;
                let radiance = radiance(light.brightness.value, light.color, area);
                let material = self.materials.add(Material::Emissive { radiance, two_sided: *two_sided });
                let shape = Triangles::quad(*origin, *edge_u, *edge_v);
                self.mesh(&shape, &DAffine3::IDENTITY, material, source);
            }
        }
        None
    }
}

/// The radiance of a surface of this area (both sides counted where both shine), in W·m⁻²·sr⁻¹: Φ = π·A·L.
pub(super) fn radiance(brightness: Brightness, color: Rgb, area: f64) -> Rgb {
    match brightness {
        Brightness::Power(watts) => of_unit_luminance(color) * (watts / (PI * area)) as f32,
        Brightness::Radiance(radiance) | Brightness::Intensity(radiance) => radiance * color,
        Brightness::Irradiance(value) => color * (value / PI) as f32,
    }
}

fn intensity(light: &ir::Light) -> Rgb {
    match light.brightness.value {
        Brightness::Power(watts) => of_unit_luminance(light.color) * (watts / (4.0 * PI)) as f32,
        Brightness::Intensity(value) | Brightness::Radiance(value) => value * light.color,
        Brightness::Irradiance(value) => light.color * value as f32,
    }
}

fn irradiance(light: &ir::Light) -> Rgb {
    match light.brightness.value {
        Brightness::Irradiance(value) | Brightness::Power(value) => light.color * value as f32,
        Brightness::Radiance(value) | Brightness::Intensity(value) => value * light.color,
    }
}

/// Watts count by luminance: the colour is scaled to have 1; black stays black.
fn of_unit_luminance(color: Rgb) -> Rgb {
    let luminance = color.luminance();
    if luminance > 0.0 { color / luminance } else { Rgb::BLACK }
}
