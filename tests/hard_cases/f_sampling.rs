//! Section F: lights, sampling and weights.

use crate::laws::statistics::independent_points;
use crate::laws::worlds::{camera, diffuse, emissive, empty, gray, mean, path_tracing, quad, sphere, trace};
use crate::support::*;
use snell::math::{Rgb, Vec2, Vec3};
use snell::render::bsdf::Material;
use snell::render::integrator::mis_weight;
use snell::render::light::{AliasTable, Environment, EnvironmentRadiance, Falloff, Light, Sky};
use snell::render::sampler::{Dim, Sampler};
use snell::render::shape::{MaterialId, Mesh};
use snell::render::texture::Image;
use snell::render::{GatherRadius, HybridSettings, Method, Parts, PpmSettings, Settings, World, render};
use std::f64::consts::PI;
use std::sync::Arc;

/// A white floor seen at one point, the origin, under a lamp that is given.
fn irradiance(lamp: Mesh) -> f64 {
    let mut parts = empty(camera(Vec3::new(3.0, 0.5, 0.0), Vec3::new(-3.0, -0.5, 0.0), 1e-5, 8));
    parts.materials = vec![diffuse(1.0), emissive(1.0)];
    parts.meshes = vec![quad(Vec3::new(-5.0, 0.0, -5.0), Vec3::Z * 10.0, Vec3::X * 10.0, 0), lamp];
    PI * mean(&trace(parts, 400, 2))
}

/// Irradiance at the origin of y = 0 from a polygon of radiance 1 (Lambert 1760; Baum et al. 1989): half the sum over its
/// edges of the angle they span times the height of the normal of the plane through them and the origin.
fn lambert(corners: &[Vec3]) -> f64 {
    let edges = (0..corners.len()).map(|i| (corners[i], corners[(i + 1) % corners.len()]));
    let term = |(a, b): (Vec3, Vec3)| {
        let (a, b) = (a.as_dvec3(), b.as_dvec3());
        let cross = a.cross(b);
        cross.length().atan2(a.dot(b)) * cross.y / cross.length()
    };
    (0.5 * edges.map(term).sum::<f64>()).abs()
}

/// Case 46: a triangle and a quad as lamps at distances from 1 to 10⁶ m, of the same size: irradiance within 0.2 % of
/// Lambert's formula. The solid angle of the triangle in single precision, from the arc tangent of a triple product
/// (van Oosterom, Strackee 1983), is lost long before.
#[test]
fn hard_case_46_tiny_and_distant_lamps() {
    let mut worst_naive = 0.0_f32;
    for exponent in 0..=6 {
        let height = 10_f32.powi(exponent);
        let (u, v) = (Vec3::new(0.7, 0.1, 0.0), Vec3::new(0.1, -0.2, 0.9));
        let corner = Vec3::new(-0.2, height, -0.3);
        let lamp = quad(corner, u, v, 1);
        let expected = lambert(&[corner, corner + u, corner + u + v, corner + v]);
        let found = irradiance(Mesh { material: MaterialId(1), ..lamp });
        assert!((found / expected - 1.0).abs() <= 2e-3, "quad at {height} m: {found}, {expected}");

        let triangle = mesh(vec![corner, corner + u, corner + v], vec![[0, 1, 2]]);
        let expected = lambert(&[corner, corner + u, corner + v]);
        let found = irradiance(Mesh { material: MaterialId(1), ..triangle });
        assert!((found / expected - 1.0).abs() <= 2e-3, "triangle at {height} m: {found}, {expected}");

        let [a, b, c] = [corner, corner + u, corner + v].map(|p| p.normalize());
        let omega = 2.0 * a.dot(b.cross(c)).abs().atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a));
        worst_naive = worst_naive.max((omega / expected as f32 - 1.0).abs());
    }
    assert!(worst_naive > 0.02, "the naive solid angle is off by only {worst_naive}");
}

/// Case 47: lamps seen exactly edge-on, and receivers in their plane: exactly nothing, no NaN.
#[test]
fn hard_case_47_lamps_edge_on() {
    for lamp in [
        quad(Vec3::new(-0.5, 0.0, 1.0), Vec3::X, Vec3::Z, 1),
        quad(Vec3::new(-0.5, 0.0, 1.0), Vec3::Z, Vec3::X, 1),
    ] {
        assert_eq!(irradiance(lamp), 0.0);
    }
    // The pixels are spread over 0.1 mm about the plane of this one.
    let in_its_plane = irradiance(quad(Vec3::new(0.0, 1.0, -0.5), Vec3::Y, Vec3::Z, 1));
    assert!((0.0..1e-4).contains(&in_its_plane), "{in_its_plane}");
    // A little over the plane it is a little, not a jump.
    let above = irradiance(quad(Vec3::new(-0.5, 1e-6, 1.0), Vec3::X, Vec3::Z, 1));
    assert!((0.0..1e-5).contains(&above), "{above}");
}

/// Case 49: lights whose powers differ by 10¹². Each is drawn as often as its share, and none with power has a
/// probability of 0. A running sum in single precision loses the small ones.
#[test]
fn hard_case_49_lights_of_very_different_power() {
    let weights: Vec<f64> = (0..1_000_000).map(|i| if i % 1000 == 0 { 1.0 } else { 1e-12 }).collect();
    let total: f64 = weights.iter().sum();
    let table = AliasTable::new(&weights);
    for (i, weight) in weights.iter().enumerate() {
        let pmf = f64::from(table.pmf(i));
        assert!(pmf > 0.0 && (pmf * total / weight - 1.0).abs() < 1e-4, "light {i}: {pmf}");
    }
    let mut sum = 0.0_f32;
    let lost = weights.iter().filter(|&&weight| {
        let before = sum;
        sum += weight as f32;
        sum == before
    });
    assert!(lost.count() > 900_000, "a running sum keeps most of them");
}

/// Whether each elementary interval of area 2⁻ᵐ holds one of 2ᵐ points.
fn is_net(points: &[[f64; 2]], m: u32) -> bool {
    (0..=m).all(|a| {
        let (columns, rows) = (1 << a, 1 << (m - a));
        let mut seen = vec![false; columns * rows];
        points.iter().all(|[x, y]| {
            let at = (x * columns as f64) as usize * rows + (y * rows as f64) as usize;
            !std::mem::replace(&mut seen[at], true)
        })
    })
}

/// Case 52: points of every decision are (0, 2)-nets: each prefix of 2ᵐ, m ≤ 10, hits each elementary interval once
/// (Sobol 1967; Owen 1995; Burley 2020), and no two pixels share a sequence. Independent points are none.
#[test]
fn hard_case_52_points_are_nets() {
    let mut first_points = std::collections::HashSet::new();
    for pixel in 0..10_000_u64 {
        let point = |i| Sampler::new(3, 0, pixel, i).get_2d(Dim::Filter).to_array().map(f32::to_bits);
        assert!(first_points.insert([point(0), point(1), point(2)]), "pixel {pixel} repeats another");
    }
    for dim in [Dim::Filter, Dim::Lens, Dim::Bsdf(0), Dim::Bsdf(7), Dim::Light(3), Dim::PhotonDirection] {
        for pixel in [0, 1, 77 << 32 | 5] {
            let points: Vec<[f64; 2]> = (0..1024)
                .map(|i| Sampler::new(9, 0, pixel, i).get_2d(dim).to_array().map(f64::from))
                .collect();
            for m in 0..=10 {
                assert!(is_net(&points[..1 << m], m), "{dim:?} of pixel {pixel}, 2^{m} points");
            }
        }
    }
    let mut random = Random(152);
    let independent: Vec<[f64; 2]> = (0..64).map(|_| [random.unit(), random.unit()].map(f64::from)).collect();
    assert!(!is_net(&independent, 6));
}

/// Case 45: weights of two strategies at the extremes: finite, in [0, 1], and together 1 but for rounding, unless both
/// densities are 0 (Veach 1997, eq. 9.20, the ratio formed first). Squares of the densities themselves overflow.
#[test]
fn hard_case_45_weights_at_the_extremes() {
    let densities = [0.0, 1e-38, 1.0, 1e38, f32::INFINITY];
    let mut wrong_by_naive = 0;
    for a in densities {
        for b in densities {
            let (wa, wb) = (mis_weight(a, b), mis_weight(b, a));
            assert!((0.0..=1.0).contains(&wa), "{a} against {b}: {wa}");
            let both_0 = a == 0.0 && b == 0.0;
            assert!(both_0 || (wa + wb - 1.0).abs() <= f32::EPSILON, "{a} and {b}: {wa} + {wb}");
            let naive = a * a / (a * a + b * b);
            wrong_by_naive += usize::from(!both_0 && naive.is_nan());
        }
    }
    assert!(wrong_by_naive >= 6, "squares fail only {wrong_by_naive} times");
}

fn map_of(width: u32, height: u32, texel: impl Fn(u32, u32) -> f32) -> Sky {
    let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let texels = texels.map(|(x, y)| Rgb::gray(texel(x, y))).collect();
    let radiance = EnvironmentRadiance::Image(Arc::new(Image::new(width, height, texels)));
    Sky::new(Environment { radiance, scale: 1.0, rotation: 0.7 })
}

/// Case 48: maps with black rows, one bright texel, odd sizes, nothing: every u, the least and the greatest too, draws a
/// direction of positive density, and that density is the one of the direction but on the very edge of texels. A running sum
/// in single precision of 10⁵ entries ends beside 1: the last numbers draw what has no width.
#[test]
fn hard_case_48_awkward_environment_maps() {
    let skies = [
        ("1 × 1", map_of(1, 1, |_, _| 2.0)),
        ("2 × 1", map_of(2, 1, |x, _| x as f32)),
        ("8192 × 1", map_of(8192, 1, |x, _| (x % 7) as f32)),
        ("black rows", map_of(64, 32, |x, y| if y % 3 == 0 { (x + 1) as f32 } else { 0.0 })),
        ("a sun", map_of(512, 256, |x, y| if (x, y) == (100, 60) { 1e5 } else { 0.0 })),
        ("black", map_of(4, 4, |_, _| 0.0)),
    ];
    let last = 1.0 - f32::EPSILON / 2.0;
    for (name, sky) in skies {
        let mut off = 0;
        for i in 0..=64 {
            for j in 0..=64 {
                let u = |i: i32| if i == 64 { last } else { i as f32 / 64.0 };
                let (dir, pdf) = sky.sample(Vec2::new(u(i), u(j)));
                assert!(pdf > 0.0 && pdf.is_finite() && dir.is_normalized(), "{name} at {i} {j}: {pdf}");
                off += usize::from((sky.pdf(dir) / pdf - 1.0).abs() > 1e-4);
            }
        }
        // Multiples of 1/64 are the edges of texels here.
        assert!(off < 1_500, "{name}: {off} of 4,225 have another density");
        let random_off = independent_points(4_000).filter(|(u, _)| {
            let (dir, pdf) = sky.sample(*u);
            (sky.pdf(dir) / pdf - 1.0).abs() > 1e-4
        });
        assert!(random_off.count() < 10, "{name}: the density is another");
    }
    let naive = (0..100_000).map(|i| 1.0 + (i % 3) as f32).fold(0.0_f32, |sum, x| sum + x / 199_999.0);
    assert!((naive - 1.0).abs() > f32::EPSILON, "the sum in single precision ends at {naive}");
}

/// A closed ball that emits 1 − ρ and reflects ρ: radiance is 1 everywhere inside.
fn glowing_ball(albedo: f32) -> Parts {
    let mut parts = empty(camera(Vec3::new(0.2, 0.1, 0.3), Vec3::NEG_Z, 1.0, 16));
    let glow = Material::Emissive { radiance: Rgb::WHITE, two_sided: true };
    let mix = Material::Mix { a: MaterialId(1), b: MaterialId(2), amount: gray(albedo) };
    parts.materials = vec![mix, glow, diffuse(1.0)];
    parts.solids = vec![sphere(Vec3::ZERO, 1.0, 0)];
    parts
}

/// Case 50: roulette in closed balls of albedo 0.5, 0.9 and 0.99: radiance 1 within 0.3 %, and within 1.5 %, its noise,
/// for the last, whose paths have a hundred vertices. Whoever ends paths by chance and gives survivors no greater weight
/// loses most of the light. So does, nearly always, whoever ends one in twenty whatever they carry: of light that loses one
/// in a hundred the square of the weight then grows without bound.
#[test]
fn hard_case_50_roulette_takes_nothing() {
    for (albedo, passes, most) in [(0.5, 128, 3e-3), (0.9, 128, 3e-3), (0.99, 256, 1.5e-2)] {
        let found = mean(&trace(glowing_ball(albedo), passes, 10_000));
        assert!((found - 1.0).abs() <= most, "albedo {albedo}: {found}");
    }
    let (mut random, mut sum) = (Random(150), 0.0);
    for _ in 0..10_000 {
        let mut beta = 1.0;
        while beta > 1e-30 && random.unit() < beta {
            sum += beta;
            beta *= 0.9;
        }
    }
    assert!(sum / 10_000.0 < 5.0, "of 1 / (1 − 0.9) the naive walk finds {}", sum / 10_000.0);
}

fn with(method: Method, passes: u32) -> Settings {
    Settings { method, ..path_tracing(passes, 1_000) }
}

fn ppm(radius: f32) -> Method {
    Method::Ppm(PpmSettings { photon_count: 20_000, k: 100_000, radius, shrink: 2.0 / 3.0 })
}

fn hybrid(radius: f32) -> Method {
    let radius = GatherRadius::Meters(radius);
    Method::Hybrid(HybridSettings { photon_count: 20_000, k: 100_000, radius, shrink: 2.0 / 3.0 })
}

/// A ball of albedo 0.5 with point lights of intensity π / count in its centre.
fn lit_ball(materials: Vec<Material>, count: u32) -> World {
    let mut parts = empty(camera(Vec3::new(0.2, 0.1, 0.3), Vec3::NEG_Z, 1.0, 8));
    parts.materials = materials;
    parts.solids = vec![sphere(Vec3::ZERO, 1.0, 0)];
    let intensity = Rgb::gray(std::f32::consts::PI / count as f32);
    parts.lights =
        (0..count).map(|_| Light::Point { p: Vec3::ZERO, intensity, falloff: Falloff::PHYSICAL }).collect();
    World::new(parts)
}

/// Case 51: scenes with an answer. In the unit ball of albedo 0.5 radiance is 1 under one point light of intensity π, under
/// four of π / 4, and where it emits 0.5; half matt 0.25 and half mirror 0.5, under a point light, it is 2 by photons (paths
/// from the camera never meet that light by way of the mirror, and are not asked). Means within 0.5 %, by photons 1 %. A
/// path tracer content with four vertices is too dark.
#[test]
fn hard_case_51_scenes_with_an_answer() {
    let mean_of = |world: &World, settings: &Settings| mean(&render(world, settings, &()).film);
    for count in [1, 4] {
        let world = lit_ball(vec![diffuse(0.5)], count);
        for (method, most) in [(Method::Pt, 5e-3), (hybrid(0.08), 5e-3), (ppm(0.08), 1e-2)] {
            let found = mean_of(&world, &with(method, 128));
            assert!((found - 1.0).abs() <= most, "{count} lights, {method:?}: {found}");
        }
        let naive = mean_of(&world, &path_tracing(64, 4));
        assert!(naive < 0.95, "four vertices see {naive}");
    }
    let world = World::new(glowing_ball(0.5));
    for (method, most) in [(Method::Pt, 5e-3), (hybrid(0.08), 5e-3), (ppm(0.08), 1e-2)] {
        let found = mean_of(&world, &with(method, 128));
        assert!((found - 1.0).abs() <= most, "glowing, {method:?}: {found}");
    }
    // Matt 0.25 and mirror 0.5, and the rest absorbed.
    let mix = |a, b, amount| Material::Mix { a: MaterialId(a), b: MaterialId(b), amount: gray(amount) };
    let mirror = Material::Mirror { color: gray(1.0) };
    let world = lit_ball(vec![mix(1, 2, 0.5), diffuse(0.5), mirror], 1);
    for method in [ppm(0.08), hybrid(0.08)] {
        let found = mean_of(&world, &with(method, 128));
        assert!((found - 2.0).abs() <= 0.02, "half mirror, {method:?}: {found}");
    }
}
