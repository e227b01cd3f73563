//! What photon maps promise: the nearest are the nearest, densities are right, and the picture is that of path tracing.

use crate::laws::worlds::{camera, cornell, diffuse, empty, gray, mean, quad, sphere, trace};
use snell::math::{Rgb, Vec3};
use snell::render::bsdf::Material;
use snell::render::film::Film;
use snell::render::light::{Falloff, Light};
use snell::render::photon::Schedule;
use snell::render::photon::{Disc, Neighbor, Photon, PhotonMap};
use snell::render::shape::MaterialId;
use snell::render::{Method, Parts, PpmSettings, Settings, World, render};

/// Numbers in [0, 1) that look random, the same on every run (Vigna 2015, splitmix64).
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ (x >> 31)) >> 40) as f32 / (1_u64 << 24) as f32
    }

    fn point(&mut self) -> Vec3 {
        Vec3::new(self.unit(), self.unit(), self.unit())
    }
}

fn photon(p: Vec3) -> Photon {
    Photon { p, wi: Vec3::Z, n: Vec3::Z, power: Rgb::WHITE, depth: 2 }
}

/// Clouds, planes, lines, duplicates, far away ones, with few photons and many.
fn awkward_photons(i: usize, random: &mut Random) -> Vec<Photon> {
    let count = [0, 1, 2, 15, 16, 17, 33, 200, 1000][i % 9];
    let place = |p: Vec3| match i % 7 {
        0 => p,
        1 => p * Vec3::new(1.0, 1.0, 0.0),
        2 => Vec3::X * p.x,
        3 => Vec3::splat(0.25),
        4 => (p * 4.0).round() / 4.0,
        5 => Vec3::new(1e6, -1e6, 1e6) + p * 10.0,
        _ => p * p * p,
    };
    (0..count).map(|_| photon(place(random.point()))).collect()
}

/// A hard case of `hard_cases/g_photons.rs`.
pub fn the_nearest_photons_are_those_that_trying_all_finds() {
    let mut random = Random(1);
    for i in 0..189 {
        let photons = awkward_photons(i, &mut random);
        let map = PhotonMap::new(&photons);
        let mut found = Vec::new();
        for j in 0..100 {
            let near = photons.get(j * 7 % photons.len().max(1)).map_or(Vec3::ZERO, |photon| photon.p);
            let p = near + (random.point() - 0.5) * 0.2;
            let disc = Disc { p, n: Vec3::Z, radius: random.unit() * 2.0, k: [1, 2, 15, 16, 50][j % 5] };
            let accepts = |photon: &Photon| photon.p.x < p.x + 0.1;
            map.nearest(&disc, accepts, &mut found);
            found.sort_by(Neighbor::order);
            assert_eq!(found, by_trying_all(&map, &disc, accepts), "set {i}, {disc:?}");
        }
    }
}

fn by_trying_all(map: &PhotonMap, disc: &Disc, accepts: impl Fn(&Photon) -> bool) -> Vec<Neighbor> {
    let neighbor = |(index, photon): (u32, &Photon)| {
        let to = photon.p - disc.p;
        let height = (to.x * disc.n.x + to.y * disc.n.y + to.z * disc.n.z) * 10.0;
        let radius2 = (to.x * to.x + to.y * to.y + to.z * to.z).max(height * height);
        (radius2 <= disc.radius * disc.radius && accepts(photon)).then_some(Neighbor { radius2, index })
    };
    let mut all: Vec<_> = (0..).zip(map.photons()).filter_map(neighbor).collect();
    all.sort_by(Neighbor::order);
    all.truncate(disc.k);
    all
}

#[test]
fn the_map_is_the_same_for_any_number_of_threads() {
    let mut random = Random(2);
    let photons: Vec<_> = (0..100_000).map(|_| photon(random.point())).collect();
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        pool.install(|| PhotonMap::new(&photons)).photons().to_vec()
    };
    assert_eq!(with(1), with(2));
}

#[test]
fn radii_follow_the_closed_form() {
    // The product of (i + α) / (i + 1) over i = 1 … n − 1 is Γ(n + α) / (Γ(1 + α) Γ(n + 1)).
    let alpha = 2.0 / 3.0;
    let mut schedule = Schedule::new(0.5, alpha);
    let mut last = f64::INFINITY;
    for n in [1_u32, 2, 10, 1000, 1_000_000] {
        let n_real = f64::from(n);
        let log = libm::lgamma(n_real + alpha) - libm::lgamma(1.0 + alpha) - libm::lgamma(n_real + 1.0);
        let radius2 = schedule.radius2(n - 1);
        assert!((radius2 / (0.25 * libm::exp(log)) - 1.0).abs() < 1e-8, "pass {n}");
        assert!(0.0 < radius2 && radius2 < last);
        last = radius2;
    }
    let again = schedule.radius2(10);
    assert_eq!(again.to_bits(), Schedule::new(0.5, alpha).radius2(10).to_bits());
}

fn ppm(photon_count: u32, k: u32, radius: f32, passes: u32, max_depth: u32) -> Settings {
    let method = Method::Ppm(PpmSettings { photon_count, k, radius, shrink: 2.0 / 3.0 });
    Settings { seed: 1, ..Settings::new(method, max_depth, passes) }
}

fn map_photons(parts: Parts, settings: &Settings) -> Film {
    render(&World::new(parts), settings, &()).film
}

/// A large floor under parallel light, seen from above: everywhere the radiance is albedo / π times the irradiance, 1.
fn lit_floor() -> Parts {
    let mut parts = empty(camera(Vec3::new(0.0, 5.0, 0.0), Vec3::NEG_Y, 0.1, 8));
    parts.materials = vec![diffuse(0.5)];
    parts.meshes = vec![quad(Vec3::new(-2.0, 0.0, -2.0), Vec3::Z * 4.0, Vec3::X * 4.0, 0)];
    let light =
        Light::Directional { direction: Vec3::NEG_Y, irradiance: Rgb::gray(std::f32::consts::PI * 2.0) };
    parts.lights = vec![light];
    parts
}

#[test]
fn k_nearest_photons_tell_their_density() {
    let mut random = Random(3);
    for k in [5, 10, 50, 200] {
        let (maps, queries, count) = (8, 5_000, 40_000);
        let mut sum = 0.0;
        for _ in 0..maps {
            let photons: Vec<_> =
                (0..count).map(|_| photon(random.point() * Vec3::new(1.0, 1.0, 0.0))).collect();
            let map = PhotonMap::new(&photons);
            let mut found = Vec::new();
            for _ in 0..queries {
                let p = random.point() * Vec3::new(0.8, 0.8, 0.0) + Vec3::new(0.1, 0.1, 0.0);
                map.nearest(&Disc { p, n: Vec3::Z, radius: 1.0, k }, |_| true, &mut found);
                let radius2 = found.iter().map(|neighbor| neighbor.radius2).fold(0.0, f32::max);
                sum += (k - 1) as f64 / (std::f64::consts::PI * f64::from(radius2));
            }
        }
        let density = sum / f64::from(maps * queries * count);
        assert!((density - 1.0).abs() < 0.01, "k = {k}: {density}");
    }
}

#[test]
fn density_is_right_whether_the_radius_or_the_number_of_photons_binds() {
    for (k, radius) in [(5, 1.0), (10, 1.0), (50, 1.0), (1_000_000, 0.1)] {
        let film = map_photons(lit_floor(), &ppm(40_000, k, radius, 40, 4));
        // Photons spread more evenly than by chance, so the k-th is a little farther away than k − 1 allows for; on a
        // lattice, k − 1/2 would be right.
        let least = 0.99 - 0.5 / k as f32;
        assert!((f64::from(least)..1.01).contains(&mean(&film)), "k = {k}: {}", mean(&film));
    }
}

#[test]
fn photon_mapping_and_path_tracing_agree() {
    for specular in [false, true] {
        let side = 12;
        let expected = trace(cornell(side, specular), 1500, 5);
        let film = map_photons(cornell(side, specular), &ppm(20_000, 100_000, 0.06, 40, 5));
        let ratio = mean(&film) / mean(&expected);
        // What is left is the darkening along edges, which the radius has not yet outgrown.
        assert!((0.9..1.02).contains(&ratio), "specular {specular}: {ratio}");
    }
}

/// A matt room with a ball of light.
fn lamp_room(side: u32) -> Parts {
    let mut parts = cornell(side, false);
    parts.meshes.truncate(5); // the walls
    parts.solids = vec![sphere(Vec3::new(0.2, 1.5, -0.1), 0.15, 3)];
    parts
}

/// The quarters of the picture agree within three standard deviations (about 2 %) and 1 %. Discs lose a fifth of the light
/// within a radius of an edge, so the radius is small.
#[test]
fn photon_mapping_and_path_tracing_agree_block_by_block() {
    const SIDE: u32 = 24;
    const BLOCK: u32 = 12;
    let traced = trace(lamp_room(SIDE), 1024, 5);
    let mapped = map_photons(lamp_room(SIDE), &ppm(150_000, 100_000, 0.02, 48, 5));
    for y in (0..SIDE).step_by(BLOCK as usize) {
        for x in (0..SIDE).step_by(BLOCK as usize) {
            let of = |film: &Film| block(film, SIDE, [x, y], BLOCK);
            let ((a, variance_a), (b, variance_b)) = (of(&traced), of(&mapped));
            let noise = 3.0 * (variance_a + variance_b).sqrt();
            assert!(
                (a - b).abs() <= noise + 0.01 * a,
                "block ({x}, {y}): {a} traced, {b} mapped, noise {noise}"
            );
        }
    }
}

/// The mean of a block of pixels, and its variance.
fn block(film: &Film, side: u32, [x, y]: [u32; 2], size: u32) -> (f64, f64) {
    let (mean, variance) = (film.mean(), film.variance().expect("there are several passes"));
    let cells = (y..y + size).flat_map(|y| (x..x + size).map(move |x| (y * side + x) as usize));
    let count = f64::from(size * size);
    let (sum, spread) = cells.fold((0.0, 0.0), |(sum, spread), i| {
        (sum + f64::from(mean[i].mean()), spread + f64::from(variance[i].mean()))
    });
    (sum / count, spread / (count * count))
}

#[test]
fn in_a_closed_sphere_photons_add_up_to_emission_over_one_minus_albedo() {
    // e = ρ = 1/2: the radiance is 1 everywhere.
    let mut parts = empty(camera(Vec3::new(0.2, 0.1, 0.3), Vec3::NEG_Z, 1.0, 16));
    let light = Material::Emissive { radiance: Rgb::WHITE, two_sided: true };
    let mix = Material::Mix { a: MaterialId(1), b: MaterialId(2), amount: gray(0.5) };
    parts.materials = vec![mix, diffuse(1.0), light];
    parts.solids = vec![sphere(Vec3::ZERO, 1.0, 0)];
    let film = map_photons(parts, &ppm(50_000, 100_000, 0.08, 16, 1000));
    assert!((mean(&film) - 1.0).abs() < 0.01, "{}", mean(&film));
}

#[test]
fn any_number_of_threads_renders_the_same_bits() {
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        pool.install(|| map_photons(cornell(16, true), &ppm(20_000, 50, 0.2, 2, 6))).mean()
    };
    assert_eq!(with(1), with(2));
}

/// A hard case of `hard_cases/g_photons.rs`.
pub fn no_light_comes_through_a_thin_wall() {
    // A lamp over a plate; below the plate, much nearer than the radius, a floor that must stay dark.
    let mut parts = empty(camera(Vec3::new(0.0, -1.0, 0.0), Vec3::Y, 0.1, 8));
    parts.materials = vec![diffuse(0.5)];
    let plate = |height: f32| quad(Vec3::new(-2.0, height, -2.0), Vec3::Z * 4.0, Vec3::X * 4.0, 0);
    parts.meshes = vec![plate(0.0), plate(-0.001)];
    parts.lights = vec![Light::Point { p: Vec3::Y, intensity: Rgb::gray(10.0), falloff: Falloff::PHYSICAL }];
    let film = map_photons(parts, &ppm(20_000, 50, 0.1, 4, 5));
    assert_eq!(mean(&film), 0.0);
}

#[test]
fn without_light_the_picture_is_black() {
    let mut parts = lit_floor();
    parts.lights.clear();
    assert_eq!(mean(&map_photons(parts, &ppm(1000, 10, 0.1, 2, 5))), 0.0);
}
