//! Section D: transforms and the camera.

use crate::support::*;
use snell::source::Memory;

fn told(text: &str) -> Result<snell::render::film::Film, String> {
    let told = render_text(text, &Memory::default(), &[], 2);
    told.film.ok_or(told.report)
}

fn scaled(transform: &str) -> String {
    format!(
        "snell 1\ncamera {{ position: (0m, 0m, 3m), look_at: (0m, 0m, 0m), film: {{ size: 8 x 8 }} }}\n\
         light point {{ position: (1m, 2m, 3m), power: 50W }}\n\
         sphere {{ center: (0m, 0m, 0m), radius: 1m, transform: {transform} }}\n\
         render {{ method: pt, stop: passes(1) }}\n"
    )
}

/// Case 30: singular transforms are rejected where the scale of 0 stands; squeezed ones, as far as 10⁻⁶, are not. The
/// rule is on the determinant over the product of column norms, not on the determinant, which is 10⁻¹⁸ for a ball of a
/// micrometre.
#[test]
fn hard_case_30_singular_transforms() {
    for transform in
        ["scale(0)", "scale(1, 0, 1)", "scale(1, 1, 0) then rotate_y(30deg) then translate(1m, 0m, 0m)"]
    {
        let report = told(&scaled(transform)).err().expect("it flattens the sphere");
        assert!(report.contains("singular"), "{report}");
        assert!(report.contains("scene.snell:4:"), "the place of the transform: {report}");
    }
    for transform in ["scale(1e-6)", "scale(1e6)", "scale(1, 1e-3, 1)"] {
        if let Err(report) = told(&scaled(transform)) {
            panic!("{transform}: {report}");
        }
    }
}

/// The scene of case 31; `x` is 1, or −1 for its mirror image.
const HANDED: &str = "
snell 1
param x: number = 1
camera { position: (x * 1m, 1m, 3m), look_at: (0m, 0.3m, 0m), film: { size: 24 x 24, filter: box(0.5px) } }
light point { position: (x * 1m, 1.5m, 1m), power: 20W }
plane { y: 0m }
group {
    transform: scale(x, 1, 1)
    quad {
        origin: (0.2m, 2m, -0.3m), edge_u: (0.5m, 0m, 0m), edge_v: (0m, 0m, 0.5m)
        material: emissive { radiance: rgb(20, 20, 20) }
    }
    box { center: (0.4m, 0.3m, 0m), size: (0.3m, 0.6m, 0.2m), transform: rotate_y(20deg), material: diffuse { color: #c08040 } }
    sphere { center: (-0.4m, 0.3m, 0.2m), radius: 30cm, material: glass { ior: 1.5 } }
}
render { method: pt, depth: 6 }
";

/// Case 31: a scene and its mirror image, seen by a mirrored camera, look alike after flipping: glass has its inside
/// where it had it, and what shines to one side shines to that side. Means of columns agree within 5 standard errors. Orientation
/// that ignored the sign of the determinant would turn the lamp off and the glass inside out.
#[test]
fn hard_case_31_mirrored_transforms() {
    let render = |x: &str| {
        let told = render_text(HANDED, &Memory::default(), &[("x", x)], 64);
        told.film.unwrap_or_else(|| panic!("{}", told.report))
    };
    let (film, mirrored) = (render("1"), render("-1"));
    let column = |film: &snell::render::film::Film, x: usize| {
        let (mean, variance) = (film.mean(), film.variance().expect("64 passes"));
        let rows = || (0..24).map(|y| y * 24 + x);
        let sum = rows().map(|i| f64::from(mean[i].mean())).sum::<f64>() / 24.0;
        let spread = rows().map(|i| f64::from(variance[i].mean())).sum::<f64>() / (24.0 * 24.0);
        (sum, spread)
    };
    for x in 0..24 {
        let ((a, va), (b, vb)) = (column(&film, x), column(&mirrored, 23 - x));
        assert!(a > 1e-4, "column {x} is dark");
        assert!((a - b).abs() <= 5.0 * (va + vb).sqrt() + 0.01 * a, "column {x}: {a} and {b}, {va:e} {vb:e}");
    }
}

fn looking(camera: &str) -> String {
    format!(
        "snell 1\ncamera {{ {camera} }}\nlight point {{ position: (1m, 2m, 3m), power: 50W }}\n\
         plane {{ y: -1m }}\nsphere {{ center: (0m, 0m, 0m), radius: 1m }}\nrender {{ method: pt, stop: passes(1) }}\n"
    )
}

/// Case 33: the corners of the camera. An opening of 0 takes the pinhole's path, bit for bit; extreme fields of view,
/// distances and sizes give finite pictures; an up vector along the view is rejected where it stands.
#[test]
fn hard_case_33_camera_corners() {
    let at = "position: (0m, 0m, 4m), look_at: (0m, 0m, 0m)";
    let film = |camera: String| told(&looking(&camera)).unwrap_or_else(|report| panic!("{camera}: {report}"));
    let fov = "fov: 20deg, film: { size: 16 x 16 }";
    let pinhole = film(format!("{at}, {fov}"));
    let closed = film(format!("{at}, {fov}, lens: thin {{ radius: 0m, focus: 3m }}"));
    let open = film(format!("{at}, {fov}, lens: thin {{ radius: 5cm, focus: 3m }}"));
    assert!(film_bits(&pinhole) == film_bits(&closed), "an opening of 0 is a pinhole");
    assert!(film_bits(&pinhole) != film_bits(&open), "an opening of 5 cm is not");
    for camera in [
        "fov: 0.01deg, film: { size: 8 x 8 }",
        "fov: 179deg, film: { size: 8 x 8 }",
        "film: { size: 1 x 1 }",
        "film: { size: 1 x 2000 }",
        "lens: thin { radius: 1mm, focus: 1mm }, film: { size: 8 x 8 }",
        "lens: thin { radius: 1mm, focus: 10000km }, film: { size: 8 x 8 }",
    ] {
        let film = film(format!("{at}, {camera}"));
        assert!(
            film.bad_count() == 0
                && film.mean().iter().all(|pixel| pixel.to_array().into_iter().all(f32::is_finite)),
            "{camera}"
        );
    }
    let report = told(&looking(&format!("{at}, up: (0, 0, 1), {fov}"))).err().expect("up is along the view");
    assert!(report.contains("scene.snell:2:"), "{report}");
}
