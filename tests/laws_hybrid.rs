//! What path tracing with caustics from photons promises: no path is counted twice, none is lost.

use crate::laws::worlds::{
    camera, color, cornell, cuboid, diffuse, emissive, empty, gray, mean, quad, sphere, trace,
};
use snell::math::{DAffine3, Ray, Rgb, Vec3};
use snell::render::bsdf::{Glass, Material};
use snell::render::film::Film;
use snell::render::integrator::Pass;
use snell::render::light::{Environment, EnvironmentRadiance, Falloff, Light};
use snell::render::photon::{Aim, gathers};
use snell::render::sampler::Dim;
use snell::render::shape::{MaterialId, Solid, SolidKind};
use snell::render::texture::Image;
use snell::render::{
    GatherRadius, HybridSettings, Method, Monitor, Parts, PpmSettings, Progress, Sampling, Settings, Stop,
    StoppedBy, World, render,
};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

const SIDE: u32 = 16;
const DEPTH: u32 = 6;

fn hybrid(photon_count: u32, radius: f32) -> Method {
    let radius = GatherRadius::Meters(radius);
    Method::Hybrid(HybridSettings { photon_count, k: 500, radius, shrink: 2.0 / 3.0 })
}

fn settings(method: Method, passes: u32, seed: u64) -> Settings {
    Settings { seed, ..Settings::new(method, DEPTH, passes) }
}

/// The means of the four quarters of a picture.
fn quarters(film: &Film) -> [f64; 4] {
    let mean = film.mean();
    let half = SIDE / 2;
    [(0, 0), (half, 0), (0, half), (half, half)].map(|(x, y)| {
        let cells = (y..y + half).flat_map(|y| (x..x + half).map(move |x| (y * SIDE + x) as usize));
        cells.map(|i| f64::from(mean[i].mean())).sum::<f64>() / f64::from(half * half)
    })
}

/// Mean and variance of the mean of the quarters over independent renders: photons are shared by the pixels of a pass, so
/// only whole renders are independent.
fn measure(world: &World, method: Method, passes: u32) -> [(f64, f64); 4] {
    let runs: Vec<_> =
        (0..RUNS).map(|seed| quarters(&render(world, &settings(method, passes, seed), &()).film)).collect();
    [0, 1, 2, 3].map(|quarter| {
        let n = RUNS as f64;
        let mean = runs.iter().map(|run| run[quarter]).sum::<f64>() / n;
        let squares: f64 = runs.iter().map(|run| (run[quarter] - mean).powi(2)).sum();
        (mean, squares / (n - 1.0) / n)
    })
}

const RUNS: u64 = 16;
/// Of Welch's t with 15 to 30 degrees of freedom: exceeded by chance once in 30,000 tests, of which there are 50.
const T: f64 = 5.0;
/// What discs lose at edges, of the whole.
const BIAS: f64 = 0.01;

fn assert_same(name: &str, parts: Parts, other: (Method, u32)) {
    assert_alike(name, parts, other, (hybrid(2_000, 0.03), 6));
}

fn assert_alike(name: &str, parts: Parts, other: (Method, u32), one: (Method, u32)) {
    let world = World::new(parts);
    let expected = measure(&world, other.0, other.1);
    let found = measure(&world, one.0, one.1);
    for (quarter, ((a, va), (b, vb))) in expected.into_iter().zip(found).enumerate() {
        let tolerance = T * (va + vb).sqrt() + BIAS * a;
        assert!(
            (a - b).abs() <= tolerance,
            "{name}, quarter {quarter}: {a} and {b}, noise {}",
            (va + vb).sqrt()
        );
    }
}

fn metal(roughness: f32) -> Material {
    Material::Metal { f0: color(0.9, 0.6, 0.3), edge: gray(1.0), roughness: gray(roughness) }
}

fn glass(absorption: Rgb) -> Material {
    Material::Glass(Glass { absorption, ..Glass::of_ior(1.5) })
}

fn glossy(diffuse: f32, specular: f32, shininess: f32) -> Material {
    Material::Phong { diffuse: gray(diffuse), specular: gray(specular), shininess }
}

/// A floor and a glass ball, seen from above at an angle.
fn table(floor: Material) -> Parts {
    let mut parts = empty(camera(Vec3::new(0.0, 2.5, 2.5), Vec3::new(0.0, -1.0, -1.0), 0.4, SIDE));
    parts.materials = vec![floor, glass(Rgb::BLACK), emissive(10.0)];
    parts.meshes = vec![quad(Vec3::new(-3.0, 0.0, -3.0), Vec3::Z * 6.0, Vec3::X * 6.0, 0)];
    parts.solids = vec![sphere(Vec3::new(0.0, 0.6, 0.0), 0.5, 1)];
    parts
}

fn lamp(parts: &mut Parts) {
    parts.meshes.push(quad(Vec3::new(-0.9, 2.4, -0.5), Vec3::X * 0.6, Vec3::Z * 0.6, 2));
}

/// Worlds where paths from the camera find everything often enough to be compared with.
fn worlds_of_finite_variance() -> Vec<(&'static str, Parts)> {
    let mut metals = cornell(SIDE, true);
    (metals.materials[4], metals.materials[5]) = (metal(0.25), metal(0.6));
    let mut glossies = cornell(SIDE, true);
    (glossies.materials[4], glossies.materials[5]) = (glossy(0.3, 0.6, 200.0), glossy(0.2, 0.7, 1000.0));
    glossies.materials[0] = glossy(0.5, 0.3, 100.0);

    let mut lamp_in_glass = cornell(SIDE, true);
    lamp_in_glass.meshes.truncate(5);
    lamp_in_glass.solids =
        vec![sphere(Vec3::new(0.1, 1.2, 0.0), 0.4, 5), sphere(Vec3::new(0.1, 1.2, 0.0), 0.2, 3)];

    let mut pane = cornell(SIDE, true);
    pane.meshes.extend(cuboid(Vec3::new(-1.0, 0.0, 1.2), Vec3::new(1.0, 2.0, 1.3), false, 5));

    let mut ruby = table(diffuse(0.7));
    ruby.materials[1] = glass(Rgb::new(0.1, 2.0, 3.0));
    lamp(&mut ruby);

    let mut polished = table(Material::Mix { a: MaterialId(3), b: MaterialId(4), amount: gray(0.4) });
    polished.materials.extend([diffuse(0.7), Material::Mirror { color: gray(0.9) }]);
    polished.solids.push(sphere(Vec3::new(0.9, 0.4, 0.4), 0.3, 3));
    lamp(&mut polished);

    let mut endless = table(Material::Mirror { color: gray(0.8) });
    endless.meshes.clear();
    endless.materials[1] = diffuse(0.7);
    endless.solids.push(endless_floor());
    lamp(&mut endless);

    let mut sun = table(diffuse(0.7));
    let bright = |i: u32| if i == 2 * 16 + 5 { Rgb::new(40.0, 36.0, 30.0) } else { Rgb::gray(0.1) };
    let sky = Arc::new(Image::new(16, 8, (0..16 * 8).map(bright).collect()));
    sun.environment =
        Some(Environment { radiance: EnvironmentRadiance::Image(sky), scale: 1.0, rotation: 0.3 });

    vec![
        ("balls of glass and mirror", cornell(SIDE, true)),
        ("metals on both sides of the threshold", metals),
        ("lobes of both kinds at once", glossies),
        ("a lamp within glass", lamp_in_glass),
        ("a pane before the camera", pane),
        ("glass that absorbs", ruby),
        ("a floor half matt, half mirror", polished),
        ("a mirror without end", endless),
        ("a sky with a sun", sun),
    ]
}

/// A hard case of `hard_cases/g_photons.rs`.
pub fn hybrid_and_path_tracing_agree_quarter_by_quarter() {
    for (name, parts) in worlds_of_finite_variance() {
        assert_same(name, parts, (Method::Pt, 32));
    }
}

/// So many probes that most paths end at their second matt vertex.
#[test]
fn what_is_gathered_is_what_paths_find() {
    let mut red = cornell(SIDE, true);
    red.materials[0] = Material::Diffuse { color: color(0.9, 0.3, 0.0) };
    for (name, parts) in [("balls of glass and mirror", cornell(SIDE, true)), ("a red room", red)] {
        assert_alike(name, parts, (Method::Pt, 64), (hybrid(40_000, 0.03), 4));
    }
}

/// Paths never find lights without size through glass; photons of all light do.
#[test]
fn hybrid_and_photon_mapping_agree_on_lights_without_size() {
    let ppm = Method::Ppm(PpmSettings { photon_count: 40_000, k: 100_000, radius: 0.03, shrink: 2.0 / 3.0 });
    let point =
        Light::Point { p: Vec3::new(-0.5, 2.4, -0.3), intensity: Rgb::gray(5.0), falloff: Falloff::PHYSICAL };
    let sun = Light::Directional {
        direction: Vec3::new(0.3, -1.0, 0.2).normalize(),
        irradiance: Rgb::new(3.0, 2.0, 1.0),
    };
    for (name, light) in [("point", point), ("sun", sun)] {
        let mut parts = table(diffuse(0.7));
        parts.lights = vec![light];
        assert_same(name, parts, (ppm, 8));
    }
}

/// Photon maps cannot light an endless floor from infinity, hybrid need not.
#[test]
fn light_from_infinity_reaches_a_floor_without_end() {
    let mut parts = table(diffuse(0.5));
    parts.meshes.clear();
    parts.solids = vec![endless_floor(), sphere(Vec3::new(40.0, 2.0, 0.0), 0.5, 1)];
    let irradiance = Rgb::gray(std::f32::consts::PI);
    parts.lights = vec![Light::Directional { direction: Vec3::NEG_Y, irradiance }];
    let film = render(&World::new(parts), &settings(hybrid(1000, 0.05), 4, 0), &()).film;
    assert!((mean(&film) - 0.5).abs() < 1e-3, "{}", mean(&film));
}

/// A plane under everything, of the first material.
fn endless_floor() -> Solid {
    let world_from_object = DAffine3::from_rotation_x(-std::f64::consts::FRAC_PI_2);
    Solid { kind: SolidKind::Plane, world_from_object, ..sphere(Vec3::ZERO, 1.0, 0) }
}

/// A hard case of `hard_cases/g_photons.rs`.
pub fn without_caustics_hybrid_is_path_tracing_to_the_bit() {
    let mut uniform = table(diffuse(0.7));
    uniform.environment =
        Some(Environment { radiance: EnvironmentRadiance::Constant(Rgb::WHITE), scale: 1.0, rotation: 0.0 });
    let worlds = [("nothing throws any", cornell(SIDE, false)), ("the sky is too wide for photons", uniform)];
    for (name, parts) in worlds {
        let world = World::new(parts);
        let film = |method| render(&world, &settings(method, 3, 1), &()).film.mean();
        assert_eq!(film(Method::Pt), film(hybrid(1000, 0.05)), "{name}");
    }
}

#[test]
fn any_number_of_threads_renders_the_same_bits() {
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        let world = World::new(cornell(SIDE, true));
        pool.install(|| render(&world, &settings(hybrid(5_000, 0.05), 2, 1), &())).film.mean()
    };
    assert_eq!(with(1), with(2));
}

/// A hard case of `hard_cases/g_photons.rs`.
pub fn aimed_photons_bring_to_the_targets_what_all_photons_bring() {
    let lights = [
        Light::Point { p: Vec3::new(-0.5, 2.4, -0.3), intensity: Rgb::gray(5.0), falloff: Falloff::PHYSICAL },
        // Within one of the balls.
        Light::Point { p: Vec3::new(0.1, 0.7, 0.1), intensity: Rgb::gray(5.0), falloff: Falloff::PHYSICAL },
        Light::Directional { direction: Vec3::new(0.3, -1.0, 0.2).normalize(), irradiance: Rgb::gray(3.0) },
    ];
    let mut worlds: Vec<_> = lights
        .into_iter()
        .map(|light| {
            let mut parts = table(diffuse(0.7));
            parts.lights = vec![light];
            parts
        })
        .collect();
    let mut both_sides = table(diffuse(0.7));
    both_sides.materials[2] = Material::Emissive { radiance: Rgb::gray(10.0), two_sided: true };
    // Upright between the balls, and beside them: each side sees some.
    both_sides.meshes.push(quad(Vec3::new(0.7, 0.2, -1.0), Vec3::Y * 0.6, Vec3::Z * 0.6, 2));
    worlds.push(both_sides);
    let mut ball = table(diffuse(0.7));
    ball.solids.push(sphere(Vec3::new(-0.9, 1.4, 0.3), 0.3, 2));
    worlds.push(ball);
    let mut sun = table(diffuse(0.7));
    let bright = |i: u32| if i == 2 * 16 + 5 { Rgb::gray(40.0) } else { Rgb::gray(0.1) };
    let sky = Arc::new(Image::new(16, 8, (0..16 * 8).map(bright).collect()));
    sun.environment =
        Some(Environment { radiance: EnvironmentRadiance::Image(sky), scale: 1.0, rotation: 0.3 });
    worlds.push(sun);
    for (i, mut parts) in worlds.into_iter().enumerate() {
        // Three balls, two of which overlap.
        parts.solids.push(sphere(Vec3::new(0.3, 0.8, 0.2), 0.3, 1));
        parts.solids.push(sphere(Vec3::new(1.3, 0.4, -0.8), 0.2, 1));
        let world = World::new(parts);
        let (aimed, plain) = (power_by_aiming(&world), power_by_chance(&world));
        assert!((aimed / plain - 1.0).abs() < 0.01, "light {i}: {aimed} aimed, {plain} by chance");
    }
}

const DRAWS: u32 = 200_000;

/// The power that arrives at what throws caustics, in watts, by aimed photons.
fn power_by_aiming(world: &World) -> f64 {
    let aim = Aim::new(world);
    let pass = Pass { index: 0, seed: 1, sampling: Sampling::Sobol };
    let mut sum = 0.0;
    for photon in 0..DRAWS {
        if let Some(aimed) = aim.emit(&pass.photon_sampler(photon), 0.0) {
            sum += arrives(world, &aimed.ray, aimed.power);
        }
    }
    sum / f64::from(DRAWS)
}

fn power_by_chance(world: &World) -> f64 {
    let pass = Pass { index: 0, seed: 2, sampling: Sampling::Sobol };
    let mut sum = 0.0;
    for photon in 0..8 * DRAWS {
        let sampler = pass.photon_sampler(photon);
        let choice = world.lights.choose(sampler.get_1d(Dim::PhotonLight));
        let (light, pmf) = choice.expect("there is light");
        let (u_pos, u_dir) = (sampler.get_2d(Dim::PhotonPosition), sampler.get_2d(Dim::PhotonDirection));
        let start = light.sample_emission(&world.geometry, u_pos, u_dir);
        sum += arrives(world, &start.ray, start.weight / pmf);
    }
    sum / f64::from(8 * DRAWS)
}

fn arrives(world: &World, ray: &Ray, power: Rgb) -> f64 {
    let Some(hit) = world.closest_hit(ray) else { return 0.0 };
    let bsdf = world.bsdf(&world.interaction(ray, &hit));
    let is_sharp = !bsdf.lobes().is_empty() && !bsdf.lobes().iter().any(gathers);
    if is_sharp { f64::from(power.mean()) } else { 0.0 }
}

/// Cancels from the first question on, and counts the passes that were finished all the same.
struct Impatient(AtomicU32);

impl Monitor for Impatient {
    fn pass_done(&self, _: &Progress) {
        self.0.fetch_add(1, Ordering::Relaxed);
    }

    fn cancelled(&self) -> bool {
        true
    }
}

#[test]
fn cancelling_stops_among_the_photons() {
    let world = World::new(cornell(SIDE, true));
    let many = 2_000_000_000; // minutes of work, if nobody asked
    let ppm = Method::Ppm(PpmSettings { photon_count: many, k: 10, radius: 0.1, shrink: 0.5 });
    for method in [hybrid(many, 0.1), ppm] {
        let monitor = Impatient(AtomicU32::new(0));
        let outcome = render(&world, &settings(method, 1, 0), &monitor);
        assert_eq!(outcome.stopped_by, StoppedBy::Cancelled);
        assert_eq!(monitor.0.into_inner(), 0);
    }
}

#[test]
fn a_time_limit_stops_among_the_photons_and_changes_no_bit() {
    let world = World::new(cornell(SIDE, true));
    let timed = |method, seconds| {
        let stop = Stop { seconds: Some(seconds), ..Stop::default() };
        render(&world, &Settings { stop, ..settings(method, 1, 0) }, &())
    };
    let many = 2_000_000_000; // minutes of work, if nobody looked at the clock
    let ppm = Method::Ppm(PpmSettings { photon_count: many, k: 10, radius: 0.1, shrink: 0.5 });
    for method in [hybrid(many, 0.1), ppm] {
        let outcome = timed(method, 0.01);
        assert_eq!((outcome.stopped_by, outcome.stats.passes), (StoppedBy::Time, 0));
    }
    let some = timed(hybrid(2_000, 0.05), 0.3);
    let again = render(&world, &settings(hybrid(2_000, 0.05), some.stats.passes, 0), &());
    assert_eq!(some.film.mean(), again.film.mean(), "{} passes", some.stats.passes);
}

#[test]
fn caustics_are_as_bright_as_the_light_that_makes_them() {
    // Straight through a pane, from a lamp to a floor: glass of index 1 changes nothing.
    let through = |ior: f32| {
        let mut parts = table(diffuse(0.7));
        parts.materials[1] = Material::Glass(Glass::of_ior(ior));
        lamp(&mut parts);
        parts
    };
    let mut bare = through(1.0);
    bare.solids.clear();
    let expected = mean(&trace(bare, 64, DEPTH));
    let film = render(&World::new(through(1.0)), &settings(hybrid(20_000, 0.03), 16, 0), &()).film;
    assert!((mean(&film) / expected - 1.0).abs() < 0.01, "{} instead of {expected}", mean(&film));
}
