//! Section F: lights, sampling and weights.

use crate::laws::worlds::{camera, diffuse, emissive, empty, mean, quad, trace};
use crate::support::*;
use snell::math::Vec3;
use snell::render::light::AliasTable;
use snell::render::sampler::{Dim, Sampler};
use snell::render::shape::{MaterialId, Mesh};
use std::f64::consts::PI;

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
