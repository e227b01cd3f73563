//! That errors are honest: intervals hold the truth, stops keep their word, the time left is foretold, errors fall as theory
//! says, and a small mistake is found.

use super::laws::worlds::{camera, cornell, cuboid, diffuse, emissive, empty, quad, sphere};
use snell::math::{Rgb, Vec3};
use snell::output::Picture;
use snell::render::bsdf::{Glass, Material};
use snell::render::film::Film;
use snell::render::light::{Environment, EnvironmentRadiance};
use snell::render::{
    GatherRadius, HybridSettings, Method, Monitor, Outcome, Parts, PpmSettings, Progress, Sampling, Settings,
    Stop, StoppedBy, World, render,
};
use snell::study::metrics::{Relative, mean};
use snell::study::statistics::{line_through, median};
use std::sync::Mutex;

/// Four scenes whose noise has a finite variance.
fn scenes(side: u32) -> [(&'static str, World); 4] {
    parts(side).map(|(name, parts)| (name, World::new(parts)))
}

/// The same with caustics, from a ball of glass or a mirror in each.
fn caustic_scenes(side: u32) -> [(&'static str, World); 4] {
    let balls = [(Vec3::ZERO, 0.0), (Vec3::new(0.4, 0.3, 0.6), 0.3), (Vec3::new(0.9, 0.3, 0.3), 0.3), {
        (Vec3::new(0.4, -0.5, -0.4), 0.35)
    }];
    let mut scenes = parts(side);
    scenes[0].1 = cornell(side, true);
    for ((_, parts), (center, radius)) in scenes.iter_mut().zip(balls).skip(1) {
        let glass = parts.materials.len() as u32;
        parts.materials.push(Material::Glass(Glass::of_ior(1.5)));
        parts.solids.push(sphere(center, radius, glass));
    }
    scenes.map(|(name, parts)| (name, World::new(parts)))
}

fn parts(side: u32) -> [(&'static str, Parts); 4] {
    let floor = |parts: &mut Parts| {
        parts.materials = vec![diffuse(0.6), emissive(3.0)];
        parts.meshes = vec![quad(Vec3::new(-4.0, 0.0, -4.0), Vec3::Z * 8.0, Vec3::X * 8.0, 0)];
    };
    let view = || camera(Vec3::new(0.0, 1.5, 4.0), Vec3::new(0.0, -0.3, -1.0), 0.5, side);
    let mut lamp = empty(view());
    floor(&mut lamp);
    lamp.solids = vec![sphere(Vec3::new(0.5, 2.0, 0.0), 0.5, 1), sphere(Vec3::new(-0.5, 0.5, 0.0), 0.5, 0)];
    let mut sky = empty(view());
    floor(&mut sky);
    sky.solids = vec![sphere(Vec3::new(0.0, 0.7, 0.0), 0.7, 0)];
    let radiance = EnvironmentRadiance::Constant(Rgb::new(0.5, 0.7, 1.0));
    sky.environment = Some(Environment { radiance, scale: 1.0, rotation: 0.0 });
    let mut room = empty(camera(Vec3::new(0.2, 0.1, 0.3), Vec3::new(0.3, -0.2, -1.0), 1.0, side));
    room.materials = vec![diffuse(0.5), emissive(2.0)];
    room.meshes = cuboid(Vec3::splat(-1.0), Vec3::new(1.0, 2.0, 1.0), true, 0);
    room.meshes.push(quad(Vec3::new(-0.5, 1.99, -0.5), Vec3::X, Vec3::Z, 1));
    [("cornell", cornell(side, false)), ("lamp", lamp), ("sky", sky), ("room", room)]
}

fn settings(seed: u64, stop: Stop) -> Settings {
    Settings { seed, stop, ..Settings::new(Method::Pt, 8, 1) }
}

fn rendered(world: &World, seed: u64, stop: Stop) -> Outcome {
    render(world, &settings(seed, stop), &())
}

fn after(passes: u32) -> Stop {
    Stop { passes: Some(passes), ..Stop::default() }
}

fn until(error: f64) -> Stop {
    Stop { error: Some(error), ..Stop::default() }
}

/// A long render, with how far it may be from the truth itself.
struct Truth {
    picture: Picture,
    /// relMSE of its noise, and the root of that.
    noise: f64,
    error: f64,
    /// The mean over pixels and channels of its variance.
    mse: f64,
}

impl Truth {
    fn of(world: &World, passes: u32) -> Self {
        let outcome = rendered(world, 1_000_000, after(passes));
        let error = outcome.error.expect("many passes").error;
        let variance = outcome.film.variance().expect("many passes");
        let mse = mean_of(variance.iter().map(|v| f64::from(v.mean())));
        Self { picture: picture(&outcome.film), noise: error.powi(2), error, mse }
    }

    /// √relMSE of a film.
    fn error_of(&self, film: &Film) -> f64 {
        let relative = Relative::to(self.picture.mean_luminance());
        let pairs = film.mean().into_iter().zip(&self.picture.radiance);
        let squares: Vec<f64> = pairs.map(|(x, &r)| relative.squared(x, r)).collect();
        (mean(&squares) - self.noise).max(0.0).sqrt()
    }

    /// The mean over pixels and channels of the squared distance.
    fn mse_of(&self, mean: &[Rgb]) -> f64 {
        let pairs = mean.iter().zip(&self.picture.radiance);
        let squares = pairs.flat_map(|(x, r)| [0, 1, 2].map(|c| f64::from(x[c] - r[c]).powi(2)));
        squares.sum::<f64>() / (3 * mean.len()) as f64
    }

    /// How many numbers of a film lie in the intervals that it has for them, and how many have one.
    fn held_by(&self, film: &Film) -> (usize, usize) {
        let (seen, margins) = (film.mean(), film.margin().expect("four passes or more"));
        let numbers = seen.iter().zip(&margins).zip(&self.picture.radiance);
        let held = numbers.flat_map(|((x, m), r)| [0, 1, 2].map(|c| (x[c] - r[c]).abs() <= m[c]));
        (held.filter(|held| *held).count(), 3 * seen.len())
    }
}

fn picture(film: &Film) -> Picture {
    let region = film.region();
    Picture::new(region.width, region.height, film.mean())
}

/// For each scene the share of short renders whose error lies in its interval, and the share of numbers in theirs.
fn coverage(side: u32, reference_passes: u32, runs: u64, passes: u32) -> Vec<(&'static str, f64, f64)> {
    let of = |(name, world): (&'static str, World)| {
        let truth = Truth::of(&world, reference_passes);
        let (mut pictures, mut numbers) = (0, (0, 0));
        for seed in 0..runs {
            let short = rendered(&world, seed, after(passes));
            let (low, high) = short.error.and_then(|e| e.interval).expect("four passes or more");
            pictures += usize::from((low..=high).contains(&truth.error_of(&short.film)));
            let (held, all) = truth.held_by(&short.film);
            numbers = (numbers.0 + held, numbers.1 + all);
        }
        (name, pictures as f64 / runs as f64, numbers.0 as f64 / numbers.1 as f64)
    };
    scenes(side).into_iter().map(of).collect()
}

fn mean_of(values: impl Iterator<Item = f64>) -> f64 {
    mean(&values.collect::<Vec<_>>())
}

#[test]
fn printed_intervals_hold_the_truth() {
    let found = coverage(10, 2048, 12, 64);
    let pictures = mean_of(found.iter().map(|(_, pictures, _)| *pictures));
    let numbers = mean_of(found.iter().map(|(_, _, numbers)| *numbers));
    // Of 48 intervals of 95 %, 41 or more hold the truth with probability 0.99.
    assert!(pictures >= 41.0 / 48.0, "{found:?}");
    assert!((0.92..=0.975).contains(&numbers), "{found:?}");
}

#[test]
#[ignore = "takes minutes: 800 renders"]
fn printed_intervals_hold_the_truth_at_length() {
    let found = coverage(16, 8192, 200, 64);
    println!("{found:.3?}");
    let pictures = mean_of(found.iter().map(|(_, pictures, _)| *pictures));
    assert!((0.92..=0.975).contains(&pictures), "{found:?}");
    for (name, _, numbers) in found {
        assert!((0.92..=0.975).contains(&numbers), "{name}: {numbers}");
    }
}

/// Renders with photons: of how many what was said held.
#[derive(Debug)]
struct Photons {
    runs: usize,
    /// The interval of noise held how far the picture is from the mean of all such pictures.
    noise: usize,
    /// The bounds of blur held how far that mean is from the truth.
    least: usize,
    most: usize,
    /// The interval of both held how far the picture is from the truth.
    total: usize,
}

/// What photons say of their errors, against the truth by paths and against the mean of the other runs.
fn photon_coverage(
    worlds: [(&'static str, World); 4],
    method: Method,
    reference_passes: u32,
    runs: u64,
    passes: u32,
) -> Vec<(&'static str, Photons)> {
    let of = |(name, world): (&'static str, World)| {
        let truth = Truth::of(&world, reference_passes);
        let settings = |seed| Settings { method, ..settings(seed, after(passes)) };
        let films: Vec<Film> = (0..runs).map(|seed| render(&world, &settings(seed), &()).film).collect();
        let means: Vec<Vec<Rgb>> = films.iter().map(Film::mean).collect();
        let relative = Relative::to(truth.picture.mean_luminance());
        let squared = |a: &[Rgb], b: &[Rgb]| {
            let pairs = a.iter().zip(b).zip(&truth.picture.radiance);
            mean_of(pairs.map(|((&a, &b), &r)| relative.of_standard_error(a - b, r)))
        };
        let n = runs as f64;
        let all: Vec<Rgb> = (0..means[0].len())
            .map(|i| means.iter().map(|mean| mean[i]).sum::<Rgb>() / runs as f32)
            .collect();
        // A run is (n − 1) / n as far from the mean of all as from that of the others, whose own noise it has beside its own.
        let spread = mean_of(means.iter().map(|mean| squared(mean, &all))) * n / (n - 1.0);
        let noise_of = |mean: &[Rgb]| {
            let of_others = squared(mean, &all) * (n / (n - 1.0)).powi(2) - spread / (n - 1.0);
            of_others.max(0.0).sqrt()
        };
        let blur = squared(&all, &truth.picture.radiance) - spread / n - truth.noise;
        let blur = blur.max(0.0).sqrt();
        let mut held = Photons { runs: films.len(), noise: 0, least: 0, most: 0, total: 0 };
        for (film, mean) in films.iter().zip(&means) {
            let estimate = film.error().expect("many passes");
            let (low, high) = estimate.interval.expect("four passes or more");
            held.noise += usize::from((low..=high).contains(&noise_of(mean)));
            // Where no light that photons bring is in the picture, there is no blur.
            held.least += usize::from(estimate.blur.is_none_or(|bounds| bounds.least <= blur));
            held.most += usize::from(estimate.blur.is_none_or(|bounds| blur <= bounds.most));
            let (low, high) = estimate.total_interval().expect("eight passes or more");
            held.total += usize::from((low..=high).contains(&truth.error_of(film)));
        }
        (name, held)
    };
    worlds.into_iter().map(of).collect()
}

fn ppm() -> Method {
    Method::Ppm(PpmSettings { photon_count: 2_000, k: 60, radius: 0.3, shrink: 2.0 / 3.0 })
}

fn hybrid() -> Method {
    let radius = GatherRadius::Pixels(1.5);
    Method::Hybrid(HybridSettings { photon_count: 2_000, k: 500, radius, shrink: 2.0 / 3.0 })
}

/// The share of all runs.
fn share(found: &[(&'static str, Photons)], of: fn(&Photons) -> usize) -> f64 {
    let sum = |of: fn(&Photons) -> usize| found.iter().map(|(_, photons)| of(photons)).sum::<usize>();
    let runs = sum(|photons| photons.runs);
    sum(of) as f64 / runs as f64
}

#[test]
fn printed_intervals_of_photons_hold_the_truth() {
    for (worlds, method) in [(scenes(8), ppm()), (caustic_scenes(8), hybrid())] {
        let found = photon_coverage(worlds, method, 1024, 12, 16);
        for of in [|p: &Photons| p.noise, |p: &Photons| p.least, |p: &Photons| p.most, |p: &Photons| p.total]
        {
            // Of 48 intervals of 95 %, 41 or more hold the truth with probability 0.99.
            assert!(share(&found, of) >= 41.0 / 48.0, "{method:?}: {found:?}");
        }
    }
}

#[test]
#[ignore = "takes minutes: 1,600 renders"]
fn printed_intervals_of_photons_hold_the_truth_at_length() {
    for (worlds, method) in [(scenes(16), ppm()), (caustic_scenes(16), hybrid())] {
        let found = photon_coverage(worlds, method, 8192, 200, 64);
        println!("{method:?}: {found:?}");
        for of in [|p: &Photons| p.least, |p: &Photons| p.most] {
            assert!(share(&found, of) >= 0.92, "{method:?}: {found:?}");
        }
        // Not reached: intervals of noise for photons beside paths are as wide as photons alone need them, and hold all.
        for of in [|p: &Photons| p.noise, |p: &Photons| p.total] {
            assert!((0.92..=0.975).contains(&share(&found, of)), "{method:?}: {found:?}");
        }
    }
}

/// For each scene how many of some renders that stop at an error have reached it.
fn reached(side: u32, reference_passes: u32, runs: u64, times: f64) -> Vec<(&'static str, usize)> {
    let of = |(name, world): (&'static str, World)| {
        let truth = Truth::of(&world, reference_passes);
        let target = times * truth.error;
        let reached = (0..runs).filter(|&seed| {
            let outcome = rendered(&world, seed, until(target));
            assert_eq!(outcome.stopped_by, StoppedBy::Error);
            truth.error_of(&outcome.film) <= target
        });
        (name, reached.count())
    };
    scenes(side).into_iter().map(of).collect()
}

#[test]
fn an_error_that_is_asked_for_is_reached() {
    let counts = reached(10, 2048, 6, 4.0);
    let all: usize = counts.iter().map(|(_, count)| count).sum();
    // Nine of ten are promised; of 24, 18 or more have probability 0.99.
    assert!(all >= 18, "{counts:?} of 6 each");
}

#[test]
#[ignore = "takes minutes: 200 renders"]
fn an_error_that_is_asked_for_is_reached_at_length() {
    let counts = reached(16, 8192, 50, 6.0);
    println!("{counts:?} of 50 each");
    for (name, count) in counts {
        assert!(count >= 45, "{name}: {count} of 50");
    }
}

/// Notes at every doubling how many passes the render will take, as the progress bar does.
struct Prophet {
    target: f64,
    foretold: Mutex<Vec<(u32, f64)>>,
}

impl Monitor for Prophet {
    fn pass_done(&self, progress: &Progress<'_>) {
        let passes = progress.film.passes();
        if passes.is_power_of_two() && passes >= 4 {
            let estimate = progress.film.error().expect("four passes");
            let all = f64::from(passes) * estimate.effort_to(self.target);
            self.foretold.lock().expect("nobody panics").push((passes, all));
        }
    }
}

/// Of renders that stop at an error, for each: the passes that were foretold at the first doubling after a tenth of the run
/// over those it took, and the error of what was left then, as a share. Targets are `times` those for which a run
/// takes some 200 passes.
fn prophecies(side: u32, runs: u64, times: f64) -> Vec<(f64, f64)> {
    let of = |world: &World, seed: u64, target: f64| {
        let prophet = Prophet { target, foretold: Mutex::default() };
        let taken = f64::from(render(world, &settings(seed, until(target)), &prophet).stats.passes);
        let foretold = prophet.foretold.into_inner().expect("nobody panics");
        let (at, all) =
            foretold.into_iter().find(|(at, _)| f64::from(*at) >= 0.1 * taken).expect("some doubling");
        (all / taken, (all - taken).abs() / (taken - f64::from(at)).max(1.0))
    };
    let worlds = scenes(side).map(|(_, world)| world);
    let targets = [0.03, 0.04, 0.007, 0.012].map(|target| times * target);
    let pairs = || worlds.iter().zip(targets);
    (0..runs).flat_map(|seed| pairs().map(move |(world, target)| of(world, seed, target))).collect()
}

/// The share of prophecies that are near, and the middle error of what was left.
fn quality(found: &[(f64, f64)]) -> (f64, f64) {
    let near = found.iter().filter(|(ratio, _)| (0.7..=1.5).contains(ratio)).count();
    (near as f64 / found.len() as f64, median(&found.iter().map(|(_, left)| *left).collect::<Vec<_>>()))
}

#[test]
fn the_passes_that_are_left_are_foretold() {
    let found = prophecies(24, 3, 1.5);
    let (near, left) = quality(&found);
    // Of pictures this small the error itself is known to a tenth only.
    assert!(near >= 0.4 && left < 0.6, "{near} {left}: {found:.2?}");
}

#[test]
#[ignore = "takes minutes: 80 renders"]
fn the_passes_that_are_left_are_foretold_at_length() {
    let found = prophecies(48, 20, 1.0);
    let (near, left) = quality(&found);
    println!("{near} within 0.7 to 1.5, {left} of what is left");
    // Not reached: of what is left 0.24 is the middle error. How far the errors of eight streams differ is known to a quarter, and
    // that decides about a seventh of the passes, when they are foretold as well as when the render stops.
    assert!(near >= 0.8 && left < 0.15, "{near} {left}: {found:.2?}");
}

#[test]
fn a_limit_of_time_is_kept() {
    let [(_, world), ..] = scenes(64);
    let outcome = rendered(&world, 1, Stop { seconds: Some(0.5), ..Stop::default() });
    assert_eq!(outcome.stopped_by, StoppedBy::Time);
    assert!(outcome.stats.passes > 1 && outcome.stats.seconds < 1.5, "{:?}", outcome.stats);
}

#[test]
fn looking_at_the_error_does_not_change_the_picture() {
    struct Curious;
    impl Monitor for Curious {
        fn pass_done(&self, progress: &Progress<'_>) {
            assert_eq!(progress.film.error().is_some(), progress.film.passes() > 1);
            assert_eq!(progress.film.margin().is_some(), progress.film.passes() > 3);
        }
    }
    let [(_, world), ..] = scenes(16);
    let blind = rendered(&world, 3, after(20));
    let curious = render(&world, &settings(3, Stop { error: Some(1e-9), ..after(20) }), &Curious);
    assert_eq!(blind.film.mean(), curious.film.mean());
    assert_eq!(blind.error, curious.error);
}

/// The picture after 4, 8, 16, … passes.
struct Doublings(Mutex<Vec<(u32, Vec<Rgb>)>>);

impl Monitor for Doublings {
    fn pass_done(&self, progress: &Progress<'_>) {
        let passes = progress.film.passes();
        if passes.is_power_of_two() && passes >= 4 {
            self.0.lock().expect("nobody panics").push((passes, progress.film.mean()));
        }
    }
}

/// How the mean squared error falls with the passes, as the slope of logarithms over several seeds.
fn slope(world: &World, truth: &Truth, settings: Settings, seeds: u64) -> f64 {
    let runs: Vec<Vec<(u32, f64)>> = (1..=seeds)
        .map(|seed| {
            let seen = Doublings(Mutex::default());
            render(world, &Settings { seed, ..settings }, &seen);
            let seen = seen.0.into_inner().expect("nobody panics");
            seen.iter().map(|(passes, mean)| (*passes, truth.mse_of(mean) - truth.mse)).collect()
        })
        .collect();
    let points: Vec<(f64, f64)> = (0..runs[0].len())
        .map(|i| (f64::from(runs[0][i].0).ln(), mean_of(runs.iter().map(|run| run[i].1)).ln()))
        .collect();
    line_through(&points).expect("several doublings").0
}

#[test]
fn errors_of_paths_fall_as_theory_says() {
    for (name, world) in scenes(12).into_iter().skip(1) {
        let truth = Truth::of(&world, 8192);
        let of = |sampling| slope(&world, &truth, Settings { sampling, ..settings(0, after(128)) }, 12);
        let (independent, sobol) = (of(Sampling::Independent), of(Sampling::Sobol));
        assert!((independent + 1.0).abs() <= 0.05, "{name}: independent samples fall with {independent}");
        assert!(sobol <= -0.95, "{name}: Sobol points fall with {sobol}");
    }
}

/// Knaus & Zwicker 2011: the mean squared error of progressive photon mapping falls as passes^(−2/3) in the end, for
/// α = 2/3, and no faster than noise alone.
#[test]
fn errors_of_photons_fall_as_theory_says() {
    let [_, (_, world), ..] = scenes(12);
    let truth = Truth::of(&world, 8192);
    let photons = PpmSettings { photon_count: 2_000, k: 1_000, radius: 0.5, shrink: 2.0 / 3.0 };
    // Independent camera paths: of evenly spread ones, what is seen of the lamp itself falls faster than noise.
    let (method, sampling) = (Method::Ppm(photons), Sampling::Independent);
    let found = slope(&world, &truth, Settings { method, sampling, ..settings(0, after(128)) }, 6);
    assert!((-1.0..=-0.6).contains(&found), "{found}");
}
