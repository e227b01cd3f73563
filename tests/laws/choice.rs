//! Laws of the choice among lights.

use super::statistics::{chi_square, independent_points, points, significance};
use super::worlds::{camera, diffuse, emissive, empty, mean, path_tracing, quad, sphere};
use snell::math::{Bounds, Ray, Rgb, Vec2, Vec3, warp};
use snell::render::light::{Cone, Environment, EnvironmentRadiance, Falloff, Light, LightBounds};
use snell::render::light::{LightTree, Sky, Viewpoint};
use snell::render::texture::Image;
use snell::render::{Outcome, Parts, World, render};
use std::f64::consts::PI;
use std::sync::Arc;

/// A few numbers in [0, 1) for the `i`-th thing.
fn random(i: u32) -> [f32; 6] {
    let mut drawn = independent_points(3 * i + 3).skip(3 * i as usize).map(|(u, _)| u.to_array());
    let mut pair = || drawn.next().expect("there are three");
    let ([a, b], [c, d], [e, f]) = (pair(), pair(), pair());
    [a, b, c, d, e, f]
}

/// Lights of all kinds, in a cube about the origin: small and large, weak and strong, on one spot and on one line.
fn lights(n: u32) -> Vec<LightBounds> {
    let light = |i: u32| {
        let [x, y, z, size, a, b] = random(i);
        let p = match i % 4 {
            0 => Vec3::splat(0.25),
            1 => Vec3::X * x,
            _ => Vec3::new(x, y, z) * 2.0 - 1.0,
        };
        let axis = warp::square_to_uniform_sphere(Vec2::new(a, b));
        LightBounds {
            bounds: Bounds::new(p, p + Vec3::splat(size * size * 0.2)),
            intensity: 10_f32.powf(4.0 * z - 2.0),
            normals: if i.is_multiple_of(3) { Cone::ALL } else { Cone::around(axis) },
            cos_reach: 0.0,
            two_sided: i.is_multiple_of(5),
        }
    };
    (0..n).map(light).collect()
}

/// Points near and far, on surfaces and in the open.
fn viewpoints() -> impl Iterator<Item = Viewpoint> {
    (1_000..1_060).map(|i| {
        let [x, y, z, scale, a, b] = random(i);
        let n = warp::square_to_uniform_sphere(Vec2::new(a, b));
        Viewpoint {
            p: (Vec3::new(x, y, z) * 2.0 - 1.0) * 10_f32.powf(4.0 * scale - 2.0),
            n: (i % 3 > 0).then_some(n),
        }
    })
}

#[test]
fn the_probabilities_of_all_lights_add_up_to_one() {
    for n in [1, 2, 3, 7, 100, 1_000] {
        let tree = LightTree::new(&lights(n));
        for from in viewpoints() {
            let sum: f64 = (0..n).map(|light| f64::from(tree.pmf(&from, light))).sum();
            // A group may promise light that none of its members keeps: then nothing is drawn.
            assert!(sum <= 1.0 + 1e-4, "{n} lights from {from:?}: {sum}");
            let surely = from.n.is_none() && n > 100;
            assert!(!surely || sum >= 0.2, "{n} lights from {from:?}: {sum}");
        }
    }
}

/// Of two lamps alike each is drawn half the time, though beside one of them a spot shines that never reaches the point.
#[test]
fn a_spot_that_shines_past_hides_no_lamp() {
    let lamp = |x: f32| LightBounds {
        bounds: Bounds::new(Vec3::X * x, Vec3::X * x),
        intensity: 1.0,
        normals: Cone::ALL,
        cos_reach: 0.0,
        two_sided: false,
    };
    let spot = LightBounds { intensity: 100.0, normals: Cone::around(Vec3::Y), cos_reach: 0.9, ..lamp(1.01) };
    let tree = LightTree::new(&[lamp(-1.0), lamp(1.0), spot]);
    let from = Viewpoint { p: Vec3::NEG_Y, n: None };
    assert!((tree.pmf(&from, 0) - 0.5).abs() < 1e-6, "{}", tree.pmf(&from, 0));
}

#[test]
fn lights_are_drawn_as_often_as_their_probability_says() {
    [7, 60].into_iter().for_each(assert_drawn_as_often);
}

fn assert_drawn_as_often(n: u32) {
    let tree = LightTree::new(&lights(n));
    let tests = 2 * viewpoints().count();
    for from in viewpoints() {
        let draws = 20_000;
        // The last bin counts the draws of nothing.
        let mut counts = vec![0.0; n as usize + 1];
        for (u, v) in independent_points(draws) {
            match tree.sample(&from, f64::from(u.x) + f64::from(v) / 16_777_216.0) {
                Some((light, pmf)) => {
                    assert!((pmf / tree.pmf(&from, light) - 1.0).abs() < 1e-4);
                    counts[light as usize] += 1.0;
                }
                None => counts[n as usize] += 1.0,
            }
        }
        let mut expected: Vec<f64> =
            (0..n).map(|light| f64::from(tree.pmf(&from, light)) * f64::from(draws)).collect();
        expected.push((f64::from(draws) - expected.iter().sum::<f64>()).max(0.0));
        if expected.iter().filter(|count| **count >= 5.0).count() > 1 {
            let p = chi_square(&counts, &expected);
            assert!(p > significance(tests), "from {from:?}: p = {p}");
        }
    }
}

/// A world of lights of every kind about a floor.
fn mixed() -> World {
    let mut parts = empty(camera(Vec3::new(0.0, 1.0, 4.0), Vec3::NEG_Z, 0.5, 8));
    parts.materials = vec![diffuse(0.5), emissive(3.0), emissive(40.0)];
    parts.meshes = vec![
        quad(Vec3::new(-5.0, 0.0, -5.0), Vec3::Z * 10.0, Vec3::X * 10.0, 0),
        quad(Vec3::new(-0.5, 2.0, -1.0), Vec3::X, Vec3::Z * 2.0, 1),
    ];
    let mut odd = quad(Vec3::new(-3.0, 0.5, -2.0), Vec3::Y, Vec3::Z, 2);
    odd.positions[2] += Vec3::Z * 0.5;
    parts.meshes.push(odd);
    parts.solids = vec![sphere(Vec3::new(2.0, 1.0, 0.0), 0.3, 2)];
    let falloff = Falloff::PHYSICAL;
    parts.lights = vec![
        Light::Point { p: Vec3::new(1.0, 2.0, 1.0), intensity: Rgb::gray(2.0), falloff },
        Light::Directional { direction: Vec3::new(0.6, -0.8, 0.0), irradiance: Rgb::gray(1.0) },
    ];
    parts.environment = Some(picture());
    World::new(parts)
}

/// A sky of few texels, one of them bright.
fn picture() -> Environment {
    let texels =
        (0..32).map(|i| Rgb::gray(if i == 10 { 30.0 } else { 0.2 + 0.1 * (i % 3) as f32 })).collect();
    let radiance = EnvironmentRadiance::Image(Arc::new(Image::new(8, 4, texels)));
    Environment { radiance, scale: 1.0, rotation: 0.3 }
}

#[test]
fn what_is_drawn_towards_lights_has_the_density_that_chance_is_weighed_against() {
    let world = mixed();
    let (mut seen, mut sky) = (0, 0);
    for i in 0..400 {
        let [x, _, z, a, b, c] = random(i);
        let p = Vec3::new(x, 0.0, z) * 4.0 - Vec3::new(2.0, 0.0, 2.0);
        let from = Viewpoint { p, n: (i % 2 > 0).then_some(Vec3::Y) };
        let u_choice = Vec2::new(a, 0.5);
        let Some(drawn) = world.lights.sample_li(&world.geometry, &from, u_choice, Vec2::new(b, c)) else {
            continue;
        };
        assert!(drawn.pdf > 0.0 && drawn.pdf.is_finite() && drawn.wi.is_normalized());
        let ray = Ray::new(p + drawn.wi * 1e-3, drawn.wi);
        let expected = match world.closest_hit(&ray) {
            _ if drawn.delta => continue,
            Some(hit) => {
                let surface = world.interaction(&ray, &hit);
                world.lights.pdf_area(&world.geometry, &from, &surface)
            }
            None => world.lights.pdf_sky(&from, drawn.wi),
        };
        if drawn.distance().is_finite() {
            seen += 1
        } else {
            sky += 1
        }
        // What stands in the way of the light has a density of its own.
        let blocked = world.any_hit(&Ray { t_max: drawn.distance() * 0.99, ..ray });
        assert!(blocked || (drawn.pdf / expected - 1.0).abs() < 2e-2, "{drawn:?}, expected {expected}");
    }
    assert!(seen > 50 && sky > 20, "{seen} points of lamps and {sky} of the sky were drawn");
}

/// A lamp of 1 m × 1 m over a matt floor, in `across` × `across` squares, each of two triangles.
fn tiled_lamp(across: u32) -> Parts {
    let mut parts = empty(camera(Vec3::new(0.0, 1.0, 2.0), Vec3::new(0.0, -0.5, -1.0), 0.5, 24));
    parts.materials = vec![diffuse(0.8), emissive(5.0)];
    parts.meshes = vec![quad(Vec3::new(-5.0, 0.0, -5.0), Vec3::Z * 10.0, Vec3::X * 10.0, 0)];
    let side = 1.0 / across as f32;
    for (i, j) in (0..across).flat_map(|i| (0..across).map(move |j| (i, j))) {
        let origin = Vec3::new(i as f32 * side - 0.5, 1.2, j as f32 * side - 0.5);
        parts.meshes.push(quad(origin, Vec3::X * side, Vec3::Z * side, 1));
    }
    parts
}

fn error(outcome: &Outcome) -> f64 {
    outcome.error.expect("more than one pass").error
}

#[test]
fn a_hundred_thousand_lamps_converge_like_ten() {
    // 3 × 3 × 2 and 224 × 224 × 2 triangles.
    let outcomes = [3, 224].map(|across| render(&World::new(tiled_lamp(across)), &path_tracing(32, 2), &()));
    let [few, many] = &outcomes;
    assert!((mean(&many.film) / mean(&few.film) - 1.0).abs() < 0.02);
    assert!(error(many) < 1.5 * error(few), "{} with many, {} with few", error(many), error(few));
}

#[test]
fn a_sky_is_drawn_for_paths_by_what_is_brighter_than_its_mean() {
    let sky = Sky::new(picture());
    let n = 20_000;
    let mut integral = 0.0;
    for (u, _) in points(n) {
        let (dir, pdf) = sky.sample_direct(u).expect("the picture has a bright texel");
        assert!(pdf > 0.0 && (sky.pdf_direct(dir) / pdf - 1.0).abs() < 1e-3);
        let anywhere = warp::square_to_uniform_sphere(u);
        integral += 4.0 * PI * f64::from(sky.pdf_direct(anywhere)) / f64::from(n);
    }
    assert!((integral - 1.0).abs() < 0.02, "{integral}");

    let even = |radiance| Sky::new(Environment { radiance, scale: 2.0, rotation: 0.0 });
    let gray = Image::new(4, 2, vec![Rgb::gray(0.3); 8]);
    for sky in
        [even(EnvironmentRadiance::Constant(Rgb::WHITE)), even(EnvironmentRadiance::Image(Arc::new(gray)))]
    {
        assert!(sky.sample_direct(Vec2::splat(0.5)).is_none() && sky.direct_irradiance() == 0.0);
    }
}
