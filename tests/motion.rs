//! What moves while the shutter is open is blurred as long exposures are: a picture is the mean of all its moments.

use crate::support::{film_bits, render_text};
use snell::render::film::Film;
use snell::source::Memory;

/// Renders a text that must be without a mistake.
fn film(text: &str, sets: &[(&str, &str)], passes: u32) -> Film {
    let told = render_text(text, &Memory::default(), sets, passes);
    told.film.unwrap_or_else(|| panic!("{}", told.report))
}

/// The luminance of each pixel.
fn luminances(film: &Film) -> Vec<f64> {
    film.mean().iter().map(|pixel| f64::from(pixel.luminance())).collect()
}

/// The mean pictures of moments that divide the time evenly, each in the middle of its part.
fn mean_of_stills(text: &str, name: &str, moments: u32, passes: u32) -> Vec<f64> {
    let mut sum = Vec::new();
    for moment in 0..moments {
        let s = (f64::from(moment) + 0.5) / f64::from(moments);
        let still = luminances(&film(text, &[(name, &s.to_string()), ("seed", &moment.to_string())], passes));
        sum.resize(still.len(), 0.0);
        sum.iter_mut().zip(&still).for_each(|(sum, x)| *sum += x / f64::from(moments));
    }
    sum
}

/// The largest difference of two pictures, and their means.
fn compared(a: &[f64], b: &[f64]) -> (f64, f64, f64) {
    assert_eq!(a.len(), b.len());
    let largest = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let mean = |x: &[f64]| x.iter().sum::<f64>() / x.len() as f64;
    (largest, mean(a), mean(b))
}

#[test]
fn a_black_ball_that_moves_covers_each_pixel_for_the_time_that_it_is_there() {
    const PASSES: u32 = 1024;
    let text = "snell 1
        environment { radiance: 1 }
        camera {
            position: (0m, 0m, 5m), direction: (0, 0, -1), shutter: 50%
            lens: orthographic { height: 2m }
            film: { size: 24 x 8, filter: box(0.5px) }
        }
        sphere {
            radius: 0.6m, material: diffuse { color: 0 }
            transform: moving(translate(-1.5m, 0.1m, 0m), translate(4.5m, 0.1m, 0m))
        }";
    let seen = luminances(&film(text, &[], PASSES));
    // The shutter is open for the first half of the way: from -1.5 m to 1.5 m. Each pixel is a square of 0.25 m.
    let (radius, side, steps) = (0.6, 0.25, 200);
    for (i, seen) in seen.iter().enumerate() {
        let (left, top) = ((i % 24) as f64 * side - 3.0, 1.0 - (i / 24) as f64 * side);
        let mut covered = 0.0;
        for row in 0..steps {
            let y = top - (f64::from(row) + 0.5) / f64::from(steps) * side - 0.1;
            let half = f64::max(radius * radius - y * y, 0.0).sqrt();
            for moment in 0..steps {
                let center = -1.5 + 3.0 * (f64::from(moment) + 0.5) / f64::from(steps);
                let overlap = f64::min(left + side, center + half) - f64::max(left, center - half);
                covered += overlap.max(0.0) / side;
            }
        }
        let covered = covered / f64::from(steps * steps);
        // Four and a half standard deviations of independent samples; stratified ones vary less.
        let room = 4.5 * (covered * (1.0 - covered) / f64::from(PASSES)).sqrt() + 1e-4;
        assert!((1.0 - seen - covered).abs() < room, "pixel {i}: {seen}, covered {covered}");
    }
}

/// A bar that turns about its middle, `how` it does so, in front of a bright sky.
fn bar(how: &str, shutter: &str) -> String {
    format!(
        "snell 1
        param s: number = 0
        param seed: int = 0
        environment {{ radiance: 1 }}
        camera {{
            position: (0m, 0m, 5m), look_at: (0m, 0m, 0m), fov: 30deg {shutter}
            film: {{ size: 16 x 16, filter: box(0.5px) }}
        }}
        box {{
            min: (-1m, -0.1m, -0.1m), max: (1m, 0.1m, 0.1m), material: diffuse {{ color: 0 }}
            transform: {how}
        }}
        render {{ seed: seed }}"
    )
}

#[test]
fn a_bar_that_turns_more_than_once_is_the_mean_of_its_stills() {
    let moving = bar("moving(rotate_z(20deg), rotate_z(470deg)) then rotate_x(30deg)", ", shutter: 100%");
    let stills = bar("rotate_z(20deg + s * 450deg) then rotate_x(30deg)", "");
    let blurred = luminances(&film(&moving, &[], 1024));
    let mean = mean_of_stills(&stills, "s", 120, 8);
    let (largest, a, b) = compared(&blurred, &mean);
    // A pixel is at most wrong by a moment of the stills where an edge passes, ten times at most: 10 / (2 · 120), and noise.
    assert!(largest < 0.06 && (a - b).abs() < 2e-3, "{largest}: {a} {b}");
    assert!(a < 0.95, "the bar is to be seen: {a}");
}

#[test]
fn transforms_that_are_written_differently_turn_the_short_way_at_an_even_speed() {
    let quarter = "matrix([0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])";
    let moving = bar(&format!("moving(scale(1), {quarter})"), ", shutter: 100%");
    let stills = bar("rotate_z(s * 90deg)", "");
    let (largest, a, b) =
        compared(&luminances(&film(&moving, &[], 512)), &mean_of_stills(&stills, "s", 60, 8));
    assert!(largest < 0.08 && (a - b).abs() < 3e-3, "{largest}: {a} {b}");
}

#[test]
fn a_closed_shutter_sees_the_beginning_and_a_half_open_one_half_of_the_way() {
    let still = film_bits(&film(&bar("rotate_z(20deg)", ""), &[], 2));
    let closed = film_bits(&film(&bar("moving(rotate_z(20deg), rotate_z(90deg))", ""), &[], 2));
    assert_eq!(still, closed);
    let whole = bar("moving(translate(0m, 0m, 0m), translate(0.5m, 0m, 0m))", ", shutter: 100%");
    let half = bar("moving(translate(0m, 0m, 0m), translate(1m, 0m, 0m))", ", shutter: 50%");
    assert_eq!(film_bits(&film(&whole, &[], 2)), film_bits(&film(&half, &[], 2)));
    assert_ne!(film_bits(&film(&whole, &[], 2)), still);
}

#[test]
fn a_camera_that_moves_sees_what_moves_the_other_way() {
    let scene = |camera: &str, ball: &str| {
        format!(
            "snell 1
            environment {{ radiance: 1 }}
            camera {{
                position: (0m, 0.5m, 5m), look_at: (0m, 0m, 0m), fov: 40deg, shutter: 100% {camera}
                film: {{ size: 16 x 16, filter: box(0.5px) }}
            }}
            group {{
                {ball}
                sphere {{ radius: 0.7m, material: diffuse {{ color: 0.2 }} }}
                box {{ min: (0.8m, -0.5m, -0.5m), max: (1.2m, 0.5m, 0.5m), material: diffuse {{ color: 0.7 }} }}
            }}"
        )
    };
    let way = "moving(translate(0m, 0m, 0m), translate(0.8m, 0.3m, 0m)) then moving(rotate_y(0deg), rotate_y(25deg))";
    let back = "transform: moving(rotate_y(0deg), rotate_y(-25deg)) then moving(translate(0m, 0m, 0m), translate(-0.8m, -0.3m, 0m))";
    let camera = luminances(&film(&scene(&format!(", transform: {way}"), ""), &[], 256));
    let world = luminances(&film(&scene("", back), &[], 256));
    let (largest, a, b) = compared(&camera, &world);
    // The same numbers are drawn, so that only rounding at edges parts them.
    assert!(largest < 0.02 && (a - b).abs() < 1e-3, "{largest}: {a} {b}");
}

/// A ball rolling through the light of a lamp, of glass or of chalk.
fn rolling(transform: &str, shutter: &str, material: &str, method: &str) -> String {
    format!(
        "snell 1
        param s: number = 0
        param seed: int = 0
        light sphere {{ center: (0m, 3m, 0m), radius: 20cm, power: 100W }}
        camera {{
            position: (0m, 3m, 4m), look_at: (0m, 0m, 0m), fov: 40deg {shutter}
            film: {{ size: 12 x 12, filter: box(0.5px) }}
        }}
        plane {{ y: 0m, material: diffuse {{ color: 0.7 }} }}
        sphere {{ radius: 0.5m, material: {material}, transform: {transform} }}
        render {{ method: {method}, seed: seed, photons: {{ count: 4000, radius: 15cm, shrink: 0.999 }} }}"
    )
}

#[test]
fn photons_of_what_moves_are_the_mean_of_those_of_its_stills() {
    let ways = [
        "moving(translate(-1m, 0.5m, 0m), translate(1m, 0.5m, 0m))",
        "translate((2 * s - 1) * 1m, 0.5m, 0m)",
    ];
    for (method, material) in [
        ("ppm", "diffuse { color: 0.5 }"),
        ("hybrid", "glass { ior: 1.5 }"),
        ("pt", "diffuse { color: 0.5 }"),
    ] {
        let blurred = luminances(&film(&rolling(ways[0], ", shutter: 100%", material, method), &[], 384));
        let mean = mean_of_stills(&rolling(ways[1], "", material, method), "s", 48, 8);
        let (largest, a, b) = compared(&blurred, &mean);
        let peak = mean.iter().copied().fold(0.0, f64::max);
        assert!(
            (a / b - 1.0).abs() < 0.02 && largest < 0.12 * peak,
            "{method}: {largest} of {peak}, {a} {b}"
        );
    }
}

#[test]
fn motion_is_the_same_on_any_number_of_threads() {
    for method in ["pt", "ppm", "hybrid"] {
        let way = "moving(translate(-1m, 0.5m, 0m), translate(1m, 0.5m, 0m)) then moving(rotate_y(0deg), rotate_y(400deg))";
        let text = rolling(way, ", shutter: 70%", "glass { ior: 1.5 }", method);
        let bits = [1, 3].map(|threads| {
            let pool =
                rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads are to be had");
            pool.install(|| film_bits(&film(&text, &[], 3)))
        });
        assert_eq!(bits[0], bits[1], "{method}");
    }
}
