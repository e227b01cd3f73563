//! What shines by a picture sends the light of each of its points.

use crate::support::render_text;
use snell::source::Memory;

/// Four fields: red and black above black and blue.
fn files() -> Memory {
    Memory::default().with("fields.ppm", "P3 2 2 255\n255 0 0  0 0 0\n0 0 0  0 0 255\n")
}

/// A floor under a lamp of 2 m × 2 m, in light that comes straight and by way of the floor's own wall.
fn room(lamp: &str, method: &str) -> String {
    format!(
        "snell 1
        camera {{
            position: (0m, 1.5m, 5m), look_at: (0m, 0.4m, 0m), fov: 40deg
            film: {{ size: 12 x 12, filter: box(0.5px) }}
        }}
        plane {{ y: 0m, material: diffuse {{ color: 0.6 }} }}
        plane {{ z: -2m, material: diffuse {{ color: 0.6 }} }}
        {lamp}
        render {{ method: {method}, photons: {{ count: 20000, radius: 12cm, shrink: 0.99 }} }}"
    )
}

/// The mean of each channel over the picture, and all pixels.
fn seen(text: &str, passes: u32) -> ([f64; 3], Vec<[f64; 3]>) {
    let told = render_text(text, &files(), &[], passes);
    let film = told.film.unwrap_or_else(|| panic!("{}", told.report));
    let pixels: Vec<[f64; 3]> = film.mean().iter().map(|pixel| pixel.to_array().map(f64::from)).collect();
    let mean = [0, 1, 2].map(|c| pixels.iter().map(|pixel| pixel[c]).sum::<f64>() / pixels.len() as f64);
    (mean, pixels)
}

#[test]
fn a_lamp_that_shines_by_a_picture_is_as_bright_as_its_fields() {
    // The picture's upper edge is that of `edge_v`.
    let picture = |material: &str| {
        format!(
            "let fields = image {{ file: \"fields.ppm\", filter: nearest }}
            quad {{
                origin: (-1m, 2.5m, -1m), edge_u: (2m, 0m, 0m), edge_v: (0m, 0m, 2m), material: {material}
            }}"
        )
    };
    let model = picture("principled { color: 0, ior: 1, emission: fields * 5 }");
    let lamp = picture("emissive { radiance: fields * 2.5, color: 2 }");
    let field = |x: &str, z: &str, color: &str| {
        format!(
            "quad {{
                origin: ({x}, 2.5m, {z}), edge_u: (1m, 0m, 0m), edge_v: (0m, 0m, 1m)
                material: emissive {{ radiance: 5, color: {color} }}
            }}"
        )
    };
    let fields = [field("-1m", "0m", "rgb(1, 0, 0)"), field("0m", "-1m", "rgb(0, 0, 1)")].concat();
    for (picture, method, passes) in [(&model, "pt", 512), (&lamp, "pt", 512), (&model, "ppm", 96)] {
        let (a, left) = seen(&room(picture, method), passes);
        let (b, right) = seen(&room(&fields, method), passes);
        for channel in [0, 2] {
            assert!((a[channel] / b[channel] - 1.0).abs() < 0.02, "{method}: {a:?} {b:?}");
        }
        assert!(a[1] < 1e-6 && b[0] > 0.01 && b[2] > 0.01, "{method}: {a:?} {b:?}");
        // Pixel by pixel they part by noise alone, which no pixel's neighbours share.
        let peak = right.iter().flatten().copied().fold(0.0, f64::max);
        let values = left.iter().flatten().zip(right.iter().flatten());
        let square: f64 = values.map(|(left, right)| (left - right) * (left - right)).sum();
        let rms = (square / left.len() as f64).sqrt();
        assert!(rms < 0.08 * peak, "{method}: {rms} of {peak}");
    }
}

#[test]
fn a_picture_of_one_colour_shines_as_that_colour_does() {
    let lamp = |emission: &str| {
        format!(
            "sphere {{
                center: (0m, 1.6m, 0m), radius: 30cm
                material: principled {{ color: 0, ior: 1, emission: {emission} }}
            }}"
        )
    };
    let picture =
        "(image { file: \"fields.ppm\", uv_scale: (0, 0), uv_offset: (0.25, 0.75), filter: nearest }) * 20";
    for method in ["pt", "ppm", "hybrid"] {
        let (a, _) = seen(&room(&lamp(picture), method), 48);
        let (b, _) = seen(&room(&lamp("rgb(20, 0, 0)"), method), 48);
        assert!((a[0] / b[0] - 1.0).abs() < 0.01, "{method}: {a:?} {b:?}");
    }
}
