//! Laws of lamps with a shape, of spots, and of daylight.

use super::statistics::points;
use super::worlds::{camera, diffuse, emissive, empty, quad};
use snell::math::{DAffine3, DMat3, DVec3, Ray, Rgb, Vec2, Vec3, warp};
use snell::render::light::{Environment, EnvironmentRadiance, Falloff, Light, Sky, Spot, Sun};
use snell::render::shape::{Frustum, MaterialId, Solid, SolidKind, SourceId, Torus};
use snell::render::texture::Image;
use snell::render::{Parts, World};
use std::f64::consts::PI;
use std::sync::Arc;

/// A white floor at y = 0.
fn floor() -> Parts {
    let mut parts = empty(camera(Vec3::new(3.0, 0.5, 0.0), Vec3::new(-3.0, -0.5, 0.0), 1e-4, 1));
    parts.materials = vec![diffuse(1.0), emissive(1.0)];
    parts.meshes = vec![quad(Vec3::new(-5.0, 0.0, -5.0), Vec3::Z * 10.0, Vec3::X * 10.0, 0)];
    parts
}

fn lamp(kind: SolidKind, world_from_object: DAffine3) -> Solid {
    let (material, source) = (MaterialId(1), SourceId::default());
    Solid { kind, world_from_object, texture_from_object: DAffine3::IDENTITY, material, source, motion: None }
}

/// The irradiance of the origin of the floor, in W/m², by points on the lights.
fn irradiance(world: &World) -> f64 {
    let down = Ray::new(Vec3::Y * 1e-3, Vec3::NEG_Y);
    let surface = world.interaction(&down, &world.closest_hit(&down).expect("the floor"));
    let n = 20_000;
    let by = |light: &Light, u| {
        let Some(drawn) = light.sample_li(&world.geometry, surface.p, u) else { return 0.0 };
        let cos = f64::from(drawn.wi.y.max(0.0));
        let arrives = cos > 0.0 && !world.any_hit(&drawn.shadow_ray(&surface));
        if arrives { f64::from(drawn.radiance.r / drawn.pdf) * cos } else { 0.0 }
    };
    let sum = |light| points(n).map(|(u, _)| by(light, u)).sum::<f64>() / f64::from(n);
    world.lights.all().iter().map(sum).sum()
}

/// The same by directions drawn in proportion to their cosine.
fn irradiance_by_chance(world: &World) -> f64 {
    let n = 200_000;
    let seen = points(n).filter(|&(u, _)| {
        let local = warp::square_to_cosine_hemisphere(u);
        let ray = Ray::new(Vec3::Y * 1e-4, Vec3::new(local.x, local.z, local.y));
        world.closest_hit(&ray).is_some_and(|hit| world.geometry.material(hit.prim) == MaterialId(1))
    });
    PI * seen.count() as f64 / f64::from(n)
}

fn assert_close(value: f64, expected: f64, tolerance: f64) {
    assert!((value / expected - 1.0).abs() <= tolerance, "{value} for {expected}");
}

#[test]
fn irradiance_from_a_disk_above() {
    for (height, radius) in [(2.0, 1.0), (1.0, 3.0)] {
        let mut parts = floor();
        let turned = DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y) * radius;
        parts.solids =
            vec![lamp(SolidKind::Disk, DAffine3::from_mat3_translation(turned, DVec3::Y * height))];
        let expected = PI * radius * radius / (height * height + radius * radius);
        assert_close(irradiance(&World::new(parts)), expected, 5e-3);
    }
}

#[test]
fn lamps_of_every_shape_shine_as_brightly_as_they_look() {
    let squeezed = DAffine3::from_scale(DVec3::new(1.0, 0.5, 2.0));
    let turned = DAffine3::from_rotation_x(0.7);
    for (name, kind) in [
        ("cylinder", SolidKind::Frustum(Frustum { base: 0.4, top: 0.4, height: 1.5, caps: true })),
        ("pipe", SolidKind::Frustum(Frustum { base: 0.4, top: 0.2, height: 1.0, caps: false })),
        ("cone", SolidKind::Frustum(Frustum { base: 0.5, top: 0.0, height: 1.0, caps: true })),
        ("ring", SolidKind::Torus(Torus { major: 0.7, minor: 0.2 })),
    ] {
        let mut parts = floor();
        let place = DAffine3::from_translation(DVec3::new(0.2, 2.0, -0.3)) * turned * squeezed;
        parts.solids = vec![lamp(kind, place)];
        let world = World::new(parts);
        let (by_points, by_chance) = (irradiance(&world), irradiance_by_chance(&world));
        // A pipe is seen from within, too, where it is dark.
        match name {
            "pipe" => assert!(by_points < by_chance, "{by_points} {by_chance}"),
            _ => assert!((by_points / by_chance - 1.0).abs() < 0.03, "{name}: {by_points} for {by_chance}"),
        }
        let light = &world.lights.all()[0];
        let n = 20_000;
        let emitted = points(n).zip(points(n).skip(1)).map(|((u_pos, v), (u_dir, _))| {
            f64::from(light.sample_emission(&world.geometry, Vec2::new(v, u_pos.y), u_dir).weight.r)
        });
        let mean = emitted.sum::<f64>() / f64::from(n);
        assert_close(mean, f64::from(light.power(&world.geometry).r), 2e-2);
    }
}

#[test]
fn irradiance_from_a_spot() {
    let spot = |p: Vec3, axis: Vec3| {
        let mut parts = floor();
        let (intensity, falloff) = (Rgb::gray(8.0), Falloff::PHYSICAL);
        parts.lights =
            vec![Light::Spot(Spot { p, axis, cos_inner: 0.95, cos_outer: 0.9, intensity, falloff })];
        irradiance(&World::new(parts))
    };
    assert_close(spot(Vec3::Y * 2.0, Vec3::NEG_Y), 2.0, 1e-5);
    assert_eq!(spot(Vec3::Y * 2.0, Vec3::Y), 0.0);
    assert_eq!(spot(Vec3::new(2.0, 2.0, 0.0), Vec3::NEG_Y), 0.0);
}

fn daylight(sun: Option<Sun>) -> Environment {
    let texels = (0..16 * 8).map(|i| Rgb::gray(if i < 64 { 1.0 + (i % 5) as f32 } else { 0.3 })).collect();
    let sky = Arc::new(Image::new(16, 8, texels));
    Environment { radiance: EnvironmentRadiance::Daylight { sky, sun }, scale: 2.0, rotation: 0.0 }
}

#[test]
fn a_sky_with_a_sun_is_drawn_with_the_density_it_claims() {
    let direction = Vec3::new(0.5, 0.7, -0.3).normalize();
    for (sine, radiance) in [(0.1_f64, 100.0), (0.004_65, 2e5), (0.004_65, 1e-3)] {
        let sun = Sun { direction, sin2: sine * sine, radiance: Rgb::gray(radiance) };
        let sky = Sky::new(daylight(Some(sun)));
        let n = 40_000;
        let (mut total, mut on_sun) = (0.0, 0);
        for (u, _) in points(n) {
            let (dir, pdf) = sky.sample(u);
            assert!(pdf > 0.0 && pdf.is_finite() && (sky.pdf(dir) / pdf - 1.0).abs() < 1e-4);
            on_sun += u32::from(sun.meets(dir));
            total += f64::from(sky.radiance(dir).r / pdf) / f64::from(n);
        }
        assert!(on_sun > n / 6 && on_sun < n * 5 / 6, "{on_sun} of {n} at the sun");
        assert_close(total, 4.0 * PI * f64::from(sky.mean().r), 1e-2);
        let without = Sky::new(daylight(None));
        let from_sun = f64::from(sky.mean().r - without.mean().r) * 4.0 * PI;
        let expected = 2.0 * f64::from(radiance) * PI * sine * sine;
        assert!((from_sun - expected).abs() < 1e-2 * expected + 1e-5, "{from_sun} for {expected}");
    }
}
