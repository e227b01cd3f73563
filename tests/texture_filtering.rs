//! Pictures of which a pixel covers many texels are seen as their means: with less noise, and as bright as without.

use crate::support::{film_bits, render_planned};
use snell::plan::{Effect, Wanted};
use snell::render::film::Film;
use snell::source::Memory;

/// A chessboard of 64 × 64 texels.
fn files() -> Memory {
    let texel = |i: usize| if (i / 64 + i % 64).is_multiple_of(2) { "255 255 255\n" } else { "0 0 0\n" };
    let texels: String = (0..64 * 64).map(texel).collect();
    Memory::default().with("chess.ppm", format!("P3 64 64 255\n{texels}"))
}

/// Renders with pictures filtered, or with points of them looked up.
fn film(text: &str, passes: u32, filtered: bool) -> Film {
    let replan = |plan: &mut snell::plan::Plan| {
        if !filtered {
            let left_out = plan.want(&[Wanted::Without(Effect::TextureFiltering)]);
            assert_eq!(left_out.len(), 1, "the scene calls for it");
        }
    };
    let told = render_planned(text, &files(), &[], passes, &replan);
    told.film.unwrap_or_else(|| panic!("{}", told.report))
}

/// The luminance of each pixel, their mean, and their standard deviation.
fn luminances(film: &Film) -> (Vec<f64>, f64, f64) {
    let all: Vec<f64> = film.mean().iter().map(|pixel| f64::from(pixel.luminance())).collect();
    let count = all.len() as f64;
    let mean = all.iter().sum::<f64>() / count;
    let square = all.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / count;
    (all, mean, square.sqrt())
}

/// A chessboard of 256 fields along each side of 40 m, in the sun.
fn board(camera: &str) -> String {
    format!(
        "snell 1
        camera {{ {camera}, film: {{ size: 16 x 16, filter: box(0.5px) }} }}
        light directional {{ direction: (0, -1, 0), irradiance: 3 }}
        quad {{
            origin: (-20m, 0m, 20m), edge_u: (40m, 0m, 0m), edge_v: (0m, 0m, -40m)
            material: diffuse {{ color: image {{ file: \"chess.ppm\", uv_scale: (4, 4) }} }}
        }}
        render {{ method: pt }}"
    )
}

#[test]
fn a_board_seen_from_far_is_grey_from_the_first_sample_on() {
    let text = board("position: (0m, 100m, 0m), look_at: (0m, 0m, 0m), up: (0, 0, -1), fov: 10deg");
    let (_, grey, noise) = luminances(&film(&text, 1, true));
    assert!(noise < 1e-3 * grey, "{noise} of {grey}");
    let (_, mean, noise) = luminances(&film(&text, 1, false));
    // Between the middles of four texels a blend is the mean ± a half times two numbers from -1 to 1: a third of the mean.
    assert!((noise / mean - 1.0 / 3.0).abs() < 0.06, "{noise} of {mean}");
    // As bright as the mean of all points.
    let (_, mean, noise) = luminances(&film(&text, 256, false));
    let room = 4.0 * noise / 16.0 + 1e-3 * mean;
    assert!((mean - grey).abs() < room, "{mean} {grey}");
}

#[test]
fn a_board_at_a_slant_is_as_bright_as_without() {
    let text = board("position: (0m, 6m, 40m), look_at: (0m, 0m, 0m), fov: 20deg");
    let (filtered, a, _) = luminances(&film(&text, 64, true));
    let (points, b, _) = luminances(&film(&text, 256, false));
    assert!((a / b - 1.0).abs() < 0.01, "{a} {b}");
    // Nothing is blurred beyond its pixel: where a pixel is more than the sky, it is what the points say.
    for (i, (filtered, point)) in filtered.iter().zip(&points).enumerate() {
        assert!((filtered - point).abs() < 0.25 * b.max(*point), "pixel {i}: {filtered} {point}");
    }
}

#[test]
fn what_is_seen_from_near_is_the_same_bit_for_bit() {
    let text = board("position: (0m, 2m, 0m), look_at: (0m, 0m, 0m), up: (0, 0, -1), fov: 20deg");
    assert_eq!(film_bits(&film(&text, 2, true)), film_bits(&film(&text, 2, false)));
}

#[test]
fn light_from_a_board_is_as_bright_as_without() {
    let text = "snell 1
        camera { position: (0m, 1m, 6m), look_at: (0m, 1m, 0m), fov: 20deg, film: { size: 8 x 8, filter: box(0.5px) } }
        light directional { direction: (0, -1, 0), irradiance: 3 }
        plane { y: 0m, material: diffuse { color: image { file: \"chess.ppm\", projection: planar {
            origin: (0m, 0m, 0m), u: (8m, 0m, 0m), v: (0m, 0m, -8m)
        } } } }
        sphere { center: (0m, 1m, 0m), radius: 0.8m, material: diffuse { color: 0.8 } }
        render { method: pt }";
    let (_, a, _) = luminances(&film(text, 512, true));
    let (_, b, _) = luminances(&film(text, 512, false));
    assert!((a / b - 1.0).abs() < 0.01, "{a} {b}");
}
