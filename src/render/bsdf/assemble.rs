//! From a material to the lobes that it has at a point.

use super::conductor::{Conductor, MIRROR_ALPHA};
use super::material::{Glass, Material, Principled};
use super::{Bsdf, Coat, Lobe, Materials, Pane, Reflectance, RoughDielectric, Substrate};
use crate::math::Rgb;
use crate::render::geometry::SurfacePoint;
use crate::render::shape::MaterialId;

/// The refractive index of a clear coat over a principled material (KHR_materials_clearcoat).
const CLEARCOAT_IOR: f32 = 1.5;

impl Materials {
    pub(super) fn add_lobes(&self, id: MaterialId, share: f32, surface: &SurfacePoint, bsdf: &mut Bsdf) {
        match *self.get(id) {
            Material::Diffuse { color } | Material::Whitted { diffuse: color, .. } => {
                bsdf.add(Lobe::Lambert { albedo: self.color(color, surface) * share });
            }
            Material::Phong { diffuse, specular, shininess } => {
                let (diffuse, specular) = (self.color(diffuse, surface), self.color(specular, surface));
                let scale = share / (diffuse + specular).max_component().max(1.0);
                bsdf.add(Lobe::Lambert { albedo: diffuse * scale });
                bsdf.add(Lobe::Phong { albedo: specular * scale, exponent: shininess });
            }
            Material::Mirror { color } => {
                let color = self.color(color, surface) * share;
                bsdf.add(Lobe::Mirror(Reflectance::flat(color)));
            }
            Material::Metal { f0, edge, roughness } => {
                let alpha = self.alpha(roughness, surface);
                let reflectance = Reflectance::metal(self.color(f0, surface), self.color(edge, surface));
                bsdf.add(metal(reflectance, alpha, share));
            }
            Material::Glass(glass) => {
                let alpha = self.alpha(glass.roughness, surface);
                bsdf.add(clear(&glass, alpha, share));
            }
            Material::Plastic { color, ior, roughness } => {
                let (color, alpha) = (self.color(color, surface), self.alpha(roughness, surface));
                add_coated(bsdf, color, ior, alpha, share);
            }
            Material::Layer { base, ior, roughness, cover } => {
                let (alpha, cover) = (self.alpha(roughness, surface), self.scalar(cover, surface));
                let first = bsdf.lobes().len();
                self.add_lobes(base, share, surface, bsdf);
                add_coat(bsdf, first, ior, alpha, cover.clamp(0.0, 1.0), share);
            }
            Material::Principled(ref principled) => self.add_principled(principled, share, surface, bsdf),
            Material::Mask { base, .. }
            | Material::TwoSided { front: base, .. }
            | Material::Glow { base, .. }
            | Material::Relief { base, .. } => self.add_lobes(base, share, surface, bsdf),
            Material::Emissive { .. } => {}
            Material::Mix { a, b, amount } => {
                let amount = self.scalar(amount, surface).clamp(0.0, 1.0);
                if amount < 1.0 {
                    self.add_lobes(a, share * (1.0 - amount), surface, bsdf);
                }
                if amount > 0.0 {
                    self.add_lobes(b, share * amount, surface, bsdf);
                }
            }
        }
    }

    /// glTF 2.0, appendix B, with KHR_materials_transmission, _ior and _clearcoat: metal and dielectric by shares, the
    /// dielectric matt or clear by shares, under a coat.
    fn add_principled(&self, of: &Principled, share: f32, surface: &SurfacePoint, bsdf: &mut Bsdf) {
        let unit = |input| self.scalar(input, surface).clamp(0.0, 1.0);
        let (color, alpha) = (self.color(of.color, surface), self.alpha(of.roughness, surface));
        let (metallic, transmission, clearcoat) =
            (unit(of.metallic), unit(of.transmission), unit(of.clearcoat));
        let first = bsdf.lobes().len();
        if metallic > 0.0 {
            bsdf.add(metal(Reflectance::metal(color, Rgb::WHITE), alpha, share * metallic));
        }
        let (matt, through) = (1.0 - transmission, transmission);
        if metallic < 1.0 && matt > 0.0 {
            add_coated(bsdf, color, of.ior, alpha, share * (1.0 - metallic) * matt);
        }
        if metallic < 1.0 && through > 0.0 {
            // Light that goes into a body and out again takes on the colour once.
            let glass = Glass { tint: color.map(f32::sqrt), ..Glass::of_ior(of.ior) };
            bsdf.add(clear(&glass, alpha, share * (1.0 - metallic) * through));
        }
        if clearcoat > 0.0 {
            let alpha = self.alpha(of.clearcoat_roughness, surface);
            add_coat(bsdf, first, CLEARCOAT_IOR, alpha, clearcoat, share);
        }
    }
}

/// Metal of any roughness.
fn metal(reflectance: Reflectance, alpha: f32, share: f32) -> Lobe {
    if alpha < MIRROR_ALPHA {
        Lobe::Mirror(reflectance * share)
    } else {
        Lobe::Conductor(Conductor::metal(reflectance, alpha, share))
    }
}

/// Glass of any roughness and thickness.
fn clear(glass: &Glass, alpha: f32, share: f32) -> Lobe {
    let &Glass { ior, tint, thin, .. } = glass;
    if thin {
        Lobe::Pane(Pane { share, ior, tint, alpha })
    } else if alpha < MIRROR_ALPHA || (ior - 1.0).abs() < RoughDielectric::LEAST_BEND {
        Lobe::Dielectric { share, ior, tint }
    } else {
        Lobe::RoughDielectric(RoughDielectric { share, ior, tint, alpha })
    }
}

/// The outside of something clear.
fn shine(ior: f32, alpha: f32, share: f32) -> Lobe {
    let reflectance = Reflectance::of_ior(ior);
    if alpha < MIRROR_ALPHA {
        Lobe::Mirror(reflectance * share)
    } else {
        Lobe::Conductor(Conductor::coat(reflectance, alpha, share))
    }
}

/// A matt body under its own coat.
fn add_coated(bsdf: &mut Bsdf, color: Rgb, ior: f32, alpha: f32, share: f32) {
    bsdf.add(Lobe::Substrate(Substrate::new(color, ior, Coat::new(ior, alpha, 1.0), share)));
    bsdf.add(shine(ior, alpha, share));
}

/// A coat over the lobes from `first` on.
fn add_coat(bsdf: &mut Bsdf, first: usize, ior: f32, alpha: f32, cover: f32, share: f32) {
    if cover > 0.0 {
        bsdf.cover(Coat::new(ior, alpha, cover), first);
        bsdf.add(shine(ior, alpha, share * cover));
    }
}

/// The most lobes that a material can have at a point: each glossy part and each glass is one, all diffuse parts
/// together are one, and all mirrors are, apart from those under a coat. A world takes no material with more than
/// [`Bsdf::MAX_LOBES`], and none with two coats.
pub fn lobe_count(materials: &[Material], id: MaterialId) -> usize {
    let mut parts = Vec::new();
    collect_parts(materials, id, false, &mut parts);
    let any = |wanted: fn(&Material) -> bool, under| {
        usize::from(parts.iter().any(|(part, covered)| *covered == under && wanted(part)))
    };
    let matt = |part: &Material| {
        matches!(part, Material::Diffuse { .. } | Material::Phong { .. } | Material::Whitted { .. })
    };
    let mirror = |part: &Material| matches!(part, Material::Mirror { .. });
    let own = |(part, _): &(Material, bool)| match part {
        Material::Phong { .. } | Material::Metal { .. } | Material::Glass(_) | Material::Layer { .. } => 1,
        Material::Plastic { .. } => 2,
        Material::Principled(_) => 5,
        _ => 0,
    };
    let alike: usize = [false, true].into_iter().map(|under| any(matt, under) + any(mirror, under)).sum();
    alike + parts.iter().map(own).sum::<usize>()
}

/// The materials that a mix or layer comes down to, each with whether it lies under a coat; layers count as themselves.
fn collect_parts(materials: &[Material], id: MaterialId, covered: bool, parts: &mut Vec<(Material, bool)>) {
    match materials[id.0 as usize] {
        Material::Mix { a, b, .. } => {
            collect_parts(materials, a, covered, parts);
            collect_parts(materials, b, covered, parts);
        }
        layer @ Material::Layer { base, .. } => {
            collect_parts(materials, base, true, parts);
            parts.push((layer, covered));
        }
        Material::Mask { base, .. }
        | Material::TwoSided { front: base, .. }
        | Material::Glow { base, .. }
        | Material::Relief { base, .. } => collect_parts(materials, base, covered, parts),
        part => parts.push((part, covered)),
    }
}
