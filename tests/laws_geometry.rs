//! What rays may rely on: no leaks, no order dependence, the tree as if every primitive had been tried.

use crate::support::*;
use snell::math::{DAffine3, DMat3, DVec2, DVec3, Ray, Vec2, Vec3};
use snell::render::geometry::{Geometry, Hit, PrimId, Shapes, SurfacePoint};
use snell::render::shape::{Frustum, Instance, MaterialId, Mesh, Profile, SolidKind, SourceId, Torus};

#[test]
fn no_ray_escapes_a_closed_mesh() {
    assert_no_ray_escapes(50_000);
}

#[test]
#[ignore = "half a minute: 8 × 2 million rays"]
fn no_ray_of_millions_escapes_a_closed_mesh() {
    assert_no_ray_escapes(2_000_000);
}

fn assert_no_ray_escapes(rays: usize) {
    for (name, mesh, center) in closed_meshes() {
        let mut random = Random(2);
        let geometry = scene(mesh.clone());
        let escaped = (0..rays)
            .map(|i| aimed_ray(&mesh, center, i, &mut random))
            .filter(|ray| geometry.closest_hit(ray).is_none())
            .count();
        assert_eq!(escaped, 0, "{name}");
    }
}

#[test]
fn vector_registers_change_no_bit() {
    assert_twins_agree(20_000);
}

#[test]
#[ignore = "half a minute: 8 × 1 million rays"]
fn vector_registers_change_no_bit_of_millions() {
    assert_twins_agree(1_000_000);
}

/// The code for any processor and that for the one at hand, hit by hit.
fn assert_twins_agree(rays: usize) {
    let whole =
        |hit: Option<Hit>| hit.map(|hit| (hit.t.to_bits(), hit.prim, hit.uv.to_array().map(f32::to_bits)));
    for (name, mesh, center) in closed_meshes() {
        let mut random = Random(27);
        let (fast, portable) = (scene(mesh.clone()), scene(mesh.clone()).without_simd());
        for i in 0..rays {
            let ray = aimed_ray(&mesh, center, i, &mut random);
            let ray = Ray { o: ray.o + Vec3::splat((i % 3) as f32) * (ray.o - center), ..ray };
            let (hit, twin) = (fast.closest_hit(&ray), portable.closest_hit(&ray));
            assert_eq!(whole(hit), whole(twin), "{name}: {ray:?}");
            let t_max = hit.map_or(1.0, |hit| hit.t) * if i % 2 == 0 { 0.9 } else { 1.1 };
            let segment = Ray { t_max, ..ray };
            assert_eq!(fast.any_hit(&segment), portable.any_hit(&segment), "{name}: {segment:?}");
        }
    }
}

#[test]
fn any_number_of_threads_builds_the_same_tree() {
    use snell::render::accel::{Items, build::Cell, partition};
    fn describe(cell: &Cell, out: &mut Vec<u32>) {
        let bounds = cell.bounds();
        out.extend(bounds.min.to_array().into_iter().chain(bounds.max.to_array()).map(f32::to_bits));
        match cell {
            Cell::Inner { children, .. } => children.iter().for_each(|child| describe(child, out)),
            Cell::Leaf { items, .. } => out.extend(items),
        }
    }
    let mut random = Random(28);
    let triangles: Vec<_> = (0..10_000)
        .map(|_| {
            let center = random.point();
            [0; 3].map(|_| center + random.point() * 0.1)
        })
        .collect();
    let built_by = |threads| {
        let pool =
            rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be started");
        let mut words = Vec::new();
        pool.install(|| describe(&partition(&Items { triangles: &triangles, boxes: &[] }).root, &mut words));
        words
    };
    assert_eq!(built_by(1), built_by(4));
}

#[test]
fn aimed_rays_tell_a_leaky_triangle_test_from_a_tight_one() {
    let (positions, triangles) = sphere(20, 20, |_, _| 1.0);
    let mesh = mesh(positions, triangles);
    let mut random = Random(3);
    let rays: Vec<_> = (0..4000).map(|i| aimed_ray(&mesh, Vec3::ZERO, i, &mut random)).collect();
    let leaky =
        |ray: &Ray| mesh.triangles.iter().any(|triangle| naive_intersect(mesh.corners(*triangle), ray));
    let escaped = rays.iter().filter(|ray| !leaky(ray)).count();
    assert!(escaped > 10, "the rays are aimed too badly to find a leak: {escaped}");
}

#[test]
fn the_tree_finds_what_trying_every_triangle_finds() {
    for (name, mesh, center) in closed_meshes() {
        let brute_force = BruteForce::new(&mesh);
        let mut random = Random(4);
        let rays: Vec<_> = (0..2_000).map(|i| aimed_ray(&mesh, center, i, &mut random)).collect();
        let geometry = scene(mesh);
        for ray in rays {
            let found = bits(geometry.closest_hit(&ray));
            assert_eq!(found, brute_force.closest_hit(&ray), "{name}: {ray:?}");
        }
    }
}

#[test]
fn any_hit_agrees_with_closest_hit() {
    let meshes = closed_meshes();
    for (name, mesh, center) in meshes {
        let mut random = Random(5);
        let rays: Vec<_> = (0..20_000).map(|i| aimed_ray(&mesh, center, i, &mut random)).collect();
        let geometry = scene(mesh);
        for ray in rays {
            let t = geometry.closest_hit(&ray).expect("the mesh is closed").t;
            let until = |t_max| geometry.any_hit(&Ray { t_max, ..ray });
            assert!(!until(t) && until(t.next_up()), "{name}: {ray:?} at {t}");
        }
    }
}

/// Small scenes that break trees: soups, grids with everything in planes, fans, nested scales, flat ones, tiny ones.
fn awkward_scene(i: usize, random: &mut Random) -> Mesh {
    let count = 1 + random.below(120);
    let soup = |random: &mut Random, size: f32| {
        let corners = (0..count).flat_map(|_| {
            let center = random.point();
            [0; 3].map(|_| center + random.point() * size)
        });
        corners.collect::<Vec<_>>()
    };
    let positions: Vec<Vec3> = match i % 7 {
        0 => soup(random, 0.1),
        1 => soup(random, 1.0),
        2 => soup(random, 0.3).iter().map(|p| (*p * 4.0).round() / 4.0).collect(),
        3 => soup(random, 0.3).iter().map(|p| *p * Vec3::new(1.0, 0.0, 1.0)).collect(),
        4 => soup(random, 0.5)
            .iter()
            .enumerate()
            .map(|(i, p)| if i % 3 == 0 { Vec3::ZERO } else { *p })
            .collect(),
        5 => soup(random, 0.3).iter().enumerate().map(|(i, p)| *p * 0.8_f32.powi(i as i32 / 3)).collect(),
        _ => soup(random, 0.01)
            .iter()
            .enumerate()
            .map(|(i, p)| if i % 3 == 0 { *p * 100.0 } else { *p })
            .collect(),
    };
    let triangles = (0..count as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
    let area = |triangle: &[u32; 3]| {
        snell::render::shape::triangle::cross_of_edges(triangle.map(|i| positions[i as usize])).length()
    };
    let triangles = triangles.filter(|triangle| area(triangle) > 0.0).collect();
    mesh(positions, triangles)
}

#[test]
fn the_tree_survives_awkward_scenes() {
    let mut random = Random(6);
    for i in 0..210 {
        let mesh = awkward_scene(i, &mut random);
        let brute_force = BruteForce::new(&mesh);
        let corners = mesh.positions.clone();
        let geometry = scene(mesh);
        for j in 0..500 {
            // Half of the rays run along axes, some exactly through coordinates of the scene, with zeros of both signs.
            let o = if j % 3 == 0 {
                corners[random.below(corners.len())] + random.axis() * 2.0
            } else {
                random.point() * 2.0
            };
            let zero = if random.below(2) == 0 { 0.0 } else { -0.0 };
            let axis = random.axis();
            let d = if j % 2 == 0 {
                random.direction()
            } else {
                Vec3::select(axis.cmpeq(Vec3::ZERO), Vec3::splat(zero), axis)
            };
            let ray = Ray::new(o, d);
            assert_eq!(bits(geometry.closest_hit(&ray)), brute_force.closest_hit(&ray), "scene {i}: {ray:?}");
        }
    }
}

#[test]
fn an_empty_scene_is_missed() {
    let geometry = Geometry::build(Vec::new(), Vec::new());
    let ray = Ray::new(Vec3::ZERO, Vec3::X);
    assert!(geometry.closest_hit(&ray).is_none() && !geometry.any_hit(&ray) && geometry.bounds().is_empty());
}

#[test]
fn the_lowest_of_coplanar_duplicates_wins() {
    let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
    let geometry = scene(mesh(corners, vec![[0, 1, 2]; 100_000]));
    let mut random = Random(7);
    for _ in 0..20 {
        let o = Vec3::new(random.unit() * 0.5, random.unit() * 0.5, 1.0);
        assert_eq!(geometry.closest_hit(&Ray::new(o, Vec3::NEG_Z)).map(|hit| hit.prim), Some(PrimId(0)));
    }
}

#[test]
fn slivers_do_not_explode_the_tree() {
    use snell::render::accel::{Items, build, partition};
    let mut random = Random(8);
    let triangles: Vec<_> = (0..4_000)
        .map(|_| {
            let (a, b) = (random.point(), random.point());
            [a, b, b + random.point() * 1e-3]
        })
        .collect();
    let partition = partition(&Items { triangles: &triangles, boxes: &[] });
    let references = partition.root.references();
    assert!(references <= build::reference_limit(triangles.len()), "{references} references");
    assert!(partition.root.depth() <= build::depth_limit(triangles.len()));
    let positions: Vec<_> = triangles.iter().flatten().copied().collect();
    let indices = (0..4_000).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let mesh = mesh(positions, indices);
    let brute_force = BruteForce::new(&mesh);
    let geometry = scene(mesh);
    for _ in 0..2_000 {
        let ray = Ray::new(random.point(), random.direction());
        assert_eq!(bits(geometry.closest_hit(&ray)), brute_force.closest_hit(&ray));
    }
}

#[test]
fn rays_with_nan_or_infinity_miss() {
    let (positions, triangles) = sphere(20, 20, |_, _| 1.0);
    let shapes =
        vec![solid(SolidKind::Sphere, DAffine3::IDENTITY), solid(SolidKind::Plane, DAffine3::IDENTITY)];
    let geometry = Geometry::build(vec![mesh(positions, triangles)], shapes);
    let mut random = Random(9);
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for field in 0..6 {
            for _ in 0..100 {
                let mut ray = Ray::new(random.point(), random.direction());
                if field < 3 {
                    ray.o[field] = bad
                } else {
                    ray.d[field - 3] = bad
                }
                assert!(geometry.closest_hit(&ray).is_none() && !geometry.any_hit(&ray));
            }
        }
        let ray = Ray { t_max: if bad > 0.0 { f32::NAN } else { bad }, ..Ray::new(Vec3::ZERO, Vec3::X) };
        assert!(geometry.closest_hit(&ray).is_none() && !geometry.any_hit(&ray));
    }
    assert!(geometry.closest_hit(&Ray::new(Vec3::ZERO, Vec3::ZERO)).is_none());
}

#[test]
fn rays_leave_a_mesh_cleanly_at_any_place_and_size() {
    let far = Vec3::new(148_376.0, 1234.0, -223_423.0);
    // Faces of the cube that is shifted by its own half lie in coordinate planes, where offsets of coordinates vanish.
    let near = [1.0, 1e-4, 1e6].map(|scale| (scale, Vec3::splat(scale)));
    let centered = [1.0, 1e-4, 1e-6, 1e6].map(|scale| (scale, Vec3::ZERO));
    // Farther away, points near an edge of a cube round onto it, and rays inwards rightly leave there.
    let distant = [(1.0, Vec3::splat(1e4)), (100.0, Vec3::new(1e6, 0.0, -1e6)), (2.0, far)];
    let round = sphere(40, 40, |_, _| 1.0);
    let cubes = [cube(8), cube(1)];
    let all = near.into_iter().chain(centered);
    let cases = all.clone().flat_map(|place| cubes.iter().map(move |shape| (shape, place)));
    for ((positions, triangles), (scale, shift)) in
        cases.chain(all.chain(distant).map(|place| (&round, place)))
    {
        let positions = positions.iter().map(|p| *p * scale + shift).collect();
        let geometry = scene(mesh(positions, triangles.clone()));
        let found = self_hits_and_leaks(&geometry, shift, scale, |point, dir| point.spawn(dir));
        assert_eq!(found, (0, 0), "{} triangles, scale {scale}, shift {shift}", triangles.len());
    }
}

#[test]
fn a_fixed_offset_would_leak() {
    let (positions, triangles) = sphere(40, 40, |_, _| 1e-4);
    let geometry = scene(mesh(positions, triangles));
    let fixed = |point: &SurfacePoint, dir: Vec3| Ray::new(point.p + dir * 1e-4, dir);
    let (_, leaks) = self_hits_and_leaks(&geometry, Vec3::ZERO, 1e-4, fixed);
    assert!(leaks > 1000, "only {leaks} leaks");
}

/// Spawns a ray outwards, which must miss, and one inwards, which must hit, from points of a convex closed surface.
fn self_hits_and_leaks(
    geometry: &Geometry,
    center: Vec3,
    scale: f32,
    spawn: impl Fn(&SurfacePoint, Vec3) -> Ray,
) -> (usize, usize) {
    let mut random = Random(10);
    let (mut self_hits, mut leaks) = (0, 0);
    for _ in 0..20_000 {
        let ray = Ray::new(center + random.direction() * scale * 3.0, Vec3::ZERO);
        let ray = Ray { d: center + random.point() * scale * 0.5 - ray.o, ..ray };
        let Some(hit) = geometry.closest_hit(&ray) else { continue };
        let point = geometry.surface_point(&ray, &hit);
        let dir = random.direction();
        let outwards = if dir.dot(point.n) < 0.0 { -dir } else { dir };
        self_hits += usize::from(geometry.any_hit(&spawn(&point, outwards)));
        leaks += usize::from(!geometry.any_hit(&spawn(&point, -outwards)));
    }
    (self_hits, leaks)
}

fn solid_scene(kind: SolidKind, world_from_object: DAffine3) -> Geometry {
    Geometry::build(Vec::new(), vec![solid(kind, world_from_object)])
}

fn ball(center: DVec3, radius: f64) -> DAffine3 {
    DAffine3::from_translation(center) * DAffine3::from_scale(DVec3::splat(radius))
}

#[test]
fn small_and_distant_spheres_are_hit_where_they_are() {
    let mut random = Random(11);
    for exponent in 1..=6 {
        let distance = 10_f32.powi(exponent);
        for _ in 0..5_000 {
            let o = random.direction() * distance;
            // Aim anywhere in a disk somewhat larger than the sphere.
            let d = (random.point() * 1.2 - o).normalize();
            let geometry = solid_scene(SolidKind::Sphere, DAffine3::IDENTITY);
            let found = geometry.closest_hit(&Ray::new(o, d)).map(|hit| f64::from(hit.t));
            let (o, d) = (o.as_dvec3(), d.as_dvec3());
            let along = -o.dot(d) / d.length_squared();
            let miss = o.cross(d).length() / d.length();
            if (miss - 1.0).abs() > 1e-9 * f64::from(distance) {
                assert_eq!(found.is_some(), miss < 1.0, "at distance {distance}, passing by at {miss}");
            }
            if let Some(t) = found.filter(|_| miss < 0.999) {
                let expected = along - (1.0 - miss * miss).sqrt() / d.length();
                assert!((t - expected).abs() <= 4.0 * f64::from(f32::EPSILON) * expected);
            }
        }
    }
}

#[test]
fn a_sphere_as_large_as_a_world_is_a_good_floor() {
    for radius in [1e5, 1e6, 1e7, 1e8] {
        let geometry = solid_scene(SolidKind::Sphere, ball(DVec3::new(0.0, -radius, 0.0), radius));
        let hit = geometry.closest_hit(&Ray::new(Vec3::Y, Vec3::NEG_Y)).expect("the floor is below");
        assert!((hit.t - 1.0).abs() <= 1e-6, "radius {radius}: {}", hit.t);
    }
}

#[test]
fn rays_leave_solids_cleanly() {
    let squeezed = DAffine3::from_scale(DVec3::new(3.0, 0.2, -1.0));
    let turned = DAffine3::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 1.0);
    for (name, kind, world_from_object) in [
        ("sphere", SolidKind::Sphere, DAffine3::IDENTITY),
        ("tiny sphere", SolidKind::Sphere, ball(DVec3::ZERO, 1e-6)),
        ("far sphere", SolidKind::Sphere, ball(DVec3::new(1e6, 0.0, -1e6), 100.0)),
        ("squeezed sphere", SolidKind::Sphere, turned * squeezed),
        ("egg", SolidKind::Revolve(egg()), turned),
        ("cylinder", CYLINDER, turned),
        (
            "thin cylinder",
            SolidKind::Frustum(Frustum { base: 1e-4, top: 1e-4, height: 1e4, caps: true }),
            turned,
        ),
        ("squeezed cone", CONE, turned * squeezed),
        ("far cylinder", CYLINDER, ball(DVec3::new(1e4, 0.0, -1e4), 1e3)),
    ] {
        let (center, scale) =
            (world_from_object.translation.as_vec3(), world_from_object.matrix3.x_axis.length() as f32);
        let geometry = solid_scene(kind, world_from_object);
        let (self_hits, leaks) = self_hits_and_leaks(&geometry, center, scale, |point, dir| point.spawn(dir));
        assert_eq!((self_hits, leaks), (0, 0), "{name}");
    }
}

#[test]
fn planes_are_met_at_grazing_angles() {
    let geometry = solid_scene(SolidKind::Plane, DAffine3::IDENTITY);
    for slope in [1e-1_f32, 1e-3, 1e-5, 1e-7] {
        let ray = Ray::new(Vec3::new(0.0, 0.0, 1.0), Vec3::new(1.0, 0.0, -slope));
        let hit = geometry.closest_hit(&ray).expect("the ray descends");
        assert!((f64::from(hit.t) * f64::from(slope) - 1.0).abs() <= f64::from(f32::EPSILON));
        let point = geometry.surface_point(&ray, &hit);
        assert!(point.p.z == 0.0 && point.p.is_finite() && point.tangent.is_finite());
    }
    assert!(geometry.closest_hit(&Ray::new(Vec3::Z, Vec3::X)).is_none());
    assert!(geometry.closest_hit(&Ray::new(Vec3::ZERO, Vec3::X)).is_none());
}

/// A convex closed profile from the bottom of the axis to the top.
fn egg() -> Profile {
    let point = DVec2::new;
    Profile {
        pieces: vec![
            [point(0.0, -1.0), point(0.5, -1.0), point(0.8, -0.5), point(0.8, 0.0)],
            [point(0.8, 0.0), point(0.8, 0.6), point(0.4, 1.2), point(0.0, 1.2)],
        ],
    }
}

#[test]
fn no_ray_escapes_an_egg() {
    let geometry = solid_scene(SolidKind::Revolve(egg()), ball(DVec3::new(10.0, -3.0, 7.0), 2.0));
    let mut random = Random(13);
    for i in 0..20_000 {
        let mut d = random.direction();
        d.y *= [1.0, 0.0, 1e-7, 1e-12][i % 4];
        let o = Vec3::new(10.0, -3.0, 7.0) + random.point() * 0.5;
        assert!(geometry.closest_hit(&Ray::new(o, d)).is_some(), "from {o} along {d}");
    }
}

const CYLINDER: SolidKind = SolidKind::Frustum(Frustum { base: 0.7, top: 0.7, height: 1.6, caps: true });
const CONE: SolidKind = SolidKind::Frustum(Frustum { base: 1.0, top: 0.0, height: 1.5, caps: true });
const RING: SolidKind = SolidKind::Torus(Torus { major: 1.0, minor: 0.3 });

#[test]
fn no_ray_escapes_a_cylinder_a_cone_or_the_tube_of_a_ring() {
    let mut random = Random(15);
    for (kind, inside) in [(CYLINDER, DVec3::Y * 0.8), (CONE, DVec3::Y * 0.4), (RING, DVec3::X)] {
        let place = DAffine3::from_translation(DVec3::new(10.0, -3.0, 7.0)) * DAffine3::from_rotation_x(0.4);
        let middle = place.transform_point3(inside).as_vec3();
        let geometry = solid_scene(kind, place);
        for i in 0..20_000 {
            let mut d = random.direction();
            d.y *= [1.0, 0.0, 1e-7, 1e-12][i % 4];
            let o = middle + random.point() * 0.15;
            assert!(geometry.closest_hit(&Ray::new(o, d)).is_some(), "from {o} along {d}");
        }
    }
}

/// The ring is not convex: what leaves it may meet it again, but never where it left.
#[test]
fn rays_leave_a_ring_cleanly() {
    let turned = DAffine3::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 1.0);
    for place in [turned, ball(DVec3::ZERO, 1e-6), ball(DVec3::new(1e6, 0.0, -1e6), 100.0)] {
        let (center, scale) = (place.translation.as_vec3(), place.matrix3.x_axis.length() as f32);
        let geometry = solid_scene(RING, place);
        let mut random = Random(16);
        for _ in 0..20_000 {
            let ray = Ray::new(center + random.point() * 4.0 * scale, random.direction());
            let Some(hit) = geometry.closest_hit(&ray) else { continue };
            let point = geometry.surface_point(&ray, &hit);
            let dir = random.direction();
            let again = geometry.closest_hit(&point.spawn(dir)).map(|hit| hit.t);
            match dir.dot(point.n) > 0.0 {
                // Outwards: whatever is met is the far side of the hole, or another part of the tube.
                true => assert!(again.is_none_or(|t| t > 1e-2 * scale * dir.dot(point.n)), "{again:?}"),
                false => assert!(again.is_some(), "a leak at {}", point.p),
            }
        }
    }
}

#[test]
fn boxes_hold_what_is_drawn_from_solids_and_no_more_than_they_must() {
    let skewed = DAffine3::from_mat3(DMat3::from_cols(
        DVec3::new(1.0, 0.3, -0.2),
        DVec3::new(0.5, 2.0, 0.1),
        DVec3::new(-0.4, 0.2, 0.6),
    ));
    for kind in [SolidKind::Sphere, SolidKind::Disk, CYLINDER, CONE, RING] {
        let geometry = solid_scene(kind, skewed);
        let bounds = geometry.bounds();
        let drawn = (0..256 * 256).map(|i| {
            let u = Vec2::new((i % 256) as f32 + 0.5, (i / 256) as f32 + 0.5) / 256.0;
            geometry.sample_area(PrimId(0), u).p
        });
        let drawn: Vec<Vec3> = drawn.collect();
        let held = drawn
            .iter()
            .copied()
            .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        let size = bounds.size().max_element();
        assert!((held.0 - bounds.min).min_element() >= -1e-6 && (bounds.max - held.1).min_element() >= -1e-6);
        assert!((held.0 - bounds.min).max_element() < 0.05 * size, "{bounds:?} around {held:?}");
        assert!((bounds.max - held.1).max_element() < 0.05 * size, "{bounds:?} around {held:?}");
    }
}

#[test]
fn points_drawn_towards_a_viewer_have_the_density_they_claim() {
    let corners = vec![Vec3::ZERO, Vec3::new(1.0, 0.2, 0.0), Vec3::new(0.1, 1.0, 0.3)];
    let squeezed = DAffine3::from_scale(DVec3::new(1.0, 0.5, 2.0));
    let at = |x: f64| DAffine3::from_translation(DVec3::new(x, 0.0, 0.0));
    let solids = vec![
        solid(SolidKind::Sphere, at(10.0)),
        solid(SolidKind::Disk, at(20.0)),
        solid(SolidKind::Sphere, at(30.0) * squeezed),
        solid(CYLINDER, at(40.0)),
        solid(CONE, at(50.0) * squeezed),
        solid(RING, at(60.0) * squeezed),
    ];
    let geometry = Geometry::build(vec![mesh(corners, vec![[0, 1, 2]])], solids);
    let mut random = Random(14);
    for prim in (0..geometry.prim_count()).map(PrimId) {
        let from = Vec3::new(prim.0 as f32 * 10.0 + 0.3, 0.4, 2.5);
        // The mean of 1 / pdf over the part that is seen is the solid angle; so is the share of directions that hit.
        let (mut by_points, mut by_directions) = (0.0, 0.0);
        let count = 20_000;
        for _ in 0..count {
            let u = Vec2::new(random.unit(), random.unit());
            let Some(sample) = geometry.sample_toward(prim, from, u) else { continue };
            let ray = Ray::new(from, sample.wi);
            let Some(hit) = geometry.closest_hit(&ray).filter(|hit| hit.prim == prim) else { continue };
            let point = geometry.surface_point(&ray, &hit);
            // Across a rim the density is another.
            if point.p.distance(sample.p) < 1e-3 && point.n.dot(sample.n) > 0.9 {
                let pdf = geometry.pdf_toward(prim, from, &point);
                // The hit is up to 1 mm from the point drawn, and the sharpest bend has a radius of 125 mm.
                let tolerance = 1e-3 + 1e-2 / sample.n.dot(sample.wi).abs();
                assert!((pdf / sample.pdf - 1.0).abs() < tolerance, "{prim:?}: {pdf} is not {}", sample.pdf);
                by_points += 1.0 / f64::from(sample.pdf) / f64::from(count);
            }
        }
        for _ in 0..10 * count {
            let dir = random.direction();
            let seen = geometry.closest_hit(&Ray::new(from, dir)).is_some_and(|hit| hit.prim == prim);
            by_directions += f64::from(u8::from(seen)) * 4.0 * std::f64::consts::PI / f64::from(10 * count);
        }
        assert!(
            (by_points / by_directions - 1.0).abs() < 0.05,
            "{prim:?}: {by_points} is not {by_directions}"
        );
    }
}

#[test]
fn nothing_lies_between_a_floor_and_the_sides_of_a_small_box_that_face_it() {
    let mut random = Random(26);
    let (positions, triangles) = cube(1);
    for (scale, place) in
        [(0.04, Vec3::new(0.3, 2.1, -0.2)), (0.04, Vec3::ZERO), (1e-3, Vec3::new(7.0, -3.0, 2.0))]
    {
        let placed = positions.iter().map(|&p| p * scale + place).collect();
        let floor = solid(
            SolidKind::Plane,
            DAffine3::from_rotation_x(-std::f64::consts::FRAC_PI_2)
                * DAffine3::from_translation(DVec3::Z * -4.0),
        );
        let geometry = Geometry::build(vec![mesh(placed, triangles.clone())], vec![floor]);
        for _ in 0..20_000 {
            let from = Vec3::new(random.unit() * 12.0 - 6.0, 3.0, random.unit() * 12.0 - 6.0);
            let down = Ray::new(from + Vec3::Y * 2.0, Vec3::NEG_Y);
            let Some(hit) = geometry.closest_hit(&down).filter(|hit| hit.prim.0 >= triangles.len() as u32)
            else {
                continue;
            };
            let surface = geometry.surface_point(&down, &hit);
            let prim = PrimId((random.unit() * triangles.len() as f32) as u32);
            let end = geometry.sample_area(prim, Vec2::new(random.unit(), random.unit()));
            if end.n.dot(surface.p - end.p) > 0.0 {
                assert!(
                    !geometry.any_hit(&surface.spawn_to(end.p, end.p_error, end.n)),
                    "{} to {}",
                    surface.p,
                    end.p
                );
            }
        }
    }
}

/// A mesh in a frame of its own, placed once.
fn placed(mesh: Mesh, world_from_mesh: DAffine3) -> Geometry {
    let instance =
        Instance { mesh: 0, world_from_mesh, material: MaterialId(3), source: SourceId(5), motion: None };
    Geometry::new(Shapes { shared: vec![mesh], instances: vec![instance], ..Shapes::default() })
}

/// Turned, squeezed, mirrored, far away, tiny and huge.
fn placements() -> Vec<(&'static str, DAffine3)> {
    let turned = DAffine3::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 1.0);
    let at = |x, y, z| DAffine3::from_translation(DVec3::new(x, y, z));
    vec![
        ("as it is", DAffine3::IDENTITY),
        ("turned", at(0.3, -7.0, 2.0) * turned),
        ("squeezed and mirrored", turned * DAffine3::from_scale(DVec3::new(3.0, 0.2, -1.0)) * turned),
        ("tiny", at(1e-6, 0.0, 2e-6) * turned * DAffine3::from_scale(DVec3::splat(1e-6))),
        ("huge", turned * DAffine3::from_scale(DVec3::splat(1e6))),
        ("far", at(148_376.0, 1234.0, -223_423.0) * turned * DAffine3::from_scale(DVec3::splat(8.0))),
    ]
}

#[test]
fn an_instance_that_is_not_moved_changes_no_bit() {
    for (name, mesh, center) in closed_meshes() {
        let instance = placed(mesh.clone(), DAffine3::IDENTITY);
        let copy = scene(mesh.clone());
        let mut random = Random(29);
        for i in 0..5_000 {
            let ray = aimed_ray(&mesh, center, i, &mut random);
            let (hit, other) = (instance.closest_hit(&ray), copy.closest_hit(&ray));
            assert_eq!(bits(hit), bits(other), "{name}: {ray:?}");
            let (Some(hit), Some(other)) = (hit, other) else { continue };
            let (point, expected) = (instance.surface_point(&ray, &hit), copy.surface_point(&ray, &other));
            assert_eq!((point.p, point.n, point.p_object), (expected.p, expected.n, expected.p_object));
            assert_eq!((point.material, point.source), (MaterialId(3), SourceId(5)));
        }
    }
}

#[test]
fn no_ray_escapes_a_closed_instance() {
    for (name, world_from_mesh) in placements() {
        let (positions, triangles) = cube(16);
        let shape = mesh(positions, triangles);
        let instance = placed(shape.clone(), world_from_mesh);
        let to_world = |p: Vec3| world_from_mesh.transform_point3(p.as_dvec3());
        let mut random = Random(30);
        for i in 0..20_000 {
            let ray = aimed_ray(&shape, Vec3::ZERO, i, &mut random);
            let d = world_from_mesh.transform_vector3(ray.d.as_dvec3()).as_vec3();
            let ray = Ray::new(to_world(ray.o).as_vec3(), d);
            let hit = instance.closest_hit(&ray);
            assert!(hit.is_some(), "{name}: {ray:?}");
            // The parameter means the same in both frames.
            let (t, point) = (hit.map_or(0.0, |hit| hit.t), instance.surface_point(&ray, &hit.unwrap()));
            let off = ray.o.as_dvec3() + ray.d.as_dvec3() * f64::from(t) - point.p.as_dvec3();
            let size = (point.p - ray.o).length() + ray.o.length();
            assert!(off.length() <= 1e-5 * f64::from(size), "{name}: {off}");
        }
    }
}

#[test]
fn rays_leave_instances_cleanly() {
    for (name, world_from_mesh) in placements() {
        let (positions, triangles) = sphere(40, 40, |_, _| 1.0);
        let geometry = placed(mesh(positions, triangles), world_from_mesh);
        let center = world_from_mesh.translation.as_vec3();
        let scale = world_from_mesh.matrix3.determinant().abs().cbrt() as f32;
        let found = self_hits_and_leaks(&geometry, center, scale, |point, dir| point.spawn(dir));
        assert_eq!(found, (0, 0), "{name}");
    }
}

#[test]
fn instances_and_copies_agree_on_areas_normals_and_order() {
    let (positions, triangles) = sphere(12, 12, |_, _| 1.0);
    let shape = mesh(positions, triangles);
    let count = shape.triangles.len() as u32;
    for (name, world_from_mesh) in placements() {
        let instance =
            |material| Instance { mesh: 0, world_from_mesh, material, source: SourceId(0), motion: None };
        let mut copy = shape.clone();
        copy.positions = shape
            .positions
            .iter()
            .map(|p| world_from_mesh.transform_point3(p.as_dvec3()).as_vec3())
            .collect();
        if world_from_mesh.matrix3.determinant() < 0.0 {
            copy.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        let shapes = Shapes {
            meshes: vec![copy],
            shared: vec![shape.clone()],
            instances: vec![instance(MaterialId(1)), instance(MaterialId(2))],
            solids: vec![solid(SolidKind::Sphere, DAffine3::from_translation(DVec3::splat(9.0)))],
        };
        let geometry = Geometry::new(shapes);
        assert_eq!(geometry.prim_count(), 3 * count + 1);
        let materials: Vec<_> =
            geometry.instance_prims().map(|(instance, prims)| (instance.material.0, prims.start)).collect();
        assert_eq!(materials, [(1, count), (2, 2 * count)]);
        let far = world_from_mesh.translation.abs().max_element()
            / world_from_mesh.matrix3.determinant().abs().cbrt();
        let tolerance = 1e-4 + 1e-6 * far;
        for i in 0..count {
            let (copied, placed) = (PrimId(i), PrimId(2 * count + i));
            assert!((geometry.area(placed) / geometry.area(copied) - 1.0).abs() < tolerance, "{name}");
            let (a, b) = (Vec2::new(0.3, 0.6), Vec2::new(0.3, 0.6));
            let (copied, placed) = (geometry.sample_area(copied, a), geometry.sample_area(placed, b));
            assert!(f64::from(copied.n.dot(placed.n)) > 1.0 - tolerance, "{name}: {} {}", copied.n, placed.n);
        }
    }
}
