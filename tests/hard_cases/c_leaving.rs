//! Section C: leaving a surface.

use crate::laws::worlds::{camera, empty, quad, trace};
use crate::support::*;
use snell::math::{Ray, Rgb, Vec3};
use snell::render::bsdf::Material;
use snell::render::geometry::{Geometry, SurfacePoint};
use snell::render::shape::MaterialId;

/// Spawns a ray outwards, which must miss, and one inwards, which must hit, from points of a convex closed surface:
/// how many of each are wrong.
fn self_hits_and_leaks(
    geometry: &Geometry,
    center: Vec3,
    scale: f32,
    count: usize,
    spawn: impl Fn(&SurfacePoint, Vec3) -> Ray,
) -> [usize; 2] {
    let mut random = Random(125);
    let mut wrong = [0; 2];
    for _ in 0..count {
        let o = center + random.direction() * scale * 3.0;
        let ray = Ray::new(o, center + random.point() * scale * 0.5 - o);
        let Some(hit) = geometry.closest_hit(&ray) else { continue };
        let point = geometry.surface_point(&ray, &hit);
        let dir = random.direction();
        let outwards = if dir.dot(point.n) < 0.0 { -dir } else { dir };
        wrong[0] += usize::from(geometry.any_hit(&spawn(&point, outwards)));
        wrong[1] += usize::from(!geometry.any_hit(&spawn(&point, -outwards)));
    }
    wrong
}

/// The sizes and places of case 25.
fn placements() -> [(f32, Vec3); 7] {
    [
        (1.0, Vec3::ZERO),
        (1e-4, Vec3::ZERO),
        (1e-6, Vec3::ZERO),
        (1e6, Vec3::ZERO),
        (1.0, Vec3::splat(1e4)),
        (100.0, Vec3::new(1e6, 0.0, -1e6)),
        (2.0, Vec3::new(148_376.0, 1234.0, -223_423.0)),
    ]
}

fn spawn_failures(count: usize, spawn: impl Fn(&SurfacePoint, Vec3) -> Ray + Copy) -> [usize; 2] {
    let mut wrong = [0; 2];
    for (scale, shift) in placements() {
        let (positions, triangles) = sphere(40, 40, |_, _| 1.0);
        let geometry = scene(mesh(positions.iter().map(|p| *p * scale + shift).collect(), triangles));
        let found = self_hits_and_leaks(&geometry, shift, scale, count, spawn);
        wrong = [wrong[0] + found[0], wrong[1] + found[1]];
    }
    wrong
}

/// Case 25: no self-hits and no leaks at any size and place (Pharr, Jakob, Humphreys 2023, section 6.8). 0 of each. An
/// offset of 10⁻⁴ m fails both ways; so does the hit point itself.
#[test]
fn hard_case_25_no_self_hits_and_no_leaks() {
    assert_eq!(spawn_failures(20_000, |point, dir| point.spawn(dir)), [0, 0]);
    let fixed = spawn_failures(2_000, |point, dir| Ray::new(point.p + dir * 1e-4, dir));
    assert!(fixed[0] > 100 && fixed[1] > 100, "a fixed offset fails only {fixed:?}");
    let bare = spawn_failures(2_000, |point, dir| Ray::new(point.p, dir));
    assert!(bare[0] > 100, "no offset fails only {bare:?}");
}

/// Case 25 at length: 2 · 10⁵ points for each size and place.
#[test]
#[ignore = "takes a minute"]
fn hard_case_25_no_self_hits_and_no_leaks_at_length() {
    assert_eq!(spawn_failures(200_000, |point, dir| point.spawn(dir)), [0, 0]);
}

/// Case 26: a mesh that shines in a closed room that shines as much, all with radiance 1: shadow rays that met the lamp
/// itself or the wall behind it would darken pixels. Mean 1 ± 0.2 %, no pixel below 0.98. The closed segment, with both
/// of its ends on their surfaces, is blocked by the very surfaces it joins.
#[test]
fn hard_case_26_shadow_rays_end_before_the_light() {
    let mut parts = empty(camera(Vec3::new(0.2, 0.1, 0.8), Vec3::new(-0.2, -0.1, -1.0), 1.0, 16));
    let glow = Material::Emissive { radiance: Rgb::WHITE, two_sided: true };
    let half = Material::Mix {
        a: MaterialId(1),
        b: MaterialId(0),
        amount: snell::render::bsdf::Input::Constant(Rgb::gray(0.5)),
    };
    let matt = Material::Diffuse { color: snell::render::bsdf::Input::Constant(Rgb::WHITE) };
    parts.materials = vec![glow, matt, half];
    let (positions, triangles) = sphere(12, 16, |_, _| 0.3);
    parts.meshes = vec![snell::render::shape::Mesh { material: MaterialId(2), ..mesh(positions, triangles) }];
    parts.meshes.extend(crate::laws::worlds::cuboid(Vec3::splat(-1.0), Vec3::ONE, true, 2));
    let film = trace(parts, 64, 1_000);
    let mean = crate::laws::worlds::mean(&film);
    assert!((mean - 1.0).abs() <= 5e-3, "mean {mean}");

    // The segments themselves: from points of a floor to points of a lamp, ends included, are all blocked.
    let mut random = Random(126);
    let floor = quad(Vec3::new(-1.0, 0.0, -1.0), Vec3::Z * 2.0, Vec3::X * 2.0, 0);
    let lamp = quad(Vec3::new(-0.5, 1.0, -0.5), Vec3::X, Vec3::Z, 0);
    let geometry = Geometry::build(vec![floor, lamp], Vec::new());
    let (mut blocked, mut blocked_by_naive) = (0, 0);
    for _ in 0..5_000 {
        let down = Ray::new(random.point() * Vec3::new(0.9, 0.0, 0.9) + Vec3::Y * 0.5, Vec3::NEG_Y);
        let point = geometry.surface_point(&down, &geometry.closest_hit(&down).expect("the floor"));
        let u = snell::math::Vec2::new(random.unit(), random.unit());
        let end = geometry.sample_area(snell::render::geometry::PrimId(2 + random.below(2) as u32), u);
        blocked += usize::from(geometry.any_hit(&point.spawn_to(end.p, end.p_error, end.n)));
        let naive = Ray { t_max: 1.0_f32.next_up(), ..Ray::new(point.p, end.p - point.p) };
        blocked_by_naive += usize::from(geometry.any_hit(&naive));
    }
    assert_eq!(blocked, 0);
    assert!(blocked_by_naive > 100, "the closed segment is blocked only {blocked_by_naive} times");
}
