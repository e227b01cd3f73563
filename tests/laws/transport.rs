//! Laws of whole pictures.

use super::worlds::{
    camera, cornell, cuboid, diffuse, emissive, empty, gray, mean, path_tracing, quad, sphere, trace,
};
use snell::math::{Rgb, Vec3};
use snell::render::bsdf::{Glass, Material, Relief, TextureId};
use snell::render::film::{Film, Region};
use snell::render::light::{Environment, EnvironmentRadiance, Falloff, Light};
use snell::render::shape::MaterialId;
use snell::render::texture::{Pattern, Texture};
use snell::render::{Monitor, Progress, Settings, Stop, StoppedBy, World, render};

/// Emits as much as it reflects of white: `share` of the light.
fn glowing(share: f32) -> [Material; 3] {
    let light = Material::Emissive { radiance: Rgb::WHITE, two_sided: true };
    [Material::Mix { a: MaterialId(1), b: MaterialId(2), amount: gray(share) }, diffuse(1.0), light]
}

/// Whether every pixel lies within `spread` of 1 and their mean within `tolerance`.
fn assert_all_one(film: &Film, tolerance: f64, spread: f32) {
    let mean = mean(film);
    assert!((mean - 1.0).abs() <= tolerance, "mean {mean}");
    for (i, pixel) in film.mean().iter().enumerate() {
        assert!((pixel.mean() - 1.0).abs() <= spread, "pixel {i} is {pixel:?}");
    }
}

fn uniform_sky(radiance: f32) -> Option<Environment> {
    let radiance = EnvironmentRadiance::Constant(Rgb::gray(radiance));
    Some(Environment { radiance, scale: 1.0, rotation: 0.0 })
}

#[test]
fn in_a_closed_room_radiance_is_emission_over_one_minus_albedo() {
    // e = s, ρ = 1 − s: the radiance is 1 whatever the share.
    for share in [0.5, 0.1] {
        let mut parts = empty(camera(Vec3::new(0.2, 0.1, 0.3), Vec3::new(0.3, -0.2, -1.0), 1.0, 16));
        parts.materials = glowing(share).into();
        parts.meshes = cuboid(Vec3::splat(-1.0), Vec3::new(1.0, 2.0, 1.0), true, 0);
        assert_all_one(&trace(parts, 256, 1_000), 5e-3, 0.25);
    }
}

#[test]
fn in_a_closed_sphere_too() {
    let mut parts = empty(camera(Vec3::new(0.2, 0.1, 0.3), Vec3::NEG_Z, 1.0, 16));
    parts.materials = glowing(0.5).into();
    parts.solids = vec![sphere(Vec3::ZERO, 1.0, 0)];
    assert_all_one(&trace(parts, 256, 1_000), 5e-3, 0.25);
}

#[test]
fn a_point_light_in_a_closed_sphere() {
    // Intensity π gives the irradiance π everywhere; albedo 0.5 sends on 0.5, and all bounces add up to 1.
    for positions in [vec![Vec3::ZERO], vec![Vec3::ZERO; 4]] {
        let mut parts = empty(camera(Vec3::new(0.2, 0.1, 0.3), Vec3::NEG_Z, 1.0, 16));
        parts.materials = vec![diffuse(0.5)];
        parts.solids = vec![sphere(Vec3::ZERO, 1.0, 0)];
        let intensity = Rgb::gray(std::f32::consts::PI / positions.len() as f32);
        parts.lights = positions
            .into_iter()
            .map(|p| Light::Point { p, intensity, falloff: Falloff::PHYSICAL })
            .collect();
        assert_all_one(&trace(parts, 256, 1_000), 5e-3, 0.1);
    }
}

#[test]
fn mirrors_and_matt_walls_share_a_closed_sphere() {
    // Emission 0.25, diffuse 0.25, mirror 0.5.
    let mut parts = empty(camera(Vec3::new(0.2, 0.1, 0.3), Vec3::NEG_Z, 1.0, 16));
    let mix = |a, b, amount| Material::Mix { a: MaterialId(a), b: MaterialId(b), amount: gray(amount) };
    let mirror = Material::Mirror { color: gray(1.0) };
    let light = Material::Emissive { radiance: Rgb::WHITE, two_sided: true };
    parts.materials = vec![mix(1, 4, 0.25), mix(2, 3, 2.0 / 3.0), diffuse(1.0), mirror, light];
    parts.solids = vec![sphere(Vec3::ZERO, 1.0, 0)];
    assert_all_one(&trace(parts, 256, 1_000), 5e-3, 0.3);
}

#[test]
fn what_loses_nothing_is_invisible_under_a_uniform_sky() {
    let materials = [
        diffuse(1.0),
        Material::Mirror { color: gray(1.0) },
        Material::Metal { f0: gray(1.0), edge: gray(1.0), roughness: gray(0.02) },
        Material::Glass(Glass::of_ior(1.5)),
        Material::Glass(Glass::of_ior(1.0)),
        Material::Glass(Glass { thin: true, ..Glass::of_ior(1.5) }),
        Material::Plastic { color: gray(1.0), ior: 1.5, roughness: gray(0.4) },
    ];
    for material in materials {
        let mut parts = empty(camera(Vec3::new(0.0, 0.0, 3.0), Vec3::NEG_Z, 0.4, 16));
        parts.materials = vec![material];
        parts.solids = vec![sphere(Vec3::ZERO, 1.0, 0)];
        parts.environment = uniform_sky(1.0);
        let film = trace(parts, 64, 1_000);
        assert_all_one(&film, 5e-3, 0.35);
    }
}

#[test]
fn ground_glass_is_invisible_under_a_uniform_sky() {
    let mut parts = empty(camera(Vec3::new(0.0, 0.0, 3.0), Vec3::NEG_Z, 0.4, 16));
    parts.materials = vec![Material::Glass(Glass { roughness: gray(0.15), ..Glass::of_ior(1.5) })];
    parts.solids = vec![sphere(Vec3::ZERO, 1.0, 0)];
    parts.environment = uniform_sky(1.0);
    // Some of it comes by rare ways, which are noise in a pixel.
    assert_all_one(&trace(parts, 64, 1_000), 1e-2, 2.0);
}

#[test]
fn glass_that_spreads_colours_spreads_white_light_to_white_again() {
    let mut parts = empty(camera(Vec3::new(0.0, 0.0, 3.0), Vec3::NEG_Z, 0.3, 8));
    parts.materials = vec![Material::Glass(Glass { spread: 0.05, ..Glass::of_ior(1.6) })];
    parts.solids = vec![sphere(Vec3::ZERO, 1.0, 0)];
    parts.environment = uniform_sky(1.0);
    let pixels = trace(parts, 1_024, 100).mean();
    let total = pixels.iter().fold(Rgb::BLACK, |sum, &pixel| sum + pixel) / pixels.len() as f32;
    for channel in 0..3 {
        assert!((total[channel] - 1.0).abs() < 0.01, "{total:?}");
    }
}

#[test]
fn a_mask_lets_light_and_shadow_rays_through_its_holes() {
    // A lit floor under a sheet that is half there, a quarter there, or not: seen from between the two.
    let lit_floor = |opacity: f32, cutoff: f32| {
        let mut parts = empty(camera(Vec3::Y, Vec3::NEG_Y, 0.1, 8));
        let mask = Material::Mask { base: MaterialId(2), opacity: gray(opacity), cutoff };
        parts.materials = vec![diffuse(1.0), mask, diffuse(0.0)];
        let side =
            |y: f32, material| quad(Vec3::new(-9.0, y, -9.0), Vec3::Z * 18.0, Vec3::X * 18.0, material);
        parts.meshes = vec![side(0.0, 0), side(2.0, 1)];
        parts.lights =
            vec![Light::Point { p: Vec3::Y * 3.0, intensity: Rgb::WHITE, falloff: Falloff::PHYSICAL }];
        mean(&trace(parts, 64, 3))
    };
    let open = lit_floor(0.0, 0.0);
    assert!(open > 0.0);
    assert_eq!(lit_floor(1.0, 0.0), 0.0);
    for opacity in [0.25, 0.5] {
        let share = lit_floor(opacity, 0.0) / open;
        assert!((share - f64::from(1.0 - opacity)).abs() < 0.03, "{opacity}: {share}");
    }
    assert_eq!(lit_floor(0.4, 0.5), open);
    assert_eq!(lit_floor(0.6, 0.5), 0.0);
}

#[test]
fn each_side_of_a_surface_may_be_another_material() {
    let seen_from = |z: f32| {
        let mut parts = empty(camera(Vec3::Z * z, Vec3::Z * -z, 0.1, 4));
        let glow = |radiance| Material::Emissive { radiance: Rgb::gray(radiance), two_sided: false };
        parts.materials =
            vec![Material::TwoSided { front: MaterialId(1), back: MaterialId(2) }, glow(1.0), glow(3.0)];
        parts.meshes = vec![quad(Vec3::new(-1.0, -1.0, 0.0), Vec3::X * 2.0, Vec3::Y * 2.0, 0)];
        mean(&trace(parts, 1, 2))
    };
    assert_eq!([seen_from(1.0), seen_from(-1.0)], [1.0, 3.0]);
}

#[test]
fn a_bumped_surface_is_lit_by_the_slope_that_its_heights_have() {
    // Heights that rise with v: the normal leans against it.
    let lit_from = |dir: Vec3, depth: f32| {
        let mut parts = empty(camera(Vec3::Z * 3.0, Vec3::NEG_Z, 0.01, 4));
        let relief = Relief::Bump { height: TextureId(0), depth };
        parts.materials = vec![Material::Relief { base: MaterialId(1), relief }, diffuse(1.0)];
        let (a, b) = (gray(0.0), gray(1.0));
        parts.textures = vec![Texture::Pattern { a, b, pattern: Pattern::Rise }];
        parts.meshes = vec![quad(Vec3::new(-1.0, -1.0, 0.0), Vec3::X * 2.0, Vec3::Y * 2.0, 0)];
        parts.lights = vec![Light::Directional { direction: -dir, irradiance: Rgb::WHITE }];
        mean(&trace(parts, 1, 2)) * std::f64::consts::PI
    };
    let down = Vec3::new(0.0, -1.0, 1.0).normalize();
    let up = Vec3::new(0.0, 1.0, 1.0).normalize();
    // The quad is 2 m wide, so 1 m of depth makes a slope of 1/2: the normal is (0, −1, 2) / √5.
    let (slant, facing, away) = (0.8_f64.sqrt(), 0.9_f64.sqrt(), 0.1_f64.sqrt());
    let straight = 0.5_f64.sqrt();
    for (dir, depth, expected) in [
        (Vec3::Z, 0.0, 1.0),
        (Vec3::Z, 1.0, slant),
        (down, 1.0, facing),
        (up, 1.0, away),
        (up, 0.0, straight),
    ] {
        let found = lit_from(dir, depth);
        assert!((found - expected).abs() < 1e-3, "{dir} {depth}: {found}");
    }
}

#[test]
fn light_fades_in_coloured_glass() {
    let mut parts = empty(camera(Vec3::new(0.0, 0.0, 3.0), Vec3::NEG_Z, 1e-3, 4));
    let absorption = Rgb::new(0.0, 0.5, 2.0);
    parts.materials =
        vec![Material::Glass(Glass { tint: Rgb::new(0.9, 1.0, 1.0), absorption, ..Glass::of_ior(1.0) })];
    parts.meshes = cuboid(Vec3::splat(-1.0), Vec3::splat(1.0), false, 0);
    parts.environment = uniform_sky(1.0);
    let pixel = trace(parts, 4, 10).mean()[5];
    let expected = Rgb::new(0.81, (-1.0_f32).exp(), (-4.0_f32).exp());
    for channel in 0..3 {
        assert!((pixel[channel] / expected[channel] - 1.0).abs() < 1e-3, "{pixel:?} for {expected:?}");
    }
}

#[test]
fn a_bubble_in_glass_is_free_space_again() {
    let mut parts = empty(camera(Vec3::new(0.0, 0.0, 3.0), Vec3::NEG_Z, 1e-3, 4));
    let glass =
        |ior, absorption| Material::Glass(Glass { absorption: Rgb::gray(absorption), ..Glass::of_ior(ior) });
    parts.materials = vec![glass(1.5, 1.0), glass(1.0, 0.0)];
    parts.meshes = cuboid(Vec3::splat(-1.0), Vec3::splat(1.0), false, 0);
    parts.solids = vec![sphere(Vec3::ZERO, 0.5, 1)];
    parts.environment = uniform_sky(1.0);
    // Straight through: four boundaries, each with R = 0.04, and 1 m of glass. Paths that turn back absorb more.
    let pixel = f64::from(mean(&trace(parts, 512, 100)) as f32);
    let (pass, kept) = (0.96_f64.powi(4), (-1.0_f64).exp());
    assert!((pass * kept..pass * kept + 0.12).contains(&pixel), "{pixel}");
}

#[test]
fn depth_counts_vertices_up_to_the_light() {
    let lit_floor = |max_depth| {
        let mut parts = empty(camera(Vec3::Y, Vec3::NEG_Y, 0.1, 4));
        parts.materials = vec![diffuse(1.0)];
        parts.meshes = vec![quad(Vec3::new(-1.0, 0.0, -1.0), Vec3::Z * 2.0, Vec3::X * 2.0, 0)];
        parts.lights = vec![Light::Point { p: Vec3::Y, intensity: Rgb::WHITE, falloff: Falloff::PHYSICAL }];
        mean(&trace(parts, 1, max_depth))
    };
    assert_eq!(lit_floor(1), 0.0);
    assert!(lit_floor(2) > 0.0);
    assert_eq!(lit_floor(2), lit_floor(3));
}

#[test]
fn a_lamp_behind_a_wall_leaks_no_light() {
    let mut parts = empty(camera(Vec3::new(0.0, 0.5, 0.9), Vec3::NEG_Z, 1.0, 16));
    parts.materials = vec![diffuse(0.8), emissive(10.0)];
    parts.meshes = cuboid(Vec3::splat(-1.0), Vec3::splat(1.0), true, 0);
    parts.solids = vec![sphere(Vec3::new(0.0, 0.0, -1.2), 0.199, 1)];
    assert_eq!(mean(&trace(parts, 16, 20)), 0.0);
}

fn bits(film: &Film) -> Vec<[u32; 3]> {
    film.mean().iter().map(|pixel| pixel.to_array().map(f32::to_bits)).collect()
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let with_threads = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| trace(cornell(40, true), 4, 32))
    };
    assert_eq!(bits(&with_threads(1)), bits(&with_threads(2)));
}

#[test]
fn a_crop_shows_the_same_bits_as_the_whole() {
    let world = World::new(cornell(32, true));
    let whole = render(&world, &path_tracing(2, 8), &()).film;
    let crop = Region { x: 5, y: 9, width: 20, height: 18 };
    let part = render(&world, &Settings { crop: Some(crop), ..path_tracing(2, 8) }, &()).film;
    let expected: Vec<_> = crop.pixels().map(|[x, y]| bits(&whole)[(y * 32 + x) as usize]).collect();
    assert_eq!(bits(&part), expected);
}

/// Asks to stop once so many passes are done.
struct StopAfter(std::sync::atomic::AtomicU32);

impl Monitor for StopAfter {
    fn pass_done(&self, _: &Progress) {
        self.0.fetch_sub(1, std::sync::atomic::Ordering::Relaxed);
    }

    fn cancelled(&self) -> bool {
        self.0.load(std::sync::atomic::Ordering::Relaxed) == 0
    }
}

#[test]
fn a_render_stops_when_told_and_keeps_whole_passes() {
    let world = World::new(cornell(16, false));
    let stopped = |stop, monitor: &dyn Monitor| {
        let outcome = render(&world, &Settings { stop, ..path_tracing(1, 8) }, monitor);
        (outcome.stopped_by, outcome.stats.passes)
    };
    let passes = Stop { passes: Some(3), ..Stop::default() };
    assert_eq!(stopped(passes, &()), (StoppedBy::Passes, 3));
    assert_eq!(stopped(Stop::default(), &()), (StoppedBy::Passes, 1));
    let time = Stop { seconds: Some(0.0), ..Stop::default() };
    assert_eq!(stopped(time, &()), (StoppedBy::Time, 1));
    let error = Stop { error: Some(10.0), ..Stop::default() };
    assert_eq!(stopped(error, &()), (StoppedBy::Error, 16));
    let endless = Stop { passes: Some(u32::MAX), ..Stop::default() };
    assert_eq!(stopped(endless, &StopAfter(5.into())), (StoppedBy::Cancelled, 5));
}
