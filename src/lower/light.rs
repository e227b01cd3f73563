//! Lights: points and directions as they are, balls and parallelograms as shapes that emit.

use super::tessellate::Triangles;
use super::{Lowering, daylight};
use crate::ir::light::{Brightness, LightKind};
use crate::ir::{self};
use crate::math::{DAffine3, DMat3, DVec3, Rgb};
use crate::render::bsdf::Material;
use crate::render::light::{Environment, Falloff, Light, Spot};
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
            LightKind::Spot { position, direction, angle, blend, falloff } => {
                let half = angle.value / 2.0;
                let cos = |angle: f64| libm::cos(angle) as f32;
                let mut spot = Spot {
                    p: (*position - self.center).as_vec3(),
                    axis: direction.value.normalize().as_vec3().normalize(),
                    cos_inner: cos(half * (1.0 - blend.value)),
                    cos_outer: cos(half),
                    intensity: Rgb::WHITE,
                    falloff: Falloff(falloff.value.map(|x| x as f32)),
                };
                spot.intensity = match light.brightness.value {
                    // The power is all that comes out, so a narrower cone is brighter.
                    Brightness::Power(watts) => {
                        of_unit_luminance(light.color) * (watts / f64::from(spot.power().r)) as f32
                    }
                    _ => intensity(light),
                };
                return Some(Light::Spot(spot));
            }
            LightKind::Disk { center, edge_u, edge_v, two_sided, .. } => {
                let across = edge_u.cross(*edge_v);
                let sides = if *two_sided { 2.0 } else { 1.0 };
                let radiance = radiance(light.brightness.value, light.color, PI * across.length() * sides);
                let frame = DMat3::from_cols(*edge_u, *edge_v, across / across.length().sqrt());
                self.shapes.solids.push(Solid {
                    kind: SolidKind::Disk,
                    world_from_object: DAffine3::from_mat3_translation(frame, *center - self.center),
                    texture_from_object: DAffine3::IDENTITY,
                    material: self.materials.add(Material::Emissive { radiance, two_sided: *two_sided }),
                    source,
                    motion: None,
                });
            }
            // The sky is made an environment of.
            LightKind::SunSky(_) => {}
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
                    motion: None,
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

/// The sky of a light that is one.
pub(super) fn sky(light: &ir::Light) -> Option<Environment> {
    let LightKind::SunSky(day) = &light.kind else { return None };
    let scale = match light.brightness.value {
        Brightness::Power(value) | Brightness::Irradiance(value) => value as f32,
        Brightness::Radiance(value) | Brightness::Intensity(value) => value.luminance(),
    };
    Some(Environment { radiance: daylight::radiance(day), scale, rotation: 0.0 })
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
