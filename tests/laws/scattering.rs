//! Laws of every bsdf.

use super::statistics::{
    COLUMNS, ROWS, bin, chi_square, independent_points, integrate_bins, points, significance,
};
use super::worlds::{color, diffuse, gray};
use snell::math::{Rgb, Vec2, Vec3};
use snell::render::bsdf::{
    Bsdf, Glass, Input, Material, Materials, Principled, Transport, fresnel_dielectric,
};
use snell::render::geometry::{PrimId, Spread, SurfacePoint};
use snell::render::shape::{MaterialId, SourceId};

/// A point on the plane z = 0 with this shading normal.
pub fn surface(ns: Vec3) -> SurfacePoint {
    let tangent = (Vec3::X - ns * ns.x).normalize();
    SurfacePoint {
        p: Vec3::ZERO,
        p_error: Vec3::ZERO,
        n: Vec3::Z,
        ns,
        tangent,
        uv: Vec2::ZERO,
        p_object: Vec3::ZERO,
        material: MaterialId(0),
        prim: PrimId(0),
        source: SourceId(0),
        time: 0.0,
        footprint: 0.0,
        angle: 0.0,
        spread: Spread::NONE,
    }
}

/// The bsdf of the first of some materials.
pub fn bsdf(materials: &[Material]) -> Bsdf {
    Materials::new(materials.to_vec(), Vec::new()).bsdf(&surface(Vec3::Z))
}

pub fn phong(diffuse: f32, specular: f32, shininess: f32) -> Material {
    Material::Phong { diffuse: gray(diffuse), specular: gray(specular), shininess }
}

/// White metal whose width of slopes is `alpha`.
pub fn metal(alpha: f32) -> Material {
    Material::Metal { f0: gray(1.0), edge: gray(1.0), roughness: gray(alpha.sqrt()) }
}

fn plastic(color: f32, alpha: f32) -> Material {
    Material::Plastic { color: gray(color), ior: 1.5, roughness: gray(alpha.sqrt()) }
}

fn ground(ior: f32, alpha: f32, thin: bool) -> Material {
    Material::Glass(Glass { roughness: gray(alpha.sqrt()), thin, ..Glass::of_ior(ior) })
}

/// A coat over the second material.
fn layer(alpha: f32, cover: f32) -> Material {
    Material::Layer { base: MaterialId(1), ior: 1.5, roughness: gray(alpha.sqrt()), cover: gray(cover) }
}

fn principled(metallic: f32, transmission: f32, clearcoat: f32) -> Material {
    Material::Principled(Principled {
        color: color(0.9, 0.6, 0.2),
        metallic: gray(metallic),
        roughness: gray(0.6),
        transmission: gray(transmission),
        ior: 1.5,
        clearcoat: gray(clearcoat),
        clearcoat_roughness: gray(0.4),
        emission: Rgb::BLACK,
    })
}

fn mix(amount: f32) -> Material {
    Material::Mix { a: MaterialId(1), b: MaterialId(2), amount: gray(amount) }
}

fn mix_of(a: u32, b: u32) -> Material {
    Material::Mix { a: MaterialId(a), b: MaterialId(b), amount: gray(0.5) }
}

/// Every way of scattering through a surface into more than one direction.
fn passing_bsdfs() -> Vec<(&'static str, Bsdf)> {
    vec![
        ("ground glass", bsdf(&[ground(1.5, 0.25, false)])),
        ("frosted diamond", bsdf(&[ground(2.4, 0.6, false)])),
        ("ground pane", bsdf(&[ground(1.5, 0.25, true)])),
        ("clear principled", bsdf(&[principled(0.2, 0.7, 0.5)])),
    ]
}

/// Every way of scattering into more than one direction.
pub fn smooth_bsdfs() -> Vec<(&'static str, Bsdf)> {
    let bent = Vec3::new(0.5, 0.2, 0.8).normalize();
    let copper = Material::Metal { f0: color(0.95, 0.64, 0.54), edge: gray(1.0), roughness: gray(0.5) };
    let dipping = Material::Metal { edge: color(1.0, 0.8, 0.7), f0: gray(0.5), roughness: gray(0.6) };
    let on_bent = |material| Materials::new(vec![material], Vec::new()).bsdf(&surface(bent));
    vec![
        ("diffuse", bsdf(&[diffuse(0.8)])),
        ("phong 0", bsdf(&[phong(0.0, 1.0, 0.0)])),
        ("phong 1", bsdf(&[phong(0.3, 0.7, 1.0)])),
        ("phong 40", bsdf(&[phong(0.5, 0.4, 40.0)])),
        ("metal 0.2", bsdf(&[metal(0.2)])),
        ("metal 0.5", bsdf(&[metal(0.5)])),
        ("metal 1", bsdf(&[metal(1.0)])),
        ("copper with a dip", bsdf(&[dipping])),
        ("mix", bsdf(&[mix(0.3), phong(0.5, 0.5, 10.0), copper])),
        ("rough plastic", bsdf(&[plastic(0.8, 0.2)])),
        ("layer", bsdf(&[layer(0.3, 0.7), mix_of(2, 3), copper, diffuse(0.8)])),
        ("principled", bsdf(&[principled(0.3, 0.0, 0.6)])),
        ("bent diffuse", on_bent(diffuse(0.8))),
        ("bent metal", on_bent(copper)),
    ]
}

/// Directions to the viewer: along the normal, slanted, grazing, and from behind.
pub fn directions() -> [Vec3; 5] {
    let at = |degrees: f32, z: f32| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        Vec3::new(sin * 0.8, sin * 0.6, cos * z)
    };
    [at(0.0, 1.0), at(35.0, 1.0), at(70.0, 1.0), at(89.0, 1.0), at(50.0, -1.0)]
}

/// Pairs of random directions in the upper hemisphere.
pub fn pairs(n: u32) -> impl Iterator<Item = (Vec3, Vec3)> {
    let up = |u: Vec2| {
        let w = snell::math::warp::square_to_uniform_sphere(u);
        Vec3::new(w.x, w.y, w.z.abs().max(1e-4)).normalize()
    };
    points(n).map(move |(u, v)| (up(u), up(Vec2::new(v, (7.0 * u.x + 3.0 * u.y).fract()))))
}

/// A hard case of `hard_cases/e_scattering.rs`.
pub fn every_smooth_bsdf_draws_what_its_pdf_claims() {
    let n = 200_000;
    let bsdfs = smooth_bsdfs();
    let limit = significance(bsdfs.len() * directions().len());
    for (name, bsdf) in bsdfs {
        for wo in directions() {
            let side = 1.0_f32.copysign(wo.z);
            let mirrored = |w: Vec3| Vec3::new(w.x, w.y, w.z * side);
            let mut counts = vec![0.0; ROWS * COLUMNS + 1];
            for (u, u_lobe) in independent_points(n) {
                let drawn = bsdf.sample(wo, u, u_lobe, Transport::Radiance);
                let place = drawn.map(|s| bin(mirrored(s.wi)).expect("light does not pass through"));
                counts[place.unwrap_or(ROWS * COLUMNS)] += 1.0;
            }

            let mut expected = integrate_bins(16, |wi| bsdf.pdf(wo, mirrored(wi)));
            let total: f64 = expected.iter().sum();
            let lost = counts[ROWS * COLUMNS] / f64::from(n);
            assert!((total + lost - 1.0).abs() < 4e-3, "{name} along {wo}: pdf {total} + lost {lost}");

            expected.iter_mut().for_each(|share| *share *= f64::from(n));
            expected.push(counts[ROWS * COLUMNS]);
            let p = chi_square(&counts, &expected);
            assert!(p > limit, "{name} along {wo}: p = {p}");
        }
    }
}

/// A hard case of `hard_cases/e_scattering.rs`.
pub fn every_bsdf_that_passes_light_draws_what_its_pdf_claims_on_both_sides() {
    let n = 200_000;
    let limit = significance(passing_bsdfs().len() * directions().len());
    for (name, bsdf) in passing_bsdfs() {
        for wo in directions() {
            let on = |side: f32| move |w: Vec3| Vec3::new(w.x, w.y, w.z * side);
            let half = ROWS * COLUMNS;
            let mut counts = vec![0.0; 2 * half + 1];
            for (u, u_lobe) in independent_points(n) {
                let drawn = bsdf.sample(wo, u, u_lobe, Transport::Radiance);
                let place = drawn.map(|s| match bin(s.wi) {
                    Some(place) => place,
                    None => half + bin(on(-1.0)(s.wi)).expect("on one of the sides"),
                });
                counts[place.unwrap_or(2 * half)] += 1.0;
            }
            let mut expected = integrate_bins(24, |wi| bsdf.pdf(wo, wi));
            expected.extend(integrate_bins(24, |wi| bsdf.pdf(wo, on(-1.0)(wi))));
            let total: f64 = expected.iter().sum();
            let lost = counts[2 * half] / f64::from(n);
            assert!((total + lost - 1.0).abs() < 6e-3, "{name} along {wo}: pdf {total} + lost {lost}");
            expected.iter_mut().for_each(|share| *share *= f64::from(n));
            expected.push(counts[2 * half]);
            let p = chi_square(&counts, &expected);
            assert!(p > limit, "{name} along {wo}: p = {p}");
        }
    }
}

/// A hard case of `hard_cases/e_scattering.rs`.
pub fn through_a_surface_scattering_is_reciprocal_up_to_the_square_of_the_index() {
    for (name, ior) in [("ground glass", 1.5_f32), ("frosted diamond", 2.4), ("ground pane", 1.0)] {
        let (_, bsdf) = passing_bsdfs().into_iter().find(|(known, _)| *known == name).expect("one of them");
        let square = |w: Vec3| if w.z > 0.0 { 1.0 } else { ior * ior };
        for (a, b) in pairs(5_000) {
            for b in [b, Vec3::new(b.x, b.y, -b.z)] {
                let ab = bsdf.eval(a, b).r / (b.z.abs() * square(a));
                let ba = bsdf.eval(b, a).r / (a.z.abs() * square(b));
                assert!((ab - ba).abs() <= 5e-3 * ab.max(ba) + 1e-6, "{name}: {a} {b}: {ab} {ba}");
            }
        }
    }
}

#[test]
fn the_weight_of_a_sample_is_value_over_density() {
    for (name, bsdf) in smooth_bsdfs().into_iter().chain(passing_bsdfs()) {
        for wo in directions() {
            for (u, u_lobe) in points(2_000) {
                let Some(s) = bsdf.sample(wo, u, u_lobe, Transport::Radiance) else { continue };
                let (value, pdf) = bsdf.eval_pdf(wo, s.wi);
                assert!((pdf / s.pdf - 1.0).abs() < 2e-3, "{name} along {wo} to {}: {pdf}, {}", s.wi, s.pdf);
                for channel in 0..3 {
                    let error = (value[channel] / pdf - s.weight[channel]).abs();
                    assert!(error <= 2e-3 * s.weight[channel], "{name} along {wo} to {}", s.wi);
                }
                assert!((s.wi.length() - 1.0).abs() < 1e-6);
            }
        }
    }
}

/// A hard case of `hard_cases/e_scattering.rs`.
pub fn smooth_bsdfs_are_reciprocal_where_normals_are_real() {
    for (name, bsdf) in smooth_bsdfs().into_iter().filter(|(name, _)| !name.starts_with("bent")) {
        for (a, b) in pairs(10_000) {
            let (ab, ba) = (bsdf.eval(a, b).r / b.z, bsdf.eval(b, a).r / a.z);
            assert!((ab - ba).abs() <= 1e-4 * ab.max(ba), "{name}: {a} {b}: {ab} {ba}");
        }
    }
}

#[test]
fn photons_scatter_by_the_adjoint_of_what_radiance_does() {
    // Flux from wo to wi is what wi sees by light from wo, in terms of real cosines (Veach 1997, section 5.3).
    for (name, bsdf) in smooth_bsdfs().into_iter().chain(passing_bsdfs()) {
        for wo in directions().into_iter().filter(|wo| 0.05 < wo.z) {
            for (u, u_lobe) in points(1_000) {
                let Some(s) = bsdf.sample(wo, u, u_lobe, Transport::Importance) else { continue };
                let scattered = s.weight.r * s.pdf;
                let seen = bsdf.eval(s.wi, wo).r * (s.wi.z / wo.z).abs();
                assert!(
                    (scattered - seen).abs() <= 5e-3 * seen,
                    "{name} {wo} to {}: {scattered}, {seen}",
                    s.wi
                );
            }
        }
    }
}

#[test]
fn no_light_passes_from_one_side_of_the_geometric_normal_to_the_other() {
    for (name, bsdf) in smooth_bsdfs() {
        for (a, b) in pairs(10_000) {
            let below = Vec3::new(b.x, b.y, -b.z);
            assert!(bsdf.eval(a, below).is_black() && bsdf.pdf(a, below) == 0.0, "{name}");
            assert!(bsdf.eval(below, a).is_black(), "{name}");
            assert!(bsdf.eval(a, b).is_valid(), "{name}");
        }
    }
}

/// The mean weight of `n` draws.
pub fn albedo(bsdf: &Bsdf, wo: Vec3, n: u32, transport: Transport) -> Rgb {
    let weights = points(n).filter_map(|(u, u_lobe)| Some(bsdf.sample(wo, u, u_lobe, transport)?.weight));
    weights.fold(Rgb::BLACK, |sum, weight| sum + weight) / n as f32
}

#[test]
fn nothing_reflects_more_than_it_receives() {
    let glass = |ior| Material::Glass(Glass::of_ior(ior));
    let lossless =
        [("diffuse", diffuse(1.0)), ("mirror", Material::Mirror { color: gray(1.0) }), ("glass", glass(1.5))];
    for wo in directions() {
        for (name, material) in lossless {
            let albedo = albedo(&bsdf(&[material]), wo, 20_000, Transport::Importance).r;
            assert!((albedo - 1.0).abs() < 2e-3, "{name} along {wo}: {albedo}");
        }
        for shininess in [0.0, 1.0, 10.0, 1e3, 1e5] {
            let albedo = albedo(&bsdf(&[phong(0.2, 0.8, shininess)]), wo, 20_000, Transport::Radiance).r;
            assert!(albedo < 1.001, "phong {shininess} along {wo}: {albedo}");
        }
    }
}

/// Widths of microfacet slopes, from below the one that counts as smooth to the roughest.
const ALPHAS: [f32; 7] = [1e-4, 1.1e-3, 1e-2, 0.1, 0.3, 0.6, 1.0];

/// A hard case of `hard_cases/e_scattering.rs`.
pub fn white_metal_returns_all_light_at_every_width_and_angle() {
    for alpha in ALPHAS {
        let bsdf = bsdf(&[metal(alpha)]);
        for cos in [1.0_f32, 0.8, 0.4, 0.1, 0.01, 1e-4] {
            let wo = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
            let albedo = albedo(&bsdf, wo, 40_000, Transport::Radiance).r;
            // Where the table would have to bend between its nodes: grazing, and hardly rough.
            let most = if cos < 0.05 { 8e-3 } else { 2.5e-3 };
            assert!((albedo - 1.0).abs() < most, "metal {alpha} at {cos}: {albedo}");
            for (u, u_lobe) in points(2_000) {
                let weight = bsdf.sample(wo, u, u_lobe, Transport::Radiance).map_or(0.0, |s| s.weight.r);
                let most = if alpha > 0.05 && cos > 0.05 { 3.0 } else { 100.0 };
                assert!((0.0..most).contains(&weight), "metal {alpha} at {cos}: {weight}");
            }
        }
    }
}

/// A hard case of `hard_cases/e_scattering.rs`.
pub fn white_plastic_returns_all_light_and_coats_never_more() {
    for alpha in ALPHAS {
        for cos in [1.0_f32, 0.7, 0.3, 0.05] {
            let wo = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
            let seen = |materials: &[Material]| albedo(&bsdf(materials), wo, 40_000, Transport::Radiance);
            let white = seen(&[plastic(1.0, alpha)]).r;
            assert!((white - 1.0).abs() < 6e-3, "plastic {alpha} at {cos}: {white}");
            for base in [diffuse(1.0), metal(0.3), metal(1e-4)] {
                let coated = seen(&[layer(alpha, 1.0), base]).r;
                assert!((0.8..1.004).contains(&coated), "layer {alpha} over {base:?} at {cos}: {coated}");
            }
            let all = seen(&[principled(0.5, 0.0, 1.0)]).max_component();
            assert!(all < 1.004, "principled at {cos}: {all}");
        }
    }
}

/// A hard case of `hard_cases/e_scattering.rs`. Where grazing light meets a table that bends between its nodes, a little
/// more is off.
pub fn ground_glass_and_panes_pass_on_all_they_receive() {
    for wo in directions() {
        for alpha in ALPHAS {
            let bsdf = |ior, thin| bsdf(&[ground(ior, alpha, thin)]);
            for (name, bsdf) in
                [("glass", bsdf(1.5, false)), ("diamond", bsdf(2.4, false)), ("pane", bsdf(1.5, true))]
            {
                let seen = albedo(&bsdf, wo, 40_000, Transport::Importance).r;
                let most = if wo.z.abs() < 0.1 { 2.5e-2 } else { 6e-3 };
                assert!((seen - 1.0).abs() < most, "{name} {alpha} along {wo}: {seen}");
            }
        }
    }
}

#[test]
fn a_pane_shows_what_is_behind_it_in_its_own_direction() {
    let pane = bsdf(&[ground(1.5, 0.0, true)]);
    for wo in directions() {
        let s = pane.sample(wo, Vec2::ZERO, 0.999_999, Transport::Radiance).expect("something passes");
        assert!((s.wi + wo).length() < 1e-6 && !s.through && s.eta == 1.0, "{s:?}");
        assert_eq!(s.weight, Rgb::WHITE);
    }
}

#[test]
fn coloured_metal_keeps_what_its_facets_do_not_reflect() {
    let copper = |alpha: f32| Material::Metal {
        f0: color(0.95, 0.64, 0.54),
        edge: color(1.0, 0.9, 0.85),
        roughness: gray(alpha.sqrt()),
    };
    let mut last = Rgb::WHITE;
    for alpha in ALPHAS {
        let seen = albedo(&bsdf(&[copper(alpha)]), Vec3::Z, 40_000, Transport::Radiance);
        assert!((0..3).all(|channel| seen[channel] < last[channel] + 2e-3), "rougher is not darker: {alpha}");
        assert!(alpha > 0.02 || (seen.g - 0.64).abs() < 5e-3, "{alpha}: {seen:?}");
        last = seen;
    }
    assert!(0.3 < last.g && last.g < 0.5, "{last:?}");
}

#[test]
fn an_overfull_phong_material_is_scaled_to_what_it_receives() {
    let albedo = albedo(&bsdf(&[phong(0.9, 0.9, 20.0)]), Vec3::Z, 20_000, Transport::Radiance).r;
    assert!((0.97..1.001).contains(&albedo), "{albedo}");
}

/// A hard case of `hard_cases/e_scattering.rs`.
pub fn scattering_survives_grazing_directions() {
    let materials = [
        diffuse(1.0),
        phong(0.5, 0.5, 1e5),
        metal(1.1e-3),
        metal(1e-2),
        metal(1.0),
        plastic(0.8, 0.01),
        plastic(1.0, 1.0),
        ground(1.5, 0.01, false),
        ground(1.5, 1.0, false),
        ground(1.5, 0.3, true),
        principled(0.3, 0.4, 1.0),
    ];
    for material in materials {
        let bsdf = bsdf(&[material]);
        for cos in [1e-3_f32, 1e-6, 1e-20, 0.0] {
            let wo = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
            for (u, u_lobe) in points(1_000) {
                if let Some(s) = bsdf.sample(wo, u, u_lobe, Transport::Radiance) {
                    assert!(
                        s.weight.is_valid() && s.pdf > 0.0 && s.pdf.is_finite(),
                        "{material:?} {cos}: {s:?}"
                    );
                    assert!(s.wi.is_finite());
                }
            }
            for (_, wi) in pairs(500) {
                let (value, pdf) = bsdf.eval_pdf(wo, wi);
                assert!(
                    value.is_valid() && pdf >= 0.0 && pdf.is_finite(),
                    "{material:?} {cos}: {value:?} {pdf}"
                );
            }
        }
    }
}

#[test]
fn fresnel_reflectance_is_exact_at_every_angle() {
    for eta in [1.0, 1.0 + 1e-6, 1.0 - 1e-6, 1.0001, 1.5, 1.0 / 1.5, 2.42, 1.0 / 2.42] {
        for i in 0..=10_000 {
            let cos = f64::from(i) / 10_000.0;
            let (reflectance, cos_t) = fresnel_dielectric(cos, eta);
            assert!((0.0..=1.0).contains(&reflectance) && cos_t >= 0.0);
            assert!((reflectance - fresnel_by_angles(cos, eta)).abs() < 1e-6, "eta {eta}, cos {cos}");
        }
    }
}

/// Fresnel's equations in their form by angles (sine and tangent laws), an independent way to the same number.
fn fresnel_by_angles(cos: f64, eta: f64) -> f64 {
    if eta == 1.0 {
        return 0.0;
    }
    let i = cos.acos();
    let sin_t = i.sin() / eta;
    if sin_t >= 1.0 {
        return 1.0;
    }
    let t = sin_t.asin();
    if i < 1e-4 {
        return ((eta - 1.0) / (eta + 1.0)).powi(2);
    }
    let (s, p) = ((i - t).sin() / (i + t).sin(), (i - t).tan() / (i + t).tan());
    0.5 * (s * s + p * p)
}

#[test]
fn glass_of_index_1_is_not_there() {
    let glass = bsdf(&[Material::Glass(Glass::of_ior(1.0))]);
    for wo in directions() {
        for (u, u_lobe) in points(100) {
            let s = glass.sample(wo, u, u_lobe, Transport::Radiance).expect("everything passes");
            assert!((s.wi + wo).abs().max_element() <= 2.4e-7, "{wo} {}", s.wi);
            assert_eq!(s.weight, Rgb::WHITE);
        }
    }
}

#[test]
fn refraction_obeys_its_law_and_reverses() {
    let glass = bsdf(&[Material::Glass(Glass::of_ior(1.5))]);
    for wo in directions() {
        let ior = if wo.z > 0.0 { 1.5 } else { 1.0 / 1.5 };
        let s = glass.sample(wo, Vec2::ZERO, 0.999_999, Transport::Radiance).expect("something leaves");
        let sines = |w: Vec3| w.truncate().length();
        if s.eta != 1.0 {
            assert!((sines(wo) - ior * sines(s.wi)).abs() < 1e-6);
            assert!((s.weight.r * ior * ior - 1.0).abs() < 1e-6);
            let back = glass.sample(s.wi, Vec2::ZERO, 0.999_999, Transport::Radiance).expect("it goes back");
            assert!((back.wi - wo).length() < 1e-5);
        }
    }
}

#[test]
fn a_mirror_with_an_interpolated_normal_never_sends_light_into_the_surface() {
    let bent = surface(Vec3::new(0.7, 0.0, 0.714).normalize());
    let mirror = Materials::new(vec![Material::Mirror { color: gray(1.0) }], Vec::new()).bsdf(&bent);
    for (wo, _) in pairs(1_000) {
        let s = mirror.sample(wo, Vec2::ZERO, 0.5, Transport::Radiance).expect("mirrors reflect");
        assert!(s.wi.z > 0.0, "{wo} to {}", s.wi);
    }
}

#[test]
fn directions_stay_unit_vectors_over_ten_thousand_bounces() {
    let mirror = bsdf(&[Material::Mirror { color: gray(1.0) }]);
    let mut wo = Vec3::new(0.6, 0.1, 0.7).normalize();
    for _ in 0..10_000 {
        wo = mirror.sample(wo, Vec2::ZERO, 0.5, Transport::Radiance).expect("mirrors reflect").wi;
        assert!((wo.length() - 1.0).abs() < 1e-6);
    }
}

#[test]
fn scalars_take_the_mean_of_the_channels() {
    let by_color = Material::Mix {
        a: MaterialId(1),
        b: MaterialId(2),
        amount: Input::Constant(Rgb::new(0.0, 0.3, 0.6)),
    };
    let value = |materials: [Material; 3]| bsdf(&materials).eval(Vec3::Z, Vec3::Z).r;
    assert_eq!(value([by_color, diffuse(1.0), diffuse(0.0)]), value([mix(0.3), diffuse(1.0), diffuse(0.0)]));
}
