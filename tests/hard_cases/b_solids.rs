//! Section B: shapes that are intersected exactly.

use crate::support::*;
use snell::math::{DAffine3, DMat3, DVec2, DVec3, Ray, Vec2, Vec3};
use snell::render::geometry::Geometry;
use snell::render::shape::{Profile, SolidKind};
use snell::source::Memory;

fn solids(kind: SolidKind, world_from_object: DAffine3) -> Geometry {
    Geometry::build(Vec::new(), vec![solid(kind, world_from_object)])
}

fn ball(center: DVec3, radius: f64) -> DAffine3 {
    DAffine3::from_translation(center) * DAffine3::from_scale(DVec3::splat(radius))
}

/// Case 18: small or distant spheres (Haines, Günther, Akenine-Möller 2019). Against double precision from the distance of
/// the line, hits and misses are right wherever that distance is certain, and t within 4 units in the last place.
#[test]
fn hard_case_18_small_and_distant_spheres() {
    let geometry = solids(SolidKind::Sphere, DAffine3::IDENTITY);
    let mut random = Random(118);
    let (mut wrong, mut wrong_by_naive) = (0, 0);
    for exponent in 1..=6 {
        let distance = 10_f32.powi(exponent);
        for _ in 0..10_000 {
            let o = random.direction() * distance;
            let d = (random.point() * 1.2 - o).normalize();
            let found = geometry.closest_hit(&Ray::new(o, d)).map(|hit| f64::from(hit.t));
            let naive = textbook_sphere(o, d, 1.0);
            let (o, d) = (o.as_dvec3(), d.as_dvec3());
            let miss = o.cross(d).length() / d.length();
            if (miss - 1.0).abs() > 1e-9 * f64::from(distance) {
                wrong += usize::from(found.is_some() != (miss < 1.0));
                wrong_by_naive += usize::from(naive.is_some() != (miss < 1.0));
            }
            if let Some(t) = found.filter(|_| miss < 0.999) {
                let expected = -o.dot(d) / d.length_squared() - (1.0 - miss * miss).sqrt() / d.length();
                assert!((t - expected).abs() <= 4.0 * f64::from(f32::EPSILON) * expected, "{t}, {expected}");
            }
        }
    }
    assert_eq!(wrong, 0);
    assert!(wrong_by_naive > 100, "the textbook was wrong only {wrong_by_naive} times");
}

/// Case 19: a sphere as large as a world, as a floor 1 m below. c = (|o| − r)(|o| + r) in double precision: t to 10⁻⁶
/// up to a radius of 10⁸ m. In single precision c is lost.
#[test]
fn hard_case_19_spheres_as_large_as_worlds() {
    let mut random = Random(119);
    let mut worst_naive = 0.0_f32;
    for radius in [1e5, 1e6, 1e7, 1e8] {
        let geometry = solids(SolidKind::Sphere, ball(DVec3::new(0.0, -radius, 0.0), radius));
        for _ in 0..200 {
            let slope = Vec3::new(random.unit() - 0.5, -1.0, random.unit() - 0.5);
            let hit = geometry.closest_hit(&Ray::new(Vec3::Y, slope)).expect("the floor is below");
            // The sphere lies below the plane by x² / 2r: to first order t grows by as much.
            let sag = f64::from(slope.x * slope.x + slope.z * slope.z) / (2.0 * radius);
            assert!((f64::from(hit.t) - 1.0 - sag).abs() <= 1e-6, "radius {radius}: {}", hit.t);
        }
        let above = Vec3::Y * (1.0 + radius as f32);
        let naive = textbook_sphere(above, Vec3::NEG_Y, radius as f32).unwrap_or(0.0);
        worst_naive = worst_naive.max((naive - 1.0).abs());
    }
    assert!(worst_naive > 1e-2, "the textbook is off by only {worst_naive}");
}

/// Pebbles of a centimetre on a floor.
const PEBBLES: &str = "
snell 1
param floor: int = 0
camera { position: (0m, 10cm, 40cm), look_at: (0m, 1cm, 0m), fov: 30deg, film: { size: 24 x 24 } }
light sphere { center: (20cm, 50cm, 20cm), radius: 5cm, power: 12W }
if floor == 0 { plane { y: 0m } }
if floor == 1 { sphere { center: (0m, -10000km, 0m), radius: 10000km } }
for i in 0..7 { sphere { center: (-9cm + i * 3cm, 1cm, 0m), radius: 1cm } }
render { method: pt, depth: 4 }
";

/// Case 19 in a picture: pebbles on a planet look like pebbles on a plane, within 2 % of the mean. The middle of the whole
/// scene, moved to the origin, would leave what stands on the planet 10⁷ m away, where single precision knows metres.
#[test]
fn hard_case_19_pebbles_on_a_planet() {
    let mean = |floor: &str| {
        let told = render_text(PEBBLES, &Memory::default(), &[("floor", floor)], 64);
        crate::laws::worlds::mean(&told.film.unwrap_or_else(|| panic!("{}", told.report)))
    };
    let (plane, planet) = (mean("0"), mean("1"));
    assert!((planet / plane - 1.0).abs() < 0.02, "{planet} on the planet, {plane} on the plane");
    assert_eq!(1e7_f32 + 0.01, 1e7);
}

/// Case 20: rays that leave a sphere outwards never meet it again, those inwards meet it exactly once more, also when
/// they start as close to the tangent as can be. A root at t ≈ 0 taken for a hit would meet it at once.
#[test]
fn hard_case_20_leaving_a_sphere() {
    for (center, radius) in [(DVec3::ZERO, 1.0), (DVec3::new(1e4, 3.0, -7.0), 0.5), (DVec3::ZERO, 1e-6)] {
        let geometry = solids(SolidKind::Sphere, ball(center, radius));
        let (center, radius) = (center.as_vec3(), radius as f32);
        let mut random = Random(120);
        let mut met_by_naive = 0;
        for i in 0..20_000 {
            let o = center + random.direction() * radius * 3.0;
            let ray = Ray::new(o, center + random.point() * radius * 0.5 - o);
            let hit = geometry.closest_hit(&ray).expect("aimed at its middle");
            let point = geometry.surface_point(&ray, &hit);
            let grazing = random.direction().reject_from(point.n) + point.n * [1e-6, 1e-3][i % 2];
            let dir = if i % 3 == 0 { grazing } else { random.direction() }.normalize();
            let outwards = if dir.dot(point.n) < 0.0 { -dir } else { dir };
            assert!(!geometry.any_hit(&point.spawn(outwards)), "outwards along {outwards}");
            met_by_naive += usize::from(geometry.any_hit(&Ray::new(ray.at(hit.t), outwards)));
            if i % 3 != 0 {
                let inwards = point.spawn(-outwards);
                let second = geometry.closest_hit(&inwards).expect("a ray inwards comes out");
                let out = geometry.surface_point(&inwards, &second);
                assert!(!geometry.any_hit(&out.spawn(-outwards)), "a third meeting along {}", -outwards);
            }
        }
        assert!(met_by_naive > 100, "without an offset only {met_by_naive} rays met the sphere again");
    }
}

/// Case 21: planes seen edge-on, down to 10⁻⁷ rad: t within 4 units in the last place of the exact one, parallel rays
/// miss. A threshold of 10⁻⁶ on the cosine, as many have it, loses the last of these.
#[test]
fn hard_case_21_planes_edge_on() {
    let geometry = solids(SolidKind::Plane, DAffine3::IDENTITY);
    let mut random = Random(121);
    let mut lost_by_naive = 0;
    for exponent in 0..=7 {
        for _ in 0..200 {
            let slope = 10_f32.powi(-exponent) * (0.5 + random.unit());
            let ray = Ray::new(Vec3::new(random.unit(), random.unit(), 1.0), Vec3::new(1.0, 0.3, -slope));
            let hit = geometry.closest_hit(&ray).expect("the ray descends");
            assert!((f64::from(hit.t) * f64::from(slope) - 1.0).abs() <= 4.0 * f64::from(f32::EPSILON));
            let point = geometry.surface_point(&ray, &hit);
            assert!(point.p.z == 0.0 && point.p.is_finite() && point.tangent.is_finite());
            lost_by_naive += usize::from(slope <= 1e-6);
        }
    }
    assert!(lost_by_naive > 100);
    for o in [Vec3::Z, Vec3::ZERO] {
        assert!(geometry.closest_hit(&Ray::new(o, Vec3::X)).is_none(), "parallel from {o}");
    }
}

/// A transform of random scales from 10⁻⁴ to 10⁴, turned and moved.
fn random_transform(random: &mut Random) -> DAffine3 {
    let size = 10_f64.powf(f64::from(random.unit()) * 8.0 - 4.0);
    let stretch = random.point().as_dvec3() * 0.4 + 1.0;
    let axis = random.direction().as_dvec3().normalize();
    let turned = DMat3::from_axis_angle(axis, f64::from(random.unit()) * 6.0);
    DAffine3::from_mat3_translation(
        turned * DMat3::from_diagonal(stretch * size),
        random.point().as_dvec3() * size * 3.0,
    )
}

/// Case 22: rays that leave convex solids of random size, stretch, turn and place outwards never meet them again.
/// Ellipsoids stand for all quadrics with one discriminant. Starting at the rounded hit itself, many do.
#[test]
fn hard_case_22_leaving_stretched_solids() {
    let mut random = Random(122);
    let mut met_by_naive = 0;
    for _ in 0..300 {
        let placed = random_transform(&mut random);
        let geometry = solids(SolidKind::Sphere, placed);
        for _ in 0..100 {
            let o = placed.transform_point3(random.direction().as_dvec3() * 3.0).as_vec3();
            let target = placed.transform_point3(random.point().as_dvec3() * 0.4).as_vec3();
            let ray = Ray::new(o, target - o);
            let hit = geometry.closest_hit(&ray).expect("aimed at its middle");
            let point = geometry.surface_point(&ray, &hit);
            let dir = random.direction();
            let outwards = if dir.dot(point.n) < 0.0 { -dir } else { dir };
            assert!(!geometry.any_hit(&point.spawn(outwards)), "{placed:?}");
            met_by_naive += usize::from(geometry.any_hit(&Ray::new(ray.at(hit.t), outwards)));
        }
    }
    assert!(met_by_naive > 100, "only {met_by_naive} met again without an offset");
}

/// A random profile of up to three cubics with radius ≥ 0.
fn random_profile(random: &mut Random) -> Profile {
    let mut point = || DVec2::new(f64::from(random.unit()), f64::from(random.unit()) * 2.0 - 1.0);
    let mut start = point();
    let pieces = (0..1 + (start.x * 3.0) as usize).map(|i| {
        let mut piece = [start, point(), point(), point()];
        match i {
            0 => piece[0].x = 0.0,        // begins on the axis
            1 => piece[3].x = piece[0].x, // ends straight above or below
            _ => piece[2] = piece[1],     // a doubled point
        }
        start = piece[3];
        piece
    });
    Profile { pieces: pieces.collect() }
}

fn bezier(piece: &[DVec2; 4], t: f64) -> DVec2 {
    let s = 1.0 - t;
    piece[0] * (s * s * s)
        + piece[1] * (3.0 * s * s * t)
        + piece[2] * (3.0 * s * t * t)
        + piece[3] * (t * t * t)
}

/// Whether a ray certainly meets, or certainly misses, a surface of revolution; `None` near a silhouette.
///
/// Along the ray the squared distance from the axis is a parabola in the height, so that every short chord of the
/// profile is met where the sign of "squared radius of the chord − squared radius of the ray" changes.
fn meets_by_chords(profile: &Profile, o: DVec3, d: DVec3) -> Option<bool> {
    const CHORDS: u32 = 4_000;
    let mut certain = true;
    for piece in &profile.pieces {
        let f = |t: f64| {
            let p = bezier(piece, t);
            let s = (p.y - o.y) / d.y;
            let (x, z) = (o.x + s * d.x, o.z + s * d.z);
            (p.x * p.x - (x * x + z * z), s)
        };
        let mut last = f(0.0);
        for i in 1..=CHORDS {
            let next = f(f64::from(i) / f64::from(CHORDS));
            if (last.0 < 0.0) != (next.0 < 0.0) && last.1 > 1e-6 && next.1 > 1e-6 {
                return Some(true);
            }
            certain &= next.0.abs() > 1e-5 && next.1.abs() > 1e-5;
            last = next;
        }
    }
    certain.then_some(false)
}

/// Case 23: surfaces of revolution (Yuksel 2022: bracketed roots of one polynomial). Hits and misses against thousands of
/// chords of the profile, in random profiles with cusps, doubled points, pieces on the axis and straight ones; the point
/// lies on the surface to 10⁻⁶ of its size. Newton's method from the middle of each piece misses hits.
#[test]
fn hard_case_23_surfaces_of_revolution() {
    let mut random = Random(123);
    let (mut wrong, mut decided, mut lost_by_naive) = (0, 0, 0);
    for _ in 0..60 {
        let profile = random_profile(&mut random);
        let geometry = solids(SolidKind::Revolve(profile.clone()), DAffine3::IDENTITY);
        for _ in 0..60 {
            let o = random.direction() * 2.5;
            let ray = Ray::new(o, random.point() * 0.8 - o);
            let hit = geometry.closest_hit(&ray);
            let (o, d) = (ray.o.as_dvec3(), ray.d.as_dvec3());
            if let Some(hit) = &hit {
                let p = geometry.surface_point(&ray, hit).p.as_dvec3();
                let radius = p.x.hypot(p.z);
                let off = profile.pieces.iter().flat_map(|piece| {
                    (0..=4_000)
                        .map(|i| bezier(piece, f64::from(i) / 4_000.0).distance(DVec2::new(radius, p.y)))
                });
                // A point between two of 4,000 samples is at most half a step of the profile (length < 6) away.
                assert!(off.fold(f64::INFINITY, f64::min) < 1e-3, "{p} is not on the surface");
            }
            if let Some(meets) = meets_by_chords(&profile, o, d) {
                decided += 1;
                wrong += usize::from(meets != hit.is_some());
                lost_by_naive += usize::from(meets && !newton_finds(&profile, o, d));
            }
        }
    }
    assert!(decided > 2_000, "only {decided} rays tell anything");
    assert_eq!(wrong, 0, "of {decided}");
    assert!(lost_by_naive > 20, "Newton's method lost only {lost_by_naive}");
}

/// Newton's method for f(t) = 0 from the middle of each piece, ten steps, as courses teach it.
fn newton_finds(profile: &Profile, o: DVec3, d: DVec3) -> bool {
    profile.pieces.iter().any(|piece| {
        let f = |t: f64| {
            let p = bezier(piece, t);
            let s = (p.y - o.y) / d.y;
            p.x * p.x - (o.x + s * d.x).powi(2) - (o.z + s * d.z).powi(2)
        };
        let mut t = 0.5;
        for _ in 0..10 {
            t -= f(t) * 2e-6 / (f(t + 1e-6) - f(t - 1e-6));
        }
        let s = (bezier(piece, t).y - o.y) / d.y;
        (0.0..=1.0).contains(&t) && f(t).abs() < 1e-6 && s > 0.0
    })
}

/// Case 24: the poles and the seam of a sphere's parameters. Frames are orthonormal to 10⁻⁶ and finite there; across the
/// seam u runs from one end of its range to the other, and nowhere else. ∂p/∂u, the naive tangent, is 0 at the poles.
#[test]
fn hard_case_24_poles_and_seams() {
    let geometry = solids(SolidKind::Sphere, DAffine3::IDENTITY);
    let mut random = Random(124);
    for i in 0..2_000 {
        let tiny = random.point() * 10_f32.powi(-(i % 12));
        let target = [Vec3::Y, Vec3::NEG_Y, Vec3::NEG_Z][i as usize % 3] + tiny * 0.5;
        let o = target * 3.0;
        let ray = Ray::new(o, target - o);
        let hit = geometry.closest_hit(&ray).expect("aimed at the surface");
        let point = geometry.surface_point(&ray, &hit);
        assert!(point.uv.is_finite() && point.uv.cmpge(Vec2::ZERO).all() && point.uv.cmple(Vec2::ONE).all());
        assert!((point.tangent.length() - 1.0).abs() < 1e-6 && point.tangent.dot(point.ns).abs() < 1e-6);
    }
    let pole = geometry.surface_point(
        &Ray::new(Vec3::Y * 2.0, Vec3::NEG_Y),
        &geometry.closest_hit(&Ray::new(Vec3::Y * 2.0, Vec3::NEG_Y)).expect("the pole"),
    );
    let along_u = Vec3::new(-pole.p.z, 0.0, pole.p.x);
    assert!(along_u.try_normalize().is_none(), "the naive tangent exists at the pole: {along_u}");
    let u = |phi: f32| {
        let o = Vec3::new(phi.sin(), 0.0, phi.cos()) * 2.0;
        let ray = Ray::new(o, -o);
        geometry.surface_point(&ray, &geometry.closest_hit(&ray).expect("the equator")).uv.x
    };
    let jumps = (0..3600).filter(|&i| {
        let at = |i: i32| u((i as f32 + 0.5).to_radians() * 0.1);
        (at(i + 1) - at(i)).abs() > 1e-3
    });
    assert_eq!(jumps.count(), 1, "the seam is in one place");
}
