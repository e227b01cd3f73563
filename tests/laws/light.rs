//! Laws of every light.

use super::statistics::points;
use super::worlds::{camera, cornell, diffuse, emissive, empty, mean, quad, sphere, trace};
use snell::math::{DAffine3, DMat3, DVec3, Rgb, Vec2, Vec3};
use snell::render::light::{Environment, EnvironmentRadiance, Falloff, Light, Sky};
use snell::render::shape::{MaterialId, Solid, SolidKind, SourceId};
use snell::render::texture::Image;
use snell::render::{Parts, World};
use std::f64::consts::PI;
use std::sync::Arc;

/// A white floor at y = 0 seen from the side at one point, the origin.
fn floor() -> Parts {
    let mut parts = empty(camera(Vec3::new(3.0, 0.5, 0.0), Vec3::new(-3.0, -0.5, 0.0), 1e-4, 16));
    parts.materials = vec![diffuse(1.0), emissive(1.0)];
    parts.meshes = vec![quad(Vec3::new(-5.0, 0.0, -5.0), Vec3::Z * 10.0, Vec3::X * 10.0, 0)];
    parts
}

/// The irradiance at the origin of the floor, in W/m²: all that a white surface receives it sends on, as E / π.
fn irradiance(parts: Parts) -> f64 {
    PI * mean(&trace(parts, 64, 2))
}

fn assert_close(value: f64, expected: f64, tolerance: f64) {
    assert!((value / expected - 1.0).abs() <= tolerance, "{value} for {expected}");
}

#[test]
fn irradiance_from_a_point_light() {
    let mut parts = floor();
    parts.lights = vec![Light::Point {
        p: Vec3::new(0.0, 2.0, 1.0),
        intensity: Rgb::gray(7.0),
        falloff: Falloff::PHYSICAL,
    }];
    let d2 = 5.0_f64;
    assert_close(irradiance(parts), 7.0 * (2.0 / d2.sqrt()) / d2, 1e-3);
}

#[test]
fn irradiance_from_a_directional_light() {
    let mut parts = floor();
    let direction = Vec3::new(0.0, -0.8, 0.6);
    parts.lights = vec![Light::Directional { direction, irradiance: Rgb::gray(3.0) }];
    assert_close(irradiance(parts), 3.0 * 0.8, 1e-3);
}

#[test]
fn irradiance_from_a_sphere() {
    for (height, radius) in [(2.0, 1.5), (2.0, 0.1), (200.0, 1.0)] {
        let mut parts = floor();
        parts.solids = vec![sphere(Vec3::Y * height, radius, 1)];
        assert_close(irradiance(parts), PI * (radius / f64::from(height)).powi(2), 3e-3);
    }
}

#[test]
fn irradiance_from_a_rectangle_above() {
    for height in [0.5, 2.0, 100.0] {
        let mut parts = floor();
        parts.meshes.push(quad(Vec3::new(-0.5, height, -1.0), Vec3::X, Vec3::Z * 2.0, 1));
        // Four times that of the quarter whose corner is straight above (Siegel & Howell, configuration 4).
        let (a, b) = (0.5 / f64::from(height), 1.0 / f64::from(height));
        let half = |a: f64, b: f64| a / (1.0 + a * a).sqrt() * (b / (1.0 + a * a).sqrt()).atan();
        assert_close(irradiance(parts), 4.0 * 0.5 * (half(a, b) + half(b, a)), 3e-3);
    }
}

#[test]
fn a_lamp_without_end_is_found_by_chance() {
    let mut parts = floor();
    // The plane z = 0 turned over, and lifted above the camera: it shines downwards.
    let downwards = DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y);
    parts.solids = vec![Solid {
        kind: SolidKind::Plane,
        world_from_object: DAffine3::from_mat3_translation(downwards, DVec3::Y),
        texture_from_object: DAffine3::IDENTITY,
        material: MaterialId(1),
        source: SourceId::default(),
        motion: None,
    }];
    assert_close(irradiance(parts), PI, 1e-6);
}

#[test]
fn a_one_sided_light_turned_away_sends_nothing() {
    let mut parts = floor();
    parts.meshes.push(quad(Vec3::new(-0.5, 2.0, -1.0), Vec3::Z * 2.0, Vec3::X, 1));
    assert_eq!(irradiance(parts), 0.0);
}

#[test]
fn irradiance_from_a_sky() {
    let mut parts = floor();
    parts.environment = Some(environment(EnvironmentRadiance::Constant(Rgb::gray(0.5)), 2.0, 0.0));
    assert_close(irradiance(parts), PI, 5e-3);
}

#[test]
fn irradiance_from_a_sun_of_one_texel() {
    let mut parts = floor();
    let sun = Sky::new(sun_map());
    let expected = integrate_sky(&sun, |dir| f64::from(dir.y.max(0.0)));
    parts.environment = Some(sun_map());
    // Of 64 passes the standard deviation is 0.45 %.
    assert_close(PI * mean(&trace(parts, 1_024, 2)), expected, 5e-3);
}

fn environment(radiance: EnvironmentRadiance, scale: f32, rotation: f32) -> Environment {
    Environment { radiance, scale, rotation }
}

fn image(width: u32, height: u32, texel: impl Fn(u32, u32) -> f32) -> EnvironmentRadiance {
    let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let texels = texels.map(|(x, y)| Rgb::gray(texel(x, y))).collect();
    EnvironmentRadiance::Image(Arc::new(Image::new(width, height, texels)))
}

/// Dim on one side and bright on the other.
pub fn sky_of_two_halves() -> Environment {
    environment(image(16, 8, |x, _| if x < 8 { 0.2 } else { 1.5 }), 1.0, 0.3)
}

/// Black but for one texel high in the sky.
fn sun_map() -> Environment {
    environment(image(32, 16, |x, y| if (x, y) == (9, 4) { 1e4 } else { 0.0 }), 1.0, 0.7)
}

/// The integral over all directions of a sky's radiance times a function.
fn integrate_sky(sky: &Sky, f: impl Fn(Vec3) -> f64) -> f64 {
    let (rows, columns) = (400, 800);
    let mut sum = 0.0;
    for i in 0..rows {
        let cos: f64 = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(rows);
        let sin = (1.0 - cos * cos).sqrt();
        for j in 0..columns {
            let phi = 2.0 * PI * (f64::from(j) + 0.5) / f64::from(columns);
            let dir = Vec3::new((sin * phi.cos()) as f32, cos as f32, (sin * phi.sin()) as f32);
            sum += f64::from(sky.radiance(dir).r) * f(dir);
        }
    }
    sum * 4.0 * PI / f64::from(rows * columns)
}

#[test]
fn a_sky_is_drawn_with_the_density_it_claims() {
    let skies = [
        sun_map(),
        environment(image(1, 1, |_, _| 2.0), 1.0, 0.0),
        environment(image(2, 1, |x, _| x as f32), 1.0, 1.0),
        environment(image(8192, 1, |x, _| (x % 7) as f32), 1.0, 0.0),
        environment(image(13, 7, |x, y| if y == 3 { 0.0 } else { (x * y) as f32 }), 3.0, -2.0),
        environment(image(4, 4, |_, _| 0.0), 1.0, 0.0),
    ];
    for sky in skies.map(Sky::new) {
        let (mut total, mut misses) = (0.0, 0);
        let n = 20_000;
        for (u, _) in points(n) {
            let (dir, pdf) = sky.sample(u);
            assert!(pdf > 0.0 && pdf.is_finite());
            misses += u32::from((sky.pdf(dir) / pdf - 1.0).abs() > 1e-4);
            total += f64::from(sky.radiance(dir).r / pdf) / f64::from(n);
        }
        // A direction on the very edge of a texel may round into its neighbour.
        assert!(misses <= n / 500, "{misses} of {n} directions have another density");
        let expected = 4.0 * PI * f64::from(sky.mean().r);
        assert!((total - expected).abs() <= 5e-3 * expected, "{total} for {expected}");
        for ux in [0.0, 0.5, 1.0 - f32::EPSILON / 2.0] {
            for uy in [0.0, 0.5, 1.0 - f32::EPSILON / 2.0] {
                let (dir, pdf) = sky.sample(Vec2::new(ux, uy));
                assert!(pdf > 0.0 && dir.is_normalized());
            }
        }
    }
}

#[test]
fn where_a_sky_shines_its_density_is_not_zero() {
    let sky = Sky::new(sun_map());
    for (u, _) in points(20_000) {
        let dir = snell::math::warp::square_to_uniform_sphere(u);
        assert!(sky.radiance(dir).is_black() || sky.pdf(dir) > 0.0);
    }
}

#[test]
fn the_centre_of_a_sky_is_ahead_and_its_right_is_to_the_right() {
    let quarters = image(4, 2, |x, _| x as f32);
    let sky = Sky::new(environment(quarters.clone(), 1.0, 0.0));
    let from = |x: f32, z: f32| sky.radiance(Vec3::new(x, 0.0, z)).r;
    assert_eq!([from(0.0, -1.0), from(1.0, 0.0), from(-1.0, 0.0)], [1.5, 2.5, 0.5]);
    // A quarter turn counter-clockwise seen from above brings what was ahead to the left.
    let turned = Sky::new(environment(quarters, 1.0, std::f32::consts::FRAC_PI_2));
    assert!((turned.radiance(Vec3::NEG_X).r - 1.5).abs() < 1e-5);
}

/// A hard case of `hard_cases/g_photons.rs`.
pub fn photons_carry_the_power_of_their_light() {
    let mut parts = cornell(16, true);
    parts.lights = vec![
        Light::Point { p: Vec3::ONE, intensity: Rgb::gray(2.0), falloff: Falloff::PHYSICAL },
        Light::Directional { direction: Vec3::NEG_Y, irradiance: Rgb::gray(2.0) },
    ];
    parts.environment = Some(sun_map());
    let world = World::new(parts);
    assert_eq!(world.lights.all().len(), 5);
    for light in world.lights.all() {
        let n = 20_000;
        let mut total = 0.0;
        for ((u_pos, v), (u_dir, _)) in points(n).zip(points(n).skip(1)) {
            let u_pos = Vec2::new(v, u_pos.y);
            let sample = light.sample_emission(&world.geometry, u_pos, u_dir);
            assert!(sample.ray.d.is_normalized() && sample.ray.o.is_finite());
            total += f64::from(sample.weight.r) / f64::from(n);
        }
        assert_close(total, f64::from(light.power(&world.geometry).r), 5e-3);
    }
}
